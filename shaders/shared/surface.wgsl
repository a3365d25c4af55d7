// What every surface module answers with. Positions are in object space, relative to the surface's present origin.

struct SurfaceFrame {
    position: vec3f,
    du: vec3f,
    dv: vec3f,
    normal: vec3f,
}

// Of half a triangle, by that of the whole: how long its edges are.
const HALF_LEVEL: f32 = 0.70710678;

// Bounds of the diamond of a leaf (the leaf and its H-neighbour), in object units.
struct SurfaceBound {
    centre: vec3f, // of the hypotenuse, on the surface
    radius: f32,   // ball that contains the surface over the diamond: for culling
    size: f32,     // half the length of the drawn hypotenuse, from above; never grows from parent to child: for metrics
    guard: f32,    // ball that contains the guard balls of the children: for the guard band
    deviation: f32, // distance of the surface from flat triangles of this level, from above; never grows from parent to child
    pair_deviation: f32, // the same for the halves of such a triangle on both sides of its median
}
