//! Numbers of corners and edges, surface by surface.

use crate::breaks::Breaks;
use crate::{BaselineError, Side};

/// Numbers for the corners and edges of every surface before they are united.
pub(crate) struct Numbers {
    /// Per surface: cells in u and v, first corner, first edge.
    surfaces: Vec<(usize, usize, u32, u32)>,
    pub corners: u32,
    pub edges: u32,
}

impl Numbers {
    pub fn new(breaks: &Breaks) -> Result<Self, BaselineError> {
        let too_large = || BaselineError::TooLarge { what: "cells" };
        let (mut corners, mut edges) = (0u32, 0u32);
        let mut surfaces = Vec::new();
        for [u, v] in &breaks.along {
            let (nu, nv) = (u.len() - 1, v.len() - 1);
            surfaces.push((nu, nv, corners, edges));
            let more = |count: u32, by: usize| u32::try_from(by).ok().and_then(|by| count.checked_add(by));
            corners = more(corners, (nu + 1).saturating_mul(nv + 1)).ok_or_else(too_large)?;
            edges = more(edges, nu.saturating_mul(nv + 1)).ok_or_else(too_large)?;
            edges = more(edges, nv.saturating_mul(nu + 1)).ok_or_else(too_large)?;
        }
        Ok(Self {
            surfaces,
            corners,
            edges,
        })
    }

    pub fn corner(&self, surface: usize, i: usize, j: usize) -> u32 {
        let (nu, _, first, _) = self.surfaces[surface];
        first + (j * (nu + 1) + i) as u32
    }

    pub fn edge(&self, surface: usize, direction: usize, i: usize, j: usize) -> u32 {
        let (nu, nv, _, first) = self.surfaces[surface];
        let local = if direction == 0 {
            j * nu + i
        } else {
            nu * (nv + 1) + j * (nu + 1) + i
        };
        first + local as u32
    }

    /// The i-th corner along a side.
    pub fn side_corner(&self, (surface, side): (usize, Side), i: usize) -> u32 {
        let (nu, nv, ..) = self.surfaces[surface];
        match side {
            Side::UMin => self.corner(surface, 0, i),
            Side::UMax => self.corner(surface, nu, i),
            Side::VMin => self.corner(surface, i, 0),
            Side::VMax => self.corner(surface, i, nv),
        }
    }

    /// The i-th edge along a side.
    pub fn side_edge(&self, (surface, side): (usize, Side), i: usize) -> u32 {
        let (nu, nv, ..) = self.surfaces[surface];
        match side {
            Side::UMin => self.edge(surface, 1, 0, i),
            Side::UMax => self.edge(surface, 1, nu, i),
            Side::VMin => self.edge(surface, 0, i, 0),
            Side::VMax => self.edge(surface, 0, i, nv),
        }
    }

    pub fn corners_of(&self, surface: usize) -> impl Iterator<Item = (usize, usize)> {
        let (nu, nv, ..) = self.surfaces[surface];
        (0..=nv).flat_map(move |j| (0..=nu).map(move |i| (i, j)))
    }

    /// (direction, i, j) in the order of their numbers.
    pub fn edges_of(&self, surface: usize) -> impl Iterator<Item = (usize, usize, usize)> {
        let (nu, nv, ..) = self.surfaces[surface];
        let along_u = (0..=nv).flat_map(move |j| (0..nu).map(move |i| (0, i, j)));
        along_u.chain((0..nv).flat_map(move |j| (0..=nu).map(move |i| (1, i, j))))
    }
}
