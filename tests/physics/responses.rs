//! Response methods against each other and against a dense solution.

use crate::support::{Kind, assert_close, on, one_throw, study, system, uniform_chain};
use hartog::absorber::mounted::station_of;
use hartog::absorber::{Host, Mounted, Operating, Tuned};
use hartog::drivetrain::{Chain, Station, System, natural};
use hartog::numerics::{C64, I};
use hartog::response::{Direct, Grid, Quantity, Receptance, Response, ResponseError, Work};
use hartog::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// Index of what carries a hub among the stations and, after them, the rings.
fn hub_of(stations: usize, m: &Mounted) -> usize {
    match m.on {
        Host::Station(s) => s,
        Host::Ring(inner) => stations + inner,
    }
}

/// Angles of stations, then rings, by a dense complex LU of the whole system with the rings as bodies of their own.
fn dense(sys: &System, design: &[Mounted], order: usize, speed: f64) -> DVector<C64> {
    let n = sys.chain.len();
    let w = sys.excitation.orders[order].value() * speed * RAD_PER_S_PER_RPM;
    let mut d: DMatrix<C64> = DMatrix::zeros(n + design.len(), n + design.len());
    let link = |d: &mut DMatrix<C64>, i: usize, j: usize, s: C64| {
        d[(i, i)] += s;
        d[(j, j)] += s;
        d[(i, j)] -= s;
        d[(j, i)] -= s;
    };
    for (i, s) in sys.chain.stations.iter().enumerate() {
        d[(i, i)] += s.stiffness_to_ground + I * w * s.damping_to_ground - w * w * s.inertia;
        if i + 1 < n {
            link(&mut d, i, i + 1, s.stiffness_to_next * (1.0 + I * s.loss_factor_to_next) + I * w * s.damping_to_next);
        }
    }
    let shaft_speed = speed * RAD_PER_S_PER_RPM;
    for (r, m) in design.iter().enumerate() {
        let hub = hub_of(n, m);
        let law = m.absorber.law().expect("a ring that moves");
        link(&mut d, hub, n + r, law.dynamic_stiffness(Operating { omega: w, shaft_speed }));
        d[(n + r, n + r)] -= C64::from(w * w * law.ring_inertia());
        d[(hub, hub)] -= C64::from(w * w * m.hub_inertia);
    }
    let mut torque = DVector::zeros(n + design.len());
    sys.torque(order, speed, &mut torque.as_mut_slice()[..n]);
    d.full_piv_lu().solve(&torque).expect("regular")
}

fn check_against_dense(sys: &System, design: &[Mounted], speeds: &[f64], tolerance: f64) {
    let grid = Grid::new(speeds, &[]);
    let (direct, n) = (Direct::new(sys, &grid), sys.chain.len());
    for &speed in speeds {
        for order in 0..sys.orders() {
            let x = dense(sys, design, order, speed);
            let scale = x.iter().map(|y| y.norm()).fold(0.0, f64::max);
            let same = |q: Quantity, expected: C64| {
                let y = direct.order_at(design, q, order, speed, &mut Work::default()).expect("finite");
                assert_close((y - expected).norm(), 0.0, 0.0, tolerance * scale, &format!("{q:?} order {order} at {speed}"));
            };
            for i in 0..n {
                same(Quantity::Twist { from: i, to: None }, x[i]);
            }
            same(Quantity::Twist { from: 0, to: Some(n - 1) }, x[0] - x[n - 1]);
            for (r, m) in design.iter().enumerate() {
                same(Quantity::RingTwist(r), x[n + r] - x[hub_of(n, m)]);
            }
        }
    }
}

/// Independent method: dense LU with the rings as bodies. Rounding of ill-conditioned points allows 1e-9 of the largest angle.
#[test]
fn direct_equals_dense() {
    for name in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let sys = system(&study(name));
        let two_on_one = [on(0, Kind::Tuned, 0.01, 2e4, 5.0), Mounted { hub_inertia: 0.01, ..on(0, Kind::Viscous, 0.02, 0.0, 30.0) }];
        let apart = [on(0, Kind::Undamped, 0.02, 5e4, 0.0), on(3, Kind::Tuned, 0.005, 1e4, 1.0)];
        let one_on_the_other = [
            on(0, Kind::Viscous, 0.02, 0.0, 30.0),
            Mounted::on_ring(0, Tuned { ring_inertia: 0.01, stiffness: 2e4, damping: 5.0 }).with_hub(0.003),
            Mounted::on_ring(1, Tuned { ring_inertia: 0.004, stiffness: 9e3, damping: 1.0 }),
        ];
        for design in [&[][..], &two_on_one, &one_on_the_other, &apart, &[on(6, Kind::Viscous, 0.1, 0.0, 100.0)]] {
            check_against_dense(&sys, design, &[1000.0, 1777.0, 3050.0], 1e-9);
        }
    }
}

