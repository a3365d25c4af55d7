// NURBS surfaces, basis functions by Bézier extraction. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_basis.wgsl, shared/basis_extraction.wgsl
