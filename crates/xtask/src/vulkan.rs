//! Is there a Vulkan driver, and if not, may it be installed?
//!
//! keyleaf needs the loader (`libvulkan.so.1`) and a driver manifest whose driver can work here: the software driver
//! always can, a hardware driver only where there is a render device. The folders are those of the Vulkan loader's
//! documentation, *Driver interface to the Vulkan loader*.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::packages::{self, Elsewhere};
use crate::run::Failed;

const PACKAGES: [&str; 2] = ["libvulkan1", "mesa-vulkan-drivers"];
const ELSEWHERE: [Elsewhere; 4] = [
    ("dnf", "sudo dnf install vulkan-loader mesa-vulkan-drivers"),
    ("pacman", "sudo pacman -S vulkan-icd-loader vulkan-swrast"),
    ("zypper", "sudo zypper install libvulkan1 libvulkan_lvp"),
    ("apk", "sudo apk add vulkan-loader mesa-vulkan-swrast"),
];
/// Manifest names of software drivers (Mesa's llvmpipe, SwiftShader).
const SOFTWARE: [&str; 2] = ["lvp", "swiftshader"];

/// Finds a driver, or installs the software driver where this user may.
///
/// # Errors
/// [`Failed`] with code 2 and the one command to run, where there is no driver and this user may not install one.
pub fn set_up() -> anyhow::Result<()> {
    if !cfg!(target_os = "linux") {
        eprintln!("set-up: Vulkan drivers are looked for on Linux only; nothing done");
        return Ok(());
    }
    match find() {
        Ok(driver) => eprintln!("set-up: Vulkan driver {}", driver.display()),
        Err(missing) => {
            if let Some((name, _)) = forced_manifests() {
                return Err(
                    Failed::bad_use(format!("{missing} among what {name} names; correct it or unset it")).into(),
                );
            }
            packages::install(&missing, &PACKAGES, &ELSEWHERE)?;
            let driver = find()
                .map_err(|missing| Failed::bad_use(format!("{} installed, but {missing}", PACKAGES.join(" and "))))?;
            eprintln!("set-up: installed; Vulkan driver {}", driver.display());
        }
    }
    Ok(())
}

/// The manifest of a driver that can work on this machine, or what is missing.
fn find() -> Result<PathBuf, String> {
    if !library_folders()
        .iter()
        .any(|folder| folder.join("libvulkan.so.1").exists())
    {
        return Err("there is no Vulkan loader (libvulkan.so.1)".into());
    }
    let manifests = manifests();
    let hardware = has_render_device();
    let usable = |path: &&PathBuf| (hardware || is_software(path)) && library_exists(path);
    manifests.iter().find(usable).cloned().ok_or_else(|| {
        if manifests.is_empty() {
            "there is no Vulkan driver".into()
        } else {
            "the only Vulkan drivers are for hardware that is not here".into()
        }
    })
}

/// A device that a hardware driver can open: DRM render nodes, NVIDIA's, and that of WSL.
fn has_render_device() -> bool {
    let render_node = |entry: fs::DirEntry| entry.file_name().to_string_lossy().starts_with("renderD");
    let dri = fs::read_dir("/dev/dri").is_ok_and(|mut entries| entries.any(|e| e.is_ok_and(render_node)));
    dri || ["/dev/nvidia0", "/dev/dxg"].iter().any(|path| Path::new(path).exists())
}

fn is_software(manifest: &Path) -> bool {
    let name = manifest
        .file_name()
        .map(|name| name.to_string_lossy().to_lowercase())
        .unwrap_or_default();
    SOFTWARE.iter().any(|software| name.contains(software))
}

/// Whether the driver that a manifest names exists; a bare name is left to the loader.
fn library_exists(manifest: &Path) -> bool {
    let Ok(text) = fs::read_to_string(manifest) else {
        return false;
    };
    let Some(library) = library_path(&text) else {
        return false;
    };
    if !library.contains('/') {
        return true;
    }
    manifest.parent().is_some_and(|folder| folder.join(library).exists())
}

