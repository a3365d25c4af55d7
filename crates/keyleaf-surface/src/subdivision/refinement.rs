//! One step of subdivision about one child of the middle face of a ring: what both schemes share.

use super::Creasing;
use super::ring::{Fan, Ring, Spoke};
use super::sharpness::{VertexRule, decremented, is_semi_sharp, mean_of_others};
use super::stencil::Stencil;
use std::collections::HashMap;

/// What a vertex of the finer mesh comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    Corner(usize),
    /// The smaller vertex first.
    Edge([u32; 2]),
    Face(u32),
}

/// A ring of the finer mesh, and its vertices as sums of those of the coarser ring.
#[derive(Clone, Debug)]
pub struct Child {
    /// The ring.
    pub ring: Ring,
    /// By vertex.
    pub stencils: Vec<Stencil>,
}

impl From<Children<1>> for Child {
    /// The points of one child are its vertices, in their order.
    fn from(
        Children {
            points,
            children: [child],
        }: Children<1>,
    ) -> Self {
        Self {
            ring: child.ring,
            stencils: points,
        }
    }
}

impl Child {
    /// A sum of vertices of the child as one of vertices of the parent.
    pub fn over_parent(&self, stencil: &Stencil) -> Stencil {
        Stencil::sum(
            stencil
                .0
                .iter()
                .map(|&(vertex, weight)| (&self.stencils[vertex as usize], weight)),
        )
    }
}

/// Some children of a ring, and the points that their vertices are, each once.
#[derive(Debug)]
pub struct Children<const N: usize> {
    /// Sums of vertices of the parent.
    pub points: Vec<Stencil>,
    /// The children.
    pub children: [SharedChild; N],
}

/// One of the children that share points.
#[derive(Debug)]
pub struct SharedChild {
    pub ring: Ring,
    /// The points that its vertices are.
    pub vertices: Vec<u32>,
}

impl SharedChild {
    /// The same with the corners numbered from another one: corner 0 becomes corner `turns`.
    pub fn turned(self, turns: usize) -> Self {
        Self {
            ring: self.ring.turned(turns),
            ..self
        }
    }
}

/// Masks of a scheme.
pub trait Masks {
    /// The point of the corner of a fan where nothing is sharp.
    fn smooth(&self, ring: &Ring, fan: &Fan) -> Stencil;

    /// The point of an edge between two faces, as if it were smooth.
    fn edge(&self, ring: &Ring, ends: [u32; 2], faces: [u32; 2]) -> Stencil;

    /// The point of the corner of a fan.
    fn corner(&self, ring: &Ring, fan: &Fan, creasing: Creasing) -> Stencil {
        let by = |rule| match rule {
            VertexRule::Smooth => self.smooth(ring, fan),
            VertexRule::Crease(ends) => crease_mask(fan, ends),
            VertexRule::Corner => Stencil::of(fan.vertex),
        };
        match fan.rules(creasing) {
            [(now, _), (_, 0.0)] => by(now),
            [(now, share), (next, rest)] => Stencil::sum([(&by(now), share), (&by(next), rest)]),
        }
    }
}

/// Children in the making, one after the other. Vertices and faces of a child are numbered as they are asked for.
pub struct Refinement<'a, M> {
    pub ring: &'a Ring,
    creasing: Creasing,
    masks: &'a M,
    /// Sharpness of the near halves of the spokes of every corner.
    near_halves: Vec<Vec<f64>>,
    /// The points of all children.
    points: Vec<Stencil>,
    point_of: HashMap<Source, u32>,
    /// The points that the vertices of this child are.
    vertices: Vec<u32>,
    /// By point.
    vertex_of: HashMap<u32, u32>,
    faces: Vec<Vec<u32>>,
    face_of: HashMap<[usize; 3], u32>,
}

impl<'a, M: Masks> Refinement<'a, M> {
    pub fn new(ring: &'a Ring, creasing: Creasing, masks: &'a M) -> Self {
        Self {
            ring,
            creasing,
            masks,
            near_halves: ring
                .fans
                .iter()
                .map(|fan| fan.subdivided_sharpnesses(creasing))
                .collect(),
            points: Vec::new(),
            point_of: HashMap::new(),
            vertices: Vec::new(),
            vertex_of: HashMap::new(),
            faces: Vec::new(),
            face_of: HashMap::new(),
        }
    }

    /// The child whose corners have these fans. What is asked for after that belongs to another one.
    pub fn finish(&mut self, fans: Vec<Fan>) -> SharedChild {
        self.vertex_of.clear();
        self.face_of.clear();
        let vertices = std::mem::take(&mut self.vertices);
        SharedChild {
            ring: Ring {
                vertex_count: vertices.len(),
                faces: std::mem::take(&mut self.faces),
                fans,
            },
            vertices,
        }
    }

    /// The points of all children.
    pub fn into_points(self) -> Vec<Stencil> {
        self.points
    }

