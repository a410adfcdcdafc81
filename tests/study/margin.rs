//! Margin of the crank: as objective, as limit, over speed; and what it must not cost.

use crate::support::{Kind, assert_close, on, study, system, three_values};
use hartog::absorber::{Host, Mounted, TUNED};
use hartog::analysis::{Results, Silent, margins, run};
use hartog::crankshaft::{
    Crank, CriticalLocation, FactorSource, FatigueSpec, FilletSpec, Margin, MarginCriterion, MeanBending, Place, Torque,
};
use hartog::drivetrain::System;
use hartog::fatigue::Criterion;
use hartog::fatigue::multiaxial::Criterion as Multiaxial;
use hartog::input::Study;
use hartog::numerics::C64;
use hartog::numerics::synthesis::{self, Extremes, Synthesiser};
use hartog::objective::{Condition, Limit, Measure, PeakFinder};
use hartog::optimise::{LoadCase, Problem, Slot, Space, Variable};
use hartog::response::{Direct, Grid, Method, Quantity, Response, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

pub const ENGINES: [&str; 2] = ["villalva_i6_thesis", "villalva_v10_thesis"];

/// A study with every fifth speed and nothing to optimise.
pub fn short(name: &str) -> Study {
    let mut s = study(name);
    (s.optimise, s.front) = (None, None);
    s.more_objectives.clear();
    s.conditions.clear();
    let last = s.speeds_rpm[s.speeds_rpm.len() - 1];
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(5).collect();
    if s.speeds_rpm[s.speeds_rpm.len() - 1] < last {
        s.speeds_rpm.push(last);
    }
    s
}

pub struct Case {
    pub study: Study,
    pub system: System,
    pub grid: Grid,
    pub margin: Margin,
}

impl Case {
    pub fn new(study: Study) -> Self {
        let system = system(&study);
        let grid = Grid::new(&study.speeds_rpm, &system.excitation.tabulated_rpm);
        let margin = margins::model(&study, &system.excitation.harmonics, &grid).expect("[fatigue]");
        Self { study, system, grid, margin }
    }

    pub fn with<T>(&self, job: impl FnOnce(&PeakFinder) -> T) -> T {
        let method = Method::Direct(Direct::new(&self.system, &self.grid));
        job(&PeakFinder::new(&self.system, &self.grid, &method, true).with_margin(Some(&self.margin)))
    }
}

pub fn random_absorber(random: &mut Xoshiro256PlusPlus, name: &str) -> Mounted {
    let (ring, omega) = if name == "villalva_i6_thesis" { (0.05, 1440.0) } else { (0.02, 2590.0) };
    let mut factor = || random.random_range(-1.0..1.0f64).exp();
    let (stiffness, damping) = (ring * omega * omega * factor(), 0.4 * ring * omega * factor());
    on(0, Kind::Tuned, ring, stiffness, damping)
}

/// Law: leaving out speeds and shafts by the bound from the magnitudes of the orders changes nothing: the smallest margin is that of an evaluation of everything (every grid
/// speed and shaft, then a fine scan round the smallest), for random absorbers.
#[test]
fn skipping_by_the_bound_changes_nothing() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    for name in ENGINES {
        let case = Case::new(short(name));
        let measures = margins::measures(&case.study);
        for _ in 0..6 {
            let design = [random_absorber(&mut random, name)];
            case.with(|finder| {
                let mut work = Work::default();
                let found = margins::smallest(finder, &design, &measures, &mut work).expect("finite");
                let all = case.grid.len() as u64 * 7 * found.len() as u64;
                assert!(work.syntheses < all / 2 + 1400 * found.len() as u64, "{} of {all} sums: nothing is left out", work.syntheses);
                for m in &found {
                    let full = everything(&case, finder, &design, m.criterion);
                    assert!(m.margin <= full * (1.0 + 1e-9), "{name}: {} above the full evaluation's {full}", m.margin);
                    // the scan is a little coarse
                    assert_close(m.margin, full, 1e-4, 0.0, name);
                }
            });
        }
    }
}

