//! One surface with its quadtree on the device of the tests.

use crate::gpu::{gpu, inspector, passes};
use crate::random::Random;
use glam::{DAffine3, DVec3, UVec2};
use keyleaf::inspect::{Emitted, GpuFrame};
use keyleaf::key::{Place, RootPoint};
use keyleaf::read_back::Snapshot;
use keyleaf::surface::Surface;
use keyleaf::{Frame, Metric, Quadtree, Settings, View};
use std::collections::BTreeSet;
use std::sync::Arc;

pub const EDGE: Metric = Metric::Edge { pixels: 40.0 };

/// Settings for small tests: every leaf a triangle, one pass a frame.
pub fn settings(metric: Metric) -> Settings {
    Settings {
        metric,
        base_grid: 0,
        capacity: 20_000,
        max_level: 31,
        ..Settings::default()
    }
}

pub struct World {
    pub surface: Arc<dyn Surface>,
    pub quadtree: Quadtree,
}

impl World {
    pub fn new(surface: &Arc<dyn Surface>, settings: Settings) -> Self {
        Self::placed(surface, DAffine3::IDENTITY, settings)
    }

    pub fn placed(surface: &Arc<dyn Surface>, world_from_object: DAffine3, settings: Settings) -> Self {
        let passes = passes(Quadtree::kind(surface.as_ref(), &settings));
        let (device, queue) = (&gpu().device, &gpu().queue);
        let quadtree = Quadtree::new(device, queue, passes, Arc::clone(surface), world_from_object, settings);
        Self {
            surface: Arc::clone(surface),
            quadtree: quadtree.expect("the settings are in range"),
        }
    }

    /// Starts again from these leaves.
    pub fn set_leaves(&mut self, leaves: &[Place]) {
        self.quadtree
            .set_leaves(&gpu().queue, leaves)
            .expect("the leaves cover the roots");
    }

    /// One frame.
    pub fn frame(&mut self, view: &View) {
        let mut encoder = gpu().device.create_command_encoder(&Default::default());
        self.quadtree.update(&gpu().queue, &mut encoder, view);
        gpu().queue.submit([encoder.finish()]);
    }

    pub fn snapshot(&self) -> Snapshot {
        self.quadtree
            .read_back(&gpu().device, &gpu().queue)
            .expect("the device works")
    }

    /// One frame, and what it left.
    pub fn pass(&mut self, view: &View) -> Snapshot {
        self.frame(view);
        self.snapshot()
    }

    /// So many frames, and what the last one left.
    pub fn passes(&mut self, view: &View, count: u32) -> Snapshot {
        (1..count).for_each(|_| self.frame(view));
        self.pass(view)
    }

    pub fn emit(&self, slots: &[u32]) -> Emitted {
        let kind = Quadtree::kind(self.surface.as_ref(), self.quadtree.settings());
        inspector(kind)
            .emit(&gpu().device, &gpu().queue, &self.quadtree, slots)
            .expect("the device works")
    }

    pub fn evaluate(&self, points: &[RootPoint]) -> Vec<GpuFrame> {
        let kind = Quadtree::kind(self.surface.as_ref(), self.quadtree.settings());
        inspector(kind)
            .evaluate(&gpu().device, &gpu().queue, &self.quadtree, points)
            .expect("the device works")
    }

    /// The metric over the threshold of a node in f64, with the scale and planes that the GPU got. Twin of `wish` in `update.wgsl`.
    pub fn wish(&self, view: &View, node: &Place) -> f64 {
        let settings = self.quadtree.settings();
        if node.level >= settings.max_level.min(31 - settings.base_grid) {
            return 0.0;
        }
        self.wish_of_size(
            view,
            node,
            settings.metric.size(settings.base_grid).of(self.surface.as_ref(), node),
        )
    }

    /// The same for a size that the metric did not give.
    pub fn wish_of_size(&self, view: &View, node: &Place, size: f64) -> f64 {
        let settings = self.quadtree.settings();
        let to_world = self.quadtree.world_from_object();
        let frame = Frame::new(view, to_world, DVec3::ZERO, settings);
        let bound = self.surface.bound(node);
        let centre = bound.centre - to_world.inverse().transform_point3(view.eye);
        let distance = if frame.without_distance == 1 {
            1.0
        } else {
            (to_world.matrix3 * centre).length().max(frame.near.into())
        };
        let is_outside = frame.planes[6..].iter().any(|plane| {
            let plane = plane.as_dvec4();
            plane.truncate().dot(centre) + plane.w < -bound.guard
        });
        let factor = if is_outside { f64::from(frame.guard_factor) } else { 1.0 };
        size * f64::from(frame.wish_scale) / distance * factor
    }
}

/// The places of the leaves.
pub fn places(snapshot: &Snapshot) -> BTreeSet<Place> {
    snapshot.leaves.iter().map(|leaf| leaf.place()).collect()
}

/// All nodes of a level.
pub fn uniform(surface: &dyn Surface, level: u32) -> Vec<Place> {
    let mut nodes: Vec<Place> = surface.topology().roots().collect();
    for _ in 0..level {
        nodes = nodes.into_iter().flat_map(Place::children).collect();
    }
    nodes
}

pub fn size_of_box((low, high): (DVec3, DVec3)) -> f64 {
    (high - low).length()
}

/// A camera somewhere about a surface, near or far, that looks at some point of its box.
pub fn random_view(random: &mut Random, surface: &dyn Surface) -> View {
    let (low, high) = surface.bounding_box();
    let size = size_of_box((low, high));
    let room = size * random.pick(&[0.02, 0.2, 1.0]);
    let eye = random.point((low - room, high + room));
    let target = random.point((low, high));
    View::look_at(eye, target, random.between(0.3, 1.8), 1e-4 * size, UVec2::new(320, 200))
}
