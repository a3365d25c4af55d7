//! The quadtree of patches over a domain: what all faces with the same neighbourhood share (Brainerd et al. 2016, *Efficient GPU
//! rendering of subdivision surfaces using adaptive quadtrees*).

use super::SubdivisionScheme;
use super::ring::Ring;
use super::shapes::{ChildShape, Shapes};
use super::stencil::Stencils;

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
    /// By node, the shape of its ring.
    pub shapes: Vec<u32>,
    /// Where the patches are.
    pub places: Vec<CellPlace>,
    /// The points of the face's first step that the vertices of the domain's ring are, where the face is not the domain.
    pub entry: Vec<u32>,
}

/// How trees are grown: cells are split until they are regular, or as deep as the isolation says and their sharpness is used up, which
/// takes at most [`INFINITE_SHARPNESS`](super::INFINITE_SHARPNESS) steps.
#[derive(Debug)]
pub struct Grower {
    pub scheme: SubdivisionScheme,
    pub isolation: u32,
    pub shapes: Shapes,
}

impl Grower {
    /// The tree of the middle face of a ring.
    pub fn of_face(&mut self, ring: &Ring) -> Tree {
        let shape = self.shapes.of(ring.clone());
        self.grow(shape, Vec::new(), 0)
    }

    /// The trees of the children of the middle face of a ring, no quad, at its corners, and the points of the first step.
    pub fn of_corners(&mut self, ring: &Ring) -> (Stencils, Vec<Tree>) {
        let (points, children) = self.shapes.at_corners(ring);
        // A domain at a corner is a step deep, so that the cells along an edge are as deep on both sides.
        let grow = |ChildShape { shape, vertices }| self.grow(shape, vertices, 1);
        (points, children.into_iter().map(grow).collect())
    }

    fn grow(&mut self, shape: u32, entry: Vec<u32>, depth: u32) -> Tree {
        let mut tree = Tree {
            nodes: vec![Node::Patch(0)],
            shapes: vec![shape],
            entry,
            ..Tree::default()
        };
        self.grow_node(&mut tree, 0, CellPlace::DOMAIN, depth);
        tree
    }

    fn grow_node(&mut self, tree: &mut Tree, node: usize, place: CellPlace, depth: u32) {
        let shape = tree.shapes[node];
        if self.shapes.is_patch(shape, depth >= self.isolation) {
            tree.nodes[node] = Node::Patch(tree.places.len() as u32);
            tree.places.push(place);
            return;
        }
        let first = tree.nodes.len();
        tree.nodes[node] = Node::Children(first as u32);
        tree.nodes.extend([Node::Patch(0); 4]);
        tree.shapes.extend(self.shapes.split(shape));
        for number in 0..4 {
            self.grow_node(tree, first + number, place.child(self.scheme, number), depth + 1);
        }
    }
}
