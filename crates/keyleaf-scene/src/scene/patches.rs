//! Sources that are Bézier and NURBS surfaces: files of them, or control points written into the scene.

use glam::DVec3;
use keyleaf_surface::{BasisMethod, NurbsSurface, PatchError};
use serde::{Deserialize, Serialize};

use super::control_point::ControlPoint;
use super::error::Problem;

/// The surfaces of a file: .bpt, .obj with `surf` statements, .teaset, .dat or no ending (Newell's tea set).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatchesSource {
    /// The file.
    pub path: String,
    /// Boundaries join when they are no farther apart than this part of the diagonal of the model's box; 0 to 0.01, default 1e-6.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
    /// How basis functions are computed; default `None`: single Bézier patches by their own shader, all else `Triangular`.
    #[serde(default)]
    pub basis: Option<Basis>,
    /// Whether trimmed surfaces are drawn whole; else they are refused. Default false.
    #[serde(default)]
    pub ignore_trims: bool,
    /// Whether knot spans are cut into 2, 4 or 8 equal parts where knot-span quads are long and narrow, so that they take fewer
    /// triangles; the shape and the joins stay, and faces are numbered by the new quads. Not for single Bézier patches without `basis`.
    /// Default false.
    #[serde(default)]
    pub even_spans: bool,
}

impl PatchesSource {
    /// A file with defaults for all but its path.
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            tolerance: tolerance(),
            basis: None,
            ignore_trims: false,
            even_spans: false,
        }
    }
}

/// NURBS surfaces, written into the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NurbsSource {
    /// At least one.
    pub surfaces: Vec<NurbsPatch>,
    /// See [`PatchesSource::tolerance`]; default 1e-6.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
    /// How basis functions are computed; default `Triangular`.
    #[serde(default)]
    pub basis: Basis,
    /// See [`PatchesSource::even_spans`]; default false.
    #[serde(default)]
    pub even_spans: bool,
}

/// One NURBS surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NurbsPatch {
    /// In u and v, each 1 to 7; default (3, 3).
    #[serde(default = "cubic")]
    pub degree: [u32; 2],
    /// Knots in u, as many as a row has points, and degree + 1 more; none less than the one before. Default `None`: clamped and
    /// uniform, 0 at the start and 1 more with every span.
    #[serde(default)]
    pub knots_u: Option<Vec<f64>>,
    /// Knots in v, as many as there are rows, and degree + 1 more. Default `None`: as for u.
    #[serde(default)]
    pub knots_v: Option<Vec<f64>>,
    /// Rows of control points: u runs along a row, v from row to row.
    pub points: Vec<Vec<ControlPoint>>,
}

/// Bézier patches, written into the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BezierSource {
    /// At least one. Each is a list of rows of control points: u runs along a row, v from row to row. A patch of degree p in u and q
    /// in v, each 1 to 7, has q + 1 rows of p + 1 points.
    pub patches: Vec<Vec<Vec<ControlPoint>>>,
    /// See [`PatchesSource::tolerance`]; default 1e-6.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// How the basis functions of NURBS are computed. All give the same surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Basis {
    /// The triangular scheme (Piegl & Tiller A2.2), its loops written out where no degree is above 3.
    #[default]
    Triangular,
    /// The triangular scheme by loops, which degrees above 3 take anyway.
    Loops,
    /// The stair strategy (Concheiro).
    Stair,
    /// De Boor's algorithm.
    DeBoor,
    /// Bernstein polynomials, and an extraction matrix for each span.
    Extraction,
    /// No basis functions: coefficients of powers, made once a knot-span quad (Concheiro 2.2). For samples it is fast; at collapsed edges
    /// normals are less exact.
    Power,
}

impl From<Basis> for BasisMethod {
    fn from(basis: Basis) -> Self {
        match basis {
            Basis::Triangular => Self::Triangular,
            Basis::Loops => Self::Loops,
            Basis::Stair => Self::Stair,
            Basis::DeBoor => Self::DeBoor,
            Basis::Extraction => Self::Extraction,
            Basis::Power => Self::Power,
        }
    }
}

impl NurbsPatch {
    /// The surface; the field of a problem is relative to this patch.
    pub(crate) fn surface(&self) -> Result<NurbsSurface, Problem> {
        let counts = counts(&self.points, "points")?;
        let [u, v] = [0, 1].map(|axis| self.knots(axis, counts[axis]));
        surface(self.degree, [u?, v?], &self.points).map_err(|error| {
            let field = match field_of(&error) {
                Place::Degree => "degree".to_owned(),
                Place::Knots(direction, None) => format!("knots_{direction}"),
                Place::Knots(direction, Some(index)) => format!("knots_{direction}[{index}]"),
                Place::Point(index) => format!("points[{}][{}]", index / counts[0], index % counts[0]),
                Place::Whole => "points".to_owned(),
            };
            Problem::new(field, error.to_string())
        })
    }

