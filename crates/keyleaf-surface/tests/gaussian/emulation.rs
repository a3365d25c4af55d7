//! Positions and normals from the tables alone, with the expressions of the shaders in f32.

use crate::models::Random;
use crate::products::{any_point, condition, meshes, product, shipped};
use glam::{DVec3, Vec3};
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::gaussian::{CovarianceMesh, GaussianProduct};
use keyleaf_surface::{SubdivisionScheme, Surface, SurfaceTables};

const EPS: f64 = 1.0 / 16_777_216.0;

/// As in the shaders, where a mean is 0 if a pivot or the determinant is less.
const LEAST_PIVOT: f32 = 1e-15;

type Dual = [f32; 9];

fn word(tables: &SurfaceTables, k: usize) -> u32 {
    u32::from_le_bytes(tables.params[4 * k..4 * k + 4].try_into().expect("four bytes"))
}

fn entry(tables: &SurfaceTables, k: usize) -> [f32; 4] {
    tables.a[4 * k..4 * k + 4].try_into().expect("four floats")
}

fn plus(a: Dual, b: Dual, weight: f32) -> Dual {
    std::array::from_fn(|k| a[k] + weight * b[k])
}

/// A patch of the tables.
struct Patch<'a> {
    tables: &'a SurfaceTables,
    first: usize,
    points: usize,
}

impl Patch<'_> {
    fn control(&self, place: usize) -> Dual {
        let at = self.first + 3 + 2 * place;
        let [a, b] = [at, at + 1].map(|k| entry(self.tables, k));
        let c = entry(self.tables, self.first + 3 + 2 * self.points + place / 4)[place % 4];
        [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], c]
    }

    fn in_object_space(&self, [x, y, z]: [f32; 3]) -> Vec3 {
        let [a, b, c] = [0, 1, 2].map(|k| Vec3::from_slice(&entry(self.tables, self.first + k)[..3]));
        x * a + y * b + z * c
    }

    fn centre(&self) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|k| entry(self.tables, self.first + k)[3]))
    }
}

/// The node of a point, with its parameters: of a quad u, v, of a triangle barycentric coordinates.
fn patch<'a>(surface: &GaussianProduct, tables: &'a SurfaceTables, at: RootPoint) -> (Patch<'a>, [f32; 3]) {
    let record = 8 * surface.topology().first_half_edge(at.face) as usize;
    let (mut node, first) = (tables.b[record + 5], tables.b[record + 6] as usize);
    let [x, y, z] = [at.x, at.y, at.z()].map(u64::from);
    let is_patch = |node: u32| tables.b[node as usize] >> 31 == 1;
    let number = |node: u32| (tables.b[node as usize] & 0x7fff_ffff) as usize;
    if surface.settings().scheme == SubdivisionScheme::CatmullClark {
        let (a, b) = (at.root, (at.root + 1) % 4);
        let sum = |has: fn(u32) -> bool| z + 2 * (x * u64::from(has(a)) + y * u64::from(has(b)));
        let (mut u, mut v) = (sum(|corner| corner == 1 || corner == 2), sum(|corner| corner >= 2));
        let one = 1u64 << 32;
        while !is_patch(node) {
            let (right, up) = (u64::from(2 * u >= one), u64::from(2 * v >= one));
            (u, v) = (2 * u - right * one, 2 * v - up * one);
            node = tables.b[node as usize] + (right + 2 * up) as u32;
        }
        let [u, v] = [u, v].map(|x| x as f32 / one as f32);
        let first = first + 39 * number(node);
        return (
            Patch {
                tables,
                first,
                points: 16,
            },
            [u, v, 0.0],
        );
    }
    let whole = 3 * u64::from(ONE);
    let mut w = [z; 3];
    w[at.root as usize] += 3 * x;
    w[(at.root as usize + 1) % 3] += 3 * y;
    while !is_patch(node) {
        let doubled = w.map(|weight| 2 * weight);
        let corner = doubled.iter().position(|&weight| weight >= whole);
        w = doubled;
        match corner {
            Some(corner) => w[corner] -= whole,
            None => w = w.map(|weight| whole - weight),
        }
        node = tables.b[node as usize] + corner.unwrap_or(3) as u32;
    }
    let first = first + 37 * number(node);
    (
        Patch {
            tables,
            first,
            points: 15,
        },
        w.map(|weight| weight as f32 / whole as f32),
    )
}

