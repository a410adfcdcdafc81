//! An absorber at the temperature and strain that it has in operation: both depend on its motion, which depends on them.
//!
//! Temperature: F(T) = T - T0 - R P(T) = 0 with the temperature T0 of what surrounds the absorber and its resistance R to heat. F is negative at T0; a balance is stable where F rises through zero
//! (R dP/dT < 1), and from cold the lowest one is reached. Three are possible where heating moves the ring's resonance into an order. Strain: that at which the material's own twist makes it, one
//! for all orders of a speed. Where a material follows both, the power at each temperature is that at its lowest strain.

use super::host_receptance::{Followed, OpenLaw};
use super::{Direct, Hosts, Quantity, ResponseError};
use crate::absorber::{Law, Material, Mounted, Thermal, at_strain, at_temperature};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::roots::roots;
use crate::numerics::synthesis::Synthesiser;
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

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
    #[doc(hidden)]
    pub const ALL: [Self; 2] = [Self::HalfPeakToPeak, Self::RootMeanSquare];

    /// The word used in tables.
    #[doc(hidden)]
    pub fn name(self) -> &'static str {
        match self {
            Self::HalfPeakToPeak => "half_peak_to_peak",
            Self::RootMeanSquare => "root_mean_square",
        }
    }
}

/// A temperature in balance.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Balance {
    /// °C.
    pub celsius: f64,
    /// W.
    pub power: f64,
    /// Whether the absorber returns to it.
    pub stable: bool,
}

/// Temperatures and strains of a scan; strains by their logarithm.
const SAMPLES: usize = 40;
const LEAST_STRAIN: f64 = 1e-6;
#[doc(hidden)]
pub const MOST_STRAIN: f64 = 10.0;

/// An absorber of a design whose law follows its motion.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Follower<'a> {
    /// The design.
    pub design: &'a [Mounted],
    /// Index of the absorber.
    pub index: usize,
    /// Its law at the reference.
    pub law: Arc<dyn Law>,
}

impl<'a> Follower<'a> {
    /// The first absorber of a design whose material is as asked for.
    pub fn of(design: &'a [Mounted], asked: impl Fn(&Material) -> bool) -> Option<Self> {
        let law_of = |m: &Mounted| m.absorber.law().filter(|l| l.material().is_some_and(&asked)).cloned();
        design.iter().enumerate().find_map(|(index, m)| Some(Self { design, index, law: law_of(m)? }))
    }

    /// Absorber `index` of a design, where its material says what cools it.
    pub fn cooled(design: &'a [Mounted], index: usize) -> Option<Self> {
        let law = design.get(index)?.absorber.law()?;
        law.material().is_some_and(|m| m.thermal.is_some()).then(|| Self { design, index, law: law.clone() })
    }
}

/// Such an absorber at one speed.
#[doc(hidden)]
pub struct AtSpeed<'a> {
    open: OpenLaw<'a>,
    synthesiser: &'a Synthesiser,
    law: Arc<dyn Law>,
    speed_rpm: f64,
    rule: Rule,
}

impl<'a> AtSpeed<'a> {
    /// Of a design at a speed; `known`: hosts, and which speed of their grid this is.
    pub fn new(
        (direct, synthesiser): (&'a Direct<'a>, &'a Synthesiser),
        of: &Follower<'a>,
        rule: Rule,
        speed_rpm: f64,
        known: Option<(&'a Hosts, usize)>,
    ) -> Self {
        Self { open: OpenLaw::new(direct, (of.design, of.index), speed_rpm, known), synthesiser, law: of.law.clone(), speed_rpm, rule }
    }

    /// All strains between the least and the most that agree with themselves at a temperature (°C; where nothing is known of that, the reference), ascending; the lowest is met from rest.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn strains(&self, celsius: Option<f64>) -> Result<Vec<f64>, ResponseError> {
        let law = self.warmed(celsius);
        let per_twist = self.law.strain_per_twist().unwrap_or(0.0);
        let mut excess = |x: f64| -> Result<f64, ResponseError> {
            let ring = self.open.ring_twist(&at_strain(&law, x.exponential()))?;
            let twist = match self.rule {
                Rule::HalfPeakToPeak => self.synthesiser.extremes(&ring).half_peak_to_peak,
                Rule::RootMeanSquare => ring.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt(),
            };
            Ok(x - (per_twist * twist).max(LEAST_STRAIN).logarithm())
        };
        Ok(roots(LEAST_STRAIN.logarithm(), MOST_STRAIN.logarithm(), SAMPLES, &mut excess)?.into_iter().map(f64::exponential).collect())
    }

    /// At any temperature of its material, which is this.
    #[doc(hidden)]
    pub fn over_temperature(&self, thermal: Thermal) -> OverTemperature<'_> {
        let follows_strain = self.law.material().is_some_and(|m| m.amplitude.is_some());
        let quick = if follows_strain { None } else { self.open.followed(self.law.as_ref()) };
        OverTemperature { own: self, thermal, quick }
    }

