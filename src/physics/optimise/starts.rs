//! Where searches start: closed forms for every mode the torque reaches, and random points.

use super::variables::{Space, Variable};
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::parameter::STIFFNESS;
use crate::absorber::{Host, Operating, Parameter};
use crate::numerics::elementary::Elementary;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Modes that get closed-form starts of their own.
#[doc(hidden)]
pub const MOST_MODES: usize = 3;
/// Closed-form starts of several absorbers together.
const MOST_COMBINED: usize = 12;
/// Absorbers of one type on one mode start apart by this factor in what grows with the ring: alike they would stay alike.
const APART: f64 = 1.3;

/// Starts closer than this in every coordinate are one.
const ALIKE: f64 = 1e-6;

/// A named start.
#[doc(hidden)]
pub type NamedPoint = (String, Vec<f64>);

/// Starts of a search in a family.
pub type Starts<'a> = &'a (dyn Fn(&Space) -> Vec<NamedPoint> + Sync);

/// Starts for a family, with the modes of each of its absorbers: the closed forms of each mode (a free ring inertia at its upper bound and its middle),
/// the lowest bounds, then `random` points from `seed`.
pub fn starts(space: &Space, modes: &[Vec<EngineMode>], random: usize, seed: u64) -> Vec<NamedPoint> {
    let mut list = if space.slots.len() == 1 { single(space, &modes[0]) } else { several(space, modes) };
    if list.is_empty() {
        // no elastic mode moves the station: nothing to tune to
        list.push(("middle of the bounds".to_owned(), space.bounds().iter().map(|(low, high)| 0.5 * (low + high)).collect()));
    }
    let middle = list[0].1.clone();
    let lowest = |which: &dyn Fn(&Parameter) -> bool| -> Vec<f64> {
        let bounds = space.bounds();
        let chosen = |v: &Variable| which(&space.slots[v.absorber].declaration.parameters[v.parameter]);
        space.variables.iter().zip(&bounds).zip(&middle).map(|((v, b), w)| if chosen(v) { b.0 } else { *w }).collect()
    };
    // the ends of the box that are often best: no damper, and hardly any ring at all
    let is_ring = |p: &Parameter| p.key == crate::absorber::parameter::RING_INERTIA.key;
    let ends = [("least damping", lowest(&|p| p.dissipative)), ("loosest ring", lowest(&|p| !is_ring(p)))];
    list.extend(ends.map(|(name, point)| (name.to_owned(), point)));
    for (i, point) in random_points(space, &middle, random, seed).into_iter().enumerate() {
        list.push((format!("random {}", i + 1), point));
    }
    distinct(list, <[f64]>::to_vec)
}

/// Without starts at the place of an earlier one, each `ordered`: closed forms may agree, and what agrees because it began alike proves nothing.
#[doc(hidden)]
pub fn distinct(list: Vec<NamedPoint>, ordered: impl Fn(&[f64]) -> Vec<f64>) -> Vec<NamedPoint> {
    let alike = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < ALIKE);
    let mut distinct: Vec<(NamedPoint, Vec<f64>)> = Vec::new();
    for start in list {
        let own = ordered(&start.1);
        if distinct.iter().all(|(_, known)| !alike(known, &own)) {
            distinct.push((start, own));
        }
    }
    distinct.into_iter().map(|(start, _)| start).collect()
}

/// Ring inertias to start an absorber with, and how they are named.
fn inertias(space: &Space, absorber: usize) -> Vec<(f64, &'static str)> {
    match space.variables.iter().find(|v| (v.absorber, v.parameter) == (absorber, 0)) {
        None => vec![(space.slots[absorber].values[0], "")],
        Some(v) => vec![(v.upper, ", largest ring"), ((v.lower * v.upper).sqrt(), ", middle ring")],
    }
}

fn single(space: &Space, modes: &[EngineMode]) -> Vec<NamedPoint> {
    let mut list = Vec::new();
    for (m, engine) in modes.iter().take(MOST_MODES).enumerate() {
        for form in space.slots[0].declaration.closed_forms.iter().filter(|f| m == 0 || f.every_mode) {
            for (ring_inertia, which) in inertias(space, 0) {
                let values = vec![(form.values)(ring_inertia, *engine)];
                let point = space.point(&values);
                let name = format!("{}, mode {}{which}", form.name, m + 1);
                list.extend(retuned(space, &point, *engine).map(|p| (format!("{name}, retuned"), p)));
                list.push((name, point));
            }
        }
    }
    list
}

