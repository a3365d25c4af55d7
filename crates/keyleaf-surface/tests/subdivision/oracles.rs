//! Limits, normals and derivatives against tables of OpenSubdiv, where the folder that holds them is there.

use crate::models::{mesh, point_of_domain, settings};
use crate::oracle_tables::{floats, list, oracle};
use glam::DVec3;
use keyleaf_key::RootPoint;
use keyleaf_surface::{
    BoundaryRule, ControlMesh, Corner, Crease, Creasing, INFINITE_SHARPNESS, LoopWeights, MeshError, ParameterError,
    Subdivision, SubdivisionError, SubdivisionScheme, Surface,
};
use serde_json::Value;
use std::collections::HashMap;

const CATMULL_CLARK: [&str; 27] = [
    "chaikin0",
    "cube",
    "cube_corner1",
    "cube_creases0",
    "cube_creases1",
    "dart_edgeonly",
    "edgecorner",
    "edgenone",
    "edgeonly",
    "fan",
    "gregory_test1",
    "gregory_test3",
    "nonman_edges",
    "nonman_verts",
    "nonquads",
    "pole64",
    "pole8",
    "pyramid_creases0",
    "single_crease",
    "spot_control",
    "tent",
    "tent_creases0",
    "toroidal_tet",
    "torus_creases0",
    "val2_interior",
    "xord_boundary",
    "xord_interior",
];

const LOOP: [&str; 18] = [
    "chaikin0",
    "cube",
    "cube_creases0",
    "cube_creases1",
    "icos_semisharp",
    "icosahedron",
    "nonman_edges",
    "nonman_verts",
    "pole64",
    "pole8",
    "saddle_edgecorner",
    "saddle_edgeonly",
    "tetrahedron",
    "triangle_edgecorner",
    "triangle_edgeonly",
    "val2_interior",
    "xord_boundary",
    "xord_interior",
];

/// Tables with edges that three faces share.
const NO_SURFACES: [&str; 4] = ["cc/fan", "cc/nonman_edges", "loop/nonman_edges", "loop/val2_interior"];

fn indices(value: &Value) -> Vec<u32> {
    floats(value).into_iter().map(|x| x as u32).collect()
}

/// The control mesh of a table.
pub fn control(table: &Value) -> ControlMesh {
    let positions = list(&table["verts"])
        .iter()
        .map(|v| DVec3::from_slice(&floats(v)))
        .collect();
    let faces: Vec<Vec<u32>> = list(&table["faces"]).iter().map(indices).collect();
    // OpenSubdiv keeps sharpness in f32.
    let sharpness = |x: f64| f64::from(x as f32);
    let crease = |row: &Value| {
        let row = floats(row);
        Crease {
            vertices: [row[0] as u32, row[1] as u32],
            sharpness: sharpness(row[2]),
        }
    };
    let corner = |row: &Value| {
        let row = floats(row);
        Corner {
            vertex: row[0] as u32,
            sharpness: sharpness(row[1]),
        }
    };
    ControlMesh {
        mesh: mesh(positions, faces),
        creases: list(&table["creases"]).iter().map(crease).collect(),
        corners: list(&table["corners"]).iter().map(corner).collect(),
        boundary: match table["boundary"].as_str() {
            Some("none") => BoundaryRule::None,
            Some("edge_only") => BoundaryRule::Edges,
            _ => BoundaryRule::EdgesAndCorners,
        },
        creasing: Creasing::Uniform,
    }
}

/// All tables, with their surfaces where they have one.
pub fn for_every_table(mut check: impl FnMut(&str, &Value, SubdivisionScheme, &ControlMesh)) {
    let loops = LOOP.map(|name| (format!("loop/{name}"), SubdivisionScheme::Loop(LoopWeights::Loop)));
    let names = CATMULL_CLARK.map(|name| (format!("cc/{name}"), SubdivisionScheme::CatmullClark));
    for (name, scheme) in names.into_iter().chain(loops) {
        let Some(table) = oracle(&format!("{name}.json")) else {
            return;
        };
        check(&name, &table, scheme, &control(&table));
    }
}

