//! What actions do.

use crate::action::Action;
use crate::app::App;
use crate::camera::path::Motion;
use crate::document::Look;
use crate::opening::Wanted;
use crate::projection::Screen;
use crate::reload::Changed;
use crate::{library, screenshot};
use anyhow::Context;
use keyleaf::shading::Tint;
use keyleaf_shaders::reload as texts;
use std::io::Write;
use std::path::PathBuf;

/// What is done after the frame, since it needs its picture or ends the loop.
#[derive(Debug, Clone, PartialEq)]
pub enum Ask {
    /// A picture, of the window or of the scene alone.
    Picture(PathBuf, bool),
    /// Counts and times as JSON.
    Report(PathBuf),
    /// The triangles seen, as a model.
    Export(PathBuf),
    /// Loses the device, as a driver that crashes does.
    LoseDevice,
    /// The end.
    Quit,
}

impl App {
    /// Does what was asked for; what must wait until the frame is drawn is returned.
    pub(crate) fn perform(&mut self) -> Vec<Ask> {
        let mut asked = Vec::new();
        for action in std::mem::take(&mut self.viewer.actions) {
            match self.act(action) {
                Ok(ask) => asked.extend(ask),
                Err(error) => self.viewer.complain(format!("{error:#}")),
            }
        }
        asked
    }

    fn act(&mut self, action: Action) -> anyhow::Result<Option<Ask>> {
        match action {
            Action::Open(file) => self.open(Wanted::File(file, self.options.reading), false),
            Action::Reload => self.reopen(),
            Action::Rebuild(scene) => {
                let file = self.viewer.document.as_ref().map(|d| d.loaded.file.clone());
                let wanted = file.map(|file| Wanted::Scene(file, scene));
                wanted.into_iter().for_each(|wanted| self.open(wanted, true));
            }
            Action::Tune(scene) => {
                if let (Some(document), Some(shell)) = (&mut self.viewer.document, &self.shell) {
                    document.tune(&shell.gpu.headless, *scene, &mut self.pipelines)?;
                }
            }
            Action::Frame | Action::GoTo(_) | Action::SetMode(_) => self.move_camera(action),
            Action::Wireframe | Action::Tint(_) | Action::Overdraw => self.change_look(&action)?,
            Action::Freeze => {
                let view = self.viewer.view();
                if let Some(document) = &mut self.viewer.document {
                    document.set_frozen(if document.frozen.is_some() { None } else { Some(view) });
                }
            }
            Action::Minimap | Action::Panel | Action::Help | Action::Theme => self.switch_part(&action),
            Action::Pick(at) => self.pick(at)?,
            Action::Pivot(at) => self.set_pivot(at)?,
            Action::ChoosePath(_) | Action::Play | Action::Scrub(_) | Action::Record => return self.time_line(action),
            Action::CopyScene => self.copy_scene()?,
            Action::CopyCamera => self.copy_camera()?,
            Action::Screenshot { whole } => {
                return Ok(Some(Ask::Picture(screenshot::free_name(&self.name(), "png"), whole)));
            }
            Action::Export => return Ok(Some(Ask::Export(screenshot::free_name(&self.name(), "ply")))),
            Action::Quit => return Ok(Some(Ask::Quit)),
        }
        Ok(None)
    }

    fn name(&self) -> String {
        self.viewer
            .document
            .as_ref()
            .map_or_else(|| "window".to_owned(), |d| d.name())
    }

    fn reopen(&mut self) {
        let file = self.viewer.document.as_ref().map(|d| d.loaded.file.clone());
        if let Some(file) = file {
            self.open(Wanted::File(file, self.options.reading), true);
        }
    }

    fn move_camera(&mut self, action: Action) {
        let Some(document) = &self.viewer.document else { return };
        match action {
            Action::Frame => self.viewer.camera.frame(document.loaded.bounds),
            Action::GoTo(number) => {
                if let Some(camera) = document.loaded.scene.cameras.get(number) {
                    self.viewer.camera.go_to(camera);
                }
            }
            Action::SetMode(mode) => self.viewer.camera.mode = mode,
            _ => {}
        }
        self.viewer.let_go_of_path();
    }

