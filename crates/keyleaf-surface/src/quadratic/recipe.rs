//! How triangle patches follow from the vertices of a control mesh.

use super::error::TrianglePatchError;
use super::loop_limit::{self, Rules};
use super::net::{PositionNet, QuadraticNet, edge_control};
use super::samples::LimitSamples;
use super::{butterfly, corner_owner, point_normal};
use crate::PoseShader;
use glam::DVec3;
use keyleaf_key::{HalfEdge, Topology};
use std::sync::Arc;

/// Where the patches come from.
#[derive(Clone, Debug)]
pub enum Recipe {
    /// Samples of anything.
    Samples,
    /// The Loop limit surface.
    Limit(Rules),
    /// The Butterfly scheme.
    Butterfly,
    /// PN triangles, with the normals that are given at corners, by half-edge.
    PointNormal(Arc<[Option<DVec3>]>),
}

impl Recipe {
    /// The nets of all faces of a mesh.
    pub fn nets(
        &self,
        topology: &Topology,
        positions: &[DVec3],
    ) -> Result<Vec<(PositionNet, QuadraticNet)>, TrianglePatchError> {
        let samples = match self {
            Self::Samples => LimitSamples::default(),
            Self::Limit(rules) => loop_limit::samples(topology, positions, *rules),
            Self::Butterfly => butterfly::samples(topology, positions),
            Self::PointNormal(given) => {
                let nets = point_normal::nets(topology, positions, given).into_iter();
                let nets = nets.map(|(positions, normals)| (PositionNet::Cubic(positions), normals));
                return Ok(nets.collect());
            }
        };
        samples.check(topology)?;
        Ok(quadratic_nets(topology, &samples))
    }

    /// What poses them on the GPU.
    pub fn pose_shader(&self) -> Option<PoseShader> {
        match self {
            Self::Samples => None,
            Self::Limit(_) => Some(PoseShader::QAS_LIMIT),
            Self::Butterfly => Some(PoseShader::QAS_BUTTERFLY),
            Self::PointNormal(_) => Some(PoseShader::POINT_NORMAL),
        }
    }
}

/// The quadratic patches through samples.
pub fn quadratic_nets(topology: &Topology, samples: &LimitSamples) -> Vec<(PositionNet, QuadraticNet)> {
    let index = |half_edge: HalfEdge| topology.half_edge_index(half_edge.face, half_edge.root) as usize;
    let nets = (0..topology.face_count()).map(|face| {
        let own = [0, 1, 2].map(|root| index(HalfEdge { face, root }));
        let corners = [0, 1, 2].map(|root| samples.corners[index(corner_owner(topology, face, root))].position);
        let middles = [0, 1, 2].map(|root| samples.edges[index(topology.half_edge_owner(face, root))].position);
        let net = |corners: [DVec3; 3], middles: [DVec3; 3]| QuadraticNet {
            corners,
            edges: [0, 1, 2].map(|r| edge_control(middles[r], corners[r], corners[(r + 1) % 3])),
        };
        let normals = net(
            own.map(|i| samples.corners[i].normal),
            own.map(|i| samples.edges[i].normal),
        );
        (PositionNet::Quadratic(net(corners, middles)), normals)
    });
    nets.collect()
}
