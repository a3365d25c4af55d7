//! The executable model of the design, line by line, on nodes that are lists of digits. Nothing of it uses the crate, so that
//! the two can be compared. The one addition: on a boundary there is no H, and nothing is asked of it.

use crate::meshes::Mesh;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Face, root, digits.
pub type Node = (u32, u32, Vec<u32>);

/// Wish and whether it wants to merge, as published by the pass before.
pub type Leaves = HashMap<Node, (f64, bool)>;

pub struct Model {
    corner_counts: Vec<u32>,
    twins: HashMap<(u32, u32), (u32, u32)>,
    max_level: usize,
}

fn parent(n: &Node) -> Node {
    (n.0, n.1, n.2[..n.2.len() - 1].to_vec())
}

fn child(n: &Node, digit: u32) -> Node {
    (n.0, n.1, [&n.2[..], &[digit]].concat())
}

fn children(n: &Node) -> [Node; 4] {
    [0, 1, 2, 3].map(|digit| child(n, digit))
}

impl Model {
    pub fn new(mesh: &Mesh, max_level: usize) -> Self {
        let mut edges = HashMap::new();
        for (face, corners) in (0..).zip(&mesh.faces) {
            for (root, &from) in (0..).zip(corners) {
                edges.insert((from, corners[(root as usize + 1) % corners.len()]), (face, root));
            }
        }
        let twins = edges
            .iter()
            .filter_map(|(&(from, to), &edge)| Some((edge, *edges.get(&(to, from))?)))
            .collect();
        let corner_counts = mesh.faces.iter().map(|corners| corners.len() as u32).collect();
        Self {
            corner_counts,
            twins,
            max_level,
        }
    }

    pub fn start(&self) -> Leaves {
        let roots = (0..)
            .zip(&self.corner_counts)
            .flat_map(|(face, &count)| (0..count).map(move |root| (face, root)));
        roots.map(|(face, root)| ((face, root, vec![]), (0.0, false))).collect()
    }

    fn x(&self, n: &Node) -> Node {
        let Some(digit) = n.2.last() else {
            let count = self.corner_counts[n.0 as usize];
            return (n.0, (n.1 + count - 1) % count, vec![]);
        };
        let p = parent(n);
        match digit {
            0 => child(&p, 1),
            2 => child(&p, 3),
            1 => child(&self.y(&p), 2),
            _ => child(&self.x(&p), 0),
        }
    }

    fn y(&self, n: &Node) -> Node {
        let Some(digit) = n.2.last() else {
            return (n.0, (n.1 + 1) % self.corner_counts[n.0 as usize], vec![]);
        };
        let p = parent(n);
        match digit {
            1 => child(&p, 0),
            3 => child(&p, 2),
            0 => child(&self.y(&p), 3),
            _ => child(&self.x(&p), 1),
        }
    }

    fn h(&self, n: &Node) -> Option<Node> {
        let Some(digit) = n.2.last() else {
            return self.twins.get(&(n.0, n.1)).map(|&(face, root)| (face, root, vec![]));
        };
        let p = parent(n);
        match digit {
            1 => Some(child(&p, 2)),
            2 => Some(child(&p, 1)),
            0 => Some(child(&self.h(&p)?, 3)),
            _ => Some(child(&self.h(&p)?, 0)),
        }
    }

    fn across_outer_leg(&self, n: &Node) -> Node {
        if n.2.last() >= Some(&2) {
            self.x(&parent(n))
        } else {
            self.y(&parent(n))
        }
    }

    /// Returns the next leaves, the next requests, and how many leaves changed.
    pub fn update(
        &self,
        leaves: &Leaves,
        requests: &HashMap<Node, f64>,
        metric: impl Fn(&Node) -> f64,
        capacity: usize,
    ) -> (Leaves, HashMap<Node, f64>, usize) {
        let blocked = |n: &Node| !n.2.is_empty() && leaves.contains_key(&self.across_outer_leg(n));
        let wish = |n: &Node| {
            if n.2.len() < self.max_level {
                leaves[n].0.max(requests.get(n).copied().unwrap_or(0.0))
            } else {
                0.0
            }
        };

        let bucket = |n: &Node| wish(n).log2().floor() as i64;
        let mut count = BTreeMap::new();
        for n in leaves.keys().filter(|n| wish(n) > 1.0) {
            *count.entry(bucket(n)).or_insert(0) += 1;
        }
        let (mut free, mut lowest) = (capacity as i128 - leaves.len() as i128, i64::MAX);
        for (b, leaves_in_it) in count.into_iter().rev() {
            if 3 * leaves_in_it > free {
                break;
            }
            free -= 3 * leaves_in_it;
            lowest = b;
        }
        let wants: HashSet<Node> = leaves
            .keys()
            .filter(|n| wish(n) > 1.0 && bucket(n) >= lowest)
            .cloned()
            .collect();

        let may_merge = |q: &Node| {
            for d in std::iter::once(q.clone()).chain(self.h(q)) {
                if children(&d)
                    .iter()
                    .any(|k| leaves.get(k).is_none_or(|published| !published.1) || wants.contains(k))
                {
                    return false;
                }
                for (m, legs) in [(self.x(&d), [0, 1]), (self.y(&d), [2, 3])] {
                    if leaves.contains_key(&m) {
                        continue;
                    }
                    for k in legs.map(|digit| child(&m, digit)) {
                        if leaves.contains_key(&k) {
                            if wants.contains(&k) {
                                return false;
                            }
                        } else if m.2.is_empty() || !leaves.contains_key(&parent(&m)) {
                            return false;
                        }
                    }
                }
            }
            true
        };

        let (mut kept, mut asked, mut changed) = (Vec::new(), HashMap::<Node, f64>::new(), 0);
        for n in leaves.keys() {
            if wants.contains(n) {
                let other = self.h(n);
                let other_wants = other.as_ref().is_none_or(|h| wants.contains(h) && !blocked(h));
                if other_wants && !blocked(n) {
                    kept.extend(children(n));
                    changed += 1;
                    continue;
                }
                if blocked(n) {
                    let blocker = self.across_outer_leg(n);
                    for c in self.h(&blocker).into_iter().chain([blocker]) {
                        let request = asked.entry(c).or_insert(0.0);
                        *request = request.max(wish(n));
                    }
                }
            } else if !n.2.is_empty() && leaves[n].1 && may_merge(&parent(n)) {
                changed += 1;
                if n.2.last() == Some(&0) {
                    kept.push(parent(n));
                }
                continue;
            }
            kept.push(n.clone());
        }
        let publish = |n: Node| {
            let merge = leaves.contains_key(&n) && !n.2.is_empty() && metric(&parent(&n)) <= 1.0;
            (n.clone(), (metric(&n), merge))
        };
        (kept.into_iter().map(publish).collect(), asked, changed)
    }
}
