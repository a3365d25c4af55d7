//! The device of all tests, and the pipelines that they share.

use keyleaf::headless::Headless;
use keyleaf::inspect::Inspector;
use keyleaf::{Kind, Morph, Passes};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex};

/// The device. Panics where there is none.
pub fn gpu() -> &'static Headless {
    static GPU: LazyLock<Headless> = LazyLock::new(|| {
        pollster::block_on(Headless::request())
            .unwrap_or_else(|error| panic!("these tests need a Vulkan driver, a software one is enough: {error}"))
    });
    &GPU
}

/// The update of a kind, compiled once.
pub fn passes(kind: Kind) -> Arc<Passes> {
    static ALL: Mutex<Option<HashMap<Kind, Arc<Passes>>>> = Mutex::new(None);
    let mut all = ALL.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let kind = Kind {
        morph: Morph::None, // as far as the update goes
        ..kind
    };
    let compile = || Arc::new(Passes::new(&gpu().device, kind).expect("the shaders compose"));
    Arc::clone(all.get_or_insert_default().entry(kind).or_insert_with(compile))
}

/// The evaluators of a kind, compiled once.
pub fn inspector(kind: Kind) -> Arc<Inspector> {
    static ALL: Mutex<Option<HashMap<Vec<&'static str>, Arc<Inspector>>>> = Mutex::new(None);
    let mut all = ALL.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let compile = || Arc::new(Inspector::new(&gpu().device, &kind).expect("the shaders compose"));
    Arc::clone(
        all.get_or_insert_default()
            .entry(kind.drawing_files())
            .or_insert_with(compile),
    )
}
