//! What Taylor models enclose, by brute force: random boxes of designs, and random designs in them.

use crate::support::{study, system, uniform_chain};
use hartog::absorber::closed_forms::EngineMode;
use hartog::absorber::{Absorber, Declaration, Mounted, Operating, Range, Surroundings, TYPES};
use hartog::drivetrain::System;
use hartog::numerics::C64;
use hartog::numerics::taylor::{MOST, Taylor};
use hartog::response::enclosed::{BaseAtSpeed, Enclosed};
use hartog::response::{Direct, Grid, Quantity, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Types whose law has an enclosure.
fn enclosed_types() -> Vec<&'static Declaration> {
    let has_enclosure = |d: &&&Declaration| {
        let values: Vec<f64> = d.parameters.iter().map(|p| (p.typical)(&SURROUNDINGS)).collect();
        let models: Vec<Taylor> = values.iter().map(|v| Taylor::constant(C64::from(*v))).collect();
        (d.build)(&values).over(&models, &Operating { omega: 500.0, shaft_speed: 100.0 }.into()).is_some()
    };
    TYPES.iter().filter(has_enclosure).copied().collect()
}

const MODES: [EngineMode; 1] = [EngineMode { inertia: 0.4, omega: 1400.0 }];
const SURROUNDINGS: Surroundings = Surroundings { modes: &MODES, ring_inertia: 0.076 };

/// A box of a type round typical values, from a factor of 7 down to a millionth wide, of at most five of its parameters.
struct RandomBox {
    declaration: &'static Declaration,
    /// Of each parameter.
    ends: Vec<(f64, f64)>,
    /// Variables that are its own: the first, and how many.
    own: (usize, usize),
}

impl RandomBox {
    fn new(declaration: &'static Declaration, own: (usize, usize), random: &mut Xoshiro256PlusPlus) -> Self {
        let width = 2.0 * 10f64.powf(random.random_range(-6.0..0.0));
        let ends = declaration.parameters.iter().enumerate().map(|(i, p)| {
            let centre = (p.typical)(&SURROUNDINGS) * f64::exp(random.random_range(-2.0..2.0));
            let within = |x: f64| match p.range {
                Range::Within(low, high) => x.clamp(low, high),
                Range::Above(least) => x.max(least + 1e-3),
                Range::Positive | Range::NotNegative => x,
            };
            let half = if i < own.1 { width * random.random_range(0.0..0.5) } else { 0.0 };
            (within(centre * (-half).exp()), within(centre * half.exp()))
        });
        Self { declaration, ends: ends.collect(), own }
    }

    fn models(&self) -> Vec<Taylor> {
        let model = |(i, (low, high)): (usize, &(f64, f64))| {
            if i < self.own.1 { Taylor::between(*low, *high, self.own.0 + i) } else { Taylor::constant(C64::from(0.5 * (low + high))) }
        };
        self.ends.iter().enumerate().map(model).collect()
    }

    /// A law of it at a point of the box of all variables.
    fn at(&self, at: &[f64; MOST]) -> Absorber {
        let place = |i: usize| if i < self.own.1 { at[self.own.0 + i] } else { 0.0 };
        let value = |(i, (low, high)): (usize, &(f64, f64))| 0.5 * (low + high) + 0.5 * (high - low) * place(i);
        let values: Vec<f64> = self.ends.iter().enumerate().map(value).collect();
        Absorber::Ring((self.declaration.build)(&values))
    }
}

/// A point of the box of all variables; every fourth is a corner.
fn point(random: &mut Xoshiro256PlusPlus) -> [f64; MOST] {
    let corner = random.random_range(0..4) == 0;
    [(); MOST].map(|()| if corner { f64::from(random.random_range(0..2) * 2 - 1) } else { random.random_range(-1.0..=1.0) })
}

fn holds(model: &Taylor, at: &[f64; MOST], exact: C64) -> bool {
    let linear: C64 = model.slopes.iter().zip(at).map(|(g, x)| g * *x).sum();
    (exact - model.centre - linear).norm() <= model.rest
}

