//! Given designs, and what absorbers of designs and families share.

use super::material_states::{Known, Temperatures, material, of_measured};
use super::named::{station, table};
use super::rooms::made;
use super::substances::Substances;
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::construction::shape;
use crate::absorber::measured::Measured;
use crate::absorber::{Absorber, Branch, Declaration, Host, Law, Mounted, Parameter, Prony, WithMaterial, types};
use crate::drivetrain::{Chain, Modes};
use crate::input::error::{At, Check};
use crate::input::letters::fault;
use crate::input::schema::absorber::{RawAbsorber, RawEngineInertia, RawMeasured, RawOn, RawProny, RawSeeded, RawType};
use crate::input::schema::bounds::Bounds;
use crate::input::schema::material_states::RawMaterialStates;
use crate::input::schema::study::{RawDesign, RawStudy};
use crate::input::tables::measured_law;
use crate::input::tables::not_plain;
use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

/// A named design of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignSpec {
    /// Unique in the study.
    pub name: String,
    /// None, one or more.
    pub absorbers: Vec<Mounted>,
}

/// What absorbers are resolved against.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reaches<'a> {
    pub chain: &'a Chain,
    pub modes: &'a Modes,
    pub temperatures: Temperatures,
    pub substances: &'a Substances,
    /// Folder of the study.
    pub folder: &'a Path,
    /// Lowest and highest frequency of the torque, Hz.
    pub frequencies_hz: (f64, f64),
}

pub(crate) fn resolve(check: &mut Check, study: &RawStudy, of: Reaches) -> Vec<DesignSpec> {
    let chain = of.chain;
    let mut names = HashSet::new();
    let mut designs = Vec::new();
    for raw in &study.design {
        let name = raw.name.get_ref();
        if !names.insert(name.clone()) {
            check.wrong(&raw.name, format!("found design `{name}` a second time, expected different names"));
        }
        check.name(&raw.name);
        if let Some(found) = not_plain(name).filter(|_| fault(name).is_none()) {
            check.wrong_with_help(&raw.name, found, "designs name files and rows; `optimum_…` are hartog's own");
        }
        let hosts = hosts(check, chain, &raw.absorber.iter().map(|a| (a.name.as_ref(), &a.on)).collect::<Vec<_>>());
        only_one_follows(check, raw.absorber.iter().map(|a| a.material.iter().map(At::get_ref).collect()));
        let place = |i: usize| Some((*hosts.get(i)?.as_ref()?, root(&hosts, i)?));
        let absorbers: Vec<Mounted> = raw.absorber.iter().enumerate().filter_map(|(i, a)| absorber(check, a, place(i), of)).collect();
        if absorbers.len() == raw.absorber.len() {
            one_of_large_twist(check, raw, &absorbers);
        }
        designs.push(DesignSpec { name: name.clone(), absorbers });
    }
    designs
}

/// What can be asked of absorbers whose heat is not balanced.
pub(crate) const HEAT_OF_OTHERS: &str =
    "the others stay at the reference of their material; `dissipated_power = { absorber = …, max_w = … }` limits their heat";

/// Temperature and strain that agree with themselves are sought of one absorber of a design; given are the materials of each.
pub(super) fn only_one_follows<'r>(check: &mut Check, absorbers: impl Iterator<Item = Vec<&'r RawMaterialStates>>) {
    for material in absorbers.filter_map(|a| a.into_iter().find(|m| m.cooling.is_some() || m.amplitude.is_some())).skip(1) {
        let what = "of a second absorber of a design, expected one absorber with `cooling` or `amplitude`: temperature and strain are balanced for one at a time";
        match (&material.cooling, &material.amplitude) {
            (Some(cooling), _) => check.wrong_with_help(cooling, format!("found `cooling` {what}"), HEAT_OF_OTHERS),
            (None, Some(amplitude)) => check.wrong_with_help(amplitude, format!("found `amplitude` {what}"), HEAT_OF_OTHERS),
            (None, None) => {}
        }
    }
}

/// The balance of harmonics is that of one absorber, between the chain and nothing else.
fn one_of_large_twist(check: &mut Check, raw: &RawDesign, absorbers: &[Mounted]) {
    let large = |m: &Mounted| m.absorber.law().is_some_and(|law| law.large_twist().is_some());
    let Some(first) = absorbers.iter().position(large) else { return };
    let name = |i: usize| absorbers[i].absorber.type_name();
    if let Some(second) = (first + 1..absorbers.len()).find(|i| large(&absorbers[*i])) {
        let found = format!("found `{}` beside `{}` in one design, expected one absorber of large twist", name(second), name(first));
        check.wrong(&raw.name, found);
    }
    if matches!(absorbers[first].on, Host::Ring(_)) || absorbers.iter().any(|m| m.on == Host::Ring(first)) {
        let found = format!("found `{}` on a ring or with an absorber on its ring, expected it on a station, by itself", name(first));
        check.wrong(&raw.name, found);
    }
}

