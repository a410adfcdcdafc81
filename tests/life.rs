//! Life of rubber by cycles of its strain.

use crate::support::{assert_close, study, system};
use hartog::absorber::StrainLife;
use hartog::analysis::LifeOverDuty;
use hartog::input::Study;
use hartog::numerics::C64;
use hartog::numerics::rainflow::amplitudes;
use hartog::response::{Direct, Grid, Quantity, Response, Work};
use std::f64::consts::TAU;

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
