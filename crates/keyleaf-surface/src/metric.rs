//! How coarse a leaf is, before the view counts. Twin of `shaders/metrics`.

use crate::surface::HALF_LEVEL;
use crate::{Surface, diamond};
use glam::DVec3;
use keyleaf_key::{MAX_LEVEL, ONE, Place, RootPoint, neighbour};

/// What the size of a leaf is. Both halves of a diamond have the same.
///
/// ```
/// use keyleaf_key::Place;
/// use keyleaf_surface::{CornerAttributes, Mesh, MetricSize, PolygonMesh, Surface};
/// let square = PolygonMesh {
///     positions: [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -1.0], [0.0, 0.0, -1.0]].map(Into::into).to_vec(),
///     faces: [[0, 1, 2, 3]].into_iter().collect(),
///     corners: CornerAttributes::default(),
/// };
/// let square = Mesh::new(&square)?;
/// let root = Place::of_root(0, 0);
/// assert_eq!(MetricSize::LengthTest.of(&square, &root), 0.5);
/// assert_eq!(MetricSize::DistanceTest.of(&square, &root), 0.0); // flat
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MetricSize {
    /// `SurfaceBound::size`: half the length of an edge, from above. Object units.
    Edge,
    /// √2 · 2^−level (Khoury 2.1).
    Distance,
    /// `SurfaceBound::deviation` of a leaf that is drawn as 4^grid triangles, or what its size says of it. Object units.
    Deviation {
        /// The exponent.
        grid: u32,
    },
    /// [`Edge`](Self::Edge), times a factor beside open boundaries (Concheiro 6.10).
    Boundary(f64),
    /// The length of the curves of the root, over 2^level (Concheiro 6.8). Object units.
    LocalArea,
    /// The distance of the surface from the triangle at six points (Concheiro 6.9). Object units.
    LinearApproximation,
    /// The distance of the middles of the edges from the triangle (Concheiro 3.2.2). Object units.
    DistanceTest,
    /// One minus the cosine between an edge and the way to the surface beside it (Concheiro 3.2.2).
    FlatTest,
    /// The distance of the surface from the edges, at the same samples. Object units.
    FlatTestPixels,
    /// Half the length of the longest edge (Concheiro 3.2.2). Object units.
    LengthTest,
}

/// Times [`SurfaceBound::size`](crate::SurfaceBound::size): how far a point of a flat triangle is from the surface over it, at most. By
/// weights (1 − c)/2, (1 − c)/2, c of the corners it is (1 − c)(1 + 2 c).
const FARTHEST: f64 = 1.125;

/// A leaf, or the pair of which it is the even half, whose surface is sampled at quarters of the legs.
struct Samples<'a> {
    surface: &'a dyn Surface,
    leaf: Place,
    is_pair: bool,
}

/// O, R and U in quarters of the legs.
const CORNERS: [[u32; 2]; 3] = [[0, 0], [4, 0], [0, 4]];

