//! Pictures of how far what is drawn is from the exact surface, as colours on a logarithmic scale.

use glam::{DMat4, DVec3, UVec2};
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, View};
use keyleaf_stage::{Deviations, Difference, Loaded, Stage, differences, drawn};

/// What is shown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The distance to the exact point at the same parameters, over the diagonal of the surface's box.
    Position,
    /// The angle to the exact normal, in radians.
    Normal,
}

impl Quantity {
    /// The decades that have colours.
    pub fn scale(self) -> Scale {
        match self {
            Self::Position => Scale {
                least: 1e-9,
                greatest: 1e-3,
            },
            Self::Normal => Scale {
                least: 1e-7,
                greatest: 1e-1,
            },
        }
    }

    fn of(self, difference: &Difference, diagonal: f64) -> f64 {
        match self {
            Self::Position => difference.distance / diagonal,
            Self::Normal => difference.angle,
        }
    }
}

/// The picture of what a stage draws for a view, and its figures over all vertices drawn.
pub fn of_stage(
    gpu: &Headless,
    stage: &Stage,
    loaded: &Loaded,
    view: &View,
    quantity: Quantity,
) -> Result<(Vec<u8>, Deviations), KeyleafError> {
    let mut field = Field::default();
    for (shown, object) in stage.objects.iter().zip(&loaded.objects) {
        let of_object = drawn(gpu, &shown.quadtree)?;
        let (low, high) = object.surface.bounding_box();
        let diagonal = (high - low).length().max(f64::MIN_POSITIVE);
        let first = field.positions.len() as u32;
        let to_world = |position| object.world_from_object.transform_point3(position);
        field
            .positions
            .extend(of_object.vertices.iter().map(|v| to_world(v.position)));
        let found = differences(&of_object, object.surface.as_ref());
        field
            .values
            .extend(found.iter().map(|found| quantity.of(found, diagonal)));
        let triangles = of_object.triangles.iter();
        field.triangles.extend(triangles.map(|t| t.map(|v| first + v)));
    }
    let deviations = Deviations::of(field.values.iter().copied());
    Ok((picture(&field, view, quantity.scale()), deviations))
}

/// A value a vertex over triangles in world space.
#[derive(Default)]
struct Field {
    positions: Vec<DVec3>,
    values: Vec<f64>,
    triangles: Vec<[u32; 3]>,
}

/// What colours mean: the decades from `least`, which is dark blue, to `greatest`, which is yellow. Values are cut to them.
#[derive(Clone, Copy)]
pub struct Scale {
    pub least: f64,
    pub greatest: f64,
}

const BACKGROUND: [u8; 3] = [236, 238, 241];

/// The colours of the scale at equal distances (viridis, S. van der Walt and N. Smith, public domain).
const COLOURS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [72, 40, 120],
    [62, 74, 137],
    [49, 104, 142],
    [38, 130, 142],
    [31, 158, 137],
    [53, 183, 121],
    [144, 215, 67],
    [253, 231, 37],
];

impl Scale {
    /// The colour of a value.
    pub fn colour(self, value: f64) -> [u8; 3] {
        let decades = (self.greatest / self.least).log10();
        let part = (value.max(f64::MIN_POSITIVE) / self.least).log10() / decades;
        let place = part.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
        let first = (place as usize).min(COLOURS.len() - 2);
        let between = place - first as f64;
        std::array::from_fn(|c| {
            let [a, b] = [COLOURS[first][c], COLOURS[first + 1][c]].map(f64::from);
            (a + (b - a) * between).round() as u8
        })
    }

    /// The scale as a bar, decade by decade, at the lower edge of a picture.
    fn draw(self, pixels: &mut [[u8; 3]], size: UVec2) {
        let [width, height] = size.to_array().map(|n| n as usize);
        let thickness = (height / 40).clamp(1, 16);
        let decades = (self.greatest / self.least).log10().round().max(1.0);
        for x in 0..width {
            let part = (x as f64 + 0.5) / width as f64;
            let is_tick = (part * decades).fract() < decades / width as f64 && x > 0;
            let value = self.least * (self.greatest / self.least).powf(part);
            let colour = if is_tick { BACKGROUND } else { self.colour(value) };
            for y in height - thickness..height {
                pixels[y * width + x] = colour;
            }
        }
    }
}

