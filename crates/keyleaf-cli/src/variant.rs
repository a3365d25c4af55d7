//! Settings that are swept: `edge=1,2,4`, each value a variant.

use crate::arguments::{parse_back_faces, parse_morph, parse_pairs};
use anyhow::{Context, bail, ensure};
use keyleaf::{Balance, Metric, Settings};
use std::collections::BTreeMap;

/// A setting and the values that it takes in turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    name: &'static str,
    values: Vec<String>,
}

/// A name and what its values are.
const NAMES: [(&str, &str); 11] = [
    ("edge", "pixels"),
    ("deviation", "pixels"),
    ("distance", "a factor"),
    ("base-grid", "0 to 6"),
    ("max-level", "0 to 31 - k"),
    ("settle", "passes a frame, 1 to 64"),
    (
        "guard",
        "the part of the threshold outside the view, above 0, at most 1",
    ),
    ("back-faces", "drawn, hidden, leaves, light, strong or conservative"),
    ("morph", "none or geomorph"),
    ("pairs", "forced or wished"),
    ("neighbours", "on or off"),
];

/// What a sweep looks like, for `--help`.
pub fn parse_sweep(text: &str) -> anyhow::Result<Sweep> {
    let names = || NAMES.map(|(name, _)| name).join(", ");
    let (name, values) = text
        .split_once('=')
        .with_context(|| format!("expected NAME=VALUE,VALUE… with one of the names {}", names()))?;
    let known = NAMES.iter().find(|(known, _)| *known == name.trim());
    let (name, _) = known.with_context(|| format!("no setting '{name}' to sweep: expected one of {}", names()))?;
    let values: Vec<String> = values.split(',').map(|value| value.trim().to_owned()).collect();
    let sweep = Sweep { name, values };
    for value in &sweep.values {
        apply(sweep.name, value, &mut Settings::default())?;
    }
    Ok(sweep)
}

/// One value for each sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variant(Vec<(&'static str, String)>);

impl Variant {
    /// All combinations of sweeps, the first one outermost; one variant that changes nothing without sweeps.
    pub fn all(sweeps: &[Sweep]) -> Vec<Self> {
        sweeps.iter().fold(vec![Self::default()], |variants, sweep| {
            let with = |variant: &Self, value: &String| {
                let mut values = variant.0.clone();
                values.push((sweep.name, value.clone()));
                Self(values)
            };
            variants
                .iter()
                .flat_map(|variant| sweep.values.iter().map(move |value| with(variant, value)))
                .collect()
        })
    }

    /// `edge=4 base-grid=2`; empty where it changes nothing.
    pub fn name(&self) -> String {
        let texts: Vec<String> = self.0.iter().map(|(name, value)| format!("{name}={value}")).collect();
        texts.join(" ")
    }

    /// Settings with its values.
    pub fn apply(&self, settings: &mut Settings) -> anyhow::Result<()> {
        self.0.iter().try_for_each(|(name, value)| apply(name, value, settings))
    }
}

fn apply(name: &str, value: &str, settings: &mut Settings) -> anyhow::Result<()> {
    let expected = NAMES
        .iter()
        .find(|(known, _)| *known == name)
        .map_or("", |(_, values)| values);
    let wrong = || format!("--sweep {name}: '{value}' is no value; expected {expected}");
    let number = || -> anyhow::Result<f32> {
        let number: f32 = value.parse().with_context(wrong)?;
        ensure!(number > 0.0 && number.is_finite(), wrong());
        Ok(number)
    };
    let count = || value.parse::<u32>().with_context(wrong);
    match name {
        "edge" => settings.set_metric(Metric::Edge { pixels: number()? }),
        "deviation" => settings.set_metric(Metric::Deviation { pixels: number()? }),
        "distance" => settings.set_metric(Metric::Distance { factor: number()? }),
        "base-grid" => {
            settings.base_grid = count()?;
            settings.max_level = settings
                .max_level
                .min(keyleaf::key::MAX_LEVEL.saturating_sub(settings.base_grid));
        }
        "max-level" => settings.max_level = count()?,
        "settle" => settings.settle = count()?,
        "guard" => settings.guard_factor = number()?,
        "back-faces" => settings.back_faces = parse_back_faces(value).with_context(wrong)?,
        "morph" => settings.morph = parse_morph(value).with_context(wrong)?,
        "pairs" => settings.pairs = parse_pairs(value).with_context(wrong)?,
        "neighbours" => {
            settings.balance = match value {
                "on" => Balance::Table,
                "off" => Balance::Off,
                _ => bail!(wrong()),
            }
        }
        _ => bail!(wrong()),
    }
    settings.validate().with_context(wrong)
}

/// What a record says of settings.
pub fn described(settings: &Settings) -> BTreeMap<String, String> {
    let metric = match settings.metric {
        Metric::Edge { pixels } => format!("edge {pixels} px"),
        Metric::Deviation { pixels } => format!("deviation {pixels} px"),
        Metric::Distance { factor } => format!("distance {factor}"),
        other => format!("{other:?}"),
    };
    [
        ("metric", metric),
        ("base_grid", settings.base_grid.to_string()),
        ("capacity", settings.capacity.to_string()),
        ("max_level", settings.max_level.to_string()),
        ("settle", settings.settle.to_string()),
        ("target_leaves", settings.target_leaves.to_string()),
        ("guard_band", settings.guard_band.to_string()),
        ("guard_factor", settings.guard_factor.to_string()),
        ("cull", settings.cull.to_string()),
        ("back_faces", settings.back_faces.name().to_owned()),
        ("morph", settings.morph.name().to_owned()),
        ("pairs", settings.pairs.name().to_owned()),
        ("neighbours", (settings.balance == Balance::Table).to_string()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeps_make_every_combination() {
        let sweeps = ["edge=2,4", "base-grid=1,2"].map(|text| parse_sweep(text).unwrap());
        let names: Vec<String> = Variant::all(&sweeps).iter().map(Variant::name).collect();
        let expected = [
            "edge=2 base-grid=1",
            "edge=2 base-grid=2",
            "edge=4 base-grid=1",
            "edge=4 base-grid=2",
        ];
        assert_eq!(names, expected);
        assert_eq!(Variant::all(&[]), [Variant::default()]);
        let mut settings = Settings::default();
        Variant::all(&sweeps)[2].apply(&mut settings).unwrap();
        assert_eq!((settings.metric, settings.base_grid), (Metric::Edge { pixels: 4.0 }, 1));
    }

    #[test]
    fn what_cannot_be_swept_is_refused_with_what_can() {
        let message = |text: &str| format!("{:#}", parse_sweep(text).unwrap_err());
        assert!(message("colour=1").contains("base-grid"));
        assert!(message("edge").contains("NAME=VALUE"));
        for wrong in [
            "edge=",
            "edge=0",
            "edge=1,x",
            "base-grid=7",
            "neighbours=maybe",
            "morph=yes",
            "settle=0",
        ] {
            assert!(message(wrong).contains("expected"), "{wrong}");
        }
    }
}
