//! Convexity test and ear clipping of n-gons.
//!
//! A face of `keyleaf` is a fan of roots about its centre, which is only right for a convex polygon. A polygon that
//! is not convex in its mean plane (Newell's normal) is cut into triangles by ear clipping, after Meisters, *Polygons
//! have ears* (1975); of the ears at hand the one with the best shape is cut. Time O(n²), at least O(n) memory.

use glam::{DVec2, DVec3};

/// Sine of the largest inward turn of a polygon that still counts as convex: what rounding to some six digits in a
/// text file does to a corner of 180°.
const CONVEX_TOLERANCE: f64 = 1e-3;

/// Newell's normal: the vector area of a closed polygon times 2; zero for one without area.
pub fn newell_normal(points: &[DVec3]) -> DVec3 {
    let Some(&origin) = points.first() else {
        return DVec3::ZERO;
    };
    (0..points.len())
        .map(|i| (points[i] - origin).cross(points[(i + 1) % points.len()] - origin))
        .sum()
}

/// The polygon in its mean plane, centred and scaled to size 1, seen so that it runs anticlockwise; `None` if it has
/// no area.
fn flatten(points: &[DVec3]) -> Option<Vec<DVec2>> {
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    let size = points
        .iter()
        .map(|&p| (p - centre).abs().max_element())
        .fold(0.0, f64::max);
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let scaled: Vec<DVec3> = points.iter().map(|&p| (p - centre) / size).collect();
    let normal = newell_normal(&scaled);
    if normal.length() < 1e-12 {
        return None;
    }
    let (x, y) = normal.normalize().any_orthonormal_pair();
    Some(scaled.iter().map(|p| DVec2::new(p.dot(x), p.dot(y))).collect())
}

/// Twice the signed area of a triangle, positive if it runs anticlockwise.
fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether the fan about the centroid covers the polygon once and no corner turns inwards. Triangles always are.
pub fn is_convex(points: &[DVec3]) -> bool {
    if points.len() <= 3 {
        return true;
    }
    let Some(flat) = flatten(points) else { return false };
    let count = flat.len();
    let mut winding = 0.0;
    for i in 0..count {
        let (a, b, c) = (flat[i], flat[(i + 1) % count], flat[(i + 2) % count]);
        let (before, after) = (b - a, c - b);
        if before.perp_dot(after) < -CONVEX_TOLERANCE * before.length() * after.length() {
            return false;
        }
        // The centroid is the origin.
        if a.perp_dot(b) <= 0.0 {
            return false;
        }
        winding += a.perp_dot(b).atan2(a.dot(b));
    }
    winding < 3.0 * std::f64::consts::PI
}

/// Cuts a polygon into triangles with its own corners: at most n - 2 triples of positions in `points`, with the
/// polygon's orientation.
///
/// `vertices` are the names of the corners: a polygon may pass through one vertex twice, and no triangle with two
/// equal names comes out. A diagonal between two names for which `taken` is true is avoided where there is a choice,
/// since it would make an edge with three faces.
pub fn triangulate(points: &[DVec3], vertices: &[u32], mut taken: impl FnMut(u32, u32) -> bool) -> Vec<[usize; 3]> {
    let count = points.len().min(vertices.len());
    let mut triangles = Vec::with_capacity(count.saturating_sub(2));
    let distinct =
        |[a, b, c]: [usize; 3]| vertices[a] != vertices[b] && vertices[b] != vertices[c] && vertices[c] != vertices[a];
    let Some(flat) = flatten(&points[..count]) else {
        triangles.extend((2..count).map(|i| [0, i - 1, i]).filter(|&t| distinct(t)));
        return triangles;
    };
    let mut rest: Vec<usize> = (0..count).collect();
    let mut quality: Vec<f64> = (0..count).map(|i| ear(&flat, vertices, &rest, i)).collect();
    while rest.len() > 3 {
        let at = best_ear(&rest, &quality, vertices, &mut taken);
        let triangle = around(&rest, at);
        if distinct(triangle) {
            triangles.push(triangle);
        }
        rest.remove(at);
        quality.remove(at);
        let after = at % rest.len();
        let before = (at + rest.len() - 1) % rest.len();
        for i in [before, after] {
            quality[i] = ear(&flat, vertices, &rest, i);
        }
    }
    if let &[a, b, c] = rest.as_slice()
        && distinct([a, b, c])
    {
        triangles.push([a, b, c]);
    }
    triangles
}

/// The corner `rest[i]` with its neighbours.
fn around(rest: &[usize], i: usize) -> [usize; 3] {
    let count = rest.len();
    [rest[(i + count - 1) % count], rest[i], rest[(i + 1) % count]]
}

/// The best ear whose diagonal is free, else the best ear, else the least bad corner.
fn best_ear(rest: &[usize], quality: &[f64], vertices: &[u32], taken: &mut impl FnMut(u32, u32) -> bool) -> usize {
    let mut order: Vec<usize> = (0..rest.len()).collect();
    let best = |order: &[usize]| {
        let better = |a: &&usize, b: &&usize| quality[**a].total_cmp(&quality[**b]);
        order.iter().max_by(better).copied()
    };
    let first = best(&order).unwrap_or(0);
    // Looking for a free diagonal costs a sort only where the best one is taken.
    let [a, _, c] = around(rest, first);
    if quality[first] <= 0.0 || !taken(vertices[a], vertices[c]) {
        return first;
    }
    order.sort_by(|&a, &b| quality[b].total_cmp(&quality[a]));
    order
        .into_iter()
        .take_while(|&i| quality[i] > 0.0)
        .find(|&i| {
            let [a, _, c] = around(rest, i);
            !taken(vertices[a], vertices[c])
        })
        .unwrap_or(first)
}

