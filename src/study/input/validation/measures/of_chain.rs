//! Measures of the chain and of the crank.

use super::context::{Context, Judged, default_twist};
use super::names::{Bound, Names, Resolved, spec};
use crate::crankshaft::FatigueSpec;
use crate::drivetrain::Chain;
use crate::fatigue::shaft_rules::ShaftRule;
use crate::input::error::{At, Check};
use crate::input::measure::{LimitOfRule, MeasureSpec, UnitOf};
use crate::input::schema::bounds::{KR_STRENGTH, M68_STRENGTH, M68_STRESS_FACTOR};
use crate::input::schema::fatigue::RawCriterion;
use crate::input::schema::measure::{
    RawAcceleration, RawAmplitude, RawBand, RawKrCrank, RawKrEngine, RawM68, RawMargin, RawStress, RawTorque, RawTwist, RawVelocity,
};
use crate::input::validation::named::station;
use crate::objective::{Over, Property, Within};
use crate::response::{Quantity, Rate};
use crate::units::{M_PER_MM, PA_PER_MPA};
use std::f64::consts::PI;

fn twist(check: &mut Check, chain: &Chain, from: &At<String>, to: &At<String>) -> Option<Quantity> {
    let a = station(check, chain, from);
    let b = if to.get_ref() == "ground" { Some(None) } else { station(check, chain, to).map(Some) };
    let (a, b) = (a?, b?);
    if b == Some(a) {
        check.wrong(to, format!("found a twist from `{0}` to `{0}`, expected two different stations", to.get_ref()));
    }
    Some(Quantity::Twist { from: a, to: b })
}

fn torques(chain: &Chain) -> Vec<Quantity> {
    (0..chain.len() - 1).map(Quantity::ShaftTorque).collect()
}

/// The criterion of a margin: the one named, or the first of the study.
fn criterion<'f, T>(
    check: &mut Check,
    named: Option<&At<RawCriterion>>,
    at: &At<T>,
    fatigue: Judged<'f>,
) -> Option<(usize, &'f FatigueSpec)> {
    let fatigue = match fatigue {
        Judged::By(fatigue) => fatigue,
        // its own mistakes have been reported
        Judged::Wrongly => return None,
        Judged::Not => {
            check.wrong(at, "found a margin in a study without [fatigue], expected material and criteria there");
            return None;
        }
    };
    let Some(named) = named else { return Some((0, fatigue)) };
    let wanted = named.get_ref().0;
    let found = fatigue.criteria.iter().position(|c| *c == wanted);
    if found.is_none() {
        check.wrong(named, format!("found criterion `{}`, expected one of those in [fatigue]", wanted.name()));
    }
    found.map(|index| (index, fatigue))
}

/// Shafts whose torque the crank carries.
fn crank_torques(chain: &Chain) -> Vec<Quantity> {
    let throws = chain.stations.iter().map(|s| s.throws.len()).sum();
    crate::crankshaft::shafts(chain, throws).into_iter().map(Quantity::ShaftTorque).collect()
}

pub(super) fn peak_twist<'r>(check: &mut Check, t: &'r RawTwist, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    let name = |i: usize| chain.stations[i].name.as_str();
    let quantity = twist(check, chain, &t.from, &t.to)?;
    let Quantity::Twist { from, to } = quantity else { return None };
    let place = format!("{} to {}", name(from), to.map_or("ground", name));
    let over = of.over(check, t.over, t.order.as_ref());
    let names = Names { key: "peak_twist", column: "twist_deg", word: "twist", what: "twist", place };
    Some(Resolved {
        spec: spec(names, (vec![quantity], over, of.within(check, t.within())), UnitOf::Angle),
        bound: Bound::Most(t.max_deg.as_ref()),
    })
}

pub(super) fn hub_amplitude<'r>(check: &mut Check, a: &'r RawAmplitude, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    let name = |i: usize| chain.stations[i].name.as_str();
    let from = station(check, chain, &a.station)?;
    let over = of.over(check, a.over, a.order.as_ref());
    let place = format!("of {}", name(from));
    let names = Names { key: "hub_amplitude", column: "hub_deg", word: "hub", what: "amplitude", place };
    let quantities = vec![Quantity::Twist { from, to: None }];
    Some(Resolved {
        spec: spec(names, (quantities, over, of.within(check, a.within())), UnitOf::Angle),
        bound: Bound::Most(a.max_deg.as_ref()),
    })
}

