//! A law fitted to measured stiffness, in words.

use super::table::{significant, table};
use crate::analysis::fit_law::{Fitted, LawFit};
use crate::report::csv::rounded;

/// Values with standard errors, factors of temperature, how well it fits, and the line of a study.
pub(crate) fn fit_law(fit: &LawFit) -> String {
    let error = |f: &Fitted| match f.standard_error {
        None => "held".to_owned(),
        Some(e) if e.is_finite() => significant(e, 2),
        Some(_) => "not determined".to_owned(),
    };
    let note = |f: &Fitted| if f.on_bound { "on a bound of the search" } else { "" }.to_owned();
    let parameters = &fit.declaration.parameters[1..];
    let own = parameters.iter().zip(&fit.values).map(|(p, f)| vec![p.key.to_owned(), significant(f.value, 6), error(f), note(f)]);
    let several = fit.factors.len() > 1;
    let factors = fit.factors.iter().filter(|_| several);
    let factors = factors.map(|(c, f)| vec![format!("factor at {c} °C"), significant(f.value, 6), error(f), note(f)]);
    let rows: Vec<Vec<String>> = own.chain(factors).collect();
    let mut text = format!("A law of type `{}`:\n{}", fit.declaration.name, table(&["parameter", "value", "standard error", ""], &rows));
    if let Some(worst) = fit.worst() {
        let place = if several { format!(" and {} °C", worst.celsius) } else { String::new() };
        text.push_str(&format!(
            "  off by {:.2} % of the stiffness (root mean square), by {:.2} % at {} Hz{place}; {} of {} searches end here\n",
            100.0 * fit.rms(),
            100.0 * worst.error(),
            worst.hz,
            fit.agreeing.0,
            fit.agreeing.1
        ));
    }
    let wlf = fit.williams_landel_ferry();
    let temperature = wlf.map(|(c1, c2, off)| {
        let reference = fit.factors.iter().find(|f| f.1.standard_error.is_none()).map_or(0.0, |f| f.0);
        text.push_str(&format!("  the factors follow Williams, Landel and Ferry to a factor of {}\n", significant(off, 3)));
        format!(
            "  material.temperature.wlf = {{ c1 = {}, c2_k = {}, reference_c = {reference} }}\n",
            significant(c1, 5),
            significant(c2, 5)
        )
    });
    let values = parameters.iter().zip(&fit.values).map(|(p, f)| format!("{} = {}", p.key, rounded(f.value)));
    let line = values.collect::<Vec<_>>().join(", ");
    text + &format!(
        "In a study, with a ring of its own:\n  type.{} = {{ ring_inertia_kg_m2 = …, {line} }}\n{}",
        fit.declaration.name,
        temperature.unwrap_or_default()
    )
}
