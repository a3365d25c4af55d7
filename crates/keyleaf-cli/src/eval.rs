//! `keyleaf eval`: the surface at given parameters.

use crate::arguments::{Overrides, ReadingArguments, load_scene, parse_time};
use crate::csv::{Csv, Row};
use crate::output::{self, thousands};
use crate::{Outcome, session};
use anyhow::{Context, bail, ensure};
use clap::{Args, ValueEnum};
use glam::{DMat3, DVec3};
use keyleaf::inspect::Inspector;
use keyleaf::key::RootPoint;
use keyleaf::surface::{OwnCoord, SurfaceFrame};
use keyleaf::{Passes, Quadtree, Settings};
use keyleaf_stage::{Loaded, LoadedObject};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

/// Evaluate a surface at the points of a table
///
/// The header of the table says what a row is: face,u,v (local to a face: quads have their corners 0..3 at (0,0), (1,0), (1,1), (0,1),
/// triangles at (0,0), (1,0), (0,1); polygons with n > 4 corners have u in 0..n along the boundary and v = 1 at the centre), or
/// surface,s,t (the parameters of a NURBS surface by its knots, of a Bézier patch from 0 to 1, both counted from 0 as in the file;
/// height maps and procedural terrain: surface 0, the unit square, s east and t north). Other columns are kept.
///
/// Appended, in world space: x,y,z, the derivatives du_x,… and dv_x,… in the parameters of the row, and the unit normal n_x,n_y,n_z,
/// with all digits that tell the number.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf eval scenes/terrain_real.ron --at points.csv -o heights.csv
  keyleaf eval cube.obj --at points.csv -o exact.csv --on cpu

points.csv:
  face,u,v
  0,0.5,0.25")]
pub struct Arguments {
    /// Scene file, model or height map
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    #[command(flatten)]
    reading: ReadingArguments,
    /// The points: a .csv with a header
    #[arg(long, value_name = "FILE")]
    at: PathBuf,
    /// The result: the same with more columns
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// Where it is computed
    #[arg(long, value_enum, default_value = "gpu")]
    on: Place,
    /// The surface of the scene, for rows without a column `object` [default: the only one]
    #[arg(long, value_name = "NAME")]
    object: Option<String>,
    /// Seconds at which surfaces that move are taken
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, default_value = "0")]
    time: f64,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// By the shader that draws it, in f32
    Gpu,
    /// By its twin, in f64
    Cpu,
}

const APPENDED: &str = "x,y,z,du_x,du_y,du_z,dv_x,dv_y,dv_z,n_x,n_y,n_z";

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    output::ensure_writable(&arguments.output)?;
    let mut loaded = load_scene(&arguments.scene, &arguments.reading, &Overrides::default(), quiet)?;
    loaded.pose(arguments.time)?;
    let csv = Csv::read(&arguments.at)?;
    let points = points(&csv, &loaded, arguments)?;
    let mut lines: Vec<Option<String>> = vec![None; points.len()];
    let gpu = if arguments.on == Place::Gpu {
        Some(session::device()?)
    } else {
        None
    };
    for (i, object) in loaded.objects.iter().enumerate() {
        let wanted: Vec<(usize, OwnCoord)> = (0..)
            .zip(&points)
            .filter_map(|(row, (object, point))| (*object == i).then_some((row, *point)))
            .collect();
        let (Some(gpu), false) = (&gpu, wanted.is_empty()) else {
            for (row, point) in wanted {
                let frame = in_own_parameters(object.surface.frame(point.at), &point);
                lines[row] = Some(numbers::<f64>(&placed(object, frame)));
            }
            continue;
        };
        let at: Vec<RootPoint> = wanted.iter().map(|(_, point)| point.at).collect();
        // A quadtree of the roots alone: it holds the tables of the surface, for the object's own origin.
        let settings = Settings {
            capacity: object.surface.topology().half_edge_count(),
            ..object.settings
        };
        let passes = Arc::new(Passes::new(
            &gpu.device,
            Quadtree::kind(object.surface.as_ref(), &settings),
        )?);
        let surface = Arc::clone(&object.surface);
        let quadtree = Quadtree::new(
            &gpu.device,
            &gpu.queue,
            passes,
            surface,
            object.world_from_object,
            settings,
        )?;
        let inspector = Inspector::new(&gpu.device, &Quadtree::kind(object.surface.as_ref(), &settings))?;
        let frames = inspector.evaluate(&gpu.device, &gpu.queue, &quadtree, &at)?;
        for ((row, point), frame) in wanted.iter().zip(frames) {
            let frame = SurfaceFrame {
                position: frame.position.as_dvec3() + quadtree.origin(),
                du: frame.du.as_dvec3(),
                dv: frame.dv.as_dvec3(),
                normal: frame.normal.as_dvec3(),
            };
            lines[*row] = Some(numbers::<f32>(&placed(object, in_own_parameters(frame, point))));
        }
    }
    let mut text = format!("{},{APPENDED}\n", csv.header);
    for (row, numbers) in csv.rows().zip(&lines) {
        let numbers = numbers
            .as_deref()
            .with_context(|| format!("{}: was not evaluated", row.place()))?;
        ensure!(
            !numbers.contains("NaN") && !numbers.contains("inf"),
            "{}: the surface is not finite there",
            row.place()
        );
        writeln!(text, "{},{numbers}", row.text)?;
    }
    output::write(&arguments.output, text.as_bytes())?;
    output::print(&format!(
        "{}: {} points",
        arguments.output.display(),
        thousands(points.len() as u64)
    ))?;
    Ok(Outcome::Done)
}

