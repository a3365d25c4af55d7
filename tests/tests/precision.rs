//! Planet scale: two metres above the ground of a map of ten thousand kilometres, f32 is as good as f64 on the screen.

use crate::random::Random;
use crate::surfaces::hills;
use crate::world::{EDGE, World, settings};
use glam::{DAffine3, DVec2, DVec3, UVec2};
use keyleaf::key::{ONE, RootPoint};
use keyleaf::surface::{HeightField, HeightFieldSettings, Interpolation, Surface, Terrain, TerrainSettings};
use keyleaf::{Frame, Settings, View};
use std::sync::Arc;

const EXTENT: f64 = 1e7;
const ALTITUDES: [f64; 5] = [2.0, 20.0, 100.0, 1000.0, 1e5];
/// What nobody sees, in pixels.
const UNSEEN: f64 = 0.05;

fn terrain() -> Arc<dyn Surface> {
    Arc::new(
        Terrain::new(TerrainSettings {
            extent: EXTENT,
            ..TerrainSettings::default()
        })
        .expect("a terrain"),
    )
}

fn height_field() -> Arc<dyn Surface> {
    let extent = DVec2::splat(EXTENT);
    let settings = HeightFieldSettings {
        extent,
        scale: 10.0,
        offset: 0.0,
        interpolation: Interpolation::Bicubic,
    };
    Arc::new(HeightField::new(hills(129, 129), settings).expect("a field"))
}

/// Somewhere on the map, at least a tenth of it away from spokes and edges.
fn somewhere(random: &mut Random, root: u32) -> RootPoint {
    RootPoint {
        face: 0,
        root,
        x: ONE / 10 + random.below(ONE / 4),
        y: ONE / 10 + random.below(ONE / 4),
    }
}

/// A point within `reach` metres.
fn about(at: RootPoint, reach: f64, random: &mut Random) -> RootPoint {
    // A step of a root's coordinate is 2^-32 of the extent.
    let steps = (reach / EXTENT * 2f64.powi(32)).max(1.0);
    let moved = |x: u32, by: f64| (f64::from(x) + by).clamp(0.0, f64::from(ONE) / 2.0 - 1.0) as u32;
    RootPoint {
        x: moved(at.x, random.between(-steps, steps)),
        y: moved(at.y, random.between(-steps, steps)),
        ..at
    }
}

/// A full-HD view from above a point, with points of the ground that are in it: their exact place relative to the eye, and the GPU's.
struct Sight {
    view: View,
    points: Vec<(RootPoint, DVec3, DVec3)>,
}

impl Sight {
    fn new(surface: &Arc<dyn Surface>, at: RootPoint, altitude: f64, seed: u64) -> Self {
        let eye = surface.point(at) + DVec3::Y * altitude;
        let view = View::look_at(eye, eye + DVec3::new(0.8, -0.3, 0.6), 1.0, 0.1, UVec2::new(1920, 1080));
        let mut random = Random(seed);
        let mut points: Vec<RootPoint> = (0..400)
            .map(|i| about(at, altitude * 2f64.powi(i % 12), &mut random))
            .collect();
        points.retain(|at| is_inside(&view, surface.point(*at) - eye));
        assert!(points.len() > 10, "{} points in view", points.len());
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
        let found = world
            .evaluate(&points)
            .into_iter()
            .map(|gpu| (gpu.position - frame.eye).as_dvec3());
        let points = points
            .iter()
            .zip(found)
            .map(|(at, found)| (*at, surface.point(*at) - eye, found))
            .collect();
        Self { view, points }
    }

    /// The largest distance on the screen between places, in pixels.
    fn worst(&self, places: impl Fn(&(RootPoint, DVec3, DVec3)) -> (DVec3, DVec3)) -> f64 {
        let on_screen = |place: DVec3| {
            let seen = self.view.orientation.inverse() * place;
            seen.truncate() / seen.z * self.view.pixels_per_unit()
        };
        self.points
            .iter()
            .map(places)
            .map(|(a, b)| on_screen(a).distance(on_screen(b)))
            .fold(0.0, f64::max)
    }
}

fn is_inside(view: &View, from_eye: DVec3) -> bool {
    let seen = view.orientation.inverse() * from_eye;
    let half = 0.5f64.tan() * -seen.z;
    -seen.z > 0.1 && seen.y.abs() < half && seen.x.abs() < half * view.aspect()
}

