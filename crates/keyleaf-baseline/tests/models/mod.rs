//! Analytic models with what tessellators stumble over: reversed joins, seams, poles, unlike knots.

// Every test program uses some of them.
#![allow(dead_code)]

use glam::{DVec2, DVec3};
use keyleaf_baseline::{Boundary, Sampler, Side, View};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Surfaces given by a function.
pub struct Model {
    pub name: &'static str,
    pub point: fn(usize, DVec2) -> DVec3,
    pub spans: Vec<[Vec<f64>; 2]>,
    pub joins: HashMap<(usize, Side), Boundary>,
}

impl Sampler for Model {
    fn surfaces(&self) -> usize {
        self.spans.len()
    }
    fn point(&self, surface: usize, at: DVec2) -> DVec3 {
        (self.point)(surface, at)
    }
    fn spans(&self, surface: usize) -> [Vec<f64>; 2] {
        self.spans[surface].clone()
    }
    fn boundary(&self, surface: usize, side: Side) -> Boundary {
        self.joins.get(&(surface, side)).copied().unwrap_or(Boundary::Free)
    }
}

impl Model {
    fn new(name: &'static str, point: fn(usize, DVec2) -> DVec3, spans: Vec<[Vec<f64>; 2]>) -> Self {
        Self {
            name,
            point,
            spans,
            joins: HashMap::new(),
        }
    }

    fn join(mut self, a: (usize, Side), b: (usize, Side), reversed: bool) -> Self {
        self.joins.insert(
            a,
            Boundary::Joined {
                surface: b.0,
                side: b.1,
                reversed,
            },
        );
        self.joins.insert(
            b,
            Boundary::Joined {
                surface: a.0,
                side: a.1,
                reversed,
            },
        );
        self
    }
}

pub fn unit() -> [Vec<f64>; 2] {
    [vec![0.0, 1.0], vec![0.0, 1.0]]
}

/// The sine by cubics between its knots at whole numbers.
fn cubic_sine(x: f64) -> f64 {
    let i = x.floor();
    let t = x - i;
    let (p0, m0, p1, m1) = (i.sin(), i.cos(), (i + 1.0).sin(), (i + 1.0).cos());
    let (t2, t3) = (t * t, t * t * t);
    p0 * (2.0 * t3 - 3.0 * t2 + 1.0) + m0 * (t3 - 2.0 * t2 + t) + p1 * (3.0 * t2 - 2.0 * t3) + m1 * (t3 - t2)
}

/// 3 × 3 bicubic patches; every other one is turned by half a turn, so that its joins are reversed.
pub fn wave() -> Model {
    fn point(surface: usize, at: DVec2) -> DVec3 {
        let (i, j) = (surface % 3, surface / 3);
        let at = if (i + j) % 2 == 1 { DVec2::ONE - at } else { at };
        let at = at + DVec2::new(i as f64, j as f64);
        DVec3::new(at.x, at.y, 0.6 * cubic_sine(1.5 * at.x) * cubic_sine(at.y + 0.4))
    }
    let mut model = Model::new("wave", point, vec![unit(); 9]);
    for j in 0..3 {
        for i in 0..3 {
            let turned = (i + j) % 2 == 1;
            if i < 2 {
                let side = if turned { Side::UMin } else { Side::UMax };
                model = model.join((3 * j + i, side), (3 * j + i + 1, side), true);
            }
            if j < 2 {
                let side = if turned { Side::VMin } else { Side::VMax };
                model = model.join((3 * j + i, side), (3 * j + i + 3, side), true);
            }
        }
    }
    model
}

fn on_torus(angles: DVec2) -> DVec3 {
    let radius = 2.0 + 0.7 * angles.y.cos();
    DVec3::new(radius * angles.x.cos(), radius * angles.x.sin(), 0.7 * angles.y.sin())
}

/// A torus of 4 × 4 patches.
pub fn torus() -> Model {
    fn point(surface: usize, at: DVec2) -> DVec3 {
        on_torus((at + DVec2::new((surface % 4) as f64, (surface / 4) as f64)) * FRAC_PI_2)
    }
    let mut model = Model::new("torus", point, vec![unit(); 16]);
    for j in 0..4 {
        for i in 0..4 {
            model = model.join((4 * j + i, Side::UMax), (4 * j + (i + 1) % 4, Side::UMin), false);
            model = model.join((4 * j + i, Side::VMax), (4 * ((j + 1) % 4) + i, Side::VMin), false);
        }
    }
    model
}

/// A torus that is one surface of one span, joined to itself.
pub fn closed_torus() -> Model {
    Model::new("closed torus", |_, at| on_torus(at * TAU), vec![unit()])
        .join((0, Side::UMin), (0, Side::UMax), false)
        .join((0, Side::VMin), (0, Side::VMax), false)
}

fn on_sphere(longitude: f64, latitude: f64) -> DVec3 {
    DVec3::new(
        latitude.cos() * longitude.cos(),
        latitude.cos() * longitude.sin(),
        latitude.sin(),
    )
}

