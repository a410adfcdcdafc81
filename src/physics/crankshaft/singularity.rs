//! Reactions by the singularity functions of \[Villalva 2014\] eq. (7.11): equilibrium of forces and moments, and the deflection at every support, as one
//! system for the reactions and two constants of integration (the other two are zero). Row 6 of the printed system needs L_a6.
//!
//! Cubes of long distances cancel: good for a dozen throws; with 30 some five digits are left.

use super::beam::{Beam, Reactions};
use nalgebra::DMatrix;

/// The reactions; nothing where the system is singular.
pub fn reactions(beam: &Beam) -> Option<Reactions> {
    let (n, loads) = (beam.supports.len(), beam.loads_at.len());
    let first = beam.supports[0].at;
    // in units of the mean span, so that cubes and ones are of a size
    let unit = (beam.supports[n - 1].at - first) / (n - 1) as f64;
    let place = |x: f64| (x - first) / unit;
    let cube = |x: f64| x.max(0.0).powi(3) / 6.0;
    let mut matrix = DMatrix::zeros(n + 2, n + 2);
    let mut right = DMatrix::zeros(n + 2, loads);
    for (i, support) in beam.supports.iter().enumerate() {
        let x = place(support.at);
        for (j, other) in beam.supports.iter().enumerate() {
            matrix[(i, j)] = cube(x - place(other.at));
        }
        // a yielding support: E I v = - E I R/k
        if let Some(k) = support.stiffness {
            matrix[(i, i)] += beam.rigidity / (k * unit.powi(3));
        }
        matrix[(i, n)] = x;
        matrix[(i, n + 1)] = 1.0;
        matrix[(n, i)] = 1.0;
        matrix[(n + 1, i)] = x;
        for (c, at) in beam.loads_at.iter().enumerate() {
            right[(i, c)] = -cube(x - place(*at));
        }
    }
    for (c, at) in beam.loads_at.iter().enumerate() {
        right[(n, c)] = -1.0;
        right[(n + 1, c)] = -place(*at);
    }
    let solved = matrix.full_piv_lu().solve(&right)?;
    Some(Reactions(solved.rows(0, n).into_owned()))
}