/// The six with its damping; a chain without any, whose poles lie on the real axis; an almost undamped one.
fn systems() -> Vec<System> {
    let six = study("villalva_i6_thesis");
    let excitation = crate::support::one_throw(&[(2, 300.0), (5, 200.0), (9, 100.0), (12, 50.0)]);
    let undamped = uniform_chain(4, 0.3, 1.5e6);
    let mut damped = uniform_chain(7, 0.1, 2e6);
    damped.stations.iter_mut().for_each(|s| s.damping_to_ground = 0.01);
    vec![system(&six), System::new(undamped, excitation.clone()), System::new(damped, excitation)]
}

/// Law: for every type, S and the phasors of twist, shaft torque and ring twists of every design of a box lie in the models of the box: of one absorber, and of two on different stations. Returns how many numbers
/// were held against a model.
fn every_design_is_enclosed(boxes: u64, designs: usize, first: u64) -> u64 {
    let (systems, types) = (systems(), enclosed_types());
    let quantities = [Quantity::RingTwist(0), Quantity::RingTwist(1), Quantity::Twist { from: 0, to: Some(3) }, Quantity::ShaftTorque(1)];
    let mut held = 0;
    for seed in first..first + boxes {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let count = random.random_range(1..=2);
        let quantities = [&quantities[..count], &quantities[2..]].concat();
        let mut kind = || types[random.random_range(0..types.len())];
        let kinds = [kind(), kind()];
        let system = &systems[random.random_range(0..systems.len())];
        let speed = random.random_range(600.0..3500.0);
        let grid = Grid::new(&[speed], &[]);
        let direct = Direct::new(system, &grid);
        let variables = MOST / count;
        let own: Vec<RandomBox> =
            kinds[..count].iter().enumerate().map(|(k, kind)| RandomBox::new(kind, (k * variables, variables), &mut random)).collect();
        let stations = [0, 2];
        let design = |at: &[f64; MOST]| -> Vec<Mounted> {
            own.iter().zip(stations).map(|(own, station)| Mounted::on_station(station, own.at(at))).collect()
        };
        let middle = design(&[0.0; MOST]);
        let base = BaseAtSpeed::new(&direct, &stations, &quantities, speed).expect("no speed is a resonance");
        let absorbers: Vec<Enclosed> =
            middle.iter().zip(&own).map(|(m, own)| Enclosed::of(m, own.models(), &stations).expect("an enclosure")).collect();
        let mut phasors = vec![vec![Taylor::constant(C64::from(0.0)); system.orders()]; quantities.len()];
        // a box that may hold a pole has none
        if base.phasors(&absorbers, &quantities, |i, order, y| phasors[i][order] = y[0]).is_none() {
            continue;
        }
        for _ in 0..designs {
            let at = point(&mut random);
            let design = design(&at);
            let law = design[0].absorber.law().expect("a law");
            for (order, n) in system.excitation.orders.iter().enumerate() {
                let operating = Operating { omega: n.omega(speed), shaft_speed: speed * std::f64::consts::PI / 30.0 };
                let s = law.over(&own[0].models(), &operating.into()).expect("an enclosure");
                assert!(holds(&s, &at, law.dynamic_stiffness(operating)), "{seed}: S of {} at {n}: {s:?}", kinds[0].name);
                for (i, q) in quantities.iter().enumerate() {
                    let model = &phasors[i][order];
                    // row by row with exchange, as the base
                    let exact = direct.order_at(&design, *q, order, speed, &mut Work::default()).expect("no pole");
                    assert!(holds(model, &at, exact), "{seed}: {q:?} of {kinds:?} at {n}: {model:?} {exact}");
                    held += 1;
                }
            }
        }
    }
    held
}

#[test]
fn designs_are_enclosed() {
    assert_eq!(enclosed_types().len(), 13);
    let held = every_design_is_enclosed(1500, 6, 0);
    assert!(held > 30_000, "{held}");
}

/// The same with 10⁷ numbers.
#[test]
#[ignore = "some minutes"]
fn ten_million_numbers_are_enclosed() {
    let mut held = 0;
    for first in (1_000_000..).step_by(10_000) {
        held += every_design_is_enclosed(10_000, 10, first);
        if held >= 10_000_000 {
            break;
        }
    }
    println!("{held} numbers");
}
