//! What a comparison comes to: how far predictions are off, which design is best and how far ahead an optimum is, which tolerances fail.

use super::{AmplitudeRow, Entry, Kind, Role};
use crate::absorber::tuned::TUNED;
use crate::absorber::viscous::VISCOUS;
use crate::analysis::Results;
use crate::input::{Published, Study};

/// Sizes of deviations, per cent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spread {
    /// Each, ascending.
    pub deviations: Vec<f64>,
}

impl Spread {
    /// Of values in any order.
    pub fn new(deviations: impl IntoIterator<Item = f64>) -> Self {
        let mut deviations: Vec<f64> = deviations.into_iter().collect();
        deviations.sort_by(f64::total_cmp);
        Self { deviations }
    }

    /// Of predicted rows.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a AmplitudeRow>) -> Self {
        Self::new(predicted(rows).filter_map(AmplitudeRow::deviation_percent))
    }

    /// Middle value, or the mean of the two; nothing without rows.
    pub fn median(&self) -> Option<f64> {
        let n = self.deviations.len();
        (n > 0).then(|| 0.5 * (self.deviations[(n - 1) / 2] + self.deviations[n / 2]))
    }

    /// Largest.
    pub fn worst(&self) -> Option<f64> {
        self.deviations.last().copied()
    }
}

/// Rows that are predicted.
fn predicted<'a>(rows: impl IntoIterator<Item = &'a AmplitudeRow>) -> impl Iterator<Item = &'a AmplitudeRow> {
    rows.into_iter().filter(|r| r.role == Role::Predicted)
}

/// A published design or an optimum with its objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// Name.
    pub name: String,
    /// Sum of the rings, kg m².
    pub ring_inertia: f64,
    /// Objective of the study, SI.
    pub objective: f64,
}

/// A stated tolerance and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Of what.
    pub what: &'static str,
    /// Per cent.
    pub tolerance: f64,
    /// Largest deviation (or the median), per cent; nothing where there is no number to compare, infinite where one has no counterpart.
    pub found: Option<f64>,
}

impl Check {
    /// Whether it holds; what cannot be looked at does not.
    pub fn holds(&self) -> bool {
        self.found.is_some_and(|f| f <= self.tolerance)
    }
}

/// What a comparison comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Predicted amplitudes.
    pub all: Spread,
    /// Those of tuned absorbers.
    pub tuned: Spread,
    /// Those of viscous absorbers.
    pub viscous: Spread,
    /// Published designs, the best first.
    pub designs: Vec<Ranked>,
    /// Optima with a ring of a published size, the best first.
    pub optima: Vec<Ranked>,
    /// Stated tolerances.
    pub checks: Vec<Check>,
    /// Whether the optima hold the limits of the study.
    pub limits_hold: bool,
}

impl Verdict {
    /// Whether every stated tolerance and every limit holds.
    pub fn holds(&self) -> bool {
        self.limits_hold && self.checks.iter().all(Check::holds)
    }
}

/// Draws the conclusions of a comparison.
pub fn verdict(study: &Study, published: &Published, results: &Results, entries: &[Entry], rows: &[AmplitudeRow]) -> Verdict {
    let kind = |r: &AmplitudeRow| crate::validation::absorbers::type_of(&study.designs[r.design].absorbers);
    let all = Spread::of(rows);
    let ranked = |d: &crate::analysis::DesignResult| {
        let ring_inertia = d.absorbers.iter().map(|a| a.absorber.ring_inertia()).sum();
        d.objective.map(|objective| Ranked { name: d.name.clone(), ring_inertia, objective })
    };
    let sorted = |mut list: Vec<Ranked>| {
        list.sort_by(|a, b| a.objective.total_cmp(&b.objective));
        list
    };
    let worst = |k: Kind| {
        let counts = |role: Role| matches!(role, Role::Predicted | Role::Recomputed);
        let predicted = entries.iter().filter(|e| e.kind == k && counts(e.role));
        // a number without counterpart, or a printed zero that ours is not, is off by any share
        let size = |e: &Entry| match e.deviation_percent() {
            Some(d) => d.abs(),
            None if e.published.is_some() && e.published == e.computed => 0.0,
            None => f64::INFINITY,
        };
        predicted.map(size).reduce(f64::max)
    };
    // a tolerance is on what the printed digits do not explain
    let beyond = Spread::new(predicted(rows).filter_map(AmplitudeRow::beyond_digits_percent));
    let t = &published.tolerances;
    let stated = [
        ("natural frequencies", t.frequency, worst(Kind::Frequency)),
        ("critical speeds", t.critical_speed, worst(Kind::CriticalSpeed)),
        ("stiffness by the source's procedure", t.stiffness, worst(Kind::Stiffness)),
        ("damping by the source's procedure", t.damping, worst(Kind::Damping)),
        ("median of the predicted amplitudes beyond their digits", t.amplitude_median, beyond.median()),
        ("worst predicted amplitude beyond its digits", t.amplitude_worst, beyond.worst()),
        ("safety factors from their stresses", t.safety_factor, worst(Kind::SafetyFactor)),
        ("multiaxial safety factors from their stresses", t.multiaxial_factor, worst(Kind::Multiaxial)),
    ];
    let check = |(what, tolerance, found): (&'static str, Option<f64>, Option<f64>)| Some(Check { what, tolerance: tolerance?, found });
    Verdict {
        tuned: Spread::of(rows.iter().filter(|r| kind(r) == Some(&TUNED))),
        viscous: Spread::of(rows.iter().filter(|r| kind(r) == Some(&VISCOUS))),
        designs: sorted(results.designs.iter().filter_map(ranked).collect()),
        optima: sorted(results.optima.iter().filter_map(|o| ranked(&o.design)).collect()),
        checks: stated.into_iter().filter_map(check).collect(),
        limits_hold: results.limits_hold(),
        all,
    }
}
