//! How far terminal patches are from the limit surface.

use super::dual::Dual;
use super::dual_patches::DualPatches;
use super::solve::Ldl;
use crate::subdivision::BETWEEN_SAMPLES;
use glam::DVec3;

/// The greatest distance at samples of the terminal patches, with room for what is between them; object units.
///
/// `errors` are those of samples in dual space about a centre, with their patches. In space they are what they are at the corner of the
/// patch where they count most.
pub fn error(patches: &DualPatches, errors: &[(u32, Dual)], centre: DVec3) -> f64 {
    let mut greatest: f64 = 0.0;
    for samples in errors.chunk_by(|a, b| a.0 == b.0) {
        let patch = samples[0].0 as usize;
        let own = &patches.frames[patch];
        let corners = patches.corners().iter();
        let corners: Vec<_> = corners
            .filter_map(|&corner| patches.nets[patch].control(corner).solve())
            .collect();
        for (_, missed) in samples {
            let missed = own.of_vertices(missed, centre);
            let motion = |(factors, mean): &(Ldl, DVec3)| {
                let rate = factors.solve(missed.information - missed.precision * *mean);
                (own.frame.axes * rate).length()
            };
            greatest = corners.iter().map(motion).fold(greatest, f64::max);
        }
    }
    BETWEEN_SAMPLES * greatest
}
