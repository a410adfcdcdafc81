//! The limits of a study for a design that deviates from its drawing.

use crate::absorber::{Deviation, Mounted};
use crate::input::{LimitSpec, Study};
use crate::objective::{Limit, Measure, holds};
use crate::optimise::{LoadCase, robust};
use crate::response::Work;

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

/// The limit that is broken by most (an index); `None` where all hold. As by [`worst`], but the values of limits that hold are not computed to the end.
pub(super) fn broken(study: &Study, cases: &[LoadCase], design: &[Mounted], deviation: &Deviation) -> Option<usize> {
    let judged: Vec<(usize, Limit)> =
        study.limits.iter().enumerate().filter(|l| !l.1.of.measure.is_inertia()).map(|(i, l)| (i, l.to_limit())).collect();
    let mut ratios = vec![0.0_f64; judged.len()];
    for case in cases.iter().map(|case| LoadCase { deviation: Some(deviation), ..*case }) {
        let mut asked: Vec<(usize, &Measure, f64)> = Vec::new();
        for (at, (_, limit)) in judged.iter().enumerate() {
            asked.extend(case.parts_of(limit).map(|(measure, most)| (at, measure, most)));
        }
        let above: Vec<(&Measure, f64)> = asked.iter().map(|(_, measure, most)| (*measure, *most)).collect();
        for ((at, _, most), value) in asked.iter().zip(case.values_above(design, &above, &mut Work::default())) {
            ratios[*at] = ratios[*at].max(value.map_or(f64::INFINITY, |v| v / most));
        }
    }
    let largest = judged.iter().zip(ratios).fold((0.0, 0), |m, ((i, _), r)| if r > m.0 { (r, *i) } else { m });
    (!holds(largest.0)).then_some(largest.1)
}

/// The largest of them, and the limit it is of.
pub(super) fn worst(study: &Study, cases: &[LoadCase], design: &[Mounted], deviation: &Deviation) -> (f64, usize) {
    ratios(study, cases, design, deviation).into_iter().fold((0.0, 0), |m, (i, r)| if r > m.0 { (r, i) } else { m })
}
