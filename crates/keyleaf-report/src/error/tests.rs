//! Spheres, where every answer is known.

use super::nearest::distance_squared;
use super::sphere::Sphere;
use super::*;
use glam::{DMat4, DQuat, DVec3, DVec4};
use keyleaf_key::{ONE, Place, RootPoint};
use keyleaf_surface::{
    BoundaryRule, ControlMesh, CornerAttributes, Mesh, PolygonMesh, Subdivision, SubdivisionSettings, Surface,
    SurfaceFrame, root_point,
};

const UNIT: ErrorSettings = ErrorSettings {
    intervals: 6,
    most_samples: usize::MAX,
    truth: Truth::Limit,
    diagonal: Some(1.0),
};

fn exact(p: DVec3) -> DVec3 {
    p
}

fn rounded(p: DVec3) -> DVec3 {
    p.as_vec3().as_dvec3()
}

/// Whole faces of the octahedron as triangles.
fn octahedron_faces(sphere: &Sphere) -> Vec<DrawnTriangle> {
    let corner = |face, root| RootPoint {
        face,
        root,
        x: ONE,
        y: 0,
    };
    (0..8)
        .map(|face| sphere.triangle([0, 1, 2].map(|root| corner(face, root)), exact))
        .collect()
}

/// The greatest distance between triangles and the sphere in closed form: from their points nearest to the centre.
fn sagitta(triangles: &[DrawnTriangle]) -> f64 {
    let nearest = triangles.iter().map(|t| distance_squared(DVec3::ZERO, t.positions()));
    1.0 - nearest.fold(f64::INFINITY, f64::min).sqrt()
}

fn near(a: f64, b: f64, part: f64) -> bool {
    (a - b).abs() <= part * b.abs()
}

#[test]
fn an_octahedron_is_as_far_from_its_sphere_as_geometry_says() {
    let sphere = Sphere::octahedron();
    let error = measure(&sphere, &octahedron_faces(&sphere), &UNIT, None).unwrap();
    let depth = 1.0 - 1.0 / 3f64.sqrt();
    assert!(near(error.forward.max, depth, 1e-12), "{error:?}");
    assert!(near(error.backward.max, depth, 1e-12), "{error:?}");
    // Radial lines are the sphere's own parameters: the mean square of 1 - |p| over the triangle, by a fine sum.
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..500 {
        for j in 0..500 - i {
            let (u, v) = ((f64::from(i) + 1.0 / 3.0) / 500.0, (f64::from(j) + 1.0 / 3.0) / 500.0);
            sum += (1.0 - DVec3::new(1.0 - u - v, u, v).length()).powi(2);
            count += 1.0;
        }
    }
    assert!(near(error.forward.rms, f64::sqrt(sum / count), 0.01), "{error:?}");
    assert!(near(error.parametric.rms, error.forward.rms, 1e-9));
    assert!(error.normal.max < 1e-6);
    assert!(near(error.longest_edge, 2f64.sqrt(), 1e-12));
}

#[test]
fn flat_shading_is_off_by_the_angle_at_the_corners() {
    let sphere = Sphere::octahedron();
    let mut triangles = octahedron_faces(&sphere);
    for triangle in &mut triangles {
        let normal = triangle.area_vector();
        triangle.corners.iter_mut().for_each(|corner| corner.normal = normal);
    }
    let error = measure(&sphere, &triangles, &UNIT, None).unwrap();
    assert!(
        near(error.normal.max, (1.0 / 3f64.sqrt()).acos().to_degrees(), 1e-9),
        "{error:?}"
    );
}

#[test]
fn triangles_squares_and_pentagons_agree_with_the_closed_form() {
    for sphere in [Sphere::octahedron(), Sphere::cube(), Sphere::prism()] {
        for level in 1..4 {
            let triangles = sphere.triangles(level, exact);
            let error = measure(&sphere, &triangles, &UNIT, None).unwrap();
            // A lattice of 6 intervals may miss the deepest point by little.
            assert!(near(error.forward.max, sagitta(&triangles), 0.05), "{level} {error:?}");
            assert!(near(error.backward.max, sagitta(&triangles), 0.05), "{level} {error:?}");
            assert!(error.forward.max <= sagitta(&triangles) * (1.0 + 1e-9));
        }
    }
}

