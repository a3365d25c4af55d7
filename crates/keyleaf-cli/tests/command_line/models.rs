//! What `export` and `eval` write.

use super::{Folder, png};

/// Positions as text, and triangles, of an .obj.
fn triangles(text: &str) -> (Vec<&str>, Vec<[usize; 3]>) {
    let vertices = text.lines().filter_map(|line| line.strip_prefix("v ")).collect();
    let corner = |text: &str| text.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    let triangle = |face: &str| {
        face.split_whitespace()
            .map(corner)
            .collect::<Vec<_>>()
            .try_into()
            .unwrap()
    };
    (vertices, faces.map(triangle).collect())
}

#[test]
fn exports_of_closed_models_are_watertight_in_every_bit() {
    let folder = Folder::new("watertight");
    // Poles, seams and collapsed edges included.
    let scenes = [
        "goblet",
        "torus",
        "pot",
        "cube",
        "fox",
        "displaced",
        "valences",
        "creases",
        "qas",
        "gaussian",
        "figure",
    ];
    let scenes = scenes.map(|name| {
        let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
        format!("{scenes}/{name}.ron --no-cull --pixels 40 --size 160x120 --quiet")
    });
    let moved = scenes.last().map(|scene| format!("{scene} --time 0.7"));
    let meshes = [
        "cube.obj --no-cull --eye 3,2,1.5 --look-at 0,0,0 --size 200x150",
        "two.ron --no-cull --size 120x90",
        "cube.obj --uniform 2",
    ];
    for arguments in meshes
        .into_iter()
        .chain(scenes.iter().chain(&moved).map(String::as_str))
    {
        folder.succeed(&format!("export {arguments} -o out.obj"));
        let text = folder.read("out.obj");
        let (vertices, triangles) = triangles(&text);
        let mut edges: Vec<(&str, &str)> = triangles
            .iter()
            .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
            .map(|(a, b)| (vertices[a], vertices[b]))
            .collect();
        edges.sort_unstable();
        assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "{arguments}");
        assert!(
            edges.iter().all(|(a, b)| edges.binary_search(&(*b, *a)).is_ok()),
            "{arguments}"
        );
        let mut distinct = vertices.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), vertices.len(), "{arguments}: every point once");
    }
}

#[test]
fn exports_hold_what_is_drawn() {
    let folder = Folder::new("export");
    let report = folder.succeed_with_json("export cube.obj -o u.ply --uniform 1 --base-grid 0 --json");
    assert_eq!(
        (report["triangles"].as_u64(), report["vertices"].as_u64()),
        (Some(96), Some(50))
    );
    let view = "--size 100x80 --eye 0,0,5 --look-at 0,0,0";
    let seen = folder.succeed_with_json(&format!("export cube.obj -o seen.obj {view} --json"));
    let drawn = folder.succeed_with_json(&format!("render cube.obj -o seen.png {view} --json"));
    assert_eq!(seen["triangles"], drawn["triangles"]);
    folder.succeed(&format!("export cube.obj -o n.obj {view} --normals"));
    assert!(folder.read("n.obj").contains("vn "));
    folder.succeed("export cube.obj -o s.stl --uniform 0");
    assert_eq!(folder.read_bytes("s.stl").len(), 84 + 50 * 24 * 16);
    folder.refuse("export cube.obj -o x.fbx", &["x.fbx", ".ply"]);
    folder.refuse("export cube.obj -o x.obj --uniform 30", &["30", "29"]);
    folder.refuse("export cube.obj -o x.obj --uniform 12", &["402653184", "level 9"]);
    folder.refuse("export cube.obj -o x.stl --uniform 1 --normals", &["x.stl"]);
}

#[test]
fn eval_appends_columns_on_both_devices() {
    let folder = Folder::new("eval");
    folder.write("in.csv", "id,face,u,v\na,1,0.5,0.25\n\nb,0,0,1\n");
    for device in ["gpu", "cpu"] {
        folder.succeed(&format!("eval cube.obj --at in.csv -o {device}.csv --on {device}"));
        let text = folder.read(&format!("{device}.csv"));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "id,face,u,v,x,y,z,du_x,du_y,du_z,dv_x,dv_y,dv_z,n_x,n_y,n_z");
        assert_eq!(lines[1], "a,1,0.5,0.25,0,-0.5,1,2,0,0,0,2,0,0,0,1");
        assert!(lines[2].starts_with("b,0,0,1,-1,-1,-1,") && lines.len() == 3, "{text}");
    }
    folder.write("objects.csv", "object,face,u,v\nleft,1,0.5,0.5\nright,1,0.5,0.5\n");
    folder.succeed("eval two.ron --at objects.csv -o objects_out.csv");
    let text = folder.read("objects_out.csv");
    assert!(
        text.lines()
            .nth(2)
            .unwrap()
            .starts_with("right,1,0.5,0.5,2,0,0.5,1,0,0,"),
        "{text}"
    );
    folder.write("map.csv", "surface,s,t\n0,0.125,0.5\n");
    folder.succeed("eval hills.ron --at map.csv -o map_gpu.csv");
    assert!(
        folder
            .read("map_gpu.csv")
            .lines()
            .nth(1)
            .unwrap()
            .starts_with("0,0.125,0.5,1250,")
    );
}

#[test]
fn heights_by_eval_are_those_of_the_file() {
    let folder = Folder::new("heights");
    let (width, height) = (9, 5);
    folder.write("map.png", png(width, height));
    let mut points = "surface,s,t\n".to_owned();
    let mut expected = Vec::new();
    for (x, y) in [(0, 0), (8, 0), (3, 1), (4, 4), (0, 4), (7, 2)] {
        // Row 0 is at v = 1.
        points += &format!(
            "0,{},{}\n",
            f64::from(x) / f64::from(width - 1),
            1.0 - f64::from(y) / f64::from(height - 1)
        );
        expected.push(f64::from(x * 700 + y * 900));
    }
    folder.write("points.csv", points);
    folder.succeed("eval map.png --at points.csv -o out.csv");
    let text = folder.read("out.csv");
    for (line, expected) in text.lines().skip(1).zip(expected) {
        let y: f64 = line.split(',').nth(4).unwrap().parse().unwrap();
        assert!((y - expected).abs() <= 0.5, "{line}: {expected}");
    }
}