pub(super) fn velocity<'r>(check: &mut Check, v: &'r RawVelocity, of: Context) -> Option<Resolved<'r>> {
    let (over, within) = (of.over(check, v.over, v.order.as_ref()), of.within(check, v.within()));
    let words = ("velocity", "velocity_rad_per_s", "angular velocity");
    motion(check, &v.station, (Rate::Velocity, words), (over, within), v.max_rad_per_s.as_ref(), of)
}

pub(super) fn acceleration<'r>(check: &mut Check, a: &'r RawAcceleration, of: Context) -> Option<Resolved<'r>> {
    let (over, within) = (of.over(check, a.over, a.order.as_ref()), of.within(check, a.within()));
    let words = ("acceleration", "acceleration_rad_per_s2", "angular acceleration");
    motion(check, &a.station, (Rate::Acceleration, words), (over, within), a.max_rad_per_s2.as_ref(), of)
}

/// A rate of a station; `words`: its key and word, its column, what it is.
fn motion<'r>(
    check: &mut Check,
    named: &At<String>,
    (rate, (key, column, what)): (Rate, (&'static str, &'static str, &'static str)),
    (over, within): (Over, Within),
    most: Option<&'r At<f64>>,
    of: Context,
) -> Option<Resolved<'r>> {
    let at = station(check, of.chain, named)?;
    let place = format!("of {}", of.chain.stations[at].name);
    let parts = (vec![Quantity::Motion(at, rate)], over, within);
    Some(Resolved { spec: spec(Names { key, column, word: key, what, place }, parts, UnitOf::Motion(rate)), bound: Bound::Most(most) })
}

pub(super) fn vibratory_torque<'r, T>(check: &mut Check, t: &'r RawTorque, at: &At<T>, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    if chain.len() == 1 {
        check.wrong(at, "found the vibratory torque of a chain without shafts, expected two stations or another measure");
        return None;
    }
    let (quantities, place) = match &t.shaft {
        None => (torques(chain), "of the shafts".to_owned()),
        Some(shaft) => {
            let shaft = of.shaft(check, shaft)?;
            (vec![Quantity::ShaftTorque(shaft)], format!("of shaft {}", chain.shaft_name(shaft)))
        }
    };
    let over = of.over(check, t.over, t.order.as_ref());
    let names = Names { key: "vibratory_torque", column: "torque_n_m", word: "torque", what: "vibratory torque", place };
    Some(Resolved {
        spec: spec(names, (quantities, over, of.within(check, t.within())), UnitOf::Torque),
        bound: Bound::Most(t.max_n_m.as_ref()),
    })
}

pub(super) fn shaft_stress<'r>(check: &mut Check, s: &'r RawStress, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    let shaft = of.shaft(check, &s.shaft)?;
    let outer = M_PER_MM * check.positive(&s.outer_diameter_mm);
    let inner = M_PER_MM * s.inner_diameter_mm.as_ref().map_or(0.0, |d| check.not_negative(d));
    if let Some(at) = s.inner_diameter_mm.as_ref().filter(|_| inner >= outer) {
        check.wrong(at, format!("found {} mm, expected less than the outer diameter", at.get_ref()));
        return None;
    }
    let section_modulus = PI * (outer.powi(4) - inner.powi(4)) / (16.0 * outer);
    let over = of.over(check, s.over, s.order.as_ref());
    let place = format!("of shaft {}", chain.shaft_name(shaft));
    let names = Names { key: "shaft_stress", column: "shaft_stress_mpa", word: "stress", what: "nominal stress", place };
    let unit = UnitOf::Stress { section_modulus };
    let mut within = of.within(check, s.within());
    let ratio = chain.speed_ratios().map_or(1.0, |ratios| ratios[shaft].abs());
    if let Some(rule) = &s.iacs_m68 {
        of_propulsion(check, (rule, &s.shaft), (chain, shaft), over);
    }
    let propulsion = s.iacs_m68.as_ref().map(|r| propulsion(check, r, (outer, ratio)));
    let rules = [propulsion, s.korean_register_crank.as_ref().map(|r| Some(crank(check, r)))];
    let mut rules = rules.into_iter().flatten();
    let Some(rule) = rules.next() else {
        let spec = spec(names, (vec![Quantity::ShaftTorque(shaft)], over, within), unit);
        return Some(Resolved { spec, bound: Bound::Most(s.max_mpa.as_ref()) });
    };
    const ONE: &str = "found another limit beside that of a rule, expected one of them";
    if let Some(at) = &s.max_mpa {
        check.wrong(at, ONE);
    }
    if let Some(at) = &s.factor_by_speed {
        check.wrong(at, ONE);
    }
    if let Some(Some(second)) = rules.next() {
        check.wrong(second.rated, ONE);
    }
    let rule = rule?;
    let limit = of_rule(check, &rule, of, &mut within)?;
    Some(Resolved {
        spec: spec(names, (vec![Quantity::ShaftTorque(shaft)], over, within), unit),
        bound: Bound::Rule {
            words: rule.words,
            limit,
            rule: LimitOfRule {
                rule: rule.rule,
                rated_rpm: rule.rated_rpm,
                transient: rule.rule.transient(),
                excepted: Context::excepted(s.within()),
            },
        },
    })
}

