//! From the polygons of a file to a mesh: equal positions become one vertex, and what cannot be a face is mended.
//!
//! In this order: positions that are equal bit by bit (after −0 → +0) are welded; corners that fall together are
//! dropped, and faces with fewer than three left; polygons that are not convex, or pass through a vertex twice, are
//! triangulated; faces that are there twice are dropped; vertices without a face are dropped. Corner attributes stay
//! with their corners. Whatever is done is a note. Time O(n), but O(k²) for a concave polygon of k corners.

mod control;

use std::collections::{HashMap, HashSet};
use std::path::Path;

use glam::DVec3;
use keyleaf_key::{Topology, TopologyError};

use crate::error::ImportError;
use crate::note::Note;
use crate::soup::Soup;
use crate::triangulate::{is_convex, triangulate};
use keyleaf_surface::{CornerAttributes, Faces, PolygonMesh};

pub(crate) use control::weld_control;

/// From this many faces on, a mesh gets a warning: three or four leaves a face is the least there can be.
pub const MANY_FACES: usize = 1_000_000;

/// A welded and checked mesh.
#[derive(Debug)]
pub(crate) struct Welded {
    pub mesh: PolygonMesh,
    /// Material of each face; empty if all have material 0.
    pub materials: Vec<u32>,
}

/// Welds, mends and checks the polygons of `file`.
pub(crate) fn weld(file: &Path, soup: &Soup, notes: &mut Vec<Note>) -> Result<Welded, ImportError> {
    if soup.face_count() == 0 {
        let reason = format!("the mesh is empty: {} vertices, no faces", soup.positions.len());
        return Err(ImportError::empty(file, reason));
    }
    let (vertex_of, distinct) = weld_positions(&soup.positions);
    let mut welding_notes = Vec::new();
    let error = match build(file, soup, &vertex_of, &mut welding_notes) {
        Ok(welded) => {
            if distinct < soup.positions.len() {
                let count = soup.positions.len();
                let text = format!("{count} vertices with {distinct} positions: equal ones are welded");
                notes.push(Note::remark(file, text));
            }
            notes.append(&mut welding_notes);
            return Ok(welded);
        }
        Err(error) => error,
    };
    // A file that states its topology may mean two vertices at one place to be two.
    if soup.states_topology && distinct < soup.positions.len() && is_no_surface(&error) {
        let own: Vec<u32> = (0..soup.positions.len() as u32).collect();
        let mut own_notes = Vec::new();
        if let Ok(welded) = build(file, soup, &own, &mut own_notes) {
            let text = "equal positions are not welded, since that would give no surface; \
                small gaps may show where such vertices meet";
            notes.push(Note::warning(file, text));
            notes.append(&mut own_notes);
            return Ok(welded);
        }
    }
    Err(error)
}

fn is_no_surface(error: &ImportError) -> bool {
    matches!(error, ImportError::Topology { .. } | ImportError::Empty { .. })
}

/// For each vertex the first one with equal position, and how many different positions there are.
fn weld_positions(positions: &[DVec3]) -> (Vec<u32>, usize) {
    let mut first = HashMap::with_capacity(positions.len());
    let vertex_of = positions
        .iter()
        .zip(0..)
        .map(|(p, index)| {
            *first
                .entry((*p + DVec3::ZERO).to_array().map(f64::to_bits))
                .or_insert(index)
        })
        .collect();
    (vertex_of, first.len())
}

/// Faces made of corners of a soup, which is how corners keep their attributes.
#[derive(Default)]
struct Selection {
    corners: Vec<u32>,
    ends: Vec<u32>,
    /// Face of the soup that each face comes from.
    origin: Vec<u32>,
}

impl Selection {
    fn push(&mut self, corners: impl IntoIterator<Item = u32>, origin: u32) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len() as u32);
        self.origin.push(origin);
    }

    fn iter(&self) -> impl Iterator<Item = (&[u32], u32)> {
        let mut first = 0;
        self.ends.iter().zip(&self.origin).map(move |(&end, &origin)| {
            let face = &self.corners[first..end as usize];
            first = end as usize;
            (face, origin)
        })
    }
}

