//! Products over shapes drawn at random: valences 3 to 13, polygons to 11 corners, boundaries, creases, covariances of a condition to 1e6.
//!
//! The limit surface in dual space is linear in the control points. So its nine coordinates are those of three plain subdivision surfaces,
//! and the product follows from their points.

use crate::models::{Random, mesh};
use crate::products::{any_point, bipyramid, condition, prism, product};
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::gaussian::{
    Conditioning, Covariance, CovarianceMesh, Dual, DualFrame, DualJet, MeanJet, Symmetric3,
};
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Corner, Crease, INFINITE_SHARPNESS, LoopWeights, Subdivision, SubdivisionScheme,
    SubdivisionSettings, Surface, SurfaceFrame,
};
use std::f64::consts::TAU;

const SQUARES: SubdivisionScheme = SubdivisionScheme::CatmullClark;

/// A closed mesh of n quads about each pole.
fn trapezohedron(n: u32) -> ControlMesh {
    let rim = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(2 * n);
        DVec3::new(angle.cos(), angle.sin(), if k.is_multiple_of(2) { 0.3 } else { -0.3 })
    };
    let positions = (0..2 * n).map(rim).chain([DVec3::Z, -DVec3::Z]).collect();
    let around = |k: u32| k % (2 * n);
    let faces = (0..n).flat_map(|k| {
        let k = 2 * k;
        [
            vec![2 * n, k, around(k + 1), around(k + 2)],
            vec![2 * n + 1, around(k + 1), k, around(k + 2 * n - 1)],
        ]
    });
    ControlMesh::from(mesh(positions, &faces.collect::<Vec<_>>()))
}

/// Without its first faces.
fn opened(mut control: ControlMesh, faces: usize) -> ControlMesh {
    control.mesh.faces = control.mesh.faces.iter().skip(faces).collect();
    control.creases.clear();
    control
}

/// Creases and corners of sharpness 0.3 to 5, or for ever, at random.
fn sharpened(mut control: ControlMesh, random: &mut Random) -> ControlMesh {
    let value = |random: &mut Random| {
        if random.unit() < 0.25 {
            INFINITE_SHARPNESS
        } else {
            0.3 + 4.7 * random.unit().powi(2)
        }
    };
    let ends = |face: &[u32]| -> Vec<[u32; 2]> {
        let next = face.iter().cycle().skip(1);
        face.iter().zip(next).map(|(&a, &b)| [a, b]).collect()
    };
    let edges: Vec<[u32; 2]> = control
        .mesh
        .faces
        .iter()
        .flat_map(ends)
        .filter(|[a, b]| a < b)
        .collect();
    let mut creases = Vec::new();
    for vertices in edges {
        if random.unit() < 0.15 {
            let sharpness = value(random);
            creases.push(Crease { vertices, sharpness });
        }
    }
    control.creases = creases;
    if random.unit() < 0.5 {
        let sharpness = value(random);
        control.corners = vec![Corner { vertex: 0, sharpness }];
    }
    control
}

/// Disks, rods and what is between, turned anyhow, of conditions to this one.
fn with_covariances(control: ControlMesh, condition: f64, random: &mut Random) -> CovarianceMesh {
    let matrices: Vec<Symmetric3> = (0..control.mesh.positions.len())
        .map(|_| {
            let values = [1.0, condition.powf(-random.unit()), 1.0 / condition];
            Symmetric3::diagonal(values).congruent(random.rotation(3.0))
        })
        .collect();
    let made = CovarianceMesh::new(control, &matrices, Conditioning::Strict);
    made.expect("covariances").0
}

fn meshes(random: &mut Random) -> Vec<(String, SubdivisionScheme, CovarianceMesh)> {
    let mut meshes = Vec::new();
    for n in 3..=13 {
        let conditions = [1e2, 1e4, 1e6];
        let triangles = SubdivisionScheme::Loop([LoopWeights::Loop, LoopWeights::Warren][n as usize % 2]);
        let open = (n as usize).div_ceil(2);
        let mut kinds = vec![
            ("trapezohedron", SQUARES, trapezohedron(n)),
            ("open trapezohedron", SQUARES, opened(trapezohedron(n), open)),
            ("bipyramid", triangles, bipyramid(n)),
            ("open bipyramid", triangles, opened(bipyramid(n), open)),
        ];
        if n <= 11 {
            kinds.push(("prism", SQUARES, prism(n)));
        }
        for (k, (name, scheme, control)) in kinds.into_iter().enumerate() {
            let condition = conditions[(k + n as usize) % 3];
            let mut control = if random.unit() < 0.5 {
                sharpened(control, random)
            } else {
                control
            };
            control
                .mesh
                .positions
                .iter_mut()
                .for_each(|p| *p += random.vector() * 0.1);
            if random.unit() < 0.5 {
                control.boundary = BoundaryRule::EdgesAndCorners;
            }
            let name = format!(
                "{name} of {n}, condition {condition:.0e}, {} creases",
                control.creases.len()
            );
            meshes.push((name, scheme, with_covariances(control, condition, random)));
        }
    }
    meshes
}