/// What carries each absorber of a list: a station, or the ring of another one by its name. Nothing where a mistake leaves none.
pub(crate) fn hosts(check: &mut Check, chain: &Chain, list: &[(Option<&At<String>>, &RawOn)]) -> Vec<Option<Host>> {
    let mut names = HashSet::new();
    for name in list.iter().filter_map(|a| a.0) {
        check.name(name);
        if name.get_ref().is_empty() {
            check.wrong(name, "found an empty name, expected one that `on.ring` can name");
        }
        if !names.insert(name.get_ref()) {
            check.wrong(name, format!("found absorber `{}` a second time, expected different names", name.get_ref()));
        }
    }
    let host = |(_, on): &(Option<&At<String>>, &RawOn)| match on {
        RawOn::Station(name) => station(check, chain, name).map(Host::Station),
        RawOn::Ring(name) => {
            let found = list.iter().position(|a| a.0.is_some_and(|n| n.get_ref() == name.get_ref()));
            if found.is_none() {
                check.wrong_with_help(
                    name,
                    format!("found the ring of `{}`, expected that of an absorber beside this one", name.get_ref()),
                    "the inner absorber has `name = …`, the outer one `on.ring` with that name",
                );
            }
            found.map(Host::Ring)
        }
    };
    let hosts: Vec<Option<Host>> = list.iter().map(host).collect();
    for (i, (_, on)) in list.iter().enumerate() {
        if let (RawOn::Ring(name), true, None) = (on, hosts.iter().all(Option::is_some), root(&hosts, i)) {
            check.wrong(name, "found rings that carry each other, expected one of them on a station");
        }
    }
    hosts
}

/// Station below an absorber; nothing where there is none.
pub fn root(hosts: &[Option<Host>], index: usize) -> Option<usize> {
    let mut at = index;
    for _ in 0..=hosts.len() {
        match (*hosts.get(at)?)? {
            Host::Station(station) => return Some(station),
            Host::Ring(inner) => at = inner,
        }
    }
    None
}

/// A value of a parameter.
pub fn value(check: &mut Check, parameter: &Parameter, raw: &At<f64>) -> f64 {
    check.within(raw, &Bounds::of_parameter(parameter.range))
}

/// An absorber in its place, with the station below it.
fn absorber(check: &mut Check, raw: &RawAbsorber, place: Option<(Host, usize)>, of: Reaches) -> Option<Mounted> {
    let Reaches { chain, modes, temperatures, substances, .. } = of;
    let hub_inertia = raw.hub_inertia_kg_m2.as_ref().map_or(0.0, |h| check.not_negative(h));
    let absorber = match &raw.kind {
        RawType::Declared(declaration, values) => Absorber::Ring(declared(check, raw, (declaration, values), substances)?),
        RawType::Measured(m) => measured(check, m, of)?,
        RawType::Prony(p) => prony(check, p),
        RawType::Locked(l) => Absorber::Locked { ring_inertia: check.not_negative(&l.ring_inertia_kg_m2) },
        RawType::Seeded(s) => {
            if let (Host::Ring(_), _) = place? {
                check.wrong(
                    &s.by,
                    "found a closed form for an absorber on a ring, expected one on a station: closed forms know of no ring below",
                );
            }
            seeded(check, s, place?.1, chain, modes)?
        }
    };
    let law_of = &raw.kind;
    let absorber = match (absorber, &raw.material) {
        (Absorber::Ring(law), Some(raw)) => {
            if !raw.get_ref().properties.is_empty() {
                check.wrong(raw, "found properties of the material of a given ring, expected them among the values of its type");
            }
            if matches!(law_of, RawType::Measured(_)) && !of_measured(check, raw.get_ref()) {
                return None;
            }
            let spec = material(check, raw.get_ref(), (law.declaration(), None), Known { temperatures, substances });
            let known = Arc::new(spec.of_type(law.declaration(), spec.choices.first(), temperatures));
            Absorber::Ring(WithMaterial::of(law, &known))
        }
        (Absorber::Locked { ring_inertia }, Some(raw)) => {
            check.wrong(raw, "found the material of a locked ring, expected it with a ring that moves");
            Absorber::Locked { ring_inertia }
        }
        (absorber, None) => absorber,
    };
    Some(Mounted { on: place?.0, hub_inertia, absorber })
}

