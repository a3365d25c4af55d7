// The knots about a span, relative to the span and its length. Twin: keyleaf-surface `knots`.
// requires: shared/patch.wgsl

// How far u is beyond knot x(i + 1 - j), and how far before x(i + j), in lengths of the span; j = 1..p at index j.
struct Knots {
    left: array<f32, 8>,
    right: array<f32, 8>,
}

fn knots_about(span: u32, degree: u32, f: f32, g: f32) -> Knots {
    var knots: Knots;
    knots.left[1] = f;
    knots.right[1] = g;
    for (var j = 2u; j <= degree; j++) {
        knots.left[j] = f + bitcast<f32>(surface_b[span + j - 2u]);
        knots.right[j] = g + bitcast<f32>(surface_b[span + degree + j - 3u]);
    }
    return knots;
}
