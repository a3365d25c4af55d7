//! Cameras, transforms and meshes at which something could become zero, infinite or endless.

use crate::snapshot::findings;
use crate::world::{EDGE, World, places, settings, size_of_box};
use crate::{meshes, surfaces};
use glam::{DAffine3, DQuat, DVec3, UVec2};
use keyleaf::key::{ONE, RootPoint};
use keyleaf::layout::state;
use keyleaf::read_back::Snapshot;
use keyleaf::surface::Surface;
use keyleaf::{Metric, Projection, Settings, View};
use std::sync::Arc;

const SCREEN: UVec2 = UVec2::new(640, 360);

/// Passes with nothing wrong in any, and finite wishes.
fn run(world: &mut World, view: &View, passes: u32, case: &str) -> Snapshot {
    let mut last = world.pass(view);
    for _ in 1..passes {
        assert_eq!(findings(world.surface.topology(), &last), [], "{case}");
        assert!(
            last.states.iter().all(|word| state::wish(*word).is_finite()),
            "{case}: a wish that is no number"
        );
        last = world.pass(view);
    }
    assert_eq!(findings(world.surface.topology(), &last), [], "{case}");
    last
}

#[test]
fn a_camera_exactly_on_the_surface_on_a_vertex_or_an_edge_gets_finite_wishes() {
    for (name, surface) in surfaces::all() {
        let size = size_of_box(surface.bounding_box());
        let face = surface.topology().face_count() - 1;
        for (x, y) in [(0, 0), (ONE, 0), (ONE / 4, 3 * (ONE / 4)), (ONE / 8, ONE / 3)] {
            let at = RootPoint { face, root: 0, x, y };
            let eye = surface.point(at);
            let view = View::look_at(eye, eye + DVec3::new(0.3, -0.2, 0.5) * size, 1.2, 1e-6 * size, SCREEN);
            let settings = Settings {
                capacity: 3000,
                ..settings(EDGE)
            };
            let snapshot = run(
                &mut World::new(&surface, settings),
                &view,
                40,
                &format!("{name} at {at:?}"),
            );
            let deepest = snapshot.leaves.iter().map(|leaf| leaf.place().level).max();
            assert!(deepest > Some(5), "{name} at {at:?}: level {deepest:?}");
        }
    }
}

#[test]
fn a_camera_inside_a_closed_mesh_sees_leaves_on_all_sides() {
    let surface = surfaces::flat(&meshes::cube());
    for capacity in [300, 20_000] {
        let mut world = World::new(
            &surface,
            Settings {
                capacity,
                cull: false,
                ..settings(EDGE)
            },
        );
        let view = View::look_at(DVec3::splat(0.5), DVec3::ZERO, 1.0, 1e-3, SCREEN);
        let snapshot = run(&mut world, &view, 20, "inside");
        assert!(snapshot.leaves.len() as u32 <= capacity);
        let faces: std::collections::BTreeSet<u32> = snapshot.leaves.iter().map(|leaf| leaf.place().face).collect();
        assert_eq!(faces.len(), 6);
    }
}

#[test]
fn extreme_fields_of_view_and_viewports() {
    let surface = surfaces::flat(&meshes::house());
    for fov in [1.0f64, 170.0] {
        for side in [
            UVec2::ZERO,
            UVec2::ONE,
            UVec2::new(8192, 8192),
            UVec2::new(8192, 1),
            UVec2::new(1, 8192),
        ] {
            let view = View::look_at(
                DVec3::new(1.0, 1.2, 1.4),
                DVec3::new(0.2, 0.4, 0.1),
                fov.to_radians(),
                1e-3,
                side,
            );
            let mut world = World::new(
                &surface,
                Settings {
                    capacity: 3000,
                    ..settings(EDGE)
                },
            );
            run(&mut world, &view, 16, &format!("fov {fov}, {side}"));
        }
    }
}

#[test]
fn an_orthographic_camera_refines_everything_alike() {
    let surface = surfaces::flat(&meshes::cube());
    let projection = Projection::Orthographic {
        height: 2.0,
        near: -10.0,
        far: 10.0,
    };
    let mut view = View::look_at(DVec3::new(2.0, 2.0, 2.0), DVec3::splat(0.5), 1.0, 1.0, SCREEN);
    view.projection = projection;
    for metric in [EDGE, Metric::Distance { factor: 5.0 }] {
        let snapshot = run(&mut World::new(&surface, settings(metric)), &view, 20, metric.name());
        let level = snapshot.leaves[0].place().level;
        assert!(
            level > 1 && snapshot.leaves.iter().all(|leaf| leaf.place().level == level),
            "{}",
            metric.name()
        );
        let farther = View {
            eye: view.eye * 2.0,
            ..view
        };
        let again = run(&mut World::new(&surface, settings(metric)), &farther, 20, metric.name());
        assert!(
            places(&again) == places(&snapshot),
            "{}: the distance does not count",
            metric.name()
        );
    }
}

