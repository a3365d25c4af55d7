//! Uniform tessellation (thesis chapter 2 and 6.4): one resolution a surface, or one a KSQuad.
//!
//! Vertex shader tessellation, VST, evaluates a stored grid P^l of 2^(l+1) × 2^(l+1) parameters (equation 2.1) for
//! every surface: 2 (2^(l+1) − 1)² triangles at level l. RPNS instead chooses a resolution a KSQuad from its size on
//! screen (equation 6.8).
//!
//! Departures:
//! - The thesis draws neighbours at one level, or oversamples borders until gaps do not show (6.3). Here a shared side
//!   has the segments of the finer of its two surfaces, or, between KSQuads, those that its own length asks for; a strip
//!   joins them to the first row inside.
//! - Thesis 2.1 leaves the choice of level to the application. Here it is the least whose chords deviate by at most a
//!   number of pixels.
//! - Equation 6.8 measures the corners of a KSQuad only; a closed one has size 0. Here the sides and middle lines are
//!   measured along the surface, by length over distance rather than by projection, so that no view direction is
//!   needed.

use crate::cells::{Cells, Domain, position};
use crate::curve::Curve;
use crate::geometry::distance_to_segment;
use crate::grid::{Order, Segments, grid};
use crate::mesher::Mesher;
use crate::view::{positive, within};
use crate::{BaselineError, Sampler, Side, Tessellation, View};
use glam::{DVec2, DVec3};

/// The finest level of a grid: 1023 segments, two million triangles a surface.
pub const MAX_LEVEL: u32 = 9;
/// Segments a side of a KSQuad that the tessellator stage of DirectX 11 can make (thesis 6.6).
pub const MAX_FACTOR: u32 = 64;

/// Segments a side of the grid of a level.
pub fn segments(level: u32) -> u32 {
    (2 << level.min(MAX_LEVEL)) - 1
}

/// For each surface the least level, from 1 to `max_level`, whose triangle edges deviate from it by at most `pixels`.
///
/// Looks at the middle of every edge. Costs (2^(l+2) − 1)² evaluations a level that is tried.
///
/// # Errors
/// [`BaselineError`] if the model, the view or a setting is at fault.
pub fn levels(sampler: &dyn Sampler, view: &View, pixels: f64, max_level: u32) -> Result<Vec<u32>, BaselineError> {
    view.check()?;
    positive("pixels", pixels)?;
    within("max_level", max_level, 1..=MAX_LEVEL, "a level from 1 to 9")?;
    let cells = Cells::surfaces(sampler)?;
    let mut levels = Vec::new();
    for (surface, domain) in cells.domains.iter().enumerate() {
        let mut level = 1;
        while level < max_level && deviation(sampler, view, surface, *domain, level)? > pixels {
            level += 1;
        }
        levels.push(level);
    }
    Ok(levels)
}

/// VST: every surface as the grid of its level, from 1 to [`MAX_LEVEL`], with boundary rows stitched.
///
/// # Errors
/// [`BaselineError`] if the model or a level is at fault, or if there is not one level a surface.
pub fn at_levels(sampler: &dyn Sampler, levels: &[u32]) -> Result<Tessellation, BaselineError> {
    let cells = Cells::surfaces(sampler)?;
    tessellate_levels(sampler, &cells, levels, &mut Order::Rows)
}

/// [`at_levels`] at the [`levels`] that a deviation in pixels asks for.
///
/// # Errors
/// [`BaselineError`] if the model, the view or a setting is at fault.
pub fn per_surface(
    sampler: &dyn Sampler,
    view: &View,
    pixels: f64,
    max_level: u32,
) -> Result<Tessellation, BaselineError> {
    at_levels(sampler, &levels(sampler, view, pixels, max_level)?)
}

