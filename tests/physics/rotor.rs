//! The shaft of the flexible crank against closed forms: bars, Jeffcott's rotor, rigid rotors, energy and rigid motion.

use hartog::rotor::beam::{Beam, Section};
use hartog::rotor::body::Body;
use hartog::rotor::free_modes::free_modes;
use hartog::rotor::shaft::{Dissipation, Shaft, Turning};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

const E: f64 = 205e9;
const NU: f64 = 0.3;
const RHO: f64 = 7850.0;

/// A solid round section with Cowper's shear factor.
fn round(diameter: f64, density: f64) -> Section {
    let g = E / (2.0 * (1.0 + NU));
    let (area, second) = (PI * diameter * diameter / 4.0, PI * diameter.powi(4) / 64.0);
    let kappa = 6.0 * (1.0 + NU) / (7.0 + 6.0 * NU);
    Section {
        axial: E * area,
        shear: kappa * g * area,
        bending: [E * second; 2],
        torsion: g * 2.0 * second,
        mass: density * area,
        rotary: [density * second; 2],
    }
}

/// x along the axis of rotation.
fn along() -> Matrix3<f64> {
    Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
}

fn straight(length: f64, elements: usize, section: Section) -> Shaft {
    let step = length / elements as f64;
    let mut shaft = Shaft::new((0..=elements).map(|i| Vector3::new(0.0, 0.0, step * i as f64)).collect());
    for i in 0..elements {
        shaft.join(i, &Beam { section, length: step, axes: along(), tension: 0.0 }, Dissipation::default());
    }
    shaft
}

/// A pole beside a frequency: where the inverse of an answer to a force on an unknown is zero, rad/s, by two answers beside it.
fn pole(shaft: &Shaft, speed: f64, (near, unknown): (f64, usize)) -> f64 {
    let inverse = |omega: f64| {
        let force = DVector::from_fn(6 * shaft.len(), |i, _| nalgebra::Complex::new(f64::from(u8::from(i == unknown)), 0.0));
        1.0 / shaft.response(Turning { omega, speed }, &force).expect("beside the pole")[unknown].re
    };
    let (low, high) = (near * (1.0 - 1e-6), near * (1.0 + 1e-6));
    let (a, b) = (inverse(low), inverse(high));
    low - a * (high - low) / (b - a)
}

/// A free bar against Timoshenko's exact frequencies (roots of his equation, to the digits given) and those of torsion and of axial motion, n c/2L.
#[test]
fn free_bar() {
    let shaft = straight(1.0, 60, round(0.05, RHO));
    let modes = free_modes(&shaft, 20).expect("modes");
    assert_eq!(modes.iter().filter(|m| m.omega == 0.0).count(), 6, "six rigid motions");
    let of = |kind: &str| modes.iter().filter(|m| m.omega > 0.0 && m.kind() == kind).map(|m| m.omega / TAU).collect::<Vec<_>>();
    let g = E / (2.0 * (1.0 + NU));
    // cubic shapes of bending converge as the fourth power of the elements, linear ones as the square: (pi/60)²/24 is 1.1e-4
    let close = |found: f64, exact: f64, tolerance: f64| assert!((found / exact - 1.0).abs() < tolerance, "{found} for {exact}");
    close(of("bending")[0], 225.9575, 3e-6);
    close(of("bending")[2], 615.4531, 2e-5);
    close(of("torsion")[0], (g / RHO).sqrt() / 2.0, 1.2e-4);
    close(of("axial")[0], (E / RHO).sqrt() / 2.0, 1.2e-4);
    // a mode of a straight bar is of one kind
    assert!(modes.iter().filter(|m| m.omega > 0.0).all(|m| [m.torsion, m.axial, m.bending()].into_iter().fold(0.0, f64::max) > 1.0 - 1e-9));
}

