//! Meshes moved along their smooth normals: P = B + h N. Twin of `shaders/shared/displaced.wgsl`.
//!
//! B is the flat mesh; N is the interpolated vertex normal, made one unit long; h is the displacement. A vertex normal is the
//! area-weighted mean of the normals of its faces, so that N, and with it P, is the same on both sides of a mesh edge.

use crate::direction::frame_normal;
use crate::mesh::{POSITION_ERROR, Polygons, unit_or_up, vector_entry};
use crate::stencil::{Jet, Operand, over_edges, root_speeds};
use crate::surface::HALF_LEVEL;
use crate::{MeshError, PolygonMesh, SurfaceBound, SurfaceFrame, diamond};
use glam::DVec3;
use keyleaf_key::{Place, RootPoint};

/// Where opposite normals nearly cancel, N is shorter than one instead of turning ever faster. As in the WGSL.
const SHORTEST_NORMAL: f64 = 0.0625;

/// A mesh with smooth normals.
#[derive(Clone, Debug)]
pub struct SmoothMesh {
    pub polygons: Polygons,
    /// Unit normals of the vertices.
    normals: Vec<DVec3>,
    /// Means of the corner normals of the faces, not of unit length: the interpolation is linear through them.
    centre_normals: Vec<DVec3>,
    /// Like [`Polygons::speeds`], of the unit normal.
    pub normal_speeds: Vec<f64>,
}

/// The displacement over the diamond of a leaf.
#[derive(Clone, Copy, Debug)]
pub struct DisplacementBound {
    /// Of |h|, anywhere.
    pub largest: f64,
    /// Of h against its value at the centre.
    pub variation: f64,
    /// Of the change of h over half of the diamond's diagonals.
    pub steepest: f64,
    /// The growth of the size by it, as the metric counts it.
    pub typical: f64,
    /// How far h may jump at a seam that the diamond touches.
    pub jump: f64,
}

impl SmoothMesh {
    pub fn new(mesh: &PolygonMesh) -> Result<Self, MeshError> {
        let polygons = Polygons::new(mesh)?;
        let topology = &polygons.topology;
        let mut normals: Vec<DVec3> = polygons.vertex_areas().into_iter().map(unit_or_up).collect();
        // Where the faces about a vertex cancel, one of them has to do.
        for (vertex, area) in polygons.vertex_areas().into_iter().enumerate() {
            if let (true, Some(owner)) = (area == DVec3::ZERO, topology.vertex_owner(vertex as u32)) {
                normals[vertex] = polygons.face_normals[owner.face as usize];
            }
        }
        let mean = |face| {
            let corners = topology.vertices(face);
            corners.iter().map(|&v| normals[v as usize]).sum::<DVec3>() / corners.len() as f64
        };
        let centre_normals = (0..topology.face_count()).map(mean).collect();
        let mut smooth = Self {
            polygons,
            normals,
            centre_normals,
            normal_speeds: Vec::new(),
        };
        smooth.normal_speeds = smooth.bound_normal_speeds();
        Ok(smooth)
    }

    /// |d(n / max(|n|, s))| <= |dn| / max(|n|, s), with |n| bounded from below over each face.
    fn bound_normal_speeds(&self) -> Vec<f64> {
        let topology = &self.polygons.topology;
        let shortest = |face: u32| {
            let direction = unit_or_up(self.centre_normals[face as usize]);
            let along = topology
                .vertices(face)
                .iter()
                .map(|&v| self.normals[v as usize].dot(direction));
            along.fold(f64::INFINITY, f64::min).max(SHORTEST_NORMAL)
        };
        let lengths: Vec<f64> = topology.roots().map(|root| 1.0 / shortest(root.face)).collect();
        let speeds = root_speeds(topology, |operand| self.normal(operand));
        speeds
            .iter()
            .zip(over_edges(topology, &lengths))
            .map(|(speed, length)| speed * length)
            .collect()
    }

