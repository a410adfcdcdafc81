//! What comparisons come to by publication: which designs it chooses and how far ours agree, how far numbers are off by role, what contradicts itself.

use super::table::{aligned, dash, significant};
use crate::crankshaft::Place;
use crate::input::{Study, UnitOf};
use crate::units::DEG_PER_RAD;
use crate::validation::rounds::RoundRow;
use crate::validation::worked_examples::ExampleRow;
use crate::validation::{Agreement, Chosen, Comparison, Entry, Kind, Placed, Role, Spread};

/// A study with what it comes to.
pub type Page<'a> = (&'a Study, &'a Comparison);

/// Rings whose inertias differ by less than this share are the same.
pub(super) const SAME_RING: f64 = 1e-9;

/// The publication a study is of; the engine where the study names none.
fn source<'a>((study, _): &Page<'a>) -> &'a str {
    study.published.as_ref().map(|p| p.source.as_str()).filter(|s| !s.is_empty()).unwrap_or(&study.engine.name)
}

/// Studies by publication, as they come.
fn by_source<'a>(pages: &[Page<'a>]) -> Vec<(&'a str, Vec<Page<'a>>)> {
    let mut groups: Vec<(&str, Vec<Page>)> = Vec::new();
    for page in pages {
        match groups.iter_mut().find(|g| g.0 == source(page)) {
            Some(group) => group.1.push(*page),
            None => groups.push((source(page), vec![*page])),
        }
    }
    groups
}

/// Rounds of sizing and worked examples beside ours.
#[derive(Debug, Clone)]
pub struct SizedPage {
    /// Title of the file.
    pub title: String,
    /// Rounds.
    pub rounds: Vec<RoundRow>,
    /// Worked examples.
    pub examples: Vec<ExampleRow>,
}

/// What is said of several studies and of sizing, by publication.
pub fn publications(pages: &[Page], sized: &[SizedPage]) -> String {
    let groups = by_source(pages);
    let mut rows: Vec<Vec<String>> = groups.iter().flat_map(|(source, pages)| deviations(source, pages)).collect();
    rows.extend(sized.iter().flat_map(of_sizing));
    for i in (1..rows.len()).rev() {
        if rows[i][0] == rows[i - 1][0] {
            rows[i][0].clear();
        }
    }
    let mut text = aligned(&["publication", "role", "numbers", "median/%", "worst/%", "within"], &rows, |c| c < 2);
    let pairs: Vec<Vec<String>> = pages.iter().filter_map(pairs).collect();
    if !pairs.is_empty() {
        let header: Vec<&str> = std::iter::once("pairs in the printed order").chain(MEASURES.map(|m| m.0)).collect();
        text.push_str(&format!("\n{}", aligned(&header, &pairs, |c| c < 1)));
    }
    for (source, pages) in &groups {
        let sentences = [chosen(pages), accepted(pages), trends(pages), misprints(source, pages)].concat();
        sentences.iter().for_each(|s| text.push_str(&format!("  {s}\n")));
    }
    let checks = || pages.iter().flat_map(|p| &p.1.verdict.checks);
    let held = checks().filter(|check| check.holds()).count();
    if checks().count() > 0 {
        text.push_str(&format!("  {held} of {} tolerances that the studies state hold.\n", checks().count()));
    }
    text
}

/// What predicted numbers are, in the words of the summary.
fn words(kind: Kind) -> &'static str {
    match kind {
        Kind::Frequency | Kind::CriticalSpeed => "frequencies",
        Kind::Amplitude => "hub amplitudes",
        Kind::OwnStress | Kind::FullCycleStress | Kind::FlexibleStress | Kind::OwnMargin | Kind::FullCycleMargin => {
            "crank stress and margin"
        }
        Kind::CrankMode => "modes of the crank",
        Kind::VibratoryTorque => "vibratory torque",
        _ => "other",
    }
}

