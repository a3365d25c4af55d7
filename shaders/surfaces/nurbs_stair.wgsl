// NURBS surfaces, basis functions by the stair strategy. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_basis.wgsl, shared/basis_stair.wgsl
