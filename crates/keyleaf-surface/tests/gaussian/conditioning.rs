//! What is lost in f32: storage, solver and residual, measured with the arithmetic of the shaders.
//!
//! K = 16 Gaussians within a patch of extent 1, random positive weights. Errors are those of the mean against the exact one, in units
//! of 2⁻²⁴ of the extent, so that the bound 64 κ 2⁻²⁴ reads 64 κ.

use crate::models::{Random, disk};
use crate::oracle_tables::oracle;
use glam::{DMat3, DVec3};
use keyleaf_surface::gaussian::{Covariance, Dual, DualFrame, Symmetric3};

const K: usize = 16;
const TRIALS: usize = 400;
const EPS: f64 = 1.0 / 16_777_216.0;

type Six = [f32; 6];
type Three = [f32; 3];
type Solver = fn(Six, Three) -> Three;

fn multiply([xx, xy, xz, yy, yz, zz]: Six, [x, y, z]: Three) -> Three {
    [
        xx * x + xy * y + xz * z,
        xy * x + yy * y + yz * z,
        xz * x + yz * y + zz * z,
    ]
}

fn plus<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
    std::array::from_fn(|k| a[k] + b[k])
}

fn minus<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn times<const N: usize>(a: [f32; N], w: f32) -> [f32; N] {
    a.map(|x| x * w)
}

fn rounded<const N: usize>(a: [f64; N]) -> [f32; N] {
    a.map(|x| x as f32)
}

/// LDLᵀ with the largest pivot first, as in `solve.rs`.
fn solve(matrix: Six, b: Three) -> Three {
    let [xx, xy, xz, yy, yz, zz] = matrix;
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut order = [0, 1, 2];
    let first = (0..3).fold(0, |best, k| if rows[k][k] > rows[best][best] { k } else { best });
    order.swap(0, first);
    let p0 = rows[first][first];
    let rest = |a: usize, c: usize| rows[a][c] - rows[a][first] / p0 * rows[first][c];
    if rest(order[2], order[2]) > rest(order[1], order[1]) {
        order.swap(1, 2);
    }
    let [i, j, k] = order;
    let (p1, l10, l20) = (rest(j, j), rows[j][i] / p0, rows[k][i] / p0);
    let l21 = rest(k, j) / p1;
    let p2 = rest(k, k) - l21 * rest(k, j);
    let y0 = b[i];
    let y1 = b[j] - l10 * y0;
    let x2 = (b[k] - l20 * y0 - l21 * y1) / p2;
    let x1 = y1 / p1 - l21 * x2;
    let mut x = [0.0; 3];
    (x[i], x[j], x[k]) = (y0 / p0 - l10 * x1 - l20 * x2, x1, x2);
    x
}

fn adjugate([xx, xy, xz, yy, yz, zz]: Six, [x, y, z]: Three) -> Three {
    let c = [
        yy * zz - yz * yz,
        xz * yz - xy * zz,
        xy * yz - xz * yy,
        xx * zz - xz * xz,
        xy * xz - xx * yz,
        xx * yy - xy * xy,
    ];
    let determinant = xx * c[0] + xy * c[1] + xz * c[2];
    times(multiply(c, [x, y, z]), 1.0 / determinant)
}

/// How a patch is stored and solved.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    /// (q̂, q̄) of absolute coordinates, adjugate: the thesis.
    AbsoluteAdjugate,
    /// (q̂, q̄) about a centre, adjugate.
    CentredAdjugate,
    /// (q̂, q̄) about a centre, LDLᵀ.
    Centred,
    /// The same and a step with r = q̄ − q̂ μ of the sums.
    CentredPlain,
    /// The same and a step with r = Σ α (q̄_i − q̂_i μ).
    CentredTerms,
    /// (q̂_0, q̄_0) and differences to them, LDLᵀ, plain residual.
    Differences,
    /// (q̂_i, μ_i − c), r = Σ α q̂_i (μ_i − μ) from μ = Σ α μ_i, two steps.
    Means,
    /// (q̂, q̄) in the whitened frame, LDLᵀ.
    Whitened,
    /// The same and a plain step.
    WhitenedPlain,
}

