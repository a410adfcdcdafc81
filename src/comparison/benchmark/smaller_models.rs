//! What methods with a smaller model would cost and err, by count and by estimate: why `auto` does not consider them.
//!
//! Once the chain is tabulated its size costs nothing, and without tables (a chain that nothing damps) a few speeds cannot be trusted to show its narrow
//! peaks, whatever the model.

use super::methods::Candidate;
use super::speed_accuracy::peak;
use crate::absorber::Mounted;
use crate::analysis::method_selection::nominal;
use crate::input::Study;
use crate::numerics::ZERO;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::PeakFinder;
use crate::response::{Direct, Grid, Quantity, Work};

/// A method with a model of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallerModel {
    /// The method.
    pub candidate: Candidate,
    /// Nominal seconds a design, as those of strategies.
    pub seconds: f64,
    /// Twice the largest relative difference to a direct solution at the method's own peak, over the probe designs: where the true peak is elsewhere the error
    /// is larger than that difference.
    pub error: f64,
}

const METHODS: [Candidate; 5] =
    [Candidate::ClosedForm, Candidate::Reduced(1), Candidate::Reduced(2), Candidate::Reduced(3), Candidate::Modal];
/// Speeds a method starts from.
const SPEEDS: usize = 27;
/// An error is doubled where it is only known at the peak that a method itself found.
const OWN_PEAK: f64 = 2.0;

/// Estimates over probe designs with finite peaks.
pub fn estimates(study: &Study, finder: &PeakFinder, probes: &[Mounted], quantity: Quantity) -> Vec<SmallerModel> {
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let speeds: Vec<f64> = (0..SPEEDS).map(|i| first + (last - first) * i as f64 / (SPEEDS - 1) as f64).collect();
    let grid = Grid::new(&speeds, &[]);
    let direct = Direct::new(finder.system, &grid);
    let synthesiser = Synthesiser::new(&finder.system.excitation.harmonics);
    let estimate = |candidate: Candidate| -> Option<SmallerModel> {
        let method = candidate.build(finder.system, &grid, probes.get(..1)?, quantity)?;
        let (mut error, mut work) = (0.0, Work::default());
        for m in probes {
            let design = std::slice::from_ref(m);
            let (speed, value) = peak(method.as_ref(), &synthesiser, design, quantity, true, &mut work).ok()?;
            let mut y = vec![ZERO; finder.system.orders()];
            direct.at(design, quantity, speed, &mut y, &mut work).ok()?;
            let exact = synthesiser.extremes(&y).half_peak_to_peak;
            error = f64::max(error, OWN_PEAK * (value / exact - 1.0).abs());
        }
        let seconds = nominal(&work, finder.system.chain.len()) / probes.len() as f64;
        Some(SmallerModel { candidate, seconds, error })
    };
    METHODS.iter().filter_map(|c| estimate(*c)).collect()
}
