//! The modified Butterfly scheme.

use crate::models::{grid, open_fan, shaken, sphere, torus, wheel};
use glam::DVec3;
use keyleaf_key::ONE;
use keyleaf_surface::{LimitSamples, PolygonMesh, Surface, TrianglePatches};

fn middles(mesh: &PolygonMesh) -> Vec<(DVec3, [DVec3; 2])> {
    let samples = LimitSamples::of_butterfly(mesh).expect("samples");
    let topology = mesh.topology().expect("a surface");
    let ends = topology
        .roots()
        .map(|root| [0, 1].map(|step| mesh.positions[topology.vertex(root.face, (root.root + step) % 3) as usize]));
    samples.edges.iter().map(|sample| sample.position).zip(ends).collect()
}

#[test]
fn cubics_are_reproduced_inside_regular_meshes() {
    let cubics: [fn(f64, f64) -> f64; 4] = [
        |x, y| 1.0 - 2.0 * x + 3.0 * y,
        |x, y| x * x - x * y + 2.0 * y * y,
        |x, y| x * x * x - 3.0 * x * y * y,
        |x, y| y * y * y + x * x * y - x,
    ];
    for cubic in cubics {
        let mesh = grid(9, cubic);
        let inside = |p: DVec3| {
            let j = p.y / 0.75f64.sqrt();
            let i = p.x - j / 2.0;
            (2.0..=6.0).contains(&i) && (2.0..=6.0).contains(&j)
        };
        let mut count = 0;
        for (middle, ends) in middles(&mesh) {
            if ends.into_iter().all(inside) {
                assert!(
                    (middle.z - cubic(middle.x, middle.y)).abs() < 1e-11,
                    "{middle} {}",
                    cubic(middle.x, middle.y)
                );
                count += 1;
            }
        }
        assert!(count > 50);
    }
}

#[test]
fn linear_functions_are_reproduced_on_planar_meshes_of_any_valence_and_up_to_boundaries() {
    let meshes = (3..=12)
        .map(|n| wheel(n, 0.0))
        .chain((3..=12).map(open_fan))
        .chain([grid(5, |_, _| 0.0)]);
    for mesh in meshes {
        let mut mesh = shaken(mesh, 0.1, 31);
        for position in &mut mesh.positions {
            position.z = 0.5 * position.x - 0.25 * position.y + 1.0;
        }
        for (middle, ends) in middles(&mesh) {
            assert!(
                (middle.z - (0.5 * middle.x - 0.25 * middle.y + 1.0)).abs() < 1e-14,
                "{middle}"
            );
            assert!(
                middle.distance((ends[0] + ends[1]) / 2.0) < 0.7 * ends[0].distance(ends[1]),
                "{middle} {ends:?}"
            );
        }
    }
}

#[test]
fn the_surface_interpolates_vertices_and_edge_middles_with_normals_on_both_sides_alike() {
    for mesh in [
        shaken(sphere(1), 0.1, 1),
        wheel(3, 1.0),
        wheel(4, 1.0),
        wheel(12, 1.0),
        open_fan(2),
        open_fan(8),
    ] {
        let surface = TrianglePatches::butterfly(&mesh).expect("a surface");
        let samples = LimitSamples::of_butterfly(&mesh).expect("samples");
        for (index, root) in surface.topology().roots().enumerate() {
            let vertex = surface.topology().vertex(root.face, root.root);
            let frame = surface.frame(root.corners()[1]);
            assert_eq!(frame.position, mesh.positions[vertex as usize]);
            assert!(frame.normal.distance(samples.corners[index].normal) < 1e-14);
            let middle = surface.frame(root.at(ONE / 2, ONE / 2));
            assert!(middle.position.distance(samples.edges[index].position) < 1e-14);
            assert!(middle.normal.distance(samples.edges[index].normal) < 1e-12);
        }
    }
}

/// On a regular mesh with even spacing the scheme is of fourth order.
#[test]
fn a_torus_is_approached_to_fourth_order() {
    let off = |p: DVec3| (DVec3::new(p.x, p.y, 0.0).length() - 2.0).hypot(p.z) - 0.75;
    let largest = |n: u32| {
        let errors = middles(&torus(n)).into_iter().map(|(middle, _)| off(middle).abs());
        errors.fold(0.0, f64::max)
    };
    let errors = [12, 24, 48].map(largest);
    println!("distance of edge middles from the torus: {errors:?}");
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0] / 12.0), "{errors:?}");
}
