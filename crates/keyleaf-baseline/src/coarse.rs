//! The coarse triangles that the adaptive methods refine, and what has been decided for their edges.
//!
//! Every cell is two triangles about a diagonal (thesis 3.3), which rises from corner 0 to corner 3 or falls from 1 to
//! 2. A triangle has corners V1 V2 V3; V1 is the apex from which rows are counted, the side V1 V2 is the left one, V1
//! V3 the right one, V2 V3 the base.

use crate::cells::{Cell, Cells, Edge};
use crate::curve::Curve;
use crate::insertion::{Settings, inserted_on_edge};
use crate::mesher::{Mesher, Node};
use crate::{BaselineError, Sampler, Side, View};
use glam::DVec2;
use std::collections::HashMap;

/// Barycentric coordinates as whole numbers, with respect to V1, V2, V3. Their sum is the unit of the pattern.
pub(crate) type Lattice = [u32; 3];

/// An edge of a coarse triangle, in the direction of [`EDGES`].
#[derive(Clone, Copy, Debug)]
enum CoarseEdge {
    Forward(Side),
    Backward(Side),
    Diagonal,
}

/// Corners of the edges: left, base, right.
pub(crate) const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [0, 2]];

/// One of the two triangles of a cell.
#[derive(Debug)]
pub(crate) struct CoarseTriangle {
    /// Corners of the cell.
    pub corners: [usize; 3],
    edges: [CoarseEdge; 3],
}

/// The two triangles of a cell.
pub(crate) fn coarse_triangles(cells: &Cells, cell: &Cell) -> &'static [CoarseTriangle; 2] {
    if cells.falling_diagonal(cell) {
        &FALLING
    } else {
        &RISING
    }
}

const RISING: [CoarseTriangle; 2] = [
    CoarseTriangle {
        corners: [0, 1, 3],
        edges: [
            CoarseEdge::Forward(Side::VMin),
            CoarseEdge::Forward(Side::UMax),
            CoarseEdge::Diagonal,
        ],
    },
    CoarseTriangle {
        corners: [0, 3, 2],
        edges: [
            CoarseEdge::Diagonal,
            CoarseEdge::Backward(Side::VMax),
            CoarseEdge::Forward(Side::UMin),
        ],
    },
];

const FALLING: [CoarseTriangle; 2] = [
    CoarseTriangle {
        corners: [0, 1, 2],
        edges: [
            CoarseEdge::Forward(Side::VMin),
            CoarseEdge::Diagonal,
            CoarseEdge::Forward(Side::UMin),
        ],
    },
    CoarseTriangle {
        corners: [1, 3, 2],
        edges: [
            CoarseEdge::Forward(Side::UMax),
            CoarseEdge::Backward(Side::VMax),
            CoarseEdge::Diagonal,
        ],
    },
];

impl CoarseTriangle {
    /// A point of the triangle as fractions of its cell.
    pub fn fraction(&self, w: Lattice) -> DVec2 {
        let unit = f64::from(w[0] + w[1] + w[2]);
        let mut sum = DVec2::ZERO;
        for (corner, w) in self.corners.into_iter().zip(w) {
            sum += f64::from(w) * DVec2::new((corner % 2) as f64, (corner / 2) as f64);
        }
        sum / unit
    }
}

/// What has been decided for an edge: its resolution, and the inserted candidates as distances from its start in units.
#[derive(Clone, Debug, Default)]
pub(crate) struct EdgePlan {
    pub resolution: u32,
    pub inserted: Vec<u32>,
}

/// The plans of all edges of the cells, over a pattern of `unit` segments an edge.
pub(crate) struct Plans<'a> {
    sampler: &'a dyn Sampler,
    view: &'a View,
    settings: &'a Settings,
    /// Segments of the unified pattern.
    pub unit: u32,
    edges: Vec<EdgePlan>,
}

impl<'a> Plans<'a> {
    pub fn new(
        sampler: &'a dyn Sampler,
        view: &'a View,
        settings: &'a Settings,
        cells: &Cells,
        unit: u32,
    ) -> Result<Self, BaselineError> {
        let mut plans = Self {
            sampler,
            view,
            settings,
            unit,
            edges: Vec::new(),
        };
        for edge in &cells.edges {
            let plan = if edge.collapsed {
                EdgePlan::default()
            } else {
                plans.plan(&curve(cells, edge))?
            };
            plans.edges.push(plan);
        }
        Ok(plans)
    }

    /// The plan of the diagonal of a cell. That between two sides with the same corners stays straight, or they would
    /// meet behind it.
    pub fn diagonal(&self, cells: &Cells, cell: &Cell) -> Result<EdgePlan, BaselineError> {
        if cells.is_bigon(cell) {
            return Ok(EdgePlan::default());
        }
        self.plan(&diagonal(cells, cell))
    }

