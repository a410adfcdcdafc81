//! Shank of the rod: an I-section 5 t high, 4 t wide, with web and flanges t thick: buckling by Rankine in both planes, tension and compression by Goodman.

use super::cycle::Cycle;
use super::section::Swing;
use super::specification::Material;
use crate::fatigue::endurance::Loading;
use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// Height over t.
pub(super) const HEIGHT: f64 = 5.0;
/// Area over t².
const AREA: f64 = 11.0;
/// Square of the radius of gyration over t² for buckling in the plane of motion: (4·5³ - 3·3³)/(12·11).
const GYRATION2_IN_PLANE: f64 = 419.0 / 132.0;
/// Across it: (2·4³ + 3)/(12·11).
const GYRATION2_ACROSS: f64 = 131.0 / 132.0;
/// Rankine's constant of steel for ends that turn freely.
const RANKINE: f64 = 1.0 / 7500.0;
/// Share of the height of the section at the small and at the big eye, with the flanges as they are \[Fialho & Almeida 2019\] section 2.4.2.1: 0.75 to 0.9, and 1.1 to 1.25.
#[doc(hidden)]
pub const TAPER: (f64, f64) = (0.9, 1.1);
/// Area over t² where it is lowest.
const AREA_AT_SMALL_EYE: f64 = 10.5;

/// Loads on the shank.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct ShankLoads {
    /// Largest compression, N.
    pub compression: f64,
    /// Largest of tension and compression, N.
    pub largest: f64,
    /// Along the rod at its small and at its big end, N; tension is positive.
    pub force: [Swing; 2],
}

impl ShankLoads {
    /// Of a cycle.
    pub fn of(cycle: &Cycle) -> Self {
        let both = || cycle.rod_tension_small.iter().chain(&cycle.rod_tension_big).copied();
        let force = [&cycle.rod_tension_small, &cycle.rod_tension_big].map(|end| Swing::of(end.iter().copied()));
        Self { compression: both().fold(0.0, |m, f| m.max(-f)), largest: both().fold(0.0, |m, f| m.max(f.abs())), force }
    }
}

/// Of steel, Pa.
const YOUNG_MODULUS: f64 = 206e9;

/// t at which a load buckles the shank, m: P = S_y A/(1 + a (L/k)²) after Rankine \[Fialho & Almeida 2019\] eq. (50), which is quadratic in t², and no more than Euler's pi² E I/L², which
/// Rankine's constant overestimates for strong steels; in the plane of motion with ends that turn on their pins, across it with ends held by them, L/2.
pub fn buckling_thickness(load: f64, yield_strength: f64, length: f64) -> f64 {
    let needed = |length: f64, gyration2: f64| {
        let slender = RANKINE * length * length / gyration2;
        let crushing = AREA * yield_strength;
        let rankine = ((load + (load * load + 4.0 * crushing * load * slender).sqrt()) / (2.0 * crushing)).sqrt();
        rankine.max((load * length * length / (PI * PI * YOUNG_MODULUS * AREA * gyration2)).power(0.25))
    };
    needed(length, GYRATION2_IN_PLANE).max(needed(0.5 * length, GYRATION2_ACROSS))
}

/// t of the smallest section against yielding and against fatigue, for a factor, m. A mean compression counts as none.
pub(super) fn axial_thickness(loads: &ShankLoads, material: &Material, factor: f64) -> [f64; 2] {
    let limit = material.fatigue_limit(Loading::Axial, 0.0);
    let thickness = |area: f64| (factor * area / AREA_AT_SMALL_EYE).sqrt();
    let goodman = |force: Swing| force.amplitude / limit + force.mean.max(0.0) / material.tensile;
    [thickness(loads.largest / material.yield_strength), thickness(loads.force.map(goodman).into_iter().fold(0.0, f64::max))]
}

/// Force that buckles a shank, N.
pub fn buckling_load(thickness: f64, yield_strength: f64, length: f64) -> f64 {
    let crushing = AREA * thickness * thickness * yield_strength;
    let load = |length: f64, gyration2: f64| {
        let slender = length * length / (gyration2 * thickness * thickness);
        (crushing / (1.0 + RANKINE * slender)).min(PI * PI * YOUNG_MODULUS * AREA * thickness * thickness / slender)
    };
    load(length, GYRATION2_IN_PLANE).min(load(0.5 * length, GYRATION2_ACROSS))
}
