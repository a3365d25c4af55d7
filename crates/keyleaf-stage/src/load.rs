//! From what a user points at to surfaces with settings and looks. Needs no GPU.

use crate::stage::{colour, look_of, world_box};
use glam::{DAffine3, DVec3, UVec2, Vec3};
use keyleaf::draw::{ColourTexture, Look};
use keyleaf::shading::{Material, Shading};
use keyleaf::{BackFaces, Metric, Morph, Pairs, Projection, Settings, Threshold, View};
use keyleaf_scene::scene::{CameraPath, Colouring, Culling, Effect, NamedCamera};
use keyleaf_scene::{ControlCage, OpenError, OpenOptions, OpenedScene, OpenedSurface, PoseError, Scene};
use keyleaf_surface::Surface;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a scene file cannot say of a file that is opened directly.
pub type LoadOptions = OpenOptions;

/// Why something cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// A file is missing, malformed, or says what cannot be.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// There is no camera of that name.
    #[error("no camera {name:?} in this scene; there are: {known}")]
    NoCamera {
        /// Asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A pose of a moving surface that cannot be.
    #[error("surface {name}: {source}")]
    Pose {
        /// The surface.
        name: String,
        /// What is wrong.
        source: PoseError,
    },
    /// There is no path of that name.
    #[error("no camera path {name:?} in this scene; there are: {known}")]
    NoPath {
        /// Asked for.
        name: String,
        /// The names there are.
        known: String,
    },
}

/// A scene with the surfaces that it names.
#[derive(Clone)]
pub struct Loaded {
    /// What was opened.
    pub file: PathBuf,
    /// The scene; for a model or height map, one that shows it.
    pub scene: Scene,
    /// Its surfaces.
    pub objects: Vec<LoadedObject>,
    /// What was noted on the way.
    pub notes: Vec<String>,
    /// The files that the surfaces come from, for a program that watches them.
    pub files: Vec<PathBuf>,
    /// World box of all surfaces.
    pub bounds: (DVec3, DVec3),
}

/// One surface with its settings and look.
#[derive(Clone)]
pub struct LoadedObject {
    /// Its name in the scene.
    pub name: String,
    /// The evaluator; of a moving control mesh as it is at time 0.
    pub surface: Arc<dyn Surface>,
    /// The control mesh, if it is the surface of one.
    pub cage: Option<Arc<ControlCage>>,
    /// Where it stands.
    pub world_from_object: DAffine3,
    /// What the scene says of its refinement.
    pub settings: Settings,
    /// How its colour comes about.
    pub material: Material,
    /// Attributes of corners, and the base-colour texture.
    pub look: Look,
    /// Linear.
    pub base_colour: [f32; 3],
    /// By height and slope, in object space.
    pub colouring: Colouring,
}

/// Opens a scene file, a model or a height map.
///
/// # Errors
/// [`LoadError::Open`] names file, place and reason.
pub fn load(file: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    Ok(prepare(keyleaf_scene::open(file, options)?))
}

/// Loads a scene that was made or changed in code; `file` names it, its folder is where relative paths begin.
///
/// # Errors
/// [`LoadError::Open`] names the field, or the file that is refused.
pub fn load_scene(scene: Scene, file: &Path) -> Result<Loaded, LoadError> {
    Ok(prepare(
        keyleaf_scene::load_scene(scene, file).map_err(OpenError::from)?,
    ))
}

fn prepare(opened: OpenedScene) -> Loaded {
    let files = opened.surfaces.iter().flat_map(|s| s.files.iter().cloned()).collect();
    let mut objects: Vec<LoadedObject> = opened.surfaces.into_iter().map(object).collect();
    let boxes = objects
        .iter()
        .map(|o| world_box(o.surface.bounding_box(), &o.world_from_object));
    let bounds = boxes.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |all, one| {
        (all.0.min(one.0), all.1.max(one.1))
    });
    let mut notes: Vec<String> = opened.notes.iter().map(ToString::to_string).collect();
    notes.extend(objects.iter_mut().filter_map(refine_gaps));
    Loaded {
        file: opened.file,
        scene: opened.scene,
        objects,
        notes,
        files,
        bounds,
    }
}

/// How much finer the boundaries of a model are drawn than the rest, where some lie along others that they could not be joined with.
const GAP_OVERSAMPLING: f32 = 4.0;

