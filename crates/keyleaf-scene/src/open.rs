//! Opens what a user points at: a scene file, a model, a file of patches, or a height map; everything that it refers to is read.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DVec3};
use keyleaf_surface::{CornerAttributes, Surface};
use thiserror::Error;

use crate::control_surfaces::ControlCage;
use crate::error::{FilePlace, ImportError, extension};
use crate::heightmap::is_height_map;
use crate::material::SurfaceMaterial;
use crate::model::is_model;
use crate::note::Note;
use crate::patch::is_patch_file;
use crate::scene::{
    CameraPath, Colouring, HeightFieldSource, Material, NamedCamera, PatchesSource, Problem, Scene, SceneError,
    Settings, Shape, ShapeName, Source, SurfaceEntry, Transform, reference,
};
use crate::surfaces::{self, Made};
use crate::view::Extent;

/// The file types that [`open`] knows, as an error lists them.
pub const OPEN_EXTENSIONS: &str = ".ron (scene); .obj, .gltf, .glb, .ply, .stl, .off (model); .bpt, .obj with 'surf', .teaset, .dat or no ending (patches); \
     .png, .tif, .tiff, .exr, .r16, .raw (height map)";

/// What a file that is opened directly cannot tell itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OpenOptions {
    /// Width and height in samples of a raw height map; `None`: a square one.
    pub raw_size: Option<[u32; 2]>,
    /// Trimmed NURBS surfaces are drawn whole; else they are refused.
    pub ignore_trims: bool,
    /// Knot spans of NURBS surfaces are cut so that knot-span quads become even ([`PatchesSource::even_spans`]).
    pub even_spans: bool,
    /// Z is up in the file: it is turned by -90 degrees about X.
    pub z_up: bool,
    /// The kind of surface that a model of polygons is the control mesh of; `None`: its polygons are drawn.
    pub shape: Option<ShapeName>,
}

/// A scene with all that it refers to.
#[derive(Debug)]
pub struct OpenedScene {
    /// The file that was opened.
    pub file: PathBuf,
    /// The scene, with at least one camera and one path. For a model, patches or a height map, the scene that shows it: its
    /// [`Scene::to_ron`] beside the file opens the same.
    pub scene: Scene,
    /// Its surfaces, in the order of [`Scene::surfaces`].
    pub surfaces: Vec<OpenedSurface>,
    /// What importers did.
    pub notes: Vec<Note>,
}

/// A surface, ready to be drawn.
#[derive(Clone)]
pub struct OpenedSurface {
    /// Its name in the scene.
    pub name: String,
    /// The surface, in object space.
    pub surface: Arc<dyn Surface>,
    /// Attributes of the corners, in the order of the half-edges of the surface's topology; none for patches,
    /// height fields and terrain.
    pub corners: CornerAttributes,
    /// Where it stands: a turn, an even scale and a move.
    pub world_from_object: DMat4,
    /// Base colour and picture: the model's, with what the scene says.
    pub material: SurfaceMaterial,
    /// Colours by shape, with heights and snow line resolved (object space).
    pub colouring: Colouring,
    /// The scene's settings with those of the surface.
    pub settings: Settings,
    /// The control mesh that it is the surface of, and how that moves; `surface` is as at time 0.
    pub cage: Option<Arc<ControlCage>>,
    /// The files that it comes from, for a program that watches them.
    pub files: Vec<PathBuf>,
}

impl std::fmt::Debug for OpenedSurface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let roots = self.surface.topology().half_edge_count();
        write!(
            f,
            "OpenedSurface({}, {}, {roots} roots)",
            self.name,
            self.surface.shader()
        )
    }
}

/// Why something cannot be opened.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The scene file, or something that it refers to.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A model, a file of patches or a height map that was opened directly.
    #[error(transparent)]
    Import(#[from] ImportError),
}

impl OpenedScene {
    /// How many roots the surfaces have together: the fewest leaves.
    pub fn root_count(&self) -> u64 {
        root_count(&self.surfaces)
    }

    /// A camera by its name, or the first one; `None` if there is no such name.
    pub fn camera(&self, name: Option<&str>) -> Option<&NamedCamera> {
        self.scene
            .cameras
            .iter()
            .find(|c| name.is_none_or(|name| c.name == name))
    }

