//! How long surfaces take to make. Run with `cargo test --release -- --ignored --nocapture speed`.

use crate::models::{LOOP, disc, mesh, prism, settings};
use glam::DVec3;
use keyleaf_surface::{ControlMesh, PolygonMesh, Subdivision, SubdivisionScheme};
use std::time::Instant;

/// A closed strip of quads round a torus; triangles where asked for.
fn torus(columns: u32, rows: u32, is_loop: bool) -> PolygonMesh {
    let angle = |k: u32, of: u32| std::f64::consts::TAU * f64::from(k) / f64::from(of);
    let position = |k: u32| {
        let (a, b) = (angle(k % columns, columns), angle(k / columns, rows));
        DVec3::new((3.0 + b.cos()) * a.cos(), (3.0 + b.cos()) * a.sin(), b.sin())
    };
    let at = |i: u32, j: u32| i % columns + j % rows * columns;
    let quads = (0..columns * rows).map(|k| {
        let (i, j) = (k % columns, k / columns);
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    let faces = quads.flat_map(|[a, b, c, d]| {
        if is_loop {
            vec![vec![a, b, c], vec![a, c, d]]
        } else {
            vec![vec![a, b, c, d]]
        }
    });
    mesh((0..columns * rows).map(position).collect(), faces)
}

/// Cubes apart: every face has four corners with three faces.
fn cubes(count: u32) -> PolygonMesh {
    let corner = |k: u32| {
        DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2 & 1)) + f64::from(k / 8) * 2.0 * DVec3::X
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [1, 3, 7, 5],
        [3, 2, 6, 7],
        [2, 0, 4, 6],
    ];
    let all = (0..count).flat_map(|cube| faces.map(|face| face.map(|vertex| vertex + 8 * cube)));
    mesh((0..8 * count).map(corner).collect(), all)
}

#[test]
#[ignore = "measures time"]
fn speed() {
    for (what, polygons, scheme) in [
        (
            "252 quads with four extraordinary corners",
            cubes(42),
            SubdivisionScheme::CatmullClark,
        ),
        (
            "10,000 regular quads",
            torus(100, 100, false),
            SubdivisionScheme::CatmullClark,
        ),
        ("20,000 regular triangles", torus(100, 100, true), LOOP),
        (
            "two polygons of 1,000 corners",
            prism(1000).mesh,
            SubdivisionScheme::CatmullClark,
        ),
        ("a vertex of 1,000 faces", disc(1000, LOOP).mesh, LOOP),
    ] {
        let control = ControlMesh::from(polygons);
        let times = (0..5).map(|_| {
            let start = Instant::now();
            let surface = Subdivision::new(&control, settings(scheme, 8)).expect("a surface");
            let made = start.elapsed();
            let tables = keyleaf_surface::Surface::tables(&surface, DVec3::ZERO);
            (made, start.elapsed() - made, tables.a.len() / 4)
        });
        let (made, tables, entries) = times.min().expect("a time");
        println!("{what}: surface {made:.1?}, tables {tables:.1?}, {entries} entries");
    }
}