/// How far numbers of a publication are off by role, predicted ones by what they are. What contradicts itself or is unexplained is told apart from these, and inputs are as given.
fn deviations(source: &str, pages: &[Page]) -> Vec<Vec<String>> {
    let all: Vec<&Entry> = pages.iter().flat_map(|p| &p.1.entries).filter(|e| e.published.is_some() && e.kind != Kind::Accepted).collect();
    let told = |role: &Role| !matches!(role, Role::Given | Role::Erratum | Role::Unexplained);
    let mut rows: Vec<Vec<String>> = Vec::new();
    for role in Role::ALL.into_iter().filter(told) {
        let of_role: Vec<&Entry> = all.iter().copied().filter(|e| e.role == role).collect();
        if role != Role::Predicted {
            rows.extend((!of_role.is_empty()).then(|| row(source, role.name().to_owned(), &of_role)));
            continue;
        }
        let mut kinds: Vec<&str> = of_role.iter().map(|e| words(e.kind)).collect();
        kinds.sort_unstable();
        kinds.dedup();
        for kind in kinds {
            let of_kind: Vec<&Entry> = of_role.iter().copied().filter(|e| words(e.kind) == kind).collect();
            rows.push(row(source, format!("{}: {kind}", role.name()), &of_kind));
        }
    }
    rows
}

fn row(source: &str, role: String, entries: &[&Entry]) -> Vec<String> {
    let spread = Spread::new(entries.iter().filter_map(|e| e.deviation_percent()).map(f64::abs));
    let within = entries.iter().filter(|e| e.is_within() == Some(true)).count();
    let compared = entries.iter().filter(|e| e.is_within().is_some()).count();
    let within = if compared > 0 { format!("{within} of {compared}") } else { "-".into() };
    spread_row(source, role, entries.len(), &spread, within)
}

fn spread_row(source: &str, role: String, numbers: usize, spread: &Spread, within: String) -> Vec<String> {
    let percent = |x: Option<f64>| dash(x.map(|x| format!("{x:.1}")));
    vec![source.to_owned(), role, numbers.to_string(), percent(spread.median()), percent(spread.worst()), within]
}

/// The last of our rounds of sizing beside the printed one, and worked examples.
fn of_sizing(page: &SizedPage) -> Vec<Vec<String>> {
    let last = page.rounds.iter().map(|r| r.round).max().unwrap_or(0);
    let rounds = Spread::new(page.rounds.iter().filter(|r| r.round == last).map(|r| r.deviation_percent().abs()));
    let examples = Spread::new(page.examples.iter().filter_map(|e| e.deviation_percent()).map(f64::abs));
    let within = page.examples.iter().filter(|e| e.computed.is_some_and(|c| (c - e.book).abs() <= e.half_digit)).count();
    let mut rows = Vec::new();
    if !rounds.deviations.is_empty() {
        let role = format!("{}: round {last} of sizing", Role::Predicted.name());
        rows.push(spread_row(&page.title, role, rounds.deviations.len(), &rounds, "-".into()));
    }
    if !examples.deviations.is_empty() {
        let (role, n) = (format!("{}: worked examples", Role::Recomputed.name()), examples.deviations.len());
        rows.push(spread_row(&page.title, role, n, &examples, format!("{within} of {n}")));
    }
    rows
}

/// Measures that designs are ranked by, in words: of margins at every place of the tables.
const MEASURES: [(&str, Kind); 4] = [
    ("hub amplitude", Kind::Amplitude),
    ("torque", Kind::VibratoryTorque),
    ("margin, case C", Kind::OwnMargin),
    ("margin, full cycle", Kind::FullCycleMargin),
];

