//! What a proof costs: boxes and seconds against the gap, a curve for each type and number of free parameters.

use super::canvas::{self, COLOURS, Stroke, WIDTH, captioned, fill, line, px, text};
use super::chart::decades;
use super::legend::{self, Entry};
use crate::benchmark::proofs::ProofCost;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use plotters::prelude::*;

/// What is drawn of a proof.
type Of = fn(&ProofCost) -> f64;

/// `proofs.svg` and `.png`; none where nothing was measured.
///
/// # Errors
/// [`WriteError`] where they cannot be written.
pub fn draw(study: &Study, measured: &[ProofCost], folder: &Folder) -> Result<(), WriteError> {
    let mut curves: Vec<(&str, usize)> = measured.iter().map(|p| (p.kind, p.free)).collect();
    curves.dedup();
    if curves.is_empty() {
        return Ok(());
    }
    let label =
        |(kind, free): (&str, usize)| format!("{}, {free} free parameter{}", kind.replace('_', " "), if free == 1 { "" } else { "s" });
    let entries: Vec<Entry> = curves.iter().enumerate().map(|(i, c)| Entry::curve(label(*c), Stroke::of(i, 20))).collect();
    let range = |of: &dyn Fn(&ProofCost) -> f64| {
        let (low, high) = measured.iter().map(of).fold((f64::INFINITY, 0.0f64), |(a, b), x| (a.min(x), b.max(x)));
        (low / 1.5, high * 1.5)
    };
    let gaps = range(&|p| p.gap);
    canvas::save(folder, "proofs", (WIDTH, 400 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own =
            captioned(&main, format!("{}: proof that no design of the family is better by more than a gap", study.engine.name), text(15))?;
        let panels: [(&str, Of); 2] = [("boxes", |p| p.boxes as f64), ("seconds, all threads", |p| p.seconds.max(1e-3))];
        for (panel, (name, of)) in own.split_evenly((1, 2)).iter().zip(panels) {
            let values = range(&of);
            let mut chart = ChartBuilder::on(panel)
                .margin(px(8))
                .margin_right(px(20))
                .x_label_area_size(px(40))
                .y_label_area_size(px(62))
                .build_cartesian_2d(
                    (gaps.0..gaps.1).log_scale().with_key_points(decades(gaps.0, gaps.1)),
                    (values.0..values.1).log_scale().with_key_points(decades(values.0, values.1)),
                )?;
            canvas::log_axes!(chart, "gap, as a share of the optimum", name, &|x| format!("{x:.0e}"));
            for (i, curve) in curves.iter().enumerate() {
                let own: Vec<&ProofCost> = measured.iter().filter(|p| (p.kind, p.free) == *curve).collect();
                canvas::curve(&mut chart, own.iter().map(|p| (p.gap, of(p))), Stroke::of(i, 20))?;
                // filled where the boxes sufficed
                let colour = COLOURS[i % COLOURS.len()];
                let mark = |p: &ProofCost| if p.proved { fill(colour, 1.0) } else { line(colour, 14) };
                chart.draw_series(own.iter().map(|p| Circle::new((p.gap, of(p)), px(4), mark(p))))?;
            }
        }
        Ok(())
    })
}
