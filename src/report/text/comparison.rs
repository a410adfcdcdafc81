//! What is printed of a comparison: a table that lines up, and a paragraph generated from the numbers.

use super::publications::{SAME_RING, agreements, value};
use super::table::{aligned, dash, significant};
use crate::input::Study;
use crate::validation::{Comparison, Entry, Kind, Ranked, Role, Spread};

/// An input that differs from the printed one by more than its digits.
fn differs(e: &Entry) -> bool {
    const DIGITS: f64 = 0.5;
    e.role == Role::Given
        && !is_own(e)
        && (e.computed.is_none() && e.published.is_some() || e.deviation_percent().is_some_and(|d| d.abs() > DIGITS))
}

/// A deviation with its sign; none where it rounds to zero.
fn percent(d: f64) -> String {
    if d.abs() < 0.05 { "0.0".into() } else { format!("{d:+.1}") }
}

fn row(e: &Entry) -> Vec<String> {
    let number = |x: Option<f64>| dash(x.map(|x| significant(x, 4)));
    vec![
        e.table.clone(),
        e.design.clone(),
        e.quantity.clone(),
        number(e.published),
        number(e.computed),
        e.unit.clone(),
        dash(e.deviation_percent().map(percent)),
        e.role.name().to_owned(),
    ]
}

/// Stresses by our own loads on assumed lengths, and factors without stresses: in `comparison.csv`, and summed up below.
fn is_own(e: &Entry) -> bool {
    matches!(
        e.kind,
        Kind::OwnStress
            | Kind::FullCycleStress
            | Kind::FlexibleStress
            | Kind::OwnMargin
            | Kind::FullCycleMargin
            | Kind::MultiaxialAlone
            | Kind::PlaneAngle
    )
}

/// Every number that is not an input, and inputs that differ from the printed ones. Notes are in `comparison.csv`; those of misprints and of what stays unexplained are printed too.
pub fn entries(c: &Comparison) -> String {
    let rows: Vec<Vec<String>> = c.entries.iter().filter(|e| (e.role != Role::Given || differs(e)) && !is_own(e)).map(row).collect();
    aligned(&["table", "design", "quantity", "published", "computed", "unit", "off/%", "role"], &rows, |c| c < 3 || c == 5 || c == 7)
}

fn spread(words: &str, s: &Spread) -> String {
    match (s.median(), s.worst()) {
        (Some(median), Some(worst)) => format!("{words}: {} rows, median {median:.1} %, worst {worst:.1} %", s.deviations.len()),
        _ => format!("{words}: no row"),
    }
}

/// Where a number stands, what it is, as printed and as computed.
fn named(e: &Entry) -> String {
    let design = if e.design.is_empty() { String::new() } else { format!(" of {}", e.design) };
    let number = |x: Option<f64>| dash(x.map(|x| significant(x, 4)));
    format!("{} {}{design} ({} printed, {} computed, {})", e.table, e.quantity, number(e.published), number(e.computed), e.unit)
}

/// Factors printed with one digit that differ by no more than it are the same.
const ONE_DIGIT: f64 = 0.1 + 1e-9;

/// Which design is best, how far ahead an optimum is, how good the predictions are, and what not to trust.
#[doc(hidden)]
pub fn paragraph(study: &Study, c: &Comparison) -> String {
    let parts = [best(study, c), reproduced(study, c), own_stresses(c), multiaxial_alone(c), misprints(c), doubts(study, c), tolerances(c)];
    parts.concat().iter().map(|line| format!("  {line}\n")).collect()
}

/// The same in few lines: how many numbers there are in each role, what is best and what is possible, how good the predictions are, and what of the tolerances fails.
#[doc(hidden)]
pub fn brief(study: &Study, c: &Comparison) -> String {
    let name = |role: Role| if role == Role::Erratum { "errata" } else { role.name() };
    let printed = || c.entries.iter().filter(|e| e.published.is_some());
    let of_role = |role: Role| (printed().filter(|e| e.role == role && !differs(e)).count(), name(role));
    let inputs = (c.entries.iter().filter(|e| differs(e)).count(), "by other inputs");
    let counts: Vec<(usize, &str)> = Role::ALL.map(of_role).into_iter().chain([inputs]).collect();
    let numbers = format!("{} published numbers: {}.", printed().count(), super::counted(&counts));
    let failing: Vec<String> = tolerances(c).into_iter().filter(|line| !line.ends_with("holds.")).collect();
    let held = c.verdict.checks.iter().filter(|check| check.holds()).count();
    let held = format!("{held} of {} tolerances that the study states hold.", c.verdict.checks.len());
    let more = [best(study, c), agreements(&(study, c)), own_stresses(c), doubts(study, c)].concat();
    let more = more.into_iter().filter(|line| !line.starts_with("Input differs"));
    let held = Some(held).filter(|_| !c.verdict.checks.is_empty());
    let lines = std::iter::once(numbers).chain(reproduced(study, c)).chain(more).chain(failing).chain(held);
    lines.map(|line| format!("  {line}\n")).collect()
}

