//! Which settings are not beaten.

/// The points (cost, error) for which no other has at most their cost and at most their error and less of one, by ascending cost. Of
/// equal points the first one counts; points that are not finite never do.
///
/// ```
/// use keyleaf_report::pareto::front;
/// let points = [(1.0, 9.0), (2.0, 4.0), (3.0, 5.0), (4.0, 1.0)];
/// assert_eq!(front(&points), [0, 1, 3]);
/// ```
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let is_finite = |i: &usize| points[*i].0.is_finite() && points[*i].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(is_finite).collect();
    order.sort_by(|a, b| {
        let (a, b) = (points[*a], points[*b]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut least = f64::INFINITY;
    order.retain(|i| {
        let is_better = points[*i].1 < least;
        least = least.min(points[*i].1);
        is_better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn a_point_is_in_the_front_iff_none_beats_it() {
        let number = |i: usize| ((i as f64 * 12.9898).sin() * 43758.5453).rem_euclid(1.0);
        let points: Vec<(f64, f64)> = (0..60)
            .map(|i| ((number(2 * i) * 9.0).floor(), (number(2 * i + 1) * 9.0).floor()))
            .collect();
        let found = front(&points);
        for (i, p) in points.iter().enumerate() {
            let is_beaten = points.iter().enumerate().any(|(j, q)| {
                let is_as_good = q.0 <= p.0 && q.1 <= p.1;
                is_as_good && (q != p || j < i)
            });
            assert_eq!(found.contains(&i), !is_beaten, "{p:?}");
        }
        assert!(found.windows(2).all(|pair| points[pair[0]].0 < points[pair[1]].0));
    }

    #[test]
    fn what_was_not_measured_is_not_in_the_front() {
        let points = [(f64::NAN, 0.0), (1.0, f64::INFINITY), (2.0, 3.0)];
        assert_eq!(front(&points), [2]);
        assert_eq!(front(&[]), [0; 0]);
    }
}
