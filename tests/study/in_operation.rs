//! Rubber at the temperature and strain of its own motion, both at once: what a design comes to then, and whether its limits hold.

use crate::limited::{optimum, read};
use crate::limits::{TwoMasses, What, measure, with};
use crate::support::assert_close;
use hartog::absorber::{Absorber, Cooling, Geometry, Kraus, Material, Mounted, RUBBER, TemperatureLaw, Thermal, ToAir, WithMaterial};
use hartog::analysis::OptimumResult;
use hartog::input::{DesignSpec, LimitSpec, MeasureSpec, Study};
use hartog::numerics::{C64, I};
use hartog::objective::{Condition, Measure, Over, PeakFinder};
use hartog::response::{Direct, Grid, Method, Quantity, Work};
use std::f64::consts::PI;

const MASSES: TwoMasses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
const KRAUS: Kraus = Kraus { storage_ratio: 2.5, loss_ratio: 1.4, strain: 0.05, exponent: 0.6, reference: 0.05 };
const PER_TWIST: f64 = 250.0;
const AIR: f64 = 20.0;
/// Per kelvin, and the temperature that the rubber bears, °C.
const SOFTENING: f64 = 0.01;
const LIMIT: f64 = 120.0;
/// Power of the absorber per kelvin, W/K.
const CONDUCTANCE: f64 = 3e-4;
const STIFFNESS: f64 = 1000.0;
const LOSS: f64 = 0.15;

fn study_of(thermal: bool, amplitude: bool) -> Study {
    let mut s = with(MASSES, What::Twist, &[]);
    s.optimise = None;
    let law = TemperatureLaw::Exponential { per_k: SOFTENING, reference: AIR, between: (AIR, LIMIT) };
    let cooling = Cooling { air: AIR, hub: AIR, to_air: ToAir::Given(CONDUCTANCE), to_hub: 0.0, limit: LIMIT };
    let geometry = Geometry::Wedges { inner: 0.08, outer: 0.11, slope: 1.0 / PER_TWIST, count: 1.0 };
    let material = Material {
        geometry: Some(geometry),
        thermal: thermal.then_some(Thermal { law, cooling }),
        amplitude: amplitude.then_some(KRAUS),
        ..Material::default()
    };
    let rubber = WithMaterial::of((RUBBER.build)(&[MASSES.ring, STIFFNESS, LOSS]), &material.into());
    s.designs = vec![DesignSpec { name: "ring".into(), absorbers: vec![Mounted::on_station(0, Absorber::Ring(rubber))] }];
    s
}

fn every_second_speed(s: Study) -> Study {
    Study { speeds_rpm: s.speeds_rpm.iter().copied().step_by(2).collect(), ..s }
}

/// Angle of the mass under 1 N m, and twist of the ring, by formulas of two masses.
fn motion(omega: f64, celsius: f64, strain: f64) -> (f64, f64, C64) {
    let soft = (-SOFTENING * (celsius - AIR)).exp();
    let (storage, loss) = KRAUS.factors(strain);
    let stiffness = STIFFNESS * soft * C64::new(storage, LOSS * soft * loss);
    let ring = C64::from(-MASSES.ring * omega * omega);
    let own = 1e4 - omega * omega + I * omega * 2.0 * MASSES.damping_ratio * 100.0;
    let theta = 1.0 / (own + stiffness * ring / (stiffness + ring));
    (theta.norm(), (ring / (stiffness + ring) * theta).norm(), stiffness)
}

/// The lowest strain that its own twist makes at a temperature, by a fine scan and bisection.
fn own_strain(omega: f64, celsius: f64) -> f64 {
    let excess = |x: f64| x - (PER_TWIST * motion(omega, celsius, x.exp()).1).ln();
    lowest((1e-6f64.ln(), 10f64.ln()), 4000, &excess).exp()
}

/// The lowest zero of a function that is negative at first.
fn lowest((low, high): (f64, f64), n: usize, f: &dyn Fn(f64) -> f64) -> f64 {
    let at = |i: usize| low + (high - low) * i as f64 / n as f64;
    let i = (0..n).find(|i| f(at(i + 1)) > 0.0).expect("a zero");
    let (mut a, mut b) = (at(i), at(i + 1));
    for _ in 0..50 {
        let c = 0.5 * (a + b);
        if f(c) > 0.0 { b = c } else { a = c }
    }
    0.5 * (a + b)
}

