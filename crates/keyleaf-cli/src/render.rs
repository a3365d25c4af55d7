//! `keyleaf render`: one headless frame.

use crate::Outcome;
use crate::arguments::{SceneArguments, ViewArguments};
use crate::difference::{self, Quantity};
use crate::output::{self, thousands};
use crate::session::{self, DeviceReport};
use crate::timing;
use anyhow::{Context, ensure};
use clap::{Args, ValueEnum};
use glam::{DVec3, UVec2};
use image::{DynamicImage, ImageBuffer, ImageFormat};
use keyleaf::headless::Headless;
use keyleaf::shading::Tint;
use keyleaf::{KeyleafError, View};
use keyleaf_stage::{Canvas, Deviations, Loaded, Show, Stage, StageLook, Timer, construction};
use serde_json::json;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Render one frame of a scene to a picture
///
/// The surfaces are refined for the view until nothing changes, then drawn once.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf render scenes/terrain_real.ron -o terrain.png
  keyleaf render cow.obj -o cow.png --eye 3,2,4 --look-at 0,1,0 --fov 40 --size 800x600 --wireframe
  keyleaf render scenes/fox.ron -o fox.exr --channel position --json
  keyleaf render scenes/valences.ron -o error.png --channel error
  keyleaf render scenes/gaussian.ron -o gaussian.png --cage --ellipsoids 0.5")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    view: ViewArguments,
    /// The picture: .png, or .exr for the channel position
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// What the picture shows
    #[arg(long, value_enum, default_value = "color", value_name = "CHANNEL")]
    channel: Channel,
    #[command(flatten)]
    overlay: OverlayArguments,
    /// Frames to refine for [default: until nothing changes]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,
    /// Print a report as JSON
    #[arg(long)]
    json: bool,
}

/// What is drawn over the surface.
#[derive(Args, Clone, Copy)]
pub struct OverlayArguments {
    /// Draw the edges of the triangles
    #[arg(long)]
    pub wireframe: bool,
    /// Tint leaves by their level
    #[arg(long)]
    pub level_tint: bool,
    /// Draw the edges of control meshes
    #[arg(long)]
    pub cage: bool,
    /// Draw the ellipsoids of covariances, so many standard deviations large [default: 1]
    #[arg(long, value_name = "SIGMAS", num_args = 0..=1, default_missing_value = "1", value_parser = parse_sigmas)]
    pub ellipsoids: Option<f64>,
}

/// A size in standard deviations.
fn parse_sigmas(text: &str) -> anyhow::Result<f64> {
    let sigmas: f64 = text.parse().context("expected a number of standard deviations")?;
    ensure!(
        sigmas > 0.0 && sigmas <= 1e3,
        "expected a number of standard deviations above 0, at most 1000"
    );
    Ok(sigmas)
}

impl OverlayArguments {
    /// Adds what surfaces are made of.
    fn add_construction(self, loaded: &mut Loaded, time: f64) {
        let made: Vec<_> = loaded
            .objects
            .iter()
            .flat_map(|object| {
                let cage = self.cage.then(|| construction::control_cage(object, time));
                let ellipsoids = self
                    .ellipsoids
                    .map(|sigmas| construction::ellipsoids(object, time, sigmas));
                [cage, ellipsoids].into_iter().flatten().flatten()
            })
            .collect();
        loaded.objects.extend(made);
    }
}

/// A channel as the command line names it.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// The lit picture
    #[value(alias = "colour")]
    Color,
    /// World normals n as colours n/2 + 1/2
    Normal,
    /// Levels of the leaves as colours
    Level,
    /// World positions: in an .exr as floats, alpha 1 where there is a surface; in a .png as 16-bit numbers, 0 to 65535 from the
    /// least to the greatest coordinate of the scene's box
    Position,
    /// How far vertices are from the exact surface, over its diagonal: 1e-9 dark blue to 1e-3 yellow, by decades
    Error,
    /// The angle between their normals and the exact ones: 1e-7 dark blue to 1e-1 radians yellow, by decades
    NormalError,
}

