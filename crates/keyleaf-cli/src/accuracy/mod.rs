//! `keyleaf accuracy`: what accuracy costs.
//!
//! | module | does |
//! |---|---|
//! | `studio` | pictures of a scene at changing settings, with their triangles and times |
//! | `psnr` | how far two pictures are apart |
//! | `culling` | ways of culling × size of the triangles (Concheiro, tables 6.3 to 6.14) |
//! | `methods` | tessellations of the thesis and the quadtree (tables 3.1, 4.1, 6.15) |
//! | `sampler` | a model of patches as the tessellators of `keyleaf-baseline` take it |
//! | `report`, `series` | error against time for every setting, as a page |
//! | `bases` | methods for basis functions × degree |
//! | `isolation` | subdivision surfaces: isolation × preprocessing, memory, error, time (Komar, tables 4.1, 4.6, 4.7) |
//! | `levels` | metrics, base grids and neighbours: leaves, triangles, their sizes (Khoury) |
//! | `quadratic` | QAS, PN triangles and Loop surfaces of one control mesh |
//! | `samples` | points of a surface, and how far the GPU is off there |

mod bases;
mod culling;
mod isolation;
mod levels;
mod methods;
mod psnr;
mod quadratic;
mod report;
mod sampler;
mod samples;
mod series;
mod studio;

use crate::Outcome;
use crate::arguments::{Overrides, ReadingArguments, load_scene, parse_size};
use crate::output;
use crate::session::{self, DeviceReport};
use anyhow::Context;
use clap::{Args, ValueEnum};
use glam::UVec2;
use keyleaf::{Morph, Pairs};
use keyleaf_report::report::Report;
use keyleaf_report::{html, svg, table};
use keyleaf_stage::{Loaded, LoadedObject, view_of};
use serde::Serialize;
use serde_json::json;
use std::path::{Path, PathBuf};
use studio::Setup;

/// Measure what accuracy costs: error, triangles and milliseconds
///
/// With --out a report of every setting of the scenes: error against time, triangles, memory, time by pass, and which settings no other
/// beats, as one HTML page with a .csv of the same name beside it.
///
/// With --suite the tables of a work. The suite concheiro has the tables of Concheiro's thesis with keyleaf's figures, each for the first Bézier or NURBS surface of every
/// scene. culling: triangles, PSNR and milliseconds for ways of culling × edges of 1 to 16 pixels (tables 6.3 to 6.14). methods:
/// uniform, semi-adaptive and DABT tessellations at three qualities, and the quadtree at the same PSNR (tables 3.1, 4.1, 6.15). bases:
/// methods for basis functions × degree, milliseconds and f32 error; it needs no scene.
///
/// The suite komar is for subdivision surfaces: isolation of extraordinary vertices × preprocessing, memory, error and milliseconds (tables
/// 4.1, 4.6, 4.7). The suite qas is for control meshes of triangles: QAS, PN triangles and Loop surfaces of the first one of each
/// scene, against the limit. The suite khoury is for any surface: the screen-space and the distance metric with as many triangles, base
/// grids, and what it costs that nothing cracks.
///
/// PSNR is of the picture against one with edges of half a pixel and nothing culled. Milliseconds are the median of a frame that
/// updates and draws.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf accuracy scenes/torus.ron --out report.html --quick
  keyleaf accuracy scenes/goblet.ron --suite concheiro
  keyleaf accuracy scenes/torus.ron scenes/panels.ron --suite concheiro --table culling --size 1280x720
  keyleaf accuracy --suite concheiro --table bases --json
  keyleaf accuracy scenes/gaussian.ron --suite komar
  keyleaf accuracy scenes/qas.ron --suite qas
  keyleaf accuracy scenes/fox.ron --suite khoury")]
