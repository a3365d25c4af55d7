//! The events of a person's hands.

use super::{Button, Input};
use egui::{Event, Key, Modifiers, Pos2};
use egui_winit::winit::dpi::PhysicalPosition;
use egui_winit::winit::event::{DeviceId, ElementState, MouseButton, MouseScrollDelta, TouchPhase, WindowEvent};

/// A place of the window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pixels: PhysicalPosition<f64>,
}

impl Place {
    /// From points.
    pub fn new(at: Pos2, scale: f64) -> Self {
        Self {
            pixels: PhysicalPosition::new(f64::from(at.x) * scale, f64::from(at.y) * scale),
        }
    }

    fn towards(self, to: Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * part;
        Self {
            pixels: PhysicalPosition::new(mix(self.pixels.x, to.pixels.x), mix(self.pixels.y, to.pixels.y)),
        }
    }
}

/// The pointer comes here.
pub(super) fn at(place: Place) -> Vec<Input> {
    vec![Input::Event(WindowEvent::CursorMoved {
        device_id: DeviceId::dummy(),
        position: place.pixels,
    })]
}

fn press(button: Button, state: ElementState) -> Input {
    Input::Event(WindowEvent::MouseInput {
        device_id: DeviceId::dummy(),
        state,
        button: match button {
            Button::Left => MouseButton::Left,
            Button::Right => MouseButton::Right,
        },
    })
}

/// A drag, a move a frame.
pub(super) fn drag(from: Place, to: Place, button: Button, moves: u32) -> Vec<Vec<Input>> {
    let mut frames = vec![at(from), vec![press(button, ElementState::Pressed)]];
    frames.extend((1..=moves).map(|i| at(from.towards(to, f64::from(i) / f64::from(moves)))));
    frames.push(vec![press(button, ElementState::Released)]);
    frames.push(Vec::new());
    frames
}

/// A click.
pub(super) fn click(place: Place) -> Vec<Vec<Input>> {
    vec![
        at(place),
        vec![press(Button::Left, ElementState::Pressed)],
        vec![press(Button::Left, ElementState::Released)],
    ]
}

/// Notches of the wheel, one a frame; the interface smooths them over some frames more.
pub(super) fn wheel(place: Place, notches: f32) -> Vec<Vec<Input>> {
    let mut frames = vec![at(place)];
    let event = |y: f32| {
        vec![Input::Event(WindowEvent::MouseWheel {
            device_id: DeviceId::dummy(),
            delta: MouseScrollDelta::LineDelta(0.0, y),
            phase: TouchPhase::Moved,
        })]
    };
    let whole = notches.abs().ceil().max(1.0);
    frames.extend((0..whole as u32).map(|_| event(notches / whole)));
    frames.extend((0..12).map(|_| Vec::new()));
    frames
}

/// A key that is held for some frames, with its modifiers.
pub(super) fn key(name: &str, frames: u32) -> Result<Vec<Vec<Input>>, String> {
    let (modifiers, name) = match name.split_once('+') {
        Some(("Shift", key)) => (Modifiers::SHIFT, key),
        Some(("Ctrl", key)) => (Modifiers::CTRL | Modifiers::COMMAND, key),
        Some((other, _)) => return Err(format!("unknown modifier '{other}'; expected Shift or Ctrl")),
        None => (Modifiers::NONE, name),
    };
    let key = Key::from_name(name).ok_or_else(|| format!("unknown key '{name}'"))?;
    let event = |pressed| {
        vec![Input::Interface(Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        })]
    };
    let mut all = vec![event(true)];
    all.extend((0..frames).map(|_| Vec::new()));
    all.extend([event(false), Vec::new()]);
    Ok(all)
}
