//! Distances to segments and triangles.

use glam::DVec3;

/// Distance from a point to the segment between a and b.
pub(crate) fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let length = ab.length_squared();
    let t = if length > 0.0 {
        ((p - a).dot(ab) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + ab * t)
}

/// Distance from a point to a triangle.
pub(crate) fn distance_to_triangle(p: DVec3, triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    height_over_triangle(p, triangle).unwrap_or_else(|| {
        distance_to_segment(p, a, b)
            .min(distance_to_segment(p, b, c))
            .min(distance_to_segment(p, c, a))
    })
}

/// Distance from a point to a triangle that it is above or below; `None` beside the triangle.
pub(crate) fn height_over_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    if area > 0.0 {
        // Barycentric coordinates of the foot of the perpendicular (Ericson 2005, section 3.4).
        let wb = ap.cross(ac).dot(normal) / area;
        let wc = ab.cross(ap).dot(normal) / area;
        if wb >= 0.0 && wc >= 0.0 && wb + wc <= 1.0 {
            return Some(ap.dot(normal).abs() / area.sqrt());
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_feature_of_a_triangle_may_be_face_edge_or_corner() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(distance_to_triangle(DVec3::new(0.25, 0.25, -2.0), triangle), 2.0);
        assert_eq!(distance_to_triangle(DVec3::new(0.5, -3.0, 4.0), triangle), 5.0);
        assert_eq!(distance_to_triangle(DVec3::new(-3.0, -4.0, 0.0), triangle), 5.0);
        assert_eq!(
            distance_to_triangle(DVec3::new(2.0, 1.0, 0.0), [DVec3::ZERO, DVec3::X, DVec3::X]),
            2.0_f64.sqrt()
        );
    }
}
