//! From the parameters that users write to the exact points of the roots.

use crate::ParameterError;
use keyleaf_key::{ONE, RootPoint, Topology};

/// The point with parameters (u, v) of a face of a topology; see [`Surface::face_coord`](crate::Surface::face_coord), which takes a user's
/// number of the face: another one where some faces are not drawn.
///
/// # Errors
/// [`ParameterError`] if there is no such face or (u, v) is NaN or outside it.
pub fn root_point(topology: &Topology, face: u32, u: f64, v: f64) -> Result<RootPoint, ParameterError> {
    let faces = topology.face_count();
    if face >= faces {
        return Err(ParameterError::Face { face, faces });
    }
    let corners = topology.corner_count(face);
    let outside = |expected| Err(ParameterError::OutOfDomain { face, u, v, expected });
    let unit = 0.0..=1.0;
    let (root, x, y) = match corners {
        3 if unit.contains(&u) && unit.contains(&v) && u + v <= 1.0 + 1e-12 => triangle(u, v),
        3 => return outside("u >= 0, v >= 0 and u + v <= 1"),
        4 if unit.contains(&u) && unit.contains(&v) => quad(u, v),
        4 => return outside("0 <= u <= 1 and 0 <= v <= 1"),
        n if (0.0..=f64::from(n)).contains(&u) && unit.contains(&v) => fan(n, u, v),
        _ => return outside("0 <= u <= number of corners and 0 <= v <= 1"),
    };
    Ok(RootPoint { face, root, x, y })
}

fn fixed(value: f64) -> u32 {
    (value.clamp(0.0, 1.0) * f64::from(ONE)).round() as u32
}

/// Weights that may have been rounded to a sum just above one.
fn weights(x: f64, y: f64) -> (u32, u32) {
    let x = fixed(x);
    (x, fixed(y).min(ONE - x))
}

/// The root is opposite the corner with the least weight, which is a third of the centre's.
fn triangle(u: f64, v: f64) -> (u32, u32, u32) {
    let corner = [(1.0 - u - v).max(0.0), u, v];
    let opposite = (0..3).min_by(|&a, &b| corner[a].total_cmp(&corner[b])).unwrap_or(2);
    let (root, next) = ((opposite + 1) % 3, (opposite + 2) % 3);
    // Less than the grid resolves: on the side, also where 1 - u - v has rounded.
    if corner[opposite] < 1e-10 {
        let x = fixed(corner[root]);
        return (root as u32, x, ONE - x);
    }
    let (x, y) = weights(corner[root] - corner[opposite], corner[next] - corner[opposite]);
    (root as u32, x, y)
}

/// The root is the one of the nearest edge; in integers, so that a point of a side stays on it.
fn quad(u: f64, v: f64) -> (u32, u32, u32) {
    let (u, v) = (fixed(u), fixed(v));
    let distances = [v, ONE - u, ONE - v, u];
    let root = (0..4).min_by_key(|&root| distances[root]).unwrap_or(0);
    let along = [u, v, ONE - u, ONE - v][root];
    (root as u32, ONE - along - distances[root], along - distances[root])
}

fn fan(corners: u32, u: f64, v: f64) -> (u32, u32, u32) {
    let root = (u.floor() as u32).min(corners - 1);
    let along = u - f64::from(root);
    if v == 0.0 {
        let y = fixed(along);
        return (root, ONE - y, y);
    }
    let (x, y) = weights((1.0 - along) * (1.0 - v), along * (1.0 - v));
    (root, x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quad_coord::QuadCoord;

    fn mixed() -> Topology {
        Topology::new(8, [vec![0, 1, 2], vec![2, 1, 3, 4], vec![4, 3, 5, 6, 7]]).unwrap()
    }

    #[test]
    fn quad_parameters_come_back_within_a_unit() {
        for i in 0..=20 {
            for j in 0..=20 {
                let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                let at = root_point(&mixed(), 1, u, v).unwrap();
                let [s, t] = QuadCoord::of(at).to_f64();
                assert!((s - u).abs() <= f64::from(ONE).recip() && (t - v).abs() <= f64::from(ONE).recip());
                assert!(at.x <= ONE - at.y);
                assert_eq!(at.is_on_mesh_edge(), u * v * (1.0 - u) * (1.0 - v) == 0.0);
            }
        }
    }

    #[test]
    fn triangle_parameters_come_back_and_sides_stay_sides() {
        for i in 0..=20 {
            for j in 0..=20 - i {
                let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                let at = root_point(&mixed(), 0, u, v).unwrap();
                let third = f64::from(at.z()) / f64::from(ONE) / 3.0;
                let mut corner = [third; 3];
                corner[at.root as usize] += f64::from(at.x) / f64::from(ONE);
                corner[(at.root as usize + 1) % 3] += f64::from(at.y) / f64::from(ONE);
                assert!((corner[1] - u).abs() < 1e-9 && (corner[2] - v).abs() < 1e-9);
                if i == 0 || j == 0 {
                    assert!(at.is_on_mesh_edge());
                }
            }
        }
    }

    #[test]
    fn parameters_outside_are_refused() {
        let mesh = mixed();
        assert!(matches!(
            root_point(&mesh, 3, 0.0, 0.0),
            Err(ParameterError::Face { face: 3, faces: 3 })
        ));
        for (face, u, v) in [
            (0, 0.6, 0.6),
            (0, f64::NAN, 0.0),
            (1, 1.1, 0.0),
            (1, 0.0, -0.1),
            (2, 5.1, 0.0),
            (2, 0.0, f64::NAN),
        ] {
            assert!(matches!(
                root_point(&mesh, face, u, v),
                Err(ParameterError::OutOfDomain { .. })
            ));
        }
        assert_eq!(
            root_point(&mesh, 2, 5.0, 0.0).unwrap(),
            RootPoint {
                face: 2,
                root: 4,
                x: 0,
                y: ONE
            }
        );
    }
}
