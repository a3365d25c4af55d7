//! QAS, Butterfly and PN triangles in f64, and their tables in emulated f32.

mod bounds;
mod butterfly;
mod emulation;
mod hard_cases;
mod models;
#[path = "../oracle_tables/mod.rs"]
mod oracle_tables;
mod oracles;
mod point_normal;
#[path = "../gaussian/refine.rs"]
mod refine;
