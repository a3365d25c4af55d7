//! Watching files: the open scene with its data, and, in a checkout, the WGSL.

use crate::app::Wake;
use egui_winit::winit::event_loop::EventLoopProxy;
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What has changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Changed {
    /// A file of the scene.
    Scene,
    /// A WGSL file.
    Shaders,
}

/// A watch on files; it ends when it is dropped.
pub struct Watch {
    _watcher: RecommendedWatcher,
}

impl Watch {
    /// Watches the files of a scene, and a folder of WGSL files. Editors replace files, so that folders are watched.
    ///
    /// # Errors
    /// The system cannot watch.
    pub fn new(files: &[PathBuf], shaders: Option<&Path>, proxy: EventLoopProxy<Wake>) -> notify::Result<Self> {
        let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let files: BTreeSet<PathBuf> = files.iter().map(|file| real(file)).collect();
        let folders: BTreeSet<PathBuf> = files.iter().filter_map(|f| f.parent().map(Path::to_path_buf)).collect();
        let shaders = shaders.map(real);
        let in_shaders = shaders.clone();
        let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else { return };
            if matches!(event.kind, EventKind::Access(_) | EventKind::Remove(_)) {
                return;
            }
            for path in &event.paths {
                let is_wgsl = path.extension().is_some_and(|e| e == "wgsl");
                let changed = if files.contains(path) {
                    Changed::Scene
                } else if is_wgsl && in_shaders.as_ref().is_some_and(|folder| path.starts_with(folder)) {
                    Changed::Shaders
                } else {
                    continue;
                };
                // The loop is gone only if the window was closed meanwhile.
                let _ = proxy.send_event(Wake::Changed(changed));
            }
        })?;
        for folder in folders {
            watcher.watch(&folder, RecursiveMode::NonRecursive)?;
        }
        if let Some(shaders) = &shaders {
            watcher.watch(shaders, RecursiveMode::Recursive)?;
        }
        Ok(Self { _watcher: watcher })
    }
}
