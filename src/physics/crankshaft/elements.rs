//! Reactions by beam elements: Hermite's cubics between all supports and forces, exact for single forces. What margins are computed by: it keeps its digits
//! for any number of throws.

use super::beam::{Beam, Reactions};
use nalgebra::DMatrix;

/// The reactions; nothing where the beam can move freely.
pub fn reactions(beam: &Beam) -> Option<Reactions> {
    let mut nodes: Vec<f64> = beam.supports.iter().map(|s| s.at).chain(beam.loads_at.iter().copied()).collect();
    nodes.sort_by(f64::total_cmp);
    nodes.dedup();
    let node = |x: f64| nodes.partition_point(|n| *n < x);
    let unit = beam.length() / (nodes.len() - 1) as f64;
    // deflections in units of `unit`, forces in units of E I/unit²
    let size = 2 * nodes.len();
    let mut stiffness = DMatrix::zeros(size, size);
    for (i, pair) in nodes.windows(2).enumerate() {
        let l = (pair[1] - pair[0]) / unit;
        let element = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ];
        for (a, row) in element.iter().enumerate() {
            for (b, value) in row.iter().enumerate() {
                stiffness[(2 * i + a, 2 * i + b)] += value / l.powi(3);
            }
        }
    }
    let rigid: Vec<usize> = beam.supports.iter().filter(|s| s.stiffness.is_none()).map(|s| 2 * node(s.at)).collect();
    let mut springs = Vec::new();
    for s in &beam.supports {
        let k = s.stiffness.map(|k| k * unit.powi(3) / beam.rigidity);
        springs.push(k);
        if let Some(k) = k {
            stiffness[(2 * node(s.at), 2 * node(s.at))] += k;
        }
    }
    let free: Vec<usize> = (0..size).filter(|d| !rigid.contains(d)).collect();
    let reduced = DMatrix::from_fn(free.len(), free.len(), |a, b| stiffness[(free[a], free[b])]);
    let mut force = DMatrix::zeros(size, beam.loads_at.len());
    for (c, at) in beam.loads_at.iter().enumerate() {
        force[(2 * node(*at), c)] = 1.0;
    }
    let right = DMatrix::from_fn(free.len(), force.ncols(), |a, c| force[(free[a], c)]);
    let solved = reduced.cholesky()?.solve(&right);
    let mut moved = DMatrix::zeros(size, force.ncols());
    for (a, d) in free.iter().enumerate() {
        moved.row_mut(*d).copy_from(&solved.row(a));
    }
    let held = &stiffness * &moved - &force;
    let reaction = |i: usize, c: usize| match springs[i] {
        Some(k) => -k * moved[(2 * node(beam.supports[i].at), c)],
        None => held[(2 * node(beam.supports[i].at), c)],
    };
    Some(Reactions(DMatrix::from_fn(beam.supports.len(), force.ncols(), reaction)))
}
