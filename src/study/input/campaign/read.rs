//! The file of a campaign.

use super::axes::axis;
use super::named::file;
use super::platform::{not_of_results, platform};
use super::sample::sample;
use super::spec::{Axis, Campaign, Each, MOST_CASES, Platform, Sample};
use crate::input::InputError;
use crate::input::error::{At, Check, Source};
use crate::input::kinds::no_table;
use crate::input::overrides::Override;
use crate::input::schema::bounds::{CASES_PER_SHARD, RELATIVE_ERROR};
use crate::input::schema::campaign::{RawCampaign, RawEach};
use std::collections::HashSet;
use std::path::Path;

/// Reads and checks the file of a campaign. The studies are not read.
///
/// # Errors
/// [`InputError`] with every mistake found.
pub fn read_campaign(path: &Path) -> Result<Campaign, InputError> {
    let source = Source::read(path)?;
    no_table(&source, "a campaign in TOML", "it names a study and what varies of it")?;
    let raw: RawCampaign = source.parse()?;
    let mut check = Check::new(&source);
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let campaign = resolve(&mut check, path, folder, &raw);
    match campaign {
        Some(campaign) if check.mistakes.is_empty() => Ok(campaign),
        _ => Err(InputError::sorted(check.mistakes)),
    }
}

fn resolve(check: &mut Check, path: &Path, folder: &Path, raw: &RawCampaign) -> Option<Campaign> {
    let study = raw.study.as_ref().map(|s| file(check, folder, s));
    let mut names = HashSet::new();
    let mut axes: Vec<Axis> = raw.vary.iter().filter_map(|v| axis(check, folder, v, &mut names)).collect();
    if let Some(without) = raw.vary.iter().find(|_| study.is_none() && axes.iter().all(|a| a.variants.iter().any(|v| v.study.is_none()))) {
        check.wrong(without, "found no `study`, expected one here or in every variant of a [[vary]]");
    } else if raw.vary.is_empty() && study.is_none() {
        let message = "key `study` is missing in this table";
        check.mistakes.push(check.source.mistake(0..0, message.into(), None));
    }
    let platform = platform(check, raw, &mut axes);
    if let Some(name) = &raw.partition {
        match axes.iter().position(|a| a.name == *name.get_ref()) {
            Some(i) => axes[..=i].rotate_right(1),
            None => check.wrong(name, format!("found `{}`, expected the name of a [[vary]] by which cases differ", name.get_ref())),
        }
    }
    let sample = raw.sample.as_ref().and_then(|s| sample(check, folder, s, &mut names));
    if raw.vary.is_empty() && raw.sample.is_none() {
        let message = "found nothing that varies, expected a [[vary]] or [sample]";
        check.mistakes.push(check.source.mistake(0..0, message.into(), None));
    }
    if platform.is_some() {
        not_of_results(check, raw, &names);
    }
    let all: Vec<&Axis> = axes.iter().chain(platform.iter().flat_map(Platform::axes)).collect();
    only_once(check, raw, &all, sample.as_ref());
    let cases_per_shard = raw.cases_per_shard.as_ref().map(|n| check.whole(n, &CASES_PER_SHARD) as usize);
    let each = match raw.each {
        RawEach::Evaluate => Each::Evaluate,
        RawEach::Optimise => Each::Optimise,
        RawEach::Front => Each::Front,
        RawEach::Robust => Each::Robust,
        RawEach::Platform => Each::Platform,
    };
    let tolerance = raw.tolerance.as_ref().map(|t| {
        if each != Each::Evaluate {
            check.wrong(t, "found `tolerance` beside a search, whose optima are exact, expected it with `each = \"evaluate\"` only");
        }
        check.within(t, &RELATIVE_ERROR)
    });
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let campaign = Campaign { name, path: path.to_path_buf(), study, each, axes, sample, platform, tolerance, cases_per_shard };
    if campaign.cases().is_none() {
        let message =
            format!("found more than {MOST_CASES} cases, expected fewer: each value of a [[vary]] is taken with all of the others");
        check.mistakes.push(check.source.mistake(0..0, message, None));
    }
    Some(campaign)
}

/// A key has one value in a case: it is no key of two axes, or of an axis and the sample.
fn only_once(check: &mut Check, raw: &RawCampaign, axes: &[&Axis], sample: Option<&Sample>) {
    let mut known: HashSet<String> = HashSet::new();
    for (axis, own) in axes.iter().map(|a| (a, a.variants.iter().flat_map(|v| &v.set).map(Override::path).collect::<HashSet<_>>())) {
        if let Some(twice) = own.iter().find(|key| known.contains(*key)) {
            let message = format!("found `{twice}` of `{}` among the keys of another [[vary]], expected it in one of them", axis.name);
            let place = raw.vary.first().map_or(0..0, At::span);
            check.mistakes.push(check.source.mistake(place, message, None));
        }
        known.extend(own);
    }
    for (key, place) in sample.iter().flat_map(|s| &s.keys).map(|k| &k.key).zip(raw.sample.iter().flat_map(|s| &s.get_ref().of)) {
        if !known.insert(key.clone()) {
            check.wrong(place, format!("found `{key}` a second time, expected a key in one place"));
        }
    }
}
