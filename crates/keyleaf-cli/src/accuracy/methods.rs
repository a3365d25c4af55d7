//! Tessellations of the thesis, and the quadtree at the same PSNR (Concheiro, tables 3.1, 4.1 and 6.15).

use super::Shown;
use super::culling::reference;
use super::psnr::{self, psnr};
use super::sampler::{PatchSampler, object_of};
use super::studio::{Setup, Studio, with_object, with_settings};
use crate::output::thousands;
use crate::progress;
use anyhow::Context;
use keyleaf::draw::Attribute;
use keyleaf::{BackFaces, Metric, Pairs, Projection, Threshold, View};
use keyleaf_baseline::{Deviation, Method, Quality, deviation};
use keyleaf_stage::{Loaded, Pipelines};
use serde_json::json;

/// A way to refine the quadtree.
struct Refined {
    name: &'static str,
    metric: fn(f32) -> Metric,
    /// The finest and the coarsest threshold in pixels.
    range: [f32; 2],
}

/// By a bound of the distance to the surface, by that distance as sampled at one point and at two of each edge, and by length.
const METRICS: [Refined; 4] = [
    Refined {
        name: "deviation",
        metric: |pixels| Metric::Deviation { pixels },
        range: [1.0 / 32.0, 32.0],
    },
    Refined {
        name: "distance test",
        metric: |pixels| Metric::DistanceTest(Threshold::Pixels(pixels)),
        range: [1.0 / 32.0, 32.0],
    },
    Refined {
        name: "flat test",
        metric: |pixels| Metric::FlatTest(Threshold::Pixels(pixels)),
        range: [1.0 / 32.0, 32.0],
    },
    Refined {
        name: "edge",
        metric: |pixels| Metric::Edge { pixels },
        range: [1.0, 128.0],
    },
];

/// Thresholds an octave.
const STEPS: u32 = 2;

/// PSNR and triangles of the quadtree, from coarse to fine.
struct Curve(Vec<[f64; 2]>);

impl Curve {
    /// Until the PSNR is as high as that, or the threshold as fine as it goes.
    fn of(
        setup: &Setup<'_>,
        scene: &Loaded,
        view: &View,
        refined: &Refined,
        reference: &[u8],
        highest: f64,
    ) -> anyhow::Result<Self> {
        let (metric, [fine, coarse]) = (refined.metric, refined.range);
        let start = with_settings(scene, |settings| {
            settings.metric = metric(coarse);
            settings.base_grid = 0; // a triangle a leaf
            settings.pairs = Pairs::Wished;
            settings.target_leaves = 0;
            settings.capacity = settings.capacity.max(1 << 20);
        });
        let mut studio = Studio::new(setup, &start, view)?;
        let steps = (coarse / fine).log2() as u32 * STEPS;
        let mut points = Vec::new();
        for step in 0..=steps {
            let pixels = coarse * (-(step as f32) / STEPS as f32).exp2();
            studio.set(|settings| settings.metric = metric(pixels))?;
            let shot = studio.look()?;
            let decibels = psnr(&shot.pixels, reference);
            points.push([decibels, shot.triangles as f64]);
            if decibels >= highest {
                break;
            }
        }
        Ok(Self(points))
    }

    /// Triangles for a PSNR, between two points of the curve; those of its coarse end where even that is better, none where the PSNR is
    /// beyond its fine end.
    fn triangles(&self, decibels: f64) -> Option<f64> {
        if let Some(&[coarsest, triangles]) = self.0.first()
            && decibels < coarsest
        {
            return Some(triangles);
        }
        let between = |pair: &[[f64; 2]]| -> Option<f64> {
            let ([a, few], [b, many]) = (pair[0], pair[1]);
            let part = (decibels - a) / (b - a);
            (0.0..=1.0).contains(&part).then(|| few * (many / few).powf(part))
        };
        self.0.windows(2).find_map(between)
    }
}

/// What a method made of the model.
struct Made {
    quality: Quality,
    method: Method,
    triangles: u64,
    deviation: Deviation,
    /// Of its picture, none where it has more triangles than the device takes.
    decibels: Option<f64>,
}

/// Bytes of the largest buffer of a mesh, a triangle: attributes of its corners and its own.
const BYTES_OF_TRIANGLE: u64 = 4 * size_of::<Attribute>() as u64;

