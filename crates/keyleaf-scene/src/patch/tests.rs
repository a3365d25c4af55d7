//! Patches of `.bpt` and of the tea set, what is recognised, and the shared data where they are there.

use super::*;
use keyleaf_surface::{PatchKind, PatchSettings, Patches, Surface, Unjoined};
use std::fmt::Write as _;
use std::path::PathBuf;

const WHOLE: PatchFileOptions = PatchFileOptions { ignore_trims: false };

fn parse(name: &str, text: &str) -> Result<PatchModel, String> {
    decode(Path::new(name), text.as_bytes(), &WHOLE).map_err(|e| e.to_string())
}

fn error(name: &str, text: &str) -> String {
    parse(name, text).map(|model| model.surfaces.len()).unwrap_err()
}

/// A bilinear patch, and one of degrees 2 and 1.
const BPT: &str = "2\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 2\n\n2 1\n1 0 0\n2 0 0\n3 0 0\n1 1 2\r\n2\t1 0\n3 1 4\n\n";

#[test]
fn bpt_patches_have_u_fastest() {
    let model = parse("a.bpt", BPT).unwrap();
    assert!(model.is_bezier && model.notes.is_empty());
    assert_eq!(model.names, ["patch 1", "patch 2"]);
    let at = |surface: usize, u, v| model.surfaces[surface].frame(u, v).unwrap().position.to_array();
    assert_eq!(at(0, 0.5, 0.5), [0.5, 0.5, 0.5]);
    assert_eq!(at(0, 1.0, 0.0), [1.0, 0.0, 0.0]);
    assert_eq!(model.surfaces[1].degree(), [2, 1]);
    assert_eq!(at(1, 1.0, 1.0), [3.0, 1.0, 4.0]);
    assert_eq!(at(1, 0.5, 0.0), [2.0, 0.0, 0.0]);
}

#[test]
fn bpt_errors_name_file_line_and_reason() {
    let of = |from: &str, to: &str| {
        assert!(BPT.contains(from), "{from}");
        error("a.bpt", &BPT.replacen(from, to, 1))
    };
    assert!(of("1 1 2", "1 nan 2").starts_with("a.bpt: line 6: control point is NaN"));
    assert!(of("1 1 2", "1 1").starts_with("a.bpt: line 6: expected control point x y z, found 2 values"));
    assert!(of("1 1 2", "1 1 2 3").contains("line 6: expected control point x y z, found 4"));
    assert!(of("1 1 2", "1 one 2").contains("line 6: expected control point x y z, found 'one'"));
    assert!(of("1 1 2", "1 1e30 2").contains("line 6"));
    let many = of("2\n1 1", "3\n1 1");
    assert!(
        many.contains("line 14: the file ends after this line; expected the two degrees of patch 3 of 3"),
        "{many}"
    );
    assert!(of("2\n1 1", "1\n1 1").contains("line 8: the file goes on after the last of its patches"));
    assert!(of("2\n1 1", "2\n8 1").contains("line 2: the degree 8 of patch 1 is not from 1 to 7"));
    assert!(of("2\n1 1", "2\n0 1").contains("the degree 0"));
    assert!(of("2\n1 1", "0\n1 1").contains("line 1: there are no patches"));
    assert!(of("2\n1 1", "-1\n1 1").contains("line 1: expected the number of patches, found '-1'"));
    assert!(error("a.bpt", "").contains("line 1: the file ends"));
    assert!(error("a.bpt", "99999999999\n1 1\n").contains("line 2: the file ends"));
}

/// A flat patch and one that leans on its last row.
fn teaset() -> String {
    let mut text = String::from(
        "2\n1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28\n28\n",
    );
    for index in 0..28 {
        writeln!(text, "{}.0,{}.0,{}.0", index % 4, index / 4, (index / 16) * 2).unwrap();
    }
    text
}

#[test]
fn tea_set_shares_vertices() {
    for name in ["cup", "cup.teaset", "cup.dat"] {
        let model = parse(name, &teaset()).unwrap();
        assert!(model.is_bezier);
        let [first, second] = &model.surfaces[..] else { panic!() };
        assert_eq!(first.points()[12..], second.points()[..4]);
        assert_eq!(first.frame(1.0, 0.0).unwrap().position.to_array(), [3.0, 0.0, 0.0]);
    }
    let spaced = teaset().replace(',', ", ").replace('\n', "\n\n");
    assert_eq!(parse("cup", &spaced).unwrap(), parse("cup", &teaset()).unwrap());
}

