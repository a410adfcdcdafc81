//! The largest value of a function of one variable in an interval.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use std::cell::{Cell, RefCell};

/// The search stops within this share of the interval.
const TOLERANCE: f64 = 1e-5;
/// A search whose best point moves this often in a row to one end, and comes within this share of the interval, looks at that end itself.
const TOWARDS_AN_END: (i32, f64) = (2, 0.15);

/// What a search has met between two points.
#[derive(Debug, Clone, Copy)]
struct Met {
    interval: (f64, f64),
    /// Point and value, where one is known.
    best: Option<(f64, f64)>,
    /// The nearest points beside the best one.
    sides: (f64, f64),
    /// How often in a row the best point has moved: down, below zero, or up.
    moved: i32,
}

impl Met {
    fn nothing(a: f64, b: f64) -> Self {
        Self { interval: (a, b), best: None, sides: (a, b), moved: 0 }
    }

    fn put(&mut self, x: f64, value: f64) {
        let Some((at, largest)) = self.best else {
            self.best = Some((x, value));
            return;
        };
        let (out, moved) = if value > largest { (at, if x < at { self.moved.min(0) - 1 } else { self.moved.max(0) + 1 }) } else { (x, 0) };
        self.moved = moved;
        if value > largest {
            self.best = Some((x, value));
        }
        // the lower of the two points is a neighbour of the higher one
        if (out < x) || (out == x && x < at) {
            self.sides.0 = self.sides.0.max(out);
        } else {
            self.sides.1 = self.sides.1.min(out);
        }
    }

    /// The end that the search heads for.
    fn heads_for(&self) -> Option<f64> {
        let ((low, high), (at, _)) = (self.interval, self.best?);
        let near = TOWARDS_AN_END.1 * (high - low).abs();
        let end = if self.moved < 0 { low } else { high };
        (self.moved.abs() >= TOWARDS_AN_END.0 && (at - end).abs() <= near).then_some(end)
    }
}

/// A cost that ends a search: the target of argmin where none is given. An error would end it as well, but it keeps a backtrace where `RUST_BACKTRACE` is set, which takes a tenth of the time of searches.
const ENDS: f64 = f64::NEG_INFINITY;

struct Negated<'a, F, E> {
    f: RefCell<&'a mut F>,
    failure: &'a RefCell<Option<E>>,
    centre: f64,
    met: &'a Cell<Met>,
    /// Whether the search ends where it heads for an end.
    heeds_ends: bool,
}

impl<F: FnMut(f64) -> Result<f64, E>, E> CostFunction for Negated<'_, F, E> {
    type Param = f64;
    type Output = f64;
    fn cost(&self, offset: &f64) -> Result<f64, Error> {
        let x = self.centre + offset;
        match (self.f.borrow_mut())(x) {
            Ok(value) if value.is_finite() => {
                let mut met = self.met.get();
                met.put(x, value);
                self.met.set(met);
                Ok(if self.heeds_ends && met.heads_for().is_some() { ENDS } else { -value })
            }
            // argmin cannot go on from infinity; a function with a pole is expected to return an error there
            Ok(_) => Ok(0.0),
            Err(e) => {
                *self.failure.borrow_mut() = Some(e);
                Ok(ENDS)
            }
        }
    }
}

/// Brent's method \[Brent 1973\] for a maximum of `f` between `a` and `b`; returns the point and its value, never less than the best value
/// met. The search stops within about 1e-5 of the interval length, where the value of a smooth maximum is exact to about 1e-10 of its change
/// over the interval. Where it heads for an end, the value and the slope there decide.
///
/// # Errors
/// The first error of `f`.
pub fn maximise<E>(a: f64, b: f64, mut f: impl FnMut(f64) -> Result<f64, E>) -> Result<(f64, f64), E> {
    let tolerance = TOLERANCE * (b - a).abs();
    let met = brent((a, b), tolerance, true, &mut f)?;
    let best = met.best.unwrap_or((0.5 * (a + b), f64::NEG_INFINITY));
    let Some(end) = met.heads_for() else { return Ok(best) };
    let inside = end + if met.moved < 0 { tolerance } else { -tolerance };
    let (at_end, beside) = (f(end)?, f(inside)?);
    if at_end.is_finite() && at_end >= best.1 && at_end >= beside {
        return Ok((end, at_end));
    }
    let rest = if met.moved < 0 { (end, met.sides.1) } else { (met.sides.0, end) };
    let again = brent(rest, tolerance, false, &mut f)?.best;
    let all = [Some(best), Some((end, at_end)), Some((inside, beside)), again];
    Ok(all.into_iter().flatten().filter(|b| b.1.is_finite()).fold(best, |m, b| if b.1 > m.1 { b } else { m }))
}

fn brent<E>((a, b): (f64, f64), tolerance: f64, heeds_ends: bool, f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<Met, E> {
    let failure = RefCell::new(None);
    let met = Cell::new(Met::nothing(a, b));
    let centre = 0.5 * (a + b);
    let problem = Negated { f: RefCell::new(f), failure: &failure, centre, met: &met, heeds_ends };
    let solver = BrentOpt::new(a - centre, b - centre).set_tolerance(f64::EPSILON.sqrt(), tolerance);
    // What was met is kept on this side, an error of `f` in `failure`: argmin reports none.
    drop(Executor::new(problem, solver).configure(|s| s.max_iters(60)).timer(false).run());
    failure.into_inner().map_or_else(|| Ok(met.get()), Err)
}

/// The same from a bracket a < m < b whose middle is no lower than its ends, searched mostly to the right of `m` (or to the left). The
/// interval is cut so that the method's first point is `m`: a maximum at least as high as f(m) is certain.
///
/// # Errors
/// The first error of `f`.
pub fn maximise_bracket<E>((a, m, b): (f64, f64, f64), right: bool, f: &mut dyn FnMut(f64) -> Result<f64, E>) -> Result<(f64, f64), E> {
    if !right {
        let (at, value) = maximise_bracket((-b, -m, -a), true, &mut |x| f(-x))?;
        return Ok((-at, value));
    }
    let golden = 0.5 * (3.0 - 5f64.sqrt());
    let length = ((m - a) / golden).min((b - m) / (1.0 - golden));
    maximise(m - golden * length, m + (1.0 - golden) * length, f)
}
