//! Forces and moments of a sized slider-crank over the cycle.

use super::results::FrontPoint;
use crate::analysis::curves::{ACCELERATION, Axis, CRANK_DEG, Curve, FORCE, Figure, MOMENT, Panel, Scale, TORQUE, TRAVEL, VELOCITY, curve};
use crate::engine::kinematics::{Kinematics, SliderCrank};
use crate::input::SizingStudy;
use crate::numerics::elementary::Elementary;
use crate::sizing::Sized;
use crate::sizing::crank::shares;
use crate::sizing::cycle::{Cycle, Gas};
use crate::units::{DEG_PER_RAD, M_PER_MM, RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// Forces at the joints, along and across rod and crank, and moments at the sections, for the lowest and the highest speed.
pub(super) fn figures(study: &SizingStudy, sized: &Sized) -> Vec<Figure> {
    let fired: Vec<usize> = (0..sized.cycles.len()).filter(|i| sized.cycles[*i].filling == Gas::Fired).collect();
    let mut shown = vec![fired[0], fired[fired.len() - 1]];
    shown.dedup();
    let both = |i: usize| {
        let (cycle, throws) = (&sized.cycles[i], &sized.throws[i]);
        let name = format!("{}_rpm", cycle.speed_rpm);
        [kinematics(study, cycle, &name), forces(study, cycle, &name), moments(study, cycle, throws, &name)]
    };
    shown.into_iter().flat_map(both).collect()
}

fn panel(title: &str, y: Axis, curves: Vec<Curve>) -> Panel {
    Panel { title: title.into(), x: CRANK_DEG, y, curves, scale: Scale::Own }
}

fn slider_crank(study: &SizingStudy) -> SliderCrank {
    let spec = &study.specification;
    SliderCrank { crank_radius: spec.crank_radius(), rod_length: spec.rod_length, kinematics: Kinematics::Exact }
}

/// Travel from dead centre, velocity and acceleration of the piston.
fn kinematics(study: &SizingStudy, cycle: &Cycle, name: &str) -> Figure {
    let crank = slider_crank(study);
    let omega = cycle.speed_rpm * RAD_PER_S_PER_RPM;
    let line =
        |f: &dyn Fn(f64) -> f64| vec![curve("piston", cycle.crank_deg.iter().copied(), cycle.crank_deg.iter().map(|d| f(d * RAD_PER_DEG)))];
    Figure {
        name: format!("sizing_kinematics_{name}"),
        title: format!("{}: motion of the piston at {} rpm", study.title, cycle.speed_rpm),
        panels: vec![
            panel("travel", TRAVEL, line(&|t| crank.motion(t).travel / M_PER_MM)),
            panel("velocity", VELOCITY, line(&|t| crank.motion(t).slope * omega)),
            panel("acceleration", ACCELERATION, line(&|t| crank.motion(t).curvature * omega * omega)),
        ],
    }
}

fn forces(study: &SizingStudy, cycle: &Cycle, name: &str) -> Figure {
    let over = |label: &str, y: &[f64]| curve(label, cycle.crank_deg.iter().copied(), y.iter().copied());
    let crank = slider_crank(study);
    // tension and cross force turned back by the lean of the rod
    let on_pin = |j: usize| {
        let (sine, cosine) = crank.lean(cycle.crank_deg[j] * RAD_PER_DEG).angle.sine_cosine();
        let (tension, across) = (cycle.rod_tension_small[j], cycle.rod_across_small[j]);
        [-(tension * cosine + across * sine), tension * sine - across * cosine]
    };
    let on_pin: Vec<[f64; 2]> = (0..cycle.crank_deg.len()).map(on_pin).collect();
    let part = |axis: usize| on_pin.iter().map(|f| f[axis]).collect::<Vec<f64>>();
    Figure {
        name: format!("sizing_forces_{name}"),
        title: format!("{}: forces at {} rpm", study.title, cycle.speed_rpm),
        panels: vec![
            panel("piston", FORCE, vec![over("gas", &cycle.gas), over("liner", &cycle.liner)]),
            panel(
                "rod: tension is positive",
                FORCE,
                vec![
                    over("along, small end", &cycle.rod_tension_small),
                    over("along, big end", &cycle.rod_tension_big),
                    over("across, small end", &cycle.rod_across_small),
                    over("across, big end", &cycle.rod_across_big),
                ],
            ),
            panel(
                "rod on piston pin, in axes of the cylinder",
                FORCE,
                vec![over("along it, away from the crank", &part(0)), over("across it", &part(1))],
            ),
            panel("crankpin", FORCE, vec![over("radial, outwards", &cycle.radial), over("tangential", &cycle.tangential)]),
        ],
    }
}

fn moments(study: &SizingStudy, cycle: &Cycle, throws: &[crate::sizing::crank::ThrowLoads], name: &str) -> Figure {
    let spec = &study.specification;
    let degrees = || cycle.crank_deg.iter().copied();
    let arm = shares(&spec.bearings).0 * spec.bearings.before;
    let bending = |f: &[f64]| f.iter().map(|f| f * arm).collect::<Vec<f64>>();
    let pin = cycle.rod_tension_small.iter().map(|p| p * spec.bore / 8.0);
    let crankpin = vec![
        curve("by the radial force", degrees(), bending(&cycle.radial)),
        curve("by the tangential force", degrees(), bending(&cycle.tangential)),
    ];
    let torque = throws.iter().enumerate().map(|(i, t)| curve(format!("after throw {}", i + 1), degrees(), t.torque_after.iter().copied()));
    Figure {
        name: format!("sizing_moments_{name}"),
        title: format!("{}: moments at {} rpm", study.title, cycle.speed_rpm),
        panels: vec![
            panel("bending of the piston pin", MOMENT, vec![curve("middle of the pin", degrees(), pin)]),
            panel("bending of the crankpin", MOMENT, crankpin),
            panel("torque in the crank", TORQUE, torque.collect()),
        ],
    }
}

const RING: Axis = Axis { column: "ring_inertia_kg_m2", label: "ring inertia / kg m²" };
const MASS: Axis = Axis { column: "crank_mass_kg", label: "mass / kg" };
const TWIST: Axis = Axis { column: "peak_twist_deg", label: "twist / °" };

/// Crank mass and twist against ring inertia, beside those without absorber.
#[doc(hidden)]
pub fn front_figure(study: &SizingStudy, front: &[FrontPoint]) -> Figure {
    let rings: Vec<&FrontPoint> = front.iter().filter(|p| p.ring_inertia > 0.0).collect();
    let panel = |title: &str, y: Axis, value: &dyn Fn(&FrontPoint) -> f64| {
        let line = |points: &[&FrontPoint], label: &str, level: Option<f64>| {
            curve(label, points.iter().map(|p| p.ring_inertia), points.iter().map(|p| level.unwrap_or_else(|| value(p))))
        };
        let none = front.iter().find(|p| p.ring_inertia == 0.0).map(|p| line(&rings, "without absorber", Some(value(p))));
        Panel {
            title: title.into(),
            x: RING,
            y,
            curves: std::iter::once(line(&rings, "with absorber", None)).chain(none).collect(),
            scale: Scale::Own,
        }
    };
    Figure {
        name: "sizing_front".into(),
        title: format!("{}: crank sized to one factor, by its absorber", study.title),
        panels: vec![
            panel("mass of the crank", MASS, &|p| p.crank_mass),
            panel("largest twist", TWIST, &|p| p.response.twist * DEG_PER_RAD),
        ],
    }
}
