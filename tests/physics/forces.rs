//! Forces in a cylinder unit: laws that hold whatever the method.

use crate::support::{assert_close, study};
use hartog::crankshaft::Crank;
use hartog::crankshaft::loads::CrankModel;
use hartog::engine::cycle::{crank_fixed, pin_angles, throw_loads};
use hartog::engine::forces::{
    Moment, UnitForces, friction_torque, gas_torque, inertia_for_growth, inertia_force_across, inertia_torque_per_omega2, newton_euler,
    traditional, unit_forces,
};
use hartog::engine::{Excitation, Geometry, RodModel, Source};
use hartog::numerics::harmonics;
use std::f64::consts::TAU;

const ENGINES: [&str; 2] = ["villalva_i6_thesis", "villalva_v10_thesis"];

fn geometry(name: &str) -> Geometry {
    let Source::Cylinder { geometry, .. } = study(name).engine.source else { unreachable!("cylinders") };
    geometry
}

/// The rod as a rigid body, its inertia as a multiple of that of two masses.
fn body(g: &Geometry, multiple: f64) -> Geometry {
    Geometry { rod: RodModel::Body { centre_from_big_end: g.rod_centre(), inertia: multiple * g.two_mass_inertia() }, ..g.clone() }
}

/// Moments over a revolution, under pressure and at speed.
fn moments() -> impl Iterator<Item = Moment> {
    (0..96).map(|j| Moment { pressure: 1e5 + 6e6 * f64::from(j % 7), theta: TAU * f64::from(j) / 96.0 + 0.01, omega: 700.0 })
}

fn parts(f: &UnitForces) -> [f64; 6] {
    [f.small_end[0], f.small_end[1], f.big_end[0], f.big_end[1], f.liner, f.torque]
}

/// Law: a rod whose inertia is m a b is two masses in its eyes: both methods give the same forces, to 1e-12 of the largest.
#[test]
fn methods_agree_for_a_rod_of_two_masses() {
    for name in ENGINES {
        let g = geometry(name);
        for at in moments() {
            let (a, b) = (parts(&traditional(&g, at)), parts(&newton_euler(&body(&g, 1.0), at)));
            let scale = a.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (a, b) in a.iter().zip(&b) {
                assert_close(*b, *a, 0.0, 1e-12 * scale, &format!("{name} at {}", at.theta));
            }
        }
    }
}

/// Law: more inertia of the rod leaves the forces along the cylinder alone and moves those across it by dI beta''/(L cos beta).
#[test]
fn inertia_of_the_rod_acts_across_the_cylinder() {
    for name in ENGINES {
        let g = geometry(name);
        let more = 0.7 * g.two_mass_inertia();
        for at in moments() {
            let (a, b) = (newton_euler(&body(&g, 1.0), at), newton_euler(&body(&g, 1.7), at));
            let lean = g.slider_crank.lean(at.theta);
            let change = more * lean.curvature * at.omega * at.omega / (g.slider_crank.rod_length * lean.angle.cos());
            let scale = parts(&a).iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            assert_close(b.big_end[0], a.big_end[0], 0.0, 1e-12 * scale, "along");
            assert_close(a.big_end[1] - b.big_end[1], change, 0.0, 1e-12 * scale, "across");
            assert_close(a.liner - b.liner, change, 0.0, 1e-12 * scale, "liner");
        }
    }
}

