//! What can be wrong with a leaf set and with the triangles drawn for it, in integers. Works on any lists of leaves and
//! triangles, such as those that a GPU holds.

use crate::neighbour::{across_outer_leg, h};
use crate::{Place, RootPoint, Site, Topology};
use std::collections::BTreeSet;

/// One way in which a list of places is not a leaf set that keeps the invariants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Violation {
    /// Not a place of a key of this mesh.
    NotANode(Place),
    /// A leaf that is there more than once: reported once for each copy too many.
    Duplicate(Place),
    /// A leaf that has other leaves inside it.
    Overlap(Place),
    /// A node that no leaf covers, as large as it can be.
    Gap(Place),
    /// (I1) broken: a split node whose H-neighbour is not split.
    HalfDiamond {
        /// The node that is split.
        split: Place,
        /// The other half of its diamond, which is not.
        whole: Place,
    },
    /// (I2) broken: a split node whose C(n) is not split.
    Unbalanced {
        /// The node that is split.
        split: Place,
        /// The node of its parent's level across its outer leg, which is not.
        whole: Place,
    },
}

/// Everything that keeps `leaves` from covering the roots of the mesh exactly once and from keeping (I1) and (I2).
///
/// Time n log n in the number of leaves times their level at most.
pub fn violations(topology: &Topology, leaves: impl IntoIterator<Item = Place>) -> Vec<Violation> {
    let (mut found, mut set, mut split) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for leaf in leaves {
        if !topology.has_root(leaf.face, leaf.root) || !leaf.is_valid() {
            found.push(Violation::NotANode(leaf));
        } else if set.insert(leaf) {
            for ancestor in leaf.ancestors() {
                if !split.insert(ancestor) {
                    break;
                }
            }
        } else {
            found.push(Violation::Duplicate(leaf));
        }
    }
    let is_there = |node: &Place| set.contains(node) || split.contains(node);
    found.extend(topology.roots().filter(|root| !is_there(root)).map(Violation::Gap));
    found.extend(set.intersection(&split).copied().map(Violation::Overlap));
    for &node in &split {
        let missing = |other: &Place| !split.contains(other);
        found.extend(
            node.children()
                .into_iter()
                .filter(|child| !is_there(child))
                .map(Violation::Gap),
        );
        found.extend(
            h(topology, node)
                .filter(missing)
                .map(|whole| Violation::HalfDiamond { split: node, whole }),
        );
        found.extend(
            across_outer_leg(topology, node)
                .filter(missing)
                .map(|whole| Violation::Unbalanced { split: node, whole }),
        );
    }
    found
}

/// An edge of drawn triangles that is not matched: a crack, a T-junction or an overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crack {
    /// The ends of the edge, the smaller one first.
    pub ends: [Site; 2],
    /// How many triangles run through it from the first end to the second.
    pub forward: usize,
    /// How many run through it from the second end to the first.
    pub backward: usize,
    /// Whether it lies on a boundary of the mesh, where it should have one triangle and not two.
    pub is_boundary: bool,
}

/// A directed edge of a drawn triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct DrawnEdge {
    ends: [Site; 2],
    is_forward: bool,
    is_boundary: bool,
}

/// The edges of `triangles` that are not used once in each direction, or once on a boundary of the mesh. None: the triangles are
/// a closed conforming mesh, open only where the control mesh is.
///
/// Ends are compared as [`Site`]s. The roots of the points must exist. Time n log n in the number of triangles.
pub fn cracks(topology: &Topology, triangles: impl IntoIterator<Item = [RootPoint; 3]>) -> Vec<Crack> {
    let mut edges: Vec<DrawnEdge> = triangles
        .into_iter()
        .flat_map(|[o, r, u]| [[o, r], [r, u], [u, o]])
        .map(|points| {
            let [from, to] = points.map(|point| Site::of(topology, point));
            DrawnEdge {
                ends: [from.min(to), from.max(to)],
                is_forward: from < to,
                is_boundary: points[0].runs_along_boundary(points[1], topology),
            }
        })
        .collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a.ends == b.ends).filter_map(crack).collect()
}

/// What is wrong with all drawn edges between the same two ends.
fn crack(edges: &[DrawnEdge]) -> Option<Crack> {
    let forward = edges.iter().filter(|edge| edge.is_forward).count();
    let (ends, backward) = (edges[0].ends, edges.len() - forward);
    let is_boundary = edges.iter().any(|edge| edge.is_boundary);
    let matched = if is_boundary {
        edges.len() == 1
    } else {
        forward == 1 && backward == 1
    };
    (!matched || ends[0] == ends[1]).then_some(Crack {
        ends,
        forward,
        backward,
        is_boundary,
    })
}
