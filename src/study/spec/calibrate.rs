//! Inputs to be fitted to published or measured amplitudes.

use super::{DesignSpec, Study};
use crate::chain::{Chain, Modes};
use crate::engine::{Engine, Pressure, Source};
use crate::study::input_error::{At, Check};
use crate::study::published::Published;
use crate::study::raw::study::{RawCalibrate, RawExcluded, RawRange};
use crate::units::PA_PER_BAR;

/// An input of the model that can be fitted; values are in the unit of its key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    pub fn changes_torque(self) -> bool {
        !matches!(self, Self::ThrowDamping | Self::ShaftDamping | Self::ShaftLossFactor)
    }

    /// Values that make sense.
    fn range(self) -> (f64, f64) {
        match self {
            Self::PressureScale => (1e-6, 5.0),
            Self::CompressionRatio => (1.5, 50.0),
            Self::HeatCapacityRatio => (1.05, 1.67),
            Self::Boost => (1e-6, 100.0),
            Self::BurnStart => (-90.0, 90.0),
            Self::BurnDuration => (1.0, 170.0),
            Self::WiebeExponent => (0.1, 10.0),
            Self::ThrowDamping | Self::ShaftDamping => (0.0, 1e9),
            Self::ShaftLossFactor => (0.0, 1.0),
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

    /// Whether the chain has values of this input other than their mean.
    fn varies(self, chain: &Chain, mean: f64) -> bool {
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
    fn apply(self, engine: &mut Engine, chain: &mut Chain, value: f64) {
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

impl Study {
    /// The study with other values of some inputs, each in the unit of its key.
    #[must_use]
    pub fn with_inputs(&self, values: &[(Input, f64)]) -> Self {
        let mut study = self.clone();
        for (input, value) in values {
            input.apply(&mut study.engine, &mut study.chain, *value);
        }
        if values.iter().any(|(input, _)| !input.changes_torque()) {
            study.modes = Modes::new(&study.chain);
        }
        study
    }
}

/// An input free between bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeInput {
    /// Which.
    pub input: Input,
    /// In the unit of its key.
    pub lower: f64,
    /// Above `lower`.
    pub upper: f64,
    /// Value in the engine file; of dampings the mean.
    pub start: f64,
    /// Whether that is a mean of different values.
    pub varies: bool,
}

/// What to calibrate, against which rows of the published amplitudes.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrateSpec {
    /// At least one.
    pub inputs: Vec<FreeInput>,
    /// Rows fitted, indices of [`Published::amplitudes`]; at least as many as inputs.
    pub rows: Vec<usize>,
    /// Rows set aside by name.
    pub excluded: Vec<usize>,
    /// Inputs that were chosen by hand with the published rows in view, and are held: named in the list of what was tuned.
    pub by_hand: Vec<(Input, f64)>,
}

pub fn resolve(
    check: &mut Check,
    at: &At<RawCalibrate>,
    published: Option<&Published>,
    designs: &[DesignSpec],
    engine: &Engine,
    chain: &Chain,
) -> Option<CalibrateSpec> {
    let raw = at.get_ref();
    let before = check.mistakes.len();
    let amplitudes = published.map_or(&[][..], |p| &p.amplitudes);
    if amplitudes.iter().all(|a| a.amplitude.is_none()) {
        check.wrong(&raw.designs, "found [calibrate] without published amplitudes, expected `amplitudes` in [published]");
        return None;
    }
    let mut chosen = Vec::new();
    for name in raw.designs.get_ref() {
        match designs.iter().position(|d| d.name == *name.get_ref()) {
            None => {
                let known: Vec<&str> = designs.iter().map(|d| d.name.as_str()).collect();
                check.wrong(name, format!("found design `{}`, expected one of the study: {}", name.get_ref(), known.join(", ")));
            }
            Some(d) if chosen.contains(&d) => check.wrong(name, "found a design a second time, expected each once"),
            Some(d) => chosen.push(d),
        }
    }
    let excluded = raw
        .exclude
        .iter()
        .enumerate()
        .filter_map(|(i, e)| {
            let x = e.get_ref();
            let key = |e: &RawExcluded| (e.design.get_ref().clone(), e.order.get_ref().to_bits(), e.speed_rpm.get_ref().to_bits());
            let repeated = raw.exclude[..i].iter().any(|o| key(o.get_ref()) == key(x));
            let found = amplitudes.iter().position(|a| {
                designs[a.design].name == *x.design.get_ref()
                    && a.order.value() == *x.order.get_ref()
                    && a.speed_rpm == *x.speed_rpm.get_ref()
            });
            if repeated {
                check.wrong(e, "found an amplitude to exclude a second time, expected each once");
            }
            if found.is_none() {
                check.wrong(e, "found no published amplitude with this design, order and speed, expected one to exclude");
            }
            found
        })
        .collect::<Vec<_>>();
    let inputs = free_inputs(check, raw, engine, chain);
    let by_hand = by_hand(check, raw, &inputs, engine, chain);
    let fitted = |i: &usize| chosen.contains(&amplitudes[*i].design) && amplitudes[*i].amplitude.is_some() && !excluded.contains(i);
    let rows: Vec<usize> = (0..amplitudes.len()).filter(fitted).collect();
    if check.mistakes.len() > before {
        // what follows from a mistake is not another one
        return None;
    }
    if inputs.is_empty() {
        let known: Vec<&str> = Input::ALL.iter().map(|i| i.key()).collect();
        check.wrong(
            &raw.designs,
            format!("found no input to calibrate, expected at least one of {}, each with `between`", known.join(", ")),
        );
    } else if rows.len() < inputs.len() {
        check.wrong(
            &raw.designs,
            format!(
                "found {} inputs for {} published amplitude(s) of these designs, expected at least as many amplitudes",
                inputs.len(),
                rows.len()
            ),
        );
    }
    Some(CalibrateSpec { inputs, rows, excluded, by_hand })
}

fn free_inputs(check: &mut Check, raw: &RawCalibrate, engine: &Engine, chain: &Chain) -> Vec<FreeInput> {
    let ranges = [
        &raw.pressure_scale,
        &raw.compression_ratio,
        &raw.heat_capacity_ratio,
        &raw.boost_bar,
        &raw.burn_start_deg,
        &raw.burn_duration_deg,
        &raw.wiebe_exponent,
        &raw.throw_damping_n_m_s_per_rad,
        &raw.shaft_damping_n_m_s_per_rad,
        &raw.shaft_loss_factor,
    ];
    let mut inputs: Vec<FreeInput> = Vec::new();
    for (input, range) in Input::ALL.into_iter().zip(ranges) {
        let Some(range) = range else { continue };
        let Some(start) = input.value(engine, chain) else {
            check.wrong(range, format!("found `{}`, expected an input that this engine has", input.key()));
            continue;
        };
        let bounds = match range.get_ref() {
            RawRange::Between(pair) => pair,
            RawRange::Fixed(_) | RawRange::Each(_) => {
                check.wrong(range, "found another choice, expected `between = [lower, upper]`");
                continue;
            }
        };
        let [low, high] = bounds.get_ref().as_slice() else {
            check.wrong(bounds, format!("found {} values, expected two: a lower and an upper bound", bounds.get_ref().len()));
            continue;
        };
        let (least, most) = input.range();
        let expected = format!("a bound of `{}` from {least} to {most}", input.key());
        let (lower, upper) = (check.within(low, least..=most, &expected), check.within(high, least..=most, &expected));
        if upper <= lower {
            check.wrong(bounds, format!("found bounds {lower} and {upper}, expected the lower one first and below the upper one"));
        }
        inputs.push(FreeInput { input, lower, upper, start, varies: input.varies(chain, start) });
    }
    let last = |input: Input| {
        let free = inputs.iter().find(|f| f.input == input).map(|f| f.upper);
        free.or_else(|| input.value(engine, chain)).unwrap_or(0.0)
    };
    if let Some(range) = raw.burn_duration_deg.as_ref().or(raw.burn_start_deg.as_ref())
        && last(Input::BurnStart) + last(Input::BurnDuration) > 180.0
    {
        check.wrong(range, "found bounds that allow a burn beyond 180 degrees, expected its end before");
    }
    inputs
}

fn by_hand(check: &mut Check, raw: &RawCalibrate, free: &[FreeInput], engine: &Engine, chain: &Chain) -> Vec<(Input, f64)> {
    let mut list = Vec::new();
    for key in raw.tuned_by_hand.iter().flat_map(|k| k.get_ref()) {
        let input = Input::ALL.into_iter().find(|i| i.key() == key.get_ref());
        match input.and_then(|i| i.value(engine, chain).map(|v| (i, v))) {
            None => {
                let known: Vec<&str> = Input::ALL.iter().filter(|i| i.value(engine, chain).is_some()).map(|i| i.key()).collect();
                check.wrong(key, format!("found `{}`, expected an input of this engine: {}", key.get_ref(), known.join(", ")));
            }
            Some((i, _)) if free.iter().any(|f| f.input == i) => {
                check.wrong(key, format!("found `{}` among the fitted inputs as well, expected it in one place", key.get_ref()));
            }
            Some((i, _)) if list.iter().any(|(other, _)| *other == i) => {
                check.wrong(key, "found an input a second time, expected each once")
            }
            Some(held) => list.push(held),
        }
    }
    list
}
