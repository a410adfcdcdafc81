//! Measures: every one against an independent sum, its gradient against differences, and limits that bind.

use crate::support::{assert_close, study, system};
use hartog::absorber::{Absorber, Host, Mounted, RUBBER, TUNED};
use hartog::input::{LimitSpec, MeasureSpec, Study};
use hartog::numerics::C64;
use hartog::objective::{DutyLoad, Measure, Over, PeakFinder, Property, STATISTICS, Within};
use hartog::response::{Direct, Grid, Method, Quantity, Rate, Response, Work};

const ENGINES: [&str; 2] = ["villalva_i6_thesis", "villalva_v10_thesis"];

pub fn with_finder<T>(study: &Study, f: impl FnOnce(&PeakFinder) -> T) -> T {
    let sys = system(study);
    let grid = Grid::new(&study.speeds_rpm, &sys.excitation.tabulated_rpm);
    let method = Method::Direct(Direct::new(&sys, &grid));
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let point = |(share, speed_rpm)| DutyLoad { share, speed_rpm, system: system(study) };
    let duty = [(0.25, low + 11.0), (0.6, 0.3 * low + 0.7 * high), (0.15, high)].map(point);
    f(&PeakFinder::new(&sys, &grid, &method, true).with_duty(&duty))
}

fn ring(declaration: &'static hartog::absorber::Declaration, on: Host, values: &[f64]) -> Mounted {
    Mounted { on, hub_inertia: 0.002, absorber: Absorber::Ring((declaration.build)(values)) }
}

/// One ring; two on different stations; a ring on a ring, of laws that depend on frequency.
fn designs() -> Vec<Vec<Mounted>> {
    let station = Host::Station;
    vec![
        vec![ring(&TUNED, station(0), &[0.05, 3.4e4, 30.0])],
        vec![ring(&TUNED, station(0), &[0.03, 4e4, 15.0]), ring(&TUNED, station(2), &[0.02, 5e4, 20.0])],
        vec![ring(&TUNED, station(0), &[0.04, 4e4, 12.0]), ring(&TUNED, Host::Ring(0), &[0.01, 2e4, 6.0])],
        vec![ring(&TUNED, station(0), &[0.05, 3.4e4, 30.0]), ring(&RUBBER, station(0), &[0.02, 3e4, 0.3])],
    ]
}

/// Measures with all that may be asked of them.
fn measures(study: &Study, rings: usize) -> Vec<Measure> {
    let all = || (0..rings).map(Quantity::RingTwist).collect::<Vec<_>>();
    let order = hartog::engine::Order::from_twice(6);
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let middle = 0.5 * (low + high);
    let factors = vec![(low, 1.0), (middle + 3.0, 0.6), (high, 1.4)];
    let within = Within { ranges: vec![(low + 12.0, middle), (middle + 77.0, high)], factors };
    let mut list = vec![
        Measure::new(all(), Over::Synthesis),
        Measure::new(all(), Over::Orders),
        Measure::new(vec![Quantity::RingTwist(rings - 1)], Over::Order(order)),
        Measure::new(all(), Over::Power),
        Measure::new(vec![Quantity::RingTwist(rings - 1)], Over::Power),
        Measure::new(vec![study.twist], Over::Order(order)),
        Measure::new(vec![Quantity::Motion(1, Rate::Acceleration)], Over::Synthesis),
        Measure::new(vec![Quantity::Motion(0, Rate::Acceleration)], Over::Orders),
        Measure::new(vec![Quantity::Motion(2, Rate::Velocity)], Over::Synthesis),
        Measure::new(vec![study.twist], Over::Statistic(STATISTICS[0])),
        Measure::new(vec![Quantity::Motion(0, Rate::Acceleration)], Over::Statistic(STATISTICS[0])),
        Measure::new(vec![study.twist], Over::Mean),
        Measure::new(all(), Over::Mean),
        Measure::new(all(), Over::MeanPower),
        Measure::new(all(), Over::Property(Property::RingInertia)),
        Measure::new(all(), Over::Property(Property::TotalInertia)),
        Measure::new(vec![study.twist], Over::Property(Property::Band { low: 60.0, high: 4000.0 })),
    ];
    for quantities in [vec![study.twist], vec![Quantity::ShaftTorque(2)], all()] {
        list.push(Measure { quantities: quantities.clone(), over: Over::Synthesis, within: within.clone() });
        list.push(Measure { quantities: quantities.clone(), over: Over::Orders, within: within.clone() });
        list.push(Measure { quantities, over: Over::Statistic(STATISTICS[0]), within: within.clone() });
    }
    list.push(Measure { quantities: all(), over: Over::Power, within });
    list
}