/// A ring of a declared type; a compound or oil gives what its values leave out.
fn declared(
    check: &mut Check,
    raw: &RawAbsorber,
    (declaration, values): (&'static Declaration, &[Option<At<f64>>]),
    substances: &Substances,
) -> Option<Arc<dyn Law>> {
    let names = raw.material.as_ref().and_then(|m| m.get_ref().of.as_ref());
    let shape = shape(declaration);
    let named = names.zip(shape).and_then(|(names, shape)| match names.get_ref().as_slice() {
        [name] => substances.find(&mut Check::new(check.source), name, shape.medium),
        list => {
            check.wrong(names, format!("found {} names, expected one compound or oil of a given design", list.len()));
            None
        }
    });
    let mut complete = true;
    let mut list = Vec::new();
    for (p, given) in declaration.parameters.iter().zip(values) {
        let own = named.as_ref().and_then(|s| s.value(p.key));
        match (given, own) {
            (Some(given), Some(_)) => {
                check.wrong(given, format!("found `{}` beside `material.of`, whose table has it, expected one of them", p.key));
            }
            (Some(given), None) => list.push(value(check, p, given)),
            (None, Some(own)) => list.push(own),
            (None, None) => complete = false,
        }
    }
    if !complete && names.is_none() {
        let missing: Vec<&str> = declaration.parameters.iter().zip(values).filter(|v| v.1.is_none()).map(|v| v.0.key).collect();
        let given = values.iter().flatten().next()?;
        check.wrong(
            given,
            format!("found `{}` without {}, expected them, or a compound or oil as `material.of`", declaration.name, missing.join(", ")),
        );
    }
    if list.len() != declaration.parameters.len() {
        return None;
    }
    if let (Some(shape), Some(Some(at))) = (shape, values.get(1)) {
        made(check, at, (shape, &list), None);
    }
    Some((declaration.build)(&list))
}

/// A ring on measured values, which the study's frequencies and temperatures may not leave.
fn measured(check: &mut Check, raw: &RawMeasured, of: Reaches) -> Option<Absorber> {
    let ring_inertia = check.positive(&raw.ring_inertia_kg_m2);
    let found = Arc::new(table(check, &raw.file, of.folder, measured_law)?);
    let (low, high) = (found.frequencies_hz[0], found.frequencies_hz[found.frequencies_hz.len() - 1]);
    if low > of.frequencies_hz.0 || high < of.frequencies_hz.1 {
        let (from, to) = of.frequencies_hz;
        check.wrong_with_help(
            &raw.file,
            format!("found measurements from {low} to {high} Hz, expected those of the study's speeds and orders, {from:.4} to {to:.4} Hz"),
            "`hartog fit` finds a law that goes on beyond what was measured; `speed_rpm` and `order_limit` make the range narrower",
        );
    }
    let has_temperature = found.temperatures_c.len() > 1;
    let celsius = match &raw.temperature_c {
        Some(t) if !has_temperature => {
            check.wrong(t, "found a temperature with a table that has none, expected a column `temperature_c` there");
            return None;
        }
        Some(t) => *t.get_ref(),
        None if has_temperature => {
            check.wrong(&raw.file, "found measurements at several temperatures, expected `temperature_c = …`, at which the ring works");
            return None;
        }
        None => 0.0,
    };
    let (coldest, hottest) = (found.temperatures_c[0], found.temperatures_c[found.temperatures_c.len() - 1]);
    let asked = [Some(celsius), of.temperatures.cold, of.temperatures.hot];
    for t in asked.into_iter().flatten().filter(|t| has_temperature && !(coldest..=hottest).contains(t)) {
        check.wrong(&raw.file, format!("found {t} °C outside the measurements, expected temperatures from {coldest} to {hottest} °C"));
    }
    let Temperatures { cold, hot } = of.temperatures;
    Some(Measured { ring_inertia, scale: 1.0, celsius, table: found, cold, hot }.into())
}

/// A ring on a Prony series.
fn prony(check: &mut Check, raw: &RawProny) -> Absorber {
    let ring_inertia = check.positive(&raw.ring_inertia_kg_m2);
    let stiffness = check.not_negative(&raw.stiffness_n_m_per_rad);
    if raw.branches.get_ref().is_empty() {
        check.wrong(&raw.branches, "found no branch, expected at least one");
    }
    let branches = raw
        .branches
        .get_ref()
        .iter()
        .map(|b| Branch { stiffness: check.positive(&b.stiffness_n_m_per_rad), relaxation_time: check.positive(&b.relaxation_time_s) });
    Prony { ring_inertia, stiffness, branches: branches.collect(), stiffness_scale: 1.0, time_scale: 1.0 }.into()
}

/// Engine inertia at a station for the closed forms and the first elastic mode's frequency; nothing where no elastic mode moves there.
pub(crate) fn engine_mode(chain: &Chain, modes: &Modes, station: usize, whole_chain: bool) -> Option<EngineMode> {
    let mode = modes.elastic().next()?;
    let inertia = if whole_chain { chain.total_inertia() } else { modes.equivalent_inertia(mode, station) };
    (inertia.is_finite() && inertia < 1e6 * chain.total_inertia()).then_some(EngineMode { inertia, omega: modes.omega[mode] })
}

fn seeded(check: &mut Check, raw: &RawSeeded, station: usize, chain: &Chain, modes: &Modes) -> Option<Absorber> {
    let ring_inertia = check.positive(&raw.ring_inertia_kg_m2);
    let Some((declaration, form)) = types::closed_form(raw.by.get_ref()) else {
        let known = types::closed_form_names();
        check.wrong(&raw.by, format!("found rule `{}`, expected one of {}", raw.by.get_ref(), known.join(", ")));
        return None;
    };
    let whole = matches!(raw.engine_inertia, RawEngineInertia::WholeChain);
    let Some(engine) = engine_mode(chain, modes, station, whole) else {
        check.wrong(&raw.by, "no elastic mode moves this station, expected one for a closed form");
        return None;
    };
    Some(Absorber::Ring((declaration.build)(&(form.values)(ring_inertia, engine))))
}
