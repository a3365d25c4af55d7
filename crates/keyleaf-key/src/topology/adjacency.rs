//! How the tables of a [`Topology`](super::Topology) are made, and what can be wrong with the faces.

use super::{HalfEdge, MAX_CORNERS, TopologyError};

/// Checks faces one by one. Remembers, per vertex, the last face that used it and at which corner.
pub(super) struct CornerOfVertex(Vec<Option<HalfEdge>>);

impl CornerOfVertex {
    pub fn new(vertex_count: usize) -> Self {
        Self(vec![None; vertex_count])
    }

    /// Is this, taken alone, a polygon?
    pub fn check(&mut self, face: u32, corners: &[u32]) -> Result<(), TopologyError> {
        check_corner_count(face, corners.len())?;
        let vertex_count = self.0.len();
        for (corner, &vertex) in (0..).zip(corners) {
            let Some(last) = self.0.get_mut(vertex as usize) else {
                return Err(TopologyError::IndexOutOfRange {
                    face,
                    corner,
                    vertex,
                    vertex_count,
                });
            };
            match last.replace(HalfEdge { face, root: corner }) {
                Some(earlier) if earlier.face == face => {
                    return Err(TopologyError::RepeatedIndex {
                        face,
                        corners: [earlier.root, corner],
                        vertex,
                    });
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Whether a face may have this many corners.
pub(super) fn check_corner_count(face: u32, corners: usize) -> Result<(), TopologyError> {
    match corners {
        0..3 => Err(TopologyError::TooFewCorners { face, corners }),
        3..=MAX_CORNERS => Ok(()),
        _ => Err(TopologyError::TooManyCorners { face, corners }),
    }
}

/// All half-edges in the order of their indices.
pub(super) fn half_edges(face_first: &[u32]) -> Vec<HalfEdge> {
    (0..)
        .zip(face_first.windows(2))
        .flat_map(|(face, range)| (0..range[1] - range[0]).map(move |root| HalfEdge { face, root }))
        .collect()
}

/// The first half-edge that starts at each vertex.
pub(super) fn vertex_owners(vertex_count: usize, half_edges: &[HalfEdge], vertices: &[u32]) -> Vec<Option<HalfEdge>> {
    let mut owners = vec![None; vertex_count];
    for (&half_edge, &vertex) in half_edges.iter().zip(vertices) {
        owners[vertex as usize].get_or_insert(half_edge);
    }
    owners
}

/// Start, end and index of a half-edge.
#[derive(Clone, Copy)]
struct Directed {
    from: u32,
    to: u32,
    index: usize,
}

impl Directed {
    fn undirected(self) -> [u32; 2] {
        [self.from.min(self.to), self.from.max(self.to)]
    }
}

/// The twin of every half-edge: those between the same two vertices, found side by side after a sort.
pub(super) fn twins(
    half_edges: &[HalfEdge],
    face_first: &[u32],
    vertices: &[u32],
) -> Result<Vec<Option<HalfEdge>>, TopologyError> {
    let polygon = |face: u32| &vertices[face_first[face as usize] as usize..face_first[face as usize + 1] as usize];
    let mut edges: Vec<Directed> = half_edges
        .iter()
        .enumerate()
        .map(|(index, half_edge)| {
            let corners = polygon(half_edge.face);
            let next = (half_edge.root as usize + 1) % corners.len();
            Directed {
                from: vertices[index],
                to: corners[next],
                index,
            }
        })
        .collect();
    edges.sort_unstable_by_key(|edge| (edge.undirected(), edge.index));

    let mut twins = vec![None; half_edges.len()];
    for at_edge in edges.chunk_by(|a, b| a.undirected() == b.undirected()) {
        match *at_edge {
            [_] => {}
            [a, b] if a.from == b.to => {
                twins[a.index] = Some(half_edges[b.index]);
                twins[b.index] = Some(half_edges[a.index]);
            }
            _ => {
                return Err(why_no_surface(at_edge, |index| half_edges[index].face, polygon));
            }
        }
    }
    Ok(twins)
}

/// The clearest reason why these half-edges, in the order of their indices, cannot lie at one edge.
fn why_no_surface<'a>(
    at_edge: &[Directed],
    face_of: impl Fn(usize) -> u32,
    polygon: impl Fn(u32) -> &'a [u32],
) -> TopologyError {
    let faces: Vec<u32> = at_edge.iter().map(|edge| face_of(edge.index)).collect();
    for (i, &later) in faces.iter().enumerate() {
        if let Some(&earlier) = faces[..i]
            .iter()
            .find(|&&face| is_rotation(polygon(face), polygon(later)))
        {
            return TopologyError::DuplicateFace {
                faces: [earlier, later],
            };
        }
    }
    match faces[..] {
        [a, b] => TopologyError::InconsistentWinding {
            vertices: [at_edge[0].from, at_edge[0].to],
            faces: [a, b],
        },
        _ => TopologyError::NonManifoldEdge {
            vertices: at_edge[0].undirected(),
            faces,
        },
    }
}

/// Whether `b` lists the distinct vertices of `a` in the same cyclic order.
fn is_rotation(a: &[u32], b: &[u32]) -> bool {
    a.len() == b.len()
        && b.iter()
            .position(|vertex| *vertex == a[0])
            .is_some_and(|start| a.iter().eq(b[start..].iter().chain(&b[..start])))
}
