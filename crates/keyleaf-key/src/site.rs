//! One canonical address for a point of the surface that several roots share.

use crate::{HalfEdge, ONE, RootPoint, Topology};

/// The canonical address of a point: two [`RootPoint`]s are the same point of the surface iff their sites are equal.
///
/// Evaluators choose their operands by it, so that all roots that share a point compute the same bits (ARCHITECTURE section 3, *same
/// bits*), and checks match edges by it. Parameters are in units of 1/[`ONE`] and lie strictly between 0 and [`ONE`].
///
/// ```
/// use keyleaf_key::{ONE, RootPoint, Site, Topology};
/// let mesh = Topology::new(4, [[0, 1, 2], [2, 1, 3]])?;
/// let one_side = RootPoint { face: 0, root: 1, x: ONE / 4, y: ONE / 4 * 3 };
/// let other_side = RootPoint { face: 1, root: 0, x: ONE / 4 * 3, y: ONE / 4 };
/// assert_eq!(Site::of(&mesh, one_side), Site::of(&mesh, other_side));
/// # Ok::<(), keyleaf_key::TopologyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Site {
    /// A vertex of the mesh.
    Vertex {
        /// The vertex.
        vertex: u32,
        /// The half-edge with the smallest index that starts there.
        owner: HalfEdge,
    },
    /// Inside a mesh edge.
    Edge {
        /// The half-edge of the edge with the smaller index.
        owner: HalfEdge,
        /// How far from the owner's start to its end.
        t: u32,
    },
    /// Inside a spoke, which two roots of a face share.
    Spoke {
        /// The face.
        face: u32,
        /// The corner at which the spoke ends.
        corner: u32,
        /// How far from the centre to the corner.
        t: u32,
    },
    /// The centre of a face, which all its roots share.
    Centre {
        /// The face.
        face: u32,
    },
    /// Inside one root, where the address is unique.
    Interior(RootPoint),
}

impl Site {
    /// The site of a point, in constant time. The root must exist and `x + y` must not exceed [`ONE`].
    pub fn of(topology: &Topology, point: RootPoint) -> Self {
        let RootPoint { face, root, x, y } = point;
        let next = || (root + 1) % topology.corner_count(face);
        match (x, y) {
            (0, 0) => Self::Centre { face },
            (ONE, _) => Self::at_corner(topology, face, root),
            (_, ONE) => Self::at_corner(topology, face, next()),
            (t, 0) => Self::Spoke { face, corner: root, t },
            (0, t) => Self::Spoke {
                face,
                corner: next(),
                t,
            },
            _ if point.is_on_mesh_edge() => {
                let owner = topology.half_edge_owner(face, root);
                Self::Edge {
                    owner,
                    t: if owner == (HalfEdge { face, root }) { y } else { x },
                }
            }
            _ => Self::Interior(point),
        }
    }

    fn at_corner(topology: &Topology, face: u32, corner: u32) -> Self {
        let vertex = topology.vertex(face, corner);
        let owner = topology.vertex_owner(vertex).unwrap_or(HalfEdge { face, root: corner });
        Self::Vertex { vertex, owner }
    }
}
