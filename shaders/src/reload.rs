//! Replacing the texts of WGSL files while a program runs: what a person edits in a checkout is seen at once.
//!
//! Only with the feature `reload`, for tools: this is global, as the built-in texts are. Texts that are replaced stay in memory.

use crate::FILES;
use std::collections::HashMap;
use std::path::Path;
use std::sync::RwLock;

/// Texts in place of the built-in ones, by path.
pub type Texts = HashMap<&'static str, &'static str>;

static REPLACED: RwLock<Option<Texts>> = RwLock::new(None);

/// The files of a folder `shaders` that differ from the built-in ones. Files that the table does not name are left out.
///
/// # Errors
/// A file cannot be read.
pub fn read(folder: &Path) -> std::io::Result<Texts> {
    let mut texts = Texts::new();
    for (path, built_in) in FILES {
        let text = std::fs::read_to_string(folder.join(path))?;
        if text != *built_in {
            let now = text_in_place_of(path);
            let same = now.filter(|now| *now == text);
            texts.insert(path, same.unwrap_or_else(|| Box::leak(text.into_boxed_str())));
        }
    }
    Ok(texts)
}

/// Uses these texts from now on, and no others; those that were used before.
pub fn replace(texts: Texts) -> Texts {
    let mut replaced = REPLACED.write().unwrap_or_else(|poisoned| poisoned.into_inner());
    replaced.replace(texts).unwrap_or_default()
}

/// The text in place of a built-in one.
pub(crate) fn text_in_place_of(path: &str) -> Option<&'static str> {
    let replaced = REPLACED.read().unwrap_or_else(|poisoned| poisoned.into_inner());
    replaced.as_ref()?.get(path).copied()
}
