//! Bounds of the f64 twins against the surfaces themselves.

mod fixtures;
mod random;

use fixtures::{Fixture, fixtures};
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, neighbour};
use keyleaf_surface::{Surface, SurfaceBound};
use random::Random;

/// Points of a leaf, its corners first.
fn points_of(leaf: &Place, random: &mut Random) -> Vec<RootPoint> {
    let unit = leaf.unit();
    let mut points = leaf.corners().to_vec();
    for _ in 0..12 {
        let a = random.below(unit + 1);
        points.push(leaf.at(a, random.below(unit - a + 1)));
    }
    points
}

fn error_of(fixture: &Fixture) -> f64 {
    1e-12 * (fixture.magnitude + fixture.surface.bounding_box().1.abs().max_element())
}

fn for_every_leaf(mut check: impl FnMut(&Fixture, &dyn Surface, &Place, SurfaceBound, &mut Random)) {
    for fixture in &fixtures() {
        let mut random = Random(4);
        for _ in 0..600 {
            let leaf = random.leaf(fixture.surface.topology());
            check(
                fixture,
                &*fixture.surface,
                &leaf,
                fixture.surface.bound(&leaf),
                &mut random,
            );
        }
    }
}

#[test]
fn the_culling_ball_holds_the_surface_over_both_halves_of_the_diamond() {
    for_every_leaf(|fixture, surface, leaf, bound, random| {
        for half in [Some(*leaf), neighbour::h(surface.topology(), *leaf)]
            .into_iter()
            .flatten()
        {
            for at in points_of(&half, random) {
                let outside = surface.point(at).distance(bound.centre) - bound.radius;
                assert!(
                    outside <= error_of(fixture),
                    "{}: {outside:e} outside of {bound:?} of {leaf:?}",
                    fixture.name
                );
            }
        }
    });
}

#[test]
fn both_halves_of_a_diamond_have_the_same_bound() {
    for_every_leaf(|fixture, surface, leaf, bound, _| {
        if let Some(other) = neighbour::h(surface.topology(), *leaf) {
            let other = surface.bound(&other);
            assert!(
                bound.centre.distance(other.centre) <= error_of(fixture),
                "{}",
                fixture.name
            );
            let close = |a: f64, b: f64| (a - b).abs() <= error_of(fixture) + 1e-12 * a;
            let same =
                close(bound.radius, other.radius) && close(bound.size, other.size) && close(bound.guard, other.guard);
            assert!(same, "{}: {bound:?} {other:?}", fixture.name);
        }
    });
}

#[test]
fn sizes_halve_and_guard_balls_hold_those_of_the_children() {
    for_every_leaf(|fixture, surface, leaf, bound, _| {
        if leaf.level == 31 {
            return;
        }
        for child in leaf.children() {
            let small = surface.bound(&child);
            assert!(
                small.size <= bound.size / 2.0 * (1.0 + 1e-12),
                "{}: {bound:?} {small:?}",
                fixture.name
            );
            let reach = small.centre.distance(bound.centre) + small.guard;
            assert!(
                reach <= bound.guard + error_of(fixture),
                "{}: {leaf:?} {bound:?} {small:?}",
                fixture.name
            );
        }
    });
}

#[test]
fn size_bounds_half_the_drawn_hypotenuse_and_the_median() {
    let (mut seen, mut beyond) = (0, 0);
    for_every_leaf(|fixture, surface, leaf, bound, _| {
        let [origin, right, up] = leaf.corners().map(|at| surface.point(at));
        if leaf.level == 31 || (fixture.name.starts_with("texture: prism") && bound.guard > 4.0 * bound.size) {
            return; // no middle, and the jump at a seam
        }
        let middle = surface.point(leaf.middle());
        let longest = (right.distance(up) / 2.0).max(origin.distance(middle));
        let holds = longest <= bound.size + error_of(fixture);
        assert!(
            holds || !fixture.has_strict_size,
            "{}: {longest} {bound:?} of {leaf:?}",
            fixture.name
        );
        seen += u32::from(!fixture.has_strict_size);
        beyond += u32::from(!holds);
    });
    assert!(
        beyond * 50 <= seen,
        "a typical slope should seldom be exceeded: {beyond} of {seen}"
    );
}

