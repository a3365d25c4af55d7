//! Shapes drawn at random: valences 3 to 13, polygons to 11 corners, boundaries, creases and corners. What the tables give in f32 is the
//! limit surface, and normals are those of its positions.

use crate::global_refinement::any_sharpness;
use crate::models::{LOOP, Random, disc, point_of_domain, prism, settings};
use glam::{DVec3, Vec3};
use keyleaf_key::{ONE, RootPoint, Topology};
use keyleaf_surface::{BoundaryRule, ControlMesh, Creasing, Subdivision, SubdivisionScheme, Surface, SurfaceTables};

const CATMULL_CLARK: SubdivisionScheme = SubdivisionScheme::CatmullClark;

/// Rounding of a position in f32, in units of the largest coordinate.
const POSITION_BOUND: f64 = 16.0 / 16_777_216.0;
const NORMAL_BOUND: f64 = 1e-4;

/// In a terminal patch, away from its corner: with many faces about it the surface flattens slowly there, by a tenth in ten steps.
const TERMINAL_NORMAL_BOUND: f64 = 0.05;

struct Shape {
    name: String,
    is_smooth: bool,
    control: ControlMesh,
    scheme: SubdivisionScheme,
}

/// Discs about a vertex of every valence, prisms over every polygon, and prisms without one of their polygons.
fn shapes(random: &mut Random) -> Vec<Shape> {
    let open = |n: u32| {
        let mut control = prism(n);
        control.mesh.faces = control.mesh.faces.iter().skip(1).collect();
        control
    };
    let mut shapes = Vec::new();
    for n in 3..=13 {
        let mut kinds = vec![
            ("disc", disc(n, CATMULL_CLARK), CATMULL_CLARK),
            ("disc", disc(n, LOOP), LOOP),
        ];
        if n <= 11 {
            kinds.extend([
                ("prism", prism(n), CATMULL_CLARK),
                ("open prism", open(n), CATMULL_CLARK),
            ]);
        }
        for (name, control, scheme) in kinds {
            let (mut smooth, mut sharp) = (control.clone(), any_sharpness(control, random));
            for control in [&mut smooth, &mut sharp] {
                control
                    .mesh
                    .positions
                    .iter_mut()
                    .for_each(|p| *p += random.vector() * 0.1);
                control.boundary = [BoundaryRule::Edges, BoundaryRule::EdgesAndCorners][random.below(2) as usize];
                control.creasing = [Creasing::Uniform, Creasing::Chaikin][random.below(2) as usize];
            }
            for (what, control) in [("smooth", smooth), ("sharp", sharp)] {
                let name = format!("{what} {name} of {n}, {scheme:?}");
                let is_smooth = what == "smooth";
                shapes.push(Shape {
                    name,
                    is_smooth,
                    control,
                    scheme,
                });
            }
        }
    }
    shapes
}

/// A point of a face in the tables: the domain and its parameters there, which are exact in f32; and the same point of the surface.
struct Place {
    half_edge: u32,
    at: [u32; 2],
    point: RootPoint,
    /// Whether it lies near a corner of the domain, but is none.
    is_in_terminal: bool,
    /// The corner of the face that the point is or lies near, if it does.
    corner: Option<u32>,
}

/// Parameters are multiples of 1 / STEPS.
const STEPS: u32 = 1 << 12;

/// So near to a corner there are terminal patches.
const NEAR: u32 = STEPS >> 8;

/// Whether a vertex has a unique normal that cells near it approach: nothing is sharp, and it is inside.
fn is_smooth_inside(topology: &Topology, vertex: u32) -> bool {
    topology.roots().all(|root| {
        let corners = topology.vertices(root.face);
        let next = corners[(root.root as usize + 1) % corners.len()];
        let touches = corners[root.root as usize] == vertex || next == vertex;
        !touches || topology.twin(root.face, root.root).is_some()
    })
}

