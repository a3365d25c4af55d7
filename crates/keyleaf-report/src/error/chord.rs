//! The chord error of even grids: what a surface loses at each level, whatever the view.

use super::domain::Domain;
use super::lattice::{LatticePoint, lattice};
use super::measure::Sum;
use super::object::diagonal_of;
use super::{Measure, MeasureError};
use glam::{DVec2, DVec3};
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::Surface;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The chord error of a level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChordError {
    /// Edges of faces have 2^level chords.
    pub level: u32,
    /// Triangles of all faces.
    pub triangles: u64,
    /// Distance at equal parameters over the diagonal of the surface's box; the mean is over parameters, faces alike.
    pub error: Measure,
}

/// The finest level: 2,097,152 triangles a square face.
const MAX_LEVEL: u32 = 10;

/// Divides every face evenly – squares into 2^level × 2^level cells of two triangles, triangles, and the roots of other polygons, into
/// 4^level – and takes the distance between triangles and surface at equal parameters, at 28 points a triangle.
///
/// Costs 28 evaluations of the surface a triangle; faces are spread over all cores.
///
/// # Errors
/// [`MeasureError::Setting`] for a level above 10, or for a surface without extent.
pub fn chord_error(surface: &dyn Surface, level: u32) -> Result<ChordError, MeasureError> {
    if level > MAX_LEVEL {
        return Err(MeasureError::Setting {
            name: "level",
            value: f64::from(level),
            expected: "a level from 0 to 10",
        });
    }
    let diagonal = diagonal_of(surface, None)?;
    let pieces: Vec<Domain> = (0..surface.topology().face_count())
        .flat_map(|face| pieces(surface, face))
        .collect();
    let points = lattice(6);
    let sums: Vec<(Sum, u64)> = pieces
        .par_iter()
        .map(|domain| of_piece(surface, *domain, 1 << level, &points))
        .collect::<Result<_, _>>()?;
    let mut all = Sum::default();
    sums.iter().for_each(|(sum, _)| all.join(sum));
    Ok(ChordError {
        level,
        triangles: sums.iter().map(|(_, triangles)| triangles).sum(),
        error: all.measure().over(diagonal),
    })
}

fn pieces(surface: &dyn Surface, face: u32) -> Vec<Domain> {
    let topology = surface.topology();
    let at = |root| RootPoint {
        face,
        root,
        x: ONE,
        y: 0,
    };
    let corners = topology.corner_count(face);
    let roots = if corners <= 4 { 0..1 } else { 0..corners };
    roots.map(|root| Domain::of(topology, at(root))).collect()
}

fn of_piece(
    surface: &dyn Surface,
    domain: Domain,
    count: u32,
    points: &[LatticePoint],
) -> Result<(Sum, u64), MeasureError> {
    let is_square = matches!(domain, Domain::Square { .. });
    let position = |at: DVec2| -> Result<DVec3, MeasureError> { Ok(surface.point(domain.point(surface, at)?)) };
    let at = |i: u32, j: u32| DVec2::new(i.into(), j.into()) / f64::from(count);
    let triangles = if is_square { 2 } else { 1 } * u64::from(count) * u64::from(count);
    let mut sum = Sum::default();
    let mut add = |corners: [DVec2; 3]| -> Result<(), MeasureError> {
        let [a, b, c] = corners;
        let [p, q, r] = [position(a)?, position(b)?, position(c)?];
        for point in points {
            let [wa, wb, wc] = point.weights;
            let there = position(a * wa + b * wb + c * wc)?;
            sum.add(there.distance(p * wa + q * wb + r * wc), point.area / triangles as f64);
        }
        Ok(())
    };
    for i in 0..count {
        for j in 0..if is_square { count } else { count - i } {
            add([at(i, j), at(i + 1, j), at(i, j + 1)])?;
            if is_square || i + j + 1 < count {
                add([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])?;
            }
        }
    }
    Ok((sum, triangles))
}