/// A face of a refined level: the control face, its domain, and the parameters of its corners.
#[derive(Clone)]
struct Refined {
    face: u32,
    domain: Option<u32>,
    at: Vec<[f64; 2]>,
}

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]
}

/// The faces of the last level with what they are in the control mesh.
fn refined(table: &Value, scheme: SubdivisionScheme) -> (Vec<Vec<u32>>, Vec<Refined>) {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut faces: Vec<Vec<u32>> = list(&table["faces"]).iter().map(indices).collect();
    let mut places: Vec<Refined> = (0..)
        .zip(&faces)
        .map(|(face, corners)| Refined {
            face,
            domain: None,
            at: if corners.len() == 4 {
                square.clone()
            } else {
                vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
            },
        })
        .collect();
    for level in &list(&table["levels"])[1..] {
        let children: Vec<Vec<u32>> = list(&level["faces"]).iter().map(indices).collect();
        let mut below = Vec::new();
        for (corners, place) in faces.iter().zip(&places) {
            let count = corners.len();
            let at = &place.at;
            if scheme == SubdivisionScheme::CatmullClark && count != 4 {
                below.extend((0..count as u32).map(|domain| Refined {
                    face: place.face,
                    domain: Some(domain),
                    at: square.clone(),
                }));
                continue;
            }
            let child = |at: Vec<[f64; 2]>| Refined { at, ..place.clone() };
            let edge = |k: usize| middle(at[k % count], at[(k + 1) % count]);
            if count == 4 {
                let centre = middle(at[0], at[2]);
                below.push(child(vec![at[0], edge(0), centre, edge(3)]));
                below.push(child(vec![edge(0), at[1], edge(1), centre]));
                below.push(child(vec![centre, edge(1), at[2], edge(2)]));
                below.push(child(vec![edge(3), centre, edge(2), at[3]]));
            } else {
                below.push(child(vec![at[0], edge(0), edge(2)]));
                below.push(child(vec![edge(0), at[1], edge(1)]));
                below.push(child(vec![edge(2), edge(1), at[2]]));
                // Whatever order the table has.
                let first = below.len() - 3;
                let of: HashMap<u32, [f64; 2]> = (first..first + 3)
                    .flat_map(|face| children[face].iter().copied().zip(below[face].at.clone()))
                    .collect();
                below.push(child(children[first + 3].iter().map(|vertex| of[vertex]).collect()));
            }
        }
        assert_eq!(children.len(), below.len());
        (faces, places) = (children, below);
    }
    (faces, places)
}

/// The point of a surface, none where the face is not drawn.
fn root_point(surface: &Subdivision, control: &ControlMesh, place: &Refined, at: [f64; 2]) -> Option<RootPoint> {
    let drawn = surface.drawn_faces().binary_search(&place.face).ok()? as u32;
    let corners = control.mesh.faces.get(place.face as usize).expect("a face").len() as u32;
    Some(match place.domain {
        Some(domain) => point_of_domain(drawn, corners, domain, at),
        None => surface.face_coord(place.face, at[0], at[1]).expect("in the face"),
    })
}

fn largest(control: &ControlMesh) -> f64 {
    let positions = control.mesh.positions.iter();
    positions.map(|p| p.abs().max_element()).fold(0.0, f64::max)
}

