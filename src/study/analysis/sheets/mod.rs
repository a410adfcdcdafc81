//! What a damper is ordered by: dimensions, masses, stiffness at the frequency that counts, strain, stress or swing, heat, and how many of those that are made hold the limits.

mod acceptance;
mod holding;

use acceptance::damping;
pub use acceptance::{Band, Measured};
pub use holding::Holding;

use super::heat::HeatOfDesign;
use super::required_material::{OnHeldHub, at_own_frequency};
use super::{DesignResult, Progress};
use crate::absorber::substance::Outside;
use crate::absorber::{Law, Medium, Mounted, Operating, Parts, Shape, Substance, construction};
use crate::input::Study;
use crate::numerics::elementary::Elementary;
use crate::objective::{Condition, Measure, Over, PeakFinder, mass};
use crate::optimise::{LoadCase, Tolerances, largest};
use crate::response::{Quantity, ResponseError, Work};
use crate::units::{HZ_PER_RAD_PER_S, M_PER_MM, RAD_PER_S_PER_RPM};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// A damper by its dimensions, as it is ordered, SI.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Sheet {
    /// Name of the design.
    pub design: String,
    /// Index of the absorber.
    pub absorber: usize,
    /// Type.
    pub kind: &'static str,
    /// The same.
    #[serde(skip)]
    pub shape: &'static Shape,
    /// The compound or oil.
    #[serde(skip)]
    pub substance: Option<Arc<Substance>>,
    /// Values of its dimensions by their keys.
    pub dimensions: Vec<(&'static str, f64)>,
    /// What they come to.
    #[serde(skip)]
    pub parts: Parts<f64>,
    /// Inertia of the ring, kg m².
    pub ring_inertia: f64,
    /// Of all of it, kg.
    pub mass: f64,
    /// Of what is sheared, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sheared_mass: Option<f64>,
    /// Of the springs, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_mass: Option<f64>,
    /// Stiffness at no frequency, N m/rad, of rubber and springs.
    pub static_stiffness: Option<f64>,
    /// Damping at low frequency, N m s/rad, of oil.
    pub damping: Option<f64>,
    /// The ring on its held hub at the reference of its material.
    #[serde(skip)]
    pub on_held_hub: Option<OnHeldHub>,
    /// In each condition of the study: at the frequency of the largest order at the peak of the twist.
    pub at_peak: Vec<AtPeak>,
    /// Largest shear strain in the conditions that a design is to hold in, of rubber and oil.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain: Option<f64>,
    /// Shear stress of that strain, Pa, where it is largest, with the largest modulus of `at_peak`; of springs the largest stress in the same conditions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress: Option<f64>,
    /// Of pendulum masses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing: Option<Swing>,
    /// Largest mean power in the same conditions, W.
    pub power: f64,
    /// Largest temperature that is reached from cold, °C, where it is told what cools it; infinite where it overheats.
    pub celsius: Option<f64>,
    /// What is outside of where the numbers of its compound or oil hold.
    #[serde(skip)]
    pub outside: Vec<Outside>,
    /// How many of those that are made hold all limits.
    pub holding: Option<Holding>,
    /// The number that a maker measures, and within what every damper holds all limits.
    pub acceptance: Option<Band>,
}

/// Pendulum masses, and how far they swing.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Swing {
    /// Order that they are tuned to.
    pub tuning_order: f64,
    /// Of the centre of each from the axis, m.
    pub centre_radius: f64,
    /// Mass of each, kg.
    pub each: f64,
    /// Largest arc of a centre to each side, m, in the conditions that a design is to hold in.
    pub arc: f64,
    /// The same as the angle of the path, rad.
    pub angle: f64,
    /// Largest radius that a corner of a mass comes to, m, its path being a circle.
    pub reach: f64,
}

/// The dynamic stiffness that counts in a condition.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct AtPeak {
    /// The condition.
    pub condition: Condition,
    /// Frequency of the largest order at the peak, Hz.
    pub frequency_hz: f64,
    /// Real part of S, N m/rad.
    pub stiffness: f64,
    /// Imaginary part, N m/rad.
    pub loss_stiffness: f64,
    /// Imaginary over real part.
    pub loss_factor: f64,
}

