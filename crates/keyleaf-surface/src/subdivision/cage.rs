//! A checked control mesh, and the rings of its faces.

use super::ring::{Fan, Ring, Spoke};
use super::sharpness::mean_of_others;
use super::{BoundaryRule, ControlMesh, Creasing, INFINITE_SHARPNESS, MAX_FAN, SubdivisionError, SubdivisionScheme};
use glam::DVec3;
use keyleaf_key::{HalfEdge, RootPoint, Topology};
use std::collections::HashMap;

/// A control mesh with its adjacency and sharpness.
#[derive(Clone, Debug)]
pub struct Cage {
    /// How all its faces meet.
    pub topology: Topology,
    /// By vertex.
    pub positions: Vec<DVec3>,
    /// How sharpness falls.
    pub creasing: Creasing,
    /// The faces that are part of the surface.
    pub drawn: Vec<u32>,
    /// By half-edge.
    edges: Vec<f64>,
    /// By half-edge: the mean sharpness of the other semi-sharp edges at its end.
    beyond: Vec<f64>,
    /// By vertex.
    vertices: Vec<f64>,
}

/// Where a ring is in its cage.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The ring.
    pub ring: Ring,
    /// The vertices of the cage, by vertex of the ring.
    pub vertices: Vec<u32>,
}

impl Cage {
    pub fn new(control: &ControlMesh, scheme: SubdivisionScheme) -> Result<Self, SubdivisionError> {
        let topology = control.mesh.topology()?;
        if let SubdivisionScheme::Loop(_) = scheme {
            let corners = |face: &u32| topology.corner_count(*face);
            if let Some(face) = (0..topology.face_count()).find(|face| corners(face) != 3) {
                let corners = corners(&face);
                return Err(SubdivisionError::NoTriangle { face, corners });
            }
        }
        check_fans(&topology)?;
        let mut cage = Self {
            edges: vec![0.0; topology.half_edge_count() as usize],
            beyond: Vec::new(),
            vertices: vec![0.0; topology.vertex_count()],
            positions: control.mesh.positions.clone(),
            creasing: control.creasing,
            drawn: Vec::new(),
            topology,
        };
        cage.set_creases(control)?;
        cage.set_corners(control)?;
        let at_boundary = cage.set_boundaries(control.boundary);
        cage.beyond = cage.means_beyond();
        cage.drawn = (0..cage.topology.face_count())
            .filter(|&face| {
                let touches = |&vertex: &u32| at_boundary[vertex as usize];
                control.boundary != BoundaryRule::None || !cage.topology.vertices(face).iter().any(touches)
            })
            .collect();
        if cage.drawn.is_empty() {
            return Err(SubdivisionError::NothingDrawn);
        }
        Ok(cage)
    }

    fn set_creases(&mut self, control: &ControlMesh) -> Result<(), SubdivisionError> {
        let half_edges: HashMap<[u32; 2], HalfEdge> = if control.creases.is_empty() {
            HashMap::new()
        } else {
            let roots = self.topology.roots();
            let keyed = roots.map(|root| (root.face, root.root));
            keyed
                .map(|(face, root)| (sorted(self.ends(face, root)), HalfEdge { face, root }))
                .collect()
        };
        let mut named = HashMap::new();
        for (index, crease) in control.creases.iter().enumerate() {
            check_sharpness("crease", index, crease.sharpness)?;
            let vertices = crease.vertices;
            let Some(&HalfEdge { face, root }) = half_edges.get(&sorted(vertices)) else {
                return Err(SubdivisionError::NoSuchEdge {
                    crease: index,
                    vertices,
                });
            };
            if let Some(earlier) = named.insert(sorted(vertices), index) {
                return Err(SubdivisionError::DuplicateCrease {
                    creases: [earlier, index],
                    vertices,
                });
            }
            let twin = self.topology.twin(face, root);
            for HalfEdge { face, root } in [Some(HalfEdge { face, root }), twin].into_iter().flatten() {
                self.edges[self.topology.half_edge_index(face, root) as usize] =
                    crease.sharpness.min(INFINITE_SHARPNESS);
            }
        }
        Ok(())
    }

