//! Tessellations of the thesis, and the quadtree at the same PSNR (Concheiro, tables 3.1, 4.1 and 6.15).

use super::Shown;
use super::culling::reference;
use super::psnr::{self, psnr};
use super::sampler::{PatchSampler, object_of};
use super::studio::{Setup, Studio, with_object, with_settings};
use crate::output::thousands;
use crate::progress;
use anyhow::Context;
use keyleaf::{BackFaces, Metric, Projection, View};
use keyleaf_baseline::{Method, Quality, deviation};
use keyleaf_stage::Loaded;
use serde_json::json;

/// Thresholds of the quadtree in pixels between which the one of equal PSNR is looked for.
const RANGE: [f32; 2] = [1.0 / 64.0, 64.0];
/// Halvings of that range, by its logarithm: within 1.3 %.
const HALVINGS: u32 = 9;

/// How the quadtree is refined: by the distance to the surface, or by length.
const METRICS: [(&str, fn(f32) -> Metric); 2] = [
    ("deviation", |pixels| Metric::Deviation { pixels }),
    ("edge", |pixels| Metric::Edge { pixels }),
];

/// The quadtree at one quality: found by its threshold.
struct Match {
    pixels: f32,
    triangles: u64,
    decibels: f64,
}

/// The table of one scene.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, view: &View) -> anyhow::Result<Shown> {
    let object = &loaded.objects[0];
    let patches = object
        .surface
        .as_patches()
        .context("the surface is no model of patches")?;
    let sampler = PatchSampler(patches);
    let seen = seen_from(loaded, view, setup)?;
    let back_faces = object.settings.back_faces;
    let fine = reference(setup, loaded, view, back_faces)?;
    let quiet = Setup { quiet: true, ..*setup };
    let mut quadtrees = Vec::new();
    for (name, metric) in METRICS {
        let start = with_settings(loaded, |settings| {
            settings.metric = metric(RANGE[1]);
            settings.base_grid = 1;
            settings.capacity = settings.capacity.max(1 << 20);
        });
        quadtrees.push((name, metric, Studio::new(&quiet, &start, view)?));
    }

    let steps = (Quality::ALL.len() * Method::ALL.len()) as u64;
    let bar = progress::bar(steps, "methods", setup.quiet);
    let mut shown = Shown {
        title: format!("{}: tessellations", loaded.file.display()),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let mut rows = Vec::new();
    for quality in Quality::ALL {
        for method in Method::ALL {
            let tessellation = method.tessellate(&sampler, &seen, quality)?;
            let measured = deviation(&sampler, &seen, &tessellation)?;
            let drawn = with_object(loaded, object_of(object, &sampler, &tessellation)?);
            let decibels = psnr(&Studio::new(&quiet, &drawn, view)?.look()?.pixels, &fine.pixels);
            let triangles = tessellation.triangles.len() as u64;
            let mut row = vec![
                quality.to_string(),
                method.to_string(),
                thousands(triangles),
                format!("{:.3}", measured.max_pixels),
                psnr::cell(decibels),
            ];
            let mut equal = serde_json::Map::new();
            for (name, metric, studio) in &mut quadtrees {
                let found = of_equal_psnr(studio, *metric, decibels, &fine.pixels)?;
                let ratio = triangles as f64 / found.triangles.max(1) as f64;
                row.extend([thousands(found.triangles), format!("{ratio:.2}")]);
                equal.insert(
                    (*name).to_owned(),
                    json!({ "pixels": found.pixels, "triangles": found.triangles, "psnr_db": psnr::value(found.decibels), "ratio": ratio }),
                );
            }
            rows.push(row);
            shown.rows.push(json!({
                "quality": quality.to_string(), "method": method.to_string(), "triangles": triangles,
                "max_error_pixels": measured.max_pixels, "mean_error_pixels": measured.mean_pixels,
                "psnr_db": psnr::value(decibels), "quadtree": equal,
            }));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let side = if back_faces == BackFaces::Drawn {
        "both sides drawn"
    } else {
        "one side drawn"
    };
    shown.add(
        &format!("triangles of each method, and of the quadtree at the same PSNR with how many times fewer; {side}"),
        &[
            "quality",
            "method",
            "triangles",
            "error px",
            "PSNR dB",
            "quadtree, deviation",
            "times fewer",
            "quadtree, edge",
            "times fewer",
        ],
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

/// The coarsest quadtree whose picture is at least as close to the reference.
fn of_equal_psnr(
    studio: &mut Studio<'_>,
    metric: fn(f32) -> Metric,
    decibels: f64,
    reference: &[u8],
) -> anyhow::Result<Match> {
    let mut at = |pixels: f32| -> anyhow::Result<Match> {
        studio.set(|settings| settings.metric = metric(pixels))?;
        let shot = studio.look()?;
        Ok(Match {
            pixels,
            triangles: shot.triangles,
            decibels: psnr(&shot.pixels, reference),
        })
    };
    let [mut fine, mut coarse] = RANGE;
    let mut best = None;
    for _ in 0..HALVINGS {
        let middle = (fine * coarse).sqrt();
        let found = at(middle)?;
        if found.decibels >= decibels {
            fine = middle;
            best = Some(found);
        } else {
            coarse = middle;
        }
    }
    match best {
        Some(best) => Ok(best),
        None => at(fine),
    }
}