/// Laws: Newton's for piston and rod, with accelerations by differences of positions (six points, 0.02 rad: 1e-11), moments about the crankshaft's axis;
/// and the torque is the virtual work of gas and masses. All to 1e-9 of the largest force.
#[test]
fn forces_balance_on_every_body() {
    for name in ENGINES {
        for multiple in [1.0, 1.4] {
            let g = body(&geometry(name), multiple);
            let (r, l, a) = (g.slider_crank.crank_radius, g.slider_crank.rod_length, g.rod_centre());
            let inertia = g.two_mass_inertia() + g.excess_inertia();
            let beta = |t: f64| (r / l * t.sin()).asin();
            let pin = |t: f64| [r * t.cos(), r * t.sin()];
            let piston = |t: f64| r * t.cos() + l * beta(t).cos();
            let centre = |t: f64| [pin(t)[0] + a * beta(t).cos(), pin(t)[1] - a * beta(t).sin()];
            for at in moments() {
                let second = |f: &dyn Fn(f64) -> f64| {
                    let (h, t) = (0.02, at.theta);
                    let pair = |k: f64| f(t + k * h) + f(t - k * h);
                    at.omega * at.omega * (270.0 * pair(1.0) - 27.0 * pair(2.0) + 2.0 * pair(3.0) - 490.0 * f(t)) / (180.0 * h * h)
                };
                let f = newton_euler(&g, at);
                let gas = (at.pressure - g.crankcase_pressure) * g.piston_area();
                let scale = 1e-9 * parts(&f)[..5].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                let zero = |x: f64, what: &str| assert_close(x, 0.0, 0.0, scale, &format!("{name}, {what} at {}", at.theta));
                zero(g.piston_mass * second(&piston) - f.small_end[0] + gas, "piston along");
                zero(f.small_end[1] + f.liner, "piston across");
                let acceleration = [second(&|t| centre(t)[0]), second(&|t| centre(t)[1])];
                zero(g.rod_mass * acceleration[0] + f.big_end[0] + f.small_end[0], "rod along");
                zero(g.rod_mass * acceleration[1] + f.big_end[1] + f.small_end[1], "rod across");
                // moments about the crankshaft's axis: the rod leans backwards
                let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
                let momentum = g.rod_mass * cross(centre(at.theta), acceleration) - inertia * second(&beta);
                let moment = cross([piston(at.theta), 0.0], f.small_end) + cross(pin(at.theta), f.big_end);
                assert_close(momentum, -moment, 0.0, scale * l, "moment of the rod");
                assert_close(f.torque, cross(pin(at.theta), f.big_end), 0.0, scale * r, "torque");
                let work = gas_torque(&g, at.pressure, at.theta) + at.omega * at.omega * inertia_torque_per_omega2(&g, at.theta);
                assert_close(f.torque, work, 0.0, scale * r, "virtual work");
            }
        }
    }
}

/// Law: in line and in a V the torque of a throw over the cycle is that of the orders the chain is excited with, and equals what the pin force does on
/// the pin's path, rigid rods included.
#[test]
fn throws_do_the_work_of_their_pins() {
    for name in ENGINES {
        let mut engine = study(name).engine;
        let Source::Cylinder { geometry, .. } = &mut engine.source else { unreachable!("cylinders") };
        *geometry = body(geometry, 1.4);
        let r = geometry.slider_crank.crank_radius;
        let speed = 2600.0;
        let loads = throw_loads(&engine, speed).expect("cylinders");
        let e = Excitation::new(&engine, 12.0);
        for throw in 0..e.throws() {
            let (torque, force) = (&loads.torque[throw], &loads.pin_force()[throw]);
            let scale = torque.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (n, c) in harmonics::analyse(torque, &e.harmonics).iter().enumerate() {
                assert!((e.throw_torque(throw, n, speed) - c).norm() < 1e-9 * scale, "{name}, throw {throw}, order {}", e.orders[n]);
            }
            // the pin stands along a cylinder when that fires
            let bank = engine.layout.bank_angle_deg.unwrap_or(0.0);
            let firing = engine.layout.firing_on_throw(throw);
            let forward = firing.len() < 2 || ((firing[1] - firing[0] - bank).rem_euclid(360.0) + 1e-6).rem_euclid(360.0) < 1e-3;
            let half = if forward { -0.5 * bank } else { 0.5 * bank };
            for j in (0..torque.len()).step_by(97) {
                let at = (360.0 * f64::from(engine.strokes) / 2.0 * j as f64 / torque.len() as f64 - firing[0] + half).to_radians();
                let work = r * (at.cos() * force[j][1] - at.sin() * force[j][0]);
                assert_close(work, torque[j], 0.0, 1e-9 * scale, &format!("{name}, throw {throw}, sample {j}"));
            }
        }
    }
}

