//! Springs of steel and pendulum masses by their dimensions: each formula of a drawing against an integral that does not know it.

use crate::construction::{integral, parts, values};
use crate::support::assert_close;
use hartog::absorber::construction::Unfit;
use hartog::absorber::{
    COIL_SPRINGS, Declaration, LEAF_SPRINGS, Law, Operating, PENDULUM_MASSES, Pendulum, SpringPack, Tuned, construction,
};
use std::f64::consts::{PI, TAU};

/// kg m² and kg of a ring of steel with rectangular section.
fn ring(ring: [f64; 2], width: f64) -> (f64, f64) {
    let of = |power: i32| integral(ring[0], ring[1], |r| 7850.0 * TAU * r.powi(power) * width);
    (of(3), of(1))
}

/// Independent: a leaf is marched from its clamp to its end, its curvature being that of the moment of a force of 1 N there over the E I of its section, whose second moment is summed over fibres. The torque on the hub is moment and
/// shear at the clamp together. To 1e-6, the error of 20,000 steps by the midpoint; inertia and mass of the ring to 1e-9.
#[test]
fn leaves_by_marching_a_beam() {
    let p = parts(&LEAF_SPRINGS);
    let (length, thickness, e) = (50e-3, 2.6e-3, 206e9);
    let breadth = 0.8 * p.ring_width;
    let (inertia, mass) = ring(p.ring, p.ring_width);
    assert_close(inertia, 0.076, 1e-9, 0.0, "inertia");
    assert_close(p.ring_mass, mass, 1e-9, 0.0, "mass");
    let second = integral(-0.5 * thickness, 0.5 * thickness, |y| breadth * y * y);
    let steps = 20_000;
    let dx = length / f64::from(steps);
    let (mut slope, mut deflection) = (0.0, 0.0);
    for i in 0..steps {
        let curvature = (length - (f64::from(i) + 0.5) * dx) / (e * second);
        deflection += dx * (slope + 0.5 * dx * curvature);
        slope += dx * curvature;
    }
    let [slot, _] = p.ring;
    let clamp = slot - length;
    assert_close(p.bore, 2.0 * clamp, 1e-12, 0.0, "bore");
    // a twist of one moves every end by the radius of the slots
    let force = slot / deflection;
    let torque = 24.0 * (force * length + force * clamp);
    assert_close(p.factor, torque, 1e-6, 0.0, "stiffness");
    assert_close(p.stress_per_twist, force * length * 0.5 * thickness / second, 1e-6, 0.0, "stress at the clamp");
    assert_close(p.element_volume, 24.0 * length * thickness * breadth, 1e-12, 0.0, "leaves");
    assert_eq!((p.strain_per_twist, p.width, p.element_length), (0.0, p.ring_width, breadth));
}

/// Independent: the stiffness of a coil spring by the energy of torsion in its wire, all along the active coils, its polar moment summed over rings of the section, to 1e-9. Source: the stress lies within 1.5 per cent of that by
/// Bergsträsser's factor (4 C + 2)/(4 C - 3), and is Wahl's at C = 4 (1.40375) and C = 10 (1.1448), to the printed digits.
#[test]
fn coils_by_the_energy_of_torsion() {
    let p = parts(&COIL_SPRINGS);
    let (wire, index, coils, g) = (10e-3, 4.2, 3.0, 79e9);
    let mean = wire * index;
    let (inertia, mass) = ring(p.ring, p.ring_width);
    assert_close(inertia, 0.05, 1e-9, 0.0, "inertia");
    assert_close(p.ring_mass, mass, 1e-9, 0.0, "mass");
    let polar = integral(0.0, 0.5 * wire, |r| TAU * r.powi(3));
    // of a force of 1 N
    let energy = integral(0.0, PI * mean * coils, |_| (0.5 * mean).powi(2) / (2.0 * g * polar));
    let rate = 0.5 / energy;
    assert_close(p.ring[0] - p.radius, 0.5 * (mean + wire), 1e-12, 0.0, "coils touch the ring");
    assert_close(p.factor, 8.0 * rate * p.radius.powi(2), 1e-9, 0.0, "stiffness");
    // shear of torsion at the edge of the wire
    let plain = rate * p.radius * 0.5 * mean * 0.5 * wire / polar;
    let curvature = p.stress_per_twist / plain;
    assert_close(curvature, (4.0 * index + 2.0) / (4.0 * index - 3.0), 0.015, 0.0, "Bergsträsser");
    for (index, printed, digits) in [(4.0, 1.403_75, 1e-6), (10.0, 1.1448, 5e-5)] {
        let mut values = values(&COIL_SPRINGS);
        values[5] = index;
        let p = construction::shape(&COIL_SPRINGS).expect("a shape").parts_of(&values);
        let rate = g * wire / (8.0 * index.powi(3) * coils);
        let plain = 8.0 * rate * p.radius * index / (PI * wire * wire);
        assert_close(p.stress_per_twist / plain, printed, 0.0, digits, "Wahl");
    }
    assert_close(p.element_volume, 8.0 * PI * mean * (coils + 2.0) * 0.25 * PI * wire * wire, 1e-12, 0.0, "wire");
    assert_close(p.width, mean + wire, 1e-12, 0.0, "wider than the ring");
}