    /// A path by its name, or the first one; `None` if there is no such name.
    pub fn path(&self, name: Option<&str>) -> Option<&CameraPath> {
        self.scene.paths.iter().find(|p| name.is_none_or(|name| p.name == name))
    }
}

fn root_count(surfaces: &[OpenedSurface]) -> u64 {
    surfaces
        .iter()
        .map(|s| u64::from(s.surface.topology().half_edge_count()))
        .sum()
}

/// Opens a scene file, a model, a file of patches or a height map; the ending of its name tells which, and for .obj files and files
/// without an ending their content ([`is_patch_file`]).
///
/// Coordinates stay as the file has them, with Y up; with [`OpenOptions::z_up`] the surface of a file that is opened directly stands
/// turned by -90 degrees about X. A scene file gives its own [`Transform`].
///
/// # Errors
/// [`OpenError`] names file, place and reason; a scene also line, column and field.
///
/// ```
/// use keyleaf_scene::{OpenOptions, open};
/// let error = open("cow.blend".as_ref(), &OpenOptions::default()).unwrap_err();
/// assert!(error.to_string().starts_with("cow.blend: unknown file type 'blend'"));
/// ```
pub fn open(file: &Path, options: &OpenOptions) -> Result<OpenedScene, OpenError> {
    if extension(file) == "ron" {
        let text = std::fs::read_to_string(file).map_err(|source| SceneError::Read {
            file: file.to_path_buf(),
            source,
        })?;
        let scene = Scene::from_ron(&text, file)?;
        return Ok(load(file, &text, scene)?);
    }
    if is_patch_file(file) {
        return open_directly(file, Opened::Patches, options);
    }
    if is_model(file) {
        return open_directly(file, Opened::Model, options);
    }
    if is_height_map(file) {
        return open_directly(file, Opened::HeightMap, options);
    }
    Err(OpenError::Import(ImportError::UnknownExtension {
        file: file.to_path_buf(),
        extension: extension(file),
        expected: OPEN_EXTENSIONS,
    }))
}

/// Reads what a scene refers to; `file` names it, its folder is where relative paths begin.
///
/// # Errors
/// [`SceneError::Invalid`] if a value is out of range, [`SceneError::Reference`] if a file is refused.
pub fn load_scene(scene: Scene, file: &Path) -> Result<OpenedScene, SceneError> {
    scene.validate(file)?;
    load(file, "", scene)
}

fn load(file: &Path, text: &str, mut scene: Scene) -> Result<OpenedScene, SceneError> {
    let mut notes = Vec::new();
    let mut made = Vec::new();
    for (index, entry) in scene.surfaces.iter().enumerate() {
        let surface = surfaces::make(file, entry, &mut notes).map_err(|failure| {
            let field = format!("surfaces[{index}].{}", failure.field);
            reference(file, text, field, failure.source)
        })?;
        made.push(surface);
    }
    let extent = extent(&scene, &made);
    if scene.cameras.is_empty() {
        scene.cameras.push(extent.camera());
    }
    if scene.paths.is_empty() {
        scene.paths.push(extent.path());
    }
    let surfaces: Vec<OpenedSurface> = scene
        .surfaces
        .iter()
        .zip(made)
        .map(|(entry, made)| finish(&scene, entry, made))
        .collect();
    let capacity = scene.settings.capacity;
    if let Some(short) = surfaces
        .iter()
        .find(|s| s.surface.topology().half_edge_count() > capacity)
    {
        let roots = short.surface.topology().half_edge_count();
        let problem = format!(
            "{capacity} leaves are too few: the surface {:?} has {roots} roots, which is the least",
            short.name
        );
        return Err(Problem::new("settings.capacity", problem).at(file, text));
    }
    Ok(OpenedScene {
        file: file.to_path_buf(),
        scene,
        surfaces,
        notes,
    })
}

fn finish(scene: &Scene, entry: &SurfaceEntry, made: Made) -> OpenedSurface {
    OpenedSurface {
        name: entry.name.clone(),
        surface: made.surface,
        corners: made.corners,
        world_from_object: entry.transform.matrix(),
        material: made.material,
        colouring: made.colouring,
        settings: scene.settings.with(&entry.settings),
        cage: made.cage,
        files: made.files,
    }
}

