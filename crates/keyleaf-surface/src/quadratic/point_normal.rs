//! PN triangles (Vlachos, Peters, Boyd & Mitchell 2001): a cubic patch of positions and a quadratic one of normals over every
//! triangle, from its corners and their normals alone.

use super::error::TrianglePatchError;
use super::fan::Fan;
use super::net::{CubicNet, QuadraticNet};
use crate::PolygonMesh;
use glam::DVec3;
use keyleaf_key::{Place, Topology};

/// Where the normals of the corners of PN triangles come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CornerNormals {
    /// The faces about a vertex, weighted by their angles there.
    #[default]
    AngleWeighted,
    /// [`CornerAttributes::normals`](crate::CornerAttributes::normals); those that are zero from the faces.
    OfMesh,
}

/// The nets of all faces; `given` are normals of corners, by half-edge.
pub fn nets(topology: &Topology, positions: &[DVec3], given: &[Option<DVec3>]) -> Vec<(CubicNet, QuadraticNet)> {
    let normals = corner_normals(topology, positions, given);
    let at = |face, corner: u32| {
        let corner = corner % 3;
        let index = topology.half_edge_index(face, corner) as usize;
        (positions[topology.vertex(face, corner) as usize], normals[index])
    };
    let edge = |root: Place| edge_controls(topology, at, root);
    let edges: Vec<[DVec3; 2]> = topology.roots().map(edge).collect();
    let net = |face: u32| {
        let first = topology.first_half_edge(face) as usize;
        let corners = [0, 1, 2].map(|corner| at(face, corner));
        (
            cubic(
                corners.map(|(position, _)| position),
                [0, 1, 2].map(|r| edges[first + r]),
            ),
            quadratic(corners),
        )
    };
    (0..topology.face_count()).map(net).collect()
}

/// The unit normals that are given at the corners of a mesh, by half-edge; empty if none are.
pub fn given_normals(
    topology: &Topology,
    mesh: &PolygonMesh,
    normals: CornerNormals,
) -> Result<Vec<Option<DVec3>>, TrianglePatchError> {
    if normals == CornerNormals::AngleWeighted {
        return Ok(Vec::new());
    }
    let given = mesh.corners.normals.as_ref().ok_or(TrianglePatchError::NoNormals)?;
    let normal = |(root, normal): (Place, &[f32; 3])| {
        let normal = DVec3::from_array(normal.map(f64::from));
        if !normal.is_finite() {
            let (face, corner) = (root.face, root.root);
            return Err(TrianglePatchError::Normal { face, corner });
        }
        Ok(normal.try_normalize())
    };
    topology.roots().zip(given).map(normal).collect()
}

/// The normal that is given at the start of a half-edge.
pub fn given_at(given: &[Option<DVec3>], half_edge: usize) -> Option<DVec3> {
    given.get(half_edge).copied().flatten()
}

/// A unit normal a half-edge: the given one, or that of the faces about the vertex.
fn corner_normals(topology: &Topology, positions: &[DVec3], given: &[Option<DVec3>]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::Y; topology.half_edge_count() as usize];
    for fan in Fan::all(topology) {
        let mean = fan.mean_normal(topology, positions);
        for spoke in &fan.spokes {
            let index = topology.half_edge_index(spoke.face, spoke.root) as usize;
            normals[index] = given_at(given, index).unwrap_or(mean);
        }
    }
    normals
}

/// The control points between the ends of a half-edge. Where the normals on its two sides differ, the mean of what they say, so that
/// both faces have the same edge.
fn edge_controls(topology: &Topology, at: impl Fn(u32, u32) -> (DVec3, DVec3), root: Place) -> [DVec3; 2] {
    let owner = topology.half_edge_owner(root.face, root.root);
    let one_sided = |face, start: u32, end: u32| {
        let ((p, n), (q, m)) = (at(face, start), at(face, end));
        [tangent_control(p, n, q), tangent_control(q, m, p)]
    };
    let [near_start, near_end] = one_sided(owner.face, owner.root, owner.root + 1);
    let controls = match topology.twin(owner.face, owner.root) {
        None => [near_start, near_end],
        Some(twin) => {
            let [start, end] = one_sided(twin.face, twin.root + 1, twin.root);
            [(near_start + start) / 2.0, (near_end + end) / 2.0]
        }
    };
    let [a, b] = controls;
    if (owner.face, owner.root) == (root.face, root.root) {
        [a, b]
    } else {
        [b, a]
    }
}

/// A third of the way from p to q, projected into the tangent plane of p.
fn tangent_control(p: DVec3, normal: DVec3, q: DVec3) -> DVec3 {
    p + ((q - p) - normal * (q - p).dot(normal)) / 3.0
}

/// With the centre of Vlachos et al. 3.1, which reproduces quadratics: E + (E − V) / 2.
fn cubic(corners: [DVec3; 3], edges: [[DVec3; 2]; 3]) -> CubicNet {
    let mean_edge = edges.iter().flatten().sum::<DVec3>() / 6.0;
    let mean_corner = corners.iter().sum::<DVec3>() / 3.0;
    CubicNet {
        corners,
        edges,
        centre: mean_edge + (mean_edge - mean_corner) / 2.0,
    }
}

/// Vlachos et al. 3.3: the mean normal of an edge, mirrored in the plane that halves it.
fn quadratic(corners: [(DVec3, DVec3); 3]) -> QuadraticNet {
    let edge = |r: usize| {
        let ((p, n), (q, m)) = (corners[r], corners[(r + 1) % 3]);
        let (sum, chord) = (n + m, q - p);
        let length = chord.length_squared();
        let mirrored = if length > 0.0 {
            sum - chord * (2.0 * chord.dot(sum) / length)
        } else {
            sum
        };
        mirrored.try_normalize().unwrap_or(DVec3::ZERO)
    };
    QuadraticNet {
        corners: corners.map(|(_, normal)| normal),
        edges: [0, 1, 2].map(edge),
    }
}
