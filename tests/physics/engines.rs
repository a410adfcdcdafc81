//! Engine: kinematics, pressure, orders, layout.

use crate::support::{assert_close, study};
use hartog::engine::cycle::throw_loads;
use hartog::engine::pressure::{sample_angle, samples};
use hartog::engine::{Excitation, Geometry, Kinematics, Order, Pressure, SliderCrank, Source};
use hartog::numerics::{C64, harmonics};
use hartog::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};
use std::f64::consts::{PI, TAU};

fn crank(ratio: f64, kinematics: Kinematics) -> SliderCrank {
    SliderCrank { crank_radius: 0.05, rod_length: 0.05 / ratio, kinematics }
}

/// Law: slope and curvature are the derivatives of the travel. Central differences with step 1e-4 err by about 1e-9.
#[test]
fn derivatives_of_the_travel() {
    for kinematics in [Kinematics::Exact, Kinematics::Truncated] {
        for deg in [0.0f64, 17.0, 90.0, 133.0, 180.0, 301.0] {
            let (t, h) = (deg * RAD_PER_DEG, 1e-4);
            let c = crank(0.32, kinematics);
            let (before, here, after) = (c.motion(t - h), c.motion(t), c.motion(t + h));
            assert_close((after.travel - before.travel) / (2.0 * h), here.slope, 1e-7, 1e-10, "slope");
            assert_close((after.slope - before.slope) / (2.0 * h), here.curvature, 1e-7, 1e-10, "curvature");
        }
    }
}

/// Geometry: the piston travels a stroke between dead centres; L sin(beta) = r sin(theta) closes the triangle.
#[test]
fn exact_kinematics_closes_the_triangle() {
    let c = crank(0.3, Kinematics::Exact);
    assert_close(c.motion(PI).travel, 2.0 * c.crank_radius, 1e-14, 0.0, "stroke");
    for deg in [10.0f64, 75.0, 200.0] {
        let t = deg * RAD_PER_DEG;
        let height = c.crank_radius + c.rod_length - c.motion(t).travel;
        let (x, y) = (c.crank_radius * t.cos(), c.crank_radius * t.sin());
        assert_close((height - x).hypot(y), c.rod_length, 1e-14, 0.0, "rod length");
    }
}

/// Source: [Villalva 2014] eqs. (3.63) to (3.65) drop terms of relative order (r/L)³: eight times less at half the ratio.
#[test]
fn truncated_series_errs_with_the_cube_of_the_rod_ratio() {
    let error = |ratio: f64| {
        let worst =
            |t: f64| (crank(ratio, Kinematics::Exact).motion(t).travel - crank(ratio, Kinematics::Truncated).motion(t).travel).abs();
        (0..360).map(|d| worst(f64::from(d) * RAD_PER_DEG)).fold(0.0, f64::max)
    };
    assert_close(error(0.2) / error(0.1), 8.0, 0.1, 0.0, "ratio of errors");
}

fn parts(name: &str) -> (Geometry, Pressure, u32, usize) {
    let study = study(name);
    let n = study.engine.layout.firing_deg.len();
    match study.engine.source {
        Source::Cylinder { geometry, pressure } => (geometry, pressure, study.engine.strokes, n),
        Source::Harmonics(_) => unreachable!("the shipped engines have cylinders"),
    }
}

/// Net work of a trace over the displaced volume, by the trapezoidal rule on pressure and volume: independent of the torque.
fn mean_pressure(trace: &[f64], g: &Geometry) -> f64 {
    let volume = |j: usize| g.piston_area() * g.slider_crank.motion(sample_angle(j)).travel;
    let n = trace.len();
    (0..n).map(|j| 0.5 * (trace[j] + trace[(j + 1) % n]) * (volume((j + 1) % n) - volume(j))).sum::<f64>() / g.displacement()
}

