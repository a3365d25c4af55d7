//! Control meshes, and points of their faces.

use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{
    ControlMesh, CornerAttributes, LoopWeights, PolygonMesh, Subdivision, SubdivisionScheme, SubdivisionSettings,
};
use std::f64::consts::TAU;

pub const LOOP: SubdivisionScheme = SubdivisionScheme::Loop(LoopWeights::Loop);

/// A generator of numbers that look random: xorshift64*.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, bound: u32) -> u32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) % u64::from(bound)) as u32
    }

    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        f64::from(self.below(1 << 30)) / f64::from(1 << 30)
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
}

pub fn mesh<F: AsRef<[u32]>>(positions: Vec<DVec3>, faces: impl IntoIterator<Item = F>) -> PolygonMesh {
    PolygonMesh {
        positions,
        faces: faces.into_iter().collect(),
        corners: CornerAttributes::default(),
    }
}

pub fn settings(scheme: SubdivisionScheme, isolation: u32) -> SubdivisionSettings {
    SubdivisionSettings { scheme, isolation }
}

/// The point of a face that is no quad, by the parameters of one of the quads of the first step.
pub fn point_of_domain(face: u32, corners: u32, domain: u32, [s, t]: [f64; 2]) -> RootPoint {
    let fixed = |x: f64| (x * f64::from(ONE)).round() as u32;
    if s >= t {
        let [x, y] = [1.0 - (s + t) / 2.0, (s - t) / 2.0].map(fixed);
        return RootPoint {
            face,
            root: domain,
            x,
            y,
        };
    }
    let [x, y] = [(t - s) / 2.0, 1.0 - (s + t) / 2.0].map(fixed);
    RootPoint {
        face,
        root: (domain + corners - 1) % corners,
        x,
        y,
    }
}

/// The rings of a disc of n sectors: how many vertices a sector of a ring has, and the first vertex of a ring.
struct Disc {
    sectors: u32,
    is_loop: bool,
}

impl Disc {
    const RINGS: u32 = 3;

    fn per_sector(&self, ring: u32) -> u32 {
        if self.is_loop { ring } else { 2 * ring }
    }

    fn vertex(&self, ring: u32, k: u32) -> u32 {
        let first = 1 + self.sectors * (1..ring).map(|ring| self.per_sector(ring)).sum::<u32>();
        if ring == 0 {
            0
        } else {
            first + k % (self.sectors * self.per_sector(ring))
        }
    }

    fn position(&self, ring: u32, k: u32) -> DVec3 {
        let place = f64::from(k) / f64::from(self.per_sector(ring));
        let corner = |k: f64| {
            let angle = TAU / f64::from(self.sectors) * k;
            DVec3::new(angle.cos(), angle.sin(), 0.0)
        };
        let (a, b, part) = (corner(place.floor()), corner(place.floor() + 1.0), place.fract());
        let flat = match part {
            _ if self.is_loop => a.lerp(b, part),
            0.0..=0.5 => a + b * 2.0 * part,
            _ => b + a * 2.0 * (1.0 - part),
        };
        let p = flat * f64::from(ring);
        p.with_z(0.1 * p.x * p.x - 0.05 * p.y * p.y + 0.07 * p.x * p.y + 0.03 * p.x)
    }

    fn triangles(&self, sector: u32, ring: u32) -> Vec<Vec<u32>> {
        let (inner, outer) = (sector * ring, sector * (ring + 1));
        let mut faces = Vec::new();
        for k in 0..=ring {
            let [a, b, c] =
                [(ring, inner + k), (ring + 1, outer + k), (ring + 1, outer + k + 1)].map(|(r, k)| self.vertex(r, k));
            faces.push(vec![a, b, c]);
            if k < ring {
                faces.push(vec![a, c, self.vertex(ring, inner + k + 1)]);
            }
        }
        faces
    }

    fn quads(&self, sector: u32, ring: u32) -> Vec<Vec<u32>> {
        let (inner, outer) = (2 * sector * ring, 2 * sector * (ring + 1));
        let quad = |k: u32, l: u32| {
            vec![
                self.vertex(ring, k),
                self.vertex(ring + 1, l),
                self.vertex(ring + 1, l + 1),
                self.vertex(ring, k + 1),
            ]
        };
        let corner = outer + ring;
        let far = [corner, corner + 1, corner + 2].map(|k| self.vertex(ring + 1, k));
        let diagonal = vec![self.vertex(ring, inner + ring), far[0], far[1], far[2]];
        let before = (0..ring).map(|k| quad(inner + k, outer + k));
        let after = (0..ring).map(|k| quad(inner + ring + k, corner + 2 + k));
        before.chain([diagonal]).chain(after).collect()
    }
}

/// A bent disc of n sectors of quads or triangles about its first vertex, three rings of faces wide. Face 0 starts at that vertex.
pub fn disc(sectors: u32, scheme: SubdivisionScheme) -> ControlMesh {
    let disc = Disc {
        sectors,
        is_loop: scheme != SubdivisionScheme::CatmullClark,
    };
    let ring = |ring: u32| (0..sectors * disc.per_sector(ring)).map(move |k| (ring, k));
    let places = (1..=Disc::RINGS).flat_map(ring);
    let positions = [DVec3::ZERO]
        .into_iter()
        .chain(places.map(|(ring, k)| disc.position(ring, k)));
    let cells = (0..sectors).flat_map(|sector| (0..Disc::RINGS).map(move |ring| (sector, ring)));
    let faces = cells.flat_map(|(sector, ring)| {
        if disc.is_loop {
            disc.triangles(sector, ring)
        } else {
            disc.quads(sector, ring)
        }
    });
    ControlMesh::from(mesh(positions.collect(), faces))
}

/// A prism with two n-gons and n quads, closed.
pub fn prism(n: u32) -> ControlMesh {
    let corner = |k: u32| {
        let angle = TAU * f64::from(k % n) / f64::from(n);
        DVec3::new(
            angle.cos(),
            angle.sin(),
            if k < n { -1.0 } else { 1.0 + 0.3 * angle.cos() },
        )
    };
    let caps = [(0..n).rev().collect::<Vec<u32>>(), (n..2 * n).collect()];
    let sides = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]);
    ControlMesh::from(mesh((0..2 * n).map(corner).collect(), caps.into_iter().chain(sides)))
}

/// A point of a face, drawn at random.
pub fn any_point(surface: &Subdivision, random: &mut Random) -> RootPoint {
    use keyleaf_surface::Surface;
    let face = random.below(surface.topology().face_count());
    let root = random.below(surface.topology().corner_count(face));
    let x = random.below(ONE);
    RootPoint {
        face,
        root,
        x,
        y: random.below(ONE - x),
    }
}
