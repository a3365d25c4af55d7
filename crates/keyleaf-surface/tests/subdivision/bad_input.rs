//! Control meshes that have no surface, and hard ones that do.

use crate::models::{LOOP, Random, any_point, disc, mesh, prism, settings};
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Corner, Crease, LoopWeights, MeshError, ParameterError, Subdivision, SubdivisionError,
    SubdivisionScheme, Surface,
};

const CATMULL_CLARK: SubdivisionScheme = SubdivisionScheme::CatmullClark;

fn error(control: &ControlMesh, scheme: SubdivisionScheme) -> SubdivisionError {
    Subdivision::new(control, settings(scheme, 3)).expect_err("no surface")
}

fn crease(vertices: [u32; 2], sharpness: f64) -> Crease {
    Crease { vertices, sharpness }
}

#[test]
fn creases_and_corners_that_name_nothing_or_have_no_sharpness_are_refused() {
    let with = |creases: Vec<Crease>, corners: Vec<Corner>| {
        error(
            &ControlMesh {
                creases,
                corners,
                ..prism(5)
            },
            CATMULL_CLARK,
        )
    };
    assert!(matches!(
        with(vec![crease([0, 1], 1.0), crease([0, 2], 1.0)], vec![]),
        SubdivisionError::NoSuchEdge {
            crease: 1,
            vertices: [0, 2]
        }
    ));
    assert!(matches!(
        with(vec![crease([0, 1], 1.0), crease([1, 0], 1.0)], vec![]),
        SubdivisionError::DuplicateCrease { creases: [0, 1], .. }
    ));
    for sharpness in [f64::NAN, f64::INFINITY, -0.5] {
        assert!(matches!(
            with(vec![crease([0, 1], sharpness)], vec![]),
            SubdivisionError::Sharpness {
                what: "crease",
                index: 0,
                ..
            }
        ));
        assert!(matches!(
            with(vec![], vec![Corner { vertex: 0, sharpness }]),
            SubdivisionError::Sharpness { what: "corner", .. }
        ));
    }
    let corner = |vertex| Corner { vertex, sharpness: 1.0 };
    assert!(matches!(
        with(vec![], vec![corner(10)]),
        SubdivisionError::NoSuchVertex { vertex: 10, .. }
    ));
    assert!(matches!(
        with(vec![], vec![corner(1), corner(1)]),
        SubdivisionError::DuplicateCorner { .. }
    ));
}

#[test]
fn faces_must_suit_the_scheme_and_the_boundary_rule_must_leave_some() {
    assert!(matches!(
        error(&prism(5), LOOP),
        SubdivisionError::NoTriangle { face: 0, corners: 5 }
    ));
    let square = mesh(
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.0))
            .to_vec(),
        [[0, 1, 2, 3]],
    );
    let control = ControlMesh {
        boundary: BoundaryRule::None,
        ..ControlMesh::from(square.clone())
    };
    assert_eq!(error(&control, CATMULL_CLARK), SubdivisionError::NothingDrawn);
    let mut far = square;
    far.positions[2].x = f64::NAN;
    assert!(matches!(
        error(&far.into(), CATMULL_CLARK),
        SubdivisionError::Mesh(MeshError::Position { vertex: 2, .. })
    ));
    let deep = Subdivision::new(&prism(5), settings(CATMULL_CLARK, 17));
    assert!(matches!(deep, Err(SubdivisionError::Setting(_))));
    assert!(matches!(
        error(&ControlMesh::default(), CATMULL_CLARK),
        SubdivisionError::Mesh(_)
    ));
}

#[test]
fn vertices_and_polygons_with_too_many_about_them_are_refused_at_once() {
    let start = std::time::Instant::now();
    let rim = |k: u32| DVec3::new(f64::from(k).cos(), f64::from(k).sin(), 0.0);
    let cone = |n: u32| {
        let positions = [DVec3::Z].into_iter().chain((0..n).map(rim)).collect();
        ControlMesh::from(mesh(positions, (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n])))
    };
    let polygon = |n: u32| ControlMesh::from(mesh((0..n).map(rim).collect(), [(0..n).collect::<Vec<_>>()]));
    for n in [1025, 60_000] {
        for scheme in [CATMULL_CLARK, LOOP] {
            assert_eq!(
                error(&cone(n), scheme),
                SubdivisionError::TooManyAround {
                    what: "vertex",
                    index: 0,
                    of: "faces",
                    found: n
                }
            );
        }
        assert_eq!(
            error(&polygon(n), CATMULL_CLARK),
            SubdivisionError::TooManyAround {
                what: "face",
                index: 0,
                of: "corners",
                found: n
            }
        );
    }
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn faces_that_the_boundary_rule_leaves_out_are_told() {
    for scheme in [CATMULL_CLARK, LOOP] {
        let control = ControlMesh {
            boundary: BoundaryRule::None,
            ..disc(5, scheme)
        };
        let surface = Subdivision::new(&control, settings(scheme, 3)).expect("a surface");
        let faces = control.mesh.faces.len() as u32;
        assert_eq!(surface.topology().face_count() as usize, surface.drawn_faces().len());
        for face in 0..faces {
            let at = surface.face_coord(face, 0.25, 0.25);
            match surface.drawn_faces().binary_search(&face) {
                Ok(drawn) => assert_eq!(at.expect("in the face").face, drawn as u32),
                Err(_) => assert_eq!(at, Err(ParameterError::NotDrawn { face })),
            }
        }
        assert!(matches!(
            surface.face_coord(faces, 0.0, 0.0),
            Err(ParameterError::Face { .. })
        ));
        assert!(matches!(
            surface.face_coord(0, 1.5, 0.0),
            Err(ParameterError::OutOfDomain { face: 0, .. })
        ));
    }
}

