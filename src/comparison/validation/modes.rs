//! Natural frequencies of the crank by itself, free at both ends: the flexible crank beside printed finite elements and measurements.

use super::{Entry, Kind, Role, Uncertainty};
use crate::input::{Published, Study};
use crate::rotor::free_modes::FreeMode;
use crate::units::HZ_PER_RAD_PER_S;

/// One entry a printed mode; none without a flexible crank.
pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let (Some(flexible), Some(crank), false) = (&study.flexible, &study.crank, published.modes.is_empty()) else { return Vec::new() };
    let free = |attached| flexible.free_modes((crank, &study.engine, &study.chain), attached).unwrap_or_default();
    let (attached, bare) = (free(true), free(false));
    let entry = |p: &crate::input::published::PublishedMode| {
        let own: Option<&FreeMode> = if p.attached { &attached } else { &bare }.get(p.mode - 1);
        let kind = own.map_or("", |m| m.kind());
        let note = match p.kind.as_str() {
            "" => format!("ours is of {kind}"),
            printed if printed == kind => format!("both of {kind}"),
            printed => format!("printed as {printed}, ours is of {kind}"),
        };
        Entry {
            table: p.table.clone(),
            design: String::new(),
            quantity: format!("{} {} crank, free mode {}", p.source, if p.attached { "whole" } else { "bare" }, p.mode).trim().to_owned(),
            kind: Kind::CrankMode,
            unit: "Hz".into(),
            published: Some(p.frequency_hz),
            computed: own.map(|m| m.omega * HZ_PER_RAD_PER_S),
            uncertainty: Uncertainty::default(),
            role: Role::Predicted,
            note,
        }
    };
    published.modes.iter().map(entry).collect()
}
