//! No method leaves cracks, folds or overlaps on any model.

mod models;

use glam::DVec2;
use keyleaf_baseline::{
    Method, Quality, Sampler, Settings, Tessellation, Test, check, dabt, semi_adaptive, uniform, zones,
};
use models::Model;
use std::collections::{HashMap, HashSet};

fn assert_watertight(model: &Model, tessellation: &Tessellation, how: &str) {
    let report = check(model, tessellation);
    assert!(report.is_watertight(), "{} {how}: {report:?}", model.name);
    assert_eq!(tessellation.positions.len(), tessellation.parameters.len());
    for (position, &(surface, at)) in tessellation.positions.iter().zip(&tessellation.parameters) {
        assert_eq!(*position, model.point(surface as usize, at), "{} {how}", model.name);
    }
}

/// Vertices minus edges plus triangles.
fn euler_characteristic(tessellation: &Tessellation) -> i64 {
    let mut edges = HashSet::new();
    let mut vertices = HashSet::new();
    for &[a, b, c] in &tessellation.triangles {
        edges.extend([[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]]);
        vertices.extend([a, b, c]);
    }
    vertices.len() as i64 - edges.len() as i64 + tessellation.triangles.len() as i64
}

#[test]
fn every_method_is_watertight_on_every_model_at_every_quality() {
    for model in models::all() {
        for view in [models::near(), models::far()] {
            for method in Method::ALL {
                for quality in Quality::ALL {
                    let tessellation = method.tessellate(&model, &view, quality).unwrap();
                    assert_watertight(&model, &tessellation, &format!("{method} {quality} from {}", view.eye));
                }
            }
        }
    }
}

#[test]
fn adaptive_methods_are_watertight_at_any_resolution_and_threshold() {
    let view = models::near();
    for model in [
        models::wave(),
        models::sphere(),
        models::globe(),
        models::unlike_knots(),
        models::pillow(),
        models::leaf(),
    ] {
        for coarse_cells in [1, 2, 3] {
            for max_resolution in [0, 1, 2, 5, 8, 15] {
                for pixels in [0.0, 0.3, 3.0, 30.0] {
                    for segment_pixels in [0.0, 20.0] {
                        for test in [Test::Distance { pixels }, Test::Length { pixels: 5.0 * pixels }] {
                            let settings = Settings {
                                test,
                                segment_pixels,
                                max_resolution,
                                coarse_cells,
                            };
                            let how = format!("{settings:?}");
                            let full = dabt::tessellate(&model, &view, &settings).unwrap();
                            assert_watertight(&model, &full, &how);
                            let semi = semi_adaptive::tessellate(&model, &view, &settings).unwrap();
                            assert_watertight(&model, &semi, &how);
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn neighbouring_surfaces_of_unlike_levels_are_stitched() {
    for model in models::all() {
        let levels: Vec<u32> = (0..model.surfaces())
            .map(|surface| 1 + (surface as u32 * 7 + 3) % 5)
            .collect();
        let tessellation = uniform::at_levels(&model, &levels).unwrap();
        assert_watertight(&model, &tessellation, "levels");
        let zoned = zones::at_levels(&model, &levels, zones::ZONE_SIZE).unwrap().0;
        assert_watertight(&model, &zoned, "zones");
    }
}

#[test]
fn closed_models_keep_their_topology() {
    let expected = [
        (models::torus(), 0),
        (models::closed_torus(), 0),
        (models::sphere(), 2),
        (models::globe(), 2),
        (models::pillow(), 2),
        (models::moebius(), 0),
        (models::wave(), 1),
        (models::leaf(), 1),
    ];
    for (model, characteristic) in expected {
        for method in Method::ALL {
            for view in [models::near(), models::far()] {
                let tessellation = method.tessellate(&model, &view, Quality::Low).unwrap();
                assert_eq!(
                    euler_characteristic(&tessellation),
                    characteristic,
                    "{} {method}",
                    model.name
                );
            }
        }
    }
}

#[test]
fn a_pole_is_one_vertex() {
    for model in [models::sphere(), models::globe()] {
        for method in Method::ALL {
            let tessellation = method.tessellate(&model, &models::near(), Quality::High).unwrap();
            let poles = tessellation
                .positions
                .iter()
                .filter(|position| position.truncate().length() < 1e-9)
                .count();
            assert_eq!(poles, 2, "{} {method}", model.name);
        }
    }
}

#[test]
fn shared_points_are_one_vertex() {
    let tessellation = Method::Dabt(keyleaf_baseline::TestKind::Distance)
        .tessellate(&models::torus(), &models::near(), Quality::High)
        .unwrap();
    let mut seen: HashMap<[i64; 3], usize> = HashMap::new();
    for position in &tessellation.positions {
        let rounded = (*position * 1e9).round().to_array().map(|x| x as i64);
        assert_eq!(*seen.entry(rounded).and_modify(|count| *count += 1).or_insert(1), 1);
    }
}

#[test]
fn the_check_finds_what_is_broken() {
    let model = models::torus();
    let whole = uniform::at_levels(&model, &[1; 16]).unwrap();
    assert!(check(&model, &whole).is_watertight());

    let mut missing = whole.clone();
    missing.triangles.pop();
    missing.domains.pop();
    assert_eq!(check(&model, &missing).open_edges, 3);

    let mut twice = whole.clone();
    twice.triangles.push(twice.triangles[0]);
    twice.domains.push(twice.domains[0]);
    assert_eq!(check(&model, &twice).crowded_edges, 3);
    assert!(check(&model, &twice).most_covered > 1.0);

    let mut not_welded = whole.clone();
    let copy = not_welded.positions.len() as u32;
    let vertex = not_welded.triangles[0][0];
    not_welded.positions.push(not_welded.positions[vertex as usize]);
    not_welded.triangles[0][0] = copy;
    assert!(check(&model, &not_welded).open_edges > 0);

    let mut folded = whole.clone();
    folded.domains[0].1.swap(0, 1);
    assert_eq!(check(&model, &folded).folded_triangles, 1);

    let mut nan = whole;
    nan.positions[0].x = f64::NAN;
    nan.domains[1].1[0] = DVec2::NAN;
    assert_eq!(check(&model, &nan).not_finite, 2);
}
