//! Bézier and NURBS surfaces in f64: against exact tables, at hard places, joined.

mod bad_input;
mod bounds;
mod hard_cases;
mod joins;
mod models;
mod oracles;
mod own_parameters;
mod tables;
