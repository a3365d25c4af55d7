// NURBS surfaces. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_basis.wgsl, shared/basis_triangular.wgsl