/// Law: the change of a value with each parameter of each absorber is that of central differences, to the 4e-6 of a peak that differences of refined ones leave: those are right to 1e-10, and steps are 1e-4.
#[test]
fn gradients_of_measures_equal_differences() {
    for name in ENGINES {
        let mut s = study(name);
        s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(2).collect();
        with_finder(&s, |finder| {
            for design in designs() {
                for measure in measures(&s, design.len()) {
                    let value = |d: &[Mounted]| finder.peak(d, &measure, &mut Work::default()).expect("damped").expect("a peak");
                    let peak = value(&design);
                    for i in 0..design.len() {
                        let gradient = finder.gradient(&design, i, &measure, &peak, &mut Work::default()).expect("damped");
                        let law = design[i].absorber.law().expect("a ring").clone();
                        let values = law.values();
                        for (p, x) in values.iter().enumerate() {
                            let moved = |share: f64| {
                                let mut moved = values.clone();
                                moved[p] *= 1.0 + share;
                                let mut d = design.clone();
                                d[i].absorber = Absorber::Ring((law.declaration().build)(&moved));
                                value(&d).value
                            };
                            let step = 1e-4;
                            let difference = (moved(step) - moved(-step)) / (2.0 * step * x);
                            let found = gradient.get(p).copied().unwrap_or(0.0);
                            assert_close(found * x, difference * x, 1e-5, 4e-6 * peak.value, &format!("{name}, {measure:?}, {i}, {p}"));
                        }
                    }
                }
            }
        });
    }
}

/// Independent: a sweep every quarter of a revolution, sums of half peak-to-peak by sampling the cycle, powers by the law of each ring.
#[test]
fn values_of_measures_equal_a_fine_sweep() {
    for name in ENGINES {
        let s = study(name);
        with_finder(&s, |finder| {
            let (low, high) = (s.speeds_rpm[0], s.speeds_rpm[s.speeds_rpm.len() - 1]);
            let fine: Vec<f64> = (0..=((high - low) * 2.0) as usize).map(|i| low + i as f64 * 0.5).collect();
            let grid = Grid::new(&fine, &[]);
            let direct = Direct::new(finder.system, &grid);
            let orders = finder.system.orders();
            let design = &designs()[1];
            // samples of the cycle: more than twice its harmonics, so that a mean square of them is exact
            let harmonics = &finder.system.excitation.harmonics;
            let samples = 2 * harmonics[orders - 1] + 2;
            let angle = |i: u32, h: u32| std::f64::consts::TAU * f64::from(i * h) / f64::from(samples);
            let turns: Vec<Vec<C64>> =
                (0..samples).map(|i| harmonics.iter().map(|h| C64::from_polar(1.0, angle(i, *h))).collect()).collect();
            for measure in measures(&s, design.len()) {
                if matches!(measure.over, Over::Mean | Over::MeanPower | Over::Property(_)) {
                    continue;
                }
                let holds =
                    |speed: f64| measure.within.ranges.is_empty() || measure.within.ranges.iter().any(|r| r.0 <= speed && speed <= r.1);
                let mut sum = vec![0.0; fine.len()];
                for quantity in &measure.quantities {
                    let mut sweep: Vec<C64> = Vec::new();
                    direct.sweep(design, *quantity, &mut sweep, &mut Work::default()).expect("damped");
                    for (i, y) in sweep.chunks(orders).enumerate() {
                        let order = |n: usize| finder.system.excitation.orders[n];
                        let value = match measure.over {
                            Over::Synthesis => finder.synthesis(y)[0],
                            Over::Orders => y.iter().map(|y| y.norm()).fold(0.0, f64::max),
                            Over::Statistic(_) => {
                                let sample = |turn: &Vec<C64>| y.iter().zip(turn).map(|(y, t)| (y * t).re).sum::<f64>().powi(2);
                                (turns.iter().map(sample).sum::<f64>() / turns.len() as f64).sqrt()
                            }
                            Over::Order(o) => (0..orders).filter(|n| order(*n) == o).map(|n| y[n].norm()).sum(),
                            _ => {
                                let Quantity::RingTwist(r) = quantity else { panic!("a ring") };
                                let own = design[*r].absorber.damping().expect("a damper");
                                (0..orders).map(|n| 0.5 * own * (order(n).omega(fine[i]) * y[n].norm()).powi(2)).sum()
                            }
                        };
                        let value = if holds(fine[i]) { value * measure.within.weight(fine[i]) } else { 0.0 };
                        sum[i] = if measure.over == Over::Power { sum[i] + value } else { f64::max(sum[i], value) };
                    }
                }
                let expected = sum.into_iter().fold(0.0, f64::max);
                let peak = finder.peak(design, &measure, &mut Work::default()).expect("damped").expect("a peak");
                assert!(peak.value >= expected * (1.0 - 1e-12), "{name}, {measure:?}: {} is below {expected}", peak.value);
                assert_close(peak.value, expected, 3e-5, 0.0, &format!("{name}, {measure:?}"));
                assert!(holds(peak.speed_rpm));
            }
        });
    }
}

