// A height map over a rectangle, smooth: bicubic Catmull-Rom interpolation. Twin: keyleaf-surface `height_field`.
// requires: shared/height_field.wgsl, shared/heights_bicubic.wgsl