/// Jeffcott's rotor: a disc in the middle of a massless pinned shaft. In turning axes w0 is seen as w0 - W and w0 + W, exactly.
#[test]
fn jeffcott() {
    let mut shaft = straight(0.8, 2, round(0.05, 0.0));
    shaft.hold(0, [true, true, true, false, false, true]);
    shaft.hold(2, [true, true, false, false, false, false]);
    shaft.put(1, &Body { mass: 20.0, arm: Vector3::zeros(), tensor: Matrix3::zeros() });
    let s = round(0.05, 0.0);
    let flexibility = 0.8f64.powi(3) / (48.0 * s.bending[0]) + 0.8 / (4.0 * s.shear);
    let natural = (1.0 / (20.0 * flexibility)).sqrt();
    assert!((natural - 540.648).abs() < 1e-3, "{natural}");
    for wanted in [natural - 300.0, natural + 300.0] {
        let found = pole(&shaft, 300.0, (wanted, 6));
        assert!((found / wanted - 1.0).abs() < 1e-10, "{found} for {wanted}");
    }
}

/// A rigid rotor on two springs k at +-a: it translates at sqrt(2 k/m) and tilts at (+-Ip W + sqrt(Ip² W² + 8 Id k a²))/(2 Id), seen standing still.
#[test]
fn rigid_rotor() {
    let (m, polar, diametral, k, a, speed) = (30.0, 0.4, 0.25, 2e6, 0.3, 250.0);
    let mut section = round(0.2, 0.0);
    // so stiff that it does not bend, so little that rounding does not
    section.bending = [1e12; 2];
    section.shear = f64::INFINITY;
    let mut shaft = Shaft::new([-a, 0.0, a].map(|z| Vector3::new(0.0, 0.0, z)).to_vec());
    (0..2).for_each(|i| shaft.join(i, &Beam { section, length: a, axes: along(), tension: 0.0 }, Dissipation::default()));
    shaft.hold(1, [false, false, true, false, false, true]);
    [0, 2].into_iter().for_each(|i| shaft.hold(i, [false, false, true, false, false, true]));
    shaft.put(1, &Body { mass: m, arm: Vector3::zeros(), tensor: Matrix3::from_diagonal(&Vector3::new(diametral, diametral, polar)) });
    [0, 2].into_iter().for_each(|i| shaft.bear(i, (k, 0.0)));
    let translation = (2.0 * k / m).sqrt();
    let root = (polar * polar * speed * speed + 8.0 * diametral * k * a * a).sqrt();
    let tilts = [(root + polar * speed) / (2.0 * diametral), (root - polar * speed) / (2.0 * diametral)];
    // forward motions are slower in turning axes, backward ones faster
    for (wanted, unknown) in [(translation - speed, 6), (translation + speed, 6), (tilts[0] - speed, 9), (tilts[1] + speed, 9)] {
        let found = pole(&shaft, speed, (wanted.abs(), unknown));
        assert!((found / wanted.abs() - 1.0).abs() < 1e-6, "{found} for {wanted}");
    }
}

