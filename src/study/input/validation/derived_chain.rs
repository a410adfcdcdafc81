//! Inertias and stiffnesses of stations that the file leaves to the dimensions of the crank.

use crate::crankshaft::Crank;
use crate::drivetrain::throw_stiffness::{Step, shear_modulus, stepped_shaft, stiffness};
use crate::drivetrain::{Station, throw_inertia};
use crate::engine::{Engine, Source};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::SECTOR;
use crate::input::schema::crank::{RawCrank, RawMasses, RawRing};
use crate::input::schema::engine::{RawEngine, RawStation};
use crate::input::schema::step::RawStep;
use crate::units::{M_PER_MM, RAD_PER_DEG};

/// Of steel, GPa.
pub(super) const YOUNG_MODULUS: f64 = 206.0;

/// Masses that the file describes beside the dimensions of the crank.
pub(super) fn masses(check: &mut Check, raw: &RawMasses) -> throw_inertia::Masses {
    let mut mm = |value: &At<f64>| check.not_negative(value) * M_PER_MM;
    let (web_height, web_centre) = (mm(&raw.web_height_mm), mm(&raw.web_centre_mm));
    let counterweight = raw.counterweight.as_ref().map(|c| throw_inertia::Sector {
        outer_radius: mm(&c.outer_radius_mm),
        inner_radius: mm(&c.inner_radius_mm),
        thickness: mm(&c.thickness_mm),
        angle: 0.0,
    });
    let counterweight = counterweight.zip(raw.counterweight.as_ref()).map(|(sector, c)| {
        if sector.inner_radius >= sector.outer_radius {
            check.wrong(&c.inner_radius_mm, "found an inner radius of at least the outer one, expected a smaller one");
        }
        let angle = check.within(&c.angle_deg, &SECTOR) * RAD_PER_DEG;
        throw_inertia::Sector { angle, ..sector }
    });
    let rings = raw.rings.iter().map(|ring| (ring_step(check, ring), ring.cut)).collect();
    throw_inertia::Masses { density: check.positive(&raw.density_kg_m3), web_height, web_centre, counterweight, rings }
}

fn ring_step(check: &mut Check, raw: &RawRing) -> Step {
    steps(check, &[RawStep { diameter_mm: raw.diameter_mm.clone(), bore_mm: raw.bore_mm.clone(), length_mm: raw.length_mm.clone() }])[0]
}

pub(super) fn steps(check: &mut Check, raw: &[RawStep]) -> Vec<Step> {
    let step = |s: &RawStep| {
        let diameter = check.positive(&s.diameter_mm) * M_PER_MM;
        let bore = s.bore_mm.as_ref().map_or(0.0, |b| check.not_negative(b)) * M_PER_MM;
        if let Some(b) = s.bore_mm.as_ref().filter(|_| bore >= diameter) {
            check.wrong(b, format!("found a bore of {} mm, expected one below the diameter, {} mm", b.get_ref(), s.diameter_mm.get_ref()));
        }
        Step { diameter, bore, length: check.positive(&s.length_mm) * M_PER_MM }
    };
    raw.iter().map(step).collect()
}

/// Fills in what the file leaves out, and says of each station whether the stiffness after it comes from dimensions.
pub(super) fn derive(
    check: &mut Check,
    raw: &RawEngine,
    engine: Option<&Engine>,
    crank: Option<&Crank>,
    stations: &mut [Station],
) -> Vec<bool> {
    let raw_crank = raw.crank.as_ref().map(|c| c.get_ref());
    if raw_crank.is_some() && crank.is_none() && engine.is_some() {
        // its mistakes have been reported, and what follows from it is open
        for (s, station) in raw.station.iter().zip(stations.iter_mut()) {
            station.inertia = s.inertia_kg_m2.as_ref().map_or(1.0, |given| check.positive(given));
        }
        let given = |s: &RawStation| s.stiffness_to_next_n_m_per_rad.is_some() || s.gear_ratio_to_next.is_some();
        return raw.station.iter().enumerate().map(|(i, s)| !given(s) && i + 1 < raw.station.len()).collect();
    }
    for (s, station) in raw.station.iter().zip(stations.iter_mut()) {
        station.inertia = match &s.inertia_kg_m2 {
            Some(given) => check.positive(given),
            None => derived_inertia(check, s, engine, crank).unwrap_or(1.0),
        };
    }
    (0..stations.len()).map(|i| derived_stiffness(check, raw, i, (crank, raw_crank), stations)).collect()
}