    fn change_look(&mut self, action: &Action) -> anyhow::Result<()> {
        let (Some(document), Some(shell)) = (&mut self.viewer.document, &self.shell) else {
            return Ok(());
        };
        let look = document.look;
        let look = match *action {
            Action::Wireframe => Look {
                wireframe: !look.wireframe,
                ..look
            },
            Action::Overdraw => Look {
                overdraw: !look.overdraw,
                ..look
            },
            Action::Tint(tint) => Look {
                overdraw: false,
                tint: if look.tint == tint && !look.overdraw {
                    Tint::None
                } else {
                    tint
                },
                ..look
            },
            _ => look,
        };
        document.set_look(&shell.gpu.headless, look, &mut self.pipelines)
    }

    fn switch_part(&mut self, action: &Action) {
        let shown = &mut self.viewer.shown;
        let part = match action {
            Action::Minimap => &mut shown.minimap,
            Action::Panel => &mut shown.panel,
            Action::Help => &mut shown.help,
            _ => &mut shown.light,
        };
        *part = !*part;
        self.set_theme();
    }

    fn screen(&self) -> Screen {
        Screen {
            view: self.viewer.view(),
            rect: self.viewer.viewport,
        }
    }

    fn pick(&mut self, at: Option<egui::Pos2>) -> anyhow::Result<()> {
        let screen = self.screen();
        let (Some(document), Some(shell)) = (&self.viewer.document, &self.shell) else {
            return Ok(());
        };
        let gpu = &shell.gpu.headless;
        self.viewer.picked = match at {
            Some(at) => self.picker.pick(gpu, document, &screen, at)?,
            None => None,
        };
        Ok(())
    }

    fn set_pivot(&mut self, at: egui::Pos2) -> anyhow::Result<()> {
        let before = self.viewer.picked.take();
        self.pick(Some(at))?;
        let found = std::mem::replace(&mut self.viewer.picked, before);
        if let Some(found) = found {
            self.viewer.camera.pivot = found.position;
            self.viewer.camera.near = None;
            self.viewer.let_go_of_path();
        }
        Ok(())
    }

    fn time_line(&mut self, action: Action) -> anyhow::Result<Option<Ask>> {
        let viewer = &mut self.viewer;
        let path = viewer.path().cloned();
        match (action, path) {
            (Action::ChoosePath(number), _) => {
                viewer.timeline.chosen = number;
                viewer.timeline.time = 0.0;
                viewer.timeline.motion = Motion::Free;
            }
            (Action::Play, Some(path)) => match viewer.timeline.motion {
                Motion::Playing => viewer.timeline.motion = Motion::Paused,
                Motion::Recording => {}
                Motion::Free | Motion::Paused => viewer.timeline.play(&path),
            },
            (Action::Scrub(time), Some(path)) => {
                viewer.timeline.motion = Motion::Paused;
                viewer.timeline.time = time;
                viewer.timeline.place(&mut viewer.camera, &path);
            }
            (Action::Record, _) if viewer.timeline.motion == Motion::Recording => self.end_recording()?,
            (Action::Record, _) if viewer.document.is_some() => viewer.timeline.record(),
            _ => {}
        }
        Ok(None)
    }

    /// The path joins those of the scene, and a file in the current folder.
    fn end_recording(&mut self) -> anyhow::Result<()> {
        let name = self.name();
        let viewer = &mut self.viewer;
        let Some(document) = &mut viewer.document else {
            return Ok(());
        };
        let paths = &mut document.loaded.scene.paths;
        let names = paths.iter().map(|path| path.name.as_str());
        let Some(path) = viewer.timeline.finish(&viewer.camera, names) else {
            return Ok(());
        };
        let file = screenshot::free_name(&format!("{name}-path"), "ron");
        let text = path.to_ron()?;
        paths.push(path);
        viewer.timeline.chosen = paths.len() - 1;
        viewer.timeline.time = 0.0;
        if !self.is_scripted() {
            keyleaf_scene::write_whole(&file, |out| out.write_all(text.as_bytes()))
                .with_context(|| format!("{}: cannot be written", file.display()))?;
            self.viewer.say(format!("path saved as {}", file.display()));
        }
        Ok(())
    }

    fn copy_scene(&mut self) -> anyhow::Result<()> {
        let Some(document) = &self.viewer.document else {
            return Ok(());
        };
        self.context.copy_text(document.scene().to_ron()?);
        self.viewer.say("the scene is on the clipboard");
        Ok(())
    }

