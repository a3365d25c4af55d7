//! What a report shows: plain data, which the program fills.

mod csv;
mod quantity;
#[cfg(test)]
mod tests;

pub use quantity::Quantity;

use crate::error::{Measure, MeshError};
use crate::picture::PictureError;
use crate::run::{Clock, Device, SceneRun, Tool};
use crate::scaling::Scaling;
use crate::statistics::Interval;
use serde::{Deserialize, Serialize};

/// All of a report: [`html::page`](crate::html::page) and [`Report::csv`] show it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Its title.
    pub title: String,
    /// What measured.
    pub tool: Tool,
    /// What was measured on.
    pub device: Device,
    /// What a reader should know before the figures, a paragraph each.
    pub notes: Vec<String>,
    /// The scenes.
    pub scenes: Vec<SceneReport>,
    /// What other sizes and devices would take.
    pub scaling: Option<Scaling>,
}

/// One scene at many settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneReport {
    /// Name of the scene.
    pub name: String,
    /// The camera, or the path of cameras.
    pub camera: String,
    /// Pixels of the picture.
    pub size: [u32; 2],
    /// What milliseconds are measured by.
    pub clock: Clock,
    /// One for each setting. Those of a series stand together, from coarse to fine.
    pub points: Vec<Point>,
    /// How time grows with the number of leaves.
    pub growth: Vec<GrowthPoint>,
    /// Remarks, a paragraph each.
    pub notes: Vec<String>,
}

/// One setting, measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// What varies from series to series, such as the metric: points of a series are joined by a line.
    pub series: String,
    /// What varies within the series, such as `4 px`.
    pub label: String,
    /// Median milliseconds of all passes.
    pub ms: f64,
    /// Where that median may lie.
    pub spread: Option<Interval>,
    /// Milliseconds by pass.
    pub passes: Vec<PassTime>,
    /// Leaves alive.
    pub leaves: f64,
    /// Triangles drawn.
    pub triangles: f64,
    /// Bytes of all buffers.
    pub bytes: u64,
    /// The factor by which full buffers raised the threshold: above 1 the setting was not reached.
    pub threshold_factor: f64,
    /// Errors, as far as they were measured.
    pub errors: Errors,
}

/// Milliseconds of a pass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PassTime {
    /// Name of the pass.
    pub name: String,
    /// Median milliseconds.
    pub ms: f64,
}

/// Errors of a setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Distance over the diagonal, both ways.
    pub object: Option<Measure>,
    /// Degrees between normals.
    pub normal: Option<Measure>,
    /// Pixels that the surface is off, seen side-on.
    pub pixels: Option<Measure>,
    /// Pixels that the silhouette is off.
    pub silhouette: Option<Measure>,
    /// Of the picture, against a reference.
    pub picture: Option<PictureError>,
}

/// A size of the quadtree and what it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GrowthPoint {
    /// Leaves alive.
    pub leaves: f64,
    /// Median milliseconds of all passes.
    pub ms: f64,
    /// Bytes of all buffers.
    pub bytes: u64,
}

impl Point {
    /// Times, counts and bytes of a run. Phases take the place of a pass that has them.
    pub fn of_run(series: &str, label: &str, run: &SceneRun) -> Self {
        let frame = run.frame_ms();
        let mut passes = Vec::new();
        for pass in &run.passes {
            let parts = if pass.phases.is_empty() {
                std::slice::from_ref(pass)
            } else {
                &pass.phases
            };
            passes.extend(parts.iter().map(|part| PassTime {
                name: part.name.clone(),
                ms: part.ms.p50,
            }));
        }
        Self {
            series: series.to_owned(),
            label: label.to_owned(),
            ms: frame.p50,
            spread: frame.median_interval(),
            passes,
            leaves: run.leaves.p50,
            triangles: run.triangles.p50,
            bytes: run.bytes(),
            threshold_factor: run.figures.get("threshold_factor_max").copied().unwrap_or(1.0),
            errors: Errors::default(),
        }
    }
}

impl Errors {
    /// What was measured of triangles, and of the picture.
    pub fn new(mesh: Option<&MeshError>, picture: Option<PictureError>) -> Self {
        let screen = mesh.and_then(|mesh| mesh.screen);
        Self {
            object: mesh.map(MeshError::both_ways),
            normal: mesh.map(|mesh| mesh.normal),
            pixels: screen.map(|screen| screen.side_on),
            silhouette: screen
                .and_then(|screen| screen.silhouette)
                .map(|silhouette| silhouette.error),
            picture,
        }
    }
}

impl SceneReport {
    /// Names of the series, in the order of their first points.
    pub fn series(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for point in &self.points {
            if !names.contains(&point.series.as_str()) {
                names.push(&point.series);
            }
        }
        names
    }

    /// The points that no other beats in time and in an error, by ascending time.
    pub fn front(&self, quantity: Quantity) -> Vec<usize> {
        let cost = |point: &Point| (point.ms, quantity.badness(point).unwrap_or(f64::NAN));
        crate::pareto::front(&self.points.iter().map(cost).collect::<Vec<_>>())
    }
}
