//! Makes the Bézier and NURBS surfaces of a scene's entry, and says how they were joined.

use std::path::Path;
use std::sync::Arc;

use keyleaf_surface::{BasisMethod, JoinReport, NurbsSurface, PatchKind, PatchSettings, Patches, Surface, Unjoined};

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::patch::{PatchFileOptions, read_patches};
use crate::scene::{BezierSource, NurbsSource, PatchesSource, Problem, bezier_surface};
use crate::surfaces::{Failure, Made};

/// The surfaces of a file.
pub(crate) fn of_file(folder: &Path, source: &PatchesSource, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let file = folder.join(&source.path);
    let options = PatchFileOptions {
        ignore_trims: source.ignore_trims,
    };
    let model = read_patches(&file, &options).map_err(Failure::of("source.path"))?;
    notes.extend(model.notes);
    let kind = match source.basis {
        None if model.is_bezier => PatchKind::Bezier,
        basis => PatchKind::Nurbs(basis.unwrap_or_default().into()),
    };
    let settings = PatchSettings {
        tolerance: source.tolerance,
        kind,
        even_spans: source.even_spans,
    };
    let mut made = join(&file, model.surfaces, settings, notes)?;
    made.files.push(file);
    Ok(made)
}

/// NURBS surfaces of the scene file `file`.
pub(crate) fn of_nurbs(file: &Path, source: &NurbsSource, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let surfaces = source.surfaces.iter().map(|patch| patch.surface());
    let settings = PatchSettings {
        tolerance: source.tolerance,
        kind: PatchKind::Nurbs(BasisMethod::from(source.basis)),
        even_spans: source.even_spans,
    };
    join(file, written(file, surfaces)?, settings, notes)
}

/// Bézier patches of the scene file `file`.
pub(crate) fn of_bezier(file: &Path, source: &BezierSource, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let surfaces = source.patches.iter().map(|rows| bezier_surface(rows));
    let settings = PatchSettings {
        tolerance: source.tolerance,
        kind: PatchKind::Bezier,
        even_spans: false,
    };
    join(file, written(file, surfaces)?, settings, notes)
}

/// What validation has accepted.
fn written(
    file: &Path,
    surfaces: impl Iterator<Item = Result<NurbsSurface, Problem>>,
) -> Result<Vec<NurbsSurface>, Failure> {
    let refused = |Problem { field, problem }| {
        let reason = format!("{field}: {problem}");
        Failure::of("source")(ImportError::malformed(file, FilePlace::Whole, reason))
    };
    surfaces.map(|surface| surface.map_err(refused)).collect()
}

fn join(
    file: &Path,
    surfaces: Vec<NurbsSurface>,
    settings: PatchSettings,
    notes: &mut Vec<Note>,
) -> Result<Made, Failure> {
    let patches = Patches::new(surfaces, settings);
    let patches = patches
        .map_err(|error| ImportError::malformed(file, FilePlace::Whole, error.to_string()))
        .map_err(Failure::of("source"))?;
    tell(file, patches.report(), notes);
    if settings.even_spans {
        notes.push(Note::remark(file, cuts(&patches, settings.kind)));
    }
    Ok(Made::new(Arc::new(patches)))
}

/// What became of the knot spans of a model that wished them even.
fn cuts(patches: &Patches, kind: PatchKind) -> String {
    if kind == PatchKind::Bezier {
        return "even_spans has no effect on single Bézier patches; with a basis they are NURBS surfaces".to_owned();
    }
    let surfaces = 0..patches.surfaces().len() as u32;
    let parts = |surface: u32| patches.parts_of_spans(surface).into_iter().product::<u32>();
    let cut = surfaces.clone().filter(|&surface| parts(surface) > 1).count();
    let quads = |surface: u32| {
        let [u, v] = patches.knots_of(surface).map(|knots| knots.len() as u32 - 1);
        u * v
    };
    let before: u32 = surfaces.map(|surface| quads(surface) / parts(surface)).sum();
    let now = patches.topology().face_count();
    format!("knot-span quads: {now}, of {before} before knot spans were cut to make them even, in {cut} surfaces")
}

/// Notes about the joins.
fn tell(file: &Path, report: &JoinReport, notes: &mut Vec<Note>) {
    let JoinReport {
        exact,
        snapped,
        largest_move,
        unjoined,
        poles,
        transposed,
    } = report;
    let mut remark = |text: String| notes.push(Note::remark(file, text));
    let joined = exact + snapped;
    if joined > 0 {
        remark(format!(
            "pairs of boundaries joined: {joined} ({exact} equal, {snapped} within the tolerance, control points moved by at most \
             {largest_move:e})"
        ));
    }
    let count = |why: Unjoined| unjoined.iter().filter(|(_, reason)| *reason == why).count();
    match count(Unjoined::Free) {
        0 => {}
        free => remark(format!(
            "boundaries open because no other has the same curve with the same knots: {free}"
        )),
    }
    if !poles.is_empty() {
        remark(format!(
            "points into which boundaries collapse (poles): {}",
            poles.len()
        ));
    }
    if !transposed.is_empty() {
        let number = transposed.len();
        remark(format!(
            "surfaces with u and v exchanged, so that neighbours have the same side up: {number}"
        ));
    }
    match count(Unjoined::Apart) {
        0 => {}
        apart => notes.push(Note::warning(
            file,
            format!("boundaries that lie along another but are not the same curve with the same knots, open: {apart}"),
        )),
    }
    match count(Unjoined::Crowded) {
        0 => {}
        crowded => notes.push(Note::warning(
            file,
            format!("boundaries open because two others with the same curve are joined already: {crowded}"),
        )),
    }
    match count(Unjoined::NotOrientable) {
        0 => {}
        turned => notes.push(Note::warning(
            file,
            format!("boundaries open because the joined surface would have one side only: {turned}"),
        )),
    }
}
