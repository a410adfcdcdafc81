//! The table of designs and optima that a run prints first.

use super::judged::{asked, is_apart, is_other, word};
use super::table::{dash, significant, table};
use super::verdict::verdicts;
use super::width::is_wide;
use crate::absorber::parameter::{DAMPING, RING_INERTIA, STIFFNESS};
use crate::absorber::{Absorber, Host, Mounted, Parameter};
use crate::analysis::{DesignResult, Results};
use crate::csv::in_unit;
use crate::input::{Study, UnitOf};
use crate::response::Quantity;
use crate::units::DEG_PER_RAD;

/// Parameters that some absorber has besides ring inertia, stiffness and damping.
fn other_parameters<'a>(designs: impl Iterator<Item = &'a DesignResult>) -> Vec<&'static Parameter> {
    let mut list: Vec<&Parameter> = Vec::new();
    for p in designs.flat_map(|d| &d.absorbers).filter_map(|m| m.absorber.declaration()).flat_map(|t| t.parameters) {
        if ![RING_INERTIA.key, STIFFNESS.key, DAMPING.key].contains(&p.key) && list.iter().all(|known| known.key != p.key) {
            list.push(p);
        }
    }
    list
}

/// Ring, stiffness, damping and the other parameters of an absorber.
fn absorber_cells(mounted: Option<&Mounted>, others: &[&Parameter]) -> Vec<String> {
    let one = mounted.map(|m| &m.absorber);
    let mut cells = vec![
        dash(one.map(|a| significant(a.ring_inertia(), 4))),
        dash(one.and_then(Absorber::stiffness).map(|k| significant(k, 5))),
        dash(one.and_then(Absorber::damping).map(|c| significant(c, 4))),
    ];
    cells.extend(others.iter().map(|p| dash(one.and_then(|a| a.value(p.key)).map(|x| significant(x, 4)))));
    cells
}

/// A line for each absorber of a design after its first.
fn further_absorbers(study: &Study, d: &DesignResult, others: &[&Parameter], columns: usize) -> Vec<Vec<String>> {
    let line = |(i, m): (usize, &Mounted)| {
        let host = match m.on {
            Host::Station(station) => study.chain.stations[station].name.clone(),
            Host::Ring(inner) => format!("ring {}", inner + 1),
        };
        let mut row = vec![format!("  {}: {} on {host}", i + 1, m.absorber.type_name())];
        row.extend(absorber_cells(Some(m), others));
        row.resize(columns, String::new());
        row
    };
    d.absorbers.iter().enumerate().skip(1).map(line).collect()
}

fn design_row(study: &Study, results: &Results, d: &DesignResult, (others, judged): (&[&Parameter], bool)) -> Vec<String> {
    let orders = &results.system.excitation.orders;
    let frequency = |i: usize| dash(d.frequencies_hz.get(i).map(|f| format!("{f:.2}")));
    let mut row = vec![d.name.clone()];
    row.extend(absorber_cells(d.absorbers.first(), others));
    if is_wide() {
        row.extend([frequency(0), frequency(1), frequency(2)]);
    }
    row.extend([dash(d.twist.map(|p| significant(p.value * DEG_PER_RAD, 4))), dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm)))]);
    if is_wide() {
        row.push(dash(d.order_twist.map(|p| significant(p.value * DEG_PER_RAD, 4))));
        row.push(dash(d.order_twist.map(|p| format!("{} @ {:.0}", orders[p.order], p.speed_rpm))));
    }
    row.extend([dash(d.torque.map(|p| format!("{:.0}", p.value))), dash(d.power.map(|p| significant(p, 3)))]);
    if judged {
        let own = results.judged(d);
        row.push(dash(own.as_ref().map(|j| significant(in_unit(study, j.value), 5))));
        row.push(dash(own.filter(|j| !j.is_reference()).map(|j| word(j.reached_in))));
    }
    row.extend((!study.limits.is_empty()).then(|| held(results, d)));
    row
}

/// Whether a design holds its limits, in a word.
fn held(results: &Results, d: &DesignResult) -> String {
    if results.holds_limits(d) { "hold" } else { "FAIL" }.into()
}

