//! A law fitted to measured stiffness, in words.

use super::table::{significant, table};
use crate::analysis::fit_law::{Fitted, LawFit};
use crate::csv::rounded;

/// Values with standard errors, factors of temperature, how well it fits, and the line of a study.
#[doc(hidden)]
pub fn fit_law(fit: &LawFit) -> String {
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
    if !fit.describes() {
        text.push_str("  warning: a law of this type does not describe these measurements; what follows is the nearest one\n");
    }
    let temperature = temperature(fit);
    if let Some((law, off, _)) = &temperature {
        // an exponential has one constant, Williams, Landel and Ferry two
        let constants = if fit.declaration.stiffness_follows() { 1 } else { 2 };
        let unchecked =
            if fit.factors.len() <= constants + 1 { ", as few temperatures as it has constants: nothing checks it" } else { "" };
        text.push_str(&format!("  the factors follow {law} to a factor of {}{unchecked}\n", significant(*off, 3)));
    }
    let values = parameters.iter().zip(&fit.values).map(|(p, f)| format!("{} = {}", p.key, rounded(f.value)));
    let line = values.collect::<Vec<_>>().join(", ");
    text + &format!(
        "In a study, with a ring of its own:\n  type.{} = {{ ring_inertia_kg_m2 = …, {line} }}\n{}",
        fit.declaration.name,
        temperature.map_or_else(String::new, |t| t.2)
    )
}

/// The law of temperature that the factors follow, by its name, the largest ratio that is left, and its line of a study: a shift of frequency, or where the stiffness is the same at every frequency its fall per kelvin.
fn temperature(fit: &LawFit) -> Option<(&'static str, f64, String)> {
    let reference = fit.factors.iter().find(|f| f.1.standard_error.is_none())?.0;
    if fit.declaration.stiffness_follows() {
        let (per_k, off) = fit.exponential()?;
        let (low, high) = (fit.factors.first()?.0, fit.factors.last()?.0);
        let values = format!("per_k = {}, reference_c = {reference}, between_c = [{low}, {high}]", significant(per_k, 5));
        return Some(("an exponential", off, format!("  material.temperature.exponential = {{ {values} }}\n")));
    }
    let (c1, c2, off) = fit.williams_landel_ferry()?;
    let values = format!("c1 = {}, c2_k = {}, reference_c = {reference}", significant(c1, 5), significant(c2, 5));
    Some(("Williams, Landel and Ferry", off, format!("  material.temperature.wlf = {{ {values} }}\n")))
}
