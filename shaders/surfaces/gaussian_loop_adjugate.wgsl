// Gaussian-product subdivision by the rules of Loop, precisions inverted by the adjugate. Twin: keyleaf-surface `gaussian`.
// requires: shared/solve_adjugate.wgsl, shared/gaussian_triangle.wgsl
