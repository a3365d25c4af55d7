//! Makes the surface of a scene's entry: reads its files and hands them to `keyleaf-surface`.

use std::borrow::Cow;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use keyleaf_surface::{
    CornerAttributes, DisplacedNoise, DisplacedTexture, HeightField, HeightFieldSettings, Mesh, NoiseDisplacement,
    PolygonMesh, Surface, Terrain, TerrainSettings, TextureDisplacement,
};

use crate::control_surfaces::{self, ControlCage};
use crate::error::{FilePlace, ImportError};
use crate::heightmap::{HeightMapOptions, read_displacement, read_height_map};
use crate::material::SurfaceMaterial;
use crate::model::{Model, ModelOptions, read_model};
use crate::note::Note;
use crate::patch_surfaces;
use crate::scene::{
    Colouring, DisplacementHeight, HeightFieldSource, Interpolation, Material, Shape, Source, SurfaceEntry,
    TerrainSource,
};
use crate::texture::ColourTexture;

/// The grey of a surface without a material, linear.
const GREY: f32 = 0.45;
/// Where snow begins, as a fraction of the relief, if the scene does not say.
const SNOW_LINE: f64 = 0.7;
/// Samples along each side of the part of a terrain that default views show.
const TERRAIN_SAMPLES: u32 = 48;

/// A surface and what was found on the way.
pub(crate) struct Made {
    pub surface: Arc<dyn Surface>,
    pub corners: CornerAttributes,
    pub material: SurfaceMaterial,
    pub colouring: Colouring,
    /// The box that default views show, in object space.
    pub shown: (DVec3, DVec3),
    /// Whether it is looked across rather than at.
    pub is_ground: bool,
    /// Spacing of a height field.
    pub spacing: Option<[f64; 2]>,
    /// The control mesh that it is the surface of.
    pub cage: Option<Arc<ControlCage>>,
    pub files: Vec<PathBuf>,
}

impl Made {
    /// An object without attributes, material and files.
    pub fn new(surface: Arc<dyn Surface>) -> Self {
        Self {
            shown: surface.bounding_box(),
            surface,
            corners: CornerAttributes::default(),
            material: SurfaceMaterial::default(),
            colouring: Colouring::Plain,
            is_ground: false,
            spacing: None,
            cage: None,
            files: Vec::new(),
        }
    }
}

/// What could not be made, by the field of the entry.
pub(crate) struct Failure {
    pub field: Cow<'static, str>,
    pub source: Box<dyn Error + Send + Sync>,
}

impl Failure {
    pub fn of<E: Error + Send + Sync + 'static>(field: impl Into<Cow<'static, str>>) -> impl FnOnce(E) -> Self {
        let field = field.into();
        move |error| Self {
            field,
            source: Box::new(error),
        }
    }

    /// For a model or a map that was opened directly.
    pub fn without_scene(self, file: &Path) -> ImportError {
        match self.source.downcast::<ImportError>() {
            Ok(error) => *error,
            Err(error) => ImportError::malformed(file, FilePlace::Whole, error.to_string()),
        }
    }
}

/// Makes the surface of an entry of the scene `file`; paths are relative to its folder.
pub(crate) fn make(file: &Path, entry: &SurfaceEntry, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut made = match &entry.source {
        Source::Mesh(path) => {
            let file = folder.join(path);
            match entry.surface {
                Shape::Flat | Shape::Displaced(_) => make_mesh(folder, &file, entry, notes)?,
                _ => control_surfaces::make(folder, &file, entry, notes)?,
            }
        }
        Source::HeightField(source) => make_height_field(folder, source, notes)?,
        Source::Terrain(source) => make_terrain(source)?,
        Source::Patches(source) => patch_surfaces::of_file(folder, source, notes)?,
        Source::Nurbs(source) => patch_surfaces::of_nurbs(file, source, notes)?,
        Source::Bezier(source) => patch_surfaces::of_bezier(file, source, notes)?,
    };
    dress(folder, &entry.material, &mut made)?;
    Ok(made)
}

fn make_mesh(folder: &Path, file: &Path, entry: &SurfaceEntry, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let by_texture =
        matches!(&entry.surface, Shape::Displaced(d) if matches!(d.height, DisplacementHeight::Texture(_)));
    let options = ModelOptions {
        keep_uvs: by_texture || entry.material.texture.is_some(),
    };
    let Model {
        mesh,
        material,
        notes: found,
    } = read_model(file, &options).map_err(Failure::of("source"))?;
    notes.extend(found);
    let mut files = vec![file.to_path_buf()];
    let surface: Arc<dyn Surface> = match &entry.surface {
        Shape::Displaced(displaced) => displace(folder, &mesh, &displaced.height, &mut files, notes)?,
        _ => Arc::new(Mesh::new(&mesh).map_err(Failure::of("source"))?),
    };
    Ok(Made {
        corners: mesh.corners,
        material,
        files,
        ..Made::new(surface)
    })
}

