//! Natural frequencies of chain and absorbers together.

use crate::absorber::{Mounted, Ring};
use crate::chain::{Chain, Modes};
use crate::numerics::eigen;
use crate::units::HZ_PER_RAD_PER_S;
use nalgebra::{DMatrix, DVector};

/// Chains longer than this are represented by as many of their lowest modes.
const LARGEST_DENSE: usize = 64;

/// Natural frequencies, Hz, ascending, without rigid modes. The absorbers' damping counts, the engine's own does not; overdamped motions
/// have no frequency and are left out. `modes` are those of the chain alone.
///
/// Chains of more than 64 stations enter by their lowest 64 modes; the lowest frequencies then err by about (f/f64)².
pub fn frequencies_hz(chain: &Chain, modes: &Modes, design: &[Mounted]) -> Vec<f64> {
    if design.is_empty() {
        return modes.frequencies_hz();
    }
    let mut with_hubs = chain.clone();
    for mounted in design {
        with_hubs.stations[mounted.station].inertia += mounted.hub_inertia;
    }
    let own;
    let hubless = design.iter().all(|m| m.hub_inertia == 0.0);
    let modes = if hubless {
        modes
    } else {
        own = Modes::new(&with_hubs);
        &own
    };
    // generalised coordinates: the chain's modes, then the rings
    let kept = modes.omega.len().min(LARGEST_DENSE);
    let n = kept + design.len();
    let mut mass = DVector::from_element(n, 1.0);
    let mut k = DMatrix::zeros(n, n);
    let mut c = DMatrix::zeros(n, n);
    for i in 0..kept {
        k[(i, i)] = modes.omega[i] * modes.omega[i];
    }
    for (r, mounted) in design.iter().enumerate() {
        let a = &mounted.absorber;
        mass[kept + r] = a.ring_inertia();
        // the twist of this ring as a row over the coordinates
        let twist = DVector::from_fn(n, |i, _| match i {
            i if i < kept => -modes.shapes[(mounted.station, i)],
            i if i == kept + r => 1.0,
            _ => 0.0,
        });
        k += &twist * twist.transpose() * a.stiffness();
        c += &twist * twist.transpose() * a.damping();
    }
    let mut frequencies: Vec<f64> = if design.iter().all(|m| m.absorber.damping() == 0.0) {
        eigen::generalised(&k, mass.as_slice()).0.iter().map(|l| l.max(0.0).sqrt()).collect()
    } else {
        eigen::quadratic(&mass, &c, &k).iter().map(|s| s.im).collect()
    };
    // a double zero eigenvalue is split by rounding: to about the square root of the rounding of the largest
    let largest = frequencies.iter().copied().fold(0.0, f64::max);
    frequencies.retain(|f| *f > 1e-6 * largest);
    frequencies.sort_by(f64::total_cmp);
    frequencies.iter().map(|f| f * HZ_PER_RAD_PER_S).collect()
}