const METHODS: [Method; 9] = [
    Method::AbsoluteAdjugate,
    Method::CentredAdjugate,
    Method::Centred,
    Method::CentredPlain,
    Method::CentredTerms,
    Method::Differences,
    Method::Means,
    Method::Whitened,
    Method::WhitenedPlain,
];

/// What the Gaussians of a patch are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    /// Disks with one axis.
    Parallel,
    /// Disks whose axes are turned by about 0.1, as over a bent surface.
    Tilted,
    /// Disks with any axes.
    Any,
    /// Round ones whose variances differ by up to the condition.
    Sizes,
}

const MODES: [Mode; 4] = [Mode::Parallel, Mode::Tilted, Mode::Any, Mode::Sizes];

impl Mode {
    fn covariance(self, condition: f64, common: DMat3, random: &mut Random) -> Covariance {
        match self {
            Self::Parallel => disk(condition, common),
            Self::Tilted => disk(condition, common * random.rotation(0.1)),
            Self::Any => disk(condition, random.rotation(3.0)),
            Self::Sizes => Covariance::isotropic(condition.powf(-random.unit())).expect("positive"),
        }
    }
}

/// A mean and a derivative.
type Answer = [DVec3; 2];

struct Case {
    gaussians: Vec<(DVec3, Covariance)>,
    weights: Vec<f64>,
    /// Derivatives of the weights, which sum to zero.
    rates: Vec<f64>,
}

impl Case {
    fn new(mode: Mode, condition: f64, offset: f64, random: &mut Random) -> Self {
        let common = random.rotation(3.0);
        // As f32 holds them, so that only the arithmetic is measured.
        let offset = DVec3::splat(offset);
        let gaussian = |random: &mut Random| {
            let mean = (random.vector() * 0.5 + offset).as_vec3().as_dvec3();
            (mean, mode.covariance(condition, common, random))
        };
        let gaussians = (0..K).map(|_| gaussian(random)).collect();
        let [weights, other] = [0, 1].map(|_| random.weights(K));
        Self {
            rates: weights.iter().zip(&other).map(|(a, b)| b - a).collect(),
            gaussians,
            weights,
        }
    }

    fn duals(&self, frame: &DualFrame) -> Vec<Dual> {
        self.gaussians
            .iter()
            .map(|(mean, covariance)| Dual::of(*mean, covariance, frame))
            .collect()
    }

    /// In f64, in the whitened frame.
    fn exact(&self) -> Answer {
        let frame = DualFrame::whitened(&self.gaussians);
        let duals = self.duals(&frame);
        let sum = |weights: &[f64]| {
            duals
                .iter()
                .zip(weights)
                .fold(Dual::default(), |sum, (&dual, &w)| sum + dual * w)
        };
        let jet = keyleaf_surface::gaussian::DualJet {
            terms: [
                sum(&self.weights),
                sum(&self.rates),
                Dual::default(),
                Dual::default(),
                Dual::default(),
                Dual::default(),
            ],
        };
        let mean = jet.mean().expect("definite").in_object_space(&frame);
        [mean.mean, mean.first[0]]
    }

    fn in_f32(&self, method: Method) -> Answer {
        let frame = match method {
            Method::AbsoluteAdjugate => DualFrame::OBJECT,
            Method::Whitened | Method::WhitenedPlain => DualFrame::whitened(&self.gaussians),
            _ => DualFrame::scaled(&self.gaussians),
        };
        let [mean, rate] = match method {
            Method::Means => self.with_means(&frame),
            _ => self.with_duals(&frame, method),
        };
        // Near the patch's centre f32 holds a point to a rounding of the extent; the map is made in f32 as well.
        let columns = [frame.axes.x_axis, frame.axes.y_axis, frame.axes.z_axis].map(|c| rounded(c.to_array()));
        let map = |v: Three| {
            let [a, b, c] = [0, 1, 2].map(|k| times(columns[k], v[k]));
            DVec3::from_array(plus(plus(a, b), c).map(f64::from))
        };
        [frame.centre + map(mean), map(rate)]
    }

