//! Points of the limit surface by refining the ring of a face about them, until the rest is a spline or a limit rule: the truth.

use super::bspline::{self, Jet};
use super::cage::Cage;
use super::cell::{DomainPoint, SquarePoint, TrianglePoint};
use super::limit::limit;
use super::loop_scheme::{self, Part};
use super::refinement::Child;
use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::stencil::{Stencil, Vector};
use super::{Creasing, SubdivisionScheme, box_spline, catmull_clark};
use crate::LoopWeights;
use crate::direction::cross_direction;
use glam::DVec3;
use keyleaf_key::RootPoint;

/// Steps after which what is left of a cell is below the rounding of f64.
const DEEPEST: u32 = 90;

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

/// A cell with the values of its ring, about one of them: small cells keep their precision.
struct Cell<V> {
    ring: Ring,
    origin: V,
    offsets: Vec<V>,
}

impl<V: Located> Cell<V> {
    fn of_face(cage: &Cage, face: u32, value: impl Fn(u32) -> V) -> Self {
        let placed = cage.ring(face);
        let origin = placed.vertices.first().map_or(V::ZERO, |&vertex| value(vertex));
        let offset = |&vertex: &u32| value(vertex).plus(origin, -1.0);
        Self {
            ring: placed.ring,
            origin,
            offsets: placed.vertices.iter().map(offset).collect(),
        }
    }

    fn become_child(&mut self, Child { ring, stencils }: Child) {
        let mut offsets: Vec<V> = stencils.iter().map(|stencil| stencil.apply(&self.offsets)).collect();
        let shift = offsets.first().copied().unwrap_or(V::ZERO);
        offsets.iter_mut().for_each(|offset| *offset = offset.plus(shift, -1.0));
        self.origin = self.origin.plus(shift, 1.0);
        self.offsets = offsets;
        self.ring = ring;
    }

    fn offset(&self, stencil: &Stencil) -> V {
        stencil.apply(&self.offsets)
    }

    fn spline(&self, jet: Jet<V>, scale: f64) -> ExactPoint {
        let at = self.origin.plus(jet.value, 1.0);
        let [du, dv] = [jet.du, jet.dv].map(|rate| at.motion(rate));
        ExactPoint {
            position: at.position(),
            du: du * scale,
            dv: dv * scale,
            normal: cross_direction(du, dv),
        }
    }

    /// The limit of a corner; none where rules still change, or masks need another step.
    fn limit(&self, corner: usize, scheme: SubdivisionScheme) -> Option<CornerLimit> {
        let fan = &self.ring.fans[corner];
        let is_quads = fan.faces.iter().all(|&face| self.ring.faces[face as usize].len() == 4);
        if scheme == SubdivisionScheme::CatmullClark && !is_quads {
            return None;
        }
        let sector = Sector::of(fan)?;
        let limit = limit(&self.ring, &sector, scheme)?;
        let at = self.origin.plus(self.offset(&limit.position), 1.0);
        let motion = |tangent: &Stencil| at.motion(self.offset(tangent));
        let [first, second] = limit.tangents.each_ref().map(motion);
        let arm = |k: usize| motion(&sector.arm(k));
        let across = (0..sector.faces.len()).map(|k| arm(k).cross(arm(k + 1))).sum::<DVec3>();
        let turned = |normal: DVec3| if normal.dot(across) < 0.0 { -normal } else { normal };
        let normal = match sector.kind {
            SectorKind::Corner => cross_direction(first, second).map(turned),
            // The tangents of one face are defective and name a side of the crease only.
            SectorKind::Crease if sector.faces.len() == 1 => cross_direction(first, second).map(turned),
            SectorKind::Interior if sector.faces.len() > 4 => {
                // Neighbouring spokes are nearly parallel where there are many: better two that are a quarter apart.
                let mut wider = sector.clone();
                wider.own += sector.faces.len().div_ceil(4) - 1;
                let [_, far] = super::limit::tangents(&self.ring, &wider, scheme);
                cross_direction(first, motion(&far))
            }
            _ => cross_direction(first, second),
        };
        let own = [arm(sector.own), arm(sector.own + 1)];
        let normal = normal.or_else(|| cross_direction(own[0], own[1]));
        let flat = |v: DVec3| normal.map_or(v, |normal| v - normal * v.dot(normal));
        let tangents = if sector.kind == SectorKind::Interior {
            [first, second]
        } else {
            own.map(flat)
        };
        Some(CornerLimit {
            position: at.position(),
            tangents,
            normal,
        })
    }

