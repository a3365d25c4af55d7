//! A cone of all normals that a KSQuad can have, for back-patch culling that loses nothing.

use super::bezier_net::BezierNet;
use super::evaluation::KsQuad;
use glam::DVec3;

/// A KSQuad is bounded in parts, 4^this of them: the tangents of a part differ less.
const DEPTH: u32 = 2;
/// More pairs of tangents than this in a part are not worth their time: the face has no cone.
const MOST_PAIRS: usize = 1 << 16;
/// Below this sine the rounding of the operands decides the direction of their cross product.
const PARALLEL: f64 = 1e-12;
/// What rounding, in f64 here and in f32 where it is used, may turn a normal by, as a sine.
const ROUNDING: f64 = 1e-6;

/// Every normal is within the angle of the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalCone {
    /// A unit vector.
    pub axis: DVec3,
    /// Cosine of the angle, above 0.
    pub cosine: f64,
    /// Sine of the angle.
    pub sine: f64,
}

impl NormalCone {
    /// Of a KSQuad; none where its normals may differ by a right angle and more, or weights vanish.
    ///
    /// A tangent in u is a sum of differences of neighbours in u with weights that are not negative: of control points of one row, or,
    /// where weights differ, of any two rows (the curve at a fixed v has control points in the hulls of the columns). So du × dv is such a
    /// sum of cross products of all pairs.
    pub fn of(quad: &KsQuad<'_>) -> Option<Self> {
        let mut normals = Vec::new();
        for part in BezierNet::of(quad).parts(DEPTH) {
            let [us, vs] = part.tangents()?;
            if us.len() * vs.len() > MOST_PAIRS {
                return None;
            }
            for u in us.iter().filter_map(|u| u.try_normalize()) {
                // Directions only: lengths are weights that are not negative. What is parallel adds nothing.
                let crosses = vs.iter().filter_map(|v| Some(u.cross(v.try_normalize()?)));
                normals.extend(crosses.filter(|n| n.length() > PARALLEL).map(DVec3::normalize));
            }
        }
        let axis = normals.iter().sum::<DVec3>().try_normalize()?;
        let cosine = normals.iter().map(|n| n.dot(axis)).fold(1.0, f64::min);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt() + ROUNDING;
        let cosine = (1.0 - sine * sine).max(0.0).sqrt().min(cosine);
        (cosine > ROUNDING).then_some(Self { axis, cosine, sine })
    }
}