/// An overhung disc (Ip/Id 1.9) on a massless cantilever: (k11 - m w²)(k22 - Id w² + Ip W w) = k12² with w seen standing still, forward positive; in turning axes w - W. Its four roots to 1e-8, at a low speed and above the first of them, where
/// the forward motion is slower than the shaft. The same of a disc that the shaft carries without turning it against itself: bending does not see its inertia about the axis, torsion sees none of it.
#[test]
fn overhung_disc() {
    let (length, mass, diametral) = (0.3, 25.0, 0.2);
    let (polar, s) = (1.9 * diametral, round(0.06, 0.0));
    let disc = Body { mass, arm: Vector3::zeros(), tensor: Matrix3::from_diagonal(&Vector3::new(diametral, diametral, polar)) };
    let [shaft, carrying] = [false, true].map(|carried| {
        let mut shaft = straight(length, 1, s);
        shaft.hold(0, [true; 6]);
        shaft.hold(1, [false, false, true, false, false, true]);
        if carried {
            shaft.carry(1, &disc)
        } else {
            shaft.put(1, &disc)
        }
        shaft
    });
    let about_axis = |shaft: &Shaft| shaft.mass_matrix()[(11, 11)];
    assert!((about_axis(&shaft) - about_axis(&carrying) - polar).abs() < 1e-15 && about_axis(&carrying).abs() < 1e-15);
    let (ei, shear) = (s.bending[0], s.shear);
    let flexibility = nalgebra::Matrix2::new(
        length.powi(3) / (3.0 * ei) + length / shear,
        length.powi(2) / (2.0 * ei),
        length.powi(2) / (2.0 * ei),
        length / ei,
    );
    let k = flexibility.try_inverse().expect("stiff");
    for speed in [150.0, 1500.0] {
        let left = |w: f64| (k[(0, 0)] - mass * w * w) * (k[(1, 1)] - diametral * w * w + polar * speed * w) - k[(0, 1)].powi(2);
        // roots by bisection between places where the sign changes
        let (from, to, steps) = (-6000.0, 9000.0, 30_000);
        let place = |i: i32| from + (to - from) * f64::from(i) / f64::from(steps);
        let mut roots = Vec::new();
        for i in 0..steps {
            let (mut a, mut b) = (place(i), place(i + 1));
            if left(a) * left(b) < 0.0 {
                for _ in 0..80 {
                    let middle = 0.5 * (a + b);
                    if left(a) * left(middle) <= 0.0 { b = middle } else { a = middle }
                }
                roots.push(0.5 * (a + b));
            }
        }
        assert_eq!(roots.len(), 4, "{roots:?}");
        for root in roots {
            let wanted = (root - speed).abs();
            for shaft in [&shaft, &carrying] {
                let found = pole(shaft, speed, (wanted, 9));
                assert!((found / wanted - 1.0).abs() < 1e-8, "{speed} rad/s: {found} for {wanted}");
            }
        }
    }
}

/// A crank without throws is a chain: in torsion the frequencies of massless shafts with discs are those of inertias and springs to rounding (1e-10), and no mode is both of torsion and of bending.
#[test]
fn a_straight_shaft_is_a_chain() {
    let (n, length, inertia) = (6, 0.15, 0.03);
    let s = round(0.05, 0.0);
    let mut shaft = straight(length * f64::from(n - 1), n as usize - 1, s);
    for i in 0..n as usize {
        shaft.put(i, &Body { mass: 4.0, arm: Vector3::zeros(), tensor: Matrix3::from_diagonal(&Vector3::new(0.02, 0.02, inertia)) });
    }
    let chain = crate::support::uniform_chain(n as usize, inertia, s.torsion / length);
    let modes = free_modes(&shaft, 36).expect("modes");
    let elastic = || modes.iter().filter(|m| m.omega > 0.0);
    assert!(elastic().all(|m| m.torsion < 1e-9 || m.torsion > 1.0 - 1e-9), "torsion and bending are apart");
    let torsion: Vec<f64> = elastic().filter(|m| m.torsion > 0.5).map(|m| m.omega / TAU).collect();
    let of_chain: Vec<f64> = hartog::drivetrain::Modes::new(&chain).frequencies_hz().into_iter().filter(|f| *f > 0.0).collect();
    assert_eq!(torsion.len(), of_chain.len());
    for (found, wanted) in torsion.iter().zip(of_chain) {
        assert!((found / wanted - 1.0).abs() < 1e-10, "{found} for {wanted}");
    }
}

