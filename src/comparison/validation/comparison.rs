//! All tables of one engine beside our numbers.

use super::amplitudes::{self, AmplitudeRow};
use super::choices::{self, Choices};
use super::entry::Entry;
use super::verdict::{self, Verdict};
use super::{
    absorbers, chain, claims, fatigue, frequencies, modes, multiaxial, notches, planes, predicted, text_values, uncertainty, von_mises,
};
use crate::analysis::{Calibrated, Calibration, Results, RunError};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::{Input, Published, Study};

/// All tables of one engine beside our numbers.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// In the order of the tables.
    pub entries: Vec<Entry>,
    /// Amplitudes, for plots and summaries.
    pub amplitudes: Vec<AmplitudeRow>,
    /// Which designs are better, as printed and as computed.
    pub choices: Choices,
    /// Amplitude of one order at the hub that the source accepts, degrees.
    pub accepted: Option<f64>,
    /// What follows from them.
    pub verdict: Verdict,
}

/// Compares a study, as fitted, with its published tables. `whole`: the same with all designs and criteria, where a comparison leaves some out; `results`: of the study, optima included where it has any.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn compare(
    (study, whole): (&Study, &Study),
    published: &Published,
    calibration: Option<&Calibration>,
    results: &Results,
) -> Result<Comparison, RunError> {
    let amplitudes = amplitudes::rows(study, published, calibration, &results.system)?;
    let mut entries = entries((study, whole), published, &results.system, &amplitudes)?;
    uncertainty::digits(&mut entries);
    if let Some(calibration) = calibration {
        uncertainty::standard_errors(&mut entries, calibration, |inputs| {
            let moved = study.with_inputs(&from_fitted(study, calibration, inputs));
            let torque = Excitation::new(&moved.engine, moved.order_limit);
            let system = System::with_modes(moved.chain.clone(), moved.modes.clone(), torque);
            let amplitudes = amplitudes::rows(&moved, published, Some(calibration), &system)?;
            self::entries((&moved, whole), published, &system, &amplitudes)
        })?;
    }
    let choices = choices::choices(study, published, &entries);
    let verdict = verdict::verdict(study, published, results, &entries, &amplitudes);
    Ok(Comparison { entries, amplitudes, choices, accepted: self::amplitudes::accepted_deg(published), verdict })
}

/// Values of inputs as a study that is fitted already takes them: a scale of a pressure that the fit has scaled counts from one again.
fn from_fitted(study: &Study, calibration: &Calibration, inputs: &[(Input, f64)]) -> Vec<(Input, f64)> {
    let again = |(c, (input, value)): (&Calibrated, &(Input, f64))| {
        let own = input.value(&study.engine, &study.chain).unwrap_or(c.value);
        (*input, value * own / c.value)
    };
    calibration.inputs.iter().zip(inputs).map(again).collect()
}

/// Every printed number beside ours, without uncertainties.
fn entries(
    (study, whole): (&Study, &Study),
    published: &Published,
    system: &System,
    amplitudes: &[AmplitudeRow],
) -> Result<Vec<Entry>, RunError> {
    let conventions = absorbers::conventions(study, published);
    let mut entries = text_values::inputs(study, published);
    entries.extend(frequencies::entries(study, published));
    entries.extend(modes::entries(study, published));
    entries.extend(von_mises::entries(whole, published)?);
    entries.extend(absorbers::entries(study, published, &conventions));
    entries.extend(self::amplitudes::entries(study, published, &conventions, amplitudes));
    entries.extend(self::amplitudes::acceptance(study, published, amplitudes));
    entries.extend(text_values::peaks(study, published, system)?);
    entries.extend(fatigue::entries(study, published));
    entries.extend(notches::entries(study, published));
    entries.extend(multiaxial::entries(study, published));
    entries.extend(planes::entries(published));
    entries.extend(predicted::entries(study, published, system, fatigue::strength(published))?);
    entries.extend(chain::entries(study, published));
    entries.extend(chain::printed(study, published));
    entries.extend(claims::entries(study, published, amplitudes)?);
    Ok(entries)
}
