//! Free forces and moments of the moving masses on the engine.

use super::cylinder::{STRIDE, cylinder_of, degrees};
use super::figure::{CRANK_DEG, FORCE, Figure, MOMENT, Panel, Scale, curve};
use crate::engine::cycle::{axes, pin_angles};
use crate::engine::pressure::{sample_angle, samples};
use crate::input::Study;
use crate::numerics::elementary::Elementary;
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// Below this share of what one cylinder makes, a sum is rounding.
const ROUNDING: f64 = 1e-9;

/// Forces along the middle of the banks and across it, and their moments about the middle of the crank where its lengths are known, at a speed: what oscillates
/// with its acceleration, what rotates (rods, pins and webs less the counterweights) with the throw. Nothing where the torque comes from a table.
pub(super) fn balance(study: &Study, speed_rpm: f64) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let omega2 = (speed_rpm * RAD_PER_S_PER_RPM).powi(2);
    let layout = &study.engine.layout;
    let pins = pin_angles(&study.engine);
    let unbalance = study.crank.as_ref().map_or(0.0, |c| c.unbalance) / layout.rods_per_throw as f64;
    let rotating = geometry.rod_rotating_fraction() * geometry.rod_mass * geometry.slider_crank.crank_radius + unbalance;
    // (cylinder's axis, firing, pin, place along the crank from its middle)
    let middle = study.crank.as_ref().map(|c| 0.5 * c.bearings()[c.throws()]);
    let units: Vec<[f64; 4]> = (0..layout.throws())
        .flat_map(|t| {
            let places = study.crank.as_ref().map(|c| c.rod_places(t));
            let offset = move |i: usize| places.as_ref().zip(middle).map_or(0.0, |(p, m)| p[i] - m);
            let axes = axes(&study.engine, t);
            let pin = pins[t];
            let firing: Vec<f64> = layout.firing_on_throw(t).to_vec();
            (0..firing.len()).map(move |i| [axes[i], firing[i] * RAD_PER_DEG, pin, offset(i)]).collect::<Vec<_>>()
        })
        .collect();
    let n = samples(study.engine.strokes) / STRIDE;
    let mut sums = vec![[0.0; 4]; n];
    for (j, sum) in sums.iter_mut().enumerate() {
        let theta = sample_angle(j * STRIDE);
        for [axis, firing, pin, place] in &units {
            let oscillating = geometry.oscillating_mass() * geometry.slider_crank.motion(theta - firing).curvature * omega2;
            let (turned, outward) = (theta + pin, rotating * omega2);
            let x = oscillating * axis.cosine() + outward * turned.cosine();
            let y = oscillating * axis.sine() + outward * turned.sine();
            for (s, v) in sum.iter_mut().zip([x, y, x * place, y * place]) {
                *s += v;
            }
        }
    }
    // what cancels leaves rounding: of a force of one cylinder, or of its moment about the end
    let one = (geometry.oscillating_mass() * geometry.slider_crank.crank_radius + rotating.abs()) * omega2;
    let arm = units.iter().map(|u| u[3].abs()).fold(0.0, f64::max);
    let snapped = |v: f64, size: f64| if v.abs() < ROUNDING * size { 0.0 } else { v };
    let size = |i: usize| if i < 2 { one } else { one * arm };
    let line = |label: &str, i: usize| curve(label, degrees(n), sums.iter().map(move |s| snapped(s[i], size(i))));
    let mut panels = vec![Panel {
        title: "free force".into(),
        x: CRANK_DEG,
        y: FORCE,
        curves: vec![line("along the middle of the banks", 0), line("across it", 1)],
        scale: Scale::Own,
    }];
    if middle.is_some() {
        let curves = vec![line("in the plane of the middle of the banks", 2), line("across it", 3)];
        panels.push(Panel {
            title: "free moment about the middle of the crank".into(),
            x: CRANK_DEG,
            y: MOMENT,
            curves,
            scale: Scale::Own,
        });
    }
    Some(Figure { name: "balance".into(), title: format!("{}: balance at {speed_rpm} rpm", study.engine.name), panels })
}
