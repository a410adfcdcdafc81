//! The flexible crank: its keys checked, and put together with the chain.

use super::absorbers::DesignSpec;
use super::checked_study::CrankModel;
use super::flexible_model::FlexibleModel;
use super::{derived_chain, imported};
use crate::crankshaft::Crank;
use crate::crankshaft::flexible::{
    BeamCrank, Bearing, BearingNodes, Carried, CarriedRing, CrankBody, End, FlexibleSpec, JointSpec, LinearBearings, WebFactors, assemble,
};
use crate::drivetrain::Chain;
use crate::engine::Engine;
use crate::input::error::{At, Check};
use crate::input::schema::bounds::{BEARING_STIFFNESS, DAMPING_TIME, LOOSE_RATIO, LOSS_FACTOR, OIL_PRESSURE, REACH, WEB_FACTOR};
use crate::input::schema::engine::RawEngine;
use crate::input::schema::flexible::{RawBearing, RawCarriedRing, RawEnd, RawFlexible, RawWebFactors};
use crate::input::schema::study::RawStudy;
use crate::units::PA_PER_MPA;
use std::path::Path;
use std::sync::Arc;

/// Step of the shafts at the ends, mm.
const SHORTEST_STEP_MM: f64 = 1.0;
/// A journal with three nodes is at least this share of its diameter long.
const SHORTEST: f64 = 0.2;

/// What of the crank a study asks for.
fn asked(check: &mut Check, study: &RawStudy, known: bool, designs: &[&DesignSpec]) -> CrankModel {
    let Some(raw) = &study.crank else { return CrankModel::Chain };
    let model = CrankModel::from(*raw.get_ref());
    if model == CrankModel::Chain {
        return model;
    }
    if !known {
        check.wrong(raw, "found a flexible crank without [crank.flexible] in the engine file, expected its bearings, ends and webs there");
    }
    let large = |d: &&DesignSpec| d.absorbers.iter().filter_map(|m| m.absorber.law()).any(|law| law.large_twist().is_some());
    if let Some(d) = designs.iter().copied().find(large) {
        check.wrong(
            raw,
            format!("found a flexible crank with design `{}`, whose law is of large twist, expected `crank = \"chain\"` for it", d.name),
        );
    }
    if let Some(calibrate) = &study.calibrate {
        check.wrong(
            calibrate,
            "found [calibrate] with a flexible crank, expected `crank = \"chain\"`: what is fitted are stiffnesses of the chain",
        );
    }
    model
}

/// The flexible crank of an engine file, and what of the crank a study with these designs asks for.
pub(super) fn of_study(
    (check, in_engine): (&mut Check, &mut Check),
    (study, engine, folder): (&RawStudy, &RawEngine, &Path),
    parts: (Option<&Crank>, &Engine, &Chain),
    speeds_rpm: &[f64],
    designs: &[&DesignSpec],
) -> (Option<FlexibleModel>, CrankModel) {
    let flexible = resolve(in_engine, (engine, folder), parts);
    let known = flexible.is_some() || !in_engine.mistakes.is_empty();
    let model = asked(check, study, known, designs);
    // a study on the chain does not ask for what cycles tell of its bearings
    let (Some(own), Some(crank)) = (&flexible, parts.0) else { return (flexible, model) };
    if model == CrankModel::Chain || own.spec.joints.is_none() || !check.mistakes.is_empty() {
        return (flexible, model);
    }
    match own.with_nearest_bearings(speeds_rpm, (crank, parts.1, parts.2)) {
        Ok(settled) => (Some(settled), model),
        Err(why) => {
            if let Some(raw) = engine.crank.as_ref().and_then(|c| c.get_ref().flexible.as_ref()) {
                in_engine
                    .wrong(raw, format!("found bearings on which no periodic motion of the crank was found, expected other ones: {why}"));
            }
            (flexible, model)
        }
    }
}

/// The crank put together, or nothing where a mistake leaves none.
fn resolve(
    check: &mut Check,
    (raw, folder): (&RawEngine, &Path),
    (crank, engine, chain): (Option<&Crank>, &Engine, &Chain),
) -> Option<FlexibleModel> {
    let (table, crank) = (raw.crank.as_ref()?, crank?);
    let own = table.get_ref().flexible.as_ref()?;
    let before = check.mistakes.len();
    let spec = spec(check, (own, folder), crank, chain)?;
    if check.mistakes.len() > before {
        return None;
    }
    match assemble(crank, engine, chain, &spec, Carried::All) {
        Ok(assembled) => Some(FlexibleModel::new(spec, assembled)),
        Err(why) => {
            check.wrong(own, format!("found a crank that does not fit its chain, expected one that does: {why}"));
            None
        }
    }
}

