//! Points of a face as weighted sums of what its corners and its centre have. Twin of `shaders/shared/polygon.wgsl`.

use crate::quad_coord::QuadCoord;
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, Topology};

/// What a weight belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// A corner, by its half-edge.
    Corner(u32),
    /// The centre of a face: the mean of its corners.
    Centre(u32),
}

/// Weights of the value and of its derivatives, from the corners of one face.
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    pub operands: [Operand; 4],
    pub value: [f64; 4],
    pub du: [f64; 4],
    pub dv: [f64; 4],
    pub duv: [f64; 4],
}

/// A field and its derivatives at a point.
#[derive(Clone, Copy, Debug)]
pub struct FieldJet {
    pub value: DVec3,
    pub du: DVec3,
    pub dv: DVec3,
    pub duv: DVec3,
}

impl Jet {
    /// Quads are bilinear in the unit square; triangles linear; other polygons fans, see
    /// [`Surface::face_coord`](crate::Surface::face_coord) for the parameters.
    pub fn of(topology: &Topology, at: RootPoint) -> Self {
        let first = topology.first_half_edge(at.face);
        let count = topology.corner_count(at.face);
        let corners = [0, 1, 2, 3].map(|corner| Operand::Corner(first + corner % count));
        match count {
            3 => Self::triangle(corners, at),
            4 => Self::quad(corners, at),
            _ => Self::fan([first + at.root, first + (at.root + 1) % count], at),
        }
    }

    fn quad(operands: [Operand; 4], at: RootPoint) -> Self {
        let [u, v] = QuadCoord::of(at).to_f64();
        Self {
            operands,
            value: [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v],
            du: [v - 1.0, 1.0 - v, v, -v],
            dv: [u - 1.0, -u, u, 1.0 - u],
            duv: [1.0, -1.0, 1.0, -1.0],
        }
    }

    fn triangle(operands: [Operand; 4], at: RootPoint) -> Self {
        let [x, y, z] = weights(at);
        let mut value = [z / 3.0, z / 3.0, z / 3.0, 0.0];
        value[at.root as usize] += x;
        value[(at.root as usize + 1) % 3] += y;
        Self {
            operands,
            value,
            du: [-1.0, 1.0, 0.0, 0.0],
            dv: [-1.0, 0.0, 1.0, 0.0],
            duv: [0.0; 4],
        }
    }

    fn fan([a, b]: [u32; 2], at: RootPoint) -> Self {
        let [x, y, z] = weights(at);
        let rim = x + y;
        let along = if rim > 0.0 { y / rim } else { 0.5 };
        let centre = Operand::Centre(at.face);
        Self {
            operands: [Operand::Corner(a), Operand::Corner(b), centre, centre],
            value: [x, y, z, 0.0],
            du: [-rim, rim, 0.0, 0.0],
            dv: [along - 1.0, -along, 1.0, 0.0],
            duv: [1.0, -1.0, 0.0, 0.0],
        }
    }

    /// The sum for a field.
    pub fn value(&self, field: impl Fn(Operand) -> DVec3) -> DVec3 {
        self.operands
            .iter()
            .zip(self.value)
            .map(|(&operand, weight)| field(operand) * weight)
            .sum()
    }

    /// The sums for a field, derivatives from differences.
    pub fn field(&self, field: impl Fn(Operand) -> DVec3) -> FieldJet {
        let p = self.operands.map(&field);
        let sum = |w: [f64; 4]| (1..4).map(|i| (p[i] - p[0]) * w[i]).sum();
        FieldJet {
            value: self.value(field),
            du: sum(self.du),
            dv: sum(self.dv),
            duv: sum(self.duv),
        }
    }
}

/// The weights of the corner, the next corner and the centre.
fn weights(at: RootPoint) -> [f64; 3] {
    [at.x, at.y, at.z()].map(|weight| f64::from(weight) / f64::from(ONE))
}

/// A number for every root that, times 2^−level, bounds how far a field moves over half the hypotenuse, over the median and over
/// half of the diamond's diagonals. The larger of both roots of a mesh edge, so that both halves of a diamond agree.
///
/// Over a fan the field is linear: half the hypotenuse and the median are all. Over a quad it is bilinear, and the diagonals of a
/// diamond run along u and v, so that half the longest side bounds both derivatives.
pub fn root_speeds(topology: &Topology, field: impl Fn(Operand) -> DVec3) -> Vec<f64> {
    let own = |root: &Place| {
        let first = topology.first_half_edge(root.face);
        let count = topology.corner_count(root.face);
        let side = |corner: u32| {
            let a = field(Operand::Corner(first + corner));
            (a, field(Operand::Corner(first + (corner + 1) % count)))
        };
        if count == 4 {
            return (0..4).map(side).map(|(a, b)| a.distance(b) / 2.0).fold(0.0, f64::max);
        }
        let (a, b) = side(root.root);
        f64::max(
            a.distance(b) / 2.0,
            field(Operand::Centre(root.face)).distance((a + b) / 2.0),
        )
    };
    let speeds: Vec<f64> = topology.roots().map(|root| own(&root)).collect();
    over_edges(topology, &speeds)
}

/// The larger of the values of both roots of every mesh edge.
pub fn over_edges(topology: &Topology, values: &[f64]) -> Vec<f64> {
    let twin = |root: Place| {
        topology
            .twin(root.face, root.root)
            .map(|t| topology.half_edge_index(t.face, t.root))
    };
    let other = |root| twin(root).map_or(0.0, |index| values[index as usize]);
    topology
        .roots()
        .zip(values)
        .map(|(root, &value)| value.max(other(root)))
        .collect()
}
