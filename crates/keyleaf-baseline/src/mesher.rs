//! Builds a tessellation in which every shared point is evaluated and stored once.

use crate::cells::{Cell, Cells, position};
use crate::tessellation::Sliver;
use crate::{BaselineError, Sampler, Side, Tessellation};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// A vertex as a surface sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub vertex: u32,
    /// Parameters on the surface at hand.
    pub at: DVec2,
}

/// A tessellation in the making.
pub(crate) struct Mesher<'a> {
    pub cells: &'a Cells,
    sampler: &'a dyn Sampler,
    result: Tessellation,
    corners: Vec<Option<u32>>,
    /// Vertices on edges, by edge and reduced fraction.
    on_edges: HashMap<[u32; 3], u32>,
}

impl<'a> Mesher<'a> {
    pub fn new(sampler: &'a dyn Sampler, cells: &'a Cells) -> Self {
        let corners = vec![None; cells.corners.len()];
        Self {
            cells,
            sampler,
            result: Tessellation::default(),
            corners,
            on_edges: HashMap::new(),
        }
    }

    /// Corner i + 2j of a cell.
    pub fn corner(&mut self, cell: &Cell, corner: usize) -> Result<Node, BaselineError> {
        let number = cell.corners[corner];
        let at = self.parameters(cell, DVec2::new((corner % 2) as f64, (corner / 2) as f64));
        if let Some(vertex) = self.corners[number as usize] {
            return Ok(Node { vertex, at });
        }
        let place = self.cells.corners[number as usize];
        let vertex = self.vertex(place.surface, self.cells.domains[place.surface].at(place.t))?;
        self.corners[number as usize] = Some(vertex);
        Ok(Node { vertex, at })
    }

    /// The point `numerator / denominator` along a side of a cell. All points of a collapsed side are one vertex.
    pub fn on_side(
        &mut self,
        cell: &Cell,
        side: Side,
        numerator: u32,
        denominator: u32,
    ) -> Result<Node, BaselineError> {
        let [start, end] = match side {
            Side::UMin => [0, 2],
            Side::UMax => [1, 3],
            Side::VMin => [0, 1],
            Side::VMax => [2, 3],
        };
        if numerator == 0 || numerator >= denominator {
            return self.corner(cell, if numerator == 0 { start } else { end });
        }
        let at = self.parameters(cell, side.at(f64::from(numerator) / f64::from(denominator)));
        let side = cell.edges[side as usize];
        let edge = self.cells.edges[side.edge as usize];
        if edge.collapsed {
            let vertex = self.corner(cell, start)?.vertex;
            return Ok(Node { vertex, at });
        }
        let numerator = if side.reversed {
            denominator - numerator
        } else {
            numerator
        };
        let common = greatest_common_divisor(numerator, denominator);
        let key = [side.edge, numerator / common, denominator / common];
        if let Some(&vertex) = self.on_edges.get(&key) {
            return Ok(Node { vertex, at });
        }
        let t = edge.from.lerp(edge.to, f64::from(key[1]) / f64::from(key[2]));
        let vertex = self.vertex(edge.surface, self.cells.domains[edge.surface].at(t))?;
        self.on_edges.insert(key, vertex);
        Ok(Node { vertex, at })
    }

    /// A new vertex inside a cell, by its fractions of the cell.
    pub fn inside(&mut self, cell: &Cell, fraction: DVec2) -> Result<Node, BaselineError> {
        let at = self.parameters(cell, fraction);
        Ok(Node {
            vertex: self.vertex(cell.surface, at)?,
            at,
        })
    }

    /// Where a vertex is.
    pub fn position(&self, node: Node) -> DVec3 {
        self.result.positions[node.vertex as usize]
    }

    /// Parameters of a point of a cell.
    pub fn parameters(&self, cell: &Cell, fraction: DVec2) -> DVec2 {
        self.cells.domains[cell.surface].at(cell.at(fraction))
    }

    /// Adds a triangle, or a sliver if collapsed edges leave it without three different corners.
    pub fn triangle(&mut self, cell: &Cell, corners: [Node; 3]) {
        let vertices @ [a, b, c] = corners.map(|node| node.vertex);
        let (surface, at) = (cell.surface as u32, corners.map(|node| node.at));
        if a != b && b != c && c != a {
            self.result.triangles.push(vertices);
            self.result.domains.push((surface, at));
        } else {
            self.result.slivers.push(Sliver { vertices, surface, at });
        }
    }

    pub fn finish(self) -> Tessellation {
        self.result
    }

    fn vertex(&mut self, surface: usize, at: DVec2) -> Result<u32, BaselineError> {
        let vertex =
            u32::try_from(self.result.positions.len()).map_err(|_| BaselineError::TooLarge { what: "vertices" })?;
        self.result.positions.push(position(self.sampler, surface, at)?);
        self.result.parameters.push((surface as u32, at));
        Ok(vertex)
    }
}

pub(crate) fn greatest_common_divisor(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
