//! Bounds of the roots of a face, from the control points of its patches.
//!
//! Second derivatives grow from patch to patch towards extraordinary vertices; each root has the largest of the patches that it touches.

use super::SubdivisionScheme;
use super::bezier::Slopes;
use super::neighbourhoods::Kind;
use super::tree::{CellPlace, Tree};
use crate::root_bound::RootBound;

impl RootBound {
    /// Of a quad, whose nodes have hypotenuses and diagonals along u and v; those of level 0 have length `length`.
    fn of_square(Slopes { first, second }: Slopes, length: f64) -> Self {
        let half_speed = first[0].max(first[1]) * length / 2.0;
        Self {
            size: half_speed,
            ball: half_speed,
            // Of linear interpolation over a triangle in a square of this length.
            deviation: (second[0] + 2.0 * second[1] + second[2]) * length * length / 8.0,
        }
    }

    /// Of a triangle: hypotenuses run along the mesh edge, medians to the centre, by turns.
    fn of_triangle(Slopes { first, second }: Slopes, directions: [[f64; 2]; 2]) -> Self {
        let speed = |[a, b]: [f64; 2]| a.abs() * first[0] + b.abs() * first[1];
        let curvature = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            (a * c).abs() * second[0] + (a * d + b * c).abs() * second[1] + (b * d).abs() * second[2]
        };
        let [edge, median] = directions;
        let [half_edge, median_speed] = [speed(edge) / 2.0, speed(median)];
        // Nodes are turned by quarters: hypotenuses run along the edge, or along the median and are twice as long.
        let size = half_edge.max(median_speed);
        let along = [edge[0] / 2.0, edge[1] / 2.0];
        Self {
            size,
            ball: size,
            deviation: (curvature(along, along) + 2.0 * curvature(along, median) + curvature(median, median)) / 2.0,
        }
    }
}

/// The derivative bounds of a patch in the parameters of its domain.
pub fn in_domain(own: Slopes, place: CellPlace) -> Slopes {
    let scale = 1.0 / place.right[0].abs();
    Slopes {
        first: own.first.map(|x| x * scale),
        second: own.second.map(|x| x * scale * scale),
    }
}

fn larger(a: Slopes, b: Slopes) -> Slopes {
    Slopes {
        first: [0, 1].map(|k| a.first[k].max(b.first[k])),
        second: [0, 1, 2].map(|k| a.second[k].max(b.second[k])),
    }
}

/// A patch of a domain that a root touches.
#[derive(Clone, Copy, Debug)]
pub struct Touched {
    pub domain: usize,
    pub patch: u32,
    /// Whether the parameters of the domain are those of the root exchanged.
    pub is_turned: bool,
}

/// The patches that a root touches: all bounds of the root are the largest of theirs.
pub fn touched(trees: &[Tree], scheme: SubdivisionScheme, corners: usize, root: usize) -> Vec<Touched> {
    let of = |domain: usize, is_turned: bool, touches: &dyn Fn(CellPlace) -> bool| -> Vec<Touched> {
        let patches = (0..).zip(&trees[domain].places);
        let patches = patches.filter(|(_, place)| touches(**place));
        patches
            .map(|(patch, _)| Touched {
                domain,
                patch,
                is_turned,
            })
            .collect()
    };
    match scheme {
        SubdivisionScheme::Loop(_) => of(0, false, &|place| touches_triangle_root(place, root)),
        SubdivisionScheme::CatmullClark if corners == 4 => of(0, false, &|place| touches_square_root(place, root)),
        SubdivisionScheme::CatmullClark => {
            // Half of two domains, in each other's parameters exchanged.
            let mut all = of(root, false, &|place| place.origin[0] + place.right[0] > place.origin[1]);
            all.extend(of((root + 1) % corners, true, &|place| {
                place.origin[1] + place.up[1] > place.origin[0]
            }));
            all
        }
    }
}

/// The bounds of the roots of a face, taken alone. `slopes` are those of a patch of a domain, in the parameters of the domain.
pub fn of_roots(
    kind: &Kind,
    scheme: SubdivisionScheme,
    slopes: impl Fn(usize, u32, CellPlace) -> Slopes,
) -> Vec<RootBound> {
    let corners = kind.touched.len();
    let domains: Vec<Vec<Slopes>> = kind
        .trees
        .iter()
        .enumerate()
        .map(|(domain, tree)| {
            let patches = (0..).zip(&tree.places);
            patches.map(|(patch, &place)| slopes(domain, patch, place)).collect()
        })
        .collect();
    let of_root = |root: usize| {
        let largest = kind.touched[root].iter().fold(Slopes::default(), |largest, touched| {
            let slopes = domains[touched.domain][touched.patch as usize];
            larger(largest, if touched.is_turned { turned(slopes) } else { slopes })
        });
        match scheme {
            SubdivisionScheme::Loop(_) => RootBound::of_triangle(largest, triangle_directions(root)),
            SubdivisionScheme::CatmullClark => RootBound::of_square(largest, if corners == 4 { 1.0 } else { 2.0 }),
        }
    };
    (0..corners).map(of_root).collect()
}

/// In parameters exchanged.
fn turned(Slopes { first, second }: Slopes) -> Slopes {
    Slopes {
        first: [first[1], first[0]],
        second: [second[2], second[1], second[0]],
    }
}

/// Whether a cell of a quad has a part inside the quarter at edge `root`.
fn touches_square_root(place: CellPlace, root: usize) -> bool {
    let [low, high] = [place.at([0.0, 0.0]), place.at([1.0, 1.0])];
    // Turned so that the edge is v = 0: the lower side of the cell against the highest point of the triangle over it.
    let ([left, right], bottom) = match root {
        0 => ([low[0], high[0]], low[1]),
        1 => ([low[1], high[1]], 1.0 - high[0]),
        2 => ([1.0 - high[0], 1.0 - low[0]], 1.0 - high[1]),
        _ => ([1.0 - high[1], 1.0 - low[1]], low[0]),
    };
    let highest = if left <= 0.5 && right >= 0.5 {
        0.5
    } else {
        right.min(1.0 - left)
    };
    bottom < highest
}

/// Whether a cell of a triangle has a part in the third at edge `root`: there the opposite corner has the least weight.
fn touches_triangle_root(place: CellPlace, root: usize) -> bool {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|corner| {
        let [b, c] = place.at(corner);
        [1.0 - b - c, b, c]
    });
    let opposite = (root + 2) % 3;
    let is_above = |other: usize| corners.iter().all(|corner| corner[opposite] >= corner[other]);
    !is_above(root) && !is_above((root + 1) % 3)
}

/// The edge of a root, and the way from the centre to the middle of it, in the second and the third barycentric coordinate.
fn triangle_directions(root: usize) -> [[f64; 2]; 2] {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let [a, b] = [corners[root], corners[(root + 1) % 3]];
    [
        [b[0] - a[0], b[1] - a[1]],
        [(a[0] + b[0]) / 2.0 - 1.0 / 3.0, (a[1] + b[1]) / 2.0 - 1.0 / 3.0],
    ]
}
