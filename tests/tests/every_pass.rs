//! What must hold after every pass, whatever the camera does: see `snapshot::findings`.

use crate::snapshot::findings;
use crate::surfaces;
use crate::world::{EDGE, World, settings, size_of_box};
use glam::{DQuat, DVec3, UVec2};
use keyleaf::surface::Surface;
use keyleaf::{Pairs, Settings, View};
use std::sync::Arc;

/// A fly-in from afar to a point on the surface, a fast turn there, and teleports. (what, view)
fn flight(surface: &dyn Surface) -> Vec<(String, View)> {
    let (low, high) = surface.bounding_box();
    let size = size_of_box((low, high));
    let goal = surface.point(surface.face_coord(0, 0.31, 0.27).expect("a point of face 0"));
    let start = goal + DVec3::new(0.6, 0.9, 0.5) * 2.0 * size;
    let look = |eye: DVec3, target: DVec3| View::look_at(eye, target, 1.0, 1e-5 * size, UVec2::new(400, 300));
    let mut views = Vec::new();
    for step in 0..14 {
        let left = 0.55_f64.powi(step);
        views.push((format!("fly-in {step}"), look(goal + (start - goal) * left, goal)));
    }
    let there = goal + (start - goal) * 2e-3;
    for step in 0..8 {
        let mut view = look(there, goal);
        view.orientation = DQuat::from_rotation_y(f64::from(step) * 0.9) * view.orientation;
        views.push((format!("turn {step}"), view));
    }
    for (step, (x, y, z)) in [
        (0.1, 0.2, 0.9),
        (0.9, 1.1, 0.1),
        (-1.0, 0.5, -1.5),
        (0.5, 0.5, 0.5),
        (0.3, 3.0, 0.3),
    ]
    .into_iter()
    .enumerate()
    {
        let view = look(low + (high - low) * DVec3::new(x, y, z), (low + high) / 2.0);
        views.extend((0..3).map(|pass| (format!("teleport {step} pass {pass}"), view)));
    }
    views
}

/// Flies and checks each frame. Returns the most leaves, and the most that were starved.
fn fly(name: &str, surface: &Arc<dyn Surface>, settings: Settings) -> (u32, u32) {
    let mut world = World::new(surface, settings);
    let (mut most, mut starved) = (0, 0);
    for (what, view) in flight(surface.as_ref()) {
        let snapshot = world.pass(&view);
        assert_eq!(findings(surface.topology(), &snapshot), [], "{name}, {what}");
        most = most.max(snapshot.control.leaves);
        starved = starved.max(snapshot.control.starved);
    }
    (most, starved)
}

#[test]
fn nothing_is_wrong_in_any_frame_of_a_flight_on_any_surface() {
    for ((name, surface), pairs) in surfaces::all().into_iter().zip(Pairs::ALL.into_iter().cycle()) {
        let (most, _) = fly(
            name,
            &surface,
            Settings {
                pairs,
                ..settings(EDGE)
            },
        );
        println!("{name}: at most {most} leaves, pairs {}", pairs.name());
        assert!(most > 100, "{name}: {most} leaves");
    }
}

#[test]
fn a_full_buffer_stays_complete_and_free_of_cracks_and_says_so() {
    for (name, surface) in surfaces::all() {
        let roots = surface.topology().half_edge_count();
        for capacity in [roots, roots + 5, 200] {
            let (most, starved) = fly(
                name,
                &surface,
                Settings {
                    capacity,
                    pairs: Pairs::Wished,
                    ..settings(EDGE)
                },
            );
            assert!(
                most <= capacity && starved > 0,
                "{name}, capacity {capacity}: {most} leaves, {starved} starved"
            );
        }
    }
}

#[test]
fn nothing_is_wrong_with_four_passes_a_frame_nor_on_any_base_grid() {
    let all = surfaces::all();
    for (k, (name, surface)) in [(0, &all[2]), (1, &all[3]), (2, &all[6]), (3, &all[4])] {
        for settle in [1, 4] {
            fly(
                name,
                surface,
                Settings {
                    settle,
                    base_grid: k,
                    max_level: 31 - k,
                    ..settings(keyleaf::Metric::Edge { pixels: 12.0 })
                },
            );
        }
    }
}

#[test]
fn nothing_is_wrong_without_guard_band_or_culling_or_with_a_target_of_leaves() {
    let all = surfaces::all();
    for (name, surface) in [&all[2], &all[6]] {
        fly(
            name,
            surface,
            Settings {
                guard_factor: 1.0,
                ..settings(EDGE)
            },
        );
        fly(
            name,
            surface,
            Settings {
                cull: false,
                ..settings(EDGE)
            },
        );
        fly(
            name,
            surface,
            Settings {
                target_leaves: 900,
                ..settings(EDGE)
            },
        );
        fly(
            name,
            surface,
            Settings {
                target_leaves: 900,
                capacity: 700,
                settle: 3,
                ..settings(EDGE)
            },
        );
    }
}

#[test]
fn without_culling_every_drawn_leaf_is_listed() {
    for (name, surface) in surfaces::all() {
        let mut world = World::new(
            &surface,
            Settings {
                cull: false,
                ..settings(EDGE)
            },
        );
        let (_, view) = flight(surface.as_ref()).swap_remove(6);
        let snapshot = world.passes(&view, 12);
        let mut listed = snapshot.visible.clone();
        listed.sort_unstable();
        assert_eq!(listed, crate::snapshot::drawn_slots(&snapshot), "{name}");
    }
}

#[test]
fn the_table_is_rebuilt_now_and_then_and_stays_exact() {
    let surface = surfaces::flat(&crate::meshes::cube());
    let mut world = World::new(
        &surface,
        Settings {
            capacity: 200,
            ..settings(EDGE)
        },
    );
    let mut rebuilds = 0;
    for round in 0..5 {
        for (what, view) in flight(surface.as_ref()) {
            let snapshot = world.pass(&view);
            assert_eq!(findings(surface.topology(), &snapshot), [], "round {round}, {what}");
            rebuilds = snapshot.control.rebuilds;
        }
    }
    assert!(rebuilds >= 2, "{rebuilds} rebuilds");
}
