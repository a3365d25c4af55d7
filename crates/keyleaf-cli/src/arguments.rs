//! What several commands take, and how it is read.

use anyhow::{Context, bail, ensure};
use clap::{Args, ValueEnum};
use glam::{DVec3, UVec2};
use keyleaf::{BackFaces, Metric, Morph, Pairs, Settings, Threshold, View};
use keyleaf_scene::scene::ShapeName;
use keyleaf_stage::{LoadOptions, Loaded, load, view_of};
use std::path::{Path, PathBuf};

/// What is opened.
#[derive(Args, Clone)]
pub struct SceneArguments {
    /// Scene file, model or height map
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    #[command(flatten)]
    pub reading: ReadingArguments,
    #[command(flatten)]
    pub overrides: Overrides,
}

/// How a file is read that cannot tell itself.
#[derive(Args, Clone)]
pub struct ReadingArguments {
    /// Samples of a raw height map (.r16) that is opened directly; default: a square one
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub raw_size: Option<UVec2>,
    /// Draw trimmed NURBS surfaces of a file whole, that is opened directly; else they are refused
    #[arg(long)]
    pub ignore_trims: bool,
    /// Cut the knot spans of NURBS surfaces of a file that is opened directly where knot-span quads are long and narrow
    #[arg(long)]
    pub even_spans: bool,
    /// What a model of polygons that is opened directly is drawn as: flat, catmull-clark, loop, qas, pn or gaussian-product
    #[arg(long, value_name = "SHAPE")]
    pub surface: Option<ShapeName>,
    /// The axis that is up in a file that is opened directly: with z it is turned by -90 degrees about X
    #[arg(long, value_name = "AXIS", value_enum, default_value = "y")]
    pub up: Up,
}

/// An axis.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// As keyleaf has it
    Y,
    /// As CAD programs have it
    Z,
}

/// What replaces the settings of the scene, for all its surfaces.
#[derive(Args, Clone, Default)]
pub struct Overrides {
    /// Length of a drawn edge in pixels that leaves are split for; short for --metric edge=P, or boundary=P,P/n where boundaries are finer
    #[arg(long, value_name = "P", conflicts_with = "metric", allow_negative_numbers = true)]
    pub pixels: Option<f32>,
    /// When leaves split: edge=PIXELS, distance=FACTOR (Khoury 2.1), deviation=PIXELS, or a test of Concheiro's thesis:
    /// boundary=PIXELS,PIXELS (elsewhere, at open boundaries), local-area=PIXELS, linear-approximation=PIXELS, and distance-test,
    /// flat-test, length-test=VALUE in their own unit, or in pixels as 2px
    #[arg(long, value_name = "METRIC", value_parser = parse_metric)]
    pub metric: Option<Metric>,
    /// Triangles seen from behind: drawn, hidden, leaves (whole leaves left out), or whole faces of Bézier and NURBS surfaces left out: light and strong (LQC and SQC of
    /// Concheiro's thesis, both approximate) or conservative
    #[arg(long, value_name = "HOW", value_parser = parse_back_faces)]
    pub back_faces: Option<BackFaces>,
    /// Where the vertices that a split adds are drawn: on the surface (none), or first on the edge that they divide, from where they slide
    /// to the surface (geomorph; with the metrics edge, boundary and local-area)
    #[arg(long, value_name = "HOW", value_parser = parse_morph)]
    pub morph: Option<Morph>,
    /// Leaves that are drawn two as one triangle: beside larger ones, where they must be (forced), or also where the metric is satisfied with
    /// triangles twice as large (wished)
    #[arg(long, value_name = "WHICH", value_parser = parse_pairs)]
    pub pairs: Option<Pairs>,
    /// Leaves that the buffers of a surface hold
    #[arg(long, value_name = "N")]
    pub capacity: Option<u32>,
    /// k: every leaf is drawn as 4^k triangles, 0..=6
    #[arg(long, value_name = "K")]
    pub base_grid: Option<u32>,
    /// The deepest level, 0..=31 - k
    #[arg(long, value_name = "L")]
    pub max_level: Option<u32>,
}

/// Where the camera stands.
#[derive(Args, Clone)]
#[group(skip)]
pub struct ViewArguments {
    /// A camera of the scene by its name; default: the first one
    #[arg(long, value_name = "NAME", conflicts_with_all = ["eye", "look_at", "fov"])]
    pub camera: Option<String>,
    /// Position of the camera in metres
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_point, allow_hyphen_values = true, requires = "look_at")]
    pub eye: Option<DVec3>,
    /// The point in the middle of the picture
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_point, allow_hyphen_values = true, requires = "eye")]
    pub look_at: Option<DVec3>,
    /// Vertical angle of view in degrees [default: 50]
    #[arg(long, value_name = "DEGREES", requires = "eye", value_parser = parse_fov)]
    pub fov: Option<f64>,
    /// Seconds at which surfaces that move are shown
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, default_value = "0")]
    pub time: f64,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1280x720")]
    pub size: UVec2,
}

