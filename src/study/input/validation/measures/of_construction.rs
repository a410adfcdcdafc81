//! Measures of absorbers by their dimensions.

use super::context::Context;
use super::names::{Bound, Names, Resolved, spec};
use crate::absorber::Medium;
use crate::absorber::construction::words_of;
use crate::input::error::{At, Check};
use crate::input::measure::UnitOf;
use crate::input::schema::measure::RawOwnStrain;
use crate::input::schema::measure_of_construction::{RawCost, RawEnvelope, RawMass, RawVolume};
use crate::objective::{Over, Price, Property, Within};
use crate::response::Quantity;
use crate::units::M_PER_MM;

/// Rings of absorbers by their dimensions, in some type or design on such a medium; a mistake where there is none.
fn rings(
    check: &mut Check,
    named: Option<&At<i64>>,
    (word, at): (&str, &At<impl Sized>),
    (of, media): (Context, fn(Medium) -> bool),
) -> Option<Vec<Quantity>> {
    let rings = of.rings(check, named)?;
    let carried = |q: &Quantity| if let Quantity::RingTwist(i) = q { of.media.get(*i) } else { None };
    let has = |q: &Quantity| carried(q).is_some_and(|own| own.iter().any(|m| media(*m)));
    if !rings.iter().any(has) {
        let drawn = rings.iter().filter_map(carried).any(|own| !own.is_empty());
        let without = if drawn { "that have none" } else { "without dimensions" };
        let known = words_of(media).join(", ");
        check.wrong(at, format!("found the {word} of absorbers {without}, expected that of a type by its dimensions: {known}"));
        return None;
    }
    Some(rings)
}

fn any(_: Medium) -> bool {
    true
}

pub(super) fn strain<'r>(check: &mut Check, s: &'r RawOwnStrain, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(Some(&s.absorber)));
    let names = Names { key: "strain", column: "own_strain_percent", word: "own_strain", what: "shear strain", place };
    let rings = rings(check, Some(&s.absorber), ("shear strain", &s.absorber), (of, Medium::is_sheared))?;
    let parts = (rings, Over::Strain, of.within(check, s.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::Percent), bound: Bound::Most(s.max_percent.as_ref()) })
}

/// Rings on springs by their dimensions, which tell the stress of a twist.
pub(super) fn springs(check: &mut Check, absorber: &At<i64>, of: Context) -> Option<Vec<Quantity>> {
    rings(check, Some(absorber), ("stress of springs", absorber), (of, Medium::is_spring))
}

pub(super) fn mass<'r>(check: &mut Check, m: &'r RawMass, at: &At<impl Sized>, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(m.absorber.as_ref()));
    let names = Names { key: "mass", column: "mass_kg", word: "mass", what: "mass", place };
    let parts = (rings(check, m.absorber.as_ref(), ("mass", at), (of, any))?, Over::Property(Property::Mass), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Mass), bound: Bound::Most(m.max_kg.as_ref()) })
}

pub(super) fn volume<'r>(check: &mut Check, v: &'r RawVolume, at: &At<impl Sized>, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(v.absorber.as_ref()));
    let names = Names { key: "volume", column: "volume_l", word: "volume", what: "volume", place };
    let parts = (rings(check, v.absorber.as_ref(), ("volume", at), (of, any))?, Over::Property(Property::Volume), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Volume), bound: Bound::Most(v.max_l.as_ref()) })
}

pub(super) fn cost<'r>(check: &mut Check, c: &'r RawCost, at: &At<impl Sized>, of: Context) -> Option<Resolved<'r>> {
    let mut number = |x: Option<&At<f64>>| x.map_or(0.0, |x| check.not_negative(x));
    let price = Price {
        fixed: number(c.fixed.as_ref()),
        ring: number(Some(&c.ring_per_kg)),
        housing: number(c.housing_per_kg.as_ref()),
        diameter: number(c.per_mm_of_diameter.as_ref()) / M_PER_MM,
    };
    let place = format!("of {}", Context::ring_words(c.absorber.as_ref()));
    let names = Names { key: "cost", column: "cost", word: "cost", what: "cost", place };
    let parts = (rings(check, c.absorber.as_ref(), ("cost", at), (of, any))?, Over::Property(Property::Cost(price)), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Currency), bound: Bound::Most(c.max.as_ref()) })
}

/// A limit for each size that is given.
pub(super) fn envelope<'r>(check: &mut Check, e: &'r RawEnvelope, of: Context) -> Vec<Resolved<'r>> {
    let Some(rings) = rings(check, Some(&e.absorber), ("envelope", &e.absorber), (of, any)) else { return Vec::new() };
    let place = format!("of {}", Context::ring_words(Some(&e.absorber)));
    let one = |(what, column, word): (&'static str, &'static str, &'static str), property, unit, bound| {
        let names = Names { key: word, column, word, what, place: place.clone() };
        Resolved { spec: spec(names, (rings.clone(), Over::Property(property), Within::default()), unit), bound }
    };
    let mut list = Vec::new();
    if let Some(most) = &e.outer_diameter_mm {
        let of = ("outer diameter", "outer_diameter_mm", "outer_diameter");
        list.push(one(of, Property::OuterDiameter, UnitOf::Length, Bound::Most(Some(most))));
    }
    if let Some(most) = &e.width_mm {
        list.push(one(("width", "width_mm", "width"), Property::Width, UnitOf::Length, Bound::Most(Some(most))));
    }
    if let Some(least) = &e.bore_mm {
        list.push(one(("bore", "bore_mm", "bore"), Property::Bore, UnitOf::Bore, Bound::Least(Some(least))));
    }
    if list.is_empty() {
        check.wrong(&e.absorber, "found an envelope without a size, expected `outer_diameter_mm`, `width_mm` or `bore_mm`");
    }
    list
}
