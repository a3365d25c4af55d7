//! PN triangles, alone and compared with QAS.

use crate::models::{open_fan, shaken, sphere, wheel};
use crate::refine::{Refined, Scheme};
use glam::DVec3;
use keyleaf_key::ONE;
use keyleaf_surface::{ControlMesh, CornerNormals, LoopWeights, PolygonMesh, Surface, TrianglePatches};

/// Largest distance from a unit sphere, and largest angle between the shading normal and the sphere's.
fn off_sphere(surface: &TrianglePatches) -> [f64; 2] {
    let mut largest = [0.0f64; 2];
    for root in surface.topology().roots() {
        for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
            let frame = surface.frame(root.at(i * (ONE / 8), j * (ONE / 8)));
            largest[0] = largest[0].max((frame.position.length() - 1.0).abs());
            largest[1] = largest[1].max(frame.normal.angle_between(frame.position));
        }
    }
    largest
}

#[test]
fn a_sphere_is_approached_by_pn_triangles_and_by_butterfly_patches() {
    println!("steps | PN: distance, angle | Butterfly: distance, angle");
    let mut last = [[f64::INFINITY; 2]; 2];
    for steps in 0..5 {
        let mesh = sphere(steps);
        let pn = off_sphere(&TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted).expect("a surface"));
        let butterfly = off_sphere(&TrianglePatches::butterfly(&mesh).expect("a surface"));
        println!(
            "{steps} | {:.2e}, {:.2e} | {:.2e}, {:.2e}",
            pn[0], pn[1], butterfly[0], butterfly[1]
        );
        for (now, before) in [pn, butterfly].iter().zip(&last) {
            assert!(now[0] < before[0] / 1.5, "{now:?} {before:?}");
        }
        last = [pn, butterfly];
    }
    assert!(
        last.iter().all(|[distance, angle]| *distance < 2e-3 && *angle < 0.05),
        "{last:?}"
    );
}

/// Against the Loop limit of the same mesh, QAS is nearer than PN triangles of its limit vertices.
#[test]
fn qas_is_nearer_to_the_loop_limit_than_pn_triangles_of_the_limit_vertices() {
    for (name, mesh) in [
        ("octahedron", sphere(0)),
        ("sphere", sphere(1)),
        ("shaken", shaken(sphere(1), 0.2, 3)),
        ("wheel", wheel(7, 1.0)),
    ] {
        let control = ControlMesh::from(mesh.clone());
        let qas = TrianglePatches::of_loop(&control, LoopWeights::Loop).expect("a surface");
        let points = mesh.positions.iter().map(|p| p.to_array()).collect();
        let faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        let coarse = Refined::new(Scheme::Loop, false, points, &faces);
        let projected = coarse
            .limits()
            .iter()
            .map(|limit| DVec3::from_array(limit.value))
            .collect();
        let projected = PolygonMesh {
            positions: projected,
            ..mesh
        };
        let pn = TrianglePatches::point_normal(&projected, CornerNormals::AngleWeighted).expect("a surface");
        let fine = coarse.refine().refine().refine();
        let limits = fine.limits();
        let mut largest = [0.0f64; 2];
        for ((face, i, j), vertex) in fine.by_parameter() {
            let limit = DVec3::from_array(limits[vertex].value);
            for (largest, surface) in largest.iter_mut().zip([&qas, &pn]) {
                let at = surface
                    .face_coord(face as u32, f64::from(i) / 8.0, f64::from(j) / 8.0)
                    .expect("inside");
                *largest = largest.max(surface.point(at).distance(limit));
            }
        }
        println!(
            "{name}: largest distance to the Loop limit, QAS {:.2e}, PN {:.2e}",
            largest[0], largest[1]
        );
        assert!(largest[0] < largest[1], "{name}: {largest:?}");
    }
}

#[test]
fn vertices_and_their_normals_are_interpolated() {
    for mesh in [
        shaken(sphere(1), 0.1, 1),
        wheel(3, 1.0),
        wheel(12, 1.0),
        open_fan(2),
        open_fan(9),
    ] {
        let surface = TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted).expect("a surface");
        for root in surface.topology().roots() {
            let vertex = surface.topology().vertex(root.face, root.root);
            let frame = surface.frame(root.corners()[1]);
            assert_eq!(frame.position, mesh.positions[vertex as usize]);
            // The patch is tangent to the plane of the normal.
            assert!(frame.normal.dot(frame.du).abs() + frame.normal.dot(frame.dv).abs() < 1e-13);
        }
    }
}

#[test]
fn normals_of_the_mesh_count_and_hard_edges_stay_closed() {
    let mut mesh = sphere(0);
    let flat = |face: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[face[k] as usize]);
        [(b - a).cross(c - a).normalize().as_vec3().to_array(); 3]
    };
    mesh.corners.normals = Some(mesh.faces.iter().flat_map(flat).collect());
    let surface = TrianglePatches::point_normal(&mesh, CornerNormals::OfMesh).expect("a surface");
    for root in surface.topology().roots() {
        let middle = root.at(ONE / 2, ONE / 2);
        let mesh_normal =
            DVec3::from_array(mesh.corners.normals.as_ref().expect("normals")[3 * root.face as usize].map(f64::from));
        let frame = surface.frame(middle);
        assert!(frame.normal.distance(mesh_normal) < 1e-6);
        // Both faces say a chord.
        let ends = [root.corners()[1], root.corners()[2]].map(|at| surface.point(at));
        assert!(frame.position.distance((ends[0] + ends[1]) / 2.0) < 1e-7);
        let twin = surface.topology().twin(root.face, root.root).expect("closed");
        let other = keyleaf_key::Place::of_root(twin.face, twin.root).at(ONE / 2, ONE / 2);
        assert_eq!(surface.point(middle), surface.point(other));
    }
    // A normal that is zero comes from the faces.
    if let Some(normals) = &mut mesh.corners.normals {
        normals.iter_mut().for_each(|normal| *normal = [0.0; 3]);
    }
    let zero = TrianglePatches::point_normal(&mesh, CornerNormals::OfMesh).expect("a surface");
    let smooth = TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted).expect("a surface");
    let at = smooth.face_coord(3, 0.2, 0.3).expect("inside");
    assert_eq!(zero.frame(at), smooth.frame(at));
}
