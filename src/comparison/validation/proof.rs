//! A proof from a file, held against dense solutions of chain and ring: nothing of the search that wrote it is used.
//!
//! The ring's law S turns the system by rank one: with v = 1 at its carrier and -1 at the ring, and x the angles, an output is y(S + D) = y(S) - o(A⁻¹v) (v·x) D/(1 + c D), c = v·A⁻¹v
//! \[Sherman & Morrison 1950\]. In each parameter S is linear, so that D over a box lies in the hull of what it is in the corners, and so does the linear part of y; what is left is at most
//! |c| r²/(1 - |c| r) with r the largest |D|. A box that this does not exclude is cut.

use crate::absorber::{Absorber, Declaration, Mounted, Operating, RUBBER, TUNED, UNDAMPED, VISCOUS};
use crate::crankshaft::Torque;
use crate::input::tables::ExcludedBox;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::numerics::synthesis::Extremes;
use crate::objective::{HELD, Measure, Over};
use crate::optimise::{ExcludingSpeed, Exclusion, LoadCase, Problem, Space};
use crate::response::{Dense, Quantity};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Why a proof is not confirmed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Objection {
    /// Line of the file; `None`: not of one line.
    pub line: Option<u64>,
    /// Whether the proof does not hold as it stands; else it is of a kind that is not checked.
    pub is_refuted: bool,
    /// In words.
    pub words: String,
}

impl Objection {
    fn refuted(words: impl Into<String>) -> Self {
        Self { line: None, is_refuted: true, words: words.into() }
    }

    fn unchecked(words: impl Into<String>) -> Self {
        Self { line: None, is_refuted: false, words: words.into() }
    }
}

/// Types whose law is linear in each of its parameters.
const TYPES: [&Declaration; 4] = [&TUNED, &UNDAMPED, &VISCOUS, &RUBBER];
/// What excludes exceeds what is claimed by this share at least.
const BEYOND: f64 = 1e-9;
/// Parts of a box that are looked at, at most.
const PARTS: u64 = 100_000;

/// Confirms that boxes cover all designs of a problem, and that at the speeds of each every design in it breaks a limit or has an objective of at least `claim`; without a claim, that every one breaks a limit. Returns the
/// number of parts of boxes that were looked at.
///
/// # Errors
/// [`Objection`] where that is not so, or cannot be told.
pub fn confirm(problem: &Problem, claim: Option<f64>, boxes: &[ExcludedBox]) -> Result<u64, Objection> {
    let (space, [slot]) = (&problem.space, problem.space.slots.as_slice()) else {
        return Err(Objection::unchecked("only proofs of one absorber are checked"));
    };
    if !TYPES.contains(&slot.declaration) || space.variables.iter().any(|v| v.parameter == 0) || !problem.weights.is_empty() {
        let types: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
        let words = format!("only proofs of {}, of a ring of given inertia and no sum of objectives, are checked", types.join(", "));
        return Err(Objection::unchecked(words));
    }
    if problem.load_cases.iter().any(|c| c.finder.system.flexible.is_some()) {
        return Err(Objection::unchecked("proofs on a flexible crank are not checked"));
    }
    if claim.is_some_and(|claim| !(claim.is_finite() && claim > 0.0)) {
        return Err(Objection::refuted("the bound is not above zero"));
    }
    let bounds: Vec<(f64, f64)> = space.variables.iter().map(|v| (v.lower, v.upper)).collect();
    let keys: Vec<&str> = space.variables.iter().map(|v| slot.declaration.parameters[v.parameter].key).collect();
    cover(&keys, bounds, boxes.iter().collect())?;
    let parts = AtomicU64::new(0);
    let objection = |row: &ExcludedBox| match excluded(problem, claim, &row.own) {
        Ok(own) => {
            parts.fetch_add(own, Ordering::Relaxed);
            None
        }
        Err(objection) => Some(Objection { line: Some(row.line), ..objection }),
    };
    match boxes.par_iter().find_map_first(objection) {
        Some(objection) => Err(objection),
        None => Ok(parts.into_inner()),
    }
}

