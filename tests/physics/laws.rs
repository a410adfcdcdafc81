//! What every declared type of absorber obeys, whatever its law: a new type is held to all of it without a line here.

use crate::support::{assert_close, one_throw, study, system, uniform_chain};
use hartog::absorber::closed_forms::EngineMode;
use hartog::absorber::{Absorber, Declaration, Follows, Host, Mounted, Operating, Range, Surroundings, TYPES};
use hartog::drivetrain::System;
use hartog::input::Study;
use hartog::numerics::{C64, I, ZERO};
use hartog::objective::{Measure, Over, PeakFinder};
use hartog::response::{Dense, Direct, Grid, JointReceptance, Method, Quantity, Receptance, Response, Work};
use hartog::units::RAD_PER_S_PER_RPM;

/// The shipped types, and that of an example: a law that depends on the speed.
fn every_law() -> impl Iterator<Item = &'static Declaration> {
    TYPES.into_iter().chain([&crate::examples::own_law::MAGNETIC])
}

/// Those whose S is not that of another type at small twist.
fn laws_of_small_twist() -> impl Iterator<Item = &'static Declaration> {
    every_law().filter(|d| (d.build)(&vec![1.0; d.parameters.len()]).large_twist().is_none())
}

const SPEEDS: [f64; 4] = [800.0, 1500.0, 2290.0, 3100.0];

/// A type with typical values for a ring of the in-line six, the first of them its ring inertia; `detuned` moves the others.
fn typical(s: &Study, declaration: &'static Declaration, ring_inertia: f64, detuned: f64) -> Vec<f64> {
    let modes = [EngineMode { inertia: s.modes.equivalent_inertia(1, 0), omega: s.modes.omega[1] }];
    let surroundings = Surroundings { modes: &modes, ring_inertia };
    let value = |p: &hartog::absorber::Parameter| {
        // half the typical damping: a ring whose own resonance is seen
        let x = (p.typical)(&surroundings) * if p.dissipative { 0.5 } else { detuned };
        match p.range {
            Range::Within(low, high) => x.clamp(low, high),
            Range::Above(least) => x.max(least + 0.1),
            Range::Positive | Range::NotNegative => x,
        }
    };
    let mut values: Vec<f64> = declaration.parameters.iter().map(value).collect();
    values[0] = ring_inertia;
    values
}

fn build(declaration: &Declaration, values: &[f64], on: Host) -> Mounted {
    Mounted { on, hub_inertia: 0.0, absorber: Absorber::Ring((declaration.build)(values)) }
}

fn sweep(sys: &System, design: &[Mounted], quantity: Quantity) -> Vec<C64> {
    let (grid, mut out) = (Grid::new(&SPEEDS, &[]), Vec::new());
    Direct::new(sys, &grid).sweep(design, quantity, &mut out, &mut Work::default()).expect("damped");
    out
}

#[track_caller]
fn same(a: &[C64], b: &[C64], tolerance: f64, what: &str) {
    let scale = a.iter().map(|y| y.norm()).fold(0.0, f64::max);
    let worst = a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(worst <= tolerance * scale, "{what}: off by {:e}", worst / scale);
}

