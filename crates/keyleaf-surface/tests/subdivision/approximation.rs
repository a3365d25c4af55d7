//! What is drawn against the limit surface.

use crate::models::{LOOP, Random, any_point, disc, prism, settings};
use crate::oracle_tables::oracle;
use crate::oracles::for_every_table;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{Subdivision, SubdivisionScheme, Surface};

/// The greatest distance between what is drawn and the limit surface at equal parameters, in the terminal patch of face 0 at its first
/// corner, over the length of the patch.
fn error_of_terminal_patch(surface: &Subdivision, isolation: u32) -> f64 {
    let mut random = Random(3);
    let corner = |x: u32| RootPoint {
        face: 0,
        root: 0,
        x,
        y: ONE - x,
    };
    let unit = ONE >> isolation;
    let extent = surface.point(corner(ONE)).distance(surface.point(corner(ONE - unit)));
    let points = (0..200).map(|_| {
        let x = ONE - random.below(unit / 2);
        RootPoint {
            face: 0,
            root: 0,
            x,
            y: random.below(ONE - x + 1),
        }
    });
    let error = |at| surface.approximate(at).position.distance(surface.frame(at).position);
    points.map(error).fold(0.0, f64::max) / extent
}

/// The anchors are those of another mesh; they are relative to the cell as well.
#[test]
fn terminal_patches_err_less_at_equal_parameters_than_those_of_loop_and_schaefer() {
    let Some(anchors) = oracle("accuracy_anchors.json") else {
        return;
    };
    for n in [3, 5, 6, 8, 12, 16, 32] {
        let control = disc(n, SubdivisionScheme::CatmullClark);
        for isolation in [1, 2, 3, 4, 5] {
            let made = settings(SubdivisionScheme::CatmullClark, isolation);
            let surface = Subdivision::new(&control, made).expect("a surface");
            let anchor = &anchors["acc_terminal_patch_error_by_depth"][n.to_string()][isolation as usize - 1][0];
            let error = error_of_terminal_patch(&surface, isolation);
            assert!(
                error <= anchor.as_f64().expect("a number"),
                "{n} at {isolation}: {error} {anchor}"
            );
        }
    }
}

#[test]
fn terminal_patches_have_the_limit_position_and_normal_at_their_corner() {
    for scheme in [SubdivisionScheme::CatmullClark, LOOP] {
        for n in 3..=12 {
            for isolation in [1, 4, 8] {
                let surface = Subdivision::new(&disc(n, scheme), settings(scheme, isolation)).expect("a surface");
                let at = RootPoint {
                    face: 0,
                    root: 0,
                    x: ONE,
                    y: 0,
                };
                let (drawn, exact) = (surface.approximate(at), surface.frame(at));
                assert!(drawn.position.distance(exact.position) < 1e-13, "{scheme:?} {n}");
                assert!(drawn.normal.cross(exact.normal).length() < 1e-9, "{scheme:?} {n}");
                assert!(drawn.normal.dot(exact.normal) > 0.0, "{scheme:?} {n}");
            }
        }
    }
}

#[test]
fn what_is_drawn_is_the_limit_surface_within_the_estimated_error() {
    let mut random = Random(5);
    for_every_table(|name, _, scheme, control| {
        for isolation in [3, 8] {
            let Ok(surface) = Subdivision::new(control, settings(scheme, isolation)) else {
                return;
            };
            let (low, high) = surface.bounding_box();
            let room = surface.terminal_error() + 1e-14 * low.abs().max(high.abs()).max_element();
            for _ in 0..150 {
                let at = any_point(&surface, &mut random);
                let off = surface.approximate(at).position.distance(surface.point(at));
                assert!(off <= room, "{name} at {isolation}: {off:e} {room:e} {at:?}");
            }
        }
    });
}

#[test]
fn errors_fall_with_the_isolation() {
    for scheme in [SubdivisionScheme::CatmullClark, LOOP] {
        for n in [3, 5, 7, 12] {
            let control = disc(n, scheme);
            let error = |isolation| {
                let made = Subdivision::new(&control, settings(scheme, isolation));
                made.expect("a surface").terminal_error()
            };
            let errors: Vec<f64> = (1..=16).map(error).collect();
            assert!(
                errors.windows(2).all(|pair| pair[1] < pair[0]),
                "{scheme:?} {n}: {errors:?}"
            );
        }
    }
    let error = |isolation| {
        let made = Subdivision::new(&prism(5), settings(SubdivisionScheme::CatmullClark, isolation));
        made.expect("a surface").terminal_error()
    };
    assert!(error(0) > error(4) && error(4) > error(16));
}

#[test]
fn both_sides_of_an_edge_are_evaluated_at_one_address_and_agree() {
    let mut random = Random(11);
    for_every_table(|name, _, scheme, control| {
        let Ok(surface) = Subdivision::new(control, settings(scheme, 8)) else {
            return;
        };
        let topology = surface.topology();
        let largest = control
            .mesh
            .positions
            .iter()
            .map(|p| p.abs().max_element())
            .fold(0.0, f64::max);
        for place in topology.roots().take(400) {
            let Some(twin) = topology.twin(place.face, place.root) else {
                continue;
            };
            let x = random.below(ONE + 1);
            let own = RootPoint {
                face: place.face,
                root: place.root,
                x,
                y: ONE - x,
            };
            let other = RootPoint {
                face: twin.face,
                root: twin.root,
                x: ONE - x,
                y: x,
            };
            assert_eq!(surface.point(own), surface.point(other), "{name}");
            let [own, other] = [own, other].map(|at| surface.approximate(at).position);
            assert!(own.distance(other) <= 1e-14 * largest, "{name}: {own} {other}");
        }
    });
}
