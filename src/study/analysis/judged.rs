//! The one value that a design is judged by: of what it is the worst, and what the same measure comes to at the reference.

use super::evaluate::DesignResult;
use super::results::{OptimumResult, Results};
use crate::numerics::elementary::Elementary;
use crate::objective::{Condition, Measure, Over};
use std::cmp::Ordering;

/// What a value is reached in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Basis {
    /// A condition; firing is the reference.
    In(Condition),
    /// The absorber's own amplitude, by harmonic balance.
    OwnAmplitude,
    /// The tolerances of the study.
    Tolerances,
}

impl Basis {
    /// The reference: all cylinders fire, materials are at their reference, twist is small, parameters are as drawn.
    const REFERENCE: Self = Self::In(Condition::Firing);

    /// Its word in files.
    #[doc(hidden)]
    pub fn name(self) -> &'static str {
        match self {
            Self::In(condition) => condition.name(),
            Self::OwnAmplitude => "own_amplitude",
            Self::Tolerances => "tolerances",
        }
    }
}

/// The value that a design is judged by.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Judged {
    /// Index of the objective that it is a value of.
    pub objective: usize,
    /// The largest, inside: as it is minimised.
    pub value: f64,
    /// What it is the largest of.
    pub worst_of: Vec<Basis>,
    /// In which of these it is reached.
    pub reached_in: Basis,
    /// The same measure at the reference.
    pub reference: f64,
}

/// Values that differ by less than this share are one.
const SAME: f64 = 1e-9;

impl Judged {
    /// Whether it is the value at the reference and of nothing else.
    #[doc(hidden)]
    pub fn is_reference(&self) -> bool {
        self.worst_of == [Basis::REFERENCE]
    }

    /// The value at the reference, where it is another one.
    #[doc(hidden)]
    pub fn other_reference(&self) -> Option<f64> {
        ((self.value / self.reference - 1.0).abs() > SAME).then_some(self.reference)
    }
}

impl Results {
    /// Conditions that a design is judged in: those that an optimum is to hold in, and in operation; one that changes nothing is firing, and an inertia is the same in all.
    fn judged_in(&self, d: &DesignResult) -> Vec<Basis> {
        if self.study.objective.measure.is_inertia() {
            return vec![Basis::REFERENCE];
        }
        let held = self.study.held();
        let changes = |c: Condition| d.conditions.iter().any(|own| own.condition == c);
        let mut list = Vec::new();
        for c in held.iter().copied().chain(Some(Condition::InOperation).filter(|c| changes(*c))) {
            let basis = if changes(c) { Basis::In(c) } else { Basis::REFERENCE };
            if !list.contains(&basis) {
                list.push(basis);
            }
        }
        list
    }

    /// What a design is judged by: the first objective; an optimum within the tolerances by its worst in them.
    #[doc(hidden)]
    pub fn judged(&self, d: &DesignResult) -> Option<Judged> {
        let (value, reference) = (d.objective?, d.reference?);
        let mut worst_of = self.judged_in(d);
        if let Some(own) = self.large_twist.iter().find(|own| own.design == d.name).filter(|own| own.at_large_twist.objective.is_some()) {
            worst_of.retain(|_| !own.at_large_twist.alone);
            worst_of.push(Basis::OwnAmplitude);
        }
        let same = |v: f64| v >= value * (1.0 - SAME);
        let reached = |b: &Basis| match b {
            Basis::In(Condition::Firing) => same(reference),
            Basis::In(c) => d.conditions.iter().any(|own| own.condition == *c && same(own.objective)),
            Basis::OwnAmplitude | Basis::Tolerances => true,
        };
        let reached_in = worst_of.iter().copied().find(reached).unwrap_or(Basis::REFERENCE);
        let drawn = Judged { objective: 0, value, worst_of, reached_in, reference };
        let robust = self.optima.iter().find(|o| o.robust && o.design.name == d.name);
        Some(robust.map_or_else(|| drawn.clone(), |o| self.within_tolerances(o, &drawn)))
    }