    fn with_duals(&self, frame: &DualFrame, method: Method) -> [Three; 2] {
        let duals = self.duals(frame);
        let base = if method == Method::Differences {
            duals[0]
        } else {
            Dual::default()
        };
        let stored: Vec<(Six, Three)> = duals
            .iter()
            .map(|&dual| {
                let dual = dual - base;
                (rounded(dual.precision.to_array()), rounded(dual.information.to_array()))
            })
            .collect();
        let base: (Six, Three) = (rounded(base.precision.to_array()), rounded(base.information.to_array()));
        let sum = |weights: &[f64], start: (Six, Three)| {
            stored.iter().zip(weights).fold(start, |(q, i), (&(dq, di), &w)| {
                (plus(q, times(dq, w as f32)), plus(i, times(di, w as f32)))
            })
        };
        let (q, information) = sum(&self.weights, base);
        let solver = match method {
            Method::AbsoluteAdjugate | Method::CentredAdjugate => adjugate,
            _ => solve,
        };
        let mut mean = solver(q, information);
        match method {
            Method::CentredPlain | Method::Differences | Method::WhitenedPlain => {
                mean = plus(mean, solve(q, minus(information, multiply(q, mean))));
            }
            Method::CentredTerms => {
                let term = |r: Three, (&(dq, di), &w): (&(Six, Three), &f64)| {
                    plus(r, times(minus(di, multiply(dq, mean)), w as f32))
                };
                let residual = stored.iter().zip(&self.weights).fold([0.0; 3], term);
                mean = plus(mean, solve(q, residual));
            }
            _ => {}
        }
        let (dq, di) = sum(&self.rates, ([0.0; 6], [0.0; 3]));
        [mean, solver(q, minus(di, multiply(dq, mean)))]
    }

    /// Σ α q̂_i (μ_i − μ) is small and nearly exact; its first μ is the mean of the means.
    fn with_means(&self, frame: &DualFrame) -> [Three; 2] {
        let units = frame.axes.x_axis.x;
        let stored: Vec<(Six, Three)> = self
            .gaussians
            .iter()
            .zip(self.duals(frame))
            .map(|((mean, _), dual)| {
                let local = (*mean - frame.centre) / units;
                (rounded(dual.precision.to_array()), rounded(local.to_array()))
            })
            .collect();
        let sum_of_precisions = |weights: &[f64]| {
            stored
                .iter()
                .zip(weights)
                .fold([0.0; 6], |q, (&(dq, _), &w)| plus(q, times(dq, w as f32)))
        };
        let moment = |weights: &[f64], mean: Three| {
            let term = |r: Three, (&(dq, at), &w): (&(Six, Three), &f64)| {
                plus(r, times(multiply(dq, minus(at, mean)), w as f32))
            };
            stored.iter().zip(weights).fold([0.0; 3], term)
        };
        let q = sum_of_precisions(&self.weights);
        let mut mean = stored
            .iter()
            .zip(&self.weights)
            .fold([0.0; 3], |sum, (&(_, at), &w)| plus(sum, times(at, w as f32)));
        for _ in 0..2 {
            mean = plus(mean, solve(q, moment(&self.weights, mean)));
        }
        [mean, solve(q, moment(&self.rates, mean))]
    }
}

/// Median, 99th percentile and largest error of means, and 99th percentile of derivatives, in units of 2⁻²⁴ of the extent.
fn errors(method: Method, mode: Mode, condition: f64, offset: f64) -> [f64; 4] {
    let mut random = Random(0x9E37_79B9);
    let (mut means, mut rates) = (Vec::new(), Vec::new());
    for _ in 0..TRIALS {
        let case = Case::new(mode, condition, offset, &mut random);
        let (exact, found) = (case.exact(), case.in_f32(method));
        let error = |k: usize| {
            let error = exact[k].distance(found[k]) / EPS;
            if error.is_nan() { f64::INFINITY } else { error }
        };
        means.push(error(0));
        rates.push(error(1));
    }
    means.sort_by(f64::total_cmp);
    rates.sort_by(f64::total_cmp);
    [
        means[TRIALS / 2],
        means[TRIALS * 99 / 100],
        means[TRIALS - 1],
        rates[TRIALS * 99 / 100],
    ]
}

