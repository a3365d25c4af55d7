//! Subdivision of a whole mesh, step by step, in any number of dimensions, and limits of its vertices by masks: slow and simple.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// A rule of subdivision. Boundary edges are sharp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    CatmullClark,
    Loop,
    /// Loop's with Warren's weights.
    Warren,
}

/// A face of a refined mesh: its vertices, the face it came from, and the parameters of its corners there in units of 2^−level.
#[derive(Clone, Debug)]
pub struct Face {
    pub vertices: Vec<usize>,
    pub base: usize,
    pub params: Vec<[u32; 2]>,
}

/// A refined mesh with points of N coordinates.
#[derive(Clone, Debug)]
pub struct Refined<const N: usize> {
    pub scheme: Scheme,
    /// Whether boundary vertices with one face stay.
    pub sharp_corners: bool,
    pub points: Vec<[f64; N]>,
    pub faces: Vec<Face>,
}

/// A vertex on the limit surface with two tangents, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub struct Limit<const N: usize> {
    pub value: [f64; N],
    pub tangents: [[f64; N]; 2],
}

/// The neighbours of a vertex, counter-clockwise: ends of edges, and opposite corners of quads between them.
struct Ring {
    closed: bool,
    edges: Vec<usize>,
    diagonals: Vec<usize>,
}

/// Σ w p.
pub fn sum<const N: usize>(terms: impl IntoIterator<Item = (f64, [f64; N])>) -> [f64; N] {
    let mut total = [0.0; N];
    for (weight, point) in terms {
        total.iter_mut().zip(point).for_each(|(t, p)| *t += weight * p);
    }
    total
}

fn beta(scheme: Scheme, n: usize) -> f64 {
    let (valence, angle) = (n as f64, TAU / n as f64);
    match scheme {
        Scheme::Warren if n == 3 => 3.0 / 16.0,
        Scheme::Warren => 3.0 / (8.0 * valence),
        _ => (0.625 - (0.375 + angle.cos() / 4.0).powi(2)) / valence,
    }
}

impl<const N: usize> Refined<N> {
    pub fn new(scheme: Scheme, sharp_corners: bool, points: Vec<[f64; N]>, faces: &[Vec<u32>]) -> Self {
        let square = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let triangle = [[0, 0], [1, 0], [0, 1]];
        let face = |(base, vertices): (usize, &Vec<u32>)| Face {
            vertices: vertices.iter().map(|&v| v as usize).collect(),
            base,
            params: if vertices.len() == 3 {
                triangle.to_vec()
            } else {
                square.to_vec()
            },
        };
        Self {
            scheme,
            sharp_corners,
            points,
            faces: faces.iter().enumerate().map(face).collect(),
        }
    }

    /// The vertex at every (base face, i, j).
    pub fn by_parameter(&self) -> BTreeMap<(usize, u32, u32), usize> {
        let corners = |face: &Face| -> Vec<_> {
            let pairs = face.params.iter().zip(&face.vertices);
            pairs.map(|(&[i, j], &vertex)| ((face.base, i, j), vertex)).collect()
        };
        self.faces.iter().flat_map(corners).collect()
    }

    fn rings(&self) -> Vec<Ring> {
        let mut sectors: Vec<BTreeMap<usize, (usize, usize)>> = vec![BTreeMap::new(); self.points.len()];
        for Face { vertices, .. } in &self.faces {
            let n = vertices.len();
            for k in 0..n {
                let at = |step: usize| vertices[(k + step) % n];
                sectors[vertices[k]].insert(at(1), (at(2), at(n - 1)));
            }
        }
        sectors.iter().map(Self::ring).collect()
    }

    fn ring(sectors: &BTreeMap<usize, (usize, usize)>) -> Ring {
        let is_end = |vertex: &usize| sectors.values().any(|(_, last)| last == vertex);
        let open = sectors.keys().find(|start| !is_end(start));
        let start = open.or(sectors.keys().min()).copied();
        let mut ring = Ring {
            closed: open.is_none(),
            edges: start.into_iter().collect(),
            diagonals: Vec::new(),
        };
        let mut at = start;
        while let Some(&(diagonal, next)) = at.and_then(|at| sectors.get(&at)) {
            ring.diagonals.push(diagonal);
            if Some(next) == start {
                break;
            }
            ring.edges.push(next);
            at = Some(next);
        }
        ring
    }

    fn stays(&self, ring: &Ring) -> bool {
        self.sharp_corners && !ring.closed && ring.edges.len() == 2
    }