/// What is built has the values it was built from, the ring inertia first; the derivatives of S are those of central differences (1e-6 of S); S is passive; a
/// constant spring and damper, where the law says it has them, give S at any point, and a law that depends on the speed says so.
#[test]
fn every_declaration_is_consistent() {
    let s = study("villalva_i6_thesis");
    for declaration in every_law() {
        let values = typical(&s, declaration, 0.03, 1.1);
        let law = (declaration.build)(&values);
        assert_eq!(law.values(), values, "{}", declaration.name);
        assert_eq!((law.ring_inertia(), law.declaration()), (values[0], declaration));
        for omega in [150.0, 900.0, 4000.0] {
            for shaft_speed in [90.0, 260.0] {
                let at = Operating { omega, shaft_speed };
                let stiffness = law.dynamic_stiffness(at);
                assert!(stiffness.im >= 0.0, "{}: not passive", declaration.name);
                if let Some(constant) = law.spring_and_damper() {
                    assert_eq!(constant.dynamic_stiffness(omega), stiffness);
                }
                let other = law.dynamic_stiffness(Operating { shaft_speed: 1.5 * shaft_speed, ..at });
                assert_eq!(other != stiffness, law.depends_on_speed(), "{}", declaration.name);
                let derivatives = law.derivatives(at);
                assert_eq!(derivatives.len(), values.len());
                for (i, derivative) in derivatives.iter().enumerate() {
                    let with = |factor: f64| {
                        let mut v = values.clone();
                        v[i] *= factor;
                        (declaration.build)(&v).dynamic_stiffness(at)
                    };
                    let difference = (with(1.0 + 1e-6) - with(1.0 - 1e-6)) / (2e-6 * values[i]);
                    let scale = stiffness.norm() / values[i];
                    assert!(
                        (difference - derivative).norm() <= 1e-6 * scale,
                        "{} parameter {i}: {difference} {derivative}",
                        declaration.name
                    );
                }
            }
        }
        for form in declaration.closed_forms {
            let mode = EngineMode { inertia: 1.0, omega: 100.0 };
            let values = (form.values)(0.1, mode);
            assert_eq!((values.len(), values[0]), (declaration.parameters.len(), 0.1), "{}", form.name);
        }
    }
}

/// A ring of no inertia changes nothing; a stiff law adds the ring to its hub; hub inertia is inertia of the station; energy in is energy dissipated.
#[test]
fn limits_of_every_law() {
    let s = study("villalva_i6_thesis");
    let sys = system(&s);
    let heavier = |by: f64| {
        let mut chain = s.chain.clone();
        chain.stations[0].inertia += by;
        System::new(chain, sys.excitation.clone())
    };
    for declaration in every_law() {
        let name = declaration.name;
        let mut values = typical(&s, declaration, 0.03, 1.0);
        values[0] = 1e-12;
        let light = build(declaration, &values, Host::Station(0));
        // a housing is an inertia of its own
        let housing = |m: &Mounted| m.absorber.law().map_or(0.0, |law| law.hub_inertia());
        same(&sweep(&heavier(housing(&light)), &[], s.twist), &sweep(&sys, &[light], s.twist), 1e-9, name);
        // springs, and dampers that grow with the ring, by 10⁸: the law is all but a rigid link
        let mut values = typical(&s, declaration, 0.05, 1.0);
        for (v, p) in values.iter_mut().zip(declaration.parameters).skip(1) {
            let grows =
                p.extensive || ["relaxed_modulus_mpa", "viscosity_pa_s", "youngs_modulus_gpa", "shear_modulus_gpa"].contains(&p.key);
            *v *= if grows { 1e8 } else { 1.0 };
        }
        let stiff = build(declaration, &values, Host::Station(0));
        same(&sweep(&heavier(0.05 + housing(&stiff)), &[], s.twist), &sweep(&sys, &[stiff], s.twist), 1e-4, name);
        let plain = build(declaration, &typical(&s, declaration, 0.03, 1.0), Host::Station(0));
        same(
            &sweep(&heavier(0.02), std::slice::from_ref(&plain), s.twist),
            &sweep(&sys, &[plain.clone().with_hub(0.02)], s.twist),
            1e-11,
            name,
        );
        energy(&s, &sys, std::slice::from_ref(&plain), name);
        for outer in laws_of_small_twist() {
            let on_it = build(outer, &typical(&s, outer, 0.01, 1.3), Host::Ring(0));
            energy(&s, &sys, &[plain.clone(), on_it], &format!("{} on the ring of {name}", outer.name));
        }
    }
}

