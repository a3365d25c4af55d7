//! Every shader that a scene can ask for composes and validates, and holds nothing that it did not ask for. No device.

use keyleaf::draw::Sky;
use keyleaf::inspect::Inspector;
use keyleaf::map::MapPipeline;
use keyleaf::shading::{Atmosphere, Channel, Material, Overlay, Tint};
use keyleaf::surface::PoseShader;
use keyleaf::{BackFaces, Balance, Kind, Morph, modules};
use keyleaf_shaders::{FILES, compose, dependencies, label, located, source};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::collections::BTreeSet;

/// What every device of WebGPU can do beyond naga's minimum: `unpack2x16float`.
const CAPABILITIES: Capabilities = Capabilities::SHADER_FLOAT16_IN_FLOAT32;

pub fn files_in(folder: &str) -> Vec<&'static str> {
    FILES
        .iter()
        .map(|(path, _)| *path)
        .filter(|path| path.starts_with(folder))
        .collect()
}

pub fn kinds() -> Vec<Kind> {
    let mut kinds = Vec::new();
    for surface in files_in("surfaces/") {
        for metric in files_in("metrics/") {
            kinds.extend([Balance::Table, Balance::Off].map(|balance| Kind {
                surface,
                metric,
                balance,
                back_faces: BackFaces::Drawn,
                morph: Morph::None,
                pair_metric: None,
                pose: None,
            }));
            kinds.push(Kind {
                surface,
                metric,
                balance: Balance::Table,
                back_faces: BackFaces::Leaves,
                morph: Morph::None,
                pair_metric: Some(pair_metric(metric)),
                pose: None,
            });
        }
        kinds.extend(
            BackFaces::ALL
                .map(|back_faces| Kind {
                    surface,
                    metric: "metrics/edge.wgsl",
                    balance: Balance::Table,
                    back_faces,
                    morph: Morph::None,
                    pair_metric: None,
                    pose: None,
                })
                .into_iter()
                .filter(|kind| kind.validate().is_ok()),
        );
    }
    for (surface, pose) in [
        ("surfaces/catmull_clark.wgsl", PoseShader::CATMULL_CLARK),
        ("surfaces/loop.wgsl", PoseShader::LOOP),
        ("surfaces/qas.wgsl", PoseShader::QAS_LIMIT),
        ("surfaces/qas.wgsl", PoseShader::QAS_BUTTERFLY),
        ("surfaces/pn.wgsl", PoseShader::POINT_NORMAL),
        ("surfaces/gaussian_catmull_clark.wgsl", PoseShader::GAUSSIAN),
        ("surfaces/gaussian_loop.wgsl", PoseShader::GAUSSIAN),
    ] {
        kinds.push(Kind {
            surface,
            metric: "metrics/edge.wgsl",
            balance: Balance::Table,
            back_faces: BackFaces::Drawn,
            morph: Morph::None,
            pair_metric: None,
            pose: Some(pose),
        });
    }
    kinds
}

pub fn channels() -> Vec<Channel> {
    let mut channels = vec![
        Channel::Normal,
        Channel::Level,
        Channel::Position,
        Channel::Error,
        Channel::Overdraw,
    ];
    for material in [
        Material::Plain,
        Material::Terrain,
        Material::Attributes,
        Material::Texture,
        Material::Matcap,
    ] {
        let overlays = Tint::ALL.map(|tint| [false, true].map(|wireframe| Overlay { tint, wireframe }));
        for overlay in overlays.into_iter().flatten() {
            channels.extend([Atmosphere::None, Atmosphere::Haze].map(|air| Channel::Colour(material, overlay, air)));
        }
    }
    channels
}

/// Channels that differ in what their vertices say of themselves; what the pixels do with it is no matter of morphing.
pub fn morphing_channels() -> [Channel; 4] {
    let tinted = |material, tint| Channel::Colour(material, Overlay { tint, wireframe: false }, Atmosphere::None);
    [
        Channel::Position,
        tinted(Material::Texture, Tint::None),
        tinted(Material::Plain, Tint::Error),
        tinted(Material::Plain, Tint::Morph),
    ]
}