impl SceneArguments {
    /// Opens the scene with what was asked for.
    pub fn load(&self, quiet: bool) -> anyhow::Result<Loaded> {
        load_scene(&self.scene, &self.reading, &self.overrides, quiet)
    }
}

/// Opens a scene; its notes go to stderr.
pub fn load_scene(
    scene: &Path,
    reading: &ReadingArguments,
    overrides: &Overrides,
    quiet: bool,
) -> anyhow::Result<Loaded> {
    let options = LoadOptions {
        raw_size: reading.raw_size.map(|size| size.to_array()),
        ignore_trims: reading.ignore_trims,
        even_spans: reading.even_spans,
        z_up: reading.up == Up::Z,
        shape: reading.surface,
    };
    let mut loaded = load(scene, &options)?;
    if !quiet {
        loaded.notes.iter().for_each(|note| eprintln!("{note}"));
    }
    for object in &mut loaded.objects {
        overrides.apply(&mut object.settings);
        object
            .settings
            .validate()
            .with_context(|| format!("surface {}", object.name))?;
    }
    Ok(loaded)
}

impl Overrides {
    fn apply(&self, settings: &mut Settings) {
        let of_edges = |pixels| match settings.metric {
            // Boundaries stay as much finer as they are.
            Metric::Boundary {
                pixels: before,
                boundary_pixels,
            } => Metric::Boundary {
                pixels,
                boundary_pixels: pixels * (boundary_pixels / before),
            },
            _ => Metric::Edge { pixels },
        };
        settings.set_metric(self.pixels.map(of_edges).or(self.metric).unwrap_or(settings.metric));
        settings.back_faces = self.back_faces.unwrap_or(settings.back_faces);
        settings.morph = self.morph.unwrap_or(settings.morph);
        settings.pairs = self.pairs.unwrap_or(settings.pairs);
        settings.capacity = self.capacity.unwrap_or(settings.capacity);
        settings.target_leaves = settings.target_leaves.min(settings.capacity);
        if let Some(k) = self.base_grid {
            settings.base_grid = k;
            settings.max_level = settings.max_level.min(keyleaf::key::MAX_LEVEL.saturating_sub(k));
        }
        settings.max_level = self.max_level.unwrap_or(settings.max_level);
    }
}

impl ViewArguments {
    /// What the camera is called, and what it sees.
    pub fn view(&self, loaded: &Loaded) -> anyhow::Result<(String, View)> {
        let (Some(eye), Some(look_at)) = (self.eye, self.look_at) else {
            let camera = loaded.camera(self.camera.as_deref())?;
            return Ok((camera.name.clone(), loaded.view(Some(&camera.name), self.size)?));
        };
        ensure!(
            eye != look_at,
            "--look-at is the same point as --eye: a camera needs a direction"
        );
        let fov = self.fov.unwrap_or(50.0);
        let view = keyleaf_scene::View::new(eye, look_at, fov, None);
        Ok((
            format!("eye {eye}, look at {look_at}, fov {fov}"),
            view_of(&view, self.size),
        ))
    }
}

/// `WxH`, both at least 1.
pub fn parse_size(text: &str) -> anyhow::Result<UVec2> {
    let side = |text: &str| text.trim().parse::<u32>().ok();
    let (width, height) = text
        .split_once(['x', 'X'])
        .context("expected WIDTHxHEIGHT, such as 1280x720")?;
    match (side(width), side(height)) {
        (Some(0), Some(_)) | (Some(_), Some(0)) => bail!("expected at least 1x1"),
        (Some(width), Some(height)) => Ok(UVec2::new(width, height)),
        _ => bail!("expected WIDTHxHEIGHT in whole numbers, such as 1280x720"),
    }
}

fn parse_point(text: &str) -> anyhow::Result<DVec3> {
    let numbers: Vec<f64> = text.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    let most = keyleaf_scene::MAX_COORDINATE;
    match numbers[..] {
        [x, y, z] if text.matches(',').count() == 2 && [x, y, z].iter().all(|c| c.abs() <= most) => {
            Ok(DVec3::new(x, y, z))
        }
        _ => bail!("expected three finite numbers X,Y,Z, each at most {most:e}"),
    }
}

fn parse_fov(text: &str) -> anyhow::Result<f64> {
    let fov: f64 = text.parse().context("expected a number of degrees")?;
    ensure!(fov > 0.0 && fov < 180.0, "expected degrees above 0 and below 180");
    Ok(fov)
}

const METRICS: &str = "edge=PIXELS, distance=FACTOR, deviation=PIXELS, boundary=PIXELS,PIXELS, local-area=PIXELS, \
    linear-approximation=PIXELS, distance-test=VALUE, flat-test=VALUE or length-test=VALUE, where VALUE is a number in the unit of \
    the test, or one of pixels such as 2px";

