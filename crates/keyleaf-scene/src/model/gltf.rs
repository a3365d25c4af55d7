//! glTF 2.0, text and binary: all meshes of the default scene with the transforms of their nodes baked in.
//!
//! Base colours, base-colour pictures, `COLOR_0`, `NORMAL` and the texture coordinates that the picture asks for are
//! read; skins, animations and morph targets are not (a note says so). A node that mirrors (negative determinant)
//! gets its winding turned.

use std::path::Path;

use glam::{DMat3, DMat4, DQuat, DVec3, Vec3};
use gltf::mesh::{Mode, Semantic};
use gltf::scene::Transform;

use crate::error::{FilePlace, ImportError};
use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::soup::{Soup, check_finite, unit};

use super::gltf_data::{GltfData, part};

/// What a glTF file holds.
pub(super) struct GltfModel {
    pub soup: Soup,
    pub materials: Vec<SurfaceMaterial>,
}

/// Reads a glTF or GLB file from its bytes; buffers and pictures are looked for beside `file`.
pub(super) fn read(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<GltfModel, ImportError> {
    let data = GltfData::read(file, bytes, notes)?;
    let document = &data.document;
    let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
        return Err(ImportError::empty(file, "the file has no scene"));
    };
    if document.skins().next().is_some() || document.animations().next().is_some() {
        notes.push(Note::remark(
            file,
            "skins and animations are not read: the model is in its rest pose",
        ));
    }
    let mut builder = Builder {
        data: &data,
        soup: Soup::default(),
        lacks_normals: false,
    };
    // An explicit stack and a mark: a file may name a node twice, or a node as its own ancestor.
    let mut seen = vec![false; document.nodes().len()];
    let mut open: Vec<_> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    open.reverse();
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            let reason = "the node has two parents or is its own ancestor";
            return Err(ImportError::malformed(file, part("node", node.index()), reason));
        }
        let matrix = parent * matrix_of(node.transform());
        check_finite(
            file,
            || part("node", node.index()),
            "transform",
            &matrix.to_cols_array(),
        )?;
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                let place = || FilePlace::Part(format!("mesh {}, primitive {}", mesh.index(), primitive.index()));
                builder.primitive(&primitive, &place, matrix, notes)?;
            }
        }
        open.extend(
            node.children()
                .map(|child| (child, matrix))
                .collect::<Vec<_>>()
                .into_iter()
                .rev(),
        );
    }
    let mut soup = builder.soup;
    if builder.lacks_normals && !soup.normals.is_empty() {
        soup.normals.clear();
        notes.push(Note::remark(file, "normals are ignored: not all meshes have them"));
    }
    let materials = materials(&data, &soup, notes)?;
    Ok(GltfModel { soup, materials })
}

fn matrix_of(transform: Transform) -> DMat4 {
    match transform {
        Transform::Matrix { matrix } => DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))),
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => {
            let rotation = DQuat::from_array(rotation.map(f64::from));
            let rotation = if rotation.length() > 0.0 {
                rotation.normalize()
            } else {
                DQuat::IDENTITY
            };
            DMat4::from_scale_rotation_translation(
                Vec3::from(scale).as_dvec3(),
                rotation,
                Vec3::from(translation).as_dvec3(),
            )
        }
    }
}

/// Collects the primitives of all nodes.
struct Builder<'a> {
    data: &'a GltfData<'a>,
    soup: Soup,
    lacks_normals: bool,
}

