//! One surface with its quadtree: buffers by leaf, and the passes of a frame.
//!
//! # Theory
//! Khoury's linear quadtree keeps only the leaves, each a key, and every frame splits and merges them in one parallel pass (Khoury
//! 3.1.3: compute, copy, draw).
//!
//! # Changes versus the papers
//! * Leaves keep their slot instead of being copied from list to list, and the surface's answers about a leaf are cached with it.
//!   A frame costs a distance and some planes a leaf, whatever the surface; the surface is asked once in a leaf's life.
//! * Neighbours are the leaves that are there, found in a hash table that only changes touch, not the wishes of neighbours.
//! * The changes that a frame decides happen at the start of the next one, so that what is drawn is what was culled.
//!
//! # Practice: one pass
//! | dispatch | invocations | does |
//! |---|---|---|
//! | `pose_…` | vertices, faces, edges | only where the control mesh has moved: control points, normals, bounds |
//! | `measure_all` | leaves | only after that, or when the origin has moved: asks the surface about all leaves |
//! | `decide_splits` | leaves that want to split | what was published → change records, requests |
//! | `decide_merges` | leaves with a satisfied parent | what was published → change records |
//! | `copy_changes` | 1 | arguments |
//! | `apply` | changes | leaves, table |
//! | `flag` | changes | pair flags about the changes |
//! | `measure` | 4 a change | asks the surface about new leaves |
//! | `copy_leaves` | 1 | the new count, arguments |
//! | `match_slots`, `move_leaves` | freed slots | compaction |
//! | `clear_table`, `enter_leaves` | entries, leaves | only when the table is too full |
//! | `cull_faces` | faces | only where back faces are culled: which may be seen |
//! | `update` | 1 for 8 leaves | publishes wishes, culls, lists |
//! | `copy_counts` | 1 | admission, pressure, arguments |

use crate::buffers::{Buffers, Groups, check_capacity};
use crate::layout::{self, Control, Leaf, arguments, state};
use crate::passes::{Kind, Passes, Stage};
use crate::posing::Posing;
use crate::settings::{Balance, Morph, Pairs};
use crate::statistics::{Statistics, StatisticsReader};
use crate::surface_buffers::SurfaceBuffers;
use crate::view::{Frame, View};
use crate::{KeyleafError, Settings};
use glam::{DAffine3, DVec3};
use keyleaf_key::Place;
use keyleaf_surface::Surface;
use std::sync::Arc;

/// One surface with its quadtree.
pub struct Quadtree {
    passes: Arc<Passes>,
    surface: Arc<dyn Surface>,
    surface_buffers: SurfaceBuffers,
    buffers: Buffers,
    groups: Groups,
    settings: Settings,
    world_from_object: DAffine3,
    reader: StatisticsReader,
    needs_measure: bool,
    /// Where the control mesh moves and the GPU follows it.
    posing: Option<Posing>,
    /// Of the last update or look.
    frame: Option<Frame>,
    /// What the last update was for.
    refined: Option<View>,
}

/// The parts of a pass, in their order: the rows of the table above.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Phase {
    /// What has moved: the control points of the surface, and what the surface says of all leaves. Nothing in most frames.
    Refresh,
    /// Splits, merges and requests are decided.
    Decide,
    /// They happen: leaves, leaf table, pair flags.
    Apply,
    /// The surface is asked about new leaves.
    Measure,
    /// Holes are filled; the table is made anew when it is too full.
    Compact,
    /// All leaves publish wishes, are culled and listed.
    Update,
}

impl Phase {
    /// All, in their order.
    pub const ALL: [Self; 6] = [
        Self::Refresh,
        Self::Decide,
        Self::Apply,
        Self::Measure,
        Self::Compact,
        Self::Update,
    ];

    /// The name that reports and labels use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Refresh => "refresh",
            Self::Decide => "decide",
            Self::Apply => "apply",
            Self::Measure => "measure",
            Self::Compact => "compact",
            Self::Update => "update",
        }
    }
}

impl Quadtree {
    /// The kind of pipelines that a surface with these settings needs.
    pub fn kind(surface: &dyn Surface, settings: &Settings) -> Kind {
        Kind {
            surface: surface.shader(),
            metric: settings.metric.shader(),
            balance: settings.balance,
            back_faces: settings.drawn_faces(),
            morph: settings.morph,
            pair_metric: (settings.pairs == Pairs::Wished).then(|| settings.metric.pair_shader()),
            pose: if settings.moving { surface.pose_shader() } else { None },
        }
    }

