//! Bad use and bad input: exit code 2, one message, no file.

use super::{CUBE, Folder, TWO, png, refused};

#[test]
fn bad_input_exits_2_with_one_message_and_no_file() {
    let folder = Folder::new("bad-input");
    let map = png(16, 16);
    folder.write("cut.png", &map[..map.len() / 2]);
    folder.write("nan.obj", CUBE.replace("v 1 1 1", "v 1 nan 1"));
    folder.write("range.obj", CUBE.replace("f 5 6 7 8", "f 5 6 7 99"));
    folder.write(
        "fins.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n",
    );
    folder.write("empty.obj", "v 0 0 0\n");
    folder.write("field.ron", TWO.replace("scale: 0.5", "size: 0.5"));
    folder.write(
        "keys.ron",
        "Scene(surfaces: [Surface(name: \"a\", source: Terrain())], paths: [(name: \"p\", keys: [])])",
    );
    folder.write("lost.ron", TWO.replace("Mesh(\"cube.obj\")", "Mesh(\"nowhere.obj\")"));
    for (input, parts) in [
        ("nothing.obj", &["nothing.obj"][..]),
        ("cut.png", &["cut.png"]),
        ("nan.obj", &["nan.obj"]),
        ("range.obj", &["range.obj"]),
        ("fins.obj", &["fins.obj", "face"]),
        ("empty.obj", &["empty.obj"]),
        ("field.ron", &["field.ron:4", "size", "scale"]),
        ("keys.ron", &["keys.ron", "key"]),
        ("lost.ron", &["nowhere.obj"]),
        ("two.ron --capacity 5", &["capacity", "5", "24"]),
        ("two.ron --capacity 0", &["capacity"]),
        ("two.ron --pixels -3", &["pixels"]),
        ("two.ron --base-grid 7", &["base_grid"]),
        ("two.ron --camera nobody", &["nobody", "front, top"]),
        ("two.ron --size 0x0", &["0x0"]),
        ("two.ron --size 640", &["640"]),
        ("two.ron --size 999999x2", &["999999"]),
        ("two.ron --eye 1,2,3", &["--look-at"]),
        ("two.ron --eye 1,2,3 --look-at 1,2,3", &["--look-at"]),
        ("two.ron --eye 1,2,nan --look-at 0,0,0", &["1,2,nan"]),
        ("two.ron --channel normal --wireframe", &["--wireframe"]),
        ("two.ron -o", &["a value is required"]),
    ] {
        let arguments = if input.ends_with("-o") {
            format!("render {input}")
        } else {
            format!("render {input} -o out.png")
        };
        folder.refuse(&arguments, parts);
    }
    folder.refuse("render cube.obj -o out.gif", &["out.gif", ".png"]);
    folder.refuse("render cube.obj -o out.exr", &["out.exr", "position"]);
    folder.refuse("render cube.obj -o nowhere/out.png", &["nowhere"]);
    folder.refuse("check two.ron --path nothing", &["nothing", "around"]);
    folder.refuse("check two.ron --step 0", &["--step"]);
    folder.refuse("bench nothing.ron --out run.json", &["nothing.ron"]);
    folder.refuse("bench two.ron --out run.json --frames 0", &["--frames"]);
    folder.refuse("bench two.ron --out run.json --from 9", &["--from", "0.3"]);
    folder.refuse("plan two.blend", &["two.blend"]);
    folder.refuse("fly two.ron", &["fly"]);
}

#[test]
fn bad_points_are_refused_with_file_and_line() {
    let folder = Folder::new("bad-points");
    for (points, parts) in [
        ("face,u,v\n0,0.5,0.5\n0,nan,0\n", &["in.csv:3", "u"][..]),
        ("face,u,v\n9,0,0\n", &["in.csv:2", "face 9"]),
        ("face,u,v\n-1,0,0\n", &["in.csv:2", "face"]),
        ("face,u,v\n0,1.5,0\n", &["in.csv:2", "1.5"]),
        ("face,u,v\n0,1\n", &["in.csv:2", "3"]),
        ("face,u\n0,0\n", &["in.csv:1", "`v`", "face,u,v or surface,s,t"]),
        (
            "surface,s,t\n0,0,0\n",
            &["in.csv:2", "no parameters of its own", "face,u,v"],
        ),
        ("", &["in.csv", "empty"]),
    ] {
        folder.write("in.csv", points);
        folder.refuse("eval cube.obj --at in.csv -o out.csv --on cpu", parts);
    }
    folder.write("in.csv", "face,u,v\n0,0,0\n");
    folder.refuse("eval two.ron --at in.csv -o out.csv", &["left, right", "--object"]);
    folder.refuse(
        "eval two.ron --at in.csv -o out.csv --object nobody",
        &["nobody", "left, right"],
    );
    folder.refuse("eval cube.obj --at nothing.csv -o out.csv", &["nothing.csv"]);
}

#[test]
fn no_adapter_exits_2_with_advice() {
    let folder = Folder::new("no-adapter");
    let nothing = [
        ("WGPU_BACKEND", "dx12"),
        ("VK_DRIVER_FILES", "/nowhere"),
        ("VK_ICD_FILENAMES", "/nowhere"),
    ];
    for arguments in [
        "info",
        "render cube.obj -o out.png",
        "check cube.obj",
        "export cube.obj -o out.obj",
    ] {
        refused(
            arguments,
            &folder.run_in(arguments, &nothing),
            &["no graphics adapter", "mesa-vulkan-drivers"],
        );
    }
    assert!(!folder.files().iter().any(|file| file.starts_with("out")));
    let plan = folder.run_in("plan cube.obj", &nothing);
    assert_eq!(plan.status.code(), Some(0), "a plan needs no adapter");
}
