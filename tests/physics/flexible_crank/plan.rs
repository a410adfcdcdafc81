//! Where the parts of the six's crank lie and what they are made of, put together anew from the engine file.

use super::independent::{Section, round, web_of};
use hartog::crankshaft::Crank;
use hartog::crankshaft::flexible::{Balance, FlexibleSpec};
use hartog::engine::Geometry;
use hartog::engine::cycle::pin_angles;
use hartog::input::Study;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// On the pin: the rotating part of the rod and half of what oscillates.
pub fn rod_mass(geometry: &Geometry) -> f64 {
    geometry.rod_rotating_fraction() * geometry.rod_mass + 0.5 * geometry.oscillating_mass()
}

/// A body: node, mass, centre, directions, integrals of squares.
type Placed = (usize, f64, Vector3<f64>, [Vector3<f64>; 3], [f64; 3]);

/// Where everything is.
pub struct Plan {
    pub places: Vec<Vector3<f64>>,
    pub beams: Vec<(Section, f64)>,
    pub bodies: Vec<Placed>,
    pub polars: Vec<(usize, f64)>,
    pub bearings: Vec<[usize; 3]>,
    pub pins: Vec<usize>,
    pub directions: Vec<[Vector3<f64>; 2]>,
}

impl Plan {
    fn to(&mut self, place: Vector3<f64>, section: Section, tension: f64) -> usize {
        self.places.push(place);
        self.beams.push((section, tension));
        self.places.len() - 1
    }

    /// A throw behind the middle of a bearing at z; returns that of the next.
    fn throw(&mut self, (crank, spec, rod): (&Crank, &FlexibleSpec, f64), (t, angle, b): (usize, f64, &Balance), mut z: f64) -> f64 {
        let on_axis = |z: f64| Vector3::new(0.0, 0.0, z);
        let (lj, w, r) = (crank.journal_lengths[0], crank.web_thickness, crank.crank_radius);
        assert!(b.counterweight == 0.0, "without counterweights");
        let density = spec.beams().expect("beams").density * b.density;
        let outwards = Vector3::new(angle.cos(), angle.sin(), 0.0);
        self.directions.push([outwards, Vector3::new(-angle.sin(), angle.cos(), 0.0)]);
        let (journal, pin) = (round(crank, crank.journal_diameter, density, 1.0), round(crank, crank.pin_diameter, density, 1.0));
        let (stub_j, stub_p) = (round(crank, crank.journal_diameter, 0.0, 2.0), round(crank, crank.pin_diameter, 0.0, 2.0));
        let section = web_of(crank, spec, density);
        let radius = 0.5 * crank.web_breadth;
        let half_disc = density * w * PI * radius * radius / 2.0;
        let centre = 4.0 * radius / (3.0 * PI);
        let ends = half_disc * (r + centre) + 0.5 * (pin.mass * crank.pin_length + rod) * r;
        // mean of x² over the inner and outer half: r²/12 and 7 r²/12
        let tension = |twelfths: f64| ends + section.mass * r * r * (1.0 - twelfths / 12.0) / 2.0;
        let before = self.places.len() - 1;
        self.bearings.push([before - 1, before, before + 1]);
        let at = |x: f64, z: f64| outwards * x + on_axis(z);
        self.to(on_axis(z + lj / 3.0), journal, 0.0);
        z += 0.5 * lj;
        self.to(on_axis(z), journal, 0.0);
        let a = self.to(on_axis(z + 0.5 * w), stub_j, 0.0);
        self.to(at(0.5 * r, z + 0.5 * w), section, tension(1.0));
        let b1 = self.to(at(r, z + 0.5 * w), section, tension(7.0));
        z += w;
        self.to(at(r, z), stub_p, 0.0);
        let middle = self.to(at(r, z + 0.5 * crank.pin_length), pin, 0.0);
        z += crank.pin_length;
        self.to(at(r, z), pin, 0.0);
        let c = self.to(at(r, z + 0.5 * w), stub_p, 0.0);
        self.to(at(0.5 * r, z + 0.5 * w), section, tension(7.0));
        let d = self.to(on_axis(z + 0.5 * w), section, tension(1.0));
        z += w;
        self.to(on_axis(z), stub_j, 0.0);
        self.to(on_axis(z + lj / 6.0), journal, 0.0);
        z += 0.5 * lj;
        self.to(on_axis(z), journal, 0.0);
        self.pins.push(middle);
        let tangential = self.directions[t][1];
        for (node, sign) in [(a, -1.0), (b1, 1.0), (c, 1.0), (d, -1.0)] {
            let squares =
                [half_disc * (radius * radius / 4.0 - centre * centre), half_disc * radius * radius / 4.0, half_disc * w * w / 12.0];
            self.bodies.push((node, half_disc, outwards * (sign * centre), [outwards, tangential, Vector3::z()], squares));
        }
        self.bodies.push((middle, rod, Vector3::zeros(), [Vector3::x(), Vector3::y(), Vector3::z()], [0.0; 3]));
        let lacks = (b.station - b.steel - b.on_pin).max(0.0);
        self.polars.extend([(a, 0.5 * lacks), (d, 0.5 * lacks)]);
        z
    }

