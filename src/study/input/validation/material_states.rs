//! States of an absorber's material: what temperature and age make of its parameters.

pub(crate) use super::material_laws::Temperatures;
use super::material_laws::{celsius, cooling, kraus, law, strain_life};
use super::substances::{Substances, named, reaches};
use crate::absorber::construction::shape;
use crate::absorber::parameter::STIFFNESS;
use crate::absorber::{
    Cooling, Declaration, Factors, Follows, Geometry, Kraus, Material, Range, State, StrainLife, Substance, TYPES, TemperatureLaw, Thermal,
};
use crate::input::error::{At, Check};
use crate::input::schema::absorber::RawType;
use crate::input::schema::material_states::{RawAmplitude, RawGeometry, RawLife, RawMaterialStates, RawTemperatureLaw, RawTemperatures};
use crate::input::schema::study::{RawCondition, RawStudy};
use crate::units::M_PER_MM;
use std::sync::Arc;

/// What a study says of the material of an absorber.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MaterialSpec {
    /// How it follows temperature.
    pub temperature: Option<TemperatureLaw>,
    /// Factors on parameters when aged, by their keys.
    pub ageing: Vec<(&'static str, f64)>,
    /// What cools it.
    pub cooling: Option<Cooling>,
    /// What of it is sheared.
    pub geometry: Option<Geometry>,
    /// How it follows the amplitude of its strain.
    pub amplitude: Option<Kraus>,
    /// Cycles of that strain that it bears.
    pub life: Option<StrainLife>,
    /// Bounds of its properties by their keys.
    pub properties: Vec<(&'static str, (f64, f64))>,
    /// Compounds or oils that it may be.
    pub choices: Vec<Arc<Substance>>,
}

/// What materials are resolved against.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known<'a> {
    /// Of the study's conditions.
    pub temperatures: Temperatures,
    /// Compounds and oils that can be named.
    pub substances: &'a Substances,
}

/// No material changes more than this with temperature.
const LEAST_FACTOR: f64 = 1e-15;
const MOST_FACTOR: f64 = 1e15;

/// The temperatures of a study's conditions.
pub(super) fn of_conditions(check: &mut Check, study: &RawStudy) -> Temperatures {
    let temperatures = temperatures(check, study.temperatures.as_ref());
    check_conditions(check, study, temperatures);
    temperatures
}

fn temperatures(check: &mut Check, raw: Option<&RawTemperatures>) -> Temperatures {
    let Some(raw) = raw else { return Temperatures::default() };
    let [cold, hot] = [&raw.cold_c, &raw.hot_c].map(|t| t.as_ref().map(|t| celsius(check, t)));
    if let (Some(low), Some(high), Some(at)) = (cold, hot, &raw.hot_c)
        && high <= low
    {
        check.wrong(at, format!("found {high} °C, expected more than the {low} °C of `cold_c`"));
    }
    Temperatures { cold, hot }
}

/// All conditions that a study names.
pub(super) fn conditions(study: &RawStudy) -> impl Iterator<Item = &At<RawCondition>> {
    study.conditions.iter().chain(study.optimise.iter().flat_map(|o| &o.conditions)).flat_map(|l| l.get_ref())
}

