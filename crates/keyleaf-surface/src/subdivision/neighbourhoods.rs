//! Faces by what their neighbourhood looks like: those that look alike share trees and weights.

use super::cage::{Cage, Placed};
use super::stencil::Vector;
use super::tree::{Grower, Tree};
use std::collections::HashMap;

/// The trees of a kind of neighbourhood, one a domain.
pub type Kind = Vec<Tree>;

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
    /// The faces of the surface.
    pub faces: Vec<FaceRing>,
    /// Control points of all patches of all faces.
    pub entries: usize,
}

impl Neighbourhoods {
    pub fn new(cage: &Cage, grower: &mut Grower) -> Self {
        let control_points = grower.scheme.control_points();
        let mut kinds: Vec<Kind> = Vec::new();
        let mut known: HashMap<Vec<u64>, u32> = HashMap::new();
        let mut faces = Vec::with_capacity(cage.drawn.len());
        let mut entries = 0;
        for &face in &cage.drawn {
            let Placed { ring, vertices } = cage.ring(face);
            let kind = *known.entry(ring.signature()).or_insert_with(|| {
                let corners = ring.fans.len();
                let domains = if corners == 4 || control_points == super::quartic::CONTROL_POINTS {
                    vec![None]
                } else {
                    (0..corners).map(Some).collect()
                };
                kinds.push(domains.into_iter().map(|corner| grower.grow(&ring, corner)).collect());
                kinds.len() as u32 - 1
            });
            let first_entries = kinds[kind as usize]
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
        Self {
            control_points,
            kinds,
            faces,
            entries,
        }
    }

    /// The trees of a face.
    pub fn trees(&self, face: u32) -> &[Tree] {
        &self.kinds[self.faces[face as usize].kind as usize]
    }

    /// The control points of all patches from the values of the control vertices: face after face, domain after domain, patch after patch.
    /// Of each patch the first, then the differences of the others to it.
    pub fn apply<V: Vector>(&self, values: &[V]) -> Vec<V> {
        let mut points = Vec::with_capacity(self.entries);
        self.for_every_row(
            values,
            |tree| &tree.rows,
            |first, point| {
                // Rows of differences sum to zero.
                let is_first = points.len() % self.control_points == 0;
                points.push(if is_first { first.plus(point, 1.0) } else { point });
            },
        );
        points
    }

    /// The errors at the samples of all terminal patches.
    pub fn errors<V: Vector>(&self, values: &[V]) -> Vec<V> {
        let mut errors = Vec::new();
        self.for_every_row(values, |tree| &tree.errors, |_, error| errors.push(error));
        errors
    }

    /// Sums of values relative to the first of their ring, which keeps the digits of what is far from zero.
    fn for_every_row<V: Vector>(&self, values: &[V], rows: impl Fn(&Tree) -> &Vec<f64>, mut emit: impl FnMut(V, V)) {
        let mut own = Vec::new();
        for face in &self.faces {
            let first = values[face.vertices[0] as usize];
            own.clear();
            own.extend(
                face.vertices
                    .iter()
                    .map(|&vertex| values[vertex as usize].plus(first, -1.0)),
            );
            for tree in &self.kinds[face.kind as usize] {
                for row in rows(tree).chunks_exact(tree.width) {
                    let terms = own.iter().zip(row);
                    emit(
                        first,
                        terms.fold(V::ZERO, |sum, (&value, &weight)| sum.plus(value, weight)),
                    );
                }
            }
        }
    }
}