fn displace(
    folder: &Path,
    mesh: &PolygonMesh,
    height: &DisplacementHeight,
    files: &mut Vec<PathBuf>,
    notes: &mut Vec<Note>,
) -> Result<Arc<dyn Surface>, Failure> {
    match height {
        DisplacementHeight::Texture(texture) => {
            let file = folder.join(&texture.path);
            let read = read_displacement(&file).map_err(Failure::of("surface.height.path"))?;
            notes.extend(read.notes);
            files.push(file);
            let displacement = TextureDisplacement {
                texels: read.map,
                scale: texture.amplitude / read.full_scale,
                offset: -texture.middle * texture.amplitude,
                repeats: texture.repeats,
            };
            let surface = DisplacedTexture::new(mesh, displacement);
            Ok(Arc::new(surface.map_err(Failure::of("surface.height"))?))
        }
        DisplacementHeight::Noise(noise) => {
            let displacement = NoiseDisplacement {
                amplitude: noise.amplitude,
                frequency: 1.0 / noise.wavelength,
                octaves: noise.octaves,
                gain: noise.gain,
                seed: noise.seed,
            };
            let surface = DisplacedNoise::new(mesh, displacement);
            Ok(Arc::new(surface.map_err(Failure::of("surface.height"))?))
        }
    }
}

fn make_height_field(folder: &Path, source: &HeightFieldSource, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let file = folder.join(&source.path);
    let options = HeightMapOptions {
        raw_size: source.raw_size,
        void_value: source.void_value,
    };
    let read = read_height_map(&file, &options).map_err(Failure::of("source.path"))?;
    let spacing = source
        .spacing
        .map_or_else(|| read.spacing_or_default(source.scale), DVec2::from);
    notes.extend(read.notes);
    let steps = DVec2::new(f64::from(read.map.width()), f64::from(read.map.height())) - DVec2::ONE;
    let settings = HeightFieldSettings {
        extent: spacing * steps,
        scale: source.scale,
        offset: source.offset,
        interpolation: match source.interpolation {
            Interpolation::Bicubic => keyleaf_surface::Interpolation::Bicubic,
            Interpolation::Bilinear => keyleaf_surface::Interpolation::Bilinear,
        },
    };
    let surface = HeightField::new(read.map, settings).map_err(Failure::of("source"))?;
    let (low, high) = surface.bounding_box();
    // The bounds of the interpolation are wider than the samples.
    let heights = [read.range.0, read.range.1].map(|h| f64::from(h) * source.scale + source.offset);
    let shown = (
        DVec3::new(low.x, heights[0].min(heights[1]), low.z),
        DVec3::new(high.x, heights[0].max(heights[1]), high.z),
    );
    Ok(Made {
        shown,
        is_ground: true,
        spacing: Some(spacing.to_array()),
        files: vec![file],
        ..Made::new(Arc::new(surface))
    })
}

fn make_terrain(source: &TerrainSource) -> Result<Made, Failure> {
    let settings = TerrainSettings::from(source);
    let surface = Terrain::new(settings).map_err(Failure::of("source"))?;
    let cell = source.extent * (-f64::from(source.first_level)).exp2();
    let middle = source.extent / 2.0;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..TERRAIN_SAMPLES * TERRAIN_SAMPLES {
        let place = |k: u32| {
            let across = f64::from(k) / f64::from(TERRAIN_SAMPLES - 1) * 2.0 - 1.0;
            (0.5 + across * cell / source.extent).clamp(0.0, 1.0)
        };
        let at = surface.face_coord(0, place(i % TERRAIN_SAMPLES), place(i / TERRAIN_SAMPLES));
        let height = surface.point(at.map_err(Failure::of("source"))?).y;
        (low, high) = (low.min(height), high.max(height));
    }
    // Peaks between the samples.
    let margin = 0.1 * (high - low);
    let shown = (
        DVec3::new(middle - cell, low - margin, -middle - cell),
        DVec3::new(middle + cell, high + margin, -middle + cell),
    );
    Ok(Made {
        shown,
        is_ground: true,
        ..Made::new(Arc::new(surface))
    })
}

/// Applies the scene's material to what the model has.
fn dress(folder: &Path, material: &Material, made: &mut Made) -> Result<(), Failure> {
    if !material.vertex_colours {
        made.corners.colours = None;
    }
    if let Some(path) = &material.texture {
        let file = folder.join(path);
        let picture = ColourTexture::read(&file).map_err(Failure::of("material.texture"))?;
        made.material.texture = Some(Arc::new(picture));
        made.files.push(file);
    }
    if let Some(path) = &material.matcap {
        let file = folder.join(path);
        let picture = ColourTexture::read(&file).map_err(Failure::of("material.matcap"))?;
        // The model's own picture gives way, as it does to the scene's.
        made.material.texture = None;
        made.material.matcap = Some(Arc::new(picture));
        made.files.push(file);
    }
    made.colouring = match &material.colouring {
        Colouring::Plain => Colouring::Plain,
        Colouring::Terrain(colours) => {
            let mut colours = colours.clone();
            let (low, high) = (made.shown.0.y, made.shown.1.y);
            // A flat surface still needs a scale of heights.
            let range = [low, if high > low { high } else { low + 1.0 }];
            let [low, high] = *colours.heights.get_or_insert(range);
            colours.snow_line.get_or_insert(low + SNOW_LINE * (high - low));
            Colouring::Terrain(colours)
        }
    };
    let is_plain = made.material == SurfaceMaterial::default()
        && made.corners.colours.is_none()
        && made.colouring == Colouring::Plain;
    let base = material
        .base_colour
        .unwrap_or(if is_plain { [GREY; 3] } else { [1.0; 3] });
    made.material
        .base_colour
        .iter_mut()
        .zip(base)
        .for_each(|(own, base)| *own *= base);
    Ok(())
}
