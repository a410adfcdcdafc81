//! Life of rubber by cycles of its strain.

use crate::measures::with_finder;
use crate::support::{assert_close, study, system, variant};
use hartog::absorber::{Absorber, Factors, Host, Mounted, State, StrainLife, TUNED, WithMaterial};
use hartog::analysis::LifeOverDuty;
use hartog::input::Study;
use hartog::numerics::C64;
use hartog::numerics::rainflow::amplitudes;
use hartog::objective::{Measure, Over};
use hartog::response::{Direct, Grid, Quantity, Response, Work};
use std::f64::consts::TAU;
use std::sync::Arc;

fn sorted(mut list: Vec<f64>) -> Vec<f64> {
    list.sort_by(f64::total_cmp);
    list
}

/// Source: ASTM E1049, the history of its example of rainflow counting, repeated: ranges 3, 4, 7 and 9.
#[test]
fn rainflow_of_the_standard() {
    let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0];
    assert_eq!(sorted(amplitudes(&history)), [1.5, 2.0, 3.5, 4.5]);
    // where a history begins does not matter
    for shift in 0..history.len() {
        let mut moved = history;
        moved.rotate_left(shift);
        assert_eq!(sorted(amplitudes(&moved)), [1.5, 2.0, 3.5, 4.5], "{shift}");
    }
    assert!(amplitudes(&[]).is_empty());
}

/// Ranges of a repeated history by the definition of what is inside: of four turning points in a row the inner two are a cycle where the outer two hold them; another way to the same counts.
fn by_four_points(history: &[f64]) -> Vec<f64> {
    let top = (0..history.len()).fold(0, |m, i| if history[i] > history[m] { i } else { m });
    let mut left: Vec<f64> = history.iter().cycle().skip(top).take(history.len() + 1).copied().collect();
    let mut list = Vec::new();
    while let Some(i) = (0..left.len().saturating_sub(3)).find(|i| {
        let (outer, inner) = ((left[*i], left[i + 3]), (left[i + 1], left[i + 2]));
        outer.0.min(outer.1) <= inner.0.min(inner.1) && outer.0.max(outer.1) >= inner.0.max(inner.1)
    }) {
        list.push(0.5 * (left[i + 1] - left[i + 2]).abs());
        left.drain(i + 1..i + 3);
    }
    // what is left rises and falls less and less from the largest value to the smallest, and back
    list.push(0.5 * (left.iter().copied().fold(f64::MIN, f64::max) - left.iter().copied().fold(f64::MAX, f64::min)));
    list
}

/// Turning points of the twist of the first ring over a working cycle: the highest of parabolas through samples.
fn turning_points(s: &Study, speed_rpm: f64) -> Vec<f64> {
    let (sys, grid) = (system(s), Grid::new(&[speed_rpm], &[]));
    let direct = Direct::new(&sys, &grid);
    let mut y = Vec::new();
    direct.sweep(&s.designs[0].absorbers, Quantity::RingTwist(0), &mut y, &mut Work::default()).expect("damped");
    let n = 20_000;
    let at = |j: usize| -> f64 {
        let psi = TAU * (j % n) as f64 / n as f64;
        sys.excitation.harmonics.iter().zip(&y).map(|(h, y)| (y * C64::from_polar(1.0, f64::from(*h) * psi)).re).sum()
    };
    let f: Vec<f64> = (0..n).map(at).collect();
    let turn = |j: usize| {
        let (a, b, c) = (f[(j + n - 1) % n], f[j], f[(j + 1) % n]);
        ((b - a) * (c - b) <= 0.0 && a != b).then(|| b - (c - a).powi(2) / (8.0 * (a - 2.0 * b + c)))
    };
    (0..n).filter_map(turn).collect()
}

/// The shipped ring of rubber: cycles of the twist of all orders, sampled 20000 times a working cycle and counted by four points, give the life by Miner's rule to 1e-6; ten times the strain that it bears gives
/// a million times the life of exponent 6.
#[test]
fn life_of_a_ring() {
    let mut s = study("villalva_i6_laws");
    s.designs.retain(|d| d.name == "rubber_payne");
    s.duty.iter_mut().for_each(|p| p.load_fraction = 1.0);
    let results = s.run().expect("damped");
    let life: &LifeOverDuty = &results.duty[0].lives[0];
    let material = s.designs[0].absorbers[0].absorber.law().and_then(|l| l.material()).expect("a material").clone();
    let (law, per_twist): (StrainLife, f64) = (material.life.expect("life"), material.geometry.expect("a sleeve").strain_per_twist());
    let mut damage = 0.0;
    for p in &life.points {
        let point = p.point;
        let turns = turning_points(&s, point.speed_rpm);
        let counted = by_four_points(&turns);
        let an_hour: f64 = counted.iter().map(|a| law.damage(per_twist * a)).sum::<f64>() * 60.0 * point.speed_rpm / 2.0;
        assert_close(p.damage_per_h, an_hour, 1e-6, 0.0, "damage an hour");
        assert_close(p.cycles_per_h, counted.len() as f64 * 60.0 * point.speed_rpm / 2.0, 1e-12, 0.0, "cycles an hour");
        damage += point.share * an_hour;
    }
    assert_close(life.hours(), 1.0 / damage, 1e-6, 0.0, "life");
    assert!(life.hours() > 100.0 && life.hours() < 1e6, "{}", life.hours());
    let stronger = StrainLife { strain: 10.0 * law.strain, ..law };
    assert_close(law.damage(0.03) / stronger.damage(0.03), 1e6, 1e-9, 0.0, "exponent");
}

