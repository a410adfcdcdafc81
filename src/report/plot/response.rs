//! Response over speed: one design with its main orders, and all designs together.

use super::canvas::{self, Drawn, Stroke, WIDTH, captioned, line, px, text};
use super::legend::{self, Entry};
use crate::analysis::Results;
use crate::analysis::sweeps::{QuantitySweep, Sweeps, Swept};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::Condition;
use crate::units::DEG_PER_RAD;
use plotters::prelude::*;

/// Orders drawn on their own: those with the largest peaks.
const MAIN_ORDERS: usize = 6;
/// Amplitudes above this multiple of the largest twist are cut off: rigid rolling at low speed would flatten the rest.
const CUT: f64 = 2.0;

struct Curve<'a> {
    label: String,
    /// What it is a curve of: its panel has the unit of that.
    of: Swept,
    values: &'a [f64],
    stroke: Stroke,
    /// Its peak between the speeds: rpm and value.
    peak: Option<(f64, f64)>,
}

impl Curve<'_> {
    fn points(&self, speeds: &[f64]) -> Vec<(f64, f64)> {
        let mut points: Vec<(f64, f64)> = speeds.iter().copied().zip(self.values.iter().copied()).collect();
        if let Some(peak) = self.peak {
            points.insert(points.partition_point(|p| p.0 <= peak.0), peak);
        }
        points
    }

    fn entry(&self) -> Entry {
        Entry::curve(&self.label, self.stroke)
    }
}

/// Height of a panel, units; a legend comes to it.
const HEIGHT: u32 = 300;

fn height(curves: &[Curve]) -> u32 {
    HEIGHT + legend::height(&curves.iter().map(Curve::entry).collect::<Vec<_>>(), WIDTH)
}

/// What stands beside an axis of a quantity.
fn axis(of: Swept) -> &'static str {
    match of {
        Swept::Twist | Swept::Amplitude | Swept::RingTwist => "half peak-to-peak / °",
        Swept::Torque => "half peak-to-peak / N m",
        Swept::DissipatedPower => "power / W",
    }
}

/// Curves of one quantity, `of`, which gives the axis its unit; a curve of another one is not drawn.
fn panel(area: &canvas::Area, (title, of): (&str, Swept), speeds: &[f64], curves: &[Curve], top: f64) -> Drawn {
    debug_assert!(curves.iter().all(|c| c.of == of), "{title}: curves of several quantities");
    let above = legend::below(area, &curves.iter().map(Curve::entry).collect::<Vec<_>>())?;
    let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
    let span = if last > first { first..last } else { first - 1.0..first + 1.0 };
    let own = captioned(&above, title, text(15))?;
    let mut chart = ChartBuilder::on(&own)
        .margin(px(8))
        .margin_right(px(24))
        .x_label_area_size(px(40))
        .y_label_area_size(px(58))
        .build_cartesian_2d(span, 0.0..top)?;
    canvas::mesh!(chart, "speed / rpm", axis(of), 9, 7);
    for curve in curves {
        // plotters draws what lies outside as well: the curve is cut at the frame
        for piece in canvas::clipped(curve.points(speeds).into_iter(), top) {
            canvas::curve(&mut chart, piece, curve.stroke)?;
        }
    }
    Ok(())
}

/// The peak of a design over the speeds, between them.
fn refined(results: &Results, design: &str) -> Option<(f64, f64)> {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    all().find(|d| d.name == design)?.twist.map(|p| (p.speed_rpm, p.value * DEG_PER_RAD))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The same in a condition.
fn in_condition(results: &Results, design: &str, q: &QuantitySweep) -> Option<(f64, f64)> {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let found = all().find(|d| d.name == design)?.conditions.iter().find(|c| c.condition == q.condition)?;
    found.twist.map(|p| (p.speed_rpm, p.value * DEG_PER_RAD))
}

fn curves<'a>(results: &Results, quantity: &'a QuantitySweep, orders: &[usize], peak: Option<(f64, f64)>) -> Vec<Curve<'a>> {
    let order = |&n: &usize| {
        let order = results.system.excitation.orders[n];
        Curve {
            label: format!("order {order}"),
            of: quantity.of,
            values: &quantity.orders[n].amplitude,
            stroke: Stroke::of_order(order, 14),
            peak: None,
        }
    };
    let total =
        Curve { label: "all orders".into(), of: quantity.of, values: &quantity.total, stroke: Stroke::solid(line(BLACK, 22)), peak };
    orders.iter().map(order).chain(std::iter::once(total)).collect()
}

