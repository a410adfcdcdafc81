//! The beams and bodies of a crank, one after the other, before they are put together.

use super::web_factors::WebFactors;
use crate::drivetrain::throw_stiffness::{Step, shear_modulus};
use crate::rotor::beam::{Beam, Section};
use crate::rotor::body::Body;
use crate::rotor::shaft::{Dissipation, Shaft};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// What joins a node to the next.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Join {
    /// A beam, and whether it carries mass.
    Beam(Beam, Dissipation),
    /// A spring in rotation about the axis, N m/rad.
    Torsion(f64, Dissipation),
}

impl Join {
    /// Stiffness in rotation about the axis, N m/rad, and how it dissipates.
    pub(super) fn torsion(&self) -> (f64, Dissipation) {
        match self {
            Self::Beam(beam, dissipation) => (beam.section.torsion / beam.length, *dissipation),
            Self::Torsion(stiffness, dissipation) => (*stiffness, *dissipation),
        }
    }
}

/// Nodes with what joins them and what sits on them.
#[derive(Debug, Clone, Default)]
pub(super) struct Row {
    pub places: Vec<Vector3<f64>>,
    pub joins: Vec<Join>,
    pub bodies: Vec<(usize, Body)>,
}

/// Axes of a beam along z that turns with the crank.
fn along_axis() -> Matrix3<f64> {
    Matrix3::from_rows(&[Vector3::z().transpose(), Vector3::x().transpose(), Vector3::y().transpose()])
}

/// Elastic constants and density of the crank, Pa and kg/m³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Material {
    pub young_modulus: f64,
    pub density: f64,
}

/// Poisson's ratio of steel.
const POISSON: f64 = 0.3;
/// Shear stiffness of a web over that of its section: the factors hold its shear.
const STIFF_IN_SHEAR: f64 = 1000.0;

impl Material {
    fn shear_modulus(&self) -> f64 {
        shear_modulus(self.young_modulus)
    }

    /// Section of a round with the shear factor of \[Cowper 1966\]; `stiffer`: a factor on its stiffness.
    pub(super) fn round(&self, step: &Step, stiffer: f64) -> Section {
        let (d, m) = (step.diameter, step.bore / step.diameter);
        let (area, second) = (PI / 4.0 * d * d * (1.0 - m * m), PI / 64.0 * d.powi(4) * (1.0 - m.powi(4)));
        let (nu, n) = (POISSON, 1.0 + m * m);
        let kappa = 6.0 * (1.0 + nu) * n * n / ((7.0 + 6.0 * nu) * n * n + (20.0 + 12.0 * nu) * m * m);
        let (e, g) = (self.young_modulus * stiffer, self.shear_modulus() * stiffer);
        Section {
            axial: e * area,
            shear: kappa * g * area,
            bending: [e * second; 2],
            torsion: g * 2.0 * second,
            mass: self.density * area,
            rotary: [self.density * second; 2],
        }
    }

    /// Section of a web, local y along the crank.
    pub(super) fn web(&self, (thickness, breadth): (f64, f64), factors: &WebFactors) -> Section {
        let (w, b) = (thickness, breadth);
        let area = w * b;
        let (long, short) = (w.max(b), w.min(b));
        let ratio = short / long;
        let rectangle = long * short.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
        let (in_plane, edgewise) = (b * w.powi(3) / 12.0, w * b.powi(3) / 12.0);
        Section {
            axial: self.young_modulus * area,
            shear: self.shear_modulus() * area * STIFF_IN_SHEAR,
            bending: [self.young_modulus * in_plane * factors.bending, self.young_modulus * edgewise * factors.edge],
            torsion: self.shear_modulus() * rectangle * factors.twist,
            mass: self.density * area,
            rotary: [self.density * edgewise, self.density * in_plane],
        }
    }
}

impl Row {
    /// Begins with a node.
    pub(super) fn from(place: Vector3<f64>) -> Self {
        Self { places: vec![place], ..Self::default() }
    }

    /// The last node.
    pub(super) fn last(&self) -> usize {
        self.places.len() - 1
    }

    /// A node at a place along the crank, beside the axis as the last one is, joined by a beam of a section.
    pub(super) fn along(&mut self, z: f64, section: Section) -> usize {
        let from = self.places[self.last()];
        let place = Vector3::new(from.x, from.y, z);
        self.joins.push(Join::Beam(Beam { section, length: z - from.z, axes: along_axis(), tension: 0.0 }, Dissipation::default()));
        self.places.push(place);
        self.last()
    }

    /// A node across the axis, joined by a beam under a tension per square of the speed.
    pub(super) fn across(&mut self, place: Vector3<f64>, section: Section, tension: f64) -> usize {
        let step = place - self.places[self.last()];
        let direction = step / step.norm();
        let axes = Matrix3::from_rows(&[direction.transpose(), Vector3::z().transpose(), direction.cross(&Vector3::z()).transpose()]);
        self.joins.push(Join::Beam(Beam { section, length: step.norm(), axes, tension }, Dissipation::default()));
        self.places.push(place);
        self.last()
    }

    /// A node that only turns about the axis, joined by a spring.
    pub(super) fn turning(&mut self, stiffness: f64, dissipation: Dissipation) -> usize {
        self.places.push(self.places[self.last()]);
        self.joins.push(Join::Torsion(stiffness, dissipation));
        self.last()
    }

    /// Puts a body on a node.
    pub(super) fn put(&mut self, node: usize, body: Body) {
        self.bodies.push((node, body));
    }

    /// The shaft.
    pub(super) fn shaft(&self) -> Shaft {
        let mut shaft = Shaft::new(self.places.clone());
        for (first, join) in self.joins.iter().enumerate() {
            match join {
                Join::Beam(beam, dissipation) => shaft.join(first, beam, *dissipation),
                Join::Torsion(stiffness, dissipation) => shaft.join_in_torsion(first, *stiffness, *dissipation),
            }
        }
        self.bodies.iter().for_each(|(node, body)| shaft.put(*node, body));
        shaft
    }
}
