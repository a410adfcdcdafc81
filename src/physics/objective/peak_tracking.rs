//! A branch of extremes over speed: one local maximum and one local minimum in the cycle, followed from speed to speed. Its value is smooth where the torque is, so that few
//! direct solutions find its top.

use super::local_maxima;
use super::peak::Place;
use super::peak_search::PeakFinder;
use super::point_metric::PointMetric;
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::numerics::C64;
use crate::numerics::interpolation::Interpolation;
use crate::numerics::maximise::maximise;
use crate::numerics::synthesis::Extremes;
use crate::response::{Quantity, ResponseError, Work};
use std::collections::VecDeque;

/// From one direct solution to the next, shares of the distance between known speeds that end the search. The slope at a point is off by the product of its distances to the others: two near ones are
/// needed before a step says how little is left.
const LAST: [f64; 2] = [1e-7, 3e-6];
/// The same where there were [`MOST`] of them.
const ENOUGH: f64 = 1e-5;
/// Values closer than this are level.
const LEVEL: f64 = 1e-13;
/// Steps, at most.
const MOST: usize = 8;
/// A maximum closer to an end of the search than this share of its length is none.
const EDGE: f64 = 1e-3;
/// Known speeds that a branch is followed over, on one side.
const FARTHEST: usize = 8;
/// The slope of a parabola is off by no more than this share of what it differs from that of its chord.
const DOUBT: f64 = 1.0;
/// A pair higher than that of the branch by this share is another one.
const ANOTHER: f64 = 1e-12;

/// A branch at a speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnBranch {
    pub speed_rpm: f64,
    pub value: f64,
    pub extremes: Extremes,
}

/// A peak: its speed and place, and the pairs of extremes there.
pub(super) type Peaked = (f64, Place, Vec<Extremes>);

/// Known speeds that a top is looked for between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Beside {
    Both,
    Before,
    After,
}

/// Where a branch goes from a speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Away {
    /// It falls, or the range ends.
    Falls,
    Rises,
    Unclear,
}

/// A branch at neighbouring known speeds, followed from one to the next and computed once at each.
struct Followed<'b, 'f, 'a> {
    branches: &'b Branches<'f, 'a>,
    /// Index of the first of them.
    first: usize,
    known: VecDeque<OnBranch>,
}

impl Followed<'_, '_, '_> {
    /// The branch at a known speed.
    fn at(&mut self, i: usize) -> OnBranch {
        while i < self.first {
            self.first -= 1;
            self.known.push_front(self.branches.known(self.first, &self.known[0].extremes));
        }
        while i >= self.first + self.known.len() {
            let last = self.known.len() - 1;
            self.known.push_back(self.branches.known(self.first + last + 1, &self.known[last].extremes));
        }
        self.known[i - self.first]
    }

    /// The branch at the next known speed on a side, where there is one.
    fn beside(&mut self, i: usize, side: usize) -> Option<OnBranch> {
        let next = i.wrapping_add(side);
        (next < self.branches.speeds.rpm.len()).then(|| self.at(next))
    }

    /// The known speed, not far from `i`, at which the branch is higher than at its neighbours; nothing where it rises further.
    fn climbed(&mut self, i: usize) -> Option<usize> {
        let mut here = (i, self.at(i).value);
        for side in [1, usize::MAX] {
            while let Some(there) = self.beside(here.0, side).filter(|there| there.value > here.1) {
                here = (here.0.wrapping_add(side), there.value);
                if here.0.abs_diff(i) > FARTHEST {
                    return None;
                }
            }
            if here.0 != i {
                break;
            }
        }
        Some(here.0)
    }

    /// Whether a branch that is highest at a known speed may reach `wanted` between its neighbours.
    fn may_reach(&mut self, i: usize, wanted: f64) -> bool {
        match (self.beside(i, usize::MAX), self.at(i), self.beside(i, 1)) {
            (Some(left), top, Some(right)) if !self.branches.speeds.kink[i] => {
                local_maxima::may_reach([left, top, right].map(|p| (p.speed_rpm, p.value)), wanted)
            }
            _ => true,
        }
    }

    /// Where the branch goes from a known speed, an end of the range or a kink of the torque, on one side of it: by the slope there of the parabola through it and two neighbours, where
    /// that is larger than what it may be wrong by.
    fn away(&mut self, i: usize, side: usize) -> Away {
        let Speeds { rpm, kink, .. } = self.branches.speeds;
        let (next, after) = (i.wrapping_add(side), i.wrapping_add(side).wrapping_add(side));
        if next >= rpm.len() {
            return Away::Falls;
        }
        if after >= rpm.len() || kink[next] {
            return Away::Unclear;
        }
        let (chord, slope) = slopes(&[i, next, after].map(|i| self.at(i)));
        let doubt = DOUBT * (slope - chord).abs();
        if slope > doubt {
            Away::Falls
        } else if slope < -doubt {
            Away::Rises
        } else {
            Away::Unclear
        }
    }
}