/// Bearings at rest under forces between them bear the reactions of the continuous beam on seven supports that loads of cranks are found by (another code: cubic elements of a plane beam): with springs to 1e-8, and with bearings a
/// thousand times as stiff as the shaft those of rigid supports to 1e-3.
#[test]
fn reactions_of_the_continuous_beam() {
    use hartog::crankshaft::{Beam as Continuous, Support, elements::reactions};
    let (spans, span) = (6, 0.13f64);
    let mut s = round(0.08, 0.0);
    s.shear = f64::INFINITY;
    let at_support = |i: usize| 2 * i;
    for (stiffness, is_rigid, tolerance) in [(3e8, false, 1e-8), (1e3 * 48.0 * s.bending[0] / span.powi(3), true, 1e-3)] {
        let mut shaft = straight(span * spans as f64, 2 * spans, s);
        shaft.hold(0, [false, false, true, false, false, true]);
        (0..=spans).for_each(|i| shaft.bear(at_support(i), (stiffness, 0.0)));
        let support = |i: usize| Support { at: span * i as f64, stiffness: (!is_rigid).then_some(stiffness) };
        let beam = Continuous {
            supports: (0..=spans).map(support).collect(),
            loads_at: (0..spans).map(|i| span * (i as f64 + 0.5)).collect(),
            rigidity: s.bending[0],
        };
        let expected = reactions(&beam).expect("supported").0;
        for (load, direction) in [(0, 0), (2, 1), (4, 0)] {
            let unknown = 6 * (2 * load + 1) + direction;
            let force = DVector::from_fn(6 * shaft.len(), |i, _| nalgebra::Complex::new(f64::from(u8::from(i == unknown)), 0.0));
            let moved = shaft.response(Turning { omega: 0.0, speed: 0.0 }, &force).expect("held");
            for i in 0..=spans {
                let found = -stiffness * moved[6 * at_support(i) + direction].re;
                assert!((found - expected[(i, load)]).abs() < tolerance, "load {load}, support {i}: {found} for {}", expected[(i, load)]);
            }
        }
    }
}

/// A bent shaft with everything on it: two webs, bodies off their nodes, bearings, damping.
fn bent(angle: f64) -> Shaft {
    let turn = |x: f64, y: f64| Vector3::new(x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos(), 0.0);
    let (radial, tangential) = (turn(1.0, 0.0), turn(0.0, 1.0));
    let at = |r: f64, z: f64| radial * r + Vector3::new(0.0, 0.0, z);
    let places =
        vec![at(0.0, 0.0), at(0.0, 0.05), at(0.03, 0.05), at(0.06, 0.05), at(0.06, 0.1), at(0.03, 0.1), at(0.0, 0.1), at(0.0, 0.15)];
    let mut shaft = Shaft::new(places.clone());
    for i in 0..7 {
        let step = places[i + 1] - places[i];
        let direction = step / step.norm();
        let second = if direction.z.abs() > 0.5 { radial } else { Vector3::z() };
        let third = direction.cross(&second);
        let axes = Matrix3::from_rows(&[direction.transpose(), second.transpose(), third.transpose()]);
        shaft.join(
            i,
            &Beam { section: round(0.05, RHO), length: step.norm(), axes, tension: 0.0 },
            Dissipation { loss_factor: 0.02, time: 1e-6 },
        );
    }
    let tensor = Matrix3::new(0.01, 0.001, 0.002, 0.001, 0.02, -0.001, 0.002, -0.001, 0.025);
    let frame = Matrix3::from_columns(&[radial, tangential, Vector3::z()]);
    for node in [1, 3, 6] {
        let arm = frame * Vector3::new(0.01, -0.02, 0.005);
        shaft.put(node, &Body { mass: 2.0, arm, tensor: frame * tensor * frame.transpose() });
    }
    [0, 7].into_iter().for_each(|node| shaft.bear(node, (1e8, 2e4)));
    shaft.tie(0, &hartog::rotor::shaft::Six::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0), (1e8, 1e3));
    shaft
}

fn solved(shaft: &Shaft, at: Turning, force: &DVector<nalgebra::Complex<f64>>) -> DVector<nalgebra::Complex<f64>> {
    shaft.response(at, force).expect("damped")
}

