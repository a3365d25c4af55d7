// Bézier patches of degrees up to 3, also rational. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_cubic.wgsl, shared/basis_bernstein_cubic.wgsl