#[test]
fn a_mirrored_object_is_refined_and_culled_like_its_original() {
    let surface = surfaces::by_noise(&meshes::house());
    let eye = DVec3::new(0.75, 1.0, 0.875);
    let settings = Settings {
        guard_factor: 1.0,
        cull: false,
        ..settings(EDGE)
    };
    let look = |eye: DVec3, target: DVec3| View::look_at(eye, target, 1.0, 1e-3, SCREEN);
    let original = run(
        &mut World::new(&surface, settings),
        &look(eye, DVec3::ZERO),
        20,
        "original",
    );
    let flip = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let mirrored = run(
        &mut World::placed(&surface, flip, settings),
        &look(flip.transform_point3(eye), DVec3::ZERO),
        20,
        "mirrored",
    );
    assert!(places(&original) == places(&mirrored));

    // With culling: the mirror image of a view along x = 0 is the view itself, with left and right exchanged.
    let settings = Settings { cull: true, ..settings };
    let view = look(DVec3::new(0.0, 1.5, 2.0), DVec3::new(0.0, 0.5, 0.0));
    let drawn = |transform| {
        let snapshot = run(&mut World::placed(&surface, transform, settings), &view, 20, "both");
        let mut drawn: Vec<_> = snapshot
            .visible
            .iter()
            .map(|slot| snapshot.leaves[*slot as usize].place())
            .collect();
        drawn.sort_unstable();
        drawn
    };
    assert_eq!(drawn(DAffine3::IDENTITY), drawn(flip));
}

/// Multiples of large powers of two, so that nothing rounds in f64.
const FAR: DVec3 = DVec3::new(1_048_576.0, -2_097_152.0, 524_288.0);

#[test]
fn an_object_a_million_units_away_is_refined_like_one_at_zero() {
    let eye = DVec3::new(0.75, 1.0, 0.875);
    let look = |eye: DVec3| View::look_at(eye, eye - DVec3::new(0.5, 0.5, 0.75), 1.0, 1e-3, SCREEN);
    let near = surfaces::flat(&meshes::house());
    let expected = run(&mut World::new(&near, settings(EDGE)), &look(eye), 20, "near");
    let positions = |world: &World, snapshot: &Snapshot| -> Vec<[f32; 3]> {
        world.emit(&crate::snapshot::drawn_slots(snapshot)).positions
    };

    let mut placed = World::placed(&near, DAffine3::from_translation(FAR), settings(EDGE));
    let far = run(&mut placed, &look(eye + FAR), 20, "placed far away");
    assert!(places(&far) == places(&expected), "placed far away");

    let moved = meshes::moved(meshes::house(), FAR);
    // The mesh itself is rounded to 2^-32 there.
    let surface = surfaces::flat(&moved);
    let mut world = World::new(&surface, settings(EDGE));
    let far = run(&mut world, &look(eye + FAR), 20, "vertices far away");
    let difference = places(&far).symmetric_difference(&places(&expected)).count();
    assert!(
        difference * 50 <= expected.leaves.len(),
        "vertices far away: {difference} leaves differ"
    );
    for at in positions(&world, &far) {
        assert!(
            glam::Vec3::from(at).length() < 4.0,
            "{at:?} is not relative to an origin near by"
        );
    }
}

#[test]
fn points_of_an_object_a_million_units_away_are_as_exact_as_at_zero() {
    let surface = surfaces::flat(&meshes::moved(meshes::house(), FAR));
    let mut world = World::new(&surface, settings(EDGE));
    let eye = FAR + DVec3::new(0.75, 1.0, 0.875);
    world.frame(&View::look_at(eye, FAR, 1.0, 1e-3, SCREEN));
    let points: Vec<RootPoint> = surface
        .topology()
        .roots()
        .flat_map(|root| root.children())
        .map(|child| child.middle())
        .collect();
    for (at, gpu) in points.iter().zip(world.evaluate(&points)) {
        let exact = surface.point(*at) - world.quadtree.origin();
        assert!(
            gpu.position.as_dvec3().distance(exact) < 2e-6,
            "{at:?}: {} for {exact}",
            gpu.position
        );
    }
}

