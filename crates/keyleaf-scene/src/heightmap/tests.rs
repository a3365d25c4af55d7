//! Height maps of all formats, broken ones, and real terrain.

use super::*;
use image::{ImageBuffer, ImageFormat, Luma, Rgb};
use std::path::PathBuf;

/// An empty folder of this test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("keyleaf-heights-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn read(file: &Path) -> Result<HeightMapFile, String> {
    read_height_map(file, &HeightMapOptions::default()).map_err(|e| e.to_string())
}

fn samples(map: &HeightMap) -> Vec<f32> {
    let rows = (0..map.height()).rev();
    rows.flat_map(|j| (0..map.width()).map(move |i| (i, j)))
        .map(|(i, j)| map.sample(i, j))
        .collect()
}

fn save_grey16(file: &Path, width: u32, values: &[u16]) {
    let height = values.len() as u32 / width;
    ImageBuffer::<Luma<u16>, _>::from_raw(width, height, values.to_vec())
        .unwrap()
        .save(file)
        .unwrap();
}

/// A slope from 100 to 219, 12x10.
fn slope() -> Vec<u16> {
    (100..220).collect()
}

fn said(file: &HeightMapFile, text: &str) -> bool {
    file.notes.iter().any(|n| n.text.contains(text))
}

#[test]
fn all_formats_give_the_exact_samples_with_row_0_on_top() {
    let folder = folder("formats");
    let values = [0u16, 1, 2, 300, 16_384, 65_534];
    let floats = values.map(f32::from);
    save_grey16(&folder.join("a.png"), 3, &values);
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    std::fs::write(folder.join("a.r16"), &bytes).unwrap();
    save_grey16(&folder.join("a.tif"), 3, &values);
    for name in ["a.png", "a.tif"] {
        let read = read(&folder.join(name)).unwrap();
        assert_eq!((read.map.width(), read.map.height(), read.voids), (3, 2, 0));
        assert_eq!(samples(&read.map), floats, "{name}");
        assert_eq!(read.map.sample(0, 0), 300.0, "row 0 of the map is the lowest");
    }
    let options = HeightMapOptions {
        raw_size: Some([3, 2]),
        ..Default::default()
    };
    assert_eq!(
        samples(&read_height_map(&folder.join("a.r16"), &options).unwrap().map),
        floats
    );
    std::fs::write(folder.join("b.r16"), &bytes[..8]).unwrap();
    assert_eq!(samples(&read(&folder.join("b.r16")).unwrap().map), floats[..4]);

    let grey8 = ImageBuffer::<Luma<u8>, _>::from_raw(2, 2, vec![0u8, 7, 128, 255]).unwrap();
    grey8.save(folder.join("8.png")).unwrap();
    let read8 = read(&folder.join("8.png")).unwrap();
    assert_eq!(samples(&read8.map), [0.0, 7.0, 128.0, 255.0]);
    assert!(said(&read8, "terraces"));
    let colour = ImageBuffer::<Rgb<u8>, _>::from_pixel(2, 2, Rgb([50, 50, 50]));
    colour.save(folder.join("rgb.png")).unwrap();
    assert!(said(&read(&folder.join("rgb.png")).unwrap(), "luminance"));
    assert_eq!(read_displacement(&folder.join("8.png")).unwrap().full_scale, 255.0);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn float_tiff_and_exr_keep_their_bits_and_their_nans_are_voids() {
    let folder = folder("floats");
    let values = [0.5f32, -12.25, 1.0e-20, f32::NAN, 8848.862, 3.25];
    let mut tiff = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut tiff).unwrap();
    encoder
        .write_image::<tiff::encoder::colortype::Gray32Float>(3, 2, &values)
        .unwrap();
    std::fs::write(folder.join("a.tif"), tiff.into_inner()).unwrap();
    {
        use exr::prelude::*;
        let channel = |name, values: &[f32]| AnyChannel::new(name, FlatSamples::F32(values.to_vec()));
        let channels = AnyChannels::sort(smallvec_of([channel("A", &[1.0; 6]), channel("Y", &values)]));
        Image::from_channels((3, 2), channels)
            .write()
            .to_file(folder.join("a.exr"))
            .unwrap();
    }
    for name in ["a.tif", "a.exr"] {
        let file = read(&folder.join(name)).unwrap();
        assert_eq!(file.voids, 1, "{name}");
        for (sample, value) in samples(&file.map).iter().zip(values) {
            let filled = value.is_nan() && (0.5..=8848.9).contains(sample);
            assert!(
                filled || sample.to_bits() == value.to_bits(),
                "{name}: {sample} {value}"
            );
        }
    }
    std::fs::remove_dir_all(folder).unwrap();
}

