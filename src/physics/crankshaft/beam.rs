//! A beam on several supports under single forces: shear and bending moment from the reactions, whatever method found those.
//!
//! Signs as in \[Villalva 2014\] section 7.2: V = sum F <x - L>⁰ + sum R <x - a>⁰ and M = sum F <x - L> + sum R <x - a>, forces and reactions positive
//! in the same direction. A sagging beam has a negative moment.

use nalgebra::DMatrix;

/// A support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Along the beam, m.
    pub at: f64,
    /// N/m; `None`: rigid.
    pub stiffness: Option<f64>,
}

/// A beam of one section.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// By ascending place, at least two.
    pub supports: Vec<Support>,
    /// Places of the forces, ascending, m.
    pub loads_at: Vec<f64>,
    /// E I, N m².
    pub rigidity: f64,
}

/// Reactions of every support (rows) to a unit force at every place of a force (columns).
#[derive(Debug, Clone, PartialEq)]
pub struct Reactions(pub DMatrix<f64>);

impl Beam {
    /// Length between the outermost supports and forces, m.
    pub fn length(&self) -> f64 {
        let all = || self.supports.iter().map(|s| s.at).chain(self.loads_at.iter().copied());
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    }

    /// Bending moment at `x` per unit force at each place, m.
    pub fn moment_at(&self, reactions: &Reactions, x: f64) -> Vec<f64> {
        self.at(reactions, |at| (x - at).max(0.0))
    }

    /// Shear force just after `x` per unit force at each place.
    pub fn shear_at(&self, reactions: &Reactions, x: f64) -> Vec<f64> {
        self.at(reactions, |at| if x >= at { 1.0 } else { 0.0 })
    }

    fn at(&self, reactions: &Reactions, step: impl Fn(f64) -> f64) -> Vec<f64> {
        let steps: Vec<f64> = self.supports.iter().map(|s| step(s.at)).collect();
        let value_at = |(column, at): (usize, &f64)| {
            step(*at) + reactions.0.column(column).iter().zip(&steps).map(|(reaction, step)| reaction * step).sum::<f64>()
        };
        self.loads_at.iter().enumerate().map(value_at).collect()
    }
}