/// Whether boxes cover a range, each part of it once: there are cuts between them, and each slab is covered, or there is one and it is the range.
fn cover(keys: &[&str], range: Vec<(f64, f64)>, boxes: Vec<&ExcludedBox>) -> Result<(), Objection> {
    let is_same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    let mut open = vec![(range, boxes)];
    while let Some((range, boxes)) = open.pop() {
        if let [only] = boxes.as_slice()
            && only.own.ranges.iter().zip(&range).all(|(a, b)| is_same(a.0, b.0) && is_same(a.1, b.1))
        {
            continue;
        }
        let slabs = (0..range.len()).map(|d| (d, slabs(d, boxes.clone()))).find(|found| found.1.len() > 1);
        let Some((d, slabs)) = slabs else {
            let ranges: Vec<String> = keys.iter().zip(&range).map(|(key, r)| format!("{key} {} to {}", r.0, r.1)).collect();
            let words = format!("the boxes do not cover {} without gaps and overlaps", ranges.join(" and "));
            return Err(Objection { line: boxes.first().map(|b| b.line), ..Objection::refuted(words) });
        };
        let from = |slab: &Vec<&ExcludedBox>| slab[0].own.ranges[d].0;
        let starts: Vec<f64> = slabs.iter().map(from).collect();
        let last = slabs.len() - 1;
        for (i, slab) in slabs.into_iter().enumerate() {
            let mut own = range.clone();
            own[d] = (if i == 0 { own[d].0 } else { starts[i] }, if i == last { own[d].1 } else { starts[i + 1] });
            open.push((own, slab));
        }
    }
    Ok(())
}

/// Boxes between cuts across a parameter that no box of them crosses, in ascending order.
fn slabs(d: usize, mut boxes: Vec<&ExcludedBox>) -> Vec<Vec<&ExcludedBox>> {
    boxes.sort_by(|a, b| a.own.ranges[d].0.total_cmp(&b.own.ranges[d].0));
    let (mut slabs, mut end): (Vec<Vec<&ExcludedBox>>, f64) = (Vec::new(), f64::NEG_INFINITY);
    for b in boxes {
        match slabs.last_mut() {
            Some(slab) if b.own.ranges[d].0 < end => slab.push(b),
            _ => slabs.push(vec![b]),
        }
        end = end.max(b.own.ranges[d].1);
    }
    slabs
}

/// Number of parts of a box that were looked at until all of it was excluded.
fn excluded(problem: &Problem, claim: Option<f64>, own: &Exclusion) -> Result<u64, Objection> {
    let shares = own.speeds.iter().map(|s| s.share);
    if shares.clone().any(|share| !(0.0..=1.0).contains(&share)) || (shares.sum::<f64>() - 1.0).abs() > BEYOND {
        return Err(Objection::refuted("the shares of its speeds are not from 0 to 1, or not 1 together"));
    }
    let (mut open, mut parts) = (vec![own.ranges.clone()], 0);
    while let Some(ranges) = open.pop() {
        parts += 1;
        if parts > PARTS {
            return Err(Objection::unchecked(format!("{PARTS} parts of the box do not suffice to exclude it")));
        }
        let mut least = Least::default();
        for speed in &own.speeds {
            least.add(problem, claim, (&ranges, speed))?;
        }
        if least.value - least.doubt < 1.0 + BEYOND {
            let unchecked = Objection::unchecked;
            return Err(match (least.value + least.doubt < 1.0 + BEYOND, least.is_partial) {
                (_, true) => {
                    unchecked("it may rest on an rms value, a power, a strain or a multiaxial margin: of these no proof is checked")
                }
                (true, false) => Objection::refuted("a design in it is not excluded"),
                (false, false) => unchecked("rounding of the dense solutions hides whether it is excluded"),
            });
        }
        if let Some(along) = least.open_along() {
            let (low, high) = ranges[along];
            let middle = if low > 0.0 { (low * high).sqrt() } else { 0.5 * (low + high) };
            for half in [(low, middle), (middle, high)] {
                let mut ranges = ranges.clone();
                ranges[along] = half;
                open.push(ranges);
            }
        }
    }
    Ok(parts)
}

