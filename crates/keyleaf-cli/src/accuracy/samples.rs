//! Points of a surface, and how far the GPU is from the exact surface there.

use super::studio::Setup;
use glam::DAffine3;
use keyleaf::inspect::Inspector;
use keyleaf::key::{ONE, RootPoint, Topology};
use keyleaf::surface::Surface;
use keyleaf::{Quadtree, Settings};
use keyleaf_stage::{Deviations, Difference, Pipelines, difference};
use std::sync::Arc;

/// Point i of Roberts' sequence, which is even over a root; roots in turn.
pub fn even(topology: &Topology, i: u32) -> RootPoint {
    let fraction = |step: f64| (f64::from(i) * step).fract();
    let (a, b) = (fraction(0.754_877_666_246_693), fraction(0.569_840_290_998_053));
    let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
    let [x, y] = [a, b].map(|part| (part * f64::from(ONE)) as u32);
    let (face, root) = root_of(topology, i);
    RootPoint { face, root, x, y }
}

/// A point near the corner at the start of a root, which are taken in turn: in four steps towards it half as far each.
pub fn near_corner(topology: &Topology, i: u32) -> RootPoint {
    let RootPoint { face, root, x, y } = even(topology, i);
    let steps = 1 + i / topology.half_edge_count().max(1) % 8;
    let [x, y] = [(ONE - x) >> steps, y >> steps];
    let x = ONE - x;
    RootPoint {
        face,
        root,
        x,
        y: y.min(ONE - x),
    }
}

fn root_of(topology: &Topology, i: u32) -> (u32, u32) {
    let number = i % topology.half_edge_count().max(1);
    // The last face that starts at or before it.
    let (mut face, mut beyond) = (0, topology.face_count());
    while face + 1 < beyond {
        let middle = face.midpoint(beyond);
        if topology.first_half_edge(middle) <= number {
            face = middle;
        } else {
            beyond = middle;
        }
    }
    (face, number - topology.first_half_edge(face))
}

/// How far the GPU is from `exact` at these points, when it evaluates `drawn`. Both have the same faces.
pub fn differences(
    setup: &Setup<'_>,
    drawn: &Arc<dyn Surface>,
    exact: &dyn Surface,
    at: &[RootPoint],
    pipelines: &mut Pipelines,
) -> anyhow::Result<Vec<Difference>> {
    let gpu = setup.gpu;
    let settings = Settings {
        capacity: drawn.topology().half_edge_count(),
        ..Settings::default()
    };
    let kind = Quadtree::kind(drawn.as_ref(), &settings);
    let passes = pipelines.passes(&gpu.device, kind)?;
    let inspector = Inspector::new(&gpu.device, &kind)?;
    let quadtree = Quadtree::new(
        &gpu.device,
        &gpu.queue,
        passes,
        Arc::clone(drawn),
        DAffine3::IDENTITY,
        settings,
    )?;
    let frames = inspector.evaluate(&gpu.device, &gpu.queue, &quadtree, at)?;
    let of = |(at, frame): (&RootPoint, &keyleaf::inspect::GpuFrame)| {
        let position = frame.position.as_dvec3() + quadtree.origin();
        difference(exact, *at, position, frame.normal.as_dvec3())
    };
    Ok(at.iter().zip(&frames).map(of).collect())
}

/// Points taken evenly, and as many towards the corners of faces.
const SAMPLES: u32 = 2000;

/// How far what the GPU draws is from the limit.
pub struct Accuracy {
    /// Distances over the diagonal: the largest of all points, the root mean square of those that are even.
    pub position: Deviations,
    /// Angles of the normals in degrees, likewise.
    pub normal: Deviations,
}

impl Accuracy {
    /// Of a surface that the GPU draws, against another one.
    pub fn of(
        setup: &Setup<'_>,
        drawn: &Arc<dyn Surface>,
        exact: &dyn Surface,
        pipelines: &mut Pipelines,
    ) -> anyhow::Result<Self> {
        let topology = exact.topology();
        let mut at: Vec<RootPoint> = (0..SAMPLES).map(|i| even(topology, i)).collect();
        at.extend((0..SAMPLES).map(|i| near_corner(topology, i)));
        let found = differences(setup, drawn, exact, &at, pipelines)?;
        let (low, high) = exact.bounding_box();
        let diagonal = (high - low).length().max(f64::MIN_POSITIVE);
        let over = |value: fn(&Difference) -> f64, unit: f64| {
            let all = Deviations::of(found.iter().map(value));
            let even = Deviations::of(found[..SAMPLES as usize].iter().map(value));
            Deviations {
                largest: all.largest,
                rms: even.rms,
            }
            .scaled(1.0 / unit)
        };
        Ok(Self {
            position: over(|found| found.distance, diagonal),
            normal: over(|found| found.angle, 1f64.to_radians()),
        })
    }
}
