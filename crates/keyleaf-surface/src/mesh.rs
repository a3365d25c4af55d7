//! Flat meshes. Twin of `shaders/surfaces/mesh.wgsl`.

use crate::direction::{frame_normal, round_up};
use crate::stencil::{FieldJet, Jet, Operand, over_edges, root_speeds};
use crate::surface::uniform;
use crate::{MeshError, PolygonMesh, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, diamond};
use encase::ShaderType;
use glam::DVec3;
use keyleaf_key::{Place, RootPoint, Topology};

/// 2⁻²⁴: half a unit in the last place of an f32 in 1..2.
pub const F32_ROUNDING: f64 = 1.0 / 16_777_216.0;

/// The rounding error of a weighted sum of f32 positions, in units of the largest coordinate.
pub const POSITION_ERROR: f64 = 16.0 * F32_ROUNDING;

/// Polygons with their centres and normals: what flat and displaced meshes are made of.
#[derive(Clone, Debug)]
pub struct Polygons {
    pub topology: Topology,
    positions: Vec<DVec3>,
    /// Start vertex of every half-edge.
    pub vertices: Vec<u32>,
    centres: Vec<DVec3>,
    pub face_normals: Vec<DVec3>,
    /// Bounds half the hypotenuse, the median and half the speed of a root; see [`root_speeds`].
    pub speeds: Vec<f64>,
}

impl Polygons {
    pub fn new(mesh: &PolygonMesh) -> Result<Self, MeshError> {
        let topology = mesh.topology()?;
        let faces = 0..topology.face_count();
        let vertices: Vec<u32> = faces
            .clone()
            .flat_map(|face| topology.vertices(face).iter().copied())
            .collect();
        let centre = |face| {
            let corners = topology.vertices(face);
            corners.iter().map(|&v| mesh.positions[v as usize]).sum::<DVec3>() / corners.len() as f64
        };
        let centres: Vec<DVec3> = faces.clone().map(centre).collect();
        let area = |face| area_vector(topology.vertices(face).iter().map(|&v| mesh.positions[v as usize]));
        let face_normals = faces.map(|face| unit_or_up(area(face))).collect();
        let mut polygons = Self {
            topology,
            positions: mesh.positions.clone(),
            vertices,
            centres,
            face_normals,
            speeds: Vec::new(),
        };
        polygons.speeds = root_speeds(&polygons.topology, |operand| polygons.position(operand));
        Ok(polygons)
    }

    pub fn position(&self, operand: Operand) -> DVec3 {
        match operand {
            Operand::Corner(half_edge) => self.positions[self.vertices[half_edge as usize] as usize],
            Operand::Centre(face) => self.centres[face as usize],
        }
    }

    /// Area vectors of the faces, twice the area long, summed over the faces about every vertex.
    pub fn vertex_areas(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for face in 0..self.topology.face_count() {
            let corners = self.topology.vertices(face);
            let area = area_vector(corners.iter().map(|&v| self.positions[v as usize]));
            corners.iter().for_each(|&v| sums[v as usize] += area);
        }
        sums
    }

    pub fn bounding_box(&self) -> (DVec3, DVec3) {
        let points = || self.vertices.iter().map(|&v| self.positions[v as usize]);
        (
            points().fold(DVec3::INFINITY, DVec3::min),
            points().fold(DVec3::NEG_INFINITY, DVec3::max),
        )
    }

    /// The largest coordinate relative to the origin.
    pub fn largest(&self, origin: DVec3) -> f64 {
        let (low, high) = self.bounding_box();
        (low - origin).abs().max((high - origin).abs()).max_element()
    }

    pub fn vertex_count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// Positions of vertices and centres relative to the origin, four floats each.
    pub fn position_table(&self, origin: DVec3) -> impl Iterator<Item = f32> {
        self.positions
            .iter()
            .chain(&self.centres)
            .flat_map(move |&p| vector_entry(p - origin))
    }

    pub fn face_normal_table(&self) -> impl Iterator<Item = f32> {
        self.face_normals.iter().flat_map(|&n| vector_entry(n))
    }
}

/// A vector as the tables hold it.
pub fn vector_entry(v: DVec3) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, 0.0]
}

/// Twice the area of a polygon along its mean normal (Newell), about its first corner.
fn area_vector(mut corners: impl Iterator<Item = DVec3>) -> DVec3 {
    let Some(first) = corners.next() else {
        return DVec3::ZERO;
    };
    let (mut sum, mut last) = (DVec3::ZERO, DVec3::ZERO);
    for corner in corners {
        sum += last.cross(corner - first);
        last = corner - first;
    }
    sum
}

/// The direction of a vector; (0, 1, 0) for none.
pub fn unit_or_up(v: DVec3) -> DVec3 {
    crate::direction::scaled(v).try_normalize().unwrap_or(DVec3::Y)
}

