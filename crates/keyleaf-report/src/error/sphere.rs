//! The unit sphere over a polyhedron, in closed form, and its triangles. For tests.

use super::{DrawnTriangle, DrawnVertex};
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, Topology};
use keyleaf_surface::{Surface, SurfaceBound, SurfaceFrame, SurfaceTables};

/// Every point of the polyhedron, moved along its radius onto the sphere.
pub(super) struct Sphere {
    topology: Topology,
    corners: Vec<DVec3>,
}

impl Sphere {
    pub fn new(corners: Vec<DVec3>, faces: &[Vec<u32>]) -> Self {
        Self {
            topology: Topology::new(corners.len(), faces).unwrap(),
            corners,
        }
    }

    pub fn octahedron() -> Self {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let corners = axes.iter().flat_map(|axis| [*axis, -*axis]).collect();
        let faces = [
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ];
        Self::new(corners, &faces.map(Vec::from))
    }

    pub fn cube() -> Self {
        let corner = |i: u32| DVec3::new((i & 1).into(), (i >> 1 & 1).into(), (i >> 2).into()) * 2.0 - 1.0;
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        Self::new((0..8).map(corner).collect(), &faces.map(Vec::from))
    }

    /// Two pentagons and five squares about the z axis.
    pub fn prism() -> Self {
        let corner = |i: u32| {
            let angle = f64::from(i % 5) * std::f64::consts::TAU / 5.0;
            DVec3::new(angle.cos(), angle.sin(), if i < 5 { -0.7 } else { 0.7 })
        };
        let mut faces = vec![vec![4, 3, 2, 1, 0], vec![5, 6, 7, 8, 9]];
        faces.extend((0..5).map(|i| vec![i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i]));
        Self::new((0..10).map(corner).collect(), &faces)
    }

    /// The flat point, and its derivatives by the face's parameters.
    fn flat(&self, at: RootPoint) -> [DVec3; 3] {
        let corners: Vec<DVec3> = self
            .topology
            .vertices(at.face)
            .iter()
            .map(|vertex| self.corners[*vertex as usize])
            .collect();
        let count = corners.len();
        let centre = corners.iter().sum::<DVec3>() / count as f64;
        let weight = |w: u32| f64::from(w) / f64::from(ONE);
        let (r, u) = (corners[at.root as usize], corners[(at.root as usize + 1) % count]);
        let p = centre * weight(at.z()) + r * weight(at.x) + u * weight(at.y);
        // Squares here are parallelograms.
        [p, corners[1] - corners[0], corners[count - 1] - corners[0]]
    }

    /// All nodes of a level as drawn, with positions through `round`.
    pub fn triangles(&self, level: u32, round: impl Fn(DVec3) -> DVec3) -> Vec<DrawnTriangle> {
        let mut nodes: Vec<Place> = self.topology.roots().collect();
        for _ in 0..level {
            nodes = nodes.into_iter().flat_map(Place::children).collect();
        }
        nodes
            .into_iter()
            .map(|node| self.triangle(node.corners(), &round))
            .collect()
    }

    pub fn triangle(&self, corners: [RootPoint; 3], round: impl Fn(DVec3) -> DVec3) -> DrawnTriangle {
        let vertex = |at| {
            let frame = self.frame(at);
            DrawnVertex {
                at,
                position: round(frame.position),
                normal: frame.normal,
            }
        };
        DrawnTriangle {
            corners: corners.map(vertex),
        }
    }
}

impl Surface for Sphere {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.flat(at)[0].normalize()
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let [p, du, dv] = self.flat(at);
        let normal = p.normalize();
        let tangent = |d: DVec3| (d - normal * normal.dot(d)) / p.length();
        SurfaceFrame {
            position: normal,
            du: tangent(du),
            dv: tangent(dv),
            normal,
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        SurfaceBound {
            centre: self.point(leaf.middle()),
            radius: 2.0,
            size: 2.0,
            guard: 4.0,
            deviation: 2.0,
            pair_deviation: 2.0,
        }
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        (DVec3::NEG_ONE, DVec3::ONE)
    }

    fn shader(&self) -> &'static str {
        ""
    }

    fn tables(&self, _: DVec3) -> SurfaceTables {
        SurfaceTables {
            params: Vec::new(),
            a: Vec::new(),
            b: Vec::new(),
            heights: None,
            height_bounds: None,
        }
    }
}