fn compare(sys: &System, grid: &Grid, design: &[Mounted], quantity: Quantity, tolerance: f64) -> Work {
    let receptance = Receptance::new(sys, grid, station_of(design, 0), &[quantity]);
    let (mut a, mut b, mut m) = (Vec::new(), Vec::new(), Vec::new());
    let mut work = Work::default();
    receptance.sweep(design, quantity, &mut a, &mut work).expect("finite");
    receptance.squares(design, quantity, &mut m, &mut Work::default()).expect("finite");
    Direct::new(sys, grid).sweep(design, quantity, &mut b, &mut Work::default()).expect("finite");
    let scale = b.iter().map(|y| y.norm()).fold(0.0, f64::max);
    for ((a, b), m) in a.iter().zip(&b).zip(&m) {
        assert_close((a - b).norm(), 0.0, 0.0, tolerance * scale, &format!("{quantity:?}"));
        assert_close(m.sqrt(), b.norm(), 0.0, tolerance * scale, "magnitude");
    }
    work
}

/// The two methods agree to 1e-10 of the largest amplitude, for every type, station and quantity; ring inertias over fifteen decades.
#[test]
fn receptance_equals_direct() {
    for name in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let s = study(name);
        let sys = system(&s);
        let grid = Grid::new(&s.speeds_rpm, &sys.excitation.tabulated_rpm);
        let last = s.chain.len() - 1;
        for station in [0, 3, last] {
            let quantities = [
                Quantity::Twist { from: 0, to: Some(last) },
                Quantity::Twist { from: station, to: None },
                Quantity::ShaftTorque(2),
                Quantity::RingTwist(0),
            ];
            for quantity in quantities {
                for m in [
                    on(station, Kind::Tuned, 0.03, 6e4, 15.0),
                    on(station, Kind::Viscous, 0.03, 0.0, 40.0),
                    Mounted { hub_inertia: 0.02, ..on(station, Kind::Undamped, 0.03, 6e4, 0.0) },
                    on(station, Kind::Tuned, 1e-12, 1e-6, 0.0),
                    on(station, Kind::Tuned, 1e3, 1e12, 1e6),
                    on(station, Kind::Tuned, 0.03, 0.0, 0.0),
                ] {
                    let work = compare(&sys, &grid, &[m], quantity, 1e-10);
                    assert_eq!((work.direct_solves, work.receptance_points), (0, (grid.len() * sys.orders()) as u64), "work");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    /// The same for random chains, dampings (often zero) and absorbers.
    #[test]
    fn methods_agree_on_random_chains(
        stations in prop::collection::vec((0.001..1.0f64, 1e4..1e7f64, 0.1..30.0f64), 2..9),
        at in 0usize..9, ring in 1e-4..1.0f64, k in prop_oneof![Just(0.0), 1e2..1e6f64], c in prop_oneof![Just(0.0), 0.1..1e3f64],
    ) {
        let n = stations.len();
        let chain = Chain { stations: stations.iter().enumerate().map(|(i, s)| Station {
            name: format!("s{i}"),
            inertia: s.0,
            stiffness_to_next: if i + 1 < n { s.1 } else { 0.0 },
            damping_to_ground: s.2,
            throws: if i == 1 { vec![0] } else { vec![] },
            ..Station::default()
        }).collect() };
        let sys = System::new(chain, one_throw(&[(2, 10.0), (6, 4.0), (14, 1.0)]));
        let grid = Grid::new(&[300.0, 1100.0, 5000.0, 9000.0], &[]);
        let design = [on(at % n, Kind::Tuned, ring, k, c)];
        compare(&sys, &grid, &design, Quantity::Twist { from: 0, to: Some(n - 1) }, 1e-10);
        check_against_dense(&sys, &design, &grid.speed_rpm, 1e-8);
    }
}

fn undamped_single() -> System {
    let station = Station { name: "engine".into(), inertia: 1.0, stiffness_to_ground: 1e4, throws: vec![0], ..Station::default() };
    System::new(Chain { stations: vec![station] }, one_throw(&[(2, 1.0)]))
}

/// Exactly at and next to the resonance of an undamped base, receptance gives way to the direct solve, counted, and stays right.
#[test]
fn singular_base_is_left_to_the_direct_solve() {
    let sys = undamped_single();
    let resonance = 100.0 / RAD_PER_S_PER_RPM;
    let grid = Grid::new(&[500.0, resonance * (1.0 - 1e-9), resonance, 2000.0], &[]);
    let design = [on(0, Kind::Tuned, 0.1, 800.0, 3.0)];
    let work = compare(&sys, &grid, &design, Quantity::Twist { from: 0, to: None }, 1e-10);
    assert!(work.singular_points >= 1 && work.singular_points == work.direct_solves, "{work:?}");
    check_against_dense(&sys, &design, &grid.speed_rpm, 1e-9);
}

/// Without any damping the resonance has no finite amplitude: a named error with order, speed and frequency, not an infinity.
#[test]
fn undamped_resonance_is_named() {
    let sys = undamped_single();
    let resonance = 100.0 / RAD_PER_S_PER_RPM;
    let grid = Grid::new(&[resonance], &[]);
    let error = Direct::new(&sys, &grid).order_at(&[], Quantity::Twist { from: 0, to: None }, 0, resonance, &mut Work::default());
    match error {
        Err(ResponseError::Unbounded { order, speed_rpm, frequency_hz }) => {
            assert_eq!(order.value(), 1.0);
            assert_close(speed_rpm, 954.93, 1e-5, 0.0, "speed");
            assert_close(frequency_hz, 15.9155, 1e-5, 0.0, "frequency");
        }
        // the pole may be missed by a rounding: then the amplitude is huge but finite
        Err(other) => panic!("{other}"),
        Ok(y) => assert!(y.norm() > 1e6 && y.is_finite(), "{y}"),
    }
}

/// Law: an undamped ring at its own resonance holds the hub still, and its twist balances the torque: k twist = -T.
#[test]
fn undamped_ring_holds_the_hub_still() {
    let sys = undamped_single();
    let speed = 50.0 / RAD_PER_S_PER_RPM;
    let grid = Grid::new(&[speed], &[]);
    let design = [on(0, Kind::Undamped, 0.4, 1000.0, 0.0)];
    let direct = Direct::new(&sys, &grid);
    let at = |q| direct.order_at(&design, q, 0, speed, &mut Work::default()).expect("finite");
    assert_close(at(Quantity::Twist { from: 0, to: None }).norm(), 0.0, 0.0, 1e-18, "hub");
    assert_close(at(Quantity::RingTwist(0)).re, -1.0 / 1000.0, 1e-9, 0.0, "ring");
    // the same at the foot of a chain, where a whole speed is solved at once: hub and ring carry the torque T s/(s + k) of the hub's shaft
    let mut chain = uniform_chain(3, 0.03, 1.2e6);
    (chain.stations[0].throws, chain.stations[1].throws) = (vec![], vec![0]);
    (chain.stations[0].stiffness_to_next, chain.stations[1].damping_to_ground) = (1e4, 3.0);
    let sys = System::new(chain, one_throw(&[(2, 100.0)]));
    let (speed, ring) = (1800.0, 0.7);
    let stiffness = ring * (speed * RAD_PER_S_PER_RPM).powi(2);
    for k in [stiffness, stiffness * (1.0 + 1e-15), stiffness * (1.0 - 1e-10), stiffness * (1.0 + 1e-6)] {
        let (design, grid) = ([on(0, Kind::Undamped, ring, k, 0.0)], Grid::new(&[speed], &[]));
        let mut found = Vec::new();
        Direct::new(&sys, &grid).sweep(&design, Quantity::RingTwist(0), &mut found, &mut Work::default()).expect("finite");
        let exact = dense(&sys, &design, 0, speed);
        assert_close((found[0] / (exact[3] - exact[0]) - 1.0).norm(), 0.0, 0.0, 1e-8, "a ring at its resonance");
    }
}

/// Law (reciprocity): the angle at a from a torque at b is that at b from a torque at a, absorbers included.
#[test]
fn reciprocity() {
    let response = |throw_at: usize, seen_at: usize| {
        let mut chain = uniform_chain(6, 0.02, 5e5);
        for (i, s) in chain.stations.iter_mut().enumerate() {
            s.throws = if i == throw_at { vec![0] } else { vec![] };
            s.damping_to_next = if i < 5 { 3.0 + i as f64 } else { 0.0 };
            s.loss_factor_to_next = 0.01;
        }
        let sys = System::new(chain, one_throw(&[(6, 1.0)]));
        let grid = Grid::new(&[4000.0], &[]);
        let design = [on(1, Kind::Tuned, 0.01, 1e4, 2.0), on(4, Kind::Viscous, 0.02, 0.0, 9.0)];
        Direct::new(&sys, &grid)
            .order_at(&design, Quantity::Twist { from: seen_at, to: None }, 0, 4000.0, &mut Work::default())
            .expect("damped")
    };
    assert_close((response(0, 5) / response(5, 0) - 1.0).norm(), 0.0, 0.0, 1e-11, "0 and 5");
    assert_close((response(2, 4) / response(4, 2) - 1.0).norm(), 0.0, 0.0, 1e-11, "2 and 4");
}

/// Source: [Villalva 2014] Tables 6.1 and 6.2. Viscous rows print damped frequencies: within 1 %. Tuned rows print undamped ones: within 1 Hz of
/// an undamped ring's.
#[test]
fn frequencies_with_published_absorbers() {
    let check = |name: &str, kind: Kind, ring, k, c, printed: [f64; 3], rtol, atol| {
        let s = study(name);
        let own = natural::frequencies_hz(&s.chain, &s.modes, &[on(0, kind, ring, k, c)]);
        for (f, p) in own.iter().zip(printed) {
            assert_close(*f, p, rtol, atol, name);
        }
    };
    check("villalva_v10_thesis", Kind::Viscous, 0.01, 0.0, 24.7, [373.0, 1026.0, 1625.0], 0.01, 0.0);
    check("villalva_i6_thesis", Kind::Viscous, 0.076, 0.0, 105.1, [189.0, 595.0, 1063.0], 0.01, 0.0);
    check("villalva_v10_thesis", Kind::Undamped, 0.052, 350e3, 0.0, [225.0, 625.0, 1182.0], 0.0, 1.0);
    check("villalva_v10_thesis", Kind::Undamped, 0.052, 261e3, 0.0, [219.0, 598.0, 1159.0], 0.0, 1.0);
    check("villalva_i6_thesis", Kind::Undamped, 0.076, 158e3, 0.0, [155.0, 332.0, 642.0], 0.0, 1.0);
    check("villalva_i6_thesis", Kind::Undamped, 0.076, 149e3, 0.0, [154.0, 327.0, 640.0], 0.0, 1.0);
}

/// Independent method: without damping the frequencies are those of a chain with the ring as a further station. Long chains enter by 64
/// modes, which costs the lowest frequencies less than 1e-3.
#[test]
fn frequencies_with_a_ring_equal_a_longer_chain() {
    for (n, rtol) in [(5, 1e-10), (300, 1e-3)] {
        let chain = uniform_chain(n, 0.01, 1e6);
        let mut longer = chain.clone();
        longer.stations[n - 1].stiffness_to_next = 2e5;
        longer.stations.push(Station { name: "ring".into(), inertia: 0.05, ..Station::default() });
        let modes = hartog::drivetrain::Modes::new(&chain);
        let own = natural::frequencies_hz(&chain, &modes, &[on(n - 1, Kind::Undamped, 0.05, 2e5, 0.0)]);
        for (a, b) in own.iter().zip(hartog::drivetrain::Modes::new(&longer).frequencies_hz()).take(3) {
            assert_close(*a, b, rtol, 0.0, &format!("{n} stations"));
        }
    }
}

/// A ring on a ring that is next to nothing, or stiffly or heavily held, leaves the frequencies of the rest: those without it, or with it as inertia of the inner
/// ring. Eigenvalue solvers lose the rest beside its own fast motion.
#[test]
fn frequencies_beside_a_ring_that_hardly_moves_on_its_own() {
    let s = study("villalva_i6_thesis");
    let inner = |inertia: f64| on(0, Kind::Tuned, inertia, 5.5e4, 28.0);
    let frequencies = |design: &[Mounted]| natural::frequencies_hz(&s.chain, &s.modes, design);
    for (ring, stiffness, damping) in [(1e-12, 1.0, 0.1), (1e-10, 0.0, 1.0), (0.01, 0.0, 1e8), (0.01, 1e14, 0.1)] {
        let found = frequencies(&[inner(0.05), Mounted::on_ring(0, Tuned { ring_inertia: ring, stiffness, damping })]);
        for (a, b) in frequencies(&[inner(0.05 + ring)]).iter().zip(&found) {
            assert_close(*b, *a, 1e-6, 0.0, &format!("{ring} {stiffness} {damping}"));
        }
    }
}
