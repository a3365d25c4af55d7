//! Three numbers a root that bound all its diamonds.

use crate::{SurfaceBound, diamond};
use glam::DVec3;
use keyleaf_key::{MAX_LEVEL, Place, Topology};

/// Bounds of a root, for both roots of a mesh edge alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootBound {
    /// Times 2^−level: half the hypotenuse and the median.
    pub size: f64,
    /// Times 2^−level: the surface over the diamond about the middle of the hypotenuse.
    pub ball: f64,
    /// Times 4^−level: the distance between the surface and flat triangles as large as the node.
    pub deviation: f64,
}

impl RootBound {
    /// The larger of each.
    pub fn max(self, other: Self) -> Self {
        Self {
            size: self.size.max(other.size),
            ball: self.ball.max(other.ball),
            deviation: self.deviation.max(other.deviation),
        }
    }

    /// Of a leaf whose diamond has its centre there, where points of mesh edges may be off by `error` from what the root's own face says.
    pub fn of_leaf(&self, leaf: &Place, centre: DVec3, error: f64) -> SurfaceBound {
        let ball = self.ball * diamond::ball_scale(leaf.level);
        let scale = diamond::level_scale(leaf.level);
        SurfaceBound {
            centre,
            radius: ball + error,
            size: self.size * scale,
            // Centres may be off as well, at every level.
            guard: 2.0 * ball + 2.0 * error * f64::from(MAX_LEVEL + 2 - leaf.level),
            deviation: self.deviation * scale * scale,
            // Both are of sums of all second derivatives, and half a triangle is half as wide in every direction.
            pair_deviation: self.deviation * scale * scale / 4.0,
        }
    }

    /// Of all roots from what each says alone, by half-edge: the larger of both roots of a mesh edge.
    pub fn of_both_sides(topology: &Topology, own: Vec<Self>) -> Vec<Self> {
        let roots = topology.roots().zip(&own);
        roots
            .map(|(root, &bound)| match topology.twin(root.face, root.root) {
                Some(twin) => bound.max(own[topology.half_edge_index(twin.face, twin.root) as usize]),
                None => bound,
            })
            .collect()
    }
}
