//! Help, plan and info.

use super::Folder;
use serde_json::Value;

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new("help");
    for command in [
        "view", "render", "export", "eval", "check", "bench", "compare", "accuracy", "plan", "info",
    ] {
        let help = folder.succeed(&format!("{command} --help"));
        assert!(
            help.contains(&format!("keyleaf {command} ")) && help.contains("Example"),
            "{help}"
        );
    }
    let help = folder.succeed("--help");
    assert!(help.contains("SCENE") && help.contains("compare"), "{help}");
}

#[test]
fn info_names_the_device() {
    let folder = Folder::new("info");
    let info = folder.succeed_with_json("info --json");
    assert!(!info["device"].as_str().unwrap().is_empty() && info["limits"]["texture_side"].as_u64().unwrap() >= 8192);
    assert!(folder.succeed("info").contains(info["device"].as_str().unwrap()));
}

#[test]
fn plan_lists_what_is_named_and_nothing_else() {
    let folder = Folder::new("plan");
    let plan = |arguments: &str| folder.succeed(&format!("plan {arguments} --json"));
    let bare = plan("cube.obj");
    assert!(!bare.contains("displaced") && !bare.contains("wireframe") && !bare.contains("height"));
    assert!(plan("cube.obj --wireframe").contains("overlay_wireframe.wgsl"));
    let roots = serde_json::from_str::<Value>(&bare)
        .unwrap()
        .pointer("/surfaces/0/roots")
        .and_then(Value::as_u64);
    assert_eq!(roots, Some(24));
    assert!(folder.succeed("plan hills.ron").contains("surfaces/terrain.wgsl"));
}

#[test]
fn quiet_commands_print_nothing_but_results() {
    let folder = Folder::new("quiet");
    let output = folder.run("render cube.obj -o a.png --size 20x20 --quiet");
    assert!(output.stderr.is_empty() && output.status.success());
}