impl Builder<'_> {
    fn primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        place: &dyn Fn() -> FilePlace,
        matrix: DMat4,
        notes: &mut Vec<Note>,
    ) -> Result<(), ImportError> {
        let file = self.data.file;
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            notes.push(Note::remark(file, format!("{}points and lines are not read", place())));
            return Ok(());
        }
        let accessor = |semantic: Semantic| primitive.get(&semantic).map(|a| a.index());
        let Some(positions) = accessor(Semantic::Positions) else {
            return Err(ImportError::malformed(file, place(), "the primitive has no POSITION"));
        };
        let positions = self.data.vectors::<3>(positions, [0.0; 3], place)?;
        let first = self.soup.positions.len() as u32;
        for position in &positions {
            let position = matrix.transform_point3(DVec3::from(*position));
            check_finite(file, place, "position", &position.to_array())?;
            self.soup.positions.push(position);
        }
        let triangles = self.triangles(primitive, place, positions.len())?;
        let mirrored = matrix.determinant() < 0.0;
        let corners: Vec<u32> = triangles
            .iter()
            .flat_map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
            .collect();
        let attribute = |semantic, fill: [f64; 4]| -> Result<Option<Vec<[f64; 4]>>, ImportError> {
            let Some(index) = accessor(semantic) else {
                return Ok(None);
            };
            let values = self.data.vectors::<4>(index, fill, place)?;
            if values.len() != positions.len() {
                let reason = "its attributes have different counts";
                return Err(ImportError::malformed(file, place(), reason));
            }
            for value in &values {
                check_finite(file, place, "attribute", value)?;
            }
            Ok(Some(values))
        };
        let info = primitive.material().pbr_metallic_roughness().base_color_texture();
        let set = info.map_or(0, |info| info.tex_coord());
        let uvs = attribute(Semantic::TexCoords(set), [0.0; 4])?;
        let colours = attribute(Semantic::Colors(0), [0.0, 0.0, 0.0, 1.0])?;
        let normals = attribute(Semantic::Normals, [0.0; 4])?;

        let before = self.soup.corners.len();
        let count = before + corners.len();
        let at = |values: &[[f64; 4]], corner: &u32| values[*corner as usize];
        // v = 0 is the top of the picture in glTF, and its bottom here.
        append(
            &mut self.soup.uvs,
            before,
            count,
            [0.0; 2],
            &uvs,
            &corners,
            |values, c| {
                let [u, v, ..] = at(values, c);
                [u as f32, (1.0 - v) as f32]
            },
        );
        append(
            &mut self.soup.colours,
            before,
            count,
            [1.0; 4],
            &colours,
            &corners,
            |values, c| at(values, c).map(|channel| channel as f32),
        );
        let normal_matrix = DMat3::from_mat4(matrix).inverse().transpose();
        append(
            &mut self.soup.normals,
            before,
            count,
            [0.0; 3],
            &normals,
            &corners,
            |values, c| {
                let [x, y, z, _] = at(values, c);
                unit(normal_matrix * DVec3::new(x, y, z))
            },
        );
        self.lacks_normals |= normals.is_none() && !corners.is_empty();

        let material = primitive.material().index().map_or(0, |i| i + 1) as u32;
        for triangle in 0..triangles.len() {
            self.soup.ends.push((before + 3 * (triangle + 1)) as u32);
            self.soup.materials.push(material);
        }
        self.soup.corners.extend(corners.iter().map(|c| first + c));
        Ok(())
    }

    /// The triangles of a primitive, with checked indices into its own vertices.
    fn triangles(
        &self,
        primitive: &gltf::Primitive<'_>,
        place: &dyn Fn() -> FilePlace,
        count: usize,
    ) -> Result<Vec<[u32; 3]>, ImportError> {
        let indices = match primitive.indices() {
            Some(accessor) => self.data.indices(accessor.index(), count, place)?,
            None => (0..count as u32).collect(),
        };
        Ok(match primitive.mode() {
            Mode::TriangleStrip => indices
                .windows(3)
                .enumerate()
                .map(|(i, w)| {
                    if i % 2 == 0 {
                        [w[0], w[1], w[2]]
                    } else {
                        [w[1], w[0], w[2]]
                    }
                })
                .collect(),
            Mode::TriangleFan => indices.windows(2).skip(1).map(|w| [indices[0], w[0], w[1]]).collect(),
            _ if indices.len() % 3 != 0 => {
                let reason = format!("{} indices are no whole number of triangles", indices.len());
                return Err(ImportError::malformed(self.data.file, place(), reason));
            }
            _ => indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        })
    }
}

/// Appends the attribute of one primitive to that of all, padding what had none.
fn append<T: Copy>(
    all: &mut Vec<T>,
    before: usize,
    count: usize,
    fill: T,
    values: &Option<Vec<[f64; 4]>>,
    corners: &[u32],
    convert: impl Fn(&[[f64; 4]], &u32) -> T,
) {
    if let Some(values) = values {
        all.resize(before, fill);
        all.extend(corners.iter().map(|corner| convert(values, corner)));
    } else if !all.is_empty() {
        all.resize(count, fill);
    }
}

/// Material 0 is glTF's default material; material i + 1 is the file's i-th. Only those in use are decoded.
fn materials(data: &GltfData<'_>, soup: &Soup, notes: &mut Vec<Note>) -> Result<Vec<SurfaceMaterial>, ImportError> {
    let mut materials = vec![SurfaceMaterial::default()];
    for (index, material) in data.document.materials().enumerate() {
        let pbr = material.pbr_metallic_roughness();
        let base_colour = pbr.base_color_factor().map(|c| c.clamp(0.0, 1.0));
        let used = soup.materials.contains(&(index as u32 + 1));
        let texture = match pbr.base_color_texture().filter(|_| used) {
            Some(info) => Some(data.picture(info.texture().source().index(), notes)?),
            None => None,
        };
        materials.push(SurfaceMaterial {
            base_colour,
            texture,
            ..SurfaceMaterial::default()
        });
    }
    Ok(materials)
}
