// NURBS surfaces, basis functions by de Boor's recursion. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/patch_basis.wgsl, shared/basis_de_boor.wgsl
