//! The state of the viewer: everything but window and device.

use crate::action::Action;
use crate::camera::Camera;
use crate::camera::path::{Motion, TimeLine};
use crate::costs::Costs;
use crate::document::Document;
use crate::levels::Levels;
use crate::minimap::Minimap;
use crate::panels::strip::Strip;
use crate::picking::Picked;
use crate::remembered::Shown;
use egui::Rect;
use glam::UVec2;
use keyleaf::View;
use keyleaf_scene::scene::CameraPath;
use std::path::PathBuf;

/// What is said to the person, over the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// The text.
    pub text: String,
    /// Whether something failed: it stays until it is closed, or mended.
    pub is_error: bool,
    /// Seconds since the start at which it goes away by itself.
    pub until: f64,
}

/// The state of the viewer.
pub struct Viewer {
    /// The scene that is open.
    pub document: Option<Document>,
    /// The file that is being opened.
    pub opening: Option<PathBuf>,
    /// What is said.
    pub message: Option<Message>,
    /// The camera.
    pub camera: Camera,
    /// The camera paths.
    pub timeline: TimeLine,
    /// What is visible of the window's parts.
    pub shown: Shown,
    /// What the last frames cost.
    pub costs: Costs,
    /// The map.
    pub minimap: Minimap,
    /// Leaves by level.
    pub levels: Levels,
    /// Accuracy against time.
    pub strip: Strip,
    /// The leaf that was picked.
    pub picked: Option<Picked>,
    /// Scenes that are shipped.
    pub library: Vec<PathBuf>,
    /// The picture of the scene, for the interface.
    pub picture: Option<egui::TextureId>,
    /// Where the scene is shown, in points.
    pub viewport: Rect,
    /// The size of its picture, in pixels.
    pub pixels: UVec2,
    /// What was asked for and is not done yet.
    pub actions: Vec<Action>,
    /// Seconds since the start.
    pub time: f64,
    /// About the device, for the panel.
    pub device: DeviceText,
    /// Whether the camera moves by itself or by held keys.
    pub is_moving: bool,
}

/// What the panel says of the device.
#[derive(Debug, Clone, Default)]
pub struct DeviceText {
    /// Name of the adapter.
    pub name: String,
    /// Driver and API.
    pub driver: String,
    /// How frames wait for the screen.
    pub present: String,
    /// Whether it computes on the CPU: its times are not GPU times.
    pub is_software: bool,
}

impl Viewer {
    /// A viewer without a scene.
    pub fn new(shown: Shown, library: Vec<PathBuf>) -> Self {
        Self {
            document: None,
            opening: None,
            message: None,
            camera: Camera::default(),
            timeline: TimeLine::default(),
            shown,
            costs: Costs::default(),
            minimap: Minimap::default(),
            levels: Levels::default(),
            strip: Strip::default(),
            picked: None,
            library,
            picture: None,
            viewport: Rect::NOTHING,
            pixels: UVec2::ONE,
            actions: Vec::new(),
            time: 0.0,
            device: DeviceText::default(),
            is_moving: false,
        }
    }

    /// What the camera sees.
    pub fn view(&self) -> View {
        self.camera.view(self.pixels)
    }

    /// The path that is chosen.
    pub fn path(&self) -> Option<&CameraPath> {
        self.document.as_ref()?.loaded.scene.paths.get(self.timeline.chosen)
    }

    /// Says something for a while.
    pub fn say(&mut self, text: impl Into<String>) {
        // What failed stays until it is read.
        if self.message.as_ref().is_some_and(|m| m.is_error) {
            return;
        }
        self.message = Some(Message {
            text: text.into(),
            is_error: false,
            until: self.time + 4.0,
        });
    }

    /// Says that something failed, until it is closed or mended.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            is_error: true,
            until: f64::INFINITY,
        });
    }

    /// Begins a frame: the time goes on, and with it what moves by itself.
    pub fn advance(&mut self, seconds: f64) {
        self.time += seconds;
        if self.message.as_ref().is_some_and(|m| m.until <= self.time) {
            self.message = None;
        }
        let path = self
            .document
            .as_ref()
            .and_then(|d| d.loaded.scene.paths.get(self.timeline.chosen));
        self.timeline.advance(&mut self.camera, path, seconds);
        self.is_moving = matches!(self.timeline.motion, Motion::Playing | Motion::Recording);
    }

    /// Whether figures of frames that were drawn are still on their way.
    pub fn costs_are_late(&self) -> bool {
        self.costs.is_waiting()
            || self
                .document
                .as_ref()
                .is_some_and(|d| d.probe.as_ref().is_some_and(|p| p.is_waiting()))
    }

    /// The person has taken the camera: a path that runs, or stands, ends.
    pub fn let_go_of_path(&mut self) {
        if matches!(self.timeline.motion, Motion::Playing | Motion::Paused) {
            self.timeline.motion = Motion::Free;
        }
    }

    /// Whether another frame is needed, though nobody touched anything.
    pub fn is_busy(&self) -> bool {
        let view = self.view();
        self.is_moving
            || self.costs_are_late()
            || self.document.as_ref().is_some_and(|d| d.needs_frame(&view))
            || (self.shown.minimap && self.minimap.is_behind())
    }
}