/// One resolution a KSQuad: dices of at most `dice_pixels` (the µ of equation 6.8), up to [`MAX_FACTOR`] a side.
///
/// # Errors
/// [`BaselineError`] if the model, the view or the setting is at fault.
pub fn per_ks_quad(sampler: &dyn Sampler, view: &View, dice_pixels: f64) -> Result<Tessellation, BaselineError> {
    view.check()?;
    positive("dice_pixels", dice_pixels)?;
    let cells = Cells::spans(sampler, 1)?;
    let count = |surface: usize, from: DVec2, to: DVec2| -> Result<u32, BaselineError> {
        let domain = cells.domains[surface];
        let curve = Curve {
            surface,
            from: domain.at(from),
            to: domain.at(to),
        };
        let dices = (curve.pixels(sampler, view)? / dice_pixels).ceil();
        Ok((dices as u32).clamp(1, MAX_FACTOR))
    };
    let mut on_edges = Vec::new();
    for edge in &cells.edges {
        on_edges.push(if edge.collapsed {
            0
        } else {
            count(edge.surface, edge.from, edge.to)?
        });
    }
    let mut mesher = Mesher::new(sampler, &cells);
    for cell in &cells.cells {
        let side = |side: Side| on_edges[cell.edges[side as usize].edge as usize];
        let middle = |from: DVec2, to: DVec2| count(cell.surface, cell.at(from), cell.at(to));
        let u = middle(DVec2::new(0.0, 0.5), DVec2::new(1.0, 0.5))?
            .max(side(Side::VMin))
            .max(side(Side::VMax));
        let v = middle(DVec2::new(0.5, 0.0), DVec2::new(0.5, 1.0))?
            .max(side(Side::UMin))
            .max(side(Side::UMax));
        let sides = Side::ALL.map(|which| matching(side(which), [u, v][which.runs_along()]));
        grid(&mut mesher, cell, Segments { inside: [u, v], sides }, &mut Order::Rows)?;
    }
    Ok(mesher.finish())
}

/// One grid a surface, where every cell is a surface.
pub(crate) fn tessellate_levels(
    sampler: &dyn Sampler,
    cells: &Cells,
    levels: &[u32],
    order: &mut Order<'_>,
) -> Result<Tessellation, BaselineError> {
    if levels.len() != cells.cells.len() {
        let value = levels.len() as f64;
        return Err(BaselineError::Setting {
            name: "number of levels",
            value,
            expected: "one level a surface",
        });
    }
    let mut on_edges = vec![0; cells.edges.len()];
    for (cell, &level) in cells.cells.iter().zip(levels) {
        within("level", level, 1..=MAX_LEVEL, "a level from 1 to 9")?;
        for side in cell
            .edges
            .iter()
            .filter(|side| !cells.edges[side.edge as usize].collapsed)
        {
            let on_edge = &mut on_edges[side.edge as usize];
            *on_edge = segments(level).max(*on_edge);
        }
    }
    let mut mesher = Mesher::new(sampler, cells);
    for (cell, &level) in cells.cells.iter().zip(levels) {
        let inside = segments(level);
        let sides = cell.edges.map(|side| matching(on_edges[side.edge as usize], inside));
        grid(
            &mut mesher,
            cell,
            Segments {
                inside: [inside; 2],
                sides,
            },
            order,
        )?;
    }
    Ok(mesher.finish())
}

/// The segments of a side; a collapsed one has none of its own and takes those of the inside.
fn matching(on_edge: u32, inside: u32) -> u32 {
    if on_edge == 0 { inside } else { on_edge }
}

/// The greatest distance in pixels between the middles of triangle edges and the surface above them.
fn deviation(
    sampler: &dyn Sampler,
    view: &View,
    surface: usize,
    domain: Domain,
    level: u32,
) -> Result<f64, BaselineError> {
    // Points at half the spacing of the grid, row by row: even ones are vertices.
    let size = 2 * segments(level) as usize;
    let mut rows: Vec<Vec<DVec3>> = Vec::new();
    for j in 0..=size {
        let point = |i| {
            position(
                sampler,
                surface,
                domain.at(DVec2::new(i as f64, j as f64) / size as f64),
            )
        };
        rows.push((0..=size).map(point).collect::<Result<_, _>>()?);
    }
    let mut greatest = 0.0_f64;
    for j in 0..=size {
        for i in 0..=size {
            let (a, b) = match (i % 2, j % 2) {
                (0, 0) => continue,
                (1, 0) => (rows[j][i - 1], rows[j][i + 1]),
                (0, _) => (rows[j - 1][i], rows[j + 1][i]),
                _ => (rows[j - 1][i - 1], rows[j + 1][i + 1]),
            };
            let middle = rows[j][i];
            greatest = greatest.max(view.pixels(distance_to_segment(middle, a, b), middle));
        }
    }
    Ok(greatest)
}
