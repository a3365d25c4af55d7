//! What the viewer remembers from one start to the next: the window, and what is shown of its parts.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What is shown of the window's parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shown {
    /// Figures and settings.
    pub panel: bool,
    /// The map.
    pub minimap: bool,
    /// The time line.
    pub timeline: bool,
    /// The list of keys.
    #[serde(skip)]
    pub help: bool,
    /// Light instead of dark.
    pub light: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            panel: true,
            minimap: true,
            timeline: true,
            help: false,
            light: false,
        }
    }
}

/// What is remembered.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    /// Width and height of the window, in points.
    pub size: Option<[f64; 2]>,
    /// Where it stood, in pixels.
    pub position: Option<[i32; 2]>,
    /// Whether it filled the screen.
    pub maximised: bool,
    /// What was shown of its parts.
    pub shown: Shown,
}

/// The file: in the folder where programs keep their state.
fn file() -> Option<PathBuf> {
    let set = |name: &str| {
        std::env::var_os(name)
            .filter(|value| !value.is_empty())
            .map(PathBuf::from)
    };
    let home = || set("HOME").or_else(|| set("USERPROFILE"));
    let folder = set("XDG_STATE_HOME")
        .or_else(|| set("LOCALAPPDATA"))
        .or_else(|| home().map(|home| home.join(".local/state")))?;
    Some(folder.join("keyleaf").join("viewer.ron"))
}

impl Remembered {
    /// What was remembered; the defaults if that is nothing or cannot be read.
    pub fn load() -> Self {
        let text = file().and_then(|file| std::fs::read_to_string(file).ok());
        text.and_then(|text| ron::from_str(&text).ok()).unwrap_or_default()
    }

    /// Remembers this, as far as the file can be written.
    pub fn save(&self) {
        let Some(file) = file() else { return };
        let Ok(text) = ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::new()) else {
            return;
        };
        if file
            .parent()
            .is_some_and(|folder| std::fs::create_dir_all(folder).is_ok())
        {
            // Not being remembered is no reason to complain.
            let _ = keyleaf_scene::write_whole(&file, |out| std::io::Write::write_all(out, text.as_bytes()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_remembered_is_read_back_and_fields_may_lack() {
        let all = Remembered {
            size: Some([900.0, 600.0]),
            maximised: true,
            ..Remembered::default()
        };
        let text = ron::to_string(&all).unwrap();
        assert_eq!(ron::from_str::<Remembered>(&text).unwrap(), all);
        assert_eq!(ron::from_str::<Remembered>("()").unwrap(), Remembered::default());
    }
}
