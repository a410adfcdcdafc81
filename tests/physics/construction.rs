//! Dampers by their dimensions: stiffness, damping, strain, inertia and mass of drawings on rubber and oil against quadrature, and every derivative of all of them against differences.

use crate::support::{assert_close, study, system};
use hartog::absorber::{
    Absorber, DISC, Declaration, HOUSING, Host, Medium, Mounted, Operating, Parts, SHAPES, SLEEVE, WEDGE, construction,
};
use hartog::objective::{Measure, Over, PeakFinder, Price, Property};
use hartog::response::{Direct, Grid, Method, Quantity, Work};
use std::f64::consts::{PI, TAU};

/// Values as they are declared: kg m², mm, kg/m³, then those of the material.
pub fn values(kind: &Declaration) -> Vec<f64> {
    match kind.name {
        "sleeve" => vec![0.076, 250.0, 18.0, 9.0, 0.9, 7200.0, 0.8, 500.0, 4e-14, 0.25],
        "disc" => vec![0.05, 240.0, 40.0, 12.0, 2.0, 7850.0, 0.8, 500.0, 4e-14, 0.25],
        "wedge" => vec![0.05, 240.0, 60.0, 0.09, 1.0, 7850.0, 0.8, 500.0, 4e-14, 0.25],
        "leaf_springs" => vec![0.076, 260.0, 18.0, 24.0, 50.0, 2.6, 0.8, 7850.0, 206.0, 0.3, 1.4, 150.0],
        "coil_springs" => vec![0.05, 250.0, 20.0, 8.0, 10.0, 4.2, 3.0, 7850.0, 79.0, 12.0],
        "pendulum_masses" => vec![0.02, 240.0, 40.0, 4.0, 0.8, 11.0, 7850.0, 0.8],
        _ => vec![0.076, 270.0, 5.0, 40.0, 0.5, 0.4, 7850.0, 7200.0, 97.0, 3.07e-3, 0.8, 0.3],
    }
}

