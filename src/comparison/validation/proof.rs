//! A proof from a file, held against dense solutions of chain and ring: nothing of the search that wrote it is used.
//!
//! The ring's law S turns the system by rank one: with v = 1 at its carrier and -1 at the ring, and x the angles, an output is y(S + D) = y(S) - o(A⁻¹v) (v·x) D/(1 + c D), c = v·A⁻¹v
//! \[Sherman & Morrison 1950\]. In each parameter S is linear, so that D over a box lies in the hull of what it is in the corners, and so does the linear part of y; what is left is at most
//! |c| r²/(1 - |c| r) with r the largest |D|. A box that this does not exclude is cut.

use crate::absorber::{Absorber, Declaration, Operating, RUBBER, TUNED, UNDAMPED, VISCOUS};
use crate::crankshaft::Torque;
use crate::input::tables::ExcludedBox;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::numerics::synthesis::Extremes;
use crate::objective::{Measure, Over};
use crate::optimise::{LoadCase, Problem, Space};
use crate::response::{Dense, Quantity};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;

/// Why a proof is not confirmed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Objection {
    /// Line of the file; `None`: not of one line.
    pub line: Option<u64>,
    /// In words.
    pub words: String,
}

/// Types whose law is linear in each of its parameters.
const TYPES: [&Declaration; 4] = [&TUNED, &UNDAMPED, &VISCOUS, &RUBBER];
/// What excludes exceeds what is claimed by this share at least: rounding of dense solutions is smaller.
const BEYOND: f64 = 1e-9;
/// Parts of a box that are looked at, at most.
const PARTS: u64 = 100_000;

/// Confirms that boxes cover all designs of a problem, and that at the speed of each every design in it breaks a limit or has an objective of at least `claim`; without a claim, that every one breaks a limit. Returns the
/// number of parts of boxes that were looked at.
///
/// # Errors
/// [`Objection`] where that is not so, or cannot be told.
pub fn confirm(problem: &Problem, claim: Option<f64>, boxes: &[ExcludedBox]) -> Result<u64, Objection> {
    let whole = |words: String| Objection { line: None, words };
    let (space, [slot]) = (&problem.space, problem.space.slots.as_slice()) else {
        return Err(whole("only proofs of one absorber are checked".into()));
    };
    if !TYPES.contains(&slot.declaration) || space.variables.iter().any(|v| v.parameter == 0) || !problem.weights.is_empty() {
        let types: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
        return Err(whole(format!(
            "only proofs of {}, of a ring of given inertia and no sum of objectives, are checked",
            types.join(", ")
        )));
    }
    let bounds: Vec<(f64, f64)> = space.variables.iter().map(|v| (v.lower, v.upper)).collect();
    cover(&bounds, boxes.iter().collect())?;
    let one = |row: &ExcludedBox| excluded(problem, claim, row).map_err(|words| Objection { line: Some(row.line), words });
    let looked: Vec<Result<u64, Objection>> = boxes.par_iter().map(one).collect();
    looked.into_iter().sum()
}

/// Whether boxes cover a range, each part of it once: there is a cut between them, or there is one and it is the range.
fn cover(range: &[(f64, f64)], mut boxes: Vec<&ExcludedBox>) -> Result<(), Objection> {
    let is_same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    if let [only] = boxes.as_slice()
        && only.ranges.iter().zip(range).all(|(a, b)| is_same(a.0, b.0) && is_same(a.1, b.1))
    {
        return Ok(());
    }
    for d in 0..range.len() {
        boxes.sort_by(|a, b| a.ranges[d].0.total_cmp(&b.ranges[d].0));
        let mut end = f64::NEG_INFINITY;
        for i in 0..boxes.len() {
            let from = boxes[i].ranges[d].0;
            if i > 0 && end <= from {
                let (mut low, mut high) = (range.to_vec(), range.to_vec());
                (low[d].1, high[d].0) = (from, from);
                let right = boxes.split_off(i);
                cover(&low, boxes)?;
                return cover(&high, right);
            }
            end = end.max(boxes[i].ranges[d].1);
        }
    }
    let words = format!("the boxes do not cover {range:?} without gaps and overlaps");
    Err(Objection { line: boxes.first().map(|b| b.line), words })
}