    /// The corner itself after so many steps that it is its limit.
    fn settled(&self, corner: usize) -> CornerLimit {
        let fan = &self.ring.fans[corner];
        let own = self.offsets[fan.vertex as usize];
        let at = self.origin.plus(own, 1.0);
        let arm = |k| {
            fan.spoke(k).map_or(DVec3::ZERO, |spoke| {
                at.motion(self.offsets[spoke.vertex as usize].plus(own, -1.0))
            })
        };
        let tangents = [arm(0), arm(1)];
        CornerLimit {
            position: at.position(),
            tangents,
            normal: cross_direction(tangents[0], tangents[1]),
        }
    }
}

/// The limit of a corner of a cell, with tangents towards the next and the previous corner.
struct CornerLimit {
    position: DVec3,
    tangents: [DVec3; 2],
    normal: Option<DVec3>,
}

/// The point of a face, in the parameters of the face, from the values of the control vertices.
pub fn evaluate<V: Located>(
    cage: &Cage,
    scheme: SubdivisionScheme,
    at: RootPoint,
    value: impl Fn(u32) -> V,
) -> ExactPoint {
    match scheme {
        SubdivisionScheme::CatmullClark => {
            let DomainPoint {
                domain,
                at: point,
                rates: [s, t],
            } = DomainPoint::of(at, cage.topology.corner_count(at.face));
            let mut cell = Cell::of_face(cage, at.face, value);
            if cell.ring.fans.len() != 4 {
                let child = catmull_clark::child(&cell.ring, domain, cage.creasing);
                cell.become_child(child);
            }
            let exact = in_square(cell, cage.creasing, point);
            ExactPoint {
                du: exact.du * s[0] + exact.dv * t[0],
                dv: exact.du * s[1] + exact.dv * t[1],
                ..exact
            }
        }
        SubdivisionScheme::Loop(weights) => {
            let cell = Cell::of_face(cage, at.face, value);
            in_triangle(cell, cage.creasing, weights, TrianglePoint::of(at))
        }
    }
}

fn in_square<V: Located>(mut cell: Cell<V>, creasing: Creasing, mut at: SquarePoint) -> ExactPoint {
    let mut scale = 1.0;
    for _ in 0..DEEPEST {
        if let Some(points) = bspline::control_points(&cell.ring) {
            let points = points.map(|row| row.map(|point| cell.offset(&point)));
            let [u, v] = at.to_f64();
            return cell.spline(bspline::evaluate(&points, u, v), scale);
        }
        let limit = at.corner().and_then(|corner| {
            let limit = cell.limit(corner, SubdivisionScheme::CatmullClark)?;
            Some(of_square_corner(limit, corner, scale))
        });
        if let Some(limit) = limit {
            return limit;
        }
        let (corner, inner) = at.descend();
        cell.become_child(catmull_clark::child(&cell.ring, corner, creasing));
        (at, scale) = (inner, scale * 2.0);
    }
    let corner = at.corner().unwrap_or(0);
    of_square_corner(cell.settled(corner), corner, scale)
}

fn of_square_corner(limit: CornerLimit, corner: usize, scale: f64) -> ExactPoint {
    let [next, previous] = limit.tangents.map(|tangent| tangent * scale);
    let [du, dv] = match corner {
        0 => [next, previous],
        1 => [-previous, next],
        2 => [-next, -previous],
        _ => [previous, -next],
    };
    ExactPoint {
        position: limit.position,
        du,
        dv,
        normal: limit.normal,
    }
}

fn in_triangle<V: Located>(
    mut cell: Cell<V>,
    creasing: Creasing,
    weights: LoopWeights,
    mut at: TrianglePoint,
) -> ExactPoint {
    let scheme = SubdivisionScheme::Loop(weights);
    let mut scale = 1.0;
    for _ in 0..DEEPEST {
        if let Some(points) = box_spline::control_points(&cell.ring) {
            let points = points.map(|point| cell.offset(&point));
            return cell.spline(box_spline::evaluate(&points, at.to_f64()), scale);
        }
        let limit = at.corner().and_then(|corner| {
            let limit = cell.limit(corner, scheme)?;
            Some(of_triangle_corner(limit, corner, scale))
        });
        if let Some(limit) = limit {
            return limit;
        }
        let (part, inner) = at.descend();
        cell.become_child(loop_scheme::child(&cell.ring, part, weights, creasing));
        at = inner;
        scale *= if part == Part::Middle { -2.0 } else { 2.0 };
    }
    let corner = at.corner().unwrap_or(0);
    of_triangle_corner(cell.settled(corner), corner, scale)
}

fn of_triangle_corner(limit: CornerLimit, corner: usize, scale: f64) -> ExactPoint {
    let [next, previous] = limit.tangents.map(|tangent| tangent * scale);
    let [du, dv] = match corner {
        0 => [next, previous],
        1 => [-previous, next - previous],
        _ => [previous - next, -next],
    };
    ExactPoint {
        position: limit.position,
        du,
        dv,
        normal: limit.normal,
    }
}
