//! A step of subdivision of a whole mesh, written apart from the library: the refined mesh must have the same limit surface.

use crate::models::{LOOP, Random, disc, mesh, point_of_domain, prism, settings};
use glam::DVec3;
use keyleaf_key::RootPoint;
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Corner, Crease, Creasing, INFINITE_SHARPNESS, Subdivision, SubdivisionScheme, Surface,
};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

type Edge = (u32, u32);

fn edge(a: u32, b: u32) -> Edge {
    (a.min(b), a.max(b))
}

struct Global<'a> {
    control: &'a ControlMesh,
    is_loop: bool,
    /// Faces at every edge.
    edges: BTreeMap<Edge, Vec<usize>>,
    sharp: BTreeMap<Edge, f64>,
    corners: BTreeMap<u32, f64>,
}

impl<'a> Global<'a> {
    fn new(control: &'a ControlMesh, is_loop: bool) -> Self {
        let mut edges: BTreeMap<Edge, Vec<usize>> = BTreeMap::new();
        let mut faces_at: BTreeMap<u32, usize> = BTreeMap::new();
        for (face, corners) in control.mesh.faces.iter().enumerate() {
            for k in 0..corners.len() {
                edges
                    .entry(edge(corners[k], corners[(k + 1) % corners.len()]))
                    .or_default()
                    .push(face);
                *faces_at.entry(corners[k]).or_default() += 1;
            }
        }
        let mut sharp: BTreeMap<Edge, f64> = control
            .creases
            .iter()
            .map(|c| (edge(c.vertices[0], c.vertices[1]), c.sharpness))
            .collect();
        sharp.extend(
            edges
                .iter()
                .filter(|(_, faces)| faces.len() == 1)
                .map(|(&e, _)| (e, INFINITE_SHARPNESS)),
        );
        let mut corners: BTreeMap<u32, f64> = control.corners.iter().map(|c| (c.vertex, c.sharpness)).collect();
        if control.boundary == BoundaryRule::EdgesAndCorners {
            corners.extend(
                faces_at
                    .iter()
                    .filter(|(_, count)| **count == 1)
                    .map(|(&v, _)| (v, INFINITE_SHARPNESS)),
            );
        }
        Self {
            control,
            is_loop,
            edges,
            sharp,
            corners,
        }
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.control.mesh.positions[vertex as usize]
    }

    fn centroid(&self, face: usize) -> DVec3 {
        let corners = self.control.mesh.faces.get(face).expect("a face");
        corners.iter().map(|&v| self.position(v)).sum::<DVec3>() / corners.len() as f64
    }

    fn sharpness(&self, e: Edge) -> f64 {
        self.sharp.get(&e).copied().unwrap_or(0.0)
    }

    fn edges_at(&self, vertex: u32) -> Vec<Edge> {
        self.edges
            .keys()
            .filter(|(a, b)| *a == vertex || *b == vertex)
            .copied()
            .collect()
    }

    /// The half of an edge at one of its ends.
    fn half(&self, e: Edge, end: u32) -> f64 {
        let s = self.sharpness(e);
        if s >= INFINITE_SHARPNESS || s <= 0.0 {
            return s;
        }
        let others: Vec<f64> = self
            .edges_at(end)
            .into_iter()
            .filter(|&other| other != e)
            .map(|other| self.sharpness(other))
            .filter(|&other| other > 0.0 && other < INFINITE_SHARPNESS)
            .collect();
        if self.control.creasing == Creasing::Uniform || others.is_empty() {
            return (s - 1.0).max(0.0);
        }
        let mean = others.iter().sum::<f64>() / others.len() as f64;
        (0.75 * s + 0.25 * mean - 1.0).max(0.0)
    }

    fn edge_point(&self, e: Edge) -> DVec3 {
        let (a, b) = (self.position(e.0), self.position(e.1));
        let s = self.sharpness(e);
        let stays = self.half(e, e.0) > 0.0 && self.half(e, e.1) > 0.0;
        let share = if stays { 1.0 } else { s.min(1.0) };
        let faces = &self.edges[&e];
        let smooth = if faces.len() == 1 {
            (a + b) / 2.0
        } else if self.is_loop {
            let opposite = |face: usize| {
                let corners = self.control.mesh.faces.get(face).expect("a face");
                self.position(*corners.iter().find(|&&v| v != e.0 && v != e.1).expect("a triangle"))
            };
            (a + b) * 0.375 + (opposite(faces[0]) + opposite(faces[1])) * 0.125
        } else {
            (a + b + self.centroid(faces[0]) + self.centroid(faces[1])) / 4.0
        };
        (a + b) / 2.0 * share + smooth * (1.0 - share)
    }