/// How many pairs of designs are in the printed order by every measure: of margins at crankpins, then at journals. `None` where nothing is ranked.
fn pairs((study, c): &Page) -> Option<Vec<String>> {
    let agreement = |kind: Kind, place: &str| {
        let of = c.choices.rankings.iter().filter(|r| r.kind == kind && r.quantity.ends_with(place));
        let own = Agreement::of(of);
        (own.pairs > 0).then(|| format!("{} of {}", own.agree, own.pairs))
    };
    let cell = |(_, kind): (&str, Kind)| match kind {
        Kind::OwnMargin | Kind::FullCycleMargin => {
            let both = [Place::Crankpin, Place::Journal].map(|p| agreement(kind, p.name()).unwrap_or_else(|| "-".into()));
            both.join(", ")
        }
        _ => dash(agreement(kind, "")),
    };
    (!c.choices.rankings.is_empty()).then(|| std::iter::once(study.engine.name.clone()).chain(MEASURES.map(cell)).collect())
}

/// How many pairs of designs of one study are in the printed order.
pub(super) fn agreements(page: &Page) -> Vec<String> {
    let named = |row: Vec<String>| {
        let parts: Vec<String> = MEASURES.iter().zip(&row[1..]).map(|((what, _), cell)| format!("{what} {cell}")).collect();
        format!("Pairs of designs in the printed order (margins at crankpins, journals): {}.", parts.join("; "))
    };
    pairs(page).map(named).into_iter().chain(chosen(&[*page])).collect()
}

/// What a publication recommends, and our optimum beside it.
fn chosen(pages: &[Page]) -> Vec<String> {
    let line = |(study, c): &Page| {
        let name = |c: &Chosen| format!("{} ({})", c.design.replace('_', " "), c.choice.table);
        let names: Vec<String> = c.choices.chosen.iter().map(name).collect();
        let ours = beside_ours(study, c).map_or_else(String::new, |ours| format!("; {ours}"));
        (!names.is_empty()).then(|| format!("{}: it chooses {}{ours}.", study.engine.name, names.join(", then ")))
    };
    pages.iter().filter_map(line).collect()
}

/// Our optimum beside each recommended design, by the objective of the study.
fn beside_ours(study: &Study, c: &Comparison) -> Option<String> {
    let own = |name: &str| c.verdict.designs.iter().find(|d| d.name == name);
    let chosen: Vec<_> = c.choices.chosen.iter().filter_map(|c| own(&c.design)).collect();
    let optimum = chosen.first().and_then(|first| {
        let same = c.verdict.optima.iter().find(|o| (o.ring_inertia / first.ring_inertia - 1.0).abs() < SAME_RING);
        same.or(c.verdict.optima.first())
    })?;
    let theirs: Vec<String> = chosen.iter().map(|d| value(study, d.objective)).collect();
    let best = value(study, optimum.objective);
    let what = &study.objective.label;
    Some(format!("{what} by ours {}, of the optimum with {} kg m² {best}", theirs.join(" and "), significant(optimum.ring_inertia, 4)))
}

/// Which designs hold the amplitude at the hub that a publication accepts, as printed and by ours.
fn accepted(pages: &[Page]) -> Vec<String> {
    let mut lines = Vec::new();
    for (study, c) in pages {
        let rows: Vec<&Entry> = c.entries.iter().filter(|e| e.kind == Kind::Accepted).collect();
        let Some(limit) = c.accepted.filter(|_| !rows.is_empty()) else { continue };
        let hold = |value: fn(&Entry) -> Option<f64>| {
            let names: Vec<String> =
                rows.iter().filter(|e| value(e).is_some_and(|v| v <= limit)).map(|e| e.design.replace('_', " ")).collect();
            if names.is_empty() { "no design".to_owned() } else { names.join(", ") }
        };
        lines.push(format!(
            "{}: {}° of one order at the hub is accepted; it holds as printed with {}, by ours with {}.",
            study.engine.name,
            significant(limit, 2),
            hold(|e| e.published),
            hold(|e| e.computed)
        ));
    }
    lines
}