    /// All that has been made.
    pub fn children<const N: usize>(self, children: [SharedChild; N]) -> Children<N> {
        Children {
            points: self.points,
            children,
        }
    }

    fn vertex(&mut self, source: Source, stencil: impl FnOnce(&Self) -> Stencil) -> u32 {
        let point = self.point_of.get(&source).copied().unwrap_or_else(|| {
            let stencil = stencil(self);
            let point = self.points.len() as u32;
            self.points.push(stencil);
            self.point_of.insert(source, point);
            point
        });
        *self.vertex_of.entry(point).or_insert_with(|| {
            self.vertices.push(point);
            self.vertices.len() as u32 - 1
        })
    }

    /// The point of a corner of the middle face.
    pub fn corner_point(&mut self, corner: usize) -> u32 {
        self.vertex(Source::Corner(corner), |of| {
            of.masks.corner(of.ring, &of.ring.fans[corner], of.creasing)
        })
    }

    /// The point of a spoke.
    pub fn edge_point(&mut self, corner: usize, spoke: usize) -> u32 {
        let fan = &self.ring.fans[corner];
        let (a, b) = (fan.vertex, fan.spokes[spoke].vertex);
        self.vertex(Source::Edge([a.min(b), a.max(b)]), |of| of.edge_stencil(corner, spoke))
    }

    fn edge_stencil(&self, corner: usize, place: usize) -> Stencil {
        let fan = &self.ring.fans[corner];
        let spoke = fan.spokes[place];
        let share = spoke.sharp_share(self.near_halves[corner][place], self.creasing);
        let ends = [fan.vertex, spoke.vertex];
        let sharp = Stencil(ends.map(|end| (end, 0.5)).to_vec());
        if share >= 1.0 {
            return sharp;
        }
        let before = (place + fan.spokes.len() - 1) % fan.spokes.len();
        let faces = [before, place].map(|place| fan.faces[place % fan.faces.len()]);
        let smooth = self.masks.edge(self.ring, ends, faces);
        if share <= 0.0 {
            return smooth;
        }
        Stencil::sum([(&sharp, share), (&smooth, 1.0 - share)])
    }

    /// The point of a face.
    pub fn face_point(&mut self, face: u32) -> u32 {
        self.vertex(Source::Face(face), |of| centroid(of.ring, face))
    }

    /// The face with this key, with vertices that are made if it is new.
    pub fn face(&mut self, key: [usize; 3], vertices: impl FnOnce(&mut Self) -> Vec<u32>) -> u32 {
        if let Some(&known) = self.face_of.get(&key) {
            return known;
        }
        let vertices = vertices(self);
        let face = self.faces.len() as u32;
        self.face_of.insert(key, face);
        self.faces.push(vertices);
        face
    }

    /// The near half of a spoke, from its corner.
    pub fn spoke_from_corner(&mut self, corner: usize, place: usize) -> Spoke {
        let old = self.ring.fans[corner].spokes[place];
        let sharpness = self.near_halves[corner][place];
        let far = old.far_half(self.creasing);
        let beyond = if self.creasing == Creasing::Chaikin && is_semi_sharp(far) {
            far
        } else {
            sharpness
        };
        Spoke {
            vertex: self.edge_point(corner, place),
            sharpness,
            beyond,
        }
    }

    /// The near half of a spoke, towards its corner.
    pub fn spoke_to_corner(&mut self, corner: usize, place: usize) -> Spoke {
        let halves = &self.near_halves[corner];
        let sharpness = halves[place];
        let beyond = match self.creasing {
            Creasing::Uniform => sharpness,
            Creasing::Chaikin => mean_of_others(halves, place),
        };
        Spoke {
            vertex: self.corner_point(corner),
            sharpness,
            beyond,
        }
    }

    /// The fan about the point of a corner; `child_face` makes the child at a corner of the face at a place of the corner's fan.
    pub fn fan_of_corner(&mut self, corner: usize, child_face: impl Fn(&mut Self, usize, usize) -> u32) -> Fan {
        let fan = &self.ring.fans[corner];
        Fan {
            vertex: self.corner_point(corner),
            sharpness: decremented(fan.sharpness),
            own: fan.own,
            spokes: (0..fan.spokes.len())
                .map(|k| self.spoke_from_corner(corner, k))
                .collect(),
            faces: (0..fan.faces.len()).map(|k| child_face(self, corner, k)).collect(),
        }
    }
}

/// The mean of the corners of a face.
pub fn centroid(ring: &Ring, face: u32) -> Stencil {
    let corners = &ring.faces[face as usize];
    let weight = 1.0 / corners.len() as f64;
    Stencil(corners.iter().map(|&vertex| (vertex, weight)).collect())
}

/// The mask of a crease, the same in both schemes: (1, 6, 1) / 8.
fn crease_mask(fan: &Fan, ends: [usize; 2]) -> Stencil {
    let [a, b] = ends.map(|end| fan.spokes[end].vertex);
    Stencil(vec![(fan.vertex, 0.75), (a, 0.125), (b, 0.125)])
}