/// Law: both cycles have the area they were asked for. The Otto cycle jumps at the dead centres, where a sample cuts the corner by about
/// (0.1°)² of the pressure.
#[test]
fn cycles_have_the_mean_pressure_asked_for() {
    let (g, pressure, strokes, n) = parts("villalva_v10_thesis");
    let Pressure::Otto(otto) = &pressure else { unreachable!("Otto") };
    let wanted = otto.pressure_scale * otto.brake_mean_pressure(6, &g, strokes, n);
    // 530 N m x 4 pi over ten times 0.5266 dm³: [Villalva 2014] Figure 3.12
    assert_close(otto.brake_mean_pressure(6, &g, strokes, n), 530.0 * 4.0 * PI / (10.0 * 0.526_59e-3), 1e-4, 0.0, "brake mean pressure");
    assert_close(mean_pressure(&pressure.trace(6, &g, strokes, n), &g), wanted, 2e-4, 0.0, "Otto");
    let (g, pressure, strokes, n) = parts("villalva_i6_thesis");
    assert_close(mean_pressure(&pressure.trace(0, &g, strokes, n), &g), 17e5, 1e-5, 0.0, "Wiebe");
}

/// Law: closed expansion is isentropic: p V^k is constant after the burn (Wiebe) and after dead centre (Otto).
#[test]
fn expansion_is_isentropic() {
    for (name, k) in [("villalva_i6_thesis", 1.35), ("villalva_v10_thesis", 1.4)] {
        let (g, pressure, strokes, n) = parts(name);
        let trace = pressure.trace(0, &g, strokes, n);
        let ratio = if name == "villalva_i6_thesis" { 17.3 } else { 12.5 };
        let clearance = 2.0 * g.slider_crank.crank_radius / (ratio - 1.0);
        let invariant = |deg: usize| trace[10 * deg] * (clearance + g.slider_crank.motion(sample_angle(10 * deg)).travel).powf(k);
        assert_close(invariant(170), invariant(80), 1e-12, 0.0, name);
    }
}

/// Law: order zero of the torque delivers the indicated work; the moving masses deliver none.
#[test]
fn mean_torque_is_indicated_work() {
    let study = study("villalva_i6_thesis");
    let e = Excitation::new(&study.engine, 12.0);
    let (g, ..) = parts("villalva_i6_thesis");
    for audit in &e.audit {
        assert_close(audit.mean_torque * 4.0 * PI, audit.indicated_mean_pressure * g.displacement() * 6.0, 1e-12, 0.0, "work");
        assert_close(audit.indicated_mean_pressure, 17e5, 1e-9, 0.0, "indicated mean pressure");
    }
    let n = samples(4);
    let work: f64 = (0..n).map(|j| hartog::engine::forces::inertia_torque_per_omega2(&g, sample_angle(j))).sum();
    assert_close(work / n as f64, 0.0, 0.0, 1e-12 * g.oscillating_mass(), "work of the masses");
}

/// Source: the leading inertia torque of a slider-crank is m r² w² (lambda/4 sin t - sin 2t/2 - 3 lambda/4 sin 3t): truncated series, to second
/// order in lambda.
#[test]
fn inertia_orders_match_the_classic_series() {
    let study = study("villalva_v10_thesis");
    let mut engine = study.engine.clone();
    let Source::Cylinder { geometry, .. } = &mut engine.source else { unreachable!("cylinders") };
    geometry.slider_crank.kinematics = Kinematics::Truncated;
    let (m, r) = (geometry.oscillating_mass(), geometry.slider_crank.crank_radius);
    let lambda = r / geometry.slider_crank.rod_length;
    let e = Excitation::new(&engine, 4.0);
    // the difference between two speeds of the same table value leaves the masses alone
    let inertia = |order: usize| {
        let w = |rpm: f64| rpm * RAD_PER_S_PER_RPM;
        let at = |rpm| e.unit_torque(order, rpm);
        // 1000 and 2000 rpm are tabulated; gas is removed by the value at a massless engine
        let mut massless = engine.clone();
        let Source::Cylinder { geometry, .. } = &mut massless.source else { unreachable!("cylinders") };
        (geometry.piston_mass, geometry.rod_mass) = (0.0, 0.0);
        let gas = Excitation::new(&massless, 4.0);
        (at(2000.0) - gas.unit_torque(order, 2000.0)) / (w(2000.0) * w(2000.0))
    };
    let unit = m * r * r;
    // sin n t has the phasor -i
    for (order, expected) in [(1, lambda / 4.0), (3, -0.5), (5, -0.75 * lambda)] {
        let c = inertia(order);
        assert_close(c.im, -expected * unit, 0.0, 1e-9 * unit, "inertia torque");
        assert_close(c.re, 0.0, 0.0, 1e-9 * unit, "no cosine");
    }
}

