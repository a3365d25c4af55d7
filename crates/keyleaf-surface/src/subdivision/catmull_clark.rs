//! The rules of Catmull and Clark (1978) with those of DeRose, Kass and Truong (1998) for creases.

use super::Creasing;
use super::refinement::{Child, Children, Masks, Refinement, SharedChild, centroid};
use super::ring::{Fan, Ring, Spoke};
use super::stencil::Stencil;

/// The masks of Catmull-Clark subdivision.
pub struct CatmullClark;

impl Masks for CatmullClark {
    /// (n − 2)/n of the vertex, 1/n² of every neighbour and of every new face point.
    fn smooth(&self, ring: &Ring, fan: &Fan) -> Stencil {
        let n = fan.faces.len() as f64;
        let weight = 1.0 / (n * n);
        let mut stencil = Stencil(vec![(fan.vertex, (n - 2.0) / n)]);
        fan.spokes.iter().for_each(|spoke| stencil.add(spoke.vertex, weight));
        for &face in &fan.faces {
            stencil.add_stencil(&centroid(ring, face), weight);
        }
        stencil.merged()
    }

    fn edge(&self, ring: &Ring, ends: [u32; 2], faces: [u32; 2]) -> Stencil {
        let mut stencil = Stencil(ends.map(|end| (end, 0.25)).to_vec());
        for face in faces {
            stencil.add_stencil(&centroid(ring, face), 0.25);
        }
        stencil.merged()
    }
}

type Step<'a> = Refinement<'a, CatmullClark>;

/// The child of the middle face at a corner. Its corners are those of the face where the face is a quad: corner `corner` is the point of
/// that corner. Of other faces it is corner 0, and corner 2 is the centre.
pub fn child(ring: &Ring, corner: usize, creasing: Creasing) -> Child {
    let mut step = Refinement::new(ring, creasing, &CatmullClark);
    let child = shared_child(&mut step, corner);
    step.children([child]).into()
}

/// The points of the first step of a face that is no quad, and its children at its corners; see [`child`].
pub fn children_at_corners(ring: &Ring, creasing: Creasing) -> (Vec<Stencil>, Vec<SharedChild>) {
    let mut step = Refinement::new(ring, creasing, &CatmullClark);
    let corners = 0..ring.fans.len();
    let children = corners.map(|corner| shared_child(&mut step, corner)).collect();
    (step.into_points(), children)
}

/// The children of a quad at its corners.
pub fn children(ring: &Ring, creasing: Creasing) -> Children<4> {
    let mut step = Refinement::new(ring, creasing, &CatmullClark);
    let children = [0, 1, 2, 3].map(|corner| shared_child(&mut step, corner));
    step.children(children)
}

fn shared_child(step: &mut Step<'_>, corner: usize) -> SharedChild {
    let corners = step.ring.fans.len();
    let previous = (corner + corners - 1) % corners;
    let own = step.ring.fans[corner].own;
    child_face(step, corner, own);
    let fans = vec![
        step.fan_of_corner(corner, child_face),
        fan_of_edge(step, corner, corner),
        fan_of_centre(step, corner),
        fan_of_edge(step, previous, corner),
    ];
    let turns = if corners == 4 { corner } else { 0 };
    step.finish(fans).turned(turns)
}

/// The child at a corner of the face at a place of the corner's fan.
fn child_face(step: &mut Step<'_>, corner: usize, place: usize) -> u32 {
    step.face([corner, place, 0], |step| {
        let fan = &step.ring.fans[corner];
        let (face, after) = (fan.faces[place], fan.after(place));
        vec![
            step.corner_point(corner),
            step.edge_point(corner, place),
            step.face_point(face),
            step.edge_point(corner, after),
        ]
    })
}

/// The fan about the point of the edge from corner `start`, seen from the child at corner `child`, one of its ends.
fn fan_of_edge(step: &mut Step<'_>, start: usize, child: usize) -> Fan {
    let end = (start + 1) % step.ring.fans.len();
    let [from, to] = [start, end].map(|corner| &step.ring.fans[corner]);
    let vertex = step.edge_point(start, from.own);
    let centre = Spoke::smooth(step.face_point(0));
    let back = step.spoke_to_corner(start, from.own);
    let on = step.spoke_to_corner(end, to.after(to.own));
    // Counter-clockwise from the end of the edge: the two children of the middle face, then those of the face across.
    let mut faces = vec![child_face(step, end, to.own), child_face(step, start, from.own)];
    let mut spokes = vec![on, centre, back];
    if let (Some(before), Some(after)) = (from.face_place(-1), to.face_place(1)) {
        spokes.push(Spoke::smooth(step.face_point(from.faces[before])));
        faces.extend([child_face(step, start, before), child_face(step, end, after)]);
    }
    Fan {
        vertex,
        sharpness: 0.0,
        own: usize::from(child == start),
        spokes,
        faces,
    }
}

fn fan_of_centre(step: &mut Step<'_>, corner: usize) -> Fan {
    let corners = step.ring.fans.len();
    let from = |k: usize| (corner + k) % corners;
    let edge_point = |step: &mut Step<'_>, corner: usize| {
        let place = step.ring.fans[corner].own;
        Spoke::smooth(step.edge_point(corner, place))
    };
    Fan {
        vertex: step.face_point(0),
        sharpness: 0.0,
        own: 0,
        spokes: (0..corners).map(|k| edge_point(step, from(k + corners - 1))).collect(),
        faces: (0..corners)
            .map(|k| child_face(step, from(k), step.ring.fans[from(k)].own))
            .collect(),
    }
}
