//! Points from the tables: the patch of a point, evaluated in f64. Twin of `shaders/surfaces/catmull_clark.wgsl` and `loop.wgsl`.

use super::bezier;
use super::bspline::Jet;
use super::cell::{DomainPoint, SquarePoint, TrianglePoint};
use super::loop_scheme::Part;
use super::neighbourhoods::Neighbourhoods;
use super::tree::{Node, Tree};
use glam::DVec3;
use keyleaf_key::RootPoint;

/// The position and the derivatives in the parameters of the domain.
pub fn in_square_domain(all: &Neighbourhoods, points: &[DVec3], face: u32, at: &DomainPoint) -> Jet<DVec3> {
    let tree = &all.trees(face)[at.domain];
    let (patch, inner, scale) = square_patch(tree, at.at);
    let jet = bezier::evaluate_square(patch_points(all, points, face, at.domain, patch), inner.to_f64());
    scaled(jet, scale)
}

/// The position and the derivatives in the second and the third barycentric coordinate.
pub fn in_triangle(all: &Neighbourhoods, points: &[DVec3], at: RootPoint) -> Jet<DVec3> {
    let (patch, inner, scale) = triangle_patch(&all.trees(at.face)[0], TrianglePoint::of(at));
    let jet = bezier::evaluate_triangle(patch_points(all, points, at.face, 0, patch), inner.to_f64());
    scaled(jet, scale)
}

/// The control points of a patch of a domain.
pub fn patch_points<'a>(
    all: &Neighbourhoods,
    points: &'a [DVec3],
    face: u32,
    domain: usize,
    patch: u32,
) -> &'a [DVec3] {
    let first = all.faces[face as usize].first_entries[domain] + patch as usize * all.control_points;
    &points[first..first + all.control_points]
}

/// The patch of a point, the point in it, and how many times the domain is as large.
pub fn square_patch(tree: &Tree, mut at: SquarePoint) -> (u32, SquarePoint, f64) {
    let (mut node, mut scale) = (tree.nodes[0], 1.0);
    loop {
        match node {
            Node::Patch(patch) => return (patch, at, scale),
            Node::Children(first) => {
                let (corner, inner) = at.descend();
                let number = [0, 1, 3, 2][corner];
                node = tree.nodes[first as usize + number];
                (at, scale) = (inner, 2.0 * scale);
            }
        }
    }
}

/// The same of a triangle; negative where the patch is turned by half a turn.
pub fn triangle_patch(tree: &Tree, mut at: TrianglePoint) -> (u32, TrianglePoint, f64) {
    let (mut node, mut scale) = (tree.nodes[0], 1.0);
    loop {
        match node {
            Node::Patch(patch) => return (patch, at, scale),
            Node::Children(first) => {
                let (part, inner) = at.descend();
                let (number, factor) = match part {
                    Part::Corner(corner) => (corner, 2.0),
                    Part::Middle => (3, -2.0),
                };
                node = tree.nodes[first as usize + number];
                (at, scale) = (inner, factor * scale);
            }
        }
    }
}

fn scaled(jet: Jet<DVec3>, scale: f64) -> Jet<DVec3> {
    Jet {
        value: jet.value,
        du: jet.du * scale,
        dv: jet.dv * scale,
        duv: jet.duv * scale * scale,
    }
}