fn any_place(surface: &Subdivision, random: &mut Random) -> Place {
    let topology = surface.topology();
    let face = random.below(topology.face_count());
    let corners = topology.corner_count(face);
    let is_triangle = surface.scheme() != CATMULL_CLARK;
    // Inside, on an edge, at a corner, and near one.
    let any = |random: &mut Random, end: u32| match random.below(4) {
        0 => 0,
        1 => random.below(end.min(9) + 1),
        _ => random.below(end + 1),
    };
    let s = any(random, STEPS);
    let t = any(random, if is_triangle { STEPS - s } else { STEPS });
    let [u, v] = [s, t].map(|x| f64::from(x) / f64::from(STEPS));
    let first = topology.first_half_edge(face);
    let near = |x: u32| {
        if x < NEAR {
            Some(0)
        } else {
            (x + NEAR > STEPS).then_some(1)
        }
    };
    let is_in_terminal = near(s).is_some() && near(t).is_some() && [s, t].iter().any(|x| x % STEPS != 0);
    if is_triangle || corners == 4 {
        let point = surface.face_coord(face, u, v).expect("in the face");
        let corner = match (near(s), near(t)) {
            (Some(0), Some(0)) => Some(0),
            (Some(1), Some(0)) => Some(1),
            (Some(1), Some(1)) => Some(2),
            (Some(0), Some(1)) => Some(if is_triangle { 2 } else { 3 }),
            _ => None,
        };
        return Place {
            half_edge: first,
            at: [s, t],
            point,
            is_in_terminal,
            corner,
        };
    }
    let domain = random.below(corners);
    Place {
        half_edge: first + domain,
        at: [s, t],
        point: point_of_domain(face, corners, domain, [u, v]),
        is_in_terminal,
        corner: (near(s) == Some(0) && near(t) == Some(0)).then_some(domain),
    }
}

/// The first entry of the patch at a point of a domain, and the parameters there.
fn patch(tables: &SurfaceTables, half_edge: u32, at: [u32; 2], is_triangle: bool) -> (usize, [f32; 3]) {
    let record = 8 * half_edge as usize;
    let (mut node, entry) = (tables.b[record + 5] as usize, tables.b[record + 6] as usize);
    let [mut s, mut t] = at.map(i64::from);
    let one = i64::from(STEPS);
    while tables.b[node] >> 31 == 0 {
        let child = if is_triangle {
            let r = one - s - t;
            let halved = [2 * r >= one, 2 * s >= one, 2 * t >= one];
            let child = halved.iter().position(|&is| is).unwrap_or(3);
            [s, t] = match child {
                0 => [2 * s, 2 * t],
                1 => [2 * s - one, 2 * t],
                2 => [2 * s, 2 * t - one],
                _ => [one - 2 * s, one - 2 * t],
            };
            child
        } else {
            let (right, up) = (i64::from(2 * s >= one), i64::from(2 * t >= one));
            (s, t) = (2 * s - right * one, 2 * t - up * one);
            (right + 2 * up) as usize
        };
        node = tables.b[node] as usize + child;
    }
    let number = (tables.b[node] & 0x7fff_ffff) as usize;
    let size = if is_triangle { 15 } else { 16 };
    let [u, v, w] = [s, t, one - s - t].map(|x| x as f32 / one as f32);
    (entry + size * number, if is_triangle { [w, u, v] } else { [u, v, 0.0] })
}

