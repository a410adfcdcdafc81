//! Temperatures of absorbers, in words.

use super::table::{significant, table};
use crate::analysis::{HeatAt, HeatOfDesign, Results};
use crate::units::DEG_PER_RAD;

/// The designs in balance of heat; empty where no material says what cools it.
pub(crate) fn heat(results: &Results) -> String {
    if results.heat.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = results.heat.iter().map(row).collect();
    let header = ["design", "hottest/°C", "at/rpm", "limit/°C", "twist/°", "at/rpm", "heat/W"];
    let mut text = format!("In balance of heat, each speed by itself, reached from cold:\n{}", table(&header, &rows));
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
        let over: Vec<&HeatAt> = d.points.iter().filter(|p| p.balances.is_empty()).collect();
        if let (Some(first), Some(last)) = (over.first(), over.last()) {
            let most = over.iter().map(|p| p.power_at_limit).fold(0.0, f64::max);
            text.push_str(&format!(
                "  {} OVERHEATS at {} speeds from {} to {} rpm: at {} °C it still dissipates up to {most:.0} W.\n",
                d.design,
                over.len(),
                first.speed_rpm,
                last.speed_rpm,
                d.limit
            ));
        }
    }
    text
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
        format!("{most:.0}"),
    ]
}