/// All methods at all qualities.
fn tessellations(
    setup: &Setup<'_>,
    loaded: &Loaded,
    view: &View,
    sampler: &PatchSampler<'_>,
    reference: &[u8],
) -> anyhow::Result<Vec<Made>> {
    let seen = seen_from(loaded, view, setup)?;
    let quiet = Setup { quiet: true, ..*setup };
    let mut pipelines = Pipelines::default();
    let limit = setup.gpu.device.limits().max_storage_buffer_binding_size;
    let bar = progress::bar((Quality::ALL.len() * Method::ALL.len()) as u64, "methods", setup.quiet);
    let mut made = Vec::new();
    for quality in Quality::ALL {
        for method in Method::ALL {
            let tessellation = method.tessellate(sampler, &seen, quality)?;
            let triangles = tessellation.triangles.len() as u64;
            let decibels = if triangles * BYTES_OF_TRIANGLE <= limit {
                let drawn = with_object(loaded, object_of(&loaded.objects[0], sampler, &tessellation)?);
                let mut studio = Studio::with_pipelines(&quiet, &drawn, view, &mut pipelines)?;
                Some(psnr(&studio.look()?.pixels, reference))
            } else {
                None
            };
            made.push(Made {
                quality,
                method,
                triangles,
                deviation: deviation(sampler, &seen, &tessellation)?,
                decibels,
            });
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(made)
}

/// The table of one scene.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, view: &View) -> anyhow::Result<Shown> {
    let object = &loaded.objects[0];
    let patches = object
        .surface
        .as_patches()
        .context("the surface is no model of patches")?;
    let sampler = PatchSampler::new(patches);
    let back_faces = object.settings.back_faces;
    let fine = reference(setup, loaded, view, back_faces)?;
    let quiet = Setup { quiet: true, ..*setup };
    let made = tessellations(setup, loaded, view, &sampler, &fine.pixels)?;
    let highest = made.iter().filter_map(|made| made.decibels).fold(0.0, f64::max);
    let mut curves = Vec::new();
    let bar = progress::bar(METRICS.len() as u64, "quadtree", setup.quiet);
    for refined in &METRICS {
        let curve = Curve::of(&quiet, loaded, view, refined, &fine.pixels, highest)?;
        curves.push((refined.name, curve));
        bar.inc(1);
    }
    bar.finish_and_clear();

    let mut shown = Shown {
        title: format!("{}: tessellations", loaded.file.display()),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let mut rows = Vec::new();
    for made in &made {
        let mut row = vec![
            made.quality.to_string(),
            made.method.to_string(),
            thousands(made.triangles),
            format!("{:.3}", made.deviation.max_pixels),
            made.decibels.map_or_else(|| "-".to_owned(), psnr::cell),
        ];
        let mut equal = serde_json::Map::new();
        for (name, curve) in &curves {
            let found = made.decibels.and_then(|decibels| curve.triangles(decibels));
            let ratio = found.map(|found| made.triangles as f64 / found);
            let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
            row.push(or_dash(found.map(|found| thousands(found.round() as u64))));
            row.push(or_dash(ratio.map(|ratio| format!("{ratio:.2}"))));
            equal.insert((*name).to_owned(), json!({ "triangles": found, "ratio": ratio }));
        }
        rows.push(row);
        shown.rows.push(json!({
            "quality": made.quality.to_string(), "method": made.method.to_string(), "triangles": made.triangles,
            "max_error_pixels": made.deviation.max_pixels, "mean_error_pixels": made.deviation.mean_pixels,
            "psnr_db": made.decibels.map(psnr::value), "quadtree": equal,
        }));
    }
    let side = if back_faces == BackFaces::Drawn {
        "both sides drawn"
    } else {
        "one side drawn"
    };
    let quadtrees: Vec<String> = METRICS
        .iter()
        .map(|refined| format!("quadtree, {}", refined.name))
        .collect();
    let curves = quadtrees.iter().flat_map(|name| [name.as_str(), "times fewer"]);
    let head: Vec<&str> = ["quality", "method", "triangles", "error px", "PSNR dB"]
        .into_iter()
        .chain(curves)
        .collect();
    shown.add(
        &format!(
            "triangles of each method, and of the quadtree at the same PSNR, with how many times fewer that is; {side}; the quadtree leaves out what the scene says"
        ),
        &head,
        &rows,
    );
    Ok(shown)
}

/// The eye as the tessellators take it, in object space.
fn seen_from(loaded: &Loaded, view: &View, setup: &Setup<'_>) -> anyhow::Result<keyleaf_baseline::View> {
    let Projection::Perspective { fov_y, near } = view.projection else {
        anyhow::bail!("the tessellations of the thesis need a perspective camera");
    };
    let to_object = loaded.objects[0].world_from_object.inverse();
    let scale = to_object.matrix3.determinant().abs().cbrt();
    Ok(keyleaf_baseline::View {
        eye: to_object.transform_point3(view.eye),
        pixels_per_radian: f64::from(setup.size.y) / 2.0 / (fov_y / 2.0).tan(),
        near: near * scale,
    })
}

#[cfg(test)]
mod tests {
    use super::Curve;

    #[test]
    fn triangles_between_two_points_of_the_curve_go_by_their_logarithm() {
        let curve = Curve(vec![[30.0, 100.0], [40.0, 10_000.0], [50.0, 20_000.0]]);
        assert_eq!(curve.triangles(35.0).map(f64::round), Some(1000.0));
        assert_eq!(curve.triangles(50.0), Some(20_000.0));
        assert_eq!((curve.triangles(29.0), curve.triangles(51.0)), (Some(100.0), None));
    }
}
