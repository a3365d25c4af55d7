//! Khoury's pipeline: what a metric and its factor make of a scene (Khoury 2018, figures 4.5 to 4.7 in numbers), and what it costs that
//! nothing cracks.

use super::Shown;
use super::series::gridded;
use super::studio::{Setup, Studio, screen_of, with_settings};
use crate::output::thousands;
use crate::progress;
use crate::timing::TimedFrame;
use glam::DVec2;
use keyleaf::{Balance, Metric, Settings, View};
use keyleaf_report::error::ScreenView;
use keyleaf_report::run::Series;
use keyleaf_stage::{Drawn, Loaded, drawn};
use serde_json::json;

/// Edges of drawn triangles in pixels, from coarse to fine.
const PIXELS: [f32; 4] = [32.0, 16.0, 8.0, 4.0];
/// Edges at which everything else is compared.
const COMPARED: f32 = 8.0;
const GRIDS: [u32; 4] = [0, 1, 2, 3];
/// Steps to the factor that draws as many triangles.
const STEPS: u32 = 8;
/// Room for the finest of them.
const CAPACITY: u32 = 1 << 19;

/// Sizes of the triangles in the picture.
struct Areas {
    /// Pixels.
    mean: f64,
    /// The standard deviation over the mean.
    variation: f64,
}

impl Areas {
    /// Of the triangles that lie in the picture as a whole.
    fn of(drawn: &Drawn, view: &ScreenView) -> Self {
        let corner = |index: u32| view.pixel(drawn.vertices[index as usize].position);
        let inside = |p: DVec2| view.contains(p).then_some(p);
        let area = |triangle: &[u32; 3]| -> Option<f64> {
            let [a, b, c] = triangle.map(|index| corner(index).and_then(inside));
            let (a, b, c) = (a?, b?, c?);
            Some((b - a).perp_dot(c - a).abs() / 2.0)
        };
        let areas: Vec<f64> = drawn.triangles.iter().filter_map(area).collect();
        let count = areas.len().max(1) as f64;
        let mean = areas.iter().sum::<f64>() / count;
        let variance = areas.iter().map(|area| (area - mean).powi(2)).sum::<f64>() / count;
        Self {
            mean,
            variation: variance.sqrt() / mean.max(f64::MIN_POSITIVE),
        }
    }
}

/// What a setting made of the scene.
struct Row {
    name: String,
    value: String,
    leaves: u32,
    /// The coarsest and the finest level of what is drawn.
    levels: [u32; 2],
    triangles: u64,
    /// The part of the triangles that stands for two leaves, so that no T-junction is left.
    pairs: f64,
    areas: Areas,
    starved: u32,
    update_ms: f64,
    draw_ms: f64,
}

impl Row {
    fn cells(&self) -> Vec<String> {
        let [coarsest, finest] = self.levels;
        vec![
            self.name.clone(),
            self.value.clone(),
            thousands(u64::from(self.leaves)),
            format!("{coarsest} to {finest}"),
            thousands(self.triangles),
            format!("{:.1} %", 100.0 * self.pairs),
            format!("{:.2}", self.areas.mean),
            format!("{:.2}", self.areas.variation),
            format!("{:.2}", self.update_ms),
            format!("{:.2}", self.draw_ms),
        ]
    }

    fn json(&self) -> serde_json::Value {
        json!({
            "setting": self.name, "value": self.value, "leaves": self.leaves, "levels": self.levels,
            "triangles": self.triangles, "pairs": self.pairs, "area_pixels": self.areas.mean,
            "area_variation": self.areas.variation, "starved": self.starved, "update_ms": self.update_ms,
            "draw_ms": self.draw_ms,
        })
    }
}

const HEAD: [&str; 10] = [
    "setting",
    "value",
    "leaves",
    "levels",
    "triangles",
    "pairs",
    "px² a triangle",
    "variation",
    "update ms",
    "draw ms",
];

/// One scene, whose first surface is measured.
struct Measuring<'a> {
    setup: &'a Setup<'a>,
    loaded: &'a Loaded,
    view: &'a View,
    screen: ScreenView,
}

