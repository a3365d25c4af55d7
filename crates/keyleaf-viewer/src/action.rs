//! What a person can ask for, and the keys that ask for it.

use crate::camera::Mode;
use egui::{Key, Modifiers, Pos2};
use keyleaf::shading::Tint;
use keyleaf_scene::Scene;
use std::path::PathBuf;

/// Something to do. Buttons, keys and scripts ask for the same ones.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Open a scene, a model or a height map.
    Open(PathBuf),
    /// Open the present file again.
    Reload,
    /// See all of the content.
    Frame,
    /// Go to a camera of the scene, by its number.
    GoTo(usize),
    /// Orbit or fly.
    SetMode(Mode),
    /// Edges of the triangles, or not.
    Wireframe,
    /// Tint by this, or, if it is there already, by nothing.
    Tint(Tint),
    /// How often each pixel is drawn, or the picture.
    Overdraw,
    /// Stop refining, or go on.
    Freeze,
    /// The map, or not.
    Minimap,
    /// The panel of figures and settings, or not.
    Panel,
    /// The list of keys, or not.
    Help,
    /// Dark or light.
    Theme,
    /// A picture of the window, or of the scene alone.
    Screenshot {
        /// With the panels.
        whole: bool,
    },
    /// Say what leaf is at a place of the window, or pick nothing.
    Pick(Option<Pos2>),
    /// Turn about the surface at a place of the window.
    Pivot(Pos2),
    /// Choose a camera path, by its number.
    ChoosePath(usize),
    /// Play or pause the path.
    Play,
    /// Go to a time on the path, in seconds.
    Scrub(f64),
    /// Record a path, or end the recording and save it.
    Record,
    /// Take over settings, light and effects of a changed scene.
    Tune(Box<Scene>),
    /// Make the surfaces of a changed scene anew.
    Rebuild(Box<Scene>),
    /// Put the scene as it is now on the clipboard.
    CopyScene,
    /// Put the present camera on the clipboard, as a scene has it.
    CopyCamera,
    /// Write the triangles that are seen.
    Export,
    /// Close the viewer.
    Quit,
}

/// A key, what it does, and the words for it.
pub struct Shortcut {
    /// The key.
    pub key: Key,
    /// Held with it.
    pub modifiers: Modifiers,
    /// What it does.
    pub action: fn() -> Action,
    /// The key, as the list of keys has it.
    pub label: &'static str,
    /// What it does, in words.
    pub what: &'static str,
}

const fn plain(key: Key, label: &'static str, what: &'static str, action: fn() -> Action) -> Shortcut {
    Shortcut {
        key,
        modifiers: Modifiers::NONE,
        action,
        label,
        what,
    }
}

/// All keys that do something at once; those of the flight are held.
pub const SHORTCUTS: &[Shortcut] = &[
    plain(Key::F, "F", "frame the content", || Action::Frame),
    plain(Key::O, "O", "orbit", || Action::SetMode(Mode::Orbit)),
    plain(Key::G, "G", "fly", || Action::SetMode(Mode::Fly)),
    plain(Key::Num1, "1", "wireframe", || Action::Wireframe),
    plain(Key::Num2, "2", "levels", || Action::Tint(Tint::Level)),
    plain(Key::Num3, "3", "pairs in red", || Action::Tint(Tint::Pairs)),
    plain(Key::Num4, "4", "change zones", || Action::Tint(Tint::Wish)),
    plain(Key::Num5, "5", "normals", || Action::Tint(Tint::Normal)),
    plain(Key::Num6, "6", "error in pixels", || Action::Tint(Tint::Error)),
    plain(Key::Num7, "7", "overdraw", || Action::Overdraw),
    plain(Key::Num8, "8", "morph zones", || Action::Tint(Tint::Morph)),
    plain(Key::Num0, "0", "plain surface", || Action::Tint(Tint::None)),
    plain(Key::Z, "Z", "freeze the quadtree", || Action::Freeze),
    plain(Key::M, "M", "minimap", || Action::Minimap),
    plain(Key::I, "I", "figures and settings", || Action::Panel),
    plain(Key::Space, "Space", "play or pause the path", || Action::Play),
    plain(Key::R, "R", "record a path, end and save it", || Action::Record),
    plain(Key::P, "P", "picture of the window", || Action::Screenshot {
        whole: true,
    }),
    Shortcut {
        key: Key::P,
        modifiers: Modifiers::SHIFT,
        action: || Action::Screenshot { whole: false },
        label: "Shift P",
        what: "picture of the scene alone",
    },
    plain(Key::X, "X", "export the triangles seen", || Action::Export),
    plain(Key::F5, "F5", "open the file again", || Action::Reload),
    plain(Key::T, "T", "dark or light", || Action::Theme),
    plain(Key::Escape, "Esc", "let go of the picked leaf", || Action::Pick(None)),
    plain(Key::Questionmark, "?", "this list", || Action::Help),
    plain(Key::F1, "F1", "this list", || Action::Help),
    Shortcut {
        key: Key::Q,
        modifiers: Modifiers::COMMAND,
        action: || Action::Quit,
        label: "Ctrl Q",
        what: "quit",
    },
];

/// What the pointer does, and the keys that are held: (input, what).
pub const GESTURES: &[(&str, &str)] = &[
    ("drag", "turn"),
    ("right or Shift drag", "move sideways"),
    ("wheel, pinch", "nearer; in flight, faster"),
    ("click", "say what leaf this is"),
    ("double click", "turn about this point"),
    ("W A S D", "fly"),
    ("E  Q", "fly up, down"),
    ("Shift", "fly faster"),
    ("drop a file", "open it"),
];

/// What was asked for by keys in this frame.
pub fn pressed(context: &egui::Context) -> Vec<Action> {
    if context.text_edit_focused() {
        return Vec::new();
    }
    context.input_mut(|input| {
        let mut actions = Vec::new();
        for event in &input.raw.events {
            let egui::Event::Key {
                key,
                pressed: true,
                repeat: false,
                modifiers,
                ..
            } = event
            else {
                continue;
            };
            // A question mark is typed with Shift on most keyboards.
            let plain = |s: &&Shortcut| s.key == *key && modifiers.matches_logically(s.modifiers);
            let typed = |s: &&Shortcut| s.key == Key::Questionmark && *key == Key::Questionmark;
            let slash = |s: &&Shortcut| s.key == Key::Questionmark && *key == Key::Slash && modifiers.shift;
            let most_specific = SHORTCUTS
                .iter()
                .filter(|s| plain(s) || typed(s) || slash(s))
                .filter(|s| s.modifiers.shift == modifiers.shift || s.key == Key::Questionmark)
                .max_by_key(|s| s.modifiers != Modifiers::NONE);
            actions.extend(most_specific.map(|s| (s.action)()));
        }
        actions
    })
}
