//! Quartic Bézier triangles of cells of a Loop surface: exact where the cell is regular, else terminal.
//!
//! At a regular corner the box spline gives all derivatives up to the second, and so the six control points about it. At others: the limit
//! position; points in the limit tangent plane, so far out that the edges are right halfway ([`Spectra`]); and the inner point that makes
//! a point inside right.

use super::box_spline::{self, EXPONENTS};
use super::limit::limit;
use super::loop_scheme::{self, Part};
use super::refinement::Child;
use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::spectrum::Spectra;
use super::stencil::Stencil;
use super::{Creasing, SubdivisionScheme};
use crate::LoopWeights;

/// Control points of a patch, in the order of [`EXPONENTS`].
pub const CONTROL_POINTS: usize = 15;

/// The Bernstein polynomials of an inner control point where its corner has the weight 1/2 and the others 1/4, and of the other two there.
const INNER: [f64; 2] = [3.0 / 16.0, 3.0 / 32.0];

/// The control points about a corner.
#[derive(Clone, Debug)]
pub struct CornerNet {
    /// At the corner.
    pub point: Stencil,
    /// Beside it, towards the next corner.
    pub next: Stencil,
    /// Beside it, towards the previous corner.
    pub previous: Stencil,
    /// In the middle of the edge to the next corner.
    pub next_middle: Stencil,
    /// In the middle of the edge to the previous corner.
    pub previous_middle: Stencil,
    /// The inner one.
    pub inner: Stencil,
}

/// The coefficient of a Bernstein polynomial.
pub fn multinomial([i, j, k]: [usize; 3]) -> f64 {
    let factorial = |n: usize| (1..=n).map(|x| x as f64).product::<f64>();
    24.0 / (factorial(i) * factorial(j) * factorial(k))
}

/// The place of a control point.
pub fn place(exponents: [usize; 3]) -> usize {
    let [_, j, k] = exponents;
    j + k * (11 - k) / 2
}

/// The control points about a corner where the surface is a box spline.
pub fn regular_corner(ring: &Ring, corner: usize) -> Option<CornerNet> {
    let about = box_spline::neighbours(ring, corner)?;
    let own = Stencil::of(ring.fans[corner].vertex);
    let basis = box_spline::basis();
    let control = |exponents: [usize; 3]| {
        let place = place(exponents);
        let scale = 12.0 * multinomial(exponents);
        // Of the control points of a cell: corner 0, its neighbours in their order.
        let points = [0, 1, 2, 3, 4, 5, 6].map(|point| basis[point][place] / scale);
        Stencil::sum([&own].into_iter().chain(&about).zip(points))
    };
    Some(CornerNet {
        point: control([4, 0, 0]),
        next: control([3, 1, 0]),
        previous: control([3, 0, 1]),
        next_middle: control([2, 2, 0]),
        previous_middle: control([2, 0, 2]),
        inner: control([2, 1, 1]),
    })
}

/// The control points of a regular cell.
pub fn regular(ring: &Ring) -> Option<Vec<Stencil>> {
    let corner = |corner| regular_corner(ring, corner);
    Some(assembled([corner(0)?, corner(1)?, corner(2)?]))
}

fn assembled(corners: [CornerNet; 3]) -> Vec<Stencil> {
    let mut points = vec![Stencil::default(); CONTROL_POINTS];
    for (corner, net) in corners.into_iter().enumerate() {
        let mut set = |exponents: [usize; 3], stencil: Stencil| {
            points[place([0, 1, 2].map(|k| exponents[(k + 3 - corner) % 3]))] = stencil;
        };
        set([4, 0, 0], net.point);
        set([3, 1, 0], net.next);
        set([3, 0, 1], net.previous);
        set([2, 2, 0], net.next_middle);
        set([2, 1, 1], net.inner);
    }
    points
}

/// The control points of a cell that is not refined any further, with settled corners.
pub fn terminal(ring: &Ring, weights: LoopWeights, spectra: &mut Spectra) -> Option<Vec<Stencil>> {
    let regular = [0, 1, 2].map(|corner| regular_corner(ring, corner));
    let samples = Samples::new(ring, weights);
    let mut nets = Vec::with_capacity(3);
    for (corner, net) in regular.iter().enumerate() {
        nets.push(match net {
            Some(net) => net.clone(),
            None => irregular_corner(ring, corner, weights, &regular, &samples, spectra)?,
        });
    }
    let mut nets = <[CornerNet; 3]>::try_from(nets).ok()?;
    for corner in 0..3 {
        set_edge(ring, corner, &regular, &samples, &mut nets);
    }
    let free: Vec<usize> = (0..3).filter(|&corner| regular[corner].is_none()).collect();
    let points = assembled(nets.clone());
    // What is missing at the sample of every free inner point; each moves the others' as well.
    let missing: Vec<Stencil> = free
        .iter()
        .map(|&corner| {
            let at = [0, 1, 2].map(|k| if k == corner { 0.5 } else { 0.25 });
            let own = points.iter().zip(EXPONENTS).map(|(point, e)| {
                let monomial: f64 = (0..3).map(|k| f64::powi(at[k], e[k] as i32)).product();
                (point, -multinomial(e) * monomial)
            });
            Stencil::sum(own.chain([(&samples.inner[corner], 1.0)]))
        })
        .collect();
    let [own, other] = INNER;
    let all = Stencil::sum(
        missing
            .iter()
            .map(|one| (one, 1.0 / (own + other * (free.len() as f64 - 1.0)))),
    );
    for (&corner, missing) in free.iter().zip(&missing) {
        let terms = [
            (&nets[corner].inner, 1.0),
            (missing, 1.0 / (own - other)),
            (&all, -other / (own - other)),
        ];
        nets[corner].inner = Stencil::sum(terms);
    }
    Some(assembled(nets))
}

