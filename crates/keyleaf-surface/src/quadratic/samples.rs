//! What quadratic patches interpolate: positions and normals at the vertices and the edge middles of a triangle mesh.

use super::butterfly;
use super::error::{TrianglePatchError, check_triangles};
use super::loop_limit::{self, LoopWeights, Rules};
use crate::{ControlMesh, PolygonMesh, SurfaceFrame};
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint, Topology};

/// Coordinates beyond this overflow in f32 arithmetic. Ten times what a mesh may have: schemes that interpolate overshoot.
const LARGEST_COORDINATE: f64 = 1e16;

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitSample {
    /// Position, object space.
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

/// A surface over a triangle mesh at the vertices and the edge middles, as every half-edge sees it.
///
/// Positions belong to vertices and edges: of what several half-edges say, that of the owner counts
/// ([`Topology::vertex_owner`], [`Topology::half_edge_owner`]). Normals belong to faces, so that they may differ on the two sides of
/// a crease.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LimitSamples {
    /// By half-edge, at the corner at which it starts.
    pub corners: Vec<LimitSample>,
    /// By half-edge, at its middle.
    pub edges: Vec<LimitSample>,
}

impl LimitSamples {
    /// Of any surface over the triangles of a topology.
    pub fn of_surface(topology: &Topology, frame: impl Fn(RootPoint) -> SurfaceFrame) -> Self {
        let sample = |x: u32| {
            let of_root = |root: keyleaf_key::Place| {
                let RootPoint { face, root, .. } = root.corners()[1];
                let SurfaceFrame { position, normal, .. } = frame(RootPoint {
                    face,
                    root,
                    x,
                    y: ONE - x,
                });
                LimitSample { position, normal }
            };
            topology.roots().map(of_root).collect()
        };
        Self {
            corners: sample(ONE),
            edges: sample(ONE / 2),
        }
    }

    /// Of the Loop limit surface of a mesh without sharp edges and vertices, by limit and tangent masks: one step of subdivision and
    /// limit projection (Boubekeur & Schlick 2.2). Vertices at which triangles touch in a point only are sharp.
    ///
    /// # Errors
    /// [`TrianglePatchError`] if the mesh is no surface of triangles, has sharpness, or its faces at the boundary have no surface.
    pub fn of_loop(control: &ControlMesh, weights: LoopWeights) -> Result<Self, TrianglePatchError> {
        let topology = triangles(&control.mesh)?;
        loop_limit::check(control)?;
        let rules = Rules {
            boundary: control.boundary,
            weights,
        };
        Ok(loop_limit::samples(&topology, &control.mesh.positions, rules))
    }

    /// Of the modified Butterfly scheme, which interpolates the vertices of the mesh: edge middles after one step, normals from the
    /// quadratic patches through them.
    ///
    /// The normals are those of what is drawn: the angle-weighted mean of the patches about a vertex, and the mean of both patches at
    /// an edge. The tangent masks of the scheme are no alternative: they exist for interior vertices only, and at edge middles they
    /// need a second step and two rings.
    ///
    /// # Errors
    /// [`TrianglePatchError`] if the mesh is no surface of triangles.
    pub fn of_butterfly(mesh: &PolygonMesh) -> Result<Self, TrianglePatchError> {
        let topology = triangles(mesh)?;
        Ok(butterfly::samples(&topology, &mesh.positions))
    }

    /// An error unless there is a finite sample for every corner and edge.
    pub(super) fn check(&self, topology: &Topology) -> Result<(), TrianglePatchError> {
        let half_edges = topology.half_edge_count();
        for (what, samples) in [("corners", &self.corners), ("edges", &self.edges)] {
            let found = samples.len();
            if found != half_edges as usize {
                return Err(TrianglePatchError::SampleCount {
                    what,
                    half_edges,
                    found,
                });
            }
            let is_bad = |sample: &&LimitSample| {
                let is_small = sample.position.abs().max_element() <= LARGEST_COORDINATE;
                !(is_small && sample.position.is_finite() && sample.normal.is_finite())
            };
            if let Some((root, _)) = topology.roots().zip(samples).find(|(_, sample)| is_bad(sample)) {
                let (face, root) = (root.face, root.root);
                return Err(TrianglePatchError::Sample { what, face, root });
            }
        }
        Ok(())
    }
}

/// The topology of a mesh of triangles.
pub fn triangles(mesh: &PolygonMesh) -> Result<Topology, TrianglePatchError> {
    let topology = mesh.topology()?;
    check_triangles(&topology)?;
    Ok(topology)
}
