//! Valences, boundaries, degenerate triangles and bad input.

use crate::models::{grid, mesh, open_fan, sphere, triangles, wheel};
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint, Topology};
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Corner, CornerNormals, Crease, LimitSample, LimitSamples, LoopWeights, PolygonMesh,
    Surface, SurfaceFrame, TrianglePatchError, TrianglePatches,
};

fn all_kinds(mesh: &PolygonMesh) -> [TrianglePatches; 4] {
    let control = ControlMesh::from(mesh.clone());
    [
        TrianglePatches::of_loop(&control, LoopWeights::Loop),
        TrianglePatches::of_loop(&control, LoopWeights::Warren),
        TrianglePatches::butterfly(mesh),
        TrianglePatches::point_normal(mesh, CornerNormals::AngleWeighted),
    ]
    .map(|surface| surface.expect("a surface"))
}

fn check_frames(surface: &TrianglePatches, what: &str) {
    for root in surface.topology().roots() {
        for (i, j) in (0..=4).flat_map(|i| (0..=4 - i).map(move |j| (i, j))) {
            let frame = surface.frame(root.at(i * (ONE / 4), j * (ONE / 4)));
            assert!(
                frame.position.is_finite() && (frame.normal.length() - 1.0).abs() < 1e-12,
                "{what}: {frame:?}"
            );
        }
        let bound = surface.bound(&root);
        assert!(
            bound.size.is_finite() && bound.deviation.is_finite() && bound.radius.is_finite(),
            "{what}"
        );
    }
}

#[test]
fn valences_from_3_to_64_and_boundaries_face_outwards() {
    for n in (3..=12).chain([32, 64]) {
        for surface in all_kinds(&wheel(n, 0.3)) {
            check_frames(&surface, &format!("wheel of {n}"));
            let tip = surface.frame(RootPoint {
                face: 0,
                root: 0,
                x: ONE,
                y: 0,
            });
            assert!(tip.normal.distance(DVec3::Z) < 1e-12, "{n}: {tip:?}");
        }
    }
    for k in 3..=12 {
        for surface in all_kinds(&open_fan(k)) {
            check_frames(&surface, &format!("fan of {k} edges"));
            let tip = surface.frame(RootPoint {
                face: 0,
                root: 0,
                x: ONE,
                y: 0,
            });
            assert!(tip.normal.z > 0.5, "{k}: {tip:?}");
        }
    }
}

/// The limit of a flat regular mesh is itself, at boundaries and corners as well.
#[test]
fn a_flat_mesh_stays_in_its_plane_with_its_normal() {
    for surface in all_kinds(&grid(5, |_, _| 0.0)) {
        for root in surface.topology().roots() {
            let frame = surface.frame(root.at(ONE / 4, ONE / 2));
            assert!(
                frame.position.z.abs() < 1e-15 && frame.normal.distance(DVec3::Z) < 1e-13,
                "{frame:?}"
            );
        }
    }
}

#[test]
fn degenerate_triangles_have_finite_frames_and_bounds() {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let cases = [
        ("a point", vec![p(0.0, 0.0); 4]),
        ("a line", vec![p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)]),
        (
            "an edge without length",
            vec![p(0.0, 0.0), p(0.0, 0.0), p(1.0, 1.0), p(0.0, 2.0)],
        ),
        ("a sliver", vec![p(0.0, 0.0), p(1.0, 0.0), p(0.5, 1e-9), p(0.5, 1.0)]),
        ("folded", vec![p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0), p(0.0, 0.0)]),
        ("huge", vec![p(0.0, 0.0), p(1e15, 0.0), p(0.0, 1e15), p(1e15, 1e15)]),
    ];
    for (name, positions) in cases {
        for surface in all_kinds(&mesh(positions, &[[0, 1, 2], [2, 1, 3]])) {
            check_frames(&surface, name);
            assert!(surface.tables(DVec3::ZERO).a.iter().all(|x| x.is_finite()), "{name}");
        }
    }
    // Two faces back to back: an interior vertex with two edges.
    for surface in all_kinds(&mesh(
        vec![p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)],
        &[[0, 1, 2], [0, 2, 1]],
    )) {
        check_frames(&surface, "back to back");
    }
    // Two triangles that touch in vertex 2: it stays, with a normal a fan.
    let touching = mesh(
        vec![
            p(0.0, 0.0),
            p(1.0, 0.0),
            p(0.5, 1.0),
            p(1.0, 2.0),
            DVec3::new(0.0, 2.0, 1.0),
        ],
        &[[0, 1, 2], [2, 3, 4]],
    );
    let [surface, ..] = all_kinds(&touching);
    let [below, above] = [(0, 2), (1, 0)].map(|(face, root)| {
        surface.frame(RootPoint {
            face,
            root,
            x: ONE,
            y: 0,
        })
    });
    assert!(below.position == touching.positions[2] && above.position == touching.positions[2]);
    assert!(below.normal == DVec3::Z && above.normal != DVec3::Z);
}