/// Law: between tabulated speeds gas phasors are linear and inertia torque goes with the square of the speed.
#[test]
fn torque_between_tabulated_speeds() {
    let study = study("villalva_v10_thesis");
    let e = Excitation::new(&study.engine, 12.0);
    let mut massless = study.engine.clone();
    let Source::Cylinder { geometry, .. } = &mut massless.source else { unreachable!("cylinders") };
    (geometry.piston_mass, geometry.rod_mass) = (0.0, 0.0);
    let gas = Excitation::new(&massless, 12.0);
    for order in 0..24 {
        let mean = (gas.unit_torque(order, 3000.0) + gas.unit_torque(order, 4000.0)) * 0.5;
        assert_close((gas.unit_torque(order, 3500.0) - mean).norm(), 0.0, 0.0, 1e-9, "gas");
        let inertia = |rpm: f64| (e.unit_torque(order, rpm) - gas.unit_torque(order, rpm)) / (rpm * rpm);
        assert_close((inertia(3500.0) - inertia(3000.0)).norm() * 3500.0 * 3500.0, 0.0, 0.0, 1e-9, "inertia");
    }
}

/// Law: evenly firing engines push the whole crank only with multiples of half the number of cylinders; the other orders cancel.
#[test]
fn firing_phases_of_the_six() {
    let e = Excitation::new(&study("villalva_i6_thesis").engine, 12.0);
    for (n, order) in e.orders.iter().enumerate() {
        let sum: C64 = (0..6).map(|t| e.phase(t, n)).sum();
        let expected = if order.value() % 3.0 == 0.0 { 6.0 } else { 0.0 };
        assert_close(sum.norm(), expected, 0.0, 1e-12, &format!("order {order}"));
    }
}

/// The V10 fires twice on each crankpin, 90° or 450° apart, at 0, 90, 144, 234 ... degrees [Villalva 2014] section 3.4.1; its throws follow
/// each other 144° apart in the order 1-5-2-3-4.
#[test]
fn firing_phases_of_the_v10() {
    let layout = study("villalva_v10_thesis").engine.layout;
    assert_eq!(layout.misplaced_throw(), None);
    let sequence: Vec<f64> = [0, 4, 1, 2, 3].iter().map(|t| layout.firing_on_throw(*t)[0]).collect();
    assert_eq!(sequence, [0.0, 144.0, 288.0, 432.0, 576.0]);
    let e = Excitation::new(&study("villalva_v10_thesis").engine, 12.0);
    for (n, order) in e.orders.iter().enumerate() {
        // two units 90° apart: 2 cos(n 45°)
        assert_close(e.phase(0, n).norm(), 2.0 * (order.value() * PI / 4.0).cos().abs(), 0.0, 1e-12, &format!("order {order}"));
    }
}

/// Orders: half ones for four strokes, whole ones for two; 4.5 is exact.
#[test]
fn orders_of_two_and_four_strokes() {
    assert_eq!(Order::up_to(2.0, 4).len(), 4);
    assert_eq!(Order::up_to(2.0, 2).iter().map(|o| o.value()).collect::<Vec<_>>(), [1.0, 2.0]);
    assert_eq!(Order::from_twice(9).to_string(), "4.5");
    assert_eq!((Order::from_twice(9).per_cycle(4), Order::from_twice(6).per_cycle(2)), (9, 3));
}