/// The file of the size of a pair for that of the size of a leaf.
fn pair_metric(metric: &str) -> &'static str {
    let samples = || dependencies(&[metric]).is_ok_and(|files| files.contains(&"shared/leaf_sample.wgsl"));
    match metric {
        "metrics/deviation.wgsl" => "pairs/deviation.wgsl",
        _ if samples() => "pairs/sampled.wgsl",
        _ => "pairs/of_parent.wgsl",
    }
}

/// A kind of quadtree as far as drawing goes.
pub fn drawn_kind(
    surface: &'static str,
    metric: &'static str,
    morph: Morph,
    pair_metric: Option<&'static str>,
) -> Kind {
    Kind {
        surface,
        metric,
        morph,
        balance: Balance::Table,
        back_faces: BackFaces::Drawn,
        pair_metric,
        pose: None,
    }
}

/// All sets of files that become a module.
fn combinations() -> BTreeSet<Vec<&'static str>> {
    let mut all: BTreeSet<Vec<&'static str>> = kinds().iter().flat_map(modules).map(|module| module.files).collect();
    for surface in files_in("surfaces/") {
        let [emit, evaluate] = Inspector::FILES;
        let drawn = |files: &[&'static str], morph, metric| {
            [files, &drawn_kind(surface, metric, morph, None).drawing_files()].concat()
        };
        let paired = |metric| drawn_kind(surface, metric, Morph::Geomorph, Some(pair_metric(metric)));
        let edge = "metrics/edge.wgsl";
        for channel in channels() {
            all.insert(drawn(&channel.files(), Morph::None, edge));
        }
        for channel in morphing_channels() {
            all.insert(drawn(&channel.files(), Morph::Geomorph, edge));
        }
        all.insert(drawn(&[emit], Morph::None, edge));
        for metric in ["edge", "boundary", "local_area"] {
            let metric = files_in("metrics/")
                .into_iter()
                .find(|file| *file == format!("metrics/{metric}.wgsl"));
            let metric = metric.expect("a metric");
            all.insert(drawn(&[emit], Morph::Geomorph, metric));
            all.insert([vec![emit], paired(metric).drawing_files()].concat());
        }
        all.insert(vec![evaluate, surface]);
        all.insert(MapPipeline::FILES.into_iter().chain([surface]).collect());
    }
    all.insert(Sky::FILES.to_vec());
    all
}

/// A module as naga reads it.
pub fn parse(files: &[&str]) -> naga::Module {
    let source = compose(files).expect("the files exist");
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{files:?}: {}", error.emit_to_string(&source)))
}

/// The names of the functions that a file defines.
fn functions_of(file: &str) -> BTreeSet<&'static str> {
    let text = keyleaf_shaders::source(file).expect("a file");
    text.lines()
        .filter_map(|line| line.strip_prefix("fn "))
        .filter_map(|rest| rest.split_once('('))
        .map(|(name, _)| name)
        .collect()
}

#[test]
fn every_combination_is_valid() {
    let all = combinations();
    for files in &all {
        let module = parse(files);
        let validated = Validator::new(ValidationFlags::all(), CAPABILITIES).validate(&module);
        assert!(validated.is_ok(), "{files:?}: {:?}", validated.err());
    }
    println!("{} modules", all.len());
}

#[test]
fn every_file_is_used_by_some_combination() {
    let used: BTreeSet<&str> = combinations()
        .iter()
        .flat_map(|files| dependencies(files).expect("the files exist"))
        .collect();
    let unused: Vec<&str> = FILES
        .iter()
        .map(|(path, _)| *path)
        .filter(|path| !used.contains(path))
        .collect();
    assert_eq!(unused, [] as [&str; 0]);
}

#[test]
fn a_module_has_the_functions_of_its_files_and_no_others() {
    for files in combinations() {
        let own: BTreeSet<&str> = dependencies(&files)
            .expect("the files exist")
            .into_iter()
            .flat_map(functions_of)
            .collect();
        let module = parse(&files);
        let foreign = module
            .functions
            .iter()
            .filter_map(|(_, f)| f.name.as_deref())
            .find(|name| !own.contains(name));
        assert_eq!(foreign, None, "{files:?}");
    }
}

