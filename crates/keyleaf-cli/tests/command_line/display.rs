//! A display for the viewer: the X server that draws into memory.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// A server that ends when it is dropped.
pub struct Display {
    server: Child,
    /// Its name, for the variable `DISPLAY`.
    pub name: String,
}

impl Display {
    /// Starts a server on a number that is free.
    pub fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("these tests need Xvfb, which `cargo xtask setup` installs: {error}"));
        let mut line = String::new();
        let output = server.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut line).unwrap();
        Self {
            server,
            name: format!(":{}", line.trim()),
        }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
