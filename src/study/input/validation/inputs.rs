//! Inputs of the model that can be fitted: their keys, bounds and places.

use crate::drivetrain::{Chain, Modes};
use crate::engine::{Engine, Pressure, Source};
use crate::input::schema::bounds::{
    BURN_DURATION, BURN_START, Bounds, COMPRESSION_RATIO, FITTED_BOOST, FITTED_DAMPING, FITTED_LOSS_FACTOR, FITTED_PRESSURE_SCALE,
    HEAT_CAPACITY_RATIO, WIEBE_EXPONENT,
};
use crate::units::PA_PER_BAR;

/// An input of the model that can be fitted; values are in the unit of its key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Input {
    /// Level of the pressure: `pressure_scale` of an Otto cycle; of a Wiebe cycle a factor on its mean pressure (1: as in the file).
    PressureScale,
    /// Compression ratio.
    CompressionRatio,
    /// c_p/c_v.
    HeatCapacityRatio,
    /// Boost pressure, bar.
    Boost,
    /// Start of the burn, degrees from firing dead centre.
    BurnStart,
    /// Its duration, degrees.
    BurnDuration,
    /// Wiebe's exponent.
    WiebeExponent,
    /// Damping to ground of every throw, N m s/rad.
    ThrowDamping,
    /// Damping of every shaft, N m s/rad.
    ShaftDamping,
    /// Loss factor of every shaft.
    ShaftLossFactor,
}

impl Input {
    /// All inputs.
    pub const ALL: [Self; 10] = [
        Self::PressureScale,
        Self::CompressionRatio,
        Self::HeatCapacityRatio,
        Self::Boost,
        Self::BurnStart,
        Self::BurnDuration,
        Self::WiebeExponent,
        Self::ThrowDamping,
        Self::ShaftDamping,
        Self::ShaftLossFactor,
    ];

