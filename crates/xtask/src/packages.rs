//! Packages of the system: installed where this user may, named where not.

use std::fs;
use std::process::Command;

use crate::run::{self, Failed};

/// Another package manager, and the command that installs the same with it.
pub type Elsewhere = (&'static str, &'static str);

/// Installs packages with apt-get, as root or through sudo without a password.
///
/// # Errors
/// [`Failed`] with code 2 and the one command to run, where this user may not install anything.
pub fn install(missing: &str, packages: &[&str], elsewhere: &[Elsewhere]) -> anyhow::Result<()> {
    let has_apt = run::succeeds("apt-get", &["--version"]);
    let prefix: &[&str] = match (has_apt, is_root(), has_apt && run::succeeds("sudo", &["-n", "true"])) {
        (true, true, _) => &["env"],
        (true, false, true) => &["sudo", "-n", "env"],
        _ => {
            let advice = advice(has_apt, packages, elsewhere);
            return Err(Failed::bad_use(format!("{missing}. Run:\n\n    {advice}\n")).into());
        }
    };
    eprintln!("set-up: {missing}; installing {} with apt-get", packages.join(" and "));
    let apt_get = |arguments: &[&str]| {
        let mut command = Command::new(prefix[0]);
        command
            .args(&prefix[1..])
            .args(["DEBIAN_FRONTEND=noninteractive", "apt-get", "--quiet", "--yes"]);
        run::run(command.args(["--option", "DPkg::Lock::Timeout=120"]).args(arguments))
    };
    if let Err(error) = apt_get(&["update"]) {
        // One broken source of many need not matter.
        eprintln!("set-up: {error}; trying to install all the same");
    }
    let mut arguments = vec!["install", "--no-install-recommends"];
    arguments.extend(packages);
    let advice = advice(true, packages, elsewhere);
    apt_get(&arguments).map_err(|error| Failed::bad_use(format!("{error:#}. Run:\n\n    {advice}\n")).into())
}

/// The command that installs the packages on this distribution.
fn advice(has_apt: bool, packages: &[&str], elsewhere: &[Elsewhere]) -> String {
    let other = elsewhere
        .iter()
        .find(|(manager, _)| !has_apt && run::succeeds(manager, &["--version"]));
    other.map_or_else(
        || format!("sudo apt-get install {}", packages.join(" ")),
        |(_, command)| (*command).to_owned(),
    )
}

fn is_root() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    effective_user(&status) == Some(0)
}

/// The effective user of a `/proc/self/status`: the second number of the line `Uid:`.
fn effective_user(status: &str) -> Option<u32> {
    let line = status.lines().find_map(|line| line.strip_prefix("Uid:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effective_user_is_the_second_number() {
        assert_eq!(effective_user("Name:\tx\nUid:\t1000\t0\t0\t0\n"), Some(0));
        assert_eq!(effective_user("Name:\tx\n"), None);
    }
}