fn spec(check: &mut Check, (at, folder): (&At<RawFlexible>, &Path), crank: &Crank, chain: &Chain) -> Option<FlexibleSpec> {
    let raw = at.get_ref();
    let (body, nodes) = match &raw.matrices {
        None => (CrankBody::Beams(beams(check, at, crank, chain)?), nodes(check, &raw.bearing)),
        Some(_) => {
            let own = imported::resolve(check, at, folder)?;
            let nodes = points(check, at, &own.journals);
            (CrankBody::Matrices(Arc::new(own)), nodes)
        }
    };
    let short = |l: &f64| *l < SHORTEST * crank.journal_diameter;
    if matches!(body, CrankBody::Beams(_)) && nodes == BearingNodes::Three && crank.journal_lengths.iter().any(short) {
        check.wrong(at, "found three points along a journal shorter than 0.2 of its diameter, expected `nodes = 1`");
    }
    let (bearing, joints) = bearings(check, (at, nodes), crank)?;
    let (thrust_at, thrust) = thrust(check, raw, crank)?;
    let loss_factor = check.within(&raw.loss_factor, &LOSS_FACTOR);
    if loss_factor == 0.0 && bearing.damping == 0.0 {
        check.wrong(
            &raw.loss_factor,
            "found neither a loss factor nor damping of the bearings, expected one of them: nothing else damps bending",
        );
    }
    Some(FlexibleSpec {
        body,
        loss_factor,
        rotating: raw.rotating.unwrap_or(true),
        bearing: LinearBearings::Alike(bearing),
        joints,
        nodes,
        thrust_at,
        thrust,
    })
}

/// Points along each journal of a crank by matrices: the law of an exponential bearing wants all alike.
fn points(check: &mut Check, at: &At<RawFlexible>, journals: &[Vec<u64>]) -> BearingNodes {
    let nodes = if journals.first().is_some_and(|points| points.len() == 1) { BearingNodes::One } else { BearingNodes::Three };
    if at.get_ref().bearing.exponential.is_some() && journals.iter().any(|points| points.len() != nodes.count()) {
        check.wrong(at, "found journals of other numbers of points with `bearing.exponential`, expected one or three points on each");
    }
    nodes
}

/// The crank by its dimensions.
fn beams(check: &mut Check, at: &At<RawFlexible>, crank: &Crank, chain: &Chain) -> Option<BeamCrank> {
    let raw = at.get_ref();
    let (web_factors, estimated) = web_factors(check, at, crank)?;
    let density = match (&raw.density_kg_m3, &crank.masses) {
        (Some(d), _) => check.positive(d),
        (None, Some(masses)) => masses.density,
        (None, None) => {
            check.wrong(at, "found no density, expected `density_kg_m3` (7850 of steel)");
            return None;
        }
    };
    let first = chain.stations.iter().position(|s| !s.throws.is_empty()).unwrap_or(0);
    let behind = chain.stations.get(first + crank.throws()).map(|s| s.inertia);
    Some(BeamCrank {
        web_factors,
        estimated,
        density,
        front: end(check, at, (raw.front.as_ref(), "front"), first.checked_sub(1).map(|s| chain.stations[s].inertia)),
        rear: end(check, at, (raw.rear.as_ref(), "rear"), behind),
    })
}

/// Main bearings over all their points, and the law behind them where they have one: then they are linear as in the middle of its reach, until cycles tell better ones.
fn bearings(check: &mut Check, (at, nodes): (&At<RawFlexible>, BearingNodes), crank: &Crank) -> Option<(Bearing, Option<JointSpec>)> {
    let raw = &at.get_ref().bearing;
    if let Some(law) = &raw.exponential {
        for (given, key) in [(&raw.stiffness_n_per_m, "stiffness_n_per_m"), (&raw.damping_n_s_per_m, "damping_n_s_per_m")] {
            if let Some(given) = given {
                check.wrong(
                    given,
                    format!("found `{key}` beside `exponential`, expected one of them: linear bearings near to the law follow from it"),
                );
            }
        }
        let own = law.get_ref();
        let spec = JointSpec {
            pressure: PA_PER_MPA * check.within(&own.pressure_mpa, &OIL_PRESSURE),
            clearance_ratio: check.within(&own.clearance_ratio, &REACH),
            loose: [&own.loose_stiffness, &own.loose_damping].map(|x| check.within(x, &LOOSE_RATIO)),
            time: check.within(&own.damping_time_s, &DAMPING_TIME),
        };
        let first = spec.joints(crank, nodes, (1.0, 1.0)).into_iter().next()?;
        let middle = |[loose, firm]: [f64; 2]| (loose * firm).sqrt() * nodes.count() as f64;
        return Some((Bearing { stiffness: middle(first.stiffness), damping: middle(first.damping) }, Some(spec)));
    }
    let stiffness = match (&raw.stiffness_n_per_m, crank.bearing_stiffness) {
        (Some(k), _) => check.within(k, &BEARING_STIFFNESS),
        (None, Some(k)) => k,
        (None, None) => {
            check.wrong(
                at,
                "found bearings without stiffness, expected `bearing.stiffness_n_per_m`, or `bearing_stiffness_n_per_m` of [crank]",
            );
            return None;
        }
    };
    let Some(damping) = &raw.damping_n_s_per_m else {
        check.wrong(at, "found bearings without damping, expected `bearing.damping_n_s_per_m`, or `bearing.exponential`");
        return None;
    };
    Some((Bearing { stiffness, damping: check.not_negative(damping) }, None))
}

