//! What evaluating one design costs, measured on the location.

use super::margins;
use super::timing::{Repeats, Timing, median_seconds};
use crate::absorber::Mounted;
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Direct, Quantity, Response, ResponseError, Work};

/// The median counts. Short: a study that asks for nothing else should not wait for them.
const REPEATS: Repeats = Repeats { least: 1, most: 9, seconds: 0.01 };

/// Seconds per design on one thread: squares of the magnitudes of one quantity on the grid, its synthesis at every speed, its refined peak, the torque of
/// all shafts on the grid, and the smallest margins of the crank by some criteria, refined.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn per_design(
    finder: &PeakFinder,
    design: &[Mounted],
    quantity: Quantity,
    margins: &[Measure],
) -> Result<Vec<Timing>, ResponseError> {
    let measure = Measure::new(vec![quantity], Over::Synthesis);
    let (mut squares, mut phasors) = (Vec::new(), Vec::new());
    finder.method.sweep(design, quantity, &mut phasors, &mut Work::default())?;
    let direct = Direct::new(finder.system, finder.grid);
    let mut timing = Vec::new();
    let mut put = |stage: &str, seconds: f64, work: Work| timing.push(Timing { stage: stage.into(), seconds, work });
    let mut work = Work::default();
    let seconds = median_seconds(REPEATS, || {
        work = Work::default();
        finder.method.squares(design, quantity, &mut squares, &mut work)
    })?;
    put("one_design_squares", seconds, Work { receptance_points: work.receptance_points, ..Work::default() });
    let seconds = median_seconds(REPEATS, || {
        let total = finder.synthesis(&phasors);
        debug_assert!(!total.is_empty());
        Ok(())
    })?;
    put("one_design_synthesis", seconds, Work { syntheses: finder.grid.len() as u64, ..Work::default() });
    let seconds = median_seconds(REPEATS, || {
        work = Work::default();
        finder.peak(design, &measure, &mut work).map(|_| ())
    })?;
    put("one_design_refined_peak", seconds, work);
    let shafts: Vec<Quantity> = (0..finder.system.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let seconds = median_seconds(REPEATS, || {
        work = Work::default();
        let some = super::sweeps::together(finder.system.orders(), finder.grid.len());
        shafts.chunks(some).try_for_each(|some| direct.sweep_each(design, some, &mut work).map(|_| ()))
    })?;
    put("one_design_torques", seconds, work);
    if !margins.is_empty() {
        let seconds = median_seconds(REPEATS, || {
            work = Work::default();
            margins::smallest(finder, design, margins, &mut work).map(|_| ())
        })?;
        put("one_design_margins", seconds, work);
    }
    Ok(timing)
}
