//! What is done with files: opened aside, shown when they are there, watched.

use crate::app::App;
use crate::document::Document;
use crate::library;
use crate::opening::{self, Opened, Wanted};
use crate::reload::Watch;
use keyleaf_scene::scene::CameraPath;
use std::path::PathBuf;

impl App {
    /// Opens something beside the loop; a camera path joins those of the scene that is open.
    pub(crate) fn open(&mut self, wanted: Wanted, is_again: bool) {
        if let (Wanted::File(file, _), Some(document)) = (&wanted, &mut self.viewer.document)
            && file.extension().is_some_and(|e| e == "ron")
            && let Ok(text) = std::fs::read_to_string(file)
            && let Ok(path) = CameraPath::from_ron(&text, file)
        {
            let paths = &mut document.loaded.scene.paths;
            paths.retain(|other| other.name != path.name);
            paths.push(path);
            self.viewer.timeline = Default::default();
            self.viewer.timeline.chosen = paths.len() - 1;
            return;
        }
        let file = match &wanted {
            Wanted::File(file, _) | Wanted::Scene(file, _) => file.clone(),
        };
        self.request += 1;
        self.viewer.opening = Some(file);
        opening::open(wanted, is_again, self.request, self.proxy.clone());
    }

    /// A file was opened: shows it, or says why not and keeps the last scene.
    pub(crate) fn opened(&mut self, opened: Opened) {
        if opened.number != self.request {
            return;
        }
        self.viewer.opening = None;
        let shell = match &self.shell {
            Some(shell) => shell,
            None => return,
        };
        let gpu = &shell.gpu.headless;
        let made = opened
            .result
            .map_err(anyhow::Error::msg)
            .and_then(|loaded| Document::new(gpu, loaded, &mut self.pipelines));
        // A file that is mended is opened again.
        let files = match &made {
            Ok(document) => std::iter::once(opened.file.clone())
                .chain(document.loaded.files.clone())
                .collect(),
            Err(_) => vec![opened.file.clone()],
        };
        match made {
            Ok(document) => self.show(document, opened.is_again),
            Err(error) => {
                eprintln!("error: {error:#}");
                self.viewer.complain(format!("{error:#}"));
            }
        }
        if !self.is_scripted() {
            self.watch_files(files);
        }
    }

    fn watch_files(&mut self, mut files: Vec<PathBuf>) {
        // The scene that is still shown may be mended too.
        files.extend(self.viewer.document.iter().map(|d| d.loaded.file.clone()));
        let shaders = library::shaders(files.first().map(PathBuf::as_path));
        self.watch = Watch::new(&files, shaders.as_deref(), self.proxy.clone()).ok();
    }

    fn show(&mut self, mut document: Document, is_again: bool) {
        let viewer = &mut self.viewer;
        for note in &document.loaded.notes {
            eprintln!("{note}");
        }
        if is_again {
            if let (Some(before), Some(shell)) = (&viewer.document, &self.shell) {
                // What the scene says itself was seen before, too.
                let _ = document.set_look(&shell.gpu.headless, before.look, &mut self.pipelines);
            }
        } else {
            let wanted = self.options.camera.take();
            match document.loaded.camera(wanted.as_deref()) {
                Ok(camera) => viewer.camera.go_to(camera),
                Err(error) => viewer.complain(error.to_string()),
            }
            viewer.timeline = Default::default();
            viewer.costs.samples.clear();
            viewer.strip.points.clear();
        }
        viewer.picked = None;
        viewer.levels.forget();
        viewer.costs.forget_device();
        viewer.minimap.touch();
        if viewer.message.as_ref().is_some_and(|m| m.is_error) {
            viewer.message = None;
        }
        if let Some(shell) = &self.shell {
            shell.window.set_title(&format!("{} – keyleaf", document.name()));
        }
        viewer.document = Some(document);
    }
}
