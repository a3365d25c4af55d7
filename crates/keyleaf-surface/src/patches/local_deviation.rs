//! How far flat triangles are from a surface of four-cornered faces, by place. Twin of `shaders/shared/local_deviation.wgsl`.
//!
//! A face is cut into 4^depth cells, with coarser ones above them; each has three bounds, for hypotenuses along u, along v, and for the
//! halves of both kinds of triangles, whose hypotenuses are diagonal. A diamond
//! of level l lies in two cells of level l, or, deeper than the cells go, in one or two of the finest. A hypotenuse on a mesh edge lies
//! in one cell on either side: the edge has a list of its own, of intervals with the larger of both.
//!
//! Nested: cells hold those below them, and a hypotenuse along v has at most four times the bound of one twice as long along u, see
//! [`of_second`].

use crate::diamond;
use crate::quad_coord::{QuadCoord, UNIT};
use keyleaf_key::{HalfEdge, MAX_LEVEL, Place, Topology};

/// Bounds of a cell: hypotenuses along u, along v, and halves.
type Cell = [f64; 3];

/// Times the square of the hypotenuse: the distance between a surface with second derivatives up to these (uu, uv, vv) and the flat
/// right isosceles triangle over a hypotenuse along u.
///
/// ½ Σ λᵢ Q(Pᵢ − x) with Q the second derivative: the weights λ of a point x within the triangle have variance at most 1/4 along the
/// hypotenuse and 1/16 across it, and covariance at most 1/16.
fn of_second([uu, uv, vv]: [f64; 3]) -> f64 {
    // In this order rounding keeps of_second([vv, uv, uu]) ≤ 4 of_second([uu, uv, vv]).
    (uu / 8.0 + vv / 32.0) + uv / 16.0
}

/// Times the square of the same hypotenuse: the halves of the triangle. Their hypotenuses go half of it along u and along v; weights have
/// variance at most 1/16 in both, and as much covariance.
fn of_halves([uu, uv, vv]: [f64; 3]) -> f64 {
    (uu + vv) / 32.0 + uv / 16.0
}

/// Bounds by cells and edges.
#[derive(Clone, Debug)]
pub struct LocalDeviation {
    depth: u32,
    /// Face by face, level by level from the coarsest, row by row.
    cells: Vec<Cell>,
    /// Half-edge by half-edge, level by level, along the half-edge.
    edges: Vec<f64>,
}

/// The number of levels of cells below a face: fewer where there are many faces, which are flatter each.
pub fn depth_for(faces: u32) -> u32 {
    match faces {
        0..=4096 => 3,
        4097..=65_536 => 2,
        _ => 1,
    }
}

/// How many cells a face has, of all levels.
pub fn cells_of_face(depth: u32) -> u32 {
    ((1 << (2 * (depth + 1))) - 1) / 3
}

/// How many intervals a half-edge has, of all levels.
pub fn intervals_of_edge(depth: u32) -> u32 {
    (2 << depth) - 1
}

/// The place of the first cell of a level.
fn first_cell(level: u32) -> usize {
    ((1 << (2 * level)) - 1) / 3
}

fn larger(a: Cell, b: Cell) -> Cell {
    std::array::from_fn(|k| a[k].max(b[k]))
}

impl LocalDeviation {
    /// From bounds of second derivatives (uu, uv, vv) over the 4^depth finest cells of every face, row by row.
    pub fn new(topology: &Topology, depth: u32, finest: impl Iterator<Item = Vec<[f64; 3]>>) -> Self {
        let mut local = Self {
            depth,
            cells: finest.flat_map(|finest| pyramid(depth, &finest)).collect(),
            edges: Vec::new(),
        };
        local.edges = topology
            .roots()
            .flat_map(|root| local.edge(topology, root.face, root.root))
            .collect();
        local
    }

    /// The number of levels of cells below a face.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// Three floats a cell.
    pub fn cells(&self) -> impl Iterator<Item = f64> {
        self.cells.iter().flatten().copied()
    }

    /// A float an interval.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    fn cell(&self, face: u32, level: u32, [i, j]: [u32; 2]) -> Cell {
        let first = (face * cells_of_face(self.depth)) as usize + first_cell(level);
        self.cells[first + (i + (j << level)) as usize]
    }

    /// The bound of interval `k` of a half-edge, from its own face alone.
    fn own(&self, HalfEdge { face, root }: HalfEdge, level: u32, k: u32) -> f64 {
        let last = (1 << level) - 1;
        let cell = [[k, 0], [last, k], [last - k, last], [0, last - k]][root as usize];
        self.cell(face, level, cell)[root as usize % 2]
    }

    /// The intervals of a half-edge.
    fn edge(&self, topology: &Topology, face: u32, root: u32) -> Vec<f64> {
        let own = HalfEdge { face, root };
        let twin = topology.twin(face, root);
        let of = |level: u32, k: u32| {
            let other = twin.map_or(0.0, |twin| self.own(twin, level, (1 << level) - 1 - k));
            self.own(own, level, k).max(other)
        };
        let of = &of;
        (0..=self.depth)
            .flat_map(|level| (0..1 << level).map(move |k| of(level, k)))
            .collect()
    }

    /// The bounds of a leaf: of triangles of its level, and of the halves of its own.
    pub fn of(&self, topology: &Topology, leaf: &Place) -> [f64; 2] {
        let level = leaf.level.min(self.depth);
        let centre = diamond::centre(leaf);
        let QuadCoord { u, v } = QuadCoord::of(centre);
        let [before, after] = [0, 1].map(|side| {
            let of_axis = |value: u64| (((value + side).clamp(1, UNIT) - 1) >> (32 - level)) as u32;
            self.cell(leaf.face, level, [of_axis(u), of_axis(v)])
        });
        let bounds = larger(before, after);
        let whole = if diamond::crosses_edge(leaf) {
            let half_edge = topology.half_edge_index(leaf.face, leaf.root);
            let first = half_edge * intervals_of_edge(self.depth) + (1 << level) - 1;
            self.edges[(first + (centre.y >> (MAX_LEVEL - level))) as usize]
        } else {
            bounds[(leaf.root + leaf.orientation) as usize % 2]
        };
        let scale = diamond::level_scale(leaf.level);
        [whole, bounds[2]].map(|bound| bound * scale * scale)
    }
}

/// All levels from the finest: a cell is the larger of the four below it.
fn pyramid(depth: u32, finest: &[[f64; 3]]) -> Vec<Cell> {
    let mut cells = vec![[0.0; 3]; first_cell(depth)];
    cells.extend(finest.iter().map(|&[uu, uv, vv]| {
        [
            of_second([uu, uv, vv]),
            of_second([vv, uv, uu]),
            of_halves([uu, uv, vv]),
        ]
    }));
    for level in (0..depth).rev() {
        let side = 1 << level;
        let below = first_cell(level + 1);
        for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
            let [a, b] = [below + 2 * i + 4 * j * side, below + 2 * i + (4 * j + 2) * side];
            cells[first_cell(level) + i + j * side] = [a, a + 1, b, b + 1]
                .map(|k| cells[k])
                .into_iter()
                .fold([0.0; 3], larger);
        }
    }
    cells
}
