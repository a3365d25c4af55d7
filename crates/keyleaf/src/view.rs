//! A camera, and what it asks of a quadtree.

use crate::Settings;
use crate::metric::Scale;
use crate::settings::{Morph, Pairs};
use encase::ShaderType;
use glam::{DAffine3, DMat3, DQuat, DVec3, Mat4, UVec2, Vec3, Vec4};
use keyleaf_key::MAX_LEVEL;
use keyleaf_surface::Geomorph;

/// How a camera projects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Reversed and infinitely deep.
    Perspective {
        /// Vertical field of view in radians, inside (0, pi).
        fov_y: f64,
        /// Distance of the near plane, world units.
        near: f64,
    },
    /// Parallel; the distance does not count in any metric.
    Orthographic {
        /// Height of the view in world units.
        height: f64,
        /// Distance of the near plane, world units (may be negative).
        near: f64,
        /// Distance of the far plane.
        far: f64,
    },
}

/// A camera with its viewport. Right-handed, Y up, looking along -Z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World position, f64: precision near the eye does not depend on where it is.
    pub eye: DVec3,
    /// Rotation from view to world space.
    pub orientation: DQuat,
    /// How it projects.
    pub projection: Projection,
    /// Pixels.
    pub viewport: UVec2,
}

impl View {
    /// A perspective camera at `eye` that looks at `target`, with Y up as far as that goes.
    pub fn look_at(eye: DVec3, target: DVec3, fov_y: f64, near: f64, viewport: UVec2) -> Self {
        let forward = (target - eye).try_normalize().unwrap_or(DVec3::NEG_Z);
        let up = if forward.y.abs() > 1.0 - 1e-9 {
            DVec3::NEG_Z
        } else {
            DVec3::Y
        };
        let right = forward.cross(up).normalize();
        let orientation = DQuat::from_mat3(&DMat3::from_cols(right, right.cross(forward), -forward));
        Self {
            eye,
            orientation,
            projection: Projection::Perspective { fov_y, near },
            viewport,
        }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.viewport.x.max(1)) / f64::from(self.viewport.y.max(1))
    }

    /// Pixels that a world unit covers at distance 1 (perspective), or anywhere (orthographic).
    pub fn pixels_per_unit(&self) -> f64 {
        let height = f64::from(self.viewport.y.max(1));
        match self.projection {
            Projection::Perspective { fov_y, .. } => height / (2.0 * (fov_y / 2.0).tan()),
            Projection::Orthographic { height: units, .. } => height / units,
        }
    }

    /// How far, in world units, the eye may go from the origin of the GPU's coordinates before f32 would be seen: at the near plane
    /// a step of f32 is then at most 2^-10 of the distance, and it is 2^-24 of it where the eye usually looks.
    pub(crate) fn origin_cell(&self) -> f64 {
        match self.projection {
            Projection::Perspective { near, .. } => near * 16_384.0,
            Projection::Orthographic { height, .. } => height * 1_024.0,
        }
    }

    /// Clip from view space: reversed depth, infinite for perspective.
    pub fn clip_from_view(&self) -> Mat4 {
        let aspect = self.aspect();
        match self.projection {
            Projection::Perspective { fov_y, near } => {
                let y = 1.0 / (fov_y / 2.0).tan();
                Mat4::from_cols(
                    Vec4::new((y / aspect) as f32, 0.0, 0.0, 0.0),
                    Vec4::new(0.0, y as f32, 0.0, 0.0),
                    Vec4::new(0.0, 0.0, 0.0, -1.0),
                    Vec4::new(0.0, 0.0, near as f32, 0.0),
                )
            }
            Projection::Orthographic { height, near, far } => {
                let (half_y, half_x) = (height / 2.0, height / 2.0 * aspect);
                let depth = far - near;
                Mat4::from_cols(
                    Vec4::new((1.0 / half_x) as f32, 0.0, 0.0, 0.0),
                    Vec4::new(0.0, (1.0 / half_y) as f32, 0.0, 0.0),
                    Vec4::new(0.0, 0.0, (1.0 / depth) as f32, 0.0),
                    Vec4::new(0.0, 0.0, (far / depth) as f32, 1.0),
                )
            }
        }
    }

    /// The planes of the view volume in view space, normals inwards, unit length; widened sideways by `band` of the half width.
    fn planes(&self, band: f64) -> [(DVec3, f64); 6] {
        let everywhere = (DVec3::ZERO, 1.0);
        match self.projection {
            Projection::Perspective { fov_y, near } => {
                let y = (fov_y / 2.0).tan() * (1.0 + band);
                let x = y * self.aspect();
                [
                    (DVec3::new(1.0, 0.0, -x).normalize(), 0.0),
                    (DVec3::new(-1.0, 0.0, -x).normalize(), 0.0),
                    (DVec3::new(0.0, 1.0, -y).normalize(), 0.0),
                    (DVec3::new(0.0, -1.0, -y).normalize(), 0.0),
                    (DVec3::NEG_Z, if band == 0.0 { -near } else { 0.0 }),
                    everywhere,
                ]
            }
            Projection::Orthographic { height, near, far } => {
                let y = height / 2.0 * (1.0 + band);
                let x = y * self.aspect();
                [
                    (DVec3::X, x),
                    (DVec3::NEG_X, x),
                    (DVec3::Y, y),
                    (DVec3::NEG_Y, y),
                    (DVec3::NEG_Z, -near),
                    (DVec3::Z, far),
                ]
            }
        }
    }
}

