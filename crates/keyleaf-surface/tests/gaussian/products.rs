//! Gaussian-product surfaces of several kinds, and points of them.

use crate::models::{Random, cube, disk, mesh};
use crate::oracle_tables::oracle;
use crate::oracles::read;
use crate::refine::Scheme;
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::gaussian::{Conditioning, Covariance, CovarianceMesh, GaussianProduct, GaussianSettings, Solver};
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Crease, LoopWeights, Subdivision, SubdivisionScheme, SubdivisionSettings, Surface,
};
use std::path::Path;

pub fn settings(scheme: SubdivisionScheme, isolation: u32) -> GaussianSettings {
    GaussianSettings {
        scheme,
        isolation,
        solver: Solver::Ldlt,
    }
}

pub fn scheme_of(scheme: Scheme) -> SubdivisionScheme {
    match scheme {
        Scheme::CatmullClark => SubdivisionScheme::CatmullClark,
        Scheme::Loop => SubdivisionScheme::Loop(LoopWeights::Loop),
        Scheme::Warren => SubdivisionScheme::Loop(LoopWeights::Warren),
    }
}

pub fn plain(mesh: &CovarianceMesh, scheme: SubdivisionScheme, isolation: u32) -> Subdivision {
    Subdivision::new(mesh.control(), SubdivisionSettings { scheme, isolation }).expect("a surface")
}

/// A tetrahedron-like bipyramid with n faces about each pole.
pub fn bipyramid(n: u32) -> ControlMesh {
    let rim = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        DVec3::new(angle.cos(), angle.sin(), 0.1 * f64::from(k % 3))
    };
    let positions = (0..n).map(rim).chain([DVec3::Z, -DVec3::Z]).collect();
    let faces = (0..n).flat_map(|k| {
        let next = (k + 1) % n;
        [vec![k, next, n], vec![next, k, n + 1]]
    });
    ControlMesh::from(mesh(positions, &faces.collect::<Vec<_>>()))
}

/// A prism over n corners: polygons with n corners, and creases about the upper one.
pub fn prism(n: u32) -> ControlMesh {
    let rim = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k % n) / f64::from(n);
        DVec3::new(angle.cos(), angle.sin(), if k < n { -0.7 } else { 0.8 })
    };
    let sides = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]);
    let ends = [(0..n).rev().collect(), (n..2 * n).collect()];
    let mut control = ControlMesh::from(mesh(
        (0..2 * n).map(rim).collect(),
        &sides.chain(ends).collect::<Vec<_>>(),
    ));
    let crease = |k: u32| Crease {
        vertices: [n + k, n + (k + 1) % n],
        sharpness: 2.5,
    };
    control.creases = (0..n).map(crease).collect();
    control
}

/// Disks turned anyhow at the vertices.
pub fn with_disks(control: ControlMesh, condition: f64, turn: f64, random: &mut Random) -> CovarianceMesh {
    let common = random.rotation(2.0);
    let covariances: Vec<_> = control
        .mesh
        .positions
        .iter()
        .map(|_| disk(condition, common * random.rotation(turn)).matrix())
        .collect();
    CovarianceMesh::new(control, &covariances, Conditioning::Strict)
        .expect("a mesh")
        .0
}

