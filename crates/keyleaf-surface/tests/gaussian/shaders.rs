//! The WGSL twins are valid and define what a surface must.

use naga::valid::{Capabilities, ValidationFlags, Validator};

#[path = "../shaders/mod.rs"]
mod composing;

const FILES: [&str; 4] = [
    "surfaces/gaussian_catmull_clark.wgsl",
    "surfaces/gaussian_catmull_clark_adjugate.wgsl",
    "surfaces/gaussian_loop.wgsl",
    "surfaces/gaussian_loop_adjugate.wgsl",
];

#[test]
fn all_variants_are_valid_and_define_the_interface() {
    for file in FILES {
        let source = composing::composed(file);
        let module =
            naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        if let Err(error) = validator.validate(&module) {
            panic!("{file}: {}", error.emit_to_string(&source));
        }
        for function in ["surface_point", "surface_frame", "surface_bound"] {
            let mut names = module.functions.iter().filter_map(|(_, f)| f.name.as_deref());
            assert!(names.any(|name| name == function), "{file} lacks {function}");
        }
    }
}
