//! The diamond of a leaf: the leaf and the node across its hypotenuse. Twin of `shaders/shared/diamond.wgsl`.

use keyleaf_key::{MAX_LEVEL, ONE, Place, RootPoint};

/// The middle of the hypotenuse; at level 31, where it is no multiple of 2⁻³¹, that of the parent, which is the end of this
/// hypotenuse with odd coordinates.
pub fn centre(leaf: &Place) -> RootPoint {
    let half = leaf.unit() / 2;
    let right = leaf.at(1, 0);
    match half {
        0 if right.x & 1 == 1 => right,
        0 => leaf.at(0, 1),
        _ => leaf.at(half, half),
    }
}

/// 2^−level.
pub fn level_scale(level: u32) -> f64 {
    f64::from(ONE >> level.min(MAX_LEVEL)) / f64::from(ONE)
}

/// The same for what surrounds [`centre`], which at level 31 is the parent's.
pub fn ball_scale(level: u32) -> f64 {
    level_scale(level.min(MAX_LEVEL - 1))
}

/// Whether a corner of the diamond lies on the mesh edge of its root.
pub fn touches_edge(leaf: &Place) -> bool {
    let [origin, right, up] = leaf.corners().map(|corner| u64::from(corner.x) + u64::from(corner.y));
    let edge = u64::from(ONE);
    right == edge || up == edge || origin == edge || right + up - origin == edge
}

/// Whether the hypotenuse lies on the mesh edge.
pub fn crosses_edge(leaf: &Place) -> bool {
    leaf.at(leaf.unit(), 0).is_on_mesh_edge() && leaf.at(0, leaf.unit()).is_on_mesh_edge()
}