    fn set_corners(&mut self, control: &ControlMesh) -> Result<(), SubdivisionError> {
        let mut named = HashMap::new();
        for (index, corner) in control.corners.iter().enumerate() {
            check_sharpness("corner", index, corner.sharpness)?;
            let vertex_count = self.vertices.len();
            let Some(sharpness) = self.vertices.get_mut(corner.vertex as usize) else {
                return Err(SubdivisionError::NoSuchVertex {
                    corner: index,
                    vertex: corner.vertex,
                    vertex_count,
                });
            };
            *sharpness = corner.sharpness.min(INFINITE_SHARPNESS);
            if let Some(earlier) = named.insert(corner.vertex, index) {
                return Err(SubdivisionError::DuplicateCorner {
                    corners: [earlier, index],
                    vertex: corner.vertex,
                });
            }
        }
        Ok(())
    }

    /// Makes boundary edges sharp, and vertices where fans meet that no edge joins. Which vertices are at a boundary.
    fn set_boundaries(&mut self, rule: BoundaryRule) -> Vec<bool> {
        let mut at_boundary = vec![false; self.vertices.len()];
        let mut boundary_edges = vec![0u32; self.vertices.len()];
        let mut faces = vec![0u32; self.vertices.len()];
        for root in self.topology.roots() {
            let [start, end] = self.ends(root.face, root.root).map(|vertex| vertex as usize);
            faces[start] += 1;
            if self.topology.twin(root.face, root.root).is_none() {
                self.edges[self.topology.half_edge_index(root.face, root.root) as usize] = INFINITE_SHARPNESS;
                for vertex in [start, end] {
                    at_boundary[vertex] = true;
                    boundary_edges[vertex] += 1;
                }
            }
        }
        for vertex in 0..self.vertices.len() {
            let Some(owner) = self.topology.vertex_owner(vertex as u32) else {
                continue;
            };
            // An open fan has two boundary edges, and a vertex with one face has just that fan.
            let has_fans = boundary_edges[vertex] > 2 || self.fan_size(owner) < faces[vertex];
            let is_corner = rule == BoundaryRule::EdgesAndCorners && faces[vertex] == 1;
            if has_fans || is_corner {
                self.vertices[vertex] = INFINITE_SHARPNESS;
            }
        }
        at_boundary
    }

    fn fan_size(&self, at: HalfEdge) -> u32 {
        self.fan_faces(at).0.len() as u32
    }

    fn means_beyond(&self) -> Vec<f64> {
        if self.creasing == Creasing::Uniform {
            return self.edges.clone();
        }
        // Sharpness of the edges at every vertex, each edge once.
        let mut at_vertex: Vec<Vec<(u32, f64)>> = vec![Vec::new(); self.vertices.len()];
        for root in self.topology.roots() {
            let owner = self.topology.half_edge_owner(root.face, root.root);
            if (owner.face, owner.root) == (root.face, root.root) {
                let [start, end] = self.ends(root.face, root.root);
                let sharpness = self.edges[self.topology.half_edge_index(root.face, root.root) as usize];
                at_vertex[start as usize].push((end, sharpness));
                at_vertex[end as usize].push((start, sharpness));
            }
        }
        let mean = |[start, end]: [u32; 2]| {
            let edges = &at_vertex[end as usize];
            let values: Vec<f64> = edges.iter().map(|&(_, sharpness)| sharpness).collect();
            let own = edges.iter().position(|&(other, _)| other == start).unwrap_or(0);
            mean_of_others(&values, own)
        };
        let roots = self.topology.roots();
        roots.map(|root| mean(self.ends(root.face, root.root))).collect()
    }

    /// Start and end of a half-edge.
    fn ends(&self, face: u32, root: u32) -> [u32; 2] {
        let corners = self.topology.vertices(face);
        [corners[root as usize], corners[(root as usize + 1) % corners.len()]]
    }

    /// A point of a drawn face in the control mesh.
    pub fn place(&self, at: RootPoint) -> RootPoint {
        RootPoint {
            face: self.drawn[at.face as usize],
            ..at
        }
    }

    /// The ring of a face.
    pub fn ring(&self, face: u32) -> Placed {
        let corners = self.topology.vertices(face);
        let mut numbering = Numbering {
            vertices: corners.to_vec(),
            faces: vec![face],
            ring_faces: vec![(0..corners.len() as u32).collect()],
        };
        let fans = (0..corners.len() as u32)
            .map(|root| self.fan(HalfEdge { face, root }, &mut numbering))
            .collect();
        Placed {
            ring: Ring {
                vertex_count: numbering.vertices.len(),
                faces: numbering.ring_faces,
                fans,
            },
            vertices: numbering.vertices,
        }
    }

