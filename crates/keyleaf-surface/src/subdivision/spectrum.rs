//! How far the first control points of a terminal patch lie from its extraordinary corner.
//!
//! About a vertex the surface scales by the subdominant eigenvalues λ₁, λ₂ in the directions of two eigenvectors. A polynomial edge from
//! the vertex cannot, but it can pass through the right point halfway: for the eigenvectors, and so up to higher orders for all
//! surfaces.

use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::stencil::Stencil;
use super::{SubdivisionScheme, bicubic, limit, quartic};
use std::collections::HashMap;

/// Steps of the power iteration: what is left of other eigenvectors is far below what the fit can gain.
const STEPS: usize = 40;

/// The first control point is at least this part of the way to the end of the edge: where λ is 1/4 or less the derivative vanishes, and
/// with it the normal.
const LEAST_REACH: f64 = 1.0 / 32.0;

/// Kind, number of faces and place of the middle face of a sector.
type Key = (SectorKind, usize, usize);

/// Both edges of the middle face: the first control point after the corner, in units of the two limit tangents.
pub type Reach = [[f64; 2]; 2];

/// The answers for one scheme, each computed once.
#[derive(Debug)]
pub struct Spectra {
    scheme: SubdivisionScheme,
    known: HashMap<Key, Option<Reach>>,
}

impl Spectra {
    pub fn new(scheme: SubdivisionScheme) -> Self {
        Self {
            scheme,
            known: HashMap::new(),
        }
    }

    /// For a corner of a settled ring. None where the limit has no tangent plane of two eigenvectors.
    pub fn reach(&mut self, ring: &Ring, corner: usize, sector: &Sector) -> Option<Reach> {
        let has_plane = match (sector.kind, self.scheme) {
            (SectorKind::Interior, _) => sector.faces.len() > 2,
            (SectorKind::Crease, SubdivisionScheme::CatmullClark) => (2..4).contains(&sector.faces.len()),
            (SectorKind::Crease, SubdivisionScheme::Loop(_)) => (2..6).contains(&sector.faces.len()),
            _ => false,
        };
        if !has_plane {
            return None;
        }
        let scheme = self.scheme;
        let key = (sector.kind, sector.faces.len(), sector.own);
        *self.known.entry(key).or_insert_with(|| compute(ring, corner, scheme))
    }
}

fn compute(ring: &Ring, corner: usize, scheme: SubdivisionScheme) -> Option<Reach> {
    // After two steps the other corners are regular, and each further step makes the same ring again.
    let ring = scheme.child_at(&scheme.child_at(ring, corner).ring, corner).ring;
    let sector = Sector::of(&ring.fans[corner])?;
    let own_limit = limit::limit(&ring, &sector, scheme)?;
    let child = scheme.child_at(&ring, corner);
    let places: Vec<(u32, u32)> = canonical(&ring).into_iter().zip(canonical(&child.ring)).collect();
    let step = |values: &[f64]| {
        let mut next = vec![0.0; values.len()];
        for &(own, below) in &places {
            next[own as usize] = child.stencils[below as usize].apply(values);
        }
        next
    };
    let project = |vectors: [Vec<f64>; 2]| -> Option<[Vec<f64>; 2]> {
        let vectors = vectors.map(|mut x| {
            let constant = own_limit.position.apply(&x);
            x.iter_mut().for_each(|x| *x -= constant);
            x
        });
        let [a, b] = [0, 1].map(|k| own_limit.tangents.each_ref().map(|t| t.apply(&vectors[k])));
        let determinant = a[0] * b[1] - a[1] * b[0];
        if determinant.abs() < 1e-9 * (a[0].hypot(a[1]) * b[0].hypot(b[1])) {
            return None;
        }
        let mix = |p: f64, q: f64| -> Vec<f64> {
            let terms = vectors[0].iter().zip(&vectors[1]);
            terms.map(|(x, y)| (p * x + q * y) / determinant).collect()
        };
        Some([mix(b[1], -a[1]), mix(-b[0], a[0])])
    };
    let mut vectors = project(start(&ring, &sector))?;
    for _ in 0..STEPS {
        vectors = project(vectors.map(|x| step(&x)))?;
    }
    let [x, y] = vectors.map(|x| fit(&ring, corner, scheme, &x));
    let (x, y) = (x?, y?);
    let edge = |k: usize| {
        let (near, end) = ([x[k].0, y[k].0], [x[k].1, y[k].1]);
        let along = near[0] * end[0] + near[1] * end[1];
        let least = LEAST_REACH * (end[0] * end[0] + end[1] * end[1]);
        if along < least {
            end.map(|x| x * LEAST_REACH)
        } else {
            near
        }
    };
    Some([edge(0), edge(1)])
}

