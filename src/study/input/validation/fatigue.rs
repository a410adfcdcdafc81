//! Fatigue: material, criteria, fillets.

use super::named::table;
use crate::crankshaft::stress_concentration::Formulas;
use crate::crankshaft::{Crank, FactorSource, FatigueSpec, FilletSpec, MarginCriterion, MeanBending, Place, UnitLoads};
use crate::fatigue::class_rules::{ADDITIONAL_BENDING, Manufacture, STRENGTHS};
use crate::fatigue::endurance::{self, Endurance, Loading, RELIABILITIES, Surface};
use crate::fatigue::multiaxial::Limits;
use crate::fatigue::{ClassRule, Strength};
use crate::input::error::{At, Check, InputError};
use crate::input::schema::bounds::{NOMINAL_FACTOR, TEMPERATURE_OF_STEEL};
use crate::input::schema::fatigue::{
    RawEndurance, RawFactors, RawFatigue, RawFillet, RawLoad, RawManufacture, RawMaterial, RawMeanBending, RawPlace, RawSurface,
};
use crate::input::tables::{UnitLoadReader, UnitPoint};
use crate::units::PA_PER_MPA;
use std::collections::HashSet;
use std::path::Path;

/// Points on the webs of a crank, each with either shaft's torque, of all throws of a fillet: more take gigabytes.
const MOST_LOCATIONS: usize = 1_000_000;

/// The table, or nothing where a mistake leaves none. Paths are relative to `folder`.
pub(crate) fn resolve(check: &mut Check, raw: &At<RawFatigue>, crank: Option<&Crank>, folder: &Path) -> Option<FatigueSpec> {
    let Some(crank) = crank else {
        let help = "an engine with split pins, or with torque harmonics, has no [crank]: leave out [fatigue] and all that is of `margin`";
        check.wrong_with_help(raw, "found [fatigue] for an engine without [crank], expected its dimensions in the engine file", help);
        return None;
    };
    let raw = raw.get_ref();
    let before = check.mistakes.len();
    let criteria = criteria(check, raw, crank);
    let (strength, limits) = strength(check, raw, &criteria, crank);
    let fillets = if raw.fillet.is_empty() { every_fillet() } else { fillets(check, &raw.fillet, crank, folder) };
    for (f, spec) in raw.fillet.iter().zip(&fillets) {
        if matches!(spec.factors, FactorSource::UnitLoads(_)) && limits.is_none() {
            check.wrong(
                &f.factors,
                "found stresses per unit load without a multiaxial criterion, expected one like `crossland`: others need factors",
            );
        }
    }
    let nominal = fillets.is_empty() || fillets.iter().any(|f| !matches!(f.factors, FactorSource::UnitLoads(_)));
    if let (false, Some(c)) = (nominal, raw.criteria.get_ref().iter().find(|c| matches!(c.get_ref().0, MarginCriterion::MeanStress(_)))) {
        check.wrong(
            c,
            "found a criterion of mean stress where every fillet has stresses per unit load, expected a fillet with factors for it",
        );
    }
    let add = raw.iacs_m53.additional_bending_mpa.as_ref();
    let rule = ClassRule {
        manufacture: match raw.iacs_m53.manufacture {
            RawManufacture::GrainFlow => Manufacture::GrainFlow,
            RawManufacture::FreeForged => Manufacture::FreeForged,
            RawManufacture::CastColdRolled => Manufacture::CastColdRolled,
        },
        tensile: strength.tensile,
        additional_bending: add.map_or(ADDITIONAL_BENDING, |a| check.not_negative(a) * PA_PER_MPA),
    };
    let mean_bending = match raw.mean_bending {
        RawMeanBending::Signed => MeanBending::Signed,
        RawMeanBending::AsTension => MeanBending::AsTension,
    };
    let notch_sensitivity = raw.notch_sensitivity;
    let torsion_case = raw.torsion_case.as_ref().map(|c| c.get_ref().0);
    if let Some(at) = &raw.torsion_case {
        let nominal = |place: Place| fillets.iter().any(|f| f.place == place && !matches!(f.factors, FactorSource::UnitLoads(_)));
        if !(nominal(Place::Crankpin) && nominal(Place::Journal)) {
            check.wrong(
                at,
                "found a torsion case, expected a fillet with factors at a crankpin and one at a journal: its margins are at these",
            );
        }
    }
    only_class_rule(check, raw, &criteria);
    if criteria.iter().any(|c| c.is_class_rule()) && !(STRENGTHS.0..=STRENGTHS.1).contains(&strength.tensile) {
        let (low, high) = (STRENGTHS.0 / PA_PER_MPA, STRENGTHS.1 / PA_PER_MPA);
        let at = &raw.material.tensile_strength_mpa;
        check.wrong(at, format!("found {} MPa, expected a tensile strength from {low} to {high} MPa for `iacs_m53`", at.get_ref()));
    }
    (check.mistakes.len() == before).then_some(FatigueSpec {
        criteria,
        strength,
        limits,
        mean_bending,
        notch_sensitivity,
        fillets,
        torsion_case,
        rule,
    })
}

