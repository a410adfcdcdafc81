//! Engine: geometry, layout, pressure.

use super::named::table;
use crate::engine::pressure::{Otto, Wiebe};
use crate::engine::{Engine, Geometry, HarmonicTable, Kinematics, Layout, Pressure, RodModel, SliderCrank, Source};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::{
    BANK_ANGLE, BURN_DURATION, BURN_START, COMPRESSION_RATIO, FRACTION, FRICTION, HEAT_CAPACITY_RATIO, PRESSURE_SCALE, SIGNED_ANGLE,
    WIEBE_EXPONENT, from_below,
};
use crate::input::schema::engine::{
    RawCurve, RawEngine, RawGeometry, RawKinematics, RawLayout, RawOtto, RawPressure, RawTorqueOf, RawWiebe,
};
use crate::input::tables;
use crate::units::{M_PER_MM, PA_PER_BAR, RAD_PER_S_PER_RPM, W_PER_KW};
use std::path::Path;

/// Angle between the banks of opposed cylinders, degrees.
const OPPOSED: f64 = 180.0;

/// The engine, or nothing where a mistake leaves none.
pub(crate) fn resolve(check: &mut Check, raw: &RawEngine, folder: &Path) -> Option<Engine> {
    let strokes = *raw.strokes.get_ref();
    if strokes != 2 && strokes != 4 {
        check.wrong(&raw.strokes, format!("found {strokes}, expected 2 or 4 strokes in a cycle"));
        return None;
    }
    let strokes = strokes as u32;
    let layout = layout(check, &raw.layout, 180.0 * f64::from(strokes));
    let geometry = raw.geometry.as_ref().map(|g| geometry(check, g.get_ref()));
    let source = match (raw.pressure.get_ref(), geometry) {
        (RawPressure::Harmonics(h), masses) => {
            match (h.torque, &raw.geometry) {
                (RawTorqueOf::Throw, Some(geometry)) => check.wrong_with_help(
                    geometry,
                    "found [geometry] with torque harmonics, expected none: the table holds the whole torque of a throw",
                    "`torque = \"gas\"` in [pressure.harmonics] says that it holds the gas of one cylinder only: the masses are then added",
                ),
                (RawTorqueOf::Gas, None) => {
                    check.wrong(&h.file, "found harmonics of the gas without [geometry], expected the masses whose torque is to be added");
                }
                _ => {}
            }
            let read = table(check, &h.file, folder, |path| tables::torque_harmonics(path, strokes))?;
            Source::Harmonics(HarmonicTable { masses, ..read })
        }
        (_, None) => {
            check.wrong(&raw.pressure, "found a cylinder pressure without [geometry], expected bore, crank, rod and masses");
            return None;
        }
        (_, Some(geometry)) => Source::Cylinder { geometry, pressure: pressure(check, &raw.pressure, (folder, strokes))? },
    };
    check.name(&raw.name);
    Some(Engine { name: raw.name.get_ref().clone(), strokes, layout: layout?, source })
}

/// A cylinder pressure; nothing for harmonics, and where its table has a mistake.
pub(super) fn pressure(check: &mut Check, raw: &At<RawPressure>, (folder, strokes): (&Path, u32)) -> Option<Pressure> {
    match raw.get_ref() {
        RawPressure::Otto(raw) => Some(Pressure::Otto(otto(check, raw))),
        RawPressure::Wiebe(raw) => Some(Pressure::Wiebe(wiebe(check, raw))),
        RawPressure::Measured(file) => {
            let cycle = 180.0 * f64::from(strokes);
            table(check, &file.file, folder, |path| tables::pressure_traces(path, cycle)).map(Pressure::Measured)
        }
        RawPressure::Harmonics(_) => None,
    }
}

fn geometry(check: &mut Check, raw: &RawGeometry) -> Geometry {
    let crank_radius = check.positive(&raw.crank_radius_mm) * M_PER_MM;
    let rod_length = check.positive(&raw.rod_length_mm) * M_PER_MM;
    if rod_length <= crank_radius {
        check.wrong(
            &raw.rod_length_mm,
            format!(
                "found a rod of {} mm, expected one longer than the crank radius, {} mm",
                raw.rod_length_mm.get_ref(),
                raw.crank_radius_mm.get_ref()
            ),
        );
    }
    let kinematics = match raw.kinematics {
        RawKinematics::Exact => Kinematics::Exact,
        RawKinematics::Truncated => Kinematics::Truncated,
    };
    Geometry {
        bore: check.positive(&raw.bore_mm) * M_PER_MM,
        slider_crank: SliderCrank { crank_radius, rod_length, kinematics },
        piston_mass: check.not_negative(&raw.piston_mass_kg),
        rod_mass: check.not_negative(&raw.rod_mass_kg),
        rod: rod(check, raw, rod_length, kinematics),
        crankcase_pressure: raw.crankcase_pressure_bar.as_ref().map_or(1.0, |p| check.not_negative(p)) * PA_PER_BAR,
        liner_friction: raw.liner_friction.as_ref().map_or(0.0, |f| check.within(f, &FRICTION)),
    }
}

