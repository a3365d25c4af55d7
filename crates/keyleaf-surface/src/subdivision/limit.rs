//! Where a vertex ends up, and the tangents of its limit surface: left eigenvectors of the subdivision matrix of a sector.

use super::SubdivisionScheme;
use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::stencil::Stencil;
use crate::LoopWeights;
use std::f64::consts::{PI, TAU};

/// The limit of the corner of a sector.
#[derive(Clone, Debug)]
pub struct Limit {
    /// The position, weights sum to 1.
    pub position: Stencil,
    /// Two directions that span the tangent plane, the first to the right of the second; weights sum to 0. The limit has a unique normal
    /// unless they say otherwise in [`tangents`].
    pub tangents: [Stencil; 2],
}

/// The limit at a settled corner whose faces are quads (Catmull-Clark) or triangles (Loop). None at a dart, whose mask has no closed form.
pub fn limit(ring: &Ring, sector: &Sector, scheme: SubdivisionScheme) -> Option<Limit> {
    let position = match (sector.kind, scheme) {
        (SectorKind::Dart, _) => return None,
        (SectorKind::Corner, _) => Stencil::of(sector.vertex),
        (SectorKind::Crease, _) => {
            let last = sector.spokes.len() - 1;
            let ends = [(sector.spoke(0), 1.0 / 6.0), (sector.spoke(last), 1.0 / 6.0)];
            Stencil([(sector.vertex, 2.0 / 3.0)].into_iter().chain(ends).collect())
        }
        (SectorKind::Interior, SubdivisionScheme::CatmullClark) => catmull_clark_position(ring, sector),
        (SectorKind::Interior, SubdivisionScheme::Loop(weights)) => loop_position(sector, weights),
    };
    Some(Limit {
        position,
        tangents: tangents(ring, sector, scheme),
    })
}

/// The subdominant left eigenvectors. Creases: the first along the crease towards spoke 0, the second inwards. Others: the first along
/// the spoke to the middle face's next corner, the second along that to its previous one.
///
/// At corners, and at creases with many faces (4 in Catmull-Clark, 6 in Loop subdivision), the limit surface has no unique normal; then
/// these span the plane of the two sharp edges, and of the crease and the dominant direction.
pub fn tangents(ring: &Ring, sector: &Sector, scheme: SubdivisionScheme) -> [Stencil; 2] {
    let last = sector.spokes.len() - 1;
    match (sector.kind, scheme) {
        (SectorKind::Corner, _) if !sector.is_closed() => [sector.arm(0), sector.arm(last)],
        (SectorKind::Crease, _) => {
            let along = Stencil(vec![(sector.spoke(0), 1.0), (sector.spoke(last), -1.0)]);
            let inwards = match scheme {
                SubdivisionScheme::CatmullClark => catmull_clark_inwards(ring, sector),
                SubdivisionScheme::Loop(_) => loop_inwards(sector),
            };
            [along, inwards]
        }
        (_, SubdivisionScheme::CatmullClark) if sector.faces.len() == 2 => {
            // With two faces the eigenvalue is 1/4 for both pairs of opposite points.
            let across = [0, 1].map(|k| sector.diagonal(ring, sector.own + k));
            let pairs = [[sector.spoke(sector.own), sector.spoke(sector.own + 1)], across];
            pairs.map(|[a, b]| Stencil(vec![(a, 1.0), (b, -1.0)]))
        }
        (_, SubdivisionScheme::CatmullClark) => [0, 1].map(|k| catmull_clark_along(ring, sector, sector.own + k)),
        (_, SubdivisionScheme::Loop(_)) => [0, 1].map(|k| loop_along(sector, sector.own + k)),
    }
}

/// (n² v + 4 Σ e + Σ f) / (n (n + 5)) (Halstead, Kass and DeRose 1993).
fn catmull_clark_position(ring: &Ring, sector: &Sector) -> Stencil {
    let n = sector.spokes.len() as f64;
    let all = n * (n + 5.0);
    let mut stencil = Stencil(vec![(sector.vertex, n * n / all)]);
    for k in 0..sector.spokes.len() {
        stencil.add(sector.spoke(k), 4.0 / all);
        stencil.add(sector.diagonal(ring, k), 1.0 / all);
    }
    stencil.merged()
}