/// Name, scheme and mesh of surfaces of all kinds.
pub fn meshes() -> Vec<(String, SubdivisionScheme, CovarianceMesh)> {
    let quads = SubdivisionScheme::CatmullClark;
    let triangles = SubdivisionScheme::Loop(LoopWeights::Loop);
    let mut random = Random(77);
    let mut meshes = Vec::new();
    for (condition, turn) in [(1.0, 0.0), (1e2, 3.0), (1e4, 0.1), (1e4, 3.0)] {
        let mut add = |name: &str, scheme, control| {
            let mesh = with_disks(control, condition, turn, &mut random);
            meshes.push((
                format!("{name}, condition {condition:.0e} turned by {turn}"),
                scheme,
                mesh,
            ));
        };
        add("cube", quads, ControlMesh::from(cube()));
        add("prism", quads, prism(5));
        add("bipyramid", triangles, bipyramid(5));
        let mut open = bipyramid(7);
        open.mesh.faces = open.mesh.faces.iter().skip(3).collect();
        add("open bipyramid", triangles, open);
        let mut open = ControlMesh::from(cube());
        open.mesh.faces = open.mesh.faces.iter().skip(1).collect();
        open.boundary = BoundaryRule::EdgesAndCorners;
        add("open cube", quads, open);
    }
    let flat = CovarianceMesh::from_faces(ControlMesh::from(cube()), 0.1, 1e-2).expect("a mesh");
    meshes.push(("cube with sharp edges".to_owned(), quads, flat));
    for name in [
        "cone_concave_warren",
        "cone_plateau_loop",
        "cone_pointy_warren",
        "grid4x4_boundary",
    ] {
        if let Some(table) = oracle(&format!("gps/{name}.json")) {
            let (scheme, mesh) = read(&table);
            meshes.push((name.to_owned(), scheme_of(scheme), mesh));
        }
    }
    meshes
}

pub fn any_point(surface: &dyn Surface, random: &mut Random) -> RootPoint {
    let topology = surface.topology();
    let below = |random: &mut Random, bound: u32| (random.unit() * f64::from(bound)) as u32;
    let face = below(random, topology.face_count());
    let root = below(random, topology.corner_count(face));
    let x = match below(random, 4) {
        0 => ONE - below(random, ONE >> 9),
        1 => below(random, 3) * (ONE / 2),
        _ => below(random, ONE),
    };
    let room = ONE - x;
    let y = match below(random, 3) {
        0 => room,
        _ => below(random, room.max(1)),
    };
    RootPoint { face, root, x, y }
}

/// A shipped model with its covariances, if it is there.
pub fn shipped(name: &str) -> Option<CovarianceMesh> {
    let file = |extension: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenes/{name}.{extension}"));
        std::fs::read_to_string(path).ok()
    };
    let (model, covariances) = (file("obj")?, file("cov")?);
    let lines = |key: &'static str| model.lines().filter_map(move |line| line.strip_prefix(key));
    let positions = lines("v ").map(|line| {
        let v: Vec<f64> = line.split_whitespace().map(|x| x.parse().expect("a number")).collect();
        DVec3::from_slice(&v)
    });
    let faces = lines("f ").map(|line| -> Vec<u32> {
        let corner = |word: &str| {
            word.split('/')
                .next()
                .and_then(|x| x.parse::<u32>().ok())
                .expect("an index")
                - 1
        };
        line.split_whitespace().map(corner).collect()
    });
    let rows = covariances.lines().filter(|line| !line.starts_with('#'));
    let rows = rows.map(|line| {
        line.split_whitespace()
            .filter_map(|x| x.parse().ok())
            .collect::<Vec<f64>>()
    });
    let matrices: Vec<_> = rows
        .filter_map(|row| <[f64; 6]>::try_from(row).ok())
        .map(keyleaf_surface::gaussian::Symmetric3::from_array)
        .collect();
    let control = ControlMesh::from(mesh(positions.collect(), &faces.collect::<Vec<_>>()));
    Some(
        CovarianceMesh::new(control, &matrices, Conditioning::Floor)
            .expect("a mesh")
            .0,
    )
}

/// The greatest condition of a mesh's covariances.
pub fn condition(mesh: &CovarianceMesh) -> f64 {
    mesh.covariances().iter().map(Covariance::condition).fold(1.0, f64::max)
}

pub fn product(mesh: &CovarianceMesh, scheme: SubdivisionScheme, isolation: u32) -> GaussianProduct {
    GaussianProduct::new(mesh, settings(scheme, isolation)).expect("a surface")
}