/// Two masses or a rigid body, as the keys say.
fn rod(check: &mut Check, raw: &RawGeometry, rod_length: f64, kinematics: Kinematics) -> RodModel {
    let expected = "expected `rod_rotating_fraction` (two masses), or `rod_centre_from_big_end_mm` and `rod_inertia_kg_m2` (a rigid body)";
    match (&raw.rod_rotating_fraction, &raw.rod_centre_from_big_end_mm, &raw.rod_inertia_kg_m2) {
        (Some(f), None, None) => return RodModel::TwoMasses { rotating_fraction: fraction(check, f) },
        (None, Some(centre), Some(inertia)) => {
            let centre_from_big_end = check.not_negative(centre) * M_PER_MM;
            if centre_from_big_end > rod_length {
                let words =
                    format!("found {} mm, expected a centre between the eyes, {} mm apart", centre.get_ref(), rod_length / M_PER_MM);
                check.wrong(centre, words);
            }
            if kinematics == Kinematics::Truncated {
                check.wrong(
                    inertia,
                    "found a rigid rod with truncated kinematics, expected `kinematics = \"exact\"`: the series has no rod angle",
                );
            }
            return RodModel::Body { centre_from_big_end, inertia: check.not_negative(inertia) };
        }
        (Some(f), ..) => check.wrong(f, format!("found a fraction beside a centre or an inertia of the rod, {expected}")),
        (None, Some(one), None) | (None, None, Some(one)) => check.wrong(one, format!("found one of two keys, {expected}")),
        (None, None, None) => check.wrong(&raw.rod_mass_kg, format!("found a rod without a centre of mass, {expected}")),
    }
    RodModel::TwoMasses { rotating_fraction: 0.0 }
}

fn fraction(check: &mut Check, raw: &At<f64>) -> f64 {
    let x = *raw.get_ref();
    if x > 1.0 && x <= 100.0 {
        check.wrong_with_help(
            raw,
            format!("found {x}, expected {}", FRACTION.expected()),
            format!("a fraction, not per cent: {x} % is {}", x / 100.0),
        );
        return x;
    }
    check.within(raw, &FRACTION)
}

pub(super) fn layout(check: &mut Check, raw: &RawLayout, cycle: f64) -> Option<Layout> {
    let (rods_per_throw, bank, order, firing) = match raw {
        RawLayout::InLine(l) => (1, None, &l.firing_order, &l.firing_deg),
        RawLayout::V(l) => (2, Some(&l.bank_angle_deg), &l.firing_order, &l.firing_deg),
        RawLayout::Opposed(l) => (1, None, &l.firing_order, &l.firing_deg),
    };
    let before = check.mistakes.len();
    let n = order.get_ref().len();
    if n == 0 || n % rods_per_throw != 0 {
        let expected = if rods_per_throw == 1 { "at least one cylinder" } else { "an even number of cylinders, two on each throw" };
        check.wrong(order, format!("found {n} cylinders, expected {expected}"));
        return None;
    }
    if firing.get_ref().len() != n {
        check.wrong(firing, format!("found {} firing angles, expected one for each of the {n} cylinders", firing.get_ref().len()));
        return None;
    }
    let mut firing_deg = vec![f64::NAN; n];
    for (cylinder, angle) in order.get_ref().iter().zip(firing.get_ref()) {
        let c = *cylinder.get_ref();
        let deg = check.within(angle, &from_below("an angle", 0.0, cycle, " degrees, the cycle"));
        match usize::try_from(c).ok().filter(|c| (1..=n).contains(c)) {
            None => check.wrong(cylinder, format!("found cylinder {c}, expected a number from 1 to {n}")),
            Some(i) if !firing_deg[i - 1].is_nan() => {
                let missing: Vec<String> =
                    (1..=n as i64).filter(|m| order.get_ref().iter().all(|o| o.get_ref() != m)).map(|m| m.to_string()).collect();
                check.wrong(cylinder, format!("found cylinder {c} a second time, expected each once ({} missing)", missing.join(", ")));
            }
            Some(i) => firing_deg[i - 1] = deg,
        }
    }
    for (i, pair) in firing.get_ref().windows(2).enumerate() {
        if pair[1].get_ref() < pair[0].get_ref() {
            let (a, b) = (pair[0].get_ref(), pair[1].get_ref());
            check.wrong(&firing.get_ref()[i + 1], format!("found {b} after {a}, expected firing angles in the order of firing"));
        }
    }
    let bank_angle_deg = bank.map(|b| check.within(b, &BANK_ANGLE));
    if check.mistakes.len() > before {
        return None;
    }
    let split = if let RawLayout::V(v) = raw { v.split_pin_deg.as_ref() } else { None };
    let split_pin_deg = split.map_or(0.0, |s| check.within(s, &SIGNED_ANGLE));
    let opposed = matches!(raw, RawLayout::Opposed(_)).then_some(OPPOSED);
    let layout = Layout { rods_per_throw, firing_deg, bank_angle_deg: bank_angle_deg.or(opposed), split_pin_deg };
    if let (Some(throw), Some(bank)) = (layout.misplaced_throw(), bank) {
        let pair = layout.firing_on_throw(throw);
        let split = (pair[1] - pair[0] - bank.get_ref()).rem_euclid(360.0);
        let split = if split > 180.0 { split - 360.0 } else { split };
        check.wrong_with_help(
            firing,
            format!(
                "found cylinders {} and {} of throw {} firing at {} and {} degrees, expected {} degrees between them{} (up to whole turns)",
                2 * throw + 1,
                2 * throw + 2,
                throw + 1,
                pair[0],
                pair[1],
                bank.get_ref(),
                if split_pin_deg == 0.0 { String::new() } else { format!(", either way, and {split_pin_deg} of the split pins") }
            ),
            format!("where this throw has two pins, the second {split} degrees behind the first, `split_pin_deg = {split}` beside `bank_angle_deg` says so"),
        );
        return None;
    }
    Some(layout)
}