/// Law: a mean over the duty is the sum of shares times what the design does at each point, at its speed and load: of the duty that a run reports, and of a study that has one
/// speed only.
#[test]
fn means_over_the_duty() {
    let mut s = study("villalva_i6");
    (s.optimise, s.front, s.fatigue) = (None, None, None);
    s.more_objectives.clear();
    s.conditions.clear();
    s.designs.retain(|d| d.name == "tuned_unity");
    let point = |speed_rpm, load_fraction, share| hartog::input::DutyPoint { speed_rpm, load_fraction, share };
    s.duty = vec![point(1000.0, 0.5, 0.3), point(1755.0, 1.0, 0.7)];
    s.objective.measure.over = Over::Mean;
    let power = Measure::new(vec![Quantity::RingTwist(0)], Over::MeanPower);
    s.limits =
        vec![LimitSpec { of: MeasureSpec { measure: power, ..s.objective.clone() }, words: "mean power".into(), limit: 100.0, rule: None }];
    let results = s.run().expect("damped");
    let of = |i: usize| &results.duty[0].points[i];
    assert!(of(0).twist > 0.0 && of(1).twist > 1.1 * of(0).twist, "{:?}", results.duty);
    let found = &results.designs[0];
    assert_close(found.objective.expect("twist"), 0.3 * of(0).twist + 0.7 * of(1).twist, 1e-12, 0.0, "twist");
    assert_close(100.0 * found.limits[0], results.duty[0].mean_power(), 1e-12, 0.0, "power");
    // the point at full load by itself
    s.speeds_rpm = vec![1755.0];
    (s.objective.measure.over, s.duty) = (Over::Synthesis, Vec::new());
    s.limits[0].of.measure.over = Over::Power;
    let alone = s.run().expect("damped");
    assert_close(alone.designs[0].objective.expect("twist"), of(1).twist, 1e-12, 0.0, "twist at one speed");
    assert_close(alone.designs[0].power.expect("a ring"), of(1).power, 1e-12, 0.0, "power at one speed");
}

/// Law: the least mean over a duty meets the first-order conditions to 1e-8, although other angles of the cycle are as large at a point of it; its value is that of the design; a grid of springs and dampers
/// round it finds nothing lower.
#[test]
fn the_least_mean_over_a_duty() {
    let mut s = study("villalva_i6");
    (s.front, s.fatigue) = (None, None);
    s.more_objectives.clear();
    s.conditions.clear();
    s.designs.clear();
    let point = |speed_rpm, load_fraction, share| hartog::input::DutyPoint { speed_rpm, load_fraction, share };
    s.duty = vec![point(1600.0, 0.5, 0.7), point(2200.0, 1.0, 0.3)];
    s.objective.measure.over = Over::Mean;
    let absorber = &mut s.optimise.as_mut().expect("optimises").absorbers[0];
    (absorber.types, absorber.size) = (vec![&TUNED], hartog::input::Size::Each(vec![0.076]));
    let found = s.run().expect("damped").optima.remove(0);
    let best = found.optimum.value();
    assert!(found.optimum.outcome.kkt_residual < 1e-8, "{:e}", found.optimum.outcome.kkt_residual);
    assert_close(found.design.objective.expect("twist"), best, 1e-9, 0.0, "the design's own");
    let [ring, k, c] = crate::support::three_values(&found.optimum.design[0]);
    for (a, b) in [(0.9, 1.0), (1.1, 1.0), (1.0, 0.8), (1.0, 1.25), (0.97, 1.1), (1.03, 0.9), (1.01, 1.0), (0.99, 1.0)] {
        let design = vec![crate::support::on(0, crate::support::Kind::Tuned, ring, a * k, b * c)];
        let other = s.evaluate("beside", design).expect("damped").objective.expect("twist");
        assert!(other > best * (1.0 - 1e-9), "{a} {b}: {other} is below {best}");
    }
}

/// The twist that tables report is the first that a study asks for, as an objective or as a limit, whatever stands before it: behind a margin or an inertia it was that over the whole chain.
#[test]
fn the_twist_that_is_reported_is_the_one_that_is_asked_for() {
    let twist = "peak_twist = { from = \"throw_1\", to = \"throw_6\"";
    let objective = |measure: &str| format!("[[objective]]\n{measure}\n");
    let asked = |parts: &[String]| {
        let head = "engine = \"engines/villalva_i6.toml\"\nspeed_rpm = { from = 600, to = 3200, step = 100 }\norder_limit = 6\n";
        let search = "[optimise]\n[[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"tuned\"]\nsize.ring_inertia_kg_m2.between = [0.01, 0.1]\n";
        let text = format!("{head}{}{search}", parts.concat());
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/twist.toml");
        Study::from_toml(&text, file).unwrap_or_else(|e| panic!("{e}")).twist
    };
    let inertia = objective("ring_inertia = {}");
    let limit = format!("[[constraint]]\n{twist}, max_deg = 0.5 }}\n");
    let expected = Quantity::Twist { from: 1, to: Some(6) };
    assert_eq!(asked(&[inertia.clone(), objective(&format!("{twist} }}"))]), expected);
    assert_eq!(asked(&[inertia.clone(), limit]), expected);
    let most = "[[constraint]]\ndissipated_power = { max_w = 300 }\n".to_owned();
    assert_eq!(asked(&[inertia, most]), Quantity::Twist { from: 0, to: Some(7) });
}
