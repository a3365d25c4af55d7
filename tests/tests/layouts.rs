//! Rust and WGSL lay out what they share alike: offsets, sizes, constants and bindings as naga computes them. No device.

use crate::shaders::{channels, drawn_kind, files_in, kinds, morphing_channels, parse};
use encase::ShaderType;
use encase::internal::WriteInto;
use glam::{Mat4, Vec3, Vec4};
use keyleaf::binding::Binding;
use keyleaf::draw::{Attribute, Sky};
use keyleaf::layout::{self, Control, Leaf, Measure, arguments};
use keyleaf::shading::{Background, Shading};
use keyleaf::{Frame, Morph, modules};
use naga::{AddressSpace, Literal, Module, StorageAccess, TypeInner};
use std::collections::BTreeMap;
use std::mem::{offset_of, size_of};

/// (member, offset) of a struct, and its size.
fn members(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let (_, ty) = module
        .types
        .iter()
        .find(|(_, ty)| ty.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("no struct {name}"));
    let TypeInner::Struct { members, span } = &ty.inner else {
        panic!("{name} is no struct")
    };
    (
        members
            .iter()
            .map(|m| (m.name.clone().unwrap_or_default(), m.offset))
            .collect(),
        *span,
    )
}

fn assert_members(files: &[&str], name: &str, expected: &[(&str, usize)], size: usize) {
    let (found, span) = members(&parse(files), name);
    let expected: Vec<(String, u32)> = expected
        .iter()
        .map(|(member, offset)| ((*member).to_owned(), *offset as u32))
        .collect();
    assert_eq!((found, span as usize), (expected, size), "{name}");
}

/// (name of the field, its offset) of a Rust struct.
macro_rules! offsets {
    ($ty:ty: $($field:ident),* $(,)?) => { &[$((stringify!($field), offset_of!($ty, $field))),*] };
}

#[test]
fn leaves() {
    let (key, origin) = (offset_of!(Leaf, key), offset_of!(Leaf, origin));
    let expected = [
        ("node_hi", key),
        ("node_lo", key + 4),
        ("face", key + 8),
        ("root", key + 12),
        ("x", origin),
        ("y", origin + 4),
        ("orientation_level", offset_of!(Leaf, orientation_level)),
        ("entry", offset_of!(Leaf, entry)),
    ];
    assert_members(&["shared/leaf.wgsl"], "Leaf", &expected, size_of::<Leaf>());
    let measure = offsets!(Measure: centre, radius, size, guard, parent_size, parent_radius);
    assert_members(&["shared/leaf.wgsl"], "Measure", measure, size_of::<Measure>());
}

#[test]
fn control() {
    let expected = offsets!(Control:
        leaves, allocated, visible, splitters, changes, splits, merges, freed, sources, targets, requests, lowest_bucket, pressure,
        idle, entries_used, rebuilds, unmet, starved, passes, lost, last_splits, last_merges, near, since_step, failed, view_serial, mergers, wishes);
    assert_members(&["shared/control.wgsl"], "Control", expected, size_of::<Control>());
}

#[test]
fn attributes() {
    let (found, span) = members(
        &parse(&[
            "draw/varying_attributes.wgsl",
            "draw/mark_none.wgsl",
            "morph/none.wgsl",
            "surfaces/mesh.wgsl",
        ]),
        "Attribute",
    );
    let offsets: Vec<usize> = found.iter().map(|(_, offset)| *offset as usize).collect();
    let fields = [
        offset_of!(Attribute, normal),
        offset_of!(Attribute, colour),
        offset_of!(Attribute, uv),
    ];
    assert_eq!((&offsets[..3], span as usize), (&fields[..], size_of::<Attribute>()));
}

/// Writes a uniform whose fields are distinct, and looks for them at naga's offsets. `words` has the first word of each field.
fn assert_uniform<T: ShaderType + WriteInto>(files: &[&str], name: &str, value: &T, words: &[(&str, u32)]) {
    let mut buffer = encase::UniformBuffer::new(Vec::new());
    buffer.write(value).expect("a vector grows");
    let bytes = buffer.into_inner();
    let (found, span) = members(&parse(files), name);
    assert_eq!(bytes.len(), span.next_multiple_of(16) as usize, "{name}");
    assert_eq!(found.len(), words.len(), "{name}");
    for ((member, offset), (field, word)) in found.iter().zip(words) {
        let at = *offset as usize;
        let written = u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
        assert_eq!((member.as_str(), written), (*field, *word), "{name}");
    }
}

