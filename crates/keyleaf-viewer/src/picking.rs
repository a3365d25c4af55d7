//! What lies under the pointer: the ray against the very triangles that are drawn.

use crate::document::Document;
use crate::projection::Screen;
use egui::Pos2;
use glam::DVec3;
use keyleaf::headless::Headless;
use keyleaf::inspect::{Emitted, Inspector};
use keyleaf::layout::state;
use keyleaf::read_back::Snapshot;
use keyleaf::{BaseGrid, Kind, Metric, Quadtree};
use keyleaf_key::{Place, Topology, neighbour};
use std::collections::{HashMap, HashSet};

/// A leaf that was picked.
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// The surface's name.
    pub surface: String,
    /// The leaf.
    pub place: Place,
    /// Whether it is drawn together with its other half.
    pub is_pair: bool,
    /// Metric over threshold, as published.
    pub wish: f32,
    /// The metric, with its threshold and unit.
    pub metric: String,
    /// The point of the surface, world space.
    pub position: DVec3,
    /// Its distance from the eye in metres.
    pub distance: f64,
    /// What lies across each side: (side, leaf).
    pub neighbours: Vec<(&'static str, String)>,
    /// The rim of the drawn triangles, world space.
    pub outline: Vec<DVec3>,
}

impl Picked {
    /// The digits of the key, root first.
    pub fn digits(&self) -> String {
        let digits: String = self.place.key().digits().map(|d| char::from(b'0' + d as u8)).collect();
        if digits.is_empty() { "root".to_owned() } else { digits }
    }
}

/// Evaluators of the kinds of surfaces that were asked so far.
#[derive(Default)]
pub struct Picker {
    inspectors: HashMap<Kind, Inspector>,
}

/// A ray and where it has met something.
struct Hit {
    distance: f64,
    object: usize,
    slot: u32,
    outline: Vec<DVec3>,
}

/// Leaves whose vertices are asked for at once.
const PIECE: usize = 1 << 14;

impl Picker {
    /// The leaf that is drawn at a place of the window; `None` if there is only sky. Waits for the device.
    ///
    /// # Errors
    /// The device is lost, or does not compile the evaluator.
    pub fn pick(
        &mut self,
        gpu: &Headless,
        document: &Document,
        screen: &Screen,
        at: Pos2,
    ) -> anyhow::Result<Option<Picked>> {
        let (origin, direction) = screen.ray(at);
        let mut nearest: Option<Hit> = None;
        let mut snapshots = Vec::new();
        for (index, object) in document.stage.objects.iter().enumerate() {
            let quadtree = &object.quadtree;
            let kind = Quadtree::kind(quadtree.surface().as_ref(), quadtree.settings());
            let inspector = match self.inspectors.entry(kind) {
                std::collections::hash_map::Entry::Occupied(entry) => entry.into_mut(),
                std::collections::hash_map::Entry::Vacant(entry) => entry.insert(Inspector::new(&gpu.device, &kind)?),
            };
            let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
            let grid = BaseGrid::of(quadtree.settings());
            for slots in snapshot.visible.chunks(PIECE) {
                let emitted = inspector.emit(&gpu.device, &gpu.queue, quadtree, slots)?;
                let reach = nearest.as_ref().map_or(f64::INFINITY, |hit| hit.distance);
                let ray = Ray::new(quadtree, origin, direction, reach);
                if let Some((distance, leaf)) = ray.first_hit(&emitted, &grid) {
                    nearest = Some(Hit {
                        distance,
                        object: index,
                        slot: slots[leaf],
                        outline: outline(quadtree, &emitted, &grid, leaf),
                    });
                }
            }
            snapshots.push(snapshot);
        }
        Ok(nearest.map(|hit| {
            let position = origin + direction * hit.distance;
            describe(document, &snapshots[hit.object], hit, position)
        }))
    }
}

fn describe(document: &Document, snapshot: &Snapshot, hit: Hit, position: DVec3) -> Picked {
    let object = &document.stage.objects[hit.object];
    let slot = hit.slot as usize;
    let place = snapshot.leaves[slot].place();
    let wish = state::wish(snapshot.states[slot]);
    let leaves: HashSet<Place> = snapshot.leaves.iter().map(|leaf| leaf.place()).collect();
    let topology = object.quadtree.surface().topology();
    Picked {
        surface: object.name.clone(),
        place,
        is_pair: snapshot.is_pair(slot),
        wish,
        metric: metric(object.quadtree.settings().metric, wish),
        position,
        distance: hit.distance,
        neighbours: neighbours(topology, &leaves, place),
        outline: hit.outline,
    }
}

