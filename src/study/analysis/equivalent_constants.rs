//! Whether a law would have to be as it is: the peak of a design whose laws are taken for constant springs and dampers, those that they are at the frequency of its largest order.

use super::DesignResult;
use crate::absorber::{Absorber, Mounted, Operating, Tuned};
use crate::input::{ResponseMethod, Study};
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{ResponseError, Work};
use crate::units::{HZ_PER_RAD_PER_S, RAD_PER_S_PER_RPM};
use rayon::prelude::*;

/// A design with a law that is no constant spring and damper.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SimplestLaw {
    /// Its name.
    pub design: String,
    /// Frequency of the constant values, Hz.
    pub hz: f64,
    /// Relative change of the peak twist with these.
    pub error: f64,
}

/// Of the designs that are shown, where the study leaves it to hartog how exactly a response is found.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
#[doc(hidden)]
pub fn simplest<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
) -> Result<Vec<SimplestLaw>, (&'d DesignResult, ResponseError)> {
    if study.method != ResponseMethod::Auto {
        return Ok(Vec::new());
    }
    let one = |d: &&'d DesignResult| of_design(study, finder, d).map_err(|error| (*d, error)).transpose();
    shown.par_iter().filter_map(one).collect()
}

fn of_design(study: &Study, finder: &PeakFinder, d: &DesignResult) -> Result<Option<SimplestLaw>, ResponseError> {
    let Some(peak) = d.twist else { return Ok(None) };
    let omega = finder.system.excitation.orders[peak.order].omega(peak.speed_rpm);
    let at = Operating { omega, shaft_speed: peak.speed_rpm * RAD_PER_S_PER_RPM };
    let constant = |m: &Mounted| -> Option<Absorber> {
        let law = m.absorber.law().filter(|law| law.spring_and_damper().is_none() && law.large_twist().is_none())?;
        let s = law.dynamic_stiffness(at);
        // a spring below zero is none: such a law is no spring and damper at any frequency
        let (stiffness, damping) = (s.re.max(0.0), s.im / omega);
        Some(Tuned { ring_inertia: law.ring_inertia(), stiffness, damping }.into())
    };
    let replaced: Vec<Mounted> =
        d.absorbers.iter().map(|m| Mounted { absorber: constant(m).unwrap_or_else(|| m.absorber.clone()), ..m.clone() }).collect();
    if replaced == d.absorbers {
        return Ok(None);
    }
    let measure = Measure::new(vec![study.twist], Over::Synthesis);
    let taken = finder.peak(&replaced, &measure, &mut Work::default())?.map_or(0.0, |p| p.value);
    Ok(Some(SimplestLaw { design: d.name.clone(), hz: omega * HZ_PER_RAD_PER_S, error: (taken / peak.value - 1.0).abs() }))
}
