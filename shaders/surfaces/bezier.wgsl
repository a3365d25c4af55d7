// Bézier patches, also rational. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/basis_bernstein.wgsl