/// A measured trace sampled from a model gives the model's orders, with or without the closing angle, from any first angle. Linear
/// interpolation at 0.5° costs about 1e-4.
#[test]
fn measured_trace_reproduces_the_cycle_it_was_taken_from() {
    use hartog::engine::pressure::Measured;
    let study = study("villalva_i6_thesis");
    let (g, pressure, strokes, n) = parts("villalva_i6_thesis");
    let trace = pressure.trace(0, &g, strokes, n);
    let modelled = Excitation::new(&study.engine, 12.0);
    for (first, closing) in [(0, true), (-3600, false)] {
        let count = if closing { 1441 } else { 1440 };
        let index = |i: usize| (first + 5 * i as i64).rem_euclid(7200) as usize;
        let measured = Measured {
            speeds_rpm: vec![1000.0],
            crank_deg: (0..count).map(|i| (first + 5 * i as i64) as f64 * 0.1).collect(),
            pressure: vec![(0..count).map(|i| trace[index(i)]).collect()],
            part_load: Vec::new(),
        };
        let mut engine = study.engine.clone();
        engine.source = Source::Cylinder { geometry: g.clone(), pressure: Pressure::Measured(measured) };
        let e = Excitation::new(&engine, 12.0);
        for order in 0..24 {
            let (a, b) = (e.unit_torque(order, 1000.0), modelled.unit_torque(order, 1000.0));
            assert_close((a - b).norm(), 0.0, 0.0, 1e-4 * 500.0, "order");
        }
    }
}

/// Finer sampling than 0.1° changes no order by more than the promised 1e-5 of the largest.
#[test]
fn sampling_is_fine_enough() {
    let (g, pressure, strokes, n) = parts("villalva_v10_thesis");
    let trace = pressure.trace(6, &g, strokes, n);
    let torque = |every: usize| -> Vec<C64> {
        let picked: Vec<f64> =
            (0..trace.len()).step_by(every).map(|j| hartog::engine::forces::gas_torque(&g, trace[j], sample_angle(j))).collect();
        hartog::numerics::harmonics::analyse(&picked, &(1..=24).collect::<Vec<u32>>())
    };
    let (fine, coarse) = (torque(1), torque(2));
    let largest = fine.iter().map(|c| c.norm()).fold(0.0, f64::max);
    for (a, b) in fine.iter().zip(&coarse) {
        // the trapezoidal rule converges with the square of the step: the error at 0.1° is a third of this difference
        assert_close((a - b).norm() / 3.0, 0.0, 0.0, 1e-5 * largest, "order");
    }
    assert_close(TAU * 2.0, samples(4) as f64 * sample_angle(1), 1e-12, 0.0, "a cycle");
}

/// Independent: the torque of every throw in time has the order amplitudes of the excitation, between tabulated speeds too, and order zero of
/// the audit; in dead centre the rod's force is gas less oscillating mass less rotating mass.
#[test]
fn loads_over_the_cycle() {
    for (name, speed) in [("villalva_i6_thesis", 1600.0), ("villalva_v10_thesis", 7400.0)] {
        let s = study(name);
        let e = Excitation::new(&s.engine, 12.0);
        let loads = throw_loads(&s.engine, speed).expect("a cylinder");
        for (throw, torque) in loads.torque.iter().enumerate() {
            let scale = torque.iter().copied().fold(0.0, f64::max);
            for (n, c) in harmonics::analyse(torque, &e.harmonics).iter().enumerate() {
                assert!((e.throw_torque(throw, n, speed) - c).norm() < 1e-9 * scale, "{name} throw {throw} order {}", e.orders[n]);
            }
        }
        // every throw of an engine of equal cylinders is loaded alike
        let compression = |row: &Vec<[f64; 2]>| row.iter().map(|f| -f[0]).fold(0.0, f64::max);
        for row in &loads.pin_force() {
            assert_close(compression(row), compression(&loads.pin_force()[0]), 1e-9, 0.0, name);
        }
    }
    let s = study("villalva_i6_thesis");
    let Source::Cylinder { geometry, pressure } = &s.engine.source else { panic!("a cylinder") };
    let (r, l) = (geometry.slider_crank.crank_radius, geometry.slider_crank.rod_length);
    let omega = 3200.0 * RAD_PER_S_PER_RPM;
    let gas = (pressure.trace(1, geometry, 4, 6)[0] - geometry.crankcase_pressure) * geometry.piston_area();
    let oscillating = geometry.oscillating_mass() * r * omega * omega * (1.0 + r / l);
    let rotating = geometry.rod_rotating_fraction() * geometry.rod_mass * r * omega * omega;
    let loads = throw_loads(&s.engine, 3200.0).expect("a cylinder");
    assert_close(-loads.pin_force()[0][0][0], gas - oscillating - rotating, 1e-12, 0.0, "dead centre");
}
