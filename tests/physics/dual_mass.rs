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
/// what they take. Closed form: a carried torque twists the springs at rest by T/k1, or by d1 + (T - k1 d1)/k2, the ring lagging behind its hub.
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
        assert_close(steady(&case(1e-4, 0.5, carried), 16, 1000.0).mean_twist, -at_rest, 1e-9, 0.0, "twist at rest");
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

/// A secondary mass that drives a load of 100 N m behind an engine of two stations: orders of the torque with amplitude and phase in degrees.
const ORDERS: [(f64, f64, f64); 4] = [(0.5, 60.0, 20.0), (1.0, 150.0, 0.0), (1.5, 90.0, 70.0), (2.5, 40.0, 10.0)];

/// Half peak-to-peak twist of the shaft and largest twist of the springs, degrees, by Runge and Kutta's method from rest until the motion repeats itself. Written with absolute angles: the engine gives 100 N m more to its
/// first mass, the load takes them from the ring, and springs push the ring forward where it lags behind its hub.
fn integrated(speed_rpm: f64) -> [f64; 2] {
    let (load, speed) = (100.0, speed_rpm * TAU / 60.0);
    let spring = |d: f64| d.signum() * (3e3 * d.abs().min(1f64.to_radians()) + 12e3 * (d.abs() - 1f64.to_radians()).max(0.0));
    let rates = |t: f64, x: &[f64; 6]| {
        let torque: f64 = ORDERS.iter().map(|(n, a, phase)| a * (n * speed * t + phase.to_radians()).cos()).sum();
        let shaft = 2e5 * (x[0] - x[1]) + 8.0 * (x[3] - x[4]);
        let (lag, rate) = (x[1] - x[2], x[4] - x[5]);
        let forward = spring(lag) + 2.0 * rate + 8.0 * (rate / 0.5).tanh();
        [x[3], x[4], x[5], (load + torque - shaft - 20.0 * x[3]) / 0.3, (shaft - forward - 5.0 * x[4]) / 0.5, (forward - load) / 0.2]
    };
    let cycle = 2.0 * TAU / speed;
    let (steps, cycles) = (1000, 40);
    let dt = cycle / f64::from(steps);
    let mut x = [0.0; 6];
    let (mut twist, mut ring) = ((f64::INFINITY, f64::NEG_INFINITY), 0.0f64);
    for j in 0..steps * cycles {
        let t = f64::from(j) * dt;
        let moved = |by: f64, k: &[f64; 6]| -> [f64; 6] { std::array::from_fn(|i| x[i] + by * k[i]) };
        let k1 = rates(t, &x);
        let k2 = rates(t + 0.5 * dt, &moved(0.5 * dt, &k1));
        let k3 = rates(t + 0.5 * dt, &moved(0.5 * dt, &k2));
        let k4 = rates(t + dt, &moved(dt, &k3));
        x = std::array::from_fn(|i| x[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        if j >= steps * (cycles - 1) {
            twist = (twist.0.min(x[0] - x[1]), twist.1.max(x[0] - x[1]));
            ring = ring.max((x[2] - x[1]).abs());
        }
    }
    [0.5 * (twist.1 - twist.0).to_degrees(), ring.to_degrees()]
}

/// Law: a ring that drives a load lags behind its hub, and the springs push it forward. The twist of the shaft and that of the springs are those of an integration in time of the equations of all three masses, written here from
/// Newton's law with the load on the ring, to 1e-3 (that of the balance is 1e-4): where the ring drove the engine, the twist would be 15 % larger at 2000 rpm. Torque that is the same with all signs turned makes a difference, so that
/// the sign is told.
#[test]
fn the_ring_lags_behind_its_hub() {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    let rows: Vec<String> = ORDERS.iter().map(|(n, a, phase)| format!("{n},{a},{phase}")).collect();
    put("u.csv", &format!("order,amplitude_n_m,phase_deg\n{}\n", rows.join("\n")));
    put(
        "engine.toml",
        "name = \"e\"\nstrokes = 4\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"u.csv\"\n\
        [[station]]\nname = \"a\"\nthrows = [1]\ninertia_kg_m2 = 0.3\nstiffness_to_next_n_m_per_rad = 2e5\ndamping_to_next_n_m_s_per_rad = 8\n\
        damping_to_ground_n_m_s_per_rad = 20\n[[station]]\nname = \"b\"\ninertia_kg_m2 = 0.5\ndamping_to_ground_n_m_s_per_rad = 5\n",
    );
    let study = "engine = \"engine.toml\"\nspeed_rpm = { from = 1400, to = 2000, step = 600 }\norder_limit = 12\nresponse.tolerance = 1e-4\n\
        [[objective]]\npeak_twist = { from = \"a\", to = \"b\" }\n[[design]]\nname = \"soft\"\n[[design.absorber]]\non.station = \"b\"\n\
        type.two_stage = { ring_inertia_kg_m2 = 0.2, stiffness_n_m_per_rad = 3000, damping_n_m_s_per_rad = 2, second_stiffness_n_m_per_rad = 12000, \
        second_stage_from_deg = 1.0, friction_n_m = 8, friction_rate_rad_per_s = 0.5, carried_torque_n_m = 100 }\n";
    let results = hartog::Study::from_toml(study, folder.path().join("study.toml")).map(|s| s.run()).expect("read").expect("damped");
    for speed in [1400.0, 2000.0] {
        let found = results.large_twist[0].curves.iter().flatten().find(|p| p.asked && p.speed_rpm == speed).expect("a motion");
        let [twist, ring] = integrated(speed);
        assert_close(found.twist.to_degrees(), twist, 1e-3, 0.0, &format!("twist at {speed} rpm"));
        assert_close(found.ring_twist.to_degrees(), ring, 1e-3, 0.0, &format!("twist of the springs at {speed} rpm"));
    }
}