    /// The corners of the faces about a corner, counter-clockwise, the place of its own, and whether they surround it.
    fn fan_faces(&self, at: HalfEdge) -> (Vec<HalfEdge>, usize, bool) {
        let previous =
            |at: HalfEdge| (at.root + self.topology.corner_count(at.face) - 1) % self.topology.corner_count(at.face);
        let mut corners = vec![at];
        let mut last = at;
        while let Some(twin) = self.topology.twin(last.face, previous(last)) {
            if twin == at {
                return (corners, 0, true);
            }
            corners.push(twin);
            last = twin;
        }
        let mut before = Vec::new();
        let mut first = at;
        while let Some(twin) = self.topology.twin(first.face, first.root) {
            first = HalfEdge {
                face: twin.face,
                root: (twin.root + 1) % self.topology.corner_count(twin.face),
            };
            before.push(first);
        }
        before.reverse();
        let own = before.len();
        before.extend(corners);
        (before, own, false)
    }

    fn fan(&self, at: HalfEdge, numbering: &mut Numbering) -> Fan {
        let (corners, own, is_closed) = self.fan_faces(at);
        let vertex = self.topology.vertex(at.face, at.root);
        let mut faces = Vec::with_capacity(corners.len());
        let mut spokes = Vec::with_capacity(corners.len() + 1);
        for corner in &corners {
            faces.push(numbering.face(corner, self.topology.vertices(corner.face)));
            let index = self.topology.half_edge_index(corner.face, corner.root) as usize;
            spokes.push(Spoke {
                vertex: numbering.vertex(self.ends(corner.face, corner.root)[1]),
                sharpness: self.edges[index],
                beyond: self.beyond[index],
            });
        }
        if let (false, Some(last)) = (is_closed, corners.last()) {
            // A boundary edge, which is sharp for ever.
            let count = self.topology.corner_count(last.face);
            let far = self.topology.vertex(last.face, (last.root + count - 1) % count);
            spokes.push(Spoke {
                vertex: numbering.vertex(far),
                sharpness: INFINITE_SHARPNESS,
                beyond: INFINITE_SHARPNESS,
            });
        }
        Fan {
            vertex: numbering.vertex(vertex),
            sharpness: self.vertices[vertex as usize],
            own,
            spokes,
            faces,
        }
    }
}

/// Vertices and faces of a ring in the order in which they are met.
struct Numbering {
    vertices: Vec<u32>,
    faces: Vec<u32>,
    ring_faces: Vec<Vec<u32>>,
}

impl Numbering {
    fn vertex(&mut self, vertex: u32) -> u32 {
        number(&mut self.vertices, vertex)
    }

    fn face(&mut self, at: &HalfEdge, corners: &[u32]) -> u32 {
        let known = self.faces.len();
        let face = number(&mut self.faces, at.face);
        if face as usize == known {
            let from = at.root as usize;
            let turned = corners[from..].iter().chain(&corners[..from]);
            let vertices = turned.map(|&vertex| self.vertex(vertex)).collect();
            self.ring_faces.push(vertices);
        }
        face
    }
}

fn number(known: &mut Vec<u32>, item: u32) -> u32 {
    let place = known.iter().position(|&other| other == item);
    place.unwrap_or_else(|| {
        known.push(item);
        known.len() - 1
    }) as u32
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Refuses vertices and polygons with very many faces or corners about them.
fn check_fans(topology: &Topology) -> Result<(), SubdivisionError> {
    let mut faces = vec![0u32; topology.vertex_count()];
    for face in 0..topology.face_count() {
        check_fan("face", face, "corners", topology.corner_count(face))?;
        let corners = topology.vertices(face);
        corners.iter().for_each(|&vertex| faces[vertex as usize] += 1);
    }
    (0..)
        .zip(faces)
        .try_for_each(|(vertex, found)| check_fan("vertex", vertex, "faces", found))
}

fn check_fan(what: &'static str, index: u32, of: &'static str, found: u32) -> Result<(), SubdivisionError> {
    if found <= MAX_FAN {
        return Ok(());
    }
    Err(SubdivisionError::TooManyAround { what, index, of, found })
}

fn check_sharpness(what: &'static str, index: usize, sharpness: f64) -> Result<(), SubdivisionError> {
    if sharpness.is_finite() && sharpness >= 0.0 {
        Ok(())
    } else {
        Err(SubdivisionError::Sharpness { what, index, sharpness })
    }
}
