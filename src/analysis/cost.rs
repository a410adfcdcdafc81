//! What evaluating one design costs, measured on the spot.

use super::{Timing, margins};
use crate::absorber::Mounted;
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Direct, Quantity, Response, ResponseError, Work};
use std::time::Instant;

/// Repetitions of each measurement, fewer where they take longer than this together, s; the median counts.
const REPEATS: usize = 21;
const LONG: f64 = 0.5;

fn median(mut once: impl FnMut() -> Result<(), ResponseError>) -> Result<f64, ResponseError> {
    let mut seconds = Vec::with_capacity(REPEATS);
    for _ in 0..REPEATS {
        let start = Instant::now();
        once()?;
        seconds.push(start.elapsed().as_secs_f64());
        if seconds.iter().sum::<f64>() > LONG {
            break;
        }
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds[seconds.len() / 2])
}

/// Seconds per design on one thread: squares of the magnitudes of one quantity on the grid, its synthesis at every speed, its refined peak, the torque of
/// all shafts on the grid, and the smallest margins of the crank by all criteria, refined.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub fn per_design(finder: &PeakFinder, design: &[Mounted], quantity: Quantity, margins: &[Measure]) -> Result<Vec<Timing>, ResponseError> {
    let measure = Measure { quantities: vec![quantity], over: Over::Synthesis };
    let (mut squares, mut phasors) = (Vec::new(), Vec::new());
    finder.method.sweep(design, quantity, &mut phasors, &mut Work::default())?;
    let direct = Direct::new(finder.system, finder.grid);
    let mut timing = Vec::new();
    let mut put = |stage: &str, seconds: f64, work: Work| timing.push(Timing { stage: stage.into(), seconds, work });
    let mut work = Work::default();
    finder.method.squares(design, quantity, &mut squares, &mut work)?;
    let seconds = median(|| finder.method.squares(design, quantity, &mut squares, &mut Work::default()))?;
    put("one_design_squares", seconds, Work { receptance_points: work.receptance_points, ..Work::default() });
    let seconds = median(|| {
        let total = finder.synthesis(&phasors);
        debug_assert!(!total.is_empty());
        Ok(())
    })?;
    put("one_design_synthesis", seconds, Work { syntheses: finder.grid.len() as u64, ..Work::default() });
    let mut work = Work::default();
    finder.peak(design, &measure, &mut work)?;
    let seconds = median(|| finder.peak(design, &measure, &mut Work::default()).map(|_| ()))?;
    put("one_design_refined_peak", seconds, work);
    let mut work = Work::default();
    let shafts: Vec<Quantity> = (0..finder.system.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let torques = |work: &mut Work| direct.sweep_each(design, &shafts, work).map(|_| ());
    torques(&mut work)?;
    let seconds = median(|| torques(&mut Work::default()))?;
    put("one_design_torques", seconds, work);
    if !margins.is_empty() {
        let mut work = Work::default();
        let all = |work: &mut Work| margins::smallest(finder, design, margins, work).map(|_| ());
        all(&mut work)?;
        put("one_design_margins", median(|| all(&mut Work::default()))?, work);
    }
    Ok(timing)
}
