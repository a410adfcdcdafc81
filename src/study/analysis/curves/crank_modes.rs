//! Shapes of the modes of a flexible crank.

use super::crank_loads::PLACE;
use super::figure::{Axis, Curve, Figure, Panel};
use crate::input::Study;
use crate::rotor::free_modes::FreeMode;
use crate::units::{HZ_PER_RAD_PER_S, M_PER_MM};

const MOTION: Axis = Axis { column: "relative_motion", label: "relative motion" };
/// Modes that are shown.
const MODES: usize = 6;

/// The lowest elastic modes at rest on the bearings: motion of every node across and along the axis, and about it at the radius of the throws. Nothing on a torsional chain.
pub(super) fn crank_modes(study: &Study) -> Option<Figure> {
    let (flexible, crank) = (study.on_flexible()?, study.crank.as_ref()?);
    let shaft = &flexible.assembled.shaft;
    let places = &shaft.places;
    let panel = |(i, m): (usize, &FreeMode)| {
        let motion = |k: usize, factor: f64| m.shape.iter().take(places.len()).map(move |x| x[k] * factor);
        let rows = [
            ("along the middle of the banks", 0, 1.0),
            ("across it", 1, 1.0),
            ("along the axis", 2, 1.0),
            ("rotation times crank radius", 5, crank.crank_radius),
        ];
        let largest = rows.iter().flat_map(|(_, k, factor)| motion(*k, *factor)).fold(0.0, |m: f64, x| m.max(x.abs()));
        let curve = |(label, k, factor): (&str, usize, f64)| Curve {
            label: label.into(),
            order: None,
            // nodes of matrices tell some of their motions only
            points: (0..places.len())
                .zip(motion(k, factor))
                .filter(|(node, _)| shaft.moves(*node, k))
                .map(|(node, x)| (places[node].z / M_PER_MM, x / largest))
                .collect(),
        };
        Panel {
            title: format!("mode {}: {:.1} Hz, {}", i + 1, m.omega * HZ_PER_RAD_PER_S, m.kind()),
            x: PLACE,
            y: MOTION,
            curves: rows.into_iter().map(curve).collect(),
            y_top: None,
        }
    };
    let elastic = flexible.modes()?.iter().filter(|m| m.omega > 0.0).take(MODES);
    Some(Figure {
        name: "crank_modes".into(),
        title: format!("{}: modes of the flexible crank on its bearings, at rest at angle 0°", study.engine.name),
        panels: elastic.enumerate().map(panel).collect(),
    })
}
