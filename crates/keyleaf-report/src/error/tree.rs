//! A tree of boxes about triangles: which one is nearest?

use super::nearest::distance_squared;
use glam::DVec3;

/// Triangles in a leaf of the tree.
const LEAF: usize = 4;

struct Node {
    low: DVec3,
    high: DVec3,
    /// A leaf's triangles, or 0..0.
    triangles: std::ops::Range<u32>,
    /// The second child; the first one follows its parent.
    second: u32,
}

/// Triangles, sorted into boxes by halving at the median of the longest side.
pub(super) struct Tree {
    triangles: Vec<[DVec3; 3]>,
    nodes: Vec<Node>,
}

impl Tree {
    pub fn new(mut triangles: Vec<[DVec3; 3]>) -> Self {
        let mut nodes = Vec::with_capacity(triangles.len());
        let count = triangles.len();
        if count > 0 {
            build(&mut triangles, 0..count, &mut nodes);
        }
        Self { triangles, nodes }
    }

    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The squared distance to the nearest triangle, if it is below `bound`; else `bound`.
    pub fn distance_squared(&self, p: DVec3, bound: f64) -> f64 {
        let mut best = bound;
        let mut open: Vec<u32> = Vec::with_capacity(64);
        if !self.nodes.is_empty() {
            open.push(0);
        }
        while let Some(index) = open.pop() {
            let node = &self.nodes[index as usize];
            if node.distance_squared(p) >= best {
                continue;
            }
            if node.triangles.is_empty() {
                let children = [index + 1, node.second];
                let [near, far] = children.map(|child| self.nodes[child as usize].distance_squared(p));
                // What is looked at first lies on top.
                open.extend(if near <= far {
                    [children[1], children[0]]
                } else {
                    children
                });
                continue;
            }
            for triangle in &self.triangles[node.triangles.start as usize..node.triangles.end as usize] {
                best = best.min(distance_squared(p, *triangle));
            }
        }
        best
    }
}

impl Node {
    fn distance_squared(&self, p: DVec3) -> f64 {
        p.distance_squared(p.clamp(self.low, self.high))
    }
}

fn build(triangles: &mut [[DVec3; 3]], range: std::ops::Range<usize>, nodes: &mut Vec<Node>) -> u32 {
    let index = nodes.len() as u32;
    let mine = &mut triangles[range.clone()];
    let corners = || mine.iter().flatten();
    let low = corners().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let is_leaf = range.len() <= LEAF;
    nodes.push(Node {
        low,
        high,
        triangles: if is_leaf {
            range.start as u32..range.end as u32
        } else {
            0..0
        },
        second: 0,
    });
    if !is_leaf {
        let axis = (high - low).max_position();
        let half = mine.len() / 2;
        let centre = |t: &[DVec3; 3]| t[0][axis] + t[1][axis] + t[2][axis];
        mine.select_nth_unstable_by(half, |a, b| centre(a).total_cmp(&centre(b)));
        build(triangles, range.start..range.start + half, nodes);
        nodes[index as usize].second = build(triangles, range.start + half..range.end, nodes);
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_looking_at_all_triangles_finds() {
        let number = |i: usize| ((i as f64 * 12.9898).sin() * 43758.5453).rem_euclid(1.0);
        let point = |i: usize| DVec3::new(number(3 * i), number(3 * i + 1), number(3 * i + 2));
        let triangles: Vec<[DVec3; 3]> = (0..300)
            .map(|i| [0, 1, 2].map(|j| point(i) + 0.1 * point(1000 + 3 * i + j)))
            .collect();
        let tree = Tree::new(triangles.clone());
        for i in 0..200 {
            let p = 2.0 * point(5000 + i) - 0.5;
            let all = triangles
                .iter()
                .map(|t| distance_squared(p, *t))
                .fold(f64::INFINITY, f64::min);
            assert_eq!(tree.distance_squared(p, f64::INFINITY), all);
            assert_eq!(tree.distance_squared(p, all / 2.0), all / 2.0);
        }
        assert_eq!(Tree::new(Vec::new()).distance_squared(DVec3::ZERO, 7.0), 7.0);
    }
}