/// Whether the table has the limit of a vertex of its last level: there its masks take what is still sharp for sharp for ever, all faces
/// for quads, and inner vertices with two faces for corners, which they are not.
fn has_limit(table: &Value, scheme: SubdivisionScheme, control: &ControlMesh, faces: &[Vec<u32>]) -> Vec<bool> {
    let last = list(&table["levels"]).last().expect("a level");
    let steps = last["level"].as_f64().expect("a level");
    let is_left = |sharpness: f64| sharpness > steps && sharpness < INFINITE_SHARPNESS;
    let creases = control.creases.iter().map(|crease| crease.sharpness);
    let corners = control.corners.iter().map(|corner| corner.sharpness);
    let is_sharp = creases.chain(corners).any(is_left);
    let rules = last["rule"].as_str().expect("a rule a vertex").chars();
    let mut has: Vec<bool> = rules.map(|rule| !is_sharp || matches!(rule, 's' | 'b')).collect();
    let mut face_counts = vec![0; has.len()];
    faces
        .iter()
        .flatten()
        .for_each(|&vertex| face_counts[vertex as usize] += 1);
    let rules = last["rule"].as_str().expect("a rule a vertex").chars();
    for ((has, rule), count) in has.iter_mut().zip(rules).zip(face_counts) {
        *has &= !(rule == 's' && count == 2);
    }
    for face in faces {
        if scheme == SubdivisionScheme::CatmullClark && face.len() != 4 {
            face.iter().for_each(|&vertex| has[vertex as usize] = false);
        }
    }
    has
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

#[test]
fn meshes_with_edges_of_three_faces_are_refused() {
    for_every_table(|name, _, scheme, control| {
        let made = Subdivision::new(control, settings(scheme, 2));
        if NO_SURFACES.contains(&name) {
            let error = made.expect_err("an edge with three faces");
            assert!(
                matches!(error, SubdivisionError::Mesh(MeshError::Topology(_))),
                "{name}: {error}"
            );
        } else {
            assert!(made.is_ok(), "{name}: {made:?}");
        }
    });
}

#[test]
fn limit_positions_and_normals_are_those_of_opensubdiv() {
    let (mut worst, mut worst_angle, mut compared) = (0.0, 0.0, [0, 0]);
    for_every_table(|name, table, scheme, control| {
        if NO_SURFACES.contains(&name) {
            return;
        }
        let surface = Subdivision::new(control, settings(scheme, 2)).expect("a surface");
        let last = list(&table["levels"]).last().expect("a level");
        let (faces, places) = refined(table, scheme);
        let has_limit = has_limit(table, scheme, control, &faces);
        let (mut table_worst, mut table_angle): (f64, f64) = (0.0, 0.0);
        for (corners, place) in faces.iter().zip(&places) {
            for (&vertex, &at) in corners.iter().zip(&place.at) {
                let at = root_point(&surface, control, place, at);
                let Some(at) = at.filter(|_| has_limit[vertex as usize]) else {
                    continue;
                };
                let frame = surface.frame(at);
                let limit = DVec3::from_slice(&floats(&last["limit"][vertex as usize]));
                table_worst = table_worst.max(frame.position.distance(limit) / largest(control));
                compared[0] += 1;
                assert!((frame.normal.length() - 1.0).abs() < 1e-12);
                if !last["normal"][vertex as usize].is_null() {
                    let normal = DVec3::from_slice(&floats(&last["normal"][vertex as usize]));
                    table_angle = table_angle.max(angle(frame.normal, normal));
                    compared[1] += 1;
                }
            }
        }
        println!("{name}: {table_worst:.1e} of the largest coordinate, {table_angle:.1e} rad");
        worst = f64::max(worst, table_worst);
        worst_angle = f64::max(worst_angle, table_angle);
    });
    println!("compared {compared:?}");
    assert!(worst < 1e-12, "{worst:e}");
    assert!(worst_angle < 1e-4, "{worst_angle:e}");
}

/// The table has limits at the vertices of all 36 faces, as of boundaries that are sharp. Without a rule for boundaries the 4 faces without a
/// vertex at a boundary are drawn: at their 25 places each the limits are compared, and the other 32 faces have no points at all.
#[test]
fn without_a_rule_for_boundaries_the_faces_inside_have_the_limits_of_opensubdiv_and_others_no_points() {
    let Some(table) = oracle("cc/edgenone.json") else {
        return;
    };
    let control = control(&table);
    assert_eq!(control.boundary, BoundaryRule::None);
    let scheme = SubdivisionScheme::CatmullClark;
    let surface = Subdivision::new(&control, settings(scheme, 8)).expect("a surface");
    let mut uses: HashMap<[u32; 2], u32> = HashMap::new();
    let edges = |corners: &[u32]| -> Vec<[u32; 2]> {
        let ends = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        (0..corners.len()).map(|k| sorted(ends(k))).collect()
    };
    let all = || control.mesh.faces.iter().flat_map(edges);
    all().for_each(|edge| *uses.entry(edge).or_default() += 1);
    let at_boundary: Vec<u32> = all().filter(|edge| uses[edge] == 1).flatten().collect();
    let is_inside = |corners: &[u32]| !corners.iter().any(|vertex| at_boundary.contains(vertex));
    let inside: Vec<u32> = (0..)
        .zip(control.mesh.faces.iter())
        .filter(|(_, corners)| is_inside(corners))
        .map(|(face, _)| face)
        .collect();
    assert_eq!((inside.len(), control.mesh.faces.len()), (4, 36));
    assert_eq!(surface.drawn_faces(), inside);
    let last = list(&table["levels"]).last().expect("a level");
    let (faces, places) = refined(&table, scheme);
    let mut compared = HashMap::new();
    for (corners, place) in faces.iter().zip(&places) {
        for (&vertex, &at) in corners.iter().zip(&place.at) {
            if !inside.contains(&place.face) {
                let error = surface.face_coord(place.face, at[0], at[1]);
                assert_eq!(error, Err(ParameterError::NotDrawn { face: place.face }));
                continue;
            }
            let at = surface.face_coord(place.face, at[0], at[1]).expect("in the face");
            let limit = DVec3::from_slice(&floats(&last["limit"][vertex as usize]));
            let normal = DVec3::from_slice(&floats(&last["normal"][vertex as usize]));
            for frame in [surface.frame(at), surface.drawn(at)] {
                assert!(frame.position.distance(limit) < 1e-12 * largest(&control), "{at:?}");
                assert!(angle(frame.normal, normal) < 1e-6, "{at:?}");
            }
            compared.insert(vertex, at);
        }
    }
    assert_eq!(compared.len(), 100);
}

#[test]
fn samples_inside_faces_are_those_of_opensubdiv() {
    let (mut worst, mut worst_slope, mut compared) = (0.0, 0.0, 0);
    for_every_table(|name, table, scheme, control| {
        let Some(samples) = table["samples"].as_array() else {
            return;
        };
        let surface = Subdivision::new(control, settings(scheme, 2)).expect("a surface");
        let (mut table_worst, mut table_slope): (f64, f64) = (0.0, 0.0);
        for row in samples.iter().map(floats) {
            let at = surface.face_coord(row[0] as u32, row[1], row[2]).expect("in the face");
            let frame = surface.frame(at);
            let [position, du, dv] = [3, 6, 9].map(|k| DVec3::from_slice(&row[k..]));
            table_worst = table_worst.max(frame.position.distance(position) / largest(control));
            if row[12] != 0.0 {
                for (own, exact) in [(frame.du, du), (frame.dv, dv)] {
                    table_slope = table_slope.max(own.distance(exact) / largest(control));
                }
            }
            compared += 1;
        }
        println!("{name}: {table_worst:.1e}, derivatives {table_slope:.1e}");
        worst = f64::max(worst, table_worst);
        worst_slope = f64::max(worst_slope, table_slope);
    });
    println!("compared {compared}");
    // Written with fifteen digits.
    assert!(worst < 1e-12 && worst_slope < 1e-10, "{worst:e} {worst_slope:e}");
}