fn parse_metric(text: &str) -> anyhow::Result<Metric> {
    let wrong = || format!("expected {METRICS}; numbers are positive");
    let number = |text: &str| {
        let number = text.trim().parse::<f32>().ok();
        number.filter(|n| n.is_finite() && *n > 0.0).with_context(wrong)
    };
    let threshold = |text: &str| -> anyhow::Result<Threshold> {
        match text.trim().strip_suffix("px") {
            Some(pixels) => Ok(Threshold::Pixels(number(pixels)?)),
            None => Ok(Threshold::Units(number(text)?)),
        }
    };
    let (name, value) = text.split_once('=').with_context(wrong)?;
    Ok(match name.trim() {
        "edge" => Metric::Edge { pixels: number(value)? },
        "distance" => Metric::Distance { factor: number(value)? },
        "deviation" => Metric::Deviation { pixels: number(value)? },
        "boundary" => {
            let (pixels, boundary) = value.split_once(',').with_context(wrong)?;
            Metric::Boundary {
                pixels: number(pixels)?,
                boundary_pixels: number(boundary)?,
            }
        }
        "local-area" => Metric::LocalArea { pixels: number(value)? },
        "linear-approximation" => Metric::LinearApproximation { pixels: number(value)? },
        "distance-test" => Metric::DistanceTest(threshold(value)?),
        "flat-test" => Metric::FlatTest(threshold(value)?),
        "length-test" => Metric::LengthTest(threshold(value)?),
        _ => bail!(wrong()),
    })
}

/// What is done with triangles that are seen from behind, by name.
pub fn parse_back_faces(text: &str) -> anyhow::Result<BackFaces> {
    let all = BackFaces::ALL;
    let names = || all.map(BackFaces::name).join(", ");
    let found = all.into_iter().find(|how| how.name() == text);
    found.with_context(|| format!("expected one of {}", names()))
}

/// Where new vertices are drawn, by name.
pub fn parse_morph(text: &str) -> anyhow::Result<Morph> {
    let found = Morph::ALL.into_iter().find(|how| how.name() == text);
    found.context("expected none or geomorph")
}

/// Which leaves are drawn as pairs, by name.
pub fn parse_pairs(text: &str) -> anyhow::Result<Pairs> {
    let found = Pairs::ALL.into_iter().find(|which| which.name() == text);
    found.context("expected forced or wished")
}

/// A positive number of seconds.
pub fn parse_seconds(text: &str) -> anyhow::Result<f64> {
    let seconds: f64 = text.parse().context("expected a number of seconds")?;
    ensure!(
        seconds > 0.0 && seconds.is_finite(),
        "expected a number of seconds above 0"
    );
    Ok(seconds)
}

/// A number of seconds from 0.
pub fn parse_time(text: &str) -> anyhow::Result<f64> {
    let seconds: f64 = text.parse().context("expected a number of seconds")?;
    ensure!(
        seconds >= 0.0 && seconds.is_finite(),
        "expected a number of seconds from 0"
    );
    Ok(seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_positive_sides() {
        assert_eq!(parse_size("1280x720").unwrap(), UVec2::new(1280, 720));
        for wrong in ["", "12", "0x0", "0x5", "5x0", "-1x5", "axb", "1x2x3", "1.5x2"] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn points_have_three_finite_numbers() {
        assert_eq!(parse_point("-1,2.5,3e2").unwrap(), DVec3::new(-1.0, 2.5, 300.0));
        for wrong in ["", "1,2", "1,2,3,4", "1,,2", "1,a,2,3", "nan,0,0", "1,inf,0"] {
            assert!(parse_point(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn metrics_have_a_name_and_a_positive_number() {
        assert_eq!(parse_metric("edge=4").unwrap(), Metric::Edge { pixels: 4.0 });
        assert_eq!(parse_metric("distance=0.1").unwrap(), Metric::Distance { factor: 0.1 });
        let both = Metric::Boundary {
            pixels: 8.0,
            boundary_pixels: 2.0,
        };
        assert_eq!(parse_metric("boundary=8,2").unwrap(), both);
        assert_eq!(
            parse_metric("flat-test=0.99").unwrap(),
            Metric::FlatTest(Threshold::Units(0.99))
        );
        assert_eq!(
            parse_metric("length-test=4px").unwrap(),
            Metric::LengthTest(Threshold::Pixels(4.0))
        );
        for wrong in [
            "edge",
            "edge=",
            "edge=0",
            "edge=-1",
            "edge=nan",
            "length=3",
            "boundary=8",
            "flat-test=px",
        ] {
            assert!(parse_metric(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn fewer_pixels_replace_the_metric_of_the_scene() {
        let none = Overrides::default();
        let mut settings = Settings {
            max_level: 29,
            ..Settings::default()
        };
        none.apply(&mut settings);
        assert_eq!(
            settings,
            Settings {
                max_level: 29,
                ..Settings::default()
            }
        );
        Overrides {
            pixels: Some(3.0),
            base_grid: Some(4),
            ..none
        }
        .apply(&mut settings);
        assert_eq!(
            (settings.metric, settings.base_grid, settings.max_level),
            (Metric::Edge { pixels: 3.0 }, 4, 27)
        );
        settings.validate().unwrap();
    }
}