/// The law at values of the free parameters, as a design.
fn design(space: &Space, values: &[f64]) -> Vec<Mounted> {
    let mut held = Space { slots: space.slots.clone(), variables: Vec::new() };
    space.variables.iter().zip(values).for_each(|(v, x)| held.slots[0].values[v.parameter] = *x);
    held.design(&[])
}

/// Designs in the middle and in the corners of a part, bit d of a corner's number telling its end of range d.
fn designs(problem: &Problem, case: &LoadCase, ranges: &[(f64, f64)]) -> Option<(Vec<Mounted>, Vec<Vec<Mounted>>)> {
    let end = |bits: usize, d: usize, r: &(f64, f64)| if bits >> d & 1 == 1 { r.1 } else { r.0 };
    let corner = |bits: usize| ranges.iter().enumerate().map(|(d, r)| end(bits, d, r)).collect::<Vec<_>>();
    let there = |values: &[f64]| case.absorbers(&design(&problem.space, values)).ok();
    let middle: Vec<f64> = ranges.iter().map(|r| 0.5 * (r.0 + r.1)).collect();
    Some((there(&middle)?, (0..1 << ranges.len()).map(|bits| there(&corner(bits))).collect::<Option<_>>()?))
}

/// The least that the mean over the speeds of a box is over a part of it.
#[derive(Default)]
struct Least {
    /// In the middle.
    value: f64,
    /// Change to each corner, but for what is not linear.
    corners: Vec<f64>,
    /// What that is at most.
    rest: f64,
    /// What rounding may change in the middle.
    doubt: f64,
    /// Whether something that is asked there has no bound by other means.
    is_partial: bool,
    /// How far each parameter moves phasors.
    moved: Vec<f64>,
}

