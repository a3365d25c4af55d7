// Where a point of a map lies: one quad face over a rectangle, x = u * extent (east), z = -v * extent (north is -z), relative to an
// origin. The origin is subtracted in integers, so that the result is exact to 2^-24 of the distance, whatever the extent.
// Twin: keyleaf-surface `map`.
// requires: shared/quad_coord.wgsl

struct MapPosition {
    origin: vec2u,  // (u, v) of the origin in 2^-32, clamped to the map
    step: vec2f,    // extent along u and v * 2^-32
    rest: vec2f,    // what is left: x and z of (u, v) = origin
    extent: vec2f,
}

fn map_xz(at: QuadCoord, map: MapPosition) -> vec2f {
    let x = parameter_difference(at.u, at.u_is_one, map.origin.x) * map.step.x;
    let z = parameter_difference(at.v, at.v_is_one, map.origin.y) * map.step.y;
    return vec2f(x, -z) + map.rest;
}

// Half the drawn hypotenuse and median of a diamond, and half their difference in v, have this length on the ground.
fn map_reach(map: MapPosition) -> f32 {
    return 0.5 * max(map.extent.x, map.extent.y);
}

// The frame of a map whose height has the derivatives (h_u, h_v) in u and v.
fn map_frame(position: vec3f, slope: vec2f, map: MapPosition) -> SurfaceFrame {
    let normal = normalize(scaled_vector(vec3f(-slope.x / map.extent.x, 1.0, slope.y / map.extent.y)));
    return SurfaceFrame(position, vec3f(map.extent.x, slope.x, 0.0), vec3f(0.0, slope.y, -map.extent.y), normal);
}
