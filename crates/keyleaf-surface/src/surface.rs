//! What every surface answers, and what the GPU reads of it.

use crate::{ParameterError, Patches, PoseShader, PoseTables, coordinate};
use glam::DVec3;
use keyleaf_key::{Place, RootPoint, Topology};
use std::sync::Arc;

/// A surface over the faces of a mesh. The twin of the WGSL functions `surface_point`, `surface_frame` and `surface_bound`.
///
/// Points must exist: a face and root of the topology, x + y at most [`ONE`](keyleaf_key::ONE).
pub trait Surface: Send + Sync {
    /// The faces and how they meet.
    fn topology(&self) -> &Topology;

    /// The position of a point, in object space.
    fn point(&self, at: RootPoint) -> DVec3;

    /// Position, derivatives and normal of a point.
    fn frame(&self, at: RootPoint) -> SurfaceFrame;

    /// The frame as the shader computes it, but in f64. Another one than [`frame`](Self::frame) only where a surface is drawn by an
    /// approximation of itself.
    fn drawn(&self, at: RootPoint) -> SurfaceFrame {
        self.frame(at)
    }

    /// Bounds of the diamond of a leaf; both of its halves give the same.
    fn bound(&self, leaf: &Place) -> SurfaceBound;

    /// Least and greatest coordinates of a box that holds the whole surface.
    fn bounding_box(&self) -> (DVec3, DVec3);

    /// The WGSL file of the twin, relative to the folder `shaders`.
    fn shader(&self) -> &'static str;

    /// The model of Bézier or NURBS surfaces that this is, if it is one.
    fn as_patches(&self) -> Option<&Patches> {
        None
    }

    /// What the GPU reads, for positions relative to `origin` (object space).
    fn tables(&self, origin: DVec3) -> SurfaceTables;

    /// The WGSL by which the GPU poses the surface when its control mesh moves; none where the tables are made anew for each pose.
    fn pose_shader(&self) -> Option<PoseShader> {
        None
    }

    /// What it reads besides for that; some where there is a shader.
    fn pose_tables(&self) -> Option<PoseTables> {
        None
    }

    /// The point with face-local parameters (u, v), to the nearest multiple of 2⁻³¹.
    ///
    /// Quads: the unit square with corners 0..3 at (0, 0), (1, 0), (1, 1), (0, 1). Triangles: corners (0, 0), (1, 0), (0, 1).
    /// Polygons with n > 4 corners: u in 0..=n runs along the boundary, corner r at (r, 0), and v = 1 is the centre.
    ///
    /// # Errors
    /// [`ParameterError`] if there is no such face or (u, v) is NaN or outside it.
    fn face_coord(&self, face: u32, u: f64, v: f64) -> Result<RootPoint, ParameterError> {
        coordinate::root_point(self.topology(), face, u, v)
    }

    /// The point with the parameters (s, t) of one of the surfaces of a model, such as the knots of a NURBS surface, to the nearest
    /// multiple of 2⁻³¹ of its face. At a knot it belongs to the span on the right; at the end of the domain, to the last.
    ///
    /// # Errors
    /// [`ParameterError`] if the surface has no parameters besides those of its faces, there is no such surface, or (s, t) is NaN or
    /// outside its domain.
    fn own_coord(&self, surface: u32, s: f64, t: f64) -> Result<OwnCoord, ParameterError> {
        let _ = (surface, s, t);
        Err(ParameterError::NoOwnParameters)
    }
}

/// A point that was given by the parameters (s, t) of a surface of a model.
///
/// With the frame there, the derivatives are ∂/∂s = `rates[0]` · du and ∂/∂t = `rates[1]` · dv, and the surface's own normal is the
/// frame's. Where `transposed`, du and dv change places and the surface's own normal is opposite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnCoord {
    /// The point.
    pub at: RootPoint,
    /// How fast the face's parameter that follows s, and the one that follows t, grow with it.
    pub rates: [f64; 2],
    /// Whether s is the face's second parameter, and t its first.
    pub transposed: bool,
}

impl OwnCoord {
    /// A point whose parameters are those of its face.
    pub fn of_face(at: RootPoint) -> Self {
        Self {
            at,
            rates: [1.0; 2],
            transposed: false,
        }
    }

    /// The point (s, t) of a surface that is one face over the unit square.
    pub(crate) fn of_square(topology: &Topology, surface: u32, s: f64, t: f64) -> Result<Self, ParameterError> {
        if surface != 0 {
            return Err(ParameterError::Surface { surface, surfaces: 1 });
        }
        coordinate::root_point(topology, 0, s, t).map(Self::of_face)
    }
}

/// A point with its tangent plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceFrame {
    /// Position, object space.
    pub position: DVec3,
    /// Derivative in the face's first parameter (see [`Surface::face_coord`]).
    pub du: DVec3,
    /// Derivative in the second parameter.
    pub dv: DVec3,
    /// The direction of du × dv, of unit length also where that vanishes.
    pub normal: DVec3,
}

/// Bounds of the diamond of a leaf: the leaf and the node across its hypotenuse. Lengths in object units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceBound {
    /// The middle of the hypotenuse, on the surface.
    pub centre: DVec3,
    /// The ball about the centre that holds the surface over the diamond. For culling.
    pub radius: f64,
    /// Bounds half the length of the drawn hypotenuse and of the median from above; at most half the parent's. For metrics.
    pub size: f64,
    /// Radius of a ball about the centre that holds those of the children. For the guard band.
    pub guard: f64,
    /// Bounds the distance between the surface over the diamond and flat triangles of this level with corners on it.
    ///
    /// For [`Mesh`](crate::Mesh) and [`Patches`](crate::Patches) from second derivatives, at most a quarter of the parent's. For other
    /// surfaces [`size`](Self::size), which bounds how far a point is from the nearest corner.
    pub deviation: f64,
    /// The same for the halves of such a triangle on both sides of its median, which are drawn in the place of two children each.
    pub pair_deviation: f64,
}

/// How long the edges of half a triangle are, by those of the whole.
pub(crate) const HALF_LEVEL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What a surface module reads in group 1: binding 0 `params`, 2 `a`, 3 `b`, 4 `heights`, 5 `height_bounds`. An empty table or
/// absent texture is not declared by the module.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceTables {
    /// The uniform `surface`.
    pub params: Vec<u8>,
    /// The storage buffer `surface_a`.
    pub a: Vec<f32>,
    /// The storage buffer `surface_b`.
    pub b: Vec<u32>,
    /// The texture `heights`, R32Float. Shared: it does not depend on the origin.
    pub heights: Option<Arc<TextureData>>,
    /// The texture `height_bounds`, RGBA32Float with mip levels. Shared likewise.
    pub height_bounds: Option<Arc<TextureData>>,
}

/// The texels of a two-dimensional texture of 32-bit floats.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureData {
    /// Texels a row of level 0. Level m has `max(1, width >> m)`.
    pub width: u32,
    /// Rows of level 0.
    pub height: u32,
    /// Floats a texel: 1 (R32Float) or 4 (RGBA32Float).
    pub channels: u32,
    /// Every mip level, row by row.
    pub mips: Vec<Vec<f32>>,
}

/// The bytes of a uniform, laid out as WGSL does.
pub(crate) fn uniform<T: encase::ShaderType + encase::internal::WriteInto>(params: &T) -> Vec<u8> {
    let mut buffer = encase::UniformBuffer::new(Vec::new());
    match buffer.write(params) {
        Ok(()) => buffer.into_inner(),
        // A growing vector has room for anything.
        Err(_) => Vec::new(),
    }
}
