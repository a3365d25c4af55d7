//! Tables of exact numbers made by independent code, where the folder that holds them is there.
#![allow(dead_code)]

use serde_json::Value;
use std::path::Path;

/// The table of this name, None and a printed line if there is none.
pub fn oracle(name: &str) -> Option<Value> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/oracles")
        .join(name);
    let Ok(text) = std::fs::read_to_string(&file) else {
        println!("skipped: there is no {}", file.display());
        return None;
    };
    Some(serde_json::from_str(&text).expect("JSON"))
}

/// The elements of an array.
pub fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

/// An array of numbers; what is null is no number.
pub fn floats(value: &Value) -> Vec<f64> {
    list(value).iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

/// An array of arrays of numbers.
pub fn rows(value: &Value) -> Vec<Vec<f64>> {
    list(value).iter().map(floats).collect()
}