fn build(file: &Path, soup: &Soup, vertex_of: &[u32], notes: &mut Vec<Note>) -> Result<Welded, ImportError> {
    let vertex = |corner: u32| vertex_of[soup.corners[corner as usize] as usize];
    let mut tell = |count: usize, singular: &str, plural: &str| match count {
        0 => {}
        1 => notes.push(Note::remark(file, format!("1 {singular}"))),
        _ => notes.push(Note::remark(file, format!("{count} {plural}"))),
    };
    let (faces, collapsed) = without_collapsed(soup, &vertex);
    tell(
        collapsed,
        "face has fewer than 3 different corners and is dropped",
        "faces have fewer than 3 different corners and are dropped",
    );
    let (faces, cut) = without_concave(soup, &vertex, faces);
    tell(
        cut,
        "face is not convex and is triangulated",
        "faces are not convex and are triangulated",
    );
    let (faces, doubled) = without_doubled(&vertex, faces);
    tell(
        doubled,
        "face is there twice and is dropped",
        "faces are there twice and are dropped",
    );
    if faces.ends.is_empty() {
        return Err(ImportError::empty(
            file,
            "the mesh is empty: all its faces are degenerate",
        ));
    }
    let (mut welded, unused) = gather(soup, vertex_of, &faces);
    if let Some((face, [u, v])) = tame_uvs(&mut welded.mesh) {
        let place = soup.place_of_face(faces.origin[face] as usize);
        let reason = format!("the texture coordinate ({u}, {v}) is too large for its face");
        return Err(ImportError::malformed(file, place, reason));
    }
    tell(
        unused,
        "vertex has no face and is dropped",
        "vertices have no face and are dropped",
    );
    if welded.mesh.faces.len() > MANY_FACES {
        let text = format!(
            "{} faces: keyleaf keeps three or four leaves a face at the least, so that this mesh is drawn \
             finer than a distant view needs; a coarser model would be faster",
            welded.mesh.faces.len()
        );
        notes.push(Note::warning(file, text));
    }
    match Topology::new(welded.mesh.positions.len(), welded.mesh.faces.iter()) {
        Ok(_) => Ok(welded),
        Err(source) => {
            let origin = origin_of(soup, |face| faces.origin.get(face as usize).copied(), &source);
            Err(ImportError::Topology {
                file: file.to_path_buf(),
                source,
                origin,
            })
        }
    }
}

/// Drops corners that fall together with the one before, and faces with fewer than three left.
fn without_collapsed(soup: &Soup, vertex: &impl Fn(u32) -> u32) -> (Selection, usize) {
    let mut kept = Selection::default();
    let mut collapsed = 0;
    let mut corners = Vec::new();
    for face in 0..soup.face_count() {
        corners.clear();
        for corner in soup.face(face) {
            let corner = corner as u32;
            if corners.last().is_none_or(|&last| vertex(last) != vertex(corner)) {
                corners.push(corner);
            }
        }
        while corners.len() > 1 && vertex(corners[0]) == vertex(corners[corners.len() - 1]) {
            corners.pop();
        }
        let repeats = corners.len() == 3 && vertex(corners[0]) == vertex(corners[2]);
        if corners.len() < 3 || repeats {
            collapsed += 1;
        } else {
            kept.push(corners.iter().copied(), face as u32);
        }
    }
    (kept, collapsed)
}

/// Triangulates what is not convex or passes through a vertex twice.
fn without_concave(soup: &Soup, vertex: &impl Fn(u32) -> u32, faces: Selection) -> (Selection, usize) {
    let position = |corner: u32| soup.positions[soup.corners[corner as usize] as usize];
    let is_simple = |face: &[u32]| {
        let mut vertices: Vec<u32> = face.iter().map(|&c| vertex(c)).collect();
        vertices.sort_unstable();
        vertices.windows(2).all(|w| w[0] != w[1])
    };
    let keep = |face: &[u32]| {
        face.len() == 3 || is_simple(face) && is_convex(&face.iter().map(|&c| position(c)).collect::<Vec<_>>())
    };
    let concave: Vec<bool> = faces.iter().map(|(face, _)| !keep(face)).collect();
    let cut = concave.iter().filter(|&&c| c).count();
    if cut == 0 {
        return (faces, 0);
    }
    let edge = |a: u32, b: u32| (a.min(b), a.max(b));
    let mut edges = HashSet::new();
    for (face, _) in faces.iter() {
        for (i, &corner) in face.iter().enumerate() {
            edges.insert(edge(vertex(corner), vertex(face[(i + 1) % face.len()])));
        }
    }
    let mut kept = Selection::default();
    for ((face, origin), concave) in faces.iter().zip(concave) {
        if !concave {
            kept.push(face.iter().copied(), origin);
            continue;
        }
        let points: Vec<DVec3> = face.iter().map(|&c| position(c)).collect();
        let vertices: Vec<u32> = face.iter().map(|&c| vertex(c)).collect();
        for triangle in triangulate(&points, &vertices, |a, b| edges.contains(&edge(a, b))) {
            let corners = triangle.map(|i| face[i]);
            for i in 0..3 {
                edges.insert(edge(vertex(corners[i]), vertex(corners[(i + 1) % 3])));
            }
            kept.push(corners, origin);
        }
    }
    (kept, cut)
}

