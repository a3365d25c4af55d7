//! What the GPU reads: positions computed from the tables alone, addresses, and bounds.

use crate::models::{bezier_model, clamped, model, sheet, sphere, torus};
use crate::random::Random;
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint};
use keyleaf_surface::{BasisMethod, PatchKind, PatchSettings, Patches, Surface, SurfaceTables};

/// The fields of the uniform.
struct Params {
    faces: u32,
    normals: u32,
    half_edges: u32,
    cells: u32,
    edges: u32,
    depth: u32,
    margin: f32,
}

fn params(tables: &SurfaceTables) -> Params {
    let word = |k: usize| u32::from_le_bytes(tables.params[4 * k..4 * k + 4].try_into().expect("four bytes"));
    Params {
        faces: word(0),
        normals: word(1),
        half_edges: word(2),
        cells: word(3),
        edges: word(4),
        depth: word(5),
        margin: f32::from_bits(word(6)),
    }
}

/// The basis functions of a span from its floats.
fn basis(words: &[u32], degree: usize, f: f64, method: BasisMethod) -> Vec<f64> {
    let float = |k: usize| f64::from(f32::from_bits(words[k]));
    let g = 1.0 - f;
    if method == BasisMethod::Extraction {
        let choose = |k: usize| (0..k).fold(1.0, |c, i| c * (degree - i) as f64 / (i + 1) as f64);
        let bernstein = |k: usize| choose(k) * f.powi(k as i32) * g.powi((degree - k) as i32);
        let row = |r: usize| (0..=degree).map(|k| float(r * (degree + 1) + k) * bernstein(k)).sum();
        return (0..=degree).map(row).collect();
    }
    let left = |j: usize| if j < 2 { 0.0 } else { float(j - 2) };
    let right = |j: usize| if j < 2 { 0.0 } else { float(degree - 1 + j - 2) };
    let mut n = vec![1.0];
    for j in 1..=degree {
        let mut next = vec![0.0; j + 1];
        for (r, value) in n.iter().enumerate() {
            let share = value / (1.0 + right(r + 1) + left(j - r));
            next[r] += (g + right(r + 1)) * share;
            next[r + 1] += (f + left(j - r)) * share;
        }
        n = next;
    }
    n
}

/// A point of a face relative to the origin, from the tables alone.
fn position(tables: &SurfaceTables, face: u32, [u, v]: [f64; 2], method: BasisMethod) -> DVec3 {
    let record = &tables.b[4 * face as usize..][..4];
    let (stride, p, q) = (record[1] & 0xff_ffff, (record[1] >> 24) & 15, record[1] >> 28);
    let n = basis(&tables.b[record[2] as usize..], p as usize, u, method);
    let m = basis(&tables.b[record[3] as usize..], q as usize, v, method);
    let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
    for (j, m) in m.iter().enumerate() {
        for (i, n) in n.iter().enumerate() {
            let entry = 4 * (record[0] as usize + i + j * stride as usize);
            let [x, y, z, w] = [0, 1, 2, 3].map(|k| f64::from(tables.a[entry + k]));
            sum += DVec3::new(x, y, z) * (n * m * w);
            weight += n * m * w;
        }
    }
    sum / weight
}

fn all_models() -> Vec<(BasisMethod, Patches)> {
    let methods = [
        BasisMethod::Triangular,
        BasisMethod::Stair,
        BasisMethod::DeBoor,
        BasisMethod::Extraction,
    ];
    let mut models = Vec::new();
    for method in methods {
        let surfaces = vec![
            sheet([3, 2], [clamped(3, &[0.25, 0.5, 0.5]), clamped(2, &[0.3])], 0.5, 1),
            sphere(),
            sheet([1, 4], [clamped(1, &[0.5]), (0..12).map(f64::from).collect()], 0.0, 2),
            torus(),
        ];
        let settings = PatchSettings {
            kind: PatchKind::Nurbs(method),
            ..Default::default()
        };
        models.push((method, Patches::new(surfaces, settings).expect("a model")));
    }
    models.push((
        BasisMethod::Triangular,
        bezier_model(vec![sheet([3, 3], [clamped(3, &[]), clamped(3, &[])], 0.2, 3)]),
    ));
    models
}

#[test]
fn positions_follow_from_the_tables_within_the_margin() {
    let origin = DVec3::new(0.75, -0.5, 2.0);
    for (method, model) in all_models() {
        let tables = model.tables(origin);
        let params = params(&tables);
        assert_eq!(params.faces, model.topology().face_count());
        let mut random = Random(1);
        for _ in 0..400 {
            let face = random.below(params.faces);
            let [u, v] = [0, 1].map(|_| f64::from(random.below(257)) / 256.0);
            let exact = model.point(model.face_coord(face, u, v).expect("in the face")) - origin;
            let off = position(&tables, face, [u, v], method).distance(exact);
            assert!(
                off <= f64::from(params.margin),
                "{method:?} {face} {u} {v}: {off:e} {:e}",
                params.margin
            );
        }
        assert!(params.margin < 2e-5, "{}", params.margin);
    }
}

