//! The rules of Loop (1987) with creases as in Catmull-Clark subdivision (Hoppe et al. 1994).

use super::Creasing;
use super::refinement::{Child, Children, Masks, Refinement, SharedChild};
use super::ring::{Fan, Ring, Spoke};
use super::stencil::Stencil;
use crate::LoopWeights;

/// The masks of Loop subdivision.
pub struct LoopScheme(pub LoopWeights);

impl Masks for LoopScheme {
    /// 1 − nβ of the vertex, β of every neighbour.
    fn smooth(&self, _: &Ring, fan: &Fan) -> Stencil {
        let n = fan.spokes.len();
        let beta = self.0.beta(n);
        let mut stencil = Stencil(vec![(fan.vertex, 1.0 - n as f64 * beta)]);
        fan.spokes.iter().for_each(|spoke| stencil.add(spoke.vertex, beta));
        stencil
    }

    fn edge(&self, ring: &Ring, ends: [u32; 2], faces: [u32; 2]) -> Stencil {
        let mut stencil = Stencil(ends.map(|end| (end, 0.375)).to_vec());
        for face in faces {
            let mut corners = ring.faces[face as usize].iter();
            if let Some(&opposite) = corners.find(|corner| !ends.contains(corner)) {
                stencil.add(opposite, 0.125);
            }
        }
        stencil
    }
}

type Step<'a> = Refinement<'a, LoopScheme>;

/// One of the four children of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// At a corner, with corners numbered as those of the triangle.
    Corner(usize),
    /// In the middle; its corner k is the middle of the edge across from corner k.
    Middle,
}

/// A child of the middle face.
pub fn child(ring: &Ring, part: Part, weights: LoopWeights, creasing: Creasing) -> Child {
    let masks = LoopScheme(weights);
    let mut step = Refinement::new(ring, creasing, &masks);
    let child = shared_child(&mut step, part);
    step.children([child]).into()
}

/// The children at the corners, then the one in the middle.
pub fn children(ring: &Ring, weights: LoopWeights, creasing: Creasing) -> Children<4> {
    let masks = LoopScheme(weights);
    let mut step = Refinement::new(ring, creasing, &masks);
    let parts = [Part::Corner(0), Part::Corner(1), Part::Corner(2), Part::Middle];
    let children = parts.map(|part| shared_child(&mut step, part));
    step.children(children)
}

fn shared_child(step: &mut Step<'_>, part: Part) -> SharedChild {
    let corner = match part {
        Part::Middle => {
            middle_of_own(step);
            let fans = [1, 2, 0].map(|start| fan_of_edge(step, start, 1));
            return step.finish(fans.to_vec());
        }
        Part::Corner(corner) => corner,
    };
    child_face(step, corner, step.ring.fans[corner].own);
    let fans = vec![
        step.fan_of_corner(corner, child_face),
        fan_of_edge(step, corner, 2),
        fan_of_edge(step, (corner + 2) % 3, 0),
    ];
    step.finish(fans).turned(corner)
}

/// The child at a corner of the face at a place of the corner's fan.
fn child_face(step: &mut Step<'_>, corner: usize, place: usize) -> u32 {
    step.face([corner, place, 0], |step| {
        let after = step.ring.fans[corner].after(place);
        vec![
            step.corner_point(corner),
            step.edge_point(corner, place),
            step.edge_point(corner, after),
        ]
    })
}

/// The middle child of the middle face.
fn middle_of_own(step: &mut Step<'_>) -> u32 {
    step.face([0, 0, 1], |step| {
        [1, 2, 0]
            .map(|start| step.edge_point(start, step.ring.fans[start].own))
            .to_vec()
    })
}

/// The fan about the point of the edge from corner `start`, seen from the child at its end (0), in the middle (1) or at its start (2).
fn fan_of_edge(step: &mut Step<'_>, start: usize, own: usize) -> Fan {
    let end = (start + 1) % 3;
    let [from, to] = [start, end].map(|corner| &step.ring.fans[corner]);
    let vertex = step.edge_point(start, from.own);
    // Counter-clockwise from the end of the edge.
    let mut spokes = vec![
        step.spoke_to_corner(end, to.after(to.own)),
        Spoke::smooth(step.edge_point(end, to.own)),
        Spoke::smooth(step.edge_point(start, from.after(from.own))),
        step.spoke_to_corner(start, from.own),
    ];
    let mut faces = vec![
        child_face(step, end, to.own),
        middle_of_own(step),
        child_face(step, start, from.own),
    ];
    if let (Some(before), Some(after)) = (from.face_place(-1), to.face_place(1)) {
        let back = step.edge_point(start, before);
        let on = step.edge_point(end, to.after(after));
        let middle = step.face([1, from.faces[before] as usize, 1], |_| vec![back, vertex, on]);
        spokes.extend([Spoke::smooth(back), Spoke::smooth(on)]);
        faces.extend([child_face(step, start, before), middle, child_face(step, end, after)]);
    }
    Fan {
        vertex,
        sharpness: 0.0,
        own,
        spokes,
        faces,
    }
}