/// Drops faces with the same vertices in the same order as an earlier one.
fn without_doubled(vertex: &impl Fn(u32) -> u32, faces: Selection) -> (Selection, usize) {
    let mut seen: HashSet<Box<[u32]>> = HashSet::with_capacity(faces.ends.len());
    let mut kept = Selection::default();
    let mut doubled = 0;
    for (face, origin) in faces.iter() {
        let mut cycle: Box<[u32]> = face.iter().map(|&c| vertex(c)).collect();
        let smallest = (0..cycle.len()).min_by_key(|&i| cycle[i]).unwrap_or(0);
        cycle.rotate_left(smallest);
        if seen.insert(cycle) {
            kept.push(face.iter().copied(), origin);
        } else {
            doubled += 1;
        }
    }
    (kept, doubled)
}

/// The mesh of the chosen faces, with its vertices in the order of the file, and how many positions no face uses.
fn gather(soup: &Soup, vertex_of: &[u32], faces: &Selection) -> (Welded, usize) {
    const UNUSED: u32 = u32::MAX;
    let mut new_index = vec![UNUSED; soup.positions.len()];
    for &corner in &faces.corners {
        new_index[vertex_of[soup.corners[corner as usize] as usize] as usize] = 0;
    }
    let mut positions = Vec::new();
    let mut unused = 0;
    for (old, new) in new_index.iter_mut().enumerate() {
        if *new != UNUSED {
            *new = positions.len() as u32;
            positions.push(soup.positions[old] + DVec3::ZERO);
        } else if vertex_of[old] as usize == old {
            unused += 1;
        }
    }
    let vertices = faces
        .corners
        .iter()
        .map(|&corner| new_index[vertex_of[soup.corners[corner as usize] as usize] as usize]);
    let pick = |&corner: &u32| corner as usize;
    let at_corners = faces.corners.iter().map(pick);
    let corners = CornerAttributes {
        uvs: (!soup.uvs.is_empty()).then(|| at_corners.clone().map(|c| soup.uvs[c]).collect()),
        normals: (!soup.normals.is_empty()).then(|| at_corners.clone().map(|c| soup.normals[c]).collect()),
        colours: (!soup.colours.is_empty()).then(|| at_corners.clone().map(|c| soup.colours[c]).collect()),
    };
    let of_face = |&face: &u32| soup.materials.get(face as usize).copied().unwrap_or(0);
    let materials = if soup.materials.is_empty() {
        Vec::new()
    } else {
        faces.origin.iter().map(of_face).collect()
    };
    let vertices: Vec<u32> = vertices.collect();
    let starts = std::iter::once(0).chain(faces.ends.iter().copied());
    let face = |(start, &end): (u32, &u32)| &vertices[start as usize..end as usize];
    let faces: Faces = starts.zip(&faces.ends).map(face).collect();
    (
        Welded {
            mesh: PolygonMesh {
                positions,
                faces,
                corners,
            },
            materials,
        },
        unused,
    )
}

/// Texture coordinates beyond this lose their fraction in f32.
const LARGEST_UV: f32 = 65_536.0;

/// Moves the texture coordinates of faces that lie far out by whole numbers, which changes no repeated picture; gives
/// the first face and coordinate that stay too large.
fn tame_uvs(mesh: &mut PolygonMesh) -> Option<(usize, [f32; 2])> {
    let uvs = mesh.corners.uvs.as_mut()?;
    let mut first = 0;
    for (index, face) in mesh.faces.iter().enumerate() {
        let of_face = uvs.get_mut(first..first + face.len())?;
        first += face.len();
        let fits = |uv: &[f32; 2]| uv.iter().all(|c| c.abs() <= LARGEST_UV);
        if of_face.iter().all(fits) {
            continue;
        }
        for axis in 0..2 {
            let least = of_face.iter().map(|uv| uv[axis]).fold(f32::INFINITY, f32::min).floor();
            of_face.iter_mut().for_each(|uv| uv[axis] -= least);
        }
        if let Some(uv) = of_face.iter().find(|uv| !fits(uv)) {
            return Some((index, *uv));
        }
    }
    None
}

/// Where the faces of a topology error stand in the file, for its message; `origin` gives the face of the soup.
fn origin_of(soup: &Soup, origin: impl Fn(u32) -> Option<u32>, error: &TopologyError) -> String {
    let named: Vec<u32> = match error {
        TopologyError::TooFewCorners { face, .. }
        | TopologyError::TooManyCorners { face, .. }
        | TopologyError::TooManyHalfEdges { face }
        | TopologyError::IndexOutOfRange { face, .. }
        | TopologyError::RepeatedIndex { face, .. } => vec![*face],
        TopologyError::DuplicateFace { faces } | TopologyError::InconsistentWinding { faces, .. } => faces.to_vec(),
        TopologyError::NonManifoldEdge { faces, .. } => faces.clone(),
        _ => Vec::new(),
    };
    let places: Vec<String> = named
        .iter()
        .take(4)
        .filter_map(|&face| origin(face))
        .map(|face| {
            soup.place_of_face(face as usize)
                .to_string()
                .trim_end_matches(": ")
                .to_owned()
        })
        .collect();
    if places.is_empty() {
        String::new()
    } else {
        format!(" (in the file: {})", places.join(", "))
    }
}
