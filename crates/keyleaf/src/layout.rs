//! How the quadtree's buffers are laid out: the Rust side of `shaders/shared/leaf.wgsl`, `control.wgsl` and of the constants of
//! `passes/copy.wgsl`. A test of the workspace compares sizes and offsets with those that naga computes.

use crate::settings::{BackFaces, Pairs};
use bytemuck::{Pod, Zeroable};
use keyleaf_key::{Key, Place};

/// One leaf, by slot: its key, and the key decoded. 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub struct Leaf {
    /// The key; both halves of its node are 0 in a slot that is free.
    pub key: Key,
    /// Root-space coordinates of the O corner, 31 fraction bits.
    pub origin: [u32; 2],
    /// Orientation in quarter turns, and the level shifted left by 8.
    pub orientation_level: u32,
    /// Entry of the leaf table, [`NO_ENTRY`] before it is in.
    pub entry: u32,
}

/// [`Leaf::entry`] of a leaf that is not in the table.
pub const NO_ENTRY: u32 = u32::MAX;

impl Leaf {
    /// The record of a place, not yet in the table.
    pub fn new(place: &Place) -> Self {
        Self {
            key: place.key(),
            origin: [place.x, place.y],
            orientation_level: place.orientation | (place.level << 8),
            entry: NO_ENTRY,
        }
    }

    /// The decoded form, as the GPU uses it (not derived from the key: `check` compares both).
    pub fn place(&self) -> Place {
        Place {
            face: self.key.face(),
            root: self.key.root(),
            x: self.origin[0],
            y: self.origin[1],
            orientation: self.orientation_level & 3,
            level: self.orientation_level >> 8,
        }
    }
}

/// What the surface and the metric said of a leaf. 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Measure {
    /// Middle of the hypotenuse, object units, relative to the origin.
    pub centre: [f32; 3],
    /// Radius of the culling ball, object units.
    pub radius: f32,
    /// Numerator of the metric; 0 at the level limit.
    pub size: f32,
    /// Radius of the ball for the guard band, object units.
    pub guard: f32,
    /// Numerator of the metric of the parent; for even children only.
    pub parent_size: f32,
    /// Radius of the culling ball of the parent; for even children only.
    pub parent_radius: f32,
}

/// Flags of a state word (its low eight bits hold these and the digit; the others are the published wish).
pub mod state {
    use keyleaf_key::Place;

    /// Drawn as half of a pair. If the leaf is not free, it must be, and may not split.
    pub const PAIR: u32 = 1;
    /// Made since the last publication.
    pub const FRESH: u32 = 2;
    /// Was there at the last publication but one.
    pub const MATURE: u32 = 4;
    /// Child 0 says that the parent's metric is satisfied.
    pub const MERGE: u32 = 8;
    /// Where the last digit is, in three bits.
    pub const DIGIT_SHIFT: u32 = 4;
    /// The digit of an even root; that of an odd one is one more.
    pub const ROOT_DIGIT: u32 = 4;
    /// The four nodes about the right angle are leaves: both pairs may be drawn, or none.
    pub const FREE: u32 = 0x80;
    /// All bits that are not the wish.
    pub const FLAGS: u32 = 0xff;

    /// What [`digit`] says of a place.
    pub fn digit_of(place: Place) -> u32 {
        place.digit().unwrap_or(ROOT_DIGIT | (place.root & 1))
    }

    /// The last digit, 0..=3, or [`ROOT_DIGIT`] or one more: where pairs may be, the last bit tells their odd halves.
    pub fn digit(word: u32) -> u32 {
        (word >> DIGIT_SHIFT) & 7
    }

    /// The published wish: metric over threshold, 16 bits of mantissa.
    pub fn wish(word: u32) -> f32 {
        f32::from_bits((word & !FLAGS) >> 1)
    }
}