/// Conditions that need what the study does not say.
fn check_conditions(check: &mut Check, study: &RawStudy, temperatures: Temperatures) {
    let designed = || study.design.iter().flat_map(|d| &d.absorber).filter_map(|a| a.material.as_ref());
    let optimised = || study.optimise.iter().flat_map(|o| o.absorber.get_ref()).flat_map(|a| a.material.values());
    let sold = || study.catalogue.iter().flat_map(|c| c.material.values());
    let materials = || designed().chain(optimised()).chain(sold());
    let said = materials().map(|m| (m.get_ref().temperature.is_some() || m.get_ref().of.is_some(), m.get_ref().ageing.is_some()));
    let measured =
        study.design.iter().flat_map(|d| &d.absorber).any(|a| matches!(&a.kind, RawType::Measured(m) if m.temperature_c.is_some()));
    let (warms, ages) = said.fold((false, false), |all, a| (all.0 || a.0, all.1 || a.1));
    let warms = warms || measured;
    if study.duty.is_empty() {
        let each = materials().filter_map(|m| m.get_ref().life.as_ref());
        each.for_each(|l| {
            check.wrong(
                l,
                "found how many cycles of strain a material bears, expected `duty = [...]` in the study, over which they are counted",
            )
        });
    }
    for raw in conditions(study) {
        let word = raw.get_ref().0.name();
        let (given, followed, key) = match raw.get_ref().0.material() {
            Some(State::Cold) => (temperatures.cold.is_some(), warms, "temperature"),
            Some(State::Hot) => (temperatures.hot.is_some(), warms, "temperature"),
            Some(State::Aged) => (true, ages, "ageing"),
            None => continue,
        };
        if !given {
            check.wrong(raw, format!("found condition `{word}` without its temperature, expected `temperatures = {{ {word}_c = … }}`"));
        } else if !followed {
            check.wrong(raw, format!("found condition `{word}`, expected an absorber whose `material` has `{key}`, which it changes"));
        }
    }
}

