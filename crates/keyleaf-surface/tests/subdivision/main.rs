//! Catmull-Clark and Loop subdivision surfaces in f64: against tables of OpenSubdiv, against brute force, at hard places.

mod approximation;
mod bad_input;
mod bounds;
mod global_refinement;
mod models;
#[path = "../oracle_tables/mod.rs"]
mod oracle_tables;
mod oracles;
mod random_shapes;
mod speed;
mod tables;
