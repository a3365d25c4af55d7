//! What the GPU reads to find triangle patches from a control mesh that moves. Twin of `shaders/passes/pose_triangles.wgsl`.
//!
//! `words`:
//! - a half-edge, 3 words: the vertex at which it starts, the number of its edge, the half-edge on the other side or `0xffffffff`;
//! - an edge: the half-edge that owns it;
//! - a fan, 6 words: its vertex; the word of the first vertex at the other ends of its edges, and how many there are; its triangles; the
//!   word of the first half-edge that starts there and takes its normal, and how many do;
//! - a point, 4 words: the vertex that it is relative to; the word of the first of its other vertices, and how many there are; the float
//!   in `rows` of its weights, [`sums`] a vertex. Points with the same weights share them. The Loop limit has those of all vertices,
//!   then those of all edges, the Butterfly scheme those of edges; PN triangles none;
//! - what all of those list.

use super::TrianglePatches;
use super::butterfly::ButterflyMasks;
use super::fan::Fan;
use super::loop_limit::LoopMasks;
use super::mask::{Mask, edges};
use super::point_normal::given_at;
use super::recipe::Recipe;
use super::tables::entries_of;
use crate::surface::uniform;
use crate::{PoseDispatch, PoseTables};
use encase::ShaderType;
use keyleaf_key::Topology;
use std::collections::HashMap;

const NONE: u32 = u32::MAX;
const WORDS_OF_HALF_EDGE: usize = 3;
const WORDS_OF_FAN: usize = 6;
const WORDS_OF_POINT: usize = 4;

/// The uniform `pose`.
#[derive(ShaderType)]
struct TrianglePoseParams {
    faces: u32,
    fans: u32,
    edges: u32,
    points: u32,
    /// Entries of `surface_a` a face.
    entries: u32,
    /// The number of the point of edge 0.
    edge_points: u32,
    /// Words at which edges, fans and points begin.
    edge_words: u32,
    fan_words: u32,
    point_words: u32,
}

/// The tables of a surface; none where it was made of samples.
pub fn tables(surface: &TrianglePatches) -> Option<PoseTables> {
    let (topology, recipe) = (&surface.topology, &surface.recipe);
    let fans = Fan::all(topology);
    let points = points(topology, &fans, recipe)?;
    let edge_count = edges(topology).count();
    let edge_words = WORDS_OF_HALF_EDGE * topology.half_edge_count() as usize;
    let fan_words = edge_words + edge_count;
    let point_words = fan_words + WORDS_OF_FAN * fans.len();
    let mut lists = Lists::new(point_words + WORDS_OF_POINT * points.len());

    let mut words = half_edge_words(topology);
    words.extend(edges(topology).map(|owner| topology.half_edge_index(owner.face, owner.root)));
    for fan in &fans {
        words.extend(fan_record(topology, fan, recipe, &mut lists));
    }
    let mut rows = Rows::new(sums(recipe));
    for mask in &points {
        let vertices: Vec<u32> = mask.terms.iter().map(|&(vertex, _)| vertex).collect();
        let [first, count] = lists.add(&vertices);
        words.extend([mask.centre, first, count, rows.add(mask)]);
    }
    words.extend(lists.words);
    let (faces, edge_count) = (topology.face_count(), edge_count as u32);
    let (fan_count, point_count) = (fans.len() as u32, points.len() as u32);
    let [points_first, others @ ..] = [point_count, fan_count, faces, edge_count].map(PoseDispatch::Invocations);
    let has_points = !points.is_empty();
    Some(PoseTables {
        params: uniform(&TrianglePoseParams {
            faces,
            fans: fan_count,
            edges: edge_count,
            points: point_count,
            entries: entries_of(surface),
            edge_points: point_count.saturating_sub(edge_count),
            edge_words: edge_words as u32,
            fan_words: fan_words as u32,
            point_words: point_words as u32,
        }),
        words,
        rows: rows.floats,
        scratch: 4 * (sums(recipe) * points.len()).max(1),
        vertices: surface.cage.len(),
        has_covariances: false,
        dispatches: has_points.then_some(points_first).into_iter().chain(others).collect(),
    })
}