#[test]
fn storage_solver_and_residual_are_compared() {
    println!("disks: median / 99 % / largest error of means, 99 % of derivatives, in 2^-24 of the extent");
    for mode in MODES {
        for condition in [1.0, 1e2, 1e4, 1e6] {
            for method in METHODS {
                let [median, high, largest, rate] = errors(method, mode, condition, 0.0);
                println!(
                    "{:>10} {condition:>7.0e} {:>16}: {median:9.2e} {high:9.2e} {largest:9.2e} | {rate:9.2e}",
                    format!("{mode:?}"),
                    format!("{method:?}")
                );
            }
        }
    }
    for offset in [1e2, 1e4, 1e6] {
        for method in METHODS {
            let [median, high, largest, rate] = errors(method, Mode::Tilted, 1e4, offset);
            println!(
                "offset {offset:>7.0e} {:>16}: {median:9.2e} {high:9.2e} {largest:9.2e} | {rate:9.2e}",
                format!("{method:?}")
            );
        }
    }
}

#[test]
fn centred_and_whitened_patches_keep_the_bound_up_to_the_condition_limit() {
    for mode in MODES {
        for condition in [1.0, 1e2, 1e4, 1e6] {
            for method in [Method::CentredPlain, Method::Means, Method::Whitened] {
                let [_, _, largest, _] = errors(method, mode, condition, 1e4);
                assert!(
                    largest <= 64.0 * condition,
                    "{method:?} {mode:?} {condition}: {largest}"
                );
            }
        }
    }
}

/// Disks that are alike cost a whitened patch nothing, whatever their condition.
#[test]
fn whitening_makes_parallel_disks_as_good_as_round_ones() {
    for condition in [1e2, 1e4, 1e6] {
        let [_, high, largest, rate] = errors(Method::Whitened, Mode::Parallel, condition, 0.0);
        assert!(
            high <= 4.0 && largest <= 8.0 && rate <= 16.0,
            "{condition}: {high} {largest} {rate}"
        );
    }
}

/// The table's errors are against the exact solution of the f32-stored precisions; the same is measured here for its solvers.
#[test]
fn errors_against_the_stored_precisions_are_those_of_the_table() {
    let Some(table) = oracle("gps/f32_conditioning.json") else {
        return;
    };
    let solvers: [(&str, Solver); 2] = [("adj_rel", adjugate), ("ldl_rel", solve)];
    for row in table["rows"].as_array().expect("rows") {
        let condition = row["kappa"].as_f64().expect("a number");
        if row["offset"].as_f64() != Some(0.0) || condition > 1e6 {
            continue;
        }
        let mode = if row["mode"] == "disks" {
            Mode::Tilted
        } else {
            Mode::Any
        };
        for (column, solver) in solvers {
            let found = stored_error(solver, mode, condition);
            let of_table = row[column][0].as_f64().expect("a number");
            let ratio = found / of_table;
            println!(
                "{} {condition:.0e} {column}: median {found:.1e}, table {of_table:.1e}",
                row["mode"]
            );
            assert!((0.1..10.0).contains(&ratio), "{condition} {column}: {found} {of_table}");
        }
    }
}

fn stored_error(solver: Solver, mode: Mode, condition: f64) -> f64 {
    let mut random = Random(77);
    let mut errors: Vec<f64> = (0..TRIALS)
        .map(|_| {
            let case = Case::new(mode, condition, 0.0, &mut random);
            let frame = DualFrame {
                axes: DMat3::IDENTITY,
                ..DualFrame::scaled(&case.gaussians)
            };
            let mut exact = Dual::default();
            let mut sum: (Six, Three) = ([0.0; 6], [0.0; 3]);
            for ((mean, covariance), &weight) in case.gaussians.iter().zip(&case.weights) {
                let scale = 1.0 / condition;
                let six: Six = rounded((Dual::of(*mean, covariance, &frame).precision * scale).to_array());
                let local = (*mean - frame.centre).as_vec3().to_array();
                let stored = Symmetric3::from_array(six.map(f64::from));
                let dual = Dual {
                    precision: stored,
                    information: stored * DVec3::from_array(local.map(f64::from)),
                };
                exact = exact + dual * f64::from(weight as f32);
                sum.0 = plus(sum.0, times(six, weight as f32));
                sum.1 = plus(sum.1, times(multiply(six, local), weight as f32));
            }
            let found = DVec3::from_array(solver(sum.0, sum.1).map(f64::from));
            exact.mean().map_or(f64::INFINITY, |mean| mean.distance(found))
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors[TRIALS / 2]
}
