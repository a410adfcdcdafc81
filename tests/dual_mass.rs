//! Springs of two stages with dry friction, as in a dual-mass flywheel.

use crate::large_twist::{InTime, state};
use crate::support::{assert_close, one_throw, study, uniform_chain};
use hartog::absorber::{Absorber, Instant, Law, Mounted, TWO_STAGE};
use hartog::drivetrain::System;
use hartog::response::Work;
use hartog::response::large_twist::{Balance, Steady};
use std::f64::consts::TAU;
use std::sync::Arc;

const STIFFNESS: [f64; 2] = [700.0, 1500.0];
const FROM_DEG: f64 = 1.0;
const DAMPING: f64 = 0.6;
const RATE: f64 = 2.0;

/// On a damped mass on a spring, under so much torque of one order; with friction and a torque that is carried.
fn case(torque: f64, friction: f64, carried: f64) -> (System, Arc<dyn Law>) {
    let mut chain = uniform_chain(1, 1.0, 0.0);
    (chain.stations[0].stiffness_to_ground, chain.stations[0].damping_to_ground) = (1e4, 4.0);
    let law = (TWO_STAGE.build)(&[0.1, STIFFNESS[0], DAMPING, STIFFNESS[1], FROM_DEG, friction, RATE, carried]);
    (System::new(chain, one_throw(&[(2, torque)])), law)
}

fn steady((system, law): &(System, Arc<dyn Law>), harmonics: usize, speed: f64) -> Steady {
    let design = [Mounted::on_station(0, Absorber::Ring(law.clone()))];
    let balance = Balance::new(system, &design, &[], harmonics).expect("of large twist");
    balance.curves(&[speed], &mut Work::default()).expect("damped")[0].points[0].steady.clone()
}

/// Law: the motion that is balanced returns to itself after a cycle in time, to 1e-5 of its largest angle and 1e-4 of its largest rate (the stages leave a kink, so that harmonics of the acceleration fall with their square), and what the hub does on it
/// is what damper and friction take over that cycle, to 5e-5: in the first stage, through both, and about a carried torque at their border.
#[test]
fn stages_and_friction_equal_time() {
    for (torque, friction, carried) in [(20.0, 0.0, 0.0), (100.0, 0.5, 0.0), (100.0, 0.5, 12.0), (150.0, 1.5, 12.0)] {
        let own = case(torque, friction, carried);
        for speed in [700.0, 1000.0, 1500.0] {
            let what = format!("{torque} N m, friction {friction} N m, carrying {carried} N m at {speed} rpm");
            let found = steady(&own, 128, speed);
            let time = InTime::new(&own.0, &*own.1, 0, speed);
            let start = state(&time, &found, std::slice::from_ref(&found.hub));
            let (states, end) = time.cycle(&start, 4000);
            let half = start.len() / 2;
            for (part, tolerance) in [(0..half, 1e-5), (half..start.len(), 1e-4)] {
                let scale = states.iter().flat_map(|s| &s[part.clone()]).fold(0.0, |m: f64, x| m.max(x.abs()));
                part.for_each(|i| assert_close(end[i], start[i], 0.0, tolerance * scale, &what));
            }
            let taken = |s: &Vec<f64>| s[3] * (DAMPING * s[3] + friction * (s[3] / RATE).tanh());
            let mean = states.iter().map(taken).sum::<f64>() / states.len() as f64;
            assert_close(found.power, mean, 5e-5, 0.0, &what);
        }
    }
}

/// Source: Den Hartog, Mechanical Vibrations, section 8.10: Coulomb friction takes four times torque and amplitude a cycle, to 0.1 % where rates are 2000 times the one below which it is a damper; the springs give back
/// what they take. Closed form: a carried torque twists the springs at rest by T/k1, or by d1 + (T - k1 d1)/k2.
#[test]
fn coulomb_and_rest() {
    let (amplitude, omega) = (0.05, 80.0);
    let law = (TWO_STAGE.build)(&[0.1, STIFFNESS[0], 0.0, STIFFNESS[1], FROM_DEG, 1.5, 0.002, 3.0]);
    let equations = law.large_twist().expect("equations");
    let n = 100_000;
    let power = |j: usize| {
        let (sine, cosine) = (TAU * (j as f64 + 0.5) / f64::from(n)).sin_cos();
        let at = Instant { twist: amplitude * cosine, rate: -amplitude * omega * sine, ..Instant::default() };
        equations.reactions(&at).0.value * at.rate
    };
    let a_cycle = (0..n as usize).map(power).sum::<f64>() / f64::from(n) * TAU / omega;
    assert_close(a_cycle, 4.0 * 1.5 * amplitude, 1e-3, 0.0, "N m a cycle");
    let from = FROM_DEG.to_radians();
    for (carried, at_rest) in [(5.0, 5.0 / STIFFNESS[0]), (60.0, from + (60.0 - STIFFNESS[0] * from) / STIFFNESS[1])] {
        assert_close(steady(&case(1e-4, 0.5, carried), 16, 1000.0).mean_twist, at_rest, 1e-9, 0.0, "twist at rest");
    }
}

/// Law: where friction holds the ring fast at small twist, a design is judged by its own amplitude alone; without friction by the worse of both.
#[test]
fn judged_by_its_own_amplitude() {
    let results = study("villalva_i6_dual_mass").run().expect("damped");
    for large in &results.large_twist {
        let design = results.designs.iter().find(|d| d.name == large.design).expect("shown");
        let own = large.peak.as_ref().expect("a motion that lasts").twist;
        assert!(large.at_large_twist.alone);
        assert_close(design.objective.expect("twist"), own, 1e-12, 0.0, &large.design);
        assert!((design.twist.expect("small").value / own - 1.0).abs() > 1e-3, "{own}");
    }
    assert_eq!(results.large_twist.len(), 2);
    let (_, slippery) = case(1.0, 0.0, 0.0);
    assert!(slippery.large_twist().is_some_and(|l| l.counts_when_small()));
}
