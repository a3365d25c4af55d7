//! A frame that is right has no findings; one that is broken in one place is found out.

use super::*;
use glam::{DVec3, UVec2};
use keyleaf::BackFaces;
use keyleaf::key::neighbour::{about_right_angle, across_outer_leg};
use keyleaf::key::{Forest, Key, Place};
use keyleaf::layout::{Control, Leaf, NO_ENTRY, state, table_entries};
use std::collections::BTreeSet;
use std::convert::Infallible;

fn mesh() -> Topology {
    // A quad, a triangle and a pentagon that share edges, with boundaries.
    Topology::new(9, [vec![0, 1, 2, 3], vec![2, 1, 4], vec![3, 2, 4, 5, 6]]).unwrap()
}

fn settings() -> Settings {
    Settings {
        capacity: 4096,
        base_grid: 2,
        cull: false,
        ..Settings::default()
    }
}

/// A pseudo-random balanced refinement.
fn refined(topology: &Topology, seed: u32) -> Vec<Place> {
    let metric = |p: &Place| {
        let mut h = seed ^ p.x.wrapping_mul(0x9e37_79b1) ^ p.y.wrapping_mul(0x85eb_ca77) ^ (p.face * 31 + p.root);
        h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
        if (h ^ (h >> 13)) % 100 < 25 { 2.0 } else { 0.5 }
    };
    Forest::new(topology, 4).coarsest_balanced(metric).into_iter().collect()
}

/// What the GPU would hold for these leaves.
fn snapshot(topology: &Topology, places: &[Place]) -> Snapshot {
    let there: BTreeSet<Place> = places.iter().copied().collect();
    let mut table = vec![0; table_entries(settings().capacity) as usize];
    let mut leaves: Vec<Leaf> = places.iter().map(Leaf::new).collect();
    table::fill(&mut table, &mut leaves);
    let is_pair = |p: &Place| across_outer_leg(topology, *p).is_some_and(|c| there.contains(&c));
    let is_free =
        |p: &Place| about_right_angle(topology, *p).is_some_and(|nodes| nodes.iter().all(|node| there.contains(node)));
    let flags = |p: &Place| (u32::from(is_pair(p)) * state::PAIR) | (u32::from(is_free(p)) * state::FREE);
    let word = |p: &Place| flags(p) | state::digit_of(*p) << state::DIGIT_SHIFT;
    let odd_half = |p: &Place| is_pair(p) && p.is_odd_half();
    let visible: Vec<u32> = (0..places.len() as u32)
        .filter(|&slot| !odd_half(&places[slot as usize]))
        .collect();
    let count = places.len() as u32;
    let control = Control {
        leaves: count,
        visible: visible.len() as u32,
        entries_used: count,
        ..Control::default()
    };
    Snapshot {
        leaves,
        states: places.iter().map(word).collect(),
        requests: vec![0; places.len()],
        statistics: Statistics {
            leaves: count,
            visible: control.visible,
            triangles: 0,
            splits: 0,
            merges: 0,
            unmet: 0,
            starved: 0,
            capacity: settings().capacity,
            threshold_factor: 1.0,
            passes: 1,
            rebuilds: 0,
            table_load: 0.1,
            lost: 0,
        },
        visible,
        control,
        table,
    }
}

/// Positions that depend on nothing but the identity of a point.
fn emit(topology: &Topology, snapshot: &Snapshot, slots: &[u32]) -> Emitted {
    let k = settings().base_grid;
    let mut emitted = Emitted::default();
    for &slot in slots {
        let place = snapshot.leaves[slot as usize].place();
        for v in BaseGrid::of(&settings()).vertices {
            let is_pair = snapshot.is_pair(slot as usize) && about_right_angle(topology, place).is_some();
            let point = grid_point(place, is_pair, [v & 0xffff, v >> 16], k);
            let number = site_number(topology, point);
            emitted.positions.push([
                number as u32 as f32,
                (number >> 32) as u32 as f32,
                (number >> 64) as f32,
            ]);
            emitted.normals.push([0.0, 1.0, 0.0]);
        }
    }
    emitted
}