    /// A quadtree of the roots of `surface`, placed in the world by `world_from_object`.
    ///
    /// # Errors
    /// Settings out of range, a capacity below the number of roots, or buffers beyond the limits of the device.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        passes: Arc<Passes>,
        surface: Arc<dyn Surface>,
        world_from_object: DAffine3,
        settings: Settings,
    ) -> Result<Self, KeyleafError> {
        settings.validate()?;
        check_capacity(device, surface.as_ref(), &settings)?;
        let surface_buffers =
            SurfaceBuffers::new(device, queue, &passes.surface_layout, surface.as_ref(), DVec3::ZERO)?;
        let culled = settings.drawn_faces().shader().map(|_| surface.topology().face_count());
        let buffers = Buffers::new(device, &settings, culled);
        let groups = Groups::new(device, &passes, &buffers);
        let posing = Posing::new(device, &passes, surface.as_ref(), &surface_buffers)?;
        let mut quadtree = Self {
            passes,
            surface,
            surface_buffers,
            buffers,
            groups,
            settings,
            world_from_object,
            reader: StatisticsReader::new(device),
            needs_measure: true,
            posing,
            frame: None,
            refined: None,
        };
        let roots: Vec<Place> = quadtree.surface.topology().roots().collect();
        quadtree.write_leaves(queue, &roots);
        Ok(quadtree)
    }

    /// The surface.
    pub fn surface(&self) -> &Arc<dyn Surface> {
        &self.surface
    }

    /// The present settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Where the object is in the world.
    pub fn world_from_object(&self) -> &DAffine3 {
        &self.world_from_object
    }

    /// Object-space point that positions on the GPU are relative to.
    pub fn origin(&self) -> DVec3 {
        self.surface_buffers.origin
    }

    /// Moves the object.
    pub fn set_world_from_object(&mut self, world_from_object: DAffine3) {
        self.world_from_object = world_from_object;
    }

    /// Changes settings that need no new buffers or pipelines.
    ///
    /// # Errors
    /// Settings out of range, or another capacity, kind of metric or balance than the quadtree was made with.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), KeyleafError> {
        settings.validate()?;
        let fixed = |setting, value: String| {
            Err(KeyleafError::Setting {
                setting,
                value,
                expected: "fixed when the quadtree is made",
            })
        };
        if settings.capacity != self.settings.capacity {
            return fixed("capacity", settings.capacity.to_string());
        }
        if settings.metric.shader() != self.settings.metric.shader() {
            return fixed("metric", settings.metric.name().to_owned());
        }
        if settings.balance != self.settings.balance {
            return fixed("balance", format!("{:?}", settings.balance));
        }
        if settings.drawn_faces() != self.settings.drawn_faces() {
            return fixed("back_faces", settings.back_faces.name().to_owned());
        }
        if settings.pairs != self.settings.pairs {
            return fixed("pairs", settings.pairs.name().to_owned());
        }
        if settings.moving != self.settings.moving {
            return fixed("moving", settings.moving.to_string());
        }
        self.needs_measure |= settings.max_level != self.settings.max_level
            || settings.base_grid != self.settings.base_grid
            || settings.metric.parameter() != self.settings.metric.parameter();
        self.settings = settings;
        Ok(())
    }

    /// Moves the vertices of the control mesh, object space. The next update finds control points and bounds on the GPU, and asks the
    /// surface about all leaves anew. [`surface`](Self::surface) stays as it is.
    ///
    /// # Errors
    /// [`KeyleafError::Cage`] if the settings do not say that it moves, the surface cannot be posed on the GPU
    /// ([`set_surface`](Self::set_surface) can), a position is not finite or there are not as many as before.
    pub fn set_cage(&mut self, positions: Vec<DVec3>) -> Result<(), KeyleafError> {
        self.posing()?.set(positions, None)
    }

    /// The same of a covariance mesh: means and covariances (xx, xy, xz, yy, yz, zz) in squared object units, one a vertex. Variances below the
    /// floor are raised to it. Bounds are those of the surface that it was made with, which is to
    /// [allow](keyleaf_surface::gaussian::GaussianProduct::allow_for) for all poses.
    ///
    /// # Errors
    /// [`KeyleafError::Cage`] as [`set_cage`](Self::set_cage), or if a matrix is no covariance.
    pub fn set_covariance_cage(&mut self, means: Vec<DVec3>, covariances: &[[f64; 6]]) -> Result<(), KeyleafError> {
        self.posing()?.set(means, Some(covariances))
    }

    fn posing(&mut self) -> Result<&mut Posing, KeyleafError> {
        let reason = "it was made without Settings::moving, or does not follow from its control mesh on the GPU";
        self.posing
            .as_mut()
            .ok_or_else(|| KeyleafError::Cage(reason.to_owned()))
    }

    /// Whether [`set_cage`](Self::set_cage) can move it.
    pub fn is_posed_on_gpu(&self) -> bool {
        self.posing.is_some()
    }

    /// Puts another surface of the same kind and size in the place of this one, such as another pose of it. The tables are made on the
    /// CPU and sent whole.
    ///
    /// # Errors
    /// [`KeyleafError::Cage`] if it is of another kind or size.
    pub fn set_surface(&mut self, queue: &wgpu::Queue, surface: Arc<dyn Surface>) -> Result<(), KeyleafError> {
        let is_same = surface.shader() == self.surface.shader() && surface.topology() == self.surface.topology();
        if !is_same || !self.surface_buffers.replace(queue, surface.as_ref()) {
            return Err(KeyleafError::Cage(
                "the other surface has other faces or patches".to_owned(),
            ));
        }
        self.surface = surface;
        self.needs_measure = true;
        Ok(())
    }

    /// Starts again from a given set of leaves: a balanced quadtree, such as `read_back` gives. Wishes and requests are forgotten.
    ///
    /// # Errors
    /// [`KeyleafError::Leaves`] if there are more than the capacity, or if they do not cover every root exactly once.
    pub fn set_leaves(&mut self, queue: &wgpu::Queue, leaves: &[Place]) -> Result<(), KeyleafError> {
        if leaves.len() > self.settings.capacity as usize {
            return Err(KeyleafError::Leaves(format!(
                "{} leaves exceed the capacity of {}",
                leaves.len(),
                self.settings.capacity
            )));
        }
        let mut area = std::collections::HashMap::new();
        for leaf in leaves {
            if !self.surface.topology().has_root(leaf.face, leaf.root) || !leaf.is_valid() {
                return Err(KeyleafError::Leaves(format!("{leaf:?} is no node of this surface")));
            }
            *area.entry((leaf.face, leaf.root)).or_insert(0u64) += 1u64 << (62 - 2 * leaf.level);
        }
        let roots = self.surface.topology().half_edge_count() as usize;
        if area.len() != roots || area.values().any(|a| *a != 1 << 62) {
            return Err(KeyleafError::Leaves("some root is not covered exactly once".to_owned()));
        }
        self.write_leaves(queue, leaves);
        Ok(())
    }

    fn write_leaves(&mut self, queue: &wgpu::Queue, leaves: &[Place]) {
        let records: Vec<Leaf> = leaves.iter().map(Leaf::new).collect();
        let states: Vec<u32> = leaves
            .iter()
            .map(|&p| state::FRESH | (state::digit_of(p) << state::DIGIT_SHIFT))
            .collect();
        queue.write_buffer(&self.buffers.leaves, 0, bytemuck::cast_slice(&records));
        queue.write_buffer(&self.buffers.state, 0, bytemuck::cast_slice(&states));
        let requests = vec![0u32; leaves.len()];
        queue.write_buffer(
            &self.buffers.state,
            4 * u64::from(self.settings.capacity),
            bytemuck::cast_slice(&requests),
        );
        let control = Control {
            leaves: leaves.len() as u32,
            allocated: leaves.len() as u32,
            failed: -1,
            ..Control::default()
        };
        queue.write_buffer(&self.buffers.control, 0, bytemuck::bytes_of(&control));
        let mut words = [0u32; (arguments::SIZE / 4) as usize];
        let mut put = |at: u64, groups: [u32; 3]| words[(at / 4) as usize..][..3].copy_from_slice(&groups);
        let count = leaves.len() as u32;
        // The first update clears and fills the table, and measures all leaves, before anything is decided.
        put(arguments::LEAVES, layout::groups_for(count, layout::GROUP_SIZE));
        put(arguments::ENTER, layout::groups_for(count, layout::GROUP_SIZE));
        put(
            arguments::CLEAR,
            layout::groups_for(layout::table_entries(self.settings.capacity), 4 * layout::GROUP_SIZE),
        );
        queue.write_buffer(&self.buffers.arguments, 0, bytemuck::cast_slice(&words));
        self.needs_measure = true;
        self.reader.forget();
    }

    /// Records the passes of a frame for a view: `settings.settle` of them. Nothing is submitted, nothing waits.
    pub fn update(&mut self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, view: &View) {
        self.refined = Some(*view);
        self.prepare(queue, view);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("keyleaf.update"),
                timestamp_writes: None,
            });
            for _ in 0..self.settings.settle {
                for phase in Phase::ALL {
                    self.run(phase, &mut pass);
                }
            }
        }
        self.finish(encoder);
    }

    /// As [`Quadtree::update`], every phase in a compute pass of its own, whose timestamps the caller names.
    pub fn update_timed<'a>(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        view: &View,
        mut timestamps: impl FnMut(Phase) -> Option<wgpu::ComputePassTimestampWrites<'a>>,
    ) {
        self.refined = Some(*view);
        self.prepare(queue, view);
        for _ in 0..self.settings.settle {
            for phase in Phase::ALL {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(phase.name()),
                    timestamp_writes: timestamps(phase),
                });
                self.run(phase, &mut pass);
            }
        }
        self.finish(encoder);
    }

    /// What is copied after the passes.
    fn finish(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if self.settings.morph != Morph::None {
            let (from, to) = (std::mem::offset_of!(Control, pressure) as u64, Frame::pressure_offset());
            encoder.copy_buffer_to_buffer(&self.buffers.control, from, &self.buffers.frame, to, Some(4));
        }
        self.reader.record(encoder, &self.buffers.control);
    }

    /// Lets the next draws see the leaves from `view` without refining them for it: they stay those of the last update, and so do those
    /// that it listed as visible.
    pub fn look_from(&mut self, queue: &wgpu::Queue, view: &View) {
        self.prepare(queue, view);
    }

    /// What the passes read of a view.
    fn prepare(&mut self, queue: &wgpu::Queue, view: &View) {
        self.follow(queue, view);
        let mut frame = Frame::seen_from(
            view,
            &self.refined.unwrap_or(*view),
            &self.world_from_object,
            self.surface_buffers.origin,
            &self.settings,
        );
        frame.view_serial = self.frame.map_or(0, |last| last.view_serial);
        if self.frame != Some(frame) {
            frame.view_serial = frame.view_serial.wrapping_add(1);
        }
        self.frame = Some(frame);
        let mut bytes = encase::UniformBuffer::new(Vec::new());
        if bytes.write(&frame).is_ok() {
            let without_pressure = &bytes.into_inner()[..Frame::pressure_offset() as usize];
            queue.write_buffer(&self.buffers.frame, 0, without_pressure);
        }
    }

    /// Puts the origin of positions near the eye, on a lattice so coarse that it seldom moves. A function of the view alone: what is
    /// drawn must not depend on where the camera came from. Seen from far away, the nearest point of the object counts.
    fn follow(&mut self, queue: &wgpu::Queue, view: &View) {
        let eye = self.world_from_object.inverse().transform_point3(view.eye);
        let scale = self
            .world_from_object
            .matrix3
            .determinant()
            .abs()
            .cbrt()
            .max(f64::MIN_POSITIVE);
        let cell = (view.origin_cell() / scale).log2().floor().exp2();
        let (least, most) = self.surface.bounding_box();
        let origin = (eye.clamp(least, most) / cell).round() * cell;
        if origin != self.surface_buffers.origin {
            self.surface_buffers.move_origin(queue, self.surface.as_ref(), origin);
            self.needs_measure = true;
        }
        if let Some(posing) = &mut self.posing {
            self.needs_measure |= posing.write(queue, origin);
        }
    }

    /// Table, flags and measures of all leaves, where they are out of date.
    fn measure_if_needed(&mut self, pass: &mut wgpu::ComputePass<'_>) {
        if !std::mem::take(&mut self.needs_measure) {
            return;
        }
        self.dispatch(pass, "measure", 1, &self.groups.measure, arguments::LEAVES);
        if let Some(rebuild) = &self.groups.rebuild {
            self.dispatch(pass, "rebuild", 0, rebuild, arguments::CLEAR);
            self.dispatch(pass, "rebuild", 1, rebuild, arguments::ENTER);
            self.dispatch(pass, "flag", 1, &self.groups.decide, arguments::LEAVES);
        }
    }

    /// Control points and bounds, where the control mesh has moved.
    fn pose_if_needed(&mut self, pass: &mut wgpu::ComputePass<'_>) {
        if let (Some(posing), Some(stage)) = (&mut self.posing, self.passes.stage("pose")) {
            posing.record(stage, pass);
        }
    }

    fn run(&mut self, phase: Phase, pass: &mut wgpu::ComputePass<'_>) {
        if phase == Phase::Refresh {
            self.pose_if_needed(pass);
            self.measure_if_needed(pass);
        }
        let groups = &self.groups;
        match phase {
            Phase::Refresh => {}
            Phase::Decide => {
                self.dispatch(pass, "decide", 0, &groups.decide, arguments::SPLITS);
                self.dispatch(pass, "decide", 1, &groups.decide, arguments::MERGES);
                self.dispatch_one(pass, "copy", 0, &groups.copy);
            }
            Phase::Apply => {
                self.dispatch(pass, "apply", 0, &groups.apply, arguments::CHANGES);
                if self.passes.kind.balance == Balance::Table {
                    self.dispatch(pass, "flag", 0, &groups.decide, arguments::CHANGES);
                }
            }
            Phase::Measure => self.dispatch(pass, "measure", 0, &groups.measure, arguments::MEASURE),
            Phase::Compact => {
                self.dispatch_one(pass, "copy", 1, &groups.copy);
                self.dispatch(pass, "compact", 0, &groups.compact, arguments::COMPACT);
                self.dispatch(pass, "compact", 1, &groups.compact, arguments::COMPACT);
                if let Some(rebuild) = &groups.rebuild {
                    self.dispatch(pass, "rebuild", 0, rebuild, arguments::CLEAR);
                    self.dispatch(pass, "rebuild", 1, rebuild, arguments::ENTER);
                }
            }
            Phase::Update => {
                if let Some(cull) = &groups.cull {
                    self.cull_faces(pass, cull);
                }
                self.dispatch(pass, "update", 0, &groups.update, arguments::UPDATE);
                self.dispatch(pass, "update", 1, &groups.update, arguments::UPDATE_REQUESTED);
                self.dispatch_one(pass, "copy", 2, &groups.copy);
            }
        }
    }

    fn cull_faces(&self, pass: &mut wgpu::ComputePass<'_>, group: &wgpu::BindGroup) {
        if self.bind(pass, "cull", 0, group).is_some() {
            let faces = self.surface.topology().face_count();
            let [x, y, z] = layout::groups_for(faces, layout::GROUP_SIZE);
            pass.dispatch_workgroups(x, y, z);
        }
    }

    fn bind<'a>(
        &'a self,
        pass: &mut wgpu::ComputePass<'_>,
        name: &str,
        entry: usize,
        group: &wgpu::BindGroup,
    ) -> Option<&'a Stage> {
        let stage = self.passes.stage(name)?;
        pass.set_pipeline(stage.pipelines.get(entry)?);
        pass.set_bind_group(0, group, &[]);
        if stage.uses_surface {
            pass.set_bind_group(1, &self.surface_buffers.group, &[]);
        }
        Some(stage)
    }

    fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>, name: &str, entry: usize, group: &wgpu::BindGroup, at: u64) {
        if self.bind(pass, name, entry, group).is_some() {
            pass.dispatch_workgroups_indirect(&self.buffers.arguments, at);
        }
    }

    fn dispatch_one(&self, pass: &mut wgpu::ComputePass<'_>, name: &str, entry: usize, group: &wgpu::BindGroup) {
        if self.bind(pass, name, entry, group).is_some() {
            pass.dispatch_workgroups(1, 1, 1);
        }
    }

    /// The latest figures that have arrived: some frames late, `None` before the first. The device must be polled now and then,
    /// as submitting does.
    pub fn statistics(&mut self) -> Option<Statistics> {
        self.reader.latest(&self.settings)
    }

    /// (name, bytes) of every buffer and texture.
    pub fn memory(&self) -> Vec<(&'static str, u64)> {
        let mut all =
            layout::buffer_bytes(self.settings.capacity, self.settings.drawn_faces(), self.settings.pairs).to_vec();
        all.push(("frame", self.buffers.frame.size()));
        all.push(("control", self.buffers.control.size()));
        all.push(("arguments", self.buffers.arguments.size()));
        all.extend(self.buffers.faces.iter().map(|faces| ("faces", faces.size())));
        all.extend(self.surface_buffers.sizes.iter().copied());
        all.extend(self.posing.iter().map(|posing| ("pose", posing.bytes())));
        all
    }

    pub(crate) fn buffers(&self) -> &Buffers {
        &self.buffers
    }

    pub(crate) fn surface_tables(&self) -> [&wgpu::Buffer; 2] {
        [&self.surface_buffers.a, &self.surface_buffers.b]
    }

    pub(crate) fn surface_group(&self) -> &wgpu::BindGroup {
        &self.surface_buffers.group
    }

    /// The pipelines that it was made with.
    pub fn passes(&self) -> &Arc<Passes> {
        &self.passes
    }
}
