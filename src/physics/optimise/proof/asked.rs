//! What a proof asks of designs: measures of a problem at some speeds, as lower bounds over boxes.

use super::at_speed::{AtSpeed, Pair, PairOver};
use super::form::Form;

use super::verdict::Reason;
use crate::absorber::{Host, Law, Mounted, Operating};
use crate::crankshaft::Torque;
use crate::numerics::elementary::turn;
use crate::numerics::synthesis::Extremes;
use crate::numerics::taylor::{MOST, Taylor};
use crate::numerics::{C64, ZERO};
use crate::objective::measure::{HELD, Measure, Over};
use crate::objective::{Condition, PeakFinder};
use crate::optimise::problem::Role;
use crate::optimise::{Problem, Row};
use crate::response::Quantity;
use crate::response::enclosed::{BaseAtSpeed, Enclosed};
use std::sync::Arc;

/// A load case with the absorbers of a design there: their laws are those of all designs of the family.
pub(super) struct Case<'a> {
    /// Index among the load cases of the problem.
    pub index: usize,
    pub finder: &'a PeakFinder<'a>,
    absorbers: Vec<Mounted>,
    stations: Vec<usize>,
    /// Whether quotients are made: of two parameters of one absorber linear functions say enough.
    by_quotients: bool,
    /// What is asked here.
    pub parts: Vec<Part<'a>>,
    /// Their quantities, each once.
    pub quantities: Vec<Quantity>,
}

/// A measure that must not reach a value.
pub(super) struct Part<'a> {
    pub role: Role,
    pub measure: &'a Measure,
    pub most: f64,
    /// Where its quantities stand in the list of the case.
    pub quantities: Vec<usize>,
}

/// What a problem asks, in the load cases that have an enclosure. `target`: what an objective must not reach, in the unit of the problem; `None` where only limits count.
pub(super) fn cases<'a>(problem: &'a Problem<'a>, point: &[f64], target: Option<f64>) -> Result<Vec<Case<'a>>, Reason> {
    let own = problem.space.design(point);
    if problem.space.variables.is_empty() {
        return Err(Reason::NothingFree);
    }
    if !problem.weights.is_empty() {
        return Err(Reason::Sum);
    }
    if problem.space.variables.len() > MOST {
        return Err(Reason::Parameters);
    }
    if own.iter().any(|m| matches!(m.on, Host::Ring(_))) {
        return Err(Reason::Absorbers);
    }
    if problem.load_cases.iter().any(|c| c.deviation.is_some()) {
        return Err(Reason::Tolerances);
    }
    if !own.iter().all(|m| m.absorber.law().is_some_and(has_enclosure)) {
        return Err(Reason::Law);
    }
    let objectives = problem.objectives.iter().enumerate().map(|(i, l)| (Role::Objective(i), l)).filter(|_| target.is_some());
    let limits = problem.limits.iter().enumerate().map(|(i, l)| (Role::Limit(i), l));
    let asked: Vec<_> = objectives.chain(limits).collect();
    let mut cases = Vec::new();
    for (index, case) in problem.steering() {
        // in operation absorbers follow their motion; where they do not work nothing but their inertia counts
        if case.condition == Condition::InOperation || !case.condition.has_absorbers() {
            continue;
        }
        let absorbers = case.absorbers_at_few_speeds(&own);
        let mut stations: Vec<usize> = absorbers.iter().filter_map(|m| if let Host::Station(s) = m.on { Some(s) } else { None }).collect();
        stations.dedup();
        let mut found = Case {
            index,
            finder: case.finder,
            absorbers,
            stations,
            by_quotients: own.len() == 2 || problem.space.variables.len() > 2,
            parts: Vec::new(),
            quantities: Vec::new(),
        };
        for (role, limit) in &asked {
            for (measure, unit) in case.parts_of(limit).filter(|p| has_bound(p.0, case.finder)) {
                // what is beyond a limit by rounding holds it
                let most = unit * if role.is_limit() { 1.0 + HELD } else { target.unwrap_or(f64::INFINITY) };
                let mut place = |q: &Quantity| {
                    found.quantities.iter().position(|known| known == q).unwrap_or_else(|| {
                        found.quantities.push(*q);
                        found.quantities.len() - 1
                    })
                };
                let is_there = |q: &&Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= own.len());
                let quantities = measure.quantities.iter().filter(is_there).map(&mut place).collect();
                found.parts.push(Part { role: *role, measure, most, quantities });
            }
        }
        cases.push(found);
    }
    let is_asked = |is_limit: bool| cases.iter().flat_map(|c| &c.parts).any(|p| p.role.is_limit() == is_limit);
    if !is_asked(target.is_none()) {
        return Err(Reason::Objective);
    }
    Ok(cases)
}

