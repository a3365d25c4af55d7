//! Points of the limit surface by refining the ring of a face about them, until the rest is a spline or a limit rule: the truth.

mod cell;
mod division;

use super::SubdivisionScheme;
use super::cage::Cage;
use super::cell::{DomainPoint, TrianglePoint};
use super::stencil::Vector;
use cell::{Cell, spline_point};
use division::{Division, Squares, Triangles};
use glam::DVec3;
use keyleaf_key::RootPoint;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Steps after which what is left of a cell is below the rounding of f64.
const DEEPEST: u32 = 90;

/// Cells that are kept, at most: a spline has some hundred bytes, another one some kilobytes.
const MOST_KEPT: usize = 1 << 15;

/// What control vertices have that is refined, and the point in space that a weighted sum of it is.
pub trait Located: Vector {
    /// The point.
    fn position(&self) -> DVec3;

    /// How fast the point moves where the sum changes at this rate.
    fn motion(&self, rate: Self) -> DVec3;
}

impl Located for DVec3 {
    fn position(&self) -> DVec3 {
        *self
    }

    fn motion(&self, rate: Self) -> DVec3 {
        rate
    }
}

/// A point in the parameters of its domain.
#[derive(Clone, Copy, Debug)]
pub struct ExactPoint {
    pub position: DVec3,
    /// Derivatives. At an extraordinary vertex, where they vanish or grow without bound, tangents towards the neighbours.
    pub du: DVec3,
    pub dv: DVec3,
    /// Unit normal, none where there is none.
    pub normal: Option<DVec3>,
}

/// The cells that points have asked for, refined once. Results do not depend on which are kept.
#[derive(Debug)]
pub struct ExactCells<V> {
    /// By domain: where a face is one domain its first, of other faces one a corner.
    domains: Vec<Slot<V>>,
    kept: AtomicUsize,
}

type Slot<V> = OnceLock<Box<Node<V>>>;

#[derive(Debug)]
enum Node<V> {
    /// Control points of a spline, about a value.
    Spline { origin: V, points: Vec<V> },
    /// A cell with its four children.
    Rest { cell: Cell<V>, children: [Slot<V>; 4] },
}

impl<V> Clone for ExactCells<V> {
    /// Keeps nothing yet.
    fn clone(&self) -> Self {
        Self::new(self.domains.len())
    }
}

impl<V> ExactCells<V> {
    /// For a mesh with so many half-edges.
    pub fn new(half_edges: usize) -> Self {
        Self {
            domains: std::iter::repeat_with(OnceLock::new).take(half_edges).collect(),
            kept: AtomicUsize::new(0),
        }
    }
}

impl<V: Located> ExactCells<V> {
    /// The point of a face, in the parameters of the face, from the values of the control vertices: always the same ones.
    pub fn evaluate(
        &self,
        cage: &Cage,
        scheme: SubdivisionScheme,
        at: RootPoint,
        value: impl Fn(u32) -> V,
    ) -> ExactPoint {
        let slot = |domain: usize| &self.domains[cage.topology.first_half_edge(at.face) as usize + domain];
        match scheme {
            SubdivisionScheme::CatmullClark => {
                let DomainPoint {
                    domain,
                    at: point,
                    rates: [s, t],
                } = DomainPoint::of(at, cage.topology.corner_count(at.face));
                let squares = Squares(cage.creasing);
                let whole = || {
                    let cell = Cell::of_face(cage, at.face, value);
                    let is_domain = cell.ring.fans.len() == 4;
                    let cell = if is_domain {
                        cell
                    } else {
                        cell.child(squares.child(&cell.ring, domain))
                    };
                    Node::new(&squares, cell)
                };
                let exact = self.visit(slot(domain), whole, |node| self.walk(&squares, node, point, 1.0, 0));
                ExactPoint {
                    du: exact.du * s[0] + exact.dv * t[0],
                    dv: exact.du * s[1] + exact.dv * t[1],
                    ..exact
                }
            }
            SubdivisionScheme::Loop(weights) => {
                let triangles = Triangles(weights, cage.creasing);
                let whole = || Node::new(&triangles, Cell::of_face(cage, at.face, value));
                self.visit(slot(0), whole, |node| {
                    self.walk(&triangles, node, TrianglePoint::of(at), 1.0, 0)
                })
            }
        }
    }

    /// What `then` says of the node in a slot, which is made where there is none, and kept if there is room.
    fn visit(
        &self,
        slot: &Slot<V>,
        make: impl FnOnce() -> Node<V>,
        then: impl FnOnce(&Node<V>) -> ExactPoint,
    ) -> ExactPoint {
        if let Some(node) = slot.get() {
            return then(node);
        }
        let node = Box::new(make());
        if self.kept.load(Ordering::Relaxed) >= MOST_KEPT {
            return then(&node);
        }
        self.kept.fetch_add(1, Ordering::Relaxed);
        then(slot.get_or_init(|| node))
    }

    /// The point of a node `depth` steps down, in parameters of which it has 1 / `scale`.
    fn walk<D: Division>(&self, division: &D, node: &Node<V>, at: D::Point, scale: f64, depth: u32) -> ExactPoint {
        let (cell, children) = match node {
            Node::Spline { origin, points } => return spline_point(*origin, D::evaluate(points, at), scale),
            Node::Rest { cell, children } => (cell, children),
        };
        let corner = D::corner(at);
        let limit = corner.and_then(|corner| Some((corner, cell.limit(corner, division.scheme())?)));
        let settled = || {
            let corner = corner.unwrap_or(0);
            (corner, cell.settled(corner))
        };
        if let Some((corner, limit)) = limit.or_else(|| (depth == DEEPEST).then(settled)) {
            let [du, dv] = D::derivatives(corner, limit.tangents.map(|tangent| tangent * scale));
            return ExactPoint {
                position: limit.position,
                du,
                dv,
                normal: limit.normal,
            };
        }
        let (child, inner, factor) = D::descend(at);
        let refined = || Node::new(division, cell.child(division.child(&cell.ring, child)));
        self.visit(&children[child], refined, |node| {
            self.walk(division, node, inner, scale * factor, depth + 1)
        })
    }
}

impl<V: Located> Node<V> {
    fn new<D: Division>(_: &D, cell: Cell<V>) -> Self {
        match D::control_points(&cell.ring) {
            Some(points) => Self::Spline {
                origin: cell.origin,
                points: points.iter().map(|point| cell.offset(point)).collect(),
            },
            None => Self::Rest {
                cell,
                children: Default::default(),
            },
        }
    }
}
