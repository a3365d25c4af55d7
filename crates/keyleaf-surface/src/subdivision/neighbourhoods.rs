//! Faces by what their neighbourhood looks like: those that look alike share trees and weights.

use super::SubdivisionScheme;
use super::bound::{Touched, touched};
use super::cage::{Cage, Placed};
use super::ring::Ring;
use super::shapes::{Shape, Shapes};
use super::stencil::{Stencils, Vector};
use super::tree::{Grower, Node, Tree};
use std::collections::HashMap;

/// A kind of neighbourhood.
#[derive(Clone, Debug)]
pub struct Kind {
    /// The points of the first step of a face that has several domains, from the vertices of its ring.
    first_step: Option<Stencils>,
    /// One a domain.
    pub trees: Vec<Tree>,
    /// By root, the patches that it touches.
    pub touched: Vec<Vec<Touched>>,
}

impl Kind {
    fn new(ring: &Ring, grower: &mut Grower) -> Self {
        let corners = ring.fans.len();
        let is_domain = grower.scheme != SubdivisionScheme::CatmullClark || corners == 4;
        let (first_step, trees) = if is_domain {
            (None, vec![grower.of_face(ring)])
        } else {
            let (points, trees) = grower.of_corners(ring);
            (Some(points), trees)
        };
        let touched = (0..corners).map(|root| touched(&trees, grower.scheme, corners, root));
        Self {
            touched: touched.collect(),
            first_step,
            trees,
        }
    }
}

/// A face: its kind and its ring.
#[derive(Clone, Debug)]
pub struct FaceRing {
    /// Index of the kind.
    pub kind: u32,
    /// Vertices of the control mesh, in the order of the weights.
    pub vertices: Vec<u32>,
    /// The entry of the first control point of each domain.
    pub first_entries: Vec<usize>,
}

/// All trees and all faces.
#[derive(Clone, Debug)]
pub struct Neighbourhoods {
    /// Control points a patch.
    pub control_points: usize,
    /// The kinds.
    pub kinds: Vec<Kind>,
    /// The shapes of the nodes of their trees.
    shapes: Vec<Shape>,
    /// By kind, the weights of its control points, if there are [`FACES_OF_ROWS`] faces of it.
    rows: Vec<Option<Rows>>,
    /// The faces of the surface.
    pub faces: Vec<FaceRing>,
    /// Control points of all patches of all faces.
    pub entries: usize,
}

/// So many faces of a kind are worth weights that take the vertices of their rings to control points at once, instead of level by level.
const FACES_OF_ROWS: usize = 4;

/// Columns of weights that are found at once.
const COLUMNS: usize = 8;

/// What the vertices of a ring count in the control points of a kind, and in its errors; of a ring of `width` vertices.
#[derive(Clone, Debug)]
struct Rows {
    width: usize,
    /// In the order of [`Evaluated::points`], whose first ones have weights that sum to 1, the others to 0.
    points: Vec<f64>,
    /// With the numbers of their patches.
    errors: Vec<f64>,
    patches_of_errors: Vec<u32>,
    patches: u32,
}

impl Neighbourhoods {
    pub fn new(cage: &Cage, scheme: SubdivisionScheme, isolation: u32) -> Self {
        let control_points = scheme.control_points();
        let mut grower = Grower {
            scheme,
            isolation,
            shapes: Shapes::new(scheme, cage.creasing),
        };
        let mut kinds: Vec<Kind> = Vec::new();
        let mut known: HashMap<Vec<u64>, u32> = HashMap::new();
        let mut faces = Vec::with_capacity(cage.drawn.len());
        let mut entries = 0;
        for &face in &cage.drawn {
            let Placed { ring, vertices } = cage.ring(face);
            let kind = *known.entry(ring.signature()).or_insert_with(|| {
                kinds.push(Kind::new(&ring, &mut grower));
                kinds.len() as u32 - 1
            });
            let first_entries = kinds[kind as usize]
                .trees
                .iter()
                .map(|tree| {
                    let first = entries;
                    entries += tree.places.len() * control_points;
                    first
                })
                .collect();
            faces.push(FaceRing {
                kind,
                vertices,
                first_entries,
            });
        }
        let mut all = Self {
            control_points,
            kinds,
            shapes: grower.shapes.into_all(),
            rows: Vec::new(),
            faces,
            entries,
        };
        let mut counts = vec![0; all.kinds.len()];
        all.faces.iter().for_each(|face| counts[face.kind as usize] += 1);
        let of_kind =
            |(kind, (count, width)): (u32, (usize, usize))| (count >= FACES_OF_ROWS).then(|| all.rows(kind, width));
        all.rows = (0..).zip(counts.into_iter().zip(all.widths())).map(of_kind).collect();
        all
    }