    /// Its key in a study, unit included.
    pub fn key(self) -> &'static str {
        match self {
            Self::PressureScale => "pressure_scale",
            Self::CompressionRatio => "compression_ratio",
            Self::HeatCapacityRatio => "heat_capacity_ratio",
            Self::Boost => "boost_bar",
            Self::BurnStart => "burn_start_deg",
            Self::BurnDuration => "burn_duration_deg",
            Self::WiebeExponent => "wiebe_exponent",
            Self::ThrowDamping => "throw_damping_n_m_s_per_rad",
            Self::ShaftDamping => "shaft_damping_n_m_s_per_rad",
            Self::ShaftLossFactor => "shaft_loss_factor",
        }
    }

    /// Whether it changes the torque, or else the chain.
    pub(crate) fn changes_torque(self) -> bool {
        !matches!(self, Self::ThrowDamping | Self::ShaftDamping | Self::ShaftLossFactor)
    }

    /// Values that make sense.
    pub(super) fn bounds(self) -> Bounds {
        match self {
            Self::PressureScale => FITTED_PRESSURE_SCALE,
            Self::CompressionRatio => COMPRESSION_RATIO,
            Self::HeatCapacityRatio => HEAT_CAPACITY_RATIO,
            Self::Boost => FITTED_BOOST,
            Self::BurnStart => BURN_START,
            Self::BurnDuration => BURN_DURATION,
            Self::WiebeExponent => WIEBE_EXPONENT,
            Self::ThrowDamping | Self::ShaftDamping => FITTED_DAMPING,
            Self::ShaftLossFactor => FITTED_LOSS_FACTOR,
        }
    }

    /// Value in a model (dampings: the mean); nothing where the model does not have this input.
    pub fn value(self, engine: &Engine, chain: &Chain) -> Option<f64> {
        let pressure = match &engine.source {
            Source::Cylinder { pressure, .. } => Some(pressure),
            Source::Harmonics(_) => None,
        };
        let throws: usize = chain.stations.iter().map(|s| s.throws.len()).sum();
        let shafts = chain.len() - 1;
        let mean = |sum: f64, n: usize| (n > 0).then(|| sum / n as f64);
        let links = &chain.stations[..shafts];
        match (self, pressure) {
            (Self::PressureScale, Some(Pressure::Otto(o))) => Some(o.pressure_scale),
            (Self::PressureScale, Some(Pressure::Wiebe(_))) => Some(1.0),
            (Self::CompressionRatio, Some(Pressure::Otto(o))) => Some(o.compression_ratio),
            (Self::CompressionRatio, Some(Pressure::Wiebe(w))) => Some(w.compression_ratio),
            (Self::HeatCapacityRatio, Some(Pressure::Otto(o))) => Some(o.heat_capacity_ratio),
            (Self::HeatCapacityRatio, Some(Pressure::Wiebe(w))) => Some(w.heat_capacity_ratio),
            (Self::Boost, Some(Pressure::Wiebe(w))) => Some(w.boost_pressure / PA_PER_BAR),
            (Self::BurnStart, Some(Pressure::Wiebe(w))) => Some(w.burn_start_deg),
            (Self::BurnDuration, Some(Pressure::Wiebe(w))) => Some(w.burn_duration_deg),
            (Self::WiebeExponent, Some(Pressure::Wiebe(w))) => Some(w.shape),
            (Self::ThrowDamping, _) => {
                mean(chain.stations.iter().filter(|s| !s.throws.is_empty()).map(|s| s.damping_to_ground).sum(), throws)
            }
            (Self::ShaftDamping, _) => mean(links.iter().map(|s| s.damping_to_next).sum(), shafts),
            (Self::ShaftLossFactor, _) => mean(links.iter().map(|s| s.loss_factor_to_next).sum(), shafts),
            _ => None,
        }
    }

    /// A size of this input below which it hardly acts: where the file has zero, searches go by it.
    pub(super) fn typical(self, chain: &Chain, modes: &Modes) -> f64 {
        const LIGHT: f64 = 0.01;
        let omega = modes.elastic().next().map_or(1.0, |m| modes.omega[m]);
        let mean = |sum: f64, n: usize| sum / n.max(1) as f64;
        match self {
            Self::ThrowDamping => LIGHT * omega * mean(chain.total_inertia(), chain.len()),
            Self::ShaftDamping => LIGHT / omega * mean(chain.stations.iter().map(|s| s.stiffness_to_next).sum(), chain.len()),
            Self::ShaftLossFactor => LIGHT,
            Self::BurnStart => 1.0,
            _ => 1e-3,
        }
    }

    /// Whether the chain has values of this input other than their mean.
    pub(super) fn varies(self, chain: &Chain, mean: f64) -> bool {
        let links = &chain.stations[..chain.len() - 1];
        let differs = |x: f64| (x - mean).abs() > 1e-9 * mean.abs();
        match self {
            Self::ThrowDamping => {
                let throws = chain.stations.iter().filter(|s| !s.throws.is_empty());
                throws.map(|s| s.damping_to_ground / s.throws.len() as f64).any(differs)
            }
            Self::ShaftDamping => links.iter().map(|s| s.damping_to_next).any(differs),
            Self::ShaftLossFactor => links.iter().map(|s| s.loss_factor_to_next).any(differs),
            _ => false,
        }
    }

    /// Puts a value into a model that has this input.
    pub(super) fn apply(self, engine: &mut Engine, chain: &mut Chain, value: f64) {
        let shafts = chain.len() - 1;
        match self {
            Self::ThrowDamping => {
                chain
                    .stations
                    .iter_mut()
                    .filter(|s| !s.throws.is_empty())
                    .for_each(|s| s.damping_to_ground = value * s.throws.len() as f64);
            }
            Self::ShaftDamping => chain.stations[..shafts].iter_mut().for_each(|s| s.damping_to_next = value),
            Self::ShaftLossFactor => chain.stations[..shafts].iter_mut().for_each(|s| s.loss_factor_to_next = value),
            _ => {
                let Source::Cylinder { pressure, .. } = &mut engine.source else { return };
                match (self, pressure) {
                    (Self::PressureScale, Pressure::Otto(o)) => o.pressure_scale = value,
                    (Self::PressureScale, Pressure::Wiebe(w)) => w.indicated_mean_pressure.iter_mut().for_each(|p| *p *= value),
                    (Self::CompressionRatio, Pressure::Otto(o)) => o.compression_ratio = value,
                    (Self::CompressionRatio, Pressure::Wiebe(w)) => w.compression_ratio = value,
                    (Self::HeatCapacityRatio, Pressure::Otto(o)) => o.heat_capacity_ratio = value,
                    (Self::HeatCapacityRatio, Pressure::Wiebe(w)) => w.heat_capacity_ratio = value,
                    (Self::Boost, Pressure::Wiebe(w)) => w.boost_pressure = value * PA_PER_BAR,
                    (Self::BurnStart, Pressure::Wiebe(w)) => w.burn_start_deg = value,
                    (Self::BurnDuration, Pressure::Wiebe(w)) => w.burn_duration_deg = value,
                    (Self::WiebeExponent, Pressure::Wiebe(w)) => w.shape = value,
                    _ => {}
                }
            }
        }
    }
}
