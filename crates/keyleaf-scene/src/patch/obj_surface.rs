//! One `surf` of a Wavefront OBJ file, from its statements to a surface.

use std::path::Path;

use glam::DVec3;
use keyleaf_surface::{NurbsSurface, PatchError};

use crate::error::{FilePlace, ImportError};
use crate::soup::check_finite;

use super::obj::Vertex;

/// Ends of a domain are equal if they differ by less than this part of its length.
const ROUNDING: f64 = 1e-9;

const DIRECTIONS: [&str; 2] = ["u", "v"];

/// What `cstype` says.
pub(super) struct CurveType {
    pub is_rational: bool,
    pub name: String,
    pub line: usize,
}

/// What holds for all elements that follow.
#[derive(Default)]
pub(super) struct State {
    pub curve_type: Option<CurveType>,
    /// The numbers after `deg`, and its line.
    pub degree: Option<(Vec<u32>, usize)>,
}

/// The statements from `surf` to `end`.
pub(super) struct Body {
    pub line: usize,
    pub is_trimmed: bool,
    /// From where to where in u and in v.
    range: [[f64; 2]; 2],
    controls: Vec<u32>,
    /// The numbers after `parm u` and `parm v`, and their lines.
    parameters: [Option<(Vec<f64>, usize)>; 2],
}

impl Body {
    pub fn new(line: usize, range: [[f64; 2]; 2], controls: Vec<u32>) -> Self {
        Self {
            line,
            is_trimmed: false,
            range,
            controls,
            parameters: [None, None],
        }
    }

    /// What follows `parm`.
    pub fn parameters<'a>(
        &mut self,
        file: &Path,
        line: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ImportError> {
        let malformed = |reason: String| ImportError::malformed(file, FilePlace::Line(line), reason);
        let mut words = words;
        let direction = words.next();
        let axis = DIRECTIONS.iter().position(|name| Some(*name) == direction);
        let axis = axis.ok_or_else(|| malformed("expected 'parm u' or 'parm v'".into()))?;
        let mut values: Vec<f64> = Vec::new();
        for word in words {
            let value = word.parse();
            values.push(value.map_err(|_| malformed(format!("'{word}' after 'parm' is no number")))?);
        }
        check_finite(file, || FilePlace::Line(line), "parm", &values)?;
        if self.parameters[axis].is_some() {
            return Err(malformed(format!("'parm {}' is there twice", DIRECTIONS[axis])));
        }
        self.parameters[axis] = Some((values, line));
        Ok(())
    }

    /// The surface that these statements describe.
    pub fn surface(&self, file: &Path, state: &State, vertices: &[Vertex]) -> Result<NurbsSurface, ImportError> {
        let malformed = |line, reason: String| ImportError::malformed(file, FilePlace::Line(line), reason);
        let Some(curve_type) = &state.curve_type else {
            return Err(malformed(self.line, "there is no 'cstype' before this surface".into()));
        };
        let (degree, degree_line) = match &state.degree {
            Some((degree, line)) => match degree[..] {
                [u, v] => ([u, v], *line),
                _ => return Err(malformed(*line, "a surface needs two degrees after 'deg'".into())),
            },
            None => return Err(malformed(self.line, "there is no 'deg' before this surface".into())),
        };
        let mut knots = [Vec::new(), Vec::new()];
        let mut lines = [self.line; 2];
        for axis in 0..2 {
            let Some((values, line)) = &self.parameters[axis] else {
                let reason = format!("this surface has no 'parm {}'", DIRECTIONS[axis]);
                return Err(malformed(self.line, reason));
            };
            if !(1..=7).contains(&degree[axis]) {
                let reason = PatchError::Degree {
                    direction: DIRECTIONS[axis],
                    degree: degree[axis],
                };
                return Err(malformed(degree_line, reason.to_string()));
            }
            lines[axis] = *line;
            knots[axis] = match curve_type.name.as_str() {
                "bspline" => values.clone(),
                "bezier" => bezier_knots(degree[axis], values).map_err(|reason| malformed(*line, reason))?,
                other => {
                    let reason = format!("'{other}' surfaces are not read; expected bezier or bspline");
                    return Err(ImportError::unsupported(file, FilePlace::Line(curve_type.line), reason));
                }
            };
        }
        let (points, weights) = self.controls(file, vertices, curve_type.is_rational)?;
        let surface = NurbsSurface::new(degree, knots, points, weights)
            .map_err(|error| malformed(self.line_of(&error, lines), error.to_string()))?;
        self.check_range(file, surface.domain())?;
        Ok(surface)
    }

