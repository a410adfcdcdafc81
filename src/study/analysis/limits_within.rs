//! The limits of a study for a design that deviates from its drawing.

use crate::absorber::{Deviation, Mounted};
use crate::input::{LimitSpec, Study};
use crate::optimise::{LoadCase, robust};

/// Each limited measure but sizes and masses, which have tolerances of their own on the drawing: its index, and its largest value over some load cases over its limit; infinite where nothing damps a resonance.
pub(super) fn ratios(study: &Study, cases: &[LoadCase], design: &[Mounted], deviation: &Deviation) -> Vec<(usize, f64)> {
    let in_service: Vec<LoadCase> = cases.iter().filter(|c| c.condition.is_service()).copied().collect();
    let ratio = |l: &LimitSpec| {
        let own = robust::deviated(cases, design, deviation, &l.of.measure) / l.limit;
        let excepted = l.to_limit().excepted.into_iter();
        let others =
            excepted.map(|e| robust::deviated(if e.in_service { &in_service } else { cases }, design, deviation, &e.measure) / e.limit);
        others.fold(own, f64::max)
    };
    let judged = study.limits.iter().enumerate().filter(|l| !l.1.of.measure.is_inertia());
    judged.map(|(i, l)| (i, ratio(l))).collect()
}

/// The largest of them, and the limit it is of.
pub(super) fn worst(study: &Study, cases: &[LoadCase], design: &[Mounted], deviation: &Deviation) -> (f64, usize) {
    ratios(study, cases, design, deviation).into_iter().fold((0.0, 0), |m, (i, r)| if r > m.0 { (r, i) } else { m })
}
