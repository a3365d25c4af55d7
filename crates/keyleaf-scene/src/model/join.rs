//! Many materials as one: base colours go to the corner colours, pictures are packed into one picture.
//!
//! A surface is drawn with one picture and one pipeline. Pictures are packed in shelves, highest first, each with a
//! border of [`BORDER`] texels of its own edge. A picture that some face repeats is packed as often as that face
//! repeats it, up to [`MAX_REPEATS`].

use std::path::Path;
use std::sync::Arc;

use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::texture::{ColourTexture, MAX_TEXTURE_SIDE};
use keyleaf_surface::PolygonMesh;

/// Texels around each packed picture, so that filtering does not see its neighbours.
const BORDER: u32 = 4;
/// How often a picture may be repeated within one face.
const MAX_REPEATS: u32 = 8;

/// One picture in the joint one.
struct Tile {
    picture: Arc<ColourTexture>,
    /// How often it is laid out, in x and y.
    repeats: [u32; 2],
    /// Top left texel, without the border.
    at: [u32; 2],
}

impl Tile {
    fn size(&self) -> [u32; 2] {
        [
            self.picture.width * self.repeats[0],
            self.picture.height * self.repeats[1],
        ]
    }
}

/// Gives the mesh one material that looks like its many. `of_face` may be empty: all faces have material 0.
pub(super) fn join(
    file: &Path,
    mesh: &mut PolygonMesh,
    of_face: &[u32],
    materials: &[SurfaceMaterial],
    keep_uvs: bool,
    notes: &mut Vec<Note>,
) -> SurfaceMaterial {
    let material = |face: usize| {
        let index = of_face.get(face).copied().unwrap_or(0) as usize;
        materials.get(index).cloned().unwrap_or_default()
    };
    let faces: Vec<SurfaceMaterial> = (0..mesh.faces.len()).map(material).collect();
    let first = faces.first().cloned().unwrap_or_default();
    if faces
        .iter()
        .all(|m| m.base_colour == first.base_colour && same_picture(m, &first))
    {
        return first;
    }
    let ranges = corner_ranges(mesh);
    let corner_count = ranges.last().map_or(0, |r| r.end);
    let colours = mesh.corners.colours.get_or_insert_with(|| vec![[1.0; 4]; corner_count]);
    for (range, material) in ranges.iter().zip(&faces) {
        for colour in colours.get_mut(range.clone()).unwrap_or_default() {
            colour
                .iter_mut()
                .zip(material.base_colour)
                .for_each(|(c, base)| *c *= base);
        }
    }
    let white = SurfaceMaterial::default();
    if faces.iter().all(|m| same_picture(m, &first)) {
        return SurfaceMaterial {
            texture: first.texture,
            ..white
        };
    }
    let Some(uvs) = &mut mesh.corners.uvs else { return white };
    if keep_uvs {
        let text = "the model has several pictures, which are not drawn";
        notes.push(Note::warning(file, text));
        return white;
    }
    match pack(uvs, &ranges, &faces) {
        Some((picture, stretched)) => {
            if stretched > 0 {
                let text = format!("{stretched} faces repeat a picture more than {MAX_REPEATS} times; it is stretched");
                notes.push(Note::warning(file, text));
            }
            SurfaceMaterial {
                texture: Some(Arc::new(picture)),
                ..white
            }
        }
        None => {
            let text = format!("the pictures do not fit one of {MAX_TEXTURE_SIDE} a side and are not drawn");
            notes.push(Note::warning(file, text));
            white
        }
    }
}

fn same_picture(a: &SurfaceMaterial, b: &SurfaceMaterial) -> bool {
    match (&a.texture, &b.texture) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    }
}

fn corner_ranges(mesh: &PolygonMesh) -> Vec<std::ops::Range<usize>> {
    let mut first = 0;
    let range = |face: &[u32]| {
        first += face.len();
        first - face.len()..first
    };
    mesh.faces.iter().map(range).collect()
}

