//! Meshes that several tests use.

use glam::DVec3;
use keyleaf_surface::{CornerAttributes, PolygonMesh};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A generator of the same numbers everywhere (xorshift64*).
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, end: u32) -> u32 {
        (self.next() % u64::from(end)) as u32
    }

    /// In −1..1.
    pub fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }
}

pub fn mesh(positions: Vec<DVec3>, faces: &[[u32; 3]]) -> PolygonMesh {
    PolygonMesh {
        positions,
        faces: faces.iter().collect(),
        corners: CornerAttributes::default(),
    }
}

pub fn triangles(mesh: &PolygonMesh) -> Vec<[u32; 3]> {
    mesh.faces.iter().map(|face| [face[0], face[1], face[2]]).collect()
}

/// The unit sphere by an octahedron, every triangle cut into four `steps` times.
pub fn sphere(steps: u32) -> PolygonMesh {
    let mut positions = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut faces = vec![
        [0, 1, 2],
        [1, 3, 2],
        [3, 4, 2],
        [4, 0, 2],
        [1, 0, 5],
        [3, 1, 5],
        [4, 3, 5],
        [0, 4, 5],
    ];
    for _ in 0..steps {
        let mut known: HashMap<[u32; 2], u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *known.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    mesh(positions, &faces)
}

/// A torus with radii 2 and 0.75 of 2 n² triangles, all vertices with six edges.
pub fn torus(n: u32) -> PolygonMesh {
    let position = |k: u32| {
        let [u, v] = [k % n, k / n].map(|i| TAU * f64::from(i) / f64::from(n));
        let radius = 2.0 + 0.75 * v.cos();
        DVec3::new(radius * u.cos(), radius * u.sin(), 0.75 * v.sin())
    };
    let at = |i: u32, j: u32| i % n + j % n * n;
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let cell = |(i, j)| {
        [
            [at(i, j), at(i + 1, j), at(i, j + 1)],
            [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)],
        ]
    };
    let faces: Vec<[u32; 3]> = cells.flat_map(cell).collect();
    mesh((0..n * n).map(position).collect(), &faces)
}

/// A patch of the regular triangular grid, n × n vertices, with these heights over the plane.
pub fn grid(n: u32, height: impl Fn(f64, f64) -> f64) -> PolygonMesh {
    let position = |k: u32| {
        let (i, j) = (f64::from(k % n), f64::from(k / n));
        let (x, y) = (i + j / 2.0, j * 0.75f64.sqrt());
        DVec3::new(x, y, height(x, y))
    };
    let cells = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| i + j * n));
    let faces: Vec<[u32; 3]> = cells
        .flat_map(|k| [[k, k + 1, k + n], [k + 1, k + n + 1, k + n]])
        .collect();
    mesh((0..n * n).map(position).collect(), &faces)
}

/// A cone of n triangles about vertex 0, closed, with a second ring outside so that vertex 0 is deep inside.
pub fn wheel(n: u32, height: f64) -> PolygonMesh {
    let ring = |radius: f64, z: f64| {
        (0..n).map(move |i| {
            let angle = TAU * f64::from(i) / f64::from(n);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        })
    };
    let positions = [DVec3::new(0.0, 0.0, height)]
        .into_iter()
        .chain(ring(1.0, height / 2.0))
        .chain(ring(2.0, 0.0))
        .collect();
    let faces: Vec<[u32; 3]> = (0..n)
        .flat_map(|i| {
            let (a, b) = (1 + i, 1 + (i + 1) % n);
            [[0, a, b], [a, a + n, b], [b, a + n, b + n]]
        })
        .collect();
    mesh(positions, &faces)
}

/// A fan of k − 1 triangles about vertex 0 on the boundary.
pub fn open_fan(k: u32) -> PolygonMesh {
    let rim = (0..k).map(|i| {
        let angle = TAU / 2.0 * f64::from(i) / f64::from(k - 1);
        DVec3::new(angle.cos(), angle.sin(), 0.2 * (2.0 * angle).sin())
    });
    let faces: Vec<[u32; 3]> = (1..k).map(|i| [0, i, i + 1]).collect();
    mesh([DVec3::ZERO].into_iter().chain(rim).collect(), &faces)
}

/// A mesh with its vertices moved at random.
pub fn shaken(mut mesh: PolygonMesh, amount: f64, seed: u64) -> PolygonMesh {
    let mut random = Random(seed);
    for position in &mut mesh.positions {
        *position += DVec3::new(random.signed(), random.signed(), random.signed()) * amount;
    }
    mesh
}
