//! From what a study wants optimised to families of absorbers, with their starts.

use crate::absorber::Kind;
use crate::absorber::seeds::EngineMode;
use crate::input::{AbsorberSpec, Size, Study};
use crate::optimise::{Parameter, Space, Variable, starts};
use crate::units::HZ_PER_RAD_PER_S;

/// Modes an absorber of this study can be tuned to: elastic, moving its station, within reach of the torque (at least the first).
pub fn engine_modes(study: &Study, spec: &AbsorberSpec, highest_hz: f64) -> Vec<EngineMode> {
    let total = study.chain.total_inertia();
    study
        .modes
        .elastic()
        .map(|m| EngineMode {
            inertia: if spec.whole_chain { total } else { study.modes.equivalent_inertia(m, spec.station) },
            omega: study.modes.omega[m],
        })
        .filter(|m| m.inertia < 1e4 * total)
        .enumerate()
        .filter(|(i, m)| *i == 0 || m.omega * HZ_PER_RAD_PER_S <= highest_hz)
        .map(|(_, m)| m)
        .take(starts::MOST_MODES)
        .collect()
}

/// The family of one type. `ring_inertia`: held where given, free between the bounds of the study otherwise.
pub fn family(spec: &AbsorberSpec, kind: Kind, ring_inertia: Option<f64>, modes: &[EngineMode]) -> Space {
    let size = match (ring_inertia, &spec.size) {
        (Some(j), _) => (j, j),
        (None, Size::Between(a, b)) => (*a, *b),
        (None, Size::Each(list)) => (list[0], list[0]),
    };
    let (wide_stiffness, wide_damping) = starts::wide_bounds(size.1, modes);
    let stiffness = spec.stiffness.unwrap_or(wide_stiffness);
    let damping = spec.damping.unwrap_or(wide_damping);
    let ranges = [
        (Parameter::RingInertia, size, true),
        (Parameter::Stiffness, stiffness, matches!(kind, Kind::Tuned | Kind::Undamped)),
        (Parameter::Damping, damping, matches!(kind, Kind::Tuned | Kind::Viscous)),
    ];
    let omega = modes.first().map_or(1.0, |m| m.omega);
    let typical = [size.1, size.1 * omega * omega, size.1 * omega];
    let mut fixed = [0.0; 3];
    let mut variables = Vec::new();
    for (parameter, (lower, upper), has) in ranges {
        if lower < upper && has {
            // a thousandth of the typical value: what lies below acts like zero
            variables.push(Variable { parameter, lower, upper, scale: 1e-3 * typical[parameter as usize] });
        } else {
            fixed[parameter as usize] = if has { lower } else { 0.0 };
        }
    }
    Space { kind, station: spec.station, hub_inertia: spec.hub_inertia, fixed, variables }
}

/// The optima a study asks for: name and family of each.
pub fn wanted(spec: &AbsorberSpec, modes: &[EngineMode]) -> Vec<(String, Space)> {
    let mut list = Vec::new();
    for &kind in &spec.kinds {
        let name = format!("optimum_{}", kind.name());
        match &spec.size {
            Size::Between(..) => list.push((name, family(spec, kind, None, modes))),
            Size::Each(inertias) => {
                for (i, &j) in inertias.iter().enumerate() {
                    let alike = inertias.iter().filter(|other| shown(**other) == shown(j)).count() > 1;
                    let size = if alike { j.to_string() } else { shown(j) };
                    let name = if i == 0 { name.clone() } else { format!("{name}_{size}") };
                    list.push((name, family(spec, kind, Some(j), modes)));
                }
            }
        }
    }
    list
}

/// An inertia in a name: six digits are enough to tell sizes apart.
fn shown(j: f64) -> String {
    let digits = (5 - j.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{j:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
