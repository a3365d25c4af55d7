//! Which surfaces of a joined model to transpose, so that joined boundaries run against each other.

use super::join::Join;
use std::collections::VecDeque;

/// Breadth first over each component, from its first surface, which stays as it is. Whether each surface is transposed, the joins
/// that then run against each other, and those that cannot: the component is not orientable.
pub fn orient(
    surface_count: usize,
    joins: Vec<Join>,
    surface_of: impl Fn(usize) -> usize,
) -> (Vec<bool>, Vec<Join>, Vec<Join>) {
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); surface_count];
    for join in &joins {
        let [a, b] = join.boundaries.map(&surface_of);
        neighbours[a].push((b, join.same_way));
        neighbours[b].push((a, join.same_way));
    }
    let mut transposed: Vec<Option<bool>> = vec![None; surface_count];
    for first in 0..surface_count {
        if transposed[first].is_some() {
            continue;
        }
        transposed[first] = Some(false);
        let mut queue = VecDeque::from([(first, false)]);
        while let Some((surface, own)) = queue.pop_front() {
            for &(neighbour, same_way) in &neighbours[surface] {
                if transposed[neighbour].is_none() {
                    transposed[neighbour] = Some(own ^ same_way);
                    queue.push_back((neighbour, own ^ same_way));
                }
            }
        }
    }
    let transposed: Vec<bool> = transposed.into_iter().map(|is| is == Some(true)).collect();
    let fits = |join: &Join| {
        let [a, b] = join.boundaries.map(&surface_of);
        (transposed[a] ^ transposed[b]) == join.same_way
    };
    let (kept, dropped) = joins.into_iter().partition(fits);
    (transposed, kept, dropped)
}
