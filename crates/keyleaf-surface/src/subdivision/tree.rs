//! The quadtree of patches over a domain: what all faces with the same neighbourhood share (Brainerd et al. 2016, *Efficient GPU
//! rendering of subdivision surfaces using adaptive quadtrees*).

use super::loop_scheme::{self, Part};
use super::refinement::Child;
use super::ring::Ring;
use super::spectrum::Spectra;
use super::stencil::Stencil;
use super::{Creasing, SubdivisionScheme, bicubic, catmull_clark, quartic};

/// A node of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// The number of a patch.
    Patch(u32),
    /// The first of four consecutive nodes. Of a square they are those at (0, 0), (1, 0), (0, 1) and (1, 1); of a triangle those at its
    /// corners, then the one in the middle.
    Children(u32),
}

/// Where a cell lies in its domain: the images of (0, 0), and of the steps along its first and second parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellPlace {
    pub origin: [f64; 2],
    pub right: [f64; 2],
    pub up: [f64; 2],
}

impl CellPlace {
    const DOMAIN: Self = Self {
        origin: [0.0, 0.0],
        right: [1.0, 0.0],
        up: [0.0, 1.0],
    };

    /// A point of the cell in the domain.
    pub fn at(self, [s, t]: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.origin[k] + s * self.right[k] + t * self.up[k])
    }

    /// The cell with its origin there, half as large or, turned, minus half as large.
    fn part(self, origin: [f64; 2], scale: f64) -> Self {
        Self {
            origin: self.at(origin),
            right: self.right.map(|x| x * scale),
            up: self.up.map(|x| x * scale),
        }
    }

    /// The child of a square or a triangle by its place among the children.
    pub fn child(self, scheme: SubdivisionScheme, number: usize) -> Self {
        let origin = match number {
            0 => [0.0, 0.0],
            1 => [0.5, 0.0],
            2 => [0.0, 0.5],
            _ => [0.5, 0.5],
        };
        let is_turned = number == 3 && scheme != SubdivisionScheme::CatmullClark;
        self.part(origin, if is_turned { -0.5 } else { 0.5 })
    }
}

/// Nodes and patches of a domain.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The root first.
    pub nodes: Vec<Node>,
    /// Vertices of the ring: weights a row.
    pub width: usize,
    /// Rows of weights, those of a patch together: the first gives its first control point, the others the differences of the others to
    /// it.
    pub rows: Vec<f64>,
    /// Where the patches are.
    pub places: Vec<CellPlace>,
    /// Rows that give the error of terminal patches at some of their points.
    pub errors: Vec<f64>,
    /// The patch of each of these rows.
    pub error_patches: Vec<u32>,
}

/// How trees are grown: cells are split until they are regular, or as deep as the isolation says and their sharpness is used up, which
/// takes at most [`INFINITE_SHARPNESS`](super::INFINITE_SHARPNESS) steps.
#[derive(Debug)]
pub struct Grower {
    pub scheme: SubdivisionScheme,
    pub creasing: Creasing,
    pub isolation: u32,
    pub spectra: Spectra,
}

/// A cell with its ring, over the vertices of the domain's ring.
struct Cell {
    ring: Ring,
    rows: Vec<f64>,
    place: CellPlace,
    depth: u32,
}

impl Grower {
    /// The tree of a domain: of the middle face of a ring, or of the child at one of its corners.
    pub fn grow(&mut self, ring: &Ring, corner: Option<usize>) -> Tree {
        let width = ring.vertex_count;
        let unit = |k: usize| if k.is_multiple_of(width + 1) { 1.0 } else { 0.0 };
        let mut root = Cell {
            ring: ring.clone(),
            rows: (0..width * width).map(unit).collect(),
            place: CellPlace::DOMAIN,
            depth: 0,
        };
        if let Some(corner) = corner {
            let child = catmull_clark::child(ring, corner, self.creasing);
            root = root.child(child, width, CellPlace::DOMAIN);
            root.depth = 0;
        }
        let mut tree = Tree {
            nodes: vec![Node::Patch(0)],
            width,
            ..Tree::default()
        };
        self.grow_node(&mut tree, 0, root);
        tree
    }

    fn grow_node(&mut self, tree: &mut Tree, node: usize, cell: Cell) {
        if let Some(patch) = self.patch(tree, &cell) {
            tree.nodes[node] = Node::Patch(tree.places.len() as u32);
            tree.add_patch(&patch, &cell);
            return;
        }
        let first = tree.nodes.len();
        tree.nodes[node] = Node::Children(first as u32);
        tree.nodes.extend([Node::Patch(0); 4]);
        for number in 0..4 {
            let child = self.child(&cell.ring, number);
            let child = cell.child(child, tree.width, cell.place.child(self.scheme, number));
            self.grow_node(tree, first + number, child);
        }
    }

