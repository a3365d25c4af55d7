//! What a surface is made of, to be drawn beside it: the edges of its control mesh, and the ellipsoids of its covariances.

use crate::LoadedObject;
use glam::{DMat3, DVec3};
use keyleaf::draw::Look;
use keyleaf::shading::Material;
use keyleaf::{BackFaces, Settings};
use keyleaf_scene::scene::Colouring;
use keyleaf_surface::{Mesh, PolygonMesh, Surface};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Half the width of an edge, over the diagonal of the surface's box.
const EDGE: f64 = 0.0015;
/// How often the octahedron of an ellipsoid is refined: 512 triangles.
const REFINEMENTS: u32 = 3;

const CAGE_COLOUR: [f32; 3] = [0.02, 0.03, 0.06];
const ELLIPSOID_COLOUR: [f32; 3] = [0.75, 0.3, 0.05];

/// The edges of the control mesh at a time, as thin rods; `None` if the object has no control mesh.
pub fn control_cage(object: &LoadedObject, time: f64) -> Option<LoadedObject> {
    let cage = object.cage.as_ref()?;
    let positions = cage.pose(time);
    let (low, high) = object.surface.bounding_box();
    let width = EDGE * (high - low).length();
    let mut mesh = PolygonMesh::default();
    for [a, b] in edges(&cage.control.mesh) {
        rod(&mut mesh, positions[a as usize], positions[b as usize], width);
    }
    beside(object, "control mesh", mesh, CAGE_COLOUR)
}

/// The ellipsoids of the covariances at a time, `sigmas` standard deviations large; `None` if the object has none.
pub fn ellipsoids(object: &LoadedObject, time: f64, sigmas: f64) -> Option<LoadedObject> {
    let cage = object.cage.as_ref()?;
    let covariances = cage.pose_covariances(time)?;
    let sphere = sphere();
    let mut mesh = PolygonMesh::default();
    for (position, covariance) in cage.pose(time).into_iter().zip(covariances) {
        let axes = root(covariance) * sigmas;
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(sphere.iter().flatten().map(|&x| position + axes * x));
        for triangle in 0..sphere.len() as u32 {
            mesh.faces.push(&[0, 1, 2].map(|k| first + 3 * triangle + k));
        }
    }
    beside(object, "covariances", mesh, ELLIPSOID_COLOUR)
}

/// The edges of a mesh, each once.
fn edges(mesh: &PolygonMesh) -> BTreeSet<[u32; 2]> {
    let of_face = |face: &[u32]| -> Vec<[u32; 2]> {
        let next = face.iter().cycle().skip(1);
        face.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]).collect()
    };
    mesh.faces.iter().flat_map(of_face).collect()
}

/// A prism along an edge.
fn rod(mesh: &mut PolygonMesh, from: DVec3, to: DVec3, width: f64) {
    let Some(along) = (to - from).try_normalize() else {
        return;
    };
    let (across, up) = along.any_orthonormal_pair();
    let first = mesh.positions.len() as u32;
    for end in [from, to] {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        mesh.positions
            .extend(corners.map(|[a, b]| end + (across * a + up * b) * width));
    }
    for k in 0..4 {
        let next = (k + 1) % 4;
        mesh.faces
            .push(&[k, next, next + 4, k + 4].map(|corner| first + corner));
    }
}

/// Triangles of the unit sphere, counter-clockwise as seen from outside.
fn sphere() -> Vec<[DVec3; 3]> {
    let octant = |signs: u32| {
        let sign = |bit: u32| if signs & bit == 0 { 1.0 } else { -1.0 };
        let [x, y, z] = [DVec3::X * sign(1), DVec3::Y * sign(2), DVec3::Z * sign(4)];
        if signs.count_ones().is_multiple_of(2) {
            [x, y, z]
        } else {
            [x, z, y]
        }
    };
    let split = |[a, b, c]: [DVec3; 3]| {
        let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    (0..REFINEMENTS).fold((0..8).map(octant).collect(), |triangles: Vec<_>, _| {
        triangles.into_iter().flat_map(split).collect()
    })
}

/// L with L Lᵀ = Σ (Cholesky); what is not positive counts as zero.
fn root([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> DMat3 {
    let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
    let a = xx.max(0.0).sqrt();
    let (b, c) = (over(xy, a), over(xz, a));
    let d = (yy - b * b).max(0.0).sqrt();
    let e = over(yz - b * c, d);
    let f = (zz - c * c - e * e).max(0.0).sqrt();
    DMat3::from_cols(DVec3::new(a, b, c), DVec3::new(0.0, d, e), DVec3::new(0.0, 0.0, f))
}

/// A mesh of one colour where the object is.
fn beside(object: &LoadedObject, what: &str, mesh: PolygonMesh, base_colour: [f32; 3]) -> Option<LoadedObject> {
    let surface: Arc<dyn Surface> = Arc::new(Mesh::new(&mesh).ok()?);
    let settings = Settings {
        capacity: surface.topology().half_edge_count(),
        base_grid: 0,
        max_level: 0,
        target_leaves: 0,
        back_faces: BackFaces::Drawn,
        moving: false,
        ..object.settings
    };
    Some(LoadedObject {
        name: format!("{}, {what}", object.name),
        surface,
        cage: None,
        settings,
        material: Material::Plain,
        look: Look::default(),
        base_colour,
        colouring: Colouring::Plain,
        ..object.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_covariances_give_them_back() {
        let covariance = [4.0, 1.0, 0.5, 3.0, -0.25, 2.0];
        let root = root(covariance);
        let product = root * root.transpose();
        let found = [
            product.x_axis.x,
            product.x_axis.y,
            product.x_axis.z,
            product.y_axis.y,
            product.y_axis.z,
            product.z_axis.z,
        ];
        assert!(found.iter().zip(covariance).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    #[test]
    fn triangles_of_the_sphere_look_outwards() {
        let triangles = sphere();
        assert_eq!(triangles.len(), 512);
        assert!(triangles.iter().all(|[a, b, c]| (*b - *a).cross(*c - *a).dot(*a) > 0.0));
    }
}