fn check_with(topology: &Topology, snapshot: &Snapshot, spoil: impl Fn(&mut Emitted)) -> Findings {
    let emit = |slots: &[u32]| {
        let mut emitted = emit(topology, snapshot, slots);
        spoil(&mut emitted);
        Ok::<_, Infallible>(emitted)
    };
    frame(topology, snapshot, &settings(), None, emit).unwrap()
}

fn check(topology: &Topology, snapshot: &Snapshot) -> Findings {
    check_with(topology, snapshot, |_| ())
}

fn kinds(findings: &Findings) -> Vec<FindingKind> {
    findings.counts.keys().copied().collect()
}

#[test]
fn balanced_refinements_have_no_findings() {
    let topology = mesh();
    for seed in 0..20 {
        let places = refined(&topology, seed);
        let findings = check(&topology, &snapshot(&topology, &places));
        assert!(
            findings.is_empty(),
            "seed {seed}, {} leaves: {findings:#?}",
            places.len()
        );
    }
}

#[test]
fn pairs_are_drawn_as_the_triangle_of_the_place() {
    for k in 0..=3 {
        let n = 1 << k;
        let parent = Place::of_root(1, 2).child(3).child(1);
        for digit in 0..4 {
            let leaf = parent.child(digit);
            let corners = |is_pair| [[0, 0], [n, 0], [0, n]].map(|at| grid_point(leaf, is_pair, at, k));
            assert_eq!(corners(false), leaf.corners());
            let Some(expected) = leaf.drawn(true) else { continue };
            let at = expected.iter().position(|p| *p == corners(true)[0]).unwrap();
            assert_eq!(corners(true), [0, 1, 2].map(|i| expected[(at + i) % 3]));
        }
    }
}

#[test]
fn a_missing_leaf_is_found() {
    let topology = mesh();
    let mut places = refined(&topology, 1);
    places.remove(7);
    let found = kinds(&check(&topology, &snapshot(&topology, &places)));
    assert!(
        found.contains(&FindingKind::LostLeaf) && found.contains(&FindingKind::Crack),
        "{found:?}"
    );
}

#[test]
fn a_double_leaf_is_found() {
    let topology = mesh();
    let mut places = refined(&topology, 2);
    let drawn = places.iter().copied().find(|p| p.digit() == Some(2)).unwrap(); // an even one is always drawn
    places.push(drawn);
    let found = kinds(&check(&topology, &snapshot(&topology, &places)));
    assert!(
        found.contains(&FindingKind::DuplicateLeaf) && found.contains(&FindingKind::Overlap),
        "{found:?}"
    );
}

#[test]
fn half_a_diamond_that_splits_alone_is_found() {
    let topology = mesh();
    let places = refined(&topology, 3);
    let deepest = places.iter().map(|p| p.level).max().unwrap();
    let alone = places
        .iter()
        .position(|p| p.level == deepest && h_is_inside(&topology, *p))
        .unwrap();
    let mut broken = places.clone();
    let halves = broken.remove(alone).children();
    broken.extend(halves);
    let found = kinds(&check(&topology, &snapshot(&topology, &broken)));
    assert!(
        found.contains(&FindingKind::HalfDiamond) && found.contains(&FindingKind::TJunction),
        "{found:?}"
    );
}

fn h_is_inside(topology: &Topology, place: Place) -> bool {
    keyleaf::key::neighbour::h(topology, place).is_some()
}

#[test]
fn a_leaf_inside_a_leaf_is_found() {
    let topology = mesh();
    let mut places = refined(&topology, 4);
    places.extend(places[5].children());
    let found = kinds(&check(&topology, &snapshot(&topology, &places)));
    assert!(found.contains(&FindingKind::Overlap), "{found:?}");
}

