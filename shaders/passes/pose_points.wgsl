// What of a quadratic patch is a weighted sum of the vertices of the control mesh: points, and two tangents where the kind has any
// (`POINT_SUMS`). Twin: keyleaf-surface `quadratic::mask`. An invocation a point; costs a multiply-add a weight.
// requires: passes/pose_triangles.wgsl

@compute @workgroup_size(64)
fn pose_points(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let point = invocation(group, groups, lane);
    if point >= pose.points {
        return;
    }
    let at = pose.point_words + 4u * point;
    let own = vertex_position(pose_words[at]);
    let first_term = pose_words[at + 1u];
    let first_weight = pose_words[at + 3u];
    var sums = array<vec3f, POINT_SUMS>();
    for (var k = 0u; k < listed(pose_words[at + 2u]); k++) {
        let edge = vertex_position(pose_words[first_term + k]) - own;
        for (var sum = 0u; sum < POINT_SUMS; sum++) {
            sums[sum] += pose_rows[first_weight + POINT_SUMS * k + sum] * edge;
        }
    }
    for (var sum = 0u; sum < POINT_SUMS; sum++) {
        scratch[POINT_SUMS * point + sum] = vec4f(sums[sum], 0.0);
    }
}
