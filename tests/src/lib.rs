//! Tests that span the crates of keyleaf. All of them are in one binary, `tests/main.rs`: linking wgpu is what takes long.