#[test]
fn the_error_falls_with_the_square_of_the_edge() {
    let sphere = Sphere::octahedron();
    let error = |level| measure(&sphere, &sphere.triangles(level, exact), &UNIT, None).unwrap();
    let points: Vec<(f64, f64)> = (1..6).map(error).map(|e| (e.longest_edge, e.both_ways().max)).collect();
    for pair in points.windows(2).skip(1) {
        let slope = (pair[0].1 / pair[1].1).ln() / (pair[0].0 / pair[1].0).ln();
        assert!((slope - 2.0).abs() < 0.05, "{slope} {points:?}");
    }
}

#[test]
fn rounding_to_f32_leaves_a_floor() {
    let sphere = Sphere::cube();
    let mut node = Place::of_root(0, 0);
    let mut errors = Vec::new();
    for _ in 0..20 {
        let triangle = sphere.triangle(node.corners(), rounded);
        errors.push(measure(&sphere, &[triangle], &UNIT, None).unwrap().forward.max);
        node = node.child(1);
    }
    let ulp = f64::from(f32::EPSILON);
    assert!(errors[0] > 1e-2 && errors[5] < errors[0] / 500.0, "{errors:?}");
    assert!(errors[15..].iter().all(|e| *e < ulp && *e > ulp / 100.0), "{errors:?}");
}

#[test]
fn the_nearest_point_is_found_across_faces() {
    for sphere in [Sphere::octahedron(), Sphere::cube(), Sphere::prism()] {
        let mut triangles = sphere.triangles(2, exact);
        let before = measure(&sphere, &triangles, &UNIT, None).unwrap();
        // The triangles stay on the sphere, but each slides away from its parameters.
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.3);
        for corner in triangles.iter_mut().flat_map(|t| &mut t.corners) {
            (corner.position, corner.normal) = (turn * corner.position, turn * corner.normal);
        }
        let after = measure(&sphere, &triangles, &UNIT, None).unwrap();
        assert!(after.parametric.max > 0.2);
        assert!(
            near(after.forward.max, before.forward.max, 1e-6),
            "{before:?} {after:?}"
        );
        assert!(
            near(after.forward.rms, before.forward.rms, 1e-6),
            "{before:?} {after:?}"
        );
        assert!(after.normal.max < 1e-3, "{after:?}");
    }
}

#[test]
fn a_wrong_evaluator_shows_in_every_column() {
    let sphere = Sphere::cube();
    let triangles = sphere.triangles(4, |p| p * 1.01);
    let error = measure(&sphere, &triangles, &UNIT, None).unwrap();
    assert!(
        near(error.forward.max, 0.01, 1e-3) && near(error.parametric.max, 0.01, 1e-3),
        "{error:?}"
    );
    assert!(near(error.backward.rms, 0.0095, 0.06), "{error:?}");
}

/// From +z, 50 pixels a unit.
fn parallel_view() -> ScreenView {
    let clip = DMat4::from_diagonal(DVec4::new(0.5, 0.5, 0.1, 1.0));
    ScreenView::new(clip, [200, 200])
}

/// From a point towards the origin, with a reversed, infinite depth.
fn perspective(eye: DVec3, fov_y: f64, size: [u32; 2]) -> ScreenView {
    let focal = 1.0 / (fov_y / 2.0).tan();
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let forward = -eye.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let row = |axis: DVec3, scale: f64| (axis * scale).extend(-axis.dot(eye) * scale);
    let depth = DVec4::new(0.0, 0.0, 0.0, 0.1);
    ScreenView::new(
        DMat4::from_rows(row(right, focal / aspect), row(up, focal), depth, row(forward, 1.0)),
        size,
    )
}

#[test]
fn pixels_are_what_the_scale_of_the_view_makes_of_lengths() {
    let sphere = Sphere::octahedron();
    let triangles = sphere.triangles(2, exact);
    let error = measure(&sphere, &triangles, &UNIT, Some(&parallel_view())).unwrap();
    let screen = error.screen.unwrap();
    assert!(near(screen.side_on.max, 50.0 * error.forward.max, 1e-9), "{screen:?}");
    assert!(screen.shift.max <= screen.side_on.max && screen.shift.max > 0.0);
    assert_eq!(screen.samples, error.samples);
    let away = ScreenView::new(DMat4::from_translation(DVec3::X * 9.0), [10, 10]);
    assert!(
        measure(&sphere, &triangles, &UNIT, Some(&away))
            .unwrap()
            .screen
            .is_none()
    );
}

