//! What the shaders of patches read.
//!
//! `surface_a`, four floats an entry: control points relative to the origin with their weights over the largest of their surface,
//! surface after surface, u fastest; then the mean normals of the faces.
//!
//! `surface_b`, words:
//! - a face: the entry of its first control point in `surface_a`; the number of control points a row, with the degrees in u and v in
//!   bits 24 and 28; the words at which the floats of its spans in u and v start;
//! - a half-edge (4 · face + root): the half-edge that owns the edge, with bit 31 where the edge is a point; the half-edge that owns the
//!   corner at its start, one for a whole pole; bits of two bounds (size, ball); three words of the face's normal cone: at root 0 its
//!   axis, at root 1 cosine and sine of its angle (all 0 where there is none), else zeros;
//! - the floats of [`LocalDeviation`]: cells, then edges;
//!   In power form there are no spans: instead of the first of them a face has the entry in `surface_a` of its reference point, which its
//!   coefficients follow, u fastest; they stand behind the normals;
//! - spans, each a list of floats: `left[2..=p]`, then `right[2..=p]`; for extraction instead the matrix, row by row, a row a function.
//!   Equal lists are stored once.

use super::basis::{BasisMethod, extraction_matrix};
use super::local_deviation::LocalDeviation;
use super::normal_cone::NormalCone;
use super::power_form::PowerForm;
use super::span::Span;
use super::{PatchKind, Patches};
use crate::direction::round_up;
use crate::mesh::{F32_ROUNDING, vector_entry};
use crate::surface::uniform;
use crate::{Surface, SurfaceTables};
use encase::ShaderType;
use glam::DVec3;
use std::collections::HashMap;

/// An edge that is a point, beside its owner.
const COLLAPSED: u32 = 1 << 31;

const WORDS_OF_FACE: usize = 4;
const WORDS_OF_HALF_EDGE: usize = 7;

/// The uniform `surface`.
#[derive(ShaderType)]
struct PatchParams {
    faces: u32,
    /// The entry of `surface_a` of the first normal.
    normals: u32,
    /// The word of `surface_b` of the first half-edge.
    half_edges: u32,
    /// The word of `surface_b` of the first cell.
    cells: u32,
    /// The word of `surface_b` of the first interval of an edge.
    edges: u32,
    /// The levels of cells below a face.
    depth: u32,
    /// The rounding error of a position, from above.
    margin: f32,
}

/// Lists of floats, each stored once.
struct SpanTable {
    words: Vec<u32>,
    known: HashMap<Vec<u32>, u32>,
    first: usize,
}

impl SpanTable {
    /// The word at which a list starts.
    fn place(&mut self, floats: impl Iterator<Item = f64>) -> u32 {
        let bits: Vec<u32> = floats.map(|value| (value as f32).to_bits()).collect();
        let (words, first) = (&mut self.words, self.first);
        *self.known.entry(bits).or_insert_with_key(|bits| {
            let place = first + words.len();
            words.extend(bits);
            place as u32
        })
    }

    fn place_span(&mut self, span: &Span, kind: PatchKind) -> u32 {
        let p = span.degree;
        if kind == PatchKind::Nurbs(BasisMethod::Power) {
            return 0;
        }
        if kind == PatchKind::Nurbs(BasisMethod::Extraction) {
            let rows = extraction_matrix(p, span).into_iter().take(p + 1);
            return self.place(rows.flat_map(|row| row.into_iter().take(p + 1)));
        }
        let offsets = [&span.left, &span.right];
        self.place(
            offsets
                .into_iter()
                .flat_map(|offsets| offsets[2..=p.max(1)].iter().copied()),
        )
    }
}

/// The tables for positions relative to `origin`.
pub fn tables(patches: &Patches, origin: DVec3) -> SurfaceTables {
    let faces = patches.topology.face_count();
    let half_edges = WORDS_OF_FACE * faces as usize;
    let cells = half_edges + WORDS_OF_HALF_EDGE * patches.topology.half_edge_count() as usize;
    let edges = cells + patches.deviations.cells().count();
    let first_span = edges + patches.deviations.edges().len();
    let mut spans = SpanTable {
        words: Vec::new(),
        known: HashMap::new(),
        first: first_span,
    };
    let mut b = face_words(patches, &mut spans);
    b.extend(half_edge_words(patches));
    b.extend(deviation_words(&patches.deviations));
    b.extend(spans.words);

    let normals: usize = patches.surfaces.iter().map(|surface| surface.points().len()).sum();
    let mut a: Vec<f32> = control_floats(patches, origin)
        .chain(patches.normals.iter().flat_map(|&normal| vector_entry(normal)))
        .collect();
    if patches.kind == PatchKind::Nurbs(BasisMethod::Power) {
        for face in 0..faces {
            b[WORDS_OF_FACE * face as usize + 2] = (a.len() / 4) as u32;
            a.extend(power_floats(patches, face, origin));
        }
    }
    let params = PatchParams {
        faces,
        normals: normals as u32,
        half_edges: half_edges as u32,
        cells: cells as u32,
        edges: edges as u32,
        depth: patches.deviations.depth(),
        margin: round_up(margin(patches, origin)),
    };
    SurfaceTables {
        params: uniform(&params),
        a,
        b,
        heights: None,
        height_bounds: None,
    }
}