/// The list of channels as the type that the crate wants.
fn smallvec_of<T, L: FromIterator<T>>(items: [T; 2]) -> L {
    items.into_iter().collect()
}

#[test]
fn marks_are_voids_only_where_no_other_sample_is_near() {
    let folder = folder("marks");
    for mark in [32_768u16, 32_769, 65_535] {
        let mut values = slope();
        values[30] = mark;
        values[31] = mark;
        save_grey16(&folder.join("a.png"), 12, &values);
        let file = read(&folder.join("a.png")).unwrap();
        assert_eq!(file.voids, 2);
        assert!(file.range.1 < 220.0, "no spike");
        // In a map that uses the whole range it is a height.
        let full: Vec<u16> = (0..120u32)
            .map(|i| (i * 65_535 / 119) as u16)
            .map(|v| if v.abs_diff(mark) < 600 { mark } else { v })
            .chain((0..24).map(|i| mark.wrapping_sub(40 + i)))
            .collect();
        save_grey16(&folder.join("b.png"), 12, &full);
        assert_eq!(read(&folder.join("b.png")).unwrap().voids, 0, "{mark}");
    }
    let options = HeightMapOptions {
        void_value: Some(150.0),
        ..Default::default()
    };
    save_grey16(&folder.join("c.png"), 12, &slope());
    let file = read_height_map(&folder.join("c.png"), &options).unwrap();
    assert_eq!(file.voids, 1);
    assert!((samples(&file.map)[50] - 150.0).abs() < 0.1);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn zeros_are_voids_without_a_shore_and_sea_with_one() {
    let folder = folder("zeros");
    let hole = |height: u16| -> Vec<u16> {
        (0..144)
            .map(|i| {
                if (4..8).contains(&(i % 12)) && (4..8).contains(&(i / 12)) {
                    0
                } else {
                    height
                }
            })
            .collect()
    };
    save_grey16(&folder.join("hole.png"), 12, &hole(900));
    let file = read(&folder.join("hole.png")).unwrap();
    assert_eq!((file.voids, file.range), (16, (900.0, 900.0)));
    save_grey16(&folder.join("lake.png"), 12, &hole(12));
    assert_eq!(read(&folder.join("lake.png")).unwrap().voids, 0);
    // Not metres: the same hole is a cliff.
    let mut high = hole(900);
    high[0] = 40_000;
    save_grey16(&folder.join("cliff.png"), 12, &high);
    assert_eq!(read(&folder.join("cliff.png")).unwrap().voids, 0);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn sidecar_tells_voids_and_spacing_and_is_checked() {
    let folder = folder("sidecar");
    let file = folder.join("N60E010_x.png");
    let mut values = slope();
    values[25] = 65_535;
    save_grey16(&file, 12, &values);
    let json = |text: &str| std::fs::write(file.with_extension("json"), text).unwrap();
    json(r#"{"voids": [[0, 3]], "spacing_arcsec": 1, "other": 4}"#);
    let read_it = || read(&file);
    let map = read_it().unwrap();
    assert_eq!((map.voids, map.range.1), (1, 65_535.0), "the list is authoritative");
    let spacing = map.spacing_or_default(1.0);
    assert!((spacing.y - 30.87).abs() < 1e-12 && (spacing.x - 30.87 * 60.5f64.to_radians().cos()).abs() < 1e-9);
    json(r#"{"voids": [[10, 3]]}"#);
    assert!(
        read_it()
            .unwrap_err()
            .contains("row 10, column 3: the listed void is outside")
    );
    json("{\n\"voids\": 3}");
    assert!(read_it().unwrap_err().contains("N60E010_x.json: line 2:"));
    json(r#"{"spacing_arcsec": -1}"#);
    assert!(read_it().unwrap_err().contains("spacing_arcsec"));
    std::fs::remove_file(file.with_extension("json")).unwrap();
    let map = read_it().unwrap();
    let relief = f64::from(map.range.1 - map.range.0);
    assert!((map.spacing_or_default(2.0).x * 11.0 - 12.0 * relief).abs() < 1e-9);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn broken_maps_are_errors_and_never_panic() {
    let folder = folder("broken");
    save_grey16(&folder.join("a.png"), 12, &slope());
    save_grey16(&folder.join("a.tif"), 12, &slope());
    exr::prelude::write_rgb_file(folder.join("a.exr"), 9, 9, |x, y| (x as f32, y as f32, 0.0f32)).unwrap();
    for name in ["a.png", "a.tif", "a.exr"] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let damaged = folder.join(format!("damaged.{}", &name[2..]));
        for length in (0..bytes.len()).step_by(7) {
            std::fs::write(&damaged, &bytes[..length]).unwrap();
            if let Err(error) = read(&damaged) {
                assert!(error.contains("damaged."), "{error}");
            }
        }
        std::fs::write(&damaged, &bytes[..bytes.len() / 2]).unwrap();
        assert!(read(&damaged).is_err(), "half of {name}");
        let mut state = 3u64;
        for _ in 0..400 {
            let mut copy = bytes.clone();
            for _ in 0..3 {
                state = state
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                let at = (state >> 33) as usize % copy.len();
                copy[at] = (state >> 56) as u8;
            }
            std::fs::write(&damaged, &copy).unwrap();
            let _ = read(&damaged);
        }
    }
    assert!(read(&folder.join("none.png")).unwrap_err().contains("cannot be read"));
    assert!(
        read(&folder.join("a.bmp"))
            .unwrap_err()
            .contains("unknown file type 'bmp'")
    );
    std::fs::write(folder.join("odd.r16"), [0; 14]).unwrap();
    assert!(read(&folder.join("odd.r16")).unwrap_err().contains("no square"));
    std::fs::write(folder.join("empty.r16"), []).unwrap();
    assert!(read(&folder.join("empty.r16")).is_err());
    ImageBuffer::<Luma<u8>, _>::from_raw(5, 1, vec![3u8; 5])
        .unwrap()
        .save_with_format(folder.join("thin.png"), ImageFormat::Png)
        .unwrap();
    assert!(read(&folder.join("thin.png")).unwrap_err().contains("at least 2 x 2"));
    save_grey16(&folder.join("void.png"), 2, &[65_535; 4]);
    assert!(read(&folder.join("void.png")).unwrap_err().contains("all samples"));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn voids_of_real_tiles_are_filled_without_spikes() {
    let tiles = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/terrain");
    if !tiles.is_dir() {
        println!("skipped: there is no {}", tiles.display());
        return;
    }
    let copies = folder("tiles");
    for (name, voids) in [("N46E008_1201", 103_743), ("N49W123_1201", 34_926)] {
        let file = tiles.join(format!("{name}.png"));
        let listed = read(&file).unwrap();
        let spacing = listed.spacing.unwrap();
        assert!(spacing.x < spacing.y && (spacing.y - 92.61).abs() < 1e-9);
        // Without the list.
        let copy = copies.join(format!("{name}.png"));
        std::fs::copy(&file, &copy).unwrap();
        let found = read(&copy).unwrap();
        // A handful of voids at the level of the sea are not to be told from it.
        assert!(
            listed.voids <= voids && listed.voids * 200 >= voids * 199,
            "{}",
            listed.voids
        );
        assert!(
            found.voids * 100 >= voids * 99 && found.voids <= voids,
            "{}",
            found.voids
        );
        for map in [&listed.map, &found.map] {
            let heights = samples(map);
            let width = map.width() as usize;
            let pit = |&i: &usize| {
                heights[i] == 0.0
                    && voids::neighbours(i, width, width)
                        .filter(|&n| heights[n] > 100.0)
                        .count()
                        > 0
            };
            // The steep shores of a fjord.
            assert!((0..heights.len()).filter(pit).count() < 30, "{name}");
        }
    }
    std::fs::remove_dir_all(copies).unwrap();
}