#[test]
fn a_height_field_of_a_planet_is_drawn_within_a_twentieth_of_a_pixel() {
    let surface = height_field();
    let mut random = Random(8);
    for root in 0..4 {
        let at = somewhere(&mut random, root);
        for altitude in ALTITUDES {
            let worst = Sight::new(&surface, at, altitude, 3).worst(|(_, exact, found)| (*exact, *found));
            assert!(
                worst <= UNSEEN,
                "root {root}, {altitude} m above the ground: {worst} pixels"
            );
        }
    }
}

#[test]
fn a_terrain_of_a_planet_is_placed_within_a_twentieth_of_a_pixel() {
    // Heights are those of the f32 noise here: see the next two tests.
    let surface = terrain();
    let mut random = Random(8);
    for root in 0..4 {
        let at = somewhere(&mut random, root);
        for altitude in ALTITUDES {
            let sight = Sight::new(&surface, at, altitude, 3);
            let worst = sight.worst(|(_, exact, found)| (*exact, DVec3::new(found.x, exact.y, found.z)));
            assert!(
                worst <= UNSEEN,
                "root {root}, {altitude} m above the ground: {worst} pixels"
            );
        }
    }
}

#[test]
fn heights_of_a_planets_terrain_are_right_to_a_millionth_of_their_range() {
    let surface = terrain();
    let range = 2.0 * TerrainSettings::default().height;
    let mut random = Random(9);
    for root in 0..4 {
        let sight = Sight::new(&surface, somewhere(&mut random, root), 2.0, 3);
        let worst = sight
            .points
            .iter()
            .map(|(_, exact, found)| (exact.y - found.y).abs())
            .fold(0.0, f64::max);
        println!("root {root}: {:.1} mm", worst * 1e3);
        assert!(worst <= 1e-6 * range, "root {root}: {worst} m");
    }
}

#[test]
fn the_ground_does_not_swim_when_the_origin_moves() {
    let surface = terrain();
    let mut world = World::new(
        &surface,
        Settings {
            capacity: 2000,
            ..settings(EDGE)
        },
    );
    let mut random = Random(10);
    for root in 0..4 {
        let start = surface.point(somewhere(&mut random, root));
        let from = |x: f64, height: f64| {
            let eye = DVec3::new(x, height, start.z);
            View::look_at(eye, eye + DVec3::new(0.8, -0.3, 0.6), 1.0, 0.1, UVec2::new(1920, 1080))
        };
        // The two sides of a place where the origin jumps.
        let mut origin_at = |x: f64| {
            world.frame(&from(x, start.y));
            world.quadtree.origin().x
        };
        let (before, mut low, mut high) = (origin_at(start.x), start.x, start.x + 4096.0);
        assert_ne!(origin_at(high), before);
        while high - low > 1e-6 {
            let middle = (low + high) / 2.0;
            *if origin_at(middle) == before {
                &mut low
            } else {
                &mut high
            } = middle;
        }
        let at = surface
            .face_coord(0, low / EXTENT, -start.z / EXTENT)
            .expect("on the map");
        let eye_height = surface.point(at).y + 2.0;
        let view = from(low, eye_height);
        let mut points: Vec<RootPoint> = (0..400).map(|i| about(at, 2f64.powi(1 + i % 8), &mut random)).collect();
        points.retain(|at| is_inside(&view, surface.point(*at) - view.eye));
        let mut drawn = [low, high].map(|x| {
            world.frame(&from(x, eye_height));
            let shift = world.quadtree.origin() - view.eye;
            world
                .evaluate(&points)
                .into_iter()
                .map(move |gpu| gpu.position.as_dvec3() + shift)
                .collect::<Vec<_>>()
        });
        let [here, there] = drawn.each_mut();
        let sight = Sight {
            view,
            points: points
                .iter()
                .zip(here)
                .zip(there)
                .map(|((at, a), b)| (*at, *a, *b))
                .collect(),
        };
        let worst = sight.worst(|(_, here, there)| (*here, *there));
        println!("root {root}: {} points move by up to {worst:.4} pixels", points.len());
        assert!(points.len() > 10 && worst <= UNSEEN, "root {root}: {worst} pixels");
    }
}
