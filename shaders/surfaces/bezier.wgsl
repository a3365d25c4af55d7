// Bézier patches, also rational. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_basis.wgsl, shared/basis_bernstein.wgsl
