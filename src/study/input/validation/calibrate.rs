//! Inputs to be fitted to published or measured amplitudes.

use super::{DesignSpec, Input};
use crate::drivetrain::{Chain, Modes};
use crate::engine::Engine;
use crate::input::error::{At, Check};
use crate::input::published::Published;
use crate::input::schema::range::RawRange;
use crate::input::schema::study::{RawCalibrate, RawExcluded};

/// An input free between bounds.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
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
    /// Size below which it hardly acts.
    pub scale: f64,
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

pub(crate) fn resolve(
    check: &mut Check,
    at: &At<RawCalibrate>,
    published: Option<&Published>,
    designs: &[DesignSpec],
    engine: &Engine,
    (chain, modes): (&Chain, &Modes),
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
    let inputs = free_inputs(check, raw, engine, (chain, modes));
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

fn free_inputs(check: &mut Check, raw: &RawCalibrate, engine: &Engine, (chain, modes): (&Chain, &Modes)) -> Vec<FreeInput> {
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
        let allowed = input.bounds();
        let what = format!("a bound of `{}`", input.key());
        let [lower, upper] = [low, high].map(|bound| check.within_as(bound, &allowed, &what));
        if upper <= lower {
            check.wrong(bounds, format!("found bounds {lower} and {upper}, expected the lower one first and below the upper one"));
        }
        inputs.push(FreeInput {
            input,
            lower,
            upper,
            start,
            varies: input.varies(chain, start),
            scale: if start == 0.0 { input.typical(chain, modes) } else { start.abs() },
        });
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