/// A flat mesh: bilinear quads, flat triangles, and other polygons as fans of triangles about the mean of their corners.
///
/// A triangle's normal is its own, a quad's that of the bilinear patch, a fan's that of each of its triangles. Where there is none
/// (faces without area), the mean normal of the face or, last, (0, 1, 0).
///
/// GPU memory: 16 bytes a vertex, 32 a face, 12 a corner.
#[derive(Clone, Debug)]
pub struct Mesh {
    polygons: Polygons,
    /// A quarter of the mixed derivative of each root, which bounds how far a quad is from flat triangles of level 0.
    twists: Vec<f64>,
}

#[derive(ShaderType)]
struct MeshParams {
    vertices: u32,
    faces: u32,
    margin: f32,
}

impl Mesh {
    /// The surface of a mesh. Its corner attributes do not matter.
    ///
    /// # Errors
    /// [`MeshError`] if the faces are no surface or a position is not finite.
    pub fn new(mesh: &PolygonMesh) -> Result<Self, MeshError> {
        let polygons = Polygons::new(mesh)?;
        let topology = &polygons.topology;
        let twist = |root: Place| {
            let centre = RootPoint {
                face: root.face,
                root: root.root,
                x: 0,
                y: 0,
            };
            match topology.corner_count(root.face) {
                4 => {
                    Jet::of(topology, centre)
                        .field(|operand| polygons.position(operand))
                        .duv
                        .length()
                        / 4.0
                }
                _ => 0.0,
            }
        };
        let twists = over_edges(topology, &topology.roots().map(twist).collect::<Vec<_>>());
        Ok(Self { polygons, twists })
    }

    fn jet(&self, at: RootPoint) -> FieldJet {
        Jet::of(&self.polygons.topology, at).field(|operand| self.polygons.position(operand))
    }
}

impl Surface for Mesh {
    fn topology(&self) -> &Topology {
        &self.polygons.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.jet(at).value
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let FieldJet { value, du, dv, duv } = self.jet(at);
        let mean = self.polygons.face_normals[at.face as usize];
        let is_triangle = self.topology().corner_count(at.face) == 3;
        let normal = if is_triangle {
            mean
        } else {
            frame_normal(du, dv, duv, mean)
        };
        SurfaceFrame {
            position: value,
            du,
            dv,
            normal,
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let root = self.topology().half_edge_index(leaf.face, leaf.root) as usize;
        let speed = self.polygons.speeds[root];
        let radius = speed * diamond::ball_scale(leaf.level);
        SurfaceBound {
            centre: self.point(diamond::centre(leaf)),
            radius,
            size: speed * diamond::level_scale(leaf.level),
            guard: 2.0 * radius,
            deviation: self.twists[root] * diamond::level_scale(leaf.level).powi(2),
            // The diagonals of a twisted quad are as far from it as the triangles that have them as legs.
            pair_deviation: self.twists[root] * diamond::level_scale(leaf.level).powi(2),
        }
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        self.polygons.bounding_box()
    }

    fn shader(&self) -> &'static str {
        "surfaces/mesh.wgsl"
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        let polygons = &self.polygons;
        let params = MeshParams {
            vertices: polygons.vertex_count(),
            faces: polygons.topology.face_count(),
            margin: round_up(POSITION_ERROR * polygons.largest(origin)),
        };
        let half_edges = polygons.vertices.iter().zip(polygons.speeds.iter().zip(&self.twists));
        SurfaceTables {
            params: uniform(&params),
            a: polygons
                .position_table(origin)
                .chain(polygons.face_normal_table())
                .collect(),
            b: half_edges
                .flat_map(|(&vertex, (&speed, &twist))| [vertex, round_up(speed).to_bits(), round_up(twist).to_bits()])
                .collect(),
            heights: None,
            height_bounds: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CornerAttributes;
    use keyleaf_key::ONE;

    #[test]
    fn the_deviation_bounds_flat_triangles_over_a_twisted_quad_and_is_zero_over_flat_faces() {
        let position = |k: u32| DVec3::new(f64::from(k % 3), f64::from(k / 3), if k == 4 { 1.0 } else { 0.0 });
        let mesh = PolygonMesh {
            positions: (0..6).map(position).chain([DVec3::new(3.0, 0.5, 0.0)]).collect(),
            faces: [&[0, 1, 4, 3][..], &[1, 2, 5, 4], &[2, 6, 5]].into_iter().collect(),
            corners: CornerAttributes::default(),
        };
        let mesh = Mesh::new(&mesh).expect("a surface");
        let mut largest: f64 = 0.0;
        for root in mesh.topology().roots().take(8) {
            let [origin, right, _] = root.corners().map(|at| mesh.point(at));
            let off = mesh.point(root.at(ONE / 2, 0)).distance((origin + right) / 2.0);
            largest = largest.max(off / mesh.bound(&root).deviation);
            let child = root.child(1);
            assert_eq!(mesh.bound(&child).deviation, mesh.bound(&root).deviation / 4.0);
        }
        assert!(largest > 0.1 && largest <= 1.0, "{largest}");
        assert_eq!(mesh.bound(&Place::of_root(2, 0)).deviation, 0.0);
    }
}
