//! Control meshes: a few by hand, and random ones glued from triangles, quads and hexagons with holes, open or closed.

use crate::metrics::mix;
use keyleaf_key::{RootPoint, Topology};
use proptest::prelude::*;

/// Polygons by vertex index.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub vertex_count: usize,
    pub faces: Vec<Vec<u32>>,
}

impl Mesh {
    fn new(vertex_count: usize, faces: &[&[u32]]) -> Self {
        Self {
            vertex_count,
            faces: faces.iter().map(|face| face.to_vec()).collect(),
        }
    }

    pub fn topology(&self) -> Topology {
        Topology::new(self.vertex_count, &self.faces).expect("the mesh is a surface")
    }

    /// An exact position of a point, in units of no meaning, for vertices at positions without relation to each other. The
    /// centre of a face is the mean of its corners.
    pub fn position(&self, at: RootPoint) -> [i128; 3] {
        const ALL_CORNER_COUNTS_DIVIDE: i128 = 420;
        let face = &self.faces[at.face as usize];
        let next = (at.root as usize + 1) % face.len();
        std::array::from_fn(|axis| {
            let coordinate = |vertex: u32| i128::from(mix(mix(u64::from(vertex)) ^ axis as u64) >> 24);
            let sum: i128 = face.iter().map(|vertex| coordinate(*vertex)).sum();
            let corners =
                coordinate(face[at.root as usize]) * i128::from(at.x) + coordinate(face[next]) * i128::from(at.y);
            sum * (ALL_CORNER_COUNTS_DIVIDE / face.len() as i128) * i128::from(at.z())
                + corners * ALL_CORNER_COUNTS_DIVIDE
        })
    }
}

/// The unit cube of the executable model: vertex 4x + 2y + z.
pub fn cube() -> Mesh {
    Mesh::new(
        8,
        &[
            &[0, 1, 3, 2],
            &[4, 6, 7, 5],
            &[0, 4, 5, 1],
            &[2, 3, 7, 6],
            &[0, 2, 6, 4],
            &[1, 5, 7, 3],
        ],
    )
}

/// The tetrahedron of the executable model.
pub fn tetrahedron() -> Mesh {
    Mesh::new(8, &[&[0, 3, 5], &[0, 5, 6], &[0, 6, 3], &[3, 6, 5]])
}

/// A closed house of one pentagon, five quads and five triangles.
pub fn house() -> Mesh {
    let mut faces = vec![vec![4, 3, 2, 1, 0]];
    for i in 0..5 {
        let next = (i + 1) % 5;
        faces.push(vec![i, next, next + 5, i + 5]);
        faces.push(vec![i + 5, next + 5, 10]);
    }
    Mesh {
        vertex_count: 11,
        faces,
    }
}

/// An open mesh with a triangle, a quad and a hexagon, a vertex where only corners touch, and a face on its own.
pub fn open() -> Mesh {
    Mesh::new(
        16,
        &[
            &[0, 1, 2, 3],
            &[2, 1, 4],
            &[5, 3, 2, 6, 7, 8],
            &[4, 9, 10],
            &[11, 12, 13],
            &[12, 11, 14, 15],
        ],
    )
}

pub fn by_hand() -> [Mesh; 4] {
    [cube(), tetrahedron(), house(), open()]
}

/// What a cell of the grid becomes.
#[derive(Clone, Copy, Debug)]
enum Cell {
    Quad,
    FallingDiagonal,
    RisingDiagonal,
    /// Four triangles about a vertex of its own.
    Star,
    /// One hexagon with the cell to the right, if that is free.
    Hexagon,
    Hole,
}

/// Grids of up to 4 by 4 cells, open or closed to a tube or a torus, with the corners and the faces in any order.
pub fn random() -> impl Strategy<Value = Mesh> {
    let cell = prop_oneof![
        3 => Just(Cell::Quad),
        2 => Just(Cell::FallingDiagonal),
        2 => Just(Cell::RisingDiagonal),
        1 => Just(Cell::Star),
        2 => Just(Cell::Hexagon),
        1 => Just(Cell::Hole),
    ];
    let size = (1..=4_usize, 1..=4_usize, any::<bool>(), any::<bool>());
    (size, prop::collection::vec(cell, 16), any::<u64>()).prop_map(|((width, height, tube, torus), cells, order)| {
        let (tube, torus) = (tube && width >= 3, torus && height >= 3);
        shuffled(glued(width, height, tube, torus, &cells), order)
    })
}

fn glued(width: usize, height: usize, tube: bool, torus: bool, cells: &[Cell]) -> Mesh {
    let columns = if tube { width } else { width + 1 };
    let rows = if torus { height } else { height + 1 };
    let vertex = |i: usize, j: usize| (i % columns + columns * (j % rows)) as u32;
    let (mut vertex_count, mut faces) = (columns * rows, Vec::new());
    for j in 0..height {
        let mut i = 0;
        while i < width {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            match cells[i + 4 * j] {
                Cell::Hexagon if i + 1 < width => {
                    faces.push(vec![a, b, vertex(i + 2, j), vertex(i + 2, j + 1), c, d]);
                    i += 1;
                }
                Cell::Quad | Cell::Hexagon => faces.push(vec![a, b, c, d]),
                Cell::FallingDiagonal => faces.extend([vec![a, b, d], vec![b, c, d]]),
                Cell::RisingDiagonal => faces.extend([vec![a, b, c], vec![a, c, d]]),
                Cell::Star => {
                    let middle = vertex_count as u32;
                    vertex_count += 1;
                    faces.extend([[a, b], [b, c], [c, d], [d, a]].map(|[from, to]| vec![from, to, middle]));
                }
                Cell::Hole if faces.is_empty() && i + 1 == width && j + 1 == height => faces.push(vec![a, b, c]),
                Cell::Hole => {}
            }
            i += 1;
        }
    }
    Mesh { vertex_count, faces }
}

fn shuffled(mut mesh: Mesh, order: u64) -> Mesh {
    for (i, face) in mesh.faces.iter_mut().enumerate() {
        let turn = mix(order ^ i as u64) as usize % face.len();
        face.rotate_left(turn);
    }
    mesh.faces
        .sort_by_key(|face| mix(order ^ mix(u64::from(face[0]) << 32 | u64::from(face[1]))));
    mesh
}
