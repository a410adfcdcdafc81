//! Engines that share dampers.

use super::spec::{Axis, Platform};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::SETS_OF_ENGINES;
use crate::input::schema::campaign::{RawCampaign, RawEach};
use crate::optimise::assignment::MOST_PARTIES;
use std::collections::{BTreeMap, HashSet};

/// Sets of engines whose common damper is sought where a campaign says nothing.
const SETS: usize = 2000;
/// Studies of a platform at most.
const MOST_STUDIES: usize = 256;

/// The platform of a campaign; what it covers is taken from among the axes.
pub(super) fn platform(check: &mut Check, raw: &RawCampaign, axes: &mut Vec<Axis>) -> Option<Platform> {
    let own = match (&raw.platform, raw.each) {
        (Some(own), RawEach::Platform) => own.get_ref(),
        (Some(own), _) => {
            check.wrong(own, "found [platform], expected it with `each = \"platform\"` only");
            return None;
        }
        (None, RawEach::Platform) => {
            let message = "key `platform` is missing in this table";
            check.mistakes.push(check.source.mistake(
                0..0,
                message.into(),
                Some("it names the [[vary]] whose values are the engines".into()),
            ));
            return None;
        }
        (None, _) => return None,
    };
    let mut take = |check: &mut Check, name: &At<String>| {
        let found = axes.iter().position(|a| a.name == *name.get_ref()).map(|i| axes.remove(i));
        if found.is_none() {
            check.wrong(name, format!("found `{}`, expected the name of another [[vary]]", name.get_ref()));
        }
        found
    };
    let engines = take(check, &own.engines);
    let loads: Vec<Axis> = own.loads.iter().filter_map(|name| take(check, name)).collect();
    let engines = engines?;
    if engines.variants.len() > MOST_PARTIES {
        check.wrong(&own.engines, format!("found {} engines, expected at most {MOST_PARTIES}", engines.variants.len()));
    }
    let targets = own.targets.as_ref().map(|targets| targets_of(check, targets, &engines));
    let sets = own.sets.as_ref().map_or(SETS, |n| check.whole(n, &SETS_OF_ENGINES) as usize);
    let platform = Platform { engines, loads, targets, sets };
    if platform.studies() > MOST_STUDIES {
        check.wrong(&own.engines, format!("found {} engines and loads together, expected at most {MOST_STUDIES}", platform.studies()));
    }
    Some(platform)
}

/// Columns of the results of a platform: how many dampers serve its engines,
#[doc(hidden)]
pub const DAMPERS: &str = "dampers";
/// which of them an engine has,
#[doc(hidden)]
pub const DAMPER: &str = "damper";
/// its objective over its target,
#[doc(hidden)]
pub const RATIO: &str = "ratio";
/// the largest of all engines,
#[doc(hidden)]
pub const WORST_RATIO: &str = "worst_ratio";
/// and what no assignment of so many dampers is below.
#[doc(hidden)]
pub const BOUND_OF_RATIO: &str = "lower_bound_of_worst_ratio";
/// All of them.
const RESULTS: [&str; 5] = [DAMPERS, DAMPER, RATIO, WORST_RATIO, BOUND_OF_RATIO];

/// What varies has no name of these.
pub(super) fn not_of_results(check: &mut Check, raw: &RawCampaign, names: &HashSet<String>) {
    for name in RESULTS.iter().filter(|name| names.contains(**name)) {
        let given = raw.vary.iter().filter_map(|v| v.get_ref().name.as_ref()).find(|n| n.get_ref().eq_ignore_ascii_case(name));
        let message = format!("found `{name}` as the name of what varies, which the tables of a platform have, expected another name");
        match (given, &raw.platform) {
            (Some(given), _) => check.wrong(given, message),
            (None, Some(platform)) => check.wrong(platform, message),
            (None, None) => {}
        }
    }
}

/// The target of each engine.
fn targets_of(check: &mut Check, targets: &At<BTreeMap<String, At<f64>>>, engines: &Axis) -> Vec<f64> {
    let labels = || engines.variants.iter().map(|v| v.label.as_str());
    // 1 and 1.0 are one value of a key
    let is = |name: &str, label: &str| name == label || engines.numeric && name.parse::<f64>().is_ok_and(|x| label.parse() == Ok(x));
    let of = |label: &str| targets.get_ref().iter().find(|t| is(t.0, label)).map(|t| t.1);
    for (name, value) in targets.get_ref() {
        if !labels().any(|label| is(name, label)) {
            let message =
                format!("found `{name}`, expected one of the values of `{}`: {}", engines.name, labels().collect::<Vec<_>>().join(", "));
            check.wrong(value, message);
        }
        check.positive(value);
    }
    let missing: Vec<&str> = labels().filter(|label| of(label).is_none()).collect();
    if !missing.is_empty() {
        check.wrong(targets, format!("found no target of {}, expected one for each of `{}`", missing.join(", "), engines.name));
    }
    labels().map(|label| of(label).map_or(1.0, |x| *x.get_ref())).collect()
}
