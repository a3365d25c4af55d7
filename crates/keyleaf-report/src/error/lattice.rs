//! Where a triangle is sampled.

/// A sample of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LatticePoint {
    /// Barycentric weights of the corners; they sum to 1.
    pub weights: [f64; 3],
    /// The part of the area that it stands for; they sum to 1 over the lattice.
    pub area: f64,
}

/// All points that divide the edges in `intervals`, an even number.
///
/// Taken two intervals at a time, the lattice divides the triangle into smaller ones with a point at each corner and each edge's middle.
/// The middles alone integrate squares of linear functions exactly (Strang & Fix, degree 2); the corners, with area 0, are for maxima.
pub(super) fn lattice(intervals: u32) -> Vec<LatticePoint> {
    let n = intervals.max(2);
    let cells = (n / 2).pow(2);
    let mut points = Vec::with_capacity(((n + 1) * (n + 2) / 2) as usize);
    for i in 0..=n {
        for j in 0..=n - i {
            let indices = [n - i - j, i, j];
            let is_corner = indices.iter().all(|index| index.is_multiple_of(2));
            let on_edge = indices.contains(&0);
            let cells_around = if is_corner {
                0
            } else if on_edge {
                1
            } else {
                2
            };
            points.push(LatticePoint {
                weights: indices.map(|index| f64::from(index) / f64::from(n)),
                area: f64::from(cells_around) / f64::from(3 * cells),
            });
        }
    }
    points
}

/// The triangles of the lattice, as indices into its points.
pub(super) fn cells(intervals: u32) -> Vec<[usize; 3]> {
    let n = intervals.max(2) as usize;
    let row = |i: usize| (0..i).map(|i| n + 1 - i).sum::<usize>();
    let mut cells = Vec::with_capacity(n * n);
    for i in 0..n {
        let (this, next) = (row(i), row(i + 1));
        for j in 0..n - i {
            cells.push([this + j, next + j, this + j + 1]);
            if j + 1 < n - i {
                cells.push([next + j, next + j + 1, this + j + 1]);
            }
        }
    }
    cells
}

/// The points along the edges, from corner k to the next, as indices into the lattice.
pub(super) fn along_edges(intervals: u32) -> [Vec<usize>; 3] {
    let n = intervals.max(2) as usize;
    let row = |i: usize| (0..i).map(|i| n + 1 - i).sum::<usize>();
    [
        (0..=n).map(row).collect(),
        (0..=n).map(|t| row(n - t) + t).collect(),
        (0..=n).map(|t| n - t).collect(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_integrate_quadratic_functions_exactly() {
        for intervals in [2, 4, 6] {
            let mean = |f: fn([f64; 3]) -> f64| -> f64 {
                lattice(intervals)
                    .iter()
                    .map(|point| point.area * f(point.weights))
                    .sum()
            };
            assert!((mean(|_| 1.0) - 1.0).abs() < 1e-14);
            assert!((mean(|w| w[1] * w[1]) - 1.0 / 6.0).abs() < 1e-14);
            assert!((mean(|w| w[0] * w[2]) - 1.0 / 12.0).abs() < 1e-14);
        }
    }

    #[test]
    fn points_along_an_edge_have_no_weight_of_the_corner_across_it() {
        let points = lattice(6);
        for (k, along) in along_edges(6).into_iter().enumerate() {
            let weight =
                |corner: usize| -> Vec<f64> { along.iter().map(|&i| points[i].weights[corner % 3] * 6.0).collect() };
            assert_eq!(weight(k), [6.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.0]);
            assert_eq!(weight(k + 2), [0.0; 7]);
        }
    }

    #[test]
    fn cells_tile_the_triangle() {
        let points = lattice(6);
        assert_eq!((points.len(), cells(6).len()), (28, 36));
        for [a, b, c] in cells(6) {
            let [a, b, c] = [a, b, c].map(|i| glam::DVec2::new(points[i].weights[1], points[i].weights[2]));
            assert!(((b - a).perp_dot(c - a) - 1.0 / 36.0).abs() < 1e-14);
        }
    }
}
