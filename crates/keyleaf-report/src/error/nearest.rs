//! The point of a triangle that is nearest to another.

use glam::DVec3;

/// The squared distance to a triangle, which may have shrunk to a segment or a point (Ericson, Real-Time Collision Detection, 5.1.5).
pub(super) fn distance_squared(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    let to_edges = || {
        let [x, y, z] = [[a, b], [b, c], [c, a]].map(|edge| segment_distance_squared(p, edge));
        x.min(y).min(z)
    };
    // Twice the areas of the parts beside p's projection, over the whole.
    let v = ap.cross(ac).dot(normal);
    let w = ab.cross(ap).dot(normal);
    let is_above = v >= 0.0 && w >= 0.0 && v + w <= area;
    if is_above && area > 0.0 {
        let height = ap.dot(normal);
        return height * height / area;
    }
    to_edges()
}

/// The squared distance to a segment.
pub(super) fn segment_distance_squared(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 {
        ((p - a).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance_squared(a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_to_inside_edge_corner_and_sliver_are_exact() {
        let t = [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0];
        let at = |x, y, z| distance_squared(DVec3::new(x, y, z), t);
        assert_eq!(
            [at(0.5, 0.5, 3.0), at(1.0, -2.0, 0.0), at(-3.0, -4.0, 0.0)],
            [9.0, 4.0, 25.0]
        );
        assert!((at(2.0, 2.0, 0.0) - 2.0).abs() < 1e-15);
        let sliver = [DVec3::ZERO, DVec3::X, DVec3::X];
        assert_eq!(distance_squared(DVec3::new(0.5, 2.0, 0.0), sliver), 4.0);
        assert_eq!(distance_squared(DVec3::Y, [DVec3::ZERO; 3]), 1.0);
    }
}