/// The smallest margin over all shafts at every grid speed, then at 200 speeds round the smallest.
fn everything(case: &Case, finder: &PeakFinder, design: &[Mounted], criterion: usize) -> f64 {
    let shafts: Vec<Quantity> = (0..case.study.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let used = |speeds: &[f64]| {
        let grid = Grid::new(speeds, &[]);
        let sweeps = Direct::new(&case.system, &grid).sweep_each(design, &shafts, &mut Work::default()).expect("finite");
        let mut worst = (0.0, 0.0);
        for (shaft, sweep) in sweeps.iter().enumerate() {
            let torques = finder.extremes(sweep).into_iter().zip(sweep.chunks(case.system.orders()));
            for (speed, (extremes, phasors)) in speeds.iter().zip(torques) {
                let value = case.margin.most_used(criterion, shaft, *speed, &Torque { extremes, phasors }).map_or(0.0, |u| u.value);
                if value > worst.0 {
                    worst = (value, *speed);
                }
            }
        }
        worst
    };
    let speeds = &case.grid.speed_rpm;
    let (_, at) = used(speeds);
    let i = speeds.iter().position(|s| *s == at).expect("a grid speed");
    let (low, high) = (speeds[i.saturating_sub(1)], speeds[(i + 1).min(speeds.len() - 1)]);
    let fine: Vec<f64> = (0..=200).map(|j| low + (high - low) * f64::from(j) / 200.0).collect();
    1.0 / used(&fine).0.max(used(speeds).0)
}

/// Law: the derivative of a margin's row with respect to ring inertia, stiffness and damping is that of central differences of the peak, for random absorbers and by every criterion.
#[test]
fn gradients_of_margins() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    for name in ENGINES {
        let case = Case::new(short(name));
        for (measure, criterion) in margins::measures(&case.study).iter().zip(&case.margin.criteria) {
            // peaks of Dang Van's sum on ridges are found again for a slightly other design
            let on_ridges = *criterion == MarginCriterion::Multiaxial(Multiaxial::DANG_VAN_MESOSCOPIC);
            let tolerance = if on_ridges { 0.05 } else { 2e-3 };
            for _ in 0..4 {
                let design = random_absorber(&mut random, name);
                case.with(|finder| {
                    let peak = |m: Mounted| finder.peak(&[m], measure, &mut Work::default()).expect("finite").expect("a peak");
                    let at = peak(design.clone());
                    let gradient = finder.gradient(std::slice::from_ref(&design), 0, measure, &at, &mut Work::default()).expect("finite");
                    for p in 0..3 {
                        let moved = |share: f64| {
                            let mut v = three_values(&design);
                            v[p] *= 1.0 + share;
                            peak(on(0, Kind::Tuned, v[0], v[1], v[2]))
                        };
                        let h = 1e-4;
                        let (up, down) = (moved(h), moved(-h));
                        // another peak may take over
                        if (up.speed_rpm - down.speed_rpm).abs() > 5.0 || up.quantity != at.quantity || down.quantity != at.quantity {
                            continue;
                        }
                        let difference = (up.value - down.value) / (2.0 * h * three_values(&design)[p]);
                        assert_close(
                            gradient[p],
                            difference,
                            tolerance,
                            1e-5 * at.value / three_values(&design)[p],
                            &format!("{name}, {:?}, parameter {p}", measure.over),
                        );
                    }
                });
            }
        }
    }
}

/// Law: a chain written from the other end is the same engine: same margins, at the same fillets, though torque has the other sign and throws fall along the chain.
#[test]
fn a_mirrored_chain_is_the_same_crank() {
    for name in ENGINES {
        let straight = short(name);
        let n = straight.chain.len();
        let mut mirrored = straight.clone();
        mirrored.chain.stations.reverse();
        for (i, station) in mirrored.chain.stations.iter_mut().enumerate() {
            let link = (i + 1 < n).then(|| &straight.chain.stations[n - 2 - i]);
            station.stiffness_to_next = link.map_or(0.0, |s| s.stiffness_to_next);
            station.damping_to_next = link.map_or(0.0, |s| s.damping_to_next);
            station.loss_factor_to_next = link.map_or(0.0, |s| s.loss_factor_to_next);
        }
        let (a, b) = (Case::new(straight), Case::new(mirrored));
        let design = |hub: usize| [on(hub, Kind::Tuned, 0.03, 1.2e5, 25.0)];
        let smallest = |case: &Case, hub: usize| {
            let measures = margins::measures(&case.study);
            case.with(|f| margins::smallest(f, &design(hub), &measures, &mut Work::default()).expect("finite"))
        };
        for (x, y) in smallest(&a, 0).iter().zip(&smallest(&b, n - 1)) {
            assert_close(y.margin, x.margin, 1e-9, 0.0, name);
            assert_eq!(a.margin.locations[x.used.location].name, b.margin.locations[y.used.location].name);
        }
    }
}