/// A corner of a triangle on the picture: pixels, the depth that the GPU tests (greater is nearer), and one over the distance.
#[derive(Clone, Copy)]
struct Corner {
    x: f64,
    y: f64,
    depth: f64,
    inverse: f64,
    value: f64,
}

/// The picture. Triangles that reach behind the near plane are left out.
fn picture(field: &Field, view: &View, scale: Scale) -> Vec<u8> {
    let size = view.viewport;
    let [width, height] = size.to_array().map(|n| n as usize);
    let clip_from_world = view.clip_from_view().as_dmat4()
        * DMat4::from_quat(view.orientation.inverse())
        * DMat4::from_translation(-view.eye);
    let corner = |index: u32| {
        let clip = clip_from_world * field.positions[index as usize].extend(1.0);
        (clip.z <= clip.w && clip.w > 0.0).then(|| Corner {
            x: (clip.x / clip.w * 0.5 + 0.5) * width as f64,
            y: (0.5 - clip.y / clip.w * 0.5) * height as f64,
            depth: clip.z / clip.w,
            inverse: 1.0 / clip.w,
            value: field.values[index as usize],
        })
    };
    let mut pixels = vec![BACKGROUND; width * height];
    let mut nearest = vec![0.0; width * height];
    for triangle in &field.triangles {
        if let [Some(a), Some(b), Some(c)] = triangle.map(corner) {
            fill([a, b, c], [width, height], |pixel, depth, value| {
                if depth > nearest[pixel] {
                    nearest[pixel] = depth;
                    pixels[pixel] = scale.colour(value);
                }
            });
        }
    }
    scale.draw(&mut pixels, size);
    pixels.concat()
}

/// Calls `put` for every pixel whose middle a triangle covers, with the depth and the value there.
fn fill(corners: [Corner; 3], [width, height]: [usize; 2], mut put: impl FnMut(usize, f64, f64)) {
    let [a, b, c] = corners;
    let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let range = |of: fn(&Corner) -> f64, count: usize| {
        let low = corners.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        (low - 0.5).ceil().max(0.0) as usize..((high - 0.5).floor() + 1.0).clamp(0.0, count as f64) as usize
    };
    for y in range(|corner| corner.y, height) {
        for x in range(|corner| corner.x, width) {
            let [px, py] = [x as f64 + 0.5, y as f64 + 0.5];
            let weight = |p: Corner, q: Corner| ((p.x - px) * (q.y - py) - (p.y - py) * (q.x - px)) / area;
            let weights = [weight(b, c), weight(c, a), weight(a, b)];
            if weights.iter().any(|&weight| weight < 0.0) {
                continue;
            }
            let sum = |of: fn(&Corner) -> f64| -> f64 { corners.iter().zip(weights).map(|(p, w)| of(p) * w).sum() };
            let inverse = sum(|corner| corner.inverse);
            put(
                y * width + x,
                sum(|corner| corner.depth),
                sum(|corner| corner.value * corner.inverse) / inverse,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_run_from_dark_to_bright_by_decades() {
        let scale = Scale {
            least: 1e-8,
            greatest: 1e-4,
        };
        assert_eq!(scale.colour(0.0), COLOURS[0]);
        assert_eq!(scale.colour(1e-8), COLOURS[0]);
        assert_eq!(scale.colour(1e-6), COLOURS[4]);
        assert_eq!(scale.colour(1.0), COLOURS[8]);
    }

    #[test]
    fn the_nearer_triangle_covers_the_other_and_the_rest_is_background() {
        let view = View::look_at(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 1.0, 0.1, UVec2::new(32, 32));
        let square = |z: f64| [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, z));
        let field = Field {
            positions: [square(0.0), square(1.0)].concat(),
            values: [[1e-8; 4], [1.0; 4]].concat(),
            triangles: vec![[4, 5, 6], [4, 6, 7], [0, 1, 2], [0, 2, 3]],
        };
        let scale = Scale {
            least: 1e-8,
            greatest: 1e-4,
        };
        let pixels = picture(&field, &view, scale);
        let at = |x: usize, y: usize| <[u8; 3]>::try_from(&pixels[3 * (32 * y + x)..][..3]).expect("three bytes");
        assert_eq!(at(16, 16), COLOURS[8]);
        assert_eq!(at(0, 0), BACKGROUND);
    }
}
