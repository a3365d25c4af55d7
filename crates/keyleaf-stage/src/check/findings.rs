//! What a check reports.

use keyleaf::key::Key;
use std::collections::BTreeMap;

/// What is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FindingKind {
    /// An edge that is not matched, or whose ends have other bits on its two sides.
    Crack,
    /// An edge that meets several smaller ones.
    TJunction,
    /// Leaves inside a leaf, or an edge drawn twice.
    Overlap,
    /// A part of a root that no leaf covers.
    LostLeaf,
    /// A leaf that is there twice.
    DuplicateLeaf,
    /// (I1) broken: half a diamond is split.
    HalfDiamond,
    /// (I2) broken: neighbours differ by more than a level.
    Unbalanced,
    /// A leaf marked as half of a pair that is none, or the other way round.
    PairFlag,
    /// Another flag or digit of a leaf's state that is wrong.
    State,
    /// Words that are not a key, or a key whose decoded form is another.
    Key,
    /// An entry of the leaf table that is wrong, missing or unreachable.
    Table,
    /// A slot in the draw list that should not be there, or twice.
    DrawList,
    /// A leaf that is in view and not drawn.
    Culled,
    /// A position or normal that is not finite, or a normal that is not a unit vector.
    NonFinite,
    /// A counter that says that something was lost.
    Counter,
    /// A pixel that does not show what was drawn.
    Picture,
}

impl FindingKind {
    /// The name that is printed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Crack => "crack",
            Self::TJunction => "T-junction",
            Self::Overlap => "overlap",
            Self::LostLeaf => "lost leaf",
            Self::DuplicateLeaf => "duplicate leaf",
            Self::HalfDiamond => "I1 violated",
            Self::Unbalanced => "I2 violated",
            Self::PairFlag => "wrong pair flag",
            Self::State => "wrong state",
            Self::Key => "wrong key",
            Self::Table => "wrong table entry",
            Self::DrawList => "wrong draw list",
            Self::Culled => "wrongly culled",
            Self::NonFinite => "non-finite vertex",
            Self::Counter => "wrong counter",
            Self::Picture => "wrong pixel",
        }
    }
}

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What.
    pub kind: FindingKind,
    /// The leaves or nodes concerned, if any.
    pub keys: Vec<Key>,
    /// Where and how, in words.
    pub detail: String,
}

/// The text form of a key: face, root, and its digits from the root on.
pub(super) fn key_text(key: Key) -> String {
    let mut text = format!("{}:{}:", key.face(), key.root());
    text.extend(key.digits().filter_map(|digit| char::from_digit(digit, 4)));
    text
}

impl Finding {
    /// The keys as face:root:digits.
    pub fn key_texts(&self) -> Vec<String> {
        self.keys.iter().copied().map(key_text).collect()
    }
}

/// All that is wrong with a frame: the first ones whole, the others counted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    /// The first of each kind, at most [`Findings::LIMIT`].
    pub first: Vec<Finding>,
    /// How many of each kind.
    pub counts: BTreeMap<FindingKind, u64>,
}

impl Findings {
    /// How many of each kind are kept whole.
    pub const LIMIT: u64 = 16;

    /// Adds one; `detail` is only asked for if it is kept.
    pub fn add(&mut self, kind: FindingKind, keys: impl IntoIterator<Item = Key>, detail: impl FnOnce() -> String) {
        let count = self.counts.entry(kind).or_default();
        if *count < Self::LIMIT {
            self.first.push(Finding {
                kind,
                keys: keys.into_iter().map(Key::without_flags).collect(),
                detail: detail(),
            });
        }
        *count += 1;
    }

    /// Number of all findings.
    pub fn total(&self) -> u64 {
        self.counts.values().sum()
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }
}
