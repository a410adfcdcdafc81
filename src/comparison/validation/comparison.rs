//! All tables of one engine beside our numbers.

use super::amplitudes::{self, AmplitudeRow};
use super::entry::Entry;
use super::verdict::{self, Verdict};
use super::{absorbers, chain, fatigue, frequencies, modes, multiaxial, notches, predicted, text_values, von_mises};
use crate::analysis::{Calibration, Results, RunError};
use crate::input::{Published, Study};

/// All tables of one engine beside our numbers.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// In the order of the tables.
    pub entries: Vec<Entry>,
    /// Amplitudes, for plots and summaries.
    pub amplitudes: Vec<AmplitudeRow>,
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
    let conventions = absorbers::conventions(study, published);
    let mut entries = text_values::inputs(study, published);
    entries.extend(frequencies::entries(study, published));
    entries.extend(modes::entries(study, published));
    entries.extend(von_mises::entries(whole, published)?);
    entries.extend(absorbers::entries(study, published, &conventions));
    let amplitudes = amplitudes::rows(study, published, calibration, &results.system)?;
    entries.extend(amplitudes::entries(study, published, &conventions, &amplitudes));
    entries.extend(text_values::peaks(study, published, &results.system)?);
    entries.extend(fatigue::entries(study, published));
    entries.extend(notches::entries(study, published));
    entries.extend(multiaxial::entries(study, published));
    entries.extend(predicted::entries(study, published, &results.system, fatigue::strength(published))?);
    entries.extend(chain::entries(study, published));
    let verdict = verdict::verdict(study, published, results, &entries, &amplitudes);
    Ok(Comparison { entries, amplitudes, verdict })
}