/// The uniform of `shaders/shared/frame.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Frame {
    /// Projection.
    pub clip_from_view: Mat4,
    /// Rotation and scale.
    pub view_from_object: Mat4,
    /// Rotation and scale.
    pub world_from_object: Mat4,
    /// For normals.
    pub normal_from_object: Mat4,
    /// Object space, relative to the origin.
    pub eye: Vec3,
    /// World units.
    pub near: f32,
    /// Culling planes, then guard planes.
    pub planes: [Vec4; 12],
    /// Metric over threshold of size 1 at distance 1.
    pub wish_scale: f32,
    /// Of the wish outside the guard band.
    pub guard_factor: f32,
    /// 1 where the distance does not count: orthographic views, metrics without one; else 0.
    pub without_distance: u32,
    /// Level limit.
    pub max_level: u32,
    /// Slots.
    pub capacity: u32,
    /// Entries - 1.
    pub table_mask: u32,
    /// 0: none.
    pub target_leaves: u32,
    /// k.
    pub base_grid: u32,
    /// Another number for another view; the quadtree counts.
    pub view_serial: u32,
    /// For metrics that have one.
    pub metric_parameter: f32,
    /// Where, in the array of parents, what is known of pairs begins.
    pub pairs: u32,
    /// As `eye`: from where the leaves were refined.
    pub refined_eye: Vec3,
    /// Wish of a node that is as large as it is far away.
    pub wish_when_near: f32,
    /// How far vertices may be from the surface, in object units: this times the world distance over `wish_scale`.
    pub morph_slack: f32,
    /// Sixteenths of an octave by which the threshold is raised. The device's own: it is copied there after each update of a quadtree
    /// whose vertices morph, and never written otherwise.
    pub pressure: i32,
}

impl Frame {
    /// Byte at which the pressure is; nothing follows it.
    pub fn pressure_offset() -> u64 {
        Self::METADATA.last_offset()
    }
}

