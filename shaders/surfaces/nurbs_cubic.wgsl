// NURBS surfaces of degrees up to 3. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_cubic.wgsl, shared/basis_triangular_cubic.wgsl