/// Oversamples the boundaries of a model with gaps (Concheiro 6.10, the boundary region), and says so.
fn refine_gaps(object: &mut LoadedObject) -> Option<String> {
    let gaps = object.surface.as_patches()?.report().gaps();
    let Metric::Edge { pixels } = object.settings.metric else {
        return None;
    };
    let boundary_pixels = pixels / GAP_OVERSAMPLING;
    (gaps > 0).then(|| {
        object.settings.metric = Metric::Boundary {
            pixels,
            boundary_pixels,
        };
        format!(
            "note: surface {}: {gaps} boundaries lie along others that they could not be joined with; edges at open boundaries are \
             refined to {boundary_pixels} pixels (metric boundary)",
            object.name
        )
    })
}

fn object(opened: OpenedSurface) -> LoadedObject {
    let has_corners = opened.corners.normals.is_some() || opened.corners.colours.is_some();
    let material = match (&opened.colouring, &opened.material.texture) {
        (Colouring::Terrain(_), _) => Material::Terrain,
        _ if opened.material.matcap.is_some() => Material::Matcap,
        (_, Some(_)) => Material::Texture,
        _ if has_corners => Material::Attributes,
        _ => Material::Plain,
    };
    let picture = opened.material.matcap.as_ref().or(opened.material.texture.as_ref());
    let texture = picture.map(|picture| ColourTexture {
        width: picture.width,
        height: picture.height,
        rgba: picture.rgba.clone(),
    });
    let uses_corners = matches!(material, Material::Texture | Material::Attributes | Material::Matcap);
    let [red, green, blue, _] = opened.material.base_colour;
    let moving = opened.cage.as_ref().is_some_and(|cage| cage.motion.is_some());
    LoadedObject {
        look: look_of(
            opened.surface.topology(),
            uses_corners.then_some(&opened.corners),
            texture,
        ),
        settings: Settings {
            moving,
            ..settings(&opened.settings)
        },
        cage: opened.cage,
        name: opened.name,
        surface: opened.surface,
        world_from_object: DAffine3::from_mat4(opened.world_from_object),
        material,
        base_colour: [red, green, blue],
        colouring: opened.colouring,
    }
}

/// The settings of a scene file as the library takes them.
pub fn settings(scene: &keyleaf_scene::scene::Settings) -> Settings {
    use keyleaf_scene::scene;
    use keyleaf_scene::scene::{Metric as Wanted, Threshold as WantedThreshold};
    let of = |threshold| match threshold {
        WantedThreshold::Units(value) => Threshold::Units(value as f32),
        WantedThreshold::Pixels(value) => Threshold::Pixels(value as f32),
    };
    Settings {
        metric: match scene.metric {
            Wanted::Edge { pixels } => Metric::Edge { pixels: pixels as f32 },
            Wanted::Distance { factor } => Metric::Distance { factor: factor as f32 },
            Wanted::Deviation { pixels } => Metric::Deviation { pixels: pixels as f32 },
            Wanted::Boundary {
                pixels,
                boundary_pixels,
            } => Metric::Boundary {
                pixels: pixels as f32,
                boundary_pixels: boundary_pixels as f32,
            },
            Wanted::LocalArea { pixels } => Metric::LocalArea { pixels: pixels as f32 },
            Wanted::LinearApproximation { pixels } => Metric::LinearApproximation { pixels: pixels as f32 },
            Wanted::DistanceTest(threshold) => Metric::DistanceTest(of(threshold)),
            Wanted::FlatTest(threshold) => Metric::FlatTest(of(threshold)),
            Wanted::LengthTest(threshold) => Metric::LengthTest(of(threshold)),
        },
        base_grid: scene.base_grid,
        capacity: scene.capacity,
        settle: scene.settle,
        target_leaves: scene.target_leaves.unwrap_or(0),
        max_level: scene.deepest_level(),
        guard_band: scene.guard_band.margin as f32,
        guard_factor: (1.0 / scene.guard_band.coarsen) as f32,
        cull: scene.culling == Culling::Frustum,
        back_faces: match scene.back_faces {
            scene::BackFaces::Drawn => BackFaces::Drawn,
            scene::BackFaces::Hidden => BackFaces::Hidden,
            scene::BackFaces::Leaves => BackFaces::Leaves,
            scene::BackFaces::Light => BackFaces::Light,
            scene::BackFaces::Strong => BackFaces::Strong,
            scene::BackFaces::Conservative => BackFaces::Conservative,
        },
        morph: match scene.morph {
            scene::Morph::None => Morph::None,
            scene::Morph::Geomorph => Morph::Geomorph,
        },
        pairs: match scene.pairs {
            scene::Pairs::Forced => Pairs::Forced,
            scene::Pairs::Wished => Pairs::Wished,
        },
        ..Settings::default()
    }
}

