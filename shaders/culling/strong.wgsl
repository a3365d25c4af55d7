// Strong quad culling as printed (Concheiro 6.12, SQC): a face is culled when every square of its control net faces away. Not
// conservative, though the thesis calls it so: tangents of a surface are sums of differences of all rows and columns of the net, and
// their cross products need not point to the side of any square.
// requires: shared/patch.wgsl

fn culled_from(face: u32) -> u32 {
    return 0u;
}

fn face_is_back(face: u32, eye: vec3f, side: f32) -> bool {
    let p = patch_of(face);
    for (var l = 0u; l < p.degree.y; l++) {
        for (var k = 0u; k < p.degree.x; k++) {
            let first = p.base + k + l * p.stride;
            let a = surface_a[first].xyz;
            let b = surface_a[first + 1u].xyz;
            let c = surface_a[first + 1u + p.stride].xyz;
            let d = surface_a[first + p.stride].xyz;
            let normal = cross(c - a, d - b);
            // A square without area says nothing.
            if any(normal != vec3f(0.0)) && side * dot(normal, 0.25 * (a + b + c + d) - eye) <= 0.0 {
                return false;
            }
        }
    }
    return true;
}
