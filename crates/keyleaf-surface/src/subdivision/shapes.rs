//! What cells with rings of the same shape have in common: how they are split, and their patches.
//!
//! About an extraordinary vertex the rings of a level are those of the level before, and most faces of a mesh come down to the same few
//! rings in a step or two. So the weights of a shape are made once: sparse ones, from the vertices of its ring to those of its children
//! or to control points. Values go down a tree from ring to ring.

use super::loop_scheme;
use super::refinement::Children;
use super::ring::Ring;
use super::spectrum::Spectra;
use super::stencil::{Stencil, Stencils};
use super::{Creasing, SubdivisionScheme, bicubic, catmull_clark, quartic};
use std::collections::HashMap;

/// The shape of a ring, with its sharpness.
#[derive(Clone, Debug)]
pub struct Shape {
    ring: Ring,
    /// How a cell is split, where one has been.
    pub split: Option<Split>,
    /// The patch of a cell that is not split, where there is one.
    pub patch: Option<Patch>,
    is_regular: bool,
    is_settled: bool,
}

/// The children of a cell.
#[derive(Clone, Debug)]
pub struct Split {
    /// Their vertices, from those of the cell's ring.
    pub points: Stencils,
    /// The children in the order of [`Node::Children`](super::tree::Node).
    pub children: [ChildShape; 4],
}

/// A child: its shape, and which of the points the vertices of its ring are.
#[derive(Clone, Debug)]
pub struct ChildShape {
    pub shape: u32,
    pub vertices: Vec<u32>,
}

/// The patch of a cell, from the vertices of its ring.
#[derive(Clone, Debug)]
pub struct Patch {
    /// The control points.
    pub controls: Stencils,
    /// By how much a terminal patch misses the limit surface at points about its irregular corners.
    pub errors: Stencils,
}

/// All shapes that have been met, each once.
#[derive(Debug)]
pub struct Shapes {
    scheme: SubdivisionScheme,
    creasing: Creasing,
    spectra: Spectra,
    all: Vec<Shape>,
    /// By signature.
    known: HashMap<Vec<u64>, u32>,
}

impl Shapes {
    pub fn new(scheme: SubdivisionScheme, creasing: Creasing) -> Self {
        Self {
            scheme,
            creasing,
            spectra: Spectra::new(scheme),
            all: Vec::new(),
            known: HashMap::new(),
        }
    }

    /// By number.
    pub fn into_all(self) -> Vec<Shape> {
        self.all
    }

    /// The number of the shape of a ring.
    pub fn of(&mut self, ring: Ring) -> u32 {
        let Self { all, known, scheme, .. } = self;
        *known.entry(ring.signature()).or_insert_with(|| {
            let controls = match scheme {
                SubdivisionScheme::CatmullClark => bicubic::regular(&ring),
                SubdivisionScheme::Loop(_) => quartic::regular(&ring),
            };
            all.push(Shape {
                is_regular: controls.is_some(),
                is_settled: ring.fans.iter().all(|fan| fan.is_settled()),
                split: None,
                patch: controls.map(|controls| Patch {
                    controls: controls.iter().collect(),
                    errors: Stencils::default(),
                }),
                ring,
            });
            all.len() as u32 - 1
        })
    }

    /// Whether a cell is a patch: a regular one, or a terminal one where it is the last.
    pub fn is_patch(&mut self, shape: u32, is_last: bool) -> bool {
        let own = &self.all[shape as usize];
        if own.is_regular || !is_last || !own.is_settled {
            return own.is_regular;
        }
        if own.patch.is_none() {
            self.all[shape as usize].patch = terminal(&self.all[shape as usize].ring, self.scheme, &mut self.spectra);
        }
        self.all[shape as usize].patch.is_some()
    }

    /// The shapes of the children of a cell.
    pub fn split(&mut self, shape: u32) -> [u32; 4] {
        if let Some(split) = &self.all[shape as usize].split {
            return split.children.each_ref().map(|child| child.shape);
        }
        let ring = &self.all[shape as usize].ring;
        let Children { points, children } = match self.scheme {
            SubdivisionScheme::CatmullClark => {
                let mut square = catmull_clark::children(ring, self.creasing);
                square.children.swap(2, 3);
                square
            }
            SubdivisionScheme::Loop(weights) => loop_scheme::children(ring, weights, self.creasing),
        };
        let children = children.map(|child| ChildShape {
            shape: self.of(child.ring),
            vertices: child.vertices,
        });
        let shapes = children.each_ref().map(|child| child.shape);
        self.all[shape as usize].split = Some(Split {
            points: points.iter().collect(),
            children,
        });
        shapes
    }

    /// The points of the first step of a face that is no quad, from the vertices of its ring, and its children at its corners.
    pub fn at_corners(&mut self, ring: &Ring) -> (Stencils, Vec<ChildShape>) {
        let (points, children) = catmull_clark::children_at_corners(ring, self.creasing);
        let children = children.into_iter().map(|child| ChildShape {
            shape: self.of(child.ring),
            vertices: child.vertices,
        });
        (points.iter().collect(), children.collect())
    }
}

/// The patch of a settled cell that is not split any further, none if it has faces that are no quads.
fn terminal(ring: &Ring, scheme: SubdivisionScheme, spectra: &mut Spectra) -> Option<Patch> {
    let controls = match scheme {
        SubdivisionScheme::CatmullClark if !ring.has_only(4) => None,
        SubdivisionScheme::CatmullClark => bicubic::terminal(ring, spectra),
        SubdivisionScheme::Loop(weights) => quartic::terminal(ring, weights, spectra),
    }?;
    Some(Patch {
        errors: errors(ring, scheme, &controls).iter().collect(),
        controls: controls.iter().collect(),
    })
}

/// By how much a terminal patch misses the limit surface halfway and a quarter of the way from its irregular corners to the others.
fn errors(ring: &Ring, scheme: SubdivisionScheme, controls: &[Stencil]) -> Vec<Stencil> {
    let corners = ring.fans.len();
    let mut errors = Vec::new();
    for corner in (0..corners).filter(|&corner| regular_point(ring, scheme, corner).is_none()) {
        let first = scheme.child_at(ring, corner);
        let second = scheme.child_at(&first.ring, corner);
        for k in 1..corners {
            let at = (corner + k) % corners;
            let halfway = regular_point(&first.ring, scheme, at).map(|exact| (first.over_parent(&exact), 0.5));
            let nearer = regular_point(&second.ring, scheme, at);
            let nearer = nearer.map(|exact| (first.over_parent(&second.over_parent(&exact)), 0.25));
            for (exact, part) in [halfway, nearer].into_iter().flatten() {
                let terms = controls.iter().zip(bernstein(scheme, corner, at, part));
                errors.push(Stencil::sum(terms.chain([(&exact, -1.0)])));
            }
        }
    }
    errors
}

fn regular_point(ring: &Ring, scheme: SubdivisionScheme, corner: usize) -> Option<Stencil> {
    match scheme {
        SubdivisionScheme::CatmullClark => bicubic::regular_corner(ring, corner).map(|net| net.point),
        SubdivisionScheme::Loop(_) => quartic::regular_corner(ring, corner).map(|net| net.point),
    }
}

/// The Bernstein polynomials at a part of the way from one corner to another.
fn bernstein(scheme: SubdivisionScheme, from: usize, to: usize, part: f64) -> Vec<f64> {
    match scheme {
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