    fn normal(&self, operand: Operand) -> DVec3 {
        match operand {
            Operand::Corner(half_edge) => self.normals[self.polygons.vertices[half_edge as usize] as usize],
            Operand::Centre(face) => self.centre_normals[face as usize],
        }
    }

    /// The point of the flat mesh.
    pub fn base(&self, at: RootPoint) -> DVec3 {
        Jet::of(&self.polygons.topology, at).value(|operand| self.polygons.position(operand))
    }

    /// The point displaced by h.
    pub fn point(&self, at: RootPoint, h: f64) -> DVec3 {
        let n = Jet::of(&self.polygons.topology, at).value(|operand| self.normal(operand));
        self.base(at) + n * (h / n.length().max(SHORTEST_NORMAL))
    }

    /// The frame at a point that is displaced by `h` and, seen from the face alone, has the displacement and derivatives `jet` of
    /// (weights, base, dB/du, dB/dv).
    pub fn frame(&self, at: RootPoint, h: f64, jet: impl Fn(&Jet, DVec3, DVec3, DVec3) -> [f64; 3]) -> SurfaceFrame {
        let weights = Jet::of(&self.polygons.topology, at);
        let base = weights.field(|operand| self.polygons.position(operand));
        let n = weights.field(|operand| self.normal(operand));
        let [height, height_u, height_v] = jet(&weights, base.value, base.du, base.dv);
        let length = n.value.length();
        let direction = n.value / length.max(SHORTEST_NORMAL);
        let turn = |dn: DVec3| {
            let along = if length > SHORTEST_NORMAL {
                direction.dot(dn)
            } else {
                0.0
            };
            (dn - direction * along) / length.max(SHORTEST_NORMAL)
        };
        let du = base.du + direction * height_u + turn(n.du) * height;
        let dv = base.dv + direction * height_v + turn(n.dv) * height;
        let mean = self.polygons.face_normals[at.face as usize];
        SurfaceFrame {
            position: self.point(at, h),
            du,
            dv,
            normal: frame_normal(du, dv, base.duv, mean),
        }
    }

    /// The bound about `centre`, the displaced [`diamond::centre`].
    pub fn bound(&self, leaf: &Place, centre: DVec3, h: DisplacementBound) -> SurfaceBound {
        let root = self.polygons.topology.half_edge_index(leaf.face, leaf.root) as usize;
        let smooth_speed = self.polygons.speeds[root] + h.largest * self.normal_speeds[root];
        let ball = smooth_speed * diamond::ball_scale(leaf.level);
        let size = smooth_speed * diamond::level_scale(leaf.level) + h.typical;
        SurfaceBound {
            centre,
            radius: ball + h.variation + h.jump,
            size,
            deviation: size,
            pair_deviation: HALF_LEVEL * size,
            guard: 2.0 * (ball + h.steepest) + h.jump,
        }
    }

    /// The box of the flat mesh, grown by the largest displacement.
    pub fn bounding_box(&self, largest: f64) -> (DVec3, DVec3) {
        let (low, high) = self.polygons.bounding_box();
        (low - largest, high + largest)
    }

    /// `surface_a`: positions, normals, then the normals of the faces.
    pub fn table(&self, origin: DVec3) -> Vec<f32> {
        let normals = self
            .normals
            .iter()
            .chain(&self.centre_normals)
            .flat_map(|&n| vector_entry(n));
        self.polygons
            .position_table(origin)
            .chain(normals)
            .chain(self.polygons.face_normal_table())
            .collect()
    }

    /// The rounding error of a position: that of its base and normal, and of a displacement that changes by `slope` a unit of
    /// length of the base.
    pub fn margin(&self, origin: DVec3, largest: f64, slope: f64) -> f64 {
        POSITION_ERROR * (self.polygons.largest(origin) * (1.0 + slope) + largest * (1.0 + 1.0 / SHORTEST_NORMAL))
    }
}
