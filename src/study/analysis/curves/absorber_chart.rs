//! Closed-form optima of an absorber on an undamped mass over the inertia ratio, and its response for several dampings.

use super::figure::{Axis, Curve, Figure, Look, Panel, Scale, curve};
use crate::absorber::closed_forms::{brock_unity, den_hartog_brock, h_infinity, viscous_untuned};
use crate::absorber::fixed_points::{Point, amplification, amplitude, frequency2};
use crate::numerics::elementary::Elementary;
use crate::numerics::maximise::maximise;

const RATIO: Axis = Axis { column: "inertia_ratio", label: "inertia ratio" };
const TUNING: Axis = Axis { column: "tuning", label: "tuning, absorber over engine" };
const DAMPING: Axis = Axis { column: "damping_ratio", label: "c/(2 J omega), J of ring, omega of engine" };
const PEAK: Axis = Axis { column: "peak", label: "height / static deflection of the engine" };
const AMPLITUDE: Axis = Axis { column: "amplitude_ratio", label: "amplitude / static deflection" };
const FREQUENCY: Axis = Axis { column: "frequency_ratio", label: "frequency / that of the engine" };
/// Points of a curve, and its ends.
const POINTS: usize = 200;
const RATIOS: (f64, f64) = (0.01, 1.0);
/// Of the response: inertia ratio, frequencies, and dampings c/(2 J omega) beside none and a locked ring.
const SHOWN: f64 = 0.25;
const FREQUENCIES: (f64, f64) = (0.4, 1.6);
const DAMPINGS: [f64; 3] = [0.1, 0.3, 1.0];
/// Frequencies over which a peak is looked for.
const FINE: usize = 400;
/// The picture ends here: an undamped resonance is infinite.
const TALLEST: f64 = 20.0;

/// Amplitude of the engine over frequency at one inertia ratio: without damping, with some, and with the ring locked; all pass the fixed points.
fn response() -> Panel {
    let tuning = 1.0 / (1.0 + SHOWN);
    let frequency = |i: usize| FREQUENCIES.0 + (FREQUENCIES.1 - FREQUENCIES.0) * i as f64 / (POINTS - 1) as f64;
    let line = |label: String, damping: f64| {
        let points = (0..POINTS).map(frequency).map(|f| (f, amplitude(SHOWN, tuning, damping, f * f)));
        Curve { label, look: Look::Line, points: points.collect() }
    };
    let fixed = [Point::I, Point::II].map(|p| (frequency2(SHOWN, tuning, p).sqrt(), amplification(SHOWN, tuning, p)));
    let mut curves = vec![line("no damping".into(), 0.0)];
    curves.extend(DAMPINGS.map(|d| line(format!("damping ratio {d}"), d)));
    curves.push(line("ring locked".into(), f64::INFINITY));
    curves.push(Curve { label: "fixed points".into(), look: Look::Points, points: fixed.to_vec() });
    let title = format!("response of the engine, inertia ratio {SHOWN}, tuning by Den Hartog, cut at {TALLEST}");
    Panel { title, x: FREQUENCY, y: AMPLITUDE, curves, scale: Scale::CutAt(TALLEST) }
}

/// Tuning, damping, peak and frequencies \[Villalva 2014\] chapter 6; the peaks are those at the fixed points, sqrt(1 + 2/mu) tuned by Den Hartog, 1 + 2/mu for a viscous one, and that of the exact optimum.
pub(super) fn absorber_chart() -> Figure {
    let ratio = |i: usize| RATIOS.0 * (RATIOS.1 / RATIOS.0).power(i as f64 / (POINTS - 1) as f64);
    let line = |label: &str, f: &dyn Fn(f64) -> f64| -> Curve { curve(label, (0..POINTS).map(ratio), (0..POINTS).map(|i| f(ratio(i)))) };
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel { title: title.into(), x: RATIO, y, curves, scale: Scale::Own };
    let at = |tuning: fn(f64) -> f64, point: Point| move |mu: f64| frequency2(mu, tuning(mu), point).sqrt();
    Figure {
        name: "absorber_chart".into(),
        title: "Optimal absorbers on an undamped mass".into(),
        panels: vec![
            panel(
                "tuning",
                TUNING,
                vec![line("unity", &|_| 1.0), line("Den Hartog", &den_hartog_tuning), line("exact optimum", &|mu| h_infinity(mu).0)],
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
            panel(
                "peak of the exact optimum, height of the fixed points of the others",
                PEAK,
                vec![
                    line("Den Hartog, both fixed points", &|mu| (1.0 + 2.0 / mu).sqrt()),
                    line("unity, lower fixed point", &|mu| amplification(mu, 1.0, Point::I)),
                    line("unity, upper fixed point", &|mu| amplification(mu, 1.0, Point::II)),
                    line("exact optimum", &exact_peak),
                ],
            ),
            panel("height of the fixed point, viscous", PEAK, vec![line("viscous", &|mu| 1.0 + 2.0 / mu)]),
            panel(
                "frequencies of the fixed points",
                FREQUENCY,
                vec![
                    line("unity, lower", &at(|_| 1.0, Point::I)),
                    line("unity, upper", &at(|_| 1.0, Point::II)),
                    line("Den Hartog, lower", &at(den_hartog_tuning, Point::I)),
                    line("Den Hartog, upper", &at(den_hartog_tuning, Point::II)),
                    line("viscous", &|mu| (2.0 / (2.0 + mu)).sqrt()),
                ],
            ),
            response(),
        ],
    }
}

fn den_hartog_tuning(mu: f64) -> f64 {
    1.0 / (1.0 + mu)
}

/// Peak of the exact optimum: its two peaks are level, the larger is found over frequency.
fn exact_peak(mu: f64) -> f64 {
    let (tuning, damping) = h_infinity(mu);
    let at = |f: f64| amplitude(mu, tuning, damping, f * f);
    let (low, high) = ((1.0 - mu.sqrt()).max(0.2), 1.0 + mu.sqrt());
    let frequency = |i: usize| low + (high - low) * i as f64 / FINE as f64;
    let best = (0..=FINE).fold(0, |m, i| if at(frequency(i)) > at(frequency(m)) { i } else { m });
    let found = maximise(frequency(best.max(1) - 1), frequency((best + 1).min(FINE)), |f| Ok::<f64, std::convert::Infallible>(at(f)));
    let Ok((_, peak)) = found;
    peak
}