    /// How many vertices the rings of faces have, by kind.
    fn widths(&self) -> Vec<usize> {
        let mut widths = vec![0; self.kinds.len()];
        for face in &self.faces {
            widths[face.kind as usize] = face.vertices.len();
        }
        widths
    }

    /// The kind of a face.
    pub fn kind(&self, face: u32) -> &Kind {
        &self.kinds[self.faces[face as usize].kind as usize]
    }

    /// The trees of a face.
    pub fn trees(&self, face: u32) -> &[Tree] {
        &self.kind(face).trees
    }

    /// What the patches are for these values of the control vertices.
    pub fn evaluate<V: Vector>(&self, values: &[V]) -> Evaluated<V> {
        let mut all = Evaluated::nothing();
        all.points.reserve_exact(self.entries);
        self.evaluate_faces(values, &mut all, |_| ());
        all
    }

    /// The same face by face: after each, `take` may take what there is.
    pub fn evaluate_faces<V: Vector>(
        &self,
        values: &[V],
        all: &mut Evaluated<V>,
        mut take: impl FnMut(&mut Evaluated<V>),
    ) {
        let mut ring = Vec::new();
        for face in &self.faces {
            ring.clear();
            ring.extend(face.vertices.iter().map(|&vertex| values[vertex as usize]));
            match &self.rows[face.kind as usize] {
                Some(rows) => rows.evaluate(&ring, self.control_points, all),
                None => self.evaluate_face(face.kind, &ring, all),
            }
            take(all);
        }
    }

    /// The weights of a kind, for a ring of `width` vertices.
    fn rows(&self, kind: u32, width: usize) -> Rows {
        let mut rows = Rows {
            width,
            points: Vec::new(),
            errors: Vec::new(),
            patches_of_errors: Vec::new(),
            patches: 0,
        };
        for first in (0..width).step_by(COLUMNS) {
            let unit = |k| std::array::from_fn(|column| if first + column == k { 1.0 } else { 0.0 });
            let ring: Vec<[f64; COLUMNS]> = (0..width).map(unit).collect();
            let mut all = Evaluated::nothing();
            self.evaluate_face(kind, &ring, &mut all);
            rows.points.resize(width * all.points.len(), 0.0);
            rows.errors.resize(width * all.errors.len(), 0.0);
            let count = COLUMNS.min(width - first);
            for (row, weights) in rows.points.chunks_exact_mut(width).zip(&all.points) {
                row[first..first + count].copy_from_slice(&weights[..count]);
            }
            for (row, (_, weights)) in rows.errors.chunks_exact_mut(width).zip(&all.errors) {
                row[first..first + count].copy_from_slice(&weights[..count]);
            }
            rows.patches_of_errors = all.errors.iter().map(|(patch, _)| *patch).collect();
            rows.patches = all.patches;
        }
        rows
    }

    /// The rows of all kinds, and by kind the number of its first weight.
    pub fn rows_of_kinds(&self) -> (Vec<f32>, Vec<u32>) {
        let (mut rows, mut firsts) = (Vec::new(), Vec::new());
        for (kind, (width, known)) in (0..).zip(self.widths().into_iter().zip(&self.rows)) {
            firsts.push(rows.len() as u32);
            let weights = |own: &Rows| own.points.iter().map(|&weight| weight as f32).collect::<Vec<_>>();
            rows.extend(known.as_ref().map_or_else(|| weights(&self.rows(kind, width)), weights));
        }
        (rows, firsts)
    }