    /// An optimum within tolerances: these are about the reference of each condition, so that the worst of operation counts beside them.
    fn within_tolerances(&self, o: &OptimumResult, drawn: &Judged) -> Judged {
        let known = self.robust.iter().find(|d| d.design == o.design.name).map(|d| d.worst.value);
        let worst = known.unwrap_or_else(|| o.optimum.value());
        let mut worst_of = drawn.worst_of.clone();
        worst_of.push(Basis::Tolerances);
        let (value, reached_in) =
            if drawn.value > worst * (1.0 + SAME) { (drawn.value, drawn.reached_in) } else { (worst, Basis::Tolerances) };
        Judged { value, worst_of, reached_in, ..drawn.clone() }
    }

    /// What an optimum is judged by: the objective that it minimises.
    #[doc(hidden)]
    pub fn judged_optimum(&self, o: &OptimumResult) -> Judged {
        let value = o.optimum.value();
        if let Some(first) = self.judged(&o.design).filter(|_| o.objective == 0) {
            return first;
        }
        let is_inertia = self.study.objective_of(o.objective).measure.is_inertia();
        let held = if is_inertia { &[Condition::Firing] } else { self.study.held() };
        let worst_of: Vec<Basis> = held.iter().map(|c| Basis::In(*c)).collect();
        // its active peak says where it is reached
        let row = o.optimum.outcome.rows.rows.iter().position(|r| !r.role.is_limit());
        let reached_in = row.and_then(|i| o.load_cases.get(i)).map_or(Basis::REFERENCE, |c| Basis::In(c.condition));
        Judged { objective: o.objective, value, worst_of, reached_in, reference: o.reference.unwrap_or(value) }
    }

    /// Whether an absorber of a design overheats at some speed.
    #[doc(hidden)]
    pub fn overheats(&self, name: &str) -> bool {
        self.heat.iter().any(|h| h.design == name && h.overheats())
    }

    /// Whether a measure has a value of a design: where there is no such absorber it has none, and an absorber that overheats has no temperature in balance.
    #[doc(hidden)]
    pub fn has_value(&self, d: &DesignResult, measure: &Measure) -> bool {
        d.has(measure) && !(measure.over == Over::Temperature && self.overheats(&d.name))
    }

    /// The answer to the study's question: the best optimum by the first objective; those that hold their limits and do not overheat before others.
    #[doc(hidden)]
    pub fn best_optimum(&self, robust: bool) -> Option<&OptimumResult> {
        let asked = self.optima.iter().filter(|o| o.objective == 0 && o.robust == robust && o.main);
        let most = |o: &OptimumResult| {
            if o.robust { o.optimum.outcome.rows.excess().exponential() } else { o.design.limits.iter().copied().fold(1.0, f64::max) }
        };
        let excess = |o: &OptimumResult| if self.holds_limits(&o.design) { 0.0 } else { most(o) };
        asked.min_by(|a, b| excess(a).total_cmp(&excess(b)).then_with(|| self.order(&a.design, &b.design)))
    }

    /// The best given design with an absorber, in the same order.
    #[doc(hidden)]
    pub fn best_given(&self) -> Option<&DesignResult> {
        self.designs.iter().filter(|d| !d.absorbers.is_empty()).min_by(|a, b| self.order(a, b))
    }

    /// Order of designs by what they are judged by; what is level (a lost absorber is the same for all) by the twist while all works.
    fn order(&self, a: &DesignResult, b: &DesignResult) -> Ordering {
        let fails = |d: &DesignResult| !self.holds_limits(d) || self.overheats(&d.name);
        let value = |d: &DesignResult| self.judged(d).map_or(f64::INFINITY, |j| j.value);
        let (x, y) = (value(a), value(b));
        if fails(a) != fails(b) {
            return fails(a).cmp(&fails(b));
        }
        if (x - y).abs() <= SAME * x.abs() {
            let twist = |d: &DesignResult| d.twist.map_or(0.0, |p| p.value);
            return twist(a).total_cmp(&twist(b));
        }
        x.total_cmp(&y)
    }
}
