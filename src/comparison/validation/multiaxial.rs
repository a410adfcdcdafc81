//! Multiaxial safety factors of \[Minucci 2010\] from the stresses that he prints for four points, with the limits of the study.
//!
//! Sines, Crossland and Kakuno-Kawada follow. Where a plane's stresses are printed, Dang Van's factor must lie between two bounds: shear meets the largest hydrostatic stress,
//! or the smallest. No amplitude of sqrt(J2) is below the shear amplitude of a plane: his is, because he takes the largest of ten circles in two dimensions each, which may be down to
//! sqrt(2/5) of the ball.

use super::{Entry, Kind, Role, Uncertainty};
use crate::fatigue::multiaxial::{Criterion, Limits};
use crate::input::published::{PublishedHistory, PublishedMultiaxial, PublishedPoint, SIX_CRITERIA};
use crate::input::{Published, Study};
use crate::units::PA_PER_MPA;

/// Places in the rows of factors.
const SINES: usize = 3;
const KAKUNO_KAWADA: usize = 5;
/// Printed with one digit: half of it, and a little for the stresses' own digits.
const DIGITS: f64 = 0.06;
/// Least share of the ball that the largest circle of two dimensions may have.
const LEAST_SHARE: f64 = 0.632_455_532;

pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let Some(limits) = study.fatigue.as_ref().and_then(|f| f.limits) else { return Vec::new() };
    let mut list = Vec::new();
    for row in &published.multiaxial {
        let history = published.histories.iter().find(|h| h.at.is_same(&row.at));
        for (which, printed) in row.factors.iter().enumerate() {
            let found = history.and_then(|h| from_stresses(which, *printed, h, &limits)).unwrap_or_else(|| without_stresses(which, row));
            list.push(entry(&row.at, format!("{} safety factor", SIX_CRITERIA[which].replace('_', " ")), "-", *printed, found));
        }
    }
    list.extend(published.histories.iter().filter_map(shadow));
    list.extend(alike(published));
    list
}

/// How many printed factors by Kakuno-Kawada are those by Sines, of all printed.
fn alike(published: &Published) -> Option<Entry> {
    let all = published.multiaxial.len();
    let same = published.multiaxial.iter().filter(|m| m.factors[SINES] == m.factors[KAKUNO_KAWADA]).count();
    (all > 0).then(|| Entry {
        table: "all".into(),
        design: String::new(),
        quantity: "points where the factor by Kakuno-Kawada is that by Sines".into(),
        kind: Kind::Other,
        unit: "-".into(),
        published: None,
        computed: Some(same as f64),
        uncertainty: Uncertainty::default(),
        role: Role::Recomputed,
        note: format!("of {all} points; at the other {} the two are a digit apart", all - same),
    })
}

/// What is computed, its kind and role, and what a reader should know.
type Told = (Option<f64>, Kind, Role, String);

fn entry(at: &PublishedPoint, quantity: String, unit: &str, printed: f64, (computed, kind, role, note): Told) -> Entry {
    let speed = if at.speed.is_empty() { String::new() } else { format!(" at {} rpm", at.speed) };
    Entry {
        table: at.table.clone(),
        design: format!("{} {}{speed}", at.crank, at.point),
        quantity,
        kind,
        unit: unit.into(),
        published: Some(printed),
        computed,
        uncertainty: Uncertainty::default(),
        role,
        note,
    }
}