    fn vertex_point(&self, vertex: u32) -> DVec3 {
        let own = self.position(vertex);
        let edges = self.edges_at(vertex);
        if edges.is_empty() {
            return own;
        }
        let other = |e: Edge| self.position(if e.0 == vertex { e.1 } else { e.0 });
        let smooth = || {
            let n = edges.len() as f64;
            let neighbours = edges.iter().map(|&e| other(e)).sum::<DVec3>();
            if self.is_loop {
                let beta = (0.625 - (0.375 + (TAU / n).cos() / 4.0).powi(2)) / n;
                return own * (1.0 - n * beta) + neighbours * beta;
            }
            let faces = self
                .control
                .mesh
                .faces
                .iter()
                .enumerate()
                .filter(|(_, f)| f.contains(&vertex));
            let centroids = faces.map(|(face, _)| self.centroid(face)).sum::<DVec3>();
            own * ((n - 2.0) / n) + (neighbours + centroids) / (n * n)
        };
        let by = |corner: f64, sharp: &[Edge]| match (corner > 0.0, sharp) {
            (false, [] | [_]) => (0, smooth()),
            (false, [a, b]) => (1, own * 0.75 + (other(*a) + other(*b)) * 0.125),
            _ => (2, own),
        };
        let corner = self.corners.get(&vertex).copied().unwrap_or(0.0);
        let next_corner = if corner >= INFINITE_SHARPNESS {
            corner
        } else {
            (corner - 1.0).max(0.0)
        };
        let sharp: Vec<Edge> = edges.iter().copied().filter(|&e| self.sharpness(e) > 0.0).collect();
        let next_sharp: Vec<Edge> = sharp.iter().copied().filter(|&e| self.half(e, vertex) > 0.0).collect();
        let (now, next) = (by(corner, &sharp), by(next_corner, &next_sharp));
        if now.0 == next.0 && (now.0 != 1 || sharp == next_sharp) {
            return now.1;
        }
        let mut fading: Vec<f64> = match self.control.creasing {
            Creasing::Uniform => sharp.iter().map(|&e| self.sharpness(e)).filter(|&s| s <= 1.0).collect(),
            Creasing::Chaikin => sharp
                .iter()
                .filter(|e| !next_sharp.contains(e))
                .map(|&e| self.sharpness(e))
                .collect(),
        };
        if corner > 0.0 && next_corner <= 0.0 {
            fading.push(corner);
        }
        let share = if fading.is_empty() {
            0.0
        } else {
            (fading.iter().sum::<f64>() / fading.len() as f64).min(1.0)
        };
        now.1 * share + next.1 * (1.0 - share)
    }

    /// The refined mesh. Children follow in the order of faces and corners; that of a corner starts there. The middle one of a triangle
    /// is last and starts across from corner 0.
    fn refined(&self) -> ControlMesh {
        let vertices = self.control.mesh.positions.len() as u32;
        let number: BTreeMap<Edge, u32> = self.edges.keys().copied().zip(vertices..).collect();
        let mut positions: Vec<DVec3> = (0..vertices).map(|v| self.vertex_point(v)).collect();
        positions.extend(self.edges.keys().map(|&e| self.edge_point(e)));
        let mut faces = Vec::new();
        for (face, corners) in self.control.mesh.faces.iter().enumerate() {
            let count = corners.len();
            let middle = |k: usize| number[&edge(corners[k % count], corners[(k + 1) % count])];
            if self.is_loop {
                faces.extend((0..3).map(|k| vec![corners[k], middle(k), middle(k + 2)]));
                faces.push(vec![middle(1), middle(2), middle(0)]);
                continue;
            }
            let centre = positions.len() as u32;
            positions.push(self.centroid(face));
            faces.extend((0..count).map(|k| vec![corners[k], middle(k), centre, middle(k + count - 1)]));
        }
        let halves = self.edges.keys().flat_map(|&e| [(e, e.0), (e, e.1)]);
        let creases = halves
            .filter(|&(e, _)| self.edges[&e].len() == 2)
            .map(|(e, end)| Crease {
                vertices: [end, number[&e]],
                sharpness: self.half(e, end),
            });
        let corners = self.corners.iter().map(|(&vertex, &s)| Corner {
            vertex,
            sharpness: if s >= INFINITE_SHARPNESS { s } else { (s - 1.0).max(0.0) },
        });
        ControlMesh {
            creases: creases.filter(|c| c.sharpness > 0.0).collect(),
            corners: corners.collect(),
            mesh: mesh(positions, faces),
            ..*self.control
        }
    }
}

