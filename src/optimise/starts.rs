//! Where searches start: closed forms for every mode the torque reaches, and random points.

use super::{Parameter, Space};
use crate::absorber::seeds::{EngineMode, RULES, Rule};
use crate::absorber::{Kind, Ring};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Modes that get closed-form starts of their own.
pub const MOST_MODES: usize = 3;

/// Starts for a family: the closed forms of each mode (a free ring inertia at its upper bound and its middle), the lowest bounds, then `random`
/// points from `seed`.
pub fn starts(space: &Space, modes: &[EngineMode], random: usize, seed: u64) -> Vec<(String, Vec<f64>)> {
    let free = space.variables.iter().find(|v| v.parameter == Parameter::RingInertia);
    let inertias: Vec<(f64, &str)> = match free {
        None => vec![(space.fixed[Parameter::RingInertia as usize], "")],
        Some(v) => vec![(v.upper, ", largest ring"), ((v.lower * v.upper).sqrt(), ", middle ring")],
    };
    let mut list = Vec::new();
    for (m, engine) in modes.iter().take(MOST_MODES).enumerate() {
        for (name, rule) in RULES.iter().filter(|r| suits(r.1, space.kind, m)) {
            for (ring_inertia, which) in &inertias {
                let absorber = rule.absorber(*ring_inertia, *engine);
                list.push((format!("{name}, mode {}{which}", m + 1), space.point(&absorber)));
            }
        }
    }
    if list.is_empty() {
        // no elastic mode moves the station: nothing to tune to
        list.push(("middle of the bounds".to_owned(), space.bounds().iter().map(|(low, high)| 0.5 * (low + high)).collect()));
    }
    let middle = list[0].1.clone();
    let lowest = |which: &dyn Fn(Parameter) -> bool| -> Vec<f64> {
        let bounds = space.bounds();
        space.variables.iter().zip(&bounds).zip(&middle).map(|((v, b), w)| if which(v.parameter) { b.0 } else { *w }).collect()
    };
    // the ends of the box that are often best: no damper, and hardly any ring at all
    let ends = [("least damping", lowest(&|p| p == Parameter::Damping)), ("loosest ring", lowest(&|p| p != Parameter::RingInertia))];
    for (name, point) in ends {
        if list.iter().all(|s| s.1 != point) {
            list.push((name.to_owned(), point));
        }
    }
    for (i, point) in random_points(space, &middle, random, seed).into_iter().enumerate() {
        list.push((format!("random {}", i + 1), point));
    }
    list
}

/// Points spread over the box, but not further than six e-folds from `middle`: beyond, rings are locked or loose.
pub fn random_points(space: &Space, middle: &[f64], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let bounds = space.bounds();
    let mut point = || {
        let within = |((low, high), centre): (&(f64, f64), &f64)| {
            generator.random_range((centre - 6.0).clamp(*low, *high)..=(centre + 6.0).clamp(*low, *high))
        };
        bounds.iter().zip(middle).map(within).collect()
    };
    (0..count).map(|_| point()).collect()
}

/// Higher modes get the exact optimum only; an undamped ring takes the stiffness of the tuned rules.
fn suits(rule: Rule, kind: Kind, mode: usize) -> bool {
    match kind {
        Kind::Viscous => rule.kind() == Kind::Viscous,
        Kind::Tuned => mode == 0 || rule == Rule::HInfinity,
        Kind::Locked => false,
        Kind::Undamped => rule.kind() == Kind::Tuned && (mode == 0 || rule == Rule::HInfinity),
    }
}

/// Bounds wide enough to lock the ring and to let it loose, where a study gives none: up to 10⁴ times the stiffness tuned to the highest
/// mode and 10³ times the damping of a viscous absorber.
pub fn wide_bounds(ring_inertia: f64, modes: &[EngineMode]) -> ((f64, f64), (f64, f64)) {
    // without a mode to go by, 100 rad/s is as good as any
    let first = modes.first().copied().unwrap_or(EngineMode { inertia: ring_inertia, omega: 100.0 });
    let top = modes.iter().map(|m| m.omega).fold(first.omega, f64::max);
    let viscous = Rule::ViscousUntuned.absorber(ring_inertia, first).damping();
    ((0.0, 1e4 * ring_inertia * top * top), (0.0, 1e3 * viscous))
}