#[test]
fn pixels_a_unit_are_the_steepest_derivative_of_the_projection() {
    let view = perspective(DVec3::new(3.0, 2.0, 4.0), 1.0, [600, 400]);
    let p = DVec3::new(0.3, -0.2, 0.5);
    let rate = |direction: DVec3| {
        let [a, b] = [-1e-6, 1e-6].map(|step| view.pixel(p + direction * step).unwrap());
        a.distance(b) / 2e-6
    };
    let mut steepest = 0.0f64;
    for i in 0..100 {
        for j in 0..50 {
            let (a, b) = (f64::from(i) * 0.0628, f64::from(j) * 0.0628);
            steepest = steepest.max(rate(DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos())));
        }
    }
    assert!(near(view.pixels_per_unit(p), steepest, 2e-3));
    // Behind the eye nothing is seen.
    assert_eq!(view.pixel(DVec3::new(6.0, 4.0, 8.0)), None);
}

#[test]
fn the_silhouette_of_a_polygonal_equator_is_off_by_its_sagitta() {
    let sphere = Sphere::octahedron();
    for level in 1..4 {
        let triangles = sphere.triangles(level, exact);
        let settings = ErrorSettings { intervals: 24, ..UNIT };
        let error = measure(&sphere, &triangles, &settings, Some(&parallel_view())).unwrap();
        let contour = error.screen.unwrap().silhouette.unwrap();
        let edges = triangles.iter().flat_map(|t| {
            let [a, b, c] = t.positions();
            [[a, b], [b, c], [c, a]]
        });
        let equator = edges.filter(|edge| edge.iter().all(|p| p.z == 0.0));
        let widest = equator.map(|[a, b]| a.angle_between(b)).fold(0.0, f64::max);
        let sagitta = 50.0 * (1.0 - (widest / 2.0).cos());
        assert!(near(contour.error.max, sagitta, 0.01), "{level} {contour:?} {sagitta}");
        assert!(near(contour.length, 100.0 * std::f64::consts::PI, 0.01), "{contour:?}");
    }
}

#[test]
fn a_perspective_silhouette_falls_with_the_level() {
    let sphere = Sphere::cube();
    let view = perspective(DVec3::new(2.0, 1.7, 2.3), 0.8, [500, 500]);
    let error = |level| {
        let triangles = sphere.triangles(level, exact);
        measure(&sphere, &triangles, &UNIT, Some(&view))
            .unwrap()
            .screen
            .unwrap()
            .silhouette
            .unwrap()
    };
    let [coarse, fine] = [error(2), error(4)];
    assert!(
        coarse.error.max > 10.0 * fine.error.max && fine.error.max > 0.0,
        "{coarse:?} {fine:?}"
    );
    assert!(near(coarse.length, fine.length, 0.01));
}

#[test]
fn the_creases_of_a_flat_mesh_are_its_silhouette() {
    let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
    let cube = PolygonMesh {
        positions: (0..8).map(corner).collect(),
        faces: [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [1, 3, 7, 5],
            [3, 2, 6, 7],
            [2, 0, 4, 6],
        ]
        .into_iter()
        .collect(),
        corners: CornerAttributes::default(),
    };
    let surface = Mesh::new(&cube).unwrap();
    let vertex = |face, [u, v]: [f64; 2]| {
        let at = surface.face_coord(face, u, v).unwrap();
        let frame = surface.frame(at);
        DrawnVertex {
            at,
            position: frame.position,
            normal: frame.normal,
        }
    };
    let of_face = |face| {
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|at| vertex(face, at));
        [[a, b, c], [a, c, d]].map(|corners| DrawnTriangle { corners })
    };
    let triangles: Vec<_> = (0..6).flat_map(of_face).collect();
    let view = perspective(DVec3::new(4.0, 3.4, 4.6), 0.8, [500, 500]);
    let error = measure(&surface, &triangles, &UNIT, Some(&view)).unwrap();
    let contour = error.screen.unwrap().silhouette.unwrap();
    assert!(contour.error.max < 1e-9, "{contour:?}");
    // Six of the cube's edges.
    let pixel = |k| view.pixel(corner(k)).unwrap();
    let outline: f64 = [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]]
        .map(|[a, b]| pixel(a).distance(pixel(b)))
        .iter()
        .sum();
    assert!(near(contour.length, outline, 1e-9), "{contour:?} {outline}");
}