/// Largest stress of an engine over speed, as printed and ours.
fn trends(pages: &[Page]) -> Vec<String> {
    let stresses = |kind: Kind, study: &Study| -> Vec<(f64, f64)> {
        let own = pages.iter().filter(|p| p.0.engine.name == study.engine.name).flat_map(|p| &p.1.entries);
        own.filter(|e| e.kind == kind).filter_map(|e| e.published.zip(e.computed)).collect()
    };
    let mut lines = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    for (study, _) in pages {
        if names.contains(&study.engine.name.as_str()) {
            continue;
        }
        names.push(&study.engine.name);
        let mut told = Vec::new();
        let mut printed = Vec::new();
        for (kind, model) in [(Kind::FullCycleStress, "full cycle on the chain"), (Kind::FlexibleStress, "flexible crank")] {
            let pairs = stresses(kind, study);
            let (Some(first), Some(last)) = (pairs.first(), pairs.last()) else { continue };
            let reversed = (last.0 - first.0) * (last.1 - first.1) < 0.0;
            let list = |value: fn(&(f64, f64)) -> f64| pairs.iter().map(|p| format!("{:.0}", value(p))).collect::<Vec<_>>().join(", ");
            printed = vec![list(|p| p.0)];
            told.push(format!("{model} {}{}", list(|p| p.1), if reversed { " (reversed)" } else { "" }));
        }
        if !told.is_empty() {
            lines.push(format!(
                "{}, largest stress at rising speed: printed {} MPa; {}.",
                study.engine.name,
                printed.concat(),
                told.join("; ")
            ));
        }
    }
    lines
}

/// What contradicts its own source and what no model comes near, by table.
fn misprints(source: &str, pages: &[Page]) -> Vec<String> {
    let of_role = |role: Role, words: &str| {
        let all: Vec<&Entry> = pages.iter().flat_map(|p| &p.1.entries).filter(|e| e.role == role).collect();
        let mut tables: Vec<(&str, usize)> = Vec::new();
        for e in &all {
            match tables.iter_mut().find(|t| t.0 == e.table) {
                Some(found) => found.1 += 1,
                None => tables.push((&e.table, 1)),
            }
        }
        let named = |(table, n): &(&str, usize)| if *n > 1 { format!("{table} ({n})") } else { (*table).to_owned() };
        (!all.is_empty()).then(|| format!("{} {words}: {}", all.len(), tables.iter().map(named).collect::<Vec<_>>().join(", ")))
    };
    let both = [of_role(Role::Erratum, "errata (by table or section)"), of_role(Role::Unexplained, "unexplained")];
    let told: Vec<String> = both.into_iter().flatten().collect();
    if told.is_empty() { Vec::new() } else { vec![format!("{source}: {}.", told.join("; "))] }
}

/// Designs by every measure that is printed for several: as printed, ours, their places by each, and how many pairs are in the printed order.
pub fn rankings(c: &Comparison) -> String {
    let mut rows = Vec::new();
    for ranking in &c.choices.rankings {
        for placed in &ranking.designs {
            let (printed, ours) = (ranking.place(placed, |p: &Placed| p.published), ranking.place(placed, |p: &Placed| p.computed));
            let cells = [significant(placed.published, 4), significant(placed.computed, 4), printed.to_string(), ours.to_string()];
            rows.push([ranking.quantity.clone(), placed.design.clone()].into_iter().chain(cells).collect());
        }
        let own = ranking.agreement();
        let alike = if own.tied > 0 { format!(", {} printed alike", own.tied) } else { String::new() };
        rows.push(vec![
            String::new(),
            format!("{} of {} pairs in the printed order{alike}", own.agree, own.pairs),
            String::new(),
            String::new(),
            String::new(),
            String::new(),
        ]);
    }
    if rows.is_empty() {
        String::new()
    } else {
        aligned(&["measure", "design", "published", "computed", "place", "ours"], &rows, |c| c < 2)
    }
}

/// An objective in the unit of the study.
pub(super) fn value(study: &Study, v: f64) -> String {
    match study.objective.unit {
        UnitOf::Angle => format!("{}°", significant(v * DEG_PER_RAD, 4)),
        UnitOf::Torque => format!("{} N m", significant(v, 4)),
        UnitOf::Margin => crate::text::margin::factor(1.0 / v),
        unit => format!("{}{}", significant(unit.shown(v), 4), unit.suffix()),
    }
}