#[test]
fn every_wrong_pair_flag_is_found_as_such_and_as_a_crack() {
    let topology = mesh();
    let places = refined(&topology, 5);
    for slot in 0..places.len() {
        let mut broken = snapshot(&topology, &places);
        broken.states[slot] ^= state::PAIR;
        let found = kinds(&check(&topology, &broken));
        assert!(found.contains(&FindingKind::PairFlag), "{found:?}");
        if about_right_angle(&topology, places[slot]).is_none() {
            continue; // a root that is half of none
        }
        let edges = [FindingKind::Crack, FindingKind::TJunction, FindingKind::Overlap];
        assert!(edges.iter().any(|kind| found.contains(kind)), "slot {slot}: {found:?}");
    }
}

/// Slots of leaves that may be drawn as pairs, four about one vertex.
fn free_slots(topology: &Topology, places: &[Place]) -> [usize; 4] {
    let slot = |place: &Place| places.iter().position(|other| other == place);
    let about = |place: &Place| Some(about_right_angle(topology, *place)?.map(|node| slot(&node)));
    let mut all = places.iter().filter_map(about);
    all.find_map(|[a, b, c, d]| Some([a?, b?, c?, d?]))
        .expect("some are free")
}

#[test]
fn free_leaves_may_be_pairs_all_four_or_none() {
    let topology = mesh();
    let places = refined(&topology, 7);
    let four = free_slots(&topology, &places);
    let paired = |count: usize| {
        let mut snapshot = snapshot(&topology, &places);
        for &slot in &four[..count] {
            snapshot.states[slot] |= state::PAIR;
        }
        let is_odd = |slot: u32| places[slot as usize].is_odd_half();
        let states = snapshot.states.clone();
        snapshot
            .visible
            .retain(|&slot| !(is_odd(slot) && states[slot as usize] & state::PAIR != 0));
        kinds(&check(&topology, &snapshot))
    };
    assert_eq!(paired(4), []);
    for count in 1..4 {
        let found = paired(count);
        assert!(found.contains(&FindingKind::PairFlag), "{count}: {found:?}");
    }
    let mut broken = snapshot(&topology, &places);
    broken.states[four[0]] ^= state::FREE;
    assert!(kinds(&check(&topology, &broken)).contains(&FindingKind::State));
}

#[test]
fn other_bits_on_one_side_of_an_edge_are_a_crack() {
    let topology = mesh();
    let right = snapshot(&topology, &refined(&topology, 6));
    let findings = check_with(&topology, &right, |e| {
        e.positions[0][1] = f32::from_bits(e.positions[0][1].to_bits() + 1)
    });
    assert_eq!(kinds(&findings), [FindingKind::Crack]);
    let findings = check_with(&topology, &right, |e| {
        e.positions[0] = e.positions[0].map(|c| if c == 0.0 { -0.0 } else { c })
    });
    assert!(findings.is_empty() || kinds(&findings) == [FindingKind::Crack]);
}

#[test]
fn vertices_that_are_not_finite_are_found() {
    let topology = mesh();
    let right = snapshot(&topology, &refined(&topology, 7));
    let inner = |e: &mut Emitted| e.positions[6][0] = f32::NAN; // (1, 1): inside the leaf's grid
    assert_eq!(kinds(&check_with(&topology, &right, inner)), [FindingKind::NonFinite]);
    let zero = |e: &mut Emitted| e.normals[9] = [0.0; 3];
    assert_eq!(kinds(&check_with(&topology, &right, zero)), [FindingKind::NonFinite]);
}