/// Counters that the passes share. 236 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable, Default)]
pub struct Control {
    /// Live leaves.
    pub leaves: u32,
    /// Slots in use while changes are applied.
    pub allocated: u32,
    /// Leaves that are drawn.
    pub visible: u32,
    /// Leaves that want to split.
    pub splitters: u32,
    /// Change records.
    pub changes: u32,
    /// Halves of diamonds split, while changes are applied.
    pub splits: u32,
    /// Halves of diamonds merged.
    pub merges: u32,
    /// Slots freed.
    pub freed: u32,
    /// Moves: slots to move from.
    pub sources: u32,
    /// Moves: slots to move to.
    pub targets: u32,
    /// Requests raised by the last decision.
    pub requests: u32,
    /// Lowest bucket admitted.
    pub lowest_bucket: u32,
    /// Sixteenths of an octave by which the threshold is raised.
    pub pressure: i32,
    /// Passes without a change.
    pub idle: u32,
    /// Entries of the table that are not empty.
    pub entries_used: u32,
    /// Rebuilds of the table since the start.
    pub rebuilds: u32,
    /// Leaves that wish to split.
    pub unmet: u32,
    /// Of those, the ones that do not fit the capacity.
    pub starved: u32,
    /// Passes since the start.
    pub passes: u32,
    /// Failed look-ups that the invariants promise to succeed.
    pub lost: u32,
    /// Splits of the last pass, in halves of diamonds.
    pub last_splits: u32,
    /// Merges of the last pass, in halves of diamonds.
    pub last_merges: u32,
    /// Wishes that the next lower pressure would turn into splits.
    pub near: u32,
    /// Passes since the pressure changed.
    pub since_step: u32,
    /// Pressure at which wishes did not fit in the present view; -1: none.
    pub failed: i32,
    /// Of the view that `failed` is of.
    pub view_serial: u32,
    /// Leaves that speak for a parent that is satisfied.
    pub mergers: u32,
    /// Wishes by bucket.
    pub wishes: [u32; 32],
}

/// Byte offsets of the indirect arguments in their buffer.
pub mod arguments {
    /// Of `decide_splits`.
    pub const SPLITS: u64 = 0;
    /// Of `decide_merges`.
    pub const MERGES: u64 = 16;
    /// Of `apply` and `flag`: an invocation a change.
    pub const CHANGES: u64 = 32;
    /// Of `measure`.
    pub const MEASURE: u64 = 48;
    /// Of `match_slots` and `move_leaves`.
    pub const COMPACT: u64 = 64;
    /// Of `clear_table`.
    pub const CLEAR: u64 = 80;
    /// Of `enter_leaves`.
    pub const ENTER: u64 = 96;
    /// Of `update`.
    pub const UPDATE: u64 = 112;
    /// Of `update_requested`, in its place where there are requests.
    pub const UPDATE_REQUESTED: u64 = 128;
    /// Of passes with an invocation a leaf.
    pub const LEAVES: u64 = 144;
    /// Of the draw.
    pub const DRAW: u64 = 160;
    /// Of the buffer.
    pub const SIZE: u64 = 192;
}

/// Leaves that one workgroup of `update` takes.
pub const UPDATE_LEAVES: u32 = 512;

/// Invocations of a workgroup of the other passes.
pub const GROUP_SIZE: u32 = 64;

/// The most leaves a quadtree can hold: the table stores a slot in 24 bits.
pub const MAX_CAPACITY: u32 = (1 << 24) - 3;

/// Entries of the table for a capacity: a power of two, at least twice the capacity.
pub fn table_entries(capacity: u32) -> u32 {
    (2 * capacity).next_power_of_two().max(64)
}

/// The hash by which the table holds a place. Twin of `place_hash` of `table.wgsl`.
pub fn place_hash(p: &Place) -> u32 {
    let mut h = (p.x ^ (p.x >> 16)).wrapping_mul(0x9e37_79b1);
    h = (h ^ (h >> 15) ^ p.y ^ (p.y >> 16)).wrapping_mul(0x85eb_ca77);
    h = (h ^ (h >> 16))
        .wrapping_add(p.face.wrapping_mul(0xc2b2_ae3d))
        .wrapping_add((p.root << 7) | (p.level << 2) | p.orientation);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Four floats a slot each: parents of even children, normal cones of leaves if there are any, and what is known of pairs that need not be.
/// How many of those come before the pairs.
pub fn pairs_follow(back_faces: BackFaces) -> u32 {
    1 + u32::from(back_faces.has_leaf_cones())
}

/// Bytes of each buffer whose size depends on the capacity, with the name that `plan` prints.
pub fn buffer_bytes(capacity: u32, back_faces: BackFaces, pairs: Pairs) -> [(&'static str, u64); 6] {
    let slots = u64::from(capacity);
    let behind = pairs_follow(back_faces) + u32::from(pairs == Pairs::Wished);
    [
        ("leaves", slots * size_of::<Leaf>() as u64),
        ("measures", slots * size_of::<Measure>() as u64),
        ("parents", slots * 16 * u64::from(behind)),
        ("state", slots * 8),
        ("lists", slots * 16),
        ("table", u64::from(table_entries(capacity)) * 4),
    ]
}

/// Groups in two dimensions for a number of items, as `groups_for` of `copy.wgsl` computes them.
pub fn groups_for(items: u32, group: u32) -> [u32; 3] {
    const MAX_GROUPS: u32 = 65_535;
    let groups = items.div_ceil(group);
    let rows = groups.div_ceil(MAX_GROUPS).max(1);
    [groups.div_ceil(rows), rows, 1]
}
