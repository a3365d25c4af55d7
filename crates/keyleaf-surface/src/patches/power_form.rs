//! A KSQuad as a polynomial (Concheiro 2.2): coefficients of powers of the distance from its middle.

use super::bezier_net::BezierNet;
use super::evaluation::KsQuad;
use super::span::MAX_ORDER;
use glam::{DVec3, DVec4};

/// Coefficients of w (P − S) and of w, those of u fastest.
pub struct PowerForm {
    /// S: the middle control point, so that coefficients are no longer than the patch.
    pub reference: DVec3,
    pub coefficients: Vec<DVec4>,
}

impl PowerForm {
    /// Of a KSQuad, with weights over the largest of its surface.
    pub fn of(quad: &KsQuad<'_>) -> Self {
        let net = BezierNet::of(quad);
        let centre = quad
            .control_indices()
            .next()
            .map_or(DVec3::ZERO, |(.., first)| quad.surface.control(first).0);
        let largest_weight = quad.surface.largest_weight();
        let [p, q] = net.degree();
        let controls = net.controls();
        let middle = controls[(p / 2) + (q / 2) * (p + 1)];
        let offset = if middle.w > 0.0 {
            middle.truncate() / middle.w
        } else {
            DVec3::ZERO
        };
        let [along_u, along_v] = [p, q].map(centred_powers);
        let control = |i: usize, j: usize| -> DVec4 {
            let c = controls[i + j * (p + 1)];
            (c.truncate() - offset * c.w).extend(c.w) / largest_weight
        };
        let coefficient = |k: usize, l: usize| -> DVec4 {
            let row = |j: usize| -> DVec4 { (0..=p).map(|i| control(i, j) * along_u[k][i]).sum() };
            (0..=q).map(|j| row(j) * along_v[l][j]).sum()
        };
        let places = (0..=q).flat_map(|l| (0..=p).map(move |k| (k, l)));
        Self {
            reference: centre + offset,
            coefficients: places.map(|(k, l)| coefficient(k, l)).collect(),
        }
    }
}

/// Entry [k][i]: the coefficient of s^k in Bernstein polynomial i of degree p at 1/2 + s.
fn centred_powers(p: usize) -> [[f64; MAX_ORDER]; MAX_ORDER] {
    let mut powers = [[0.0; MAX_ORDER]; MAX_ORDER];
    for i in 0..=p {
        // C(p, i) (1/2 + s)^i (1/2 - s)^(p - i), factor by factor.
        let mut polynomial = [0.0; MAX_ORDER];
        polynomial[0] = binomial(p, i);
        for factor in 0..p {
            let slope = if factor < i { 1.0 } else { -1.0 };
            for k in (0..MAX_ORDER).rev() {
                let below = if k > 0 { polynomial[k - 1] } else { 0.0 };
                polynomial[k] = 0.5 * polynomial[k] + slope * below;
            }
        }
        for (row, coefficient) in powers.iter_mut().zip(polynomial) {
            row[i] = coefficient;
        }
    }
    powers
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bernstein_polynomials_add_up_to_one_and_their_middle_is_known() {
        for p in 1..=7 {
            let powers = centred_powers(p);
            for (k, row) in powers.iter().enumerate() {
                let sum: f64 = row.iter().sum();
                assert!(
                    (sum - if k == 0 { 1.0 } else { 0.0 }).abs() < 1e-12,
                    "degree {p}, power {k}: {sum}"
                );
            }
            let middle: f64 = powers[0][p / 2];
            assert!((middle - binomial(p, p / 2) * 0.5f64.powi(p as i32)).abs() < 1e-15);
        }
    }
}