/// The metric of a leaf from its wish, with the threshold.
fn metric(metric: Metric, wish: f32) -> String {
    match metric {
        Metric::Edge { pixels } | Metric::Boundary { pixels, .. } | Metric::LocalArea { pixels } => {
            format!("{:.2} of {pixels} px an edge", wish * pixels)
        }
        Metric::Deviation { pixels } | Metric::LinearApproximation { pixels } => {
            format!("{:.3} of {pixels} px away", wish * pixels)
        }
        other => format!("{wish:.2} of the threshold ({})", other.name()),
    }
}

fn neighbours(topology: &Topology, leaves: &HashSet<Place>, place: Place) -> Vec<(&'static str, String)> {
    let across = [
        ("X leg", Some(neighbour::x(topology, place))),
        ("Y leg", Some(neighbour::y(topology, place))),
        ("hypotenuse", neighbour::h(topology, place)),
    ];
    let describe = |node: Option<Place>| {
        let Some(node) = node else {
            return "boundary".to_owned();
        };
        let face = if node.face == place.face {
            String::new()
        } else {
            format!(", face {}", node.face)
        };
        if leaves.contains(&node) {
            return format!("level {}{face}", node.level);
        }
        match node.ancestors().find(|ancestor| leaves.contains(ancestor)) {
            Some(leaf) => format!("level {}, coarser{face}", leaf.level),
            None => format!("level {} and finer{face}", node.level + 1),
        }
    };
    across.map(|(side, node)| (side, describe(node))).into()
}

/// A ray in the space of emitted vertices: object space, relative to the origin.
struct Ray {
    from: DVec3,
    along: DVec3,
    reach: f64,
}

impl Ray {
    fn new(quadtree: &Quadtree, origin: DVec3, direction: DVec3, reach: f64) -> Self {
        let object_from_world = quadtree.world_from_object().inverse();
        Self {
            from: object_from_world.transform_point3(origin) - quadtree.origin(),
            // Not of unit length: distances stay those of the world.
            along: object_from_world.transform_vector3(direction),
            reach,
        }
    }

    /// Distance and leaf of the nearest triangle.
    fn first_hit(&self, emitted: &Emitted, grid: &BaseGrid) -> Option<(f64, usize)> {
        let vertices = grid.vertices.len();
        let mut nearest = None;
        let mut reach = self.reach;
        for (leaf, positions) in emitted.positions.chunks_exact(vertices).enumerate() {
            for triangle in grid.indices.as_chunks::<3>().0 {
                let corners = triangle.map(|i| DVec3::from(positions[usize::from(i)].map(f64::from)));
                if let Some(distance) = self.triangle(corners).filter(|d| *d < reach) {
                    reach = distance;
                    nearest = Some((distance, leaf));
                }
            }
        }
        nearest
    }

    /// Möller and Trumbore 1997, both sides.
    fn triangle(&self, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let (ab, ac) = (b - a, c - a);
        let p = self.along.cross(ac);
        let determinant = ab.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let to = self.from - a;
        let u = to.dot(p) / determinant;
        let q = to.cross(ab);
        let v = self.along.dot(q) / determinant;
        let distance = ac.dot(q) / determinant;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
    }
}

/// The rim of a leaf's grid, closed.
fn outline(quadtree: &Quadtree, emitted: &Emitted, grid: &BaseGrid, leaf: usize) -> Vec<DVec3> {
    let n = 1u32 << quadtree.settings().base_grid;
    let first = leaf * grid.vertices.len();
    let at = |i: u32, j: u32| {
        let index = grid.vertices.iter().position(|v| *v == i | (j << 16)).unwrap_or(0);
        let p = DVec3::from(emitted.positions[first + index].map(f64::from)) + quadtree.origin();
        quadtree.world_from_object().transform_point3(p)
    };
    let legs = (0..n).map(|i| at(i, 0)).chain((0..n).map(|j| at(n - j, j)));
    legs.chain((0..=n).rev().map(|j| at(0, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_triangle_from_both_sides_and_not_beside_it() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let ray = |from: DVec3, along| Ray {
            from,
            along,
            reach: f64::INFINITY,
        };
        let from = DVec3::new(0.2, 0.3, 2.0);
        assert_eq!(ray(from, DVec3::NEG_Z).triangle(corners), Some(2.0));
        assert_eq!(
            ray(-from + 2.0 * from.truncate().extend(0.0), DVec3::Z).triangle(corners),
            Some(2.0)
        );
        assert_eq!(ray(from + DVec3::X, DVec3::NEG_Z).triangle(corners), None);
        assert_eq!(ray(from, DVec3::Z).triangle(corners), None);
    }
}