/// Simpson's rule.
pub fn integral(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let n = 2000;
    let x = |i: usize| low + (high - low) * i as f64 / n as f64;
    let weight = |i: usize| {
        if i == 0 || i == n {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    (0..=n).map(|i| weight(i) * f(x(i))).sum::<f64>() * (high - low) / (3.0 * n as f64)
}

pub fn parts(kind: &'static Declaration) -> Parts<f64> {
    construction::shape(kind).expect("a shape").parts_of(&values(kind))
}

/// B of a cylinder of what is sheared between two radii: the same torque T goes through every radius, so that G theta/T = ∫ dr/(2 pi L r³).
fn of_sleeve(inner: f64, outer: f64, length: f64) -> f64 {
    1.0 / integral(inner, outer, |r| 1.0 / (TAU * length * r.powi(3)))
}

/// Equals quadrature: B, inertia and mass of each shape by integrals over its section, to 1e-9; the stiffness of a bush in torsion by the formula for diameters, pi G L/(1/d² - 1/D²) [Lindley 1978].
#[test]
fn drawings_by_quadrature() {
    let ring = |p: &Parts<f64>, density: f64, j: f64, what: &str| {
        let inertia = integral(p.ring[0], p.ring[1], |r| density * TAU * r.powi(3) * p.ring_width);
        let mass = integral(p.ring[0], p.ring[1], |r| density * TAU * r * p.ring_width);
        assert_close(inertia, j, 1e-9, 0.0, &format!("{what}: inertia"));
        assert_close(p.ring_mass, mass, 1e-9, 0.0, &format!("{what}: mass"));
    };
    let p = parts(&SLEEVE);
    ring(&p, 7200.0, 0.076, "sleeve");
    let hub = 0.5 * p.bore;
    assert_close(p.factor, of_sleeve(hub, p.ring[0], p.element_length), 1e-9, 0.0, "sleeve: B");
    let by_diameters = PI * p.element_length / (1.0 / (2.0 * hub).powi(2) - 1.0 / (2.0 * p.ring[0]).powi(2));
    assert_close(p.factor, by_diameters, 1e-12, 0.0, "sleeve: by diameters");
    assert_close(p.strain_per_twist, p.factor / (TAU * p.element_length * hub * hub), 1e-12, 0.0, "sleeve: strain at the hub");
    assert_close(p.ring[0] - hub, 9e-3, 1e-12, 0.0, "sleeve: thickness");

    let p = parts(&DISC);
    ring(&p, 7850.0, 0.05, "disc");
    assert_close(p.factor, 2.0 * integral(p.ring[0], p.ring[1], |r| TAU * r.powi(3) / 0.012), 1e-9, 0.0, "disc: B");
    assert_close(p.width, p.ring_width + 0.024, 1e-12, 0.0, "disc: width");

    let p = parts(&WEDGE);
    ring(&p, 7850.0, 0.05, "wedge");
    assert_close(p.factor, integral(p.ring[0], p.ring[1], |r| TAU * r.powi(3) / (0.09 * r)), 1e-9, 0.0, "wedge: B");
    assert_close(p.element_volume, integral(p.ring[0], p.ring[1], |r| TAU * r * 0.09 * r), 1e-9, 0.0, "wedge: volume");

    let p = parts(&HOUSING);
    ring(&p, 7850.0, 0.076, "housing");
    let [inner, outer] = p.ring;
    let faces = 2.0 * integral(inner, outer, |r| TAU * r.powi(3) / 0.4e-3);
    let gaps = of_sleeve(outer, outer + 0.5e-3, p.ring_width) + of_sleeve(inner - 0.5e-3, inner, p.ring_width);
    assert_close(p.factor, faces + gaps, 1e-9, 0.0, "housing: B");
    let (bore, outside) = (0.5 * p.bore, 0.135);
    let chamber = p.ring_width + 0.8e-3;
    // two faces of 5 mm, and walls at the rim and at the bore between them
    let of = |power: i32| {
        let section = |a: f64, b: f64, width: f64| integral(a, b, |r| 7200.0 * TAU * r.powi(power) * width);
        2.0 * section(bore, outside, 5e-3) + section(outside - 5e-3, outside, chamber) + section(bore, bore + 5e-3, chamber)
    };
    assert_close(p.hub_inertia, of(3), 1e-9, 0.0, "housing: inertia");
    assert_close(p.hub_mass, of(1), 1e-9, 0.0, "housing: mass");
    let oil = integral(inner - 0.5e-3, outer + 0.5e-3, |r| TAU * r * chamber) - integral(inner, outer, |r| TAU * r * p.ring_width);
    assert_close(p.element_volume, oil, 1e-9, 0.0, "housing: oil");
    assert_close(p.outer_diameter, 0.27, 1e-12, 0.0, "housing: outer diameter");
}

/// Law: S is B times the modulus of the fractional Zener law, B i omega times the viscosity of Carreau's, that of springs with their damping, or that of pendulums of small swing, and its derivative by each parameter is that of central differences, to 1e-7 of the largest.
#[test]
fn derivatives_of_stiffness() {
    for shape in SHAPES {
        let (kind, values) = (shape.declaration, values(shape.declaration));
        let law = (kind.build)(&values);
        for omega in [50.0, 900.0, 4000.0] {
            let at = Operating { omega, shaft_speed: omega };
            let s = law.dynamic_stiffness(at);
            let found = law.derivatives(at);
            assert_eq!(found.len(), kind.parameters.len());
            for (p, x) in values.iter().enumerate() {
                let moved = |share: f64| {
                    let mut moved = values.clone();
                    moved[p] *= 1.0 + share;
                    (kind.build)(&moved).dynamic_stiffness(at)
                };
                let step = 1e-5;
                let difference = (moved(step) - moved(-step)) / (2.0 * step);
                let error = (found[p] * x - difference).norm() / s.norm();
                assert!(error < 1e-7, "{}, {}: {error:e}", kind.name, kind.parameters[p].key);
            }
        }
    }
}

/// Law: the gradient of twist, torque, strain, stress, heat, mass, volume, cost and sizes by every dimension, with the inertia of the housing or of the masses about their centres that follows from it, is that of central differences, to the 2e-4 that their curvature by the exponent of the law leaves.
#[test]
fn gradients_by_dimensions() {
    let mut s = study("villalva_i6");
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(4).collect();
    let system = system(&s);
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let method = Method::Direct(Direct::new(&system, &grid));
    let finder = PeakFinder::new(&system, &grid, &method, true);
    let price = Price { fixed: 10.0, ring: 3.0, housing: 5.0, diameter: 50.0 };
    let ring = || vec![Quantity::RingTwist(0)];
    let mut measures: Vec<Measure> =
        [Property::Mass, Property::Volume, Property::Cost(price), Property::OuterDiameter, Property::Width, Property::Bore]
            .map(|p| Measure::new(ring(), Over::Property(p)))
            .to_vec();
    measures.extend([Over::Synthesis, Over::Orders].map(|over| Measure::new(vec![s.twist], over)));
    measures.push(Measure::new(vec![Quantity::ShaftTorque(2)], Over::Synthesis));
    measures.extend([Over::Strain, Over::SpringStress, Over::Power, Over::Synthesis].map(|over| Measure::new(ring(), over)));
    let pulley = s.chain.find("pulley").expect("a pulley");
    for shape in SHAPES {
        let (kind, values) = (shape.declaration, values(shape.declaration));
        let design = |values: &[f64]| {
            vec![Mounted { on: Host::Station(pulley), hub_inertia: 0.001, absorber: Absorber::Ring((kind.build)(values)) }]
        };
        for measure in &measures {
            let peak = |v: &[f64]| finder.peak(&design(v), measure, &mut Work::default()).expect("damped");
            // oil has no strain that counts, springs have their stress, pendulums neither
            let has = match measure.over {
                Over::Strain => shape.medium == Medium::Rubber,
                Over::SpringStress => shape.medium.is_spring(),
                _ => true,
            };
            let Some(own) = peak(&values) else {
                assert!(!has, "{} {measure:?}", kind.name);
                continue;
            };
            assert!(has, "{} {measure:?}", kind.name);
            let gradient = finder.gradient(&design(&values), 0, measure, &own, &mut Work::default()).expect("damped");
            for (p, x) in values.iter().enumerate() {
                let moved = |share: f64| {
                    let mut moved = values.clone();
                    moved[p] *= 1.0 + share;
                    peak(&moved).expect("a peak").value
                };
                let step = 1e-4;
                let difference = (moved(step) - moved(-step)) / (2.0 * step);
                let found = gradient.get(p).copied().unwrap_or(0.0) * x;
                assert_close(
                    found,
                    difference,
                    2e-4,
                    4e-6 * own.value,
                    &format!("{}, {:?}, {}", kind.name, measure.over, kind.parameters[p].key),
                );
            }
        }
    }
}
