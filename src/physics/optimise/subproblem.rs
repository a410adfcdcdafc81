//! The quadratic model of a minimax problem, solved by clarabel.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::DMatrix;

/// A linearised row: value and gradient.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    /// Index of the objective that it is of (to be at most its t), or nothing for a limit (to be at most zero).
    pub objective: Option<usize>,
    /// In units of the largest objective.
    pub value: f64,
    /// With respect to the coordinates.
    pub gradient: Vec<f64>,
}

/// A step and what the model expects of it.
#[derive(Debug, Clone)]
pub struct Step {
    /// Change of the coordinates.
    pub change: Vec<f64>,
    /// Model value (weighted t) + penalty s after the step (with curvature).
    pub model: f64,
    /// One multiplier a line; those of an objective sum to its weight.
    pub multipliers: Vec<f64>,
    /// Multipliers of the lower and upper reach of each coordinate.
    pub bounds: Vec<[f64; 2]>,
}

/// Minimises the sum of weights times t + penalty s + d'Bd/2 over (d, t, s) with value + gradient d <= t (that of its objective) or <= s (limits), s >= 0 and d within `reach`.
/// Rows come in units of the largest objective, so nothing is badly scaled; what comes back is checked. `None` where the solver did not
/// succeed.
pub fn solve(lines: &[Line], weights: &[f64], hessian: &DMatrix<f64>, reach: &[(f64, f64)], penalty: f64) -> Option<Step> {
    let n = reach.len();
    let s = n + weights.len();
    let (mut row, mut column, mut value) = (Vec::new(), Vec::new(), Vec::new());
    let mut b = Vec::new();
    let mut put = |r: usize, c: usize, v: f64| {
        row.push(r);
        column.push(c);
        value.push(v);
    };
    for (r, line) in lines.iter().enumerate() {
        line.gradient.iter().enumerate().for_each(|(c, g)| put(r, c, *g));
        put(r, line.objective.map_or(s, |o| n + o), -1.0);
        b.push(-line.value);
    }
    for (i, (low, high)) in reach.iter().enumerate() {
        put(b.len(), i, 1.0);
        b.push(*high);
        put(b.len(), i, -1.0);
        b.push(-low);
    }
    put(b.len(), s, -1.0);
    b.push(0.0);
    let finite = value.iter().chain(&b).chain(hessian.iter()).all(|v| v.is_finite());
    if !finite {
        return None;
    }
    let a = CscMatrix::new_from_triplets(b.len(), s + 1, row, column, value);
    let (mut pr, mut pc, mut pv) = (Vec::new(), Vec::new(), Vec::new());
    for c in 0..n {
        for r in 0..=c {
            pr.push(r);
            pc.push(c);
            pv.push(hessian[(r, c)]);
        }
    }
    let p = CscMatrix::new_from_triplets(s + 1, s + 1, pr, pc, pv);
    let mut q = vec![0.0; s + 1];
    q[n..s].copy_from_slice(weights);
    q[s] = penalty;
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .presolve_enable(false)
        .max_threads(1u32)
        .tol_gap_abs(1e-13)
        .tol_gap_rel(1e-13)
        .tol_feas(1e-13)
        .build()
        .ok()?;
    let cones = [NonnegativeConeT(b.len())];
    let mut solver = DefaultSolver::new(&p, &q, &a, &b, &cones, settings).ok()?;
    solver.solve();
    let solved = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress);
    let x = &solver.solution.x;
    if !solved || x.iter().any(|v| !v.is_finite()) {
        return None;
    }
    let change: Vec<f64> = x[..n].iter().zip(reach).map(|(d, (low, high))| d.clamp(*low, *high)).collect();
    // t and s from the rows themselves: exact for the clamped step
    let value_of = |line: &Line| line.value + line.gradient.iter().zip(&change).map(|(g, d)| g * d).sum::<f64>();
    let largest =
        |objective: usize| lines.iter().filter(|l| l.objective == Some(objective)).map(value_of).fold(f64::NEG_INFINITY, f64::max);
    let top: f64 = weights.iter().enumerate().map(|(o, weight)| weight * largest(o)).sum();
    let excess = lines.iter().filter(|l| l.objective.is_none()).map(value_of).fold(0.0, f64::max);
    let d = nalgebra::DVector::from_column_slice(&change);
    let model = top + penalty * excess + 0.5 * (hessian * &d).dot(&d);
    let z = &solver.solution.z;
    let bounds = (0..n).map(|i| [z[lines.len() + 2 * i + 1], z[lines.len() + 2 * i]]).collect();
    Some(Step { change, model, multipliers: z[..lines.len()].to_vec(), bounds })
}
