//! Closed-form optima of an absorber on an undamped mass over the inertia ratio.

use super::figure::{Axis, Curve, Figure, Panel, curve};
use crate::absorber::closed_forms::{brock_unity, den_hartog_brock, h_infinity, viscous_untuned};
use crate::numerics::elementary::Elementary;

const RATIO: Axis = Axis { column: "inertia_ratio", label: "inertia ratio" };
const TUNING: Axis = Axis { column: "tuning", label: "tuning, absorber over engine" };
const DAMPING: Axis = Axis { column: "damping_ratio", label: "c/(2 J omega of engine)" };
const PEAK: Axis = Axis { column: "peak", label: "peak / static deflections" };
/// Points of a curve, and its ends.
const POINTS: usize = 200;
const RATIOS: (f64, f64) = (0.01, 1.0);

/// Tuning, damping and peak \[Villalva 2014\] chapter 6; the peaks are those at the fixed points, sqrt(1 + 2/mu) tuned by Den Hartog, 1 + 2/mu for a viscous one.
pub(super) fn absorber_chart() -> Figure {
    let ratio = |i: usize| RATIOS.0 * (RATIOS.1 / RATIOS.0).power(i as f64 / (POINTS - 1) as f64);
    let line = |label: &str, f: &dyn Fn(f64) -> f64| -> Curve { curve(label, (0..POINTS).map(ratio), (0..POINTS).map(|i| f(ratio(i)))) };
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel { title: title.into(), x: RATIO, y, curves, y_top: None };
    Figure {
        name: "absorber_chart".into(),
        title: "Optimal absorbers on an undamped mass".into(),
        panels: vec![
            panel(
                "tuning",
                TUNING,
                vec![line("unity", &|_| 1.0), line("Den Hartog", &|mu| 1.0 / (1.0 + mu)), line("exact optimum", &|mu| h_infinity(mu).0)],
            ),
            panel(
                "damping",
                DAMPING,
                vec![
                    line("unity, Brock", &brock_unity),
                    line("Den Hartog and Brock", &den_hartog_brock),
                    line("exact optimum", &|mu| h_infinity(mu).1),
                    line("viscous", &viscous_untuned),
                ],
            ),
            panel("peak", PEAK, vec![line("Den Hartog", &|mu| (1.0 + 2.0 / mu).sqrt()), line("viscous", &|mu| 1.0 + 2.0 / mu)]),
        ],
    }
}