/// Deviations of numbers of a kind that nothing was fitted to, per cent.
fn deviations(c: &Comparison, kind: Kind) -> impl Iterator<Item = f64> + '_ {
    let free = |role: Role| matches!(role, Role::Predicted | Role::Recomputed | Role::OtherModel);
    c.entries.iter().filter(move |e| e.kind == kind && free(e.role)).filter_map(Entry::deviation_percent)
}

/// The best published design, and what is possible beside it.
fn best(study: &Study, c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let v = &c.verdict;
    // a study may have designs where its tables have none
    let printed = study.published.as_ref().is_some_and(|p| !p.absorbers.is_empty());
    let plain: Vec<&Ranked> = v.designs.iter().filter(|d| printed && d.ring_inertia > 0.0).collect();
    if let (Some(best), none) = (plain.first(), v.designs.iter().find(|d| d.ring_inertia == 0.0)) {
        let beside = none.map_or_else(String::new, |n| format!(" (without absorber {})", value(study, n.objective)));
        let others: Vec<String> = plain[1..].iter().map(|d| format!("{} {}", d.name, value(study, d.objective))).collect();
        let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
        lines.push(format!(
            "Best published: {} with a {} of {}{beside}{others}.",
            best.name,
            study.objective.label,
            value(study, best.objective)
        ));
        let mut possible = |ring: String, own: &Ranked| {
            let ratio = own.objective / best.objective;
            let words = if ratio > 1.0 { "above" } else { "below" };
            lines.push(format!(
                "Possible with {ring}: {} by {}, {:.1} % {words}.",
                value(study, own.objective),
                own.name,
                100.0 * (1.0 - ratio).abs()
            ));
        };
        let same_ring = v.optima.iter().find(|o| (o.ring_inertia / best.ring_inertia - 1.0).abs() < SAME_RING);
        if let Some(own) = same_ring {
            possible("the same ring".into(), own);
        }
        if let Some(own) = v.optima.first().filter(|o| same_ring.is_none_or(|s| s.name != o.name)) {
            possible(format!("a ring of {} kg m²", significant(own.ring_inertia, 4)), own);
        }
    }
    lines
}

/// Amplitudes, and the worst of what is reproduced.
fn reproduced(study: &Study, c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let mut put = |line: String| lines.push(line);
    let v = &c.verdict;
    let fitted = c.entries.iter().filter(|e| e.kind == Kind::Amplitude && e.role == Role::Calibrated).count();
    if !v.all.deviations.is_empty() {
        put(format!(
            "Amplitudes at {}: {fitted} fitted. Predicted: {}. {}; {}.",
            study.chain.stations[study.hub].name,
            spread("all", &v.all),
            spread("tuned", &v.tuned),
            spread("viscous", &v.viscous)
        ));
    }
    let worst = |kind: Kind| deviations(c, kind).map(f64::abs).reduce(f64::max).map(|w| format!("{w:.2} %"));
    let trusted = [
        ("natural frequencies", Kind::Frequency),
        ("critical speeds", Kind::CriticalSpeed),
        ("absorber stiffness", Kind::Stiffness),
        ("absorber damping", Kind::Damping),
    ];
    let trusted: Vec<String> = trusted.iter().filter_map(|(words, kind)| worst(*kind).map(|w| format!("{words} {w}"))).collect();
    if !trusted.is_empty() {
        put(format!("Reproduced, at worst: {}.", trusted.join(", ")));
    }
    lines
}