/// A camera for a picture of `size` pixels.
pub fn view_of(camera: &keyleaf_scene::View, size: UVec2) -> View {
    View {
        eye: camera.eye,
        orientation: camera.orientation(),
        projection: Projection::Perspective {
            fov_y: camera.fov.to_radians(),
            near: camera.near,
        },
        viewport: size,
    }
}

impl Loaded {
    /// A camera by its name, or the first one.
    ///
    /// # Errors
    /// [`LoadError::NoCamera`] lists the names there are.
    pub fn camera(&self, name: Option<&str>) -> Result<&NamedCamera, LoadError> {
        let all = &self.scene.cameras;
        all.iter()
            .find(|c| name.is_none_or(|name| c.name == name))
            .ok_or_else(|| LoadError::NoCamera {
                name: name.unwrap_or_default().to_owned(),
                known: names(all.iter().map(|c| c.name.as_str())),
            })
    }

    /// A camera path by its name, or the first one.
    ///
    /// # Errors
    /// [`LoadError::NoPath`] lists the names there are.
    pub fn path(&self, name: Option<&str>) -> Result<&CameraPath, LoadError> {
        let all = &self.scene.paths;
        all.iter()
            .find(|p| name.is_none_or(|name| p.name == name))
            .ok_or_else(|| LoadError::NoPath {
                name: name.unwrap_or_default().to_owned(),
                known: names(all.iter().map(|p| p.name.as_str())),
            })
    }

    /// Puts moving surfaces where they are at a time in seconds.
    ///
    /// # Errors
    /// [`LoadError::Pose`] if the pose of one has no surface.
    pub fn pose(&mut self, time: f64) -> Result<(), LoadError> {
        for object in &mut self.objects {
            if let Some(cage) = object.cage.as_ref().filter(|cage| cage.motion.is_some()) {
                let posed = cage.surface_at(time);
                object.surface = posed.map_err(|source| LoadError::Pose {
                    name: object.name.clone(),
                    source,
                })?;
            }
        }
        Ok(())
    }

    /// The view of a camera by its name, or of the first one.
    ///
    /// # Errors
    /// [`LoadError::NoCamera`].
    pub fn view(&self, camera: Option<&str>, size: UVec2) -> Result<View, LoadError> {
        Ok(view_of(&keyleaf_scene::View::from(self.camera(camera)?), size))
    }

    /// The views of a path at a fixed step of time, in seconds.
    ///
    /// # Errors
    /// [`LoadError::NoPath`].
    pub fn path_views(&self, path: Option<&str>, step: f64, size: UVec2) -> Result<Vec<View>, LoadError> {
        Ok(self
            .path(path)?
            .frames(step)
            .map(|frame| view_of(&frame.view, size))
            .collect())
    }

    /// The light of the scene, without what a surface adds.
    pub(crate) fn shading(&self) -> Shading {
        let light = &self.scene.light;
        let fog = self.scene.effects.iter().find_map(|effect| {
            if let Effect::Fog(fog) = effect {
                Some(*fog)
            } else {
                None
            }
        });
        let mut shading = Shading {
            sun_direction: light.direction().as_vec3(),
            sun_colour: colour(light.colour),
            ambient: colour(light.ambient),
            exposure: light.exposure,
            ..Shading::default()
        };
        if let Some(fog) = fog {
            // Half of the colour is the fog's at this distance.
            shading.fog_density = (std::f64::consts::LN_2 / fog.distance) as f32;
            shading.fog_colour = colour(fog.colour);
        }
        shading
    }
}

impl LoadedObject {
    /// The light of the scene on this surface.
    pub(crate) fn shading(&self, light: Shading) -> Shading {
        let mut shading = Shading {
            base_colour: Vec3::from_array(self.base_colour),
            ..light
        };
        if let Colouring::Terrain(colours) = &self.colouring {
            let scale = self.world_from_object.matrix3.y_axis.y;
            let world = |height: f64| (height * scale + self.world_from_object.translation.y) as f32;
            let bounds = self.surface.bounding_box();
            let [lowest, highest] = colours.heights.unwrap_or([bounds.0.y, bounds.1.y]);
            shading.lowest = world(lowest);
            shading.highest = world(highest);
            shading.snow_line = colours.snow_line.map_or(f32::MAX, world);
            [shading.gentle, shading.steepest] = colours.slopes.map(|degrees| degrees.to_radians().tan() as f32);
            shading.low = colour(colours.low);
            shading.high = colour(colours.high);
            shading.steep = colour(colours.steep);
            shading.snow = colour(colours.snow);
        }
        shading
    }
}

fn names<'a>(all: impl Iterator<Item = &'a str>) -> String {
    let list: Vec<&str> = all.collect();
    if list.is_empty() {
        "none".to_owned()
    } else {
        list.join(", ")
    }
}