/// What only other criteria than the class rule read must not stand without one.
fn only_class_rule(check: &mut Check, raw: &RawFatigue, criteria: &[MarginCriterion]) {
    let unused = !raw.fillet.is_empty() || raw.endurance.is_some() || raw.notch_sensitivity;
    if unused && criteria.iter().all(|c| c.is_class_rule()) {
        check.wrong(
            &raw.criteria,
            "found fillets, endurance factors or notch sensitivity with `iacs_m53` alone, expected another criterion beside it: the rule has its own",
        );
    }
}

/// Whether factors come from formulas anywhere.
pub(crate) fn needs_formulas(spec: &FatigueSpec) -> bool {
    let by_fillets = spec.criteria.iter().any(|c| !c.is_class_rule());
    spec.criteria.iter().any(|c| c.is_class_rule())
        || (by_fillets && spec.fillets.iter().any(|f| matches!(f.factors, FactorSource::Formulas(_))))
}

fn criteria(check: &mut Check, raw: &RawFatigue, crank: &Crank) -> Vec<MarginCriterion> {
    let mut list = Vec::new();
    for c in raw.criteria.get_ref() {
        let criterion = c.get_ref().0;
        if list.contains(&criterion) {
            check.wrong(c, format!("found criterion `{}` a second time, expected each once", criterion.name()));
        }
        if criterion == MarginCriterion::IacsM53 && !crank.missing_bearings.is_empty() {
            check.wrong(
                c,
                "found `iacs_m53` for a crank with missing bearings, expected one throw between two main bearings, as the rule does",
            );
        }
        list.push(criterion);
    }
    if list.is_empty() {
        check.wrong(&raw.criteria, "found an empty list, expected at least one criterion");
    }
    list
}