/// A factor from the stresses printed for its point; nothing where those that it needs are not.
fn from_stresses(which: usize, printed: f64, h: &PublishedHistory, l: &Limits) -> Option<Told> {
    let weight = |c: Criterion| c.weight(l).ok();
    let (j2, amplitude, mean) = (h.sqrt_j2_amplitude, h.hydrostatic_amplitude, h.hydrostatic_mean);
    let stress = match which {
        0 => h.shear_amplitude? + weight(Criterion::MATAKE)? * h.normal_max?,
        1 => h.shear_amplitude? + weight(Criterion::MCDIARMID)? * h.normal_max?,
        2 => return dang_van(printed, h, l),
        3 => j2 + weight(Criterion::SINES)? * mean,
        4 => j2 + weight(Criterion::CROSSLAND)? * (amplitude + mean),
        _ => j2 + weight(Criterion::KAKUNO_KAWADA)? * amplitude + weight(Criterion::SINES)? * mean,
    };
    if stress <= 0.0 {
        return Some((None, Kind::Multiaxial, Role::Unexplained, "from the printed stresses it never fails".into()));
    }
    let own = l.torsion / stress;
    if (own - printed).abs() <= DIGITS {
        return Some((Some(own), Kind::Multiaxial, Role::Recomputed, "from the printed stresses".into()));
    }
    let needed = printed * stress / PA_PER_MPA;
    let from = if which < 2 { "at the printed plane" } else { "from the printed stresses" };
    let stated = l.torsion / PA_PER_MPA;
    let note = format!("{from}; a torsion limit of {needed:.0} MPa would give the printed factor, the stated one is {stated:.0} MPa");
    Some((Some(own), Kind::Multiaxial, Role::Unexplained, note))
}

/// Dang Van's factor beside its bounds; the nearer bound where it lies outside.
fn dang_van(printed: f64, h: &PublishedHistory, l: &Limits) -> Option<Told> {
    let (shear, k) = (h.shear_amplitude?, Criterion::DANG_VAN_PLANE.weight(l).ok()?);
    let factor_at = |p: f64| if shear + k * p > 0.0 { l.torsion / (shear + k * p) } else { f64::INFINITY };
    let least = factor_at(h.hydrostatic_mean + h.hydrostatic_amplitude);
    let most = factor_at(h.hydrostatic_mean - h.hydrostatic_amplitude);
    let bounds = format!(
        "between {least:.2}, if shear met the largest hydrostatic stress (the thesis's form), and {most:.2}, if it met the smallest"
    );
    if least == f64::INFINITY {
        return None;
    }
    Some(if printed > most + DIGITS {
        (Some(most), Kind::Multiaxial, Role::Erratum, format!("impossible: {bounds}"))
    } else if printed < least - DIGITS {
        (Some(least), Kind::Multiaxial, Role::Erratum, format!("impossible: {bounds}"))
    } else {
        // what shear meets when is not printed: the bound is not a prediction
        (Some(least), Kind::MultiaxialAlone, Role::Given, bounds)
    })
}

/// What can be said of a factor where no stress is printed.
fn without_stresses(which: usize, row: &PublishedMultiaxial) -> Told {
    if which == KAKUNO_KAWADA {
        let note = "the printed factor by Sines: the hydrostatic amplitude has a weight near zero here".into();
        return (Some(row.factors[SINES]), Kind::MultiaxialAlone, Role::Recomputed, note);
    }
    (None, Kind::MultiaxialAlone, Role::Given, "the stresses behind it are not printed".into())
}

/// The printed amplitude of sqrt(J2) beside the least that it can be.
fn shadow(h: &PublishedHistory) -> Option<Entry> {
    let shear = h.shear_amplitude.filter(|s| *s > h.sqrt_j2_amplitude)?;
    let share = h.sqrt_j2_amplitude / shear;
    let explained = if share >= LEAST_SHARE { "explained by" } else { "not even explained by" };
    let note = format!(
        "at least the shear amplitude of a plane, whose circle is a shadow of the ball; {explained} the largest of ten circles in two dimensions, which may be down to \
         {LEAST_SHARE:.3} of the ball (`hartog fatigue --deviator pairs`)"
    );
    let found = (Some(shear / PA_PER_MPA), Kind::Multiaxial, Role::Erratum, note);
    Some(entry(&h.at, "amplitude of sqrt(J2), at least".into(), "MPa", h.sqrt_j2_amplitude / PA_PER_MPA, found))
}