    fn moved(&self, vertex: usize, ring: &Ring, face_points: &BTreeMap<usize, Vec<[f64; N]>>) -> [f64; N] {
        let (own, n) = (self.points[vertex], ring.edges.len());
        let edges = || ring.edges.iter().map(|&e| self.points[e]);
        if n == 0 || self.stays(ring) {
            return own;
        }
        if !ring.closed {
            let ends = [0, n - 1].map(|k| (0.125, self.points[ring.edges[k]]));
            return sum([(0.75, own), ends[0], ends[1]]);
        }
        let valence = n as f64;
        if self.scheme == Scheme::CatmullClark {
            let square = valence * valence;
            let faces = face_points[&vertex].iter().map(|&f| (1.0 / square, f));
            let middles = edges().map(|e| (1.0 / square, e));
            return sum([((valence - 2.0) / valence, own)]
                .into_iter()
                .chain(faces)
                .chain(middles));
        }
        let b = beta(self.scheme, n);
        sum([(1.0 - valence * b, own)].into_iter().chain(edges().map(|e| (b, e))))
    }

    /// After one more step.
    pub fn refine(&self) -> Self {
        let quads = self.scheme == Scheme::CatmullClark;
        let centre = |face: &Face| {
            let weight = 1.0 / face.vertices.len() as f64;
            sum(face.vertices.iter().map(|&v| (weight, self.points[v])))
        };
        let centres: Vec<[f64; N]> = self.faces.iter().map(centre).collect();
        let mut centres_of: BTreeMap<usize, Vec<[f64; N]>> = BTreeMap::new();
        let mut sides: BTreeMap<[usize; 2], Vec<(usize, usize)>> = BTreeMap::new();
        for (index, Face { vertices, .. }) in self.faces.iter().enumerate() {
            for (k, &a) in vertices.iter().enumerate() {
                let b = vertices[(k + 1) % vertices.len()];
                centres_of.entry(a).or_default().push(centres[index]);
                sides.entry([a.min(b), a.max(b)]).or_default().push((index, k));
            }
        }
        let rings = self.rings();
        let mut points: Vec<[f64; N]> = (0..self.points.len())
            .map(|vertex| self.moved(vertex, &rings[vertex], &centres_of))
            .collect();
        let mut edge_vertex = BTreeMap::new();
        for (&[a, b], faces) in &sides {
            let ends = |weight: f64| [(weight, self.points[a]), (weight, self.points[b])];
            let opposite = |&(face, k): &(usize, usize)| self.points[self.faces[face].vertices[(k + 2) % 3]];
            let point = match (faces.len(), quads) {
                (1, _) => sum(ends(0.5)),
                (_, true) => sum(ends(0.25)
                    .into_iter()
                    .chain(faces.iter().map(|&(f, _)| (0.25, centres[f])))),
                _ => sum(ends(0.375)
                    .into_iter()
                    .chain(faces.iter().map(|side| (0.125, opposite(side))))),
            };
            edge_vertex.insert([a, b], points.len());
            points.push(point);
        }
        let first_centre = points.len();
        if quads {
            points.extend(&centres);
        }
        let mut faces = Vec::new();
        for (index, face) in self.faces.iter().enumerate() {
            let n = face.vertices.len();
            let vertex = |k: usize| (face.vertices[k % n], face.params[k % n].map(|p| 2 * p));
            let middle = |k: usize| {
                let ([a, b], [p, q]) = (
                    [0, 1].map(|s| face.vertices[(k + s) % n]),
                    [0, 1].map(|s| face.params[(k + s) % n]),
                );
                (edge_vertex[&[a.min(b), a.max(b)]], [p[0] + q[0], p[1] + q[1]])
            };
            let mut push = |corners: &[(usize, [u32; 2])]| {
                faces.push(Face {
                    vertices: corners.iter().map(|c| c.0).collect(),
                    base: face.base,
                    params: corners.iter().map(|c| c.1).collect(),
                });
            };
            for k in 0..n {
                if quads {
                    let [p, q] = [face.params[0], face.params[2]];
                    let inner = (first_centre + index, [p[0] + q[0], p[1] + q[1]]);
                    let mut corners = [vertex(k), middle(k), inner, middle(k + n - 1)];
                    corners.rotate_right(k);
                    push(&corners);
                } else {
                    let mut corners = [vertex(k), middle(k), middle(k + n - 1)];
                    corners.rotate_right(k);
                    push(&corners);
                }
            }
            if !quads {
                push(&[middle(0), middle(1), middle(2)]);
            }
        }
        Self { points, faces, ..*self }
    }

    /// Every vertex on the limit surface.
    pub fn limits(&self) -> Vec<Limit<N>> {
        let rings = self.rings();
        let limit = |(vertex, ring): (usize, &Ring)| match (ring.closed, self.scheme) {
            (true, Scheme::CatmullClark) => self.quad_interior(vertex, ring),
            (true, _) => self.triangle_interior(vertex, ring),
            (false, _) if self.stays(ring) || ring.edges.len() < 2 => self.sharp(vertex, ring),
            (false, Scheme::CatmullClark) => self.quad_boundary(vertex, ring),
            (false, _) => self.triangle_boundary(vertex, ring),
        };
        rings.iter().enumerate().map(limit).collect()
    }

    fn sharp(&self, vertex: usize, ring: &Ring) -> Limit<N> {
        let own = self.points[vertex];
        let edge = |k: usize| {
            ring.edges
                .get(k)
                .map_or([0.0; N], |&e| sum([(1.0, self.points[e]), (-1.0, own)]))
        };
        Limit {
            value: own,
            tangents: [edge(0), edge(1)],
        }
    }

