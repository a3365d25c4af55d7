//! What accuracy costs in time: records of runs, how two of them differ, how far drawn triangles are from their surface, and the
//! report that shows all of it. No GPU and no graphics API: the program measures, this crate counts and shows.
//!
//! | module | holds |
//! |---|---|
//! | [`run`] | [`RunRecord`](run::RunRecord): what a run measured, on what and with what; files with a version |
//! | [`statistics`] | percentiles, the spread of a median, differences in pairs |
//! | [`mod@compare`] | two runs frame by frame, with a verdict against a limit |
//! | [`error`] | drawn triangles against their surface in 64-bit numbers: in space, in pixels, of normals and silhouettes |
//! | [`picture`] | PSNR and SSIM of two pictures under a mask |
//! | [`pareto`], [`slope`] | settings that none beats; how fast an error falls, and where rounding stops it |
//! | [`scaling`] | frame time and memory for other sizes on other devices, on paper |
//! | [`report`] | the data of a report, and its CSV |
//! | [`svg`], [`html`] | its figures, and its one page |
//! | [`table`] | tables of text, and figures as people read them |
//!
//! # Practice
//!
//! *A run.* Fill a [`RunRecord`](run::RunRecord), write [`to_json`](run::RunRecord::to_json), read it again, compare:
//!
//! ```
//! use keyleaf_report::compare::{CompareOptions, compare};
//! use keyleaf_report::run::{Clock, Device, PassRecord, RunRecord, SceneRun, Series, Tool};
//!
//! let device = Device { name: "A device".into(), ..Device::default() };
//! let mut before = RunRecord::new(Tool::default(), device, [1280, 720], 30);
//! let frames = (0..60).map(|frame| 1.0 + 0.1 * f64::from(frame % 7));
//! let mut run = SceneRun::new("torus", "flight", Clock::Timestamps, 60);
//! run.passes = vec![PassRecord::new("draw", Series::new(frames))];
//! before.runs.push(run);
//! let before = RunRecord::parse("before.json".as_ref(), &before.to_json()?)?;
//!
//! let mut after = before.clone();
//! after.runs[0].passes[0].ms = Series::new(before.runs[0].passes[0].ms.samples.iter().map(|ms| 1.1 * ms));
//! let options = CompareOptions { limit: Some(0.05), ..CompareOptions::default() };
//! let comparison = compare(&before, &after, &options)?;
//! assert!(!comparison.passes());
//! assert!(comparison.text().ends_with("more than 5.0 % slower: torus draw, torus all passes"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *A report.* For each setting: a [`Point`](report::Point) of its run, with [`Errors`](report::Errors) of [`error::measure`] and
//! [`picture::picture_error`]; the points of a scene into a [`SceneReport`](report::SceneReport), the scenes into a
//! [`Report`](report::Report), and that into [`html::page`] and [`Report::csv`](report::Report::csv). `examples/report.rs` does so with
//! made-up numbers.

pub mod compare;
pub mod error;
pub mod html;
pub mod pareto;
pub mod picture;
pub mod report;
pub mod run;
pub mod scaling;
pub mod slope;
pub mod statistics;
pub mod svg;
pub mod table;

#[cfg(test)]
mod sample;