/// Every design that is shown with a damper by its dimensions.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
pub(super) fn sheets<'d>(
    study: &Study,
    (finder, cases): (&PeakFinder, &[LoadCase]),
    (shown, heat): (&[&'d DesignResult], &[HeatOfDesign]),
    progress: &dyn Progress,
) -> Result<Vec<Sheet>, (&'d DesignResult, ResponseError)> {
    let with: Vec<(&&DesignResult, Found)> = shown.iter().filter_map(|d| Some((d, first(d)?))).collect();
    if with.is_empty() {
        return Ok(Vec::new());
    }
    progress.stage("order sheets", with.len());
    let one = |(d, found): &(&&'d DesignResult, Found)| {
        let made = sheet(study, (finder, cases), (d, *found), heat).map_err(|error| (**d, error));
        progress.step();
        made
    };
    with.par_iter().map(one).collect()
}

/// A damper by its dimensions: its index, its law, what it comes to, and its shape.
type Found<'a> = (usize, &'a Arc<dyn Law>, &'a Parts<f64>, &'static Shape);

/// The first damper by its dimensions of a design.
fn first(d: &DesignResult) -> Option<Found<'_>> {
    let found = |(i, m): (usize, &'_ Mounted)| -> Option<usize> {
        let law = m.absorber.law()?;
        law.parts().zip(construction::shape(law.declaration())).map(|_| i)
    };
    let index = d.absorbers.iter().enumerate().find_map(found)?;
    let law = d.absorbers[index].absorber.law()?;
    Some((index, law, law.parts()?, construction::shape(law.declaration())?))
}

