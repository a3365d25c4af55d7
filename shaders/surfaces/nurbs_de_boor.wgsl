// NURBS surfaces, basis functions by de Boor's recursion. Twin: keyleaf-surface `patches`.
// requires: shared/patch.wgsl, shared/basis_de_boor.wgsl