/// How good an ear the corner `rest[i]` is: twice the area over the square of the longest side if it is an ear, a
/// number at most 0 if it is none.
fn ear(flat: &[DVec2], vertices: &[u32], rest: &[usize], i: usize) -> f64 {
    let triangle = around(rest, i);
    let [a, b, c] = triangle.map(|k| flat[k]);
    let names = triangle.map(|k| vertices[k]);
    let longest = (b - a)
        .length_squared()
        .max((c - b).length_squared())
        .max((a - c).length_squared());
    let shape = if longest > 0.0 { orient(a, b, c) / longest } else { 0.0 };
    if names[0] == names[2] {
        // Cutting here closes a slit of no area.
        return 0.0;
    }
    if shape <= 0.0 {
        return shape;
    }
    let blocked = rest.iter().any(|&k| {
        let p = flat[k];
        !names.contains(&vertices[k])
            && p != a
            && p != b
            && p != c
            && orient(a, b, p) >= 0.0
            && orient(b, c, p) >= 0.0
            && orient(c, a, p) >= 0.0
    });
    if blocked { -2.0 + shape } else { shape }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ring(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    }

    fn area(points: &[DVec3], triangles: &[[usize; 3]]) -> f64 {
        let twice = |t: &[usize; 3]| newell_normal(&t.map(|i| points[i])).z;
        triangles.iter().map(twice).sum::<f64>() / 2.0
    }

    fn names(points: &[DVec3]) -> Vec<u32> {
        (0..points.len() as u32).collect()
    }

    #[test]
    fn convex_polygons_with_straight_corners_are_kept() {
        let square = ring(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert!(is_convex(&square));
    }

    #[test]
    fn darts_stars_and_double_loops_are_not_convex() {
        let dart = ring(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]]);
        assert!(!is_convex(&dart));
        let turn = |i: i32| (f64::from(i) * 144.0).to_radians();
        let pentagram: Vec<_> = (0..5).map(|i| [turn(i).cos(), turn(i).sin()]).collect();
        assert!(!is_convex(&ring(&pentagram)));
        assert!(!is_convex(&ring(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])));
    }

    #[test]
    fn concave_polygon_is_covered_once_without_turned_triangles() {
        let comb = ring(&[
            [0., 0.],
            [5., 0.],
            [5., 3.],
            [4., 1.],
            [3., 3.],
            [2., 1.],
            [1., 3.],
            [0., 1.],
        ]);
        let triangles = triangulate(&comb, &names(&comb), |_, _| false);
        assert_eq!(triangles.len(), 6);
        for t in &triangles {
            assert!(newell_normal(&t.map(|i| comb[i])).z > 0.0, "{t:?} is turned");
        }
        let whole = newell_normal(&comb).z / 2.0;
        assert!((area(&comb, &triangles) - whole).abs() < 1e-12);
    }

    #[test]
    fn taken_diagonals_are_avoided() {
        // An L-shape: whatever is cut, the diagonal 0-4 must not appear.
        let shape = ring(&[[0., 0.], [4., 0.], [4., 1.], [1., 1.], [1., 4.], [0., 4.]]);
        let triangles = triangulate(&shape, &names(&shape), |a, b| (a.min(b), a.max(b)) == (0, 4));
        let has = |t: &[usize; 3]| t.contains(&0) && t.contains(&4) && !t.contains(&5);
        assert_eq!(triangles.len(), 4);
        assert!(!triangles.iter().any(has));
    }

    #[test]
    fn pinched_polygons_give_no_triangle_with_a_repeated_vertex() {
        // Two triangles that touch at one vertex, run through as one polygon.
        let points = ring(&[[0., 0.], [1., -1.], [1., 1.], [0., 0.], [-1., 1.], [-1., -1.]]);
        let triangles = triangulate(&points, &[0, 1, 2, 0, 3, 4], |_, _| false);
        let whole = newell_normal(&points).z / 2.0;
        assert!((area(&points, &triangles) - whole).abs() < 1e-12, "{triangles:?}");
        assert_eq!(triangles.len(), 2);
    }

    proptest! {
        #[test]
        fn star_shaped_polygons_are_covered_once(
            radii in prop::collection::vec(0.2f64..3.0, 4..40),
            tilt in -1.0f64..1.0,
        ) {
            let step = std::f64::consts::TAU / radii.len() as f64;
            let points: Vec<DVec3> = radii
                .iter()
                .enumerate()
                .map(|(i, r)| {
                    let (y, x) = (i as f64 * step).sin_cos();
                    DVec3::new(r * x, r * y, tilt * r * x)
                })
                .collect();
            let triangles = triangulate(&points, &names(&points), |_, _| false);
            prop_assert_eq!(triangles.len(), points.len() - 2);
            let normal = newell_normal(&points);
            let mut sum = 0.0;
            for t in &triangles {
                let part = newell_normal(&t.map(|i| points[i])).dot(normal.normalize());
                prop_assert!(part > -1e-9);
                sum += part;
            }
            prop_assert!((sum - normal.length()).abs() < 1e-9 * normal.length());
        }

        #[test]
        fn any_list_of_points_gives_only_distinct_corners(
            points in prop::collection::vec((0i8..4, 0i8..4, 0i8..2), 3..14),
        ) {
            let vertices: Vec<u32> =
                points.iter().map(|&(x, y, z)| x as u32 * 16 + y as u32 * 4 + z as u32).collect();
            let points: Vec<DVec3> = points
                .iter()
                .map(|&(x, y, z)| DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
                .collect();
            for [a, b, c] in triangulate(&points, &vertices, |a, b| (a + b) % 2 == 0) {
                prop_assert!(vertices[a] != vertices[b]);
                prop_assert!(vertices[b] != vertices[c] && vertices[c] != vertices[a]);
            }
        }
    }
}