/// The value of `library_path` in a driver manifest (JSON).
fn library_path(manifest: &str) -> Option<&str> {
    let (_, rest) = manifest.split_once("\"library_path\"")?;
    let (_, rest) = rest.split_once('"')?;
    rest.split_once('"').map(|(value, _)| value)
}

/// Folders in which the dynamic linker may find the loader.
pub fn library_folders() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = env::var_os("LD_LIBRARY_PATH")
        .iter()
        .flat_map(|paths| env::split_paths(paths).collect::<Vec<_>>())
        .collect();
    for base in ["/usr/lib", "/lib", "/usr/lib64", "/lib64", "/usr/local/lib"].map(PathBuf::from) {
        let below = fs::read_dir(&base)
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path());
        folders.extend(below.filter(|path| path.is_dir()));
        folders.push(base);
    }
    folders
}

/// Every driver manifest, in the order in which the loader looks; names from the environment replace the folders.
fn manifests() -> Vec<PathBuf> {
    let places = match forced_manifests() {
        Some((_, list)) => env::split_paths(&list).collect(),
        None => manifest_folders(),
    };
    places.iter().flat_map(|place| manifests_at(place)).collect()
}

/// The variable that names the only manifests which the loader reads, and its value.
fn forced_manifests() -> Option<(&'static str, OsString)> {
    let names = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];
    names
        .into_iter()
        .find_map(|name| set_variable(name).map(|value| (name, value)))
}

/// Folders that the loader searches, and what `VK_ADD_DRIVER_FILES` adds before them.
fn manifest_folders() -> Vec<PathBuf> {
    let list = |name: &str, otherwise: &str| {
        let paths = set_variable(name).unwrap_or_else(|| OsString::from(otherwise));
        env::split_paths(&paths).collect::<Vec<_>>()
    };
    let home = |name: &str, below: &str| {
        let own = set_variable(name).map(PathBuf::from);
        own.or_else(|| set_variable("HOME").map(|home| Path::new(&home).join(below)))
    };
    let mut folders = Vec::new();
    folders.extend(home("XDG_CONFIG_HOME", ".config"));
    folders.extend(list("XDG_CONFIG_DIRS", "/etc/xdg"));
    folders.extend([PathBuf::from("/usr/local/etc"), PathBuf::from("/etc")]);
    folders.extend(home("XDG_DATA_HOME", ".local/share"));
    folders.extend(list("XDG_DATA_DIRS", "/usr/local/share:/usr/share"));
    let added = list("VK_ADD_DRIVER_FILES", "");
    added
        .into_iter()
        .chain(folders.into_iter().map(|folder| folder.join("vulkan/icd.d")))
        .collect()
}

/// A manifest itself, or the manifests of a folder by name.
fn manifests_at(place: &Path) -> Vec<PathBuf> {
    if place.is_file() {
        return vec![place.to_path_buf()];
    }
    let entries = fs::read_dir(place)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path());
    let mut found: Vec<PathBuf> = entries
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    found.sort();
    found
}

fn set_variable(name: &str) -> Option<OsString> {
    env::var_os(name).filter(|value| !value.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn library_path_is_read_from_a_manifest() {
        let manifest =
            "{ \"ICD\": { \"api_version\": \"1.3.230\",\n \"library_path\" : \"/usr/lib/libvulkan_lvp.so\" } }";
        assert_eq!(library_path(manifest), Some("/usr/lib/libvulkan_lvp.so"));
        assert_eq!(library_path("{}"), None);
        assert_eq!(library_path("{\"library_path\": 3"), None);
    }

    #[test]
    fn software_drivers_are_known_by_name() {
        assert!(is_software(Path::new("/usr/share/vulkan/icd.d/lvp_icd.x86_64.json")));
        assert!(is_software(Path::new("vk_swiftshader_icd.json")));
        assert!(!is_software(Path::new("/usr/share/vulkan/lvp/intel_icd.x86_64.json")));
    }
}