#[test]
fn wrong_keys_states_lists_and_counters_are_found() {
    let topology = mesh();
    let right = snapshot(&topology, &refined(&topology, 8));
    let broken = |spoil: &dyn Fn(&mut Snapshot)| {
        let mut broken = right.clone();
        spoil(&mut broken);
        kinds(&check(&topology, &broken))
    };
    assert_eq!(broken(&|s| s.leaves[2].key = s.leaves[3].key), [FindingKind::Key]);
    assert!(broken(&|s| s.leaves[2].key = Key::from_words([0, 0, 77, 0])).contains(&FindingKind::Key));
    assert!(broken(&|s| s.leaves[2].origin[0] += 1).contains(&FindingKind::Key));
    assert_eq!(
        broken(&|s| s.states[4] ^= 1 << state::DIGIT_SHIFT),
        [FindingKind::State]
    );
    assert_eq!(broken(&|s| s.visible[0] = s.visible[1]), [FindingKind::DrawList]);
    assert_eq!(broken(&|s| s.visible[0] = u32::MAX), [FindingKind::DrawList]);
    assert_eq!(broken(&|s| s.control.lost = 1), [FindingKind::Counter]);
    assert_eq!(broken(&|s| s.control.leaves = 5000), [FindingKind::Counter]);
}

#[test]
fn wrong_table_entries_are_found() {
    let topology = mesh();
    let right = snapshot(&topology, &refined(&topology, 9));
    for slot in 0..right.leaves.len() {
        let entry = right.leaves[slot].entry as usize;
        let mut broken = [right.clone(), right.clone(), right.clone(), right.clone()];
        broken[0].table[entry] = 0;
        broken[1].table[entry] ^= 1 << 30;
        broken[2].leaves[slot].entry = NO_ENTRY;
        broken[3].control.entries_used -= 1;
        for broken in broken {
            assert_eq!(kinds(&check(&topology, &broken)), [FindingKind::Table]);
        }
    }
}

#[test]
fn leaves_in_view_that_are_culled_are_found() {
    let topology = mesh();
    let mut snapshot = snapshot(&topology, &refined(&topology, 10));
    snapshot.visible.clear();
    let culled = Settings {
        cull: true,
        ..settings()
    };
    let view = View::look_at(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 1.0, 0.1, UVec2::new(64, 64));
    let sight = Sight::new(&view, &glam::DAffine3::IDENTITY, DVec3::ZERO);
    let at = |position: [f32; 3]| {
        let emit = |slots: &[u32]| {
            let count = slots.len() * BaseGrid::of(&settings()).vertices.len();
            Ok::<_, Infallible>(Emitted {
                positions: vec![position; count],
                normals: vec![[0.0, 1.0, 0.0]; count],
            })
        };
        kinds(&frame(&topology, &snapshot, &culled, Some(&sight), emit).unwrap())
    };
    assert_eq!(at([0.0; 3]), [FindingKind::Culled]);
    assert_eq!(at([0.0, 0.0, 9.0]), []);
    assert_eq!(at([50.0, 0.0, 0.0]), []);
}

#[test]
fn leaves_seen_from_behind_may_be_culled_where_that_is_wanted() {
    let topology = mesh();
    let mut snapshot = snapshot(&topology, &refined(&topology, 10));
    snapshot.visible.clear();
    let from = |z: f64, back_faces: BackFaces| {
        let settings = Settings {
            cull: true,
            back_faces,
            ..settings()
        };
        let view = View::look_at(DVec3::new(0.0, 0.0, z), DVec3::ZERO, 1.0, 0.1, UVec2::new(64, 64));
        let sight = Sight::new(&view, &glam::DAffine3::IDENTITY, DVec3::ZERO);
        // All leaves lie in the plane z = 0, their fronts to +z.
        let emit = |slots: &[u32]| {
            let corners = BaseGrid::of(&settings).vertices;
            let corner = |v: &u32| [(v & 0xffff) as f32 / 8.0, (v >> 16) as f32 / 8.0, 0.0];
            let leaf: Vec<[f32; 3]> = corners.iter().map(corner).collect();
            Ok::<_, Infallible>(Emitted {
                positions: leaf.repeat(slots.len()),
                normals: vec![[0.0, 0.0, 1.0]; leaf.len() * slots.len()],
            })
        };
        let found = frame(&topology, &snapshot, &settings, Some(&sight), emit).unwrap();
        found.counts.contains_key(&FindingKind::Culled)
    };
    for (back_faces, front, back) in [
        (BackFaces::Drawn, true, true),
        (BackFaces::Leaves, true, false),
        (BackFaces::Conservative, true, false),
        (BackFaces::Strong, false, false),
    ] {
        assert_eq!(
            (from(9.0, back_faces), from(-9.0, back_faces)),
            (front, back),
            "{back_faces:?}"
        );
    }
}