    /// The control points of a cell that has no children.
    fn patch(&mut self, tree: &mut Tree, cell: &Cell) -> Option<Vec<Stencil>> {
        let regular = match self.scheme {
            SubdivisionScheme::CatmullClark => bicubic::regular(&cell.ring),
            SubdivisionScheme::Loop(_) => quartic::regular(&cell.ring),
        };
        let is_settled = cell.ring.fans.iter().all(|fan| fan.is_settled());
        let is_last = cell.depth >= self.isolation && is_settled;
        if regular.is_some() || !is_last {
            return regular;
        }
        let patch = match self.scheme {
            SubdivisionScheme::CatmullClark if !cell.ring.has_only(4) => None,
            SubdivisionScheme::CatmullClark => bicubic::terminal(&cell.ring, &mut self.spectra),
            SubdivisionScheme::Loop(weights) => quartic::terminal(&cell.ring, weights, &mut self.spectra),
        }?;
        let errors = self.errors(cell, &patch);
        tree.errors.extend(
            errors
                .iter()
                .flat_map(|error| error.apply_to_rows(&cell.rows, tree.width)),
        );
        let number = tree.places.len() as u32;
        tree.error_patches.extend(errors.iter().map(|_| number));
        Some(patch)
    }

    /// The child of a cell by its number.
    fn child(&self, ring: &Ring, number: usize) -> Child {
        match self.scheme {
            SubdivisionScheme::CatmullClark => catmull_clark::child(ring, [0, 1, 3, 2][number], self.creasing),
            SubdivisionScheme::Loop(weights) => {
                let part = if number < 3 { Part::Corner(number) } else { Part::Middle };
                loop_scheme::child(ring, part, weights, self.creasing)
            }
        }
    }

    /// By how much a terminal patch misses the limit surface at points about its irregular corners.
    fn errors(&self, cell: &Cell, patch: &[Stencil]) -> Vec<Stencil> {
        let ring = &cell.ring;
        let corners = ring.fans.len();
        let mut errors = Vec::new();
        for corner in (0..corners).filter(|&corner| self.regular_point(ring, corner).is_none()) {
            let first = self.scheme.child_at(ring, corner);
            let second = self.scheme.child_at(&first.ring, corner);
            for k in 1..corners {
                let at = (corner + k) % corners;
                let halfway = self
                    .regular_point(&first.ring, at)
                    .map(|exact| (first.over_parent(&exact), 0.5));
                let nearer = self.regular_point(&second.ring, at);
                let nearer = nearer.map(|exact| (first.over_parent(&second.over_parent(&exact)), 0.25));
                for (exact, scale) in [halfway, nearer].into_iter().flatten() {
                    let weights = self.bernstein(corner, at, scale);
                    let terms = patch.iter().zip(weights);
                    errors.push(Stencil::sum(terms.chain([(&exact, -1.0)])));
                }
            }
        }
        errors
    }

    fn regular_point(&self, ring: &Ring, corner: usize) -> Option<Stencil> {
        match self.scheme {
            SubdivisionScheme::CatmullClark => bicubic::regular_corner(ring, corner).map(|net| net.point),
            SubdivisionScheme::Loop(_) => quartic::regular_corner(ring, corner).map(|net| net.point),
        }
    }

    /// The Bernstein polynomials at a part of the way from one corner to another.
    fn bernstein(&self, from: usize, to: usize, part: f64) -> Vec<f64> {
        match self.scheme {
            SubdivisionScheme::CatmullClark => {
                let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let at = [0, 1].map(|k| corners[from][k] * (1.0 - part) + corners[to][k] * part);
                super::bezier::square_basis(at).to_vec()
            }
            SubdivisionScheme::Loop(_) => {
                let mut at = [0.0; 3];
                at[from] = 1.0 - part;
                at[to] = part;
                super::bezier::triangle_basis(at).to_vec()
            }
        }
    }
}

impl Cell {
    fn child(&self, child: Child, width: usize, place: CellPlace) -> Self {
        let rows = child
            .stencils
            .iter()
            .flat_map(|stencil| stencil.apply_to_rows(&self.rows, width));
        Self {
            rows: rows.collect(),
            ring: child.ring,
            place,
            depth: self.depth + 1,
        }
    }
}

impl Tree {
    fn add_patch(&mut self, patch: &[Stencil], cell: &Cell) {
        self.places.push(cell.place);
        let first = patch[0].apply_to_rows(&cell.rows, self.width);
        self.rows.extend(&first);
        for point in &patch[1..] {
            let row = point.apply_to_rows(&cell.rows, self.width);
            self.rows
                .extend(row.iter().zip(&first).map(|(weight, first)| weight - first));
        }
    }
}