/// A point with the spring such that the ring's own frequency is that of the best hysteretic ring, its material being what the bounds make of it; nothing where there is no material or no spring.
fn retuned(space: &Space, point: &[f64], engine: EngineMode) -> Option<Vec<f64>> {
    let parameters = space.slots[0].declaration.parameters;
    let spring = parameters.iter().position(|p| p.key == STIFFNESS.key).filter(|_| parameters.iter().any(|p| p.material))?;
    let mut values = space.values(point).swap_remove(0);
    let law = (space.slots[0].declaration.build)(&values);
    let omega = engine.omega / (1.0 + values[0] / engine.inertia);
    let own = law.dynamic_stiffness(Operating { omega, shaft_speed: omega }).re;
    values[spring] *= values[0] * omega * omega / own;
    (own > 0.0 && values[spring].is_finite()).then(|| space.point(&[values]))
}

/// Every absorber by its closed form for one of the modes, all combinations of modes, the lower modes first.
fn several(space: &Space, modes: &[Vec<EngineMode>]) -> Vec<NamedPoint> {
    let forms: Vec<_> = space.slots.iter().map(|s| s.declaration.closed_forms.iter().rfind(|f| f.every_mode)).collect();
    let counts: Vec<usize> = modes.iter().zip(&forms).map(|(m, f)| if f.is_some() { m.len().min(MOST_MODES) } else { 0 }).collect();
    if counts.contains(&0) {
        return Vec::new();
    }
    let mut chosen: Vec<Vec<usize>> = vec![Vec::new()];
    for count in &counts {
        chosen = chosen.iter().flat_map(|c| (0..*count).map(move |m| c.iter().copied().chain([m]).collect())).collect();
    }
    chosen.sort_by_key(|c: &Vec<usize>| c.iter().sum::<usize>());
    chosen.truncate(MOST_COMBINED / 2);
    let mut list = Vec::new();
    for modes_of in &chosen {
        // the first of two alike absorbers below, then above the other
        for turned in [false, true] {
            let values: Vec<Vec<f64>> = (0..space.slots.len())
                .filter_map(|i| {
                    let own = (forms[i]?.values)(inertias(space, i)[0].0, modes[i][modes_of[i]]);
                    Some(apart(space, i, own, &|j| modes_of[j] == modes_of[i], turned))
                })
                .collect();
            let names: Vec<String> = modes_of.iter().map(|m| (m + 1).to_string()).collect();
            list.push((
                format!("closed forms, modes {}{}", names.join(" and "), if turned { ", the other way" } else { "" }),
                space.point(&values),
            ));
        }
    }
    list
}

/// Mass ratios of designs elsewhere: from lightly to heavily damped ones.
const RATIOS: [f64; 3] = [0.02, 0.2, 1.0];

/// Designs that no mode asks for, in lines along which only the frequency grows: each absorber with a closed form tuned to each of these frequencies (rad/s), as on an engine of some inertia ratios; the
/// others as at a point.
#[doc(hidden)]
pub fn elsewhere(space: &Space, at: &[f64], frequencies: &[f64]) -> Vec<Vec<Vec<f64>>> {
    let own = space.values(at);
    let mut lines = Vec::new();
    for (i, slot) in space.slots.iter().enumerate() {
        let Some(form) = slot.declaration.closed_forms.iter().rfind(|f| f.every_mode) else { continue };
        let ring = own[i][0];
        for ratio in RATIOS {
            let point = |omega: &f64| {
                let mut values = own.clone();
                values[i] = (form.values)(ring, EngineMode { inertia: ring / ratio, omega: *omega });
                space.point(&values)
            };
            lines.push(frequencies.iter().map(point).collect());
        }
    }
    lines
}

/// Values of an absorber moved away from those of others on the same station and mode.
fn apart(space: &Space, index: usize, mut values: Vec<f64>, same_mode: &dyn Fn(usize) -> bool, turned: bool) -> Vec<f64> {
    let own = &space.slots[index];
    let alike = |j: usize| matches!(own.on, Host::Station(_)) && space.slots[j].on == own.on && same_mode(j);
    let (before, all) = ((0..index).filter(|j| alike(*j)).count(), (0..space.slots.len()).filter(|j| alike(*j)).count().max(1));
    let place = before as f64 - 0.5 * (all - 1) as f64;
    let factor = APART.power(if turned { -place } else { place });
    for (value, p) in values.iter_mut().zip(own.declaration.parameters).skip(1) {
        if p.extensive && !p.dissipative {
            *value *= factor;
        }
    }
    values
}

/// Points spread over the box, but not further than six e-folds from `middle`: beyond, rings are locked or loose.
#[doc(hidden)]
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
