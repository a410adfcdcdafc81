//! More speeds where a resonance is not wide for the distance of the speeds: beside it a top may lie between two speeds neither of which is higher than its neighbours, and several tops may lie in
//! neighbouring intervals. Poles tell where: farther from all of them the response is smooth, and its values show its tops.

use super::peak_search::PeakFinder;
use super::speeds::{SMOOTH, Speeds};
use crate::absorber::Mounted;
use crate::numerics::{C64, abs_sums};
use crate::response::{Quantity, ResponseError, Work};
use std::ops::Range;

/// Second differences of phasors may be this many times too small.
const DOUBT: f64 = 3.0;
/// Sharp resonances that bend a sum by less than this share hide nothing of it.
const HIDDEN: f64 = 1e-7;
/// A phasor may rise by this share between two speeds beside a sharp resonance.
pub(super) const RISE: f64 = 0.5;
/// What follows the squares of phasors may rise by this share.
pub(super) const RISE_OF_SQUARES: f64 = RISE * (2.0 + RISE);

/// How far a phasor is at most off the straight line between two known speeds: h² |y''|/8 with y'' from second differences at both.
pub(super) fn bend(rpm: &[f64], i: usize, y: impl Fn(usize) -> C64) -> f64 {
    let h = rpm[i + 1] - rpm[i];
    let second = |j: usize| {
        let (before, after) = (rpm[j] - rpm[j - 1], rpm[j + 1] - rpm[j]);
        // root of the square: the modulus that no number can overflow costs several times as much
        ((y(j + 1) - y(j)) / after - (y(j) - y(j - 1)) / before).norm_sqr().sqrt() * 2.0 / (before + after)
    };
    let inside = [i, i + 1].into_iter().filter(|j| *j > 0 && j + 1 < rpm.len());
    DOUBT * 0.125 * h * h * inside.map(second).fold(0.0, f64::max)
}

/// [`bend`] of every order of a sweep, interval after interval.
struct Bends<'s> {
    rpm: &'s [f64],
    sweep: &'s [C64],
    orders: usize,
    /// Magnitudes of second derivatives at two speeds, with the index of the latter.
    second: [Vec<f64>; 2],
    latter: Option<usize>,
}

impl<'s> Bends<'s> {
    fn new(rpm: &'s [f64], sweep: &'s [C64], orders: usize) -> Self {
        Self { rpm, sweep, orders, second: [const { Vec::new() }; 2], latter: None }
    }

    /// Puts the second derivatives at a speed last; zero at the ends of the range.
    fn push(&mut self, j: usize) {
        self.second.swap(0, 1);
        self.latter = Some(j);
        let (last, orders) = (self.rpm.len() - 1, self.orders);
        let own = &mut self.second[1];
        own.clear();
        own.resize(orders, 0.0);
        if j > 0 && j < last {
            let y = |j: usize| &self.sweep[j * orders..(j + 1) * orders];
            let distances = [self.rpm[j] - self.rpm[j - 1], self.rpm[j + 1] - self.rpm[j]];
            abs_sums::second_derivatives(y(j - 1), y(j), y(j + 1), distances, own);
        }
    }

    /// From index `i` to the next, by order.
    fn of(&mut self, i: usize) -> impl Iterator<Item = f64> {
        if self.latter != Some(i) {
            self.push(i);
        }
        self.push(i + 1);
        let h = self.rpm[i + 1] - self.rpm[i];
        let [low, high] = &self.second;
        low.iter().zip(high).map(move |(a, b)| DOUBT * 0.125 * h * h * a.max(*b))
    }
}

/// Speeds and phasors, some of which are known.
pub(super) struct Resolved {
    pub speeds: Speeds,
    pub sweep: Vec<C64>,
    /// Index of each speed among those that were known.
    pub known: Vec<Option<usize>>,
}