fn matrix(first: f32) -> Mat4 {
    Mat4::from_cols_array(&std::array::from_fn(|i| first + i as f32))
}

#[test]
fn frame() {
    let mut planes = [Vec4::ZERO; 12];
    planes[0] = Vec4::splat(500.0);
    let value = Frame {
        clip_from_view: matrix(100.0),
        view_from_object: matrix(200.0),
        world_from_object: matrix(300.0),
        normal_from_object: matrix(400.0),
        eye: Vec3::splat(1.0),
        near: 2.0,
        planes,
        wish_scale: 3.0,
        guard_factor: 4.0,
        without_distance: 5,
        max_level: 6,
        capacity: 7,
        table_mask: 8,
        target_leaves: 9,
        base_grid: 10,
        view_serial: 11,
        metric_parameter: 12.0,
        pairs: 17,
        refined_eye: Vec3::splat(13.0),
        wish_when_near: 14.0,
        morph_slack: 15.0,
        pressure: 16,
    };
    let f = f32::to_bits;
    let words = [
        ("clip_from_view", f(100.0)),
        ("view_from_object", f(200.0)),
        ("world_from_object", f(300.0)),
        ("normal_from_object", f(400.0)),
        ("eye", f(1.0)),
        ("near", f(2.0)),
        ("planes", f(500.0)),
        ("wish_scale", f(3.0)),
        ("guard_factor", f(4.0)),
        ("without_distance", 5),
        ("max_level", 6),
        ("capacity", 7),
        ("table_mask", 8),
        ("target_leaves", 9),
        ("base_grid", 10),
        ("view_serial", 11),
        ("metric_parameter", f(12.0)),
        ("pairs", 17),
        ("refined_eye", f(13.0)),
        ("wish_when_near", f(14.0)),
        ("morph_slack", f(15.0)),
        ("pressure", 16),
    ];
    assert_uniform(&["shared/frame.wgsl"], "Frame", &value, &words);
    let (found, _) = members(&parse(&["shared/frame.wgsl"]), "Frame");
    let (last, offset) = found.last().expect("members");
    assert_eq!(
        (last.as_str(), u64::from(*offset)),
        ("pressure", Frame::pressure_offset())
    );
}

#[test]
fn shading() {
    // Every field gets its number in the order of the Rust struct, by which WGSL must name them too.
    macro_rules! numbered {
        ($($field:ident: $make:expr),* $(,)?) => {{
            let mut next = 0.0;
            let mut words = Vec::new();
            let value = Shading { $($field: {
                next += 1.0;
                words.push((stringify!($field), f32::to_bits(next)));
                $make(next)
            }),* };
            (value, words)
        }};
    }
    let number = |x: f32| x;
    let (value, words) = numbered!(
        eye: Vec3::splat, exposure: number, sun_direction: Vec3::splat, line_width: number, sun_colour: Vec3::splat,
        fog_density: number, ambient: Vec3::splat, lowest: number, fog_colour: Vec3::splat, highest: number,
        base_colour: Vec3::splat, snow_line: number, low: Vec3::splat, gentle: number, high: Vec3::splat, steepest: number,
        steep: Vec3::splat, pixels_per_unit: number, snow: Vec3::splat, unused_too: number, line_colour: Vec4::splat,
    );
    assert_uniform(&["shared/shading.wgsl"], "Shading", &value, &words);
}

#[test]
fn background() {
    let value = Background {
        world_from_clip: matrix(7.0),
    };
    assert_uniform(
        &Sky::FILES,
        "Background",
        &value,
        &[("world_from_clip", f32::to_bits(7.0))],
    );
}

