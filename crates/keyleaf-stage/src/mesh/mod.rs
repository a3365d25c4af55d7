//! The very triangles that a stage draws, as a mesh.
//!
//! Vertices that are the same point of a surface become one, so that a closed surface gives a closed mesh.

mod collapse;

use crate::Stage;
use crate::check::{Welder, grid_point};
use collapse::collapse;
use glam::{DAffine3, DMat3, DVec3};
use keyleaf::headless::Headless;
use keyleaf::inspect::{Emitted, Inspector};
use keyleaf::read_back::Snapshot;
use keyleaf::{BaseGrid, KeyleafError, Quadtree};
use keyleaf_scene::{ExportError, ExportMesh, write_mesh};
use std::path::Path;

/// Which leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Those that are drawn.
    Seen,
    /// All, in view or not.
    Whole,
}

/// Why there is no mesh.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// More vertices than indices can number.
    #[error("{0} vertices are more than a model can hold: expected fewer leaves")]
    TooMany(u64),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] KeyleafError),
    /// The file was not written.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// Triangles in world space.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Of the vertices.
    pub positions: Vec<[f32; 3]>,
    /// Sums of unit normals of the vertices, not of unit length.
    pub normals: Vec<DVec3>,
    /// Vertices of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Leaves that they belong to.
    pub leaves: usize,
}

/// Leaves whose vertices are asked for at once.
const PIECE: usize = 1 << 15;

impl Mesh {
    /// Evaluates the triangles; `progress(done, all)` is told how many leaves. Waits for the device.
    ///
    /// # Errors
    /// [`MeshError`]: too many vertices, or the device is lost.
    pub fn of(
        gpu: &Headless,
        stage: &Stage,
        extent: Extent,
        mut progress: impl FnMut(u64, u64),
    ) -> Result<Self, MeshError> {
        let mut mesh = Self::default();
        for object in &stage.objects {
            mesh.add(gpu, &object.quadtree, extent, &mut progress)?;
        }
        collapse(&mut mesh.positions, &mut mesh.normals, &mut mesh.triangles);
        Ok(mesh)
    }

    /// Writes the triangles; the ending of the name says how: .obj, .ply or .stl.
    ///
    /// # Errors
    /// [`MeshError::Export`].
    pub fn write(&self, file: &Path, with_normals: bool) -> Result<(), MeshError> {
        let unit = |n: &DVec3| n.try_normalize().unwrap_or(DVec3::Y).as_vec3().to_array();
        let normals: Vec<[f32; 3]> = self.normals.iter().map(unit).collect();
        let mesh = ExportMesh {
            positions: &self.positions,
            normals: with_normals.then_some(&normals),
            triangles: &self.triangles,
        };
        Ok(write_mesh(file, &mesh)?)
    }

    fn add(
        &mut self,
        gpu: &Headless,
        quadtree: &Quadtree,
        extent: Extent,
        progress: &mut impl FnMut(u64, u64),
    ) -> Result<(), MeshError> {
        let kind = Quadtree::kind(quadtree.surface().as_ref(), quadtree.settings());
        let inspector = Inspector::new(&gpu.device, &kind)?;
        let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
        let slots = slots(&snapshot, extent);
        let grid = BaseGrid::of(quadtree.settings());
        let first = self.positions.len();
        let points = slots.len() as u64 * grid.vertices.len() as u64 + first as u64;
        if u32::try_from(points).is_err() {
            return Err(MeshError::TooMany(points));
        }
        let mut part = Part {
            quadtree,
            grid: &grid,
            placed: Placed::new(quadtree),
            welder: Welder::with_capacity(slots.len() * grid.vertices.len() / 2),
            first,
        };
        let mut done = 0;
        for piece in slots.chunks(PIECE) {
            let emitted = inspector.emit(&gpu.device, &gpu.queue, quadtree, piece)?;
            for (i, &slot) in piece.iter().enumerate() {
                part.add_leaf(self, &snapshot, slot as usize, &emitted, i);
            }
            done += piece.len() as u64;
            progress(done, slots.len() as u64);
        }
        self.leaves += slots.len();
        Ok(())
    }
}

/// The slots of the leaves, in an order that does not depend on the device's scheduling.
fn slots(snapshot: &Snapshot, extent: Extent) -> Vec<u32> {
    let place = |slot: u32| snapshot.leaves[slot as usize].place();
    let mut slots: Vec<u32> = match extent {
        Extent::Seen => snapshot.visible.clone(),
        Extent::Whole => {
            let odd = |slot: u32| place(slot).is_odd_half();
            (0..snapshot.leaves.len() as u32)
                .filter(|&slot| !(odd(slot) && snapshot.is_pair(slot as usize)))
                .collect()
        }
    };
    slots.sort_by_key(|&slot| place(slot));
    slots
}

/// One surface on its way into a mesh.
struct Part<'a> {
    quadtree: &'a Quadtree,
    grid: &'a BaseGrid,
    placed: Placed,
    welder: Welder,
    /// Vertices of the surfaces before.
    first: usize,
}

impl Part<'_> {
    /// Adds leaf `i` of those that were emitted, which is in a slot.
    fn add_leaf(&mut self, mesh: &mut Mesh, snapshot: &Snapshot, slot: usize, emitted: &Emitted, i: usize) {
        let topology = self.quadtree.surface().topology();
        let k = self.quadtree.settings().base_grid;
        let (place, is_pair) = (snapshot.leaves[slot].place(), snapshot.is_pair(slot));
        let vertices = self.grid.vertices.iter().enumerate();
        let indices: Vec<u32> = vertices
            .map(|(j, v)| {
                let at = i * self.grid.vertices.len() + j;
                let point = grid_point(place, is_pair, [v & 0xffff, v >> 16], k);
                let (number, is_new) = self.welder.index(topology, point);
                if is_new {
                    mesh.positions.push(self.placed.position(emitted.positions[at]));
                    mesh.normals.push(DVec3::ZERO);
                }
                let index = self.first + number as usize;
                mesh.normals[index] += self.placed.normal(emitted.normals[at]);
                index as u32
            })
            .collect();
        let triangles = self.grid.indices.as_chunks::<3>().0.iter();
        let corners = triangles.map(|t| t.map(|v| indices[usize::from(v)]));
        // An object that is mirrored keeps its outside.
        let is_mirrored = self.placed.is_mirrored;
        mesh.triangles
            .extend(corners.map(|[a, b, c]| if is_mirrored { [a, c, b] } else { [a, b, c] }));
    }
}

/// From emitted vertices to the world: a function of their bits alone, so that equal points stay equal.
struct Placed {
    origin: DVec3,
    world_from_object: DAffine3,
    normals: DMat3,
    is_mirrored: bool,
}

impl Placed {
    fn new(quadtree: &Quadtree) -> Self {
        let linear = quadtree.world_from_object().matrix3;
        let is_mirrored = linear.determinant() < 0.0;
        Self {
            origin: quadtree.origin(),
            world_from_object: *quadtree.world_from_object(),
            normals: linear.inverse().transpose() * if is_mirrored { -1.0 } else { 1.0 },
            is_mirrored,
        }
    }

    fn position(&self, p: [f32; 3]) -> [f32; 3] {
        let object = DVec3::from(p.map(f64::from)) + self.origin;
        // Adding zero turns -0 into +0.
        self.world_from_object
            .transform_point3(object)
            .as_vec3()
            .to_array()
            .map(|c| c + 0.0)
    }

    fn normal(&self, n: [f32; 3]) -> DVec3 {
        (self.normals * DVec3::from(n.map(f64::from))).normalize_or_zero()
    }
}