impl PeakFinder<'_> {
    /// Speeds and phasors with more of them where a sharp resonance may hide a peak that `can_matter`: by an index of a speed and how far the phasors of the sum are off straight lines up to the next,
    /// together. Half the range of a sum is convex in its phasors: between two speeds it is no higher than at the higher one by more than that. `smooth`: see [`SMOOTH`]; `is_quick`: whether `can_matter` costs less than a look at the phasors; `widest`: half the range at an index, or more. Nothing where no more are needed.
    pub(super) fn resolved(
        &self,
        design: &[Mounted],
        quantity: Quantity,
        (speeds, sweep): (&Speeds, &[C64]),
        (smooth, is_quick): (f64, bool),
        (widest, can_matter): (impl Fn(usize) -> f64, impl Fn(usize, f64) -> bool),
        work: &mut Work,
    ) -> Result<Option<Resolved>, ResponseError> {
        if speeds.sharp.is_empty() {
            return Ok(None);
        }
        let orders = self.system.orders();
        let mut of_all = Bends::new(&speeds.rpm, sweep, orders);
        let needed = |i: usize| {
            if speeds.sharp_near(i, smooth).next().is_none() {
                return 1;
            }
            // most intervals need no look at their phasors
            if is_quick && !can_matter(i, RISE * widest(i).max(widest(i + 1))) {
                return 1;
            }
            let bends: Vec<f64> = of_all.of(i).collect();
            if !can_matter(i, bends.iter().sum()) {
                return 1;
            }
            let size = abs_sums::sum(&sweep[i * orders..(i + 1) * orders]);
            let near = orders_near(speeds, i, smooth).len() as f64;
            let matters = |n: &usize| bends[*n] * near > HIDDEN * size;
            speeds.parts_for(i, smooth, speeds.sharp_near(i, smooth).filter(|s| matters(&s.order)))
        };
        let parts: Vec<usize> = (0..speeds.rpm.len().saturating_sub(1)).map(needed).collect();
        if parts.iter().all(|p| *p < 2) {
            return Ok(None);
        }
        let (finer, more) = speeds.cut(&parts);
        let between = self.direct.at_each(design, &[quantity], &more, work)?.swap_remove(0);
        let indices: Vec<Option<usize>> = (0..speeds.rpm.len()).map(Some).collect();
        let known = laid_in(&parts, &indices, &vec![None; more.len()], 1);
        Ok(Some(Resolved { speeds: finer, sweep: laid_in(&parts, sweep, &between, orders), known }))
    }
}

/// Speeds and values with more of them where a sharp resonance may hide one that reaches `wanted`. `rise`: by how much one of the orders that count may raise the value between an index of a speed and the
/// next; `most`: what all of them together may raise a value to, or more. Nothing where no more are needed.
///
/// # Errors
/// Those of `value_at`.
pub(super) fn resolved_values(
    (speeds, values): (&Speeds, &[f64]),
    wanted: f64,
    (orders, most, rise): (Range<usize>, impl Fn(f64) -> f64, impl Fn(usize, usize) -> f64),
    value_at: impl FnMut(f64) -> Result<f64, ResponseError>,
) -> Result<Option<(Speeds, Vec<f64>)>, ResponseError> {
    if speeds.sharp.is_empty() {
        return Ok(None);
    }
    let needed = |i: usize| {
        let higher = values[i].max(values[i + 1]);
        if most(higher) < wanted {
            return 1;
        }
        let near: Vec<(usize, f64)> =
            orders_near(speeds, i, SMOOTH).into_iter().filter(|n| orders.contains(n)).map(|n| (n, rise(i, n))).collect();
        if near.is_empty() || higher + near.iter().map(|n| n.1).sum::<f64>() < wanted {
            return 1;
        }
        let matters = |order: usize| near.iter().any(|(n, rise)| *n == order && *rise > HIDDEN * wanted);
        speeds.parts_for(i, SMOOTH, speeds.sharp_near(i, SMOOTH).filter(|s| matters(s.order)))
    };
    let parts: Vec<usize> = (0..values.len().saturating_sub(1)).map(needed).collect();
    if parts.iter().all(|p| *p < 2) {
        return Ok(None);
    }
    let (finer, more) = speeds.cut(&parts);
    let between = more.into_iter().map(value_at).collect::<Result<Vec<f64>, ResponseError>>()?;
    Ok(Some((finer, laid_in(&parts, values, &between, 1))))
}

/// Orders that meet a sharp resonance near the speeds from an index to the next, each once.
fn orders_near(speeds: &Speeds, i: usize, smooth: f64) -> Vec<usize> {
    let mut near: Vec<usize> = speeds.sharp_near(i, smooth).map(|s| s.order).collect();
    near.sort_unstable();
    near.dedup();
    near
}

/// Values with those of the speeds between laid in; `each`: of one speed.
fn laid_in<T: Copy>(parts: &[usize], known: &[T], between: &[T], each: usize) -> Vec<T> {
    let mut all = Vec::with_capacity(known.len() + between.len());
    let mut rest = between;
    for (i, own) in known.chunks(each).enumerate() {
        all.extend_from_slice(own);
        let (now, later) = rest.split_at(parts.get(i).map_or(0, |p| p.saturating_sub(1)) * each);
        all.extend_from_slice(now);
        rest = later;
    }
    all
}
