//! Weighted sums of vertices.

use glam::DVec3;

/// What is summed: positions, or any other values of the control vertices.
pub trait Vector: Copy {
    /// The sum of nothing.
    const ZERO: Self;

    /// `self` + `weight` · `other`.
    #[must_use]
    fn plus(self, other: Self, weight: f64) -> Self;
}

impl Vector for f64 {
    const ZERO: Self = 0.0;

    fn plus(self, other: Self, weight: f64) -> Self {
        self + other * weight
    }
}

impl Vector for DVec3 {
    const ZERO: Self = Self::ZERO;

    fn plus(self, other: Self, weight: f64) -> Self {
        self + other * weight
    }
}

impl<const N: usize> Vector for [f64; N] {
    const ZERO: Self = [0.0; N];

    fn plus(self, other: Self, weight: f64) -> Self {
        std::array::from_fn(|k| self[k] + other[k] * weight)
    }
}

/// Vertices with weights. A vertex may occur more than once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stencil(pub Vec<(u32, f64)>);

impl Stencil {
    /// One vertex.
    pub fn of(vertex: u32) -> Self {
        Self(vec![(vertex, 1.0)])
    }

    /// Adds a vertex.
    pub fn add(&mut self, vertex: u32, weight: f64) {
        self.0.push((vertex, weight));
    }

    /// Adds another stencil.
    pub fn add_stencil(&mut self, other: &Self, weight: f64) {
        self.0
            .extend(other.0.iter().map(|&(vertex, own)| (vertex, own * weight)));
    }

    /// A sum of stencils.
    pub fn sum<'a>(terms: impl IntoIterator<Item = (&'a Self, f64)>) -> Self {
        let mut sum = Self::default();
        for (stencil, weight) in terms {
            sum.add_stencil(stencil, weight);
        }
        sum.merged()
    }

    /// The same with every vertex once.
    pub fn merged(mut self) -> Self {
        let mut merged: Vec<(u32, f64)> = Vec::with_capacity(self.0.len());
        self.0.sort_by_key(|&(vertex, _)| vertex);
        for (vertex, weight) in self.0 {
            match merged.last_mut() {
                Some(last) if last.0 == vertex => last.1 += weight,
                _ => merged.push((vertex, weight)),
            }
        }
        Self(merged)
    }

    /// The sum of values by vertex.
    pub fn apply<V: Vector>(&self, values: &[V]) -> V {
        let terms = self.0.iter();
        terms.fold(V::ZERO, |sum, &(vertex, weight)| {
            sum.plus(values[vertex as usize], weight)
        })
    }

    /// The stencil over the vertices that `rows` is over, one row of `width` weights a vertex.
    pub fn apply_to_rows(&self, rows: &[f64], width: usize) -> Vec<f64> {
        let mut sum = vec![0.0; width];
        for &(vertex, weight) in &self.0 {
            let row = &rows[vertex as usize * width..][..width];
            sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
        }
        sum
    }
}

/// Stencils one after the other, in flat arrays.
#[derive(Clone, Debug, Default)]
pub struct Stencils {
    terms: Vec<(u32, f64)>,
    /// Where each of them ends.
    ends: Vec<u32>,
}

impl Stencils {
    /// Their sums of values by vertex.
    pub fn apply<'a, V: Vector>(&'a self, values: &'a [V]) -> impl Iterator<Item = V> + 'a {
        let mut first = 0;
        self.ends.iter().map(move |&end| {
            let terms = &self.terms[std::mem::replace(&mut first, end as usize)..end as usize];
            // Two sums, so that a term need not wait for the one before.
            let mut sums = [V::ZERO; 2];
            let mut pairs = terms.chunks_exact(2);
            for pair in &mut pairs {
                let [(a, weight), (b, other)] = [pair[0], pair[1]];
                sums[0] = sums[0].plus(values[a as usize], weight);
                sums[1] = sums[1].plus(values[b as usize], other);
            }
            for &(vertex, weight) in pairs.remainder() {
                sums[0] = sums[0].plus(values[vertex as usize], weight);
            }
            sums[0].plus(sums[1], 1.0)
        })
    }
}

impl<'a> FromIterator<&'a Stencil> for Stencils {
    fn from_iter<I: IntoIterator<Item = &'a Stencil>>(stencils: I) -> Self {
        let mut all = Self::default();
        for stencil in stencils {
            all.terms.extend(&stencil.0);
            all.ends.push(all.terms.len() as u32);
        }
        all
    }
}