    /// The knots of a direction with this many control points.
    fn knots(&self, axis: usize, count: usize) -> Result<Vec<f64>, Problem> {
        let degree = self.degree[axis];
        if !(1..=7).contains(&degree) {
            let direction = ["u", "v"][axis];
            return Err(Problem::new(
                "degree",
                PatchError::Degree { direction, degree }.to_string(),
            ));
        }
        let (given, name, what) = [
            (&self.knots_u, "knots_u", "points a row"),
            (&self.knots_v, "knots_v", "rows"),
        ][axis];
        let order = degree as usize + 1;
        match given {
            None if count < order => {
                let problem = format!("{count} {what} are too few for degree {degree}; expected at least {order}");
                Err(Problem::new("points", problem))
            }
            None => Ok(clamped_uniform(degree, count)),
            Some(knots) if knots.len() != count + order => {
                let (found, expected) = (knots.len(), count + order);
                let problem = format!("{found} knots; {count} {what} of degree {degree} need {expected}");
                Err(Problem::new(name, problem))
            }
            Some(knots) => Ok(knots.clone()),
        }
    }
}

/// The surface of a Bézier patch; the field of a problem is relative to it, and empty for the patch itself.
pub(crate) fn bezier_surface(rows: &[Vec<ControlPoint>]) -> Result<NurbsSurface, Problem> {
    let counts = counts(rows, "")?;
    let degree = counts.map(|count| u32::try_from(count - 1).unwrap_or(u32::MAX));
    let knots = [0, 1].map(|axis| clamped_uniform(degree[axis].clamp(1, 7), counts[axis].min(8)));
    surface(degree, knots, rows).map_err(|error| {
        let field = match field_of(&error) {
            Place::Point(index) => format!("[{}][{}]", index / counts[0], index % counts[0]),
            _ => String::new(),
        };
        Problem::new(field, error.to_string())
    })
}

fn surface(degree: [u32; 2], knots: [Vec<f64>; 2], rows: &[Vec<ControlPoint>]) -> Result<NurbsSurface, PatchError> {
    let points = rows.iter().flatten().map(|point| DVec3::from(point.position));
    let weights = rows.iter().flatten().map(|point| point.weight);
    NurbsSurface::new(degree, knots, points.collect(), weights.collect())
}

/// Points a row, and rows, each at least one; `field` is that of the rows.
fn counts(rows: &[Vec<ControlPoint>], field: &str) -> Result<[usize; 2], Problem> {
    let Some(first) = rows.first() else {
        return Err(Problem::new(field, "there are no control points"));
    };
    let row_field = |row: usize| format!("{field}[{row}]");
    if first.is_empty() {
        return Err(Problem::new(row_field(0), "the row has no control points"));
    }
    if let Some(row) = rows.iter().position(|row| row.len() != first.len()) {
        let (found, expected) = (rows[row].len(), first.len());
        let problem = format!("the row has {found} control points, the first has {expected}");
        return Err(Problem::new(row_field(row), problem));
    }
    Ok([first.len(), rows.len()])
}

/// Where in a patch something is wrong.
enum Place {
    Degree,
    Knots(&'static str, Option<usize>),
    Point(usize),
    Whole,
}

fn field_of(error: &PatchError) -> Place {
    match *error {
        PatchError::Degree { .. } => Place::Degree,
        PatchError::KnotCount { direction, .. } | PatchError::EmptyDomain { direction, .. } => {
            Place::Knots(direction, None)
        }
        PatchError::Knot { direction, index, .. }
        | PatchError::KnotDecreases { direction, index, .. }
        | PatchError::Multiplicity { direction, index, .. }
        | PatchError::ShortSpan { direction, index, .. } => Place::Knots(direction, Some(index)),
        PatchError::Point { index, .. } | PatchError::Weight { index, .. } => Place::Point(index),
        _ => Place::Whole,
    }
}

/// Clamped uniform knots for at least degree + 1 control points: 0 at the start, 1 more with every span.
fn clamped_uniform(degree: u32, count: usize) -> Vec<f64> {
    let degree = degree as usize;
    let last = count.saturating_sub(degree).max(1);
    (0..count + degree + 1)
        .map(|index| index.saturating_sub(degree).min(last) as f64)
        .collect()
}

fn tolerance() -> f64 {
    1e-6
}

fn cubic() -> [u32; 2] {
    [3, 3]
}