    fn triangle_interior(&self, vertex: usize, ring: &Ring) -> Limit<N> {
        let n = ring.edges.len();
        let chi = 1.0 / (n as f64 + 3.0 / (8.0 * beta(self.scheme, n)));
        let weighted = |weight: &dyn Fn(f64) -> f64| -> Vec<(f64, [f64; N])> {
            let angle = |i: usize| TAU * i as f64 / n as f64;
            ring.edges
                .iter()
                .enumerate()
                .map(|(i, &e)| (weight(angle(i)), self.points[e]))
                .collect()
        };
        let own = (1.0 - n as f64 * chi, self.points[vertex]);
        Limit {
            value: sum(weighted(&|_| chi).into_iter().chain([own])),
            tangents: [sum(weighted(&f64::cos)), sum(weighted(&f64::sin))],
        }
    }

    fn quad_interior(&self, vertex: usize, ring: &Ring) -> Limit<N> {
        let valence = ring.edges.len() as f64;
        let total = valence * (valence + 5.0);
        let c = |i: f64| (TAU * i / valence).cos();
        let a = 1.0 + c(1.0) + (PI / valence).cos() * (2.0 * (9.0 + c(1.0))).sqrt();
        let around = |edge: &dyn Fn(f64) -> f64, face: &dyn Fn(f64) -> f64| -> Vec<(f64, [f64; N])> {
            let edges = ring
                .edges
                .iter()
                .enumerate()
                .map(|(i, &e)| (edge(i as f64), self.points[e]));
            let faces = ring
                .diagonals
                .iter()
                .enumerate()
                .map(|(i, &f)| (face(i as f64), self.points[f]));
            edges.chain(faces).collect()
        };
        let own = (valence * valence / total, self.points[vertex]);
        let tangent = |shift: f64| sum(around(&|i| a * c(i - shift), &|i| c(i - shift) + c(i + 1.0 - shift)));
        Limit {
            value: sum(around(&|_| 4.0 / total, &|_| 1.0 / total).into_iter().chain([own])),
            tangents: [tangent(0.0), tangent(1.0)],
        }
    }

    /// The value on the boundary and the tangent along it.
    fn along_boundary(&self, vertex: usize, ring: &Ring) -> [[f64; N]; 2] {
        let [first, last] = [0, ring.edges.len() - 1].map(|k| self.points[ring.edges[k]]);
        [
            sum([(1.0 / 6.0, first), (4.0 / 6.0, self.points[vertex]), (1.0 / 6.0, last)]),
            sum([(1.0, first), (-1.0, last)]),
        ]
    }

    fn triangle_boundary(&self, vertex: usize, ring: &Ring) -> Limit<N> {
        let k = ring.edges.len();
        let [value, along] = self.along_boundary(vertex, ring);
        let (own, edge) = (self.points[vertex], |i: usize| self.points[ring.edges[i]]);
        let across = match k {
            2 => sum([(1.0, edge(0)), (1.0, edge(1)), (-2.0, own)]),
            3 => sum([(1.0, edge(1)), (-1.0, own)]),
            _ => {
                let angle = PI / (k - 1) as f64;
                let (s, d) = (1.0 / (angle / 2.0).tan(), 1.0 + 2.0 * angle.cos());
                let ends = -s * angle.cos() / d;
                let inner = (1..k - 1).map(|i| ((i as f64 * angle).sin(), edge(i)));
                sum([(-s / d, own), (ends, edge(0)), (ends, edge(k - 1))]
                    .into_iter()
                    .chain(inner))
            }
        };
        Limit {
            value,
            tangents: [along, across],
        }
    }

    fn quad_boundary(&self, vertex: usize, ring: &Ring) -> Limit<N> {
        let k = ring.diagonals.len();
        let [value, along] = self.along_boundary(vertex, ring);
        let angle = PI / k as f64;
        let cot = 1.0 / (angle / 2.0).tan();
        let root = (2.0 * (9.0 + angle.cos())).sqrt();
        let lambda = (5.0 + angle.cos() + (angle / 2.0).cos() * root) / 16.0;
        let ends = (lambda * angle.sin() - (2.0 * lambda - 0.25) * cot) / (lambda - 0.25);
        let own = -2.0 * ends - (16.0 * lambda - 2.0) * cot;
        let sine = |i: usize| (i as f64 * angle).sin();
        let inner = (1..k).map(|i| ((16.0 * lambda - 4.0) * sine(i), self.points[ring.edges[i]]));
        let faces = (0..k).map(|i| (sine(i) + sine(i + 1), self.points[ring.diagonals[i]]));
        let boundary = [
            (own, self.points[vertex]),
            (ends, self.points[ring.edges[0]]),
            (ends, self.points[ring.edges[k]]),
        ];
        Limit {
            value,
            tangents: [along, sum(boundary.into_iter().chain(inner).chain(faces))],
        }
    }
}