impl Least {
    /// Adds what is asked at a speed.
    fn add(&mut self, problem: &Problem, claim: Option<f64>, (ranges, speed): (&[(f64, f64)], &ExcludingSpeed)) -> Result<(), Objection> {
        let case = problem.load_cases.iter().find(|c| (c.condition, c.cylinder) == (speed.condition, speed.cylinder));
        let case = case.ok_or_else(|| Objection::refuted("the optimum is not held in this condition"))?;
        let (speeds, rpm) = (&case.finder.grid.speed_rpm, speed.speed_rpm);
        if !(speeds[0]..=speeds[speeds.len() - 1]).contains(&rpm) || !(case.finder.refine || speeds.contains(&rpm)) {
            return Err(Objection::refuted(format!("the study does not ask for {rpm} rpm")));
        }
        if claim.is_none() && !speed.by_limit {
            return Err(Objection::refuted("it is excluded by the objective, but there is no `lower_bound`"));
        }
        // limits hold with a little above them
        let objectives = problem.objectives.iter().filter_map(|l| Some((l, claim?))).filter(|_| !speed.by_limit);
        let limits = problem.limits.iter().map(|l| (l, 1.0 + HELD)).filter(|_| speed.by_limit);
        let parts = objectives.chain(limits).flat_map(|(l, by)| case.parts_of(l).map(move |(measure, unit)| (measure, unit * by)));
        let parts: Vec<_> = parts.filter(|(measure, _)| measure.within.holds(rpm)).collect();
        let is_there = |q: &&Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= problem.space.slots.len());
        let quantities: Vec<Quantity> = parts.iter().flat_map(|p| p.0.quantities.iter().filter(is_there).copied()).collect();
        let at = AtSpeed::new(problem, case, (ranges, rpm), &quantities);
        let at = at.ok_or_else(|| Objection::unchecked("the law is not linear in its parameters there, or the system is singular"))?;
        let mut best: Option<(Plane, &[Phasor])> = None;
        for (measure, most) in &parts {
            for (q, y) in measure.quantities.iter().filter_map(|q| Some((*q, at.outputs.iter().find(|o| o.0 == *q)?.1.as_slice()))) {
                match Plane::of(case, measure, (q, y), rpm) {
                    Some(plane) => {
                        let plane = plane.times(speed.share * measure.within.weight(rpm) / most);
                        best = best.filter(|b| b.0.value >= plane.value).or(Some((plane, y)));
                    }
                    None => self.is_partial = true,
                }
            }
        }
        let Some((plane, y)) = best else {
            return Err(Objection::unchecked("no proof by rms values, powers, strains and multiaxial margins is checked"));
        };
        self.value += plane.value;
        self.corners.resize(at.corners.len(), 0.0);
        self.moved.resize(ranges.len(), 0.0);
        for (n, (y, (c, twist))) in y.iter().zip(&at.twists).enumerate() {
            let (change, weight) = (-(y.by_pair.0 * twist.0), plane.weights[n]);
            let largest = at.corners.iter().map(|corner| corner[n].norm()).fold(0.0, f64::max);
            let (all, share) = (largest * change.norm(), largest * (c.0.norm() + c.1));
            self.rest += if share < 1.0 { (weight.norm() * share + plane.moved) * all / (1.0 - share) } else { f64::INFINITY };
            let off = y.by_pair.1 * twist.0.norm() + (y.by_pair.0.norm() + y.by_pair.1) * twist.1;
            self.rest += (weight.norm() + plane.moved) * largest * off / (1.0 - share).max(f64::EPSILON);
            self.doubt += (weight.norm() + plane.moved) * y.own.1;
            self.corners.iter_mut().zip(&at.corners).for_each(|(sum, corner)| *sum += (corner[n] * change * weight).re);
            for (d, moved) in self.moved.iter_mut().enumerate() {
                *moved += (at.corners[1 << d][n] - at.corners[0][n]).norm() * change.norm() * weight.norm();
            }
        }
        Ok(())
    }

    /// `None` where all of the part is excluded, else the parameter that it is to be cut along: that which takes most away, linearly or by what is not.
    fn open_along(&self) -> Option<usize> {
        let linear = self.corners.iter().copied().fold(f64::INFINITY, f64::min);
        if self.value + linear - self.rest - self.doubt >= 1.0 + BEYOND {
            return None;
        }
        let change = |d: usize| if -linear > self.rest { (self.corners[1 << d] - self.corners[0]).abs() } else { self.moved[d] };
        (0..self.moved.len()).max_by(|a, b| change(*a).total_cmp(&change(*b)))
    }
}

/// Dense solutions in the middle of a part, an order each.
struct AtSpeed {
    /// What S is in each corner less what it is in the middle.
    corners: Vec<Vec<C64>>,
    /// c, and v·x, each with its doubt.
    twists: Vec<(Trusted, Trusted)>,
    outputs: Vec<(Quantity, Vec<Phasor>)>,
}

/// A number, and what rounding may change of it.
type Trusted = (C64, f64);

/// A quantity at an order, in the middle.
struct Phasor {
    own: Trusted,
    /// Under the pair of torques.
    by_pair: Trusted,
}

impl AtSpeed {
    fn new(problem: &Problem, case: &LoadCase, (ranges, speed_rpm): (&[(f64, f64)], f64), quantities: &[Quantity]) -> Option<Self> {
        let (middle, corners) = designs(problem, case, ranges)?;
        let stiffness = |design: &[Mounted], omega: f64| match &design[0].absorber {
            Absorber::Ring(law) => Some(law.dynamic_stiffness(Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM })),
            Absorber::Locked { .. } => None,
        };
        let dense = Dense::new(case.finder.system, case.finder.grid);
        let outputs = quantities.iter().map(|q| (*q, Vec::new())).collect();
        let mut own = Self { corners: vec![Vec::new(); corners.len()], twists: Vec::new(), outputs };
        for (n, order) in case.finder.system.excitation.orders.iter().enumerate() {
            let solved = dense.at(&middle, (n, speed_rpm));
            let (x, pair) = (solved.under_torque()?, solved.under_pair(0)?);
            own.twists.push((solved.twist(0, &pair)?, solved.twist(0, &x)?));
            for (q, y) in &mut own.outputs {
                y.push(Phasor { own: solved.trusted(*q, &x)?, by_pair: solved.trusted(*q, &pair)? });
            }
            let omega = order.omega(speed_rpm);
            let s = stiffness(&middle, omega)?;
            let (mut sum, mut most) = (C64::default(), s.norm());
            for (all, corner) in own.corners.iter_mut().zip(&corners) {
                let change = stiffness(corner, omega)? - s;
                (sum, most) = (sum + change, f64::max(most, change.norm()));
                all.push(change);
            }
            // of a law that is linear in each parameter the middle is the mean of the corners
            if sum.norm() > BEYOND * most * corners.len() as f64 {
                return None;
            }
        }
        Some(own)
    }
}