/// Source: [Villalva 2014] pp. 60 and 63: doubling the inertia of the rod, not printed, raises the inertia force across an in-line cylinder by about 35 %.
/// That holds at 1.33 (V10) and 1.45 (six) times m a b.
#[test]
fn inertia_behind_the_dissertations_35_per_cent() {
    for name in ENGINES {
        let g = geometry(name);
        let multiple = inertia_for_growth(&g, 0.35).expect("a multiple");
        assert!((1.3..1.5).contains(&multiple), "{name}: {multiple}");
        let unit = g.two_mass_inertia();
        let ratio = inertia_force_across(&g, 2.0 * multiple * unit) / inertia_force_across(&g, multiple * unit);
        assert_close(ratio, 1.35, 1e-6, 0.0, name);
    }
}

/// Laws of liner friction, for both rods: it is mu times the normal force and acts against the motion; piston and crank stay in balance; the torque lost is the power of
/// friction, and never drives. To 1e-9 of the largest force.
#[test]
fn friction_of_the_liner_only_takes() {
    for name in ENGINES {
        for rod in [geometry(name), body(&geometry(name), 1.3)] {
            let rubbing = Geometry { liner_friction: 0.08, ..rod.clone() };
            for at in moments() {
                let (with, without) = (unit_forces(&rubbing, at), unit_forces(&rod, at));
                let motion = rod.slider_crank.motion(at.theta);
                let scale = parts(&with).iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                assert_close(with.friction.abs(), 0.08 * with.liner.abs(), 0.0, 1e-9 * scale, "Coulomb");
                // motion is travel towards the crankshaft: friction pushes away from it, along x
                assert!(with.friction * motion.slope >= 0.0, "against the motion");
                let piston = with.small_end[0] + with.friction - without.small_end[0];
                assert_close(piston, 0.0, 0.0, 1e-9 * scale, "the piston moves as before");
                let lost = -with.friction * motion.slope;
                assert_close(with.torque - without.torque, lost, 0.0, 1e-9 * scale, "virtual work");
                assert!(friction_torque(&rubbing, at) <= 1e-9 * scale);
            }
            assert_eq!(friction_torque(&rod, moments().next().expect("a moment")), 0.0);
        }
    }
}

/// Friction lowers the mean torque of the engine, and nothing else enters the excitation at the tabulated speeds.
#[test]
fn friction_lowers_the_mean_torque() {
    let mut engine = study("villalva_i6_thesis").engine;
    let before = Excitation::new(&engine, 6.0);
    if let Source::Cylinder { geometry, .. } = &mut engine.source {
        geometry.liner_friction = 0.05;
    }
    let after = Excitation::new(&engine, 6.0);
    for (a, b) in after.audit.iter().zip(&before.audit) {
        assert!(a.mean_torque < b.mean_torque && a.mean_torque > 0.9 * b.mean_torque, "{} against {}", a.mean_torque, b.mean_torque);
    }
}