fn derived_inertia(check: &mut Check, s: &RawStation, engine: Option<&Engine>, crank: Option<&Crank>) -> Option<f64> {
    let name = s.name.get_ref();
    if s.throws.is_empty() {
        check.wrong(&s.name, format!("found no `inertia_kg_m2` on `{name}`, expected it: only that of a throw follows from [crank]"));
        return None;
    }
    let Some(crank) = crank else {
        check.wrong(&s.name, format!("found no `inertia_kg_m2` on `{name}`, expected it or [crank] with the throw's dimensions"));
        return None;
    };
    let Some(masses) = &crank.masses else {
        let help =
            "masses = { density_kg_m3, web_height_mm, web_centre_mm, counterweight, rings } has what the other dimensions leave open";
        let words = format!("found no `inertia_kg_m2` on `{name}`, expected it or `masses` in [crank]");
        check.wrong_with_help(&s.name, words, help);
        return None;
    };
    let Source::Cylinder { geometry, .. } = &engine?.source else { return None };
    let rods = engine?.layout.rods_per_throw as f64 * geometry.rod_rotating_fraction() * geometry.rod_mass;
    let of_throw = |t: &usize| throw_inertia::throw_inertia(&crank.throw(*t), masses, rods);
    let throws: Vec<usize> = s.throws.iter().filter_map(|t| usize::try_from(*t.get_ref() - 1).ok()).collect();
    let sum: f64 = throws.iter().filter(|t| **t < crank.throws()).map(of_throw).sum();
    if sum <= 0.0 {
        check.wrong(
            &s.name,
            format!(
                "found an inertia of {sum:.4} kg m² for `{name}` from [crank], expected one above zero: its cuts take more than there is"
            ),
        );
        return None;
    }
    Some(sum)
}

/// Whether the stiffness after a station was put in.
fn derived_stiffness(
    check: &mut Check,
    raw: &RawEngine,
    i: usize,
    (crank, raw_crank): (Option<&Crank>, Option<&RawCrank>),
    stations: &mut [Station],
) -> bool {
    let s = &raw.station[i];
    if s.stiffness_to_next_n_m_per_rad.is_some() {
        if let Some(shaft) = &s.shaft_to_next {
            check.wrong(shaft, "found `shaft_to_next` beside `stiffness_to_next_n_m_per_rad`, expected one of them");
        }
        return false;
    }
    // a mesh without a stiffness of its own is rigid
    if s.gear_ratio_to_next.is_some() && s.shaft_to_next.is_none() {
        return false;
    }
    let next = match &s.next {
        Some(next) => raw.station.iter().position(|other| other.name.get_ref() == next.get_ref()),
        None => (i + 1 < raw.station.len()).then_some(i + 1),
    };
    if let (Some(shaft), None) = (&s.shaft_to_next, next) {
        check.wrong(shaft, "found `shaft_to_next` on the last station, expected none");
        return false;
    }
    let shaft = s.shaft_to_next.as_ref().map(|list| steps(check, list.get_ref()));
    let formula = raw_crank.and_then(|c| c.stiffness_formula.as_ref());
    let throws: Vec<usize> =
        next.map_or_else(Vec::new, |n| [&stations[i], &stations[n]].iter().filter_map(|s| s.throws.first().copied()).collect());
    let modulus = crank.map_or_else(|| shear_modulus(YOUNG_MODULUS * crate::units::PA_PER_GPA), |c| shear_modulus(c.young_modulus));
    let along = shaft.as_ref().map(|steps| 1.0 / stepped_shaft(steps, modulus));
    let flexibility = match (crank, formula, throws.as_slice(), along) {
        (Some(crank), Some(formula), throws @ ([_, _] | [_]), along) if throws.len() == 2 || along.is_some() => {
            let own = formula.get_ref().0;
            if stations[i].throws.len() > 1 || next.is_some_and(|n| stations[n].throws.len() > 1) {
                check.wrong(
                    &s.name,
                    "found several throws on a station whose link follows from dimensions, expected a station for each throw",
                );
            }
            let half = |t: &usize| {
                let throw = crank.throw(*t);
                if let Some(why) = own.out_of_range(&throw) {
                    check.wrong(formula, format!("found `{}`, {why}: expected another formula or the stiffness itself", own.name()));
                }
                0.5 / stiffness(own.flexibility(&throw), modulus)
            };
            Some(throws.iter().map(half).sum::<f64>() + along.unwrap_or(0.0))
        }
        (_, _, [], Some(along)) => Some(along),
        (_, None, [_, ..], Some(_)) => {
            if let Some(list) = &s.shaft_to_next {
                check.wrong(list, "found a shaft beside a throw without `stiffness_formula` in [crank], expected it: half of the throw is part of the link");
            }
            None
        }
        _ => None,
    };
    match flexibility {
        Some(f) => {
            stations[i].stiffness_to_next = 1.0 / f;
            true
        }
        None => false,
    }
}
