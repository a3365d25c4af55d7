//! Ways of culling × the size of triangles (Concheiro, tables 6.3 to 6.14).

use super::Shown;
use super::psnr::{self, psnr};
use super::studio::{Setup, Shot, Studio, with_settings};
use crate::output::thousands;
use crate::progress;
use keyleaf::{BackFaces, Metric, View};
use keyleaf_stage::Loaded;
use serde_json::json;

/// µ of the thesis: edges of drawn triangles in pixels.
const PIXELS: [f32; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// Edges of the reference.
const REFERENCE_PIXELS: f32 = 0.5;
/// Room for the finest of them.
const CAPACITY: u32 = 1 << 20;

/// The rows, with the names that the thesis has for them.
const WAYS: [(BackFaces, &str); 6] = [
    (BackFaces::Drawn, "none"),
    (BackFaces::Hidden, "hidden: by the rasteriser"),
    (BackFaces::Strong, "strong: SQC (approximate)"),
    (BackFaces::Light, "light: LQC (approximate)"),
    (BackFaces::Conservative, "conservative: normal cones of faces"),
    (BackFaces::Leaves, "leaves: DC, normal cones of leaves"),
];

/// The picture that others are compared with: fine, nothing culled but by the rasteriser.
pub fn reference(setup: &Setup<'_>, loaded: &Loaded, view: &View, back_faces: BackFaces) -> anyhow::Result<Shot> {
    let fine = with_settings(loaded, |settings| {
        settings.metric = Metric::Edge {
            pixels: REFERENCE_PIXELS,
        };
        settings.back_faces = back_faces;
        settings.capacity = CAPACITY.max(settings.capacity);
    });
    Studio::new(setup, &fine, view)?.look()
}

/// The table of one scene.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, view: &View) -> anyhow::Result<Shown> {
    let bar = progress::bar((WAYS.len() * PIXELS.len()) as u64, "culling", setup.quiet);
    let both_sides = reference(setup, loaded, view, BackFaces::Drawn)?;
    // Of an open surface the insides vanish with any culling: that is the setting, not an error of the way.
    let one_side = reference(setup, loaded, view, BackFaces::Hidden)?;
    let quiet = Setup { quiet: true, ..*setup };
    let mut shots: Vec<Vec<Shot>> = Vec::new();
    for (way, _) in WAYS {
        let start = with_settings(loaded, |settings| {
            settings.metric = Metric::Edge { pixels: PIXELS[0] };
            settings.back_faces = way;
            settings.capacity = CAPACITY.max(settings.capacity);
        });
        let mut studio = Studio::new(&quiet, &start, view)?;
        let mut row = Vec::new();
        for pixels in PIXELS {
            studio.set(|settings| settings.metric = Metric::Edge { pixels })?;
            row.push(studio.shoot()?);
            bar.inc(1);
        }
        shots.push(row);
    }
    bar.finish_and_clear();

    let reference_of = |way: BackFaces| match way {
        BackFaces::Drawn => &both_sides,
        _ => &one_side,
    };
    let mut shown = Shown {
        title: format!("{}: culling", loaded.file.display()),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let names = PIXELS.map(|pixels| format!("{pixels} px"));
    let head: Vec<&str> = ["back faces"]
        .into_iter()
        .chain(names.iter().map(String::as_str))
        .collect();
    let cells = |cell: &dyn Fn(usize, usize) -> String| -> Vec<Vec<String>> {
        let row = |way: usize| (0..PIXELS.len()).map(move |p| cell(way, p));
        (0..WAYS.len())
            .map(|way| [WAYS[way].1.to_owned()].into_iter().chain(row(way)).collect())
            .collect()
    };
    let share = |way: usize, p: usize| 1.0 - shots[way][p].triangles as f64 / shots[0][p].triangles.max(1) as f64;
    let decibels = |way: usize, p: usize| psnr(&shots[way][p].pixels, &reference_of(WAYS[way].0).pixels);
    shown.add(
        "triangles drawn (part culled)",
        &head,
        &cells(&|way, p| {
            let triangles = thousands(shots[way][p].triangles);
            format!("{triangles} ({:.0} %)", 100.0 * share(way, p))
        }),
    );
    shown.add("PSNR in dB", &head, &cells(&|way, p| psnr::cell(decibels(way, p))));
    shown.add(
        "milliseconds a frame",
        &head,
        &cells(&|way, p| format!("{:.2}", shots[way][p].ms)),
    );
    for (way, (back_faces, _)) in WAYS.iter().enumerate() {
        for (p, pixels) in PIXELS.iter().enumerate() {
            let shot = &shots[way][p];
            shown.rows.push(json!({
                "back_faces": back_faces.name(), "approximate": back_faces.is_approximate(), "pixels": pixels,
                "triangles": shot.triangles, "culled": share(way, p), "psnr_db": psnr::value(decibels(way, p)),
                "ms": shot.ms, "starved": shot.starved,
            }));
        }
    }
    Ok(shown)
}