#[test]
fn bounds_are_tight_enough_to_cull_and_to_measure() {
    for name in [
        "height field",
        "terrain",
        "mesh: prism",
        "texture: sheet, repeated",
        "noise: prism",
    ] {
        let (mut radius_over, mut size_over, mut count) = (0.0, 0.0, 0.0f64);
        for_every_leaf(|fixture, surface, leaf, bound, random| {
            if fixture.name == name && (4..20).contains(&leaf.level) {
                let farthest = points_of(leaf, random)
                    .into_iter()
                    .map(|at| surface.point(at).distance(bound.centre))
                    .fold(0.0, f64::max);
                radius_over += (bound.radius / farthest).ln();
                let [_, right, up] = leaf.corners().map(|at| surface.point(at));
                size_over += (bound.size / (right.distance(up) / 2.0)).ln();
                count += 1.0;
            }
        });
        let [radius, size] = [radius_over, size_over].map(|sum: f64| (sum / count).exp());
        println!("{name}: radius {radius:.2} times the farthest point, size {size:.2} times half the hypotenuse");
        assert!(radius < 6.0 && size < 4.0, "{name}: {radius} {size}");
    }
}

#[test]
fn frames_have_the_derivatives_and_unit_normals() {
    for fixture in &fixtures() {
        let surface = &*fixture.surface;
        let mut random = Random(5);
        for _ in 0..500 {
            let at = random.point(surface.topology());
            let frame = surface.frame(at);
            assert!(
                (frame.normal.length() - 1.0).abs() < 1e-12,
                "{}: {frame:?}",
                fixture.name
            );
            // At vertices of a control mesh derivatives in the face's parameters need not exist.
            let is_vertex = at.x == ONE || at.y == ONE || (at.x | at.y) == 0;
            let is_other = fixture.has_normals_of_its_own() || is_vertex && fixture.is_subdivided();
            let cross = frame.du.cross(frame.dv);
            if !is_other && cross.length() > 1e-3 * frame.du.length() * frame.dv.length() {
                assert!(
                    cross.normalize().distance(frame.normal) < 1e-6,
                    "{}: {frame:?}",
                    fixture.name
                );
            }
            let (face, _) = random.root(surface.topology());
            let corners = surface.topology().corner_count(face);
            let (u, v) = (0.3 + 0.01 * random.signed(), 0.3 + 0.01 * random.signed());
            // The centre of a triangle is an extraordinary vertex.
            let u = if corners == 3 && fixture.is_subdivided() {
                u - 0.15
            } else if corners > 4 {
                u + f64::from(random.below(corners))
            } else {
                u
            };
            if fixture.name == "terrain" {
                continue; // its finest octaves are smaller than any step; the plain one has the same code
            }
            let step = f64::exp2(-18.0);
            let at = |u: f64, v: f64| {
                surface
                    .face_coord(face, u, v)
                    .map(|at| surface.point(at))
                    .expect("a point")
            };
            let frame = surface.frame(surface.face_coord(face, u, v).expect("a point"));
            let differences = |du: f64, dv: f64| -> DVec3 { (at(u + du, v + dv) - at(u - du, v - dv)) / (2.0 * step) };
            let numeric = [differences(step, 0.0), differences(0.0, step)];
            for (numeric, exact) in numeric.into_iter().zip([frame.du, frame.dv]) {
                let error = numeric.distance(exact) / (exact.length() + fixture.magnitude * 0.05);
                assert!(error < 5e-3, "{}: {error:e} {numeric} {exact}", fixture.name);
            }
        }
    }
}
