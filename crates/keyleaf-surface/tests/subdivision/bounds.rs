//! Bounds against what is drawn.

use crate::models::{LOOP, Random, disc, prism, settings};
use crate::oracle_tables::oracle;
use crate::oracles::control;
use glam::DVec3;
use keyleaf_key::{Place, RootPoint, neighbour};
use keyleaf_surface::{Subdivision, SubdivisionScheme, Surface};

fn models() -> Vec<(String, Subdivision)> {
    let catmull_clark = SubdivisionScheme::CatmullClark;
    let made = |control, scheme| Subdivision::new(&control, settings(scheme, 6)).expect("a surface");
    let mut models = Vec::new();
    for n in [3, 5, 8] {
        models.push((format!("quads {n}"), made(disc(n, catmull_clark), catmull_clark)));
        models.push((format!("prism {n}"), made(prism(n), catmull_clark)));
        models.push((format!("triangles {n}"), made(disc(n, LOOP), LOOP)));
    }
    for name in [
        "cc/nonquads",
        "cc/single_crease",
        "loop/icos_semisharp",
        "cc/edgecorner",
    ] {
        if let Some(table) = oracle(&format!("{name}.json")) {
            let scheme = if name.starts_with("cc") { catmull_clark } else { LOOP };
            models.push((name.to_owned(), made(control(&table), scheme)));
        }
    }
    models
}

fn leaf(random: &mut Random, model: &Subdivision) -> Place {
    let face = random.below(model.topology().face_count());
    let root = Place::of_root(face, random.below(model.topology().corner_count(face)));
    (0..random.below(32)).fold(root, |place, _| place.child(random.below(4)))
}

fn points_of(leaf: &Place, random: &mut Random) -> Vec<RootPoint> {
    let unit = leaf.unit();
    let mut points = leaf.corners().to_vec();
    for _ in 0..8 {
        let a = random.below(unit + 1);
        points.push(leaf.at(a, random.below(unit - a + 1)));
    }
    points
}

/// Rounding, for models of size about ten.
const ERROR: f64 = 1e-12;

#[test]
fn bounds_hold_the_drawn_surface_and_are_nested() {
    for (name, model) in &models() {
        let mut random = Random(7);
        let drawn = |at: RootPoint| model.approximate(at).position;
        for _ in 0..500 {
            let leaf = leaf(&mut random, model);
            let bound = model.bound(&leaf);
            for half in [Some(leaf), neighbour::h(model.topology(), leaf)].into_iter().flatten() {
                assert_eq!(model.bound(&half).radius, bound.radius);
                for at in points_of(&half, &mut random) {
                    for point in [model.point(at), drawn(at)] {
                        let outside = point.distance(bound.centre) - bound.radius;
                        assert!(outside <= ERROR, "{name}: {outside:e} outside of {bound:?} of {half:?}");
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
            let corners = leaf.corners().map(drawn);
            let [origin, right, up] = corners;
            let longest = (right.distance(up) / 2.0).max(origin.distance(drawn(leaf.middle())));
            assert!(longest <= bound.size + ERROR, "{name}: {longest} {bound:?} {leaf:?}");
            let unit = leaf.unit();
            for _ in 0..8 {
                let a = random.below(unit + 1);
                let b = random.below(unit - a + 1);
                let [p, q] = [a, b].map(|x| f64::from(x) / f64::from(unit));
                let flat: DVec3 = corners
                    .into_iter()
                    .zip([1.0 - p - q, p, q])
                    .map(|(point, w)| point * w)
                    .sum();
                let off = drawn(leaf.at(a, b)).distance(flat);
                assert!(off <= bound.deviation + ERROR, "{name}: {off} {bound:?} {leaf:?}");
                assert!(off <= 1.125 * bound.size + ERROR, "{name}: {off} {bound:?} {leaf:?}");
            }
        }
    }
}

#[test]
fn sizes_are_tight_enough() {
    for (name, model) in &models() {
        let mut random = Random(9);
        let (mut over, mut count) = (0.0, 0.0);
        for _ in 0..500 {
            let leaf = leaf(&mut random, model);
            let [_, right, up] = leaf.corners().map(|at| model.point(at));
            if (2..14).contains(&leaf.level) && right.distance(up) > 1e-12 {
                over += (model.bound(&leaf).size / (right.distance(up) / 2.0)).ln();
                count += 1.0;
            }
        }
        let size = f64::exp(over / count);
        println!("{name}: size {size:.2} times half the hypotenuse");
        assert!(size < 6.0, "{name}: {size}");
    }
}