/// What a measure is nowhere below: its value in the middle, and the change of each phasor times its weight, real parts added up, less the sum of the sizes of all changes times `moved`.
struct Plane {
    value: f64,
    weights: Vec<C64>,
    moved: f64,
}

impl Plane {
    /// `None` of measures without.
    fn of(case: &LoadCase, measure: &Measure, (quantity, y): (Quantity, &[Phasor]), speed_rpm: f64) -> Option<Self> {
        let excitation = &case.finder.system.excitation;
        let centres: Vec<C64> = y.iter().map(|y| y.own.0).collect();
        let extremes = case.finder.synthesiser.extremes(&centres);
        let at = |angle: f64| -> Vec<C64> { excitation.harmonics.iter().map(|h| turn(f64::from(*h) * angle)).collect() };
        let (high, low) = (at(extremes.angle_max), at(extremes.angle_min));
        let both = |of_high: f64, of_low: f64| high.iter().zip(&low).map(|(a, b)| a * of_high + b * of_low).collect::<Vec<_>>();
        let sum = |weights: &[C64]| centres.iter().zip(weights).map(|(y, w)| (y * w).re).sum::<f64>();
        let linear = |weights: Vec<C64>| Self { value: sum(&weights), weights, moved: 0.0 };
        match measure.over {
            Over::Synthesis => Some(linear(both(0.5, -0.5))),
            Over::Orders | Over::Order(_) => {
                let is_asked = |n: &usize| !matches!(measure.over, Over::Order(o) if o != excitation.orders[*n]);
                let n = (0..y.len()).filter(is_asked).max_by(|a, b| centres[*a].norm().total_cmp(&centres[*b].norm()))?;
                let mut own = vec![C64::default(); y.len()];
                own[n] = centres[n].conj() / centres[n].norm();
                own[n].is_finite().then(|| linear(own))
            }
            Over::Margin(criterion) => {
                let (margin, Quantity::ShaftTorque(shaft)) = (case.finder.margin?, quantity) else { return None };
                if margin.is_multiaxial(criterion) {
                    return None;
                }
                let (most, least) = (sum(&high), sum(&low));
                let extremes = Extremes { half_peak_to_peak: 0.5 * (most - least), middle: 0.5 * (most + least), ..extremes };
                let torque = Torque { extremes, phasors: &centres };
                let own = margin.spots_of(criterion, shaft).map(|i| margin.used(criterion, i, speed_rpm, &torque));
                let used = own.max_by(|a, b| a.value.total_cmp(&b.value))?;
                // convex in maximum and minimum: where it falls with the one or rises with the other, that moves no further than all phasors
                let (by_most, by_least) = (0.5 * (used.slopes.0 + used.slopes.1), 0.5 * (used.slopes.1 - used.slopes.0));
                let weights = both(by_most.max(0.0), by_least.min(0.0));
                Some(Self { value: used.value, weights, moved: by_least.max(0.0) - by_most.min(0.0) })
            }
            _ => None,
        }
    }

    fn times(mut self, factor: f64) -> Self {
        self.weights.iter_mut().for_each(|w| *w *= factor);
        Self { value: self.value * factor, moved: self.moved * factor, ..self }
    }
}