/// Whether a law has an enclosure. Any point will do: it has one or none.
pub(super) fn has_enclosure(law: &Arc<dyn Law>) -> bool {
    let at = Operating { omega: 1.0, shaft_speed: 1.0 }.into();
    law.over(&law.values().into_iter().map(|x| Taylor::constant(C64::from(x))).collect::<Vec<_>>(), &at).is_some()
}

/// Whether a measure at a speed has a bound over a box: shares of strength by amplitude and mean are convex functions of the torque, those by its whole history are left out.
fn has_bound(measure: &Measure, finder: &PeakFinder) -> bool {
    match measure.over {
        Over::Synthesis | Over::Orders | Over::Order(_) | Over::Statistic(_) | Over::Power | Over::Strain | Over::SpringStress => true,
        Over::Margin(criterion) => finder.margin.is_some_and(|margin| !margin.is_multiaxial(criterion)),
        Over::Temperature | Over::Mean | Over::AtDuty(_) | Over::MeanPower | Over::Damage | Over::Property(_) => false,
    }
}

impl Case<'_> {
    /// Speeds of its sweep, rpm.
    pub fn speeds(&self) -> &[f64] {
        &self.finder.grid.speed_rpm
    }

    /// The same at one speed; `None` where it resonates without damping there, and of speeds that no peak is looked for at: beside the sweep, and between its speeds where peaks are not refined.
    pub fn at(&self, case: usize, speed_rpm: f64) -> Option<AtSpeed> {
        let speeds = self.speeds();
        if !(speeds[0]..=speeds[speeds.len() - 1]).contains(&speed_rpm) || !self.finder.refine && !speeds.contains(&speed_rpm) {
            return None;
        }
        let base = BaseAtSpeed::new(&self.finder.direct, &self.stations, &self.quantities, speed_rpm)?;
        let of = |m: &Mounted| self.stations.iter().position(|s| m.on == Host::Station(*s));
        let quotients = match self.absorbers.as_slice() {
            _ if !self.by_quotients => Vec::new(),
            [a] => of(a).map_or_else(Vec::new, |a| base.quotients([a, a], &self.quantities)),
            [a, b] => of(a).zip(of(b)).map_or_else(Vec::new, |(a, b)| base.quotients([a, b], &self.quantities)),
            _ => Vec::new(),
        };
        Some(AtSpeed { case, speed_rpm, base, quotients })
    }

    /// Whether a row of a problem is of what is asked here.
    pub fn asks(&self, row: &Row) -> bool {
        row.load_case == self.index && self.parts.iter().any(|p| p.role == row.role && p.measure.over == row.peak.over)
    }

    /// Its absorbers over a box: values of all parameters, a row an absorber.
    pub fn enclosed(&self, values: &[Vec<Taylor>]) -> Result<Vec<Enclosed>, Reason> {
        let one = |(m, v): (&Mounted, &Vec<Taylor>)| Enclosed::of(m, v.clone(), &self.stations).ok_or(Reason::Law);
        self.absorbers.iter().zip(values).map(one).collect()
    }

    /// Lower bounds of what is asked at a speed over a box; `None` where a design of it may be without finite response and absorbers are not looked at as quotients.
    pub fn forms(&self, at: &AtSpeed, (absorbers, both): (&[Enclosed], &Pair), forms: &mut Vec<Form>) -> Option<()> {
        let (orders, none) = (at.base.orders(), [Taylor::constant(ZERO); 2]);
        if orders == 0 {
            return Some(());
        }
        let mut phasors = vec![vec![none; orders]; self.quantities.len()];
        let mut pair = None;
        for order in 0..orders {
            if at.base.phasors_of(order, absorbers, &self.quantities, |i, y| phasors[i][order] = y).is_none() {
                let own = pair.get_or_insert_with(|| PairOver::of(at, both));
                let own = own.as_ref()?;
                phasors.iter_mut().enumerate().for_each(|(i, y)| y[order][0] = own.unknown(order, i));
                if !phasors.iter().all(|y| y[order][0].centre.is_finite()) {
                    return None;
                }
            }
        }
        for part in self.parts.iter().filter(|p| p.measure.within.holds(at.speed_rpm)) {
            let factor = part.measure.within.weight(at.speed_rpm) / part.most;
            let mut put = |form: Form| {
                if form.value.is_finite() {
                    forms.push(Form { is_objective: !part.role.is_limit(), ..form.times(factor) });
                }
            };
            if part.measure.over == Over::Power {
                let all = part.quantities.iter().flat_map(|q| phasors[*q].iter().enumerate());
                put(Form::of_products(all.map(|(n, [twist, moment])| (*moment, *twist, 0.5 * at.base.omega(n)))));
                continue;
            }
            for q in &part.quantities {
                let own = &phasors[*q];
                let centres: Vec<C64> = own.iter().map(|y| y[0].centre).collect();
                let weighted = |by: &dyn Fn(usize) -> C64| Form::of_sum(own.iter().enumerate().map(|(n, y)| (y[0], by(n))));
                match part.measure.over {
                    Over::Orders | Over::Order(_) => {
                        let is_asked = |n: &usize| match part.measure.over {
                            Over::Order(order) => self.finder.system.excitation.orders[*n] == order,
                            _ => true,
                        };
                        let largest = (0..orders).filter(is_asked).max_by(|a, b| centres[*a].norm_sqr().total_cmp(&centres[*b].norm_sqr()));
                        let Some(n) = largest.filter(|n| centres[*n] != ZERO) else { continue };
                        put(Form::of_sum(std::iter::once((own[n][0], centres[n].conj() / centres[n].norm()))));
                    }
                    Over::Statistic(statistic) => put(weighted(&|n| centres[n].conj() * (statistic.0.slope)(&centres, n))),
                    over => {
                        let extremes = self.finder.synthesiser.extremes(&centres);
                        let pair = pair.as_ref().and_then(Option::as_ref).map(|p| (p, *q));
                        let sum = Sum { own, centres: &centres, extremes, finder: self.finder, pair };
                        let form = match (over, self.quantities[*q]) {
                            (Over::Margin(criterion), Quantity::ShaftTorque(shaft)) => sum.used((criterion, shaft), at.speed_rpm),
                            (Over::Strain, Quantity::RingTwist(i)) => {
                                let law = self.absorbers[i].absorber.law();
                                law.and_then(|law| law.strain_per_twist()).map(|by| sum.half_range().times(by))
                            }
                            (Over::SpringStress, Quantity::RingTwist(i)) => {
                                let law = self.absorbers[i].absorber.law();
                                law.and_then(|law| law.stress_per_twist()).map(|by| sum.half_range().times(by))
                            }
                            (Over::Margin(_) | Over::Strain | Over::SpringStress, _) => None,
                            _ => Some(sum.half_range()),
                        };
                        form.into_iter().for_each(&mut put);
                    }
                }
            }
        }
        Some(())
    }
}

