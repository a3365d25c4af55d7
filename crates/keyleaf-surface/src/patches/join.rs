//! Which boundaries of a model are the same curve, and the model with those boundaries joined.
//!
//! Two boundaries join when degree, knots mapped to 0..=1 and homogeneous control points, up to a common factor of the weights, agree
//! within the tolerance. Those that do not agree to the last digits are snapped, which takes control points of their own: clamped knots
//! on both sides.
//!
//! Where knot spans are to be cut, the surfaces are joined before, so that the same boundaries join, and rounding is removed after it.

use super::boundary::{BoundaryCurve, BoundaryPlace, Difference};
use super::even_spans;
use super::gap::along_each_other;
use super::layout::{Layout, Side};
use super::nurbs_surface::NurbsSurface;
use super::orientation::orient;
use super::report::{Boundary, JoinReport, Unjoined};
use super::weld::Welds;
use glam::DVec3;
use keyleaf_key::HalfEdge;

/// Boundaries are compared when their places along this direction, which no model is aligned with, are the same.
const SWEEP: DVec3 = DVec3::new(0.571_9, 0.312_7, 0.758_3);

/// Two boundaries of the same curve, by their numbers, the smaller first.
#[derive(Clone, Copy, Debug)]
pub struct Join {
    pub boundaries: [usize; 2],
    /// Whether both run the same way, so that one of the surfaces must be transposed.
    pub same_way: bool,
    is_exact: bool,
}

/// A model whose boundaries are joined.
#[derive(Debug)]
pub struct Joined {
    /// The surfaces, some of them transposed, with equal control points where they meet.
    pub surfaces: Vec<NurbsSurface>,
    pub layouts: Vec<Layout>,
    /// Whether each surface was transposed.
    pub transposed: Vec<bool>,
    /// How often the knot spans of each surface were halved, in u and v as they were given.
    pub halvings: Vec<[u32; 2]>,
    /// The half-edges that meet.
    pub pairs: Vec<[HalfEdge; 2]>,
    /// The farthest that the curves of a join are still apart, by knots and weights.
    pub mismatch: f64,
    /// Without the poles, which the topology of the pairs tells.
    pub report: JoinReport,
}

/// Joins the boundaries of a model. The tolerance is relative to the diagonal of its box. With `even_spans`, knot spans are cut.
pub fn join(mut surfaces: Vec<NurbsSurface>, tolerance: f64, even_spans: bool) -> Joined {
    let (low, high) = bounding_box(&surfaces);
    let tolerance = Tolerance {
        relative: tolerance,
        distance: tolerance * high.distance(low),
    };
    let (mut collapsed, mut curves): (Vec<_>, Vec<_>) = boundaries(&surfaces)
        .into_iter()
        .partition(|curve| curve.is_collapsed(tolerance.distance));
    let (joins, crowded) = find_joins(&curves, tolerance);
    let surface_of = |boundary: usize| curves[boundary].place.surface;
    let (transposed, joins, dropped) = orient(surfaces.len(), joins, surface_of);
    let unjoined = unjoined(&curves, &joins, &dropped, &crowded, &surfaces, high.distance(low));

    let mut largest_move = weld(&mut surfaces, &collapsed, &curves, &joins);
    let mut halvings = vec![[0; 2]; surfaces.len()];
    if even_spans {
        let direction = |b: usize| (curves[b].place.surface, curves[b].place.side.along());
        let same = joins.iter().chain(&dropped).map(|join| join.boundaries.map(direction));
        halvings = even_spans::halvings(&surfaces, same);
        for (surface, &halvings) in surfaces.iter_mut().zip(&halvings) {
            *surface = even_spans::cut(surface, halvings);
        }
        let layouts = Layout::of_model(&surfaces);
        for curve in collapsed.iter_mut().chain(&mut curves) {
            let number = curve.place.surface;
            *curve = BoundaryCurve::new(&surfaces[number], &layouts[number], curve.place);
        }
        // What rounding took apart.
        largest_move = largest_move.max(weld(&mut surfaces, &collapsed, &curves, &joins));
    }
    let report = JoinReport {
        exact: joins.iter().filter(|join| join.is_exact).count() as u32,
        snapped: joins.iter().filter(|join| !join.is_exact).count() as u32,
        largest_move,
        unjoined,
        poles: Vec::new(),
        transposed: (0..).zip(&transposed).filter(|(_, is)| **is).map(|(s, _)| s).collect(),
    };
    for (surface, _) in surfaces.iter_mut().zip(&transposed).filter(|(_, is)| **is) {
        *surface = surface.transposed();
    }

    let layouts = Layout::of_model(&surfaces);
    let mut pairs: Vec<[HalfEdge; 2]> = layouts.iter().flat_map(Layout::inner_pairs).collect();
    let mut mismatch: f64 = 0.0;
    for join in &joins {
        let places = join.boundaries.map(|b| place_in(curves[b].place, &transposed));
        let half_edges = places.map(|place| layouts[place.surface].half_edges(place.piece, place.side));
        let [one, other] = &half_edges;
        pairs.extend(one.iter().zip(other.iter().rev()).map(|(&a, &b)| [a, b]));
        let [one, other] =
            places.map(|place| BoundaryCurve::new(&surfaces[place.surface], &layouts[place.surface], place));
        if let Some(rest) = one.difference(&other.reversed()) {
            mismatch = mismatch.max(rest.distance + rest.relative * high.distance(low));
        }
    }
    Joined {
        surfaces,
        layouts,
        transposed,
        halvings,
        pairs,
        mismatch,
        report,
    }
}