/// What branches are followed in.
pub(super) struct Branches<'f, 'a> {
    pub finder: &'f PeakFinder<'a>,
    pub design: &'f [Mounted],
    pub quantity: Quantity,
    pub metric: PointMetric<'f>,
    pub speeds: &'f Speeds,
    /// Phasors at every known speed.
    pub sweep: &'f [C64],
}

impl<'f, 'a> Branches<'f, 'a> {
    fn phasors(&self, i: usize) -> &[C64] {
        let orders = self.finder.system.orders();
        &self.sweep[i * orders..(i + 1) * orders]
    }

    fn of(&self, speed_rpm: f64, extremes: Extremes, y: &[C64]) -> OnBranch {
        OnBranch { speed_rpm, value: self.metric.value(speed_rpm, &extremes, y), extremes }
    }

    /// The branch of `from` at a known speed.
    fn known(&self, i: usize, from: &Extremes) -> OnBranch {
        let y = self.phasors(i);
        self.of(self.speeds.rpm[i], self.finder.synthesiser.branch(y, from), y)
    }

    /// The branch of `from` at a known speed and its neighbours.
    fn followed(&self, i: usize, from: &Extremes) -> Followed<'_, 'f, 'a> {
        Followed { branches: self, first: i, known: VecDeque::from([self.known(i, from)]) }
    }

    /// The branch of `from` at any speed, and the phasors there.
    fn at(&self, speed_rpm: f64, from: &Extremes, y: &mut [C64], work: &mut Work) -> Result<OnBranch, ResponseError> {
        self.finder.direct.at(self.design, self.quantity, speed_rpm, y, work)?;
        Ok(self.of(speed_rpm, self.finder.synthesiser.branch(y, from), y))
    }

    /// The peak of the largest branch beside a known speed: its speed and place, the pairs of extremes within a share there, and the phasors; nothing where branches are neither smooth nor held by
    /// that speed, or another one is higher.
    pub fn peak(&self, i: usize, share: f64, y: &mut [C64], work: &mut Work) -> Result<Option<Peaked>, ResponseError> {
        work.syntheses += 1;
        let from = self.finder.synthesiser.extremes(self.phasors(i));
        // what is known to a millionth may have led to a neighbour
        let mut branch = self.followed(i, &from);
        let Some(i) = branch.climbed(i) else { return Ok(None) };
        let Some((top, place)) = self.local(i, &mut branch, y, work)? else { return Ok(None) };
        work.syntheses += 1;
        let pairs = self.finder.synthesiser.pairs(y, share);
        let is_own = self.metric.value(top.speed_rpm, &pairs[0], y) <= top.value * (1.0 + ANOTHER);
        Ok(is_own.then_some((top.speed_rpm, place, pairs)))
    }

    /// Value of the largest branch at a known speed.
    pub fn largest(&self, i: usize, work: &mut Work) -> f64 {
        work.syntheses += 1;
        let y = self.phasors(i);
        self.metric.value(self.speeds.rpm[i], &self.finder.synthesiser.extremes(y), y)
    }

    /// The top of a branch beside a known speed that is higher than its neighbours.
    fn local(&self, i: usize, branch: &mut Followed, y: &mut [C64], work: &mut Work) -> Result<Option<(OnBranch, Place)>, ResponseError> {
        if self.speeds.is_narrow(i) {
            return Ok(None);
        }
        let is_end = i == 0 || i + 1 == self.speeds.rpm.len();
        let beside = if is_end || self.speeds.kink[i] {
            match [usize::MAX, 1].map(|side| branch.away(i, side)) {
                [Away::Falls, Away::Falls] => {
                    let top = self.at(self.speeds.rpm[i], &branch.at(i).extremes, y, work)?;
                    return Ok(Some((top, if is_end { Place::End } else { Place::Interior })));
                }
                [Away::Falls, Away::Rises] => Beside::After,
                [Away::Rises, Away::Falls] => Beside::Before,
                _ => return Ok(None),
            }
        } else {
            Beside::Both
        };
        Ok(self.top((i, branch), beside, y, work)?.map(|top| (top, Place::Interior)))
    }

    /// The peak of another branch than that of the one at `(speed, place)` beside a known speed, and the phasors there; nothing where it has none there that may reach `wanted`.
    pub fn other(
        &self,
        i: usize,
        start: &Extremes,
        ((speed_rpm, place), wanted): ((f64, Place), f64),
        y: &mut [C64],
        work: &mut Work,
    ) -> Result<Option<(OnBranch, Place)>, ResponseError> {
        if !self.speeds.is_narrow(i) {
            let mut branch = self.followed(i, start);
            let Some(near) = branch.climbed(i) else { return Ok(None) };
            if !branch.may_reach(near, wanted) {
                return Ok(None);
            }
            if let Some(peak) = self.local(near, &mut branch, y, work)? {
                return Ok(Some(peak));
            }
        }
        let top = self.searched_top(i, start, y, work)?;
        // a branch may be held by the same end of the range
        if place == Place::End {
            let end = self.at(speed_rpm, start, y, work)?;
            if end.value >= top.1 {
                return Ok(Some((end, Place::End)));
            }
        }
        let (low, high) = self.reach(i);
        let margin = EDGE * (high - low);
        // what rises beyond the neighbours is no maximum here
        if !(low + margin..=high - margin).contains(&top.0) {
            return Ok(None);
        }
        Ok(Some((self.at(top.0, start, y, work)?, Place::Interior)))
    }

    /// Two known speeds to either side.
    fn reach(&self, i: usize) -> (f64, f64) {
        let rpm = &self.speeds.rpm;
        (rpm[i.saturating_sub(2)], rpm[(i + 2).min(rpm.len() - 1)])
    }

    /// Speed and value of the largest value of a branch within two known speeds.
    pub(super) fn searched_top(&self, i: usize, from: &Extremes, y: &mut [C64], work: &mut Work) -> Result<(f64, f64), ResponseError> {
        let (low, high) = self.reach(i);
        let mut value = |speed: f64| self.at(speed, from, y, work).map(|p| p.value);
        if low < high { maximise(low, high, value) } else { Ok((low, value(low)?)) }
    }

    /// The top of a branch near a known speed, within `beside` (known speeds round it, or on one side), and the phasors there: the lowest place of the polynomial of 1/v² through all that
    /// is known, a parabola for a single resonance, which every direct solution makes more exact; nothing where that does not settle.
    fn top(
        &self,
        (i, branch): (usize, &mut Followed),
        beside: Beside,
        y: &mut [C64],
        work: &mut Work,
    ) -> Result<Option<OnBranch>, ResponseError> {
        let (rpm, middle) = (&self.speeds.rpm, branch.at(i));
        let sides: &[usize] = match beside {
            Beside::Both => &[1, usize::MAX],
            Beside::After => &[1],
            Beside::Before => &[usize::MAX],
        };
        let ends = [usize::MAX, 1].map(|side| if sides.contains(&side) { rpm[i.wrapping_add(side)] } else { rpm[i] });
        let distance = (ends[1] - ends[0]) / sides.len() as f64;
        let mut through = Interpolation::new(middle.speed_rpm, distance);
        through.push(middle.speed_rpm, middle.value.powi(-2));
        for side in sides {
            let mut here = i;
            for _ in 0..4 / sides.len() {
                // no further than a kink
                if here != i && self.speeds.kink[here] {
                    break;
                }
                let Some(there) = branch.beside(here, *side) else { break };
                if here == i && there.value > middle.value {
                    return Ok(None);
                }
                through.push(there.speed_rpm, there.value.powi(-2));
                here = here.wrapping_add(*side);
            }
        }
        let mut best = middle;
        y.copy_from_slice(self.phasors(i));
        let (mut other, mut last, mut step) = (y.to_vec(), middle.speed_rpm, f64::INFINITY);
        for solution in 0..MOST {
            let Some(speed) = through.lowest(best.speed_rpm).filter(|s| ends[0] < *s && *s < ends[1]) else { return Ok(None) };
            step = (speed - last).abs() / distance;
            if speed == last {
                break;
            }
            let there = self.at(speed, &best.extremes, &mut other, work)?;
            work.syntheses += 1;
            through.push(speed, there.value.powi(-2));
            if there.value >= best.value * (1.0 - LEVEL) {
                y.copy_from_slice(&other);
                best = there;
            }
            last = speed;
            if step <= LAST[usize::from(solution > 1)] {
                break;
            }
        }
        Ok((step <= ENOUGH).then_some(best))
    }
}

/// Growth of 1/v² away from the first of three points on one side of it: along the chord to the next, and of the parabola through all.
fn slopes(points: &[OnBranch; 3]) -> (f64, f64) {
    let [(x0, q0), (x1, q1), (x2, q2)] = points.map(|p| ((p.speed_rpm - points[0].speed_rpm).abs(), p.value.powi(-2)));
    let (s1, s2) = ((q1 - q0) / (x1 - x0), (q2 - q1) / (x2 - x1));
    (s1, s1 - (s2 - s1) / (x2 - x0) * (x1 - x0))
}