    fn controls(
        &self,
        file: &Path,
        vertices: &[Vertex],
        is_rational: bool,
    ) -> Result<(Vec<DVec3>, Vec<f64>), ImportError> {
        let mut points = Vec::with_capacity(self.controls.len());
        let mut weights = Vec::with_capacity(self.controls.len());
        for &control in &self.controls {
            let vertex = &vertices[control as usize];
            let weight = if is_rational { vertex.weight } else { 1.0 };
            let is_possible = weight > 0.0;
            if !is_possible {
                let line = self.line;
                let reason =
                    format!("the weight of this vertex is {weight}; the surface of line {line} needs one above 0");
                return Err(ImportError::malformed(file, FilePlace::Line(vertex.line), reason));
            }
            points.push(vertex.position);
            weights.push(weight);
        }
        Ok((points, weights))
    }

    /// The line of what is wrong.
    fn line_of(&self, error: &PatchError, knots: [usize; 2]) -> usize {
        match error {
            PatchError::KnotCount { direction, .. }
            | PatchError::Knot { direction, .. }
            | PatchError::KnotDecreases { direction, .. }
            | PatchError::Multiplicity { direction, .. }
            | PatchError::EmptyDomain { direction, .. }
            | PatchError::ShortSpan { direction, .. } => knots[usize::from(*direction == "v")],
            _ => self.line,
        }
    }

    /// Refuses a surface that is not all of what its knots describe.
    fn check_range(&self, file: &Path, domain: [[f64; 2]; 2]) -> Result<(), ImportError> {
        for axis in 0..2 {
            let ([from, to], [first, last]) = (self.range[axis], domain[axis]);
            let least = ROUNDING * (last - first);
            if (from - first).abs() <= least && (to - last).abs() <= least {
                continue;
            }
            let direction = DIRECTIONS[axis];
            let reason = format!("from {from} to {to} in {direction}, where 'parm' gives {first} to {last}");
            let place = FilePlace::Line(self.line);
            let is_part = from >= first - least && from < to && to <= last + least;
            return Err(if is_part {
                let reason =
                    format!("{reason}: parts of surfaces are not read; insert knots there, and leave out the rest");
                ImportError::unsupported(file, place, reason)
            } else {
                ImportError::malformed(file, place, reason)
            });
        }
        Ok(())
    }
}

/// The knots of Bézier segments between these parameters: degree + 1 at both ends, degree between segments.
fn bezier_knots(degree: u32, breaks: &[f64]) -> Result<Vec<f64>, String> {
    if breaks.len() < 2 {
        return Err(format!(
            "a Bézier surface needs at least 2 parameters, found {}",
            breaks.len()
        ));
    }
    if let Some(pair) = breaks.windows(2).find(|pair| pair[1] <= pair[0]) {
        return Err(format!(
            "the parameter {} is not above the one before it, {}",
            pair[1], pair[0]
        ));
    }
    let last = breaks.len() - 1;
    let copies = |(place, &value): (usize, &f64)| {
        let extra = usize::from(place == 0 || place == last);
        std::iter::repeat_n(value, degree as usize + extra)
    };
    Ok(breaks.iter().enumerate().flat_map(copies).collect())
}
