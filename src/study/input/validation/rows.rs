//! How long the tables of a study become.

use super::checked_study::Study;
use crate::crankshaft::fillets::LISTED_POINTS;
use crate::crankshaft::{FactorSource, MarginCriterion};
use crate::engine::Order;
use crate::input::error::Check;
use crate::input::schema::study::RawStudy;

/// A table of more rows than this takes some ten gigabytes, and no program opens it.
const MOST_ROWS: f64 = 1e8;

/// Refuses a study one of whose tables would have too many rows.
pub(super) fn check(check: &mut Check, raw: &RawStudy, study: &Study) {
    let help = if study.every_station {
        "`response.every_station` lists every order of every station and shaft"
    } else {
        "a larger step has fewer speeds"
    };
    for (table, rows) in [("response.csv", response(study)), ("margin.csv", margin(study))] {
        if rows > MOST_ROWS {
            let message =
                format!("found {} speeds, which make {rows:.0} rows of `{table}`, expected at most {MOST_ROWS}", study.speeds_rpm.len());
            check.wrong_with_help(&raw.speed_rpm, message, help);
        }
    }
}

/// Designs whose curves are in tables: the given ones, the best of catalogues, and the main optima.
fn shown(study: &Study) -> f64 {
    let sold: usize = study.catalogues.iter().map(|c| c.best * if c.free.is_empty() { 1 } else { 2 }).sum();
    let types = study.optimise.as_ref().map_or(0.0, |o| o.absorbers.iter().map(|a| a.types.len() as f64).product());
    let objectives = 1 + study.more_objectives.len() + usize::from(study.combined.is_some()) + usize::from(study.robust.is_some());
    (study.designs.len() + sold) as f64 + types * objectives as f64
}

fn response(study: &Study) -> f64 {
    let given = study.designs.iter().map(|d| d.absorbers.len()).max().unwrap_or(0);
    let absorbers = given.max(study.optimise.as_ref().map_or(0, |o| o.absorbers.len()));
    let (orders, shafts) = (Order::up_to(study.order_limit, study.engine.strokes).len(), study.chain.len() - 1);
    let listed = if study.every_station { 2 + 2 * shafts + absorbers } else { 2 };
    // every shaft, and twist and power of every ring, by their sums at least
    let sums = listed + shafts + 2 * absorbers;
    let quantities = listed * orders + sums + study.conditions.len() * (orders + 1);
    shown(study) * quantities as f64 * study.speeds_rpm.len() as f64
}

fn margin(study: &Study) -> f64 {
    let (Some(fatigue), Some(crank)) = (&study.fatigue, &study.crank) else { return 0.0 };
    let multiaxial = fatigue.criteria.iter().filter(|c| matches!(c, MarginCriterion::Multiaxial(_))).count();
    let rules = fatigue.criteria.iter().filter(|c| c.is_class_rule()).count();
    let fillets = fatigue.fillets.iter().map(|f| {
        let own = match &f.factors {
            FactorSource::UnitLoads(points) => points.len().min(LISTED_POINTS) * multiaxial,
            _ => fatigue.criteria.len() - rules,
        };
        own * f.throws(crank).len()
    });
    // the rule has the crankpin, the journal and the oil bore of every throw
    let rows = fillets.sum::<usize>() + 3 * rules * crank.throws();
    shown(study) * rows as f64 * study.speeds_rpm.len() as f64
}
