//! Given designs.

use super::{DesignSpec, station};
use crate::absorber::seeds::{EngineMode, RULES};
use crate::absorber::{Absorber, Locked, Mounted, Tuned, Undamped, Viscous};
use crate::drivetrain::{Chain, Modes};
use crate::input::error::Check;
use crate::input::schema::study::{RawAbsorber, RawEngineInertia, RawOn, RawSeeded, RawStudy, RawType};
use std::collections::HashSet;

pub fn resolve(check: &mut Check, study: &RawStudy, chain: &Chain, modes: &Modes) -> Vec<DesignSpec> {
    let mut names = HashSet::new();
    let mut designs = Vec::new();
    for raw in &study.design {
        let name = raw.name.get_ref();
        if !names.insert(name.clone()) {
            check.wrong(&raw.name, format!("found design `{name}` a second time, expected different names"));
        }
        check.name(&raw.name);
        let plain = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c)) && !name.starts_with('.');
        if !plain || name.starts_with("optimum_") {
            check.wrong_with_help(
                &raw.name,
                format!("found the name `{name}`, expected letters, digits, `_`, `-` and `.`, not starting with `optimum_`"),
                "designs name files and rows; `optimum_…` are hartog's own",
            );
        }
        let absorbers = raw.absorber.iter().filter_map(|a| absorber(check, a, chain, modes)).collect();
        designs.push(DesignSpec { name: name.clone(), absorbers });
    }
    designs
}

fn absorber(check: &mut Check, raw: &RawAbsorber, chain: &Chain, modes: &Modes) -> Option<Mounted> {
    let RawOn::Station(name) = &raw.on;
    let on = station(check, chain, name);
    let hub_inertia = raw.hub_inertia_kg_m2.as_ref().map_or(0.0, |h| check.not_negative(h));
    let absorber = match &raw.kind {
        RawType::Tuned(t) => Absorber::Tuned(Tuned {
            ring_inertia: check.positive(&t.ring_inertia_kg_m2),
            stiffness: check.not_negative(&t.stiffness_n_m_per_rad),
            damping: check.not_negative(&t.damping_n_m_s_per_rad),
        }),
        RawType::Viscous(v) => Absorber::Viscous(Viscous {
            ring_inertia: check.positive(&v.ring_inertia_kg_m2),
            damping: check.not_negative(&v.damping_n_m_s_per_rad),
        }),
        RawType::Undamped(u) => Absorber::Undamped(Undamped {
            ring_inertia: check.positive(&u.ring_inertia_kg_m2),
            stiffness: check.not_negative(&u.stiffness_n_m_per_rad),
        }),
        RawType::Locked(l) => Absorber::Locked(Locked { ring_inertia: check.not_negative(&l.ring_inertia_kg_m2) }),
        RawType::Seeded(s) => seeded(check, s, on?, chain, modes)?,
    };
    Some(Mounted { station: on?, hub_inertia, absorber })
}

/// Engine inertia at a station for the closed forms and the first elastic mode's frequency; nothing where no elastic mode moves there.
pub fn engine_mode(chain: &Chain, modes: &Modes, station: usize, whole_chain: bool) -> Option<EngineMode> {
    let mode = modes.elastic().next()?;
    let inertia = if whole_chain { chain.total_inertia() } else { modes.equivalent_inertia(mode, station) };
    (inertia.is_finite() && inertia < 1e6 * chain.total_inertia()).then_some(EngineMode { inertia, omega: modes.omega[mode] })
}

fn seeded(check: &mut Check, raw: &RawSeeded, station: usize, chain: &Chain, modes: &Modes) -> Option<Absorber> {
    let ring_inertia = check.positive(&raw.ring_inertia_kg_m2);
    let Some((_, rule)) = RULES.iter().find(|r| r.0 == raw.by.get_ref()) else {
        let known: Vec<&str> = RULES.iter().map(|r| r.0).collect();
        check.wrong(&raw.by, format!("found rule `{}`, expected one of {}", raw.by.get_ref(), known.join(", ")));
        return None;
    };
    let whole = matches!(raw.engine_inertia, RawEngineInertia::WholeChain);
    let Some(engine) = engine_mode(chain, modes, station, whole) else {
        check.wrong(&raw.by, "no elastic mode moves this station, expected one for a closed form");
        return None;
    };
    Some(rule.absorber(ring_inertia, engine))
}