/// The rule for propulsion shafts is of intermediate, thrust and propeller shafts, and limits all orders together.
fn of_propulsion(check: &mut Check, (rule, named): (&At<RawM68>, &At<String>), (chain, shaft): (&Chain, usize), over: Over) {
    let is_throw = |station: usize| chain.stations.get(station).is_some_and(|s| !s.throws.is_empty());
    if is_throw(shaft) && is_throw(chain.next(shaft)) {
        check.wrong(
            named,
            format!(
                "found `iacs_m68` for shaft {}, part of the crankshaft, expected an intermediate, thrust or propeller shaft: a crank is judged by `iacs_m53` of [fatigue] or `korean_register_crank`",
                chain.shaft_name(shaft)
            ),
        );
    }
    if over != Over::Synthesis {
        check.wrong(rule, "found `iacs_m68` beside `over` or `order`, expected neither: the rule limits all orders together");
    }
}

/// Speeds are alike within this share.
const FEW_DIGITS: f64 = 5e-4;

/// A rule with the speed it is in units of.
struct Rule<'r> {
    words: &'static str,
    rated: &'r At<f64>,
    /// Of the crankshaft, as all speeds of a study.
    rated_rpm: f64,
    rule: ShaftRule,
}

/// The rated speed of a rule as it is given, and that of the crankshaft, rpm; `ratio`: speed of the shaft over that.
fn rated<'r>(check: &mut Check, at: &'r At<RawM68>, ratio: f64) -> Option<(&'r At<f64>, f64)> {
    match (&at.get_ref().rated_speed_rpm, &at.get_ref().rated_shaft_speed_rpm) {
        (Some(crank), None) => Some((crank, check.positive(crank))),
        (None, Some(shaft)) => Some((shaft, check.positive(shaft) / ratio)),
        (Some(_), Some(shaft)) => {
            check.wrong(shaft, "found the rated speed of the shaft beside that of the crankshaft, expected one of them");
            None
        }
        (None, None) => {
            check.wrong(
                at,
                "found a rule without its rated speed, expected `rated_speed_rpm`, that of the crankshaft, or `rated_shaft_speed_rpm`, that of this shaft",
            );
            None
        }
    }
}

/// `ratio`: speed of the shaft over that of the crankshaft.
fn propulsion<'r>(check: &mut Check, at: &'r At<RawM68>, (diameter, ratio): (f64, f64)) -> Option<Rule<'r>> {
    let raw = at.get_ref();
    let tensile = PA_PER_MPA * check.within(&raw.tensile_strength_mpa, &M68_STRENGTH);
    let stress_factor = check.within(&raw.stress_factor, &M68_STRESS_FACTOR);
    let (rated, rated_rpm) = rated(check, at, ratio)?;
    Some(Rule { words: "by IACS UR M68", rated, rated_rpm, rule: ShaftRule::Propulsion { tensile, stress_factor, diameter } })
}

