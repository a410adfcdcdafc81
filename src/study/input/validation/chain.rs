//! Torsional chain.

use super::checked_study::Reciprocating;
use crate::crankshaft::Crank;
use crate::drivetrain::{Chain, Station};
use crate::engine::Engine;
use crate::input::error::{At, Check};
use crate::input::schema::engine::{RawEngine, RawReciprocating, RawStation};
use std::collections::HashSet;

/// What the file says of the reciprocating masses: a typed chain holds what it holds unless it says more; inertias that follow from dimensions do not
/// hold them, so that their mean is added.
pub(super) fn reciprocating(raw: &RawEngine) -> Reciprocating {
    let stated = raw.reciprocating_inertia.as_ref().map(|r| *r.get_ref());
    let is_derived = raw.station.iter().any(|s| s.inertia_kg_m2.is_none() && !s.throws.is_empty());
    let default = if is_derived { RawReciprocating::Mean } else { RawReciprocating::None };
    Reciprocating { mean: stated.unwrap_or(default) == RawReciprocating::Mean, stated: stated.is_some() }
}

/// Modes of longer chains would take minutes, and no shaft needs them.
const MOST_STATIONS: usize = 500;

/// Each throw acts on a station; `owner`: the station of each.
fn every_throw(check: &mut Check, raw: &RawEngine, owner: &[Option<String>]) {
    for t in owner.iter().enumerate().filter(|o| o.1.is_none()).map(|o| o.0 + 1) {
        match &raw.chain {
            Some(table) => check.wrong(&table.file, format!("throw {t} acts on no station, expected it in column `throws` of this table")),
            None => check.wrong(&raw.station[0].name, format!("throw {t} acts on no station, expected it in `throws` of one [[station]]")),
        }
    }
}

/// The chain, or nothing where a mistake leaves none. The engine is nothing where it is unknown.
pub(crate) fn resolve(check: &mut Check, raw: &RawEngine, engine: Option<&Engine>, crank: Option<&Crank>) -> Option<Chain> {
    let throws = engine.map_or(0, |e| e.layout.throws());
    if raw.station.is_empty() {
        check.wrong(&raw.strokes, "found no [[station]], expected at least one in an engine file");
        return None;
    }
    if raw.station.len() > MOST_STATIONS {
        let found = format!("found station {} of {}, expected at most {MOST_STATIONS}", MOST_STATIONS + 1, raw.station.len());
        check.wrong(&raw.station[MOST_STATIONS].name, found);
        return None;
    }
    let mut names = HashSet::new();
    let mut owner: Vec<Option<String>> = vec![None; throws];
    let mut stations = Vec::new();
    for s in &raw.station {
        let name = s.name.get_ref();
        check.name(&s.name);
        if name.is_empty() || name == "ground" {
            check.wrong(&s.name, format!("found the name `{name}`, expected another one"));
        }
        if !names.insert(name.clone()) {
            check.wrong(&s.name, format!("found station `{name}` a second time, expected different names"));
        }
        for throw in &s.throws {
            let t = *throw.get_ref();
            let Some(index) = usize::try_from(t).ok().filter(|t| (1..=throws).contains(t)) else {
                if throws > 0 {
                    check.wrong(throw, format!("found throw {t}, expected a number from 1 to {throws}, the throws of the layout"));
                }
                continue;
            };
            match &owner[index - 1] {
                Some(other) => check.wrong(throw, format!("found throw {t} on `{name}` and on `{other}`, expected it on one station")),
                None => owner[index - 1] = Some(name.clone()),
            }
        }
        stations.push(station(check, s));
    }
    every_throw(check, raw, &owner);
    let derived = super::derived_chain::derive(check, raw, engine, crank, &mut stations);
    if let (Some(engine), true) = (engine, reciprocating(raw).mean) {
        let asked = raw.reciprocating_inertia.as_ref();
        match (engine.reciprocating_inertia(), asked) {
            (Some(each), _) => {
                let per_throw = each * engine.layout.rods_per_throw as f64;
                // by default inertias that are given hold what they hold
                let taken = |s: &RawStation| asked.is_some() || s.inertia_kg_m2.is_none();
                for (station, _) in stations.iter_mut().zip(&raw.station).filter(|(_, raw)| taken(raw)) {
                    station.inertia += per_throw * station.throws.len() as f64;
                }
            }
            (None, None) => {}
            (None, Some(asked)) => {
                check.wrong(asked, "found `mean` with harmonics of a whole throw, expected it with [geometry], which has the masses")
            }
        }
    }
    let mut chain = Chain { stations: super::tree::arrange(check, &raw.station, &derived, stations)? };
    let ratios = chain.speed_ratios();
    let other = |i: &usize| !chain.stations[*i].throws.is_empty() && ratios.as_ref().is_some_and(|r| r[*i] != 1.0);
    let station = (0..chain.len()).find(other).map(|i| &chain.stations[i].name);
    if let Some(s) = raw.station.iter().find(|s| Some(s.name.get_ref()) == station) {
        let words = format!(
            "found throws on shafts of different speeds, that of `{}` among them, expected no gear between throws",
            s.name.get_ref()
        );
        check.wrong(&s.name, words);
    }
    if let Some(damping) = raw.damping.as_ref().filter(|_| check.mistakes.is_empty()) {
        super::damping::apply(check, damping, &mut chain);
    }
    Some(chain)
}

fn station(check: &mut Check, raw: &RawStation) -> Station {
    let mut optional = |value: &Option<At<f64>>| value.as_ref().map_or(0.0, |v| check.not_negative(v));
    Station {
        name: raw.name.get_ref().clone(),
        inertia: 0.0,
        stiffness_to_next: optional(&raw.stiffness_to_next_n_m_per_rad),
        damping_to_next: optional(&raw.damping_to_next_n_m_s_per_rad),
        loss_factor_to_next: optional(&raw.loss_factor_to_next),
        stiffness_to_ground: optional(&raw.stiffness_to_ground_n_m_per_rad),
        damping_to_ground: optional(&raw.damping_to_ground_n_m_s_per_rad),
        joint: None,
        throws: raw.throws.iter().filter_map(|t| usize::try_from(*t.get_ref() - 1).ok()).collect(),
    }
}
