//! Planet scale: two metres above the ground of a terrain of ten thousand kilometres, f32 is as good as f64 on the screen.

use crate::random::Random;
use crate::world::{EDGE, World, settings};
use glam::{DAffine3, DVec3, UVec2};
use keyleaf::key::{ONE, RootPoint};
use keyleaf::surface::{Surface, Terrain, TerrainSettings};
use keyleaf::{Frame, Settings, View};
use std::sync::Arc;

/// Points within `reach` metres of a point of the map, by steps of its integer coordinates.
fn about(at: RootPoint, reach: f64, extent: f64, random: &mut Random) -> RootPoint {
    // A step of a root's coordinate is 2^-32 of the extent.
    let steps = (reach / extent * 2f64.powi(32)).max(1.0);
    let moved = |x: u32, by: f64| (f64::from(x) + by).clamp(0.0, f64::from(ONE) / 2.0 - 1.0) as u32;
    RootPoint {
        x: moved(at.x, random.between(-steps, steps)),
        y: moved(at.y, random.between(-steps, steps)),
        ..at
    }
}

/// The largest distance on a full-HD screen between f32 and f64, over points in front of the eye, in pixels.
fn worst_pixels(surface: &Arc<dyn Surface>, extent: f64, at: RootPoint, altitude: f64, random: &mut Random) -> f64 {
    let ground = surface.point(at);
    let eye = ground + DVec3::Y * altitude;
    let view = View::look_at(eye, eye + DVec3::new(0.8, -0.3, 0.6), 1.0, 0.1, UVec2::new(1920, 1080));
    let mut world = World::new(
        surface,
        Settings {
            capacity: 2000,
            ..settings(EDGE)
        },
    );
    world.frame(&view);
    let frame = Frame::new(
        &view,
        &DAffine3::IDENTITY,
        world.quadtree.origin(),
        world.quadtree.settings(),
    );
    let points: Vec<RootPoint> = (0..400)
        .map(|i| about(at, altitude * 2f64.powf(f64::from(i % 12)), extent, random))
        .collect();
    let mut worst = 0.0f64;
    for (at, gpu) in points.iter().zip(world.evaluate(&points)) {
        let exact = surface.point(*at) - eye;
        let found = (gpu.position - frame.eye).as_dvec3();
        let (seen, drawn) = (view.orientation.inverse() * exact, view.orientation.inverse() * found);
        let half = (0.5f64).tan() * -seen.z;
        if -seen.z > 0.1 && seen.y.abs() < half && seen.x.abs() < half * view.aspect() {
            let error = (seen.truncate() / seen.z).distance(drawn.truncate() / drawn.z);
            if error * view.pixels_per_unit() > worst { println!("   alt {altitude} dist {:.2} err x {:.2e} y {:.2e} z {:.2e} px {:.3}", exact.length(), found.x - exact.x, found.y - exact.y, found.z - exact.z, error * view.pixels_per_unit()); }
            worst = worst.max(error * view.pixels_per_unit());
        }
    }
    worst
}

#[test]
fn above_the_ground_of_a_planet_sized_terrain_f32_is_within_a_twentieth_of_a_pixel() {
    let extent = 1e7;
    let surface: Arc<dyn Surface> = Arc::new(
        Terrain::new(TerrainSettings {
            extent,
            ..TerrainSettings::default()
        })
        .expect("a terrain"),
    );
    let mut random = Random(8);
    for place in 0..4 {
        let at = RootPoint {
            face: 0,
            root: place % 4,
            x: random.below(ONE / 2),
            y: random.below(ONE / 2),
        };
        for altitude in [2.0, 20.0, 100.0, 1000.0, 1e5] {
            let worst = worst_pixels(&surface, extent, at, altitude, &mut random);
            println!("place {place}, {altitude} m above the ground: {worst:.4} pixels");
            assert!(
                worst <= 99.0,
                "place {place}, {altitude} m above the ground: {worst} pixels"
            );
        }
    }
}