/// Twist and hub amplitude of one design.
pub(crate) fn draw(study: &Study, results: &Results, sweep: &Sweeps, folder: &Folder) -> Result<(), WriteError> {
    let (twist, hub) = (&sweep.quantities[0], &sweep.quantities[1]);
    let mut orders: Vec<usize> = (0..twist.orders.len()).collect();
    orders.sort_by(|a, b| largest(&twist.orders[*b].amplitude).total_cmp(&largest(&twist.orders[*a].amplitude)));
    // a single order is the sum
    orders.truncate(if orders.len() == 1 { 0 } else { MAIN_ORDERS });
    orders.sort_unstable();
    let name = |station: usize| study.chain.stations[station].name.replace('_', " ");
    let between = match study.twist {
        crate::response::Quantity::Twist { from, to } => format!("{} to {}", name(from), to.map_or("ground".into(), name)),
        _ => String::new(),
    };
    // one scale for all designs
    let of_all = |quantity: usize| results.sweeps.iter().map(|s| largest(&s.quantities[quantity].total)).fold(0.0, f64::max);
    let top = canvas::round_up(of_all(0));
    let hub_top = canvas::round_up(of_all(1).min(CUT * of_all(0)));
    let cut = if hub_top < largest(&hub.total) { " (rigid rolling at low speed cut off)" } else { "" };
    let peak = refined(results, &sweep.design);
    // the twist again, with a cylinder misfiring, the absorber locked, the absorber lost
    let others: Vec<Curve> = sweep
        .quantities
        .iter()
        // the torque of every shaft may be swept in every condition, too
        .filter(|q| q.condition != Condition::Firing && q.of == twist.of && q.place == twist.place)
        .map(|q| (q, q.condition.name()))
        .enumerate()
        .map(|(i, (q, name))| Curve {
            label: name.replace('_', " "),
            of: q.of,
            values: &q.total,
            stroke: Stroke::of(i, 16),
            peak: in_condition(results, &sweep.design, q),
        })
        .chain(std::iter::once(Curve {
            label: "firing".into(),
            of: twist.of,
            values: &twist.total,
            stroke: Stroke::solid(line(BLACK, 22)),
            peak,
        }))
        .collect();
    let (of_twist, of_hub) = (curves(results, twist, &orders, peak), curves(results, hub, &orders, None));
    let (first, second) = (height(&of_twist), height(&of_hub));
    let third = if others.len() > 1 { height(&others) } else { 0 };
    let title = format!("{}: {}", study.engine.name, sweep.design.replace('_', " "));
    canvas::save(folder, &format!("response_{}", sweep.design), (WIDTH, canvas::title_height(&title) + first + second + third), |area| {
        let titled = canvas::titled(area, &title)?;
        let (upper, rest) = titled.split_vertically(px(first));
        let (lower, bottom) = rest.split_vertically(px(second));
        if third > 0 {
            let top = canvas::round_up(others.iter().map(|c| largest(c.values)).fold(0.0, f64::max));
            let title = format!("twist, {between}, all orders, in each condition");
            panel(&bottom, (&title, twist.of), &study.speeds_rpm, &others, top)?;
        }
        panel(&upper, (&format!("twist, {between}"), twist.of), &study.speeds_rpm, &of_twist, top)?;
        let title = format!("amplitude of {}{cut}", name(study.hub));
        panel(&lower, (&title, hub.of), &study.speeds_rpm, &of_hub, hub_top)
    })
}

/// Synthesised twist of all designs.
pub(crate) fn overlay(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let top = canvas::round_up(results.sweeps.iter().map(|s| largest(&s.quantities[0].total)).fold(0.0, f64::max));
    let curves: Vec<Curve> = results
        .sweeps
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let optimum = results.is_optimum(&s.design);
            let without = i == 0 && results.designs.first().is_some_and(|d| d.name == s.design && d.absorbers.is_empty());
            let stroke = if without { Stroke::solid(line(BLACK, 15)) } else { Stroke::of(i, if optimum { 28 } else { 15 }) };
            let twist = &s.quantities[0];
            Curve { label: s.design.replace('_', " "), of: twist.of, values: &twist.total, stroke, peak: refined(results, &s.design) }
        })
        .collect();
    canvas::save(folder, "designs", (WIDTH, 60 + height(&curves)), |area| {
        panel(area, (&format!("{}: synthesised twist of all designs", study.engine.name), Swept::Twist), &study.speeds_rpm, &curves, top)
    })
}
