//! The largest value of a function of one variable in an interval.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use std::cell::{Cell, RefCell};

struct Negated<'a, F, E> {
    f: RefCell<&'a mut F>,
    failure: &'a RefCell<Option<E>>,
    centre: f64,
    best: &'a Cell<(f64, f64)>,
}

impl<F: FnMut(f64) -> Result<f64, E>, E> CostFunction for Negated<'_, F, E> {
    type Param = f64;
    type Output = f64;
    fn cost(&self, offset: &f64) -> Result<f64, Error> {
        let x = self.centre + offset;
        match (self.f.borrow_mut())(x) {
            Ok(value) if value.is_finite() => {
                if value > self.best.get().1 {
                    self.best.set((x, value));
                }
                Ok(-value)
            }
            // argmin cannot go on from infinity; a function with a pole is expected to return an error there
            Ok(_) => Ok(0.0),
            Err(e) => {
                *self.failure.borrow_mut() = Some(e);
                Err(Error::msg("the function failed"))
            }
        }
    }
}

/// Brent's method \[Brent 1973\] for a maximum of `f` between `a` and `b`; returns the point and its value, never less than the best value
/// met. The search stops within about 1e-5 of the interval length, where the value of a smooth maximum is exact to about 1e-10 of its change
/// over the interval.
///
/// # Errors
/// The first error of `f`.
pub fn maximise<E>(a: f64, b: f64, mut f: impl FnMut(f64) -> Result<f64, E>) -> Result<(f64, f64), E> {
    let failure = RefCell::new(None);
    let best = Cell::new((0.5 * (a + b), f64::NEG_INFINITY));
    let centre = 0.5 * (a + b);
    let problem = Negated { f: RefCell::new(&mut f), failure: &failure, centre, best: &best };
    let tolerance = 1e-5 * (b - a).abs();
    let solver = BrentOpt::new(a - centre, b - centre).set_tolerance(f64::EPSILON.sqrt(), tolerance);
    // The only error argmin can report here is one of `f`, kept in `failure`; the best point is kept on this side too.
    drop(Executor::new(problem, solver).configure(|s| s.max_iters(60)).timer(false).run());
    failure.into_inner().map_or_else(|| Ok(best.get()), Err)
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