/// Strengths, and the limits of multiaxial criteria where there are any.
fn strength(check: &mut Check, raw: &RawFatigue, criteria: &[MarginCriterion], crank: &Crank) -> (Strength, Option<Limits>) {
    let RawMaterial {
        tensile_strength_mpa,
        yield_strength_mpa,
        bending_fatigue_limit_mpa,
        torsion_fatigue_limit_mpa,
        repeated_bending_fatigue_limit_mpa,
    } = &raw.material;
    let tensile = check.positive(tensile_strength_mpa);
    let below = |check: &mut Check, value: &Option<At<f64>>, what: &str, most: f64, of: &str| {
        let x = value.as_ref().map(|v| check.positive(v))?;
        if let Some(v) = value.as_ref().filter(|_| x > most) {
            check.wrong(v, format!("found a {what} of {x} MPa, expected one not above the {of}, {most} MPa"));
        }
        Some(x)
    };
    let yielding = below(check, yield_strength_mpa, "yield strength", tensile, "tensile strength");
    let limit = below(check, bending_fatigue_limit_mpa, "bending fatigue limit", tensile, "tensile strength");
    let most = limit.unwrap_or(tensile);
    let of = if limit.is_some() { "bending fatigue limit" } else { "tensile strength" };
    let torsion = below(check, torsion_fatigue_limit_mpa, "torsion fatigue limit", most, of);
    let repeated = below(check, repeated_bending_fatigue_limit_mpa, "repeated bending fatigue limit", most, of);
    for c in criteria {
        if let MarginCriterion::MeanStress(line) = c
            && line.needs_yield()
            && yielding.is_none()
        {
            check.wrong(
                &raw.criteria,
                format!("found `{}` without a yield strength, expected `yield_strength_mpa` in the material", line.name()),
            );
        }
    }
    let mut fatigue_limit = limit.map_or_else(|| endurance::estimated_limit(tensile * PA_PER_MPA), |l| l * PA_PER_MPA);
    let polished = fatigue_limit;
    if let Some(e) = &raw.endurance {
        let factors = endurance(check, e, crank).factors(tensile * PA_PER_MPA);
        fatigue_limit *= factors.iter().product::<f64>();
    }
    // what lessens one fatigue limit of the part lessens them all
    let lessened = fatigue_limit / polished;
    let tensile = tensile * PA_PER_MPA;
    let limits = torsion.map(|t| Limits {
        tensile,
        bending: fatigue_limit,
        torsion: t * PA_PER_MPA * lessened,
        repeated_bending: repeated.map_or_else(|| Limits::goodman_repeated(fatigue_limit, tensile), |r| r * PA_PER_MPA * lessened),
    });
    let asked = multiaxial(check, raw, criteria, limits.as_ref());
    (Strength { tensile, yielding: yielding.map(|y| y * PA_PER_MPA), fatigue_limit }, limits.filter(|_| asked))
}

/// Whether a multiaxial criterion is asked for; each needs a torsion limit, and a constant.
fn multiaxial(check: &mut Check, raw: &RawFatigue, criteria: &[MarginCriterion], limits: Option<&Limits>) -> bool {
    let mut asked = false;
    for (at, criterion) in raw.criteria.get_ref().iter().zip(criteria) {
        let MarginCriterion::Multiaxial(criterion) = criterion else { continue };
        asked = true;
        let Some(limits) = limits else {
            let words = format!(
                "found `{}` without a torsion fatigue limit, expected `torsion_fatigue_limit_mpa` in the material",
                criterion.name()
            );
            check.wrong(at, words);
            continue;
        };
        if let Err(undefined) = criterion.weight(limits) {
            check.wrong(at, format!("found a criterion without a constant: {undefined}"));
        }
    }
    asked
}

pub(super) fn surface(raw: RawSurface) -> Surface {
    match raw {
        RawSurface::Ground => Surface::Ground,
        RawSurface::Machined => Surface::Machined,
        RawSurface::HotRolled => Surface::HotRolled,
        RawSurface::Forged => Surface::Forged,
    }
}

/// A reliability with a factor, per cent.
pub(super) fn reliability(check: &mut Check, raw: &At<f64>) -> f64 {
    if !RELIABILITIES.contains(raw.get_ref()) {
        let known: Vec<String> = RELIABILITIES.iter().map(ToString::to_string).collect();
        check.wrong(raw, format!("found {} %, expected one of {}", raw.get_ref(), known.join(", ")));
    }
    *raw.get_ref()
}

fn endurance(check: &mut Check, raw: &RawEndurance, crank: &Crank) -> Endurance {
    let reliability_percent = raw.reliability_percent.as_ref().map_or(50.0, |r| reliability(check, r));
    Endurance {
        loading: match raw.load {
            RawLoad::Bending => Loading::Bending,
            RawLoad::Axial => Loading::Axial,
        },
        diameter: crank.pin_diameter,
        surface: surface(raw.surface),
        temperature_c: raw.temperature_c.as_ref().map_or(20.0, |t| check.within(t, &TEMPERATURE_OF_STEEL)),
        reliability_percent,
    }
}

