//! What sizing says on the terminal.

use super::table::{aligned, dash, significant, table};
use crate::analysis::sizing::{SizingResults, crank_mass};
use crate::input::SizingStudy;
use crate::sizing::Margin;
use crate::units::{DEG_PER_RAD, M_PER_MM};
use crate::validation::rounds::{EXPLAINED, RoundRow, reason};
use crate::validation::worked_examples::ExampleRow;
use std::fmt::Write;

fn dimensions(results: &SizingResults) -> String {
    let (first, last) = (&results.sized.rounds[0], results.sized.last());
    let rows: Vec<Vec<String>> = first
        .sizes
        .named()
        .iter()
        .zip(last.sizes.named())
        .map(|(a, b)| vec![a.0.replace('_', " "), significant(a.1 / M_PER_MM, 5), significant(b.1 / M_PER_MM, 5)])
        .collect();
    format!("Dimensions:\n{}", table(&["", "first round/mm", "last round/mm"], &rows))
}

fn margins(study: &SizingStudy, results: &SizingResults) -> String {
    let last = results.sized.last();
    let cell = |x: f64| dash(x.is_finite().then(|| significant(x, 4)));
    let mut rows: Vec<Vec<String>> = last
        .margins
        .iter()
        .map(|m: &Margin| {
            let governs = if m.fatigue <= m.yielding { "fatigue" } else { "yielding" };
            let governs = if m.fatigue.is_finite() || m.yielding.is_finite() { governs } else { "nothing" };
            vec![m.section.replace('_', " "), cell(m.yielding), cell(m.fatigue), governs.into()]
        })
        .collect();
    rows.insert(2, vec!["rod shank, buckling".into(), cell(last.buckling_margin), "-".into(), "-".into()]);
    format!(
        "Margins (design factor {}, {} against buckling):\n{}",
        study.specification.design_factor,
        study.specification.buckling_factor,
        table(&["section", "yielding", "fatigue", "smaller"], &rows)
    ) + &short_of(study, results)
}

fn short_of(study: &SizingStudy, results: &SizingResults) -> String {
    let short = results.sized.last().short_of(&study.specification);
    if short.is_empty() {
        return String::new();
    }
    format!(
        "  FAILS: with the dimensions given, {} {} short of the factor.\n",
        short.join(", ").replace('_', " "),
        if short.len() == 1 { "is" } else { "are" }
    )
}

fn bodies(study: &SizingStudy, results: &SizingResults) -> String {
    let last = results.sized.last();
    let rows: Vec<Vec<String>> = [("rod, from the big end", last.rod), ("throw, from the axis", last.throw)]
        .iter()
        .map(|(name, b)| {
            let [mass, centre] = [b.mass, b.centre / M_PER_MM].map(|x| significant(x, 4));
            let [own, reference] = [b.inertia(), b.inertia_at_reference].map(|x| significant(x, 4));
            vec![(*name).to_owned(), mass, centre, own, reference]
        })
        .collect();
    format!(
        "Masses:\n{}  crank with its flywheel seat: {} kg\n",
        table(&["", "mass/kg", "centre/mm", "about centre/kg m²", "about reference/kg m²"], &rows),
        significant(crank_mass(study, &results.sized), 4)
    )
}

/// Printed rounds beside ours.
#[doc(hidden)]
pub fn rounds(rows: &[RoundRow]) -> String {
    let last = rows.iter().map(|r| r.round).max().unwrap_or(0);
    let of_round = |symbol: &str, round: usize| rows.iter().find(|r| r.quantity.symbol == symbol && r.round == round);
    let lines: Vec<Vec<String>> = rows
        .iter()
        .filter(|r| r.round == last)
        .map(|r| {
            let first = of_round(r.quantity.symbol, 1).map(|f| format!("{} / {}", significant(f.published, 4), significant(f.computed, 4)));
            vec![
                r.quantity.symbol.to_owned(),
                r.quantity.words.to_owned(),
                r.quantity.unit.to_owned(),
                dash(first),
                format!("{} / {}", significant(r.published, 4), significant(r.computed, 4)),
                format!("{:+.1}", r.deviation_percent()),
            ]
        })
        .collect();
    let header = ["", "", "unit", "round 1", &format!("round {last}"), "last/%"];
    let mut text = format!("Printed rounds (printed / computed):\n{}", aligned(&header, &lines, |c| c < 3));
    // symbols with the same reason together
    let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
    for symbol in rows.iter().filter(|r| r.round == last && r.deviation_percent().abs() > EXPLAINED).map(|r| r.quantity.symbol) {
        match reasons.iter_mut().find(|r| r.0 == reason(symbol)) {
            Some(known) => known.1.push(symbol),
            None => reasons.push((reason(symbol), vec![symbol])),
        }
    }
    for (reason, symbols) in reasons {
        _ = writeln!(text, "  {}: {reason}.", symbols.join(", "));
    }
    text
}

fn by_response(results: &SizingResults) -> String {
    let Some(r) = &results.by_response else { return String::new() };
    let absorber = r.absorbers.first().map_or_else(
        || "without absorber".to_owned(),
        |a| format!("with {} absorber of {} kg m²", a.absorber.type_name(), significant(a.absorber.ring_inertia(), 4)),
    );
    format!(
        "Crank, chain and absorber agree after {} rounds, {absorber}: first natural frequency {} Hz, twist {}°, vibratory torque {} N m.\n",
        r.rounds,
        significant(r.frequency_hz, 4),
        significant(r.twist * DEG_PER_RAD, 4),
        significant(r.torque, 4)
    )
}

