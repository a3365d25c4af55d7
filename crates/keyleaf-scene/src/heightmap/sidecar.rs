//! The optional JSON file beside a height map, `NAME.json` for `NAME.png`: where its voids are and how far apart its
//! samples are. Fields that are not known are ignored.

use std::path::Path;

use glam::DVec2;
use serde::Deserialize;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;

/// Metres of one arc second of latitude: the mean meridian, 40,007.86 km / (360 · 3600).
const METRES_PER_ARCSEC: f64 = 30.87;

/// What a sidecar may say.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Sidecar {
    /// Name of the tile by its south-west corner, such as `N46E008`.
    pub tile: Option<String>,
    /// Distance of samples in arc seconds, in both directions.
    pub spacing_arcsec: Option<f64>,
    /// Rows and columns of the voids, row 0 at the top. If the list is complete, no other sample is taken for a void but
    /// those that are not numbers or equal to an explicit void value.
    pub voids: Option<Vec<[usize; 2]>>,
    /// How many voids there are, if the list has only some of them.
    pub n_void: Option<usize>,
}

impl Sidecar {
    /// Reads the sidecar of a height map; `None` if there is none.
    pub fn read_beside(map: &Path) -> Result<Option<Self>, ImportError> {
        let file = map.with_extension("json");
        let text = match std::fs::read(&file) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(ImportError::Read { file, source }),
        };
        let sidecar: Self = serde_json::from_slice(&text).map_err(|error| {
            let reason = format!("not the sidecar of a height map: {error}");
            ImportError::malformed(&file, FilePlace::Line(error.line()), reason)
        })?;
        if sidecar.spacing_arcsec.is_some_and(|s| !(s > 0.0 && s.is_finite())) {
            let reason = "spacing_arcsec must be a positive number";
            return Err(ImportError::malformed(&file, FilePlace::Whole, reason));
        }
        Ok(Some(sidecar))
    }

    /// Spacing in metres, east and north. The latitude is that of the middle of a one-degree tile, by the name that
    /// the sidecar or the file begins with; without one the equator's, with a note.
    pub(super) fn spacing(&self, map: &Path, notes: &mut Vec<Note>) -> Option<DVec2> {
        let north = self.spacing_arcsec? * METRES_PER_ARCSEC;
        let stem = map
            .file_stem()
            .map(|s| s.to_string_lossy().into_owned())
            .unwrap_or_default();
        let south = self.tile.as_deref().and_then(latitude).or_else(|| latitude(&stem));
        if south.is_none() {
            let text = "no tile name such as N46E008 tells the latitude: east-west distances are the equator's";
            notes.push(Note::remark(map, text));
        }
        let middle = south.map_or(0.0, |s| s + 0.5);
        Some(DVec2::new(north * middle.to_radians().cos(), north))
    }
}

/// Latitude of the south edge, in degrees, from a name that begins with `NxxEyyy`.
fn latitude(name: &str) -> Option<f64> {
    let sign = match name.get(..1)? {
        "N" | "n" => 1.0,
        "S" | "s" => -1.0,
        _ => return None,
    };
    if !matches!(name.get(3..4)?, "E" | "e" | "W" | "w") {
        return None;
    }
    name.get(4..7)?.parse::<u16>().ok()?;
    Some(sign * f64::from(name.get(1..3)?.parse::<u8>().ok().filter(|&d| d <= 90)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tile_names_give_latitudes() {
        assert_eq!(latitude("N46E008_1201"), Some(46.0));
        assert_eq!(latitude("s09w072"), Some(-9.0));
        for name in ["", "N4", "N46", "NxxEyyy", "north", "N46E0", "Ñ46E008", "N99E000"] {
            assert_eq!(latitude(name), None, "{name}");
        }
    }

    #[test]
    fn spacing_shrinks_with_the_cosine_of_the_latitude() {
        let sidecar = Sidecar {
            spacing_arcsec: Some(3.0),
            ..Sidecar::default()
        };
        let spacing = sidecar.spacing(Path::new("N60E010.png"), &mut Vec::new()).unwrap();
        assert!((spacing.y - 92.61).abs() < 1e-9);
        assert!((spacing.x / spacing.y - 60.5f64.to_radians().cos()).abs() < 1e-12);
        let mut notes = Vec::new();
        assert_eq!(sidecar.spacing(Path::new("map.png"), &mut notes).unwrap().x, spacing.y);
        assert_eq!(notes.len(), 1);
    }
}