/// A design with parameters of its first absorber times factors.
fn times(design: &[Mounted], index: usize, factors: &[f64]) -> Vec<Mounted> {
    let mut moved = design.to_vec();
    let law = moved[index].absorber.law().expect("a ring").clone();
    let values: Vec<f64> = law.values().iter().zip(factors).map(|(v, f)| v * f).collect();
    moved[index].absorber = Absorber::Ring(law.rebuilt(&values));
    moved
}

/// Law: the least twist of a ring that lasts lies on the limit of its life, and none of 25 stiffnesses from a quarter to twelve times its own, and of 15 within a tenth of it, that last as long has less;
/// stress of springs is ring twist times what the study says.
#[test]
fn a_ring_that_lasts() {
    let folder = tempfile::tempdir().expect("folder");
    let stress = "[[constraint]]\nspring_stress = { absorber = 1, mpa_per_deg = 180, max_mpa = 2000 }\n\n[optimise]\n";
    let path = variant(folder.path(), "villalva_i6_life", &[("[optimise]\n", stress)]);
    let mut s = hartog::input::read(&path).expect("a study");
    (s.speeds_rpm, s.refine_peaks) = (s.speeds_rpm.iter().copied().step_by(4).collect(), false);
    s.optimise.as_mut().expect("optimises").prove.effort.boxes = 0;
    let results = s.run().expect("damped");
    let found = &results.optima[0];
    let [life, springs] = found.design.limits[..] else { panic!("two limits") };
    assert_close(life, 1.0, 1e-6, 0.0, "the limit is active");
    let hours = results.duty.iter().find(|d| d.design == found.design.name).expect("over the duty").lives[0].hours();
    assert_close(hours, 2000.0, 1e-6, 0.0, "life");
    assert_close(2000.0 * springs, 180.0 * found.design.ring_twist.expect("a ring").to_degrees(), 1e-9, 0.0, "MPa");
    let least = found.design.objective.expect("twist");
    let mut lasting = 0;
    let far = (0..25).map(|i| 0.25 * 48f64.powf(f64::from(i) / 24.0));
    for factor in far.chain((-7..=7).map(|i| 1.0 + f64::from(i) / 70.0)) {
        let other = s.evaluate("other", times(&found.optimum.design, 0, &[1.0, factor, 1.0])).expect("damped");
        if other.limits[0] <= 1.0 {
            lasting += 1;
            assert!(other.objective.expect("twist") > least * (1.0 - 1e-9), "{factor}");
        }
    }
    assert!((5..35).contains(&lasting), "{lasting}");
}

/// Law: the damage of an hour grows with each parameter as central differences say, to the square of their steps; a state of the material has the same cycles of strain, of a motion of its own.
#[test]
fn damage_by_parameters() {
    let mut s = study("villalva_i6_life");
    s.optimise.as_mut().expect("optimises").prove.effort.boxes = 0;
    let family = s.run().expect("damped").optima[0].optimum.design.clone();
    let hub = Mounted { on: Host::Station(3), hub_inertia: 0.0, absorber: Absorber::Ring((TUNED.build)(&[0.03, 4e4, 15.0])) };
    let design = vec![family[0].clone(), hub];
    let measure = Measure::new(vec![Quantity::RingTwist(0), Quantity::RingTwist(1)], Over::Damage);
    with_finder(&s, |finder| {
        let value = |d: &[Mounted]| finder.peak(d, &measure, &mut Work::default()).expect("damped").expect("sheared");
        let peak = value(&design);
        for index in 0..2 {
            let gradient = finder.gradient(&design, index, &measure, &peak, &mut Work::default()).expect("damped");
            let values = design[index].absorber.law().expect("a ring").values();
            for (p, x) in values.iter().enumerate() {
                let moved = |share: f64| {
                    let mut factors = vec![1.0; values.len()];
                    factors[p] += share;
                    value(&times(&design, index, &factors)).value
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                assert_close(gradient[p] * x, difference, 1e-6, 1e-8 * peak.value, &format!("{index}, {p}"));
            }
        }
        // no material says how long the other ring lasts
        let other = Measure::new(vec![Quantity::RingTwist(1)], Over::Damage);
        assert!(finder.peak(&design, &other, &mut Work::default()).expect("damped").is_none());
        // half as stiff when hot: as long as a ring that is half as stiff
        let law = design[0].absorber.law().expect("rubber");
        let mut material = law.material().expect("said").clone();
        material.states = vec![Factors { state: State::Hot, factors: vec![1.0, 0.5, 1.0] }];
        let own = WithMaterial::of((law.declaration().build)(&law.values()), &Arc::new(material));
        let mut hot = design.clone();
        hot[0].absorber = Absorber::Ring(own.in_state(State::Hot).expect("a state"));
        assert_close(value(&hot).value, value(&times(&design, 0, &[1.0, 0.5, 1.0])).value, 1e-12, 0.0, "hot");
    });
}
