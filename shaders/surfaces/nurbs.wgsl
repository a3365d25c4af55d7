// NURBS surfaces. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/basis_triangular.wgsl