pub struct Arguments {
    /// Scene files or models with surfaces of the kind that the suite is about
    #[arg(value_name = "SCENE", required_unless_present = "table")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    reading: ReadingArguments,
    /// The report: .html, with a .csv beside it
    #[arg(
        long,
        value_name = "FILE",
        required_unless_present = "suite",
        conflicts_with = "suite"
    )]
    out: Option<PathBuf>,
    /// A folder for the figures of the report, each as an .svg
    #[arg(long, value_name = "FOLDER", requires = "out")]
    figures: Option<PathBuf>,
    /// Few settings and samples: minutes instead of an hour on a software device
    #[arg(long, requires = "out")]
    quick: bool,
    /// The tables of a work
    #[arg(long, value_enum, value_name = "NAME")]
    suite: Option<Suite>,
    /// One table of the suite concheiro [default: all]
    #[arg(long, value_enum, value_name = "TABLE")]
    table: Option<Table>,
    /// A camera of the scenes by its name; default: the first one
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Size of the pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "640x480")]
    size: UVec2,
    /// Frames that are timed
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// Tables of a work.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
enum Suite {
    /// Parametric surfaces on the GPU (thesis, A Coruña 2013)
    Concheiro,
    /// Gaussian-product subdivision surfaces (thesis, 2020); for all subdivision surfaces
    Komar,
    /// Quadratic approximation of subdivision surfaces (Boubekeur and Schlick 2007)
    Qas,
    /// GPU tessellation with compute shaders (thesis, 2018)
    Khoury,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
enum Table {
    Culling,
    Methods,
    Bases,
}

/// A table: what it shows, its columns and rows, and the same for machines.
#[derive(Serialize)]
struct Shown {
    title: String,
    #[serde(skip)]
    text: Vec<(String, String)>,
    rows: Vec<serde_json::Value>,
}

impl Shown {
    /// Adds a part of the text: a heading, and a table.
    fn add(&mut self, heading: &str, head: &[&str], rows: &[Vec<String>]) {
        self.text.push((heading.to_owned(), table::format(head, rows)));
    }

