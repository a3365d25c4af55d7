//! Control meshes that are hard or wrong, opened as a user opens them: each is refused with its place and the reason, or has a surface
//! with finite positions and unit normals.

mod covariances;
mod folder;
mod kinds;
mod models;
mod shapes;
mod sharpness;