/// What the columns mean.
enum Kind {
    /// face, u, v
    Face([usize; 3]),
    /// surface, s, t
    Surface([usize; 3]),
}

/// The object and point of every row.
fn points(csv: &Csv, loaded: &Loaded, arguments: &Arguments) -> anyhow::Result<Vec<(usize, OwnCoord)>> {
    let columns = |names: [&'static str; 3]| -> Result<[usize; 3], &'static str> {
        let [a, b, c] = names.map(|name| csv.column(name).ok_or(name));
        Ok([a?, b?, c?])
    };
    let has = |name| csv.column(name).is_some();
    let missing = |name| {
        let there = csv.columns().join(",");
        format!(
            "{}:1: there is no column `{name}` in {there}; expected face,u,v or surface,s,t",
            arguments.at.display()
        )
    };
    let kind = if has("face") || !has("surface") {
        columns(["face", "u", "v"]).map(Kind::Face)
    } else {
        columns(["surface", "s", "t"]).map(Kind::Surface)
    };
    let kind = kind.map_err(|name| anyhow::anyhow!(missing(name)))?;
    let column = csv.column("object");
    let names = || {
        loaded
            .objects
            .iter()
            .map(|o| o.name.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let object = |name: &str, place: &str| {
        let found = loaded.objects.iter().position(|o| o.name == name);
        found.with_context(|| {
            format!(
                "{place}there is no object '{name}' in the scene; there are: {}",
                names()
            )
        })
    };
    let only = match (&arguments.object, column) {
        (Some(_), Some(_)) => bail!(
            "{}:1: there is a column `object`, and --object too",
            arguments.at.display()
        ),
        (Some(name), None) => object(name, "")?,
        (None, None) if loaded.objects.len() > 1 => {
            bail!(
                "the scene has several objects ({}): name one with --object, or in a column `object`",
                names()
            )
        }
        (None, _) => 0,
    };
    let row = |row: Row<'_>| {
        let i = column.map_or(Ok(only), |column| {
            object(row.text(column), &format!("{}: ", row.place()))
        })?;
        Ok((i, point(&row, &kind, &loaded.objects[i])?))
    };
    csv.rows().map(row).collect()
}

/// The point of a row, and how its parameters run.
fn point(row: &Row<'_>, kind: &Kind, object: &LoadedObject) -> anyhow::Result<OwnCoord> {
    let surface = &object.surface;
    match *kind {
        Kind::Face([face, u, v]) => {
            let at = surface.face_coord(row.index(face)?, row.number(u)?, row.number(v)?);
            at.map(OwnCoord::of_face)
        }
        Kind::Surface([number, s, t]) => surface.own_coord(row.index(number)?, row.number(s)?, row.number(t)?),
    }
    .with_context(|| format!("{}: '{}'", row.place(), object.name))
}

/// Derivatives and normal as the parameters of the row run.
fn in_own_parameters(frame: SurfaceFrame, point: &OwnCoord) -> SurfaceFrame {
    let [first, second, side] = if point.transposed {
        [frame.dv, frame.du, -frame.normal]
    } else {
        [frame.du, frame.dv, frame.normal]
    };
    SurfaceFrame {
        position: frame.position,
        du: first * point.rates[0],
        dv: second * point.rates[1],
        normal: side,
    }
}

/// A frame in world space: position, derivatives, normal.
fn placed(object: &LoadedObject, frame: SurfaceFrame) -> [DVec3; 4] {
    let to_world = &object.world_from_object;
    if to_world.matrix3 == DMat3::IDENTITY && to_world.translation == DVec3::ZERO {
        return [frame.position, frame.du, frame.dv, frame.normal];
    }
    let linear = to_world.matrix3;
    let normal = linear.inverse().transpose() * frame.normal;
    [
        to_world.transform_point3(frame.position),
        linear * frame.du,
        linear * frame.dv,
        normal.normalize(),
    ]
}

/// A float with the fewest digits that read back as itself.
trait Shortest {
    fn text(number: f64) -> String;
}

impl Shortest for f32 {
    fn text(number: f64) -> String {
        (number as f32).to_string()
    }
}

impl Shortest for f64 {
    fn text(number: f64) -> String {
        number.to_string()
    }
}

fn numbers<F: Shortest>(vectors: &[DVec3; 4]) -> String {
    vectors
        .iter()
        .flat_map(|v| v.to_array())
        .map(|c| F::text(c))
        .collect::<Vec<_>>()
        .join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_as_they_were() {
        let vectors = [
            DVec3::new(0.1, -1e-20, 123456.789),
            DVec3::X,
            DVec3::ZERO,
            DVec3::splat(1.0 / 3.0),
        ];
        let exact: Vec<f64> = numbers::<f64>(&vectors)
            .split(',')
            .map(|n| n.parse().unwrap())
            .collect();
        assert_eq!(exact, vectors.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>());
        let single: Vec<f32> = numbers::<f32>(&vectors)
            .split(',')
            .map(|n| n.parse().unwrap())
            .collect();
        assert_eq!(
            single,
            vectors.iter().flat_map(|v| v.as_vec3().to_array()).collect::<Vec<_>>()
        );
    }
}
