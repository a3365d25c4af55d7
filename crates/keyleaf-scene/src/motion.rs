//! Posing a control mesh: where its vertices are at a time, and how their covariances are turned.
//!
//! Rest positions are blended towards the targets of blend shapes, then moved by the groups (linear blend skinning with equal weights):
//! a vertex of n groups goes to the mean of the n places where they move it, its covariance Σ becomes A Σ Aᵀ with the mean A of their
//! linear parts. All in f64.

use std::path::PathBuf;

use glam::{DAffine3, DMat3, DQuat, DVec3, EulerRot};

use crate::curve::{Curve, Key};
use crate::scene::{BlendTrack, GroupTrack, Track, TransformKey};

/// Numbers of a transform's key: translation, rotation in degrees, logarithm of the scale.
const CHANNELS: usize = 7;

/// A control mesh with the tracks that move it.
#[derive(Debug, Clone)]
pub struct CageMotion {
    rest: Vec<DVec3>,
    blends: Vec<Blend>,
    groups: Vec<Group>,
    /// The files of the blend shapes.
    pub(crate) files: Vec<PathBuf>,
}

#[derive(Debug, Clone)]
struct Blend {
    /// From rest to the target.
    offsets: Vec<DVec3>,
    weight: Curve<1>,
}

#[derive(Debug, Clone)]
struct Group {
    /// A group before this one.
    parent: Option<usize>,
    vertices: Vec<u32>,
    pivot: DVec3,
    transform: Curve<CHANNELS>,
}

/// What of a track does not fit the mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A group has vertices that are not there.
    #[error("group '{group}' has the vertices {first} to {last}, counted from 0; the mesh has {count}")]
    Vertices {
        /// Its name.
        group: String,
        /// First of the range.
        first: u32,
        /// Last of the range.
        last: u32,
        /// Vertices of the mesh.
        count: usize,
    },
    /// A group hangs on one that is not before it.
    #[error("group '{group}' has the parent '{parent}', which is not before it")]
    Parent {
        /// Its name.
        group: String,
        /// The name of the parent.
        parent: String,
    },
    /// A blend shape has other vertices.
    #[error("the blend shape has {found} vertices, the mesh has {count}; expected the same ones")]
    Target {
        /// Vertices of the shape.
        found: usize,
        /// Vertices of the mesh.
        count: usize,
    },
}

impl CageMotion {
    /// A mesh that nothing moves yet.
    pub fn new(rest: Vec<DVec3>) -> Self {
        Self {
            rest,
            blends: Vec::new(),
            groups: Vec::new(),
            files: Vec::new(),
        }
    }

