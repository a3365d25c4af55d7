//! Control meshes: a few by hand, and random ones glued from triangles, quads, hexagons and holes, open or closed.

use crate::random::Random;
use glam::DVec3;
use keyleaf::surface::{CornerAttributes, Faces, PolygonMesh};

pub fn mesh(positions: Vec<DVec3>, faces: impl IntoIterator<Item = Vec<u32>>) -> PolygonMesh {
    PolygonMesh {
        positions,
        faces: faces.into_iter().collect::<Faces>(),
        corners: CornerAttributes::default(),
    }
}

/// The unit cube: vertex 4x + 2y + z.
pub fn cube() -> PolygonMesh {
    let corner = |v: u32| DVec3::new(f64::from(v >> 2), f64::from(v >> 1 & 1), f64::from(v & 1));
    let faces = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    mesh((0..8).map(corner).collect(), faces.map(Vec::from))
}

pub fn tetrahedron() -> PolygonMesh {
    let PolygonMesh { positions, .. } = cube();
    mesh(positions, [[0, 3, 5], [0, 5, 6], [0, 6, 3], [3, 6, 5]].map(Vec::from))
}

/// A closed house: one pentagon, five quads, five triangles.
pub fn house() -> PolygonMesh {
    let mut positions: Vec<DVec3> = Vec::new();
    for height in [0.0, 0.8] {
        for k in 0..5 {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 5.0).sin_cos();
            positions.push(DVec3::new(0.6 * cos, height + 0.03 * f64::from(k), -0.6 * sin));
        }
    }
    positions.push(DVec3::new(0.05, 1.3, 0.02));
    let mut faces = vec![vec![4, 3, 2, 1, 0]];
    for i in 0..5 {
        let next = (i + 1) % 5;
        faces.push(vec![i, next, next + 5, i + 5]);
        faces.push(vec![i + 5, next + 5, 10]);
    }
    mesh(positions, faces)
}

/// An open mesh: a triangle, quads, a hexagon, a vertex where only corners touch, and a face on its own.
pub fn open() -> PolygonMesh {
    let at = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [2.0, 0.2],
        [-0.5, 1.5],
        [1.2, 2.0],
        [0.6, 2.6],
        [-0.2, 2.3],
        [3.0, 0.0],
        [2.8, 1.0],
        [4.0, 0.0],
        [4.0, 1.0],
        [3.2, 0.6],
        [5.0, 0.1],
        [5.0, 1.1],
    ];
    let positions = at
        .iter()
        .enumerate()
        .map(|(i, [x, y])| DVec3::new(*x, 0.1 * (i as f64 * 1.7).sin(), -*y))
        .collect();
    let faces = [
        vec![0, 1, 2, 3],
        vec![2, 1, 4],
        vec![5, 3, 2, 6, 7, 8],
        vec![4, 9, 10],
        vec![11, 12, 13],
        vec![12, 11, 14, 15],
    ];
    mesh(positions, faces)
}

/// A closed torus of quads.
pub fn torus(around: u32, across: u32) -> PolygonMesh {
    let vertex = |i: u32, j: u32| i % around + around * (j % across);
    let place = |i: u32, j: u32| {
        let (sin, cos) = (f64::from(i) / f64::from(around) * std::f64::consts::TAU).sin_cos();
        let (rise, out) = (f64::from(j) / f64::from(across) * std::f64::consts::TAU).sin_cos();
        DVec3::new(cos * (1.0 + 0.4 * out), 0.4 * rise, -sin * (1.0 + 0.4 * out))
    };
    let cells = || (0..across).flat_map(|j| (0..around).map(move |i| (i, j)));
    mesh(
        cells().map(|(i, j)| place(i, j)).collect(),
        cells().map(|(i, j)| vec![vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]),
    )
}

/// A closed box, a million times longer than wide.
pub fn sliver() -> PolygonMesh {
    let mut sliver = cube();
    sliver
        .positions
        .iter_mut()
        .for_each(|p| *p *= DVec3::new(1.0, 1e-6, 1e-6));
    sliver
}

pub fn moved(mut mesh: PolygonMesh, by: DVec3) -> PolygonMesh {
    mesh.positions.iter_mut().for_each(|p| *p += by);
    mesh
}

/// A grid of up to 3 by 3 cells, a tube or a torus; corners and faces in any order.
pub fn random(seed: u64) -> PolygonMesh {
    let mut random = Random(seed);
    let (width, height) = (1 + random.below(3), 1 + random.below(3));
    let (tube, torus) = (width == 3 && random.below(2) == 0, height == 3 && random.below(2) == 0);
    let (columns, rows) = (
        if tube { width } else { width + 1 },
        if torus { height } else { height + 1 },
    );
    let vertex = |i: u32, j: u32| i % columns + columns * (j % rows);
    let mut positions = Vec::new();
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let (u, v) = (f64::from(i), f64::from(j));
        let around = |bent: bool, t: f64, count: u32| {
            if bent {
                (t / f64::from(count) * std::f64::consts::TAU).sin_cos()
            } else {
                (t, 1.0)
            }
        };
        let ((x, lift), (z, out)) = (around(tube, u, columns), around(torus, v, rows));
        let shake = random.point((DVec3::splat(-0.1), DVec3::splat(0.1)));
        positions.push(DVec3::new(x, if tube { lift } else { out }, -z) + shake);
    }
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for j in 0..height {
        let mut i = 0;
        while i < width {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            match random.below(11) {
                0..3 => faces.push(vec![a, b, c, d]),
                3..5 => faces.extend([vec![a, b, d], vec![b, c, d]]),
                5..7 => faces.extend([vec![a, b, c], vec![a, c, d]]),
                7 => {
                    let middle = positions.len() as u32;
                    positions.push([a, b, c, d].map(|v| positions[v as usize]).iter().sum::<DVec3>() / 4.0);
                    faces.extend([[a, b], [b, c], [c, d], [d, a]].map(|[from, to]| vec![from, to, middle]));
                }
                8..10 if i + 1 < width => {
                    faces.push(vec![a, b, vertex(i + 2, j), vertex(i + 2, j + 1), c, d]);
                    i += 1;
                }
                _ if faces.is_empty() => faces.push(vec![a, b, c]),
                _ => {} // a hole
            }
            i += 1;
        }
    }
    for face in &mut faces {
        let turn = random.below(face.len() as u32) as usize;
        face.rotate_left(turn);
    }
    for i in (1..faces.len()).rev() {
        faces.swap(i, random.below(i as u32 + 1) as usize);
    }
    mesh(positions, faces)
}