impl Measuring<'_> {
    fn studio(&self, change: impl Fn(&mut Settings)) -> anyhow::Result<Studio<'_>> {
        let changed = with_settings(self.loaded, |settings| {
            settings.metric = Metric::Edge { pixels: COMPARED };
            settings.target_leaves = 0;
            settings.capacity = settings.capacity.max(CAPACITY);
            change(settings);
        });
        Studio::new(self.setup, &changed, self.view)
    }

    /// The present setting of a studio.
    fn row(&self, studio: &mut Studio<'_>, name: &str, value: String) -> anyhow::Result<Row> {
        let film = studio.film()?;
        let median = |value: fn(&TimedFrame) -> f64| Series::new(film.frames.iter().map(value)).p50;
        let quadtree = &studio.stage().objects[0].quadtree;
        let snapshot = quadtree.read_back(&self.setup.gpu.device, &self.setup.gpu.queue)?;
        let slots = || snapshot.visible.iter().map(|&slot| slot as usize);
        let levels = || slots().map(|slot| snapshot.leaves[slot].place().level);
        let pairs = slots().filter(|&slot| snapshot.is_pair(slot)).count();
        Ok(Row {
            name: name.to_owned(),
            value,
            leaves: snapshot.statistics.leaves,
            levels: [levels().min().unwrap_or(0), levels().max().unwrap_or(0)],
            triangles: snapshot.statistics.triangles,
            pairs: pairs as f64 / snapshot.visible.len().max(1) as f64,
            areas: Areas::of(&drawn(self.setup.gpu, quadtree)?, &self.screen),
            starved: snapshot.statistics.starved,
            update_ms: median(|frame| frame.update.ms),
            draw_ms: median(|frame| frame.draw.unwrap_or_default().ms),
        })
    }

    /// Each edge, then the distance metric with the factor that draws as many triangles.
    fn metrics(&self, done: &dyn Fn()) -> anyhow::Result<Vec<Row>> {
        let mut studio = self.studio(|_| ())?;
        let mut rows = Vec::new();
        for pixels in PIXELS {
            studio.set(|settings| settings.metric = Metric::Edge { pixels })?;
            rows.push(self.row(&mut studio, "edge", format!("{pixels} px"))?);
            done();
        }
        let (low, high) = self.loaded.bounds;
        let mut factor = (high - low).length() as f32 / 16.0;
        // Another metric is another shader.
        let mut studio = self.studio(|settings| settings.metric = Metric::Distance { factor })?;
        for edge in 0..PIXELS.len() {
            factor = self.factor_for(&mut studio, factor, rows[edge].triangles)?;
            let value = format!("factor {factor:.3}, as many");
            rows.push(self.row(&mut studio, "distance", value)?);
            done();
        }
        Ok(rows)
    }

    /// The factor of the distance metric that draws about so many triangles, which grow with its square; it is set in the end.
    fn factor_for(&self, studio: &mut Studio<'_>, start: f32, triangles: u64) -> anyhow::Result<f32> {
        let wanted = triangles.max(1) as f32;
        let mut factor = start;
        for _ in 0..STEPS {
            studio.set(|settings| settings.metric = Metric::Distance { factor })?;
            let ratio = wanted / studio.look()?.triangles.max(1) as f32;
            if (ratio - 1.0).abs() < 0.03 {
                break;
            }
            factor *= ratio.sqrt().clamp(0.125, 8.0);
        }
        studio.set(|settings| settings.metric = Metric::Distance { factor })?;
        Ok(factor)
    }

    fn grids(&self, done: &dyn Fn()) -> anyhow::Result<Vec<Row>> {
        let mut rows = Vec::new();
        for k in GRIDS {
            let mut studio = self.studio(|settings| gridded(settings, k))?;
            rows.push(self.row(&mut studio, "base grid", format!("4^{k}"))?);
            done();
        }
        for (balance, value) in [(Balance::Table, "kept"), (Balance::Off, "off: cracks")] {
            let mut studio = self.studio(|settings| settings.balance = balance)?;
            rows.push(self.row(&mut studio, "neighbours", value.to_owned())?);
            done();
        }
        Ok(rows)
    }
}

/// The tables of one scene.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, view: &View) -> anyhow::Result<Shown> {
    let bar = progress::bar((2 * PIXELS.len() + GRIDS.len() + 2) as u64, "levels", setup.quiet);
    let quiet = Setup { quiet: true, ..*setup };
    let measuring = Measuring {
        setup: &quiet,
        loaded,
        view,
        screen: screen_of(setup, view, &loaded.objects[0]),
    };
    let metrics = measuring.metrics(&|| bar.inc(1))?;
    let grids = measuring.grids(&|| bar.inc(1))?;
    bar.finish_and_clear();
    let mut shown = Shown {
        title: format!("{}: levels of detail", loaded.file.display()),
        text: Vec::new(),
        rows: metrics.iter().chain(&grids).map(Row::json).collect(),
    };
    let cells = |rows: &[Row]| -> Vec<Vec<String>> { rows.iter().map(Row::cells).collect() };
    shown.add(
        "screen-space and distance metric, with as many triangles; pairs: drawn as one triangle against T-junctions; variation: standard \
         deviation over mean of the triangles' areas in the picture",
        &HEAD,
        &cells(&metrics),
    );
    shown.add("edges of 8 px", &HEAD, &cells(&grids));
    Ok(shown)
}
