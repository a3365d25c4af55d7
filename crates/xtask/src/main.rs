//! `cargo xtask …`: sets the machine up, shows keyleaf, tests it.
//!
//! | command | does |
//! |---|---|
//! | `demo` | set-up, release build, pictures of the default scenes, one camera path, a table |
//! | `test` | set-up, then every test of the workspace |
//! | `pictures` | the pictures of the viewer in `docs/pictures/` |
//! | `setup` | looks for a Vulkan driver and installs the software driver where there is none; the same for Xvfb, which the viewer is tested with |
//!
//! Exit codes: 0; 2 for bad use or a machine without a Vulkan driver; else that of the command that failed.

mod demo;
mod display;
mod packages;
mod pictures;
mod run;
mod table;
mod vulkan;

use std::process::ExitCode;

use run::Failed;

const HELP: &str = "\
Set-up, demonstration and tests of keyleaf.

Usage: cargo xtask <COMMAND> [--no-setup] [ARGUMENTS]

Commands:
  demo     Render the default scenes to out/demo/, fly a camera path, print figures
  test     Run all tests; further arguments go to `cargo test`
  pictures Make the pictures of the viewer in docs/pictures/
  setup    Look for a Vulkan driver; where there is none, install the software driver; the same for Xvfb
  help     Print this

Options:
  --no-setup   Do not look for a Vulkan driver (first argument of demo, test and pictures)

Examples:
  cargo xtask demo
  cargo xtask test
  cargo xtask test -p keyleaf-key -- neighbour
";

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let command = if arguments.is_empty() {
        String::from("help")
    } else {
        arguments.remove(0)
    };
    let with_setup = arguments.first().is_none_or(|first| first != "--no-setup");
    if !with_setup {
        arguments.remove(0);
    }
    let result = match command.as_str() {
        "help" | "-h" | "--help" => {
            print!("{HELP}");
            Ok(())
        }
        "demo" | "setup" | "pictures" if arguments.iter().any(|a| a == "-h" || a == "--help") => {
            print!("{HELP}");
            Ok(())
        }
        "setup" => no_arguments(&arguments)
            .and_then(|()| vulkan::set_up())
            .and_then(|()| display::set_up()),
        "demo" => no_arguments(&arguments)
            .and_then(|()| set_up(with_setup))
            .and_then(|()| demo::demo()),
        "pictures" => no_arguments(&arguments)
            .and_then(|()| set_up(with_setup))
            .and_then(|()| set_up_display(with_setup))
            .and_then(|()| pictures::pictures()),
        "test" => set_up(with_setup)
            .and_then(|()| set_up_display(with_setup))
            .and_then(|()| test(&arguments)),
        _ => Err(Failed::bad_use(format!("there is no command `{command}`\n\n{HELP}")).into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let code = error.downcast_ref::<Failed>().map_or(1, |failed| failed.code);
            let message = format!("{error:#}");
            if !message.is_empty() {
                eprintln!("xtask: {message}");
            }
            ExitCode::from(code)
        }
    }
}

fn set_up(wanted: bool) -> anyhow::Result<()> {
    if wanted { vulkan::set_up() } else { Ok(()) }
}

fn set_up_display(wanted: bool) -> anyhow::Result<()> {
    if wanted { display::set_up() } else { Ok(()) }
}

fn no_arguments(arguments: &[String]) -> anyhow::Result<()> {
    match arguments.first() {
        None => Ok(()),
        Some(first) => Err(Failed::bad_use(format!("unexpected argument `{first}`\n\n{HELP}")).into()),
    }
}

/// All tests of the workspace, or of the packages that the arguments name. The last lines are the test runner's.
fn test(arguments: &[String]) -> anyhow::Result<()> {
    let mut all = vec!["test", "--locked"];
    let names_packages = arguments
        .iter()
        .take_while(|argument| *argument != "--")
        .any(|argument| argument.starts_with("-p") || argument.starts_with("--package"));
    if !names_packages {
        all.push("--workspace");
    }
    all.extend(arguments.iter().map(String::as_str));
    run::cargo(&all).map_err(Failed::silently)
}
