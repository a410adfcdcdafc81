//! Where each station leads: the following one, or one by name; leaves first, the root last.

use crate::drivetrain::{Joint, Station};
use crate::input::error::Check;
use crate::input::schema::engine::RawStation;

/// Largest ratio of a gear, either way.
const LARGEST_RATIO: f64 = 1e3;

/// What a file says of a link.
struct Link {
    to: usize,
    gear: Option<f64>,
    /// The mesh has no stiffness of its own: both stations are one body.
    is_rigid: bool,
}

/// Puts stations, in the order of the file, into the order of a chain; nothing where a mistake leaves none.
pub(super) fn arrange(check: &mut Check, raw: &[RawStation], derived: &[bool], stations: Vec<Station>) -> Option<Vec<Station>> {
    let before = check.mistakes.len();
    let links: Vec<Option<Link>> = (0..raw.len()).map(|i| link(check, raw, i, derived[i])).collect();
    if check.mistakes.len() > before {
        return None;
    }
    let to: Vec<Option<usize>> = links.iter().map(|l| l.as_ref().map(|l| l.to)).collect();
    one_root(check, raw, &to);
    if check.mistakes.len() > before {
        return None;
    }
    let order = leaves_first(&to);
    let mut bodies: Vec<Station> = stations;
    let mut links: Vec<Option<Link>> = links;
    merge(check, raw, &order, &mut bodies, &mut links);
    let kept: Vec<usize> = order.into_iter().filter(|i| !links[*i].as_ref().is_some_and(|l| l.is_rigid)).collect();
    let place = |i: usize| kept.iter().position(|k| *k == i);
    let placed = |(own, &i): (usize, &usize)| {
        let link = links[i].as_ref();
        let joint = link.and_then(|l| Some(Joint { leads_to: place(l.to)?, gear: l.gear.unwrap_or(1.0) }));
        // a row needs no joints
        let joint = joint.filter(|j| j.leads_to != own + 1 || j.gear != 1.0).map(Box::new);
        Station { joint, ..bodies[i].clone() }
    };
    Some(kept.iter().enumerate().map(placed).collect())
}

/// The link of a station; nothing for a root.
fn link(check: &mut Check, raw: &[RawStation], i: usize, is_derived: bool) -> Option<Link> {
    let s = &raw[i];
    let name = s.name.get_ref();
    let gear = s.gear_ratio_to_next.as_ref().map(|g| {
        let ratio = *g.get_ref();
        if !(1.0 / LARGEST_RATIO..=LARGEST_RATIO).contains(&ratio.abs()) {
            let words = format!(
                "found a gear ratio of {ratio}, expected one from 0.001 to 1000, negative where the shafts turn in opposite directions"
            );
            check.wrong(g, words);
        }
        ratio
    });
    let numbers = [&s.stiffness_to_next_n_m_per_rad, &s.damping_to_next_n_m_s_per_rad, &s.loss_factor_to_next, &s.gear_ratio_to_next];
    let first = numbers.into_iter().flatten().next();
    let has_stiffness = is_derived || s.stiffness_to_next_n_m_per_rad.is_some();
    let is_rigid = meshes_rigidly(s, is_derived);
    if let (true, Some(lost)) = (is_rigid, [&s.damping_to_next_n_m_s_per_rad, &s.loss_factor_to_next].into_iter().flatten().next()) {
        check.wrong(
            lost,
            format!(
                "found damping in the mesh of `{name}`, expected its `stiffness_to_next_n_m_per_rad` beside it: a rigid mesh has no twist"
            ),
        );
    }
    let to = match &s.next {
        Some(next) => match raw.iter().position(|other| other.name.get_ref() == next.get_ref()) {
            Some(to) if to != i => to,
            found => {
                let what = if found.is_some() { "the station itself" } else { "no station of this file" };
                check.wrong(next, format!("found `{}`, {what}, expected the name of another station", next.get_ref()));
                return None;
            }
        },
        None if i + 1 < raw.len() && (is_derived || first.is_some()) => i + 1,
        None => {
            if let (Some(number), true) = (first, i + 1 == raw.len()) {
                check.wrong(number, format!("found a link from `{name}` to the next station, expected none: it is the last"));
            } else if i + 1 < raw.len() && raw.iter().all(|s| s.next.is_none()) {
                check.wrong_with_help(
                    &s.name,
                    format!("found no `stiffness_to_next_n_m_per_rad` on `{name}`, expected one: another station follows"),
                    "0 is allowed where only a damper joins two stations",
                );
            }
            return None;
        }
    };
    if !is_rigid && !has_stiffness {
        check.wrong_with_help(
            &s.name,
            format!("found no `stiffness_to_next_n_m_per_rad` on `{name}`, expected one: it leads to another station"),
            "0 is allowed where only a damper joins two stations; with `stiffness_formula` in [crank] and `shaft_to_next` it follows from dimensions",
        );
    }
    Some(Link { to, gear, is_rigid })
}