/// Independent: mass, centre and inertias of the sectors by quadrature over their area, to 1e-9; their order by the square of the centre's distance from the axis along the path, n² = -(1/2) d²R²/ds² \[Den Hartog 1956\], to the 1e-6
/// that differences leave.
#[test]
fn masses_by_quadrature() {
    let p = parts(&PENDULUM_MASSES);
    let half = PI * 0.8 / 4.0;
    let [inner, outer] = p.ring;
    let over = |f: &dyn Fn(f64, f64) -> f64| integral(inner, outer, |r| integral(-half, half, |a| 7850.0 * p.width * r * f(r, a)));
    let mass = over(&|_, _| 1.0);
    let centre = over(&|r, a| r * a.cos()) / mass;
    assert_close(p.radius, centre, 1e-9, 0.0, "centre");
    assert_close(p.ring_mass, 4.0 * mass, 1e-9, 0.0, "mass");
    assert_close(0.02, 4.0 * mass * centre * centre, 1e-9, 0.0, "inertia as points");
    let about_centre = over(&|r, a| (r * a.cos() - centre).powi(2) + (r * a.sin()).powi(2));
    assert_close(p.hub_inertia, 4.0 * about_centre, 1e-9, 0.0, "about their own centres");
    let path = 11e-3;
    let square = |s: f64| (centre - path + path * (s / path).cos()).powi(2) + (path * (s / path).sin()).powi(2);
    let step = 1e-3 * path;
    let bent = (square(step) - 2.0 * square(0.0) + square(-step)) / (step * step);
    assert_close(p.factor, -0.5 * bent, 1e-6, 0.0, "order squared");
    assert_close(path, centre / (p.factor + 1.0), 1e-12, 0.0, "path of an order");
    assert_eq!((p.element_volume, p.strain_per_twist, p.stress_per_twist), (0.0, 0.0, 0.0));
}

/// Law: S is that of `spring_pack`, `tuned` or `pendulum` with the stiffness or order that the drawing comes to, to 1e-12; springs and dampers say that they are constant, pendulums that they depend on the speed.
#[test]
fn laws_are_those_of_the_figures() {
    let [leaves, coils, masses] = [&LEAF_SPRINGS, &COIL_SPRINGS, &PENDULUM_MASSES].map(|d: &'static Declaration| (d.build)(&values(d)));
    let stiffness = |law: &dyn Law| law.parts().expect("drawn").factor;
    let pack = SpringPack {
        ring_inertia: 0.076,
        stiffness: stiffness(leaves.as_ref()),
        damping_factor: 0.3,
        dynamic_ratio: 1.4,
        reference_frequency: 150.0,
    };
    let tuned = Tuned { ring_inertia: 0.05, stiffness: stiffness(coils.as_ref()), damping: 12.0 };
    let pendulum = Pendulum { ring_inertia: 0.02, tuning_order: stiffness(masses.as_ref()).sqrt(), damping: 0.8 };
    for (drawn, figures) in [(&leaves, &pack as &dyn Law), (&coils, &tuned), (&masses, &pendulum)] {
        for (omega, shaft_speed) in [(0.0, 100.0), (300.0, 100.0), (2000.0, 300.0)] {
            let [a, b] = [drawn.as_ref(), figures].map(|law| law.dynamic_stiffness(Operating { omega, shaft_speed }));
            assert!((a - b).norm() <= 1e-12 * b.norm(), "{}: {a} {b}", drawn.declaration().name);
        }
        assert_eq!(drawn.depends_on_speed(), figures.depends_on_speed());
        assert_eq!(drawn.spring_and_damper().is_some(), figures.spring_and_damper().is_some());
        assert_eq!(drawn.is_analytic(), figures.is_analytic());
    }
    assert_eq!(leaves.strain_per_twist().or(coils.strain_per_twist()).or(masses.strain_per_twist()), None);
    assert_eq!((masses.stress_per_twist(), masses.hub_inertia() > 0.0), (None, true));
}

/// Both sides of what has room: leaves round their clamp, coils round their circle, a path within the radius of the centre, and a bore.
#[test]
fn drawings_without_room() {
    let unfit = |kind: &'static Declaration, changes: &[(usize, f64)]| {
        let mut values = values(kind);
        changes.iter().for_each(|(i, x)| values[*i] = *x);
        construction::shape(kind).expect("a shape").unfit(&values)
    };
    assert_eq!([&LEAF_SPRINGS, &COIL_SPRINGS, &PENDULUM_MASSES].map(|kind| unfit(kind, &[])), [None; 3]);
    assert!(matches!(unfit(&LEAF_SPRINGS, &[(4, 112.0)]), Some(Unfit::Bore(b)) if b <= 0.0));
    // the clamp has a radius of 62 mm, its circle 389.6 mm
    assert_eq!(unfit(&LEAF_SPRINGS, &[(3, 149.0)]), None);
    let Some(Unfit::Springs { taken, there }) = unfit(&LEAF_SPRINGS, &[(3, 150.0)]) else { panic!("150 leaves of 2.6 mm") };
    assert_close(taken, 0.39, 1e-12, 0.0, "leaves");
    assert_close(there, TAU * 0.062, 1e-12, 0.0, "round the clamp");
    // eight springs of 5 coils of 10 mm are 400 mm long; their circle is 496.4 mm
    assert_eq!(unfit(&COIL_SPRINGS, &[(6, 4.2)]), None);
    assert!(matches!(unfit(&COIL_SPRINGS, &[(6, 4.3)]), Some(Unfit::Springs { .. })));
    let centre = parts(&PENDULUM_MASSES).radius;
    assert_eq!(unfit(&PENDULUM_MASSES, &[(5, 999.0 * centre)]), None);
    let Some(Unfit::Path { path, centre: own }) = unfit(&PENDULUM_MASSES, &[(5, 1e3 * centre)]) else { panic!("a path about the axis") };
    assert_eq!((path, own), (centre, centre));
}
