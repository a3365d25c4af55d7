//! GPU against CPU, cracks, watertight surfaces and hard cases. One binary and one device for all: linking wgpu and starting a
//! device are what takes long. A test that needs a device fails if there is none.
//!
//! | module | holds the GPU to |
//! |---|---|
//! | [`shaders`], [`layouts`] | naga's view of every shader that a scene can ask for; no device |
//! | [`twin`], [`metrics`] | the CPU twin of the update, fed with what the GPU published, and the f64 twins of the metrics |
//! | [`every_pass`], [`checks`] | what must hold of every leaf set, and checks that can fail |
//! | [`history`], [`starvation`], [`scaling`] | where it settles |
//! | [`leaf_table`] | how long look-ups are |
//! | [`culling`], [`watertight`], [`closed_parts`], [`morphing`] | what is drawn |
//! | [`posing`] | what moves |
//! | [`hard_cases`], [`precision`], [`large`] | where numbers get very large, small or many |

mod gpu;
mod meshes;
mod random;
mod snapshot;
mod surfaces;
mod world;

mod checks;
mod closed_parts;
mod culling;
mod every_pass;
mod hard_cases;
mod history;
mod large;
mod layouts;
mod leaf_table;
mod metrics;
mod morphing;
mod pairs;
mod posing;
mod posing_gaussian;
mod precision;
mod scaling;
mod shaders;
mod starvation;
mod twin;
mod watertight;
