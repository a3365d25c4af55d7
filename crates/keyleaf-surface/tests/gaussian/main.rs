//! Gaussian products: dual space, patches, bounds and converters, and what is lost in f32.

mod bounds;
mod conditioning;
mod covariances;
mod emulation;
mod models;
#[path = "../oracle_tables/mod.rs"]
mod oracle_tables;
mod oracles;
mod patches;
mod products;
mod random_products;
mod refine;
mod rounding;
mod shaders;
mod surface;
mod surface_bounds;
