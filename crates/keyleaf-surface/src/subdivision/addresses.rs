//! One address for every point that several faces share: edges belong to one of their half-edges, vertices to one corner of each fan.

use keyleaf_key::{HalfEdge, ONE, RootPoint, Topology};

/// The half-edge at whose start the vertex of a corner is evaluated.
pub fn corner_owner(topology: &Topology, face: u32, corner: u32) -> HalfEdge {
    let own = HalfEdge { face, root: corner };
    topology.vertex_owner(topology.vertex(face, corner)).unwrap_or(own)
}

/// The address that all faces at a point agree on. That of a centre is in root 0.
pub fn canonical(topology: &Topology, at: RootPoint) -> RootPoint {
    if at.x == 0 && at.y == 0 {
        return RootPoint { root: 0, ..at };
    }
    if !at.is_on_mesh_edge() {
        return at;
    }
    let end = (at.root + 1) % topology.corner_count(at.face);
    if at.x == ONE || at.y == ONE {
        let corner = if at.x == ONE { at.root } else { end };
        let HalfEdge { face, root } = corner_owner(topology, at.face, corner);
        return RootPoint {
            face,
            root,
            x: ONE,
            y: 0,
        };
    }
    let HalfEdge { face, root } = topology.half_edge_owner(at.face, at.root);
    let is_own = (face, root) == (at.face, at.root);
    let [x, y] = if is_own { [at.x, at.y] } else { [at.y, at.x] };
    RootPoint { face, root, x, y }
}
