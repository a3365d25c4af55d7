//! What the GPU reads: positions and normals computed from the tables alone in f32, as a shader would.

use crate::models::{LOOP, Random, any_point, settings};
use crate::oracles::for_every_table;
use glam::{DVec3, Vec3};
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{Subdivision, SubdivisionScheme, Surface, SurfaceTables};

struct Params {
    faces: u32,
    normals: u32,
    nodes: u32,
    margin: f32,
}

fn params(tables: &SurfaceTables) -> Params {
    let word = |k: usize| u32::from_le_bytes(tables.params[4 * k..4 * k + 4].try_into().expect("four bytes"));
    Params {
        faces: word(0),
        normals: word(1),
        nodes: word(2),
        margin: f32::from_bits(word(3)),
    }
}

fn entry(tables: &SurfaceTables, k: usize) -> Vec3 {
    Vec3::from_slice(&tables.a[4 * k..4 * k + 3])
}

/// The entry of the first control point of the patch at a point of a quad with this first half-edge, and the point in the patch.
fn quad_patch(tables: &SurfaceTables, half_edge: u32, at: RootPoint) -> (usize, [f32; 2]) {
    let record = 8 * half_edge as usize;
    let (mut node, entry) = (tables.b[record + 5], tables.b[record + 6] as usize);
    let [x, y, z] = [at.x, at.y, at.z()].map(u64::from);
    let (a, b) = (at.root, (at.root + 1) % 4);
    let sum = |has: fn(u32) -> bool| z + 2 * (x * u64::from(has(a)) + y * u64::from(has(b)));
    let (mut u, mut v) = (sum(|corner| corner == 1 || corner == 2), sum(|corner| corner >= 2));
    let one = 1u64 << 32;
    while tables.b[node as usize] >> 31 == 0 {
        let (right, up) = (u64::from(2 * u >= one), u64::from(2 * v >= one));
        (u, v) = (2 * u - right * one, 2 * v - up * one);
        node = tables.b[node as usize] + (right + 2 * up) as u32;
    }
    let patch = (tables.b[node as usize] & 0x7fff_ffff) as usize;
    (entry + 16 * patch, [u, v].map(|x| x as f32 / one as f32))
}

fn frame(tables: &SurfaceTables, first: usize, [u, v]: [f32; 2]) -> (Vec3, Vec3) {
    let net = |i: usize, j: usize| {
        if i + j == 0 {
            Vec3::ZERO
        } else {
            entry(tables, first + 4 * j + i)
        }
    };
    let cubic = |t: f32| {
        let s = 1.0 - t;
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    };
    let quadratic = |t: f32| [(1.0 - t) * (1.0 - t), 2.0 * (1.0 - t) * t, t * t];
    let (mut sum, mut du, mut dv) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
    for j in 0..4 {
        for i in 0..4 {
            sum += net(i, j) * (cubic(u)[i] * cubic(v)[j]);
            if i < 3 {
                du += (net(i + 1, j) - net(i, j)) * (quadratic(u)[i] * cubic(v)[j]);
            }
            if j < 3 {
                dv += (net(i, j + 1) - net(i, j)) * (cubic(u)[i] * quadratic(v)[j]);
            }
        }
    }
    let scaled = |v: Vec3| v / v.abs().max_element().max(1e-30);
    (entry(tables, first) + sum, scaled(du).cross(scaled(dv)))
}

#[test]
fn positions_and_normals_follow_from_the_tables_in_f32() {
    let mut random = Random(1);
    let (mut worst, mut worst_angle, mut count): (f64, f64, u32) = (0.0, 0.0, 0);
    for_every_table(|name, _, scheme, control| {
        let Ok(surface) = Subdivision::new(control, settings(scheme, 8)) else {
            return;
        };
        if scheme == LOOP {
            return;
        }
        let origin = DVec3::new(0.25, -0.5, 0.125);
        let tables = surface.tables(origin);
        let params = params(&tables);
        assert_eq!(params.faces, surface.topology().face_count());
        assert_eq!(tables.a.len() as u32, 4 * (params.normals + params.faces));
        let mut check = |at: RootPoint| {
            let (first, uv) = quad_patch(&tables, surface.topology().first_half_edge(at.face), at);
            let exact = surface.approximate(at);
            let (position, cross) = frame(&tables, first, uv);
            let off = (position.as_dvec3() + origin).distance(exact.position) / f64::from(params.margin);
            let sine = cross.as_dvec3().length();
            if sine > 1e-3 {
                worst_angle = worst_angle.max(cross.as_dvec3().normalize().cross(exact.normal).length());
            }
            worst = worst.max(off);
            count += 1;
            assert!(off <= 1.0, "{name}: {off} margins at {at:?}");
        };
        for _ in 0..200 {
            let at = any_point(&surface, &mut random);
            if surface.topology().corner_count(at.face) == 4 {
                check(at);
                // Deep at the corner of a face.
                let x = ONE - random.below(ONE >> 9);
                check(RootPoint {
                    x,
                    y: random.below(ONE - x + 1),
                    ..at
                });
            }
        }
    });
    println!("{count} points: at most {worst:.2} margins, {worst_angle:.1e} rad");
    assert!(worst_angle < 1e-4, "{worst_angle:e}");
}

#[test]
fn half_edges_name_owners_that_own_themselves_and_bounds_are_rounded_up() {
    for_every_table(|name, _, scheme, control| {
        let Ok(surface) = Subdivision::new(control, settings(scheme, 4)) else {
            return;
        };
        let (tables, topology) = (surface.tables(DVec3::ZERO), surface.topology());
        let params = params(&tables);
        let record = |half_edge: u32| &tables.b[(8 * half_edge) as usize..][..8];
        assert_eq!(params.nodes, 8 * topology.half_edge_count());
        for root in topology.roots() {
            let own = topology.half_edge_index(root.face, root.root);
            let words = record(own);
            let twin = topology
                .twin(root.face, root.root)
                .map(|t| topology.half_edge_index(t.face, t.root));
            assert_eq!(words[0], twin.map_or(own, |twin| own.min(twin)), "{name}");
            assert_eq!(record(words[1])[1], words[1], "an owner owns itself");
            let bound = surface.bound(&root);
            let [size, ball, deviation] = [2, 3, 4].map(|k| f64::from(f32::from_bits(words[k])));
            assert!(
                size >= bound.size && 2.0 * ball <= bound.guard * (1.0 + 1e-6) + 1e-30 && deviation >= bound.deviation
            );
            let corners = topology.corner_count(root.face);
            let has_domain = root.root == 0 || scheme == SubdivisionScheme::CatmullClark && corners != 4;
            assert_eq!(words[5] >= params.nodes, has_domain, "{name}");
        }
    });
}
