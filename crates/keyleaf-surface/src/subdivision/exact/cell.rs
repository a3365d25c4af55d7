//! A face refined about a point, with the values of its ring.

use super::super::bspline::Jet;
use super::super::cage::Cage;
use super::super::limit::{limit, tangents};
use super::super::refinement::Child;
use super::super::ring::Ring;
use super::super::sector::{Sector, SectorKind};
use super::super::stencil::Stencil;
use super::{ExactPoint, Located};
use crate::SubdivisionScheme;
use crate::direction::cross_direction;
use glam::DVec3;

/// A cell with the values of its ring, about one of them: small cells keep their precision.
#[derive(Debug)]
pub struct Cell<V> {
    pub ring: Ring,
    pub origin: V,
    offsets: Vec<V>,
}

impl<V: Located> Cell<V> {
    pub fn of_face(cage: &Cage, face: u32, value: impl Fn(u32) -> V) -> Self {
        let placed = cage.ring(face);
        let origin = placed.vertices.first().map_or(V::ZERO, |&vertex| value(vertex));
        let offset = |&vertex: &u32| value(vertex).plus(origin, -1.0);
        Self {
            ring: placed.ring,
            origin,
            offsets: placed.vertices.iter().map(offset).collect(),
        }
    }

    pub fn child(&self, Child { ring, stencils }: Child) -> Self {
        let mut offsets: Vec<V> = stencils.iter().map(|stencil| stencil.apply(&self.offsets)).collect();
        let shift = offsets.first().copied().unwrap_or(V::ZERO);
        offsets.iter_mut().for_each(|offset| *offset = offset.plus(shift, -1.0));
        Self {
            ring,
            origin: self.origin.plus(shift, 1.0),
            offsets,
        }
    }

    pub fn offset(&self, stencil: &Stencil) -> V {
        stencil.apply(&self.offsets)
    }

    /// The limit of a corner; none where rules still change, or masks need another step.
    pub fn limit(&self, corner: usize, scheme: SubdivisionScheme) -> Option<CornerLimit> {
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
                let [_, far] = tangents(&self.ring, &wider, scheme);
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
    pub fn settled(&self, corner: usize) -> CornerLimit {
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
pub struct CornerLimit {
    pub position: DVec3,
    pub tangents: [DVec3; 2],
    pub normal: Option<DVec3>,
}

/// The point of a spline about a value, in parameters of which the cell has 1 / `scale`.
pub fn spline_point<V: Located>(origin: V, jet: Jet<V>, scale: f64) -> ExactPoint {
    let at = origin.plus(jet.value, 1.0);
    let [du, dv] = [jet.du, jet.dv].map(|rate| at.motion(rate));
    ExactPoint {
        position: at.position(),
        du: du * scale,
        dv: dv * scale,
        normal: cross_direction(du, dv),
    }
}
