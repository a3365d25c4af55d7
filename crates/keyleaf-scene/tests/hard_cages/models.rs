//! OBJ models that are hard.

pub fn vertices(positions: impl IntoIterator<Item = [f64; 3]>) -> String {
    let line = |[x, y, z]: [f64; 3]| format!("v {x:e} {y:e} {z:e}\n");
    positions.into_iter().map(line).collect()
}

/// A face a line, vertices from 1.
pub fn faces<F: AsRef<[usize]>>(faces: impl IntoIterator<Item = F>) -> String {
    let line = |face: F| {
        let corners: Vec<String> = face.as_ref().iter().map(usize::to_string).collect();
        format!("f {}\n", corners.join(" "))
    };
    faces.into_iter().map(line).collect()
}

fn on_circle(count: usize) -> impl Iterator<Item = [f64; 3]> {
    (0..count).map(move |k| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        [angle.cos(), angle.sin(), 0.1 * (3.0 * angle).sin()]
    })
}

pub const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// A closed tetrahedron of this size.
pub fn tetrahedron(size: f64) -> String {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    vertices(corners.map(|corner| corner.map(|x| x * size))) + &faces([[1, 2, 3], [1, 4, 2], [1, 3, 4], [2, 4, 3]])
}

/// Name and text of models of triangles that are hard, but have surfaces of all kinds.
pub fn hard_triangles() -> Vec<(&'static str, String)> {
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let tent = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1.0, 0.3], [1.5, 1.0, 0.0]];
    let two = [[1, 2, 3], [3, 2, 4]];
    let apart = [[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [9.0, 1.0, 0.0]];
    let cone = |count: usize| {
        let rim = |k: usize| [1, 2 + k, 2 + (k + 1) % count];
        vertices([[0.0, 0.0, 0.7]].into_iter().chain(on_circle(count))) + &faces((0..count).map(rim))
    };
    vec![
        ("one", vertices(flat) + &faces([[1, 2, 3]])),
        ("back_to_back", vertices(flat) + &faces([[1, 2, 3], [3, 2, 1]])),
        (
            "unused_vertices",
            vertices([[9e14; 3]]) + &vertices(tent) + &faces([[2, 3, 4], [4, 3, 5]]),
        ),
        (
            "two_parts",
            vertices(flat) + &vertices(apart) + &faces([[1, 2, 3], [4, 5, 6]]),
        ),
        (
            "parts_of_opposite_winding",
            vertices(flat) + &vertices(apart) + &faces([[1, 2, 3], [6, 5, 4]]),
        ),
        (
            "bow_tie",
            vertices(flat) + &vertices([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.5]]) + &faces([[1, 2, 3], [1, 4, 5]]),
        ),
        (
            "no_area",
            vertices([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]) + &faces(two),
        ),
        (
            "on_a_line",
            vertices([0.0, 1.0, 2.0, 3.0].map(|x| [x, -x, 2.0 * x])) + &faces(two),
        ),
        (
            "sliver",
            vertices([[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-12, 0.0], [0.5, 1.0, 0.0]]) + &faces(two),
        ),
        ("tiny", tetrahedron(1e-30)),
        ("huge", tetrahedron(9e14)),
        (
            "tiny_in_huge",
            tetrahedron(1e-30) + &vertices(flat.map(|p| p.map(|x| x * 1e15))) + &faces([[5, 6, 7]]),
        ),
        ("far_away", vertices(tent.map(|p| p.map(|x| x + 1e14))) + &faces(two)),
        ("valence_3", cone(3)),
        ("valence_300", cone(300)),
    ]
}

/// Name and text of models of polygons that are hard, but have surfaces.
pub fn hard_polygons() -> Vec<(&'static str, String)> {
    let centred = |corners: [f64; 3]| vertices(SQUARE) + &vertices([corners]);
    let polygon = |count: usize| vertices(on_circle(count)) + &faces([(1..=count).collect::<Vec<_>>()]);
    let drum = |count: usize| {
        let lower = |k: usize| 1 + k % count;
        let upper = |k: usize| 1 + count + k % count;
        let sides = (0..count).map(|k| vec![lower(k), lower(k + 1), upper(k + 1), upper(k)]);
        let caps = [(0..count).rev().map(lower).collect(), (0..count).map(upper).collect()];
        let raised = on_circle(count).map(|[x, y, z]| [x, y, z + 1.0]);
        vertices(on_circle(count).chain(raised)) + &faces(sides.chain(caps))
    };
    vec![
        (
            "two_common_edges",
            centred([0.5, 0.5, 1.0]) + &faces([[1, 2, 3, 4], [3, 2, 1, 5]]),
        ),
        ("pillow", vertices(SQUARE) + &faces([[1, 2, 3, 4], [4, 3, 2, 1]])),
        (
            "triangle_on_quad",
            centred([2.0, 0.5, 1.0]) + &faces([&[1, 2, 3, 4][..], &[3, 2, 5]]),
        ),
        (
            "concave",
            vertices([[0.0; 3], [2.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.5, 1.0, 0.0]]) + &faces([[1, 2, 3, 4]]),
        ),
        ("crossed", vertices(SQUARE) + &faces([[1, 3, 2, 4]])),
        (
            "bow_tie_of_quads",
            vertices(SQUARE)
                + &vertices(SQUARE.map(|p| p.map(|x| -x))[1..].iter().copied())
                + &faces([[1, 2, 3, 4], [1, 5, 6, 7]]),
        ),
        ("corners_300", polygon(300)),
        ("drum_of_300", drum(300)),
        ("drum_of_11", drum(11)),
        ("drum_of_3", drum(3)),
        (
            "valence_2_in_closed_mesh",
            centred([0.5, 0.5, 1.0]) + &faces([[1, 2, 3, 5], [3, 2, 1, 4], [1, 5, 3, 4]]),
        ),
    ]
}