/// Whether nothing but a gear joins a station to the next.
fn meshes_rigidly(s: &RawStation, is_derived: bool) -> bool {
    s.gear_ratio_to_next.is_some() && s.stiffness_to_next_n_m_per_rad.is_none() && !is_derived
}

/// Stations whose mesh is rigid, each with the one that it is one body with.
pub(super) fn meshed(raw: &[RawStation]) -> Vec<(String, String)> {
    // one with a stiffness by formula is a station of the chain, and found there
    let is_rigid = |s: &RawStation| meshes_rigidly(s, false);
    let next = |i: usize| match &raw[i].next {
        Some(next) => raw.iter().position(|other| other.name.get_ref() == next.get_ref()),
        None => Some(i + 1).filter(|n| *n < raw.len()),
    };
    let into = |i: usize| {
        let mut to = next(i)?;
        // a mesh may lead into another one, and a ring of them is refused elsewhere
        for _ in 0..raw.len() {
            if !is_rigid(&raw[to]) {
                break;
            }
            to = next(to)?;
        }
        Some((raw[i].name.get_ref().clone(), raw[to].name.get_ref().clone()))
    };
    (0..raw.len()).filter(|i| is_rigid(&raw[*i])).filter_map(into).collect()
}

/// Every station must have a path to one root.
fn one_root(check: &mut Check, raw: &[RawStation], to: &[Option<usize>]) {
    let roots: Vec<usize> = (0..to.len()).filter(|i| to[*i].is_none()).collect();
    let name = |i: usize| raw[i].name.get_ref();
    if let [first, second, ..] = roots.as_slice() {
        let words =
            format!("found two stations that lead nowhere, `{}` and `{}`, expected one: the root of the tree", name(*first), name(*second));
        check.wrong_with_help(&raw[*second].name, words, "`next` names the station that one leads to");
        return;
    }
    for i in 0..to.len() {
        let path: Vec<usize> = std::iter::successors(Some(i), |at| to[*at]).take(to.len() + 1).collect();
        if path.len() > to.len() {
            // the part that is walked again and again
            let again = path[to.len()];
            let round: Vec<&str> =
                std::iter::successors(to[again], |at| to[*at].filter(|_| *at != again)).map(|at| name(at).as_str()).collect();
            let words = format!(
                "found stations that lead round in a circle, `{}` to `{}`, expected a path to a root",
                name(again),
                round.join("` to `")
            );
            check.wrong(raw[again].next.as_ref().unwrap_or(&raw[again].name), words);
            return;
        }
    }
}

/// Every station before the one it leads to, otherwise as in the file.
fn leaves_first(to: &[Option<usize>]) -> Vec<usize> {
    let mut waiting: Vec<usize> = vec![0; to.len()];
    to.iter().flatten().for_each(|t| waiting[*t] += 1);
    let mut order = Vec::with_capacity(to.len());
    let mut ready: std::collections::BTreeSet<usize> = (0..to.len()).filter(|i| waiting[*i] == 0).collect();
    while let Some(i) = ready.pop_first() {
        order.push(i);
        if let Some(t) = to[i] {
            waiting[t] -= 1;
            if waiting[t] == 0 {
                ready.insert(t);
            }
        }
    }
    order
}

/// Makes one body of stations in a rigid mesh: J + g² J', and whatever led to the one leads to the other through both gears.
fn merge(check: &mut Check, raw: &[RawStation], order: &[usize], bodies: &mut [Station], links: &mut [Option<Link>]) {
    // from the root: what a station is merged into is settled before what leads to it
    for &i in order.iter().rev() {
        let Some(link) = &links[i] else { continue };
        let gear = link.gear.unwrap_or(1.0);
        if let Some((target, over)) = links[link.to].as_ref().filter(|t| t.is_rigid).map(|t| (t.to, t.gear.unwrap_or(1.0))) {
            links[i] = Some(Link { to: target, gear: Some(gear * over), is_rigid: links[i].as_ref().is_some_and(|l| l.is_rigid) });
        }
        let Some(Link { to, gear: Some(gear), is_rigid: true }) = &links[i] else { continue };
        if let Some(throw) = raw[i].throws.first() {
            check
                .wrong(throw, "found a throw on a station that meshes rigidly with the next, expected it there or a stiffness of the mesh");
        }
        let (square, own) = (gear * gear, bodies[i].clone());
        let into = &mut bodies[*to];
        into.inertia += square * own.inertia;
        into.stiffness_to_ground += square * own.stiffness_to_ground;
        into.damping_to_ground += square * own.damping_to_ground;
    }
}
