//! Bounds of the patches of a face, in the parameters of their domains.

use super::bound::{MeanBounds, Regions, Whole, of_patches};
use super::dual_patches::DualPatches;
use super::lanes::{Net, Square};
use super::lanes_of_triangle::BARYCENTRIC;
use crate::SubdivisionScheme;
use crate::root_bound::RootBound;
use crate::subdivision::bezier::Slopes;
use crate::subdivision::bound;
use crate::subdivision::neighbourhoods::Neighbourhoods;
use crate::subdivision::tree::Tree;
use glam::DVec3;

/// How many cuts into four there may be a face, so that bounds are closer.
const CUTS: usize = 6;

/// How many there may be, so that there are bounds.
const CUTS_FOR_ANY: usize = 1000;

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
        corners: u32,
    ) -> Self {
        let regions = roots(all.trees(face), scheme, corners as usize);
        let bounds = match scheme {
            SubdivisionScheme::CatmullClark => of_face(all, patches, face, &Square, &regions),
            SubdivisionScheme::Loop(_) => of_face(all, patches, face, &BARYCENTRIC, &regions),
        };
        let first = all.faces[face as usize].first_entries[0];
        let slopes = |domain: usize, patch: u32| {
            let before = all.faces[face as usize].first_entries[domain] - first;
            let MeanBounds { first, second, .. } = bounds[before / patches.size + patch as usize];
            Slopes { first, second }
        };
        Self {
            roots: bound::of_roots(all.trees(face), scheme, corners as usize, |domain, patch, _| {
                slopes(domain, patch)
            }),
            low: bounds.iter().fold(DVec3::INFINITY, |low, bounds| low.min(bounds.low)),
            high: bounds
                .iter()
                .fold(DVec3::NEG_INFINITY, |high, bounds| high.max(bounds.high)),
        }
    }
}

/// The roots of a face as regions of its patches.
fn roots(trees: &[Tree], scheme: SubdivisionScheme, corners: usize) -> Regions {
    let firsts: Vec<usize> = trees
        .iter()
        .scan(0, |next, tree| Some(std::mem::replace(next, *next + tree.places.len())))
        .collect();
    let patches = trees.iter().map(|tree| tree.places.len()).sum();
    let mut of_patch = vec![Vec::new(); patches];
    for root in 0..corners {
        for touched in bound::touched(trees, scheme, corners, root) {
            of_patch[firsts[touched.domain] + touched.patch as usize].push((root, touched.is_turned));
        }
    }
    Regions {
        count: corners,
        of_patch,
    }
}

/// Bounds of all patches of a face, domain after domain.
fn of_face(
    all: &Neighbourhoods,
    patches: &DualPatches,
    face: u32,
    shape: &impl Net,
    regions: &Regions,
) -> Vec<MeanBounds> {
    let domains = all.trees(face).iter().zip(&all.faces[face as usize].first_entries);
    let wholes: Vec<Whole<'_>> = domains
        .flat_map(|(tree, first)| {
            let numbers = first / patches.size..;
            numbers.zip(&tree.places)
        })
        .map(|(patch, place)| Whole {
            controls: patches.controls(patch),
            frame: &patches.frames[patch].frame,
            scale: 1.0 / place.right[0].abs(),
        })
        .collect();
    let most = [CUTS, CUTS_FOR_ANY].map(|cuts| wholes.len() + 3 * cuts);
    let (bounds, found) = of_patches(shape, &wholes, regions, most);
    let unknown = found.map_or(MeanBounds::NONE, |found| found.widened(WITHOUT_BOUNDS));
    bounds.into_iter().map(|bounds| bounds.unwrap_or(unknown)).collect()
}
