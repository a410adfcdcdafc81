//! What Taylor models enclose, by brute force: random boxes of designs, and random designs in them.

use crate::support::{study, system, uniform_chain};
use hartog::absorber::closed_forms::EngineMode;
use hartog::absorber::{Absorber, Declaration, Mounted, Operating, Range, Surroundings, TYPES};
use hartog::drivetrain::System;
use hartog::numerics::C64;
use hartog::numerics::taylor::{MOST, Taylor};
use hartog::response::enclosed::{BaseAtSpeed, Corners, Enclosed};
use hartog::response::pair::{Coefficients, pair};
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
        Self::of_width(width, declaration, own, random)
    }

    fn of_width(width: f64, declaration: &'static Declaration, own: (usize, usize), random: &mut Xoshiro256PlusPlus) -> Self {
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

/// Law: an output of two absorbers, side by side or apart, is over a box nowhere smaller than the Bernstein coefficients of its squares say, and along a direction nowhere below those of its product, whether the box
/// holds a pole or not; a linear function made of them is below one wherever the output is below its size. Direct solutions are trusted to 1e-9. Returns how often these said something, boxes with a pole apart.
fn quotients_are_bounds(boxes: u64, designs: usize, first: u64) -> [u64; 3] {
    let (systems, types) = (systems(), enclosed_types());
    let quantities = [Quantity::Twist { from: 0, to: Some(3) }, Quantity::Twist { from: 2, to: None }];
    let is_quotient = |d: &&&Declaration| {
        let values: Vec<f64> = d.parameters.iter().map(|p| (p.typical)(&SURROUNDINGS)).collect();
        (d.build)(&values).quotient(&values, Operating { omega: 500.0, shaft_speed: 100.0 }).is_some()
    };
    let types: Vec<_> = types.iter().filter(is_quotient).copied().collect();
    assert_eq!(types.len(), 5, "tuned, undamped, viscous, rubber, maxwell");
    let [mut sizes, mut along, mut with_pole] = [0; 3];
    for seed in first..first + boxes {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let system = &systems[random.random_range(0..systems.len())];
        let speed = random.random_range(600.0..3500.0);
        let grid = Grid::new(&[speed], &[]);
        let direct = Direct::new(system, &grid);
        let stations = [0, if random.random_bool(0.5) { 0 } else { 2 }];
        let hubs = [0.0, random.random_range(0.0..0.1)];
        let width = 10f64.powf(random.random_range(-3.0..1.0));
        let own: Vec<RandomBox> =
            (0..2).map(|k| RandomBox::of_width(width, types[random.random_range(0..types.len())], (3 * k, 3), &mut random)).collect();
        let design = |at: &[f64; MOST]| -> Vec<Mounted> {
            let mounted = own.iter().zip(stations).zip(hubs);
            mounted.map(|((own, station), hub)| Mounted::on_station(station, own.at(at)).with_hub(hub)).collect()
        };
        let distinct = if stations[1] == 0 { vec![0] } else { vec![0, 2] };
        let base = BaseAtSpeed::new(&direct, &distinct, &quantities, speed).expect("no speed is a resonance");
        let middle = design(&[0.0; MOST]);
        let absorbers: Vec<Enclosed> =
            middle.iter().zip(&own).map(|(m, own)| Enclosed::of(m, own.models(), &distinct).expect("an enclosure")).collect();
        let both = pair(&absorbers).expect("two absorbers");
        let all = base.quotients([0, distinct.len() - 1], &quantities);
        let mut coefficients = Coefficients::default();
        let mut phasors = vec![Taylor::constant(C64::from(0.0)); 2];
        for (order, own) in all.iter().enumerate() {
            let [a, b] = base.loads(&both, order).expect("quotients");
            let has_pole = base.phasors_of(order, &absorbers, &quantities, |i, y| phasors[i] = y[0]).is_none();
            let points: Vec<[f64; MOST]> = (0..designs).map(|_| point(&mut random)).collect();
            for (quantity, quotient) in quantities.iter().zip(own) {
                let quotient = quotient.as_ref().expect("of the chain");
                let exact =
                    |at: &[f64; MOST], q: Quantity| direct.order_at(&design(at), q, order, speed, &mut Work::default()).expect("no pole");
                let direction = C64::from_polar(1.0, random.random_range(0.0..6.3));
                let least_along = quotient.least_along([&a, &b], direction);
                let least = quotient.least([&a, &b], &mut coefficients);
                let most = exact(&points[0], *quantity).norm() * random.random_range(0.5..2.0);
                let (value, slopes) = coefficients.linear([&a, &b], both.each_ref().map(Corners::variables), most);
                for at in &points {
                    let y = exact(at, *quantity);
                    let doubt = 1e-9 * y.norm();
                    let what = || format!("{seed}: {quantity:?} at order {order} of {middle:?}: {y} at {at:?}");
                    assert!(y.norm() >= least - doubt, "{} below {least}", what());
                    assert!((y * direction).re >= least_along - doubt, "{} below {least_along}", what());
                    let linear: f64 = value + slopes.iter().zip(at).map(|(s, x)| s * x).sum::<f64>();
                    assert!(linear < 1.0 || y.norm() >= most - doubt, "{}: {linear} though below {most}", what());
                }
                sizes += u64::from(least > 0.0);
                along += u64::from(least_along.is_finite());
                with_pole += u64::from(has_pole && least > 0.0);
            }
        }
    }
    [sizes, along, with_pole]
}

#[test]
fn two_absorbers_are_bounded() {
    let [sizes, along, with_pole] = quotients_are_bounds(1500, 12, 0);
    assert!(sizes > 10_000 && along > 10_000 && with_pole > 300, "{sizes} {along} {with_pole}");
}

/// The same of some millions of designs.
#[test]
#[ignore = "some minutes"]
fn millions_of_pairs_are_bounded() {
    println!("{:?}", quotients_are_bounds(100_000, 12, 1_000_000));
}
