//! What simplifications of the model cost: error of the peak twist along each.

use super::canvas::{self, COLOURS, WIDTH, fill, line, px};
use super::chart::decades;
use crate::benchmark::model_accuracy::ModelError;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use plotters::prelude::*;

/// Smaller errors are drawn on this.
const LEAST_ERROR: f64 = 1e-7;

/// A panel a simplification, with one scale of errors.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub fn models(study: &Study, models: &[&ModelError], folder: &Folder) -> Result<(), WriteError> {
    let worst = models.iter().flat_map(|m| &m.points).map(|p| p.1).fold(1e-3, f64::max);
    let y = (LEAST_ERROR / 2.0, 2.0 * worst);
    canvas::save(folder, "models", (WIDTH, 36 + 320 * models.len().div_ceil(2) as u32), |area| {
        let titled = canvas::titled(area, &format!("{}: what a simpler model costs", study.engine.name))?;
        for ((panel, m), colour) in titled.split_evenly((models.len().div_ceil(2), 2)).iter().zip(models).zip(COLOURS) {
            let (left, right) = m.points.iter().fold((f64::INFINITY, 0.0f64), |(a, b), p| (a.min(p.0), b.max(p.0)));
            let mut chart = ChartBuilder::on(panel).margin(px(8)).x_label_area_size(px(40)).y_label_area_size(px(62)).build_cartesian_2d(
                (left / 1.15..right * 1.15).log_scale().with_key_points(ticks(m)),
                (y.0..y.1).log_scale().with_key_points(decades(y.0, y.1)),
            )?;
            canvas::log_axes!(chart, m.what.label(), "error of the peak", &|x| canvas::tick(x));
            let points: Vec<(f64, f64)> = m.points.iter().map(|p| (p.0, p.1.max(LEAST_ERROR))).collect();
            chart.draw_series(LineSeries::new(points.iter().copied(), line(colour, 18)))?;
            chart.draw_series(points.iter().map(|p| Circle::new(*p, px(3), fill(colour, 1.0))))?;
        }
        Ok(())
    })
}

/// Sizes with a label: every other one where they are many.
fn ticks(m: &ModelError) -> Vec<f64> {
    let every = if m.points.len() > 5 { 2 } else { 1 };
    m.points.iter().step_by(every).map(|p| p.0).collect()
}
