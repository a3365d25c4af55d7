//! Bounds of the patches of a face, in the parameters of their domains.

use super::bound::{MeanBounds, Regions, Whole, of_patches};
use super::dual_patches::DualPatches;
use super::lanes::{Net, Square};
use super::lanes_of_triangle::BARYCENTRIC;
use crate::SubdivisionScheme;
use crate::root_bound::RootBound;
use crate::subdivision::bezier::Slopes;
use crate::subdivision::bound;
use crate::subdivision::neighbourhoods::{Kind, Neighbourhoods};
use glam::DVec3;

/// How many more parts than patches there may be a face, so that bounds are closer.
const PARTS: usize = 24;
const PARTS_OF_TRIANGLE: usize = 30;

/// How many more there may be, so that there are bounds.
const PARTS_FOR_ANY: usize = 3000;

/// How many times as large as what has been found anything may be on a patch without bounds. Only precisions that are positive definite
/// by a hair, or not at all, leave one.
const WITHOUT_BOUNDS: f64 = 8.0;

/// Bounds of the roots of a face, taken alone, and of all of it.
pub struct FaceBounds {
    pub roots: Vec<RootBound>,
    pub low: DVec3,
    pub high: DVec3,
}

impl FaceBounds {
    pub fn new(
        all: &Neighbourhoods,
        patches: &DualPatches,
        scheme: SubdivisionScheme,
        face: u32,
        regions: &Regions,
    ) -> Self {
        let bounds = match scheme {
            SubdivisionScheme::CatmullClark => of_face(all, patches, face, &Square, regions, PARTS),
            SubdivisionScheme::Loop(_) => of_face(all, patches, face, &BARYCENTRIC, regions, PARTS_OF_TRIANGLE),
        };
        let first = all.faces[face as usize].first_entries[0];
        let slopes = |domain: usize, patch: u32| {
            let before = all.faces[face as usize].first_entries[domain] - first;
            let MeanBounds { first, second, .. } = bounds[before / patches.size + patch as usize];
            Slopes { first, second }
        };
        Self {
            roots: bound::of_roots(all.kind(face), scheme, |domain, patch, _| slopes(domain, patch)),
            low: bounds.iter().fold(DVec3::INFINITY, |low, bounds| low.min(bounds.low)),
            high: bounds
                .iter()
                .fold(DVec3::NEG_INFINITY, |high, bounds| high.max(bounds.high)),
        }
    }
}

impl Regions {
    /// The roots of faces of a kind.
    pub fn roots(kind: &Kind) -> Self {
        let mut firsts = vec![0];
        for tree in &kind.trees {
            firsts.push(firsts[firsts.len() - 1] + tree.places.len());
        }
        let mut of_patch = vec![Vec::new(); firsts[kind.trees.len()]];
        for (root, touched) in kind.touched.iter().enumerate() {
            for touched in touched {
                of_patch[firsts[touched.domain] + touched.patch as usize].push((root, touched.is_turned));
            }
        }
        Self {
            count: kind.touched.len(),
            of_patch,
        }
    }
}

/// Bounds of all patches of a face, domain after domain.
fn of_face(
    all: &Neighbourhoods,
    patches: &DualPatches,
    face: u32,
    shape: &impl Net,
    regions: &Regions,
    more: usize,
) -> Vec<MeanBounds> {
    let domains = all.trees(face).iter().zip(&all.faces[face as usize].first_entries);
    let wholes: Vec<Whole<'_>> = domains
        .flat_map(|(tree, first)| {
            let numbers = first / patches.size..;
            numbers.zip(&tree.places)
        })
        .map(|(patch, place)| Whole {
            net: &patches.nets[patch],
            frame: &patches.frames[patch].frame,
            scale: 1.0 / place.right[0].abs(),
        })
        .collect();
    let most = [more, PARTS_FOR_ANY].map(|more| wholes.len() + more);
    let (bounds, found) = of_patches(shape, &wholes, regions, most);
    let unknown = found.map_or(MeanBounds::NONE, |found| found.widened(WITHOUT_BOUNDS));
    bounds.into_iter().map(|bounds| bounds.unwrap_or(unknown)).collect()
}
