//! Absorbers whose rubber softens with its strain, at the strain that they have: one amplitude for all orders of a speed, by two rules.
//!
//! A law in frequency knows one amplitude; a ring under several orders has many. Its strain is taken as half the peak-to-peak of the synthesised twist, or as the root of twice its mean square: the truth
//! of a law in time is not known to lie between, but where the two agree the choice does not matter. Where something cools the absorber, its temperature is the one reached from cold.

use super::DesignResult;
use crate::input::Study;
use crate::numerics::maximise::maximise;
use crate::objective::PeakFinder;
use crate::response::operation::{AtSpeed, Follower, Rule};
use crate::response::{Hosts, ResponseError};
use rayon::prelude::*;

/// A design at one speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct StrainAt {
    /// rpm.
    pub speed_rpm: f64,
    /// All strains that agree with themselves, ascending; the lowest is met from rest.
    pub strains: Vec<f64>,
    /// Half peak-to-peak twist that the study reports, at the lowest, rad.
    pub twist: f64,
}

/// A design by one rule.
#[derive(Debug, Clone, serde::Serialize)]
pub struct StrainOfDesign {
    /// Its name.
    pub design: String,
    /// Index of the absorber.
    pub absorber: usize,
    /// The rule.
    pub rule: Rule,
    /// By speed.
    pub points: Vec<StrainAt>,
    /// Refined between the speeds.
    pub peak: StrainAt,
}

/// Every design with an absorber that says how it follows its strain, by both rules.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
#[doc(hidden)]
pub fn strain<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
) -> Result<Vec<StrainOfDesign>, (&'d DesignResult, ResponseError)> {
    let followed = shown.iter().filter_map(|d| Some((*d, Follower::of(&d.absorbers, |m| m.amplitude.is_some())?)));
    let followed: Vec<_> = followed.collect();
    let hosts = Hosts::of(&finder.direct, study.twist, followed.iter().map(|f| f.1.design));
    let each = followed.into_iter().flat_map(|(d, of)| Rule::ALL.map(|rule| (d, of.clone(), rule)));
    each.map(|(d, of, rule)| by_rule(study, finder, &hosts, d, (&of, rule)).map_err(|error| (d, error))).collect()
}

fn by_rule(
    study: &Study,
    finder: &PeakFinder,
    hosts: &Hosts,
    d: &DesignResult,
    (of, rule): (&Follower, Rule),
) -> Result<StrainOfDesign, ResponseError> {
    let points = finder.grid.speed_rpm.par_iter().enumerate();
    let points = points.map(|(i, s)| at(study, finder, (of, rule), *s, Some((hosts, i)))).collect::<Result<Vec<StrainAt>, _>>()?;
    let best = (0..points.len()).fold(0, |m, i| if points[i].twist > points[m].twist { i } else { m });
    let mut peak = points[best].clone();
    let strain_at = |speed_rpm: f64| at(study, finder, (of, rule), speed_rpm, None);
    if finder.refine {
        let (low, high) = (points[best.saturating_sub(1)].speed_rpm, points[(best + 1).min(points.len() - 1)].speed_rpm);
        if low < high {
            let (speed, twist) = maximise(low, high, |speed| strain_at(speed).map(|p| p.twist))?;
            if twist > peak.twist {
                peak = strain_at(speed)?;
            }
        }
    }
    Ok(StrainOfDesign { design: d.name.clone(), absorber: of.index, rule, points, peak })
}

fn at(
    study: &Study,
    finder: &PeakFinder,
    (of, rule): (&Follower, Rule),
    speed_rpm: f64,
    known: Option<(&Hosts, usize)>,
) -> Result<StrainAt, ResponseError> {
    let own = AtSpeed::new((&finder.direct, &finder.synthesiser), of, rule, speed_rpm, known);
    let celsius = own.celsius()?;
    let strains = own.strains(celsius)?;
    let phasors = own.output(&own.at(celsius)?, study.twist)?;
    Ok(StrainAt { speed_rpm, strains, twist: finder.synthesis(&phasors)[0] })
}