    fn print(&self) -> anyhow::Result<()> {
        output::print(&format!("\n{}", self.title))?;
        for (heading, text) in &self.text {
            output::print(&format!("\n{heading}\n{text}"))?;
        }
        Ok(())
    }
}

/// Opens a scene whose vertices lie on the surface, and where only those leaves are pairs that must be: what morphing costs and what pairs
/// save are series of their own.
fn load_still(file: &Path, reading: &ReadingArguments, quiet: bool) -> anyhow::Result<Loaded> {
    let still = Overrides {
        morph: Some(Morph::None),
        pairs: Some(Pairs::Forced),
        ..Overrides::default()
    };
    load_scene(file, reading, &still, quiet)
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let Some(suite) = arguments.suite else {
        return write_report(arguments, quiet);
    };
    let wants = |table: Table| suite == Suite::Concheiro && arguments.table.is_none_or(|only| only == table);
    anyhow::ensure!(
        suite == Suite::Concheiro || arguments.table.is_none(),
        "--table: only the suite concheiro has several"
    );
    // Bad input first: a device takes time to start.
    let scenes = arguments.scenes.iter().map(|file| {
        let loaded = load_still(file, &arguments.reading, quiet)?;
        let camera = loaded.camera(arguments.camera.as_deref())?.name.clone();
        Ok((shown_of(suite, loaded)?, camera))
    });
    let scenes: Vec<(Loaded, String)> = scenes.collect::<anyhow::Result<_>>()?;
    anyhow::ensure!(
        !scenes.is_empty() || arguments.table == Some(Table::Bases),
        "--table: expected a SCENE, which only the table bases does without"
    );
    let gpu = session::device()?;
    let device = DeviceReport::new(&gpu);
    let effort = report::Effort { quick: arguments.quick };
    let setup = Setup {
        gpu: &gpu,
        size: arguments.size,
        frames: arguments.frames,
        timed: effort.timed(),
        quiet,
    };
    let mut tables = Vec::new();
    let mut done = |shown: Shown| {
        if !arguments.json {
            shown.print()?;
        }
        tables.push(shown);
        anyhow::Ok(())
    };
    for (loaded, camera) in &scenes {
        let view = loaded.view(Some(camera), arguments.size)?;
        if wants(Table::Culling) {
            done(culling::table(&setup, loaded, &view)?)?;
        }
        if wants(Table::Methods) {
            done(methods::table(&setup, loaded, &view)?)?;
        }
        if suite == Suite::Komar {
            done(isolation::table(&setup, loaded, &view)?)?;
        }
        if suite == Suite::Khoury {
            done(levels::table(&setup, loaded, &view)?)?;
        }
        if suite == Suite::Qas {
            done(quadratic::table(&setup, loaded, &loaded.objects[0], &view)?)?;
        }
    }
    if wants(Table::Bases) {
        let view = view_of(&bases::view(), arguments.size);
        done(bases::table(&setup, &view)?)?;
    }
    if arguments.json {
        output::print_json(&json!({
            "device": device.device, "driver": device.driver, "backend": device.backend, "software": device.software,
            "times": device.times, "size": arguments.size.to_array(), "frames": arguments.frames, "tables": tables,
        }))?;
    } else {
        output::print(&format!("\n{}, times {}", device.device, device.times))?;
    }
    Ok(Outcome::Done)
}

/// The report of all settings.
fn write_report(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let Some(out) = &arguments.out else {
        anyhow::bail!("expected --out or --suite");
    };
    let csv = out.with_extension("csv");
    if let Some(folder) = &arguments.figures {
        std::fs::create_dir_all(folder).with_context(|| format!("{}: cannot be made", folder.display()))?;
    }
    output::ensure_writable(out)?;
    output::ensure_writable(&csv)?;
    anyhow::ensure!(
        output::extension(out) == "html",
        "{}: expected the name of an .html file",
        out.display()
    );
    let load = |file: &PathBuf| load_still(file, &arguments.reading, quiet);
    let scenes: Vec<Loaded> = arguments.scenes.iter().map(load).collect::<anyhow::Result<_>>()?;
    let gpu = session::device()?;
    let effort = report::Effort { quick: arguments.quick };
    let setup = Setup {
        gpu: &gpu,
        size: arguments.size,
        frames: arguments.frames,
        timed: effort.timed(),
        quiet,
    };
    let mut page = report::empty(&setup, effort);
    let mut failed = Vec::new();
    for loaded in &scenes {
        let camera = loaded.camera(arguments.camera.as_deref())?.name.clone();
        let view = loaded.view(Some(&camera), arguments.size)?;
        let scene = report::scene(&setup, loaded, &camera, &view, effort);
        match scene.with_context(|| loaded.file.display().to_string()) {
            Ok(scene) => page.scenes.push(scene),
            Err(error) => failed.push(format!("{error:#}")),
        }
    }
    page.notes
        .extend(failed.iter().map(|error| format!("Not measured: {error}.")));
    report::add_scaling(&mut page);
    output::write(out, html::page(&page).as_bytes())?;
    output::write(&csv, page.csv().as_bytes())?;
    if let Some(folder) = &arguments.figures {
        write_figures(folder, &page)?;
    }
    if arguments.json {
        output::print_json(&page)?;
    } else {
        let points: usize = page.scenes.iter().map(|scene| scene.points.len()).sum();
        output::print(&format!(
            "{}: {points} settings of {} scenes; {}: their figures",
            out.display(),
            page.scenes.len(),
            csv.display()
        ))?;
    }
    anyhow::ensure!(
        failed.is_empty(),
        "{}; the report has the other scenes",
        failed.join("; ")
    );
    Ok(Outcome::Done)
}

/// Each figure of each scene, named after both.
fn write_figures(folder: &Path, page: &Report) -> anyhow::Result<()> {
    for scene in &page.scenes {
        for figure in html::figures(scene) {
            let words: Vec<String> = format!("{} {}", scene.name, figure.title)
                .split(|c: char| !c.is_ascii_alphanumeric())
                .filter(|word| !word.is_empty())
                .map(str::to_ascii_lowercase)
                .collect();
            let file = folder.join(words.join("_")).with_extension("svg");
            output::write(&file, svg::standalone(&figure.svg).as_bytes())?;
        }
    }
    Ok(())
}

/// The scene with the surfaces that a suite is about.
fn shown_of(suite: Suite, mut loaded: Loaded) -> anyhow::Result<Loaded> {
    let (is_wanted, what): (fn(&LoadedObject) -> bool, _) = match suite {
        Suite::Concheiro => return patches_of(loaded),
        Suite::Komar => (
            isolation::has_isolation,
            "subdivision surface; expected one for the suite komar",
        ),
        Suite::Qas => (
            quadratic::is_of_triangles,
            "control mesh of triangles; expected one for the suite qas",
        ),
        Suite::Khoury => (|_| true, "surface"),
    };
    loaded.objects.retain(is_wanted);
    if suite == Suite::Qas {
        loaded.objects.truncate(1);
    }
    anyhow::ensure!(!loaded.objects.is_empty(), "{}: has no {what}", loaded.file.display());
    Ok(loaded)
}

/// The scene with its first Bézier or NURBS surface alone.
fn patches_of(mut loaded: Loaded) -> anyhow::Result<Loaded> {
    let found = loaded.objects.iter().position(|o| o.surface.as_patches().is_some());
    let Some(found) = found else {
        anyhow::bail!(
            "{}: has no Bézier or NURBS surface; expected one for the suite concheiro",
            loaded.file.display()
        );
    };
    loaded.objects = vec![loaded.objects.swap_remove(found)];
    Ok(loaded)
}
