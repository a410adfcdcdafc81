//! `robust.csv` and `tolerance_band.csv`: designs within the tolerances of a study.

use super::table::{Table, number, optional};
use crate::absorber::{Deviation, Mounted};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::holds;
use crate::units::DEG_PER_RAD;

/// `robust.csv`: a row a design for the objective, then one for each limit, with the factors on the parameters where each is worst and what it is proved to be at worst; `tolerance_band.csv`: a row a design and speed. None without tolerances.
///
/// # Errors
/// [`WriteError`] where they cannot be written.
pub fn robust(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.robust.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&[
        "design",
        "role",
        "measure",
        "where",
        "unit",
        "nominal",
        "worst",
        "worst_at",
        "worst_proved",
        "proof_boxes",
        "limit",
        "held",
        "percentile",
        "percentile_from",
        "percentile_to",
    ]);
    let mut band = Table::new(&["design", "speed_rpm", "twist_least_deg", "twist_largest_deg"]);
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    for d in &results.robust {
        let Some(design) = all().find(|own| own.name == d.design) else { continue };
        let limits = study.limits.iter().zip(&d.limits).map(|(l, w)| (&l.of, Some(l.limit), w));
        for (measure, limit, worst) in std::iter::once((&study.objective, None, &d.worst)).chain(limits) {
            let unit = limit.unwrap_or(1.0);
            let shown = |value: f64| Some(measure.unit.shown(value)).filter(|v| v.is_finite() && design.has(&measure.measure));
            let cell = |value: f64| optional(if limit.is_none() { shown(value) } else { None });
            let sampled = |f: &dyn Fn(&crate::analysis::Percentile) -> f64| d.percentile.as_ref().map_or_else(String::new, |p| cell(f(p)));
            table.row([
                d.design.clone(),
                if limit.is_none() { "objective" } else { "limit" }.to_owned(),
                measure.key.to_owned(),
                measure.place.clone(),
                measure.unit.symbol().to_owned(),
                optional(shown(unit * worst.nominal)),
                optional(shown(unit * worst.value)),
                factors(&design.absorbers, &worst.deviation),
                optional(worst.bound.and_then(|b| shown(unit * b.value))),
                worst.bound.map_or_else(String::new, |b| b.boxes.to_string()),
                optional(limit.and_then(shown)),
                limit.map_or_else(String::new, |_| holds(worst.value).to_string()),
                sampled(&|p| p.value),
                sampled(&|p| p.between.0),
                sampled(&|p| p.between.1),
            ]);
        }
        for (speed, (least, largest)) in study.speeds_rpm.iter().zip(&d.band) {
            band.row([d.design.clone(), number(*speed), number(least * DEG_PER_RAD), number(largest * DEG_PER_RAD)]);
        }
    }
    table.save(folder, "robust.csv")?;
    band.save(folder, "tolerance_band.csv")
}

/// Factors on parameters that are not as drawn: `1:stiffness_n_m_per_rad=1.1 1:damping…=0.7`.
fn factors(design: &[Mounted], deviation: &Deviation) -> String {
    let mut words = Vec::new();
    for (i, (m, factors)) in design.iter().zip(&deviation.factors).enumerate() {
        let keys = m.absorber.declaration().into_iter().flat_map(|d| d.parameters).map(|p| p.key);
        let shown = |f: f64| (f * 1e9).round() / 1e9;
        words.extend(keys.zip(factors).filter(|(_, f)| **f != 1.0).map(|(key, f)| format!("{}:{key}={}", i + 1, shown(*f))));
    }
    words.join(" ")
}