/// Two triangles at depths 4 and 2, the second over the left half of the picture.
fn two_triangles(view: &View) -> PictureCheck {
    let sight = Sight::new(view, &glam::DAffine3::IDENTITY, DVec3::ZERO);
    let mut check = PictureCheck::new(view);
    let indices = std::sync::Arc::from([0, 1, 2]);
    check.add(
        Key::of_root(0, 0),
        &[[-50.0, -50.0, -4.0], [50.0, -50.0, -4.0], [0.0, 90.0, -4.0]],
        &indices,
        &sight,
        true,
    );
    check.add(
        Key::of_root(0, 1),
        &[[-99.0, -99.0, -2.0], [0.0, -99.0, -2.0], [0.0, 99.0, -2.0]],
        &indices,
        &sight,
        true,
    );
    check
}

#[test]
fn triangles_seen_from_behind_hide_nothing_where_they_are_not_drawn() {
    let size = UVec2::new(16, 16);
    let view = View::look_at(DVec3::ZERO, DVec3::NEG_Z, 1.0, 0.1, size);
    let sight = Sight::new(&view, &glam::DAffine3::IDENTITY, DVec3::ZERO);
    let findings_of_nothing = |corners: [[f32; 3]; 3], is_two_sided: bool| {
        let mut check = PictureCheck::new(&view);
        let indices = std::sync::Arc::from([0, 1, 2]);
        check.add(Key::of_root(0, 0), &corners, &indices, &sight, is_two_sided);
        let mut findings = Findings::default();
        check.check(size, &[[0.0; 4]; 256], 100, &mut findings);
        findings.total()
    };
    let front = [[-50.0, -50.0, -4.0], [50.0, -50.0, -4.0], [0.0, 90.0, -4.0]];
    let back = [front[0], front[2], front[1]];
    assert!(findings_of_nothing(front, false) > 50 && findings_of_nothing(back, true) > 50);
    assert_eq!(findings_of_nothing(back, false), 0);
}

#[test]
fn pictures_that_show_the_triangles_pass_and_others_do_not() {
    let size = UVec2::new(32, 20);
    let view = View::look_at(DVec3::ZERO, DVec3::NEG_Z, 1.0, 0.1, size);
    let check = two_triangles(&view);
    let shown = |depth: &dyn Fn(u32) -> f64| -> Vec<[f32; 4]> {
        (0..size.x * size.y)
            .map(|i| {
                let (x, y) = (f64::from(i % size.x) + 0.5 - 16.0, f64::from(i / size.x) + 0.5 - 10.0);
                let depth = depth(i % size.x);
                let p = DVec3::new(x, -y, -view.pixels_per_unit()) * depth / view.pixels_per_unit();
                [p.x as f32, p.y as f32, p.z as f32, if depth > 0.0 { 1.0 } else { 0.0 }]
            })
            .collect()
    };
    let count = |pixels: &[[f32; 4]]| {
        let mut findings = Findings::default();
        check.check(size, pixels, 200, &mut findings);
        findings.total()
    };
    assert_eq!(count(&shown(&|x| if x < 16 { 2.0 } else { 4.0 })), 0);
    assert!(count(&shown(&|_| 4.0)) > 50, "what is hidden shows through");
    assert!(count(&shown(&|_| 3.0)) > 150, "there is no triangle at depth 3");
    assert!(count(&shown(&|_| 0.0)) > 150, "nothing is shown");
    let mut shifted = shown(&|x| if x < 16 { 2.0 } else { 4.0 });
    shifted.rotate_right(2);
    assert!(count(&shifted) > 150, "positions belong to other pixels");
}