/// Law: in operation, heat leaves as fast as it is made at the strain that the twist makes, both at once. Each temperature and strain of the tables is that of nested fine scans of formulas of two masses, to
/// 1e-6; the twist of the condition is the largest of theirs, and a limit between it and the twist of the reference is broken though the reference keeps it.
#[test]
fn heat_and_strain_agree_at_once() {
    let results = every_second_speed(study_of(true, true)).run().expect("damped");
    let (heat, strain) = (&results.heat[0], &results.strain[0]);
    let mut largest: f64 = 0.0;
    for (h, p) in heat.points.iter().zip(&strain.points).step_by(6) {
        let omega = h.speed_rpm * PI / 30.0;
        let missing = |celsius: f64| {
            let (_, twist, stiffness) = motion(omega, celsius, own_strain(omega, celsius));
            celsius - AIR - 0.5 * omega * stiffness.im * twist * twist / CONDUCTANCE
        };
        let celsius = lowest((AIR, LIMIT), 60, &missing);
        let expected = own_strain(omega, celsius);
        let what = format!("{} rpm", h.speed_rpm);
        assert_close(h.balances[0].celsius, celsius, 1e-6, 0.0, &what);
        assert_close(p.strains[0], expected, 1e-6, 0.0, &what);
        let twist = motion(omega, celsius, expected).0;
        assert_close(p.twist, twist, 1e-6, 0.0, &what);
        assert_close(h.twist, twist, 1e-6, 0.0, &what);
        largest = largest.max(celsius);
    }
    assert!(largest > AIR + 5.0, "it warms to {largest}");
}

/// The twist in operation is the largest of the table's, refined between its speeds; so are the objective and the verdict on a limit, which the reference alone would keep. What cools it or tells its strain alone is
/// enough to be judged so, and a ring of which neither is known is not.
#[test]
fn limits_are_judged_in_operation() {
    for (thermal, amplitude) in [(true, false), (false, true), (true, true)] {
        let mut s = study_of(thermal, amplitude);
        let free = s.run().expect("damped");
        let d = &free.designs[0];
        let [own] = d.conditions.as_slice() else { panic!("one condition") };
        assert_eq!(own.condition, Condition::InOperation);
        let (reference, twist) = (d.twist.expect("a peak").value, own.twist.expect("a peak").value);
        let table = free.strain.first().map_or_else(
            || free.heat[0].points.iter().map(|p| p.twist).fold(0.0, f64::max),
            |own| own.points.iter().map(|p| p.twist).fold(0.0, f64::max),
        );
        assert!(twist >= table && twist < 1.01 * table, "{twist} against {table}");
        assert!((twist / reference - 1.0).abs() > 0.02, "{twist} against {reference}");
        assert_eq!(d.objective, Some(twist.max(reference)));
        let limit = 0.5 * (twist + reference);
        s.limits = vec![LimitSpec { of: s.objective.clone(), words: "twist".into(), limit, rule: None }];
        let judged = &s.run().expect("damped").designs[0];
        assert_close(judged.limits[0], twist.max(reference) / limit, 1e-12, 0.0, "the worse of both");
        assert!(judged.limits[0] > 1.0);
    }
    let plain = study_of(false, false).run().expect("damped");
    assert!(plain.designs[0].conditions.is_empty() && plain.heat.is_empty() && plain.strain.is_empty());
}