/// A sphere of eight octants; each has one side in a pole.
pub fn sphere() -> Model {
    fn point(surface: usize, at: DVec2) -> DVec3 {
        on_sphere(
            (at.x + (surface % 4) as f64) * FRAC_PI_2,
            (at.y + (surface / 4) as f64 - 1.0) * FRAC_PI_2,
        )
    }
    let mut model = Model::new("sphere", point, vec![unit(); 8]);
    for i in 0..4 {
        model = model.join((i, Side::UMax), ((i + 1) % 4, Side::UMin), false);
        model = model.join((4 + i, Side::UMax), (4 + (i + 1) % 4, Side::UMin), false);
        model = model.join((i, Side::VMax), (4 + i, Side::VMin), false);
    }
    model
}

/// A sphere that is one surface of one span, from pole to pole, with a seam.
pub fn globe() -> Model {
    Model::new(
        "globe",
        |_, at| on_sphere(at.x, at.y),
        vec![[vec![0.0, TAU], vec![-FRAC_PI_2, FRAC_PI_2]]],
    )
    .join((0, Side::UMin), (0, Side::UMax), false)
}

/// A nearly flat surface of 6 × 6 spans with one small hill.
pub fn bump() -> Model {
    let knots: Vec<f64> = (0..=6).map(f64::from).collect();
    let point = |_, at: DVec2| DVec3::new(at.x, at.y, (-3.0 * at.distance_squared(DVec2::new(2.3, 3.6))).exp());
    Model::new("bump", point, vec![[knots.clone(), knots]])
}

/// Two surfaces with unlike domains and knots, joined in reverse.
pub fn unlike_knots() -> Model {
    fn point(surface: usize, at: DVec2) -> DVec3 {
        // Both to a common domain: x from 0 to 1 along the joined side, y across it.
        let common = if surface == 0 {
            at
        } else {
            DVec2::new((4.0 - at.x) / 2.0, -at.y / 5.0)
        };
        DVec3::new(common.x, common.y, (3.0 * common.x).sin() * (1.0 + common.y))
    }
    let spans = vec![
        [vec![0.0, 0.3, 1.0], vec![0.0, 1.0]],
        [vec![2.0, 2.5, 3.4, 4.0], vec![0.0, 1.0, 5.0]],
    ];
    Model::new("unlike knots", point, spans).join((0, Side::VMin), (1, Side::VMin), true)
}

/// Two surfaces joined on all four sides.
pub fn pillow() -> Model {
    fn point(surface: usize, at: DVec2) -> DVec3 {
        let height = at.x * (1.0 - at.x) * at.y * (1.0 - at.y);
        DVec3::new(at.x, at.y, if surface == 0 { height } else { -2.0 * height })
    }
    let mut model = Model::new("pillow", point, vec![unit(); 2]);
    for side in Side::ALL {
        model = model.join((0, side), (1, side), false);
    }
    model
}

/// A band with half a twist.
pub fn moebius() -> Model {
    fn point(_: usize, at: DVec2) -> DVec3 {
        let radius = 1.0 + at.y * (at.x / 2.0).cos();
        DVec3::new(radius * at.x.cos(), radius * at.x.sin(), at.y * (at.x / 2.0).sin())
    }
    Model::new("Moebius", point, vec![[vec![0.0, TAU], vec![-0.3, 0.3]]]).join((0, Side::UMin), (0, Side::UMax), true)
}

/// One patch with a collapsed side: a bent triangle.
pub fn triangle() -> Model {
    let point = |_, at: DVec2| DVec3::new((at.x - 0.5) * at.y, at.y, at.y * at.y * (at.x * PI).sin());
    Model::new("triangle", point, vec![unit()])
}

/// One patch with two collapsed sides that meet.
pub fn leaf() -> Model {
    let point = |_, at: DVec2| at.x * at.y * DVec3::new(at.y, at.x, 1.0);
    Model::new("leaf", point, vec![unit()])
}

/// One patch that is a point.
pub fn dot() -> Model {
    Model::new("dot", |_, _| DVec3::ONE, vec![unit()])
}

/// One flat square with uneven parameters.
pub fn plane() -> Model {
    Model::new(
        "plane",
        |_, at| DVec3::new(at.x * at.x, at.y + at.y * at.y, 0.0),
        vec![unit()],
    )
}

pub fn all() -> Vec<Model> {
    vec![
        wave(),
        torus(),
        closed_torus(),
        sphere(),
        globe(),
        bump(),
        unlike_knots(),
        pillow(),
        moebius(),
        triangle(),
        leaf(),
        dot(),
        plane(),
    ]
}

/// From near enough that most things are refined, and uneven.
pub fn near() -> View {
    View {
        eye: DVec3::new(3.5, -1.0, 2.0),
        pixels_per_radian: 1000.0,
        near: 0.1,
    }
}

/// So far that nothing needs more than the least.
pub fn far() -> View {
    View {
        eye: DVec3::new(0.0, 0.0, 1e6),
        pixels_per_radian: 1000.0,
        near: 0.1,
    }
}