    /// Adds the groups of a motion, in their order.
    ///
    /// # Errors
    /// [`MotionError`] names the group.
    pub fn add_groups<'a>(&mut self, tracks: impl IntoIterator<Item = &'a Track>) -> Result<(), MotionError> {
        let mut names: Vec<&str> = Vec::new();
        for track in tracks {
            let Track::Group(track) = track else { continue };
            let parent = match &track.parent {
                None => None,
                Some(parent) => Some(names.iter().position(|name| name == parent).ok_or_else(|| {
                    let (group, parent) = (track.name.clone(), parent.clone());
                    MotionError::Parent { group, parent }
                })?),
            };
            let group = Group {
                parent,
                vertices: vertices(track, self.rest.len())?,
                pivot: track.pivot.into(),
                transform: Curve::new(track.keys.iter().map(key).collect(), track.looped),
            };
            names.push(&track.name);
            self.groups.push(group);
        }
        Ok(())
    }

    /// Adds a blend shape with the positions of its file.
    ///
    /// # Errors
    /// [`MotionError::Target`] if it has other vertices than the mesh.
    pub fn add_blend(&mut self, track: &BlendTrack, target: &[DVec3]) -> Result<(), MotionError> {
        if target.len() != self.rest.len() {
            let (found, count) = (target.len(), self.rest.len());
            return Err(MotionError::Target { found, count });
        }
        let keys = track.keys.iter().map(|key| Key {
            time: key.time,
            value: [key.weight],
            ease: key.ease,
        });
        self.blends.push(Blend {
            offsets: target.iter().zip(&self.rest).map(|(&to, &from)| to - from).collect(),
            weight: Curve::new(keys.collect(), track.looped),
        });
        Ok(())
    }

    /// Seconds until the last key of all tracks.
    pub fn duration(&self) -> f64 {
        let blends = self.blends.iter().map(|blend| blend.weight.end());
        let groups = self.groups.iter().map(|group| group.transform.end());
        blends.chain(groups).fold(0.0, f64::max)
    }

    /// Where each vertex is at a time in seconds, object space. O(vertices and tracks).
    pub fn pose(&self, time: f64) -> Vec<DVec3> {
        let mut positions = self.rest.clone();
        for blend in &self.blends {
            let [weight] = blend.weight.at(time).unwrap_or([0.0]);
            for (position, &offset) in positions.iter_mut().zip(&blend.offsets) {
                *position += weight * offset;
            }
        }
        let transforms = self.transforms(time);
        let mut moved = vec![(DVec3::ZERO, 0u32); positions.len()];
        for (group, transform) in self.groups.iter().zip(&transforms) {
            for &vertex in &group.vertices {
                let (sum, count) = &mut moved[vertex as usize];
                *sum += transform.transform_point3(positions[vertex as usize]);
                *count += 1;
            }
        }
        for (position, (sum, count)) in positions.iter_mut().zip(moved) {
            if count > 0 {
                *position = sum / f64::from(count);
            }
        }
        positions
    }

    /// The covariances (xx, xy, xz, yy, yz, zz) of the vertices at a time, from those at rest, one a vertex. O(vertices and groups).
    pub fn pose_covariances(&self, time: f64, rest: &[[f64; 6]]) -> Vec<[f64; 6]> {
        let transforms = self.transforms(time);
        let mut linear = vec![(DMat3::ZERO, 0u32); rest.len()];
        for (group, transform) in self.groups.iter().zip(&transforms) {
            for &vertex in &group.vertices {
                if let Some((sum, count)) = linear.get_mut(vertex as usize) {
                    *sum += transform.matrix3;
                    *count += 1;
                }
            }
        }
        let posed = |(&covariance, (sum, count)): (&[f64; 6], (DMat3, u32))| match count {
            0 => covariance,
            _ => transformed(covariance, sum * (1.0 / f64::from(count))),
        };
        rest.iter().zip(linear).map(posed).collect()
    }

    /// Object space at rest to object space, of every group.
    fn transforms(&self, time: f64) -> Vec<DAffine3> {
        let mut transforms: Vec<DAffine3> = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            let own = group.transform.at(time).map_or(DAffine3::IDENTITY, |channels| {
                let [x, y, z, turn_x, turn_y, turn_z, scale] = channels;
                let [turn_x, turn_y, turn_z] = [turn_x, turn_y, turn_z].map(f64::to_radians);
                let rotation = DQuat::from_euler(EulerRot::ZYX, turn_z, turn_y, turn_x);
                let linear = DMat3::from_quat(rotation) * scale.exp();
                let translation = DVec3::new(x, y, z) + group.pivot - linear * group.pivot;
                DAffine3 {
                    matrix3: linear,
                    translation,
                }
            });
            let parent = group.parent.map_or(DAffine3::IDENTITY, |parent| transforms[parent]);
            transforms.push(parent * own);
        }
        transforms
    }
}

/// A Σ Aᵀ.
fn transformed([xx, xy, xz, yy, yz, zz]: [f64; 6], linear: DMat3) -> [f64; 6] {
    let matrix = DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz));
    let turned = linear * matrix * linear.transpose();
    let [x, y, z] = [turned.x_axis, turned.y_axis, turned.z_axis];
    [x.x, (x.y + y.x) / 2.0, (x.z + z.x) / 2.0, y.y, (y.z + z.y) / 2.0, z.z]
}

/// The scale is interpolated by its logarithm, so that it stays above 0.
fn key(key: &TransformKey) -> Key<CHANNELS> {
    let ([x, y, z], [turn_x, turn_y, turn_z]) = (key.translation, key.rotation);
    Key {
        time: key.time,
        value: [x, y, z, turn_x, turn_y, turn_z, key.scale.ln()],
        ease: key.ease,
    }
}

/// The vertices of a group, each once.
fn vertices(track: &GroupTrack, count: usize) -> Result<Vec<u32>, MotionError> {
    for &(first, last) in &track.vertices {
        if last as usize >= count {
            let group = track.name.clone();
            return Err(MotionError::Vertices {
                group,
                first,
                last,
                count,
            });
        }
    }
    let mut all: Vec<u32> = track.vertices.iter().flat_map(|&(first, last)| first..=last).collect();
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

#[cfg(test)]
#[path = "motion_tests.rs"]
mod tests;
