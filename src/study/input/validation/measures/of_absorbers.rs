//! Measures of the absorbers.

use super::context::Context;
use super::names::{Bound, Names, Resolved, spec};
use super::of_construction::springs;
use crate::input::error::Check;
use crate::input::measure::UnitOf;
use crate::input::schema::measure::{
    RawInertia, RawLifeOf, RawLossFactor, RawPower, RawPowerOver, RawPowerPerArea, RawRingTwist, RawSpringStress, RawStrain, RawTemperature,
};
use crate::input::validation::absorbers::HEAT_OF_OTHERS;
use crate::objective::{Over, Property, Within};
use crate::response::Quantity;
use crate::units::{DEG_PER_RAD, PA_PER_MPA};

pub(super) fn ring_twist<'r>(check: &mut Check, r: &'r RawRingTwist, of: Context) -> Option<Resolved<'r>> {
    let over = of.over(check, r.over, r.order.as_ref());
    let place = format!("of {}", Context::each_ring(r.absorber.as_ref()));
    let names = Names { key: "ring_twist", column: "ring_twist_deg", word: "ring_twist", what: "ring twist", place };
    let parts = (of.rings(check, r.absorber.as_ref())?, over, of.within(check, r.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::Angle), bound: Bound::Most(r.max_deg.as_ref()) })
}

pub(super) fn element_strain<'r>(check: &mut Check, s: &'r RawStrain, of: Context) -> Option<Resolved<'r>> {
    let (radius, thickness) = (check.positive(&s.mean_radius_mm), check.positive(&s.thickness_mm));
    let over = of.over(check, s.over, s.order.as_ref());
    let place = format!("of {}", Context::ring_words(Some(&s.absorber)));
    let names = Names { key: "element_strain", column: "strain_percent", word: "strain", what: "shear strain", place };
    let parts = (of.rings(check, Some(&s.absorber))?, over, of.within(check, s.within()));
    Some(Resolved {
        spec: spec(names, parts, UnitOf::Strain { per_twist: radius / thickness }),
        bound: Bound::Most(s.max_percent.as_ref()),
    })
}

/// By a stress that is given, in rad of the twist inside; or by the dimensions of the springs, in Pa inside.
pub(super) fn spring_stress<'r>(check: &mut Check, s: &'r RawSpringStress, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(Some(&s.absorber)));
    let names =
        Names { key: "spring_stress", column: "spring_stress_mpa", word: "spring_stress", what: "vibratory stress of the springs", place };
    let (rings, over, per_twist) = match &s.mpa_per_deg {
        Some(given) => {
            let per_twist = check.positive(given) * PA_PER_MPA * DEG_PER_RAD;
            let over = of.over(check, s.over, s.order.as_ref());
            (of.rings(check, Some(&s.absorber))?, over, per_twist)
        }
        None => {
            if s.over.is_some() || s.order.is_some() {
                check.wrong(
                    &s.absorber,
                    "found `over` or `order` of the stress by the dimensions of springs, expected `mpa_per_deg` beside it: by dimensions it is that of all orders together",
                );
            }
            (springs(check, &s.absorber, of)?, Over::SpringStress, 1.0)
        }
    };
    let parts = (rings, over, of.within(check, s.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::SpringStress { per_twist }), bound: Bound::Most(s.max_mpa.as_ref()) })
}

pub(super) fn life<'r>(check: &mut Check, l: &'r RawLifeOf, of: Context) -> Option<Resolved<'r>> {
    let rings = of.rings(check, Some(&l.absorber))?;
    if rings.iter().any(|r| matches!(r, Quantity::RingTwist(i) if !of.lives.get(*i).is_some_and(|said| *said))) {
        let found = format!(
            "found the life of absorber {}, of which some type or design does not say how many cycles of strain it bears",
            l.absorber.get_ref()
        );
        check.wrong(&l.absorber, format!("{found}, expected `life` and `geometry` in every material of it"));
    }
    let place = format!("of {}", Context::ring_words(Some(&l.absorber)));
    let names = Names { key: "life", column: "life_h", word: "life", what: "life over the duty", place };
    Some(Resolved { spec: spec(names, (rings, Over::Damage, Within::default()), UnitOf::Life), bound: Bound::Least(l.min_h.as_ref()) })
}

/// Most designs and types that a message names.
const MOST_NAMED: usize = 3;

/// How powers count.
fn of_power(over: Option<RawPowerOver>) -> Over {
    match over.unwrap_or_default() {
        RawPowerOver::Speed => Over::Power,
        RawPowerOver::Duty => Over::MeanPower,
    }
}

pub(super) fn dissipated_power<'r>(check: &mut Check, p: &'r RawPower, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(p.absorber.as_ref()));
    let names = Names { key: "dissipated_power", column: "power_w", word: "power", what: "dissipated power", place };
    let parts = (of.rings(check, p.absorber.as_ref())?, of_power(p.over), of.within(check, p.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::Power), bound: Bound::Most(p.max_w.as_ref()) })
}

