//! Scripts: steps that drive the viewer as a person would, fed into the handler of real window events.
//!
//! A script is a RON list, for instance
//!
//! ```ron
//! [
//!     Settle,
//!     Drag(from: (0.5, 0.5), to: (0.7, 0.4)),
//!     Key("2"),
//!     Settle,
//!     Screenshot("levels.png"),
//!     Quit,
//! ]
//! ```
//!
//! Places are parts of the rectangle in which the scene is shown, (0, 0) above on the left. Files are relative to the current folder.
//! Every frame of a script takes a thirtieth of a second, whatever the machine.

mod events;

use crate::camera::path::Motion;
use crate::perform::Ask;
use crate::viewer::Viewer;
use anyhow::Context;
use egui_winit::winit::event::WindowEvent;
use egui_winit::winit::window::Window;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

/// A step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Step {
    /// Wait until files are opened, paths have ended and nothing changes any more.
    Settle,
    /// Wait for so many frames.
    Frames(u32),
    /// Move the pointer with a button held.
    Drag {
        /// Where it is pressed.
        from: (f32, f32),
        /// Where it is let go.
        to: (f32, f32),
        /// Which.
        #[serde(default)]
        button: Button,
        /// In so many moves.
        #[serde(default = "moves")]
        moves: u32,
    },
    /// Move the pointer.
    Move(f32, f32),
    /// Click.
    Click(f32, f32),
    /// Click twice.
    DoubleClick(f32, f32),
    /// Click at a place of the window, in points.
    ClickWindow(f32, f32),
    /// Turn the wheel by notches at the middle; up is positive.
    Wheel(f32),
    /// Press and let go of a key, such as `F`, `2`, `Space`, `Shift+P`.
    Key(String),
    /// Hold a key for so many frames.
    Hold(String, u32),
    /// Drop a file on the window.
    Drop(PathBuf),
    /// Change the size of the window, in pixels.
    Resize(u32, u32),
    /// Hide the window, or show it again.
    Occlude(bool),
    /// A picture of the window.
    Screenshot(PathBuf),
    /// A picture of the scene alone.
    Picture(PathBuf),
    /// Counts and camera as JSON.
    Report(PathBuf),
    /// The triangles seen, as a model.
    Export(PathBuf),
    /// Lose the device.
    LoseDevice,
    /// The end. Fails if the device has refused anything.
    Quit,
}

fn moves() -> u32 {
    8
}

/// A button of the pointer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Button {
    /// The left one.
    #[default]
    Left,
    /// The right one.
    Right,
}

/// What a step does in a frame.
pub enum Input {
    /// An event of the window.
    Event(WindowEvent),
    /// An event that the window system does not let programs make: of keys.
    Interface(egui::Event),
    /// Something that has no event.
    Ask(Ask),
    /// The step failed.
    Fail(String),
    /// The end.
    Quit,
}

/// Frames after which a step that waits has failed.
const PATIENCE: u32 = 6000;

/// A script that runs.
pub struct Script {
    steps: VecDeque<Step>,
    /// What is left of the present step, frame by frame.
    frames: VecDeque<Vec<Input>>,
    waited: u32,
    /// The size that was asked for.
    resizing: Option<[u32; 2]>,
}

impl Script {
    /// Reads a script.
    ///
    /// # Errors
    /// It cannot be read, or is no list of steps; the message has file, line and column.
    pub fn read(file: &Path) -> anyhow::Result<Self> {
        let text = std::fs::read_to_string(file).with_context(|| file.display().to_string())?;
        let steps: Vec<Step> = ron::from_str(&text).map_err(|error| anyhow::anyhow!("{}:{error}", file.display()))?;
        Ok(Self::new(steps))
    }

    /// Takes a picture of the window and ends.
    pub fn of_screenshot(picture: &Path, frames: Option<u32>) -> Self {
        let mut steps = vec![frames.map_or(Step::Settle, Step::Frames)];
        steps.extend([Step::Screenshot(picture.to_path_buf()), Step::Quit]);
        Self::new(steps)
    }

    fn new(steps: Vec<Step>) -> Self {
        Self {
            steps: steps.into(),
            frames: VecDeque::new(),
            waited: 0,
            resizing: None,
        }
    }