/// Values aligned with a table of speeds.
fn aligned(check: &mut Check, values: &At<Vec<At<f64>>>, speeds: usize) -> Vec<f64> {
    if values.get_ref().len() != speeds {
        check.wrong(values, format!("found {} values, expected one for each of the {speeds} speeds", values.get_ref().len()));
    }
    let list: Vec<f64> = values.get_ref().iter().map(|v| check.not_negative(v)).collect();
    // a mistake stops the study: the missing values are never used
    list.into_iter().chain(std::iter::repeat(0.0)).take(speeds).collect()
}

fn heat_capacity_ratio(check: &mut Check, raw: Option<&At<f64>>, default: f64) -> f64 {
    raw.map_or(default, |k| check.within(k, &HEAT_CAPACITY_RATIO))
}

fn otto(check: &mut Check, raw: &RawOtto) -> Otto {
    let speeds_rpm = check.ascending(&raw.speed_rpm);
    let brake_torque = match &raw.curve {
        RawCurve::Torque(t) => aligned(check, t, speeds_rpm.len()),
        RawCurve::Power(p) => {
            let power = aligned(check, p, speeds_rpm.len());
            power.iter().zip(&speeds_rpm).map(|(p, s)| p * W_PER_KW / (s * RAD_PER_S_PER_RPM)).collect()
        }
    };
    let over_speed = raw.pressure_scale_over_speed.as_ref();
    let scale_over_speed = over_speed.map_or_else(|| vec![1.0; speeds_rpm.len()], |each| aligned(check, each, speeds_rpm.len()));
    Otto {
        speeds_rpm,
        brake_torque,
        compression_ratio: check.within(&raw.compression_ratio, &COMPRESSION_RATIO),
        pressure_scale: check.within(&raw.pressure_scale, &PRESSURE_SCALE),
        scale_over_speed,
        inlet_pressure: raw.inlet_pressure_bar.as_ref().map_or(1.0, |p| check.positive(p)) * PA_PER_BAR,
        heat_capacity_ratio: heat_capacity_ratio(check, raw.heat_capacity_ratio.as_ref(), 1.4),
    }
}

fn wiebe(check: &mut Check, raw: &RawWiebe) -> Wiebe {
    let speeds_rpm = check.ascending(&raw.speed_rpm);
    let mean = aligned(check, &raw.indicated_mean_pressure_bar, speeds_rpm.len());
    let burn_start_deg = check.within(&raw.burn_start_deg, &BURN_START);
    let burn_duration_deg = check.within(&raw.burn_duration_deg, &BURN_DURATION);
    if burn_start_deg + burn_duration_deg > 180.0 {
        check.wrong(
            &raw.burn_duration_deg,
            format!("found a burn to {} degrees, expected its end before 180", burn_start_deg + burn_duration_deg),
        );
    }
    Wiebe {
        speeds_rpm,
        indicated_mean_pressure: mean.iter().map(|p| p * PA_PER_BAR).collect(),
        boost_pressure: check.positive(&raw.boost_bar) * PA_PER_BAR,
        compression_ratio: check.within(&raw.compression_ratio, &COMPRESSION_RATIO),
        burn_start_deg,
        burn_duration_deg,
        shape: raw.wiebe_exponent.as_ref().map_or(2.0, |m| check.within(m, &WIEBE_EXPONENT)),
        heat_capacity_ratio: heat_capacity_ratio(check, raw.heat_capacity_ratio.as_ref(), 1.35),
    }
}