impl View {
    /// What says where the vertices of a morphing quadtree are drawn, in f64: of an object placed by `world_from_object`, while
    /// [`threshold_factor`](crate::Statistics::threshold_factor) is 1.
    pub fn geomorph(&self, world_from_object: &DAffine3, settings: &Settings) -> Geomorph {
        let linear = world_from_object.matrix3;
        let near = match self.projection {
            Projection::Perspective { near, .. } => Some(near),
            Projection::Orthographic { .. } => None,
        };
        Geomorph {
            size: settings.metric.size(settings.base_grid),
            base_grid: settings.base_grid,
            pairs_as_wished: settings.pairs == Pairs::Wished,
            wish_scale: wish_scale(self, linear, settings),
            wish_when_near: wish_when_near(self, settings),
            eye: world_from_object.inverse().transform_point3(self.eye),
            world_from_object: linear,
            near,
        }
    }
}

impl Frame {
    /// What `view` asks of a quadtree of an object placed by `world_from_object`, whose surface tables are relative to `origin`.
    pub fn new(view: &View, world_from_object: &DAffine3, origin: DVec3, settings: &Settings) -> Self {
        Self::seen_from(view, view, world_from_object, origin, settings)
    }

    /// The same where the leaves were refined for another view than they are seen from.
    pub fn seen_from(
        view: &View,
        refined: &View,
        world_from_object: &DAffine3,
        origin: DVec3,
        settings: &Settings,
    ) -> Self {
        let linear = world_from_object.matrix3;
        let view_from_world = DMat3::from_quat(view.orientation).transpose();
        let view_from_object = view_from_world * linear;
        let [eye, refined_eye] =
            [view, refined].map(|view| world_from_object.inverse().transform_point3(view.eye) - origin);
        let normal = linear.inverse().transpose() * linear.determinant().signum();

        // A plane n.p + d >= 0 of view space is (M^T n).p + d >= 0 in object space.
        let to_object = |(n, d): (DVec3, f64)| {
            let n = view_from_object.transpose() * n;
            let length = n.length();
            if length > 0.0 {
                (n / length).extend(d / length).as_vec4()
            } else {
                Vec4::W
            }
        };
        let mut planes = [Vec4::W; 12];
        if settings.cull {
            planes[..6].copy_from_slice(&view.planes(0.0).map(to_object));
        }
        if settings.guard_factor < 1.0 {
            planes[6..].copy_from_slice(&view.planes(settings.guard_band.max(1e-6).into()).map(to_object));
        }

        let (near, orthographic) = match view.projection {
            Projection::Perspective { near, .. } => (near, false),
            Projection::Orthographic { .. } => (1.0, true),
        };
        let is_absolute = matches!(settings.metric.scale(settings.base_grid), Scale::Absolute(_));
        Self {
            clip_from_view: view.clip_from_view(),
            view_from_object: Mat4::from_mat3(view_from_object.as_mat3()),
            world_from_object: Mat4::from_mat3(linear.as_mat3()),
            normal_from_object: Mat4::from_mat3(normal.as_mat3()),
            eye: eye.as_vec3(),
            near: near as f32,
            planes,
            wish_scale: wish_scale(refined, linear, settings) as f32,
            guard_factor: settings.guard_factor,
            without_distance: (orthographic || is_absolute).into(),
            max_level: settings.max_level.min(MAX_LEVEL - settings.base_grid),
            capacity: settings.capacity,
            table_mask: crate::layout::table_entries(settings.capacity) - 1,
            target_leaves: settings.target_leaves,
            base_grid: settings.base_grid,
            view_serial: 0,
            metric_parameter: settings.metric.parameter(),
            pairs: settings.capacity * crate::layout::pairs_follow(settings.drawn_faces()),
            refined_eye: refined_eye.as_vec3(),
            wish_when_near: wish_when_near(refined, settings) as f32,
            morph_slack: match settings.morph {
                Morph::None => 0.0,
                // While it is on its way, the wish is below 2, and an edge shorter than twice the size.
                Morph::Geomorph if settings.pairs == Pairs::Forced => 4.0 / (1u32 << settings.base_grid) as f32,
                // The vertices that pairs leave out start later by the root of two.
                Morph::Geomorph => 6.0 / (1u32 << settings.base_grid) as f32,
            },
            pressure: 0,
        }
    }
}