/// The factors of the webs, and whether they are an estimate.
fn web_factors(check: &mut Check, at: &At<RawFlexible>, crank: &Crank) -> Option<(WebFactors, bool)> {
    let Some(raw) = &at.get_ref().web_factors else {
        check.wrong(at, "found neither `web_factors` nor `matrices`, expected one of them: how stiff the crank is");
        return None;
    };
    match raw {
        RawWebFactors::Given(f) => {
            let mut factor = |value: &At<f64>| check.within(value, &WEB_FACTOR);
            Some((WebFactors { bending: factor(&f.bending), twist: factor(&f.twist), edge: factor(&f.edge) }, false))
        }
        RawWebFactors::Estimate => match WebFactors::estimate(crank) {
            Ok(factors) => Some((factors, true)),
            Err(why) => {
                check.wrong_with_help(
                    at,
                    format!("found `web_factors = \"estimate\"` for this crank, expected dimensions it holds for: {why}"),
                    "`web_factors.given = { bending = …, twist = …, edge = … }`, fitted to the flexibility of one throw of finite elements, has no such range",
                );
                None
            }
        },
    }
}

fn nodes(check: &mut Check, bearing: &RawBearing) -> BearingNodes {
    let Some(n) = &bearing.nodes else { return BearingNodes::Three };
    match *n.get_ref() {
        1 => return BearingNodes::One,
        3 => {}
        other => check.wrong(n, format!("found {other}, expected 1 or 3 points along a bearing")),
    }
    BearingNodes::Three
}

/// The bearing that holds the crank along its axis, from 0, and its stiffness and damping there.
fn thrust(check: &mut Check, raw: &RawFlexible, crank: &Crank) -> Option<(usize, Bearing)> {
    let thrust = &raw.thrust_bearing;
    let number = *thrust.bearing.get_ref();
    let at = usize::try_from(number - 1).ok().filter(|b| *b <= crank.throws() && !crank.missing_bearings.contains(b));
    if at.is_none() {
        check.wrong(&thrust.bearing, format!("found {number}, expected a main bearing that is there, from 1 to {}", crank.throws() + 1));
    }
    let stiffness = check.within(&thrust.stiffness_n_per_m, &BEARING_STIFFNESS);
    Some((at?, Bearing { stiffness, damping: check.not_negative(&thrust.damping_n_s_per_m) }))
}

/// An end of the crank, which is there where the chain has a station for it.
fn end(check: &mut Check, at: &At<RawFlexible>, (raw, key): (Option<&RawEnd>, &str), inertia: Option<f64>) -> Option<End> {
    match (raw, inertia) {
        (None, None) => None,
        (None, Some(_)) => {
            check.wrong(at, format!("found no `{key}`, expected the shaft and mass of the station on that end of the crank"));
            None
        }
        (Some(raw), None) => {
            check.wrong(&raw.mass_kg, format!("found `{key}` with no station on that end of the crank, expected one in the chain"));
            None
        }
        (Some(raw), Some(inertia)) => {
            if raw.shaft.get_ref().is_empty() {
                check.wrong(&raw.shaft, "found no step, expected the shaft from the journal to the middle of what is on it");
            }
            for step in raw.shaft.get_ref().iter().filter(|s| (0.0..SHORTEST_STEP_MM).contains(s.length_mm.get_ref())) {
                let found = step.length_mm.get_ref();
                check.wrong(
                    &step.length_mm,
                    format!("found a step of {found} mm, expected at least {SHORTEST_STEP_MM} mm: a shorter one is lost in rounding"),
                );
            }
            Some(End {
                shaft: derived_chain::steps(check, raw.shaft.get_ref()),
                mass: check.positive(&raw.mass_kg),
                diametral_inertia: raw.diametral_inertia_kg_m2.as_ref().map_or(0.5 * inertia, |i| check.positive(i)),
                ring: raw.ring.as_ref().map(|ring| carried_ring(check, ring)),
            })
        }
    }
}

/// A ring that an end carries.
fn carried_ring(check: &mut Check, raw: &RawCarriedRing) -> CarriedRing {
    let polar_inertia = check.positive(&raw.polar_inertia_kg_m2);
    let diametral_inertia = raw.diametral_inertia_kg_m2.as_ref().map_or(0.5 * polar_inertia, |i| check.positive(i));
    if let Some(given) = raw.diametral_inertia_kg_m2.as_ref().filter(|i| *i.get_ref() < 0.5 * polar_inertia) {
        check.wrong(
            given,
            format!("found {diametral_inertia} kg m² about a diameter with {polar_inertia} about the axis, expected at least half of it, as of a thin ring"),
        );
    }
    CarriedRing { mass: check.positive(&raw.mass_kg), diametral_inertia, polar_inertia }
}
