//! Bounded search without derivatives: Nelder and Mead's simplex \[Nelder & Mead 1965\] by argmin, from one start.

use super::Problem;
use super::problem::UNBOUNDED_COST;
use crate::response::Work;
use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;
use std::cell::RefCell;
use std::convert::Infallible;

/// Edge of the first simplex in coordinates: about a factor of 1.3 in value.
const EDGE: f64 = 0.25;
/// The simplex has done its part when its costs agree to this share; the minimax method finishes.
const AGREEMENT: f64 = 1e-4;

struct Cost<'a, 'b> {
    problem: &'a Problem<'b>,
    bounds: &'a [(f64, f64)],
    state: RefCell<State<'a>>,
    most: u64,
}

struct State<'a> {
    work: &'a mut Work,
    spent: u64,
    best: (Vec<f64>, f64),
}

/// Mirrors a coordinate at its bounds until it lies between them: the simplex sees a continuous function everywhere and stays in the box.
fn fold(x: f64, (low, high): (f64, f64)) -> f64 {
    let width = high - low;
    if width <= 0.0 {
        return low;
    }
    let t = (x - low).rem_euclid(2.0 * width);
    low + if t > width { 2.0 * width - t } else { t }
}

impl CostFunction for Cost<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        let mut state = self.state.borrow_mut();
        if state.spent >= self.most {
            return Err(Error::msg("evaluations spent"));
        }
        state.spent += 1;
        let w: Vec<f64> = x.iter().zip(self.bounds).map(|(x, b)| fold(*x, *b)).collect();
        let cost = self.problem.cost(&w, state.work);
        // argmin's simplex fails on a cost that is not finite
        let cost = if cost.is_finite() { cost } else { UNBOUNDED_COST };
        if cost < state.best.1 {
            state.best = (w, cost);
        }
        Ok(cost)
    }
}

/// Best point found from `start` within `most` evaluations, and its cost.
pub fn search(problem: &Problem, start: &[f64], most: u64, work: &mut Work) -> (Vec<f64>, f64) {
    let found = problem.remembered(&("simplex", start, most), work, |work| Ok::<_, Infallible>(from(problem, start, most, work)));
    let Ok(best) = found;
    best
}

fn from(problem: &Problem, start: &[f64], most: u64, work: &mut Work) -> (Vec<f64>, f64) {
    let bounds = problem.space.bounds();
    if start.is_empty() {
        return (Vec::new(), problem.cost(start, work));
    }
    let mut simplex = vec![start.to_vec()];
    for (i, (low, high)) in bounds.iter().enumerate() {
        let edge = EDGE.min(0.25 * (high - low));
        let mut corner = start.to_vec();
        corner[i] += if start[i] + edge <= *high { edge } else { -edge };
        simplex.push(corner);
    }
    let state = RefCell::new(State { work, spent: 0, best: (start.to_vec(), f64::INFINITY) });
    let cost = Cost { problem, bounds: &bounds, state, most };
    let scale = problem.cost(start, &mut Work::default());
    // a negative tolerance cannot be: scale is a peak
    if let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(AGREEMENT * scale.abs()) {
        // the executor owns the cost and drops it: the best point is kept on this side
        let shared = std::rc::Rc::new(cost);
        let _stopped = Executor::new(Shared(shared.clone()), solver).configure(|s| s.max_iters(most)).timer(false).run();
        return shared.state.borrow().best.clone();
    }
    (start.to_vec(), scale)
}

struct Shared<'a, 'b>(std::rc::Rc<Cost<'a, 'b>>);

impl CostFunction for Shared<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        self.0.cost(x)
    }
}