/// The solution by blocks is that of the whole matrix; what forces put in per cycle is what damping takes out; and turning all of the crank turns the answer.
#[test]
fn energy_and_turned_axes() {
    let at = Turning { omega: 900.0, speed: 300.0 };
    let shaft = bent(0.0);
    let n = 6 * shaft.len();
    let c = |x: f64, y: f64| nalgebra::Complex::new(x, y);
    let force = DVector::from_fn(n, |i, _| c((1.3 * i as f64).sin(), (0.7 * i as f64).cos()));
    let q = solved(&shaft, at, &force);
    let real = shaft.stiffness_matrix() - shaft.mass_matrix() * (at.omega * at.omega)
        + shaft.turning_matrix() * (at.speed * at.speed)
        + shaft.circulatory_matrix() * at.speed;
    let imaginary = shaft.loss_matrix() + shaft.damping_matrix() * at.omega + shaft.gyroscopic_matrix() * (at.omega * at.speed);
    let whole = DMatrix::from_fn(n, n, |i, j| c(real[(i, j)], imaginary[(i, j)]));
    assert!((&whole * &q - &force).norm() < 1e-9 * force.norm(), "blocks and the whole");
    // power of forces: omega/2 Im(conj(q)' f); of dampers and losses: omega/2 q^H (loss + omega C) q, and what bearings that stand still take from the rotation, omega/2 Im(q^H C_s q) speed
    let power = 0.5 * at.omega * q.dotc(&force).im;
    let dissipated = shaft.loss_matrix() + shaft.damping_matrix() * at.omega;
    let complex = |m: &DMatrix<f64>| m.map(|x| c(x, 0.0));
    let lost =
        0.5 * at.omega * (q.dotc(&(complex(&dissipated) * &q)).re + at.speed * q.dotc(&(complex(&shaft.circulatory_matrix()) * &q)).im);
    assert!((power / lost - 1.0).abs() < 1e-10, "{power} in, {lost} out");
    // gyroscopic and circulatory matrices are skew, the others symmetric: H(-W)' = H(W)
    let against = Turning { speed: -at.speed, ..at };
    let unit = |k: usize| DVector::from_fn(n, |i, _| c(f64::from(u8::from(i == k)), 0.0));
    let (a, b) = (solved(&shaft, at, &unit(2 * 6 + 1))[4 * 6], solved(&shaft, against, &unit(4 * 6))[2 * 6 + 1]);
    assert!((a - b).norm() < 1e-10 * a.norm(), "{a} {b}");
    // axes turned by 0.7 rad
    let rotation = Matrix3::new(0.7f64.cos(), -0.7f64.sin(), 0.0, 0.7f64.sin(), 0.7f64.cos(), 0.0, 0.0, 0.0, 1.0);
    let turned = |x: &DVector<nalgebra::Complex<f64>>| {
        DVector::from_fn(n, |i, _| (0..3).map(|k| x[i / 3 * 3 + k] * rotation[(i % 3, k)]).sum::<nalgebra::Complex<f64>>())
    };
    let other = solved(&bent(0.7), at, &turned(&force));
    assert!((other - turned(&q)).norm() < 1e-10 * q.norm(), "turned axes");
}

/// Mass, centre and inertia of the matrices are those of the parts, whatever the shape functions.
#[test]
fn rigid_motion() {
    let shaft = bent(0.4);
    let rotation = shaft.rigid_rotation();
    let (lengths, section) = ([0.05, 0.03, 0.03, 0.05, 0.03, 0.03, 0.05], round(0.05, RHO));
    let translation = vec![hartog::rotor::shaft::Six::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0); shaft.len()];
    let mass = section.mass * lengths.iter().sum::<f64>() + 3.0 * 2.0;
    assert!((shaft.kinetic(&translation, &translation) / mass - 1.0).abs() < 1e-12);
    // about the axis: journals and pin as cylinders, webs as rods across it, bodies by Steiner's theorem
    let journals = 2.0 * section.rotary[0];
    let web = |from: f64, to: f64| section.mass * (to.powi(3) - from.powi(3)) / 3.0 + section.rotary[0] * (to - from);
    let body = |r: f64| 0.025 + 2.0 * ((r + 0.01).powi(2) + 0.02f64.powi(2));
    let wanted = journals * 0.1 + (journals + section.mass * 0.06 * 0.06) * 0.05 + 2.0 * web(0.0, 0.06) + 2.0 * body(0.0) + body(0.06);
    let found = shaft.kinetic(&rotation, &rotation);
    assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
}
