//! Linear-quadtree keys on the faces of a polygon mesh, and everything about them that needs no GPU and no file.
//!
//! # Theory
//!
//! A face with n corners is a fan of n *root* triangles about its centre. A root splits into four similar right triangles,
//! each of these again, and so on; the leaves of that tree, each a 64-bit path, are all that keyleaf stores (Khoury, *Adaptive
//! GPU tessellation with compute shaders*; Dupuy et al., *Quadtrees on the GPU*, for square trees). The two same-level nodes
//! that share a hypotenuse are a *diamond*: they split and merge together, which is what keeps a drawn surface closed.
//!
//! # Words
//!
//! | module | gives |
//! |---|---|
//! | [`key`] | [`Key`]: the 16 bytes of a node, as the GPU stores it |
//! | [`place`] | [`Place`]: a key decoded in integers, [`RootPoint`]: a point of a face; exact at every level |
//! | [`topology`] | [`Topology`]: which half-edges of the mesh meet, and the errors of a mesh that is not a surface |
//! | [`neighbour`] | the neighbours of a node across its three edges, also across roots and faces |
//! | [`site`] | [`Site`]: one canonical address for a point that several roots share |
//! | [`forest`] | [`Forest`]: the leaves and the parallel update, twin of the compute passes, with its checks |
//! | [`pressure`] | [`Pressure`]: the threshold that rises while a full buffer leaves wishes unmet |
//!
//! # Practice
//!
//! Nothing here rounds: positions are multiples of 1/[`ONE`] in `u32`, so the deepest level has three distinct corners a leaf
//! and neighbours that agree to the last bit. Only wishes, which are priorities and not positions, are floats.
//!
//! ```
//! use keyleaf_key::{Forest, Topology};
//!
//! let tetrahedron = Topology::new(4, [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])?;
//! let mut forest = Forest::new(&tetrahedron, 3);
//! for _ in 0..12 {
//!     forest.update(|leaf| if leaf.level < 2 { 2.0 } else { 0.5 }, usize::MAX);
//! }
//! assert_eq!(forest.leaves.len(), 4 * 3 * 16); // faces, roots a face, leaves a root
//! assert!(forest.invariants().is_empty() && forest.cracks().is_empty());
//! # Ok::<(), keyleaf_key::TopologyError>(())
//! ```

pub mod forest;
pub mod key;
pub mod neighbour;
pub mod place;
pub mod pressure;
pub mod site;
pub mod topology;

pub use forest::{Changes, Forest, Published};
pub use key::{Key, KeyError};
pub use place::{Place, RootPoint};
pub use pressure::{Census, Pressure};
pub use site::Site;
pub use topology::{HalfEdge, Topology, TopologyError};

/// The length of a root's legs in the integers of root space: 1.0 with 31 fraction bits.
pub const ONE: u32 = 1 << 31;

/// The deepest level: 31 base-4 digits fit a key, and a leaf of level 31 is one unit of root space long.
pub const MAX_LEVEL: u32 = 31;

/// The most corners (and so roots) that one face may have: a root is stored in 16 bits of the key.
pub const MAX_CORNERS: usize = 65_535;