/// The mean power of the torques is what the dampers to ground and the absorbers take, to 1e-9.
fn energy(s: &Study, sys: &System, design: &[Mounted], what: &str) {
    let speed = 1777.0;
    let grid = Grid::new(&[speed], &[]);
    let direct = Direct::new(sys, &grid);
    let taken_by = |r: usize| direct.dissipated_power(design, r, speed, &mut Work::default()).expect("damped");
    let (mut put_in, mut taken) = (0.0, (0..design.len()).map(taken_by).sum::<f64>());
    let mut torque = vec![ZERO; s.chain.len()];
    for n in 0..sys.orders() {
        sys.torque(n, speed, &mut torque);
        let omega = sys.excitation.orders[n].value() * speed * RAD_PER_S_PER_RPM;
        for (i, station) in s.chain.stations.iter().enumerate() {
            let theta = direct.order_at(design, Quantity::Twist { from: i, to: None }, n, speed, &mut Work::default()).expect("damped");
            put_in += 0.5 * (torque[i] * (I * omega * theta).conj()).re;
            taken += 0.5 * station.damping_to_ground * omega * omega * theta.norm_sqr();
        }
    }
    assert_close(put_in, taken, 1e-9, 0.0, what);
}

/// Every type alone and every pair of types, side by side on two stations, on one, and one on the ring of the other: direct, receptance and dense solutions agree to
/// 1e-9, and gradients with respect to every parameter are those of central differences of the peak.
#[test]
fn methods_and_gradients_of_pairs() {
    let s = study("villalva_i6_thesis");
    let sys = system(&s);
    for (i, a) in laws_of_small_twist().enumerate() {
        check_methods(&s, &sys, &[(a, Host::Station(0))]);
        check_gradients(&s, &sys, &[(a, Host::Station(0))]);
        // each pair in one arrangement, each law in all of them
        for (j, b) in laws_of_small_twist().enumerate() {
            let on = [Host::Station(0), Host::Station(3), Host::Ring(0)][(i + j) % 3];
            check_methods(&s, &sys, &[(a, Host::Station(0)), (b, on)]);
            let on = [Host::Station(3), Host::Ring(0)][(i + j) % 2];
            check_gradients(&s, &sys, &[(a, Host::Station(0)), (b, on)]);
        }
    }
}

