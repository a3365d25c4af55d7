//! The WGSL modules without a device: they are valid, and their uniforms are laid out as the tables are.

mod fixtures;
mod random;
mod shaders;

use naga::valid::{Capabilities, ValidationFlags, Validator};

fn parsed(file: &str) -> naga::Module {
    let source = shaders::composed(file);
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    if let Err(error) = validator.validate(&module) {
        panic!("{file}: {}", error.emit_to_string(&source));
    }
    module
}

#[test]
fn every_surface_defines_the_interface() {
    for file in shaders::SURFACES {
        let module = parsed(file);
        for function in ["surface_point", "surface_frame", "surface_bound"] {
            assert!(
                module
                    .functions
                    .iter()
                    .any(|(_, f)| f.name.as_deref() == Some(function)),
                "{file} lacks {function}"
            );
        }
    }
}

#[test]
fn modules_declare_what_the_tables_fill_and_as_many_bytes() {
    for fixture in fixtures::fixtures() {
        let module = parsed(fixture.surface.shader());
        let tables = fixture.surface.tables(fixture.origin);
        let global = |name: &str| {
            module
                .global_variables
                .iter()
                .map(|(_, v)| v)
                .find(|v| v.name.as_deref() == Some(name))
        };
        let uniform = global("surface").expect("a uniform");
        assert_eq!(
            module.types[uniform.ty].inner.size(module.to_ctx()) as usize,
            tables.params.len(),
            "{}",
            fixture.name
        );
        assert_eq!(global("surface_a").is_some(), !tables.a.is_empty(), "{}", fixture.name);
        assert_eq!(global("surface_b").is_some(), !tables.b.is_empty(), "{}", fixture.name);
        assert_eq!(
            global("heights").is_some(),
            tables.heights.is_some(),
            "{}",
            fixture.name
        );
        assert_eq!(
            global("height_bounds").is_some(),
            tables.height_bounds.is_some(),
            "{}",
            fixture.name
        );
    }
}
