//! Opening models as control meshes: what is found, posed, passed on and refused.

use std::path::PathBuf;

use super::*;
use crate::scene::{CameraPath, ShapeName};
use crate::{OpenOptions, OpenedScene, open};

const TETRAHEDRON: &str = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
const COVARIANCES: &str = "covariances 4\n1 0 0 1 0 1\n1 0 0 1 0 1\n1 0 0 1 0 1\n1 0 0 1 0 0.25\n";

/// A folder with a tetrahedron and what belongs to it, removed when done.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("keyleaf-cage-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let this = Self(folder);
        this.write("a.obj", TETRAHEDRON);
        this.write("up.obj", &TETRAHEDRON.replace("v 1 1 1\n", "v 1 2 1\n"));
        this.write("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        this.write("a.cov", COVARIANCES);
        image::RgbImage::new(2, 2).save(this.0.join("clay.png")).unwrap();
        this
    }

    fn write(&self, file: &str, text: &str) {
        std::fs::write(self.0.join(file), text).unwrap();
    }

    /// Opens a scene of the tetrahedron with these fields.
    fn open(&self, fields: &str) -> Result<OpenedScene, String> {
        let text = format!("(surfaces: [(name: \"a\", source: Mesh(\"a.obj\"),\n {fields})])");
        self.write("s.ron", &text);
        open(&self.0.join("s.ron"), &OpenOptions::default()).map_err(|e| e.to_string())
    }

    fn error(&self, fields: &str) -> String {
        self.open(fields).map(|_| ()).unwrap_err()
    }

    /// What is made of the entry before the surface itself.
    fn entry(&self, fields: &str) -> SurfaceEntry {
        let text = format!("(surfaces: [(name: \"a\", source: Mesh(\"a.obj\"), {fields})])");
        crate::Scene::from_ron(&text, Path::new("s.ron"))
            .unwrap()
            .surfaces
            .remove(0)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn patches_of_triangles_are_made_and_keep_their_cage() {
    let folder = Folder::new("triangles");
    for shape in ["Qas()", "Qas(variant: Interpolating)", "PnTriangles"] {
        let opened = folder
            .open(&format!("surface: {shape}, material: (matcap: \"clay.png\")"))
            .unwrap();
        let surface = &opened.surfaces[0];
        assert_eq!(surface.cage.as_ref().unwrap().control.mesh.positions.len(), 4);
        assert!(surface.material.matcap.is_some() && surface.material.texture.is_none());
        assert_eq!(surface.files.len(), 2, "{:?}", surface.files);
        let corner = surface.surface.point(surface.surface.face_coord(0, 0.0, 0.0).unwrap());
        let is_kept = (corner - DVec3::ONE).length() < 1e-12;
        assert_eq!(is_kept, shape != "Qas()", "{shape}: {corner}");
    }
}

#[test]
fn a_moving_surface_is_made_as_it_is_at_time_zero() {
    let folder = Folder::new("moving");
    let motion = "motion: Keys([Blend(path: \"up.obj\", keys: [(time: 0, weight: 0.5), (time: 1)]), \
        Group(name: \"all\", vertices: [(0, 3)], keys: [(time: 0), (time: 1, translation: (0, 0, 3))])])";
    let opened = folder.open(&format!("surface: PnTriangles, {motion}")).unwrap();
    let surface = &opened.surfaces[0];
    let point = surface.surface.point(surface.surface.face_coord(0, 0.0, 0.0).unwrap());
    assert!((point - DVec3::new(1.0, 1.5, 1.0)).length() < 1e-12, "{point}");
    let cage = surface.cage.as_ref().unwrap();
    assert!((cage.pose(1.0)[0] - DVec3::new(1.0, 1.0, 4.0)).length() < 1e-12);
    assert!(cage.pose_covariances(1.0).is_none());
    assert!(surface.files.iter().any(|file| file.ends_with("up.obj")));
}

#[test]
fn a_surface_that_follows_from_its_vertices_allows_for_all_poses_and_is_made_of_each() {
    let folder = Folder::new("poses");
    let motion = "motion: Keys([Group(name: \"all\", vertices: [(0, 3)], \
        keys: [(time: 0), (time: 1, translation: (0, 0, 3)), (time: 2)])])";
    for shape in ["Loop()", "Qas()", "Qas(variant: Interpolating)", "PnTriangles"] {
        let opened = folder.open(&format!("surface: {shape}, {motion}")).unwrap();
        let rest = &opened.surfaces[0].surface;
        let posed = opened.surfaces[0].cage.as_ref().unwrap().surface_at(1.0).unwrap();
        assert!(
            rest.pose_shader().is_some() && rest.pose_shader() == posed.pose_shader(),
            "{shape}"
        );
        let at = rest.face_coord(1, 0.25, 0.5).unwrap();
        let moved = posed.point(at) - rest.point(at);
        assert!((moved - DVec3::new(0.0, 0.0, 3.0)).length() < 1e-9, "{shape}: {moved}");
        for surface in [rest, &posed] {
            let (low, high) = surface.bounding_box();
            assert!(
                low.z < rest.point(at).z && high.z > posed.point(at).z,
                "{shape}: {low} {high}"
            );
        }
    }
}

#[test]
fn what_the_scene_says_of_sharpness_counts_before_the_file() {
    let folder = Folder::new("sharpness");
    folder.write(
        "a.obj",
        &format!("{TETRAHEDRON}t crease 2/1/0 0 1 3\nt interpolateboundary 1/0/0 1\n"),
    );
    let entry = folder.entry(
        "surface: CatmullClark(sharpness: (creasing: Chaikin, creases: [(1, 0, 2.5), (2, 3, 10)], corners: [(3, 1)]))",
    );
    let model = read_control_mesh(&folder.0.join("a.obj"), &options(&folder.0, &entry)).unwrap();
    let mut control = model.control;
    sharpen(Path::new("a.obj"), &mut control, sharpness(&entry.surface).unwrap()).unwrap();
    let creases: Vec<f64> = control.creases.iter().map(|crease| crease.sharpness).collect();
    assert_eq!((creases, control.corners.len()), (vec![2.5, 10.0], 1));
    assert_eq!(control.boundary, keyleaf_surface::BoundaryRule::EdgesAndCorners);
    assert_eq!(control.creasing, keyleaf_surface::Creasing::Chaikin);
    let out = folder.error("surface: Loop(sharpness: (corners: [(0, 1), (4, 1)]))");
    assert!(
        out.contains("s.ron:2:27: surfaces[0].surface.sharpness: ") && out.contains("corners[1]: vertex of a corner"),
        "{out}"
    );
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let none = folder.error("surface: CatmullClark(sharpness: (creases: [(0, 2, 1)]))");
    assert!(
        none.contains("creases[0]: the crease from vertex 0 to vertex 2, counted from 0, is no edge"),
        "{none}"
    );
}

/// The covariances that a scene's entry gets.
fn covariances_of(folder: &Folder, fields: &str, notes: &mut Vec<Note>) -> Result<Vec<[f64; 6]>, String> {
    let entry = folder.entry(&format!("surface: GaussianProduct({fields})"));
    let Shape::GaussianProduct(shape) = &entry.surface else {
        panic!()
    };
    let file = folder.0.join("a.obj");
    let read = read_control_mesh(&file, &options(&folder.0, &entry)).map_err(|e| e.to_string())?;
    covariances(&file, &read.control, read.covariances, shape, notes).map_err(|e| e.source.to_string())
}

#[test]
fn covariances_come_from_files_or_from_the_mesh() {
    let folder = Folder::new("covariances");
    let of = |fields: &str| covariances_of(&folder, fields, &mut Vec::new());
    assert_eq!(of("").unwrap()[3], [1.0, 0.0, 0.0, 1.0, 0.0, 0.25]);
    assert_eq!(of("covariances: File(\"a.cov\")").unwrap(), of("").unwrap());
    let deviation = 0.5 * 8f64.sqrt();
    let round = of("covariances: Isotropic(0.5)").unwrap();
    assert!(
        round
            .iter()
            .all(|c| (c[0] - deviation * deviation).abs() < 1e-12 && c[1] == 0.0)
    );
    assert_eq!(of("covariances: FromNormals()").unwrap().len(), 4);
    let error = of("covariances: File(\"b.cov\")").unwrap_err();
    assert!(error.contains("b.cov: cannot be read"), "{error}");
}

#[test]
fn covariances_that_are_too_flat_are_made_rounder_or_refused() {
    let folder = Folder::new("flat");
    folder.write("a.cov", &COVARIANCES.replace("0.25", "-1"));
    let mut notes = Vec::new();
    let made = covariances_of(&folder, "", &mut notes).unwrap();
    assert!(made[3][5] > 0.0 && notes.len() == 1, "{made:?} {notes:?}");
    assert!(notes[0].text.contains("1, the first at vertex 3"), "{}", notes[0]);
    let error = covariances_of(&folder, "strict: true", &mut Vec::new()).unwrap_err();
    assert!(error.contains("the covariance of vertex 3 is none"), "{error}");
}

#[test]
fn what_does_not_fit_names_scene_field_and_file() {
    let folder = Folder::new("errors");
    let check = |fields: &str, expected: &[&str]| {
        let error = folder.error(fields);
        for part in expected {
            assert!(error.contains(part), "{error}");
        }
    };
    let blend =
        |path: &str| format!("surface: PnTriangles, motion: Keys([Blend(path: \"{path}\", keys: [(time: 0)])])");
    check(
        &blend("few.obj"),
        &["surfaces[0].motion[0].path: ", "has 3 vertices, the mesh has 4"],
    );
    check(
        &blend("no.obj"),
        &["surfaces[0].motion[0].path: ", "no.obj: cannot be read"],
    );
    check(
        "surface: PnTriangles, motion: Keys([Group(name: \"arm\", vertices: [(2, 4)])])",
        &["s.ron:2:32: surfaces[0].motion: group 'arm' has the vertices 2 to 4"],
    );
    check(
        "surface: PnTriangles, material: (matcap: \"no.png\")",
        &["surfaces[0].material.matcap: ", "no.png: cannot be read"],
    );
    check(
        "surface: GaussianProduct(covariances: File(\"no.cov\"))",
        &["surfaces[0].surface.covariances: ", "no.cov: cannot be read"],
    );
    std::fs::remove_file(folder.0.join("a.cov")).unwrap();
    check(
        "surface: GaussianProduct()",
        &["surfaces[0].source: ", "expected the file a.cov beside it"],
    );
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    check("surface: Qas()", &["surfaces[0].surface: ", "face 0 has 4 corners"]);
}

#[test]
fn models_open_directly_as_the_shape_that_is_asked_for() {
    let folder = Folder::new("direct");
    let open_as = |file: &str, shape: ShapeName| {
        let options = OpenOptions {
            shape: Some(shape),
            ..OpenOptions::default()
        };
        open(&folder.0.join(file), &options).map_err(|e| e.to_string())
    };
    for shape in [ShapeName::Flat, ShapeName::Qas, ShapeName::PnTriangles] {
        let opened = open_as("a.obj", shape).unwrap();
        assert_eq!(opened.scene.surfaces[0].surface, Shape::from(shape));
        assert!(opened.path(None).is_some_and(|path: &CameraPath| path.keys.len() > 1));
        folder.write("again.ron", &opened.scene.to_ron().unwrap());
        let again = open(&folder.0.join("again.ron"), &OpenOptions::default()).unwrap();
        assert_eq!(again.scene, opened.scene);
    }
    std::fs::write(folder.0.join("map.r16"), [0u8; 32]).unwrap();
    let error = open_as("map.r16", ShapeName::Loop).unwrap_err();
    assert!(
        error.contains("map.r16: only a model of polygons can be drawn as Loop"),
        "{error}"
    );
    folder.write("few.cov", "covariances 2\n");
    let error = open_as("few.obj", ShapeName::GaussianProduct).unwrap_err();
    assert!(
        error.contains("few.cov: line 1: the header says 2 vertices, the model has 3"),
        "{error}"
    );
}