fn control_floats(patches: &Patches, origin: DVec3) -> impl Iterator<Item = f32> {
    patches.surfaces.iter().flat_map(move |surface| {
        let largest = surface.largest_weight();
        let controls = surface.points().iter().zip(surface.weights());
        controls.flat_map(move |(&point, &weight)| {
            let [x, y, z, _] = vector_entry(point - origin);
            [x, y, z, (weight / largest) as f32]
        })
    })
}

/// The reference point of a face, relative to the origin, and its coefficients.
fn power_floats(patches: &Patches, face: u32, origin: DVec3) -> impl Iterator<Item = f32> {
    let quad = patches.quad(face);
    let form = PowerForm::of(&quad);
    let coefficients = form.coefficients.into_iter().flat_map(|c| c.as_vec4().to_array());
    vector_entry(form.reference - origin).into_iter().chain(coefficients)
}

fn face_words(patches: &Patches, spans: &mut SpanTable) -> Vec<u32> {
    let mut words = Vec::new();
    let mut first_point = 0;
    for (surface, layout) in patches.surfaces.iter().zip(&patches.layouts) {
        let [us, vs] = &layout.spans;
        let [stride, _] = surface.point_counts();
        let [p, q] = surface.degree();
        let places =
            [us, vs].map(|of| -> Vec<u32> { of.iter().map(|span| spans.place_span(span, patches.kind)).collect() });
        for (v, &place_v) in vs.iter().zip(&places[1]) {
            for (u, &place_u) in us.iter().zip(&places[0]) {
                let block = first_point + u.controls().start + v.controls().start * stride;
                words.extend([block as u32, stride as u32 | p << 24 | q << 28, place_u, place_v]);
            }
        }
        first_point += surface.points().len();
    }
    words
}

fn half_edge_words(patches: &Patches) -> impl Iterator<Item = u32> {
    let topology = &patches.topology;
    let cones = patches.cones();
    topology.roots().zip(&patches.bounds).flat_map(move |(root, bound)| {
        let [x, y, z] = cone_words(cones[root.face as usize], root.root);
        let own = topology.half_edge_index(root.face, root.root) as usize;
        let owner = topology.half_edge_owner(root.face, root.root);
        let corner = patches.addresses.corners[own];
        let flag = if patches.addresses.collapsed[own] { COLLAPSED } else { 0 };
        let [size, ball] = [bound.size, bound.ball].map(|bound| round_up(bound).to_bits());
        [
            topology.half_edge_index(owner.face, owner.root) | flag,
            topology.half_edge_index(corner.face, corner.root),
            size,
            ball,
            x,
            y,
            z,
        ]
    })
}

fn deviation_words(deviations: &LocalDeviation) -> impl Iterator<Item = u32> {
    let bounds = deviations.cells().chain(deviations.edges().iter().copied());
    bounds.map(|bound| round_up(bound).to_bits())
}

/// The part of a face's normal cone that the record of a root holds.
fn cone_words(cone: Option<NormalCone>, root: u32) -> [u32; 3] {
    let Some(NormalCone {
        axis,
        cosine,
        sine,
        depth,
    }) = cone
    else {
        return [0; 3];
    };
    match root {
        0 => axis.to_array().map(|c| (c as f32).to_bits()),
        1 => [(cosine as f32).to_bits(), round_up(sine).to_bits(), depth],
        _ => [0; 3],
    }
}

/// The rounding error of a position: of basis functions, of sums over rows and columns, and of a quotient, each at most a few units of
/// the largest coordinate; and how far joined curves are apart.
fn margin(patches: &Patches, origin: DVec3) -> f64 {
    let (low, high) = patches.bounding_box();
    let largest = (low - origin).abs().max((high - origin).abs()).max_element();
    let degrees = patches.surfaces.iter().map(|surface| surface.degree());
    let degree = degrees.map(|[p, q]| p + q).max().unwrap_or(0);
    (16.0 + 4.0 * f64::from(degree)) * F32_ROUNDING * largest + patches.mismatch
}
