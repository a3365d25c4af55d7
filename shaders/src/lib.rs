//! The WGSL of keyleaf: one file a pass, a surface, a metric, an effect; and the composer that puts together what a scene names.
//!
//! A file says on lines `// requires: shared/place.wgsl, …` which others it needs. [`compose`] concatenates a set of files and all
//! that they require, each once. There is no preprocessor: a variant is another file that defines the same functions, and a module
//! holds the one that was asked for. What a scene does not name is therefore not in its shaders.
//!
//! ```
//! let source = keyleaf_shaders::compose(&["passes/copy.wgsl"]).unwrap();
//! assert!(source.contains("fn copy_counts"));
//! assert!(!source.contains("fn surface_point"));
//! ```

mod located;
#[cfg(feature = "reload")]
pub mod reload;
mod table;

pub use located::{label, located};
pub use table::FILES;

/// Why a module could not be composed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ComposeError {
    /// A file was asked for, or required by another, that is not in [`FILES`].
    #[error("no shader file {file:?} (asked for by {by})")]
    UnknownFile {
        /// The path that was looked for.
        file: String,
        /// The file that requires it, or "the caller".
        by: String,
    },
}

/// The text of one WGSL file, by its path relative to the folder `shaders`.
pub fn source(file: &str) -> Option<&'static str> {
    find(file).map(|(_, text)| text)
}

/// Path and text of a file.
fn find(file: &str) -> Option<(&'static str, &'static str)> {
    let (path, text) = FILES.iter().find(|(path, _)| *path == file)?;
    #[cfg(feature = "reload")]
    let text = &reload::text_in_place_of(path).unwrap_or(text);
    Some((path, text))
}

/// The files that `roots` need, dependencies first, each once.
///
/// # Errors
/// [`ComposeError::UnknownFile`] if a file, or one that it requires, does not exist.
pub fn dependencies(roots: &[&str]) -> Result<Vec<&'static str>, ComposeError> {
    let mut order = Vec::new();
    for root in roots {
        visit(root, "the caller", &mut order)?;
    }
    Ok(order)
}

/// One WGSL module from `roots` and all that they require.
///
/// # Errors
/// [`ComposeError::UnknownFile`] if a file, or one that it requires, does not exist.
pub fn compose(roots: &[&str]) -> Result<String, ComposeError> {
    let files = dependencies(roots)?;
    let mut module = String::new();
    for file in files {
        module.push_str("// ---- ");
        module.push_str(file);
        module.push('\n');
        module.push_str(source(file).unwrap_or_default());
    }
    Ok(module)
}

/// The files on the `// requires:` lines of a text.
fn required(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .filter_map(|line| line.strip_prefix("// requires:"))
        .flat_map(|list| list.split(',').map(str::trim))
}

fn visit(file: &str, by: &str, order: &mut Vec<&'static str>) -> Result<(), ComposeError> {
    if order.contains(&file) {
        return Ok(());
    }
    let Some((path, text)) = find(file) else {
        return Err(ComposeError::UnknownFile {
            file: file.to_owned(),
            by: by.to_owned(),
        });
    };
    for next in required(text) {
        visit(next, path, order)?;
    }
    order.push(path);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependencies_come_first_and_once() {
        let files = dependencies(&["passes/decide.wgsl", "passes/flag.wgsl"]).unwrap();
        for (i, file) in files.iter().enumerate() {
            assert!(!files[..i].contains(file), "{file} twice");
            for needed in required(source(file).unwrap()) {
                assert!(files[..i].contains(&needed), "{needed} after {file}");
            }
        }
    }

    #[test]
    fn an_unknown_file_is_named_with_who_asks() {
        let error = compose(&["passes/nothing.wgsl"]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "no shader file \"passes/nothing.wgsl\" (asked for by the caller)"
        );
    }

    #[test]
    fn every_file_in_the_folder_is_in_the_table_and_says_what_it_does() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        for folder in ["shared", "passes", "surfaces", "metrics", "culling", "draw", "effects"] {
            for entry in std::fs::read_dir(root.join(folder)).unwrap() {
                let name = format!("{folder}/{}", entry.unwrap().file_name().to_string_lossy());
                let text = source(&name).unwrap_or_else(|| panic!("{name} is not in table.rs"));
                assert!(text.starts_with("// "), "{name} does not begin with what it does");
            }
        }
    }
}