impl Channel {
    /// What of the difference to the exact surface it shows.
    fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Error => Some(Quantity::Position),
            Self::NormalError => Some(Quantity::Normal),
            _ => None,
        }
    }

    /// The channel with what is drawn over it.
    pub fn look(self, overlay: OverlayArguments) -> StageLook {
        let show = match self {
            Self::Color => Show::Colour,
            Self::Normal => Show::Normal,
            Self::Level => Show::Level,
            Self::Position | Self::Error | Self::NormalError => Show::Position,
        };
        StageLook {
            show,
            wireframe: overlay.wireframe,
            tint: if overlay.level_tint { Tint::Level } else { Tint::None },
        }
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let format = format(&arguments.output, arguments.channel)?;
    let OverlayArguments {
        wireframe,
        level_tint,
        cage,
        ellipsoids,
    } = arguments.overlay;
    let is_overlay = wireframe || level_tint || cage || ellipsoids.is_some();
    ensure!(
        arguments.channel == Channel::Color || !is_overlay,
        "--wireframe, --level-tint, --cage and --ellipsoids need the channel color"
    );
    output::ensure_writable(&arguments.output)?;
    let mut loaded = arguments.scene.load(quiet)?;
    loaded.pose(arguments.view.time)?;
    let (camera, view) = arguments.view.view(&loaded)?;
    arguments.overlay.add_construction(&mut loaded, arguments.view.time);

    let gpu = session::device()?;
    let look = arguments.channel.look(arguments.overlay);
    let mut stage = session::stage(&gpu, &loaded, look)?;
    let (size, limit) = (arguments.view.size, gpu.device.limits().max_texture_dimension_2d);
    ensure!(
        size.max_element() <= limit,
        "--size {}x{}: this device draws at most {limit} pixels a side",
        size.x,
        size.y
    );
    let canvas = Canvas::new(&gpu.device, size, stage.target())?;
    compile(&gpu, &mut stage, &view)?;
    let settled = session::settle(&gpu, &mut stage, &view, arguments.frames, quiet)?;
    let timer = Timer::new(&gpu, &stage);
    let frame = timing::frame(&gpu, &mut stage, Some(&canvas), &view, timer.as_ref())?;
    let (picture, error) = match arguments.channel.quantity() {
        Some(quantity) => {
            let (colours, error) = difference::of_stage(&gpu, &stage, &loaded, &view, quantity)?;
            (png(colours, size)?, Some(error))
        }
        None => {
            let pixels = canvas.read(&gpu)?;
            (encode(pixels, size, look.show, format, &view, &loaded)?, None)
        }
    };
    output::write(&arguments.output, &picture)?;

    let device = DeviceReport::new(&gpu);
    let statistics = frame.statistics;
    let seconds = start.elapsed().as_secs_f64();
    if arguments.json {
        let draw = frame.draw.unwrap_or_default();
        output::print_json(&json!({
            "device": device.device, "driver": device.driver, "backend": device.backend, "software": device.software,
            "scene": arguments.scene.scene, "picture": arguments.output, "size": size.to_array(),
            "camera": camera, "frames": settled.frames, "settled": settled.is_settled,
            "leaves": statistics.leaves, "visible": statistics.visible, "triangles": statistics.triangles,
            "starved": statistics.starved, "threshold_factor": statistics.threshold_factor,
            "passes": [{ "name": "update", "ms": frame.update.ms }, { "name": "draw", "ms": draw.ms }],
            "clock": timing::clock(timer.as_ref()), "times": device.times,
            "error": error, "notes": loaded.notes, "seconds": seconds,
        }))?;
    } else {
        let starved = match statistics.starved {
            0 => String::new(),
            n => format!(", {} splits short of capacity", thousands(n.into())),
        };
        output::print(&format!(
            "{}: {}x{}, {} leaves, {} visible, {} triangles{starved}, {seconds:.1} s on {}",
            arguments.output.display(),
            size.x,
            size.y,
            thousands(statistics.leaves.into()),
            thousands(statistics.visible.into()),
            thousands(statistics.triangles),
            device.device,
        ))?;
        if let Some(Deviations { largest, rms }) = error {
            let what = if arguments.channel == Channel::Error {
                "positions: over the diagonal"
            } else {
                "normals: radians"
            };
            output::print(&format!(
                "difference of {what}, largest {largest:.2e}, root mean square {rms:.2e}"
            ))?;
        }
    }
    Ok(Outcome::Done)
}