/// Law: two rods side by side on a pin bend the web nearer to them more than two on its middle, and hold it less on the other side: half the pin apart, a V's margin by the
/// class rule is smaller; and mean bending counted as tension never leaves a larger margin than with its sign.
#[test]
fn rods_side_by_side_and_signs_of_the_mean() {
    let base = short("villalva_v10_thesis");
    let smallest = |crank: Crank, mean_bending: MeanBending| -> Vec<f64> {
        let fatigue = FatigueSpec { mean_bending, ..base.fatigue.clone().expect("[fatigue]") };
        let case = Case::new(Study { crank: Some(crank), fatigue: Some(fatigue), ..base.clone() });
        let measures = margins::measures(&case.study);
        case.with(|f| margins::smallest(f, &[], &measures, &mut Work::default()).expect("finite").iter().map(|m| m.margin).collect())
    };
    let crank = base.crank.clone().expect("a crank");
    assert_close(crank.rod_spacing, 0.5 * crank.pin_length, 1e-12, 0.0, "side by side unless the file says otherwise");
    let together = Crank { rod_spacing: 0.0, ..crank.clone() };
    let (apart, middle) = (smallest(crank.clone(), MeanBending::Signed), smallest(together, MeanBending::Signed));
    assert!(apart[1] < 0.97 * middle[1], "{apart:?} {middle:?}");
    let tension = smallest(crank, MeanBending::AsTension);
    assert!(tension[0] <= apart[0] && tension[1] == apart[1], "{tension:?} {apart:?}");
}

/// Sign of mean bending: at 600 rpm gas pushes the pins of the six towards the crankshaft. That opens the fillets of the crankpins and closes those of the journals, so that without any
/// torque the former have a mean stress and the latter none. At the ends of the crank: between, the throw beside it in the same plane may bend a throw the other way.
#[test]
fn gas_opens_crankpin_fillets_and_closes_those_of_journals() {
    let case = Case::new(short("villalva_i6_thesis"));
    let mean_torque = case.margin.mean_torque(600.0);
    let at_ends = |(i, s): &(usize, &CriticalLocation)| case.margin.judges(0, *i) && [0, 5].contains(&s.throw);
    for (i, location) in case.margin.locations.iter().enumerate().filter(at_ends) {
        let still = Extremes { middle: -mean_torque[location.shaft], ..Extremes::default() };
        let mean = case.margin.used(0, i, 600.0, &Torque { extremes: still, phasors: &[] }).cycle.mean;
        match location.place {
            Place::Journal => assert!(mean < 1.0, "{}: {mean}", location.name),
            _ => assert!(mean > 10e6, "{}: {mean}", location.name),
        }
    }
}

/// Law: no torque uses more than the bound from its extremes, nor than that from the sum of its orders, at any speed and shaft and by any criterion.
#[test]
fn bounds_hold() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(9);
    for name in ENGINES {
        let case = Case::new(short(name));
        let harmonics = &case.system.excitation.harmonics;
        let synthesiser = Synthesiser::new(harmonics);
        for _ in 0..3000 {
            let (criterion, shaft) = (random.random_range(0..case.margin.criteria.len()), random.random_range(0..6));
            let speed = random.random_range(case.grid.speed_rpm[0]..case.grid.speed_rpm[case.grid.len() - 1]);
            let size = random.random_range(0.0..1e3);
            let phasors: Vec<C64> = harmonics
                .iter()
                .map(|_| C64::from_polar(size * random.random_range(0.0..1.0f64).powi(4), random.random_range(0.0..TAU)))
                .collect();
            let (extremes, sum) = (synthesiser.extremes(&phasors), synthesis::bound(&phasors));
            let used = case.margin.most_used(criterion, shaft, speed, &Torque { extremes, phasors: &phasors }).map_or(0.0, |u| u.value);
            assert!(used <= case.margin.at_most(criterion, shaft, speed, sum, sum) * (1.0 + 1e-12));
            let (half, middle) = (extremes.half_peak_to_peak, extremes.middle);
            assert!(used <= case.margin.at_most(criterion, shaft, speed, half, middle) * (1.0 + 1e-12));
        }
    }
}

