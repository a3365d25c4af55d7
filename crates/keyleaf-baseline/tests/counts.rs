//! Triangle counts and errors: against the tables of the thesis, and against each other.

mod models;

use glam::{DVec2, DVec3};
use keyleaf_baseline::{
    Boundary, Method, Quality, Sampler, Settings, Side, Test, TestKind, compare, dabt, deviation, semi_adaptive,
    threshold_for_share, uniform, zones,
};

const ADAPTIVE: [Method; 2] = [
    Method::SemiAdaptive(TestKind::Distance),
    Method::Dabt(TestKind::Distance),
];

#[test]
fn uniform_counts_are_those_of_table_2_1() {
    let triangles = |level| uniform::at_levels(&models::plane(), &[level]).unwrap().triangles.len() as f64;
    // Thousands of 1024, rounded to two digits. S_1 has 26 surfaces, S_5 has 520, S_16 has 8110.
    for (surfaces, level, thousands) in [
        (26.0, 1, 0.46),
        (26.0, 4, 48.80),
        (26.0, 6, 819.05),
        (520.0, 4, 976.02),
        (8110.0, 4, 15222.09),
    ] {
        assert!(
            (surfaces * triangles(level) / 1024.0 - thousands).abs() < 0.01,
            "{surfaces} at {level}"
        );
    }
}

#[test]
fn full_pattern_has_the_triangles_of_table_4_1() {
    let settings = Settings::new(Test::Length { pixels: 0.0 });
    for tessellation in [
        dabt::tessellate(&models::plane(), &models::near(), &settings).unwrap(),
        semi_adaptive::tessellate(&models::plane(), &models::near(), &settings).unwrap(),
    ] {
        assert_eq!(tessellation.triangles.len(), 16 * 18);
    }
    assert_eq!(960 * 16 * 18 / 1024, 270);
}

#[test]
fn zones_give_the_triangles_of_the_undivided_grid() {
    let model = models::wave();
    let levels = [4, 3, 2, 4, 4, 5, 3, 4, 4];
    let whole = uniform::at_levels(&model, &levels).unwrap();
    let (zoned, cost) = zones::at_levels(&model, &levels, zones::ZONE_SIZE).unwrap();
    let triangles = |tessellation: &keyleaf_baseline::Tessellation| {
        let corner = |vertex: u32| tessellation.positions[vertex as usize].to_array().map(f64::to_bits);
        let mut all: Vec<_> = tessellation
            .triangles
            .iter()
            .map(|triangle| triangle.map(corner))
            .collect();
        all.sort_unstable();
        all
    };
    assert!(triangles(&whole) == triangles(&zoned));
    assert_eq!(cost.passes, 1);
    assert!(cost.evaluations > whole.positions.len() as u64);

    // One surface of level 6 has (128/4)² zones, of which a pass emits 256.
    let (_, cost) = zones::at_levels(&models::plane(), &[6], zones::ZONE_SIZE).unwrap();
    assert_eq!((cost.zones, cost.passes), (1024, 4));
}

#[test]
fn far_away_only_the_least_is_left() {
    let view = models::far();
    let count = |method: Method, model: &models::Model| {
        method
            .tessellate(model, &view, Quality::Medium)
            .unwrap()
            .triangles
            .len()
    };
    let wave = models::wave();
    assert_eq!(count(Method::UniformPerSurface, &wave), 9 * 18);
    assert_eq!(count(Method::UniformPerKsQuad, &wave), 9 * 2);
    assert_eq!(count(Method::UniformPerKsQuad, &models::bump()), 36 * 2);
    // An octahedron.
    assert_eq!(count(Method::UniformPerKsQuad, &models::sphere()), 8);
    for method in &Method::ALL[2..] {
        assert_eq!(
            count(*method, &wave),
            9 * 18,
            "{method}: one triangle a coarse triangle"
        );
    }
}

#[test]
fn flat_surfaces_keep_their_coarse_triangles() {
    // Even parameters: the distance test compares points of equal parameters.
    let flat = models::Model {
        point: |_, at| DVec3::new(at.x, 2.0 * at.y, 1.0),
        ..models::plane()
    };
    for method in [
        Method::SemiAdaptive(TestKind::Distance),
        Method::SemiAdaptive(TestKind::Flat),
        Method::Dabt(TestKind::Distance),
        Method::Dabt(TestKind::Flat),
    ] {
        assert_eq!(
            method
                .tessellate(&flat, &models::near(), Quality::High)
                .unwrap()
                .triangles
                .len(),
            18,
            "{method}"
        );
    }
}

#[test]
fn counts_fall_with_quality() {
    for model in models::all() {
        for method in Method::ALL {
            let counts = Quality::ALL.map(|quality| {
                method
                    .tessellate(&model, &models::near(), quality)
                    .unwrap()
                    .triangles
                    .len()
            });
            assert!(
                counts[0] >= counts[1] && counts[1] >= counts[2],
                "{} {method}: {counts:?}",
                model.name
            );
            if model.name == "wave" {
                assert!(counts[0] > counts[2], "{method}: {counts:?}");
            }
        }
    }
}

