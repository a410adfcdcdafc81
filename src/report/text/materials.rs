//! Temperatures and materials of absorbers, in words.

use super::table::{significant, table};
use crate::analysis::{DesignResult, HeatAt, HeatOfDesign, Results, SimplestLaw};
use crate::input::Study;
use crate::objective::Condition;
use crate::units::{DEG_PER_RAD, PA_PER_MPA};

/// The designs in balance of heat; empty where no material says what cools it.
#[doc(hidden)]
pub fn heat(results: &Results) -> String {
    if results.heat.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = results.heat.iter().map(row).collect();
    let header = ["design", "hottest/°C", "at/rpm", "limit/°C", "twist/°", "at/rpm", "heat/W"];
    let mut text = format!(
        "In balance of heat at the speeds of the study, each by itself, reached from cold (a limit counts between them, too):\n{}",
        table(&header, &rows)
    );
    for d in &results.heat {
        let several: Vec<&HeatAt> = d.points.iter().filter(|p| p.balances.len() > 1).collect();
        if let [first, .., last] = several.as_slice() {
            text.push_str(&format!(
                "  {}: up to {} temperatures are in balance at speeds from {} to {} rpm; which one is reached depends on what went before.\n",
                d.design,
                several.iter().map(|p| p.balances.len()).max().unwrap_or(0),
                first.speed_rpm,
                last.speed_rpm
            ));
        }
        let runs_away = d.points.iter().filter(|p| p.balances.len().is_multiple_of(2) && !p.balances.is_empty()).count();
        if runs_away > 0 {
            text.push_str(&format!(
                "  {}: at {runs_away} of the speeds the highest balance is not stable; once hotter than that, the absorber overheats.\n",
                d.design
            ));
        }
        let over: Vec<&HeatAt> = d.points.iter().filter(|p| p.balances.is_empty()).collect();
        if let (Some(first), Some(last)) = (over.first(), over.last()) {
            let most = over.iter().map(|p| p.power_at_limit).fold(0.0, f64::max);
            text.push_str(&format!(
                "  {} OVERHEATS at {} of the speeds, {}: at {} °C it still dissipates up to {most:.0} W.\n",
                d.design,
                over.len(),
                if over.len() == 1 {
                    format!("{} rpm", first.speed_rpm)
                } else {
                    format!("from {} to {} rpm", first.speed_rpm, last.speed_rpm)
                },
                d.limit
            ));
        }
    }
    text
}

/// Whether laws have to be as they are; empty where all are constant springs and dampers.
#[doc(hidden)]
pub fn simplest(study: &Study, results: &Results) -> String {
    let tolerance = format!("{} %", significant(100.0 * study.tolerance, 2));
    let word = |d: &SimplestLaw| {
        format!("{} (with its values at {:.0} Hz the peak errs by {} %)", d.design, d.hz, significant(100.0 * d.error, 2))
    };
    let (does, differs): (Vec<_>, Vec<_>) = results.simplest.iter().partition(|d| d.error <= study.tolerance);
    let mut text = String::new();
    for (list, verdict) in [(does, "is enough"), (differs, "is NOT enough")] {
        if !list.is_empty() {
            let words: Vec<String> = list.into_iter().map(word).collect();
            text.push_str(&format!(
                "Laws: within {tolerance} of the peak, a constant spring and damper {verdict} for {}.\n",
                words.join(", ")
            ));
        }
    }
    text
}

/// What absorbers would have to be made of; empty where no geometry is given.
#[doc(hidden)]
pub fn made_of(results: &Results) -> String {
    let mut rows = Vec::new();
    let shown = || results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design));
    for d in shown() {
        for (i, load) in d.loads.iter().enumerate() {
            let Some(m) = load.made_of else { continue };
            let dash = |x: Option<String>| x.unwrap_or_else(|| "-".into());
            rows.push(vec![
                d.name.clone(),
                (i + 1).to_string(),
                significant(1e6 * m.factor, 4),
                dash(m.rubber.map(|r| format!("{:.2}", r.1 / PA_PER_MPA))),
                dash(m.rubber.map(|r| format!("{:.0}", r.0))),
                dash(m.rubber.map(|r| format!("{:.2}", r.2))),
                dash(m.viscosity.map(|v| significant(v, 3))),
                format!("{:.1}", 100.0 * m.strain),
            ]);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let beyond = |d: &&DesignResult| d.loads.iter().filter_map(|l| l.made_of).any(|m| m.viscosity.is_some() && m.strain > 1.0);
    let names: Vec<&str> = shown().filter(beyond).map(|d| d.name.as_str()).collect();
    let beyond = if names.is_empty() {
        String::new()
    } else {
        format!(
            "  Oil sheared by more than one follows the rate of shear instead of its law here, which is of small strains: {}.\n",
            names.join(", ")
        )
    };
    let header = ["design", "absorber", "shape/cm³", "G'/MPa", "at/Hz", "loss factor", "viscosity/Pa s", "strain/%"];
    let table = table(&header, &rows);
    format!(
        "What the absorbers have to be made of, in the shape that is given, and the shear strain at the largest twist at the reference:\n{table}{beyond}"
    )
}

fn row(d: &HeatOfDesign) -> Vec<String> {
    let reached = d.points.iter().filter_map(|p| Some((p, p.cold_start()?)));
    let hottest = reached.clone().reduce(|m, p| if p.1.celsius > m.1.celsius { p } else { m });
    let most = reached.map(|p| p.1.power).fold(0.0, f64::max);
    let largest = d.points.iter().reduce(|m, p| if p.twist > m.twist { p } else { m });
    let dash = |x: Option<String>| x.unwrap_or_else(|| "-".into());
    vec![
        d.design.clone(),
        dash(hottest.map(|h| format!("{:.1}", h.1.celsius))),
        dash(hottest.map(|h| h.0.speed_rpm.to_string())),
        d.limit.to_string(),
        dash(largest.map(|p| significant(p.twist * DEG_PER_RAD, 4))),
        dash(largest.map(|p| p.speed_rpm.to_string())),
        dash(hottest.map(|_| format!("{most:.0}"))),
    ]
}

/// Temperatures of the conditions, and the designs that they do not change.
pub(super) fn temperatures(study: &Study, results: &Results) -> String {
    let told = [("cold", study.temperatures.cold), ("hot", study.temperatures.hot)];
    let words: Vec<String> = told.iter().filter_map(|(word, t)| Some(format!("{word}: materials at {} °C", (*t)?))).collect();
    if words.is_empty() {
        return String::new();
    }
    let unchanged = |d: &DesignResult| [Condition::Cold, Condition::Hot].iter().all(|c| c.changes_nothing(&d.absorbers));
    let shown = results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design));
    let ideal = |d: &&DesignResult| !d.absorbers.is_empty() && unchanged(d);
    let names: Vec<&str> = shown.filter(ideal).map(|d| d.name.as_str()).collect();
    let unchanged =
        if names.is_empty() { String::new() } else { format!("; taken to be the same at every temperature: {}", names.join(", ")) };
    format!("  {}{unchanged}\n", words.join(", "))
}
