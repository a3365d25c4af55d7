//! Second derivatives against differences of the first ones, and bounds of both against samples.

use super::bezier_net::BezierNet;
use super::evaluation::{KsQuad, PatchJet};
use super::span::Fraction;
use super::{BasisMethod, NurbsSurface};
use glam::DVec3;

/// Surfaces of several degrees with very different weights.
fn surfaces() -> Vec<NurbsSurface> {
    let mut state = 1u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let degrees = [[1, 1], [1, 2], [2, 3], [4, 5], [7, 3]];
    let surface = |degree: [u32; 2]| {
        let knots = degree.map(|p| [vec![0.0; p as usize + 1], vec![0.6], vec![1.0; p as usize + 1]].concat());
        let count = (degree[0] as usize + 2) * (degree[1] as usize + 2);
        let points = (0..count).map(|_| DVec3::new(random(), random(), random())).collect();
        let weights = (0..count).map(|_| 10f64.powf(2.0 * random() - 1.0)).collect();
        NurbsSurface::new(degree, knots, points, weights).expect("a surface")
    };
    degrees.into_iter().map(surface).collect()
}

fn for_every_quad(mut check: impl FnMut(&KsQuad<'_>)) {
    for surface in &surfaces() {
        let [us, vs] = surface.spans();
        for spans in us.iter().flat_map(|u| vs.iter().map(move |v| [u, v])) {
            let method = BasisMethod::Triangular;
            check(&KsQuad { surface, spans, method });
        }
    }
}

fn jet(quad: &KsQuad<'_>, u: f64, v: f64) -> PatchJet {
    quad.jet([Fraction::new(u), Fraction::new(v)])
}

#[test]
fn second_derivatives_are_those_of_the_first() {
    for_every_quad(|quad| {
        for [u, v] in [[0.3, 0.6], [0.5, 0.1], [0.9, 0.8]] {
            let step = 1e-6;
            let [west, east] = [u - step, u + step].map(|u| jet(quad, u, v));
            let [south, north] = [v - step, v + step].map(|v| jet(quad, u, v));
            let here = jet(quad, u, v);
            for (numeric, exact) in [
                (east.du - west.du, here.duu),
                (east.dv - west.dv, here.duv),
                (north.du - south.du, here.duv),
                (north.dv - south.dv, here.dvv),
            ] {
                let numeric = numeric / (2.0 * step);
                assert!(
                    numeric.distance(exact) < 1e-5 * (1.0 + exact.length()),
                    "{numeric} {exact}"
                );
            }
        }
    });
}

#[test]
fn bounds_of_parts_hold_the_derivatives_and_are_close_to_them() {
    const DEPTH: u32 = 5;
    let side = 1u32 << DEPTH;
    let mut closest = [0.0f64; 5];
    for_every_quad(|quad| {
        let parts = BezierNet::of(quad).parts(DEPTH);
        for (part, cell) in parts.iter().zip(0..) {
            let bounds = part.bounds(1.0 / f64::from(side));
            for [x, y] in [[0.0, 0.0], [0.5, 0.5], [1.0, 0.3]] {
                let at = |k: u32, x: f64| (f64::from(k) + x) / f64::from(side);
                let jet = jet(quad, at(cell % side, x), at(cell / side, y));
                let lengths = [jet.du, jet.dv, jet.duu, jet.duv, jet.dvv].map(|d| d.length());
                let all = bounds.first.into_iter().chain(bounds.second);
                for (k, (length, bound)) in lengths.into_iter().zip(all).enumerate() {
                    assert!(length <= bound * (1.0 + 1e-9) + 1e-12, "{k}: {length} {bound}");
                    closest[k] = closest[k].max(length / bound.max(1e-12));
                }
            }
        }
    });
    assert!(closest.iter().all(|&ratio| ratio > 0.8), "{closest:?}");
}
