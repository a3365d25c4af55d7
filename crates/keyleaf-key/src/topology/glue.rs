//! Twins and vertices of faces that are given by which half-edges meet.

use super::{HalfEdge, TopologyError};

/// The twin of every half-edge, from pairs.
pub(super) fn twins(
    face_first: &[u32],
    pairs: impl IntoIterator<Item = [HalfEdge; 2]>,
) -> Result<Vec<Option<HalfEdge>>, TopologyError> {
    let face_count = face_first.len() as u32 - 1;
    let index = |HalfEdge { face, root }: HalfEdge| {
        let exists = face < face_count && root < face_first[face as usize + 1] - face_first[face as usize];
        exists
            .then(|| (face_first[face as usize] + root) as usize)
            .ok_or(TopologyError::NoSuchHalfEdge { face, root })
    };
    let mut twins = vec![None; face_first[face_count as usize] as usize];
    for [a, b] in pairs {
        let places = [index(a)?, index(b)?];
        if a == b {
            return Err(TopologyError::PairedWithItself {
                face: a.face,
                root: a.root,
            });
        }
        for (place, (own, other)) in places.into_iter().zip([(a, b), (b, a)]) {
            if twins[place].replace(other).is_some() {
                return Err(TopologyError::PairedTwice {
                    face: own.face,
                    root: own.root,
                });
            }
        }
    }
    Ok(twins)
}

/// The start vertex of every half-edge, and how many vertices there are: the classes of corners that pairs connect, numbered by
/// their first corner.
pub(super) fn vertices(half_edges: &[HalfEdge], face_first: &[u32], twins: &[Option<HalfEdge>]) -> (Vec<u32>, usize) {
    let index = |HalfEdge { face, root }: HalfEdge| (face_first[face as usize] + root) as usize;
    let next = |half_edge: HalfEdge| {
        let corners = face_first[half_edge.face as usize + 1] - face_first[half_edge.face as usize];
        index(HalfEdge {
            root: (half_edge.root + 1) % corners,
            ..half_edge
        })
    };
    // Each class is a tree whose root is its least corner, so that parents come before their children.
    let mut parents: Vec<usize> = (0..half_edges.len()).collect();
    for (own, twin) in twins.iter().enumerate() {
        if let Some(twin) = *twin {
            let [a, b] = [own, next(twin)].map(|corner| class_of(&mut parents, corner));
            parents[a.max(b)] = a.min(b);
        }
    }
    let mut vertices = Vec::with_capacity(parents.len());
    let mut count = 0;
    for (corner, &parent) in parents.iter().enumerate() {
        let vertex = if parent == corner { count } else { vertices[parent] };
        count += u32::from(parent == corner);
        vertices.push(vertex);
    }
    (vertices, count as usize)
}

/// The root of a corner's tree; halves the path to it.
fn class_of(parents: &mut [usize], mut corner: usize) -> usize {
    while parents[corner] != corner {
        parents[corner] = parents[parents[corner]];
        corner = parents[corner];
    }
    corner
}
