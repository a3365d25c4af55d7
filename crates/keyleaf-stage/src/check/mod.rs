//! What is wrong with a drawn frame: nothing, if keyleaf keeps its promises.
//!
//! # Theory
//! A drawn surface is closed iff every edge of its triangles is used exactly once in each direction, but for those on a boundary of
//! the mesh. Edges are matched twice: by integer identity (the [`Site`](keyleaf_key::Site)s of their ends), which finds T-junctions
//! and gaps, and by the bits of the positions that the GPU computes, which finds what rounds differently on the two sides.
//!
//! # Practice
//! All of it works on what the GPU holds: leaves, flags, lists and table from [`Snapshot`], vertices from [`Inspector`], which runs
//! the WGSL surface function of the draw. Only identities are computed here, in integers.
//!
//! | file | finds |
//! |---|---|
//! | `leaves` | keys that are none, key and place that differ, lost, double and overlapping leaves, broken (I1) and (I2), wrong flags and lists |
//! | `table` | entries of the leaf table that are wrong, missing or unreachable |
//! | `edges` | cracks, T-junctions, vertices that are not finite, leaves left out of the draw although they are in view |
//! | `picture` | pixels of a rendered picture that do not show the emitted triangles |
//!
//! Cost: about a microsecond a drawn vertex on one core; 100,000 leaves on a base grid of 16 triangles take well under two seconds.

mod edges;
mod findings;
mod leaves;
mod picture;
mod sight;
mod table;
#[cfg(test)]
mod tests;
mod weld;

pub use findings::{Finding, FindingKind, Findings};
pub use picture::PictureCheck;
pub use sight::Sight;
pub use weld::{Welder, grid_point, site_number};

use crate::Stage;
use keyleaf::headless::Headless;
use keyleaf::inspect::{Emitted, Inspector};
use keyleaf::key::Topology;
use keyleaf::read_back::Snapshot;
use keyleaf::{Balance, BaseGrid, KeyleafError, Quadtree, Settings, Statistics, View};

/// What one surface held in a frame, and what was wrong with it.
#[derive(Debug, Clone)]
pub struct ObjectReport {
    /// Name of the surface.
    pub object: String,
    /// Figures of the last pass.
    pub statistics: Statistics,
    /// What was wrong.
    pub findings: Findings,
}

/// Checks the frames of a stage. Holds the pipelines that evaluate its surfaces.
pub struct Checker {
    inspectors: Vec<Inspector>,
}

impl Checker {
    /// Compiles what evaluates the surfaces of `stage`.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing.
    pub fn new(gpu: &Headless, stage: &Stage) -> Result<Self, KeyleafError> {
        let inspector = |quadtree: &Quadtree| {
            Inspector::new(
                &gpu.device,
                &Quadtree::kind(quadtree.surface().as_ref(), quadtree.settings()),
            )
        };
        Ok(Self {
            inspectors: stage
                .objects
                .iter()
                .map(|o| inspector(&o.quadtree))
                .collect::<Result<_, _>>()?,
        })
    }

    /// Checks every surface of `stage` as its last update for `view` left it. Waits for the device.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn frame(&self, gpu: &Headless, stage: &Stage, view: &View) -> Result<Vec<ObjectReport>, KeyleafError> {
        let object = |(object, inspector): (&crate::StageObject, &Inspector)| {
            let (statistics, findings) = quadtree(gpu, &object.quadtree, inspector, view)?;
            Ok(ObjectReport {
                object: object.name.clone(),
                statistics,
                findings,
            })
        };
        stage.objects.iter().zip(&self.inspectors).map(object).collect()
    }

    /// What evaluates surface `i` of the stage.
    pub fn inspector(&self, i: usize) -> Option<&Inspector> {
        self.inspectors.get(i)
    }
}

/// Checks one quadtree as its last update for `view` left it. Waits for the device.
///
/// # Errors
/// [`KeyleafError::ReadBack`] if the device is lost.
pub fn quadtree(
    gpu: &Headless,
    quadtree: &Quadtree,
    inspector: &Inspector,
    view: &View,
) -> Result<(Statistics, Findings), KeyleafError> {
    let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
    let sight = Sight::new(view, quadtree.world_from_object(), quadtree.origin());
    let emit = |slots: &[u32]| inspector.emit(&gpu.device, &gpu.queue, quadtree, slots);
    let findings = frame(
        quadtree.surface().topology(),
        &snapshot,
        quadtree.settings(),
        Some(&sight),
        emit,
    )?;
    Ok((snapshot.statistics, findings))
}

/// Checks what was read back of a quadtree. `emit` gives the vertices of the leaves in given slots, on the base grid of `settings`;
/// with `sight`, leaves that it sees must be in the draw.
///
/// # Errors
/// Those of `emit`.
pub fn frame<E>(
    topology: &Topology,
    snapshot: &Snapshot,
    settings: &Settings,
    sight: Option<&Sight>,
    emit: impl FnMut(&[u32]) -> Result<Emitted, E>,
) -> Result<Findings, E> {
    let mut findings = Findings::default();
    let places = leaves::check(topology, snapshot, settings, &mut findings);
    if settings.balance == Balance::Table {
        table::check(snapshot, &mut findings);
    }
    let grid = BaseGrid::of(settings);
    edges::check(topology, snapshot, &places, &grid, settings, sight, emit, &mut findings)?;
    Ok(findings)
}
