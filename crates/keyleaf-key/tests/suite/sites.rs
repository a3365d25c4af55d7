//! Sites: equal exactly where the points are.

use crate::meshes;
use keyleaf_key::{HalfEdge, ONE, RootPoint, Site, Topology};
use proptest::prelude::*;
use std::collections::HashMap;

/// All points of all roots whose coordinates are multiples of ONE / 8, or that and one unit less or more along a border.
fn lattice(topology: &Topology) -> impl Iterator<Item = RootPoint> {
    const STEP: u32 = ONE / 8;
    let values = || (0..=8).flat_map(|i| [(i * STEP).saturating_sub(1), i * STEP, (i * STEP + 1).min(ONE)]);
    let pairs: Vec<(u32, u32)> = values()
        .flat_map(|x| values().map(move |y| (x, y)))
        .filter(|(x, y)| *y <= ONE - x)
        .collect();
    topology.roots().flat_map(move |root| {
        pairs.clone().into_iter().map(move |(x, y)| RootPoint {
            face: root.face,
            root: root.root,
            x,
            y,
        })
    })
}

fn equal_sites_iff_equal_positions(mesh: &meshes::Mesh) {
    let topology = mesh.topology();
    let (mut position_of, mut site_of) = (HashMap::new(), HashMap::new());
    for point in lattice(&topology) {
        let (site, position) = (Site::of(&topology, point), mesh.position(point));
        assert_eq!(
            *position_of.entry(site).or_insert(position),
            position,
            "{site:?} has two positions"
        );
        assert_eq!(
            *site_of.entry(position).or_insert(site),
            site,
            "{point:?} has two sites"
        );
    }
}

#[test]
fn sites_are_equal_iff_points_are_on_meshes_made_by_hand() {
    meshes::by_hand().iter().for_each(equal_sites_iff_equal_positions);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn sites_are_equal_iff_points_are_on_random_meshes(mesh in meshes::random()) {
        equal_sites_iff_equal_positions(&mesh);
    }
}

#[test]
fn edges_are_measured_from_the_start_of_their_owner_and_spokes_from_the_centre() {
    let topology = Topology::new(4, [[0, 1, 2], [2, 1, 3]]).expect("two triangles");
    let site = |face, root, x, y| Site::of(&topology, RootPoint { face, root, x, y });
    let owner = HalfEdge { face: 0, root: 1 };
    assert_eq!(site(0, 1, ONE - 5, 5), Site::Edge { owner, t: 5 });
    assert_eq!(site(1, 0, 5, ONE - 5), Site::Edge { owner, t: 5 });
    assert_eq!(
        site(0, 2, 7, 0),
        Site::Spoke {
            face: 0,
            corner: 2,
            t: 7
        }
    );
    assert_eq!(
        site(0, 1, 0, 7),
        Site::Spoke {
            face: 0,
            corner: 2,
            t: 7
        }
    );
    assert_eq!(
        site(0, 2, 0, 7),
        Site::Spoke {
            face: 0,
            corner: 0,
            t: 7
        }
    );
    assert_eq!(
        site(1, 1, 0, ONE),
        Site::Vertex {
            vertex: 3,
            owner: HalfEdge { face: 1, root: 2 }
        }
    );
    assert_eq!(site(1, 1, 0, 0), Site::Centre { face: 1 });
    assert_eq!(
        site(1, 2, 1, 1),
        Site::Interior(RootPoint {
            face: 1,
            root: 2,
            x: 1,
            y: 1
        })
    );
}