#[derive(Clone, Copy)]
struct Tolerance {
    /// Of knots and weights of which the largest are 1.
    relative: f64,
    /// Of positions.
    distance: f64,
}

/// The box of the control points that count.
pub fn bounding_box(surfaces: &[NurbsSurface]) -> (DVec3, DVec3) {
    let controls = surfaces.iter().flat_map(|s| s.points().iter().zip(s.weights()));
    let points = controls.filter(|(_, w)| **w > 0.0).map(|(&p, _)| p);
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    })
}

/// All boundaries of all pieces, in the order of the surfaces.
fn boundaries(surfaces: &[NurbsSurface]) -> Vec<BoundaryCurve> {
    let layouts = Layout::of_model(surfaces);
    let mut curves = Vec::new();
    for (number, (surface, layout)) in surfaces.iter().zip(&layouts).enumerate() {
        let [nu, nv] = [0, 1].map(|axis| layout.runs[axis].len());
        for piece in (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j])) {
            let place = |side| BoundaryPlace {
                surface: number,
                piece,
                side,
            };
            curves.extend(Side::ALL.map(|side| BoundaryCurve::new(surface, layout, place(side))));
        }
    }
    curves
}

/// The joins, first come first served, and whether each boundary that has none has the curve of another.
fn find_joins(curves: &[BoundaryCurve], tolerance: Tolerance) -> (Vec<Join>, Vec<bool>) {
    let place = |index: usize| curves[index].key().dot(SWEEP);
    let mut order: Vec<usize> = (0..curves.len()).collect();
    order.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
    let places: Vec<f64> = order.iter().map(|&index| place(index)).collect();

    let mut is_joined = vec![false; curves.len()];
    let mut is_crowded = vec![false; curves.len()];
    let mut joins = Vec::new();
    for index in 0..curves.len() {
        if is_joined[index] {
            continue;
        }
        let reach = 2.0 * tolerance.distance + 1e-9 * curves[index].largest();
        let window = places.partition_point(|&x| x < place(index) - reach)
            ..places.partition_point(|&x| x <= place(index) + reach);
        let mut others: Vec<usize> = order[window].iter().copied().filter(|&other| other != index).collect();
        others.sort_unstable();
        let matching = others
            .into_iter()
            .find_map(|other| Some((other, compare(&curves[index], &curves[other], tolerance)?)));
        match matching {
            // An earlier one without join is crowded itself.
            Some((other, _)) if is_joined[other] || other < index => is_crowded[index] = true,
            Some((other, (same_way, is_exact))) => {
                joins.push(Join {
                    boundaries: [index, other],
                    same_way,
                    is_exact,
                });
                (is_joined[index], is_joined[other]) = (true, true);
            }
            None => {}
        }
    }
    (joins, is_crowded)
}