fn crank<'r>(check: &mut Check, raw: &'r At<RawKrCrank>) -> Rule<'r> {
    let raw = raw.get_ref();
    let tensile = PA_PER_MPA * check.within(&raw.tensile_strength_mpa, &KR_STRENGTH);
    let rule = ShaftRule::Crank { tensile, in_line: raw.engine != RawKrEngine::Other };
    Rule { words: "by KR Pt 5 Ch 4", rated: &raw.rated_speed_rpm, rated_rpm: check.positive(&raw.rated_speed_rpm), rule }
}

/// The limit of a rule at the rated speed, MPa; its curve over speed, and the range it holds in, go into `within`.
fn of_rule(
    check: &mut Check,
    &Rule { rated: at_rated, rated_rpm: rated, rule, .. }: &Rule,
    of: Context,
    within: &mut Within,
) -> Option<f64> {
    let given = *at_rated.get_ref();
    let found = if given == rated { format!("found {rated} rpm") } else { format!("found {given} rpm, {rated} rpm of the crankshaft") };
    // a rated speed is written with a few digits: 333.3 rpm of a shaft behind a gear of three is 1000 of the crank
    let nearly = rule.top() * rated;
    let top = if (of.speeds.1 / nearly - 1.0).abs() <= FEW_DIGITS { of.speeds.1 } else { (nearly * 1e6).round() / 1e6 };
    if of.speeds.0 >= top {
        let message = format!("{found}, expected a rated speed of which the study's speeds are no more than {}", rule.top());
        check.wrong_with_help(
            at_rated,
            message,
            "speeds are those of the crankshaft: that of a shaft behind a gear is `rated_shaft_speed_rpm` of `iacs_m68`",
        );
        return None;
    }
    let whole = rule.continuous(1.0);
    within.factors = rule.ratios().into_iter().map(|ratio| (ratio * rated, rule.continuous(ratio) / whole)).collect();
    if let Some(last) = within.factors.last_mut() {
        last.0 = top;
    }
    // the rule ends there, whatever range is asked for
    if of.speeds.1 > top {
        let asked = if within.ranges.is_empty() { vec![of.speeds] } else { std::mem::take(&mut within.ranges) };
        within.ranges = asked.into_iter().filter(|r| r.0 < top).map(|r| (r.0, r.1.min(top))).collect();
    }
    if within.ranges.is_empty() && of.speeds.1 > top {
        check.wrong(at_rated, format!("{found}, expected one of which the limit's speeds are no more than {}", rule.top()));
        return None;
    }
    Some(whole / PA_PER_MPA)
}

pub(super) fn natural_frequency<'r>(check: &mut Check, band: &'r RawBand, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    let ends: Vec<f64> = band.outside_hz.get_ref().iter().map(|x| check.positive(x)).collect();
    let [low, high] = ends[..] else {
        check.wrong(&band.outside_hz, format!("found {} numbers, expected the ends of a band, Hz", ends.len()));
        return None;
    };
    if low >= high {
        check.wrong(&band.outside_hz, format!("found a band from {low} to {high} Hz, expected its lower end first"));
        return None;
    }
    let names = Names {
        key: "natural_frequency",
        column: "frequency_in_band",
        word: "frequency",
        what: "natural frequency",
        place: format!("outside {low} to {high} Hz"),
    };
    let parts = (vec![default_twist(chain, of.hub)], Over::Property(Property::Band { low, high }), Within::default());
    Some(Resolved { spec: spec(names, parts, UnitOf::Ratio), bound: Bound::Band })
}

pub(super) fn margin<'r, T>(check: &mut Check, m: &'r RawMargin, at: &At<T>, of: Context) -> Option<Resolved<'r>> {
    let chain = of.chain;
    let (index, fatigue) = criterion(check, m.criterion.as_ref(), at, of.fatigue)?;
    let within = of.within(check, m.within());
    let parts = (crank_torques(chain), Over::Margin(index), within);
    let by = fatigue.criteria[index];
    let names = Names { key: "margin", column: "", word: "", what: "margin", place: format!("by {}", by.name()) };
    let spec = spec(names, parts, UnitOf::Margin);
    let label = spec.label.replacen("peak", "smallest", 1);
    Some(Resolved { spec: MeasureSpec { column: by.column(), word: by.column(), label, ..spec }, bound: Bound::Least(m.min.as_ref()) })
}
