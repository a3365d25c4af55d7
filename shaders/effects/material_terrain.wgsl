// Grass, dry slopes, rock and snow, by height and slope, with edges broken up by a little noise.
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
    let height = saturate((world.y - shading.lowest) / range) + rough * 0.16;
    let slope = 1.0 - normal.y + rough * 0.06;
    let grass = mix(vec3f(0.075, 0.115, 0.035), vec3f(0.16, 0.17, 0.06), saturate(rough + 0.5));
    let dry = vec3f(0.27, 0.215, 0.125);
    let rock = mix(vec3f(0.19, 0.17, 0.15), vec3f(0.30, 0.275, 0.25), saturate(rough + 0.5));
    var ground = mix(grass, dry, smoothstep(0.25, 0.6, height));
    ground = mix(ground, rock, smoothstep(0.6, 0.8, height));
    ground = mix(ground, vec3f(0.82, 0.86, 0.92), smoothstep(0.84, 0.93, height) * smoothstep(0.5, 0.3, slope));
    return mix(ground, rock, smoothstep(0.18, 0.36, slope));
}
