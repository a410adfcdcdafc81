//! Absorbers whose rubber softens with its strain, at the strain that they have: one amplitude for all orders of a speed, by two rules.
//!
//! A law in frequency knows one amplitude; a ring under several orders has many. Its strain is taken as half the peak-to-peak of the synthesised twist, or as the root of twice its mean square: the truth
//! of a law in time is not known to lie between, but where the two agree the choice does not matter.

use super::DesignResult;
use crate::absorber::{Absorber, Mounted, at_strain};
use crate::input::Study;
use crate::numerics::C64;
use crate::numerics::maximise::maximise;
use crate::numerics::roots::roots;
use crate::objective::PeakFinder;
use crate::response::{Quantity, ResponseError, Work};
use rayon::prelude::*;

/// What is taken for the amplitude of several orders together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Rule {
    /// Half the peak-to-peak of their sum.
    HalfPeakToPeak,
    /// The amplitude of a sine of the same mean square.
    RootMeanSquare,
}

impl Rule {
    /// Both.
    pub(crate) const ALL: [Self; 2] = [Self::HalfPeakToPeak, Self::RootMeanSquare];

    /// The word used in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::HalfPeakToPeak => "half_peak_to_peak",
            Self::RootMeanSquare => "root_mean_square",
        }
    }
}

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

/// Strains looked at, by their logarithm.
const LEAST: f64 = 1e-6;
const MOST: f64 = 10.0;
const SAMPLES: usize = 40;

/// Every design with an absorber that says how it follows its strain, by both rules.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
pub(crate) fn strain<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
) -> Result<Vec<StrainOfDesign>, (&'d DesignResult, ResponseError)> {
    let of = |m: &Mounted| m.absorber.law().and_then(|l| l.material()).is_some_and(|m| m.amplitude.is_some());
    let followed = shown.iter().filter_map(|d| Some((*d, d.absorbers.iter().position(of)?)));
    let each = followed.flat_map(|(d, i)| Rule::ALL.map(|rule| (d, i, rule)));
    each.map(|(d, index, rule)| by_rule(study, finder, d, (index, rule)).map_err(|error| (d, error))).collect()
}

fn by_rule(study: &Study, finder: &PeakFinder, d: &DesignResult, (index, rule): (usize, Rule)) -> Result<StrainOfDesign, ResponseError> {
    let at = |speed_rpm: f64| at(study, finder, (&d.absorbers, index), rule, speed_rpm);
    let points = finder.grid.speed_rpm.par_iter().map(|s| at(*s)).collect::<Result<Vec<StrainAt>, _>>()?;
    let best = (0..points.len()).fold(0, |m, i| if points[i].twist > points[m].twist { i } else { m });
    let mut peak = points[best].clone();
    if finder.refine {
        let (low, high) = (points[best.saturating_sub(1)].speed_rpm, points[(best + 1).min(points.len() - 1)].speed_rpm);
        if low < high {
            let (speed, twist) = maximise(low, high, |speed| at(speed).map(|p| p.twist))?;
            if twist > peak.twist {
                peak = at(speed)?;
            }
        }
    }
    Ok(StrainOfDesign { design: d.name.clone(), absorber: index, rule, points, peak })
}

/// The design with one absorber at an amplitude of strain.
fn strained(design: &[Mounted], index: usize, strain: f64) -> Vec<Mounted> {
    let mut other = design.to_vec();
    if let Absorber::Ring(law) = &design[index].absorber {
        other[index].absorber = Absorber::Ring(at_strain(law, strain));
    }
    other
}

fn at(
    study: &Study,
    finder: &PeakFinder,
    (design, index): (&[Mounted], usize),
    rule: Rule,
    speed_rpm: f64,
) -> Result<StrainAt, ResponseError> {
    let law = design[index].absorber.law();
    let per_twist = law.and_then(|l| l.material()).and_then(|m| m.geometry).map_or(0.0, |g| g.strain_per_twist());
    let phasors = |strain: f64, quantity: Quantity| -> Result<Vec<C64>, ResponseError> {
        let design = strained(design, index, strain);
        Ok(finder.direct.at_each(&design, &[quantity], &[speed_rpm], &mut Work::default())?.swap_remove(0))
    };
    let mut excess = |x: f64| -> Result<f64, ResponseError> {
        let ring = phasors(x.exp(), Quantity::RingTwist(index))?;
        let twist = match rule {
            Rule::HalfPeakToPeak => finder.synthesis(&ring)[0],
            Rule::RootMeanSquare => ring.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt(),
        };
        Ok(x - (per_twist * twist).max(LEAST).ln())
    };
    let strains: Vec<f64> = roots(LEAST.ln(), MOST.ln(), SAMPLES, &mut excess)?.into_iter().map(f64::exp).collect();
    let twist = finder.synthesis(&phasors(strains.first().copied().unwrap_or(MOST), study.twist)?)[0];
    Ok(StrainAt { speed_rpm, strains, twist })
}