#[test]
fn bad_input_is_named() {
    let quads = PolygonMesh {
        positions: grid(3, |_, _| 0.0).positions,
        faces: [&[0, 1, 3][..], &[1, 4, 3], &[1, 2, 5, 4]].into_iter().collect(),
        ..PolygonMesh::default()
    };
    let expected = Err(TrianglePatchError::NotATriangle { face: 2, corners: 4 });
    assert_eq!(TrianglePatches::butterfly(&quads).map(|_| ()), expected);
    assert_eq!(
        TrianglePatches::point_normal(&quads, CornerNormals::default()).map(|_| ()),
        expected
    );
    assert_eq!(
        LimitSamples::of_loop(&ControlMesh::from(quads), LoopWeights::Loop).map(|_| ()),
        expected
    );

    let control = ControlMesh::from(sphere(0));
    let creased = ControlMesh {
        creases: vec![Crease {
            vertices: [0, 1],
            sharpness: 0.5,
        }],
        ..control.clone()
    };
    let sharp = ControlMesh {
        corners: vec![Corner {
            vertex: 2,
            sharpness: 10.0,
        }],
        ..control.clone()
    };
    for control in [creased, sharp] {
        assert_eq!(
            LimitSamples::of_loop(&control, LoopWeights::Loop),
            Err(TrianglePatchError::Sharp)
        );
    }
    let cut = ControlMesh {
        boundary: BoundaryRule::None,
        ..control
    };
    assert_eq!(
        LimitSamples::of_loop(&cut, LoopWeights::Loop),
        Err(TrianglePatchError::NoBoundary)
    );

    let mut mesh = sphere(0);
    assert_eq!(
        TrianglePatches::point_normal(&mesh, CornerNormals::OfMesh).map(|_| ()),
        Err(TrianglePatchError::NoNormals)
    );
    let mut normals = vec![[0.0, 1.0, 0.0]; 24];
    normals[7] = [f32::NAN, 0.0, 0.0];
    mesh.corners.normals = Some(normals);
    assert_eq!(
        TrianglePatches::point_normal(&mesh, CornerNormals::OfMesh).map(|_| ()),
        Err(TrianglePatchError::Normal { face: 2, corner: 1 })
    );
    mesh.positions[3].x = f64::INFINITY;
    assert!(matches!(
        TrianglePatches::butterfly(&mesh),
        Err(TrianglePatchError::Mesh(_))
    ));
}

#[test]
fn samples_of_any_surface_are_taken_and_checked() {
    let topology = Topology::new(6, triangles(&sphere(0))).expect("a surface");
    let model = TrianglePatches::point_normal(&sphere(0), CornerNormals::default()).expect("a surface");
    let on_sphere = |at: RootPoint| {
        let frame = model.frame(at);
        let normal = frame.position.normalize();
        SurfaceFrame {
            position: normal,
            normal,
            ..frame
        }
    };
    let samples = LimitSamples::of_surface(&topology, on_sphere);
    let surface = TrianglePatches::quadratic(&topology, &samples).expect("a surface");
    for root in topology.roots() {
        for at in [root.corners()[1], root.at(ONE / 2, ONE / 2)] {
            let frame = surface.frame(at);
            assert!((frame.position.length() - 1.0).abs() < 1e-15 && frame.normal.distance(frame.position) < 1e-15);
        }
    }
    let short = LimitSamples {
        edges: samples.edges[1..].to_vec(),
        ..samples.clone()
    };
    assert_eq!(
        TrianglePatches::quadratic(&topology, &short).map(|_| ()),
        Err(TrianglePatchError::SampleCount {
            what: "edges",
            half_edges: 24,
            found: 23
        })
    );
    let mut bad = samples;
    bad.corners[4] = LimitSample {
        position: DVec3::NAN,
        normal: DVec3::Z,
    };
    assert_eq!(
        TrianglePatches::quadratic(&topology, &bad).map(|_| ()),
        Err(TrianglePatchError::Sample {
            what: "corners",
            face: 1,
            root: 1
        })
    );
}
