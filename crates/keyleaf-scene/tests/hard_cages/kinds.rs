//! The kinds of surfaces over control meshes, as a scene names them.

/// Surfaces over polygons.
pub const OF_POLYGONS: [&str; 2] = ["CatmullClark()", "GaussianProduct(covariances: Isotropic(0.4))"];

/// Surfaces over triangles.
pub const OF_TRIANGLES: [&str; 6] = [
    "Loop()",
    "Loop(weights: Warren)",
    "GaussianProduct(scheme: Loop, covariances: FromNormals())",
    "Qas()",
    "Qas(variant: Interpolating)",
    "PnTriangles",
];

/// All of them.
pub fn all_kinds() -> impl Iterator<Item = &'static str> {
    OF_POLYGONS.into_iter().chain(OF_TRIANGLES)
}
