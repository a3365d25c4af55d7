// A vertex that a split adds starts on the edge that it divides, and slides to the surface while the wish of the node that was split goes
// on growing: so a split moves nothing, and a merge neither. Where a vertex lies is a function of the vertex and the view alone, the same
// for all leaves around it: nothing cracks. Twin: keyleaf-surface `geomorph`.
//
// Departure: the papers slide the vertices of a grid within a leaf (Strugar 2009; Khoury 2.2.1, listing 2.2), which needs grids of 4^2
// triangles or more; this takes single triangles too.
//
// The metric is that of the update. The composer adds what says which vertices pairs leave out.
// requires: shared/place.wgsl, shared/surface.wgsl, shared/frame.wgsl, shared/neighbour.wgsl, shared/direction.wgsl

// The wish at which a vertex has arrived, above that at which it starts. It must, before the next split is due at twice the wish.
const MORPH_WIDTH: f32 = 0.5;
const LATEST_START: f32 = 1.5;

// The base grid is the leaf split k times: its diagonals join vertices whose coordinates have an even sum, those of a single triangle
// excepted.
fn diagonal_line(grid: vec2f) -> f32 {
    let square = vec2i(floor(grid));
    return select(grid.x - grid.y, grid.x + grid.y, ((square.x + square.y) & 1) == 1);
}

fn diagonal_step(at: vec2u, k: u32) -> vec2i {
    return select(vec2i(0), vec2i(1, -1), k == 0u || ((at.x + at.y) & 1u) == 0u);
}

// The leaf of a level with its right angle in the given square of the lattice of that level, in squares. Below the root, right angles are
// where the sum of the coordinates is odd; hypotenuses join the others.
fn leaf_in_square(face: u32, root: u32, square: vec2u, level: u32) -> Place {
    let is_first = ((square.x + square.y) & 1u) == 1u || level == 0u;
    let origin = (square + select(vec2u(1u, 0u), vec2u(0u), is_first)) << vec2u(MAX_LEVEL - level);
    return Place(face, root, origin.x, origin.y, select(1u, 0u, is_first), level);
}

// The leaf on the other side of a side of its square on which a vertex lies: the side towards smaller x, or smaller y.
fn leaf_beside(leaf: Place, square: vec2u, is_side_x: bool) -> Place {
    if is_side_x {
        if square.x == 0u {
            return leaf_in_square(leaf.face, next_root(leaf.face, leaf.root), vec2u(square.y, 0u), leaf.level);
        }
        return leaf_in_square(leaf.face, leaf.root, square - vec2u(1u, 0u), leaf.level);
    }
    if square.y == 0u {
        return leaf_in_square(leaf.face, previous_root(leaf.face, leaf.root), vec2u(0u, square.x), leaf.level);
    }
    return leaf_in_square(leaf.face, leaf.root, square - vec2u(0u, 1u), leaf.level);
}

// The trailing zeros of the coordinates of a vertex: grids have it from the level 31 less these on.
fn zeros_of(at: FaceCoord) -> u32 {
    return min(min(countTrailingZeros(at.x), countTrailingZeros(at.y)), MAX_LEVEL);
}

fn is_of_root(at: FaceCoord) -> bool {
    return MAX_LEVEL - zeros_of(at) <= frame.base_grid;
}

// The level of the nodes whose split adds a vertex, that is of no root's grid.
fn split_level(at: FaceCoord) -> u32 {
    return MAX_LEVEL - zeros_of(at) - frame.base_grid - 1u;
}

fn square_of(at: FaceCoord) -> vec2u {
    return vec2u(at.x, at.y) >> vec2u(MAX_LEVEL - split_level(at));
}

// How far a vertex has come: 0 on the edge that it divides, 1 on the surface.
fn vertex_part(face: u32, at: FaceCoord, position: vec3f) -> f32 {
    if is_of_root(at) {
        return 1.0;
    }
    // On the side of a square, the vertex is drawn when the leaves on both sides are split.
    let level = split_level(at);
    let square = square_of(at);
    let on_side = (square << vec2u(MAX_LEVEL - level)) == vec2u(at.x, at.y);
    let leaf = leaf_in_square(face, at.root, square, level);
    var split = leaf;
    var size = 0.0;
    let leaves = select(1u, 2u, any(on_side));
    for (var i = 0u; i < leaves; i++) {
        let found = metric_size(split, surface_bound(split));
        size = select(min(size, found), found, i == 0u);
        split = leaf_beside(leaf, square, on_side.x);
    }
    if !is_on_hypotenuse(at) {
        size = size_between_pairs(leaf, at, size);
    }

    let there = (frame.world_from_object * vec4f(position - frame.refined_eye, 0.0)).xyz;
    let distance = select(max(length(there), frame.near), 1.0, frame.without_distance == 1u);
    let pressure = exp2(f32(-frame.pressure) / 16.0);
    // A vertex may be nearer than the middle of the hypotenuse, which decides: by no more than the size.
    let reach = frame.wish_when_near * pressure;
    let start = select(LATEST_START, reach / (reach - 1.0), reach > 3.0);
    return saturate((size * frame.wish_scale * pressure / distance - start) / MORPH_WIDTH);
}

// Of the triangle of the next coarser grid; else on a leg.
fn is_on_hypotenuse(at: FaceCoord) -> bool {
    let zeros = zeros_of(at);
    return all(((vec2u(at.x, at.y) >> vec2u(zeros)) & vec2u(1u)) == vec2u(1u));
}

// From a vertex to one end of the edge that it divides, which runs along the lattice or along the hypotenuse of the triangle of the next
// coarser grid.
fn half_edge_of(face: u32, at: FaceCoord) -> vec2u {
    let zeros = zeros_of(at);
    let point = vec2u(at.x, at.y);
    let is_odd = ((point >> vec2u(zeros)) & vec2u(1u)) == vec2u(1u);
    let half = select(vec2u(0u), vec2u(1u << zeros), is_odd);
    let leaf = leaf_in_square(face, at.root, point >> vec2u(zeros + 1u), MAX_LEVEL - zeros - 1u);
    return select(half, vec2u(half.x, 0u - half.y), all(is_odd) && leaf.orientation == 0u);
}

fn drawn_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    var drawn = surface_frame(face, at);
    let part = vertex_part(face, at, drawn.position);
    let ends = select(2u, 0u, part >= 1.0);
    var position = vec3f(0.0);
    var normal = vec3f(0.0);
    for (var i = 0u; i < ends; i++) {
        let half = half_edge_of(face, at);
        let end = vec2u(at.x, at.y) + select(half, vec2u(0u) - half, i == 1u);
        let on = surface_frame(face, FaceCoord(at.root, end.x, end.y));
        position += 0.5 * on.position;
        normal += 0.5 * on.normal;
    }
    if ends != 0u {
        drawn.position = mix(position, drawn.position, part);
        normal = scaled_vector(mix(normal, drawn.normal, part));
        drawn.normal = select(drawn.normal, normalize(normal), any(normal != vec3f(0.0)));
    }
    return drawn;
}