/// Law: the temperature that an absorber reaches from cold is the largest of the table's over speed, refined between its speeds. Its change with each parameter is that of central differences, to 1e-5: by the
/// implicit function of the balance, by differences where the material follows its strain besides, and at its limit where it overheats, which counts as more than the limit.
#[test]
fn temperature_as_a_measure() {
    for (thermal, amplitude, cooled) in [(true, false, 1.0), (true, true, 1.0), (true, false, 0.03)] {
        let s = every_second_speed(study_of(thermal, amplitude));
        let sys = crate::support::system(&s);
        let grid = Grid::new(&s.speeds_rpm, &[]);
        let method = Method::Direct(Direct::new(&sys, &grid));
        let finder = PeakFinder::new(&sys, &grid, &method, true);
        let with = |values: &[f64]| {
            let mut material = s.designs[0].absorbers[0].absorber.law().and_then(|l| l.material()).expect("a material").clone();
            let cooling = &mut material.thermal.as_mut().expect("thermal").cooling;
            cooling.to_air = ToAir::Given(cooled * CONDUCTANCE);
            [Mounted::on_station(0, Absorber::Ring(WithMaterial::of((RUBBER.build)(values), &material.into())))]
        };
        let measure = Measure::new(vec![Quantity::RingTwist(0)], Over::Temperature);
        let peak = |values: &[f64]| finder.peak(&with(values), &measure, &mut Work::default()).expect("damped").expect("a peak");
        let values = [MASSES.ring, STIFFNESS, LOSS];
        let found = peak(&values);
        assert_eq!(found.value > LIMIT, cooled < 1.0, "{}", found.value);
        if cooled == 1.0 {
            let table = s.run().expect("damped").heat[0].points.iter().map(|p| p.balances[0].celsius).fold(0.0, f64::max);
            assert!(found.value >= table * (1.0 - 1e-9) && found.value < 1.02 * table, "{} against {table}", found.value);
        }
        let gradient = finder.gradient(&with(&values), 0, &measure, &found, &mut Work::default()).expect("damped");
        for (p, x) in values.iter().enumerate() {
            let moved = |share: f64| {
                let mut moved = values;
                moved[p] *= 1.0 + share;
                peak(&moved).value
            };
            let step = 1e-4;
            let difference = (moved(step) - moved(-step)) / (2.0 * step);
            assert_close(gradient[p] * x, difference, 1e-5, 1e-5 * found.value, &format!("{amplitude}, {cooled}, parameter {p}"));
        }
    }
}

/// A limit on temperature in a search: the best rubber of the six that stays below 78 °C lies on that limit, meets the first-order conditions to 1e-8, and is as warm as its table of heat says; without the limit
/// it is warmer and twists less.
#[test]
fn a_search_within_a_temperature() {
    let mut s = crate::support::study("villalva_i6_materials");
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(16).collect();
    (s.order_limit, s.refine_peaks) = (6.0, false);
    (s.designs, s.front) = (Vec::new(), None);
    s.conditions.clear();
    let optimise = s.optimise.as_mut().expect("optimises");
    (optimise.conditions, optimise.random_starts) = (vec![Condition::Firing], 0);
    optimise.absorbers[0].types.retain(|t| t.name == "fractional_zener");
    let measure = Measure::new(vec![Quantity::RingTwist(0)], Over::Temperature);
    let hottest = |results: &hartog::Results| {
        let points = results.heat[0].points.iter().filter_map(|p| p.balances.first());
        points.map(|b| b.celsius).fold(0.0, f64::max)
    };
    let free = s.run().expect("damped");
    let of = MeasureSpec { measure, ..s.objective.clone() };
    s.limits = vec![LimitSpec { of, words: "temperature".into(), limit: 78.0, rule: None }];
    let held = s.run().expect("damped");
    let (warm, cool) = (&free.optima[0], &held.optima[0]);
    assert!(cool.optimum.outcome.kkt_residual < 1e-8, "{:e}", cool.optimum.outcome.kkt_residual);
    assert_close(cool.design.limits[0], 1.0, 1e-6, 0.0, "on its limit");
    let reached = hottest(&held);
    assert!(reached <= 78.0 * (1.0 + 1e-6) && reached > 77.9, "{reached}");
    assert!(hottest(&free) > 78.5 && warm.optimum.value() < cool.optimum.value(), "{}", hottest(&free));
}

