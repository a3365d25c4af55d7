//! The 16 bytes that stand for one node of the quadtree (ARCHITECTURE section 2).

use crate::{MAX_LEVEL, Place};
use bytemuck::{Pod, Zeroable};
use thiserror::Error;

/// A node of the quadtree of one root of one face, in the layout that the GPU reads: `[node_hi, node_lo, face, flags | root]`.
///
/// `node` is a 1 followed by two bits a level, the root's digit first; its level is half the index of its highest set bit.
/// `root` lies in the low half of the last word and 16 bits of flags in the high half. Flags are part of the value when keys
/// are compared; keys that the CPU makes have none, and [`Key::without_flags`] drops those of the GPU.
///
/// ```
/// use keyleaf_key::Key;
/// let key = Key::of_root(7, 2).child(3).child(1);
/// assert_eq!((key.level(), key.node()), (2, 0b1_11_01));
/// assert_eq!(key.parent(), Some(Key::of_root(7, 2).child(3)));
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Pod, Zeroable)]
pub struct Key {
    node_hi: u32,
    node_lo: u32,
    face: u32,
    flags_and_root: u32,
}

/// Why four words are not a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum KeyError {
    /// The node is zero: the leading 1 is missing.
    #[error("a key whose node is 0 names no node: the leading 1 is missing")]
    NoLeadingOne,
    /// The leading 1 is followed by an odd number of bits.
    #[error("node {node:#x} is not a key: its leading 1 is followed by an odd number of bits")]
    HalfDigit {
        /// The node as it was found.
        node: u64,
    },
}

impl Key {
    /// The key of level 0 of root `root` of face `face`. Only the low 16 bits of `root` are kept.
    pub fn of_root(face: u32, root: u32) -> Self {
        Self::from_parts(1, face, root)
    }

    /// The key of the node at the end of the path `node`.
    ///
    /// # Errors
    /// [`KeyError`] when `node` is not a 1 followed by whole base-4 digits.
    pub fn new(node: u64, face: u32, root: u16) -> Result<Self, KeyError> {
        Self::from_parts(node, face, root.into()).checked()
    }

    /// The caller answers for `node`.
    pub(crate) fn from_parts(node: u64, face: u32, root: u32) -> Self {
        Self {
            node_hi: (node >> 32) as u32,
            node_lo: node as u32,
            face,
            flags_and_root: root & 0xffff,
        }
    }

    /// The four words as the GPU stores them. They are not checked here, but in [`Key::place`].
    pub fn from_words([node_hi, node_lo, face, flags_and_root]: [u32; 4]) -> Self {
        Self {
            node_hi,
            node_lo,
            face,
            flags_and_root,
        }
    }

    /// The four words as the GPU stores them.
    pub fn to_words(self) -> [u32; 4] {
        [self.node_hi, self.node_lo, self.face, self.flags_and_root]
    }

    /// The path: a 1 followed by two bits a level.
    pub fn node(self) -> u64 {
        (u64::from(self.node_hi) << 32) | u64::from(self.node_lo)
    }

    /// The face, counted from 0.
    pub fn face(self) -> u32 {
        self.face
    }

    /// The root: the face's corner at which its mesh edge starts.
    pub fn root(self) -> u32 {
        self.flags_and_root & 0xffff
    }

    /// The 16 flag bits, 0 in a key that the CPU made.
    pub fn flags(self) -> u32 {
        self.flags_and_root >> 16
    }

    /// The same node without flags.
    #[must_use]
    pub fn without_flags(self) -> Self {
        Self {
            flags_and_root: self.root(),
            ..self
        }
    }

    /// Number of base-4 digits, 0 for a root, at most [`MAX_LEVEL`].
    pub fn level(self) -> u32 {
        (self.node() | 1).ilog2() / 2
    }

    /// The last base-4 digit, which child of its parent this is; none at a root.
    pub fn digit(self) -> Option<u32> {
        (self.level() > 0).then_some(self.node_lo & 3)
    }

    /// The digits, the root's first.
    pub fn digits(self) -> impl DoubleEndedIterator<Item = u32> {
        let node = self.node();
        (0..self.level()).rev().map(move |i| (node >> (2 * i)) as u32 & 3)
    }

    /// The parent, none at a root.
    pub fn parent(self) -> Option<Self> {
        (self.level() > 0).then(|| Self::from_parts(self.node() >> 2, self.face, self.root()))
    }

    /// Child `digit` (0..4) of a node above [`MAX_LEVEL`].
    #[must_use]
    pub fn child(self, digit: u32) -> Self {
        debug_assert!(self.level() < MAX_LEVEL && digit < 4);
        Self::from_parts((self.node() << 2) | u64::from(digit), self.face, self.root())
    }

    /// The exact place of the node, in integers, one step a digit. Flags are ignored.
    ///
    /// # Errors
    /// [`KeyError`] when the words, which may come from anywhere, are not a key.
    pub fn place(self) -> Result<Place, KeyError> {
        let key = self.checked()?;
        Ok(key.digits().fold(Place::of_root(key.face, key.root()), Place::child))
    }

    fn checked(self) -> Result<Self, KeyError> {
        match self.node() {
            0 => Err(KeyError::NoLeadingOne),
            node if node.ilog2() % 2 == 1 => Err(KeyError::HalfDigit { node }),
            _ => Ok(self),
        }
    }
}

impl TryFrom<Key> for Place {
    type Error = KeyError;

    fn try_from(key: Key) -> Result<Self, KeyError> {
        key.place()
    }
}

impl From<Place> for Key {
    fn from(place: Place) -> Self {
        place.key()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_bytes_in_the_order_of_the_gpu() {
        let key = Key::of_root(5, 9).child(2);
        assert_eq!(bytemuck::cast::<Key, [u32; 4]>(key), [0, 0b110, 5, 9]);
        assert_eq!(Key::from_words(key.to_words()), key);
    }

    #[test]
    fn flags_change_neither_the_place_nor_the_relatives() {
        let plain = Key::of_root(1, 3).child(0).child(3);
        let mut words = plain.to_words();
        words[3] |= 0xabcd_0000;
        let flagged = Key::from_words(words);
        assert_eq!(flagged.flags(), 0xabcd);
        assert_ne!(flagged, plain);
        assert_eq!(flagged.without_flags(), plain);
        assert_eq!(flagged.place(), plain.place());
        assert_eq!(flagged.parent(), plain.parent());
        assert_eq!(flagged.child(1), plain.child(1));
    }

    #[test]
    fn words_that_are_no_key_are_refused() {
        assert_eq!(Key::new(0, 0, 0), Err(KeyError::NoLeadingOne));
        assert_eq!(Key::new(0b10, 0, 0), Err(KeyError::HalfDigit { node: 2 }));
        assert_eq!(
            Key::from_words([1 << 31, 0, 0, 0]).place(),
            Err(KeyError::HalfDigit { node: 1 << 63 })
        );
        assert!(Key::new(1 << 62, 0, 0).is_ok_and(|key| key.level() == MAX_LEVEL));
    }
}
