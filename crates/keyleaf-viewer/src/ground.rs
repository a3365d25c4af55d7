//! How far a camera is from what it flies over: this sets its pace.

use crate::document::Document;
use glam::{DVec2, DVec3};
use keyleaf_stage::LoadedObject;

/// The least height, as a part of the scene's radius: nobody gets stuck on the ground.
const LEAST: f64 = 2e-4;

/// Height of a point above the ground below it, or, where there is none, its distance from the content; never 0.
pub fn height_above(document: &Document, eye: DVec3) -> f64 {
    let (low, high) = document.loaded.bounds;
    let radius = ((high - low).length() / 2.0).max(f64::MIN_POSITIVE.sqrt());
    let grounds = document.loaded.objects.iter().filter_map(|object| ground(object, eye));
    let nearest = grounds.map(|ground| (eye.y - ground).abs()).min_by(f64::total_cmp);
    let from_box = (eye - eye.clamp(low, high)).length();
    nearest.unwrap_or(from_box + 0.4 * radius).max(LEAST * radius)
}

/// The height of a terrain below a point: of a surface that is one quad over a rectangle.
fn ground(object: &LoadedObject, eye: DVec3) -> Option<f64> {
    let surface = &object.surface;
    let topology = surface.topology();
    let is_ground = ["height_field", "terrain"]
        .iter()
        .any(|name| surface.shader().contains(name));
    if !is_ground || topology.face_count() != 1 || topology.corner_count(0) != 4 {
        return None;
    }
    let at = |u: f64, v: f64| surface.face_coord(0, u, v).ok().map(|at| surface.point(at));
    let flat = |p: DVec3| DVec2::new(p.x, p.z);
    let (origin, along_u, along_v) = (at(0.0, 0.0)?, at(1.0, 0.0)?, at(0.0, 1.0)?);
    let (u_axis, v_axis) = (flat(along_u - origin), flat(along_v - origin));
    let eye = object.world_from_object.inverse().transform_point3(eye);
    let offset = flat(eye - origin);
    let u = (offset.dot(u_axis) / u_axis.length_squared()).clamp(0.0, 1.0);
    let v = (offset.dot(v_axis) / v_axis.length_squared()).clamp(0.0, 1.0);
    Some(object.world_from_object.transform_point3(at(u, v)?).y)
}