/// Tendencies, on random cranks within the ranges of the formulas, by every criterion: more torque, larger given factors, sharper fillets, thinner webs and lower strength
/// leave a smaller margin.
#[test]
fn tendencies_on_random_cranks() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(17);
    let base = short("villalva_i6_thesis");
    let speeds = [900.0, 2000.0, 3200.0];
    for _ in 0..12 {
        let d = base.crank.as_ref().expect("a crank").pin_diameter;
        let mut r = |low: f64, high: f64| random.random_range(low..high);
        let crank = Crank {
            web_thickness: r(0.25, 0.6) * d,
            web_breadth: r(1.2, 2.0) * d,
            pin_fillet: r(0.035, 0.1) * d,
            journal_fillet: r(0.035, 0.1) * d,
            ..base.crank.clone().expect("a crank")
        };
        let given = |factor: f64| {
            let factors = FactorSource::Given { bending: 1.9 * factor, torsion: 2.2 * factor };
            vec![FilletSpec { name: "pin".into(), throw: None, place: Place::Crankpin, factors }]
        };
        let spec = FatigueSpec {
            criteria: Criterion::ALL.map(MarginCriterion::MeanStress).into_iter().chain([MarginCriterion::IacsM53]).collect(),
            ..base.fatigue.clone().expect("[fatigue]")
        };
        let mut spec = spec;
        spec.strength.yielding = Some(1200e6);
        let torque = Extremes { half_peak_to_peak: r(200.0, 3000.0), middle: r(-100.0, 100.0), ..Extremes::default() };
        let more = Extremes { half_peak_to_peak: 1.1 * torque.half_peak_to_peak, ..torque };
        let all = |crank: &Crank, spec: &FatigueSpec, torque: &Extremes| -> Vec<f64> {
            let model = Margin::new(&base.engine, &base.chain, crank, spec, &speeds, &[]).expect("a model");
            let each = |c: usize| {
                speeds.map(|s| 1.0 / model.most_used(c, 3, s, &Torque { extremes: *torque, phasors: &[] }).expect("locations").value)
            };
            (0..spec.criteria.len()).flat_map(each).collect()
        };
        let smaller = |a: &[f64], b: &[f64], what: &str| {
            assert!(a.iter().zip(b).all(|(a, b)| b < a), "{what}: {a:?} {b:?}");
        };
        let normal = all(&crank, &spec, &torque);
        smaller(&normal, &all(&crank, &spec, &more), "more torque");
        let sharp = Crank { pin_fillet: 0.9 * crank.pin_fillet, journal_fillet: 0.9 * crank.journal_fillet, ..crank.clone() };
        smaller(&normal, &all(&sharp, &spec, &torque), "sharper fillets");
        let thin = Crank { web_thickness: 0.93 * crank.web_thickness, ..crank.clone() };
        smaller(&normal, &all(&thin, &spec, &torque), "thinner webs");
        let mut weak = spec.clone();
        weak.strength.fatigue_limit *= 0.9;
        weak.strength.tensile *= 0.9;
        weak.strength.yielding = weak.strength.yielding.map(|y| 0.9 * y);
        weak.rule.tensile *= 0.9;
        smaller(&normal, &all(&crank, &weak, &torque), "lower strength");
        let lines: Vec<MarginCriterion> = Criterion::ALL.map(MarginCriterion::MeanStress).to_vec();
        let with = |factor: f64| FatigueSpec { criteria: lines.clone(), fillets: given(factor), ..spec.clone() };
        smaller(&all(&crank, &with(1.0), &torque), &all(&crank, &with(1.1), &torque), "larger factors");
    }
}

