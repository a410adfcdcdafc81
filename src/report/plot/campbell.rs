//! Campbell diagram: natural frequencies, order lines, speed range and the resonances in it.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, fill, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::Results;
use crate::analysis::model_check::{DRAWN_ORDERS, strongest_orders};
use crate::engine::Order;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::units::HZ_PER_RPM;
use plotters::prelude::*;

pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let chosen = strongest_orders(study, &results.system, DRAWN_ORDERS);
    let orders: Vec<Order> = chosen.iter().map(|n| results.system.excitation.orders[*n]).collect();
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let right = canvas::round_up(1.02 * high).min(1.15 * high);
    let own = results.system.modes.frequencies_hz();
    let reached = orders.last().map_or(0.0, |o| o.value() * right * HZ_PER_RPM);
    // the first optimum of the study, if there is one
    let optimum = results.optima.first().map(|o| (&o.design.name, &o.design.frequencies_hz));
    let shown = own.iter().chain(optimum.iter().flat_map(|o| o.1)).copied().filter(|f| *f <= reached);
    let top = 1.08 * shown.fold(own.first().copied().unwrap_or(1.0), f64::max);
    let (chain, found) = (Stroke::solid(line(COLOURS[0], 18)), Stroke::dashed(line(COLOURS[1], 16)));
    let alone = if results.system.flexible.is_some() { "flexible crank alone" } else { "chain alone" };
    let mut entries = vec![Entry::curve(alone, chain)];
    entries.extend(optimum.iter().map(|(name, _)| Entry::curve(name.replace('_', " "), found)));
    entries.push(Entry::curve("order lines", Stroke::solid(line(GREY, 9))));
    entries.push(Entry::new("speed range", Mark::Block(fill(COLOURS[5], 0.3))));
    entries.push(Entry::new("resonance", Mark::Point(fill(COLOURS[0], 1.0))));
    canvas::save(folder, "campbell", (WIDTH, 520 + legend::height(&entries, WIDTH)), |area| {
        let titled = canvas::titled(area, &format!("{}: Campbell diagram", study.engine.name))?;
        let above = legend::below(&titled, &entries)?;
        let mut chart = ChartBuilder::on(&above)
            .margin(px(8))
            .margin_top(px(40))
            .margin_right(px(44))
            .x_label_area_size(px(40))
            .y_label_area_size(px(58))
            .build_cartesian_2d(0.0..right, 0.0..top)?;
        chart.draw_series(std::iter::once(Rectangle::new([(low, 0.0), (high, top)], fill(COLOURS[5], 0.12))))?;
        canvas::mesh!(chart, "speed / rpm", "frequency / Hz", 9, 9);
        // where labels at the top end so far, in two rows
        let mut ends = [0, 0];
        for order in orders.iter().rev() {
            let slope = order.value() * HZ_PER_RPM;
            let end = (top / slope).min(right);
            chart.draw_series(LineSeries::new([(0.0, 0.0), (end, end * slope)], line(GREY, 9)))?;
            // labels along the frame: at the top where the line leaves there, at the right otherwise
            let label = order.to_string();
            let width = 8 * label.chars().count() as i32;
            let (dx, dy) = if end < right {
                let left = chart.backend_coord(&(end, top)).0 / px(1) as i32 - width / 2;
                let row = usize::from(left < ends[0] + 3);
                ends[row] = left + width;
                (-width / 2, -16 - 14 * row as i32)
            } else {
                (4, -7)
            };
            let label = EmptyElement::at((end, end * slope)) + Text::new(label, (dx * px(1) as i32, dy * px(1) as i32), text(13));
            chart.draw_series(std::iter::once(label))?;
        }
        for f in own.iter().filter(|f| **f <= top) {
            canvas::curve(&mut chart, [(0.0, *f), (right, *f)], chain)?;
        }
        if let Some((_, frequencies)) = &optimum {
            for f in frequencies.iter().filter(|f| **f <= top) {
                canvas::curve(&mut chart, [(0.0, *f), (right, *f)], found)?;
            }
        }
        let met = orders.iter().flat_map(|o| own.iter().map(move |f| (*f / (o.value() * HZ_PER_RPM), *f)));
        // those just above the range raise what is at its end
        let inside = met.filter(|(speed, f)| (low..=right).contains(speed) && *f <= top);
        chart.draw_series(inside.map(|p| Circle::new(p, px(4), fill(COLOURS[0], 1.0))))?;
        Ok(())
    })
}