fn sheet(
    study: &Study,
    (finder, cases): (&PeakFinder, &[LoadCase]),
    (d, (absorber, law, parts, shape)): (&DesignResult, Found),
    heat: &[HeatOfDesign],
) -> Result<Sheet, ResponseError> {
    let mounted = &d.absorbers[absorber];
    let substance = law.material().and_then(|m| m.substance.clone());
    let values = law.values();
    let dimensions: Vec<(&'static str, f64)> =
        shape.declaration.parameters.iter().map(|p| p.key).zip(values.iter().copied()).take(shape.drawn().len()).collect();
    let at_peak = at_peaks(study, finder, (d, absorber));
    // the worst of the conditions, which all have the same dimensions
    let worst = |over: Over| {
        let measure = Measure::new(vec![Quantity::RingTwist(absorber)], over);
        largest(cases.iter(), &d.absorbers, &measure, &mut Work::default())
    };
    let (twist, power) = (worst(Over::Synthesis)?, worst(Over::Power)?);
    let strain = law.strain_per_twist().map(|by| by * twist);
    let modulus_of = |p: &AtPeak| p.stiffness.hypotenuse(p.loss_stiffness) / parts.factor;
    let modulus = at_peak.iter().map(modulus_of).fold(0.0, f64::max);
    let stress = strain.map(|s| modulus * s).or_else(|| law.stress_per_twist().map(|by| by * twist));
    let mass = mass(law.as_ref(), parts);
    let celsius = heat.iter().find(|h| h.design == d.name && h.absorber == absorber).map(|h| {
        let reached = |p: &super::HeatAt| p.cold_start().map_or(f64::INFINITY, |b| b.celsius);
        h.points.iter().map(reached).fold(f64::NEG_INFINITY, f64::max)
    });
    let temperatures = [study.temperatures.cold, study.temperatures.hot, celsius.filter(|c| c.is_finite())];
    let temperatures: Vec<f64> = temperatures.into_iter().flatten().collect();
    let frequencies: Vec<f64> = at_peak.iter().map(|p| p.frequency_hz).collect();
    let outside = substance.as_ref().map_or_else(Vec::new, |s| s.valid.outside(&frequencies, &temperatures, strain.unwrap_or(0.0)));
    let scatter = study.robust.as_ref().map_or_else(Vec::new, |r| r.scatter());
    let tolerances = Tolerances::scattered_of(&d.absorbers, &scatter);
    let is_made = tolerances.edges() > 0 && study.limits.iter().any(|l| !l.of.measure.is_inertia());
    let seed = study.optimise.as_ref().map_or(1, |o| o.seed);
    let sampling = study.robust.as_ref().and_then(|r| r.sampling).filter(|_| is_made);
    let holding = sampling.map(|s| holding::holding(study, cases, &d.absorbers, (&tolerances, s, seed)));
    let acceptance = if is_made { acceptance::acceptance(study, cases, (&d.absorbers, absorber), (&scatter, seed)) } else { None };
    Ok(Sheet {
        design: d.name.clone(),
        absorber,
        kind: shape.declaration.name,
        shape,
        swing: (shape.medium == Medium::Field).then(|| swing(parts, &dimensions, twist)),
        dimensions,
        ring_inertia: law.ring_inertia(),
        sheared_mass: shape.medium.is_sheared().then_some(mass - parts.ring_mass - parts.hub_mass),
        spring_mass: shape.medium.is_spring().then_some(mass - parts.ring_mass - parts.hub_mass),
        mass,
        static_stiffness: (shape.medium == Medium::Rubber || shape.medium.is_spring()).then(|| static_stiffness(law.as_ref())),
        damping: (shape.medium == Medium::Oil).then(|| damping(law.as_ref())),
        on_held_hub: at_own_frequency(&mounted.absorber),
        at_peak,
        strain,
        stress,
        power,
        celsius,
        outside,
        holding,
        acceptance,
        parts: *parts,
        substance,
    })
}

/// Of pendulum masses whose ring has this twist, rad.
fn swing(parts: &Parts<f64>, dimensions: &[(&'static str, f64)], twist: f64) -> Swing {
    let of = |key: &str| dimensions.iter().find(|d| d.0 == key).map_or(0.0, |d| d.1);
    let (arc, path) = (parts.radius * twist, of("path_radius_mm") * M_PER_MM);
    let (corner, angle) = (PI * of("filled_share") / of("masses"), arc / path);
    // a corner moves on a circle of the path's radius about this point, and is farthest out in line with it
    let (outward, along) = (parts.ring[1] * corner.cosine() - path, parts.ring[1] * corner.sine());
    let comes_in_line = angle >= PI || along * angle.cosine() <= outward * angle.sine();
    let reach = if comes_in_line {
        path + outward.hypotenuse(along)
    } else {
        (outward + path * angle.cosine()).hypotenuse(along + path * angle.sine())
    };
    Swing {
        tuning_order: parts.factor.max(0.0).sqrt(),
        centre_radius: parts.radius,
        each: parts.ring_mass / of("masses"),
        arc,
        angle,
        reach,
    }
}

/// Real part of S at no frequency, N m/rad.
fn static_stiffness(law: &dyn Law) -> f64 {
    law.dynamic_stiffness(Operating { omega: 0.0, shaft_speed: 0.0 }).re
}

/// The dynamic stiffness at the peak of the reported twist, while all cylinders fire and in each state of the material.
fn at_peaks(study: &Study, finder: &PeakFinder, (d, absorber): (&DesignResult, usize)) -> Vec<AtPeak> {
    let of = |condition: Condition, peak: &crate::objective::Peak| -> Option<AtPeak> {
        let design = condition.absorbers(&d.absorbers);
        let law = design[absorber].absorber.law()?;
        let omega = finder.system.excitation.orders[peak.order].omega(peak.speed_rpm);
        let s = law.dynamic_stiffness(Operating { omega, shaft_speed: peak.speed_rpm * RAD_PER_S_PER_RPM });
        let loss_factor = if s.re == 0.0 { f64::INFINITY } else { s.im / s.re };
        Some(AtPeak { condition, frequency_hz: omega * HZ_PER_RAD_PER_S, stiffness: s.re, loss_stiffness: s.im, loss_factor })
    };
    let states = study.conditions.iter().filter(|c| c.material().is_some());
    let in_state = states.filter_map(|c| of(*c, d.conditions.iter().find(|r| r.condition == *c)?.twist.as_ref()?));
    d.twist.as_ref().and_then(|p| of(Condition::Firing, p)).into_iter().chain(in_state).collect()
}
