// Bézier and NURBS surfaces as polynomials a KSQuad, with coefficients made once. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_power.wgsl
