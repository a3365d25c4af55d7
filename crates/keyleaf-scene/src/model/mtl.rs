//! Wavefront material libraries: the base colour `Kd`, the opacity `d`, and the picture `map_Kd`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::texture::ColourTexture;

/// Options of `map_Kd` and how many words follow each; `-o`, `-s` and `-t` take one to three numbers.
const OPTIONS: [(&str, usize); 12] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-boost", 1),
    ("-bm", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-texres", 1),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
];

/// Reads all libraries that a model names, relative to its folder. What is missing or unreadable is a note: the
/// shape of the model does not depend on it.
pub(super) fn read_libraries(
    model: &Path,
    libraries: &[PathBuf],
    notes: &mut Vec<Note>,
) -> HashMap<String, SurfaceMaterial> {
    let folder = model.parent().unwrap_or(Path::new(""));
    let mut materials = HashMap::new();
    for library in libraries {
        let file = folder.join(library);
        match std::fs::read(&file) {
            Ok(bytes) => read(&file, &String::from_utf8_lossy(&bytes), &mut materials, notes),
            Err(error) => {
                let text = format!("material library {} cannot be read: {error}", file.display());
                notes.push(Note::warning(model, text));
            }
        }
    }
    materials
}

fn read(file: &Path, text: &str, materials: &mut HashMap<String, SurfaceMaterial>, notes: &mut Vec<Note>) {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut name = String::new();
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or("").trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        if keyword == "newmtl" {
            name = rest.to_owned();
            materials.insert(name.clone(), SurfaceMaterial::default());
        }
        let Some(material) = materials.get_mut(&name) else {
            continue;
        };
        match keyword {
            "Kd" => {
                let values: Vec<f32> = rest.split_whitespace().map_while(|w| w.parse().ok()).collect();
                // `Kd r` alone means grey.
                let channel = |i: usize| values.get(i).or(values.first()).copied();
                if let (Some(r), Some(g), Some(b)) = (channel(0), channel(1), channel(2)) {
                    let alpha = material.base_colour[3];
                    material.base_colour = [r, g, b, alpha].map(|c| c.clamp(0.0, 1.0));
                }
            }
            "d" => {
                if let Ok(alpha) = rest.parse::<f32>() {
                    material.base_colour[3] = alpha.clamp(0.0, 1.0);
                }
            }
            "map_Kd" => {
                let picture = folder.join(picture_name(rest).replace('\\', "/"));
                match ColourTexture::read(&picture) {
                    Ok(texture) => material.texture = Some(texture.into()),
                    Err(error) => notes.push(Note::warning(file, error.to_string())),
                }
            }
            _ => {}
        }
    }
}

/// The file name after the options of a map statement; it may hold spaces.
fn picture_name(mut rest: &str) -> &str {
    while let Some((option, after)) = rest.split_once(char::is_whitespace) {
        let Some(&(_, most)) = OPTIONS.iter().find(|(name, _)| *name == option) else {
            break;
        };
        rest = after.trim_start();
        for taken in 0..most {
            let Some((word, after)) = rest.split_once(char::is_whitespace) else {
                break;
            };
            if taken > 0 && most == 3 && word.parse::<f64>().is_err() {
                break;
            }
            rest = after.trim_start();
        }
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_before_the_picture_are_skipped() {
        assert_eq!(picture_name("cow.png"), "cow.png");
        assert_eq!(picture_name("a cow.png"), "a cow.png");
        assert_eq!(picture_name("-clamp on -s 1 2 3 a cow.png"), "a cow.png");
        assert_eq!(picture_name("-o 0.5 cow.png"), "cow.png");
    }

    #[test]
    fn missing_library_is_a_note() {
        let mut notes = Vec::new();
        let found = read_libraries(Path::new("x/y.obj"), &["no.mtl".into()], &mut notes);
        assert!(found.is_empty());
        assert!(notes[0].to_string().contains("no.mtl"));
    }
}
