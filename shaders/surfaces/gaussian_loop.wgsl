// Gaussian-product subdivision (Komar 2020) by the rules of Loop. Twin: keyleaf-surface `gaussian`.
// requires: shared/solve_ldlt.wgsl, shared/gaussian_triangle.wgsl