#[test]
fn eyes_very_far_away_see_roots_and_eyes_very_near_do_not_hang() {
    let surface = surfaces::flat(&meshes::cube());
    for distance in [1e6, 1e12, 1e18, 1e22, 1e37] {
        let mut world = World::new(&surface, settings(EDGE));
        let eye = DVec3::new(0.3, 1.0, 0.2) * distance;
        let snapshot = run(
            &mut world,
            &View::look_at(eye, DVec3::ZERO, 1.0, 1e-3, SCREEN),
            4,
            &format!("at {distance:e}"),
        );
        assert_eq!(snapshot.leaves.len(), 24, "at {distance:e}");
    }
    for near in [1e-12, 1e-30] {
        let eye = DVec3::new(0.5, 1.0 + near, 0.5);
        let mut world = World::new(
            &surface,
            Settings {
                capacity: 3000,
                ..settings(EDGE)
            },
        );
        run(
            &mut world,
            &View::look_at(eye, DVec3::ZERO, 1.0, near, SCREEN),
            70,
            &format!("at {near:e}"),
        );
    }
}

#[test]
fn looking_straight_down_up_and_at_oneself() {
    let surface = surfaces::flat(&meshes::cube());
    let eye = DVec3::new(0.5, 2.0, 0.5);
    for target in [eye - DVec3::Y, eye + DVec3::Y, eye] {
        run(
            &mut World::new(&surface, settings(EDGE)),
            &View::look_at(eye, target, 1.0, 1e-3, SCREEN),
            6,
            &format!("at {target}"),
        );
    }
}

#[test]
fn a_sliver_a_million_times_longer_than_wide_stays_bounded() {
    let surface = surfaces::flat(&meshes::sliver());
    let view = View::look_at(DVec3::new(0.5, 0.8, 0.9), DVec3::new(0.5, 0.0, 0.0), 1.0, 1e-3, SCREEN);
    let snapshot = run(&mut World::new(&surface, settings(EDGE)), &view, 20, "sliver");
    // Half a unit is 220 pixels from here: five levels on the four long faces, and what balance asks of the ends.
    assert!(snapshot.leaves.len() < 24 * 1024, "{}", snapshot.leaves.len());
    assert!(snapshot.control.starved == 0);
}

#[test]
fn faces_without_area_are_never_refined_for_ever() {
    let mut degenerate = meshes::house();
    degenerate.positions[7] = degenerate.positions[8];
    degenerate.positions[3] = (degenerate.positions[2] + degenerate.positions[4]) / 2.0;
    let all: [Arc<dyn Surface>; 2] = [surfaces::flat(&degenerate), surfaces::by_noise(&degenerate)];
    for surface in all {
        let view = View::look_at(
            degenerate.positions[7] + DVec3::splat(0.3),
            degenerate.positions[7],
            1.0,
            1e-3,
            SCREEN,
        );
        let snapshot = run(&mut World::new(&surface, settings(EDGE)), &view, 24, "degenerate");
        assert_eq!(
            (
                snapshot.control.starved,
                snapshot.control.last_splits,
                snapshot.control.last_merges
            ),
            (0, 0, 0)
        );
    }
}

#[test]
fn a_rotated_and_stretched_object_is_watched_in_world_units() {
    // The same shape twice: as a mesh, and as a smaller one that is placed larger.
    let mut small = meshes::cube();
    small.positions.iter_mut().for_each(|p| *p *= 0.125);
    let turn = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let view = View::look_at(
        DVec3::new(1.5, 1.25, -1.0),
        DVec3::new(0.5, 0.5, -0.5),
        1.0,
        1e-3,
        SCREEN,
    );
    let mut large = meshes::cube();
    large.positions.iter_mut().for_each(|p| *p = turn * *p);
    let expected = run(
        &mut World::new(&surfaces::flat(&large), settings(EDGE)),
        &view,
        16,
        "large",
    );
    let transform = DAffine3::from_scale_rotation_translation(DVec3::splat(8.0), turn, DVec3::ZERO);
    let found = run(
        &mut World::placed(&surfaces::flat(&small), transform, settings(EDGE)),
        &view,
        16,
        "small",
    );
    let difference = places(&found).symmetric_difference(&places(&expected)).count();
    assert!(
        difference * 50 <= expected.leaves.len(),
        "{difference} of {} differ",
        expected.leaves.len()
    );
}
