//! Bounds of the roots of a triangle.
//!
//! With the legs A and B of a root (from the centre of the triangle to its corners), hypotenuses and medians of its nodes run along
//! A − B and A + B. So three numbers a root bound all its diamonds: half the greater speed along both for sizes and balls, and second
//! derivatives along both for the distance to flat triangles, of which the largest of a level are pairs with legs A − B and A + B.

use super::net::{Barycentric, PositionNet};
use crate::stencil::over_edges;
use keyleaf_key::Topology;

/// The centre of a triangle.
const CENTRE: Barycentric = [1.0 / 3.0; 3];

/// Bounds of a root, for both roots of a mesh edge alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootBound {
    /// Times 2^−level: half the hypotenuse, the median, and the surface over the diamond about the middle of the hypotenuse.
    pub size: f64,
    /// Times 4^−level: the distance between the surface and flat triangles as large as the node.
    pub deviation: f64,
}

impl RootBound {
    fn of(net: &PositionNet, root: usize) -> Self {
        let [r, s, t] = [root, (root + 1) % 3, (root + 2) % 3];
        let corner = |k: usize| {
            let mut b = [0.0; 3];
            b[k] = 1.0;
            b
        };
        let (mut difference, mut sum) = ([0.0; 3], [1.0 / 3.0; 3]);
        (difference[r], difference[s]) = (1.0, -1.0);
        sum[t] = -2.0 / 3.0;
        let part = [corner(r), corner(s), CENTRE];
        let speed = |h| net.longest_derivative(h, part);
        let second = |h, k| net.longest_second_derivative(h, k, part);
        Self {
            size: speed(difference).max(speed(sum)) / 2.0,
            deviation: (second(difference, difference) + 2.0 * second(difference, sum) + second(sum, sum)) / 8.0,
        }
    }
}

/// The bounds of all roots, by half-edge.
pub fn of_roots(topology: &Topology, nets: &[PositionNet]) -> Vec<RootBound> {
    let own: Vec<RootBound> = nets
        .iter()
        .flat_map(|net| [0, 1, 2].map(|root| RootBound::of(net, root)))
        .collect();
    let larger = |field: fn(&RootBound) -> f64| over_edges(topology, &own.iter().map(field).collect::<Vec<_>>());
    let (sizes, deviations) = (larger(|bound| bound.size), larger(|bound| bound.deviation));
    let pairs = sizes.into_iter().zip(deviations);
    pairs.map(|(size, deviation)| RootBound { size, deviation }).collect()
}