    fn copy_camera(&mut self) -> anyhow::Result<()> {
        let camera = &self.viewer.camera;
        let number = |x: f64| format!("{x:.6}").trim_end_matches('0').trim_end_matches('.').to_owned();
        let point = |p: glam::DVec3| p.to_array().map(number).join(", ");
        let (eye, look_at) = (point(camera.eye), point(camera.pivot));
        let text = format!(
            "(name: \"here\", eye: ({eye}), look_at: ({look_at}), fov: {}),",
            camera.fov
        );
        self.context.copy_text(text);
        self.viewer.say("the camera is on the clipboard");
        Ok(())
    }

    /// Takes up what has changed in files.
    pub(crate) fn take_up(&mut self, changed: Changed) {
        match changed {
            Changed::Scene => self.reopen(),
            Changed::Shaders => {
                if let Err(error) = self.reload_shaders() {
                    self.viewer.complain(format!("{error:#}"));
                }
            }
        }
    }

    /// Compiles what the checkout has now; what does not compile changes nothing.
    fn reload_shaders(&mut self) -> anyhow::Result<()> {
        let (Some(document), Some(shell)) = (&mut self.viewer.document, &self.shell) else {
            return Ok(());
        };
        let folder = library::shaders(Some(&document.loaded.file)).context("there is no folder of shaders")?;
        let now = texts::read(&folder).with_context(|| folder.display().to_string())?;
        let before = texts::replace(now);
        if let Err(error) = document.recompile(&shell.gpu.headless, &mut self.pipelines) {
            texts::replace(before);
            return Err(error.context("the shaders were changed and are refused; the last ones stay"));
        }
        self.picker = Default::default();
        self.viewer.minimap.touch();
        self.viewer.message = None;
        self.viewer.say("shaders compiled again");
        Ok(())
    }

    /// Does what needs the picture of the frame.
    pub(crate) fn ask(&mut self, ask: Ask) -> anyhow::Result<()> {
        let Some(shell) = &self.shell else { return Ok(()) };
        match ask {
            Ask::Picture(file, whole) => {
                let (pixels, size) = if whole {
                    shell.painter.read_window(&shell.gpu)?
                } else {
                    let canvas = shell
                        .painter
                        .canvas()
                        .context("there is no scene to take a picture of")?;
                    (canvas.read(&shell.gpu.headless)?, canvas.size())
                };
                screenshot::write(&file, &pixels, size)?;
                self.announce(format!("picture saved as {}", file.display()));
            }
            Ask::Report(file) => {
                let text = serde_json::to_string_pretty(&self.report())?;
                keyleaf_scene::write_whole(&file, |out| out.write_all(text.as_bytes()))
                    .with_context(|| format!("{}: cannot be written", file.display()))?;
            }
            Ask::Export(file) => {
                let document = self.viewer.document.as_ref().context("there is no scene to export")?;
                let triangles = document.export(&shell.gpu.headless, &file)?;
                self.announce(format!("{triangles} triangles saved as {}", file.display()));
            }
            Ask::LoseDevice => shell.gpu.headless.device.destroy(),
            Ask::Quit => {}
        }
        Ok(())
    }

    /// A script's pictures say nothing of themselves.
    fn announce(&mut self, text: String) {
        if !self.is_scripted() {
            self.viewer.say(text);
        }
    }

    /// What the panels show, for scripts.
    fn report(&self) -> serde_json::Value {
        let document = self.viewer.document.as_ref();
        let statistics = document.and_then(|d| d.statistics());
        let camera = &self.viewer.camera;
        serde_json::json!({
            "file": document.map(|d| d.name()),
            "leaves": statistics.map(|s| s.leaves),
            "visible": statistics.map(|s| s.visible),
            "triangles": statistics.map(|s| s.triangles),
            "starved": statistics.map(|s| s.starved),
            "lost": statistics.map(|s| s.lost),
            "settled": document.map(|d| d.is_settled()),
            "frozen": document.map(|d| d.frozen.is_some()),
            "levels": self.viewer.levels.counts,
            "eye": camera.eye.to_array(), "pivot": camera.pivot.to_array(),
            "picture": self.viewer.pixels.to_array(),
            "paths": document.map(|d| d.loaded.scene.paths.len()),
            "picked": self.viewer.picked.as_ref().map(|p| p.digits()),
            "message": self.viewer.message.as_ref().map(|m| &m.text),
            "timestamps": self.viewer.costs.samples.back().is_some_and(|s| s.device.is_some()),
            "frames": self.frames,
            "first_frame_ms": self.first_frame.map(|d| d.as_secs_f64() * 1e3),
            "refused": self.refused,
        })
    }
}