/// Whether two boundaries join: whether they run the same way, and whether they are equal up to rounding.
fn compare(a: &BoundaryCurve, b: &BoundaryCurve, tolerance: Tolerance) -> Option<(bool, bool)> {
    let largest = a.largest().max(b.largest());
    let judge = |b: &BoundaryCurve| -> Option<bool> {
        let difference = a.difference(b)?;
        if difference.is_rounding(largest) {
            return Some(true);
        }
        let can_snap = a.corresponding_points(b).next().is_some();
        (can_snap && is_within(difference, tolerance)).then_some(false)
    };
    let against = judge(&b.reversed()).map(|is_exact| (false, is_exact));
    against.or_else(|| judge(b).map(|is_exact| (true, is_exact)))
}

fn is_within(difference: Difference, tolerance: Tolerance) -> bool {
    difference.distance <= tolerance.distance && difference.relative <= tolerance.relative
}

/// Makes the control points of joined boundaries the same, and those of collapsed ones one. The farthest that one was moved.
fn weld(surfaces: &mut [NurbsSurface], collapsed: &[BoundaryCurve], curves: &[BoundaryCurve], joins: &[Join]) -> f64 {
    let mut welds = Welds::new(surfaces);
    for curve in collapsed {
        weld_to_point(&mut welds, curve);
    }
    for join in joins {
        weld_curves(&mut welds, surfaces, join, join.boundaries.map(|b| &curves[b]));
    }
    welds.apply(surfaces)
}

/// Makes the control points of a collapsed boundary one.
fn weld_to_point(welds: &mut Welds, curve: &BoundaryCurve) {
    for pair in curve.own_points().windows(2) {
        welds.unite((curve.place.surface, pair[0]), (curve.place.surface, pair[1]));
    }
}

/// Makes the control points of two boundaries the same; also their weights, up to the common factor, unless rounding is all.
fn weld_curves(welds: &mut Welds, surfaces: &mut [NurbsSurface], join: &Join, [a, b]: [&BoundaryCurve; 2]) {
    let b = if join.same_way { b.clone() } else { b.reversed() };
    let [sa, sb] = [a, &b].map(|curve| curve.place.surface);
    for (i, j) in a.corresponding_points(&b) {
        welds.unite((sa, i), (sb, j));
        if !join.is_exact {
            let weight = surfaces[sa].weights()[i] / a.largest_weight * b.largest_weight;
            surfaces[sb].set_weight(j, weight);
        }
    }
}

/// The place of a boundary after some surfaces have been transposed.
fn place_in(place: BoundaryPlace, transposed: &[bool]) -> BoundaryPlace {
    let BoundaryPlace {
        surface,
        piece: [i, j],
        side,
    } = place;
    if !transposed[surface] {
        return place;
    }
    BoundaryPlace {
        surface,
        piece: [j, i],
        side: side.transposed(),
    }
}

/// The boundaries that are in no join, and why.
fn unjoined(
    curves: &[BoundaryCurve],
    joins: &[Join],
    dropped: &[Join],
    crowded: &[bool],
    surfaces: &[NurbsSurface],
    diagonal: f64,
) -> Vec<(Boundary, Unjoined)> {
    let mut reasons: Vec<Option<Unjoined>> = crowded
        .iter()
        .map(|&is| Some(if is { Unjoined::Crowded } else { Unjoined::Free }))
        .collect();
    joins
        .iter()
        .flat_map(|join| join.boundaries)
        .for_each(|b| reasons[b] = None);
    dropped
        .iter()
        .flat_map(|join| join.boundaries)
        .for_each(|b| reasons[b] = Some(Unjoined::NotOrientable));
    let open: Vec<usize> = (0..curves.len()).filter(|&b| reasons[b].is_some()).collect();
    let open_curves: Vec<&BoundaryCurve> = open.iter().map(|&b| &curves[b]).collect();
    for (&b, is_along) in open.iter().zip(along_each_other(&open_curves, diagonal)) {
        if is_along && reasons[b] == Some(Unjoined::Free) {
            reasons[b] = Some(Unjoined::Apart);
        }
    }
    let named = curves.iter().zip(reasons);
    named
        .filter_map(|(curve, reason)| {
            let BoundaryPlace { surface, side, .. } = curve.place;
            let at = curve.knot(&Layout::new(&surfaces[surface], 0));
            let surface = surface as u32;
            reason.map(|reason| (Boundary { surface, side, at }, reason))
        })
        .collect()
}
