//! Bounds of the roots of a triangle.
//!
//! With the legs A and B of a root (from the centre of the triangle to its corners), hypotenuses and medians of its nodes run along
//! A − B and A + B. So three numbers a root bound all its diamonds: half the greater speed along both for sizes and balls, and second
//! derivatives along both for the distance to flat triangles, of which the largest of a level are pairs with legs A − B and A + B.

use super::net::{Barycentric, PositionNet};
use crate::root_bound::RootBound;
use keyleaf_key::Topology;

/// The centre of a triangle.
const CENTRE: Barycentric = [1.0 / 3.0; 3];

fn of_root(net: &PositionNet, root: usize) -> RootBound {
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
    let half_speed = speed(difference).max(speed(sum)) / 2.0;
    RootBound {
        size: half_speed,
        ball: half_speed,
        deviation: (second(difference, difference) + 2.0 * second(difference, sum) + second(sum, sum)) / 8.0,
    }
}

/// The bounds of all roots, by half-edge.
pub fn of_roots(topology: &Topology, nets: &[PositionNet]) -> Vec<RootBound> {
    let own = nets.iter().flat_map(|net| [0, 1, 2].map(|root| of_root(net, root)));
    RootBound::of_both_sides(topology, own.collect())
}
