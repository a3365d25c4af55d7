//! Free-form surfaces of Wavefront OBJ: what is read, and what is refused and where.

use super::*;

const WHOLE: PatchFileOptions = PatchFileOptions { ignore_trims: false };
const TRIMS: PatchFileOptions = PatchFileOptions { ignore_trims: true };

fn parse_with(options: &PatchFileOptions, text: &str) -> Result<PatchModel, String> {
    decode(Path::new("a.obj"), text.as_bytes(), options).map_err(|e| e.to_string())
}

fn parse(text: &str) -> PatchModel {
    parse_with(&WHOLE, text).unwrap_or_else(|e| panic!("{e}"))
}

/// The error of a text with one replacement.
fn broken(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    parse_with(&WHOLE, &text.replacen(from, to, 1)).unwrap_err()
}

/// A quarter of a cylinder of height 2, of degree 2 by 1.
const QUARTER: &str = "# a quarter\nv 1 0 0 1\nv 1 1 0 0.7071067811865476\nv 0 1 0 1\nv 1 0 2\nv 1 1 2 0.7071067811865476\nv 0 1 2\n\
    vt 0 0\nvn 0 0 1\no wall of a tower\ncstype rat bspline\ndeg 2 1\nsurf 0 1 2 4 1 2/1/1 -4 \\\n  -3 5//1 6\n\
    parm u 0 0 0 1 1 1\nparm v 2 2 4 4\nend\n";

#[test]
fn rational_surfaces_are_round() {
    let model = parse(QUARTER);
    assert_eq!(model.names, ["wall of a tower"]);
    assert!(model.is_bezier && model.notes.is_empty());
    let surface = &model.surfaces[0];
    assert_eq!(surface.domain(), [[0.0, 1.0], [2.0, 4.0]]);
    for u in [0.1, 0.5, 0.9] {
        let at = surface.frame(u, 3.0).unwrap().position;
        assert!((at.truncate().length() - 1.0).abs() < 1e-15 && at.z == 1.0);
    }
}

#[test]
fn weights_count_only_for_rat() {
    let model = parse(&QUARTER.replace("rat bspline", "bspline"));
    assert_eq!(model.surfaces[0].weights(), [1.0; 6]);
    let coloured = QUARTER
        .replace("v 0 1 2\n", "v 0 1 2 0.1 0.2 0.3\n")
        .replace("v 1 0 2\n", "v 1 0 2 1 0.2 0.3 0.4\n");
    assert_eq!(parse(&coloured).surfaces, parse(QUARTER).surfaces);
}

/// Two cubic segments in u, one linear in v.
fn bezier() -> String {
    let points = (0..14).map(|i| format!("v {} {} {}\n", i % 7, i / 7, (i % 7) * (i % 7)));
    let controls = (1..=14).map(|i| i.to_string()).collect::<Vec<_>>().join(" ");
    let vertices = points.collect::<String>();
    format!(
        "{vertices}cstype bezier\ndeg 3 1\nctech cparm 1 2\nsurf 0 3 0 1 {controls}\nparm u 0 1 3\nparm v 0 1\nend\n"
    )
}

#[test]
fn bezier_segments_become_one_surface_with_repeated_knots() {
    let model = parse(&bezier());
    assert_eq!((model.names[0].as_str(), model.is_bezier), ("patch 1", false));
    let surface = &model.surfaces[0];
    assert_eq!(surface.knots()[0], [0., 0., 0., 0., 1., 1., 1., 3., 3., 3., 3.]);
    assert_eq!(surface.frame(1.0, 0.0).unwrap().position.to_array(), [3.0, 0.0, 9.0]);
    assert!(model.notes.iter().any(|note| note.text.contains("ctech (1)")));
    let one = bezier()
        .replace(
            "surf 0 3 0 1 1 2 3 4 5 6 7 8 9 10 11",
            "surf 0 3 0 1 1 2 3 4 8 9 10 11 #",
        )
        .replace("0 1 3", "0 3");
    assert!(parse(&one).is_bezier);
    let of = |from: &str, to: &str| broken(&bezier(), from, to);
    assert!(
        of("parm u 0 1 3", "parm u 0 3")
            .contains("line 18: there are 14 control points; knots and degrees ask for 4 x 2")
    );
    assert!(of("parm u 0 1 3", "parm u 0 1 1").contains("line 19: the parameter 1 is not above the one before it, 1"));
    assert!(of("parm u 0 1 3", "parm u 0").contains("line 19: a Bézier surface needs at least 2 parameters, found 1"));
}