pub(super) fn power_per_area<'r>(check: &mut Check, p: &'r RawPowerPerArea, of: Context) -> Option<Resolved<'r>> {
    let area = check.positive(&p.area_m2);
    let place = format!("of {}", Context::ring_words(Some(&p.absorber)));
    let names = Names { key: "power_per_area", column: "power_w_per_m2", word: "power_per_area", what: "dissipated power per area", place };
    let parts = (of.rings(check, Some(&p.absorber))?, of_power(p.over), of.within(check, p.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::PowerPerArea { area }), bound: Bound::Most(p.max_w_per_m2.as_ref()) })
}

pub(super) fn temperature<'r>(check: &mut Check, t: &'r RawTemperature, of: Context) -> Option<Resolved<'r>> {
    let rings = of.rings(check, Some(&t.absorber));
    let index = usize::try_from(*t.absorber.get_ref()).ok().and_then(|i| i.checked_sub(1));
    match index.and_then(|i| of.cooled.get(i)) {
        Some(Ok(all)) => {
            if all.iter().any(|c| c.air <= 0.0 || c.hub <= 0.0) {
                let expected = "expected air and hub above that: limits and targets are ratios of °C";
                check.wrong(&t.absorber, format!("found the temperature of an absorber that may be below 0 °C, {expected}"));
            }
            let bears = all.iter().map(|c| c.limit).fold(f64::INFINITY, f64::min);
            if let Some(most) = t.max_c.as_ref().filter(|most| *most.get_ref() > bears) {
                let found = format!("found {} °C, above the `limit_c` of its material, {bears} °C", most.get_ref());
                check.wrong(most, format!("{found}, expected no more: above that it overheats"));
            }
        }
        Some(Err(silent)) if rings.is_some() => {
            let named: Vec<&str> = silent.iter().take(MOST_NAMED).map(String::as_str).collect();
            let more = if silent.len() > MOST_NAMED { format!(" and {} others", silent.len() - MOST_NAMED) } else { String::new() };
            let (number, some) = (t.absorber.get_ref(), named.join(" and ") + &more);
            let which = if silent.len() == 1 { "does" } else { "do" };
            let found = format!("found the temperature of absorber {number}, of which {some} {which} not say what cools it");
            // one absorber of a design is cooled, and in some design it is another one
            if of.balanced.iter().any(|b| index != Some(*b)) {
                let expected = "expected that of an absorber with `cooling` in all designs and types";
                check.wrong_with_help(
                    &t.absorber,
                    format!("{found}, {expected}: temperature and strain are balanced for one absorber of a design"),
                    HEAT_OF_OTHERS,
                );
                return None;
            }
            check.wrong_with_help(
                &t.absorber,
                format!("{found}, expected `cooling` in every material of it"),
                "`cooling` stands beside a law of `temperature`; the heat of types without one is limited by `dissipated_power`",
            );
        }
        _ => {}
    }
    let place = format!("of {}", Context::ring_words(Some(&t.absorber)));
    let names = Names { key: "temperature", column: "temperature_c", word: "temperature", what: "temperature", place };
    let parts = (rings?, Over::Temperature, of.within(check, t.within()));
    Some(Resolved { spec: spec(names, parts, UnitOf::Temperature), bound: Bound::Most(t.max_c.as_ref()) })
}

pub(super) fn loss_factor<'r>(check: &mut Check, l: &'r RawLossFactor, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::each_ring(l.absorber.as_ref()));
    let names = Names { key: "loss_factor", column: "loss_factor", word: "loss_factor", what: "implied loss factor", place };
    let parts = (of.rings(check, l.absorber.as_ref())?, Over::Property(Property::LossFactor), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Ratio), bound: Bound::Most(l.max.as_ref()) })
}

pub(super) fn ring_inertia<'r>(check: &mut Check, i: &'r RawInertia, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(i.absorber.as_ref()));
    let names = Names { key: "ring_inertia", column: "inertia_of_rings_kg_m2", word: "ring_inertia", what: "ring inertia", place };
    let parts = (of.rings(check, i.absorber.as_ref())?, Over::Property(Property::RingInertia), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Inertia), bound: Bound::Most(i.max_kg_m2.as_ref()) })
}

pub(super) fn total_inertia<'r>(check: &mut Check, i: &'r RawInertia, of: Context) -> Option<Resolved<'r>> {
    let place = format!("of {}", Context::ring_words(i.absorber.as_ref()));
    let names = Names { key: "total_inertia", column: "total_inertia_kg_m2", word: "inertia", what: "total inertia", place };
    let parts = (of.rings(check, i.absorber.as_ref())?, Over::Property(Property::TotalInertia), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Inertia), bound: Bound::Most(i.max_kg_m2.as_ref()) })
}
