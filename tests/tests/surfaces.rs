//! Surfaces of every kind.

use crate::meshes;
use crate::random::Random;
use glam::{DVec2, DVec3};
use keyleaf::surface::*;
use std::sync::Arc;

pub fn flat(mesh: &PolygonMesh) -> Arc<dyn Surface> {
    Arc::new(Mesh::new(mesh).expect("a surface"))
}

/// Smooth hills: a function of the place on the map, whatever the number of samples.
pub fn hills(width: u32, height: u32) -> HeightMap {
    let sample = |k: u32| {
        let (x, y) = (
            f64::from(k % width) / f64::from(width - 1),
            f64::from(k / width) / f64::from(height - 1),
        );
        (60.0 * (7.0 * x).sin() * (5.0 * y).cos()
            + 25.0 * (19.0 * x + 8.0 * y).sin()
            + 8.0 * (43.0 * y - 17.0 * x).cos()) as f32
    };
    HeightMap::new(width, height, (0..width * height).map(sample).collect()).expect("a map")
}

/// Hills over a kilometre, or so.
pub fn height_field(side: u32, interpolation: Interpolation) -> Arc<dyn Surface> {
    let settings = HeightFieldSettings {
        extent: DVec2::new(1000.0, 1000.0),
        scale: 1.0,
        offset: 100.0,
        interpolation,
    };
    Arc::new(HeightField::new(hills(side, side), settings).expect("a field"))
}

pub fn by_noise(mesh: &PolygonMesh) -> Arc<dyn Surface> {
    let noise = NoiseDisplacement {
        amplitude: 0.08,
        frequency: 2.5,
        octaves: 4,
        gain: 0.5,
        seed: 7,
    };
    Arc::new(DisplacedNoise::new(mesh, noise).expect("a surface"))
}

/// Every face has its own part of the texture: all mesh edges are seams.
pub fn by_texture(mesh: &PolygonMesh) -> Arc<dyn Surface> {
    let mut random = Random(11);
    let uvs = (0..mesh.faces.corner_count())
        .map(|_| [random.unit() as f32, random.unit() as f32])
        .collect();
    let mesh = PolygonMesh {
        corners: CornerAttributes {
            uvs: Some(uvs),
            ..mesh.corners.clone()
        },
        ..mesh.clone()
    };
    let displacement = TextureDisplacement {
        texels: hills(24, 17),
        scale: 1e-3,
        offset: 0.02,
        repeats: true,
    };
    Arc::new(DisplacedTexture::new(&mesh, displacement).expect("a surface"))
}

/// Of a few kilometres.
pub fn terrain() -> Arc<dyn Surface> {
    let settings = TerrainSettings {
        extent: 4096.0,
        height: 300.0,
        first_level: 2,
        octaves: 8,
        ..TerrainSettings::default()
    };
    Arc::new(Terrain::new(settings).expect("a terrain"))
}

/// (name, surface), one or more for every shader.
pub fn all() -> Vec<(&'static str, Arc<dyn Surface>)> {
    let mut all = vec![
        ("cube", flat(&meshes::cube())),
        ("tetrahedron", flat(&meshes::tetrahedron())),
        ("house", flat(&meshes::house())),
        ("open mesh", flat(&meshes::open())),
        ("house with noise", by_noise(&meshes::house())),
        ("cube with texture", by_texture(&meshes::cube())),
        ("height field", height_field(33, Interpolation::Bicubic)),
        ("bilinear height field", height_field(33, Interpolation::Bilinear)),
        ("terrain", terrain()),
    ];
    all.extend(patches());
    all.extend(subdivided());
    all
}

fn joined(patches: Vec<NurbsSurface>, kind: PatchKind) -> Arc<dyn Surface> {
    let settings = PatchSettings {
        kind,
        ..PatchSettings::default()
    };
    Arc::new(Patches::new(patches, settings).expect("a model"))
}

/// A rational sphere of radius 1: two poles and a seam.
pub fn sphere() -> NurbsSurface {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let round = [
        [1, 0],
        [1, 1],
        [0, 1],
        [-1, 1],
        [-1, 0],
        [-1, -1],
        [0, -1],
        [1, -1],
        [1, 0],
    ];
    let profile = [[0, -1], [1, -1], [1, 0], [1, 1], [0, 1]];
    let weight = |k: usize| if k % 2 == 1 { half } else { 1.0 };
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (j, [radius, z]) in profile.into_iter().enumerate() {
        for (i, [x, y]) in round.into_iter().enumerate() {
            points.push(DVec3::new(f64::from(x * radius), f64::from(y * radius), f64::from(z)));
            weights.push(weight(i) * weight(j));
        }
    }
    let u = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
    let v = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
    NurbsSurface::new([2, 2], [u.to_vec(), v.to_vec()], points, weights).expect("a sphere")
}

/// Two bicubic patches that share a curve, wavy, open.
fn waves() -> Vec<NurbsSurface> {
    let mut random = Random(12);
    let heights: Vec<f64> = (0..28).map(|_| random.unit()).collect();
    let patch = |first: usize| {
        let at = |k: usize| {
            let (i, j) = (first + k % 4, k / 4);
            DVec3::new(i as f64, heights[i + 7 * j], -(j as f64))
        };
        NurbsSurface::bezier([3, 3], (0..16).map(at).collect(), vec![1.0; 16]).expect("a patch")
    };
    vec![patch(0), patch(3)]
}

/// Bézier and NURBS surfaces.
pub fn patches() -> Vec<(&'static str, Arc<dyn Surface>)> {
    let nurbs = PatchKind::Nurbs(BasisMethod::Triangular);
    vec![
        ("sphere", joined(vec![sphere()], nurbs)),
        ("waves", joined(waves(), PatchKind::Bezier)),
    ]
}

/// Subdivision surfaces and their approximations.
pub fn subdivided() -> Vec<(&'static str, Arc<dyn Surface>)> {
    let limit = |mesh: PolygonMesh, scheme| -> Arc<dyn Surface> {
        let settings = SubdivisionSettings { scheme, isolation: 6 };
        Arc::new(Subdivision::new(&ControlMesh::from(mesh), settings).expect("a subdivision surface"))
    };
    let tetrahedron = ControlMesh::from(meshes::tetrahedron());
    let plain = LoopWeights::Loop;
    let qas = TrianglePatches::of_loop(&tetrahedron, plain).expect("triangles");
    let pn = TrianglePatches::point_normal(&meshes::tetrahedron(), CornerNormals::AngleWeighted).expect("triangles");
    vec![
        (
            "catmull-clark house",
            limit(meshes::house(), SubdivisionScheme::CatmullClark),
        ),
        (
            "catmull-clark open mesh",
            limit(meshes::open(), SubdivisionScheme::CatmullClark),
        ),
        (
            "loop tetrahedron",
            limit(meshes::tetrahedron(), SubdivisionScheme::Loop(plain)),
        ),
        ("qas tetrahedron", Arc::new(qas)),
        ("pn tetrahedron", Arc::new(pn)),
    ]
}