/// What the default views show: the ground if there is any, else everything.
fn extent(scene: &Scene, made: &[Made]) -> Extent {
    let is_ground = made.iter().any(|m| m.is_ground);
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (entry, made) in scene
        .surfaces
        .iter()
        .zip(made)
        .filter(|(_, m)| m.is_ground == is_ground)
    {
        let matrix = entry.transform.matrix();
        for corner in 0..8 {
            let pick = |axis: usize| {
                if corner >> axis & 1 == 0 {
                    made.shown.0
                } else {
                    made.shown.1
                }
            };
            let point = matrix.transform_point3(DVec3::new(pick(0).x, pick(1).y, pick(2).z));
            low = low.min(point);
            high = high.max(point);
        }
    }
    Extent { low, high, is_ground }
}

/// Leaves for each root, at least, in the capacity of a model that is opened directly.
const LEAVES_PER_ROOT: u64 = 4;

/// What a file is that is no scene.
#[derive(Clone, Copy, PartialEq)]
enum Opened {
    Model,
    Patches,
    HeightMap,
}

/// Turns Z up to Y up.
const Z_UP: Transform = Transform {
    translation: [0.0; 3],
    rotation: [-90.0, 0.0, 0.0],
    scale: 1.0,
};

fn source_of(name: String, opened: Opened, options: &OpenOptions) -> Source {
    match opened {
        Opened::Model => Source::Mesh(name),
        Opened::Patches => Source::Patches(PatchesSource {
            ignore_trims: options.ignore_trims,
            even_spans: options.even_spans,
            ..PatchesSource::new(name)
        }),
        Opened::HeightMap => Source::HeightField(HeightFieldSource {
            raw_size: options.raw_size,
            ..HeightFieldSource::new(name)
        }),
    }
}

fn open_directly(file: &Path, opened: Opened, options: &OpenOptions) -> Result<OpenedScene, OpenError> {
    let name = file
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    let stem = file.file_stem().map(|s| s.to_string_lossy().into_owned());
    let colouring = match opened {
        Opened::HeightMap => Colouring::Terrain(Default::default()),
        Opened::Model | Opened::Patches => Colouring::Plain,
    };
    let shape = options.shape.map_or(Shape::Flat, Shape::from);
    if opened != Opened::Model && shape != Shape::Flat {
        let reason = format!("only a model of polygons can be drawn as {}", shape.name());
        return Err(ImportError::unsupported(file, FilePlace::Whole, reason).into());
    }
    let transform = if options.z_up { Z_UP } else { Transform::default() };
    let mut entry = SurfaceEntry {
        name: stem.filter(|s| !s.trim().is_empty()).unwrap_or("surface".into()),
        source: source_of(name, opened, options),
        surface: shape,
        motion: Default::default(),
        transform,
        material: Material {
            colouring,
            ..Material::default()
        },
        settings: Default::default(),
    };
    let mut notes = Vec::new();
    let made = surfaces::make(file, &entry, &mut notes).map_err(|failure| failure.without_scene(file))?;
    if let (Source::HeightField(map), Some(spacing)) = (&mut entry.source, made.spacing) {
        map.spacing = Some(spacing);
    }
    let roots = u64::from(made.surface.topology().half_edge_count());
    let mut settings = Settings::default();
    let capacity = (LEAVES_PER_ROOT * roots).max(settings.capacity.into());
    settings.capacity = u32::try_from(capacity).unwrap_or(u32::MAX);
    let mut scene = Scene {
        surfaces: vec![entry],
        settings,
        light: Default::default(),
        effects: Scene::default_effects(),
        cameras: Vec::new(),
        paths: Vec::new(),
    };
    let made = [made];
    let extent = extent(&scene, &made);
    scene.cameras.push(extent.camera());
    scene.paths.push(extent.path());
    let surfaces = made
        .into_iter()
        .map(|made| finish(&scene, &scene.surfaces[0], made))
        .collect();
    Ok(OpenedScene {
        file: file.to_path_buf(),
        scene,
        surfaces,
        notes,
    })
}

#[cfg(test)]
#[path = "open_tests.rs"]
mod tests;
