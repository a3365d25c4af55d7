//! A cone of all normals that a KSQuad and its triangles can have, for back-patch culling that loses nothing.
//!
//! The edge of a triangle along u is a mean of S_u times its length, and a right triangle with legs along u and v has a normal that is a
//! mean of S_u times a mean of S_v, as the surface has. With the hypotenuse along u and U', U" the means of S_u over its halves, the
//! normal of a triangle with its apex above the middle is that of U × V − U' × U" / 2: what the hypotenuse bends is taken as an error.
//! All means are over the part of the KSQuad that holds the triangle, so that the cone holds for triangles no larger than a part.

use super::bezier_net::BezierNet;
use super::evaluation::KsQuad;
use glam::DVec3;

/// A KSQuad is bounded in parts, at most 4^this of them: the tangents of a part differ less.
const DEPTH: u32 = 3;
/// The same where weights differ: what they add to the tangents falls by half with each.
const DEPTH_OF_WEIGHTS: u32 = 4;
/// Cosine of the angle of a cone that more parts need not make narrower.
const NARROW: f64 = 0.8;
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
    /// Of triangles with hypotenuses of at most one over two to this of the edge of the KSQuad.
    pub depth: u32,
}

/// What bounds du × dv over a part, up to a positive factor: means of these vectors, but for one no longer than `error`.
struct Normals {
    crosses: Vec<DVec3>,
    error: f64,
}

impl Normals {
    /// Over all pairs of control points of both derivatives: a mean of one times a mean of the other is a mean of the products.
    fn of(part: &BezierNet) -> Self {
        let [(us, u_error), (vs, v_error)] = part.tangents();
        let longest = |vectors: &[DVec3]| vectors.iter().map(|v| v.length()).fold(0.0, f64::max);
        let (u_length, v_length) = (longest(&us), longest(&vs));
        // Between the means over both halves of a hypotenuse S_u changes by no more than half of S_uu.
        let bounds = part.bounds(1.0);
        let [uu, _, vv] = bounds.second;
        let [_, greatest] = part.weights();
        let of_triangles = (bounds.first[0] * uu).max(bounds.first[1] * vv) / 4.0 * greatest * greatest;
        let error = u_length * v_error + v_length * u_error + u_error * v_error + of_triangles;
        // What is parallel adds nothing, but may shorten a mean: that matters where there is an error.
        let counts = |n: &DVec3| error > 0.0 || n.length() > PARALLEL * u_length * v_length;
        let cross = |u: &DVec3| vs.iter().map(|v| u.cross(*v)).collect::<Vec<_>>();
        Self {
            crosses: us.iter().flat_map(cross).filter(counts).collect(),
            error,
        }
    }

    /// The greatest angle between a normal and the axis; none if it may be a right angle or more.
    fn angle_from(&self, axis: DVec3) -> Option<f64> {
        let turn = if self.error > 0.0 {
            // A mean is at least as long as what all have along their own axis.
            let own = self.crosses.iter().sum::<DVec3>().try_normalize()?;
            let along = |n: &DVec3| n.dot(own);
            let least = self.crosses.iter().map(along).fold(f64::INFINITY, f64::min);
            if least <= self.error {
                return None;
            }
            (self.error / least).asin()
        } else {
            0.0
        };
        let cosines = self.crosses.iter().filter_map(|n| Some(n.try_normalize()?.dot(axis)));
        let angle = cosines.fold(1.0, f64::min).acos() + turn;
        (angle < std::f64::consts::FRAC_PI_2).then_some(angle)
    }
}

impl NormalCone {
    /// Of a KSQuad; none where its normals may differ by a right angle from their mean, or weights vanish.
    pub fn of(quad: &KsQuad<'_>) -> Option<Self> {
        let net = BezierNet::of(quad);
        let [least, greatest] = net.weights();
        if least <= 0.0 {
            return None;
        }
        let deepest = if greatest > least { DEPTH_OF_WEIGHTS } else { DEPTH };
        let mut parts = vec![net];
        let mut depth = 0;
        loop {
            let found = Self::of_parts(&parts, depth);
            if depth == deepest || found.is_some_and(|cone| cone.cosine >= NARROW) {
                return found;
            }
            parts = parts.into_iter().flat_map(|part| part.parts(1)).collect();
            depth += 1;
        }
    }

    fn of_parts(parts: &[BezierNet], depth: u32) -> Option<Self> {
        let parts: Vec<Normals> = parts.iter().map(Normals::of).collect();
        let directions = parts
            .iter()
            .flat_map(|part| &part.crosses)
            .filter_map(|n| n.try_normalize());
        let axis = directions.sum::<DVec3>().try_normalize()?;
        let angles: Option<Vec<f64>> = parts.iter().map(|part| part.angle_from(axis)).collect();
        let angle = angles?.into_iter().fold(0.0, f64::max) + ROUNDING;
        let (sine, cosine) = angle.sin_cos();
        (cosine > ROUNDING).then_some(Self {
            axis,
            cosine,
            sine,
            depth,
        })
    }
}
