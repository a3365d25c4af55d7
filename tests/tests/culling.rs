//! Culling never loses what is seen: every leaf with a surface point inside the view, by the f64 surface, is in the visible list.

use crate::random::Random;
use crate::surfaces;
use crate::world::{World, random_view, settings, size_of_box};
use glam::{DAffine3, DQuat, DVec3};
use keyleaf::key::RootPoint;
use keyleaf::surface::Surface;
use keyleaf::{Metric, Pairs, Projection, Settings, View};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Whether a world point projects inside the viewport, in front of the near plane.
fn is_seen(view: &View, point: DVec3) -> bool {
    let p = view.orientation.inverse() * (point - view.eye);
    match view.projection {
        Projection::Perspective { fov_y, near } => {
            let y = -p.z * (fov_y / 2.0).tan();
            -p.z > near && p.y.abs() < y && p.x.abs() < y * view.aspect()
        }
        Projection::Orthographic { height, near, far } => {
            let y = height / 2.0;
            (near..far).contains(&-p.z) && p.y.abs() < y && p.x.abs() < y * view.aspect()
        }
    }
}

/// Points of the drawn triangle of a leaf or pair: its corners, and some inside.
fn samples([a, b, c]: [RootPoint; 3], random: &mut Random) -> Vec<RootPoint> {
    let mut points = vec![a, b, c];
    for _ in 0..8 {
        let (s, t) = (random.unit(), random.unit());
        let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        let mix = |a: u32, b: u32, c: u32| {
            let [a, b, c] = [a, b, c].map(f64::from);
            (a + s * (b - a) + t * (c - a)) as u32
        };
        points.push(RootPoint {
            x: mix(a.x, b.x, c.x),
            y: mix(a.y, b.y, c.y),
            ..a
        });
    }
    points
}

fn check(name: &str, surface: &Arc<dyn Surface>, transform: DAffine3, views: usize, tally: &mut (usize, usize)) {
    let mut world = World::placed(
        surface,
        transform,
        Settings {
            capacity: 4000,
            pairs: Pairs::Wished, // those that must be come with them
            ..settings(Metric::Edge { pixels: 30.0 })
        },
    );
    let mut random = Random(17);
    for i in 0..views {
        let mut view = random_view(&mut random, surface.as_ref());
        if i % 4 == 3 {
            let size = size_of_box(surface.bounding_box());
            view.projection = Projection::Orthographic {
                height: size * 0.2,
                near: 0.0,
                far: size,
            };
        }
        view.eye = transform.transform_point3(view.eye);
        let snapshot = world.passes(&view, 10);
        let visible: BTreeSet<u32> = snapshot.visible.iter().copied().collect();
        for slot in crate::snapshot::drawn_slots(&snapshot) {
            let (place, is_pair) = (snapshot.leaves[slot as usize].place(), snapshot.is_pair(slot as usize));
            tally.0 += 1;
            if visible.contains(&slot) {
                continue;
            }
            tally.1 += 1;
            let triangle = place.drawn(is_pair).expect("a drawn slot");
            let seen = samples(triangle, &mut random)
                .into_iter()
                .find(|at| is_seen(&view, transform.transform_point3(surface.point(*at))));
            assert_eq!(seen, None, "{name}, view {i}: {place:?}, pair: {is_pair}, is culled");
        }
    }
}

#[test]
fn no_leaf_with_a_point_inside_the_view_is_culled() {
    let placed = DAffine3::from_scale_rotation_translation(
        DVec3::new(2.0, 0.5, 1.0),
        DQuat::from_rotation_x(0.6),
        DVec3::new(5.0, 1.0, -2.0),
    );
    let mut tally = (0, 0);
    for (name, surface) in surfaces::all() {
        check(name, &surface, DAffine3::IDENTITY, 10, &mut tally);
        check(name, &surface, placed, 4, &mut tally);
    }
    println!("{} leaves, {} culled", tally.0, tally.1);
    assert!(tally.1 * 5 > tally.0, "culling should cull something: {tally:?}");
    assert!(tally.1 < tally.0, "and leave something");
}

#[test]
fn what_is_behind_the_camera_is_culled() {
    for (name, surface) in surfaces::all() {
        let (low, high) = surface.bounding_box();
        let size = size_of_box((low, high));
        let eye = high + DVec3::splat(3.0 * size);
        let view = View::look_at(
            eye,
            eye + DVec3::splat(size),
            1.0,
            0.01 * size,
            glam::UVec2::new(300, 200),
        );
        let snapshot = World::new(&surface, settings(Metric::Edge { pixels: 30.0 })).passes(&view, 3);
        assert_eq!(snapshot.visible, [] as [u32; 0], "{name}");
    }
}
