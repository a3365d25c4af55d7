//! glTF files written here.

use super::*;
use std::fmt::Write;

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = |chunk: &[u8]| {
        let word = chunk.iter().fold(0, |word, b| word << 8 | u32::from(*b)) << (8 * (3 - chunk.len()));
        let digit = |i: usize| {
            if i > chunk.len() {
                '='
            } else {
                DIGITS[(word >> (18 - 6 * i)) as usize & 63] as char
            }
        };
        (0..4).map(digit).collect::<String>()
    };
    bytes.chunks(3).map(digits).collect()
}

/// Positions of a quad (48 bytes), normalised colours (16), indices (12), padded to 84; a 1x1 PNG follows.
fn buffer() -> Vec<u8> {
    let mut bytes = Vec::new();
    for p in [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]] {
        p.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
    }
    [255u8, 0, 0, 255].iter().for_each(|c| bytes.extend([*c; 4]));
    [0u16, 1, 2, 0, 2, 3].iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    bytes.resize(84, 0);
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(1, 1, image::Rgba([9, 8, 7, 255]))
        .write_to(&mut png, image::ImageFormat::Png)
        .unwrap();
    bytes.extend(png.into_inner());
    while !bytes.len().is_multiple_of(4) {
        bytes.push(0);
    }
    bytes
}

/// A document with a node that moves and a child that mirrors, both with the same mesh.
pub(super) fn json(with_uri: bool) -> String {
    let bytes = buffer();
    let mut uri = String::new();
    if with_uri {
        write!(
            uri,
            r#""uri":"data:application/octet-stream;base64,{}","#,
            base64(&bytes)
        )
        .unwrap();
    }
    let picture = bytes.len() - 84;
    let length = bytes.len();
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0,"translation":[10,0,0],"children":[1]}},{{"mesh":0,"scale":[-1,1,1]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":1,"TEXCOORD_0":3}},"indices":2,"material":0}}]}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{{"index":0}}}}}}],
"textures":[{{"source":0}}],"images":[{{"bufferView":3,"mimeType":"image/png"}}],
"buffers":[{{{uri}"byteLength":{length}}}],
"bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":16}},{{"buffer":0,"byteOffset":64,"byteLength":12}},{{"buffer":0,"byteOffset":84,"byteLength":{picture}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"}},
{{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}},
{{"bufferView":0,"byteOffset":4,"byteLength":1,"componentType":5126,"count":4,"type":"VEC2"}}]}}"#
    )
    .replace(r#""byteOffset":4,"byteLength":1,"#, "")
    .replace(r#""bufferView":0,"componentType":5126,"count":4,"type":"VEC2""#, r#""bufferView":4,"componentType":5126,"count":4,"type":"VEC2""#)
    .replace(r#"],
"accessors""#, r#",{"buffer":0,"byteLength":48,"byteStride":12}],
"accessors""#)
}

/// The same as one binary file.
pub(super) fn glb() -> Vec<u8> {
    let mut json = json(false).into_bytes();
    while !json.len().is_multiple_of(4) {
        json.push(b' ');
    }
    let bin = buffer();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + bin.len() as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((bin.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(bin);
    bytes
}

fn parse(name: &str, bytes: impl AsRef<[u8]>) -> Result<Model, String> {
    decode(Path::new(name), bytes.as_ref(), &ModelOptions::default()).map_err(|e| e.to_string())
}

#[test]
fn node_transforms_are_baked_and_mirrors_keep_the_outside() {
    let model = parse("a.gltf", json(true)).unwrap();
    assert_eq!(parse("a.glb", glb()).unwrap().mesh, model.mesh);
    // The quads meet at x = 10: 8 vertices, 6 positions, one consistent winding.
    assert_eq!((model.mesh.positions.len(), model.mesh.faces.len()), (6, 4));
    for face in model.mesh.faces.iter() {
        let [a, b, c] = [0, 1, 2].map(|i| model.mesh.positions[face[i] as usize]);
        assert_eq!((b - a).cross(c - a), glam::DVec3::Z);
    }
    let far = model.mesh.positions.iter().map(|p| p.x).fold(0.0, f64::max);
    assert_eq!(far, 11.0);
    assert_eq!(model.material.base_colour, [0.5, 1.0, 1.0, 1.0]);
    assert_eq!(model.material.texture.unwrap().rgba, [9, 8, 7, 255]);
    // v is turned: glTF has it at the top.
    assert_eq!(
        model.mesh.corners.uvs.unwrap()[..3],
        [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]
    );
    assert_eq!(model.mesh.corners.colours.unwrap()[..3], [[1.0; 4], [0.0; 4], [0.0; 4]]);
}

#[test]
fn errors_name_the_part() {
    let of = |from: &str, to: &str| {
        let text = json(true);
        assert!(text.contains(from), "{from}");
        parse("a.gltf", text.replace(from, to)).map(|_| ()).unwrap_err()
    };
    let out = of(
        r#""byteOffset":64,"byteLength":12"#,
        r#""byteOffset":64,"byteLength":9999"#,
    );
    assert!(out.contains("buffer view 2: the view does not lie within"), "{out}");
    assert!(of(r#""count":6"#, r#""count":3000000000"#).contains("does not lie within the view"));
    assert!(of(r#""count":6"#, r#""count":5"#).contains("no whole number of triangles"));
    assert!(
        of(
            r#""bufferView":2,"componentType":5123"#,
            r#""bufferView":1,"componentType":5121"#
        )
        .contains("vertex 255 is out of range: there are 4")
    );
    assert!(of(r#""children":[1]"#, r#""children":[0]"#).contains("node 0: the node has two parents"));
    assert!(of(r#""mesh":0,"scale""#, r#""mesh":7,"scale""#).contains("not a valid glTF document"));
    assert!(of(r#""version":"2.0""#, r#""version"#).contains("line 1: not a glTF document"));
    assert!(of("data:application/octet-stream;base64,", "no-such-file.bin?").contains("buffer 0"));
    assert!(
        of(
            r#""uri":"data:application/octet-stream;base64,"#,
            r#""uri":"%ff","name":""#
        )
        .contains("not UTF-8")
    );
    let draco = of(
        r#""scene":0"#,
        r#""scene":0,"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"]"#,
    );
    assert!(
        draco.contains("required extension KHR_draco_mesh_compression"),
        "{draco}"
    );
    let bytes = glb();
    assert!(
        parse("a.glb", &bytes[..bytes.len() - 4])
            .map(|_| ())
            .unwrap_err()
            .contains("truncated")
    );
}
