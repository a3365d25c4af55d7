//! Bicubic Bézier patches of cells of a Catmull-Clark surface: exact where the cell is regular, else terminal.
//!
//! A corner determines the four control points of its quarter. At a regular corner they follow from the B-spline about it, which gives
//! position, derivatives and mixed derivative. At others: the limit position; points in the limit tangent plane, so far out that the edges
//! are right halfway ([`Spectra`]); and the inner point that makes the middle of the patch right.

use super::bspline;
use super::limit::limit;
use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::spectrum::Spectra;
use super::stencil::Stencil;
use super::{Creasing, SubdivisionScheme, catmull_clark};

/// Control points of a patch, u fastest.
pub const CONTROL_POINTS: usize = 16;

/// The part of (3/8)² = B₁(1/2)² that an inner control point has in the middle.
const INNER_SHARE: f64 = 9.0 / 64.0;

/// The control points of a quarter of a patch.
#[derive(Clone, Debug)]
pub struct CornerNet {
    /// At the corner.
    pub point: Stencil,
    /// Beside it, towards the next corner.
    pub next: Stencil,
    /// Beside it, towards the previous corner.
    pub previous: Stencil,
    /// The inner one.
    pub inner: Stencil,
}

/// The quarter of a corner where the surface is a B-spline.
pub fn regular_corner(ring: &Ring, corner: usize) -> Option<CornerNet> {
    let block = bspline::block(ring, corner)?;
    let vertex = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
    let third = [0.0, 2.0 / 3.0, 1.0 / 3.0];
    let sum = |along: [f64; 3], up: [f64; 3]| {
        let terms = block.iter().zip(up);
        Stencil::sum(terms.flat_map(|(row, up)| row.iter().zip(along).map(move |(point, along)| (point, along * up))))
    };
    Some(CornerNet {
        point: sum(vertex, vertex),
        next: sum(third, vertex),
        previous: sum(vertex, third),
        inner: sum(third, third),
    })
}

/// The control points of a regular cell.
pub fn regular(ring: &Ring) -> Option<Vec<Stencil>> {
    let corner = |corner| regular_corner(ring, corner);
    Some(assembled([corner(0)?, corner(1)?, corner(2)?, corner(3)?]))
}

fn assembled([a, b, c, d]: [CornerNet; 4]) -> Vec<Stencil> {
    vec![
        a.point, a.next, b.previous, b.point, //
        a.previous, a.inner, b.inner, b.next, //
        d.next, d.inner, c.inner, c.previous, //
        d.point, d.previous, c.next, c.point,
    ]
}

/// The control points of a cell that is not refined any further: all faces quads, all corners settled.
pub fn terminal(ring: &Ring, spectra: &mut Spectra) -> Option<Vec<Stencil>> {
    let regular = [0, 1, 2, 3].map(|corner| regular_corner(ring, corner));
    let samples = Samples::new(ring);
    let mut nets = Vec::with_capacity(4);
    for (corner, net) in regular.iter().enumerate() {
        nets.push(match net {
            Some(net) => net.clone(),
            None => irregular_corner(ring, corner, &regular, &samples, spectra)?,
        });
    }
    let nets = <[CornerNet; 4]>::try_from(nets).ok()?;
    let is_irregular = regular.each_ref().map(Option::is_none);
    let count = is_irregular.iter().filter(|&&is| is).count() as f64;
    let mut points = assembled(nets);
    // What is missing in the middle, shared by the inner points that are free.
    let weights = [0.125, 0.375, 0.375, 0.125];
    let terms = points
        .iter()
        .enumerate()
        .map(|(k, point)| (point, -weights[k % 4] * weights[k / 4]));
    let missing = Stencil::sum(terms.chain([(&samples.middle, 1.0)]));
    for (place, _) in [5, 6, 10, 9].into_iter().zip(is_irregular).filter(|&(_, is)| is) {
        points[place] = Stencil::sum([(&points[place], 1.0), (&missing, 1.0 / (INNER_SHARE * count))]);
    }
    Some(points)
}

/// Exact points of a cell.
struct Samples {
    /// Of the middles of the edges from every corner to the next.
    edges: [Stencil; 4],
    middle: Stencil,
}

impl Samples {
    fn new(ring: &Ring) -> Self {
        let children = [0, 2].map(|corner| catmull_clark::child(ring, corner, Creasing::Uniform));
        let point = |child: usize, corner: usize| {
            let child = &children[child];
            let net = regular_corner(&child.ring, corner);
            let point = net.map_or_else(|| Stencil::of(child.ring.fans[corner].vertex), |net| net.point);
            child.over_parent(&point)
        };
        Self {
            edges: [point(0, 1), point(1, 1), point(1, 3), point(0, 3)],
            middle: point(0, 2),
        }
    }
}

fn irregular_corner(
    ring: &Ring,
    corner: usize,
    regular: &[Option<CornerNet>; 4],
    samples: &Samples,
    spectra: &mut Spectra,
) -> Option<CornerNet> {
    let sector = Sector::of(&ring.fans[corner])?;
    let scheme = SubdivisionScheme::CatmullClark;
    let own_limit = limit(ring, &sector, scheme);
    let position = match &own_limit {
        Some(limit) => limit.position.clone(),
        None => scheme.limit_by_refinement(ring, corner),
    };
    let reach = spectra.reach(ring, corner, &sector);
    let (next_corner, previous_corner) = ((corner + 1) % 4, (corner + 3) % 4);
    let edge = |k: usize| {
        let place = sector.own + k;
        let is_sharp = !sector.is_closed() && (place == 0 || place == sector.faces.len());
        if is_sharp && matches!(sector.kind, SectorKind::Crease | SectorKind::Corner) {
            return Stencil(vec![(sector.vertex, 2.0 / 3.0), (sector.spoke(place), 1.0 / 3.0)]);
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
                let back = [&far.previous, &far.next][k];
                Stencil::sum([
                    (half, 8.0 / 3.0),
                    (&position, -1.0 / 3.0),
                    (back, -1.0),
                    (&far.point, -1.0 / 3.0),
                ])
            }
            None => Stencil::sum([(&position, 1.0 / 3.0), (half, 2.0 / 3.0)]),
        }
    };
    let (next, previous) = (edge(0), edge(1));
    let inner = Stencil::sum([(&next, 1.0), (&previous, 1.0), (&position, -1.0)]);
    Some(CornerNet {
        point: position,
        next,
        previous,
        inner,
    })
}
