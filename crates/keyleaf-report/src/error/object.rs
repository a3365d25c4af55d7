//! All measures of a mesh of drawn triangles in one pass over its samples.

use super::domain::Domain;
use super::foot::{Foot, Search};
use super::lattice::{LatticePoint, lattice};
use super::measure::Sum;
use super::nearest::distance_squared;
use super::screen::{ScreenSums, ScreenView};
use super::tree::Tree;
use super::{DrawnTriangle, ErrorSettings, Measure, MeasureError, ScreenError, silhouette};
use glam::DVec3;
use keyleaf_key::RootPoint;
use keyleaf_surface::{Surface, SurfaceFrame};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Which points count as the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Truth {
    /// [`Surface::frame`]: what the model defines.
    #[default]
    Limit,
    /// [`Surface::drawn`]: what the shaders would give without rounding.
    Drawn,
}

impl Truth {
    /// The frame of a point.
    pub(super) fn frame(self, surface: &dyn Surface, at: RootPoint) -> SurfaceFrame {
        match self {
            Self::Limit => surface.frame(at),
            Self::Drawn => surface.drawn(at),
        }
    }
}

/// How far triangles are from a surface. Distances are over [`diagonal`](Self::diagonal), means over the area of the triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshError {
    /// The length that distances were divided by, object units.
    pub diagonal: f64,
    /// From triangles to the surface. An upper bound, as the search for the nearest point starts beside it and may end early.
    pub forward: Measure,
    /// From the surface over the triangles to the nearest triangle.
    pub backward: Measure,
    /// At equal parameters.
    pub parametric: Measure,
    /// Degrees between normals.
    pub normal: Measure,
    /// The longest edge of the measured triangles, over the diagonal.
    pub longest_edge: f64,
    /// Triangles that were given.
    pub triangles: usize,
    /// Triangles that were measured: all, or every n-th where samples had a limit.
    pub measured: usize,
    /// Samples of them.
    pub samples: usize,
    /// In pixels, if a view was given that sees any of it.
    pub screen: Option<ScreenError>,
}

impl MeshError {
    /// Both directions: the maximum is the Hausdorff distance of the samples.
    pub fn both_ways(&self) -> Measure {
        self.forward.or(self.backward)
    }
}

/// How samples are spread so that they do not exceed their limit.
struct Plan {
    lattice: Vec<LatticePoint>,
    intervals: u32,
    every: usize,
}

impl Plan {
    fn new(triangles: usize, settings: &ErrorSettings) -> Result<Self, MeasureError> {
        if settings.intervals < 2 || !settings.intervals.is_multiple_of(2) || settings.intervals > 64 {
            return Err(MeasureError::Setting {
                name: "intervals",
                value: f64::from(settings.intervals),
                expected: "an even number from 2 to 64",
            });
        }
        let most = settings.most_samples.max(1);
        let fine = lattice(settings.intervals);
        let fits = triangles.saturating_mul(fine.len()) <= most;
        let (lattice, intervals) = if fits {
            (fine, settings.intervals)
        } else {
            (lattice(2), 2)
        };
        let every = triangles.saturating_mul(lattice.len()).div_ceil(most).max(1);
        Ok(Self {
            lattice,
            intervals,
            every,
        })
    }
}

#[derive(Default)]
struct Sums {
    forward: Sum,
    backward: Sum,
    parametric: Sum,
    normal: Sum,
    screen: ScreenSums,
    longest_edge: f64,
}

impl Sums {
    fn join(mut self, other: &Self) -> Self {
        self.forward.join(&other.forward);
        self.backward.join(&other.backward);
        self.parametric.join(&other.parametric);
        self.normal.join(&other.normal);
        self.screen.join(&other.screen);
        self.longest_edge = self.longest_edge.max(other.longest_edge);
        self
    }
}

struct Measurement<'a> {
    surface: &'a dyn Surface,
    truth: Truth,
    lattice: &'a [LatticePoint],
    tree: &'a Tree,
    view: Option<&'a ScreenView>,
}

/// Triangles that a task measures; sums are joined in order, so that results do not depend on scheduling.
const PIECE: usize = 64;