    /// Power at a temperature, W.
    ///
    /// # Errors
    /// As [`Self::strains`].
    pub(crate) fn power_at(&self, celsius: f64) -> Result<f64, ResponseError> {
        let law = self.at(Some(celsius))?;
        self.open.power(&law)
    }

    /// Temperature that is reached from cold, °C: where it overheats, what the heat at the limit would make of it, which is above the limit; nothing where nothing cools it.
    ///
    /// # Errors
    /// As [`Self::strains`].
    pub fn reached(&self) -> Result<Option<f64>, ResponseError> {
        let Some(thermal) = self.law.material().and_then(|m| m.thermal) else { return Ok(None) };
        let (balances, at_limit) = self.over_temperature(thermal).balances()?;
        let (base, resistance) = thermal.cooling.at(self.speed_rpm * RAD_PER_S_PER_RPM);
        Ok(Some(balances.first().map_or(base + resistance * at_limit, |b| b.celsius)))
    }

    /// Temperature that is reached from cold, °C: the limit where it overheats, nothing where nothing cools it.
    ///
    /// # Errors
    /// As [`Self::strains`].
    pub fn celsius(&self) -> Result<Option<f64>, ResponseError> {
        let Some(thermal) = self.law.material().and_then(|m| m.thermal) else { return Ok(None) };
        let first = self.over_temperature(thermal).balances()?.0.first().map(|b| b.celsius);
        Ok(Some(first.unwrap_or(thermal.cooling.limit)))
    }

    /// The law at a temperature and the lowest strain there.
    ///
    /// # Errors
    /// As [`Self::strains`].
    pub fn at(&self, celsius: Option<f64>) -> Result<Arc<dyn Law>, ResponseError> {
        let law = self.warmed(celsius);
        if self.law.material().is_none_or(|m| m.amplitude.is_none()) {
            return Ok(law);
        }
        Ok(at_strain(&law, self.strains(celsius)?.first().copied().unwrap_or(MOST_STRAIN)))
    }

    /// A quantity of the whole design for each order, with a law for this absorber.
    ///
    /// # Errors
    /// As [`Self::strains`].
    pub fn output(&self, law: &Arc<dyn Law>, quantity: Quantity) -> Result<Vec<C64>, ResponseError> {
        self.open.output(law, quantity)
    }

    fn warmed(&self, celsius: Option<f64>) -> Arc<dyn Law> {
        celsius.map_or_else(|| self.law.clone(), |celsius| at_temperature(&self.law, celsius))
    }
}

/// Such an absorber at one speed, at any temperature.
#[doc(hidden)]
pub struct OverTemperature<'s> {
    own: &'s AtSpeed<'s>,
    thermal: Thermal,
    /// Where the law does not follow strain, and knows a quicker way.
    quick: Option<Followed<'s>>,
}

impl OverTemperature<'_> {
    /// All temperatures in balance up to the limit, ascending (none where it overheats), and the power at the limit, W.
    ///
    /// # Errors
    /// As [`AtSpeed::strains`].
    pub fn balances(&mut self) -> Result<(Vec<Balance>, f64), ResponseError> {
        let cooling = self.thermal.cooling;
        let (base, resistance) = cooling.at(self.own.speed_rpm * RAD_PER_S_PER_RPM);
        let mut missing = |celsius: f64| Ok(celsius - base - resistance * self.power(celsius)?);
        let found = roots(base, cooling.limit, SAMPLES, &mut missing)?;
        // F rises through every other zero, the first among them
        let balance = |(i, celsius): (usize, f64)| Ok(Balance { celsius, power: self.power(celsius)?, stable: i % 2 == 0 });
        let balances = found.into_iter().enumerate().map(balance).collect::<Result<_, _>>()?;
        Ok((balances, self.power(cooling.limit)?))
    }

    fn power(&mut self, celsius: f64) -> Result<f64, ResponseError> {
        let quick = self.quick.as_mut().map(|quick| quick.power(self.thermal.law.log_factor(celsius)));
        quick.filter(|power| power.is_finite()).map_or_else(|| self.own.power_at(celsius), Ok)
    }

    /// A quantity of the whole design for each order, at a temperature.
    ///
    /// # Errors
    /// As [`AtSpeed::strains`].
    pub fn output(&mut self, celsius: f64, quantity: Quantity) -> Result<Vec<C64>, ResponseError> {
        let quick = self.quick.as_mut().and_then(|quick| quick.output(self.thermal.law.log_factor(celsius), quantity));
        quick.map_or_else(|| self.own.output(&self.own.at(Some(celsius))?, quantity), Ok)
    }
}