/// Value and both derivatives in dual space.
fn jet(patch: &Patch<'_>, at: [f32; 3]) -> [Dual; 3] {
    let mut jet = [[0.0; 9]; 3];
    if patch.points == 16 {
        let cubic = |f: f32| {
            let g = 1.0 - f;
            [g * g * g, 3.0 * (g * g) * f, 3.0 * g * (f * f), f * f * f]
        };
        let slopes = |f: f32| {
            let g = 1.0 - f;
            let q = [3.0 * (g * g), 3.0 * (2.0 * g * f), 3.0 * (f * f)];
            [-q[0], q[0] - q[1], q[1] - q[2], q[2]]
        };
        let [u, v, _] = at;
        let row = |j: usize, weights: [f32; 4]| {
            (0..4).fold([0.0; 9], |sum, i| plus(sum, patch.control(4 * j + i), weights[i]))
        };
        let quadratic = [3.0 * (1.0 - v) * (1.0 - v), 6.0 * (1.0 - v) * v, 3.0 * v * v];
        for j in 0..4 {
            let own = row(j, cubic(u));
            jet[0] = plus(jet[0], own, cubic(v)[j]);
            jet[1] = plus(jet[1], row(j, slopes(u)), cubic(v)[j]);
            if j > 0 {
                jet[2] = plus(jet[2], plus(own, row(j - 1, cubic(u)), -1.0), quadratic[j - 1]);
            }
        }
        return jet;
    }
    let factorial = [1.0, 1.0, 2.0, 6.0];
    for (j, k) in (0..4).flat_map(|k| (0..4 - k).map(move |j| (j, k))) {
        let i = 3 - j - k;
        let power = |x: f32, n: usize| (0..n).fold(1.0, |product, _| product * x);
        let weight =
            6.0 / (factorial[i] * factorial[j] * factorial[k]) * (power(at[0], i) * power(at[1], j) * power(at[2], k));
        let place = |j: usize, k: usize| j + k * (11 - k) / 2;
        let [p, q, r] = [(j, k), (j + 1, k), (j, k + 1)].map(|(j, k)| patch.control(place(j, k)));
        let sum = plus(plus(p.map(|x| at[0] * x), q, at[1]), r, at[2]);
        jet[0] = plus(jet[0], sum, weight);
        jet[1] = plus(jet[1], plus(q, p, -1.0), 4.0 * weight);
        jet[2] = plus(jet[2], plus(r, p, -1.0), 4.0 * weight);
    }
    jet
}

fn solve_by_ldlt([xx, xy, xz, yy, yz, zz, ..]: Dual, b: [f32; 3]) -> [f32; 3] {
    let (d, o) = ([xx, yy, zz], [yz, xz, xy]);
    let turn = if zz > xx.max(yy) {
        2
    } else if yy > xx {
        1
    } else {
        0
    };
    let turned = |v: [f32; 3]| std::array::from_fn::<f32, 3, _>(|k| v[(k + turn) % 3]);
    let (d, o, b) = (turned(d), turned(o), turned(b));
    let left = [o[2] / d[0], o[1] / d[0]];
    let rest = [d[1] - left[0] * o[2], d[2] - left[1] * o[1]];
    let beside = o[0] - left[0] * o[1];
    let (i, j) = if rest[1] > rest[0] { (1, 0) } else { (0, 1) };
    let below = beside / rest[i];
    let last = rest[j] - below * beside;
    if !(d[0] > LEAST_PIVOT && rest[i] > LEAST_PIVOT && last > LEAST_PIVOT) {
        return [0.0; 3];
    }
    let y1 = b[1 + i] - left[i] * b[0];
    let y2 = b[1 + j] - left[j] * b[0] - below * y1;
    let x2 = y2 / last;
    let x1 = y1 / rest[i] - below * x2;
    let mut x = [b[0] / d[0] - left[i] * x1 - left[j] * x2, 0.0, 0.0];
    (x[1 + i], x[1 + j]) = (x1, x2);
    std::array::from_fn(|k| x[(k + 3 - turn) % 3])
}

