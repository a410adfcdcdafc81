//! Largest equivalent stresses of the flexible crank over the cycle beside printed ones of solid finite elements.

use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::{RunError, VonMisesAt, von_mises_on_bearings};
use crate::input::published::PublishedVonMises;
use crate::input::{Published, Study};
use crate::units::PA_PER_MPA;

/// Stiffness and damping of the main bearings as the engine has them.
const OWN: [f64; 2] = [1.0, 1.0];
/// Changes below this share say nothing of a direction.
const NO_CHANGE: f64 = 0.005;

/// One entry a printed stress; none without a flexible crank. Where bearings are others than those of the engine, the note compares what that changes.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn entries(study: &Study, published: &Published) -> Result<Vec<Entry>, RunError> {
    let mut found: Vec<(&PublishedVonMises, Option<VonMisesAt>)> = Vec::new();
    for p in &published.von_mises {
        let design = &study.designs[p.design];
        let [stiffness, damping] = p.bearings;
        let own = von_mises_on_bearings(study, &design.absorbers, (&[p.speed_rpm], stiffness, damping))
            .map_err(|error| RunError { what: design.name.clone(), error })?;
        found.push((p, own.into_iter().next()));
    }
    let as_given = |p: &PublishedVonMises| {
        let same =
            |o: &&(&PublishedVonMises, Option<VonMisesAt>)| (o.0.design, o.0.speed_rpm, o.0.bearings) == (p.design, p.speed_rpm, OWN);
        found.iter().find(same).filter(|_| p.bearings != OWN)
    };
    let entry = |(p, own): &(&PublishedVonMises, Option<VonMisesAt>)| {
        let place = match (own, p.place.as_str()) {
            (None, _) => String::new(),
            (Some(own), "") => format!("ours at {}", own.fillet),
            (Some(own), printed) => format!("printed at {printed}, ours at {}", own.fillet),
        };
        let changed = as_given(p).and_then(|(given, ours)| {
            let (printed, ours) = (p.stress / given.stress - 1.0, own.as_ref()?.stress / ours.as_ref()?.stress - 1.0);
            let same = if ours.abs() < NO_CHANGE {
                "ours hardly changes"
            } else if printed * ours > 0.0 {
                "the same direction"
            } else {
                "the other direction"
            };
            Some(format!("{:+.0} % printed, {:+.1} % ours: {same}", 100.0 * printed, 100.0 * ours))
        });
        let bearings = on_bearings(p.bearings);
        Entry {
            table: p.table.clone(),
            design: study.designs[p.design].name.clone(),
            quantity: format!("largest von Mises stress at {} rpm{bearings}", p.speed_rpm),
            kind: if p.bearings == OWN { Kind::FlexibleStress } else { Kind::OwnStress },
            unit: "MPa".into(),
            published: Some(p.stress / PA_PER_MPA),
            computed: own.as_ref().map(|own| own.stress / PA_PER_MPA),
            uncertainty: Uncertainty::default(),
            role: Role::Predicted,
            note: [Some(place), changed].into_iter().flatten().filter(|n| !n.is_empty()).collect::<Vec<_>>().join("; "),
        }
    };
    Ok(found.iter().map(entry).chain(changes(study, published)).collect())
}

/// Printed changes of the stress beside those that follow from the printed stresses.
fn changes<'a>(study: &'a Study, published: &'a Published) -> impl Iterator<Item = Entry> + 'a {
    published.von_mises.iter().filter_map(|p| {
        let given = published.von_mises.iter().find(|o| (o.design, o.speed_rpm, o.bearings) == (p.design, p.speed_rpm, OWN))?;
        let (printed, found) = (p.change_percent?, 100.0 * (p.stress / given.stress - 1.0));
        let (role, note) = if printed * found < 0.0 {
            (Role::Erratum, "from the printed stresses: the sign is wrong".to_owned())
        } else {
            (Role::Recomputed, "from the printed stresses".to_owned())
        };
        Some(Entry {
            table: p.table.clone(),
            design: study.designs[p.design].name.clone(),
            quantity: format!("change of the largest von Mises stress at {} rpm{}", p.speed_rpm, on_bearings(p.bearings)),
            kind: Kind::Other,
            unit: "%".into(),
            published: Some(printed),
            computed: Some(found),
            uncertainty: Uncertainty::default(),
            role,
            note,
        })
    })
}

/// Bearings in words; empty for those of the engine.
fn on_bearings([stiffness, damping]: [f64; 2]) -> String {
    match (stiffness == 1.0, damping == 1.0) {
        (true, true) => String::new(),
        (false, true) => format!(", bearings {stiffness} times as stiff"),
        (true, false) => format!(", bearings {damping} times as damped"),
        (false, false) => format!(", bearings {stiffness} times as stiff and {damping} times as damped"),
    }
}
