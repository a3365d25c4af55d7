//! The forest and the executable model, pass by pass.

use crate::executable_model::{Leaves, Model, Node};
use crate::meshes::{self, Mesh};
use crate::metrics::{self, Kind, Metric};
use keyleaf_key::forest::{Changes, wish};
use keyleaf_key::{Forest, Key, Place, Published};
use proptest::prelude::*;
use std::collections::{BTreeMap, HashMap};

fn node_of(place: Place) -> Node {
    (place.face, place.root, place.key().digits().collect())
}

fn place_of(node: &Node) -> Place {
    node.2
        .iter()
        .fold(Place::of_root(node.0, node.1), |place, digit| place.child(*digit))
}

/// The forest folds requests into the wish when it publishes, the model when it reads.
fn as_published(leaves: &Leaves, requests: &HashMap<Node, f64>, max_level: u32) -> BTreeMap<Place, Published> {
    let folded = |(node, &(wish, merge)): (&Node, &(f64, bool))| {
        let open = (node.2.len() as u32) < max_level;
        let wish = if open {
            wish.max(requests.get(node).copied().unwrap_or(0.0))
        } else {
            0.0
        };
        (
            place_of(node),
            Published {
                wish: wish as f32,
                merge,
            },
        )
    };
    leaves.iter().map(folded).collect()
}

/// One metric for a number of passes.
#[derive(Clone, Copy, Debug)]
struct Jump {
    metric: Metric,
    scale: f64,
    capacity: usize,
    passes: usize,
}

fn compare(mesh: &Mesh, max_level: u32, jumps: impl IntoIterator<Item = Jump>) {
    let topology = mesh.topology();
    let model = Model::new(mesh, max_level as usize);
    let mut forest = Forest::new(&topology, max_level);
    let (mut leaves, mut requests) = (model.start(), HashMap::new());
    for Jump {
        metric,
        scale,
        capacity,
        passes,
    } in jumps
    {
        let metric = metric.on(&topology);
        let of_place = |place: &Place| metric(place) * scale;
        let of_node = |node: &Node| f64::from(wish(of_place(&place_of(node))));
        for _ in 0..passes {
            let changed;
            (leaves, requests, changed) = model.update(&leaves, &requests, of_node, capacity);

            let changes = forest.decide(capacity);
            let asked: BTreeMap<Place, f32> = requests
                .iter()
                .map(|(node, request)| (place_of(node), *request as f32))
                .collect();
            assert_eq!(changes.leaves_changed(), changed);
            assert_eq!(changes.requests, asked);
            forest.apply(changes);
            forest.publish(of_place);
            assert_eq!(forest.leaves, as_published(&leaves, &requests, max_level));
        }
    }
}

#[test]
fn leaves_wishes_merges_and_requests_are_those_of_the_model_on_the_unit_cube() {
    for seed in 0..4 {
        for kind in [Kind::Distance, Kind::Random, Kind::Lopsided] {
            let metric = |number: u64| Metric::new(kind, 10 * number + seed);
            let jump = |number| Jump {
                metric: metric(number),
                scale: 1.0,
                capacity: usize::MAX,
                passes: 12,
            };
            compare(&meshes::cube(), 4, (0..3).map(jump));
        }
    }
}

prop_compose! {
    fn jump()(
        metric in metrics::any_kind(),
        scale in 0.1..4.0_f64,
        capacity in prop_oneof![Just(usize::MAX), 20..600_usize],
        passes in 1..10_usize,
    ) -> Jump {
        Jump { metric, scale, capacity, passes }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn leaves_wishes_merges_and_requests_are_those_of_the_model(
        mesh in meshes::random(),
        jumps in prop::collection::vec(jump(), 1..5),
    ) {
        compare(&mesh, 4, jumps);
    }

    /// What a GPU does: the published values come from elsewhere, and only the decisions are compared.
    #[test]
    fn decisions_depend_on_published_values_alone(mesh in meshes::random(), metric in metrics::any_kind(), passes in 0..8_usize) {
        let topology = mesh.topology();
        let metric = metric.on(&topology);
        let mut forest = Forest::new(&topology, 5);
        for _ in 0..passes {
            forest.update(&metric, 400);
        }
        let mut twin = Forest::with_leaves(&topology, 5, []);
        twin.leaves = forest.leaves.iter().map(|(place, published)| (place.key(), *published))
            .map(|(key, published)| (Key::place(key).expect("a key"), published)).collect();
        prop_assert_eq!(twin.decide(400), forest.decide(400));
    }
}

#[test]
fn update_is_decide_apply_publish() {
    let topology = meshes::house().topology();
    let metric = Metric::new(Kind::Graded, 3).on(&topology);
    let (mut whole, mut parts) = (Forest::new(&topology, 5), Forest::new(&topology, 5));
    for _ in 0..20 {
        let changes: Changes = parts.decide(300);
        parts.apply(changes.clone());
        parts.publish(&metric);
        assert_eq!(whole.update(&metric, 300), changes);
        assert_eq!((&whole.leaves, &whole.requests), (&parts.leaves, &parts.requests));
    }
    assert_eq!(node_of(place_of(&(2, 1, vec![3, 0, 1]))), (2, 1, vec![3, 0, 1]));
}
