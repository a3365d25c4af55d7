//! The WGSL files of the surfaces, put together as the composer does.
#![allow(dead_code)]

use std::path::Path;

/// Every surface module.
pub const SURFACES: [&str; 22] = [
    "surfaces/mesh.wgsl",
    "surfaces/displaced_texture.wgsl",
    "surfaces/displaced_noise.wgsl",
    "surfaces/height_field.wgsl",
    "surfaces/height_field_bilinear.wgsl",
    "surfaces/terrain.wgsl",
    "surfaces/bezier.wgsl",
    "surfaces/bezier_cubic.wgsl",
    "surfaces/nurbs.wgsl",
    "surfaces/nurbs_cubic.wgsl",
    "surfaces/nurbs_stair.wgsl",
    "surfaces/nurbs_de_boor.wgsl",
    "surfaces/nurbs_extraction.wgsl",
    "surfaces/nurbs_power.wgsl",
    "surfaces/catmull_clark.wgsl",
    "surfaces/loop.wgsl",
    "surfaces/qas.wgsl",
    "surfaces/pn.wgsl",
    "surfaces/gaussian_catmull_clark.wgsl",
    "surfaces/gaussian_catmull_clark_adjugate.wgsl",
    "surfaces/gaussian_loop.wgsl",
    "surfaces/gaussian_loop_adjugate.wgsl",
];

/// A file after all that it requires.
pub fn composed(file: &str) -> String {
    let mut done = Vec::new();
    let mut module = String::new();
    append(file, &mut done, &mut module);
    module
}

fn append(file: &str, done: &mut Vec<String>, module: &mut String) {
    if done.iter().any(|name| name == file) {
        return;
    }
    done.push(file.to_owned());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let requires = text.lines().filter_map(|line| line.strip_prefix("// requires:"));
    requires
        .flat_map(|list| list.split(',').map(str::trim))
        .for_each(|file| append(file, done, module));
    module.push_str(&text);
}