/// Cosines and sines of the angles of the spokes, and their sums at the diagonals.
fn start(ring: &Ring, sector: &Sector) -> [Vec<f64>; 2] {
    let whole = if sector.kind == SectorKind::Interior {
        std::f64::consts::TAU
    } else {
        std::f64::consts::PI
    };
    let turn = whole / sector.faces.len() as f64;
    let mut vectors = [vec![0.0; ring.vertex_count], vec![0.0; ring.vertex_count]];
    for k in 0..sector.spokes.len() {
        let angle = turn * (k as f64 - sector.own as f64);
        vectors[0][sector.spoke(k) as usize] = angle.cos();
        vectors[1][sector.spoke(k) as usize] = angle.sin();
    }
    if ring.has_only(4) {
        for k in 0..sector.faces.len() {
            let angle = turn * (k as f64 + 0.5 - sector.own as f64);
            let diagonal = sector.diagonal(ring, k) as usize;
            vectors[0][diagonal] = 1.4 * angle.cos();
            vectors[1][diagonal] = 1.4 * angle.sin();
        }
    }
    vectors
}

/// The first control point and the end of both edges, for values with limit 0 at the corner, so that the edges are right halfway.
fn fit(ring: &Ring, corner: usize, scheme: SubdivisionScheme, values: &[f64]) -> Option<[(f64, f64); 2]> {
    let count = ring.fans.len();
    let child = scheme.child_at(ring, corner);
    let below: Vec<f64> = child.stencils.iter().map(|stencil| stencil.apply(values)).collect();
    let edge = |towards: usize, is_next: bool| -> Option<(f64, f64)> {
        let at = |stencil: &Stencil| stencil.apply(values);
        Some(match scheme {
            SubdivisionScheme::CatmullClark => {
                let far = bicubic::regular_corner(ring, towards)?;
                let half = bicubic::regular_corner(&child.ring, towards)?.point.apply(&below);
                let back = if is_next { &far.previous } else { &far.next };
                let end = at(&far.point);
                ((8.0 * half - 3.0 * at(back) - end) / 3.0, end)
            }
            SubdivisionScheme::Loop(_) => {
                let far = quartic::regular_corner(ring, towards)?;
                let half = quartic::regular_corner(&child.ring, towards)?.point.apply(&below);
                let (back, middle) = if is_next {
                    (&far.previous, &far.previous_middle)
                } else {
                    (&far.next, &far.next_middle)
                };
                let end = at(&far.point);
                ((16.0 * half - 6.0 * at(middle) - 4.0 * at(back) - end) / 4.0, end)
            }
        })
    };
    Some([
        edge((corner + 1) % count, true)?,
        edge((corner + count - 1) % count, false)?,
    ])
}

/// The vertices of a ring in an order that depends on its shape alone.
fn canonical(ring: &Ring) -> Vec<u32> {
    let mut seen = vec![false; ring.vertex_count];
    let mut order = Vec::with_capacity(ring.vertex_count);
    let mut visit = |face: u32, from: u32| {
        for k in 0..ring.faces[face as usize].len() {
            let vertex = ring.vertex_after(face, from, k);
            if !std::mem::replace(&mut seen[vertex as usize], true) {
                order.push(vertex);
            }
        }
    };
    visit(0, ring.faces[0][0]);
    for fan in &ring.fans {
        let start = if fan.is_closed() { fan.own } else { 0 };
        for k in 0..fan.faces.len() {
            visit(fan.faces[(start + k) % fan.faces.len()], fan.vertex);
        }
    }
    order
}