#[test]
fn adaptive_needs_fewer_triangles_than_uniform_at_equal_error() {
    let (model, view) = (models::bump(), models::near());
    for method in ADAPTIVE {
        for quality in Quality::ALL {
            let adaptive = method.tessellate(&model, &view, quality).unwrap();
            let allowed = deviation(&model, &view, &adaptive).unwrap().max_pixels;
            let as_good = (1..=uniform::MAX_LEVEL)
                .map(|level| uniform::at_levels(&model, &[level]).unwrap())
                .find(|uniform| deviation(&model, &view, uniform).unwrap().max_pixels <= allowed)
                .unwrap();
            assert!(
                adaptive.triangles.len() < as_good.triangles.len(),
                "{method} {quality}: {} against {} at {allowed} px",
                adaptive.triangles.len(),
                as_good.triangles.len()
            );
        }
    }
}

#[test]
fn uniform_levels_keep_what_they_promise() {
    let (model, view) = (models::wave(), models::near());
    for pixels in [0.5, 2.0, 8.0] {
        let tessellation = uniform::per_surface(&model, &view, pixels, uniform::MAX_LEVEL).unwrap();
        // The middles of edges are all that is looked at; between them it can be a little more.
        assert!(deviation(&model, &view, &tessellation).unwrap().max_pixels < 1.5 * pixels);
    }
}

#[test]
fn fitted_thresholds_give_the_shares_of_table_4_1() {
    let (model, view) = (models::wave(), models::near());
    for method in ADAPTIVE {
        for quality in Quality::ALL {
            let share = quality.share(method).unwrap();
            let settings = threshold_for_share(&model, &view, method, share).unwrap().unwrap();
            let tessellation = match method {
                Method::Dabt(_) => dabt::tessellate(&model, &view, &settings),
                _ => semi_adaptive::tessellate(&model, &view, &settings),
            };
            let found = tessellation.unwrap().triangles.len() as f64 / (9.0 * 16.0 * 18.0);
            assert!(
                (found - share).abs() < 0.02,
                "{method} {quality}: {found} instead of {share}"
            );
        }
    }
    assert_eq!(
        threshold_for_share(&model, &view, Method::UniformPerKsQuad, 0.5),
        Ok(None)
    );
}

#[test]
fn two_samples_see_an_s_shaped_edge() {
    // One candidate an edge, and it lies on the chord: one sample there would find the edge flat.
    struct Bent;
    impl Sampler for Bent {
        fn surfaces(&self) -> usize {
            1
        }
        fn point(&self, _: usize, at: DVec2) -> DVec3 {
            DVec3::new(at.x, at.y, at.x * (at.x - 0.5) * (at.x - 1.0))
        }
        fn spans(&self, _: usize) -> [Vec<f64>; 2] {
            models::unit()
        }
        fn boundary(&self, _: usize, _: Side) -> Boundary {
            Boundary::Free
        }
    }
    let settings = Settings {
        max_resolution: 1,
        coarse_cells: 1,
        ..Settings::new(Test::Flat {
            cosine: Quality::Low.flat_cosine(),
        })
    };
    // The two sides along u and the diagonal are split, those along v are straight.
    assert_eq!(
        dabt::tessellate(&Bent, &models::near(), &settings)
            .unwrap()
            .triangles
            .len(),
        6
    );
    let distance = Settings {
        test: Test::Distance { pixels: 0.01 },
        ..settings
    };
    assert_eq!(
        dabt::tessellate(&Bent, &models::near(), &distance)
            .unwrap()
            .triangles
            .len(),
        2
    );
}

#[test]
fn deviation_of_an_octahedron_in_a_sphere_is_known() {
    let (model, view) = (models::sphere(), models::far());
    let octahedron = uniform::per_ks_quad(&model, &view, 8.0).unwrap();
    let measured = deviation(&model, &view, &octahedron).unwrap();
    let greatest = 1.0 - 1.0 / 3.0_f64.sqrt();
    assert!(
        (measured.max - greatest).abs() < 1e-3,
        "{measured:?} instead of {greatest}"
    );
    assert!(measured.mean > 0.0 && measured.mean < measured.max);
    assert!((measured.max_pixels - measured.max * 1e-3).abs() < 1e-6);
}

#[test]
fn uneven_parameters_on_a_plane_are_no_deviation() {
    for method in Method::ALL {
        let model = models::plane();
        let tessellation = method.tessellate(&model, &models::near(), Quality::Low).unwrap();
        let inside = deviation(&model, &models::near(), &tessellation).unwrap();
        assert!(inside.max < 5e-3 && inside.mean < 1e-5, "{method}: {inside:?}");
    }
}

#[test]
fn comparison_has_a_finite_row_for_every_method_and_quality() {
    for model in [
        models::wave(),
        models::sphere(),
        models::unlike_knots(),
        models::leaf(),
        models::dot(),
    ] {
        let rows = compare(&model, &models::near()).unwrap();
        assert_eq!(rows.len(), Method::ALL.len() * Quality::ALL.len());
        for row in rows {
            assert!(
                row.max_error_pixels.is_finite() && row.mean_error_pixels <= row.max_error_pixels,
                "{row:?}"
            );
            assert!(row.triangles > 0 || model.name == "dot", "{} {row:?}", model.name);
        }
    }
}
