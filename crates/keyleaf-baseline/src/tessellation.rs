//! The triangles that every tessellator returns.

use glam::{DVec2, DVec3};

/// Triangles of a model. A point that surfaces share is one vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tessellation {
    /// Where the vertices are.
    pub positions: Vec<DVec3>,
    /// The surface that each vertex was evaluated on, and its parameters there.
    pub parameters: Vec<(u32, DVec2)>,
    /// Vertices of the triangles, counter-clockwise in the parameters of their surface. All three differ.
    pub triangles: Vec<[u32; 3]>,
    /// The surface of each triangle, and the parameters of its three corners on that surface. A vertex that is shared
    /// has other parameters on other surfaces, on the two sides of a seam, and in every triangle about a pole.
    pub domains: Vec<(u32, [DVec2; 3])>,
    /// Triangles of the domains that shrink to an edge or a point next to a collapsed side.
    pub slivers: Vec<Sliver>,
}

/// A triangle of a domain that has no area, since some of its corners are the same vertex. The triangles on the two
/// sides of the edge that it shrinks to meet there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliver {
    /// Its vertices, two or three of them equal.
    pub vertices: [u32; 3],
    /// Its surface.
    pub surface: u32,
    /// Parameters of its corners on that surface.
    pub at: [DVec2; 3],
}
