// Low and high ground, rock where it is steep, snow above its line; edges broken up by a little noise.
// requires: shared/shading.wgsl, draw/varying.wgsl

fn lattice(cell: vec2i) -> f32 {
    let x = u32(cell.x) * 0x9e3779b1u ^ u32(cell.y) * 0x85ebca77u;
    let y = (x ^ (x >> 15u)) * 0x2c1b3c6du;
    return f32((y ^ (y >> 13u)) & 0xffffu) / 65535.0;
}

fn patchiness(p: vec2f) -> f32 {
    let cell = vec2i(floor(p));
    let t = smoothstep(vec2f(0.0), vec2f(1.0), fract(p));
    return mix(mix(lattice(cell), lattice(cell + vec2i(1, 0)), t.x), mix(lattice(cell + vec2i(0, 1)), lattice(cell + vec2i(1, 1)), t.x), t.y);
}

fn material(v: Varying, normal: vec3f) -> vec3f {
    let world = v.position + shading.eye;
    let range = max(shading.highest - shading.lowest, 1e-6);
    let scale = 24.0 / range;
    let rough = patchiness(world.xz * scale) * 0.5 + patchiness(world.xz * scale * 3.7) * 0.3 + patchiness(world.xz * scale * 11.3) * 0.2 - 0.5;
    let slope = sqrt(max(1.0 - normal.y * normal.y, 0.0)) / max(normal.y, 1e-3) * (1.0 + 0.5 * rough);
    let height = (world.y - shading.lowest) / range + 0.2 * rough;
    let ground = mix(shading.low, shading.high, smoothstep(0.0, 1.0, height)) * (1.0 + 0.25 * rough);
    let rock = mix(ground, shading.steep * (1.0 + 0.3 * rough), smoothstep(shading.gentle, shading.steepest, slope));
    let snow_line = shading.snow_line + 0.12 * rough * range;
    let lies = smoothstep(snow_line - 0.03 * range, snow_line + 0.03 * range, world.y)
        * (1.0 - smoothstep(shading.gentle, shading.steepest * 1.4, slope));
    return mix(rock, shading.snow, lies);
}
