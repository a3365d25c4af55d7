//! The buffers of a quadtree, and their bind groups.

use crate::binding;
use crate::layout::{self, Control, arguments};
use crate::passes::Passes;
use crate::view::Frame;
use crate::{KeyleafError, Settings};
use keyleaf_surface::Surface;

/// Buffers whose size depends on the capacity, and the bind groups over them.
#[derive(Debug)]
pub(crate) struct Buffers {
    pub frame: wgpu::Buffer,
    pub leaves: wgpu::Buffer,
    pub measures: wgpu::Buffer,
    pub parents: wgpu::Buffer,
    pub state: wgpu::Buffer,
    pub lists: wgpu::Buffer,
    pub table: wgpu::Buffer,
    /// Where back faces are culled.
    pub faces: Option<wgpu::Buffer>,
    pub control: wgpu::Buffer,
    pub arguments: wgpu::Buffer,
}

/// Group 0 of every module of the update.
pub(crate) struct Groups {
    pub update: wgpu::BindGroup,
    pub decide: wgpu::BindGroup,
    pub apply: wgpu::BindGroup,
    pub measure: wgpu::BindGroup,
    pub compact: wgpu::BindGroup,
    pub copy: wgpu::BindGroup,
    pub rebuild: Option<wgpu::BindGroup>,
    pub cull: Option<wgpu::BindGroup>,
}

/// Refuses a capacity below the number of roots, or beyond what the device can bind.
pub(crate) fn check_capacity(
    device: &wgpu::Device,
    surface: &dyn Surface,
    settings: &Settings,
) -> Result<(), KeyleafError> {
    let capacity = settings.capacity;
    let buffer_bytes = |capacity| layout::buffer_bytes(capacity, settings.drawn_faces(), settings.pairs);
    let roots = surface.topology().half_edge_count();
    if capacity < roots {
        return Err(KeyleafError::CapacityBelowRoots { capacity, roots });
    }
    let limits = device.limits();
    let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    for (buffer, bytes) in buffer_bytes(capacity) {
        if bytes > limit {
            let mut most = capacity;
            while buffer_bytes(most).iter().any(|(_, b)| *b > limit) {
                most -= (most / 64).max(1);
            }
            return Err(KeyleafError::BeyondLimits {
                buffer,
                what: "leaves",
                items: capacity.into(),
                bytes,
                limit,
                most: most.into(),
            });
        }
    }
    Ok(())
}

impl Buffers {
    pub fn new(device: &wgpu::Device, settings: &Settings, culled_faces: Option<u32>) -> Self {
        use wgpu::BufferUsages as U;
        let make = |label: &str, size: u64, usage: U| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let storage = U::STORAGE | U::COPY_DST | U::COPY_SRC;
        let sized = |name: &str| {
            let bytes = layout::buffer_bytes(settings.capacity, settings.drawn_faces(), settings.pairs)
                .iter()
                .find(|(n, _)| *n == name)
                .map_or(16, |(_, b)| (*b).max(16));
            make(&format!("keyleaf.{name}"), bytes, storage)
        };
        use encase::ShaderType;
        Self {
            frame: make("keyleaf.frame", Frame::min_size().get(), U::UNIFORM | U::COPY_DST),
            leaves: sized("leaves"),
            measures: sized("measures"),
            parents: sized("parents"),
            state: sized("state"),
            lists: sized("lists"),
            table: sized("table"),
            faces: culled_faces.map(|faces| make("keyleaf.faces", (4 * u64::from(faces)).max(16), storage)),
            control: make("keyleaf.control", size_of::<Control>() as u64, storage),
            arguments: make("keyleaf.arguments", arguments::SIZE, storage | U::INDIRECT),
        }
    }
}

impl Groups {
    pub fn new(device: &wgpu::Device, passes: &Passes, b: &Buffers) -> Self {
        let group = |name: &str, buffers: &[(u32, &wgpu::Buffer)]| {
            passes.stage(name).map(|stage| {
                let resources: Vec<_> = buffers
                    .iter()
                    .map(|(n, buffer)| (*n, buffer.as_entire_binding()))
                    .collect();
                binding::group(device, &format!("keyleaf.{name}"), &stage.layout, &resources)
            })
        };
        let required = |name: &str, buffers: &[(u32, &wgpu::Buffer)]| {
            group(name, buffers).unwrap_or_else(|| unreachable!("every kind has the module {name}"))
        };
        let leaves_on = [
            (0, &b.frame),
            (1, &b.leaves),
            (2, &b.table),
            (3, &b.state),
            (4, &b.lists),
            (5, &b.control),
        ];
        let mut update = vec![
            (0, &b.frame),
            (1, &b.measures),
            (2, &b.parents),
            (3, &b.state),
            (4, &b.lists),
            (5, &b.control),
        ];
        if let Some(faces) = &b.faces {
            update.extend([(6, &b.leaves), (7, faces)]);
        }
        Self {
            update: required("update", &update),
            cull: b
                .faces
                .as_ref()
                .and_then(|faces| group("cull", &[(0, &b.frame), (1, faces)])),
            decide: required("decide", &leaves_on),
            apply: required("apply", &leaves_on),
            measure: required(
                "measure",
                &[
                    (0, &b.frame),
                    (1, &b.leaves),
                    (2, &b.measures),
                    (3, &b.parents),
                    (4, &b.lists),
                    (5, &b.control),
                ],
            ),
            compact: required(
                "compact",
                &[
                    (0, &b.frame),
                    (1, &b.leaves),
                    (2, &b.table),
                    (3, &b.state),
                    (4, &b.lists),
                    (5, &b.control),
                    (6, &b.measures),
                    (7, &b.parents),
                ],
            ),
            copy: required("copy", &[(0, &b.frame), (1, &b.control), (2, &b.arguments)]),
            rebuild: group(
                "rebuild",
                &[(0, &b.frame), (1, &b.leaves), (2, &b.table), (5, &b.control)],
            ),
        }
    }
}
