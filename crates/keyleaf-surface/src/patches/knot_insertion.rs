//! Knots inserted into a curve, which stays as it is (Piegl & Tiller A5.4, after Boehm).

use glam::DVec3;

/// A control point and its weight.
pub type Control = (DVec3, f64);

/// Knots and control points of the same curve with `added` knots more, which ascend and lie within spans of the domain.
pub fn refine(degree: usize, knots: &[f64], controls: &[Control], added: &[f64]) -> (Vec<f64>, Vec<Control>) {
    let (Some(&first), Some(&last)) = (added.first(), added.last()) else {
        return (knots.to_vec(), controls.to_vec());
    };
    let (p, count) = (degree, added.len());
    // Spans before that of the first knot and behind that of the last stay.
    let span_of = |x: f64| knots.partition_point(|&knot| knot <= x) - 1;
    let (start, end) = (span_of(first), span_of(last) + 1);
    let mut refined_knots = vec![0.0; knots.len() + count];
    refined_knots[..=start].copy_from_slice(&knots[..=start]);
    refined_knots[end + p + count..].copy_from_slice(&knots[end + p..]);
    let mut refined = vec![(DVec3::ZERO, 0.0); controls.len() + count];
    refined[..=start - p].copy_from_slice(&controls[..=start - p]);
    refined[end - 1 + count..].copy_from_slice(&controls[end - 1..]);

    // Knots come from the last to the first; `i` and `k` are the places that are filled next, of old knots and of all.
    let (mut i, mut k) = (end + p - 1, end + p - 1 + count);
    for &x in added.iter().rev() {
        while x <= knots[i] && i > start {
            refined[k - p - 1] = controls[i - p - 1];
            refined_knots[k] = knots[i];
            (i, k) = (i - 1, k - 1);
        }
        refined[k - p - 1] = refined[k - p];
        for l in 1..=p {
            let (left, right) = (knots[i + l - p], refined_knots[k + l]);
            let width = right - left;
            let place = k + l - p;
            refined[place - 1] = mean(
                [refined[place - 1], refined[place]],
                [(right - x) / width, (x - left) / width],
            );
        }
        refined_knots[k] = x;
        k -= 1;
    }
    (refined_knots, refined)
}

/// The mean of two homogeneous control points. Positions are mixed apart from weights, from the one that counts for more: those that
/// are equal stay so, and one without weight leaves no trace.
fn mean([(p, w), (q, z)]: [Control; 2], [f, g]: [f64; 2]) -> Control {
    let (w, z) = (f * w, g * z);
    let weight = w + z;
    let (f, g) = if weight > 0.0 { (w / weight, z / weight) } else { (f, g) };
    let position = if f < g { q + (p - q) * f } else { p + (q - p) * g };
    (position, weight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_cut_as_by_de_casteljau() {
        let controls = [(0.0, 1.0), (1.0, 0.5), (4.0, 2.0)].map(|(x, w)| (DVec3::splat(x), w));
        let (knots, cut) = refine(2, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &controls, &[0.5]);
        assert_eq!(knots, [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]);
        let weighted: Vec<(f64, f64)> = cut.iter().map(|(p, w)| (p.x * w, *w)).collect();
        assert_eq!(cut.len(), 4);
        for ((x, w), expected) in weighted
            .into_iter()
            .zip([(0.0, 1.0), (0.25, 0.75), (4.25, 1.25), (8.0, 2.0)])
        {
            assert!((x - expected.0).abs() < 1e-15 && w == expected.1, "{x} {w}");
        }
    }

    #[test]
    fn points_that_are_one_stay_one() {
        let at = DVec3::new(0.1, 0.7, -1e6);
        let controls = [0.3, 1e-7, 0.0, 17.0].map(|w| (at, w));
        let knots = [0.0, 0.1, 0.3, 0.9, 1.1, 1.3, 1.9];
        let (_, cut) = refine(2, &knots, &controls, &[0.35, 0.7, 1.0]);
        assert!(cut.iter().all(|(p, _)| *p == at) && cut.len() == 7);
    }
}