fn solve_by_adjugate([xx, xy, xz, yy, yz, zz, ..]: Dual, b: [f32; 3]) -> [f32; 3] {
    let c = [
        yy * zz - yz * yz,
        yz * xz - zz * xy,
        xy * yz - yy * xz,
        zz * xx - xz * xz,
        xz * xy - xx * yz,
        xx * yy - xy * xy,
    ];
    let determinant = xx * c[0] + xy * c[1] + xz * c[2];
    if determinant.is_nan() || determinant <= LEAST_PIVOT {
        return [0.0; 3];
    }
    times(c, b).map(|x| x / determinant)
}

fn times([xx, xy, xz, yy, yz, zz]: [f32; 6], [x, y, z]: [f32; 3]) -> [f32; 3] {
    [
        xx * x + xy * y + xz * z,
        yy * y + yz * z + xy * x,
        zz * z + xz * x + yz * y,
    ]
}

type Solver = fn(Dual, [f32; 3]) -> [f32; 3];

/// Position and the cross product of the derivatives' directions.
fn frame(patch: &Patch<'_>, at: [f32; 3], solve: Solver) -> (Vec3, Vec3) {
    let [value, du, dv] = jet(patch, at);
    let precision = |d: Dual| -> [f32; 6] { std::array::from_fn(|k| d[k]) };
    let information = |d: Dual| [d[6], d[7], d[8]];
    let mean = solve(value, information(value));
    let [du, dv] = [du, dv].map(|rate| {
        let moved = times(precision(rate), mean);
        let right = std::array::from_fn(|k| information(rate)[k] - moved[k]);
        patch.in_object_space(solve(value, right))
    });
    let scaled = |v: Vec3| v / v.abs().max_element().max(1e-30);
    (
        patch.centre() + patch.in_object_space(mean),
        scaled(du).cross(scaled(dv)),
    )
}

/// What the tables allow for rounding, object units.
pub fn rounding_margin(surface: &GaussianProduct, origin: DVec3) -> f64 {
    f64::from(f32::from_bits(word(&surface.tables(origin), 3))) - 2.0 * surface.terminal_error()
}

/// Points that can be evaluated here: of polygons with other than four corners it is only by their domains.
fn points(surface: &GaussianProduct, count: usize, random: &mut Random) -> Vec<RootPoint> {
    let is_loop = surface.settings().scheme != SubdivisionScheme::CatmullClark;
    let points = std::iter::repeat_with(|| any_point(surface, random)).take(count);
    points
        .filter(|at| is_loop || surface.topology().corner_count(at.face) == 4)
        .collect()
}

/// Largest error of positions by LDLᵀ and by the adjugate, object units.
pub fn position_errors(surface: &GaussianProduct, origin: DVec3, count: usize, random: &mut Random) -> [f64; 2] {
    let tables = surface.tables(origin);
    let mut errors = [0.0f64; 2];
    for at in points(surface, count, random) {
        let exact = surface.approximate(at).position;
        let (patch, inner) = patch(surface, &tables, at);
        for (solver, error) in [solve_by_ldlt as Solver, solve_by_adjugate]
            .into_iter()
            .zip(&mut errors)
        {
            let (position, _) = frame(&patch, inner, solver);
            *error = error.max((position.as_dvec3() + origin).distance(exact));
        }
    }
    errors
}

