//! Why a surface could not be made or a point not be found.

use keyleaf_key::TopologyError;

/// Why a [`PolygonMesh`](crate::PolygonMesh) is no surface. Faces, corners and vertices are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The faces do not make up a surface.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// A coordinate is NaN, infinite, or too large for f32 arithmetic.
    #[error("vertex {vertex} has the position ({x}, {y}, {z}); expected finite coordinates of at most 1e15")]
    Position {
        /// The vertex.
        vertex: usize,
        /// Its position.
        x: f64,
        /// Its position.
        y: f64,
        /// Its position.
        z: f64,
    },
    /// There is not one value a corner.
    #[error("the mesh has {corners} corners, but {found} {attribute}; expected one a corner")]
    AttributeCount {
        /// What is counted: "texture coordinates", "normals" or "colours".
        attribute: &'static str,
        /// Corners of all faces.
        corners: usize,
        /// Values that were given.
        found: usize,
    },
    /// A texture coordinate is NaN, infinite or too large.
    #[error(
        "corner {corner} of face {face} has the texture coordinate ({u}, {v}); expected finite numbers of at most 65536"
    )]
    TextureCoordinate {
        /// The face.
        face: u32,
        /// The corner of that face.
        corner: u32,
        /// The coordinate.
        u: f32,
        /// The coordinate.
        v: f32,
    },
    /// Displacement by a texture needs to know where in the texture a corner is.
    #[error("the mesh has no texture coordinates, which displacement by a texture needs")]
    NoTextureCoordinates,
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

/// Why samples are no height map. Columns and rows are counted from 0, row 0 is the first of the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HeightMapError {
    /// Fewer than two samples along an edge.
    #[error("the height map has {width} x {height} samples; expected at least 2 x 2")]
    TooSmall {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// More than a texture can hold.
    #[error(
        "the height map has {width} x {height} samples; at most {limit} x {limit} fit a texture: cut it into tiles or reduce it"
    )]
    TooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// [`MAX_MAP_SIDE`](crate::MAX_MAP_SIDE).
        limit: u32,
    },
    /// The number of samples is not width times height.
    #[error("the height map is {width} x {height}, but has {found} samples")]
    SampleCount {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Samples that were given.
        found: usize,
    },
    /// A sample is NaN or infinite, or too large for f32 arithmetic.
    #[error("the sample in column {column}, row {row} is {value}; expected a finite height of at most 1e15")]
    Sample {
        /// Column.
        column: u32,
        /// Row.
        row: u32,
        /// The sample.
        value: f32,
    },
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

/// A setting that is out of range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {value}; expected {expected}")]
pub struct SettingError {
    /// The field.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What is possible.
    pub expected: &'static str,
}

impl SettingError {
    /// An error unless `value` is finite and `holds`.
    pub(crate) fn check(name: &'static str, value: f64, holds: bool, expected: &'static str) -> Result<(), Self> {
        if value.is_finite() && holds {
            Ok(())
        } else {
            Err(Self { name, value, expected })
        }
    }
}

/// Why a point does not exist.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// There is no such face.
    #[error("there is no face {face}: the surface has {faces} faces, counted from 0")]
    Face {
        /// The face.
        face: u32,
        /// How many there are.
        faces: u32,
    },
    /// The face is part of the control mesh only.
    #[error(
        "face {face} is not drawn: it touches a boundary, and the boundary rule is none; choose another face or rule"
    )]
    NotDrawn {
        /// The face.
        face: u32,
    },
    /// Only surfaces with knots have parameters besides those of their faces.
    #[error("the surface has no parameters of its own; expected face,u,v")]
    NoOwnParameters,
    /// There is no such surface in the model.
    #[error("there is no surface {surface}: the model has {surfaces} surfaces, counted from 0")]
    Surface {
        /// The surface.
        surface: u32,
        /// How many there are.
        surfaces: u32,
    },
    /// The parameters lie outside the domain of the surface's knots.
    #[error("({s}, {t}) is not in surface {surface}: expected {} <= s <= {} and {} <= t <= {}",
        domain[0][0], domain[0][1], domain[1][0], domain[1][1])]
    OutsideSurface {
        /// The surface.
        surface: u32,
        /// First parameter.
        s: f64,
        /// Second parameter.
        t: f64,
        /// Least and greatest of both parameters.
        domain: [[f64; 2]; 2],
    },
    /// The parameters lie outside the face.
    #[error("({u}, {v}) is not in face {face}: expected {expected}")]
    OutOfDomain {
        /// The face.
        face: u32,
        /// First parameter.
        u: f64,
        /// Second parameter.
        v: f64,
        /// The domain of that face.
        expected: &'static str,
    },
}
