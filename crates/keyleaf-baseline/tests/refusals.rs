//! Bad models, views and settings are refused with a reason, and nothing panics.

mod models;

use glam::DVec3;
use keyleaf_baseline::{
    BaselineError, Boundary, Method, Quality, Settings, Side, Test, View, compare, dabt, deviation, semi_adaptive,
    uniform, zones,
};
use models::Model;

fn errors(model: &Model, view: &View) -> Vec<BaselineError> {
    Method::ALL
        .into_iter()
        .map(|method| {
            method
                .tessellate(model, view, Quality::Medium)
                .expect_err(&method.to_string())
        })
        .collect()
}

#[test]
fn positions_that_are_not_finite_are_refused() {
    let everywhere = Model {
        point: |_, _| DVec3::NAN,
        ..models::plane()
    };
    let at_one_place = Model {
        point: |_, at| {
            if at.x > 0.4 && at.x < 0.6 {
                DVec3::splat(f64::INFINITY)
            } else {
                at.extend(0.0)
            }
        },
        ..models::plane()
    };
    for model in [everywhere, at_one_place] {
        for error in errors(&model, &models::near()) {
            assert!(matches!(error, BaselineError::Point { surface: 0, .. }), "{error}");
        }
        assert!(compare(&model, &models::near()).is_err());
    }
}

#[test]
fn knots_without_a_domain_are_refused() {
    for knots in [
        vec![],
        vec![0.0],
        vec![1.0, 1.0],
        vec![1.0, 0.0],
        vec![0.0, f64::NAN, 1.0],
        vec![f64::MIN, f64::MAX],
    ] {
        let model = Model {
            spans: vec![[vec![0.0, 1.0], knots]],
            ..models::plane()
        };
        for error in errors(&model, &models::near()) {
            assert_eq!(
                error,
                BaselineError::Knots {
                    surface: 0,
                    direction: 1
                }
            );
        }
    }
}

#[test]
fn joins_that_are_not_mutual_are_refused() {
    let joined = |surface, side| Boundary::Joined {
        surface,
        side,
        reversed: false,
    };
    for bad in [joined(7, Side::UMin), joined(0, Side::UMax), joined(0, Side::VMin)] {
        let mut model = models::plane();
        model.joins.insert((0, Side::UMax), bad);
        for error in errors(&model, &models::near()) {
            assert!(
                matches!(
                    error,
                    BaselineError::Join {
                        surface: 0,
                        side: Side::UMax,
                        ..
                    }
                ),
                "{error}"
            );
            assert!(error.to_string().contains("UMax"));
        }
    }
}

#[test]
fn views_and_settings_out_of_range_are_refused() {
    let (model, view) = (models::plane(), models::near());
    let bad_views = [
        View {
            eye: DVec3::NAN,
            ..view
        },
        View {
            pixels_per_radian: 0.0,
            ..view
        },
        View {
            pixels_per_radian: f64::INFINITY,
            ..view
        },
        View { near: -1.0, ..view },
    ];
    for view in bad_views {
        for error in errors(&model, &view) {
            assert!(matches!(error, BaselineError::Setting { .. }), "{error}");
        }
    }
    let good = Settings::new(Test::Distance { pixels: 1.0 });
    let bad_settings = [
        Settings {
            max_resolution: 16,
            ..good
        },
        Settings {
            coarse_cells: 0,
            ..good
        },
        Settings {
            segment_pixels: f64::NAN,
            ..good
        },
        Settings {
            test: Test::Flat { cosine: 1.5 },
            ..good
        },
        Settings {
            test: Test::Length { pixels: -1.0 },
            ..good
        },
        Settings {
            test: Test::Distance { pixels: f64::NAN },
            ..good
        },
    ];
    for settings in bad_settings {
        assert!(dabt::tessellate(&model, &view, &settings).is_err());
        assert!(semi_adaptive::tessellate(&model, &view, &settings).is_err());
    }
    assert!(uniform::at_levels(&model, &[0]).is_err());
    assert!(uniform::at_levels(&model, &[1, 1]).is_err());
    assert!(uniform::per_surface(&model, &view, 0.0, 3).is_err());
    assert!(uniform::per_surface(&model, &view, 1.0, 99).is_err());
    assert!(uniform::per_ks_quad(&model, &view, -2.0).is_err());
    assert!(zones::partition(4, 0).is_err());
    assert!(zones::at_levels(&model, &[3], 0).is_err());
}

#[test]
fn triangles_of_another_model_are_refused() {
    let tessellation = uniform::at_levels(&models::torus(), &[1; 16]).unwrap();
    assert!(deviation(&models::plane(), &models::near(), &tessellation).is_err());
    let report = keyleaf_baseline::check(&models::plane(), &tessellation);
    assert!(!report.is_watertight());
}

#[test]
fn an_eye_on_the_surface_only_costs_triangles() {
    let view = View {
        eye: DVec3::new(1.5, 1.5, 0.3),
        pixels_per_radian: 1000.0,
        near: 1e-9,
    };
    let model = models::wave();
    for method in Method::ALL {
        let tessellation = method.tessellate(&model, &view, Quality::Low).unwrap();
        assert!(tessellation.positions.iter().all(|position| position.is_finite()));
        assert!(tessellation.triangles.len() < 200_000, "{method}");
    }
}

#[test]
fn a_model_without_surfaces_has_no_triangles() {
    let model = Model {
        spans: Vec::new(),
        ..models::plane()
    };
    for method in Method::ALL {
        assert!(
            method
                .tessellate(&model, &models::near(), Quality::High)
                .unwrap()
                .triangles
                .is_empty()
        );
    }
}