/// Position and derivatives of a Bézier patch in f32: sums of differences to its first control point.
fn evaluated(tables: &SurfaceTables, first: usize, at: [f32; 3], is_triangle: bool) -> [Vec3; 3] {
    let entry = |k: usize| Vec3::from_slice(&tables.a[4 * (first + k)..4 * (first + k) + 3]);
    let net = |k: usize| if k == 0 { Vec3::ZERO } else { entry(k) };
    let mut sums = [Vec3::ZERO; 3];
    if is_triangle {
        let choose = |n: usize, [i, j, k]: [usize; 3]| {
            let factorial = |n: usize| (1..=n).product::<usize>();
            let places = (factorial(n) / factorial(i) / factorial(j) / factorial(k)) as f32;
            places * at[0].powi(i as i32) * at[1].powi(j as i32) * at[2].powi(k as i32)
        };
        let index = |j: usize, k: usize| (0..k).map(|k| 5 - k).sum::<usize>() + j;
        for k in 0..=4 {
            for j in 0..=4 - k {
                let i = 4 - j - k;
                sums[0] += net(index(j, k)) * choose(4, [i, j, k]);
                if i > 0 {
                    let weight = choose(3, [i - 1, j, k]);
                    sums[1] += (net(index(j + 1, k)) - net(index(j, k))) * weight;
                    sums[2] += (net(index(j, k + 1)) - net(index(j, k))) * weight;
                }
            }
        }
    } else {
        let cubic = |t: f32| {
            [
                (1.0 - t).powi(3),
                3.0 * (1.0 - t).powi(2) * t,
                3.0 * (1.0 - t) * t * t,
                t * t * t,
            ]
        };
        let quadratic = |t: f32| [(1.0 - t) * (1.0 - t), 2.0 * (1.0 - t) * t, t * t];
        let [u, v, _] = at;
        for (j, i) in (0..4).flat_map(|j| (0..4).map(move |i| (j, i))) {
            sums[0] += net(4 * j + i) * (cubic(u)[i] * cubic(v)[j]);
            if i < 3 {
                sums[1] += (net(4 * j + i + 1) - net(4 * j + i)) * (quadratic(u)[i] * cubic(v)[j]);
            }
            if j < 3 {
                sums[2] += (net(4 * j + i + 4) - net(4 * j + i)) * (cubic(u)[i] * quadratic(v)[j]);
            }
        }
    }
    sums[0] += entry(0);
    sums
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

#[test]
fn the_tables_of_random_shapes_give_the_limit_surface_in_f32() {
    let mut random = Random(101);
    // Of squares, triangles and terminal patches.
    let (mut worst, mut worst_angle, mut normals) = ([0.0f64; 3], [0.0f64; 3], 0);
    for shape in shapes(&mut random) {
        let Shape { name, control, .. } = &shape;
        let is_triangle = shape.scheme != CATMULL_CLARK;
        let surface = Subdivision::new(control, settings(shape.scheme, 10)).expect("a surface");
        let (tables, faces) = (surface.tables(DVec3::ZERO), control.mesh.topology().expect("a mesh"));
        let coordinates = control.mesh.positions.iter().map(|p| p.abs().max_element());
        let largest = coordinates.fold(0.0, f64::max);
        for _ in 0..150 {
            let place = any_place(&surface, &mut random);
            let (first, at) = patch(&tables, place.half_edge, place.at, is_triangle);
            let [position, du, dv] = evaluated(&tables, first, at, is_triangle).map(|v| v.as_dvec3());
            let exact = surface.frame(place.point);
            let what = format!("{name} at {:?} of {:?}", place.at, place.point);
            let kind = if place.is_in_terminal {
                2
            } else {
                usize::from(is_triangle)
            };
            let terminal = if place.is_in_terminal {
                surface.terminal_error()
            } else {
                0.0
            };
            let off = (position.distance(exact.position) - terminal) / largest;
            assert!(off <= POSITION_BOUND, "{what}: {off:e}");
            worst[kind] = worst[kind].max(position.distance(exact.position) / largest);
            // Where the limit has a tangent plane that is not nearly a line.
            let is_plane = |a: DVec3, b: DVec3| a.cross(b).length() >= (1e-3 * a.length() * b.length()).max(1e-300);
            let vertex = place.corner.map(|corner| faces.vertex(place.point.face, corner));
            let has_normal = vertex.is_none_or(|vertex| shape.is_smooth && is_smooth_inside(&faces, vertex));
            if has_normal && is_plane(du, dv) && is_plane(exact.du, exact.dv) {
                let off = angle(du.cross(dv), exact.normal);
                assert!(
                    off <= [NORMAL_BOUND, NORMAL_BOUND, TERMINAL_NORMAL_BOUND][kind],
                    "{what}: {off:e} rad"
                );
                worst_angle[kind] = worst_angle[kind].max(off);
                normals += 1;
            }
        }
    }
    for (kind, (worst, worst_angle)) in ["squares", "triangles", "terminal patches"]
        .iter()
        .zip(worst.iter().zip(worst_angle))
    {
        println!("{kind}: positions {worst:.1e} of the largest coordinate, normals {worst_angle:.1e} rad");
    }
    assert!(normals > 5000, "{normals}");
}

/// By differences of positions, which have been compared with those of refined meshes.
#[test]
fn normals_of_random_shapes_are_those_of_their_positions() {
    let mut random = Random(102);
    let (mut worst, mut count) = (0.0f64, 0);
    for Shape {
        name, control, scheme, ..
    } in shapes(&mut random)
    {
        let surface = Subdivision::new(&control, settings(scheme, 2)).expect("a surface");
        for _ in 0..60 {
            let topology = surface.topology();
            let face = random.below(topology.face_count());
            let root = random.below(topology.corner_count(face));
            // Inside the root, also near its corners.
            let step = ONE >> 20;
            let room = ONE >> (1 + random.below(7));
            let [x, y] = [0, 1].map(|_| step + random.below(room - 2 * step));
            let point = |x: u32, y: u32| surface.point(RootPoint { face, root, x, y });
            let across = point(x + step, y) - point(x - step, y);
            let up = point(x, y + step) - point(x, y - step);
            let normal = across.cross(up);
            if normal.length() < 1e-3 * across.length() * up.length() {
                continue;
            }
            let own = surface.frame(RootPoint { face, root, x, y }).normal;
            let off = angle(own, normal);
            assert!(
                off <= NORMAL_BOUND,
                "{name}: {off:e} rad at {x} {y} of root {root} of face {face}"
            );
            worst = worst.max(off);
            count += 1;
        }
    }
    println!("{count} normals: at most {worst:.1e} rad");
    assert!(count > 3000, "{count}");
}