/// The coordinates of the surface in dual space, three a surface.
struct Truth {
    frame: DualFrame,
    surfaces: [Subdivision; 3],
}

impl Truth {
    fn new(mesh: &CovarianceMesh, scheme: SubdivisionScheme) -> Self {
        let gaussians: Vec<(DVec3, Covariance)> = (0..).map_while(|vertex| mesh.gaussian(vertex)).collect();
        let frame = DualFrame::whitened(&gaussians);
        let duals: Vec<[f64; 9]> = gaussians
            .iter()
            .map(|(mean, covariance)| Dual::of(*mean, covariance, &frame).to_array())
            .collect();
        let surfaces = [0, 3, 6].map(|k| {
            let mut control = mesh.control().clone();
            control.mesh.positions = duals.iter().map(|dual| DVec3::from_slice(&dual[k..])).collect();
            Subdivision::new(&control, SubdivisionSettings { scheme, isolation: 0 }).expect("a surface")
        });
        Self { frame, surfaces }
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let frames = self.surfaces.each_ref().map(|surface| surface.frame(at));
        let dual = |part: fn(&SurfaceFrame) -> DVec3| {
            let parts = frames.each_ref().map(|frame| part(frame).to_array());
            let all: [f64; 9] = parts.concat().try_into().expect("nine numbers");
            Dual::from_array(all)
        };
        let zero = Dual::default();
        let jet = DualJet {
            terms: [dual(|f| f.position), dual(|f| f.du), dual(|f| f.dv), zero, zero, zero],
        };
        let mean: MeanJet = jet.mean().expect("definite").in_object_space(&self.frame);
        mean.frame(DVec3::Z)
    }
}

#[test]
fn products_of_random_shapes_follow_from_plain_subdivision_in_dual_space() {
    let mut random = Random(201);
    let (mut worst, mut worst_angle, mut normals) = (0.0f64, 0.0f64, 0);
    for (name, scheme, mesh) in meshes(&mut random) {
        let (truth, surface) = (Truth::new(&mesh, scheme), product(&mesh, scheme, 8));
        let (low, high) = surface.bounding_box();
        let extent = low.distance(high);
        let condition = condition(&mesh);
        assert!(condition < 1.01e6, "{name}: {condition}");
        for _ in 0..60 {
            let mut at = any_point(&surface, &mut random);
            if random.unit() < 0.5 {
                at = RootPoint {
                    x: (at.x / 2) | 1,
                    y: (at.y / 2) | 1,
                    ..at
                };
            }
            let (own, exact) = (surface.frame(at), truth.frame(at));
            let off = own.position.distance(exact.position) / extent;
            assert!(off < 1e-12 + 1e-14 * condition, "{name}: {off:e} at {at:?}");
            worst = worst.max(off / condition);
            let drawn = surface.drawn(at).position.distance(exact.position);
            let room = surface.terminal_error() + (1e-12 + 1e-14 * condition) * extent;
            assert!(drawn <= room, "{name}: {drawn:e} {room:e} at {at:?}");
            // At corners of cells tangents may be no derivatives; odd parameters are corners of the smallest cells only.
            let is_inside = at.x % 2 == 1 && at.y % 2 == 1 && at.x + at.y < ONE;
            let across = exact.du.cross(exact.dv).length();
            if is_inside && across >= 1e-3 * exact.du.length() * exact.dv.length() {
                let angle = own
                    .normal
                    .cross(exact.normal)
                    .length()
                    .atan2(own.normal.dot(exact.normal));
                assert!(angle < 1e-4, "{name}: {angle:e} rad at {at:?}");
                worst_angle = worst_angle.max(angle);
                normals += 1;
            }
        }
    }
    println!("at most {worst:.1e} of extent and condition, {normals} normals {worst_angle:.1e} rad");
    assert!(normals > 1000, "{normals}");
}
