//! Temperatures of an absorber in balance over speed: the heat it dissipates, which depends on its temperature, against the heat that leaves it.

use super::DesignResult;
use crate::absorber::{Mounted, Thermal};
use crate::input::Study;
use crate::objective::PeakFinder;
use crate::response::operation::{AtSpeed, Balance, Follower, Rule};
use crate::response::{Hosts, ResponseError};
use rayon::prelude::*;

/// An absorber at one speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct HeatAt {
    /// rpm.
    pub speed_rpm: f64,
    /// All temperatures in balance up to the limit, ascending; none where it overheats.
    pub balances: Vec<Balance>,
    /// Half peak-to-peak twist that the study reports, at the lowest of them or at the limit, rad.
    pub twist: f64,
    /// Power at the limit, W.
    pub power_at_limit: f64,
}

/// The absorber of a design whose material follows temperature, over speed.
#[derive(Debug, Clone, serde::Serialize)]
pub struct HeatOfDesign {
    /// Its name.
    pub design: String,
    /// Index of the absorber.
    pub absorber: usize,
    /// What its material bears, °C.
    pub limit: f64,
    /// By speed.
    pub points: Vec<HeatAt>,
}

impl HeatOfDesign {
    /// Whether no temperature up to the limit is in balance at some speed.
    pub(crate) fn overheats(&self) -> bool {
        self.points.iter().any(|p| p.balances.is_empty())
    }
}

impl HeatAt {
    /// The temperature that is reached from cold; nothing where it overheats.
    #[doc(hidden)]
    pub fn cold_start(&self) -> Option<&Balance> {
        self.balances.first()
    }
}

/// Every design with an absorber that says what cools it.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
#[doc(hidden)]
pub fn heat<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
) -> Result<Vec<HeatOfDesign>, (&'d DesignResult, ResponseError)> {
    let cooled = shown.iter().filter(|d| Follower::of(&d.absorbers, |m| m.thermal.is_some()).is_some());
    let hosts = Hosts::of(&finder.direct, study.twist, cooled.map(|d| d.absorbers.as_slice()));
    let one = |d: &&'d DesignResult| of_design(study, finder, &hosts, (&d.name, &d.absorbers)).map_err(|error| (*d, error)).transpose();
    shown.iter().filter_map(one).collect()
}

/// A design, where one of its absorbers says what cools it.
///
/// # Errors
/// As [`heat`].
#[doc(hidden)]
pub fn of_design(
    study: &Study,
    finder: &PeakFinder,
    hosts: &Hosts,
    (name, design): (&str, &[Mounted]),
) -> Result<Option<HeatOfDesign>, ResponseError> {
    let Some(of) = Follower::of(design, |m| m.thermal.is_some()) else { return Ok(None) };
    let Some(thermal) = of.law.material().and_then(|m| m.thermal) else { return Ok(None) };
    let heat_at = |(i, speed): (usize, &f64)| at(study, finder, (&of, thermal), *speed, (hosts, i));
    let points = finder.grid.speed_rpm.par_iter().enumerate().map(heat_at).collect::<Result<_, _>>()?;
    Ok(Some(HeatOfDesign { design: name.to_owned(), absorber: of.index, limit: thermal.cooling.limit, points }))
}

fn at(
    study: &Study,
    finder: &PeakFinder,
    (of, thermal): (&Follower, Thermal),
    speed_rpm: f64,
    known: (&Hosts, usize),
) -> Result<HeatAt, ResponseError> {
    let own = AtSpeed::new((&finder.direct, &finder.synthesiser), of, Rule::HalfPeakToPeak, speed_rpm, Some(known));
    let mut over = own.over_temperature(thermal);
    let (balances, power_at_limit) = over.balances()?;
    let phasors = over.output(balances.first().map_or(thermal.cooling.limit, |b| b.celsius), study.twist)?;
    Ok(HeatAt { speed_rpm, balances, twist: finder.synthesis(&phasors)[0], power_at_limit })
}
