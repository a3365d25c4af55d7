//! The triangles that are drawn, read back with the address of every vertex, and how far they are from the exact surface.

use crate::check::grid_point;
use glam::DVec3;
use keyleaf::headless::Headless;
use keyleaf::inspect::Inspector;
use keyleaf::{BaseGrid, KeyleafError, Quadtree};
use keyleaf_key::RootPoint;
use keyleaf_surface::Surface;
use rayon::prelude::*;

/// A vertex as the GPU draws it, in object space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnVertex {
    /// Where it is on the surface.
    pub at: RootPoint,
    /// Its position.
    pub position: DVec3,
    /// Its unit normal.
    pub normal: DVec3,
}

/// What is drawn of one surface. Leaves do not share vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawn {
    /// Vertices, leaf by leaf.
    pub vertices: Vec<DrawnVertex>,
    /// Counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
}

/// Leaves that are evaluated at a time.
const PIECE: usize = 4096;

/// Reads the visible leaves of a quadtree back, and evaluates their vertices by the shader that draws them. Waits for the device.
///
/// # Errors
/// [`KeyleafError::ReadBack`] if the device is lost.
pub fn drawn(gpu: &Headless, quadtree: &Quadtree) -> Result<Drawn, KeyleafError> {
    let kind = Quadtree::kind(quadtree.surface().as_ref(), quadtree.settings());
    let inspector = Inspector::new(&gpu.device, &kind)?;
    let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
    let mut slots = snapshot.visible.clone();
    slots.sort_by_key(|&slot| snapshot.leaves[slot as usize].place());
    let k = quadtree.settings().base_grid;
    let grid = BaseGrid::of(quadtree.settings());
    let mut drawn = Drawn::default();
    for piece in slots.chunks(PIECE) {
        let emitted = inspector.emit(&gpu.device, &gpu.queue, quadtree, piece)?;
        let vertices = emitted.positions.iter().zip(&emitted.normals);
        let mut vertices = vertices.map(|(p, n)| {
            let [position, normal] = [p, n].map(|v| DVec3::from(v.map(f64::from)));
            (position + quadtree.origin(), normal)
        });
        for &slot in piece {
            let (place, is_pair) = (snapshot.leaves[slot as usize].place(), snapshot.is_pair(slot as usize));
            let first = drawn.vertices.len() as u32;
            let of_leaf = grid.vertices.iter().zip(&mut vertices);
            drawn
                .vertices
                .extend(of_leaf.map(|(v, (position, normal))| DrawnVertex {
                    at: grid_point(place, is_pair, [v & 0xffff, v >> 16], k),
                    position,
                    normal,
                }));
            let triangles = grid.indices.as_chunks::<3>().0.iter();
            drawn
                .triangles
                .extend(triangles.map(|t| t.map(|v| first + u32::from(v))));
        }
    }
    Ok(drawn)
}

/// How far a vertex is from the exact surface.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Difference {
    /// Distance to the surface's point at the same parameters, object units.
    pub distance: f64,
    /// Angle between the normals, radians.
    pub angle: f64,
}

/// The largest and the root mean square of some differences.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Deviations {
    /// The largest.
    pub largest: f64,
    /// Root of the mean of the squares.
    pub rms: f64,
}

impl Deviations {
    /// Of these values; zeros if there are none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let (mut largest, mut squares, mut count) = (0.0f64, 0.0, 0.0);
        for value in values {
            largest = largest.max(value);
            squares += value * value;
            count += 1.0;
        }
        Self {
            largest,
            rms: (squares / f64::max(count, 1.0)).sqrt(),
        }
    }

    /// In another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            largest: self.largest * factor,
            rms: self.rms * factor,
        }
    }
}

/// The difference between a frame of the GPU and the exact one.
pub fn difference(surface: &dyn Surface, at: RootPoint, position: DVec3, normal: DVec3) -> Difference {
    let exact = surface.frame(at);
    Difference {
        distance: position.distance(exact.position),
        // Of directions that are nearly the same, the sine tells more digits than the cosine.
        angle: normal.cross(exact.normal).length().atan2(normal.dot(exact.normal)),
    }
}

/// The difference of every vertex from the exact surface in f64. O(vertices), each an exact evaluation.
pub fn differences(drawn: &Drawn, surface: &dyn Surface) -> Vec<Difference> {
    let of = |v: &DrawnVertex| difference(surface, v.at, v.position, v.normal);
    drawn.vertices.par_iter().map(of).collect()
}
