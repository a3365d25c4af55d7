//! Subdivision surfaces.

mod control_mesh;

pub use control_mesh::{BoundaryRule, ControlMesh, Corner, Crease, Creasing, INFINITE_SHARPNESS};
