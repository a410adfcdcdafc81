//! A stress history: the tensor at one point over one cycle.

use hartog_kernel::kernel;

/// Components of the tensor at every sample, Pa: xx, yy, zz, xy, yz, zx.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// One row a component, all of one length.
    pub components: [Vec<f64>; 6],
}

/// Weights of the six components in a quantity that is linear in the tensor.
pub(crate) type Weights = [f64; 6];

impl History {
    /// From tensors, sample by sample.
    pub fn new(tensors: impl IntoIterator<Item = [f64; 6]>) -> Self {
        let mut history = Self::default();
        for tensor in tensors {
            for (component, value) in history.components.iter_mut().zip(tensor) {
                component.push(value);
            }
        }
        history
    }

    /// A plane state of one normal stress and its shear: xx and xy.
    pub(crate) fn plane_state(xx: Vec<f64>, xy: Vec<f64>) -> Self {
        let none = || vec![0.0; xx.len()];
        let [yy, zz, yz, zx] = [none(), none(), none(), none()];
        Self { components: [xx, yy, zz, xy, yz, zx] }
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.components[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.components[0].is_empty()
    }

    /// The tensor at a sample.
    pub fn tensor(&self, j: usize) -> [f64; 6] {
        self.components.each_ref().map(|c| c[j])
    }

    /// A sum of the components with such weights over the cycle, Pa.
    #[doc(hidden)]
    pub fn along(&self, weights: &Weights) -> Vec<f64> {
        let mut out = Vec::new();
        self.project(weights, &mut out);
        out
    }

    /// A linear quantity at every sample.
    pub(crate) fn project(&self, weights: &Weights, out: &mut Vec<f64>) {
        out.resize(self.len(), 0.0);
        project(&self.components.each_ref().map(Vec::as_slice), weights, out);
    }

    /// Smallest and largest value of a linear quantity.
    pub fn range(&self, weights: &Weights) -> (f64, f64) {
        range(&self.components.each_ref().map(Vec::as_slice), weights)
    }

    /// Hydrostatic stress at every sample, Pa.
    pub fn hydrostatic(&self) -> Vec<f64> {
        let third = 1.0 / 3.0;
        let mut p = Vec::new();
        self.project(&[third, third, third, 0.0, 0.0, 0.0], &mut p);
        p
    }

    /// The deviator as a vector of five dimensions whose length is sqrt(J2), \[Minucci 2010\] eq. (4.20): one row a dimension, Pa.
    pub(crate) fn deviator(&self) -> [Vec<f64>; 5] {
        deviator_weights().map(|w| {
            let mut row = Vec::new();
            self.project(&w, &mut row);
            row
        })
    }

    /// Some of its samples.
    #[must_use]
    pub fn only(&self, samples: &[usize]) -> Self {
        Self { components: self.components.each_ref().map(|c| samples.iter().map(|j| c[*j]).collect()) }
    }

    /// Every so many samples of it.
    #[must_use]
    pub fn every(&self, stride: usize) -> Self {
        Self { components: self.components.each_ref().map(|c| c.iter().step_by(stride).copied().collect()) }
    }
}

fn deviator_weights() -> [Weights; 5] {
    let root = 3f64.sqrt();
    [
        [1.0 / root, -0.5 / root, -0.5 / root, 0.0, 0.0, 0.0],
        [0.0, 0.5, -0.5, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    ]
}

/// The deviator of one tensor in the same five dimensions.
pub(crate) fn deviator_of(tensor: &[f64; 6]) -> [f64; 5] {
    deviator_weights().map(|w| w.iter().zip(tensor).map(|(w, t)| w * t).sum())
}

#[kernel]
fn project(c: &[&[f64]; 6], w: &Weights, out: &mut [f64]) {
    let n = out.len();
    let [a, b, d, e, f, g] = c.map(|c| &c[..n]);
    for i in 0..n {
        out[i] = w[0] * a[i] + w[1] * b[i] + w[2] * d[i] + w[3] * e[i] + w[4] * f[i] + w[5] * g[i];
    }
}

#[kernel]
fn range(c: &[&[f64]; 6], w: &Weights) -> (f64, f64) {
    const LANES: usize = 16;
    let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let [a, b, d, e, f, g] = c.map(|c| c.as_chunks::<LANES>().0);
    for i in 0..a.len() {
        for l in 0..LANES {
            let v = w[0] * a[i][l] + w[1] * b[i][l] + w[2] * d[i][l] + w[3] * e[i][l] + w[4] * f[i][l] + w[5] * g[i][l];
            low[l] = if v < low[l] { v } else { low[l] };
            high[l] = if v > high[l] { v } else { high[l] };
        }
    }
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for l in 0..LANES {
        least = if low[l] < least { low[l] } else { least };
        most = if high[l] > most { high[l] } else { most };
    }
    for v in (a.len() * LANES..c[0].len()).map(|i| (0..6).map(|k| w[k] * c[k][i]).sum::<f64>()) {
        least = least.min(v);
        most = most.max(v);
    }
    (least, most)
}