/// The integer below the smallest coordinate of a face, and how many repeats of the picture it spans.
fn span(uvs: &[[f32; 2]], axis: usize) -> (f32, u32) {
    let least = uvs.iter().map(|uv| uv[axis]).fold(f32::INFINITY, f32::min).floor();
    let most = uvs.iter().map(|uv| uv[axis]).fold(f32::NEG_INFINITY, f32::max);
    // A hair over a whole number is rounding.
    let repeats = (most - least - 1e-4).ceil();
    (least, if repeats >= 1.0 { repeats.min(1e6) as u32 } else { 1 })
}

/// Packs the pictures, moves the texture coordinates into them; `None` if they do not fit. Also says how many faces
/// repeat a picture too often.
fn pack(
    uvs: &mut [[f32; 2]],
    ranges: &[std::ops::Range<usize>],
    faces: &[SurfaceMaterial],
) -> Option<(ColourTexture, usize)> {
    let white = Arc::new(ColourTexture {
        width: 1,
        height: 1,
        rgba: vec![255; 4],
    });
    let mut tiles: Vec<Tile> = Vec::new();
    let mut tile_of_face = Vec::with_capacity(faces.len());
    let mut stretched = 0;
    for (range, material) in ranges.iter().zip(faces) {
        let picture = material.texture.as_ref().unwrap_or(&white);
        let known = tiles.iter().position(|t| Arc::ptr_eq(&t.picture, picture));
        let index = known.unwrap_or_else(|| {
            tiles.push(Tile {
                picture: picture.clone(),
                repeats: [1; 2],
                at: [0; 2],
            });
            tiles.len() - 1
        });
        tile_of_face.push(index);
        if material.texture.is_some() {
            let repeats = [0, 1].map(|axis| span(&uvs[range.clone()], axis).1);
            stretched += usize::from(repeats.iter().any(|&r| r > MAX_REPEATS));
            for (tile, repeats) in tiles[index].repeats.iter_mut().zip(repeats) {
                *tile = (*tile).max(repeats.min(MAX_REPEATS));
            }
        }
    }
    let [width, height] = place(&mut tiles)?;
    for (range, &index) in ranges.iter().zip(&tile_of_face) {
        let tile = &tiles[index];
        let spans = [0, 1].map(|axis| span(&uvs[range.clone()], axis).0);
        for uv in &mut uvs[range.clone()] {
            let [u, v] = [0, 1].map(|i| (uv[i] - spans[i]).clamp(0.0, tile.repeats[i] as f32));
            let (u, v) = if Arc::ptr_eq(&tile.picture, &white) {
                (0.5, 0.5)
            } else {
                (u, v)
            };
            let x = tile.at[0] as f32 + u * tile.picture.width as f32;
            let from_top = (tile.repeats[1] as f32 - v) * tile.picture.height as f32;
            let y = tile.at[1] as f32 + from_top;
            *uv = [x / width as f32, 1.0 - y / height as f32];
        }
    }
    Some((draw(&tiles, width, height), stretched))
}

/// Gives each tile its place in shelves; the size of the whole.
fn place(tiles: &mut [Tile]) -> Option<[u32; 2]> {
    let outer = |tile: &Tile| tile.size().map(|s| u64::from(s) + 2 * u64::from(BORDER));
    let area: u64 = tiles.iter().map(outer).map(|[w, h]| w * h).sum();
    let widest = tiles.iter().map(|t| outer(t)[0]).max()?;
    let width = ((area as f64).sqrt().ceil() as u64).max(widest).next_multiple_of(4);
    let limit = u64::from(MAX_TEXTURE_SIDE);
    if width > limit {
        return None;
    }
    let mut order: Vec<usize> = (0..tiles.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(outer(&tiles[i])[1]));
    let (mut x, mut y, mut shelf) = (0, 0, 0);
    for i in order {
        let [w, h] = outer(&tiles[i]);
        if x + w > width {
            (x, y, shelf) = (0, y + shelf, 0);
        }
        if y + h > limit {
            return None;
        }
        tiles[i].at = [x as u32 + BORDER, y as u32 + BORDER];
        x += w;
        shelf = shelf.max(h);
    }
    Some([width as u32, (y + shelf) as u32])
}

