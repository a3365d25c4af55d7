//! Keys, neighbours, sites and the update, over many meshes: one program, so that it is linked once.

mod checks;
mod executable_model;
mod forest_against_model;
mod forest_properties;
mod meshes;
mod metrics;
mod model_pressure;
mod neighbours;
mod places;
mod recorded;
mod sites;
