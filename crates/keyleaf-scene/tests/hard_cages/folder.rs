//! A folder with models and a scene, and what opening it gives.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use keyleaf_scene::{OpenOptions, OpenedScene, open};
use keyleaf_surface::Surface;

/// Longer than anything here takes on a slow machine that is busy: what takes as long hangs.
const PATIENCE: Duration = Duration::from_secs(20);

/// How many roots of a surface are looked at.
const MOST_ROOTS: usize = 12;

/// A folder of its own, removed when done.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("keyleaf-hard-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub fn write(&self, file: &str, text: &str) {
        std::fs::write(self.0.join(file), text).unwrap();
    }

    /// Opens a scene that draws a model as a surface of a kind.
    pub fn open(&self, model: &str, shape: &str) -> Result<OpenedScene, String> {
        let text = format!("(surfaces: [(name: \"a\", source: Mesh(\"{model}\"), surface: {shape})])");
        self.write("s.ron", &text);
        let start = Instant::now();
        let opened = open(&self.0.join("s.ron"), &OpenOptions::default()).map_err(|error| error.to_string());
        let took = start.elapsed();
        assert!(took < PATIENCE, "{model} as {shape}: {took:?}");
        if took > Duration::from_secs(1) {
            println!("{model} as {shape}: {took:.1?}");
        }
        opened
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Every position, derivative and bound is a finite number, every normal has the length 1.
pub fn check_surface(what: &str, opened: &OpenedScene) {
    let surface: &dyn Surface = opened.surfaces[0].surface.as_ref();
    let topology = surface.topology();
    let step = (topology.half_edge_count() as usize).div_ceil(MOST_ROOTS);
    for root in topology.roots().step_by(step) {
        let one = keyleaf_key::ONE;
        for (x, y) in [
            (0, 0),
            (one, 0),
            (0, one),
            (one / 2, one / 2),
            (one / 3, one / 5),
            (one - 3, 2),
        ] {
            let at = root.at(x, y);
            for frame in [surface.frame(at), surface.drawn(at)] {
                let is_finite = frame.position.is_finite() && frame.du.is_finite() && frame.dv.is_finite();
                let is_unit = (frame.normal.length() - 1.0).abs() < 1e-9;
                assert!(is_finite && is_unit, "{what}: {frame:?} at {at:?}");
            }
        }
        let bound = surface.bound(&root);
        let numbers = [bound.radius, bound.size, bound.guard, bound.deviation];
        let is_sound = numbers.iter().all(|number| number.is_finite() && *number >= 0.0);
        assert!(is_sound && bound.centre.is_finite(), "{what}: {bound:?}");
    }
    let (low, high) = surface.bounding_box();
    assert!(low.is_finite() && high.is_finite(), "{what}: {low} {high}");
    assert!(surface.tables(low).a.iter().all(|x| x.is_finite()), "{what}");
}

/// The error of a model that is drawn as a surface of a kind; it must hold all parts.
pub fn refused(folder: &Folder, model: &str, shape: &str, parts: &[&str]) {
    let error = match folder.open(model, shape) {
        Ok(_) => panic!("{model} as {shape} opens; expected an error with {parts:?}"),
        Err(error) => error,
    };
    for part in parts {
        assert!(error.contains(part), "{model} as {shape}: '{part}' is not in: {error}");
    }
}
