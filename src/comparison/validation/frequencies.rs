//! Natural frequencies of the chain: our own, and those that other models gave for the same engine.

use super::{Entry, Kind, Role, Uncertainty};
use crate::input::published::PublishedFrequency;
use crate::input::{Published, Study};

/// A value of the chain we were given is off by no more than this; a source is held to have used that chain where half of its values are. A
/// value of such a source further off contradicts it,
const CONTRADICTS: f64 = 0.005;
/// where the same mode is printed elsewhere to this share of ours.
const AGREES: f64 = 0.002;

pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let own = study.modes.frequencies_hz();
    let computed = |f: &PublishedFrequency| own.get(f.mode - 1).copied();
    let off = |f: &PublishedFrequency| computed(f).map_or(f64::INFINITY, |own| (f.frequency_hz / own - 1.0).abs());
    let same_chain = |source: &str| {
        // without a source it is a measurement or a computation of this very engine
        if source.is_empty() {
            return true;
        }
        let own: Vec<f64> = published.frequencies.iter().filter(|f| f.source == source).map(off).collect();
        2 * own.iter().filter(|o| **o <= CONTRADICTS).count() >= own.len()
    };
    // the same mode of the chain alone, printed in another table
    let elsewhere = |f: &PublishedFrequency| {
        let alone = published.absorbers.iter().filter(|a| a.ring_inertia.is_none() && a.table != f.table);
        alone.filter_map(|a| a.frequencies_hz.get(f.mode - 1).copied().flatten().map(|hz| (a.table.clone(), hz))).next()
    };
    let entry = |f: &PublishedFrequency| {
        let same = same_chain(&f.source);
        let contradicted =
            elsewhere(f).filter(|(_, hz)| same && off(f) > CONTRADICTS && computed(f).is_some_and(|own| (hz / own - 1.0).abs() < AGREES));
        let (role, note) = match (&contradicted, computed(f)) {
            (Some((table, hz)), Some(own)) => {
                (Role::Erratum, format!("table {table} prints {hz} Hz for this mode, and the chain gives {own:.2} Hz"))
            }
            _ if same => (Role::Predicted, "the chain as given".into()),
            _ => (Role::OtherModel, "another model of the engine".into()),
        };
        Entry {
            table: f.table.clone(),
            design: String::new(),
            quantity: format!("{} f{}", f.source, f.mode).trim().to_owned(),
            kind: if same { Kind::Frequency } else { Kind::OtherModel },
            unit: "Hz".into(),
            published: Some(f.frequency_hz),
            computed: computed(f),
            uncertainty: Uncertainty::default(),
            role,
            note,
        }
    };
    published.frequencies.iter().map(entry).collect()
}
