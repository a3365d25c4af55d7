//! Whether the margin of the tables bounds what f32 loses, on surfaces that are hard for it.

use crate::emulation::{position_errors, rounding_margin};
use crate::models::Random;
use crate::products::{bipyramid, prism, settings, with_disks};
use glam::DVec3;
use keyleaf_surface::gaussian::{GaussianProduct, GaussianSettings, Solver};
use keyleaf_surface::{BoundaryRule, ControlMesh, LoopWeights, SubdivisionScheme, Surface};

const CONDITIONS: [f64; 4] = [1.0, 1e2, 1e4, 1e6];
const ISOLATIONS: [u32; 4] = [0, 1, 3, 8];

/// A mesh with vertices of valence n: a prism, or for triangles a bipyramid; without its first face if open.
fn control(scheme: SubdivisionScheme, n: u32, is_open: bool) -> ControlMesh {
    let mut control = match scheme {
        SubdivisionScheme::CatmullClark => prism(n),
        SubdivisionScheme::Loop(_) => bipyramid(n),
    };
    if is_open {
        control.creases.clear();
        control.mesh.faces = control.mesh.faces.iter().skip(1).collect();
        control.boundary = BoundaryRule::EdgesAndCorners;
    }
    control
}

/// The largest part of the margin that either solver uses, and the least part that LDLᵀ uses of well-conditioned surfaces.
fn parts_of_margin(seed: u64, scheme: SubdivisionScheme) -> [f64; 2] {
    let mut random = Random(seed);
    let (mut most, mut least) = (0.0f64, f64::INFINITY);
    for n in 3..=13 {
        for (k, &condition) in CONDITIONS.iter().enumerate() {
            let turn = if random.unit() < 0.5 { 0.1 } else { 3.0 };
            let mesh = with_disks(control(scheme, n, random.unit() < 0.5), condition, turn, &mut random);
            let isolation = ISOLATIONS[(n as usize + k + seed as usize) % 4];
            for solver in [Solver::Ldlt, Solver::Adjugate] {
                let settings = GaussianSettings {
                    solver,
                    ..settings(scheme, isolation)
                };
                let surface = GaussianProduct::new(&mesh, settings).expect("a surface");
                let (low, high) = surface.bounding_box();
                let origin = (low + high) / 2.0 + DVec3::new(1e-3, 0.0, -2e-3);
                let [ldlt, adjugate] = position_errors(&surface, origin, 300, &mut random);
                let error = if solver == Solver::Ldlt { ldlt } else { adjugate };
                let part = error / rounding_margin(&surface, origin);
                println!(
                    "{scheme:?} {n}, {condition:.0e}, {turn}, {isolation}, {solver:?}: error {error:.1e}, part {part:.1e}"
                );
                most = most.max(part);
                if condition == 1.0 && solver == Solver::Ldlt {
                    least = least.min(part);
                }
            }
        }
    }
    [most, least]
}

#[test]
fn the_margin_holds_at_any_condition_valence_and_isolation() {
    for scheme in [
        SubdivisionScheme::CatmullClark,
        SubdivisionScheme::Loop(LoopWeights::Loop),
    ] {
        let [most, least] = parts_of_margin(1, scheme);
        println!("{scheme:?}: {most:.3} of the margin is used, {least:.3} where covariances are round");
        assert!(most <= 1.0, "{most}");
        assert!(least >= 1.0 / 60.0, "{least}");
    }
}
