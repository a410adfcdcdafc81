//! The crank by matrices of another program: its keys checked, its files read.

use super::flexible_model::FlexibleModel;
use super::named;
use crate::crankshaft::Crank;
use crate::crankshaft::flexible::CrankBody;
use crate::crankshaft::flexible::imported::{ImportedCrank, Written};
use crate::drivetrain::Chain;
use crate::engine::{Engine, Source};
use crate::input::error::{At, Check};
use crate::input::matrices::{MatrixFiles, UnitSystem, structure};
use crate::input::schema::flexible::{RawCrankAxis, RawFlexible, RawMatrices, RawMatrixUnits};
use crate::rotor::structure::{CrankAxis, Structure, Unknown};
use crate::rotor::structure_checks::Objection;
use std::path::Path;

/// Unknowns of a crank that is reduced as it should be, and how many are not told of.
const USUAL: usize = 100;
const MOST: usize = 200;

/// What dimensions say of a crank of beams is said by the matrices.
fn beside(check: &mut Check, at: &At<RawFlexible>) {
    let raw = at.get_ref();
    let message = |key: &str| format!("found `{key}` beside `matrices`, expected one of them: the matrices hold webs, hub and flywheel");
    if raw.web_factors.is_some() {
        check.wrong(at, message("web_factors"));
    }
    if let Some(density) = &raw.density_kg_m3 {
        check.wrong(density, message("density_kg_m3"));
    }
    for (end, key) in [(&raw.front, "front"), (&raw.rear, "rear")] {
        if let Some(end) = end {
            check.wrong(&end.mass_kg, message(key));
        }
    }
    if let Some(nodes) = &raw.bearing.nodes {
        check.wrong(nodes, "found `nodes` beside `matrices`, expected one of them: `journals` names the points along each");
    }
}

/// Numbers of nodes, from 1.
fn nodes(check: &mut Check, all: &At<Vec<Vec<i64>>>) -> Vec<Vec<u64>> {
    if let Some(wrong) = all.get_ref().iter().flatten().find(|n| **n < 1) {
        check.wrong(all, format!("found node {wrong}, expected numbers from 1"));
    }
    all.get_ref().iter().map(|list| list.iter().map(|n| n.unsigned_abs()).collect()).collect()
}

/// One node.
fn node(check: &mut Check, n: &At<i64>) -> u64 {
    if *n.get_ref() < 1 {
        check.wrong(n, format!("found node {}, expected a number from 1", n.get_ref()));
    }
    n.get_ref().unsigned_abs()
}

/// The structure in its files, z along the crank.
fn read(check: &mut Check, at: &At<RawMatrices>, folder: &Path, rotating: bool) -> Option<(Structure, Vec<Written>)> {
    let raw = at.get_ref();
    let mut found = |name: &At<String>| named::file(check, name, folder, "a matrix");
    let (stiffness, mass, places) = (found(&raw.stiffness), found(&raw.mass), found(&raw.nodes));
    let mut given = |name: &Option<At<String>>| match name {
        Some(name) => found(name).map(Some),
        None => Some(None),
    };
    let (unknowns, gyroscopic, turning) = (given(&raw.dof)?, given(&raw.gyroscopic)?, given(&raw.turning)?);
    if rotating && (gyroscopic.is_none() || turning.is_none()) {
        check.wrong_with_help(
            at,
            "found matrices without `gyroscopic` and `turning`, expected both where the crank turns",
            "`rotating = false` leaves out what rotation does: of the twist of one six 10 to 13 %, where an order meets a bending mode, which rotation splits",
        );
        return None;
    }
    let files = MatrixFiles {
        stiffness: stiffness?,
        mass: Some(mass?),
        rotating: [gyroscopic, turning],
        unknowns,
        nodes: Some(places?),
        units: match raw.units {
            RawMatrixUnits::Si => UnitSystem::Si,
            RawMatrixUnits::MmT => UnitSystem::MmTonne,
        },
    };
    let own = structure(&files).map_err(|mut e| check.mistakes.append(&mut e.mistakes)).ok()?;
    let axis = match raw.axis {
        RawCrankAxis::X => CrankAxis::X,
        RawCrankAxis::Y => CrankAxis::Y,
        RawCrankAxis::Z => CrankAxis::Z,
    };
    let written = |u: &Unknown| Written { unknown: *u, scale: files.units.scale(u) };
    let all = own.unknowns.iter().map(written).collect();
    Some((own.along(axis), all))
}

/// Whether a crank can be computed with it in spite of that.
fn is_grave(objection: &Objection) -> bool {
    !matches!(objection, Objection::BesideTheAxis(_) | Objection::Slow(_) | Objection::Inertia(_) | Objection::TorsionalStiffness(_))
}

/// The crank by its matrices.
pub(super) fn resolve(check: &mut Check, at: &At<RawFlexible>, folder: &Path) -> Option<ImportedCrank> {
    let raw = at.get_ref();
    let matrices = raw.matrices.as_ref()?;
    beside(check, at);
    let own = matrices.get_ref();
    let (structure, written) = read(check, matrices, folder, raw.rotating.unwrap_or(true))?;
    for objection in structure.checks().objections(None).iter().filter(|o| is_grave(o)) {
        check.wrong_with_help(
            matrices,
            format!("found matrices that are not those of a free crank, expected such: {objection}"),
            "`hartog matrices FILE --mass FILE --dof FILE --nodes FILE` says what is found of them",
        );
    }
    let found = ImportedCrank {
        structure,
        written,
        hub: node(check, &own.hub),
        flywheel: node(check, &own.flywheel),
        pins: nodes(check, &own.pins),
        journals: nodes(check, &own.journals),
    };
    if let Some(why) = found.turns_wrongly().filter(|_| raw.rotating.unwrap_or(true)) {
        check.wrong(matrices, format!("found matrices that turn otherwise than their mass, expected K_s + Kc - Z and G: {why}"));
    }
    Some(found)
}

impl FlexibleModel {
    /// What is unlikely of a crank by matrices beside its chain, in words.
    pub(super) fn objections(&self, (crank, engine, chain): (&Crank, &Engine, &Chain), judged: bool) -> Vec<String> {
        let (CrankBody::Matrices(own), Source::Cylinder { geometry, .. }) = (&self.spec.body, &engine.source) else { return Vec::new() };
        let of_chain = own.of_chain((crank, chain), &self.assembled.throws, geometry.mass_on_pin());
        let mut all: Vec<String> =
            own.structure.checks().objections(Some(of_chain)).iter().map(|o| format!("of the crank by matrices: {o}")).collect();
        let silent: Vec<String> = (0..own.journals.len()).filter(|j| !own.tells_torque(*j)).map(|j| (j + 1).to_string()).collect();
        if !silent.is_empty() {
            all.push(format!(
                "outer points of the main journals {} do not rotate about the axis in the matrices: torques there come from twists between stations: some per cent off, tens where bearings are missing",
                silent.join(", ")
            ));
        }
        let unknowns = own.structure.unknowns.len();
        if unknowns > MOST {
            all.push(format!(
                "the crank by matrices has {unknowns} unknowns, each speed takes some {:.0} times as long as with {USUAL}: reduce it to its journals, pins and ends with few modes",
                (unknowns as f64 / USUAL as f64).powi(3)
            ));
        }
        if judged {
            all.push("matrices say nothing of webs: margins are by the beam on rigid bearings, without web_loads.csv; stresses are recovered from `hartog curves`".into());
        }
        all
    }
}
