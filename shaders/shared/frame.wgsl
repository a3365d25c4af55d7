// What a view asks of one quadtree in this frame. Object space is relative to the surface's origin; metrics are in world units.
// Rust: keyleaf `view::Frame`.

struct Frame {
    clip_from_view: mat4x4f,
    view_from_object: mat4x4f,  // rotation and scale only: the eye is subtracted first
    world_from_object: mat4x4f, // rotation and scale only
    normal_from_object: mat4x4f, // inverse transpose of the above, times the sign of its determinant
    eye: vec3f,                 // object space, relative to the origin
    near: f32,                  // world units: no distance counts as less
    planes: array<vec4f, 12>,   // CULLING and GUARD: object space, relative to the eye, inside positive, unit normals; unused: (0, 0, 0, 1)
    wish_scale: f32,            // metric over threshold of size 1 at distance 1
    guard_factor: f32,          // of the wish outside the guard band
    without_distance: u32,      // 1: the distance does not count
    max_level: u32,
    capacity: u32,              // slots
    table_mask: u32,            // entries - 1
    target_leaves: u32,         // 0: none
    base_grid: u32,             // k: a leaf is drawn as 4^k triangles
    view_serial: u32,           // another number for another view
    metric_parameter: f32,      // for metrics that have one
    pairs: u32,                 // where, in the array of parents, what is known of pairs begins
    refined_eye: vec3f,         // as `eye`: from where the leaves were refined
    wish_when_near: f32,        // wish of a node that is as large as it is far away, where the metric is a length
    morph_slack: f32,           // how far vertices may be from the surface: distance, over wish_scale; 0 where they do not morph
    pressure: i32,              // as in Control, after the last update; only where vertices morph
}

const CULLING: u32 = 0u;
const GUARD: u32 = 6u;