#[test]
fn surfaces_whose_first_faces_are_not_drawn_are_measured() {
    let at = |i: u32, j: u32| 5 * j + i;
    let cells = (0..16).map(|k| (k % 4, k / 4));
    let control = ControlMesh {
        boundary: BoundaryRule::None,
        ..ControlMesh::from(PolygonMesh {
            positions: (0..25)
                .map(|k| DVec3::new(f64::from(k % 5), f64::from(k / 5), 0.0))
                .collect(),
            faces: cells
                .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                .collect(),
            corners: CornerAttributes::default(),
        })
    };
    let surface = Subdivision::new(&control, SubdivisionSettings::default()).unwrap();
    assert_eq!(surface.topology().face_count(), 4);
    let vertex = |face, [u, v]: [f64; 2]| {
        let at = root_point(surface.topology(), face, u, v).unwrap();
        let SurfaceFrame { position, normal, .. } = surface.frame(at);
        DrawnVertex { at, position, normal }
    };
    let triangles: Vec<_> = (0..4)
        .map(|face| DrawnTriangle {
            corners: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(|at| vertex(face, at)),
        })
        .collect();
    let error = measure(&surface, &triangles, &UNIT, None).unwrap();
    // To the rounding of parameters.
    assert!(error.both_ways().max < 1e-9, "flat: {error:?}");
}

#[test]
fn a_limit_on_samples_measures_fewer_triangles_and_says_so() {
    let sphere = Sphere::cube();
    let triangles = sphere.triangles(3, exact);
    let all = measure(&sphere, &triangles, &UNIT, None).unwrap();
    let settings = ErrorSettings {
        most_samples: 2000,
        ..UNIT
    };
    let some = measure(&sphere, &triangles, &settings, None).unwrap();
    assert_eq!((all.measured, all.triangles), (1536, 1536));
    assert!(
        some.measured < 400 && some.samples <= 2000 && some.triangles == 1536,
        "{some:?}"
    );
    assert!(near(some.forward.max, all.forward.max, 0.2));
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let sphere = Sphere::cube();
    let good = sphere.triangles(0, exact);
    let refused = |change: fn(&mut DrawnTriangle)| {
        let mut triangles = good.clone();
        change(&mut triangles[1]);
        measure(&sphere, &triangles, &UNIT, None).unwrap_err()
    };
    assert_eq!(measure(&sphere, &[], &UNIT, None), Err(MeasureError::Empty));
    assert_eq!(
        refused(|t| t.corners[1].position.x = f64::NAN),
        MeasureError::NotFinite { triangle: 1 }
    );
    assert_eq!(
        refused(|t| t.corners[1].at.face = 1),
        MeasureError::AcrossFaces { triangle: 1 }
    );
    let outside = |root, face| MeasureError::Outside {
        triangle: 1,
        face,
        root,
    };
    assert_eq!(refused(|t| t.corners[0].at.face = 6), outside(1, 6));
    assert_eq!(refused(|t| t.corners[0].at.root = 4), outside(4, 0));
    assert_eq!(refused(|t| t.corners[0].at.x = u32::MAX), outside(1, 0));
    for intervals in [0, 3, 66] {
        let settings = ErrorSettings { intervals, ..UNIT };
        assert!(matches!(
            measure(&sphere, &good, &settings, None),
            Err(MeasureError::Setting { name: "intervals", .. })
        ));
    }
}

#[test]
fn chord_errors_of_levels_are_those_of_the_sphere() {
    let sphere = Sphere::octahedron();
    let diagonal = 12f64.sqrt();
    let first = chord_error(&sphere, 0).unwrap();
    assert_eq!(first.triangles, 8);
    assert!(near(first.error.max * diagonal, 1.0 - 1.0 / 3f64.sqrt(), 1e-9));
    let [coarse, fine] = [3, 4].map(|level| chord_error(&sphere, level).unwrap());
    assert_eq!((coarse.triangles, fine.triangles), (8 * 64, 8 * 256));
    assert!(
        near(coarse.error.max / fine.error.max, 4.0, 0.05),
        "{coarse:?} {fine:?}"
    );
    assert_eq!(chord_error(&Sphere::prism(), 2).unwrap().triangles, 2 * 5 * 16 + 5 * 32);
    assert!(chord_error(&sphere, 11).is_err());
    let (low, high) = sphere.bounding_box();
    assert_eq!(low.distance(high), diagonal);
}
