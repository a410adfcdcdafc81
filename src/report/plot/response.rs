//! Response over speed: one design with its main orders, and all designs together.

use super::canvas::{self, COLOURS, Drawn, line, px, text};
use crate::analysis::Results;
use crate::analysis::sweeps::{QuantitySweep, Sweeps};
use crate::input::Study;
use crate::objective::Condition;
use crate::report::files::{Folder, WriteError};
use plotters::prelude::*;

/// Orders drawn on their own: those with the largest peaks.
const MAIN_ORDERS: usize = 6;
/// Amplitudes above this multiple of the largest twist are cut off: rigid rolling at low speed would flatten the rest.
const CUT: f64 = 2.0;

struct Curve<'a> {
    label: String,
    values: &'a [f64],
    style: ShapeStyle,
}

fn panel(area: &canvas::Area, title: &str, unit: &str, speeds: &[f64], curves: &[Curve], top: f64) -> Drawn {
    let width = canvas::legend_width(curves.iter().map(|c| c.label.as_str()));
    let (left, right) = area.split_horizontally(area.dim_in_pixel().0 - width);
    let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
    let span = if last > first { first..last } else { first - 1.0..first + 1.0 };
    let mut chart = ChartBuilder::on(&left)
        .caption(title, text(14))
        .margin(px(8))
        .x_label_area_size(px(36))
        .y_label_area_size(px(54))
        .build_cartesian_2d(span, 0.0..top)?;
    canvas::mesh!(chart, "speed / rpm", unit, 9, 7);
    for curve in curves {
        // plotters draws what lies outside as well: the curve is cut at the frame
        let points = speeds.iter().zip(curve.values).map(|(x, y)| (*x, *y));
        for piece in canvas::clipped(points, top) {
            chart.draw_series(LineSeries::new(piece, curve.style))?;
        }
    }
    let entries: Vec<(String, ShapeStyle)> = curves.iter().map(|c| (c.label.clone(), c.style)).collect();
    canvas::legend(&right, &entries)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

fn curves<'a>(results: &Results, quantity: &'a QuantitySweep, orders: &[usize]) -> Vec<Curve<'a>> {
    let order = |&n: &usize| {
        let order = results.system.excitation.orders[n];
        Curve { label: format!("order {order}"), values: &quantity.orders[n].amplitude, style: line(canvas::of_order(order), 14) }
    };
    let total = Curve { label: "all orders".into(), values: &quantity.total, style: line(BLACK, 22) };
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
    // the twist again, with a cylinder misfiring, the absorber locked, the absorber lost
    let others: Vec<Curve> = sweep
        .quantities
        .iter()
        .filter(|q| q.condition != Condition::Firing)
        .map(|q| (q, q.condition.name()))
        .enumerate()
        .map(|(i, (q, name))| Curve { label: name.replace('_', " "), values: &q.total, style: line(COLOURS[i % COLOURS.len()], 16) })
        .chain(std::iter::once(Curve { label: "firing".into(), values: &twist.total, style: line(BLACK, 22) }))
        .collect();
    let panels = if others.len() > 1 { 3 } else { 2 };
    canvas::save(folder, &format!("response_{}", sweep.design), (900, 30 + 365 * panels), |area| {
        let titled = canvas::titled(area, &format!("{}: {}", study.engine.name, sweep.design.replace('_', " ")))?;
        let height = titled.dim_in_pixel().1 / panels;
        let (upper, rest) = titled.split_vertically(height);
        let (lower, bottom) = rest.split_vertically(height);
        if panels == 3 {
            let top = canvas::round_up(others.iter().map(|c| largest(c.values)).fold(0.0, f64::max));
            let title = format!("twist, {between}, all orders, in each condition");
            panel(&bottom, &title, "half peak-to-peak / °", &study.speeds_rpm, &others, top)?;
        }
        panel(&upper, &format!("twist, {between}"), "half peak-to-peak / °", &study.speeds_rpm, &curves(results, twist, &orders), top)?;
        let title = format!("amplitude of {}{cut}", name(study.hub));
        panel(&lower, &title, "half peak-to-peak / °", &study.speeds_rpm, &curves(results, hub, &orders), hub_top)
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
            let colour =
                if s.quantities.len() > 2 && results.sweeps[0].design == "none" && i == 0 { BLACK } else { COLOURS[i % COLOURS.len()] };
            Curve { label: s.design.replace('_', " "), values: &s.quantities[0].total, style: line(colour, if optimum { 28 } else { 15 }) }
        })
        .collect();
    canvas::save(folder, "designs", (900, 430), |area| {
        panel(
            area,
            &format!("{}: synthesised twist of all designs", study.engine.name),
            "half peak-to-peak / °",
            &study.speeds_rpm,
            &curves,
            top,
        )
    })
}
