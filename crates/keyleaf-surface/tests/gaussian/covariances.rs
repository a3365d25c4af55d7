//! Which matrices are covariances, and the converters.

use crate::models::{Random, cube, mesh};
use glam::DVec3;
use keyleaf_surface::gaussian::{
    CONDITION_LIMIT, Conditioning, Covariance, CovarianceDefect, CovarianceError, CovarianceMesh, Dual, DualFrame,
    Symmetric3, symmetric_of_rows,
};
use keyleaf_surface::{ControlMesh, PolygonMesh};

fn turned(values: [f64; 3], random: &mut Random) -> Symmetric3 {
    Symmetric3::diagonal(values).congruent(random.rotation(3.0))
}

#[test]
fn singular_and_indefinite_matrices_are_floored_or_refused() {
    let mut random = Random(6);
    let examples = [
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 0.5, -0.5],
        [3.0, 1.0, 1e-9],
        [1e-12, 1e-12, 0.0],
        [1e12, 1.0, 1.0],
    ];
    for values in examples.into_iter().cycle().take(600) {
        let matrix = turned(values, &mut random);
        assert!(
            matches!(Covariance::new(matrix), Err(CovarianceDefect::Condition { .. })),
            "{values:?}"
        );
        let (covariance, changed) = Covariance::regularised(matrix).expect("a covariance");
        let found = covariance.matrix().eigen().values;
        for (found, given) in found.into_iter().zip(values) {
            let expected = given.max(values[0] / CONDITION_LIMIT);
            assert!((found - expected).abs() < 1e-14 * values[0], "{found} {expected}");
        }
        assert!(changed && covariance.condition() < CONDITION_LIMIT * 1.01);
        // What is a covariance now stays.
        assert_eq!(Covariance::regularised(covariance.matrix()), Ok((covariance, false)));
    }
    for matrix in [Symmetric3::default(), Symmetric3::diagonal([-1.0, -2.0, -3.0])] {
        assert!(matches!(
            Covariance::regularised(matrix),
            Err(CovarianceDefect::Size { .. })
        ));
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let matrix = Symmetric3 {
            xz: bad,
            ..Symmetric3::IDENTITY
        };
        assert_eq!(Covariance::regularised(matrix), Err(CovarianceDefect::NotFinite));
    }
    assert!(Covariance::isotropic(1e-12).is_some() && Covariance::isotropic(0.0).is_none());
    assert_eq!(
        symmetric_of_rows([1.0, 2.0, 0.0, 2.1, 1.0, 0.0, 0.0, 0.0, 1.0]),
        Err(CovarianceDefect::Asymmetric)
    );
    assert_eq!(symmetric_of_rows([f64::NAN; 9]), Err(CovarianceDefect::NotFinite));
    let nearly = symmetric_of_rows([2.0, 1.0, 0.0, 1.0 + 1e-7, 2.0, 0.0, 0.0, 0.0, 2.0]).expect("symmetric");
    assert!((nearly.xy - 1.0 - 0.5e-7).abs() < 1e-15);
}

#[test]
fn the_precision_inverts_at_any_scale_and_the_mean_comes_back() {
    let mut random = Random(12);
    for scale in [1e-90, 1e-12, 1.0, 1e12, 1e90] {
        for condition in [1.0f64, 1e3, 1e7] {
            let matrix = turned([1.0, 1.0 / condition.sqrt(), 1.0 / condition], &mut random) * scale;
            let covariance = Covariance::new(matrix).expect("a covariance");
            let inverse = covariance.precision();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                assert!((inverse * (matrix * axis)).distance(axis) < 1e-15 * condition * 10.0);
            }
            let mean = random.vector() * 100.0;
            let found = Dual::of(mean, &covariance, &DualFrame::OBJECT)
                .mean()
                .expect("definite");
            assert!(found.distance(mean) < 1e-14 * condition * 100.0, "{found} {mean}");
        }
    }
}