/// Loads of a web for which a table may have stresses: moments in the plane of the throw and across it, shear force in the plane, torque.
const UNIT_LOADS: [&str; 4] = ["moment_n_m", "tangential_moment_n_m", "shear_n", "torque_n_m"];

/// Stresses per unit load at the points of a table.
fn unit_loads(check: &mut Check, file: &At<String>, folder: &Path) -> Vec<(String, UnitLoads)> {
    let read = |path: &Path| -> Result<Vec<(String, UnitLoads)>, InputError> {
        let point = |(name, t): UnitPoint| (name, UnitLoads { moment: t[0], tangential: t[1], shear: t[2], torque: t[3] });
        UnitLoadReader::open(path, &UNIT_LOADS.map(str::to_owned))?.map(|p| p.map(point)).collect()
    };
    let points = table(check, file, folder, read).unwrap_or_default();
    let nothing = |u: &UnitLoads| [u.moment, u.tangential, u.shear, u.torque].iter().flatten().all(|s| *s == 0.0);
    if let Some((name, _)) = points.iter().find(|p| nothing(&p.1)) {
        check.wrong(file, format!("found no stress at all at point `{name}` of the table, expected some"));
    }
    points
}

/// Crankpin and journal of every throw, with the factors of the class rule.
fn every_fillet() -> Vec<FilletSpec> {
    let one =
        |place: Place| FilletSpec { name: place.name().into(), throw: None, place, factors: FactorSource::Formulas(Formulas::IacsM53) };
    vec![one(Place::Crankpin), one(Place::Journal)]
}

fn fillets(check: &mut Check, raw: &[RawFillet], crank: &Crank, folder: &Path) -> Vec<FilletSpec> {
    let mut names = HashSet::new();
    let mut list = Vec::new();
    for f in raw {
        check.name(&f.name);
        if f.name.get_ref().is_empty() {
            check.wrong(&f.name, "found an empty name, expected one for tables");
        }
        let throw = f.throw.as_ref().map(|t| {
            let number = *t.get_ref();
            let index = usize::try_from(number - 1).ok().filter(|i| *i < crank.throws());
            if index.is_none() {
                check.wrong(t, format!("found throw {number}, expected a number from 1 to {}", crank.throws()));
            }
            index.unwrap_or(0)
        });
        let factors = match f.factors.get_ref() {
            RawFactors::Given(given) => {
                let mut factor = |v: &At<f64>| check.within(v, &NOMINAL_FACTOR);
                FactorSource::Given { bending: factor(&given.bending), torsion: factor(&given.torsion) }
            }
            RawFactors::UnitLoads(file) => {
                let points = unit_loads(check, file, folder);
                let (throws, found) = (if throw.is_some() { 1 } else { crank.throws() }, points.len());
                if 4 * throws * found > MOST_LOCATIONS {
                    let most = MOST_LOCATIONS / (4 * throws);
                    check.wrong(file, format!("found {found} points on the webs of {throws} throws, expected at most {most}"));
                }
                FactorSource::UnitLoads(points)
            }
            RawFactors::IacsM53 => FactorSource::Formulas(Formulas::IacsM53),
            RawFactors::Fvv1973 => FactorSource::Formulas(Formulas::Fvv1973),
        };
        // the names that tables will show
        let mut shown: Vec<String> = match throw {
            Some(_) => vec![f.name.get_ref().clone()],
            None => (1..=crank.throws()).map(|t| format!("{}_{t}", f.name.get_ref())).collect(),
        };
        if let FactorSource::UnitLoads(points) = &factors
            && points.len() > 1
        {
            shown = shown.iter().flat_map(|name| points.iter().map(move |(point, _)| format!("{name}:{point}"))).collect();
        }
        for name in shown {
            if !names.insert(name.clone()) {
                check.wrong(&f.name, format!("found fillet `{name}` a second time, expected different names"));
                break;
            }
        }
        let place = match f.on {
            RawPlace::Crankpin => Place::Crankpin,
            RawPlace::Journal => Place::Journal,
        };
        list.push(FilletSpec { name: f.name.get_ref().clone(), throw, place, factors });
    }
    list
}
