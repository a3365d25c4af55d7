//! Bézier triangles in polar form.
//!
//! A point of a triangle has three barycentric coordinates b that sum to 1; a direction has three that sum to 0. The polar form of a
//! patch of degree d is symmetric, linear in each of d arguments, and equal to the patch where all are b. Its derivative along h is
//! d times the polar form at (h, b, …), and over a smaller triangle its control points are the polar form at that one's corners.

use glam::DVec3;

/// Barycentric coordinates of a point or of a direction.
pub type Barycentric = [f64; 3];

/// A quadratic Bézier triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraticNet {
    pub corners: [DVec3; 3],
    /// Between corner r and r + 1.
    pub edges: [DVec3; 3],
}

/// A cubic Bézier triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicNet {
    pub corners: [DVec3; 3],
    /// Between corner r and r + 1: the one near r first.
    pub edges: [[DVec3; 2]; 3],
    pub centre: DVec3,
}

/// A net of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PositionNet {
    Quadratic(QuadraticNet),
    Cubic(CubicNet),
}

/// The control point between p and q with which a quadratic passes through `middle`.
pub fn edge_control(middle: DVec3, p: DVec3, q: DVec3) -> DVec3 {
    middle * 2.0 - (p + q) / 2.0
}

impl QuadraticNet {
    /// The polar form.
    pub fn polar(&self, a: Barycentric, b: Barycentric) -> DVec3 {
        let corner = |r: usize| self.corners[r] * (a[r] * b[r]);
        let edge = |r: usize| {
            let s = (r + 1) % 3;
            self.edges[r] * (a[r] * b[s] + a[s] * b[r])
        };
        (corner(0) + corner(1) + corner(2)) + (edge(0) + edge(1) + edge(2))
    }

    /// From a corner towards the next and the one before: half the derivatives there.
    pub fn corner_tangents(&self, r: usize) -> [DVec3; 2] {
        [self.edges[r], self.edges[(r + 2) % 3]].map(|control| control - self.corners[r])
    }

    /// In the middle of edge r: along it, and inwards.
    pub fn middle_tangents(&self, r: usize) -> [DVec3; 2] {
        let (s, t) = ((r + 1) % 3, (r + 2) % 3);
        let inner = (self.edges[s] + self.edges[t]) / 2.0;
        let outer = (self.corners[r] + self.corners[s] + self.edges[r] * 2.0) / 4.0;
        [self.corners[s] - self.corners[r], inner - outer]
    }
}

impl CubicNet {
    /// The polar form with one argument set.
    fn reduced(&self, a: Barycentric) -> QuadraticNet {
        let corner = |r: usize| {
            let [s, t] = [(r + 1) % 3, (r + 2) % 3];
            self.corners[r] * a[r] + self.edges[r][0] * a[s] + self.edges[t][1] * a[t]
        };
        let edge = |r: usize| {
            let [s, t] = [(r + 1) % 3, (r + 2) % 3];
            self.edges[r][0] * a[r] + self.edges[r][1] * a[s] + self.centre * a[t]
        };
        QuadraticNet {
            corners: [0, 1, 2].map(corner),
            edges: [0, 1, 2].map(edge),
        }
    }
}

impl PositionNet {
    /// The polar form with all arguments but two set to b.
    fn osculating(&self, b: Barycentric) -> QuadraticNet {
        match self {
            Self::Quadratic(net) => *net,
            Self::Cubic(net) => net.reduced(b),
        }
    }

    fn degree(&self) -> f64 {
        match self {
            Self::Quadratic(_) => 2.0,
            Self::Cubic(_) => 3.0,
        }
    }

    /// The point at b.
    pub fn point(&self, b: Barycentric) -> DVec3 {
        self.osculating(b).polar(b, b)
    }

    /// The derivative at b along h.
    pub fn derivative(&self, b: Barycentric, h: Barycentric) -> DVec3 {
        self.osculating(b).polar(h, b) * self.degree()
    }

    /// The second derivative at b along h and k.
    pub fn second_derivative(&self, b: Barycentric, h: Barycentric, k: Barycentric) -> DVec3 {
        self.osculating(b).polar(h, k) * (self.degree() * (self.degree() - 1.0))
    }

    /// Bounds the length of the derivative along h over the triangle with these corners: the longest control point there.
    pub fn longest_derivative(&self, h: Barycentric, corners: [Barycentric; 3]) -> f64 {
        let points = corners.iter().enumerate().flat_map(|(i, &a)| {
            corners[i..].iter().map(move |&b| match self {
                Self::Quadratic(net) => net.polar(h, a),
                Self::Cubic(net) => net.reduced(h).polar(a, b),
            })
        });
        points.map(DVec3::length).fold(0.0, f64::max) * self.degree()
    }

    /// Bounds the length of the second derivative along h and k over the triangle with these corners; exact, as it is linear.
    pub fn longest_second_derivative(&self, h: Barycentric, k: Barycentric, corners: [Barycentric; 3]) -> f64 {
        let lengths = corners.iter().map(|&a| self.second_derivative(a, h, k).length());
        lengths.fold(0.0, f64::max)
    }

    /// The control points: the corners first.
    pub fn controls(&self) -> Vec<DVec3> {
        match self {
            Self::Quadratic(net) => [net.corners, net.edges].concat(),
            Self::Cubic(net) => {
                let edges = net.edges.iter().flatten();
                net.corners.iter().chain(edges).chain([&net.centre]).copied().collect()
            }
        }
    }
}