type Places = [(&'static Declaration, Host)];

fn values_of(s: &Study, places: &Places) -> Vec<Vec<f64>> {
    places.iter().enumerate().map(|(i, (d, _))| typical(s, d, 0.03 / (1 + i) as f64, 1.0 + 0.3 * i as f64)).collect()
}

fn design_of(places: &Places, values: &[Vec<f64>]) -> Vec<Mounted> {
    places.iter().zip(values).map(|((d, on), v)| build(d, v, *on)).collect()
}

fn words(places: &Places) -> String {
    places.iter().map(|(d, on)| format!("{} on {on:?}", d.name)).collect::<Vec<_>>().join(", ")
}

fn check_methods(s: &Study, sys: &System, places: &Places) {
    let design = design_of(places, &values_of(s, places));
    let grid = Grid::new(&SPEEDS, &[]);
    let stations: Vec<usize> = if places.iter().any(|p| p.1 == Host::Station(3)) { vec![0, 3] } else { vec![0] };
    for quantity in [s.twist, Quantity::RingTwist(design.len() - 1), Quantity::ShaftTorque(2)] {
        let expected = sweep(sys, &design, quantity);
        let joint = JointReceptance::new(sys, &grid, &stations, &[quantity]);
        let single = Receptance::new(sys, &grid, 0, &[quantity]);
        let dense = Dense::new(sys, &grid);
        for method in [&joint as &dyn Response, &single, &dense] {
            let mut found = Vec::new();
            method.sweep(&design, quantity, &mut found, &mut Work::default()).expect("damped");
            same(&expected, &found, 1e-9, &format!("{}: {quantity:?} by {}", words(places), method.name()));
        }
    }
}

fn check_gradients(s: &Study, sys: &System, places: &Places) {
    let grid = Grid::new(&s.speeds_rpm.iter().copied().step_by(4).collect::<Vec<_>>(), &sys.excitation.tabulated_rpm);
    let method = Method::Direct(Direct::new(sys, &grid));
    let finder = PeakFinder::new(sys, &grid, &method, true);
    let measure = Measure::new(vec![s.twist], Over::Synthesis);
    let values = values_of(s, places);
    let design = design_of(places, &values);
    let peak = finder.peak(&design, &measure, &mut Work::default()).expect("damped").expect("excited");
    for (i, (declaration, _)) in places.iter().enumerate() {
        let at = |speed_rpm: f64| {
            let place = hartog::objective::Peak { speed_rpm, ..peak };
            finder.gradient(&design, i, &measure, &place, &mut Work::default()).expect("damped")
        };
        // the speed of a peak is known to the root of rounding, which a narrow one multiplies
        let (gradient, beside) = (at(peak.speed_rpm), at(peak.speed_rpm * (1.0 + f64::EPSILON.sqrt())));
        assert_eq!(gradient.len(), declaration.parameters.len());
        for (p, parameter) in declaration.parameters.iter().enumerate() {
            let with = |factor: f64| {
                let mut v = values.clone();
                v[i][p] *= factor;
                finder.peak(&design_of(places, &v), &measure, &mut Work::default()).expect("damped").expect("excited").value
            };
            let difference = (with(1.0 + 1e-6) - with(1.0 - 1e-6)) / (2e-6 * values[i][p]);
            let what = format!("{}: absorber {i}, {}", words(places), parameter.key);
            let unknown = (beside[p] - gradient[p]).abs();
            assert!(
                unknown <= 1e-3 * gradient[p].abs() + 1e-5 * peak.value / values[i][p],
                "{what}: {} known to {unknown:e} only",
                gradient[p]
            );
            assert_close(gradient[p], difference, 1e-4, 1e-5 * peak.value / values[i][p] + unknown, &what);
        }
    }
}

/// No resonance hides between the speeds of a study, whatever the law of the ring: on the six with a hundredth of its damping, steps of 40 rpm, each type at a third, once and three times its typical
/// values, with all its losses, a tenth and a hundredth of them. The refined peak is not below a sweep in steps of half a rpm (1e-9 for rounding), and is the response at
/// its speed.
#[test]
fn no_resonance_hides_between_speeds() {
    let s = study("villalva_i6_thesis");
    let mut chain = s.chain.clone();
    chain.stations.iter_mut().for_each(|station| {
        station.damping_to_ground *= 0.01;
        station.damping_to_next *= 0.01;
    });
    let sys = System::new(chain, system(&s).excitation);
    let (first, last) = (s.speeds_rpm[0], s.speeds_rpm[s.speeds_rpm.len() - 1]);
    let speeds = |step: f64| (0..=((last - first) / step) as usize).map(|i| first + step * i as f64).collect::<Vec<_>>();
    let (coarse, fine) = (Grid::new(&speeds(40.0), &sys.excitation.tabulated_rpm), Grid::new(&speeds(0.5), &[]));
    let method = Method::Receptance(Receptance::new(&sys, &coarse, 0, &[s.twist]));
    let finder = PeakFinder::new(&sys, &coarse, &method, true);
    let scan = Method::Receptance(Receptance::new(&sys, &fine, 0, &[s.twist]));
    let scanned = PeakFinder::new(&sys, &fine, &scan, false);
    let measure = Measure::new(vec![s.twist], Over::Synthesis);
    let mut narrow = 0;
    for declaration in laws_of_small_twist() {
        for (detuned, loss) in [(0.3, 1.0), (0.3, 0.01), (1.0, 0.1), (1.0, 0.01), (3.0, 0.1), (3.0, 0.01)] {
            let mut values = typical(&s, declaration, 0.05, detuned);
            values.iter_mut().zip(declaration.parameters).filter(|(_, p)| p.dissipative).for_each(|(v, _)| *v *= loss);
            let design = [Mounted::on_station(0, Absorber::Ring((declaration.build)(&values)))];
            let peak = |finder: &PeakFinder| finder.peak(&design, &measure, &mut Work::default()).expect("damped").expect("excited");
            let (found, least) = (peak(&finder), peak(&scanned));
            let what = format!("{} of {values:?}: {found:?} against {least:?}", declaration.name);
            assert!(found.value >= least.value * (1.0 - 1e-9), "{what}");
            let there = Grid::new(&[found.speed_rpm], &[]);
            let mut phasors = Vec::new();
            Direct::new(&sys, &there).sweep(&design, s.twist, &mut phasors, &mut Work::default()).expect("damped");
            assert_close(found.value, finder.synthesis(&phasors)[0], 1e-9, 0.0, &what);
            narrow += usize::from(coarse.speed_rpm.iter().all(|speed| (speed - found.speed_rpm).abs() > 1.0));
        }
    }
    assert!(narrow > 20, "{narrow} of the peaks lie between speeds");
}

/// The same of a ring in the middle of a mirrored chain, where every second motion has a node: what moves there by rounding alone must not hide the others. Steps of 400 rpm against a sweep in steps of 2 rpm.
#[test]
fn no_resonance_hides_behind_a_node() {
    let s = study("villalva_i6_thesis");
    let mut chain = uniform_chain(7, 0.1, 1e6);
    chain.stations.iter_mut().filter(|station| station.stiffness_to_next > 0.0).for_each(|station| station.damping_to_next = 0.3);
    let sys = System::new(chain, one_throw(&[(2, 100.0)]));
    let speeds = |step: usize| (9000..57_000).step_by(step).map(|i| i as f64).collect::<Vec<_>>();
    let (coarse, fine) = (Grid::new(&speeds(400), &[]), Grid::new(&speeds(2), &[]));
    let twist = Quantity::Twist { from: 0, to: Some(6) };
    let method = Method::Receptance(Receptance::new(&sys, &coarse, 3, &[twist]));
    let finder = PeakFinder::new(&sys, &coarse, &method, true);
    let scan = Method::Receptance(Receptance::new(&sys, &fine, 3, &[twist]));
    let scanned = PeakFinder::new(&sys, &fine, &scan, false);
    let measure = Measure::new(vec![twist], Over::Synthesis);
    for declaration in laws_of_small_twist() {
        for (ring, detuned) in [2e-5, 1e-3, 0.02].into_iter().flat_map(|ring| [0.3, 0.8, 1.0, 2.0, 3.0].map(|detuned| (ring, detuned))) {
            let mut values = typical(&s, declaration, ring, detuned);
            values.iter_mut().zip(declaration.parameters).filter(|(_, p)| p.dissipative).for_each(|(v, _)| *v *= 0.01);
            let design = [Mounted::on_station(3, Absorber::Ring((declaration.build)(&values)))];
            let peak = |finder: &PeakFinder| finder.peak(&design, &measure, &mut Work::default()).expect("damped").expect("excited");
            let (found, least) = (peak(&finder), peak(&scanned));
            assert!(found.value >= least.value * (1.0 - 1e-9), "{} of {values:?}: {found:?} against {least:?}", declaration.name);
        }
    }
}

/// A law that tells S by the factor of temperature tells the same as the law whose parameters follow by that factor, to 1e-13.
#[test]
fn factors_of_temperature() {
    let s = study("villalva_i6_thesis");
    let points: Vec<Operating> = (1..40)
        .map(|i| Operating { omega: 60.0 * f64::from(i), shaft_speed: 120.0 })
        .chain([Operating { omega: 0.0, shaft_speed: 120.0 }])
        .collect();
    let mut told = 0;
    for declaration in every_law() {
        let values = typical(&s, declaration, 0.05, 0.8);
        let law = (declaration.build)(&values);
        let Some(each) = law.followed_each(&points) else { continue };
        told += 1;
        for factor in [1e-3, 0.3, 1.0, 7.0, 1e4] {
            let follow = |(p, v): (&hartog::absorber::Parameter, &f64)| match p.follows {
                Follows::Nothing => *v,
                Follows::Factor => v * factor,
                Follows::Inverse => v / factor,
            };
            let followed = law.rebuilt(&declaration.parameters.iter().zip(&values).map(follow).collect::<Vec<_>>());
            let [mut re, mut im, mut below] = [(); 3].map(|()| vec![0.0; points.len()]);
            each(f64::ln(factor), [&mut re, &mut im, &mut below]);
            for (i, at) in points.iter().enumerate() {
                let found = C64::new(re[i], im[i]) / below[i];
                let expected = followed.dynamic_stiffness(*at);
                assert!((found - expected).norm() <= 1e-13 * expected.norm(), "{} at {at:?}: {found} against {expected}", declaration.name);
            }
        }
    }
    assert!(told >= 2, "{told}");
}

/// Laws compute many points several at a time by functions of their own: as they do one by one, to some units of the last place (of the larger of stiffness and damping, whose powers have exponents of up to
/// twenty), at frequencies and relaxation times far beyond any engine's.
#[test]
fn laws_are_the_same_several_points_at_a_time() {
    let s = study("villalva_i6_thesis");
    for declaration in every_law() {
        let law = (declaration.build)(&typical(&s, declaration, 0.05, 0.8));
        for count in [1, 7, 8, 9, 300] {
            let at = |i: usize| 1e-4 * 1e12_f64.powf(i as f64 / count as f64);
            let points: Vec<Operating> = (0..count).map(|i| Operating { omega: at(i), shaft_speed: 100.0 }).collect();
            let mut found = vec![ZERO; count];
            law.dynamic_stiffness_each(&points, &mut found);
            for (found, at) in found.iter().zip(&points) {
                let expected = law.dynamic_stiffness(*at);
                assert!((found - expected).norm() <= 1e-14 * expected.norm(), "{} at {at:?}: {found} against {expected}", declaration.name);
            }
        }
    }
}

/// A law that says that it is an analytic function of the frequency's logarithm is computed at a few frequencies by the tables, and by polynomials at all others: sweeps of a whole grid by receptances
/// are those of the direct solution, which asks the law itself, to 1e-11, from a tenth to ten times its typical values. Laws with kinks or of shaft speed do not say so.
#[test]
fn tables_compute_laws_at_a_few_frequencies() {
    let s = study("villalva_i6_thesis");
    let sys = system(&s);
    let speeds: Vec<f64> = (0..131).map(|i| 600.0 + 20.0 * f64::from(i)).collect();
    let grid = Grid::new(&speeds, &[]);
    let receptance = Receptance::new(&sys, &grid, s.hub, &[s.twist]);
    let direct = Direct::new(&sys, &grid);
    let mut analytic = 0;
    for declaration in every_law() {
        for factor in [0.1, 1.0, 10.0] {
            let m = build(declaration, &typical(&s, declaration, 0.05, factor), Host::Station(s.hub));
            let law = m.absorber.law().expect("a ring");
            analytic += usize::from(law.is_analytic());
            assert!(!law.is_analytic() || (law.spring_and_damper().is_none() && !law.depends_on_speed()), "{}", declaration.name);
            let (mut fast, mut exact) = (Vec::new(), Vec::new());
            receptance.sweep(std::slice::from_ref(&m), s.twist, &mut fast, &mut Work::default()).expect("damped");
            direct.sweep(std::slice::from_ref(&m), s.twist, &mut exact, &mut Work::default()).expect("damped");
            same(&fast, &exact, 1e-11, &format!("{} times {factor}", declaration.name));
        }
    }
    assert_eq!(analytic, 3 * 10, "fractional Kelvin and Zener, Maxwell, Carreau, spring pack, and five by dimensions");
}
