//! Shapes of the modes of a flexible crank.

use super::crank_loads::PLACE;
use super::figure::{Axis, Curve, Figure, Look, Panel, Scale};
use crate::crankshaft::Crank;
use crate::input::{FlexibleModel, Study};
use crate::rotor::free_modes::FreeMode;
use crate::units::{HZ_PER_RAD_PER_S, M_PER_MM};

const MOTION: Axis = Axis { column: "relative_motion", label: "relative motion" };
/// Modes that are shown.
const MODES: usize = 6;

/// A mode: motion of every node across and along the axis, and about it at the radius of the throws.
fn panel((flexible, crank): (&FlexibleModel, &Crank), (i, mode): (usize, &FreeMode)) -> Panel {
    let shaft = &flexible.assembled.shaft;
    let places = &shaft.places;
    let motion = |k: usize, factor: f64| mode.shape.iter().take(places.len()).map(move |x| x[k] * factor);
    let rows = [
        ("along the middle of the banks", 0, 1.0),
        ("across it", 1, 1.0),
        ("along the axis", 2, 1.0),
        ("rotation times crank radius", 5, crank.crank_radius),
    ];
    let largest = rows.iter().flat_map(|(_, k, factor)| motion(*k, *factor)).fold(0.0, |m: f64, x| m.max(x.abs()));
    let curve = |(label, k, factor): (&str, usize, f64)| Curve {
        label: label.into(),
        look: Look::Line,
        // nodes of matrices tell some of their motions only
        points: (0..places.len())
            .zip(motion(k, factor))
            .filter(|(node, _)| shaft.moves(*node, k))
            .map(|(node, x)| (places[node].z / M_PER_MM, x / largest))
            .collect(),
    };
    Panel {
        title: format!("mode {}: {:.1} Hz, {}", i + 1, mode.omega * HZ_PER_RAD_PER_S, mode.kind()),
        x: PLACE,
        y: MOTION,
        curves: rows.into_iter().map(curve).collect(),
        scale: Scale::Own,
    }
}

/// The lowest elastic modes at rest on the bearings, and those of the bare crank free of them, without hub and flywheel, where it is made of beams. Nothing on a torsional chain.
pub(super) fn crank_modes(study: &Study) -> Vec<Figure> {
    let Some((flexible, crank)) = study.on_flexible().zip(study.crank.as_ref()) else { return Vec::new() };
    let figure = |name: &str, of: &str, modes: &[FreeMode]| Figure {
        name: name.into(),
        title: format!("{}: modes of the {of}, at rest at angle 0°", study.engine.name),
        panels: modes.iter().filter(|m| m.omega > 0.0).take(MODES).enumerate().map(|mode| panel((flexible, crank), mode)).collect(),
    };
    let borne = flexible.modes().map(|modes| figure("crank_modes", "flexible crank on its bearings", modes));
    let free = flexible.free_modes((crank, &study.engine, &study.chain), false);
    let bare = free.map(|modes| figure("crank_modes_free", "bare crank, free at both ends", &modes));
    borne.into_iter().chain(bare).collect()
}
