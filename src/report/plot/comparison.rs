//! Computed against published amplitudes, before and after a calibration, and the orders of each design with the published points.

use super::canvas::{self, COLOURS, Drawn, GREY, PALE, Stroke, WIDTH, captioned, fill, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::{Calibration, Results, Sweeps};
use crate::engine::Order;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use crate::validation::{Comparison, Role};
use plotters::prelude::*;

/// Lines of deviation drawn beside equality.
const LINES: f64 = 0.1;

/// A published value beside ours, with how it is drawn.
struct Pair {
    published: f64,
    computed: f64,
    colour: RGBColor,
    filled: bool,
}

/// A square plot on logarithmic axes with lines of equality and ten per cent.
fn scatter(area: &canvas::Area, title: &str, what: &str, marks: &[Pair], entries: &[(String, RGBColor, bool)]) -> Drawn {
    let entry = |(label, colour, filled): &(String, RGBColor, bool)| {
        Entry::new(label, Mark::Point(if *filled { fill(*colour, 1.0) } else { line(*colour, 20) }))
    };
    let (equal, tenth) = (Stroke::solid(line(BLACK, 12)), Stroke::dashed(line(GREY, 10)));
    let mut legend: Vec<Entry> = entries.iter().map(entry).collect();
    legend.extend([Entry::curve("equal", equal), Entry::curve("±10 %", tenth)]);
    let main = legend::below(area, &legend)?;
    let all = marks.iter().flat_map(|m| [m.published, m.computed]).filter(|x| *x > 0.0);
    let (low, high) = all.fold((f64::INFINITY, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
    let (low, high) = (low / 1.3, high * 1.3);
    let ticks: Vec<f64> = canvas::ticks(low, high);
    let axis = || (low..high).log_scale().with_key_points(ticks.clone());
    let own = captioned(&main, title, text(16))?;
    let mut chart =
        ChartBuilder::on(&own).margin(px(8)).x_label_area_size(px(40)).y_label_area_size(px(62)).build_cartesian_2d(axis(), axis())?;
    canvas::mesh!(chart, format!("published {what}"), format!("computed {what}"), 20, 20);
    canvas::curve(&mut chart, [(low, low), (high, high)], equal)?;
    for factor in [1.0 - LINES, 1.0 + LINES] {
        // cut at the frame
        let ends = if factor < 1.0 { [(low / factor, low), (high, high * factor)] } else { [(low, low * factor), (high / factor, high)] };
        canvas::curve(&mut chart, ends, tenth)?;
    }
    for m in marks.iter().filter(|m| m.published > 0.0 && m.computed > 0.0) {
        let style = if m.filled { fill(m.colour, 1.0) } else { line(m.colour, 20) };
        chart.draw_series(std::iter::once(Circle::new((m.published, m.computed), px(5), style)))?;
    }
    Ok(())
}

/// All published amplitudes with a computed one: filled where predicted, open where fitted.
pub fn amplitudes(study: &Study, comparison: &Comparison, folder: &Folder) -> Result<(), WriteError> {
    let colour = |design: usize| COLOURS[design % COLOURS.len()];
    let shown = || comparison.amplitudes.iter().filter(|r| r.published.is_some() && r.computed.is_some());
    let marks: Vec<Pair> = shown()
        .filter_map(|r| {
            let (published, computed) = (r.published? * DEG_PER_RAD, r.computed?.amplitude * DEG_PER_RAD);
            let colour = if r.role == Role::Unexplained { GREY } else { colour(r.design) };
            Some(Pair { published, computed, colour, filled: r.role == Role::Predicted })
        })
        .collect();
    let mut entries = Vec::new();
    for (d, design) in study.designs.iter().enumerate() {
        for role in [Role::Calibrated, Role::Predicted] {
            if shown().any(|r| r.design == d && r.role == role) {
                entries.push((format!("{}, {}", design.name.replace('_', " "), role.name()), colour(d), role == Role::Predicted));
            }
        }
    }
    if shown().any(|r| r.role == Role::Unexplained) {
        entries.push(("unexplained, set aside".into(), GREY, false));
    }
    canvas::save(folder, "comparison", (WIDTH, 720), |area| {
        scatter(area, &format!("{}: amplitudes of orders at the hub", study.engine.name), "amplitude / °", &marks, &entries)
    })
}

/// Fitted rows before and after.
pub fn calibration(study: &Study, calibration: &Calibration, folder: &Folder) -> Result<(), WriteError> {
    let mark = |published: f64, computed: f64, filled: bool| Pair {
        published: published * DEG_PER_RAD,
        computed: computed * DEG_PER_RAD,
        colour: if filled { COLOURS[0] } else { COLOURS[1] },
        filled,
    };
    let before = calibration.rows.iter().map(|r| mark(r.published, r.before, false));
    let marks: Vec<Pair> = before.chain(calibration.rows.iter().map(|r| mark(r.published, r.after, true))).collect();
    let entries = [("fitted".to_owned(), COLOURS[0], true), ("with the engine file".to_owned(), COLOURS[1], false)];
    canvas::save(folder, "calibration", (WIDTH, 720), |area| {
        scatter(area, &format!("{}: calibration", study.engine.name), "amplitude / °", &marks, &entries)
    })
}

/// Panels side by side at most.
const COLUMNS: usize = 2;
/// The scale ends this factor above the largest published or computed amplitude of a published order.
const ROOM: f64 = 1.15;

/// Orders at the hub of every design with published amplitudes, side by side on one scale, with the published points.
pub fn orders(study: &Study, comparison: &Comparison, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let rows_of = |design: usize| comparison.amplitudes.iter().filter(move |r| r.design == design && r.published.is_some());
    let designs: Vec<(usize, &Sweeps)> = (0..study.designs.len())
        .filter(|d| rows_of(*d).next().is_some())
        .filter_map(|d| results.sweeps.iter().find(|s| s.design == study.designs[d].name).map(|s| (d, s)))
        .collect();
    let mut named: Vec<Order> = comparison.amplitudes.iter().map(|r| r.order).collect();
    named.sort_unstable();
    named.dedup();
    let seen = comparison.amplitudes.iter().flat_map(|r| [r.published, r.computed.map(|c| c.amplitude)]).flatten();
    let top = canvas::round_up(ROOM * seen.fold(0.0, f64::max) * DEG_PER_RAD);
    let rows = designs.len().div_ceil(COLUMNS);
    let mut entries: Vec<Entry> = named.iter().map(|o| Entry::curve(format!("order {o}"), stroke(*o))).collect();
    entries.push(Entry::curve("other orders", Stroke::solid(line(PALE, 14))));
    entries.push(Entry::new("published", Mark::Point(line(BLACK, 16))));
    let height = 40 + 270 * rows as u32 + legend::height(&entries, WIDTH);
    canvas::save(folder, "orders", (WIDTH, height), |area| {
        let title = format!("{}: amplitude of the {} by orders", study.engine.name, study.chain.stations[study.hub].name.replace('_', " "));
        let titled = canvas::titled(area, &title)?;
        let main = legend::below(&titled, &entries)?;
        for (panel, (design, sweep)) in main.split_evenly((rows, COLUMNS)).iter().zip(&designs) {
            one(panel, study, results, sweep, &named, top, rows_of(*design).filter_map(|r| Some((r.order, r.speed_rpm, r.published?))))?;
        }
        Ok(())
    })
}

fn stroke(order: Order) -> Stroke {
    Stroke::of_order(order, 18)
}

fn one(
    area: &canvas::Area,
    study: &Study,
    results: &Results,
    sweep: &Sweeps,
    named: &[Order],
    top: f64,
    published: impl Iterator<Item = (Order, f64, f64)>,
) -> Drawn {
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let own = captioned(area, sweep.design.replace('_', " "), text(14))?;
    let mut chart = ChartBuilder::on(&own)
        .margin(px(8))
        .margin_right(px(20))
        .x_label_area_size(px(40))
        .y_label_area_size(px(58))
        .build_cartesian_2d(first..last.max(first + 1.0), 0.0..top)?;
    canvas::mesh!(chart, "speed / rpm", "amplitude / °", 5, 6);
    let hub = &sweep.quantities[1];
    let mut curves: Vec<(usize, Stroke)> = Vec::new();
    for (n, order) in results.system.excitation.orders.iter().enumerate() {
        match named.contains(order) {
            true => curves.push((n, stroke(*order))),
            false => curves.insert(0, (n, Stroke::solid(line(PALE, 14)))),
        }
    }
    for (n, stroke) in curves {
        let points = study.speeds_rpm.iter().copied().zip(hub.orders[n].amplitude.iter().copied());
        for piece in canvas::clipped(points, top) {
            canvas::curve(&mut chart, piece, stroke)?;
        }
    }
    for (order, speed, amplitude) in published {
        let style = stroke(order).style;
        // a point on the frame or beyond is not drawn
        if (first..=last).contains(&speed) {
            chart.draw_series(std::iter::once(Circle::new((speed, amplitude * DEG_PER_RAD), px(4), style)))?;
        }
    }
    Ok(())
}