/// Draws the roots on a few pixels: drivers compile shaders at their first use, which is no part of what a pass costs.
fn compile(gpu: &Headless, stage: &mut Stage, view: &View) -> Result<(), KeyleafError> {
    session::update(gpu, stage, view)?;
    let canvas = Canvas::new(&gpu.device, UVec2::splat(8), stage.target())?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    canvas.draw(&mut encoder, stage, view, None);
    gpu.queue.submit([encoder.finish()]);
    session::wait(gpu)
}

/// The format that a name asks for, if the channel has it.
fn format(file: &Path, channel: Channel) -> anyhow::Result<ImageFormat> {
    match output::extension(file).as_str() {
        "png" => Ok(ImageFormat::Png),
        "exr" if channel == Channel::Position => Ok(ImageFormat::OpenExr),
        "exr" => anyhow::bail!(
            "{}: only the channel position is written as .exr; expected .png",
            file.display()
        ),
        other => anyhow::bail!(
            "{}: unknown picture type '{other}'; expected .png, or .exr for positions",
            file.display()
        ),
    }
}

/// A .png of three bytes a pixel.
fn png(colours: Vec<u8>, size: UVec2) -> anyhow::Result<Vec<u8>> {
    let whole = || anyhow::anyhow!("the picture has not {}x{} pixels", size.x, size.y);
    let picture = ImageBuffer::from_raw(size.x, size.y, colours).map(DynamicImage::ImageRgb8);
    let mut bytes = Cursor::new(Vec::new());
    picture.ok_or_else(whole)?.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

/// A picture file from what was read back.
fn encode(
    pixels: Vec<u8>,
    size: UVec2,
    show: Show,
    format: ImageFormat,
    view: &View,
    loaded: &Loaded,
) -> anyhow::Result<Vec<u8>> {
    let whole = || anyhow::anyhow!("the picture read back has not {}x{} pixels", size.x, size.y);
    let picture = if show == Show::Position {
        let floats: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&pixels);
        let positions = floats.into_iter().map(|[x, y, z, w]| {
            let there = DVec3::new(x.into(), y.into(), z.into());
            (w != 0.0).then_some(there + view.eye)
        });
        if format == ImageFormat::OpenExr {
            let texel = |p: Option<DVec3>| p.map_or([0.0; 4], |p| p.as_vec3().extend(1.0).to_array());
            let texels: Vec<f32> = positions.flat_map(texel).collect();
            ImageBuffer::from_raw(size.x, size.y, texels).map(DynamicImage::ImageRgba32F)
        } else {
            let (low, high) = loaded.bounds;
            let extent = (high - low).max(DVec3::splat(f64::MIN_POSITIVE));
            let part = |p: DVec3| ((p - low) / extent).clamp(DVec3::ZERO, DVec3::ONE) * f64::from(u16::MAX);
            let texel = |p: Option<DVec3>| {
                p.map_or([0; 4], |p| {
                    part(p).round().extend(f64::from(u16::MAX)).to_array().map(|c| c as u16)
                })
            };
            let texels: Vec<u16> = positions.flat_map(texel).collect();
            ImageBuffer::from_raw(size.x, size.y, texels).map(DynamicImage::ImageRgba16)
        }
    } else {
        let colours = pixels.as_chunks::<4>().0.iter();
        return png(colours.flat_map(|[r, g, b, _]| [*r, *g, *b]).collect(), size);
    };
    let mut bytes = Cursor::new(Vec::new());
    picture.ok_or_else(whole)?.write_to(&mut bytes, format)?;
    Ok(bytes.into_inner())
}
