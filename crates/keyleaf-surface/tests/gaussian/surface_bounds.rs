//! Bounds of surfaces against what is drawn.

use crate::models::Random;
use crate::products::{meshes, product, shipped};
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, neighbour};
use keyleaf_surface::gaussian::GaussianProduct;
use keyleaf_surface::{SubdivisionScheme, Surface};

fn below(random: &mut Random, bound: u32) -> u32 {
    (random.unit() * f64::from(bound)) as u32
}

fn leaf(random: &mut Random, model: &GaussianProduct) -> Place {
    let face = below(random, model.topology().face_count());
    let root = Place::of_root(face, below(random, model.topology().corner_count(face)));
    let level = below(random, 32);
    (0..level).fold(root, |place, _| place.child(below(random, 4)))
}

fn points_of(leaf: &Place, random: &mut Random) -> Vec<RootPoint> {
    let unit = leaf.unit();
    let mut points = leaf.corners().to_vec();
    for _ in 0..8 {
        let a = below(random, unit + 1);
        points.push(leaf.at(a, below(random, unit - a + 1)));
    }
    points
}

fn models() -> Vec<(String, GaussianProduct)> {
    let mut models: Vec<_> = meshes()
        .into_iter()
        .map(|(name, scheme, mesh)| (name, product(&mesh, scheme, 5)))
        .collect();
    for name in ["gauss_cube", "gauss_wirecube", "gauss_cylinder", "gauss_anvil"] {
        let model = shipped(name).map(|mesh| product(&mesh, SubdivisionScheme::CatmullClark, 5));
        models.extend(model.map(|model| (name.to_owned(), model)));
    }
    models
}

/// Rounding of f64 at conditions to 1e4, for models of size about two.
const ERROR: f64 = 1e-10;

#[test]
fn bounds_hold_the_drawn_surface_and_are_nested() {
    for (name, model) in &models() {
        let mut random = Random(7);
        let drawn = |at: RootPoint| model.drawn(at).position;
        let (low, high) = model.bounding_box();
        for _ in 0..250 {
            let leaf = leaf(&mut random, model);
            let bound = model.bound(&leaf);
            for half in [Some(leaf), neighbour::h(model.topology(), leaf)].into_iter().flatten() {
                assert_eq!(model.bound(&half).radius, bound.radius);
                for at in points_of(&half, &mut random) {
                    for point in [model.point(at), drawn(at)] {
                        let outside = point.distance(bound.centre) - bound.radius;
                        assert!(outside <= ERROR, "{name}: {outside:e} outside of {bound:?} of {half:?}");
                        assert!(
                            point.cmpge(low - ERROR).all() && point.cmple(high + ERROR).all(),
                            "{name}"
                        );
                    }
                }
            }
            if leaf.level == 31 {
                continue;
            }
            for child in leaf.children() {
                let small = model.bound(&child);
                assert!(small.size <= bound.size / 2.0 && small.deviation <= bound.deviation / 4.0);
                let reach = small.centre.distance(bound.centre) + small.guard;
                assert!(reach <= bound.guard + ERROR, "{name}: {bound:?} {small:?}");
            }
            let corners = leaf.corners().map(|at| model.approximate(at).position);
            let [origin, right, up] = corners;
            let middle = model.approximate(leaf.middle()).position;
            let longest = (right.distance(up) / 2.0).max(origin.distance(middle));
            let room = ERROR + 2.0 * model.terminal_error();
            assert!(longest <= bound.size + room, "{name}: {longest} {bound:?} {leaf:?}");
            let unit = leaf.unit();
            for _ in 0..8 {
                let a = below(&mut random, unit + 1);
                let b = below(&mut random, unit - a + 1);
                let [p, q] = [a, b].map(|x| f64::from(x) / f64::from(unit));
                let weighted = corners.into_iter().zip([1.0 - p - q, p, q]);
                let flat: DVec3 = weighted.map(|(point, w)| point * w).sum();
                let off = model.approximate(leaf.at(a, b)).position.distance(flat);
                assert!(off <= bound.deviation + room, "{name}: {off} {bound:?} {leaf:?}");
                assert!(off <= 1.125 * bound.size + room, "{name}: {off} {bound:?} {leaf:?}");
            }
        }
    }
}

/// Points of a root: everywhere, and as near to the mesh edge and to its ends as one likes, where a far stronger Gaussian takes over.
fn points_of_root(root: &Place, random: &mut Random) -> RootPoint {
    let mut any_scale = || {
        let zeros = below(random, 24);
        below(random, ONE >> zeros)
    };
    let rest = ONE - any_scale();
    let x = any_scale().min(rest);
    let [x, y] = if random.unit() < 0.5 {
        [x, rest - x]
    } else {
        [rest - x, x]
    };
    RootPoint {
        face: root.face,
        root: root.root,
        x,
        y,
    }
}

#[test]
fn sizes_are_tight_enough() {
    for (name, model) in &models() {
        let mut random = Random(9);
        let (mut over, mut count, mut most) = (0.0, 0.0, 0.0f64);
        for root in model.topology().roots().take(200) {
            let mut fastest = 0.0f64;
            for half in [Some(root), neighbour::h(model.topology(), root)].into_iter().flatten() {
                for _ in 0..200 {
                    let frame = model.approximate(points_of_root(&half, &mut random));
                    fastest = fastest.max(frame.du.length()).max(frame.dv.length());
                }
            }
            if fastest > 0.0 {
                let ratio = model.bound(&root).size / (fastest / 2.0);
                over += ratio.ln();
                count += 1.0;
                most = most.max(ratio);
            }
        }
        let size = f64::exp(over / count);
        println!("{name}: size {size:.2} times half the greatest speed found, at most {most:.1}");
        assert!(size < 40.0, "{name}: {size}");
    }
}
