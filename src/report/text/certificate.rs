//! Why an optimum is to be believed: starts, designs elsewhere and near it, other optima, first and second order.

use super::table::significant;
use crate::analysis::OptimumResult;
use crate::input::MeasureSpec;
use crate::optimise::{Stop, Survey};

/// Curvatures above this are no rounding of differences.
const ROUNDING: f64 = 1e-6;
/// Most other optima that are named.
const MOST_NAMED: usize = 3;

/// Words for designs beside an optimum: of a margin or a life the larger is the better.
struct Compared {
    better: &'static str,
    worse: &'static str,
    worse_ones: &'static str,
}

impl Compared {
    fn of(objective: &MeasureSpec) -> Self {
        if objective.unit.is_inverse() {
            Self { better: "better", worse: "worse than", worse_ones: "worse" }
        } else {
            Self { better: "lower", worse: "above", worse_ones: "higher" }
        }
    }
}

/// Its lines.
pub(super) fn certificate(objective: &MeasureSpec, o: &OptimumResult, value: impl Fn(&MeasureSpec, f64) -> String) -> Vec<String> {
    let mut lines = vec![starts(o)];
    let words = Compared::of(objective);
    let better = words.better;
    let others = &o.optimum.others;
    if !others.is_empty() {
        let named: Vec<String> = others.iter().take(MOST_NAMED).map(|l| value(objective, l.value)).collect();
        let more =
            if others.len() > MOST_NAMED { format!(" and {} {} ones", others.len() - MOST_NAMED, words.worse_ones) } else { String::new() };
        let held = if o.survey.is_some_and(|s| s.under_limits) { ", which hold the limits" } else { "" };
        lines.push(format!("  other local optima{held}: {}{more}", named.join(", ")));
    }
    match &o.scan {
        scan if scan.better && (o.nearby.better || o.survey.is_some_and(|s| s.better)) => {
            let led = format!("  one of {} designs elsewhere led to a {better} one than the starts", scan.designs);
            lines.push(format!("{led}: more random starts are advised"));
        }
        scan if scan.better => {
            lines.push(format!("  found from one of {} designs elsewhere, not from a start: more random starts are advised", scan.designs));
        }
        scan if scan.designs > 0 => {
            lines.push(format!(
                "  none of {} designs elsewhere, nor what the best {} of them lead to, is {better}",
                scan.designs, scan.followed
            ));
        }
        _ => {}
    }
    lines.extend(o.survey.as_ref().map(|s| survey(s, o.nearby.better, &words)));
    match &o.nearby {
        near if near.better => lines.push(format!("  found from one of {} random designs near the end of the search", near.designs)),
        near if near.designs > 0 => lines.push(format!("  none of {} random designs near it is {better}", near.designs)),
        _ => {}
    }
    let (s, outcome) = (&o.optimum.stages, &o.optimum.outcome);
    let residual = if outcome.kkt_residual.is_finite() { format!("{:.0e}", outcome.kkt_residual) } else { "not available".into() };
    lines.push(format!("  first order: KKT residual {residual}; {}", outcome.stop.reason()));
    if o.conflict.is_none() {
        lines.push(second_order(o));
    }
    lines.push(format!(
        "  evaluations: {} of starts, {} of search, {} of minimax",
        s.seeds.evaluations, s.search.evaluations, s.minimax.evaluations
    ));
    let unbounded = s.all().unbounded_evaluations;
    if unbounded > 0 {
        lines.push(format!("  designs that found no finite response, for want of damping at a resonance, and were passed by: {unbounded}"));
    }
    lines
}

/// What was looked at of the whole box, and what came of it: no more than that.
fn survey(s: &Survey, better_beside: bool, Compared { better, worse, .. }: &Compared) -> String {
    let of = match s.per_coordinate {
        Some(n) => format!("of {} designs on a grid over all bounds, {n} along each free parameter,", s.designs),
        None => format!("of {} designs at the ends and corners of the bounds and at random between them,", s.designs),
    };
    let asked = s.designs - s.above;
    let held = match s.within_limits {
        _ if !s.under_limits => None,
        0 => Some("none holds all limits".to_owned()),
        1 => Some("one holds all limits".to_owned()),
        n => Some(format!("{n} hold all limits")),
    };
    let above = (s.above > 0).then(|| match &held {
        Some(held) => format!("{} are {worse} the optimum by a quarter or have no finite response; of the other {asked}, {held}", s.above),
        None => format!("{} are {worse} the optimum by a quarter or have no finite response", s.above),
    });
    let followed = match (s.followed, s.better) {
        (0, _) => "none of them was worth following".to_owned(),
        (n, true) if better_beside => format!("{n} were followed: one of these led to a {better} one than what was known"),
        (n, true) => format!("{n} were followed: it was found from one of these"),
        (n, false) => {
            let within = if s.under_limits { " within the limits" } else { "" };
            format!("{n} were followed: none of these, nor what the best of them lead to, is {better}{within}")
        }
    };
    match above.or(held) {
        Some(judged) => format!("  {of} {judged}; {followed}"),
        None => format!("  {of} {followed}"),
    }
}

fn starts(o: &OptimumResult) -> String {
    let starts = &o.optimum.starts;
    let agreeing = o.optimum.agreeing();
    let ended = || o.optimum.ended().map(|s| s.finished);
    let lowest = ended().fold(f64::INFINITY, f64::min);
    let worst = ended().map(|finished| finished / lowest - 1.0).filter(|above| above.is_finite()).fold(0.0, f64::max);
    let outside = starts.len() - o.optimum.ended().count();
    let rest = match worst {
        _ if agreeing == starts.len() => String::new(),
        _ if outside > 0 => format!("; {outside} ended outside the limits"),
        above if above < 10.0 => format!("; the worst of the others ended {:.2} % above", 100.0 * above),
        _ => "; others ended far above".into(),
    };
    format!("  {agreeing} of {} starts agree to 1e-6{rest}", starts.len())
}

fn second_order(o: &OptimumResult) -> String {
    match &o.second_order {
        None if !matches!(o.optimum.outcome.stop, Stop::Converged | Stop::NothingFree) => {
            "  second order: not told, as the search did not converge".into()
        }
        None => "  second order: not available, other peaks or bounds take over that near".into(),
        Some(s) => match s.curvature {
            None => "  second order: the active peaks, limits and bounds leave no direction free".into(),
            Some(c) => {
                let directions = if s.free == 1 { "the free direction".to_owned() } else { format!("{} free directions", s.free) };
                let verdict = if c > ROUNDING { "a strict local minimum" } else { "NOT a strict local minimum" };
                format!("  second order: curvature at least {} along {directions}: {verdict}", significant(c, 3))
            }
        },
    }
}