impl Samples<'_> {
    fn at(&self, [a, b]: [u32; 2]) -> DVec3 {
        let [a, b] = [a, b].map(|quarters| self.leaf.unit() / 4 * quarters);
        self.surface.point(if self.is_pair {
            self.leaf.at_of_pair(a, b)
        } else {
            self.leaf.at(a, b)
        })
    }

    /// A point of edge `i`, in quarters from its start.
    fn on_edge(&self, [from, to]: [[u32; 2]; 2], quarters: u32) -> DVec3 {
        self.at([0, 1].map(|axis| (from[axis] * (4 - quarters) + to[axis] * quarters) / 4))
    }

    /// The largest of a value of the three edges.
    fn over_edges(&self, value: impl Fn([[u32; 2]; 2]) -> f64) -> f64 {
        [[2, 0], [0, 1], [1, 2]]
            .map(|ends| value(ends.map(|corner: usize| CORNERS[corner])))
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// The largest of a value of an edge and the way from its end to the surface, at both quarters and from both ends.
    fn flat(&self, value: impl Fn(DVec3, DVec3) -> f64) -> f64 {
        self.over_edges(|edge| {
            let [from, to] = edge.map(|end| self.at(end));
            [1, 3]
                .map(|quarters| self.on_edge(edge, quarters))
                .map(|between| value(to - from, between - from).max(value(from - to, between - to)))
                .into_iter()
                .fold(0.0, f64::max)
        })
    }

    fn linear_approximation(&self) -> f64 {
        let [o, r, u] = CORNERS.map(|corner| self.at(corner));
        [[2, 2], [0, 2], [2, 0], [1, 1], [2, 1], [1, 2]]
            .map(|at| {
                let [a, b] = at.map(|quarters| f64::from(quarters) / 4.0);
                (self.at(at) - o - (r - o) * a - (u - o) * b).length()
            })
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// One minus the cosine between two directions; 0 where there is none.
fn turn(edge: DVec3, arm: DVec3) -> f64 {
    let lengths = edge.length() * arm.length();
    if lengths > 0.0 {
        let sine = edge.cross(arm).length() / lengths;
        sine * sine / (1.0 + edge.dot(arm).abs() / lengths)
    } else {
        0.0
    }
}

/// How far the end of `arm` is from the line of `edge`.
fn distance_from_line(edge: DVec3, arm: DVec3) -> f64 {
    edge.try_normalize()
        .map_or(arm.length(), |along| along.cross(arm).length())
}

/// The length of the mesh edge of a root, or twice that of the way from its middle to the centre.
fn root_extent(surface: &dyn Surface, root: &Place) -> f64 {
    let length = |point: &dyn Fn(u32) -> [u32; 2]| -> f64 {
        let at = |k| {
            let [x, y] = point(k);
            surface.point(RootPoint {
                face: root.face,
                root: root.root,
                x,
                y,
            })
        };
        (0..4).map(|k| at(k).distance(at(k + 1))).sum()
    };
    let along = length(&|k| [ONE - k * (ONE / 4), k * (ONE / 4)]);
    let inwards = length(&|k| [ONE / 2 - k * (ONE / 8); 2]);
    along.max(2.0 * inwards)
}

impl MetricSize {
    /// The size of a leaf. Leaves so deep that quarters of their legs have no coordinates are 0 to metrics that sample.
    pub fn of(self, surface: &dyn Surface, leaf: &Place) -> f64 {
        let topology = surface.topology();
        let root = Place::of_root(leaf.face, leaf.root);
        match self {
            Self::Edge => surface.bound(leaf).size,
            Self::Distance => std::f64::consts::SQRT_2 * diamond::level_scale(leaf.level),
            Self::Deviation { grid } => {
                let bound = surface.bound(leaf);
                bound.deviation.min(FARTHEST * bound.size * f64::from(1u32 << grid))
            }
            Self::Boundary(factor) => {
                let is_open = topology.twin(leaf.face, leaf.root).is_none();
                let size = surface.bound(leaf).size;
                if is_open && diamond::touches_edge(leaf) {
                    size * factor
                } else {
                    size
                }
            }
            Self::LocalArea => {
                let other = neighbour::h(topology, root);
                let extent = other.iter().map(|other| root_extent(surface, other));
                extent.fold(root_extent(surface, &root), f64::max) * diamond::level_scale(leaf.level)
            }
            _ if leaf.level + 2 > MAX_LEVEL => 0.0,
            _ => {
                let other = neighbour::h(topology, *leaf);
                let sizes = other.iter().map(|other| self.of_half(surface, *other, false));
                sizes.fold(self.of_half(surface, *leaf, false), f64::max)
            }
        }
    }

    /// The size of what a leaf may be drawn as half of: the pair of it and its sibling, or the pair across their leg, whichever is larger.
    /// None of roots whose face has not four corners. Leaves so deep that quarters have no coordinates have none: infinite.
    pub fn of_pair(self, surface: &dyn Surface, leaf: &Place) -> Option<f64> {
        let about = neighbour::about_right_angle(surface.topology(), *leaf)?;
        let sizes = about.map(|half| self.of_half_of_pair(surface, half));
        Some(sizes.into_iter().fold(0.0, f64::max))
    }

    /// What one half of a pair says of its size. Both halves together have it: all of a pair is in the parent of a half; but over a pair of
    /// roots there is no parent, which is to be twice as large as a root.
    fn of_half_of_pair(self, surface: &dyn Surface, half: Place) -> f64 {
        let whole = half.parent().unwrap_or(half);
        let times = if half.level == 0 { 2.0 } else { 1.0 };
        match self {
            Self::Edge | Self::Distance | Self::Boundary(_) | Self::LocalArea => {
                times * HALF_LEVEL * self.of(surface, &whole)
            }
            Self::Deviation { grid } => {
                let bound = surface.bound(&whole);
                let by_speed = times * FARTHEST * bound.size * f64::from(1u32 << grid);
                by_speed.min(times * times * bound.pair_deviation)
            }
            _ if half.level + 2 > MAX_LEVEL => f64::INFINITY,
            _ if half.is_odd_half() => 0.0,
            _ => self.of_half(surface, half, true),
        }
    }

    fn of_half(self, surface: &dyn Surface, leaf: Place, is_pair: bool) -> f64 {
        let samples = Samples { surface, leaf, is_pair };
        match self {
            Self::LinearApproximation => samples.linear_approximation(),
            Self::DistanceTest => samples.over_edges(|edge| {
                let [from, to] = edge.map(|end| samples.at(end));
                samples.on_edge(edge, 2).distance(from.midpoint(to))
            }),
            Self::FlatTest => samples.flat(turn),
            Self::FlatTestPixels => samples.flat(distance_from_line),
            _ => samples.over_edges(|[from, to]| samples.at(from).distance(samples.at(to)) / 2.0),
        }
    }
}
