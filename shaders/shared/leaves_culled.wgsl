// Leaves are culled for facing away by the normal cone that `cone_measured.wgsl` kept behind the parents: axis, and the cosine of its
// angle. n . (p - eye) > 0 for all normals n of the cone and all points p of the leaf's ball: no triangle of it faces the eye.

// A part of the distance that rounding, also of the rasteriser, may add.
const EDGE_ON: f32 = 1e-4;

// `ball` has its centre relative to the eye; `side` is 0 where the eye is nowhere, and -1 for mirrored objects.
fn may_face_eye(slot: u32, ball: vec4f, side: f32) -> bool {
    let cone = parents[frame.capacity + slot];
    let along = side * dot(cone.xyz, ball.xyz);
    let across = length(cross(cone.xyz, ball.xyz));
    let sine = sqrt(max(1.0 - cone.w * cone.w, 0.0));
    return cone.w * along - sine * across <= ball.w + EDGE_ON * length(ball.xyz);
}
