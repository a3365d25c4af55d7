//! Opening files beside the event loop: the window stays alive.

use crate::app::Wake;
use egui_winit::winit::event_loop::EventLoopProxy;
use keyleaf_scene::Scene;
use keyleaf_stage::{LoadOptions, Loaded, load, load_scene};
use std::path::PathBuf;

/// What to open.
pub enum Wanted {
    /// A file.
    File(PathBuf, LoadOptions),
    /// A scene that was changed here; the file names it.
    Scene(PathBuf, Box<Scene>),
}

/// What became of it.
pub struct Opened {
    /// The file.
    pub file: PathBuf,
    /// The scene, or why there is none.
    pub result: Result<Loaded, String>,
    /// Whether it replaces itself: the camera stays.
    pub is_again: bool,
    /// Which request it answers: older ones are void.
    pub number: u64,
}

/// Opens on a thread of its own, and wakes the loop when it is done.
pub fn open(wanted: Wanted, is_again: bool, number: u64, proxy: EventLoopProxy<Wake>) {
    std::thread::spawn(move || {
        let (file, result) = match wanted {
            Wanted::File(file, options) => {
                let result = load(&file, &options);
                (file, result)
            }
            Wanted::Scene(file, scene) => {
                let result = load_scene(*scene, &file);
                (file, result)
            }
        };
        let opened = Opened {
            file,
            result: result.map_err(|error| error.to_string()),
            is_again,
            number,
        };
        // The loop is gone only if the window was closed meanwhile.
        let _ = proxy.send_event(Wake::Opened(Box::new(opened)));
    });
}