    /// What happens before the next frame.
    pub fn next(&mut self, viewer: &Viewer, window: Option<&Window>) -> Vec<Input> {
        if let Some(frame) = self.frames.pop_front() {
            return frame;
        }
        if self.must_wait(viewer, window) {
            self.waited += 1;
            if self.waited > PATIENCE {
                let text = format!(
                    "the script waited for {PATIENCE} frames in vain, before {:?}",
                    self.steps.front()
                );
                return vec![Input::Fail(text)];
            }
            return Vec::new();
        }
        self.waited = 0;
        let Some(step) = self.steps.pop_front() else {
            return vec![Input::Quit];
        };
        match self.expand(&step, viewer, window) {
            Ok(frames) => self.frames = frames.into(),
            Err(text) => return vec![Input::Fail(format!("{step:?}: {text}"))],
        }
        self.frames.pop_front().unwrap_or_default()
    }

    fn must_wait(&self, viewer: &Viewer, window: Option<&Window>) -> bool {
        if let (Some(wanted), Some(window)) = (self.resizing, window) {
            let size = window.inner_size();
            if [size.width, size.height] != wanted {
                return true;
            }
        }
        // What opens is never drawn half.
        if viewer.opening.is_some() {
            return true;
        }
        let is_moving = viewer.timeline.motion == Motion::Playing;
        self.steps.front() == Some(&Step::Settle) && (is_moving || viewer.is_busy() || viewer.costs_are_late())
    }

    fn expand(&mut self, step: &Step, viewer: &Viewer, window: Option<&Window>) -> Result<Vec<Vec<Input>>, String> {
        let scale = window.map_or(1.0, Window::scale_factor);
        let place = |x: f32, y: f32| {
            let rect = viewer.viewport;
            events::Place::new(rect.lerp_inside(egui::vec2(x, y)), scale)
        };
        Ok(match step {
            // Two frames more, so that panels show what has settled.
            Step::Settle => vec![Vec::new(), Vec::new()],
            Step::Frames(count) => (0..*count).map(|_| Vec::new()).collect(),
            Step::Drag {
                from,
                to,
                button,
                moves,
            } => events::drag(place(from.0, from.1), place(to.0, to.1), *button, (*moves).max(1)),
            Step::Move(x, y) => vec![events::at(place(*x, *y))],
            Step::Click(x, y) => events::click(place(*x, *y)),
            Step::DoubleClick(x, y) => {
                let mut frames = events::click(place(*x, *y));
                frames.extend(events::click(place(*x, *y)));
                frames
            }
            Step::ClickWindow(x, y) => events::click(events::Place::new(egui::pos2(*x, *y), scale)),
            Step::Wheel(notches) => events::wheel(place(0.5, 0.5), *notches),
            Step::Key(key) => events::key(key, 0)?,
            Step::Hold(key, frames) => events::key(key, *frames)?,
            Step::Drop(file) => vec![vec![Input::Event(WindowEvent::DroppedFile(file.clone()))]],
            Step::Resize(width, height) => {
                self.resizing = Some([*width, *height]);
                let size = egui_winit::winit::dpi::PhysicalSize::new(*width, *height);
                if let Some(window) = window
                    && let Some(now) = window.request_inner_size(size)
                {
                    return Ok(vec![vec![Input::Event(WindowEvent::Resized(now))]]);
                }
                vec![Vec::new()]
            }
            Step::Occlude(hidden) => vec![vec![Input::Event(WindowEvent::Occluded(*hidden))]],
            Step::Screenshot(file) => vec![vec![Input::Ask(Ask::Picture(file.clone(), true))]],
            Step::Picture(file) => vec![vec![Input::Ask(Ask::Picture(file.clone(), false))]],
            Step::Report(file) => vec![vec![Input::Ask(Ask::Report(file.clone()))]],
            Step::Export(file) => vec![vec![Input::Ask(Ask::Export(file.clone()))]],
            Step::LoseDevice => vec![vec![Input::Ask(Ask::LoseDevice)]],
            Step::Quit => vec![vec![Input::Quit]],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_have_defaults_and_errors_a_place() {
        let steps: Vec<Step> = ron::from_str("[Settle, Drag(from: (0.5, 0.5), to: (0.7, 0.4)), Key(\"F\")]").unwrap();
        assert_eq!(steps.len(), 3);
        let file = std::env::temp_dir().join(format!("keyleaf-script-{}.ron", std::process::id()));
        std::fs::write(&file, "[Settle,\n Jump]").unwrap();
        let error = Script::read(&file)
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default();
        assert!(error.contains(":2:"), "{error}");
        std::fs::remove_file(file).unwrap();
    }
}
