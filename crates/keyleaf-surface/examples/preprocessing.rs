//! How long surfaces of control meshes take to make, and how large their tables are, as in table 4.1 of Komar's thesis (2020):
//! `cargo run --release -p keyleaf-surface --example preprocessing`. On one thread; the median of some repeats.

use glam::DVec3;
use keyleaf_surface::gaussian::{Conditioning, CovarianceMesh, GaussianProduct, GaussianSettings, Symmetric3};
use keyleaf_surface::{
    ControlMesh, CornerAttributes, LoopWeights, PolygonMesh, Subdivision, SubdivisionScheme, SubdivisionSettings,
    Surface, SurfaceTables,
};
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

const REPEATS: usize = 9;

const MESHES: [&str; 4] = ["cube", "wirecube", "cylinder", "anvil"];

/// The default isolation comes last.
const ISOLATIONS: [u32; 7] = [1, 2, 3, 4, 5, 6, 8];

fn main() -> Result<(), Box<dyn Error>> {
    let mut models = Vec::new();
    for name in MESHES {
        models.push((name.to_owned(), model(name)?));
    }
    for (name, copies) in [("cube", 42), ("anvil", 2)] {
        models.push((format!("{copies} times {name}"), model(name)?.repeated(copies)));
    }
    println!(
        "{:<14} {:>6} {:<22} {:>9} {:>9} {:>12}",
        "mesh", "faces", "kind", "isolation", "ms", "bytes"
    );
    for (name, quads) in &models {
        let triangles = quads.triangulated();
        for (kind, model, scheme, is_gaussian) in [
            ("Catmull-Clark", quads, SubdivisionScheme::CatmullClark, false),
            ("Loop", &triangles, SubdivisionScheme::Loop(LoopWeights::Loop), false),
            ("Gaussian Catmull-Clark", quads, SubdivisionScheme::CatmullClark, true),
            (
                "Gaussian Loop",
                &triangles,
                SubdivisionScheme::Loop(LoopWeights::Loop),
                true,
            ),
        ] {
            for isolation in ISOLATIONS {
                let (median, bytes) = measured(|| match is_gaussian {
                    false => model.surface(scheme, isolation),
                    true => model.product(scheme, isolation),
                })?;
                let (ms, faces) = (median.as_secs_f64() * 1e3, model.faces.len());
                println!("{name:<14} {faces:>6} {kind:<22} {isolation:>9} {ms:>9.2} {bytes:>12}");
            }
        }
    }
    Ok(())
}

/// The median time that a surface takes to make, and the bytes of its tables.
fn measured(
    make: impl Fn() -> Result<(Duration, SurfaceTables), Box<dyn Error>>,
) -> Result<(Duration, usize), Box<dyn Error>> {
    let (mut times, mut bytes) = (Vec::new(), 0);
    for _ in 0..REPEATS {
        let (time, tables) = make()?;
        times.push(time);
        bytes = 4 * (tables.a.len() + tables.b.len());
    }
    times.sort();
    Ok((times[REPEATS / 2], bytes))
}

/// Vertices with covariances, and faces.
struct Model {
    positions: Vec<DVec3>,
    covariances: Vec<Symmetric3>,
    faces: Vec<Vec<u32>>,
}

impl Model {
    /// So many of it beside each other.
    fn repeated(&self, copies: u32) -> Self {
        let count = self.positions.len() as u32;
        let width = self.positions.iter().map(|p| 3.0 * p.x.abs()).fold(0.0, f64::max);
        let moved = |copy: u32| {
            self.positions
                .iter()
                .map(move |&p| p + f64::from(copy) * width * DVec3::X)
        };
        let renumbered = |copy: u32| {
            let face = move |face: &Vec<u32>| face.iter().map(|vertex| vertex + copy * count).collect();
            self.faces.iter().map(face)
        };
        Self {
            positions: (0..copies).flat_map(moved).collect(),
            covariances: self.covariances.repeat(copies as usize),
            faces: (0..copies).flat_map(renumbered).collect(),
        }
    }

    fn triangulated(&self) -> Self {
        let fan = |face: &Vec<u32>| {
            let pairs = face[1..].windows(2);
            pairs.map(|pair| vec![face[0], pair[0], pair[1]]).collect::<Vec<_>>()
        };
        Self {
            positions: self.positions.clone(),
            covariances: self.covariances.clone(),
            faces: self.faces.iter().flat_map(fan).collect(),
        }
    }

    fn control(&self) -> ControlMesh {
        ControlMesh::from(PolygonMesh {
            positions: self.positions.clone(),
            faces: self.faces.iter().collect(),
            corners: CornerAttributes::default(),
        })
    }

    fn surface(&self, scheme: SubdivisionScheme, isolation: u32) -> Result<(Duration, SurfaceTables), Box<dyn Error>> {
        let (control, settings) = (self.control(), SubdivisionSettings { scheme, isolation });
        let start = Instant::now();
        let surface = Subdivision::new(&control, settings)?;
        Ok((start.elapsed(), surface.tables(DVec3::ZERO)))
    }

    fn product(&self, scheme: SubdivisionScheme, isolation: u32) -> Result<(Duration, SurfaceTables), Box<dyn Error>> {
        let (mesh, _) = CovarianceMesh::new(self.control(), &self.covariances, Conditioning::Strict)?;
        let settings = GaussianSettings {
            scheme,
            isolation,
            ..GaussianSettings::default()
        };
        let start = Instant::now();
        let surface = GaussianProduct::new(&mesh, settings)?;
        Ok((start.elapsed(), surface.tables(DVec3::ZERO)))
    }
}

/// One of the covariance meshes among the scenes.
fn model(name: &str) -> Result<Model, Box<dyn Error>> {
    let read = |extension: &str| {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        std::fs::read_to_string(scenes.join(format!("gauss_{name}.{extension}")))
    };
    let (object, covariances) = (read("obj")?, read("cov")?);
    let mut positions = Vec::new();
    for line in object.lines().filter_map(|line| line.strip_prefix("v ")) {
        positions.push(DVec3::from_array(numbers(line)?));
    }
    let mut faces = Vec::new();
    for line in object.lines().filter_map(|line| line.strip_prefix("f ")) {
        let vertex = |word: &str| {
            word.split('/')
                .next()
                .unwrap_or(word)
                .parse::<u32>()
                .map(|vertex| vertex - 1)
        };
        faces.push(line.split_whitespace().map(vertex).collect::<Result<Vec<u32>, _>>()?);
    }
    let mut matrices = Vec::new();
    let is_matrix = |line: &&str| !line.is_empty() && !line.starts_with(['#', 'c']);
    for line in covariances.lines().filter(is_matrix) {
        matrices.push(Symmetric3::from_array(numbers(line)?));
    }
    Ok(Model {
        positions,
        covariances: matrices,
        faces,
    })
}

fn numbers<const N: usize>(line: &str) -> Result<[f64; N], Box<dyn Error>> {
    let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    numbers
        .try_into()
        .map_err(|_| format!("{line}: expected {N} numbers").into())
}