/// The same points of both: a child of a face, and parameters counted from its first corner.
fn compare(what: &str, control: &ControlMesh, scheme: SubdivisionScheme, random: &mut Random) -> f64 {
    let is_loop = scheme != SubdivisionScheme::CatmullClark;
    let refined = Global::new(control, is_loop).refined();
    let [coarse, fine] = [control, &refined].map(|control| Subdivision::new(control, settings(scheme, 1)).expect(what));
    let mut worst: f64 = 0.0;
    let mut child = 0;
    for (face, corners) in (0u32..).zip(control.mesh.faces.iter()) {
        let count = corners.len();
        let children = if is_loop { 4 } else { count };
        for k in 0..children {
            let [s, t] = [random.below(1 << 20), random.below(1 << 20)].map(|x| f64::from(x) / f64::from(1 << 20));
            let [s, t] = if is_loop && s + t > 1.0 {
                [1.0 - s, 1.0 - t]
            } else {
                [s, t]
            };
            let [s, t] = [[s, t], [0.0, 0.0], [s, 0.0]][random.below(3) as usize];
            let at: RootPoint = if is_loop {
                let barycentric = [1.0 - s - t, s, t];
                let b = match k {
                    3 => barycentric.map(|b| (1.0 - b) / 2.0),
                    _ => {
                        let mut b = [0.0; 3];
                        (0..3).for_each(|i| b[(k + i) % 3] = barycentric[i] / 2.0);
                        b[k] += 0.5;
                        b
                    }
                };
                coarse.face_coord(face, b[1], b[2]).expect("in the face")
            } else if count == 4 {
                let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let [o, a, b] = [corners[k], corners[(k + 1) % 4], corners[(k + 3) % 4]];
                let [u, v] = [0, 1].map(|i| o[i] + (s * (a[i] - o[i]) + t * (b[i] - o[i])) / 2.0);
                coarse.face_coord(face, u, v).expect("in the face")
            } else {
                point_of_domain(face, count as u32, k as u32, [s, t])
            };
            let below = fine.face_coord(child + k as u32, s, t).expect("in the face");
            let off = coarse.point(at).distance(fine.point(below));
            assert!(off < 1e-12, "{what}: face {face}, child {k} at ({s}, {t}): {off:e}");
            worst = worst.max(off);
        }
        child += children as u32;
    }
    worst
}

fn sharpened(mut control: ControlMesh, random: &mut Random) -> ControlMesh {
    control
        .mesh
        .positions
        .iter_mut()
        .for_each(|p| *p += random.vector() * 0.2);
    let values = [0.4, 1.0, 1.3, 2.7, 4.2, 10.0];
    let global = Global::new(&control, false);
    let edges: Vec<Edge> = global.edges.keys().copied().collect();
    for (a, b) in edges {
        if random.below(4) == 0 {
            let sharpness = values[random.below(6) as usize];
            control.creases.push(Crease {
                vertices: [b, a],
                sharpness,
            });
        }
    }
    for vertex in 0..control.mesh.positions.len() as u32 {
        if random.below(8) == 0 {
            let sharpness = values[random.below(6) as usize];
            control.corners.push(Corner { vertex, sharpness });
        }
    }
    control
}

/// Creases and corners at random, of sharpness 0.3 to 5 or for ever.
pub fn any_sharpness(mut control: ControlMesh, random: &mut Random) -> ControlMesh {
    let value = |random: &mut Random| match random.below(4) {
        0 => INFINITE_SHARPNESS,
        _ => 0.3 + 4.7 * random.unit().powi(2),
    };
    let edges: Vec<Edge> = Global::new(&control, false).edges.keys().copied().collect();
    for (a, b) in edges {
        if random.below(6) == 0 {
            let sharpness = value(random);
            control.creases.push(Crease {
                vertices: [a, b],
                sharpness,
            });
        }
    }
    for vertex in 0..control.mesh.positions.len() as u32 {
        if random.below(10) == 0 {
            let sharpness = value(random);
            control.corners.push(Corner { vertex, sharpness });
        }
    }
    control
}

#[test]
fn a_refined_mesh_has_the_same_limit_surface() {
    let mut random = Random(17);
    let mut worst: f64 = 0.0;
    for round in 0..4 {
        for n in [3, 4, 5, 7, 10, 13] {
            for (shape, scheme) in [
                (
                    disc(n, SubdivisionScheme::CatmullClark),
                    SubdivisionScheme::CatmullClark,
                ),
                (prism(n.min(11)), SubdivisionScheme::CatmullClark),
                (disc(n, LOOP), LOOP),
            ] {
                let mut control = if round == 0 {
                    shape
                } else {
                    sharpened(shape, &mut random)
                };
                control.creasing = if round == 2 {
                    Creasing::Chaikin
                } else {
                    Creasing::Uniform
                };
                control.boundary = if round == 3 {
                    BoundaryRule::EdgesAndCorners
                } else {
                    BoundaryRule::Edges
                };
                worst = worst.max(compare(
                    &format!("{scheme:?}, round {round}, {n}"),
                    &control,
                    scheme,
                    &mut random,
                ));
            }
        }
    }
    println!("at most {worst:e} apart");
}
