//! More than 65,535 workgroups: dispatched in two dimensions.

use crate::gpu::gpu;
use crate::meshes;
use crate::surfaces;
use crate::world::{World, settings, uniform};
use glam::{DVec3, UVec2};
use keyleaf::layout::{self, groups_for};
use keyleaf::{Metric, Settings, View};
use wgpu::util::DeviceExt;

/// `groups_for` of `copy.wgsl`, for a list of counts.
fn shader() -> String {
    let copy = keyleaf_shaders::source("passes/copy.wgsl").expect("a file");
    let line = copy
        .lines()
        .find(|line| line.starts_with("const MAX_GROUPS"))
        .expect("the constant");
    let start = copy.find("fn groups_for(").expect("the function");
    let function = &copy[start..start + copy[start..].find("\n}\n").expect("its end") + 3];
    format!(
        "{line}\n{function}
        @group(0) @binding(0) var<storage, read> counts: array<vec2u>;
        @group(0) @binding(1) var<storage, read_write> arguments: array<u32>;
        @compute @workgroup_size(64)
        fn all(@builtin(global_invocation_id) id: vec3u) {{
            if id.x < arrayLength(&counts) {{ groups_for(counts[id.x].x, counts[id.x].y, 3u * id.x); }}
        }}"
    )
}

#[test]
fn groups_are_counted_alike_on_both_sides_and_cover_all_items() {
    let mut counts = Vec::new();
    for group in [layout::GROUP_SIZE, 4 * layout::GROUP_SIZE, layout::UPDATE_LEAVES] {
        for base in [
            0,
            1,
            group,
            1000 * group,
            65_535 * group,
            65_536 * group,
            131_070 * group,
            131_071 * group,
            4 * layout::MAX_CAPACITY,
        ] {
            counts.extend([base.saturating_sub(1), base, base + 1].map(|items| [items, group]));
        }
    }
    let device = &gpu().device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(shader().into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("all"),
        compilation_options: Default::default(),
        cache: None,
    });
    let storage = |contents: &[u8], usage| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents,
            usage,
        })
    };
    let input = storage(bytemuck::cast_slice(&counts), wgpu::BufferUsages::STORAGE);
    let output = storage(
        &vec![0; 12 * counts.len()],
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
    );
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: input.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: output.as_entire_binding(),
            },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((counts.len() as u32).div_ceil(64), 1, 1);
    }
    gpu().queue.submit([encoder.finish()]);
    let bytes =
        keyleaf::read_back::read(device, &gpu().queue, "groups", &output, 0, output.size()).expect("the device works");
    let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
    for ([items, group], found) in counts.iter().zip(words.as_chunks::<3>().0) {
        assert_eq!(*found, groups_for(*items, *group), "{items} items in groups of {group}");
        let [x, y, z] = found.map(u64::from);
        assert!(x <= 65_535 && y <= 65_535 && z == 1, "{items} items: {found:?}");
        assert!(
            x * y * u64::from(*group) >= u64::from(*items),
            "{items} items: {found:?}"
        );
    }
}

/// 4,194,304 leaves: what 128 MiB hold, and one group more than one dimension does.
#[test]
fn a_quadtree_of_four_million_leaves_is_updated_whole() {
    let positions = (0..9u32)
        .map(|v| DVec3::new(f64::from(v % 3), 0.0, -f64::from(v / 3)))
        .collect();
    let quads = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
    let surface = surfaces::flat(&meshes::mesh(positions, quads.map(Vec::from)));
    let leaves = uniform(surface.as_ref(), 9);
    let count = leaves.len() as u32;
    assert_eq!(count, 65_536 * layout::GROUP_SIZE);
    assert_eq!(groups_for(count, layout::GROUP_SIZE), [32_768, 2, 1]);
    let mut world = World::new(
        &surface,
        Settings {
            capacity: count,
            cull: false,
            max_level: 9,
            ..settings(Metric::Edge { pixels: 1e-3 })
        },
    );
    world.set_leaves(&leaves);
    let view = View::look_at(
        DVec3::new(1.0, 1.0, -1.0),
        DVec3::new(1.0, 0.0, -1.1),
        1.0,
        1e-3,
        UVec2::new(400, 300),
    );
    let snapshot = world.pass(&view);
    let control = snapshot.control;
    assert_eq!(
        (control.leaves, control.visible, control.entries_used, control.lost),
        (count, count, count, 0)
    );
    let fresh = snapshot
        .states
        .iter()
        .filter(|word| **word & (layout::state::FRESH | layout::state::PAIR) != 0)
        .count();
    assert_eq!(fresh, 0);
    assert!(snapshot.leaves.iter().all(|leaf| leaf.entry != layout::NO_ENTRY));
}
