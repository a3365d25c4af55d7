// A height map over a rectangle, with bilinear interpolation. Twin: keyleaf-surface `height_field`.
// requires: shared/height_field.wgsl, shared/heights_bilinear.wgsl
