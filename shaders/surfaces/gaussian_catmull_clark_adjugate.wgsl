// Gaussian-product subdivision by the rules of Catmull-Clark, precisions inverted by the adjugate. Twin: keyleaf-surface `gaussian`.
// requires: shared/solve_adjugate.wgsl, shared/gaussian_square.wgsl