#[test]
fn meshes_report_which_vertices_were_changed_and_name_the_bad_one() {
    let control = ControlMesh::from(cube());
    let mut matrices = vec![Symmetric3::IDENTITY; 8];
    matrices[3] = Symmetric3::diagonal([1.0, 1.0, 0.0]);
    matrices[6] = Symmetric3::diagonal([1.0, 1.0, -1.0]);
    let (floored, changed) = CovarianceMesh::new(control.clone(), &matrices, Conditioning::Floor).expect("a mesh");
    assert_eq!(changed, [3, 6]);
    assert_eq!(floored.covariances()[2].matrix(), Symmetric3::IDENTITY);
    assert!(matches!(
        CovarianceMesh::new(control.clone(), &matrices, Conditioning::Strict),
        Err(CovarianceError::Defect {
            vertex: 3,
            defect: CovarianceDefect::Condition { .. }
        })
    ));
    matrices[5].yy = f64::NAN;
    assert_eq!(
        CovarianceMesh::new(control.clone(), &matrices, Conditioning::Floor),
        Err(CovarianceError::Defect {
            vertex: 5,
            defect: CovarianceDefect::NotFinite
        })
    );
    assert_eq!(
        CovarianceMesh::new(control.clone(), &matrices[1..], Conditioning::Floor),
        Err(CovarianceError::Count { vertices: 8, found: 7 })
    );
    assert!(floored.gaussian(8).is_none() && floored.scaled(1e300).is_none());
    let empty = ControlMesh::from(PolygonMesh::default());
    assert!(matches!(
        CovarianceMesh::isotropic(empty, 0.1),
        Err(CovarianceError::Mesh(_))
    ));
    assert!(matches!(
        CovarianceMesh::isotropic(control.clone(), 0.0),
        Err(CovarianceError::Setting(_))
    ));
    assert!(matches!(
        CovarianceMesh::from_faces(control, 0.1, f64::NAN),
        Err(CovarianceError::Setting(_))
    ));
    let point = ControlMesh::from(mesh(vec![DVec3::ONE; 3], &[vec![0, 1, 2]]));
    assert_eq!(CovarianceMesh::isotropic(point, 0.1), Err(CovarianceError::NoExtent));
}

#[test]
fn covariances_from_faces_are_flat_in_planes_long_at_edges_and_round_at_corners() {
    let s2 = (0.25f64 * 2.0).powi(2);
    let corners = CovarianceMesh::from_faces(ControlMesh::from(cube()), 0.25, 0.1).expect("a mesh");
    let expected = Symmetric3::IDENTITY * (s2 * (1.0 - 0.99 / 3.0));
    for covariance in corners.covariances() {
        assert!((covariance.matrix() - expected).norm() < 1e-14, "{covariance:?}");
    }
    // A roof of 2 × 4 squares: vertices inside a plane, and on the ridge, which runs along y.
    let position = |k: u32| {
        let (i, j) = (f64::from(k % 5), f64::from(k / 5));
        DVec3::new(i.min(2.0), j, -(i - 2.0).max(0.0))
    };
    let faces: Vec<Vec<u32>> = (0..8)
        .map(|k| k % 4 + k / 4 * 5)
        .map(|k| vec![k, k + 1, k + 6, k + 5])
        .collect();
    let roof = mesh((0..15).map(position).collect(), &faces);
    let roof = CovarianceMesh::from_faces(ControlMesh::from(roof), 1.0, 0.1).expect("a mesh");
    let flat = roof.covariances()[6].matrix();
    assert!(
        (flat - Symmetric3::diagonal([1.0, 1.0, 0.01])).norm() < 1e-14,
        "{flat:?}"
    );
    let ridge = roof.covariances()[7].matrix();
    assert!(
        (ridge - Symmetric3::diagonal([0.505, 1.0, 0.505])).norm() < 1e-14,
        "{ridge:?}"
    );
}
