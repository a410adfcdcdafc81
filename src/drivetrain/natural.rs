//! Natural motions of chain and absorbers together.

use super::{Chain, Modes};
use crate::absorber::{Kind, Mounted, Ring};
use crate::numerics::{C64, eigen};
use crate::units::HZ_PER_RAD_PER_S;
use nalgebra::{DMatrix, DVector};

/// Chains longer than this are represented by as many of their lowest modes.
const LARGEST_DENSE: usize = 64;

/// Mass, damping and stiffness in the coordinates of the lowest modes of a chain.
#[derive(Debug, Clone)]
pub struct Basis {
    /// Mode shapes: a row a station, a column a mode.
    shapes: DMatrix<f64>,
    stiffness: Vec<f64>,
    damping: DMatrix<f64>,
}

impl Basis {
    /// The lowest `count` modes; `damped`: whether the engine's own damping counts.
    pub fn new(chain: &Chain, modes: &Modes, count: usize, damped: bool) -> Self {
        let kept = count.min(modes.omega.len());
        let c = |i: usize, j: usize| modes.damping_between(chain, i, j, 0.5 * (modes.omega[i] + modes.omega[j]));
        Self {
            shapes: modes.shapes.columns(0, kept).into_owned(),
            stiffness: modes.omega[..kept].iter().map(|w| w * w).collect(),
            damping: if damped { DMatrix::from_fn(kept, kept, c) } else { DMatrix::zeros(kept, kept) },
        }
    }

    /// Eigenvalues s (1/s) of chain and absorbers, those with positive imaginary part; nothing where they cannot be computed.
    pub fn eigenvalues(&self, design: &[Mounted]) -> Option<Vec<C64>> {
        let kept = self.stiffness.len();
        let moving = design.iter().filter(|m| m.absorber.kind() != Kind::Locked).count();
        let n = kept + moving;
        let mut m = DMatrix::identity(n, n);
        let mut k = DMatrix::zeros(n, n);
        let mut c = DMatrix::zeros(n, n);
        c.view_mut((0, 0), (kept, kept)).copy_from(&self.damping);
        for (i, stiffness) in self.stiffness.iter().enumerate() {
            k[(i, i)] = *stiffness;
        }
        let mut ring = kept;
        for mounted in design {
            let a = &mounted.absorber;
            let hub = DVector::from_fn(n, |i, _| if i < kept { self.shapes[(mounted.station, i)] } else { 0.0 });
            if a.kind() == Kind::Locked {
                m.ger(mounted.hub_inertia + a.ring_inertia(), &hub, &hub, 1.0);
                continue;
            }
            let mut twist = -&hub;
            twist[ring] = 1.0;
            m[(ring, ring)] = a.ring_inertia();
            ring += 1;
            m.ger(mounted.hub_inertia, &hub, &hub, 1.0);
            k.ger(a.stiffness(), &twist, &twist, 1.0);
            c.ger(a.damping(), &twist, &twist, 1.0);
        }
        let mut s = eigen::quadratic(&m, &c, &k)?;
        // a double zero eigenvalue is split by rounding: to about the square root of the rounding of the largest
        let largest = s.iter().map(|s| s.im).fold(0.0, f64::max);
        s.retain(|s| s.im > 1e-6 * largest);
        Some(s)
    }
}

/// Natural frequencies (of the damped motion, the imaginary parts of the eigenvalues), Hz, ascending, without rigid modes. The absorbers'
/// damping counts, the engine's own does not; overdamped motions have no frequency and are left out. `modes` are those of the chain alone.
///
/// Chains of more than 64 stations enter by their lowest 64 modes; the lowest frequencies then err by about (f/f64)².
pub fn frequencies_hz(chain: &Chain, modes: &Modes, design: &[Mounted]) -> Vec<f64> {
    if design.is_empty() {
        return modes.frequencies_hz();
    }
    let eigenvalues = Basis::new(chain, modes, LARGEST_DENSE, false).eigenvalues(design).unwrap_or_default();
    let mut frequencies: Vec<f64> = eigenvalues.iter().map(|s| s.im * HZ_PER_RAD_PER_S).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies
}
