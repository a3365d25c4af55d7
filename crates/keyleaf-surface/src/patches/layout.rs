//! The KSQuads of a surface, and the half-edges of its boundaries.

use super::nurbs_surface::NurbsSurface;
use super::span::{self, Span};
use keyleaf_key::HalfEdge;
use std::ops::Range;

/// A side of a surface or of a piece of it, by its own parameters. As a number: the root of a KSQuad at that side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The least v.
    VMin,
    /// The greatest u.
    UMax,
    /// The greatest v.
    VMax,
    /// The least u.
    UMin,
}

impl Side {
    pub(super) const ALL: [Self; 4] = [Self::VMin, Self::UMax, Self::VMax, Self::UMin];

    /// The parameter that changes along the side.
    pub(super) fn along(self) -> usize {
        self as usize % 2
    }

    /// Whether the other parameter is at its end.
    pub(super) fn is_at_end(self) -> bool {
        matches!(self, Self::UMax | Self::VMax)
    }

    /// Whether the parameter falls when the side is run through counter-clockwise.
    pub(super) fn is_backward(self) -> bool {
        matches!(self, Self::VMax | Self::UMin)
    }

    /// The same side after u and v are exchanged.
    pub(super) fn transposed(self) -> Self {
        Self::ALL[3 - self as usize]
    }
}

/// The spans of a surface, and the pieces into which tears cut it.
#[derive(Clone, Debug)]
pub struct Layout {
    pub spans: [Vec<Span>; 2],
    /// Runs of spans without tear.
    pub runs: [Vec<Range<usize>>; 2],
    /// The face of the first KSQuad.
    pub first_face: u32,
}

impl Layout {
    pub fn new(surface: &NurbsSurface, first_face: u32) -> Self {
        let spans = surface.spans();
        let runs = [span::runs(&spans[0]), span::runs(&spans[1])];
        Self {
            spans,
            runs,
            first_face,
        }
    }

    /// The layouts of all surfaces of a model, whose faces follow each other.
    pub fn of_model(surfaces: &[NurbsSurface]) -> Vec<Self> {
        let mut first_face = 0;
        let next = |surface| {
            let layout = Self::new(surface, first_face);
            first_face = first_face.saturating_add(layout.face_count());
            layout
        };
        surfaces.iter().map(next).collect()
    }

    /// How many KSQuads there are.
    pub fn face_count(&self) -> u32 {
        u32::try_from(self.spans[0].len() * self.spans[1].len()).unwrap_or(u32::MAX)
    }

    /// The face of spans i and j: row by row.
    pub fn face(&self, [i, j]: [usize; 2]) -> u32 {
        self.first_face + (i + j * self.spans[0].len()) as u32
    }

    /// The spans of a face.
    pub fn spans_of(&self, face: u32) -> [usize; 2] {
        let index = (face - self.first_face) as usize;
        [index % self.spans[0].len(), index / self.spans[0].len()]
    }

    /// The half-edges of a side of a piece, counter-clockwise.
    pub fn half_edges(&self, piece: [usize; 2], side: Side) -> Vec<HalfEdge> {
        let (along, across) = (side.along(), 1 - side.along());
        let run = |axis: usize| self.runs[axis][piece[axis]].clone();
        let line = if side.is_at_end() {
            run(across).end - 1
        } else {
            run(across).start
        };
        let half_edge = |place: usize| {
            let mut spans = [line; 2];
            spans[along] = place;
            HalfEdge {
                face: self.face(spans),
                root: side as u32,
            }
        };
        let mut half_edges: Vec<HalfEdge> = run(along).map(half_edge).collect();
        if side.is_backward() {
            half_edges.reverse();
        }
        half_edges
    }

    /// The half-edges that meet inside pieces.
    pub fn inner_pairs(&self) -> impl Iterator<Item = [HalfEdge; 2]> {
        let pair = |a: [usize; 2], b: [usize; 2], side: Side| {
            let half_edge = |spans, root| HalfEdge {
                face: self.face(spans),
                root,
            };
            [half_edge(a, side as u32), half_edge(b, (side as u32 + 2) % 4)]
        };
        let connected = |axis: usize| self.runs[axis].iter().flat_map(|run| run.start..run.end - 1);
        let [nu, nv] = [self.spans[0].len(), self.spans[1].len()];
        let across_u = (0..nv).flat_map(move |j| connected(0).map(move |i| pair([i, j], [i + 1, j], Side::UMax)));
        let across_v = connected(1).flat_map(move |j| (0..nu).map(move |i| pair([i, j], [i, j + 1], Side::VMax)));
        across_u.chain(across_v)
    }
}
