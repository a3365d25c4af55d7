//! How sharpness chooses the rules of a vertex and falls from step to step (OpenSubdiv 3.6, `sdc/crease.cpp`; DeRose, Kass and
//! Truong 1998).

use super::ring::{Fan, Spoke};
use super::{Creasing, INFINITE_SHARPNESS};

/// How a vertex moves in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexRule {
    /// By all its neighbours. Also where one edge is sharp (a dart).
    Smooth,
    /// Along the two sharp edges, by their places among the spokes.
    Crease([usize; 2]),
    /// Not at all.
    Corner,
}

/// Whether this stays sharp for ever.
pub fn is_infinite(sharpness: f64) -> bool {
    sharpness >= INFINITE_SHARPNESS
}

/// Whether this is sharp, but not for ever.
pub fn is_semi_sharp(sharpness: f64) -> bool {
    sharpness > 0.0 && !is_infinite(sharpness)
}

/// After a step.
pub fn decremented(sharpness: f64) -> f64 {
    if is_infinite(sharpness) {
        sharpness
    } else {
        (sharpness - 1.0).max(0.0)
    }
}

/// The half of an edge after a step, at an end where other semi-sharp edges have a mean sharpness. With Chaikin's corner cutting it first
/// moves a quarter of the way there.
pub fn subdivided(sharpness: f64, others: f64, creasing: Creasing) -> f64 {
    match creasing {
        Creasing::Chaikin if is_semi_sharp(sharpness) => (0.75 * sharpness + 0.25 * others - 1.0).max(0.0),
        _ => decremented(sharpness),
    }
}

/// The mean of the other semi-sharp values; the value itself where there are none.
pub fn mean_of_others(values: &[f64], own: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (_, value) in values
        .iter()
        .enumerate()
        .filter(|&(k, &value)| k != own && is_semi_sharp(value))
    {
        sum += value;
        count += 1.0;
    }
    if count > 0.0 { sum / count } else { values[own] }
}

/// The rule for these sharpnesses.
pub fn vertex_rule(vertex: f64, edges: &[f64]) -> VertexRule {
    if vertex > 0.0 {
        return VertexRule::Corner;
    }
    let mut sharp = (0..edges.len()).filter(|&k| edges[k] > 0.0);
    match [sharp.next(), sharp.next(), sharp.next()] {
        [Some(a), Some(b), None] => VertexRule::Crease([a, b]),
        [_, _, None] => VertexRule::Smooth,
        _ => VertexRule::Corner,
    }
}

impl Fan {
    /// Sharpness of the spokes.
    pub fn sharpnesses(&self) -> Vec<f64> {
        self.spokes.iter().map(|spoke| spoke.sharpness).collect()
    }

    /// Sharpness of the near halves of the spokes after a step.
    pub fn subdivided_sharpnesses(&self, creasing: Creasing) -> Vec<f64> {
        let own = self.sharpnesses();
        let others = |k: usize| match creasing {
            Creasing::Uniform => own[k],
            Creasing::Chaikin => mean_of_others(&own, k),
        };
        (0..own.len())
            .map(|k| subdivided(own[k], others(k), creasing))
            .collect()
    }

    /// Whether no rule changes any more at the corner.
    pub fn is_settled(&self) -> bool {
        !is_semi_sharp(self.sharpness) && !self.spokes.iter().any(|spoke| is_semi_sharp(spoke.sharpness))
    }

    /// The rule of the corner.
    pub fn rule(&self) -> VertexRule {
        vertex_rule(self.sharpness, &self.sharpnesses())
    }

    /// The rule of the corner for the next step with its share, and the rule after that step with the rest.
    pub fn rules(&self, creasing: Creasing) -> [(VertexRule, f64); 2] {
        let now = self.rule();
        if now == VertexRule::Smooth {
            return [(now, 1.0), (now, 0.0)];
        }
        let edges = self.sharpnesses();
        let next_edges = self.subdivided_sharpnesses(creasing);
        let next_vertex = decremented(self.sharpness);
        let next = vertex_rule(next_vertex, &next_edges);
        if next == now {
            return [(now, 1.0), (now, 0.0)];
        }
        let fades = |(now, next): (f64, f64)| match creasing {
            Creasing::Uniform => now > 0.0 && now <= 1.0,
            Creasing::Chaikin => now > 0.0 && next <= 0.0,
        };
        let vertex = (self.sharpness > 0.0 && next_vertex <= 0.0).then_some(self.sharpness);
        let edges = edges.into_iter().zip(next_edges).filter(|&pair| fades(pair));
        let fading: Vec<f64> = vertex.into_iter().chain(edges.map(|(now, _)| now)).collect();
        let share = if fading.is_empty() {
            0.0
        } else {
            (fading.iter().sum::<f64>() / fading.len() as f64).min(1.0)
        };
        [(now, share), (next, 1.0 - share)]
    }
}

impl Spoke {
    /// A spoke that is not sharp.
    pub fn smooth(vertex: u32) -> Self {
        Self {
            vertex,
            sharpness: 0.0,
            beyond: 0.0,
        }
    }

    /// The half of this spoke at its far end after a step.
    pub fn far_half(self, creasing: Creasing) -> f64 {
        subdivided(self.sharpness, self.beyond, creasing)
    }

    /// How much of the sharp rule the point of this edge has in the next step; `near_half` is the sharpness of its near half after it.
    pub fn sharp_share(self, near_half: f64, creasing: Creasing) -> f64 {
        let stays = near_half > 0.0 && self.far_half(creasing) > 0.0;
        if stays { 1.0 } else { self.sharpness.min(1.0) }
    }
}
