//! A display for the viewer where there is none: the X server that draws into memory.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, ensure};

use crate::packages::{self, Elsewhere};
use crate::{run, vulkan};

/// The server, and what programs open windows with: they look for these when they start.
const PACKAGES: [&str; 6] = [
    "xvfb",
    "libx11-6",
    "libx11-xcb1",
    "libxcursor1",
    "libxi6",
    "libxkbcommon-x11-0",
];
/// What must be there of them.
const LIBRARIES: [&str; 5] = [
    "libX11.so.6",
    "libX11-xcb.so.1",
    "libXcursor.so.1",
    "libXi.so.6",
    "libxkbcommon-x11.so.0",
];
const ELSEWHERE: [Elsewhere; 4] = [
    ("dnf", "sudo dnf install xorg-x11-server-Xvfb"),
    ("pacman", "sudo pacman -S xorg-server-xvfb"),
    ("zypper", "sudo zypper install xorg-x11-server-Xvfb"),
    ("apk", "sudo apk add xvfb"),
];

/// Finds the X server in memory, or installs it where this user may.
///
/// # Errors
/// [`run::Failed`] with code 2 and the one command to run.
pub fn set_up() -> anyhow::Result<()> {
    if !cfg!(target_os = "linux") || is_there() {
        return Ok(());
    }
    packages::install(
        "the viewer is tested with Xvfb, and it or a library of X11 is not there",
        &PACKAGES,
        &ELSEWHERE,
    )?;
    ensure!(is_there(), "xvfb was installed, but Xvfb does not start");
    Ok(())
}

fn is_there() -> bool {
    let folders = vulkan::library_folders();
    let has = |library: &&str| folders.iter().any(|folder| folder.join(library).exists());
    run::succeeds("sh", &["-c", "command -v Xvfb"]) && LIBRARIES.iter().all(has)
}

/// A server that ends when it is dropped.
pub struct Display {
    server: Child,
    /// Its name, for the variable `DISPLAY`.
    pub name: String,
}

impl Display {
    /// Starts a server of its own, on a number that is free.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start() -> anyhow::Result<Self> {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .context("cannot start Xvfb")?;
        let mut line = String::new();
        if let Some(output) = server.stdout.take() {
            BufReader::new(output).read_line(&mut line)?;
        }
        let name = format!(":{}", line.trim());
        let display = Self { server, name };
        ensure!(display.name.len() > 1, "Xvfb did not say which display it serves");
        Ok(display)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