#[test]
fn tea_set_errors_name_file_line_and_reason() {
    let of = |from: &str, to: &str| {
        assert!(teaset().contains(from), "{from}");
        error("cup", &teaset().replacen(from, to, 1))
    };
    let missing = of("27,28\n", "27,29\n");
    assert!(
        missing.starts_with("cup: line 3: control point 29 is out of range: there are 28"),
        "{missing}"
    );
    assert!(of("1,2,3,4,", "0,2,3,4,").contains("line 2: control point 0 is out of range"));
    assert!(of("1,2,3,4,", "1,2,3,").contains("line 2: expected the 16 control points of patch 1 of 2, found 15"));
    assert!(of("\n28\n", "\n27\n").contains("line 32: the file goes on after the last of its vertices"));
    assert!(of("\n28\n", "\n29\n").contains("line 32: the file ends after this line; expected vertex x y z"));
    assert!(of("1.0,0.0,0.0", "1.0,inf,0.0").contains("line 6: vertex is inf"));
}

#[test]
fn files_are_recognised_by_ending_or_content() {
    let folder = std::env::temp_dir().join(format!("keyleaf-patch-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let is = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
        is_patch_file(&folder.join(name))
    };
    assert!(is("cup", &teaset()) && !is("notes", "2\n1,2,3\n") && !is("empty", ""));
    assert!(is("a.obj", "v 0 0 0\n  surf 0 1 0 1 1 1 1 1\n") && !is("b.obj", "v 0 0 0\no surf\nf 1 1 1\n"));
    assert!(is("a.bpt", "") && is("a.dat", "") && !is("a.ply", &teaset()));
    assert!(!is_patch_file(&folder.join("no.obj")) && !is_patch_file(&folder));
    let error = read_patches(&folder.join("a.ply"), &WHOLE).unwrap_err().to_string();
    assert!(
        error.contains("unknown file type 'ply'; expected one of .bpt"),
        "{error}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

/// Joins the surfaces of a shared file and prints what was found; `None` where the file is absent.
fn shared(name: &str) -> Option<(PatchModel, Patches)> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(name);
    if !file.exists() {
        println!("skipped: {} is not there", file.display());
        return None;
    }
    let model = read_patches(&file, &WHOLE).unwrap_or_else(|e| panic!("{e}"));
    let kind = if model.is_bezier {
        PatchKind::Bezier
    } else {
        PatchKind::Nurbs(keyleaf_surface::BasisMethod::Triangular)
    };
    let settings = PatchSettings {
        tolerance: 1e-6,
        kind,
        even_spans: false,
    };
    let patches = Patches::new(model.surfaces.clone(), settings).unwrap();
    let report = patches.report();
    let count = |why| report.unjoined.iter().filter(|(_, reason)| *reason == why).count();
    println!(
        "{name}: {} surfaces, {} faces, joined {} equal + {} snapped (moved {:e}), open {} free + {} crowded + {} one-sided, \
         {} poles, {} transposed",
        model.surfaces.len(),
        patches.topology().face_count(),
        report.exact,
        report.snapped,
        report.largest_move,
        count(Unjoined::Free),
        count(Unjoined::Crowded),
        count(Unjoined::NotOrientable),
        report.poles.len(),
        report.transposed.len(),
    );
    Some((model, patches))
}

#[test]
fn shared_tea_set_is_bezier_and_joins() {
    for (name, patch_count) in [("teapot", 32), ("teacup", 26), ("teaspoon", 16)] {
        let Some((model, patches)) = shared(&format!("teaset/{name}")) else {
            continue;
        };
        assert!(model.is_bezier && model.surfaces.len() == patch_count);
        assert!(
            patches.report().exact + patches.report().snapped >= patch_count as u32,
            "{name}"
        );
    }
}

#[test]
fn shared_nurbs_load_and_join() {
    for (name, surface_count) in [("HumanHead1", 20), ("Speeder", 2), ("UntrimmedSurfaces", 141)] {
        let Some((model, patches)) = shared(&format!("nurbs/v2_{name}.obj")) else {
            continue;
        };
        assert!(!model.is_bezier && model.surfaces.len() == surface_count);
        assert!(patches.report().exact + patches.report().snapped > 0, "{name}");
    }
    if let Some((model, _)) = shared("nurbs/v5_teapot.obj") {
        assert_eq!(model.surfaces.len(), 97);
    }
}

/// What knot-span quads measure in own u and v: sums of second differences, and of squares of differences. Triangles for a given
/// deviation, or length, are proportional to the sum of both directions.
fn measures(patches: &Patches) -> [[f64; 2]; 2] {
    let steps = |face: u32, own_axis: usize| {
        let is_transposed = patches.report().transposed.contains(&patches.surface_of(face).unwrap());
        let axis = own_axis ^ usize::from(is_transposed);
        let [first, middle, last] = [0.0, 0.5, 1.0].map(|t| {
            let [u, v] = if axis == 0 { [t, 0.5] } else { [0.5, t] };
            patches.point(patches.face_coord(face, u, v).unwrap())
        });
        [(first - 2.0 * middle + last).length(), (last - first).length_squared()]
    };
    let sum = |order: usize, axis: usize| -> f64 {
        let faces = 0..patches.topology().face_count();
        faces.map(|face| steps(face, axis)[order]).sum()
    };
    [0, 1].map(|order| [0, 1].map(|axis| sum(order, axis)))
}

#[test]
fn long_quads_of_files_become_even_and_the_same_boundaries_join() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/nurbs");
    for (file, joined) in [
        (scenes.join("panels.obj"), Some(12)),
        (scenes.join("goblet.obj"), None),
        (shared.join("v2_Speeder.obj"), Some(2)),
        (shared.join("v2_HumanHead1.obj"), None),
        (shared.join("v2_UntrimmedSurfaces.obj"), None),
        (shared.join("v5_teapot.obj"), None),
    ] {
        let Ok(model) = read_patches(&file, &PatchFileOptions { ignore_trims: true }) else {
            println!("skipped: {} is not there", file.display());
            continue;
        };
        let [before, after] = [false, true].map(|even_spans| {
            let settings = PatchSettings {
                even_spans,
                ..PatchSettings::default()
            };
            Patches::new(model.surfaces.clone(), settings).unwrap()
        });
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        let faces = [&before, &after].map(|patches| patches.topology().face_count());
        let measures = [&before, &after].map(measures);
        let ratios = measures.map(|of| of.map(|[u, v]| (v / u).sqrt()));
        let triangles = [0, 1].map(|order| {
            let [before, after] = measures.map(|of| of[order].iter().sum::<f64>());
            after / before
        });
        println!("{name}: faces {faces:?}, ratios {ratios:.2?}, triangles {triangles:.3?} of what they were");
        let joins = [&before, &after].map(|patches| patches.report().exact + patches.report().snapped);
        assert_eq!(joins[0], joins[1], "{name}");
        assert!(joined.is_none_or(|joined| joined == joins[0]), "{name}: {joins:?}");
        assert_eq!(before.report().unjoined, after.report().unjoined, "{name}");
        assert!(faces[1] >= faces[0], "{name}");
        if name.contains("Speeder") {
            let [was, is] = ratios.map(|[second, _]| second.log2().abs());
            assert!(triangles[0] < 0.9);
            assert!(faces[1] > faces[0] && is <= 0.5 && is < was, "{was} {is}");
        }
    }
}

#[test]
fn broken_files_never_panic() {
    let obj = "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 2\nv 1 1 0 1\ncstype rat bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\n\
        parm v 0 1\nend\n";
    let trims = PatchFileOptions { ignore_trims: true };
    for (name, text) in [("a.bpt", BPT), ("cup", &teaset()), ("a.obj", obj)] {
        assert!(parse(name, text).is_ok());
        let bytes = text.as_bytes();
        for at in 0..bytes.len() {
            let with = |middle: &[u8]| [&bytes[..at], middle, &bytes[at + 1..]].concat();
            for middle in [
                &b""[..],
                b"9",
                b"-",
                b"\\",
                b"\n",
                b" 99999999999999999999 ",
                b"e308",
                b"\xff",
                b"end\n",
            ] {
                let _ = decode(Path::new(name), &with(middle), &trims);
            }
            let _ = decode(Path::new(name), &bytes[..at], &trims);
        }
    }
}
