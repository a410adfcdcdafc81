//! What limits and bounds cost an optimum, from its multipliers.

use super::minimax::lines;
use super::{Outcome, Role, Space};
use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, ZeroConeT};
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus};
use nalgebra::{DMatrix, DVector};

/// A parameter is on a bound where it is nearer than this share of the upper one.
const ON_BOUND: f64 = 1e-9;
/// Multipliers below this are what an interior-point method leaves of zero.
const ROUNDING: f64 = 1e-9;
/// A row is active this near to its objective or limit, as a share of it.
const ACTIVE: f64 = 1e-7;
/// Singular values of the active gradients below this share of the largest are zero.
const DEPENDENT: f64 = 1e-9;

/// A parameter that lies on a bound.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct OnBound {
    /// Index of the absorber.
    pub absorber: usize,
    /// Index of the parameter in its declaration.
    pub parameter: usize,
    /// The bound.
    pub bound: f64,
    /// Whether it is the upper one.
    pub upper: bool,
    /// Per cent of the objective that one per cent further would bring; nothing for a bound of zero.
    pub price: Option<f64>,
}

/// What an active condition is of.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Of {
    Objective,
    Limit(usize),
    /// A coordinate, and whether it is its upper bound.
    Bound(usize, bool),
}

/// The conditions that are active at an optimum, with their multipliers.
struct Active {
    of: Vec<Of>,
    /// A column for each: its gradient, and which term of the objective it is of.
    columns: DMatrix<f64>,
    multipliers: DVector<f64>,
}

impl Active {
    fn new(space: &Space, outcome: &Outcome) -> Self {
        let (n, rows) = (outcome.point.len(), &outcome.rows);
        let (mut of, mut columns, mut multipliers) = (Vec::new(), Vec::new(), Vec::new());
        let mut put = |what: Of, (gradient, term): (Vec<f64>, Option<usize>), multiplier: f64| {
            let terms = (0..rows.weights().len()).map(|t| f64::from(term == Some(t)));
            of.push(what);
            columns.push(DVector::from_iterator(n + rows.weights().len(), gradient.into_iter().chain(terms)));
            multipliers.push(multiplier);
        };
        let unit = rows.objective();
        for ((row, line), multiplier) in rows.rows.iter().zip(lines(rows, unit)).zip(&outcome.multipliers) {
            let (what, is_active) = match row.role {
                Role::Limit(limit) => (Of::Limit(limit), line.value > -ACTIVE),
                Role::Objective(_) => (Of::Objective, rows.is_largest(row, ACTIVE)),
            };
            if is_active || *multiplier > ROUNDING {
                put(what, (line.gradient, line.objective), *multiplier);
            }
        }
        for (i, ((w, (low, high)), own)) in outcome.point.iter().zip(space.bounds()).zip(&outcome.bounds).enumerate() {
            for (bound, multiplier, upper) in [(low, own[0], false), (high, own[1], true)] {
                if (w - bound).abs() <= ON_BOUND * high.abs().max(1.0) || multiplier > ROUNDING {
                    let gradient = (0..n).map(|c| if c == i { if upper { 1.0 } else { -1.0 } } else { 0.0 }).collect();
                    put(Of::Bound(i, upper), (gradient, None), multiplier);
                }
            }
        }
        let rows = n + outcome.rows.weights().len();
        let columns = if columns.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(&columns) };
        Self { of, columns, multipliers: DVector::from_vec(multipliers) }
    }

    /// Whether the conditions of first order have other multipliers, too: their columns depend on each other.
    fn is_ambiguous(&self) -> bool {
        // of an objective of zero nothing is active
        if self.of.is_empty() {
            return false;
        }
        let values = self.columns.singular_values();
        let least = DEPENDENT * values.iter().copied().fold(0.0, f64::max);
        values.iter().filter(|v| **v > least).count() < self.of.len()
    }

    /// The least multiplier of a condition among all that meet those of first order; `None` where the solver did not succeed.
    fn least(&self, of: Of) -> Option<f64> {
        let (equations, unknowns) = self.columns.shape();
        let cost: Vec<f64> = self.of.iter().map(|o| f64::from(*o == of)).collect();
        let (mut row, mut column, mut value) = (Vec::new(), Vec::new(), Vec::new());
        for c in 0..unknowns {
            for r in 0..equations {
                row.push(r);
                column.push(c);
                value.push(self.columns[(r, c)]);
            }
            row.push(equations + c);
            column.push(c);
            value.push(-1.0);
        }
        let a = CscMatrix::new_from_triplets(equations + unknowns, unknowns, row, column, value);
        let sums = &self.columns * &self.multipliers;
        let b: Vec<f64> = sums.iter().copied().chain(std::iter::repeat_n(0.0, unknowns)).collect();
        let exact = 1e-12;
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_threads(1u32)
            .tol_gap_abs(exact)
            .tol_gap_rel(exact)
            .tol_feas(exact)
            .build()
            .ok()?;
        let cones = [ZeroConeT(equations), NonnegativeConeT(unknowns)];
        let mut solver = DefaultSolver::new(&CscMatrix::zeros((unknowns, unknowns)), &cost, &a, &b, &cones, settings).ok()?;
        solver.solve();
        let is_solved = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        is_solved.then(|| solver.solution.x.iter().zip(&cost).map(|(x, c)| x * c).sum::<f64>().max(0.0))
    }
}

/// What one per cent more of each limit brings, in per cent of the objective, and the bounds on which parameters lie with the same: each by itself. Where several hold the optimum at once, as a limit on inertia and the bound
/// of a ring, multipliers are not unique; what more of one alone brings is its least: nothing where the others hold the optimum without it.
#[doc(hidden)]
pub fn prices(space: &Space, outcome: &Outcome, limits: usize) -> (Vec<f64>, Vec<OnBound>) {
    let active = Active::new(space, outcome);
    let is_ambiguous = active.is_ambiguous();
    let alone = |of: Of, known: f64| if is_ambiguous { active.least(of).map_or(known, |least| least.min(known)) } else { known };
    let mut prices = vec![0.0; limits];
    for (row, multiplier) in outcome.rows.rows.iter().zip(&outcome.multipliers) {
        if let Role::Limit(limit) = row.role {
            prices[limit] += multiplier;
        }
    }
    prices.iter_mut().enumerate().filter(|p| *p.1 >= ROUNDING).for_each(|(i, p)| *p = alone(Of::Limit(i), *p));
    prices.iter_mut().filter(|p| **p < ROUNDING).for_each(|p| *p = 0.0);
    (prices, on_bounds(space, outcome, &alone))
}

fn on_bounds(space: &Space, outcome: &Outcome, alone: &dyn Fn(Of, f64) -> f64) -> Vec<OnBound> {
    let mut list = Vec::new();
    for (i, ((v, w), [low, high])) in space.variables.iter().zip(&outcome.point).zip(&outcome.bounds).enumerate() {
        let x = v.value(*w);
        for (bound, multiplier, upper) in [(v.lower, low, false), (v.upper, high, true)] {
            if (x - bound).abs() <= ON_BOUND * v.upper {
                // a coordinate is nearly the logarithm of its value
                let price = (bound > 0.0).then(|| alone(Of::Bound(i, upper), *multiplier) * bound / v.slope(bound));
                list.push(OnBound { absorber: v.absorber, parameter: v.parameter, bound, upper, price });
            }
        }
    }
    list
}
