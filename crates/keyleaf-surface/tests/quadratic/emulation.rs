//! The shaders' arithmetic in f32, from the tables alone and in the documented order.

use glam::{DVec3, Vec3};
use keyleaf_key::{ONE, RootPoint, Site, Topology};
use keyleaf_surface::{Surface, TrianglePatches};

/// The tables of a surface as a shader reads them.
pub struct Emulation<'a> {
    topology: &'a Topology,
    a: Vec<f32>,
    b: Vec<u32>,
    entries: usize,
}

impl<'a> Emulation<'a> {
    pub fn new(surface: &'a TrianglePatches, origin: DVec3) -> Self {
        let tables = surface.tables(origin);
        Self {
            topology: surface.topology(),
            entries: tables.a.len() / 4 / surface.topology().face_count() as usize,
            a: tables.a,
            b: tables.b,
        }
    }

    fn entry(&self, face: usize, entry: usize) -> Vec3 {
        Vec3::from_slice(&self.a[4 * (face * self.entries + entry)..])
    }

    /// The difference of corner r.
    fn corner(&self, face: usize, r: usize) -> Vec3 {
        if r == 0 { Vec3::ZERO } else { self.entry(face, r) }
    }

    /// The difference of control point k of edge r.
    fn edge(&self, face: usize, r: usize, k: usize) -> Vec3 {
        let on_edge = if self.is_cubic() { 2 } else { 1 };
        self.entry(face, 3 + on_edge * r + k)
    }

    fn is_cubic(&self) -> bool {
        self.entries == 17
    }

    /// Relative to the origin.
    pub fn point(&self, at: RootPoint) -> DVec3 {
        let point = match Site::of(self.topology, at) {
            Site::Vertex { .. } => {
                let corner = if at.y == ONE { (at.root + 1) % 3 } else { at.root };
                let owner = self.b[4 * (3 * at.face + corner) as usize + 1] as usize;
                self.entry(owner / 3, 0) + self.corner(owner / 3, owner % 3)
            }
            Site::Edge { t, .. } => {
                let owner = self.b[4 * (3 * at.face + at.root) as usize] as usize;
                self.on_edge(owner / 3, owner % 3, t as f32 / ONE as f32)
            }
            _ => self.inside(at),
        };
        point.as_dvec3()
    }

    fn on_edge(&self, face: usize, r: usize, t: f32) -> Vec3 {
        let w = 1.0 - t;
        let (p, q) = (self.corner(face, r), self.corner(face, (r + 1) % 3));
        let sum = if self.is_cubic() {
            let inner = self.edge(face, r, 0) * w + self.edge(face, r, 1) * t;
            (p * (w * w * w) + q * (t * t * t)) + inner * (3.0 * w * t)
        } else {
            (p * (w * w) + q * (t * t)) + self.edge(face, r, 0) * (2.0 * w * t)
        };
        self.entry(face, 0) + sum
    }

    fn inside(&self, at: RootPoint) -> Vec3 {
        let face = at.face as usize;
        let [x, y, z] = [at.x, at.y, at.z()].map(|weight| weight as f32 / ONE as f32);
        let mut b = [z / 3.0; 3];
        b[at.root as usize] += x;
        b[(at.root as usize + 1) % 3] += y;
        let mut sum = Vec3::ZERO;
        for r in 0..3 {
            let s = (r + 1) % 3;
            if self.is_cubic() {
                let inner = self.edge(face, r, 0) * b[r] + self.edge(face, r, 1) * b[s];
                sum += self.corner(face, r) * (b[r] * b[r] * b[r]) + inner * (3.0 * b[r] * b[s]);
            } else {
                sum += self.corner(face, r) * (b[r] * b[r]) + self.edge(face, r, 0) * (2.0 * b[r] * b[s]);
            }
        }
        if self.is_cubic() {
            sum += self.entry(face, 9) * (6.0 * b[0] * b[1] * b[2]);
        }
        self.entry(face, 0) + sum
    }
}
