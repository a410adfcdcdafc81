//! Laws of materials as a study gives them, and what cools an absorber.

use crate::absorber::construction::shape;
use crate::absorber::{Cooling, Declaration, Kraus, StrainLife, TemperatureLaw, ToAir};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::{ACTIVATION, CYCLES, KRAUS_EXPONENT, KRAUS_RATIO, LIFE_EXPONENT, SHARE_PER_KELVIN, STRAIN, TEMPERATURE};
use crate::input::schema::material_states::{RawCooling, RawKraus, RawLife, RawTemperatureLaw, RawToAir};
use crate::units::{KELVIN_AT_0_C, M_PER_MM};

pub(super) fn celsius(check: &mut Check, raw: &At<f64>) -> f64 {
    check.within(raw, &TEMPERATURE)
}

/// What cools an absorber whose material follows temperature by a law.
pub(super) fn cooling(
    check: &mut Check,
    at: &At<RawCooling>,
    (laws, limits): (&[TemperatureLaw], &[f64]),
    declaration: &Declaration,
) -> Option<Cooling> {
    let raw = at.get_ref();
    if laws.is_empty() {
        check.wrong(at, "found `cooling` of a material of which nothing says how it follows temperature, expected `temperature` beside it");
        return None;
    }
    let to_air = match &raw.to_air {
        RawToAir::WPerK(g) => ToAir::Given(check.positive(g)),
        RawToAir::Disc(disc) => {
            let [diameter, width] = [&disc.diameter_mm, &disc.width_mm].map(|x| M_PER_MM * check.positive(x));
            ToAir::Disc { radius: 0.5 * diameter, width }
        }
        RawToAir::OwnDisc(own) => {
            if !own.get_ref() {
                check.wrong(own, "found false, expected true, or another kind of `to_air`");
            }
            if shape(declaration).is_none() {
                check.wrong(
                    own,
                    format!(
                        "found the disc of `{}`, expected `disc = {{ diameter_mm = …, width_mm = … }}`: it has no dimensions",
                        declaration.name
                    ),
                );
            }
            ToAir::Own { radius: 0.0, width: 0.0 }
        }
    };
    let [air, hub] = [&raw.air_c, &raw.hub_c].map(|t| celsius(check, t));
    let given = raw.limit_c.as_ref().map(|t| celsius(check, t));
    if given.is_none() && limits.is_empty() {
        check.wrong(at, "found `cooling` without `limit_c`, expected the temperature that the material bears");
        return None;
    }
    // of several compounds each has its own
    let limit = given.unwrap_or_else(|| limits.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let least = given.unwrap_or_else(|| limits.iter().copied().fold(f64::INFINITY, f64::min));
    if least <= air.max(hub) {
        let round = air.max(hub);
        match &raw.limit_c {
            Some(at) => check.wrong(at, format!("found a limit of {least} °C, expected more than the {round} °C round the absorber")),
            None => check.wrong(
                &raw.hub_c,
                format!("found {round} °C round the absorber, expected less than the {least} °C that a compound or oil of `of` bears"),
            ),
        }
    }
    let places = [(air, &raw.air_c), (hub, &raw.hub_c)].into_iter().chain(given.zip(raw.limit_c.as_ref()));
    for ((t, at), law) in places.flat_map(|p| laws.iter().map(move |law| (p, law))) {
        let (low, high) = law.range();
        if !(low..=high).contains(&t) {
            let words = format!("found {t} °C outside the range of the material's law of temperature, {low:.1} to {high} °C");
            check.wrong_with_help(at, words, "a law says nothing of temperatures beyond its range (`between_c` of `temperature.exponential`): a lower temperature here, or a law that was measured farther");
        }
    }
    Some(Cooling { air, hub, to_air, to_hub: check.not_negative(&raw.to_hub_w_per_k), limit })
}

/// Temperatures of the conditions `cold` and `hot`, °C.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Temperatures {
    /// Of `cold`.
    pub cold: Option<f64>,
    /// Of `hot`.
    pub hot: Option<f64>,
}

/// How a material follows temperature.
pub(super) fn law(check: &mut Check, raw: &RawTemperatureLaw) -> TemperatureLaw {
    match raw {
        RawTemperatureLaw::Wlf(w) => {
            TemperatureLaw::Wlf { c1: check.positive(&w.c1), c2: check.positive(&w.c2_k), reference: celsius(check, &w.reference_c) }
        }
        RawTemperatureLaw::Arrhenius(a) => TemperatureLaw::Arrhenius {
            activation: 1e3 * check.within(&a.activation_kj_per_mol, &ACTIVATION),
            reference: celsius(check, &a.reference_c),
        },
        RawTemperatureLaw::Exponential(e) => {
            let ends: Vec<f64> = e.between_c.get_ref().iter().map(|t| celsius(check, t)).collect();
            let between = match ends[..] {
                [low, high] if low < high => (low, high),
                _ => {
                    check.wrong(&e.between_c, "expected the lowest and the highest temperature that the factor was measured at");
                    (-KELVIN_AT_0_C, f64::INFINITY)
                }
            };
            let per_k = check.within(&e.per_k, &SHARE_PER_KELVIN);
            TemperatureLaw::Exponential { per_k, reference: celsius(check, &e.reference_c), between }
        }
        RawTemperatureLaw::SiliconeOil(o) => TemperatureLaw::SiliconeOil { reference: celsius(check, &o.reference_c) },
    }
}

/// The law of Kraus.
pub(super) fn kraus(check: &mut Check, raw: &RawKraus) -> Kraus {
    Kraus {
        storage_ratio: check.within(&raw.storage_ratio, &KRAUS_RATIO),
        loss_ratio: check.within(&raw.loss_ratio, &KRAUS_RATIO),
        strain: check.within(&raw.critical_strain, &STRAIN),
        exponent: check.within(&raw.exponent, &KRAUS_EXPONENT),
        reference: check.within(&raw.reference_strain, &STRAIN),
    }
}

/// Cycles of strain that a material bears.
pub(super) fn strain_life(check: &mut Check, raw: &RawLife) -> StrainLife {
    StrainLife {
        strain: check.within(&raw.reference_strain, &STRAIN),
        cycles: check.within(&raw.reference_cycles, &CYCLES),
        exponent: check.within(&raw.exponent, &LIFE_EXPONENT),
    }
}