    pub fn new(study: &Study, crank: &Crank, spec: &FlexibleSpec, rod: f64) -> Self {
        let balance = &study.flexible.as_ref().expect("flexible").assembled.balance;
        let beams = spec.beams().expect("beams");
        let (front, rear) = (beams.front.as_ref().expect("a hub"), beams.rear.as_ref().expect("a flywheel"));
        let on_axis = |z: f64| Vector3::new(0.0, 0.0, z);
        let lj = crank.journal_lengths[0];
        let start = -0.5 * lj - front.shaft.iter().map(|s| s.length).sum::<f64>();
        let mut plan = Self {
            places: vec![on_axis(start)],
            beams: Vec::new(),
            bodies: Vec::new(),
            polars: Vec::new(),
            bearings: Vec::new(),
            pins: Vec::new(),
            directions: Vec::new(),
        };
        let end = |plan: &mut Self, step: &hartog::drivetrain::throw_stiffness::Step| {
            let (z, pieces) = (plan.places[plan.places.len() - 1].z, (step.length / 0.05).ceil());
            let section = round(crank, step.diameter, spec.beams().expect("beams").density, 1.0);
            (1..=pieces as usize).for_each(|k| {
                plan.to(on_axis(z + step.length * k as f64 / pieces), section, 0.0);
            });
            section.mass * step.length * 2.0 * section.squares[0]
        };
        let own: f64 = front.shaft.iter().rev().map(|s| end(&mut plan, s)).sum();
        let journal = round(crank, crank.journal_diameter, spec.beams().expect("beams").density, 1.0);
        let half_journal = journal.mass * 0.5 * lj * 2.0 * journal.squares[0];
        let stations = &study.chain.stations;
        let disc = |mass: f64, diametral: f64, polar: f64| (mass, [polar / 2.0, polar / 2.0, diametral - polar / 2.0]);
        let (m, squares) = disc(front.mass, front.diametral_inertia, stations[0].inertia - own - half_journal);
        plan.bodies.push((0, m, Vector3::zeros(), [Vector3::x(), Vector3::y(), Vector3::z()], squares));
        plan.to(on_axis(-lj / 3.0), journal, 0.0);
        plan.to(on_axis(0.0), journal, 0.0);
        let mut z = 0.0;
        for (t, (angle, b)) in pin_angles(&study.engine).into_iter().zip(balance).enumerate() {
            z = plan.throw((crank, spec, rod), (t, angle, b), z);
        }
        let before = plan.places.len() - 1;
        plan.bearings.push([before - 1, before, before + 1]);
        plan.to(on_axis(z + lj / 3.0), journal, 0.0);
        plan.to(on_axis(z + 0.5 * lj), journal, 0.0);
        let own: f64 = rear.shaft.iter().map(|s| end(&mut plan, s)).sum();
        let (m, squares) = disc(rear.mass, rear.diametral_inertia, stations[stations.len() - 1].inertia - own - half_journal);
        let last = plan.places.len() - 1;
        plan.bodies.push((last, m, Vector3::zeros(), [Vector3::x(), Vector3::y(), Vector3::z()], squares));
        plan
    }
}