fn draw(tiles: &[Tile], width: u32, height: u32) -> ColourTexture {
    let mut rgba = vec![255; width as usize * height as usize * 4];
    for tile in tiles {
        let [w, h] = tile.size();
        let picture = &tile.picture;
        for row in 0..h + 2 * BORDER {
            for column in 0..w + 2 * BORDER {
                let inside = |i: u32, size: u32| i.saturating_sub(BORDER).min(size - 1);
                let (x, y) = (inside(column, w) % picture.width, inside(row, h) % picture.height);
                let from = 4 * (y as usize * picture.width as usize + x as usize);
                let (left, top) = (tile.at[0] - BORDER, tile.at[1] - BORDER);
                let to = (top + row) as usize * width as usize + (left + column) as usize;
                rgba[4 * to..4 * to + 4].copy_from_slice(&picture.rgba[from..from + 4]);
            }
        }
    }
    ColourTexture { width, height, rgba }
}

#[cfg(test)]
mod tests {
    use super::*;
    use keyleaf_surface::CornerAttributes;

    fn picture(width: u32, height: u32, colour: u8) -> Arc<ColourTexture> {
        let texel = |i: u32| [colour, i as u8, 0, 255];
        Arc::new(ColourTexture {
            width,
            height,
            rgba: (0..width * height).flat_map(texel).collect(),
        })
    }

    /// The texel under a texture coordinate.
    fn look_up(picture: &ColourTexture, uv: [f32; 2]) -> [u8; 2] {
        let x = (uv[0] * picture.width as f32).floor() as usize;
        let y = ((1.0 - uv[1]) * picture.height as f32).floor() as usize;
        let at = 4 * (y * picture.width as usize + x);
        [picture.rgba[at], picture.rgba[at + 1]]
    }

    #[test]
    fn joined_pictures_show_the_same_texels() {
        let (red, blue) = (picture(8, 4, 200), picture(5, 7, 100));
        let material = |texture: Option<&Arc<ColourTexture>>, grey| SurfaceMaterial {
            base_colour: [grey, grey, grey, 1.0],
            texture: texture.cloned(),
            ..SurfaceMaterial::default()
        };
        let materials = [
            material(Some(&red), 0.5),
            material(Some(&blue), 1.0),
            material(None, 0.25),
        ];
        let uvs = vec![
            [0.1, 0.1],
            [0.9, 0.1],
            [0.6, 0.8], // within the picture
            [2.1, -0.9],
            [2.9, -0.9],
            [4.65, -0.33], // moved and repeated
            [0.0, 0.0],
            [1.0, 0.0],
            [9.0, 1.0],
        ];
        let mut mesh = PolygonMesh {
            positions: vec![glam::DVec3::ZERO; 9],
            faces: [[0, 1, 2], [3, 4, 5], [6, 7, 8]].into_iter().collect(),
            corners: CornerAttributes {
                uvs: Some(uvs.clone()),
                normals: None,
                colours: None,
            },
        };
        let mut notes = Vec::new();
        let joint = join(Path::new("m"), &mut mesh, &[0, 1, 2], &materials, false, &mut notes);
        let texture = joint.texture.unwrap();
        let joined = mesh.corners.uvs.unwrap();
        for (i, uv) in uvs.iter().enumerate().take(6) {
            let from: &ColourTexture = if i < 3 { &red } else { &blue };
            let wrapped = uv.map(|c| c - c.floor());
            assert_eq!(look_up(&texture, joined[i]), look_up(from, wrapped), "corner {i}");
        }
        assert_eq!(look_up(&texture, joined[8]), [255, 255]);
        let colours = mesh.corners.colours.unwrap();
        assert_eq!((colours[0][0], colours[3][0], colours[6][0]), (0.5, 1.0, 0.25));
        assert!(notes.is_empty());
    }
}