/// Measures triangles against the surface that they stand for, with a view also in pixels.
///
/// Triangles that are not given, because the view culls them, do not count: the surface over them is not measured.
///
/// # Errors
/// [`MeasureError`] if there are no triangles, one is none of the surface, or a setting is out of range.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_report::error::{DrawnTriangle, DrawnVertex, ErrorSettings, measure};
/// use keyleaf_surface::{Faces, Mesh, PolygonMesh, Surface};
///
/// let mut quad = PolygonMesh::default();
/// quad.positions = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 1.0), DVec3::Y];
/// let mut faces = Faces::new();
/// faces.push(&[0, 1, 2, 3]);
/// quad.faces = faces;
/// let surface = Mesh::new(&quad)?; // z = x y
/// let vertex = |u, v| -> Result<DrawnVertex, keyleaf_surface::ParameterError> {
///     let at = surface.face_coord(0, u, v)?;
///     let frame = surface.frame(at);
///     Ok(DrawnVertex { at, position: frame.position, normal: frame.normal })
/// };
/// let (a, b, c, d) = (vertex(0.0, 0.0)?, vertex(1.0, 0.0)?, vertex(1.0, 1.0)?, vertex(0.0, 1.0)?);
/// let triangles = [[a, b, c], [a, c, d]].map(|corners| DrawnTriangle { corners });
/// let error = measure(&surface, &triangles, &ErrorSettings::default(), None)?;
/// // On the diagonal x = y the chord z = x is at most a quarter above z = x².
/// assert!((error.parametric.max * error.diagonal - 0.25).abs() < 1e-12);
/// assert!(error.forward.max < error.parametric.max);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(
    surface: &dyn Surface,
    triangles: &[DrawnTriangle],
    settings: &ErrorSettings,
    view: Option<&ScreenView>,
) -> Result<MeshError, MeasureError> {
    if triangles.is_empty() {
        return Err(MeasureError::Empty);
    }
    let plan = Plan::new(triangles.len(), settings)?;
    let diagonal = diagonal_of(surface, settings.diagonal)?;
    let domains = triangles
        .iter()
        .enumerate()
        .map(|(i, t)| t.domain(i, surface.topology()));
    let domains: Vec<Domain> = domains.collect::<Result<_, _>>()?;
    let tree = Tree::new(triangles.iter().map(DrawnTriangle::positions).collect());
    let measurement = Measurement {
        surface,
        truth: settings.truth,
        lattice: &plan.lattice,
        tree: &tree,
        view,
    };
    let chosen: Vec<(&DrawnTriangle, Domain)> = triangles
        .iter()
        .zip(domains.iter().copied())
        .step_by(plan.every)
        .collect();
    let pieces: Vec<Sums> = chosen
        .par_chunks(PIECE)
        .map(|piece| {
            let mut sums = Sums::default();
            piece
                .iter()
                .try_for_each(|(t, domain)| measurement.add(t, *domain, &mut sums))?;
            Ok(sums)
        })
        .collect::<Result<_, MeasureError>>()?;
    let sums = pieces.iter().fold(Sums::default(), Sums::join);
    let contour = match view {
        Some(view) => silhouette::measure(surface, settings.truth, triangles, &domains, view, plan.intervals)?,
        None => None,
    };
    Ok(MeshError {
        diagonal,
        forward: sums.forward.measure().over(diagonal),
        backward: sums.backward.measure().over(diagonal),
        parametric: sums.parametric.measure().over(diagonal),
        normal: sums.normal.measure(),
        longest_edge: sums.longest_edge / diagonal,
        triangles: triangles.len(),
        measured: chosen.len(),
        samples: chosen.len() * plan.lattice.len(),
        screen: view.and_then(|_| sums.screen.error(contour)),
    })
}

/// The given length, or the diagonal of the surface's box.
pub(super) fn diagonal_of(surface: &dyn Surface, given: Option<f64>) -> Result<f64, MeasureError> {
    let (low, high) = surface.bounding_box();
    let diagonal = given.unwrap_or(low.distance(high));
    if diagonal.is_finite() && diagonal > 0.0 {
        return Ok(diagonal);
    }
    Err(MeasureError::Setting {
        name: "diagonal",
        value: diagonal,
        expected: "a length above 0",
    })
}

impl Measurement<'_> {
    fn add(&self, triangle: &DrawnTriangle, domain: Domain, sums: &mut Sums) -> Result<(), MeasureError> {
        let parameters = triangle.corners.map(|corner| domain.parameters(corner.at));
        let positions = triangle.positions();
        let area = triangle.area_vector().length();
        let pixels = self.view.map_or(0.0, |view| view.area(positions));
        sums.longest_edge = sums.longest_edge.max(triangle.longest_edge());
        for point in self.lattice {
            let [a, b, c] = point.weights;
            let (drawn, normal) = triangle.at(point.weights);
            let at = domain.point(self.surface, parameters[0] * a + parameters[1] * b + parameters[2] * c)?;
            let evaluate = |at| self.truth.frame(self.surface, at);
            let start = Foot {
                at,
                frame: evaluate(at),
            };
            let search = Search {
                surface: self.surface,
                evaluate,
                target: drawn,
            };
            let foot = search.nearest(start)?.frame;
            let over = start.frame.position;
            let own = distance_squared(over, positions);
            let forward = drawn.distance(foot.position);
            let weight = area * point.area;
            sums.forward.add(forward, weight);
            sums.backward.add(self.tree.distance_squared(over, own).sqrt(), weight);
            sums.parametric.add(drawn.distance(over), weight);
            sums.normal.add(degrees_between(normal, foot.normal), weight);
            if let Some(view) = self.view {
                sums.screen.add(view, drawn, foot.position, pixels * point.area);
            }
        }
        Ok(())
    }
}

/// 180 for a vector without a direction.
fn degrees_between(a: DVec3, b: DVec3) -> f64 {
    if a == DVec3::ZERO || b == DVec3::ZERO {
        return 180.0;
    }
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}