    /// The plans of the edges of a triangle, in the order and direction of [`EDGES`].
    pub fn of_triangle(&self, cell: &Cell, triangle: &CoarseTriangle, diagonal: &EdgePlan) -> [EdgePlan; 3] {
        triangle.edges.map(|edge| {
            let (side, backward) = match edge {
                CoarseEdge::Diagonal => return diagonal.clone(),
                CoarseEdge::Forward(side) => (side, false),
                CoarseEdge::Backward(side) => (side, true),
            };
            let side = cell.edges[side as usize];
            let mut plan = self.edges[side.edge as usize].clone();
            if backward != side.reversed {
                plan.inserted.iter_mut().for_each(|at| *at = self.unit - *at);
                plan.inserted.reverse();
            }
            plan
        })
    }

    fn plan(&self, edge: &Curve) -> Result<EdgePlan, BaselineError> {
        let resolution = self.settings.resolution(self.sampler, self.view, edge)?;
        let step = self.unit / (resolution + 1);
        let mut inserted = inserted_on_edge(self.sampler, self.view, self.settings.test, edge, resolution)?;
        inserted.iter_mut().for_each(|at| *at *= step);
        Ok(EdgePlan { resolution, inserted })
    }
}

/// The greatest resolution that any edge of the cells or diagonal asks for.
pub(crate) fn greatest_resolution(
    sampler: &dyn Sampler,
    view: &View,
    settings: &Settings,
    cells: &Cells,
) -> Result<u32, BaselineError> {
    let mut greatest = 0;
    for edge in cells.edges.iter().filter(|edge| !edge.collapsed) {
        greatest = greatest.max(settings.resolution(sampler, view, &curve(cells, edge))?);
    }
    for cell in &cells.cells {
        greatest = greatest.max(settings.resolution(sampler, view, &diagonal(cells, cell))?);
    }
    Ok(greatest)
}

/// The vertices of one cell while its two triangles are made; they share those on the diagonal.
#[derive(Default)]
pub(crate) struct CellNodes {
    diagonal: HashMap<u32, Node>,
}

impl CellNodes {
    /// The vertices of a triangle at points of its pattern. A point inside the triangle must be asked for once only.
    pub fn node(
        &mut self,
        mesher: &mut Mesher<'_>,
        cell: &Cell,
        triangle: &CoarseTriangle,
        w: Lattice,
    ) -> Result<Node, BaselineError> {
        let unit = w[0] + w[1] + w[2];
        if let Some(corner) = w.iter().position(|&w| w == unit) {
            return mesher.corner(cell, triangle.corners[corner]);
        }
        let on = EDGES.iter().position(|&[a, b]| w[a] + w[b] == unit);
        let Some(on) = on else {
            return mesher.inside(cell, triangle.fraction(w));
        };
        let along = w[EDGES[on][1]];
        match triangle.edges[on] {
            CoarseEdge::Forward(side) => mesher.on_side(cell, side, along, unit),
            CoarseEdge::Backward(side) => mesher.on_side(cell, side, unit - along, unit),
            CoarseEdge::Diagonal => {
                if let Some(&node) = self.diagonal.get(&along) {
                    return Ok(node);
                }
                let node = mesher.inside(cell, triangle.fraction(w))?;
                self.diagonal.insert(along, node);
                Ok(node)
            }
        }
    }

    /// Adds triangles given by points of the pattern.
    pub fn add(
        &mut self,
        mesher: &mut Mesher<'_>,
        cell: &Cell,
        triangle: &CoarseTriangle,
        triangles: &[[Lattice; 3]],
    ) -> Result<(), BaselineError> {
        let mut nodes: HashMap<Lattice, Node> = HashMap::new();
        for corners in triangles {
            for w in corners {
                if !nodes.contains_key(w) {
                    nodes.insert(*w, self.node(mesher, cell, triangle, *w)?);
                }
            }
            mesher.triangle(cell, corners.map(|w| nodes[&w]));
        }
        Ok(())
    }
}

fn diagonal(cells: &Cells, cell: &Cell) -> Curve {
    let domain = cells.domains[cell.surface];
    let (low, high) = (domain.at(cell.low), domain.at(cell.high));
    let (from, to) = if cells.falling_diagonal(cell) {
        (high.x, low.x)
    } else {
        (low.x, high.x)
    };
    Curve {
        surface: cell.surface,
        from: DVec2::new(from, low.y),
        to: DVec2::new(to, high.y),
    }
}

fn curve(cells: &Cells, edge: &Edge) -> Curve {
    let domain = cells.domains[edge.surface];
    Curve {
        surface: edge.surface,
        from: domain.at(edge.from),
        to: domain.at(edge.to),
    }
}