/// The value of a u32 constant.
fn constant(module: &Module, name: &str) -> u32 {
    let (_, constant) = module
        .constants
        .iter()
        .find(|(_, c)| c.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("no constant {name}"));
    match module.global_expressions[constant.init] {
        naga::Expression::Literal(Literal::U32(value)) => value,
        ref other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn arguments_and_constants() {
    let copy = parse(&["passes/copy.wgsl"]);
    let expected = [
        ("FOR_SPLITS", arguments::SPLITS),
        ("FOR_MERGES", arguments::MERGES),
        ("FOR_CHANGES", arguments::CHANGES),
        ("FOR_MEASURE", arguments::MEASURE),
        ("FOR_COMPACT", arguments::COMPACT),
        ("FOR_CLEAR", arguments::CLEAR),
        ("FOR_ENTER", arguments::ENTER),
        ("FOR_UPDATE", arguments::UPDATE),
        ("FOR_UPDATE_REQUESTED", arguments::UPDATE_REQUESTED),
        ("FOR_LEAVES", arguments::LEAVES),
        ("FOR_DRAW", arguments::DRAW),
    ];
    for (name, bytes) in expected {
        assert_eq!(u64::from(constant(&copy, name)) * 4, bytes, "{name}");
        assert_eq!(bytes % 4, 0);
    }
    const { assert!(arguments::SIZE >= arguments::DRAW + 20) };
    assert_eq!(constant(&copy, "GROUP_SIZE"), layout::GROUP_SIZE);
    assert_eq!(constant(&copy, "UPDATE_LEAVES"), layout::UPDATE_LEAVES);
    let update = parse(&[
        "passes/update.wgsl",
        "shared/balance.wgsl",
        "shared/faces_drawn.wgsl",
        "shared/pairs_forced.wgsl",
    ]);
    assert_eq!(
        constant(&update, "GROUP_SIZE") * constant(&update, "LEAVES_PER_INVOCATION"),
        layout::UPDATE_LEAVES
    );
    for (name, value) in [
        ("PAIR", layout::state::PAIR),
        ("FREE", layout::state::FREE),
        ("FRESH", layout::state::FRESH),
        ("MATURE", layout::state::MATURE),
        ("MERGE", layout::state::MERGE),
        ("DIGIT_SHIFT", layout::state::DIGIT_SHIFT),
        ("STATE_FLAGS", layout::state::FLAGS),
        ("BUCKETS", keyleaf::key::forest::BUCKETS as u32),
        ("ONE", keyleaf::key::ONE),
        ("MAX_LEVEL", keyleaf::key::MAX_LEVEL),
        ("NONE", layout::NO_ENTRY),
    ] {
        assert_eq!(constant(&update, name), value, "{name}");
    }
    let decide = parse(&["passes/decide.wgsl"]);
    assert_eq!(constant(&decide, "ROOT_DIGIT"), layout::state::ROOT_DIGIT);
    assert!(layout::MAX_CAPACITY < constant(&decide, "TOMBSTONE") - 1);
}

#[test]
fn workgroups_are_as_large_as_the_arguments_say() {
    for module in kinds().iter().flat_map(modules) {
        let naga = parse(&module.files);
        for entry in module.entries {
            let found = naga
                .entry_points
                .iter()
                .find(|e| e.name == *entry)
                .unwrap_or_else(|| panic!("no entry point {entry}"));
            let size = if module.name == "copy" { 1 } else { layout::GROUP_SIZE };
            assert_eq!(found.workgroup_size, [size, 1, 1], "{entry}");
        }
    }
}

/// What a module declares: (group, binding) → kind.
fn declared(module: &Module) -> BTreeMap<(u32, u32), Binding> {
    let mut all = BTreeMap::new();
    for (_, global) in module.global_variables.iter() {
        let Some(at) = &global.binding else { continue };
        let kind = match (global.space, &module.types[global.ty].inner) {
            (AddressSpace::Uniform, _) => Binding::Uniform,
            (AddressSpace::Storage { access }, _) if access.contains(StorageAccess::STORE) => Binding::Write,
            (AddressSpace::Storage { .. }, _) => Binding::Read,
            (_, TypeInner::Sampler { .. }) => Binding::Sampler,
            (_, TypeInner::Image { .. }) if at.group == 1 => Binding::Texels,
            (_, TypeInner::Image { .. }) => Binding::Colour,
            other => panic!("{:?} is {other:?}", global.name),
        };
        assert!(all.insert((at.group, at.binding), kind).is_none(), "{at:?} twice");
    }
    all
}

fn is_storage(kind: &Binding) -> bool {
    matches!(kind, Binding::Read | Binding::Write)
}

/// What group 1 may hold: parameters, topology, tables A and B, heights, bounds of heights.
const SURFACE: [Binding; 6] = [
    Binding::Uniform,
    Binding::Read,
    Binding::Read,
    Binding::Read,
    Binding::Texels,
    Binding::Texels,
];

#[test]
fn the_update_declares_the_bindings_of_its_layouts_and_at_most_eight_storage_buffers() {
    for kind in kinds() {
        let surface = declared(&parse(&[kind.surface, "shared/topology.wgsl"]));
        let of_surface = surface.values().filter(|kind| is_storage(kind)).count();
        for module in modules(&kind) {
            let found = declared(&parse(&module.files));
            for ((group, binding), kind) in &found {
                let expected = if *group == 0 {
                    module.bindings.get(*binding as usize)
                } else {
                    SURFACE.get(*binding as usize)
                };
                assert_eq!(Some(kind), expected, "{} group {group} binding {binding}", module.name);
                assert!(
                    *group == 0 || (*group == 1 && module.uses_surface),
                    "{} group {group}",
                    module.name
                );
            }
            for (binding, expected) in (0..).zip(module.bindings).filter(|(_, kind)| **kind != Binding::Absent) {
                assert_eq!(
                    found.get(&(0, binding)),
                    Some(expected),
                    "{} binding {binding} is in the layout only",
                    module.name
                );
            }
            let storage = module.bindings.iter().filter(|kind| is_storage(kind)).count();
            let all = storage + if module.uses_surface { of_surface } else { 0 };
            assert!(all <= 8, "{} of {kind:?} binds {all} storage buffers", module.name);
        }
    }
}

#[test]
fn no_draw_binds_more_than_eight_storage_buffers() {
    for surface in files_in("surfaces/") {
        let still = channels().into_iter().map(|channel| (channel, Morph::None));
        for (channel, morph) in still.chain(morphing_channels().map(|channel| (channel, Morph::Geomorph))) {
            let kind = drawn_kind(surface, "metrics/edge.wgsl", morph, None);
            let files = [channel.files(), kind.drawing_files()].concat();
            let found = declared(&parse(&files));
            let storage = found.values().filter(|kind| is_storage(kind)).count();
            assert!(storage <= 8, "{files:?}: {storage}");
            for ((_, binding), kind) in found.iter().filter(|((group, _), _)| *group == 1) {
                assert_eq!(
                    Some(kind),
                    SURFACE.get(*binding as usize),
                    "{files:?} group 1 binding {binding}"
                );
            }
        }
    }
}

#[test]
fn parameters_of_surfaces_lie_where_the_shaders_read_them() {
    let expected: &[(&str, &[(&str, u32)])] = &[
        ("cube", &[("vertices", 8), ("faces", 6)]),
        (
            "house with noise",
            &[
                ("vertices", 11),
                ("faces", 11),
                ("octaves", 4),
                ("seed", 7),
                ("frequency", 2.5f32.to_bits()),
                ("gain", 0.5f32.to_bits()),
                ("amplitude", 0.08f32.to_bits()),
            ],
        ),
        (
            "cube with texture",
            &[
                ("vertices", 8),
                ("faces", 6),
                ("size", 24),
                ("scale", 1e-3f32.to_bits()),
                ("offset", 0.02f32.to_bits()),
                ("repeats", 1),
            ],
        ),
        (
            "height field",
            &[("cells", 32), ("scale", 1f32.to_bits()), ("shift", 100f32.to_bits())],
        ),
        (
            "bilinear height field",
            &[("cells", 32), ("scale", 1f32.to_bits()), ("shift", 100f32.to_bits())],
        ),
        (
            "terrain",
            &[
                ("first_bits", 2),
                ("octaves", 8),
                ("seed", 1),
                ("gain", 0.5f32.to_bits()),
                ("ridged", 0.7f32.to_bits()),
                ("contrast", 0.8f32.to_bits()),
            ],
        ),
    ];
    for (name, surface) in crate::surfaces::all() {
        let Some((_, words)) = expected.iter().find(|(n, _)| *n == name) else {
            continue;
        };
        let module = parse(&[surface.shader()]);
        let uniform = module
            .global_variables
            .iter()
            .find(|(_, g)| g.space == AddressSpace::Uniform)
            .expect("parameters");
        let type_name = module.types[uniform.1.ty].name.clone().expect("a name");
        let (found, span) = members(&module, &type_name);
        let params = surface.tables(glam::DVec3::ZERO).params;
        assert_eq!(params.len(), span as usize, "{name}");
        for (member, word) in *words {
            let (_, at) = found
                .iter()
                .find(|(n, _)| n == member)
                .unwrap_or_else(|| panic!("{name} has no {member}"));
            let at = *at as usize;
            assert_eq!(
                u32::from_le_bytes(params[at..at + 4].try_into().expect("four bytes")),
                *word,
                "{name}: {member}"
            );
        }
    }
}
