//! The patches of a surface in dual space, each in a frame of its own.

use super::dual::{Dual, DualFrame, MeanJet, whitening};
use super::lanes::{CONTROLS, Lanes};
use super::patch::{DualSquare, DualTriangle};
use super::symmetric::Symmetric3;
use crate::subdivision::bicubic;
use crate::subdivision::neighbourhoods::{Evaluated, Neighbourhoods};
use glam::{DMat3, DVec3};

/// The control vertices in dual space, about their common centre.
#[derive(Clone, Debug)]
pub struct DualVertices {
    pub centre: DVec3,
    pub values: Vec<Dual>,
}

impl DualVertices {
    pub fn new(means: &[DVec3], precisions: &[Symmetric3]) -> Self {
        let frame = DualFrame {
            centre: means.iter().sum::<DVec3>() / means.len().max(1) as f64,
            axes: DMat3::IDENTITY,
        };
        let vertices = means.iter().zip(precisions);
        Self {
            centre: frame.centre,
            values: vertices
                .map(|(&mean, &precision)| Dual::of_precision(mean, precision, &frame))
                .collect(),
        }
    }
}

/// Where the numbers of a patch are: coordinates, and the factor that all its precisions have in common, which changes nothing.
#[derive(Clone, Copy, Debug)]
pub struct PatchFrame {
    pub frame: DualFrame,
    factor: f64,
}

/// Control points of all patches, in the order of [`Evaluated`].
#[derive(Clone, Debug)]
pub struct DualPatches {
    /// Control points a patch.
    pub size: usize,
    /// One a patch.
    pub frames: Vec<PatchFrame>,
    /// In the frames, one a patch.
    pub nets: Vec<Lanes<CONTROLS>>,
}

impl DualPatches {
    /// No patches, of so many control points.
    pub fn none(size: usize) -> Self {
        Self {
            size,
            frames: Vec::new(),
            nets: Vec::new(),
        }
    }

    /// Of the neighbourhoods of these vertices. And errors at the samples of terminal patches, with their patches, about the centre of the
    /// vertices.
    pub fn new(all: &Neighbourhoods, vertices: &DualVertices) -> (Self, Vec<(u32, Dual)>) {
        let size = all.control_points;
        let values: Vec<[f64; 9]> = vertices.values.iter().map(Dual::to_array).collect();
        let mut patches = Self {
            size,
            frames: Vec::with_capacity(all.entries / size),
            nets: Vec::with_capacity(all.entries / size),
        };
        let mut evaluated = Evaluated::nothing();
        all.evaluate_faces(&values, &mut evaluated, |evaluated| {
            for points in evaluated.points.chunks_exact(size) {
                let net = Lanes::of_differences(points);
                let own = PatchFrame::of(&net, size);
                patches.nets.push(own.net_inside(&net));
                patches.frames.push(own.moved(vertices.centre));
            }
            evaluated.points.clear();
        });
        let errors = evaluated.errors.into_iter();
        let errors = errors.map(|(patch, error)| (patch, Dual::from_array(error)));
        (patches, errors.collect())
    }

    /// The control points of a patch.
    pub fn controls(&self, patch: usize) -> impl Iterator<Item = Dual> + '_ {
        (0..self.size).map(move |k| self.nets[patch].control(k))
    }

    /// The control points at the corners of a patch, counter-clockwise.
    pub fn corners(&self) -> &'static [usize] {
        if self.size == bicubic::CONTROL_POINTS {
            &[0, 3, 15, 12]
        } else {
            &[0, 4, 14]
        }
    }

    /// A patch of a Catmull-Clark surface.
    pub fn square(&self, patch: usize) -> Option<DualSquare> {
        DualSquare::new([3, 3], self.controls(patch).collect())
    }

    /// A patch of a Loop surface.
    pub fn triangle(&self, patch: usize) -> Option<DualTriangle> {
        DualTriangle::new(4, self.controls(patch).collect())
    }

    /// From the coordinates of a patch to object space; where its precision is not positive definite, the middle of the patch.
    pub fn in_object_space(&self, patch: usize, jet: Option<MeanJet>) -> MeanJet {
        let frame = &self.frames[patch].frame;
        let middle = MeanJet {
            mean: frame.centre,
            first: [DVec3::ZERO; 2],
            second: [DVec3::ZERO; 3],
        };
        jet.map_or(middle, |jet| jet.in_object_space(frame))
    }

    /// The mean of a control point, about the middle of the patch.
    pub fn offset(&self, patch: usize, control: usize) -> Option<DVec3> {
        Some(self.frames[patch].frame.axes * self.nets[patch].control(control).mean()?)
    }
}

impl PatchFrame {
    /// The frame in which the mean of these control points has mean 0 and precision 1. The unit is that of the longest axis: so
    /// coordinates are numbers for f32, whatever the covariances are.
    fn of(net: &Lanes<CONTROLS>, size: usize) -> Self {
        let share = 1.0 / size as f64;
        let mean = net.weighted(&std::array::from_fn(|k| if k < size { share } else { 0.0 }));
        if let (Some(centre), Some(axes)) = (mean.mean(), whitening(mean.precision)) {
            let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
            let unit = columns.iter().map(|column| column.length()).fold(0.0, f64::max);
            let axes = axes * (1.0 / unit);
            return Self {
                frame: DualFrame { centre, axes },
                factor: unit * unit,
            };
        }
        let largest = net.traces().into_iter().map(f64::abs).fold(0.0, f64::max);
        Self {
            frame: DualFrame::OBJECT,
            factor: if largest > 0.0 { 1.0 / largest } else { 1.0 },
        }
    }

    fn inside(&self, value: &Dual) -> Dual {
        value.in_frame(&self.frame) * self.factor
    }

    fn net_inside(&self, net: &Lanes<CONTROLS>) -> Lanes<CONTROLS> {
        let mut inside = net.in_frame(&self.frame);
        inside.0.as_flattened_mut().iter_mut().for_each(|x| *x *= self.factor);
        inside
    }

    fn moved(mut self, by: DVec3) -> Self {
        self.frame.centre += by;
        self
    }

    /// A value about a centre in the space of the patch.
    pub fn of_vertices(&self, value: &Dual, centre: DVec3) -> Dual {
        self.moved(-centre).inside(value)
    }
}