/// The table of designs and optima.
pub fn designs(study: &Study, results: &Results) -> String {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let others = other_parameters(all());
    let mut header = vec!["design", "ring/kg m²", "k/N m/rad", "c/N m s/rad"];
    header.extend(others.iter().map(|p| p.label));
    let columns = ["f1/Hz", "f2/Hz", "f3/Hz", "twist/°", "at/rpm", "order/°", "order @ rpm", "torque/N m", "dissipated/W"];
    header.extend(columns.into_iter().filter(|c| is_wide() || !["f1/Hz", "f2/Hz", "f3/Hz", "order/°", "order @ rpm"].contains(c)));
    let judged = is_apart(study, results);
    let column = if study.objective.unit == UnitOf::Angle { "judged/°" } else { "judged" };
    if judged {
        header.extend([if is_other(study) { study.objective.column.as_str() } else { column }, "worst in"]);
    }
    header.extend((!study.limits.is_empty()).then_some("limits"));
    let mut rows = Vec::new();
    for d in all() {
        rows.push(design_row(study, results, d, (&others, judged)));
        rows.extend(further_absorbers(study, d, &others, header.len()));
    }
    let name = |i: usize| study.chain.stations[i].name.as_str();
    let between = match study.twist {
        Quantity::Twist { from, to } => format!("{} to {}", name(from), to.map_or("ground", name)),
        _ => String::new(),
    };
    let order = if is_wide() { "order: its largest single order; " } else { "" };
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    format!(
        "{}\n  twist: half peak-to-peak of all orders with phase, {between}, largest over {low} to {high} rpm;\n  {order}\
         torque: largest vibratory torque of a shaft; dissipated: mean power dissipated in the absorbers\n{}{}",
        table(&header, &rows),
        if judged { judged_in(study, results) } else { String::new() },
        verdicts(results)
    )
}

/// What designs are judged by, below the table.
fn judged_in(study: &Study, results: &Results) -> String {
    let (of, all) = (&study.objective.label, asked(results));
    let tolerances = results.optima.iter().any(|o| o.robust);
    let robust = if tolerances { ", robust ones within their tolerances" } else { "" };
    match all.is_empty() {
        true if !tolerances => String::new(),
        true => format!("  judged by: {of}{robust}; other columns are as drawn\n"),
        false => format!(
            "  judged by: {of}, at the worst of {all} as far as that changes a design{robust}; other columns are of firing, at the reference\n"
        ),
    }
}

/// Columns of the narrow table besides the design, those that are given up last first.
const NARROW: [&str; 5] = ["twist/°", "at/rpm", "torque/N m", "ring/kg m²", "k/N m/rad"];

/// The table on one screen (rings of all absorbers together): the first `most` designs, given ones before optima, and as many columns as fit the width.
pub(super) fn narrow(study: &Study, results: &Results, most: usize) -> String {
    let all: Vec<&DesignResult> = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).collect();
    let judged = is_apart(study, results);
    let limited = !study.limits.is_empty();
    let row = |d: &&DesignResult| {
        let alone = d.absorbers.first().map(|m| &m.absorber).filter(|_| d.absorbers.len() == 1);
        let rings = d.absorbers.iter().map(|m| m.absorber.ring_inertia()).sum::<f64>();
        let mut row = vec![d.name.clone()];
        if judged {
            let own = results.judged(d);
            row.push(dash(own.as_ref().map(|j| significant(in_unit(study, j.value), 5))));
            row.push(dash(own.filter(|j| !j.is_reference()).map(|j| word(j.reached_in))));
        }
        if limited {
            row.push(held(results, d));
        }
        row.extend([
            dash(d.twist.map(|p| significant(p.value * DEG_PER_RAD, 4))),
            dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm))),
            dash(d.torque.map(|p| format!("{:.0}", p.value))),
            dash((!d.absorbers.is_empty()).then(|| significant(rings, 4))),
            dash(alone.and_then(Absorber::stiffness).map(|k| significant(k, 5))),
        ]);
        row
    };
    let column = if study.objective.unit == UnitOf::Angle { "judged/°" } else { "judged" };
    let mut header = vec!["design"];
    if judged {
        header.extend([if is_other(study) { study.objective.column.as_str() } else { column }, "worst in"]);
    }
    header.extend(limited.then_some("limits"));
    header.extend(NARROW);
    let shown = shown(&all, results.designs.len(), most);
    let rows: Vec<Vec<String>> = shown.iter().map(row).collect();
    let text = loop {
        let cut: Vec<Vec<String>> = rows.iter().map(|r| r[..header.len()].to_vec()).collect();
        let text = table(&header, &cut);
        // a table that does not fit goes on below, after an empty line
        if header.len() < 3 || !text.contains("\n\n") {
            break text;
        }
        header.pop();
    };
    let left = all.len() - shown.len();
    let more = if left > 0 { format!("  {left} more in designs.csv\n") } else { String::new() };
    text + &more
}

/// So many of the designs: where there are too many, as many of the given ones, which come first, as of the optima.
fn shown<'d>(all: &[&'d DesignResult], given: usize, most: usize) -> Vec<&'d DesignResult> {
    if all.len() <= most {
        return all.to_vec();
    }
    let optima = all.len() - given;
    let of_optima = optima.min(most.div_ceil(2)).max(most.saturating_sub(given));
    let (first, rest) = all.split_at(given);
    first[..most - of_optima].iter().chain(&rest[..of_optima]).copied().collect()
}