/// Multiaxial factors without stresses.
fn multiaxial_alone(c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let mut put = |line: String| lines.push(line);
    let pairs: Vec<(f64, f64)> = c
        .entries
        .iter()
        .filter(|e| e.kind == Kind::MultiaxialAlone && e.role == Role::Recomputed)
        .filter_map(|e| e.published.zip(e.computed))
        .collect();
    if !pairs.is_empty() {
        let same = pairs.iter().filter(|(a, b)| (a - b).abs() <= ONE_DIGIT).count();
        put(format!(
            "Multiaxial factors without printed stresses: those by Kakuno-Kawada are those by Sines, to their digit, at {same} of {} points.",
            pairs.len()
        ));
    }
    lines
}

/// What contradicts its own source, and what no model comes near.
fn misprints(c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let mut put = |line: String| lines.push(line);
    for (role, words) in [(Role::Erratum, "Erratum"), (Role::Unexplained, "Unexplained")] {
        let of_role: Vec<&Entry> = c.entries.iter().filter(|e| e.role == role).collect();
        for (i, e) in of_role.iter().enumerate() {
            // entries with the same note share a sentence
            if of_role[..i].iter().any(|before| before.note == e.note) {
                continue;
            }
            let alike: Vec<String> = of_role[i..].iter().filter(|o| o.note == e.note).map(|o| named(o)).collect();
            put(format!("{words}: {}{}: {}.", if e.table == "text" { "" } else { "table " }, alike.join(", "), e.note));
        }
    }
    lines
}

/// Other models, inputs that differ, and the prediction to trust least.
fn doubts(study: &Study, c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let mut put = |line: String| lines.push(line);
    let other: Option<f64> = deviations(c, Kind::OtherModel).map(f64::abs).reduce(f64::max);
    if let Some(other) = other {
        put(format!("Other models of this engine have natural frequencies up to {other:.1} % away; they are not counted above."));
    }
    for e in c.entries.iter().filter(|e| differs(e)) {
        put(format!("Input differs: {}: {}.", named(e), e.note));
    }
    let counted = c.amplitudes.iter().filter(|r| r.role == Role::Predicted);
    let worst = counted.filter_map(|r| r.deviation_percent().map(|d| (d, r))).max_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((d, r)) = worst.filter(|w| w.0 > 15.0) {
        put(format!("Trust least: order {} of {}, off by {d:.0} %.", r.order, study.designs[r.design].name));
    }
    lines
}

/// The stated tolerances, and the limits of the study.
fn tolerances(c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let mut put = |line: String| lines.push(line);
    let v = &c.verdict;
    for check in &v.checks {
        let word = if check.holds() { "holds" } else { "FAILS" };
        let found = match check.found {
            Some(found) if found.is_finite() => format!("{found:.2} %"),
            Some(_) => "a number without counterpart".into(),
            None => "nothing to compare".into(),
        };
        put(format!("Tolerance, {}, {} %: {found}: {word}.", check.what, check.tolerance));
    }
    if !v.limits_hold {
        put("An optimum breaks a limit of the study; `hartog run` says which: FAILS.".into());
    }
    lines
}

/// What our own loads make of the crank, case by case.
fn own_stresses(c: &Comparison) -> Vec<String> {
    let mut lines = Vec::new();
    let of = |k: Kind, case: &str| match k {
        Kind::FullCycleStress => case == "finite elements",
        Kind::FlexibleStress => case == "largest von Mises stress",
        _ => k == Kind::OwnStress,
    };
    for case in ["case A", "case B", "case C", "finite elements", "largest von Mises stress"] {
        let ratios_of = |counts: &dyn Fn(Kind) -> bool| {
            let own = c.entries.iter().filter(|e| counts(e.kind) && e.quantity.contains(case));
            let mut ratios: Vec<f64> = own.filter_map(|e| Some(e.computed? / e.published?)).collect();
            ratios.sort_by(f64::total_cmp);
            ratios
        };
        let words = |ratios: &[f64]| {
            let (low, high) = (ratios.first()?, ratios.last()?);
            Some(format!("{:.2} times (median of {}, {low:.2} to {high:.2})", ratios[ratios.len() / 2], ratios.len()))
        };
        let both = [("stresses", ratios_of(&|k| of(k, case))), ("safety factors", ratios_of(&|k| k == Kind::OwnMargin))];
        let parts: Vec<String> =
            both.iter().filter_map(|(what, ratios)| Some(format!("{what} {} the printed ones", words(ratios)?))).collect();
        if !parts.is_empty() {
            lines.push(format!("Crank by our own loads on assumed lengths, {case}: {}.", parts.join(", ")));
        }
    }
    lines
}