/// How many sums a point is: itself, and two tangents where the kind has any.
fn sums(recipe: &Recipe) -> usize {
    match recipe {
        Recipe::Limit(_) => 3,
        _ => 1,
    }
}

/// None where there is nothing to be posed.
fn points(topology: &Topology, fans: &[Fan], recipe: &Recipe) -> Option<Vec<Mask>> {
    match recipe {
        Recipe::Samples => None,
        Recipe::Limit(rules) => {
            let mut masks = LoopMasks::new(topology, fans, *rules);
            let mut points: Vec<Mask> = (0..topology.vertex_count() as u32)
                .map(|vertex| masks.vertex(vertex))
                .collect();
            points.extend(edges(topology).map(|owner| masks.edge(owner)));
            Some(points)
        }
        Recipe::Butterfly => {
            let mut masks = ButterflyMasks::new(topology, fans);
            Some(edges(topology).map(|owner| masks.edge(owner)).collect())
        }
        Recipe::PointNormal(_) => Some(Vec::new()),
    }
}

fn half_edge_words(topology: &Topology) -> Vec<u32> {
    let mut edge_of = vec![NONE; topology.half_edge_count() as usize];
    for (edge, owner) in (0..).zip(edges(topology)) {
        edge_of[topology.half_edge_index(owner.face, owner.root) as usize] = edge;
    }
    let words = topology.roots().flat_map(|root| {
        let owner = topology.half_edge_owner(root.face, root.root);
        let twin = topology.twin(root.face, root.root);
        [
            topology.vertex(root.face, root.root),
            edge_of[topology.half_edge_index(owner.face, owner.root) as usize],
            twin.map_or(NONE, |twin| topology.half_edge_index(twin.face, twin.root)),
        ]
    });
    words.collect()
}

fn fan_record(topology: &Topology, fan: &Fan, recipe: &Recipe, lists: &mut Lists) -> [u32; WORDS_OF_FAN] {
    let index = |spoke: &keyleaf_key::HalfEdge| topology.half_edge_index(spoke.face, spoke.root);
    let takes_normal = |half_edge: &u32| match recipe {
        Recipe::PointNormal(given) => given_at(given, *half_edge as usize).is_none(),
        _ => true,
    };
    let spokes: Vec<u32> = fan.spokes.iter().map(index).filter(takes_normal).collect();
    let [ring, ring_count] = lists.add(&fan.ring(topology));
    let [first_spoke, spoke_count] = lists.add(&spokes);
    [
        fan.vertex(topology),
        ring,
        ring_count,
        fan.spokes.len() as u32,
        first_spoke,
        spoke_count,
    ]
}

/// Lists one after the other, behind all records.
struct Lists {
    first: usize,
    words: Vec<u32>,
}

impl Lists {
    fn new(first: usize) -> Self {
        Self {
            first,
            words: Vec::new(),
        }
    }

    /// The word of a list, and its length.
    fn add(&mut self, list: &[u32]) -> [u32; 2] {
        let first = (self.first + self.words.len()) as u32;
        self.words.extend(list);
        [first, list.len() as u32]
    }
}

/// Weights, those of the same neighbourhood once.
struct Rows {
    sums: usize,
    floats: Vec<f32>,
    known: HashMap<Vec<u32>, u32>,
}

impl Rows {
    fn new(sums: usize) -> Self {
        Self {
            sums,
            // No buffer is empty.
            floats: vec![0.0],
            known: HashMap::new(),
        }
    }

    /// The float of the first weight of a point.
    fn add(&mut self, mask: &Mask) -> u32 {
        let weights = mask.terms.iter().flat_map(|(_, weights)| &weights[..self.sums]);
        let floats: Vec<f32> = weights.map(|&weight| weight as f32).collect();
        let first = self.floats.len() as u32;
        let bits = floats.iter().map(|float| float.to_bits()).collect();
        *self.known.entry(bits).or_insert_with(|| {
            self.floats.extend(&floats);
            first
        })
    }
}