/// Metric over threshold of an object-space size of 1 at a world distance of 1.
fn wish_scale(view: &View, linear: DMat3, settings: &Settings) -> f64 {
    match settings.metric.scale(settings.base_grid) {
        Scale::Pixels(pixels) => largest_stretch(linear) * view.pixels_per_unit() / pixels,
        Scale::Absolute(threshold) => 1.0 / threshold,
        Scale::Factor(factor) => {
            let half_height = match view.projection {
                Projection::Perspective { fov_y, .. } => (fov_y / 2.0).tan(),
                Projection::Orthographic { height, .. } => height / 2.0,
            };
            factor / half_height
        }
    }
}

/// The wish of a node that is as large as it is far away; 1 where the size is no length. Without a distance no node is near.
fn wish_when_near(view: &View, settings: &Settings) -> f64 {
    match (view.projection, settings.metric.scale(settings.base_grid)) {
        (Projection::Orthographic { .. }, _) => 1e30,
        (_, Scale::Pixels(pixels)) => view.pixels_per_unit() / pixels,
        (_, Scale::Absolute(_) | Scale::Factor(_)) => 1.0, // no metric by which vertices morph
    }
}

/// The largest singular value of a matrix: by how much it stretches at most. Power iteration on M^T M; exact for similarities.
fn largest_stretch(m: DMat3) -> f64 {
    let square = m.transpose() * m;
    let mut v = DVec3::new(0.577, 0.578, 0.576);
    for _ in 0..64 {
        v = (square * v).try_normalize().unwrap_or(DVec3::X);
    }
    (square * v).length().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::look_at(DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO, 1.0, 0.1, UVec2::new(640, 480))
    }

    #[test]
    fn look_at_puts_the_target_on_the_axis() {
        let v = view();
        let seen = v.orientation.inverse() * (DVec3::ZERO - v.eye);
        assert!(seen.truncate().length() < 1e-12 && seen.z < 0.0);
        assert!((v.orientation * DVec3::Y).y > 0.0);
    }

    #[test]
    fn planes_in_object_space_agree_with_the_projection() {
        let v = view();
        let object = DAffine3::from_scale_rotation_translation(
            DVec3::new(1.0, 2.0, 0.5),
            DQuat::from_rotation_x(0.7),
            DVec3::new(0.3, -1.0, 2.0),
        );
        let origin = DVec3::new(0.1, 0.2, 0.3);
        let frame = Frame::new(&v, &object, origin, &Settings::default());
        let mut inside_seen = 0;
        for i in 0..4000u32 {
            let r = |k: u32| {
                let mixed = (3 * i + k).wrapping_mul(2_654_435_761);
                let mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x85eb_ca6b);
                f64::from(mixed >> 8) / f64::from(1u32 << 24) * 16.0 - 8.0
            };
            let p = DVec3::new(r(1), r(2), r(3));
            let relative = p.as_vec3() - frame.eye;
            let seen = frame.view_from_object * relative.extend(0.0);
            let clip = frame.clip_from_view * seen.truncate().extend(1.0);
            let in_clip = clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && clip.z <= clip.w && clip.w > 0.0;
            let least = frame.planes[..6]
                .iter()
                .map(|q| q.truncate().dot(relative) + q.w)
                .fold(f32::INFINITY, f32::min);
            if least.abs() > 1e-4 {
                assert_eq!(in_clip, least > 0.0, "{p} {least}");
                inside_seen += u32::from(in_clip);
            }
        }
        assert!(inside_seen > 100);
    }

    #[test]
    fn stretch_of_a_scaled_rotation() {
        let m = DMat3::from_quat(DQuat::from_rotation_y(0.3)) * DMat3::from_diagonal(DVec3::new(2.0, 3.0, 1.0));
        assert!((largest_stretch(m) - 3.0).abs() < 1e-9);
    }
}
