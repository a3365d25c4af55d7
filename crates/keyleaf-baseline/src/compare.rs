//! All methods at all qualities, side by side.

use crate::{BaselineError, Method, Quality, Sampler, Settings, Test, TestKind, View, dabt, deviation, semi_adaptive};

/// Halvings of the range of thresholds.
const BISECTIONS: u32 = 40;
/// Range of thresholds in pixels that is searched.
const PIXELS: [f64; 2] = [1e-9, 1e9];
/// Range of angles of the flat test that is searched, in radians.
const ANGLES: [f64; 2] = [1e-7, std::f64::consts::FRAC_PI_2];

/// A method at a quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// How it was tessellated.
    pub method: Method,
    /// With which thresholds.
    pub quality: Quality,
    /// How many triangles that took.
    pub triangles: usize,
    /// See [`Deviation::max_pixels`](crate::Deviation::max_pixels).
    pub max_error_pixels: f64,
    /// See [`Deviation::mean_pixels`](crate::Deviation::mean_pixels).
    pub mean_error_pixels: f64,
}

/// Tessellates a model with every method at every quality, and measures each. Qualities run from high to low, methods
/// as in [`Method::ALL`].
///
/// # Errors
/// [`BaselineError`] if the model or the view is at fault.
pub fn compare(sampler: &dyn Sampler, view: &View) -> Result<Vec<Row>, BaselineError> {
    let mut rows = Vec::new();
    for quality in Quality::ALL {
        for method in Method::ALL {
            let tessellation = method.tessellate(sampler, view, quality)?;
            let measured = deviation(sampler, view, &tessellation)?;
            rows.push(Row {
                method,
                quality,
                triangles: tessellation.triangles.len(),
                max_error_pixels: measured.max_pixels,
                mean_error_pixels: measured.mean_pixels,
            });
        }
    }
    Ok(rows)
}

/// The settings with which an adaptive method makes a share of the triangles of the full pattern of L_max = 3, such as
/// [`Quality::share`]: how tables 3.1 and 4.1 choose their thresholds.
///
/// Counts come in steps; of the thresholds next to the share, this is the one with more triangles. `None` for uniform
/// methods, which have no test. Costs some forty tessellations.
///
/// # Errors
/// [`BaselineError`] if the model or the view is at fault.
pub fn threshold_for_share(
    sampler: &dyn Sampler,
    view: &View,
    method: Method,
    share: f64,
) -> Result<Option<Settings>, BaselineError> {
    let (Method::SemiAdaptive(kind) | Method::Dabt(kind)) = method else {
        return Ok(None);
    };
    let count = |settings: &Settings| {
        let tessellation = match method {
            Method::SemiAdaptive(_) => semi_adaptive::tessellate(sampler, view, settings),
            _ => dabt::tessellate(sampler, view, settings),
        };
        tessellation.map(|tessellation| tessellation.triangles.len() as f64)
    };
    // A coarseness from 0 to 1, along the logarithm of the threshold.
    let settings = |coarseness: f64| {
        let between = |[from, to]: [f64; 2]| from * (to / from).powf(coarseness);
        Settings::new(match kind {
            TestKind::Distance => Test::Distance {
                pixels: between(PIXELS),
            },
            TestKind::Flat => Test::Flat {
                cosine: between(ANGLES).cos().clamp(0.0, 1.0),
            },
            TestKind::Length => Test::Length {
                pixels: between(PIXELS),
            },
        })
    };
    let target = share * count(&Settings::new(Test::Length { pixels: 0.0 }))?;
    let (mut fine, mut coarse) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = (fine + coarse) / 2.0;
        if count(&settings(middle))? >= target {
            fine = middle;
        } else {
            coarse = middle;
        }
    }
    Ok(Some(settings(fine)))
}