/// A study with a ring on measured values, from `low` to `high` Hz, under order 2 of a table alone.
fn measured((low, high): (f64, f64), material: &str) -> Result<hartog::Study, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    put("u.csv", "order,amplitude_n_m,phase_deg\n2,100,0\n");
    let station = |name: &str, more: &str| format!("[[station]]\nname = \"{name}\"\ninertia_kg_m2 = 0.05\n{more}\n");
    put(
        "engine.toml",
        &format!(
            "name = \"e\"\nstrokes = 4\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"u.csv\"\n{}{}",
            station("a", "throws = [1]\nstiffness_to_next_n_m_per_rad = 1e5\ndamping_to_next_n_m_s_per_rad = 5"),
            station("b", "")
        ),
    );
    let rows = [low, high].into_iter().flat_map(|f| [20, 60].map(|t| format!("{f},{t},{},0.2\n", 1000 - 5 * t)));
    put("ring.csv", &format!("frequency_hz,temperature_c,stiffness_n_m_per_rad,loss_factor\n{}", rows.collect::<String>()));
    let study = format!(
        "engine = \"engine.toml\"\nspeed_rpm = {{ from = 600, to = 3000, step = 600 }}\n[[design]]\nname = \"measured\"\n[[design.absorber]]\n\
        on.station = \"a\"\ntype.measured = {{ ring_inertia_kg_m2 = 0.005, file = \"ring.csv\", temperature_c = 40 }}\n{material}\n"
    );
    hartog::Study::from_toml(&study, folder.path().join("study.toml")).map_err(|e| e.to_string())
}

/// Measured values are asked for at the frequencies of the orders that the torque has, 20 to 100 Hz of order 2 here, and at no others. `cooling` is refused for what it lacks, a law of temperature, with the way to one; it was refused because
/// nothing says how `measured` follows temperature, which its table does, or because it is ideal.
#[test]
fn measured_values_have_no_balance_of_heat() {
    measured((20.0, 100.0), "").unwrap_or_else(|e| panic!("{e}"));
    let short = measured((20.5, 100.0), "").expect_err("too few");
    assert!(short.contains("expected those of the study's speeds and orders, 20.0000 to 100.0000 Hz"), "{short}");
    let cooling = "cooling = { air_c = 40, hub_c = 45, to_air.w_per_k = 5, to_hub_w_per_k = 2, limit_c = 55 }";
    for material in [
        format!("material = {{ {cooling} }}"),
        format!("material = {{ {cooling}, temperature.wlf = {{ c1 = 8.86, c2_k = 101.6, reference_c = 50 }} }}"),
    ] {
        let refused = measured((20.0, 100.0), &material).expect_err("no balance");
        assert!(refused.contains("a balance of heat needs a law of temperature") && refused.contains("`hartog fit`"), "{refused}");
        assert!(!refused.contains("ideal") && !refused.contains("expected `temperature` beside it"), "{refused}");
    }
}

/// How far a parameter may drift before a limit breaks is told of the absorber in operation, as the limit is judged there: a little less than that holds it, a little more does not.
#[test]
fn drifts_are_those_of_operation() {
    let mut s = read("in_operation");
    (s.speeds_rpm, s.order_limit, s.refine_peaks) = (s.speeds_rpm.iter().copied().step_by(13).collect(), 3.0, false);
    let limit = s.limits.remove(0);
    s.objective = limit.of.clone();
    let search = s.optimise.as_mut().expect("optimises");
    (search.in_operation, search.random_starts) = (true, 0);
    let least = optimum(&s).optimum.value();
    s.limits = vec![hartog::input::LimitSpec { limit: 1.03 * least, ..limit }];
    let found = optimum(&s);
    let (design, mut looked_at) = (found.optimum.design.clone(), 0);
    s.optimise = None;
    let evaluated = |parameter: usize, factor: f64| {
        let law = design[0].absorber.law().expect("a ring");
        let mut values = law.values();
        values[parameter] *= factor;
        let moved = vec![Mounted { absorber: Absorber::Ring(law.rebuilt(&values)), ..design[0].clone() }];
        s.evaluate("moved", moved).expect("damped").limits[0]
    };
    for drift in found.sensitivities.iter().filter(|d| d.limited) {
        // in operation the rubber follows its own motion: so do its changes, against differences four times as wide
        let change = |sign: f64| (evaluated(drift.parameter, 1.0 + sign * 4e-3) / evaluated(drift.parameter, 1.0) - 1.0) / 4e-3;
        for (told, own) in [(drift.more, change(1.0)), (drift.less, change(-1.0))] {
            assert_close(told, own, 0.1, 0.02, "relative change in operation");
        }
        for (sign, most) in [(1.0, drift.drift.0), (-1.0, drift.drift.1)] {
            let Some(most) = most.filter(|m| *m > 1e-3) else { continue };
            let (inside, beyond) =
                (evaluated(drift.parameter, 1.0 + sign * 0.99 * most), evaluated(drift.parameter, 1.0 + sign * 1.01 * most));
            assert!(inside <= 1.0 + hartog::objective::HELD && beyond > 1.0, "{} {sign}: {most} {inside} {beyond}", drift.parameter);
            looked_at += 1;
        }
    }
    assert!(looked_at > 0, "{:?}", found.sensitivities);
    beside_a_jump(found, &s.limits[0]);
}

