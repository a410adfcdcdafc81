//! Order spectrum of the excitation: torque of a throw, and what of it pushes the first mode.

use super::canvas::{self, COLOURS, Drawn, WIDTH, captioned, fill, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::numerics::C64;
use plotters::prelude::*;

/// Dark, middle and light, so that they are told apart without colour.
const SHADES: [RGBColor; 3] = [RGBColor(0, 60, 100), COLOURS[1], COLOURS[5]];

fn bars(area: &canvas::Area, title: &str, orders: &[f64], series: &[(String, Vec<f64>)]) -> Drawn {
    let entries: Vec<Entry> = series.iter().enumerate().map(|(i, s)| Entry::new(&s.0, Mark::Block(fill(SHADES[i], 1.0)))).collect();
    let above = legend::below(area, &entries)?;
    let top = canvas::round_up(series.iter().flat_map(|s| &s.1).copied().fold(0.0, f64::max));
    let end = orders.last().copied().unwrap_or(1.0) + 1.0;
    // a single order is no wall
    let step = orders.windows(2).map(|w| w[1] - w[0]).fold(0.1 * end, f64::min);
    let own = captioned(&above, title, text(15))?;
    let mut chart =
        ChartBuilder::on(&own).margin(px(8)).x_label_area_size(px(40)).y_label_area_size(px(62)).build_cartesian_2d(0.0..end, 0.0..top)?;
    canvas::mesh!(chart, "order", "amplitude / N m", 13, 6);
    let width = 0.8 * step / series.len() as f64;
    for (i, (_, values)) in series.iter().enumerate() {
        let bar = |(o, v): (&f64, &f64)| {
            let from = o - 0.4 * step + i as f64 * width;
            Rectangle::new([(from, 0.0), (from + width, *v)], fill(SHADES[i], 1.0))
        };
        chart.draw_series(orders.iter().zip(values).map(bar))?;
    }
    Ok(())
}

pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let system = &results.system;
    let orders: Vec<f64> = system.excitation.orders.iter().map(|o| o.value()).collect();
    let all = &study.speeds_rpm;
    let mut speeds = vec![all[0], all[all.len() / 2], all[all.len() - 1]];
    speeds.dedup();
    if system.excitation.tabulated_rpm.is_empty() {
        speeds.truncate(1);
    }
    let series = |f: &dyn Fn(usize, f64) -> f64| -> Vec<(String, Vec<f64>)> {
        speeds.iter().map(|s| (format!("{s} rpm"), (0..orders.len()).map(|n| f(n, *s)).collect())).collect()
    };
    let throw = series(&|n, speed| system.excitation.throw_torque(0, n, speed).norm());
    let mode = study.modes.elastic().next();
    let modal = mode.map(|m| {
        let shape = study.modes.shapes.column(m);
        let hub = shape.amax();
        series(&|n, speed| {
            let sum: C64 = system.phases(n).iter().zip(shape.iter()).map(|(p, phi)| p * (phi / hub)).sum();
            (sum * system.excitation.unit_torque(n, speed)).norm()
        })
    });
    canvas::save(folder, "excitation", (WIDTH, 760), |area| {
        let titled = canvas::titled(area, &format!("{}: orders of the excitation", study.engine.name))?;
        let (upper, lower) = titled.split_vertically(titled.dim_in_pixel().1 / 2);
        bars(&upper, "torque of throw 1, gas and inertia", &orders, &throw)?;
        if let Some(modal) = &modal {
            bars(&lower, "all throws together, weighted by the first mode (its largest amplitude taken as one)", &orders, modal)?;
        }
        Ok(())
    })
}