#[test]
fn half_edges_name_their_owners_and_bounds_are_rounded_up() {
    for (_, model) in all_models() {
        let tables = model.tables(DVec3::ZERO);
        let params = params(&tables);
        let topology = model.topology();
        assert_eq!(params.half_edges, 4 * params.faces);
        assert_eq!(params.cells, params.half_edges + 7 * topology.half_edge_count());
        assert_eq!((params.depth, params.edges), (3, params.cells + 3 * 85 * params.faces));
        assert_eq!(tables.a.len() as u32, 4 * (params.normals + params.faces));
        for normal in tables.a[4 * params.normals as usize..].chunks(4) {
            assert!((DVec3::new(normal[0].into(), normal[1].into(), normal[2].into()).length() - 1.0).abs() < 1e-6);
        }
        let record = |half_edge: u32| &tables.b[(params.half_edges + 7 * half_edge) as usize..][..7];
        let place = |half_edge: u32| Place::of_root(half_edge / 4, half_edge % 4);
        let corner = |half_edge: u32, end: bool| {
            let Place { face, root, .. } = place(half_edge);
            let [x, y] = if end { [0, ONE] } else { [ONE, 0] };
            model.point(RootPoint { face, root, x, y })
        };
        for root in topology.roots() {
            let own = topology.half_edge_index(root.face, root.root);
            let words = record(own);
            let (owner, is_point) = (words[0] & 0x7fff_ffff, words[0] >> 31 == 1);
            let twin = topology
                .twin(root.face, root.root)
                .map(|t| topology.half_edge_index(t.face, t.root));
            assert_eq!(owner, twin.map_or(own, |twin| own.min(twin)));
            assert_eq!(is_point, record(owner)[0] >> 31 == 1);
            let ends = [false, true].map(|end| corner(own, end));
            assert_eq!(ends[0], corner(words[1], false));
            assert_eq!(record(words[1])[1], words[1], "an owner owns itself");
            if is_point {
                let next = root.face * 4 + (root.root + 1) % 4;
                assert_eq!((ends[0], words[1]), (ends[1], record(next)[1]));
            }
            let bound = model.bound(&root);
            let [size, ball] = [2, 3].map(|k| f64::from(f32::from_bits(words[k])));
            assert!(size >= bound.size && ball * 2.0 >= bound.guard);
            assert!(size <= bound.size * (1.0 + 1e-6) && (root.root < 2 || words[4..] == [0; 3]));
        }
    }
}

/// A triangle as the quadtree has them: its hypotenuse along a side of a square of that depth or a finer one, its apex in the middle, or
/// half of it.
fn triangle(random: &mut Random, depth: u32) -> [[f64; 2]; 3] {
    let squares = f64::from(1 << (depth + random.below(3)));
    let corner = [0, 1].map(|_| (random.unit() * squares).floor().min(squares - 1.0));
    let turns = random.below(4);
    let place = |[x, y]: [f64; 2]| {
        let [mut x, mut y] = [x - 0.5, y - 0.5];
        for _ in 0..turns {
            [x, y] = [-y, x];
        }
        [(corner[0] + 0.5 + x) / squares, (corner[1] + 0.5 + y) / squares]
    };
    let whole = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.5]];
    let half = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5]];
    [whole, half][random.below(2) as usize].map(place)
}

#[test]
fn normal_cones_hold_all_normals() {
    let mut random = Random(31);
    let mut models: Vec<Patches> = all_models().into_iter().map(|(_, model)| model).collect();
    models.extend([model(vec![torus()]), model(vec![sphere()])]);
    let mut with_cone = Vec::new();
    for model in &models {
        let mut count = 0;
        let tables = model.tables(DVec3::ZERO);
        let params = params(&tables);
        for face in 0..params.faces {
            let record = |root: u32| &tables.b[(params.half_edges + 7 * (4 * face + root)) as usize..][4..7];
            let floats = |words: &[u32]| [0, 1, 2].map(|k| f64::from(f32::from_bits(words[k])));
            let axis = DVec3::from_array(floats(record(0)));
            let [cosine, sine, _] = floats(record(1));
            let depth = record(1)[2];
            if axis == DVec3::ZERO {
                assert_eq!((cosine, sine, depth), (0.0, 0.0, 0));
                continue;
            }
            assert!((axis.length() - 1.0).abs() < 1e-6 && cosine > 0.0 && (cosine.hypot(sine) - 1.0).abs() < 1e-5);
            count += 1;
            for _ in 0..200 {
                let at = model
                    .face_coord(face, random.unit(), random.unit())
                    .expect("in the square");
                let normal = model.frame(at).normal;
                assert!(
                    normal.dot(axis) >= cosine - 1e-6,
                    "face {face}: {normal} {axis} {cosine}"
                );
            }
            for _ in 0..200 {
                let [a, b, c] = triangle(&mut random, depth).map(|[u, v]| {
                    let at = model.face_coord(face, u, v).expect("in the square");
                    model.frame(at).position
                });
                let normal = (b - a).cross(c - a);
                assert!(
                    normal.dot(axis) >= (cosine - 1e-6) * normal.length(),
                    "face {face}: {normal} {axis} {cosine}"
                );
            }
        }
        with_cone.push(count);
    }
    // All of the torus; not those at the poles of the sphere, whose weights differ there.
    println!("faces with a cone: {with_cone:?}");
    assert_eq!(with_cone[with_cone.len() - 2], 16);
}

#[test]
fn equal_spans_are_stored_once_and_the_shader_follows_the_method() {
    let torus = model(vec![torus()]);
    let tables = torus.tables(DVec3::ZERO);
    // All spans are those of Bézier patches of degree 2: one left, one right, both zero.
    let params = params(&tables);
    assert_eq!(tables.b.len() as u32, params.edges + 4 * 15 * params.faces + 2);
    let shaders: Vec<_> = all_models().iter().map(|(_, model)| model.shader()).collect();
    let expected = [
        "nurbs",
        "nurbs_stair",
        "nurbs_de_boor",
        "nurbs_extraction",
        "bezier_cubic",
    ];
    assert_eq!(shaders, expected.map(|name| format!("surfaces/{name}.wgsl")));
}
