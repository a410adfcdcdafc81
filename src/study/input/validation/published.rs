//! Published tables of a study.

use super::named::table;
use crate::fatigue::multiaxial::Limits;
use crate::input::error::{At, Check, InputError};
use crate::input::published::{Published, Tolerances};
use crate::input::schema::published::{RawPublished, RawTolerances};
use crate::input::tables::{self, Reach};
use std::path::Path;

/// The tables. `limits`: those of multiaxial criteria, where the study has any.
pub(crate) fn resolve(check: &mut Check, raw: &RawPublished, folder: &Path, reach: &Reach, limits: Option<&Limits>) -> Published {
    let engine = raw.engine.get_ref().clone();
    check.name(&raw.engine);
    raw.source.iter().for_each(|source| check.name(source));
    let mut published = Published {
        chain: Vec::new(),
        frequencies: Vec::new(),
        modes: Vec::new(),
        von_mises: Vec::new(),
        absorbers: Vec::new(),
        amplitudes: Vec::new(),
        quantities: Vec::new(),
        fatigue: Vec::new(),
        stresses: Vec::new(),
        factors: Vec::new(),
        multiaxial: Vec::new(),
        histories: Vec::new(),
        planes: Vec::new(),
        choices: Vec::new(),
        source: raw.source.as_ref().map_or_else(String::new, |s| s.get_ref().clone()),
        tolerances: tolerances(check, &raw.tolerance_percent),
        engine,
    };
    let e = &published.engine;
    published.chain = rows(check, &raw.chain, folder, |p| tables::chain(p, e));
    published.frequencies = rows(check, &raw.frequencies, folder, |p| tables::frequencies(p, e));
    published.modes = rows(check, &raw.modes, folder, |p| tables::modes(p, e));
    published.von_mises = rows(check, &raw.von_mises, folder, |p| tables::von_mises(p, e, reach.designs));
    published.absorbers = rows(check, &raw.absorbers, folder, |p| tables::absorbers(p, e, reach.designs));
    published.amplitudes = rows(check, &raw.amplitudes, folder, |p| tables::amplitudes(p, e, reach));
    published.quantities = rows(check, &raw.engines, folder, |p| tables::engines(p, e));
    published.choices = rows(check, &raw.choices, folder, |p| tables::choices(p, e, reach.designs));
    if let Some(file) = &raw.fatigue {
        published.fatigue = table(check, file, folder, |p| tables::fatigue(p, e, reach.designs)).unwrap_or_default();
        if !published.quantities.iter().any(|q| q.name == "tensile_strength" && q.value.as_ref().is_ok_and(|v| *v > 0.0)) {
            check.wrong(file, "found safety factors without a strength, expected `tensile_strength` (MPa) in the table `engines`");
        }
    }
    if let Some(file) = raw.von_mises.as_ref().filter(|_| limits.is_none()) {
        check.wrong(
            file,
            "found stresses over the cycle, expected a multiaxial criterion and its material in [fatigue]: only these ask for them",
        );
    }
    published.stresses = rows(check, &raw.stresses, folder, |p| tables::stresses(p, e));
    published.factors = rows(check, &raw.factors, folder, |p| tables::factors(p, e));
    if let Some(file) = &raw.multiaxial {
        published.multiaxial = table(check, file, folder, tables::multiaxial).unwrap_or_default();
        if limits.is_none() {
            check.wrong(
                file,
                "found multiaxial safety factors without limits, expected a multiaxial criterion and its material in [fatigue]",
            );
        }
    }
    if let Some(file) = &raw.histories {
        published.histories = table(check, file, folder, tables::histories).unwrap_or_default();
        let alone = published.histories.iter().find(|h| !published.multiaxial.iter().any(|m| m.at.is_same(&h.at)));
        if let Some(h) = alone {
            let words =
                format!("found stresses of point `{}` of `{}` without factors, expected its row in `multiaxial`", h.at.point, h.at.crank);
            check.wrong(file, words);
        }
    }
    if let Some(file) = &raw.planes {
        published.planes = table(check, file, folder, tables::planes).unwrap_or_default();
    }
    any_table(check, raw);
    published
}

/// At least one table is there.
fn any_table(check: &mut Check, raw: &RawPublished) {
    let tables = [
        &raw.chain,
        &raw.frequencies,
        &raw.modes,
        &raw.von_mises,
        &raw.absorbers,
        &raw.amplitudes,
        &raw.engines,
        &raw.choices,
        &raw.fatigue,
        &raw.stresses,
        &raw.factors,
        &raw.multiaxial,
        &raw.histories,
        &raw.planes,
    ];
    if tables.iter().all(|f| f.is_none()) {
        let names = "`chain`, `frequencies`, `modes`, `von_mises`, `absorbers`, `amplitudes`, `engines`, `choices`, `fatigue`, `stresses`, `factors`, `multiaxial`, `histories`, `planes`";
        check.wrong(&raw.engine, format!("found no table, expected at least one of {names}"));
    }
}

/// Rows of a table; none where there is no such table.
fn rows<T>(check: &mut Check, file: &Option<At<String>>, folder: &Path, read: impl Fn(&Path) -> Result<Vec<T>, InputError>) -> Vec<T> {
    file.as_ref().and_then(|file| table(check, file, folder, read)).unwrap_or_default()
}

fn tolerances(check: &mut Check, raw: &RawTolerances) -> Tolerances {
    let mut percent = |value: &Option<At<f64>>| value.as_ref().map(|v| check.positive(v));
    Tolerances {
        frequency: percent(&raw.frequency),
        critical_speed: percent(&raw.critical_speed),
        stiffness: percent(&raw.stiffness),
        damping: percent(&raw.damping),
        amplitude_median: percent(&raw.amplitude_median),
        amplitude_worst: percent(&raw.amplitude_worst),
        safety_factor: percent(&raw.safety_factor),
        multiaxial_factor: percent(&raw.multiaxial_factor),
    }
}