    fn evaluate_face<V: Vector>(&self, kind: u32, ring: &[V], all: &mut Evaluated<V>) {
        let Kind { first_step, trees, .. } = &self.kinds[kind as usize];
        let Some(first_step) = first_step else {
            trees
                .iter()
                .for_each(|tree| self.evaluate_node(tree, 0, V::ZERO, ring.to_vec(), all));
            return;
        };
        let points: Vec<V> = first_step.apply(ring).collect();
        for tree in trees {
            let ring = tree.entry.iter().map(|&point| points[point as usize]).collect();
            self.evaluate_node(tree, 0, V::ZERO, ring, all);
        }
    }

    /// `ring` has the values of a cell's vertices relative to `origin`. They are taken relative to the first of them, so that small cells
    /// keep their digits.
    fn evaluate_node<V: Vector>(&self, tree: &Tree, node: usize, origin: V, mut ring: Vec<V>, all: &mut Evaluated<V>) {
        let shift = ring[0];
        let origin = origin.plus(shift, 1.0);
        ring.iter_mut().for_each(|value| *value = value.plus(shift, -1.0));
        let Shape { split, patch, .. } = &self.shapes[tree.shapes[node] as usize];
        match (tree.nodes[node], split, patch) {
            (Node::Children(first), Some(split), _) => {
                let points: Vec<V> = split.points.apply(&ring).collect();
                for (child, node) in split.children.iter().zip(first as usize..) {
                    let ring = child.vertices.iter().map(|&vertex| points[vertex as usize]).collect();
                    self.evaluate_node(tree, node, origin, ring, all);
                }
            }
            (_, _, Some(patch)) => {
                let number = all.patches;
                all.patches += 1;
                let mut controls = patch.controls.apply(&ring);
                let first = controls.next().unwrap_or(V::ZERO);
                all.points.push(origin.plus(first, 1.0));
                all.points.extend(controls.map(|control| control.plus(first, -1.0)));
                all.errors
                    .extend(patch.errors.apply(&ring).map(|error| (number, error)));
            }
            // A node is a patch only if its shape has one, and has children only if its shape has been split.
            _ => {}
        }
    }
}

impl Rows {
    /// As [`Neighbourhoods::evaluate_face`], for values of the vertices of a ring.
    fn evaluate<V: Vector>(&self, ring: &[V], control_points: usize, all: &mut Evaluated<V>) {
        // Relative to the first vertex, which keeps the digits of what is far from zero.
        let origin = ring[0];
        let arms: Vec<V> = ring.iter().map(|value| value.plus(origin, -1.0)).collect();
        let sum = |row: &[f64]| {
            let terms = row.iter().zip(&arms).skip(1);
            terms.fold(V::ZERO, |sum, (&weight, &arm)| sum.plus(arm, weight))
        };
        for patch in self.points.chunks_exact(self.width * control_points) {
            let mut rows = patch.chunks_exact(self.width);
            all.points.extend(rows.next().map(|first| origin.plus(sum(first), 1.0)));
            all.points.extend(rows.map(sum));
        }
        let errors = self.errors.chunks_exact(self.width);
        let numbers = self.patches_of_errors.iter().map(|patch| all.patches + patch);
        all.errors.extend(numbers.zip(errors.map(sum)));
        all.patches += self.patches;
    }
}

/// Control points and errors for values of the control vertices.
#[derive(Clone, Debug)]
pub struct Evaluated<V> {
    /// The control points of all patches: face after face, domain after domain, patch after patch. Of each patch the first, then the
    /// differences of the others to it.
    pub points: Vec<V>,
    /// At the samples of all terminal patches, with the number of the patch.
    pub errors: Vec<(u32, V)>,
    /// How many there are.
    patches: u32,
}

impl<V> Evaluated<V> {
    pub fn nothing() -> Self {
        Self {
            points: Vec::new(),
            errors: Vec::new(),
            patches: 0,
        }
    }
}