fn front(results: &SizingResults) -> String {
    let [none, .., largest] = results.front.as_slice() else { return String::new() };
    let rows: Vec<Vec<String>> = results
        .front
        .iter()
        .map(|p| {
            vec![
                if p.ring_inertia == 0.0 { "none".into() } else { significant(p.ring_inertia, 4) },
                significant(p.crank_mass, 4),
                significant(p.crankpin_diameter / M_PER_MM, 4),
                significant(p.journal_diameter / M_PER_MM, 4),
                significant(p.response.frequency_hz, 4),
                significant(p.response.twist * DEG_PER_RAD, 4),
                significant(p.response.torque, 4),
            ]
        })
        .collect();
    let lighter = 100.0 * (1.0 - largest.crank_mass / none.crank_mass);
    format!(
        "Crank mass against ring inertia, every crank with the same design factor:\n{}  The largest ring makes the crank {lighter:.1} % lighter than that without absorber. Each absorber is the one of least twist for its crank; f1 is with it.\n",
        table(&["ring/kg m²", "crank/kg", "crankpin/mm", "journal/mm", "f1/Hz", "twist/°", "torque/N m"], &rows)
    )
}

/// Fillet over diameter in the charts of stepped shafts.
const SHARPEST: f64 = 0.01;
const ROUNDEST: f64 = 0.3;

/// Results of worked examples beside ours.
pub fn examples(rows: &[ExampleRow]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let cells = |r: &ExampleRow| {
        let names = [&r.table, &r.example, &r.quantity, &r.unit].map(|s| s.replace('_', " "));
        let numbers = [Some(r.book), r.program, r.computed].map(|x| dash(x.map(|x| significant(x, 5))));
        names.into_iter().chain(numbers).chain([dash(r.deviation_percent().map(|d| format!("{d:+.2}")))]).collect()
    };
    let lines: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let header = ["table", "example", "quantity", "unit", "published", "program", "computed", "off/%"];
    format!("Worked examples:\n{}", aligned(&header, &lines, |c| c < 4))
}

/// Last dimensions, smallest margin and masses in few lines, the front as a table.
#[doc(hidden)]
pub fn brief(study: &SizingStudy, results: &SizingResults) -> String {
    let last = results.sized.last();
    let dimensions: Vec<String> =
        last.sizes.named().iter().map(|(name, m)| format!("{} {}", name.replace('_', " "), significant(m / M_PER_MM, 4))).collect();
    let mut text = title(study, results);
    _ = writeln!(text, "\n  dimensions, mm: {}", dimensions.join(", "));
    let margin = |m: &Margin| m.fatigue.min(m.yielding);
    if let Some(least) = last.margins.iter().min_by(|a, b| margin(a).total_cmp(&margin(b))) {
        _ = writeln!(
            text,
            "  smallest margin {} ({}), {} against buckling; design factors {} and {}",
            significant(margin(least), 4),
            least.section.replace('_', " "),
            significant(last.buckling_margin, 4),
            study.specification.design_factor,
            study.specification.buckling_factor
        );
    }
    text += &short_of(study, results);
    let [rod, throw] = [last.rod, last.throw].map(|b| significant(b.mass, 4));
    _ = writeln!(
        text,
        "  masses, kg: rod {rod}, a throw {throw}, crank with its flywheel seat {}",
        significant(crank_mass(study, &results.sized), 4)
    );
    for part in [by_response(results), front(results)].iter().filter(|p| !p.is_empty()) {
        text += "\n";
        text += part;
    }
    text + "\n"
}

/// The engine, warnings, and how many rounds it took.
fn title(study: &SizingStudy, results: &SizingResults) -> String {
    let spec = &study.specification;
    let mut text = format!(
        "{}: {} cylinder{}, {:.1} cm³, bore {} mm, stroke {} mm, rod {} mm\n",
        study.title,
        spec.firing_deg.len(),
        if spec.firing_deg.len() == 1 { "" } else { "s" },
        1e6 * spec.firing_deg.len() as f64 * spec.stroke * 0.25 * std::f64::consts::PI * spec.bore * spec.bore,
        significant(spec.bore / M_PER_MM, 4),
        significant(spec.stroke / M_PER_MM, 4),
        significant(spec.rod_length / M_PER_MM, 4)
    );
    for warning in &study.warnings {
        _ = writeln!(text, "  warning: {warning}");
    }
    let round = results.sized.last();
    for (name, diameter) in [("crankpin", round.sizes.crankpin_diameter), ("journal", round.sizes.journal_diameter)] {
        let ratio = spec.fillet_radius / diameter;
        if !(SHARPEST..=ROUNDEST).contains(&ratio) {
            _ = writeln!(
                text,
                "  warning: the fillet is {ratio:.4} of the {name}'s diameter, outside {SHARPEST} to {ROUNDEST}, where its stress concentration is known"
            );
        }
    }
    let rigid = results.sized.rounds.len() - results.by_response.as_ref().map_or(0, |r| r.rounds);
    _ = writeln!(text, "  {rigid} rounds until dimensions, masses and forces agree, the crank rigid in torsion");
    text
}

/// Dimensions, margins, masses, what is printed elsewhere, and the front.
#[doc(hidden)]
pub fn sizing(study: &SizingStudy, results: &SizingResults, published: &[RoundRow]) -> String {
    let mut text = title(study, results);
    let parts = [dimensions(results), margins(study, results), bodies(study, results), by_response(results), front(results)];
    for part in parts.iter().filter(|p| !p.is_empty()) {
        text += "\n";
        text += part;
    }
    if !published.is_empty() {
        text += "\n";
        text += &rounds(published);
    }
    text + "\n"
}