/// Σ A cᵢ eᵢ + (cᵢ + cᵢ₊₁) fᵢ over the regular vertex' 12, with cᵢ = cos 2πi/n counted from a spoke (Halstead, Kass and DeRose 1993).
fn catmull_clark_along(ring: &Ring, sector: &Sector, spoke: usize) -> Stencil {
    let n = sector.spokes.len();
    let turn = TAU / n as f64;
    let a = 1.0 + turn.cos() + (turn / 2.0).cos() * (2.0 * (9.0 + turn.cos())).sqrt();
    let mut stencil = Stencil::default();
    for k in 0..n {
        let angle = |k: usize| turn * k as f64;
        let place = spoke + k;
        stencil.add(sector.spoke(place), a * angle(k).cos() / 12.0);
        let face = angle(k).cos() + angle(k + 1).cos();
        stencil.add(sector.diagonal(ring, place), face / 12.0);
    }
    stencil.merged()
}

/// The eigenvector of λ = (5 + cos θ + cos(θ/2) √(2 (9 + cos θ))) / 16 with θ = π/k for k faces. Of one face, where the eigenvalue is
/// defective, the direction that tangents approach.
fn catmull_clark_inwards(ring: &Ring, sector: &Sector) -> Stencil {
    let faces = sector.faces.len();
    let (first, last) = (sector.spoke(0), sector.spoke(faces));
    if faces == 1 {
        return Stencil(vec![(first, 1.0), (last, 1.0), (sector.vertex, -2.0)]);
    }
    let turn = PI / faces as f64;
    let half = 1.0 / (turn / 2.0).tan();
    let eigenvalue = (5.0 + turn.cos() + (turn / 2.0).cos() * (2.0 * (9.0 + turn.cos())).sqrt()) / 16.0;
    let end = (eigenvalue * turn.sin() - (2.0 * eigenvalue - 0.25) * half) / (eigenvalue - 0.25);
    let corner = -2.0 * end - (16.0 * eigenvalue - 2.0) * half;
    let mut stencil = Stencil(vec![(sector.vertex, corner), (first, end), (last, end)]);
    let sine = |k: usize| (turn * k as f64).sin();
    for k in 1..faces {
        stencil.add(sector.spoke(k), (16.0 * eigenvalue - 4.0) * sine(k));
    }
    for k in 0..faces {
        stencil.add(sector.diagonal(ring, k), sine(k) + sine(k + 1));
    }
    stencil.merged()
}

/// (1 − n χ) v + χ Σ e with χ = 1 / (n + 3 / (8 β)).
fn loop_position(sector: &Sector, weights: LoopWeights) -> Stencil {
    let n = sector.spokes.len();
    let chi = 1.0 / (n as f64 + 3.0 / (8.0 * weights.beta(n)));
    let mut stencil = Stencil(vec![(sector.vertex, 1.0 - n as f64 * chi)]);
    sector.spokes.iter().for_each(|&spoke| stencil.add(spoke, chi));
    stencil
}

/// Σ cos(2πi/n) eᵢ, counted from a spoke, over the regular vertex' 3.
fn loop_along(sector: &Sector, spoke: usize) -> Stencil {
    let n = sector.spokes.len();
    let cosine = |k: usize| (TAU * k as f64 / n as f64).cos() / 3.0;
    Stencil((0..n).map(|k| (sector.spoke(spoke + k), cosine(k))).collect())
}

/// The eigenvector of 3/8 + cos θ / 4 with θ = π/(k − 1) for k spokes; of two and three spokes as for a regular boundary.
fn loop_inwards(sector: &Sector) -> Stencil {
    let last = sector.spokes.len() - 1;
    let (a, b) = (sector.spoke(0), sector.spoke(last));
    let turn = PI / last as f64;
    match last {
        1 => Stencil(vec![(a, 1.0), (b, 1.0), (sector.vertex, -2.0)]),
        2 => Stencil(vec![(sector.spoke(1), 1.0), (sector.vertex, -1.0)]),
        _ => {
            let half = 1.0 / (turn / 2.0).tan();
            let scale = half / (1.0 + 2.0 * turn.cos());
            let end = -scale * turn.cos();
            let mut stencil = Stencil(vec![(sector.vertex, -scale), (a, end), (b, end)]);
            for k in 1..last {
                stencil.add(sector.spoke(k), (turn * k as f64).sin());
            }
            stencil
        }
    }
}
