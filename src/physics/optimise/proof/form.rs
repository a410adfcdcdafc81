//! Real lower bounds that are linear over a box, and what follows from several of them together.

use crate::numerics::C64;
use crate::numerics::taylor::{MOST, ROUNDING, Taylor};

/// Forms that are combined, at most.
const COMBINED: usize = 10;

/// Share of its size that an addend of a sum may lose: of a hundred addends some units in the last place each.
const ADDED: f64 = 32.0 * ROUNDING;

/// A measure over what it must not reach is at least value + sum of slope_d x_d, for every x_d from -1 to 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Form {
    /// In the middle, less all that is not linear.
    pub value: f64,
    /// What the measure is in the middle, but for rounding.
    pub middle: f64,
    pub slopes: [f64; MOST],
    /// How much each variable moves the phasors behind it.
    pub spread: [f64; MOST],
    /// Whether it is of an objective.
    pub is_objective: bool,
}

impl Form {
    /// The real part of a sum of phasors times numbers.
    pub(super) fn of_sum(terms: impl Iterator<Item = (Taylor, C64)>) -> Self {
        let mut form = Self::default();
        for (y, by) in terms {
            let along = |z: C64| z.re * by.re - z.im * by.im;
            let size = by.norm();
            form.middle += along(y.centre);
            form.value -= size * (y.rest + ADDED * y.centre.norm());
            for (d, g) in y.slopes.iter().enumerate() {
                form.slopes[d] += along(*g);
                form.spread[d] += size * g.norm();
            }
        }
        form.value += form.middle;
        form
    }

    /// A number of which nothing is known but what it is in the middle.
    pub(super) fn unknown(middle: C64) -> Self {
        Self { value: f64::NEG_INFINITY, middle: middle.re, ..Self::default() }
    }

    /// The sum.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        sum.value += other.value;
        sum.middle += other.middle;
        sum.slopes.iter_mut().zip(&other.slopes).for_each(|(a, b)| *a += b);
        sum.spread.iter_mut().zip(&other.spread).for_each(|(a, b)| *a += b);
        sum
    }

    /// The imaginary part of a sum of products with the conjugates of others, times numbers.
    pub(super) fn of_products(terms: impl Iterator<Item = (Taylor, Taylor, f64)>) -> Self {
        let mut form = Self::default();
        for (a, b, by) in terms {
            let (reach_a, reach_b) = (a.reach(), b.reach());
            form.middle += by * (a.centre * b.centre.conj()).im;
            let linear = (reach_a - a.rest) * (reach_b - b.rest);
            form.value -= by
                * (linear
                    + ADDED * a.centre.norm() * b.centre.norm()
                    + (a.centre.norm() + reach_a) * b.rest
                    + (b.centre.norm() + reach_b) * a.rest);
            for d in 0..MOST {
                let slope = a.slopes[d] * b.centre.conj() + a.centre * b.slopes[d].conj();
                form.slopes[d] += by * slope.im;
                form.spread[d] += by * slope.norm();
            }
        }
        form.value += form.middle;
        form
    }

    /// The same times a positive number.
    pub(super) fn times(mut self, factor: f64) -> Self {
        self.value *= factor;
        self.middle *= factor;
        self.slopes.iter_mut().chain(&mut self.spread).for_each(|s| *s *= factor);
        self
    }

    /// The least it is over the box.
    pub(super) fn least(&self) -> f64 {
        self.value - self.slopes.iter().map(|s| s.abs()).sum::<f64>()
    }

    /// The variable along which a cut raises the least most: that with the steepest slope, or, where more is lost by what is not linear, that which moves phasors most; `None` where none does.
    pub(super) fn loses_most_along(&self) -> Option<usize> {
        let linear: f64 = self.slopes.iter().map(|s| s.abs()).sum();
        let by = if linear > self.middle - self.value { self.slopes.map(f64::abs) } else { self.spread };
        let most = (0..MOST).fold(0, |m, d| if by[d] > by[m] { d } else { m });
        (by[most] > 0.0).then_some(most)
    }

    /// A share of the way to another one: as good a bound of the larger of the two.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let mut mixed = Self { value: mix(self.value, other.value), middle: mix(self.middle, other.middle), ..*self };
        mixed.slopes.iter_mut().zip(&other.slopes).for_each(|(a, b)| *a = mix(*a, *b));
        mixed.is_objective &= other.is_objective;
        mixed
    }
}

/// The largest lower bound over the box that convex combinations of forms were found to give: their maximum is nowhere below it.
pub(super) fn least_of_largest(forms: &mut [Form]) -> f64 {
    combined(forms, |_, _| {})
}

/// The same with the share of each form in the combination, those without a share left out. The largest in the middle come first, as they stand where they are level.
pub(super) fn combination(forms: &mut [Form]) -> (f64, Vec<(usize, f64)>) {
    let mut shares: Vec<(usize, f64)> = Vec::new();
    let least = combined(forms, |i, share| {
        shares.iter_mut().for_each(|s| s.1 *= 1.0 - share);
        match shares.iter_mut().find(|s| s.0 == i) {
            Some(own) => own.1 += share,
            None => shares.push((i, share)),
        }
    });
    (least, shares)
}

/// Tells of each step to a better combination: the form, and how far the way to it.
fn combined(forms: &mut [Form], mut step: impl FnMut(usize, f64)) -> f64 {
    forms.sort_by(|a, b| b.middle.total_cmp(&a.middle));
    let forms = &forms[..forms.len().min(COMBINED)];
    let first = (0..forms.len()).reduce(|m, i| if forms[i].least() > forms[m].least() { i } else { m });
    let Some(first) = first else { return f64::NEG_INFINITY };
    let mut best = forms[first];
    step(first, 1.0);
    for _ in 0..=MOST {
        let before = best.least();
        let (from, mut taken) = (best, None);
        for (i, other) in forms.iter().enumerate() {
            // the least is concave in the share, with kinks where a slope vanishes
            for d in 0..MOST {
                let change = other.slopes[d] - from.slopes[d];
                let share = -from.slopes[d] / change;
                if change != 0.0 && (0.0..1.0).contains(&share) {
                    let mixed = from.towards(other, share);
                    if mixed.least() > best.least() {
                        (best, taken) = (mixed, Some((i, share)));
                    }
                }
            }
        }
        taken.into_iter().for_each(|(i, share)| step(i, share));
        if best.least() <= before {
            break;
        }
    }
    best.least()
}
