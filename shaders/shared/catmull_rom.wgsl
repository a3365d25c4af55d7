// Weights of the four samples about a cell: the cubic that interpolates and whose slope at a sample is the central difference
// (Catmull and Rom 1974). In two dimensions, as a tensor product, it is C1. Twin: keyleaf-surface `interpolation`.

fn catmull_rom(f: f32) -> vec4f {
    return 0.5 * vec4f(f * (f * (2.0 - f) - 1.0), f * f * (3.0 * f - 5.0) + 2.0, f * (f * (4.0 - 3.0 * f) + 1.0), f * f * (f - 1.0));
}

fn catmull_rom_slope(f: f32) -> vec4f {
    return 0.5 * vec4f(f * (4.0 - 3.0 * f) - 1.0, f * (9.0 * f - 10.0), f * (8.0 - 9.0 * f) + 1.0, f * (3.0 * f - 2.0));
}