/// Every frame is finite with a unit normal.
fn check_frames(what: &str, surface: &Subdivision) {
    let mut random = Random(23);
    let corners: Vec<RootPoint> = surface
        .topology()
        .roots()
        .map(|root| root.corners()[1])
        .take(60)
        .collect();
    let points = (0..40).map(|_| any_point(surface, &mut random));
    for at in points.collect::<Vec<_>>().into_iter().chain(corners) {
        for frame in [surface.frame(at), surface.approximate(at)] {
            assert!(
                frame.position.is_finite() && frame.du.is_finite() && frame.dv.is_finite(),
                "{what}: {frame:?}"
            );
            assert!(
                (frame.normal.length() - 1.0).abs() < 1e-9,
                "{what}: {frame:?} at {at:?}"
            );
        }
    }
    assert!(surface.terminal_error().is_finite());
}

#[test]
fn hard_meshes_have_finite_frames_everywhere() {
    for isolation in [0, 1, 4] {
        for n in [3, 7, 11, 64] {
            for scheme in [CATMULL_CLARK, LOOP, SubdivisionScheme::Loop(LoopWeights::Warren)] {
                let surface = Subdivision::new(&disc(n, scheme), settings(scheme, isolation)).expect("a surface");
                check_frames(&format!("{scheme:?} {n}"), &surface);
            }
            let surface = Subdivision::new(&prism(n), settings(CATMULL_CLARK, isolation)).expect("a surface");
            check_frames(&format!("prism {n}"), &surface);
        }
    }
    // Two faces back to back; all vertices in one point; an edge that stays sharp and ends; an unused vertex.
    let triangle = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let pillow = ControlMesh::from(mesh(triangle.clone(), [[0, 1, 2], [2, 1, 0]]));
    let point = ControlMesh::from(mesh(vec![DVec3::ONE; 3], [[0, 1, 2]]));
    let dart = |scheme| ControlMesh {
        creases: vec![crease([0, 1], 10.0)],
        ..disc(5, scheme)
    };
    for scheme in [CATMULL_CLARK, LOOP] {
        for (what, control) in [("pillow", &pillow), ("point", &point), ("dart", &dart(scheme))] {
            check_frames(what, &Subdivision::new(control, settings(scheme, 4)).expect(what));
        }
    }
}

#[test]
fn fans_that_touch_in_a_vertex_are_sharp_there() {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        p(0.0, 0.0),
        p(1.0, 0.0),
        p(1.0, 1.0),
        p(0.0, 1.0),
        p(-1.0, 0.0),
        p(-1.0, -1.0),
        p(0.0, -1.0),
    ];
    let control = ControlMesh::from(mesh(positions, [[0, 1, 2, 3], [0, 4, 5, 6]]));
    let surface = Subdivision::new(&control, settings(CATMULL_CLARK, 4)).expect("a surface");
    for face in 0..2 {
        assert_eq!(
            surface.point(RootPoint {
                face,
                root: 0,
                x: ONE,
                y: 0
            }),
            DVec3::ZERO
        );
    }
}

#[test]
fn surfaces_move_with_their_control_points() {
    let mut random = Random(29);
    let turn = glam::DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -2.0) / 3.0, 0.7) * 3.0;
    for scheme in [CATMULL_CLARK, LOOP] {
        let control = disc(7, scheme);
        let shift = DVec3::new(100.0, -20.0, 3.0);
        let mut moved = control.clone();
        moved.mesh.positions.iter_mut().for_each(|p| *p = turn * *p + shift);
        let [own, moved] =
            [&control, &moved].map(|control| Subdivision::new(control, settings(scheme, 5)).expect("a surface"));
        for _ in 0..200 {
            let at = any_point(&own, &mut random);
            assert!((turn * own.point(at) + shift).distance(moved.point(at)) < 1e-12);
            let [a, b] = [&own, &moved].map(|surface| surface.approximate(at));
            assert!((turn * a.position + shift).distance(b.position) < 1e-12);
            assert!((turn * a.normal / 3.0).distance(b.normal) < 1e-6);
        }
    }
}