/// Law: what is optimised by margin has the largest margin: no random design of the same ring does better, and the optimum by twist does not either. The limit on a margin
/// holds at the optimum, and is active where the free optimum breaks it.
#[test]
fn optimum_by_margin() {
    let case = Case::new(short("villalva_v10_thesis"));
    let measures = margins::measures(&case.study);
    let space = Space {
        slots: vec![Slot {
            declaration: &TUNED,
            on: Host::Station(0),
            hub_inertia: 0.0,
            values: vec![0.052, 0.0, 0.0],
            material: Default::default(),
        }],
        variables: vec![
            Variable { absorber: 0, parameter: 1, lower: 1e3, upper: 1e7, scale: 1e2 },
            Variable { absorber: 0, parameter: 2, lower: 0.0, upper: 1e4, scale: 0.1 },
        ],
    };
    case.with(|finder| {
        let load_cases = [LoadCase::new(Condition::Firing, finder)];
        let start = [space.variables[0].coordinate(2e5), space.variables[1].coordinate(60.0)];
        let best = |objective: &Measure, limits: &[Limit]| {
            let objectives = [objective.in_si()];
            let problem =
                Problem { load_cases: &load_cases, space: space.clone(), objectives: &objectives, weights: &[], limits, memory: None };
            let (searched, _) = hartog::optimise::gradient_free::search(&problem, &start, 200, &mut Work::default());
            hartog::optimise::minimax::minimise(&problem, &searched, &mut Work::default()).expect("finite")
        };
        let margin =
            |w: &[f64]| 1.0 / finder.peak(&space.design(w), &measures[0], &mut Work::default()).expect("finite").expect("a peak").value;
        let by_margin = best(&measures[0], &[]);
        assert!(by_margin.kkt_residual < 1e-4, "KKT {}", by_margin.kkt_residual);
        let most = margin(&by_margin.point);
        let twist = &case.study.objective.measure;
        let by_twist = best(twist, &[]);
        assert!(margin(&by_twist.point) <= most);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(23);
        for _ in 0..150 {
            let w: Vec<f64> = by_margin.point.iter().map(|w| w + random.random_range(-1.5..1.5)).collect();
            let inside: Vec<f64> = w.iter().zip(space.bounds()).map(|(w, (low, high))| w.clamp(low, high)).collect();
            assert!(margin(&inside) <= most * (1.0 + 1e-9), "a random design does better");
        }
        // between what the optimum by twist has and the most there is
        let asked = 0.5 * (margin(&by_twist.point) + most);
        let limit = Limit { limit: 1.0 / asked, ..measures[0].in_si() };
        let limited = best(twist, std::slice::from_ref(&limit));
        assert!(limited.rows.excess() < 1e-6);
        assert_close(margin(&limited.point), asked, 1e-5, 0.0, "the limit is active");
        assert!(limited.rows.objective() > by_twist.rows.objective());
    });
}

/// A study without `[fatigue]` gives the same numbers, to the bit, does the same work and writes no table of margins.
#[test]
fn without_fatigue_nothing_is_paid() {
    let with = short("villalva_i6_thesis");
    let without = Study { fatigue: None, crank: None, ..with.clone() };
    let (a, b) = (run(&with, &Silent).expect("finite"), run(&without, &Silent).expect("finite"));
    assert!(b.margin.is_none() && b.margins.is_empty() && b.diagram.is_none());
    for (a, b) in a.designs.iter().zip(&b.designs) {
        assert_eq!((a.twist, a.torque, a.objective), (b.twist, b.torque, b.objective));
        assert!(!a.margins.is_empty() && b.margins.is_empty());
    }
    let stage = |r: &Results, name: &str| r.timing.iter().any(|t| t.stage == name);
    assert!(stage(&a, "crank") && !stage(&b, "crank") && !stage(&b, "one_design_margins"));
}

/// Equals itself: the smallest margins without absorber, with the engine files as they are (`run` calibrates them first). A change of the model shows here.
#[test]
fn smallest_margins_of_the_shipped_engines() {
    for (name, expected) in
        [("villalva_i6_thesis", [2.3074101298821956, 1.273298761503726]), ("villalva_v10_thesis", [2.101397321671967, 1.3406307802336397])]
    {
        let results = run(&short(name), &Silent).expect("finite");
        let none = &results.designs[0];
        for (m, expected) in none.margins.iter().zip(expected) {
            assert_close(m.margin, expected, 1e-8, 0.0, &format!("{name}, criterion {}", m.criterion));
        }
        // the smallest of each design is that of its sweep, refined between speeds
        for (d, sweep) in results.designs.iter().zip(&results.margins) {
            for m in &d.margins {
                let least = sweep.smallest(m.criterion).into_iter().fold(f64::INFINITY, f64::min);
                assert!(m.margin <= least * (1.0 + 1e-12) && m.margin > 0.98 * least, "{} {}: {} {least}", name, d.name, m.margin);
            }
        }
    }
}
