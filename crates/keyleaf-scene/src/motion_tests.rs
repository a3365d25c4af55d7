//! Poses: blend shapes, groups, parents, joints, covariances.

use super::*;
use crate::scene::{Ease, WeightKey};

fn group(name: &str, parent: Option<&str>, vertices: &[(u32, u32)], keys: &[TransformKey]) -> Track {
    Track::Group(GroupTrack {
        name: name.into(),
        parent: parent.map(str::to_owned),
        vertices: vertices.to_vec(),
        pivot: [1.0, 0.0, 0.0],
        keys: keys.to_vec(),
        looped: false,
    })
}

fn turn(time: f64, degrees: f64, scale: f64) -> TransformKey {
    TransformKey {
        time,
        translation: [0.0, 0.0, time],
        rotation: [0.0, 0.0, degrees],
        scale,
        ease: Ease::Linear,
    }
}

fn rest() -> Vec<DVec3> {
    (0..4).map(|k| DVec3::new(f64::from(k), 0.5, 0.0)).collect()
}

fn near(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-12, "{a} {b}");
}

#[test]
fn groups_turn_about_their_pivot_and_carry_their_children() {
    let tracks = [
        group("arm", None, &[(1, 2)], &[turn(0.0, 0.0, 1.0), turn(2.0, 90.0, 4.0)]),
        group("hand", Some("arm"), &[(3, 3)], &[]),
    ];
    let mut motion = CageMotion::new(rest());
    motion.add_groups(&tracks).unwrap();
    assert_eq!((motion.pose(0.0), motion.duration()), (rest(), 2.0));
    let posed = motion.pose(2.0);
    near(posed[0], rest()[0]);
    near(posed[1], DVec3::new(-1.0, 0.0, 2.0));
    near(posed[3], DVec3::new(-1.0, 8.0, 2.0));
    // Halfway the scale is the geometric mean.
    let halfway = motion.pose(1.0)[1] - DVec3::new(1.0, 0.0, 1.0);
    assert!((halfway.length() - 2.0 * 0.5).abs() < 1e-12);
}

#[test]
fn vertices_of_two_groups_go_to_the_mean() {
    let tracks = [
        group("still", None, &[(0, 2)], &[]),
        group("moved", None, &[(2, 3), (3, 3)], &[turn(0.0, 180.0, 1.0)]),
    ];
    let mut motion = CageMotion::new(rest());
    motion.add_groups(&tracks).unwrap();
    let posed = motion.pose(0.0);
    near(posed[1], rest()[1]);
    near(posed[2], DVec3::new(1.0, 0.0, 0.0));
    near(posed[3], DVec3::new(-1.0, -0.5, 0.0));
}

#[test]
fn blend_shapes_are_added_before_the_groups_move() {
    let track = BlendTrack {
        path: "up.obj".into(),
        keys: [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
            .map(|(time, weight)| WeightKey {
                time,
                weight,
                ease: Ease::Linear,
            })
            .to_vec(),
        looped: true,
    };
    let target: Vec<DVec3> = rest().iter().map(|&p| p + DVec3::Y).collect();
    let mut motion = CageMotion::new(rest());
    motion.add_blend(&track, &target).unwrap();
    motion
        .add_groups(&[group("arm", None, &[(3, 3)], &[turn(0.0, 90.0, 1.0)])])
        .unwrap();
    for time in [1.0, 3.0, 21.0] {
        let posed = motion.pose(time);
        near(posed[0], DVec3::new(0.0, 1.5, 0.0));
        near(posed[3], DVec3::new(-0.5, 2.0, 0.0));
    }
    near(motion.pose(2.0)[0], rest()[0]);
    let few = motion.add_blend(&track, &target[1..]).unwrap_err();
    assert_eq!(few, MotionError::Target { found: 3, count: 4 });
}

#[test]
fn covariances_turn_with_their_vertices() {
    let tracks = [group("arm", None, &[(1, 1)], &[turn(0.0, 90.0, 2.0)])];
    let mut motion = CageMotion::new(rest());
    motion.add_groups(&tracks).unwrap();
    let covariance = [4.0, 0.5, 0.25, 1.0, 0.125, 9.0];
    let posed = motion.pose_covariances(0.0, &[covariance; 4]);
    assert_eq!(posed[0], covariance);
    // x becomes y, y becomes -x, and all is four times as large.
    let expected = [4.0, -2.0, -0.5, 16.0, 1.0, 36.0];
    assert!(
        posed[1].iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12),
        "{:?}",
        posed[1]
    );
    // The quadratic form of a moved offset by the inverse is what it was.
    let matrix = |[xx, xy, xz, yy, yz, zz]: [f64; 6]| {
        DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
    };
    let offset = DVec3::new(0.3, -0.2, 0.9);
    let moved = DMat3::from_rotation_z(90f64.to_radians()) * (2.0 * offset);
    let before = offset.dot(matrix(covariance).inverse() * offset);
    let after = moved.dot(matrix(posed[1]).inverse() * moved);
    assert!((before - after).abs() < 1e-12);
}

#[test]
fn what_does_not_fit_the_mesh_is_named() {
    let error = |track: Track| CageMotion::new(rest()).add_groups(&[track]).unwrap_err().to_string();
    let outside = error(group("arm", None, &[(0, 1), (2, 4)], &[]));
    assert_eq!(
        outside,
        "group 'arm' has the vertices 2 to 4, counted from 0; the mesh has 4"
    );
    assert!(error(group("hand", Some("arm"), &[], &[])).contains("parent 'arm'"));
}