/// Laws of the main bearings: together they bear what acts on the throws, at every angle, in line and in a V, counterweights or not; a force turned into axes of the crank
/// keeps its size, and what turns with the crank is constant there.
#[test]
fn bearings_bear_what_acts_on_the_throws() {
    for name in ENGINES {
        let s = study(name);
        let crank = Crank { unbalance: -0.02, ..s.crank.clone().expect("a crank") };
        let model = CrankModel::new(&s.engine, &crank).expect("cylinders");
        let plain = CrankModel::new(&s.engine, s.crank.as_ref().expect("a crank")).expect("cylinders");
        let (loads, without) = (model.at(2900.0), plain.at(2900.0));
        let angles = pin_angles(&s.engine);
        let omega = 2900.0 * TAU / 60.0;
        for j in (0..loads.theta.len()).step_by(97) {
            let bearings = loads.bearing_forces(j);
            for axis in 0..2 {
                let on: f64 = bearings.iter().map(|b| b[axis]).sum();
                let acting: f64 = (0..crank.throws()).map(|t| loads.on_throw(t, j)[axis]).sum();
                assert_close(on, acting, 0.0, 1e-9 * 1e5, "balance");
            }
            for (throw, angle) in angles.iter().enumerate() {
                let (a, b) = (loads.on_throw(throw, j), without.on_throw(throw, j));
                let turned = crank_fixed([a[0] - b[0], a[1] - b[1]], loads.theta[j] + angle);
                assert_close(turned[0], -0.02 * omega * omega, 1e-9, 1e-6, "the counterweight, outwards");
                assert_close(turned[1], 0.0, 0.0, 1e-6, "not across");
                let f = crank_fixed(a, 0.7);
                assert_close(f[0].hypot(f[1]), a[0].hypot(a[1]), 1e-12, 0.0, "size");
            }
        }
    }
}

/// Virtual work: the tangential force on a crankpin, in axes of the crank, times its radius is the torque of the throw, at every angle, in line and in a V.
#[test]
fn tangential_force_is_torque() {
    for name in ENGINES {
        let s = study(name);
        let radius = geometry(name).slider_crank.crank_radius;
        let loads = throw_loads(&s.engine, 2500.0).expect("cylinders");
        let angles = pin_angles(&s.engine);
        for (throw, (forces, torque)) in loads.pin_force().iter().zip(&loads.torque).enumerate() {
            let scale = torque.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
            for j in (0..forces.len()).step_by(37) {
                let [_, tangential] = crank_fixed(forces[j], loads.theta[j] + angles[throw]);
                assert_close(tangential * radius, torque[j], 0.0, 1e-9 * scale, "torque");
            }
        }
    }
}

/// Law: Lagrange's equation of a cylinder whose inertia is J + m r² sin² phi, with a small vibration put in. Independent: the whole nonlinear torque, its derivative by the
/// size of the vibration by differences, analysed into orders: n + 2, n - 2, and n itself with the mean inertia.
#[test]
fn variable_inertia_couples_orders() {
    use hartog::engine::varying_inertia::secondary_torque;
    let (rest, dm, speed) = (0.03, 0.01, 200.0_f64);
    for order in [3.0, 4.5, 6.0] {
        // of I phi'' + I' phi'²/2 at crank angle a = Omega t, with theta = size cos(n a) about it
        let torque = |a: f64, size: f64| {
            let (angle, n) = (a + size * (order * a).cos(), order * speed);
            let (rate, acceleration) = (speed - size * n * (order * a).sin(), -size * n * n * (order * a).cos());
            let inertia = rest + dm * angle.sin().powi(2);
            inertia * acceleration + dm * angle.sin() * angle.cos() * rate * rate
        };
        let (points, size) = (2880, 1e-4);
        let component = |of: f64| {
            let sum: f64 = (0..points)
                .map(|j| {
                    let a = 2.0 * std::f64::consts::TAU * f64::from(j) / f64::from(points);
                    (torque(a, size) - torque(a, -size)) / (2.0 * size) * (of * a).cos()
                })
                .sum();
            2.0 * sum / f64::from(points)
        };
        let scale = 0.5 * dm * speed * speed * order * order;
        for (up, of) in [(true, order + 2.0), (false, order - 2.0)] {
            assert_close(component(of), secondary_torque(0.5 * dm, speed, order, up), 0.0, 1e-5 * scale, &format!("order {order} to {of}"));
        }
        assert_close(component(order), -(rest + 0.5 * dm) * (order * speed).powi(2), 1e-5, 0.0, "the mean inertia");
    }
}
