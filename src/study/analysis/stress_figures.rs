//! The stress of one point over the cycle, and the factors of a few points beside each other.

use super::curves::{Axis, Curve, Figure, Look, Panel, Scale, curve};
use super::stress_histories::Summary;
use crate::fatigue::multiaxial::Criterion;
use crate::fatigue::multiaxial::invariants::{Pair, largest_pair, sqrt_j2};
use crate::fatigue::multiaxial::plane::resolved;
use crate::numerics::elementary::Elementary;
use crate::units::PA_PER_MPA;
use std::f64::consts::TAU;

const CYCLE: Axis = Axis { column: "cycle_percent", label: "part of the cycle / %" };
const STRESS: Axis = Axis { column: "stress_mpa", label: "stress / MPa" };
const ALONG: Axis = Axis { column: "deviator_mpa", label: "first dimension / MPa" };
const ACROSS: Axis = Axis { column: "deviator_other_mpa", label: "second dimension / MPa" };
const POINT: Axis = Axis { column: "point", label: "number of the point in the table" };
const FACTOR: Axis = Axis { column: "safety_factor", label: "safety factor" };

/// A circle of stresses, Pa, as a thin line in MPa.
#[doc(hidden)]
pub fn circle(label: &str, centre: [f64; 2], radius: f64) -> Curve {
    let round = (0..=180).map(|i| {
        let (sine, cosine) = (TAU * f64::from(i) / 180.0).sine_cosine();
        ((centre[0] + radius * cosine) / PA_PER_MPA, (centre[1] + radius * sine) / PA_PER_MPA)
    });
    Curve { label: label.into(), look: Look::Thin, points: round.collect() }
}

/// Equivalent stress of von Mises, hydrostatic stress and normal stress on the plane of the largest shear over the cycle, and the path of the deviator in the two of its five dimensions with the largest circle, of the
/// point shown. `None` without a point.
#[doc(hidden)]
pub fn of_point(summary: &Summary) -> Option<Figure> {
    let (point, result) = summary.critical.as_ref()?;
    let (history, n) = (&point.history, point.history.len());
    // the first sample once more where the cycle ends
    let percent = || (0..=n).map(|j| 100.0 * j as f64 / n as f64);
    let mpa = |values: Vec<f64>| values.clone().into_iter().chain(values.into_iter().take(1)).map(|s| s / PA_PER_MPA);
    let von_mises: Vec<f64> = sqrt_j2(history).into_iter().map(|s| 3f64.sqrt() * s).collect();
    let mut over = vec![curve("von Mises", percent(), mpa(von_mises)), curve("hydrostatic", percent(), mpa(history.hydrostatic()))];
    let plane = result.verdicts.iter().find(|v| v.criterion == Criterion::MATAKE).and_then(|v| v.plane);
    if let Some(plane) = plane {
        let normal = plane.normal();
        over.push(curve("normal to the plane of the largest shear", percent(), mpa(history.along(&resolved(&normal, &normal)))));
    }
    let Pair { dimensions: [a, b], path: [x, y], centre, radius } = largest_pair(history);
    let path = curve(format!("S{} and S{}", a + 1, b + 1), mpa(x), mpa(y));
    let panel = |title: &str, (x, y), curves: Vec<Curve>, scale: Scale| Panel { title: title.into(), x, y, curves, scale };
    Some(Figure {
        name: "fatigue_history".into(),
        title: format!("stress of point {}", point.name),
        panels: vec![
            panel("over the cycle", (CYCLE, STRESS), over, Scale::Own),
            panel(
                "deviator, pair of dimensions with the largest circle",
                (ALONG, ACROSS),
                vec![path, circle("its smallest circle", centre, radius)],
                Scale::Equal,
            ),
        ],
    })
}

/// Factors of all points by every criterion; `None` of one point or of many.
#[doc(hidden)]
pub fn of_points(summary: &Summary) -> Option<Figure> {
    let first = summary.few.first().filter(|_| summary.few.len() > 1)?;
    let line = |i: usize| {
        let numbered = summary.few.iter().enumerate().map(|(n, p)| ((n + 1) as f64, p.verdicts[i].safety_factor));
        let points = numbered.filter(|p| p.1.is_finite()).collect();
        Curve { label: first.verdicts[i].criterion.name().replace('_', " "), look: Look::Line, points }
    };
    let curves = (0..first.verdicts.len()).map(line).collect();
    Some(Figure {
        name: "fatigue_points".into(),
        title: "safety factors of all points".into(),
        panels: vec![Panel { title: "by every criterion".into(), x: POINT, y: FACTOR, curves, scale: Scale::Own }],
    })
}
