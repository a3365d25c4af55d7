//! Where the vertices of a morphing quadtree are drawn. Twin of `shaders/morph/geomorph.wgsl`.

use crate::{MetricSize, Surface, SurfaceFrame};
use glam::{DMat3, DVec3};
use keyleaf_key::{MAX_LEVEL, Place, RootPoint, Topology, neighbour};

/// The wish at which a vertex has arrived on the surface, above that at which it leaves its edge.
const WIDTH: f64 = 0.5;
/// The latest wish at which it leaves.
const LATEST_START: f64 = 1.5;

/// What says where vertices are drawn: metric and view.
///
/// A vertex that a split adds starts on the edge that it divides. As the wish of the node that was split grows on, by half of the
/// threshold, the vertex slides to the surface. All that counts is the vertex and the view: leaves around it agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geomorph {
    /// The metric. One that at least halves from level to level, so that the ends of an edge have arrived before it is divided.
    pub size: MetricSize,
    /// k: leaves are drawn as 4^k triangles.
    pub base_grid: u32,
    /// Whether leaves are drawn as pairs where the metric is satisfied with those.
    pub pairs_as_wished: bool,
    /// Metric over threshold of size 1 at a world distance of 1.
    pub wish_scale: f64,
    /// Metric over threshold of a node that is as large as it is far away; 1 where the metric is no length.
    pub wish_when_near: f64,
    /// Object space.
    pub eye: DVec3,
    /// Rotation and scale.
    pub world_from_object: DMat3,
    /// No world distance counts as less; `None`: the distance does not count.
    pub near: Option<f64>,
}

/// How a vertex came to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Insertion {
    /// The nodes whose split drew it: one, or the two beside a leg.
    pub split: Vec<Place>,
    /// The ends of the edge that it divides.
    pub ends: [RootPoint; 2],
    /// Of a vertex that the pairs of some leaves leave out: one of those.
    pub pair: Option<Place>,
}

impl Insertion {
    /// Of a vertex of leaves with grids of 4^k triangles; `None` for the vertices of roots.
    ///
    /// ```
    /// use keyleaf_key::{ONE, RootPoint, Topology};
    /// use keyleaf_surface::Insertion;
    /// let square = Topology::new(4, [[0, 1, 2, 3]])?;
    /// let point = |x, y| RootPoint { face: 0, root: 0, x, y };
    /// let middle = Insertion::of(&square, point(ONE / 2, ONE / 2), 0).unwrap();
    /// assert_eq!(middle.ends, [point(ONE, 0), point(0, ONE)]);
    /// assert_eq!(Insertion::of(&square, point(ONE / 2, ONE / 2), 1), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(topology: &Topology, at: RootPoint, base_grid: u32) -> Option<Self> {
        let zeros = at.x.trailing_zeros().min(at.y.trailing_zeros()).min(MAX_LEVEL);
        let level = (MAX_LEVEL - zeros).checked_sub(base_grid + 1)?;
        // The triangle of the next coarser grid, of which it divides an edge.
        let coarse = descend(at, level + base_grid)?;
        let unit = coarse.unit();
        let ends = match local(coarse, at) {
            (0, _) => [coarse.at(0, 0), coarse.at(0, unit)],
            (_, 0) => [coarse.at(0, 0), coarse.at(unit, 0)],
            _ => [coarse.at(unit, 0), coarse.at(0, unit)],
        };
        let leaf = descend(at, level)?;
        let beside = match local(leaf, at) {
            (0, _) => Some(neighbour::y(topology, leaf)),
            (_, 0) => Some(neighbour::x(topology, leaf)),
            _ => None,
        };
        let split = std::iter::once(leaf).chain(beside).collect();
        let is_on_leg = matches!(local(coarse, at), (0, _) | (_, 0));
        let (a, b) = local(leaf, at);
        let pair = is_on_leg.then(|| leaf.child(if a > b { 2 } else { 0 }));
        Some(Self { split, ends, pair })
    }
}

/// A node of a level that holds a point of its root.
fn descend(at: RootPoint, level: u32) -> Option<Place> {
    let mut node = Place::of_root(at.face, at.root);
    for _ in 0..level {
        node = node.children().into_iter().find(|child| {
            let (a, b) = offsets(*child, at);
            a >= 0 && b >= 0 && a + b <= i64::from(child.unit())
        })?;
    }
    Some(node)
}

/// A point by the legs of a node.
fn offsets(node: Place, at: RootPoint) -> (i64, i64) {
    let [x, y] = [(at.x, node.x), (at.y, node.y)].map(|(to, from)| i64::from(to) - i64::from(from));
    match node.orientation & 3 {
        0 => (x, y),
        1 => (y, -x),
        2 => (-x, -y),
        _ => (-y, x),
    }
}

fn local(node: Place, at: RootPoint) -> (u32, u32) {
    let (a, b) = offsets(node, at);
    (a as u32, b as u32)
}

impl Geomorph {
    /// How far a vertex has come: 0 on the edge that it divides, 1 on the surface.
    pub fn part(&self, surface: &dyn Surface, insertion: &Insertion, position: DVec3) -> f64 {
        let sizes = insertion.split.iter().map(|node| self.size.of(surface, node));
        let pair = insertion.pair.filter(|_| self.pairs_as_wished);
        let of_pair = pair.and_then(|pair| self.size.of_pair(surface, &pair));
        let size = sizes.chain(of_pair).fold(f64::INFINITY, f64::min);
        let distance = self.near.map_or(1.0, |near| {
            (self.world_from_object * (position - self.eye)).length().max(near)
        });
        let start = if self.wish_when_near > 3.0 {
            self.wish_when_near / (self.wish_when_near - 1.0)
        } else {
            LATEST_START
        };
        ((size * self.wish_scale / distance - start) / WIDTH).clamp(0.0, 1.0)
    }

    /// Where a vertex is drawn, with its normal. Derivatives are those of the surface.
    pub fn drawn(&self, surface: &dyn Surface, at: RootPoint) -> SurfaceFrame {
        let arrived = surface.drawn(at);
        let Some(insertion) = Insertion::of(surface.topology(), at, self.base_grid) else {
            return arrived;
        };
        let part = self.part(surface, &insertion, arrived.position);
        if part >= 1.0 {
            return arrived;
        }
        let [from, to] = insertion.ends.map(|end| surface.drawn(end));
        let normal = from.normal.midpoint(to.normal).lerp(arrived.normal, part);
        SurfaceFrame {
            position: from.position.midpoint(to.position).lerp(arrived.position, part),
            normal: normal.try_normalize().unwrap_or(arrived.normal),
            ..arrived
        }
    }
}