/// What is said of the material of a type; `sheared`: what of it is sheared where that is said beside it.
pub(super) fn material(
    check: &mut Check,
    raw: &RawMaterialStates,
    (declaration, sheared): (&'static Declaration, Option<Geometry>),
    Known { temperatures, substances }: Known,
) -> MaterialSpec {
    let choices = named(check, raw, declaration, substances);
    choices.iter().for_each(|s| reaches(check, raw, s, temperatures));
    let law = raw.temperature.as_ref().map(|raw| {
        let law = law(check, raw.get_ref());
        if declaration.parameters.iter().all(|p| p.follows == Follows::Nothing) {
            check.wrong(
                raw,
                format!(
                    "found how a material follows temperature, expected it with a type whose law does: `{}` is ideal",
                    declaration.name
                ),
            );
        }
        stiffness_of_rubber(check, raw, law, declaration);
        let (low, high) = law.range();
        for celsius in [temperatures.cold, temperatures.hot, Some(law.reference())].into_iter().flatten() {
            if !(low..=high).contains(&celsius) {
                let up_to = if high.is_finite() { format!("from {low} to {high}") } else { format!("from {low:.1}") };
                check.wrong(raw, format!("found {celsius} °C outside the range of this law, expected temperatures {up_to} °C"));
            } else if !(LEAST_FACTOR..=MOST_FACTOR).contains(&law.factor(celsius)) {
                let factor = law.factor(celsius);
                check.wrong(
                    raw,
                    format!("found a factor of {factor:e} at {celsius} °C, expected one from {LEAST_FACTOR:e} to {:e}", MOST_FACTOR),
                );
            }
        }
        law
    });
    let ageing = raw.ageing.as_ref().map_or_else(Vec::new, |raw| {
        raw.get_ref().iter().filter_map(|(key, value)| Some((aged_key(check, key, value, declaration)?, check.positive(value)))).collect()
    });
    let laws: Vec<TemperatureLaw> = law.iter().copied().chain(choices.iter().map(|s| s.temperature)).collect();
    let limits: Vec<f64> = choices.iter().map(|s| s.limit).collect();
    let cooling = raw.cooling.as_ref().and_then(|c| cooling(check, c, (&laws, &limits), declaration));
    if let (Some(at), Some(_)) = (&raw.geometry, sheared) {
        check.wrong(at, "found what is sheared a second time, expected `geometry` in the [[catalogue]] or in its materials");
    }
    if let Some(at) = &raw.geometry
        && shape(declaration).is_some_and(|s| !s.medium.is_sheared())
    {
        check.wrong(at, format!("found what is sheared of `{}`, expected nothing: its dimensions say what carries it", declaration.name));
    }
    let geometry = raw.geometry.as_ref().and_then(|g| geometry(check, g)).or(sheared);
    let amplitude = raw.amplitude.as_ref().map(|a| amplitude(check, a, (declaration, geometry)));
    let life = raw.life.as_ref().map(|l| life(check, l, geometry));
    MaterialSpec { temperature: law, ageing, cooling, geometry, amplitude, life, properties: Vec::new(), choices }
}

/// Types whose law follows temperature by its relaxation times, as shifts of frequency are meant.
fn shifted() -> String {
    let by_frequency = |t: &&Declaration| t.parameters.iter().any(|p| p.follows != Follows::Nothing) && !t.stiffness_follows();
    TYPES.iter().copied().filter(by_frequency).map(|t| format!("`{}`", t.name)).chain(["`prony`".to_owned()]).collect::<Vec<_>>().join(", ")
}

/// The factor of WLF and Arrhenius shifts frequency, that of an oil is one of viscosity: on a stiffness that is the same at every frequency neither means anything.
fn stiffness_of_rubber(check: &mut Check, at: &At<RawTemperatureLaw>, law: TemperatureLaw, declaration: &Declaration) {
    let (what, of) = match law {
        TemperatureLaw::Wlf { .. } => ("`wlf`, a shift of frequency", "a law over frequency"),
        TemperatureLaw::Arrhenius { .. } => ("`arrhenius`, a shift of frequency", "a law over frequency"),
        TemperatureLaw::SiliconeOil { .. } => ("`silicone_oil`, a change of viscosity", "an oil"),
        TemperatureLaw::Exponential { .. } => return,
    };
    if declaration.stiffness_follows() {
        check.wrong_with_help(
            at,
            format!("found {what}, for `{}`, whose stiffness is the same at every frequency, expected it with {of}: {}", declaration.name, shifted()),
            "a ring of rubber with such a law is `fractional_zener` or `fractional_kelvin`; for `rubber`, `exponential = { per_k = …, reference_c = …, between_c = […] }` is the share by which a stiffness falls per kelvin, as catalogues give it",
        );
    }
}

/// What says of a ring on measured values how it follows temperature, strain and heat: its table does, and nothing else may. False where a mistake was found.
pub(super) fn of_measured(check: &mut Check, raw: &RawMaterialStates) -> bool {
    let before = check.mistakes.len();
    const HELP: &str = "`hartog fit` makes a type with a law of temperature of such a table, and prints its lines for a study; with that, `cooling` finds the temperature that is reached";
    if let Some(at) = &raw.temperature {
        check.wrong_with_help(
            at,
            "found a law of temperature for `measured`, expected none: its table holds the temperatures it was measured at",
            HELP,
        );
    }
    if let Some(at) = &raw.cooling {
        check.wrong_with_help(
            at,
            "found `cooling` for `measured`, expected none: a balance of heat needs a law of temperature, and of `measured` only the stiffness at `temperature_c` and at the temperatures of conditions is read from its table",
            HELP,
        );
    }
    if let Some(at) = &raw.amplitude {
        check.wrong(at, "found how rubber follows its strain for `measured`, expected none: its table is of the strain it was measured at");
    }
    check.mistakes.len() == before
}

/// A parameter that may age: any but the ring, as long as no factor leads out of its range.
fn aged_key(check: &mut Check, key: &str, at: &At<f64>, declaration: &'static Declaration) -> Option<&'static str> {
    let may = |p: &&crate::absorber::Parameter| matches!(p.range, Range::Positive | Range::NotNegative);
    let known: Vec<&'static str> = declaration.parameters.iter().skip(1).filter(may).map(|p| p.key).collect();
    let found = known.iter().find(|k| **k == key).copied();
    if found.is_none() {
        check.wrong(at, format!("found a factor on `{key}`, expected one on {}", known.join(", ")));
    }
    found
}

/// What is sheared, in m.
pub(super) fn geometry(check: &mut Check, at: &At<RawGeometry>) -> Option<Geometry> {
    let mut length = |x: &At<f64>| M_PER_MM * check.positive(x);
    let found = match at.get_ref() {
        RawGeometry::Sleeve(s) => Geometry::Sleeve {
            inner: 0.5 * length(&s.inner_diameter_mm),
            outer: 0.5 * length(&s.outer_diameter_mm),
            length: length(&s.length_mm),
        },
        RawGeometry::Faces(f) => Geometry::Faces {
            inner: 0.5 * length(&f.inner_diameter_mm),
            outer: 0.5 * length(&f.outer_diameter_mm),
            thickness: length(&f.thickness_mm),
            count: check.positive(&f.count),
        },
        RawGeometry::Wedges(w) => Geometry::Wedges {
            inner: 0.5 * length(&w.inner_diameter_mm),
            outer: 0.5 * length(&w.outer_diameter_mm),
            slope: check.positive(&w.thickness_over_radius),
            count: check.positive(&w.count),
        },
        RawGeometry::Gap(g) => Geometry::Gap {
            inner: 0.5 * length(&g.inner_diameter_mm),
            outer: 0.5 * length(&g.outer_diameter_mm),
            width: length(&g.width_mm),
            gap: length(&g.gap_mm),
        },
    };
    let (Geometry::Sleeve { inner, outer, .. }
    | Geometry::Faces { inner, outer, .. }
    | Geometry::Wedges { inner, outer, .. }
    | Geometry::Gap { inner, outer, .. }) = found;
    if inner >= outer {
        check.wrong(at, "found an inner diameter that is not below the outer one, expected room between them");
        return None;
    }
    if let Geometry::Gap { gap, width, .. } = found
        && gap >= inner.min(width)
    {
        check.wrong(at, "found a gap as large as the ring, expected one below its bore's radius and its width");
        return None;
    }
    Some(found)
}

/// How the rubber of a type follows the amplitude of the strain that its geometry tells.
fn amplitude(check: &mut Check, at: &At<RawAmplitude>, (declaration, geometry): (&Declaration, Option<Geometry>)) -> Kraus {
    let RawAmplitude::Kraus(raw) = at.get_ref();
    if declaration.index(STIFFNESS.key).is_none_or(|i| declaration.parameters[i].follows == Follows::Nothing) {
        let found = format!(
            "found how the stiffness of filled rubber follows its strain, expected it with `type.rubber`, not with `{}`",
            declaration.name
        );
        check.wrong(at, found);
    }
    if geometry.is_none() {
        check.wrong(at, "found how rubber follows its strain, expected `geometry` beside it, which tells the strain of a twist");
    }
    kraus(check, raw)
}

/// Cycles of the strain that the geometry tells.
fn life(check: &mut Check, at: &At<RawLife>, geometry: Option<Geometry>) -> StrainLife {
    let raw = at.get_ref();
    if geometry.is_none() {
        check.wrong(
            at,
            "found how many cycles of strain a material bears, expected `geometry` beside it, which tells the strain of a twist",
        );
    }
    strain_life(check, raw)
}

impl MaterialSpec {
    /// What is known of it where a type is made of it.
    pub(crate) fn of_type(&self, declaration: &Declaration, substance: Option<&Arc<Substance>>, temperatures: Temperatures) -> Material {
        let temperature = self.temperature.or(substance.map(|s| s.temperature));
        let mut states = Vec::new();
        for (state, celsius) in [(State::Cold, temperatures.cold), (State::Hot, temperatures.hot)] {
            let (Some(law), Some(celsius)) = (&temperature, celsius) else { continue };
            states.push(Factors { state, factors: declaration.followed(law.factor(celsius)) });
        }
        if !self.ageing.is_empty() {
            let ageing_factor = |key: &str| self.ageing.iter().find(|a| a.0 == key).map_or(1.0, |a| a.1);
            states.push(Factors { state: State::Aged, factors: declaration.parameters.iter().map(|p| ageing_factor(p.key)).collect() });
        }
        let limit = |cooling: Cooling| Cooling { limit: substance.map_or(cooling.limit, |s| s.limit.min(cooling.limit)), ..cooling };
        let thermal = temperature.zip(self.cooling).map(|(law, cooling)| Thermal { law, cooling: limit(cooling) });
        let life = self.life.or(substance.and_then(|s| s.life));
        Material { states, thermal, geometry: self.geometry, amplitude: self.amplitude, life, substance: substance.cloned() }
    }
}