/// Exact points of a cell.
struct Samples {
    /// Of the middles of the edges from every corner to the next.
    edges: [Stencil; 3],
    /// Where a corner has the weight 1/2 and the others 1/4.
    inner: [Stencil; 3],
}

impl Samples {
    fn new(ring: &Ring, weights: LoopWeights) -> Self {
        let child =
            |ring: &Ring, corner: usize| loop_scheme::child(ring, Part::Corner(corner), weights, Creasing::Uniform);
        let children = [0, 1, 2].map(|corner| child(ring, corner));
        let inner = |corner: usize| {
            let outer = &children[corner];
            let small = child(&outer.ring, (corner + 1) % 3);
            outer.over_parent(&small.over_parent(&corner_limit(&small, (corner + 2) % 3)))
        };
        Self {
            edges: [0, 1, 2]
                .map(|corner| children[corner].over_parent(&corner_limit(&children[corner], (corner + 1) % 3))),
            inner: [0, 1, 2].map(inner),
        }
    }
}

/// The limit of a regular corner of a child, over the vertices of the child.
fn corner_limit(child: &Child, corner: usize) -> Stencil {
    let net = regular_corner(&child.ring, corner);
    net.map_or_else(|| Stencil::of(child.ring.fans[corner].vertex), |net| net.point)
}

/// The ends of the cubic curve of a sharp edge, from a corner that moves along it or stays.
fn sharp_edge(sector: &Sector, place: usize) -> Option<[Stencil; 2]> {
    let is_end = !sector.is_closed() && (place == 0 || place == sector.faces.len());
    let is_sharp = is_end && matches!(sector.kind, SectorKind::Crease | SectorKind::Corner);
    let part = |own: f64| Stencil(vec![(sector.vertex, own / 3.0), (sector.spoke(place), 1.0 - own / 3.0)]);
    is_sharp.then(|| [part(2.0), part(1.0)])
}

fn irregular_corner(
    ring: &Ring,
    corner: usize,
    weights: LoopWeights,
    regular: &[Option<CornerNet>; 3],
    samples: &Samples,
    spectra: &mut Spectra,
) -> Option<CornerNet> {
    let sector = Sector::of(&ring.fans[corner])?;
    let scheme = SubdivisionScheme::Loop(weights);
    let own_limit = limit(ring, &sector, scheme);
    let position = match &own_limit {
        Some(limit) => limit.position.clone(),
        None => scheme.limit_by_refinement(ring, corner),
    };
    let reach = spectra.reach(ring, corner, &sector);
    let (next_corner, previous_corner) = ((corner + 1) % 3, (corner + 2) % 3);
    let edge = |k: usize| {
        if let Some([near, _]) = sharp_edge(&sector, sector.own + k) {
            return Stencil::sum([(&position, 0.25), (&near, 0.75)]);
        }
        if let (Some(reach), Some(limit)) = (reach, &own_limit) {
            let [first, second] = &limit.tangents;
            return Stencil::sum([(&position, 1.0), (first, reach[k][0]), (second, reach[k][1])]);
        }
        let (half, far) = [
            (&samples.edges[corner], &regular[next_corner]),
            (&samples.edges[previous_corner], &regular[previous_corner]),
        ][k];
        match far {
            Some(far) => {
                let [back, middle] = [[&far.previous, &far.previous_middle], [&far.next, &far.next_middle]][k];
                Stencil::sum([
                    (half, 4.0),
                    (&position, -0.25),
                    (middle, -1.5),
                    (back, -1.0),
                    (&far.point, -0.25),
                ])
            }
            None => Stencil::sum([(&position, 0.5), (half, 0.5)]),
        }
    };
    let (next, previous) = (edge(0), edge(1));
    let inner = Stencil::sum([(&next, 1.0), (&previous, 1.0), (&position, -1.0)]);
    Some(CornerNet {
        point: position,
        next_middle: next.clone(),
        previous_middle: previous.clone(),
        next,
        previous,
        inner,
    })
}

/// The control point in the middle of the edge from a corner: that of a regular end; else so that the edge is right halfway.
fn set_edge(
    ring: &Ring,
    corner: usize,
    regular: &[Option<CornerNet>; 3],
    samples: &Samples,
    nets: &mut [CornerNet; 3],
) {
    let next = (corner + 1) % 3;
    if regular[corner].is_some() {
        return;
    }
    let sharp = Sector::of(&ring.fans[corner]).and_then(|sector| sharp_edge(&sector, sector.own));
    nets[corner].next_middle = match (sharp, &regular[next]) {
        (_, Some(far)) => far.previous_middle.clone(),
        (Some([near, far]), _) => Stencil::sum([(&near, 0.5), (&far, 0.5)]),
        _ => Stencil::sum([
            (&samples.edges[corner], 16.0 / 6.0),
            (&nets[corner].point, -1.0 / 6.0),
            (&nets[corner].next, -4.0 / 6.0),
            (&nets[next].previous, -4.0 / 6.0),
            (&nets[next].point, -1.0 / 6.0),
        ]),
    };
}