#[test]
fn knots_degrees_points_and_weights_are_checked() {
    let of = |from: &str, to: &str| broken(QUARTER, from, to);
    let falling = of("parm u 0 0 0 1 1 1", "parm u 0 0 0 1 0.5 1");
    assert!(
        falling.starts_with("a.obj: line 15: knot 4 in u is 0.5, less than the knot before it, 1"),
        "{falling}"
    );
    assert!(
        of("parm v 2 2 4 4", "parm v 2 2 4").contains("line 16: there are 3 knots in v; degree 1 needs at least 4")
    );
    assert!(
        of("parm v 2 2 4 4", "parm v 2 2 3 4 4")
            .contains("line 13: there are 6 control points; knots and degrees ask for 3 x 3")
    );
    assert!(of("parm v 2 2 4 4", "parm v 2 2 nan 4").contains("line 16: parm is NaN"));
    assert!(of("parm v 2 2 4 4", "parm v 2 2 four 4").contains("line 16: 'four' after 'parm' is no number"));
    assert!(of("parm v 2 2 4 4", "parm w 2 2 4 4").contains("line 16: expected 'parm u' or 'parm v'"));
    assert!(of("parm v 2 2 4 4", "parm u 2 2 4 4").contains("line 16: 'parm u' is there twice"));
    assert!(of("parm v 2 2 4 4\n", "").contains("line 13: this surface has no 'parm v'"));
    assert!(of("deg 2 1", "deg 8 1").contains("line 12: the degree in u is 8; expected 1 to 7"));
    assert!(of("deg 2 1", "deg 2").contains("line 12: a surface needs two degrees"));
    assert!(of("deg 2 1", "deg 2 -1").contains("line 12: '-1' after 'deg' is no degree"));
    assert!(of("deg 2 1\n", "").contains("line 12: there is no 'deg' before"));
    assert!(of("5//1 6", "5//1 7").contains("line 13: control point 7 is out of range: there are 6"));
    assert!(of("5//1 6", "5//1 0").contains("line 13: control point 0 is out of range"));
    assert!(
        of("v 1 1 0 0.7071067811865476", "v 1 1 0 0")
            .contains("line 3: the weight of this vertex is 0; the surface of line 13")
    );
    assert!(of("v 1 1 0 0.7071067811865476", "v 1 1 0 -2").contains("line 3: the weight of this vertex is -2"));
    assert!(of("v 1 1 0 0.7071067811865476", "v 1 1 0 nan").contains("line 3: v is NaN"));
    assert!(of("v 1 1 0 0.7", "v 1e20 1 0 0.7").contains("line 3: v is 1"));
}

#[test]
fn statements_out_of_place_name_their_line() {
    let of = |from: &str, to: &str| broken(QUARTER, from, to);
    assert!(of("end\n", "").contains("line 13: the file ends before the 'end' of this statement"));
    assert!(of("end\n", "end\nend\n").contains("line 18: 'end' without"));
    assert!(
        of("end\n", "surf 0 1 0 1 1\nend\n").contains("line 17: the statement of line 13 has no 'end' before this one")
    );
    assert!(of("deg 2 1", "parm u 0 1").contains("line 12: 'parm' stands outside"));
    assert!(of("cstype rat bspline\n", "").contains("line 12: there is no 'cstype' before this surface"));
    let cardinal = of("rat bspline", "cardinal");
    assert!(
        cardinal.contains("line 11: 'cardinal' surfaces are not read; expected bezier or bspline"),
        "{cardinal}"
    );
    assert!(of("rat bspline", "rational bspline").contains("line 11: expected 'cstype'"));
    assert!(of("surf 0 1 2 4", "surf 0 1 x 4").contains("line 13: 'x' after 'surf' is no number"));
    assert!(
        parse_with(&WHOLE, "v 0 0 0\n")
            .unwrap_err()
            .contains("a.obj: it has no free-form surfaces")
    );
}

#[test]
fn parts_of_surfaces_are_refused() {
    let of = |to: &str| broken(QUARTER, "surf 0 1 2 4", to);
    let part = of("surf 0.25 1 2 4");
    assert!(
        part.contains("line 13: from 0.25 to 1 in u, where 'parm' gives 0 to 1: parts of surfaces are not read"),
        "{part}"
    );
    assert!(of("surf 0 1 2 4.5").ends_with("line 13: from 2 to 4.5 in v, where 'parm' gives 2 to 4"));
    assert!(of("surf 1 0 2 4").ends_with("from 1 to 0 in u, where 'parm' gives 0 to 1"));
    let rounded = QUARTER.replace("surf 0 1 2 4", "surf 1e-12 1 2 3.9999999999");
    assert_eq!(parse(&rounded).surfaces, parse(QUARTER).surfaces);
}

#[test]
fn trimming_curves_are_refused_or_ignored() {
    let curve =
        "vp 0.1 0.1\nvp 0.9 0.1\ncstype bezier\ndeg 1\ncurv2 1 2\nparm u 0 1\nend\ncstype rat bspline\ndeg 2 1\nsurf";
    let text = QUARTER.replace("surf", curve).replace("end\no", "end\n");
    for keyword in ["trim", "hole"] {
        let (head, tail) = text.rsplit_once("end").unwrap();
        let trimmed = format!("{head}{keyword} 0 1 1\nend{tail}");
        let refused = parse_with(&WHOLE, &trimmed).unwrap_err();
        assert!(
            refused.contains(&format!("line 26: '{keyword}': untrimmed surfaces only")),
            "{refused}"
        );
        let model = parse_with(&TRIMS, &trimmed).unwrap();
        assert_eq!(model.surfaces, parse(QUARTER).surfaces);
        let notes = model
            .notes
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join("\n");
        assert!(
            notes.contains("warning: a.obj: surfaces whose trimming curves are ignored, drawn whole: 1"),
            "{notes}"
        );
        assert!(notes.contains("statements that are not read: curv2 (1)"), "{notes}");
    }
    let outside = parse_with(&TRIMS, &format!("trim 0 1 1\n{QUARTER}")).unwrap_err();
    assert!(outside.contains("line 1: 'trim' stands outside a surface"));
}

#[test]
fn polygons_and_surfaces_in_one_file_are_refused() {
    let mixed = parse_with(&WHOLE, &format!("{QUARTER}f 1 2 3\n")).unwrap_err();
    assert!(
        mixed.contains("line 18: polygons and free-form surfaces in one file; split it"),
        "{mixed}"
    );
    let folder = std::env::temp_dir().join(format!("keyleaf-patch-mesh-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("a.obj");
    std::fs::write(&file, QUARTER).unwrap();
    let mesh = crate::read_model(&file, &crate::ModelOptions::default())
        .unwrap_err()
        .to_string();
    assert!(mesh.contains("read it as Patches, not as a Mesh"), "{mesh}");
    std::fs::remove_dir_all(folder).unwrap();
}
