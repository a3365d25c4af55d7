//! The faces about a corner of the middle face that are smooth together: all of them, or those between two sharp edges.

use super::ring::{Fan, Ring};
use super::sharpness::{VertexRule, is_infinite};
use super::stencil::Stencil;

/// What bounds a sector, and so how its corner moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SectorKind {
    /// Nothing.
    Interior,
    /// Nothing, but one edge is sharp and ends here.
    Dart,
    /// Two sharp edges, along which the corner moves.
    Crease,
    /// Sharp edges; the corner stays. Without any the sector is closed.
    Corner,
}

/// The sector of the middle face at a corner where sharpness is infinite or none.
#[derive(Clone, Debug)]
pub struct Sector {
    /// What bounds it.
    pub kind: SectorKind,
    /// The corner.
    pub vertex: u32,
    /// Counter-clockwise. Where nothing bounds the sector, the first leads to the middle face's next corner.
    pub spokes: Vec<u32>,
    /// Face k lies between spokes k and k + 1.
    pub faces: Vec<u32>,
    /// The place of the middle face.
    pub own: usize,
}

impl Sector {
    /// None where a rule still changes.
    pub fn of(fan: &Fan) -> Option<Self> {
        if !fan.is_settled() {
            return None;
        }
        let sharp = fan.spokes.iter().filter(|spoke| is_infinite(spoke.sharpness)).count();
        let kind = match (fan.rule(), sharp) {
            (VertexRule::Smooth, 0) => SectorKind::Interior,
            (VertexRule::Smooth, _) => SectorKind::Dart,
            (VertexRule::Crease(_), _) => SectorKind::Crease,
            (VertexRule::Corner, _) => SectorKind::Corner,
        };
        let own = fan.own as isize;
        let count = fan.faces.len() as isize;
        let is_sharp = |offset: isize| fan.spoke(offset).is_none_or(|spoke| is_infinite(spoke.sharpness));
        let is_cut = matches!(kind, SectorKind::Crease | SectorKind::Corner) && sharp > 0;
        let (first, faces) = if is_cut {
            let first = (0..count).map(|k| -k).find(|&k| is_sharp(k)).unwrap_or(-own);
            let last = (1..=count).find(|&k| is_sharp(first + k)).unwrap_or(count);
            (first, last)
        } else {
            (0, count)
        };
        let spokes = if is_cut { faces + 1 } else { faces };
        let vertices = (first..first + spokes).filter_map(|k| fan.spoke(k));
        let places = (first..first + faces).filter_map(|k| fan.face_place(k));
        Some(Self {
            kind,
            vertex: fan.vertex,
            spokes: vertices.map(|spoke| spoke.vertex).collect(),
            faces: places.map(|place| fan.faces[place]).collect(),
            own: first.unsigned_abs(),
        })
    }

    /// Whether nothing cuts the faces apart.
    pub fn is_closed(&self) -> bool {
        self.spokes.len() == self.faces.len()
    }

    /// A spoke, counted round where the sector is closed.
    pub fn spoke(&self, k: usize) -> u32 {
        self.spokes[k % self.spokes.len()]
    }

    /// The corner across from this one in face k, of quads.
    pub fn diagonal(&self, ring: &Ring, k: usize) -> u32 {
        ring.vertex_after(self.faces[k % self.faces.len()], self.vertex, 2)
    }

    /// The difference of a spoke's end and the corner.
    pub fn arm(&self, k: usize) -> Stencil {
        Stencil(vec![(self.spoke(k), 1.0), (self.vertex, -1.0)])
    }
}
