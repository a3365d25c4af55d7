//! Unit normals that are never zero. Twin of `shaders/shared/direction.wgsl`.

use glam::DVec3;

/// Below this sine the rounding of f32 operands decides the direction of their cross product. As in the WGSL.
pub const PARALLEL: f64 = 1e-6;

/// The direction of a × b, none where they are parallel or zero. Lengths do not matter: both are scaled first.
pub fn cross_direction(a: DVec3, b: DVec3) -> Option<DVec3> {
    let cross = scaled(a).cross(scaled(b));
    (cross.abs().max_element() > PARALLEL).then(|| scaled(cross).normalize())
}

/// The vector over its largest component; zero stays zero.
pub fn scaled(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 1e-300 { v / largest } else { DVec3::ZERO }
}

/// The normal of a surface with these derivatives. Where du × dv vanishes: its limit from the side that the mixed derivative
/// names, then `fallback`, a unit vector.
pub fn frame_normal(du: DVec3, dv: DVec3, duv: DVec3, fallback: DVec3) -> DVec3 {
    if let Some(normal) = cross_direction(du, dv) {
        return normal;
    }
    match cross_direction(duv, dv).or_else(|| cross_direction(du, duv)) {
        Some(normal) if normal.dot(fallback) < 0.0 => -normal,
        Some(normal) => normal,
        None => fallback,
    }
}

/// The next f32 above: for bounds that must not round down.
pub fn round_up(bound: f64) -> f32 {
    let nearest = bound as f32;
    if f64::from(nearest) < bound {
        nearest.next_up()
    } else {
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_tiny_huge_and_vanishing_derivatives_have_unit_length() {
        let vectors = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::Y * 1e-200,
            DVec3::new(1.0, 1e-3, 0.0) * 1e200,
            DVec3::X * -3.0,
        ];
        for du in vectors {
            for dv in vectors {
                for duv in vectors {
                    assert!((frame_normal(du, dv, duv, DVec3::Z).length() - 1.0).abs() < 1e-12);
                }
            }
        }
        assert_eq!(
            frame_normal(DVec3::X * 1e-18, DVec3::Y * 1e18, DVec3::ZERO, DVec3::X),
            DVec3::Z
        );
    }
}