/// A limit of which four per cent are left stands beside a jump where a thousandth of a parameter breaks it, but not where two per cent do, nor where it is used up or broken.
fn beside_a_jump(mut found: OptimumResult, limit: &LimitSpec) {
    let told = |found: &mut OptimumResult, change: f64, ratio: f64| {
        found.sensitivities.iter_mut().filter(|s| s.limited).for_each(|s| s.drift = (None, Some(change)));
        found.jump(limit, ratio).map(|jump| jump.change)
    };
    assert_eq!(told(&mut found, 0.001, 0.96), Some(-0.001));
    assert_eq!(told(&mut found, 0.02, 0.96), None);
    assert_eq!(told(&mut found, 1e-6, 0.999), None);
    assert_eq!(told(&mut found, 0.001, 1.04), None);
    // within tolerances a drift is from their edge
    found.load_cases[0].deviation = Some(hartog::absorber::Deviation { factors: Vec::new(), amounts: Vec::new() });
    found.sensitivities.iter_mut().filter(|s| s.limited).for_each(|s| s.drift = (None, Some(0.001)));
    assert!(found.jump(limit, 0.96).is_none());
}

/// Points of a front under limits are judged as optima are, in operation, too: each point, evaluated as a given design, has the value of the front and holds the limits; and none of them beats the optimum of its bounds.
#[test]
#[ignore = "half a minute"]
fn fronts_under_limits_are_those_of_operation() {
    let mut s = read("in_operation");
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(6).collect();
    let temperature = s.objective.clone();
    let twist = s.limits.remove(0).of;
    s.objective = twist.clone();
    s.limits = vec![LimitSpec { of: temperature, words: "temperature".into(), limit: 100.0, rule: None }];
    s.optimise.as_mut().expect("optimises").absorbers[0].size = hartog::input::Size::Between(0.02, 0.05);
    let rings = MeasureSpec { measure: measure(What::RingInertia), ..twist.clone() };
    s.front = Some(hartog::input::FrontSpec::Of { points: 3, measures: vec![twist, rings] });
    let mut results = s.run().expect("damped");
    let points = results.tradeoffs.remove(0).families.remove(0).1.points;
    assert!(points.len() >= 2, "{}", points.len());
    let best = results.optima[0].design.objective.expect("a value");
    (s.optimise, s.front) = (None, None);
    for p in points {
        let own = s.evaluate("point", p.design.clone()).expect("damped");
        assert!(own.within_limits(), "{:?}", own.limits);
        assert_close(p.values[0], own.objective.expect("a value"), 1e-6, 0.0, "as on the front");
        assert!(p.values[0] >= best * (1.0 - 1e-6), "{} against {best}", p.values[0]);
    }
}

/// Where a balance of heat is lost between two speeds of a search, the temperature jumps there, and an optimum that seems to hold its limit breaks it (111.9 °C for 110 at dcf1e30): a local optimum that holds all limits is then the
/// answer.
#[test]
#[ignore = "a quarter of a minute"]
fn a_jump_between_speeds_is_no_optimum() {
    let mut s = read("balance_lost");
    s.designs.truncate(1);
    let found = optimum(&s);
    assert!(found.design.within_limits(), "{:?}", found.design.limits);
}
