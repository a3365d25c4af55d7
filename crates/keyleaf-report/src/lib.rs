//! What accuracy costs in time: records of runs, how two of them differ, how far drawn triangles are from their surface, and the
//! report that shows all of it.

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