/// Functions of an effect, the effect's name in a file, and who may have them.
#[test]
fn what_a_scene_does_not_name_is_not_in_its_shaders() {
    let effects: [(&str, &[&str]); 10] = [
        ("heights", &["height"]),
        ("morph/geomorph", &["morph/geomorph"]),
        ("noise2", &["terrain.wgsl"]),
        ("noise3", &["displaced_noise"]),
        ("displaced", &["displaced"]),
        ("wire", &["wireframe"]),
        ("haze", &["haze"]),
        ("level_colour", &["tint_level", "draw/level", "draw/map"]),
        ("material_texture", &["material_texture"]),
        ("material_terrain", &["material_terrain"]),
    ];
    for files in combinations() {
        let has = |word: &str| files.iter().any(|file| file.contains(word));
        let composed = dependencies(&files).expect("the files exist");
        for (effect, namers) in effects {
            let is_named = namers.iter().any(|word| has(word)) || (effect == "heights" && has("displaced_texture"));
            let found = composed.iter().find(|file| file.contains(effect));
            assert!(
                is_named || found.is_none(),
                "{files:?} did not name {effect}, but has {found:?}"
            );
        }
        let functions: Vec<String> = parse(&files)
            .functions
            .iter()
            .filter_map(|(_, f)| f.name.clone())
            .collect();
        for (marker, namers) in [
            ("noise", &["noise", "terrain.wgsl"][..]),
            ("height", &["height", "displaced_texture", "terrain"]),
            ("wire", &["wireframe"]),
            ("haze", &["haze"]),
        ] {
            let is_named = namers.iter().any(|word| has(word));
            let found = functions.iter().find(|name| name.contains(marker));
            assert!(
                is_named || found.is_none(),
                "{files:?} did not name {marker}, but has fn {found:?}"
            );
        }
    }
}

#[test]
fn the_update_without_neighbour_test_has_no_table() {
    for kind in kinds().into_iter().filter(|kind| kind.balance == Balance::Off) {
        for module in modules(&kind) {
            let composed = dependencies(&module.files).expect("the files exist");
            let found = composed.iter().find(|file| file.contains("table_"));
            assert_eq!(found, None, "{}", module.name);
        }
    }
}

#[test]
fn what_the_device_complains_of_names_the_file_and_its_line() {
    let gpu = crate::gpu::gpu();
    let all = kinds();
    let kind = all
        .iter()
        .find(|kind| (kind.surface, kind.metric) == ("surfaces/mesh.wgsl", "metrics/edge.wgsl"));
    let measure = modules(kind.unwrap());
    let roots = measure
        .iter()
        .find(|module| module.name == "measure")
        .unwrap()
        .files
        .clone();
    let good = compose(&roots).unwrap();
    let line_of = |text: &str| {
        let lines = source("metrics/edge.wgsl").unwrap().lines();
        1 + lines.into_iter().position(|line| line.contains(text)).unwrap()
    };
    // One that does not parse, and one whose types do not fit: of that naga names the function.
    for (broken, place) in [
        ("return bound.size size;", "return bound.size"),
        ("return leaf.level;", "fn metric_size"),
    ] {
        let line = line_of(place);
        let scope = gpu.device.push_error_scope(keyleaf::wgpu::ErrorFilter::Validation);
        let _refused = gpu.device.create_shader_module(keyleaf::wgpu::ShaderModuleDescriptor {
            label: Some(&label(&roots)),
            source: keyleaf::wgpu::ShaderSource::Wgsl(good.replace("return bound.size;", broken).into()),
        });
        let error = pollster::block_on(scope.pop()).expect("an error").to_string();
        let found = located(&error);
        assert!(
            found.contains(&format!("metrics/edge.wgsl:{line}:")),
            "{error}\n{found}"
        );
    }
}