/// Largest error of positions by LDLᵀ and by the adjugate, in units of 2⁻²⁴ of the size of the surface; the largest part of the margin
/// that LDLᵀ uses; and the largest error of its normals.
fn measured(mesh: &CovarianceMesh, scheme: SubdivisionScheme) -> ([f64; 2], f64, f64) {
    let surface = product(mesh, scheme, 8);
    let (low, high) = surface.bounding_box();
    let origin = (low + high) / 2.0 + DVec3::new(1e-3, 0.0, -2e-3);
    let tables = surface.tables(origin);
    assert_eq!(tables.a.len() as u32, 4 * (word(&tables, 1) + word(&tables, 0)));
    let errors = position_errors(&surface, origin, 1500, &mut Random(99));
    let of_margin = errors[0] / rounding_margin(&surface, origin);
    let mut angle = 0.0f64;
    for at in points(&surface, 1500, &mut Random(99)) {
        let exact = surface.approximate(at);
        let (patch, inner) = patch(&surface, &tables, at);
        let is_definite = solve_by_ldlt(jet(&patch, inner)[0], [1.0; 3]) != [0.0; 3];
        assert!(is_definite, "{at:?}");
        let (_, cross) = frame(&patch, inner, solve_by_ldlt);
        // The derivatives' angle and lengths decide what f32 can tell.
        let sine = cross.as_dvec3().length();
        if sine > 1e-2 && exact.du.length().min(exact.dv.length()) > 1e-3 * low.distance(high) {
            angle = angle.max(cross.as_dvec3().normalize().distance(exact.normal));
        }
    }
    (errors.map(|error| error / (EPS * low.distance(high))), of_margin, angle)
}

#[test]
fn positions_and_normals_follow_from_the_tables_in_f32() {
    println!("largest errors over 2^-24 of the extent by LDLt and the adjugate; part of the margin; normals");
    let mut all = meshes();
    for name in ["gauss_cube", "gauss_wirecube", "gauss_cylinder", "gauss_anvil"] {
        let model = shipped(name).map(|mesh| (name.to_owned(), SubdivisionScheme::CatmullClark, mesh));
        all.extend(model);
    }
    for (name, scheme, mesh) in all {
        let ([error, adjugate], of_margin, angle) = measured(&mesh, scheme);
        let condition = condition(&mesh);
        println!("{name} ({condition:.0e}): {error:.1}, {adjugate:.1}; {of_margin:.3}; {angle:.1e}");
        assert!(error <= 64.0 * condition, "{name}");
        assert!(of_margin <= 1.0, "{name}: {of_margin}");
        assert!(angle < 1e-3, "{name}: {angle}");
    }
}

#[test]
fn the_shader_of_equal_round_covariances_is_plain_subdivision() {
    for (name, scheme, mesh) in meshes() {
        let round = CovarianceMesh::isotropic(mesh.control().clone(), 0.2).expect("a mesh");
        let surface = product(&round, scheme, 8);
        let plain = crate::products::plain(&round, scheme, 8);
        let tables = surface.tables(DVec3::ZERO);
        let (low, high) = plain.bounding_box();
        let largest = low.abs().max(high.abs()).max_element();
        let mut random = Random(3);
        for _ in 0..300 {
            let at = any_point(&surface, &mut random);
            if scheme == SubdivisionScheme::CatmullClark && surface.topology().corner_count(at.face) != 4 {
                continue;
            }
            let (patch, inner) = patch(&surface, &tables, at);
            let (position, _) = frame(&patch, inner, solve_by_ldlt);
            let off = position.as_dvec3().distance(plain.approximate(at).position) / (EPS * largest);
            assert!(off <= 16.0, "{name}: {off}");
        }
    }
}
