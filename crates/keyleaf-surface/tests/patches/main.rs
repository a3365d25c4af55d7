//! Bézier and NURBS surfaces in f64: against exact tables, at hard places, joined.

mod bad_input;
mod bounds;
mod even_spans;
mod hard_cases;
mod joins;
mod models;
#[path = "../oracle_tables/mod.rs"]
mod oracle_tables;
mod oracles;
mod own_parameters;
#[path = "../random/mod.rs"]
mod random;
mod tables;