/// Number of parts of a box that were looked at until all of it was excluded.
fn excluded(problem: &Problem, claim: Option<f64>, row: &ExcludedBox) -> Result<u64, String> {
    let case = problem.load_cases.iter().find(|c| (c.condition, c.cylinder) == (row.condition, row.cylinder));
    let case = case.ok_or("the optimum is not held in this condition")?;
    let speeds = &case.finder.grid.speed_rpm;
    let is_asked =
        (speeds[0]..=speeds[speeds.len() - 1]).contains(&row.speed_rpm) && (case.finder.refine || speeds.contains(&row.speed_rpm));
    if !is_asked {
        return Err(format!("the study does not ask for {} rpm", row.speed_rpm));
    }
    let (mut open, mut parts) = (vec![row.ranges.clone()], 0);
    while let Some(ranges) = open.pop() {
        parts += 1;
        if parts > PARTS {
            return Err("the box could not be confirmed".into());
        }
        let part = Part::new(problem, case, &ranges, row.speed_rpm)
            .ok_or("the law is not linear in its parameters there, or the system is singular")?;
        if let Some(along) = part.open_along(problem, case, claim, row.speed_rpm)? {
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

/// A part of a box: an order each.
struct Part {
    /// What S is in each corner less what it is in the middle.
    corners: Vec<Vec<C64>>,
    /// c, and v·x.
    twists: Vec<(C64, C64)>,
    /// Phasor in the middle, and under the pair of torques, of a quantity.
    outputs: Vec<(Quantity, Vec<(C64, C64)>)>,
}

/// The law at values of the free parameters, as a design.
fn design(space: &Space, values: &[f64]) -> Vec<crate::absorber::Mounted> {
    let mut held = Space { slots: space.slots.clone(), variables: Vec::new() };
    space.variables.iter().zip(values).for_each(|(v, x)| held.slots[0].values[v.parameter] = *x);
    held.design(&[])
}

impl Part {
    fn new(problem: &Problem, case: &LoadCase, ranges: &[(f64, f64)], speed_rpm: f64) -> Option<Self> {
        let (space, system) = (&problem.space, case.finder.system);
        let dense = Dense::new(system, case.finder.grid);
        let at = |corner: Option<usize>| {
            let value = |(d, (low, high)): (usize, &(f64, f64))| match corner {
                Some(bits) if bits >> d & 1 == 1 => *high,
                Some(_) => *low,
                None => 0.5 * (low + high),
            };
            case.absorbers(&design(space, &ranges.iter().enumerate().map(value).collect::<Vec<_>>())).ok()
        };
        let middle = at(None)?;
        let corners = (0..1 << ranges.len()).map(|bits| at(Some(bits))).collect::<Option<Vec<_>>>()?;
        let stiffness = |design: &[crate::absorber::Mounted], omega: f64| match &design[0].absorber {
            Absorber::Ring(law) => Some(law.dynamic_stiffness(Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM })),
            Absorber::Locked { .. } => None,
        };
        let measures = problem.objectives.iter().chain(problem.limits).flat_map(|l| &l.measure.quantities);
        let mut part = Self { corners: vec![Vec::new(); corners.len()], twists: Vec::new(), outputs: Vec::new() };
        for q in measures {
            if part.outputs.iter().all(|known| known.0 != *q) {
                part.outputs.push((*q, Vec::new()));
            }
        }
        for (n, order) in system.excitation.orders.iter().enumerate() {
            let solved = dense.at(&middle, (n, speed_rpm));
            let (x, pair) = (solved.under_torque()?, solved.under_pair(0)?);
            part.twists.push((solved.twist(0, &pair), solved.twist(0, &x)));
            part.outputs.iter_mut().for_each(|(q, y)| y.push((solved.output(*q, &x), solved.output(*q, &pair))));
            let omega = order.omega(speed_rpm);
            let own = stiffness(&middle, omega)?;
            for (all, corner) in part.corners.iter_mut().zip(&corners) {
                all.push(stiffness(corner, omega)? - own);
            }
            // of a law that is linear in each parameter the middle is the mean of the corners
            let (sum, most) = part.corners.iter().map(|c| c[n]).fold((C64::default(), 0.0), |(s, m), d| (s + d, f64::max(m, d.norm())));
            if sum.norm() > 1e-9 * (most + own.norm()) * corners.len() as f64 {
                return None;
            }
        }
        Some(part)
    }

    /// `None` where all of it is excluded, else the parameter that it is to be cut along.
    fn open_along(&self, problem: &Problem, case: &LoadCase, claim: Option<f64>, speed_rpm: f64) -> Result<Option<usize>, String> {
        let objectives = problem.objectives.iter().filter_map(|l| Some((l, claim?)));
        let asked = objectives.chain(problem.limits.iter().map(|l| (l, 1.0)));
        let parts = asked.flat_map(|(l, times)| l.parts_in(case.condition).map(move |(measure, unit)| (measure, unit * times)));
        let there = parts.filter(|(measure, _)| measure.within.holds(speed_rpm));
        let each = there.flat_map(|(measure, most)| {
            let quantities = measure.quantities.iter().filter_map(|q| self.outputs.iter().find(|o| o.0 == *q));
            quantities.filter_map(move |(q, y)| {
                let (weights, more) = weights(case, measure, (*q, y), speed_rpm)?;
                let by = measure.within.weight(speed_rpm) / most;
                Some((y, weights.into_iter().map(|w| w * by).collect::<Vec<C64>>(), more * by))
            })
        });
        let value =
            |(y, weights, more): &(&Vec<(C64, C64)>, Vec<C64>, f64)| more + y.iter().zip(weights).map(|(y, w)| (y.0 * w).re).sum::<f64>();
        let Some(best) = each.max_by(|a, b| value(a).total_cmp(&value(b))) else {
            return Err("what is asked there has no bound by other means".into());
        };
        if value(&best) < 1.0 + BEYOND {
            return Err("the design in the middle of a part is not excluded at this speed".into());
        }
        let slopes: Vec<C64> = best.0.iter().zip(&best.1).zip(&self.twists).map(|((y, w), t)| w * y.1 * t.1).collect();
        let mut rest = 0.0;
        for (n, slope) in slopes.iter().enumerate() {
            let reach = self.corners.iter().map(|c| c[n].norm()).fold(0.0, f64::max) * self.twists[n].0.norm();
            rest += if reach < 1.0 { slope.norm() / self.twists[n].0.norm() * reach * reach / (1.0 - reach) } else { f64::INFINITY };
        }
        let linear = |corner: &Vec<C64>| corner.iter().zip(&slopes).map(|(d, s)| -(d * s).re).sum::<f64>();
        let least = self.corners.iter().map(linear).fold(f64::INFINITY, f64::min);
        if value(&best) + least - rest >= 1.0 + BEYOND {
            return Ok(None);
        }
        // along what moves phasors most
        let moves = |d: usize| -> f64 {
            let from = (0..self.corners.len()).filter(|bits| bits >> d & 1 == 0);
            from.flat_map(|bits| (0..slopes.len()).map(move |n| (bits, n)))
                .map(|(bits, n)| ((self.corners[bits | 1 << d][n] - self.corners[bits][n]) * slopes[n]).norm())
                .sum()
        };
        let count = self.corners.len().trailing_zeros() as usize;
        Ok((0..count).max_by(|a, b| moves(*a).total_cmp(&moves(*b))))
    }
}

/// Numbers whose products with the phasors of a quantity, real parts added up, and another number together are nowhere above a measure, and equal it in the middle; `None` of measures without.
fn weights(case: &LoadCase, measure: &Measure, (quantity, y): (Quantity, &[(C64, C64)]), speed_rpm: f64) -> Option<(Vec<C64>, f64)> {
    let excitation = &case.finder.system.excitation;
    let centres: Vec<C64> = y.iter().map(|y| y.0).collect();
    let extremes = case.finder.synthesiser.extremes(&centres);
    let at = |angle: f64| -> Vec<C64> { excitation.harmonics.iter().map(|h| turn(f64::from(*h) * angle)).collect() };
    let (high, low) = (at(extremes.angle_max), at(extremes.angle_min));
    let both = |of_high: f64, of_low: f64| high.iter().zip(&low).map(|(a, b)| a * of_high + b * of_low).collect::<Vec<_>>();
    let sum = |weights: &[C64]| centres.iter().zip(weights).map(|(y, w)| (y * w).re).sum::<f64>();
    match measure.over {
        Over::Synthesis => Some((both(0.5, -0.5), 0.0)),
        Over::Orders | Over::Order(_) => {
            let is_asked = |n: &usize| !matches!(measure.over, Over::Order(o) if o != excitation.orders[*n]);
            let n = (0..y.len()).filter(is_asked).max_by(|a, b| centres[*a].norm().total_cmp(&centres[*b].norm()))?;
            let mut own = vec![C64::default(); y.len()];
            own[n] = centres[n].conj() / centres[n].norm();
            own[n].is_finite().then_some((own, 0.0))
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
            // convex in maximum and minimum, rising with the one and falling with the other
            let rises = |u: &crate::crankshaft::Used| u.slopes.0 >= u.slopes.1.abs();
            let used = own.filter(rises).max_by(|a, b| a.value.total_cmp(&b.value))?;
            let weights = both(0.5 * (used.slopes.0 + used.slopes.1), 0.5 * (used.slopes.1 - used.slopes.0));
            let more = used.value - sum(&weights);
            Some((weights, more))
        }
        _ => None,
    }
}