/// A sum of orders over a box.
struct Sum<'s> {
    /// Of each order the first is what is added up.
    own: &'s [[Taylor; 2]],
    centres: &'s [C64],
    /// Of the sum in the middle.
    extremes: Extremes,
    finder: &'s PeakFinder<'s>,
    /// The absorbers as quotients with the index of the quantity, where an order has no model.
    pair: Option<(&'s PairOver<'s>, usize)>,
}

impl Sum<'_> {
    /// A multiple of the sum at the angle of its maximum and one at that of its minimum, together.
    fn at_extremes(&self, (of_max, of_min): (f64, f64)) -> Form {
        let harmonics = self.finder.system.excitation.harmonics.iter().map(|h| f64::from(*h));
        let by = harmonics.map(|h| of_max * turn(h * self.extremes.angle_max) + of_min * turn(h * self.extremes.angle_min));
        let terms = self.own.iter().map(|y| y[0]).zip(by);
        match self.pair {
            None => Form::of_sum(terms),
            Some((pair, quantity)) => pair.sum(quantity, terms),
        }
    }

    /// Half its range is at least half the difference between two angles.
    fn half_range(&self) -> Form {
        self.at_extremes((0.5, -0.5))
    }

    /// Share of the strength that is used at the location which is used most in the middle, at least: its tangent plane there, by half range and middle; these by maximum and minimum, of which the one is at least, the other
    /// at most what it is at the angle. Where the mean counts more than the amplitude, by how far any angle may move.
    fn used(&self, (criterion, shaft): (usize, usize), speed_rpm: f64) -> Option<Form> {
        let torque = Torque { extremes: self.extremes, phasors: self.centres };
        let used = self.finder.margin?.most_used(criterion, shaft, speed_rpm, &torque)?;
        let (of_max, of_min) = (0.5 * (used.slopes.0 + used.slopes.1), 0.5 * (used.slopes.1 - used.slopes.0));
        let beyond = of_min.max(0.0) - of_max.min(0.0);
        let moved = if beyond > 0.0 { beyond * self.own.iter().map(|y| y[0].reach()).sum::<f64>() } else { 0.0 };
        let mut form = self.at_extremes((of_max.max(0.0), of_min.min(0.0)));
        form.value += used.value * (1.0 - TANGENT) - form.middle - moved;
        form.middle = used.value;
        Some(form)
    }
}

/// Share of its value that a tangent plane may err by in floating-point numbers.
const TANGENT: f64 = 1e-12;
