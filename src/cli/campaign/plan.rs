//! `hartog campaign plan`.

use super::told::processor_time;
use crate::analysis::Progress;
use crate::analysis::campaign::{Column, columns, run_cases};
use crate::cli::exit::{DONE, fail, say, say_to_error};
use crate::cli::progress::Bar;
use crate::input::campaign::{Campaign, Drawing, read_campaign};
use crate::input::{InputError, InputFile, MeasureSpec, Study, noted};
use crate::report::campaign::{Manifest, counted};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

/// Arguments of `campaign plan`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Campaign file (TOML).
    campaign: PathBuf,
    /// Folder of the campaign.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// A shard takes about so long, s, and no less than the other where there are few cases.
const SHARD: f64 = 60.0;
const SHORT: f64 = 2.0;
/// So many shards at least, where they are not shorter than that.
const SHARDS: usize = 32;
/// Cases of a shard at most.
const MOST: usize = 100_000;

/// Places in the campaign where cases are timed, and how many there; of cases that take no time, more, and of slow ones the first only.
const PLACES: usize = 8;
const CASES: usize = 4;
const QUICK: (f64, usize) = (0.1, 1024);
const SLOW: f64 = 0.5;
/// After so long no further place is looked at, s.
const LONG: f64 = 10.0;

/// Cases of a platform up to which none is timed.
const MOST_PLATFORMS: usize = 64;

/// A combination that is refused.
struct Refused {
    /// Its labels.
    labels: Vec<String>,
    /// Why: what refusals are told apart by, and all of it.
    reason: String,
    told: String,
}

impl Refused {
    fn of(labels: Vec<&str>, error: &InputError) -> Self {
        Self { labels: labels.into_iter().map(str::to_owned).collect(), reason: error.mistakes[0].message.clone(), told: error.to_string() }
    }
}

/// What reading the first case of every combination has told.
struct Checked {
    columns: Vec<Column>,
    /// The first objective of the first study.
    objective: Option<MeasureSpec>,
    refused: Vec<Refused>,
    combinations: usize,
}

/// Plans a campaign.
pub(super) fn plan(arguments: &Arguments) -> u8 {
    crate::cli::threads(Some(1));
    let (read, mut inputs) = noted(|| read_campaign(&arguments.campaign));
    let campaign = match read {
        Ok(campaign) => campaign,
        Err(error) => return fail(&error),
    };
    let (checked, files) = check(&campaign);
    for file in files {
        if inputs.iter().all(|f| f.path != file.path) {
            inputs.push(file);
        }
    }
    let Some(objective) = &checked.objective else {
        let Refused { labels, told, .. } = &checked.refused[0];
        let of =
            if labels.is_empty() { "of every case".to_owned() } else { format!("of {} and every other combination", labels.join(", ")) };
        return fail(&format!("{told}\nso {of}"));
    };
    let refused = told(&checked);
    let cases = campaign.cases().unwrap_or_default();
    // a case of a platform is a search of many optima: a few of them are run sooner than timed
    let seconds = (campaign.platform.is_none() || cases > MOST_PLATFORMS).then(|| seconds_per_case(&campaign, &checked.columns));
    let per_shard = campaign.cases_per_shard.unwrap_or_else(|| seconds.map_or(1, |seconds| cases_per_shard(cases, seconds).min(cases)));
    let manifest = Manifest::new(&campaign, &inputs, (checked.columns, objective), (per_shard, seconds));
    if let Err(error) = manifest.write(&arguments.out) {
        return fail(&error);
    }
    if !refused.is_empty() {
        say_to_error(&refused);
    }
    let folder = arguments.out.display();
    say(&format!(
        "{}: {}, {}\n  {}\n  {} read; {}{} of {}\nwritten to {folder}: `hartog campaign run {folder}` runs it\n",
        campaign.name,
        counted(cases, "case"),
        campaign.each.name(),
        question(&campaign),
        counted(inputs.len(), "file"),
        seconds.zip(manifest.hours(cases)).map_or_else(String::new, |(s, hours)| format!(
            "{} a case: {} in ",
            duration(s),
            processor_time(hours)
        )),
        counted(manifest.shards, "shard"),
        counted(per_shard.min(cases), "case")
    ));
    DONE
}

/// Refusals of different kinds that are told.
const KINDS: usize = 3;

/// Combinations that are refused, one of each kind.
fn told(checked: &Checked) -> String {
    let mut kinds: Vec<(&str, usize, &Refused)> = Vec::new();
    for own in &checked.refused {
        let message = own.reason.as_str();
        match kinds.iter_mut().find(|k| k.0 == message) {
            Some(known) => known.1 += 1,
            None => kinds.push((message, 1, own)),
        }
    }
    let one = |(_, count, Refused { labels, told, .. }): &(&str, usize, &Refused)| {
        let of = if labels.is_empty() { String::new() } else { format!(", as {}", labels.join(", ")) };
        format!("warning: {count} of {} refused{of}:\n{told}", counted(checked.combinations, "combination"))
    };
    kinds.iter().take(KINDS).map(one).collect::<Vec<_>>().join("\n")
}

/// What varies, in a line.
fn question(campaign: &Campaign) -> String {
    let axes = campaign.axes.iter().map(|a| format!("{} {}", a.variants.len(), a.name));
    let platform = campaign.platform.iter().map(|p| {
        let axes: Vec<String> = p.axes().map(|a| format!("{} of {}", counted(a.variants.len(), "value"), a.name)).collect();
        let by = if p.targets.is_some() { "targets given" } else { "in units of the optimum of each alone" };
        format!("dampers for {} ({by})", axes.join(" at "))
    });
    let sample = campaign.sample.iter().map(|s| {
        let by = match (&s.drawing, s.indices) {
            (Drawing::Sobol, true) => "Saltelli's scheme",
            (Drawing::Sobol, false) => "Sobol's sequence",
            (Drawing::LatinHypercube, _) => "Latin hypercube",
            (Drawing::Full, _) => "full grid",
            (Drawing::Rows(_), _) => "table",
        };
        let keys: Vec<&str> = s.keys.iter().map(|k| k.name.as_str()).collect();
        format!("{} of {} ({by})", counted(s.count().unwrap_or_default(), "point"), keys.join(", "))
    });
    axes.chain(platform).chain(sample).collect::<Vec<_>>().join(" x ")
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{s:.2} s"),
        s if s >= 1e-3 => format!("{:.2} ms", 1e3 * s),
        s => format!("{:.1} µs", 1e6 * s),
    }
}

/// Reads the study of every combination of what varies, with the first point of the sample.
fn check(campaign: &Campaign) -> (Checked, Vec<InputFile>) {
    let mut files: Vec<InputFile> = Vec::new();
    let mut refused = Vec::new();
    // of studies with the same columns one is enough
    let mut studies: Vec<(Vec<Column>, Study)> = Vec::new();
    let mut combinations = 0;
    for case in campaign.first_cases() {
        combinations += 1;
        let mut own: Vec<Study> = Vec::new();
        let members = campaign.members(&case);
        for member in &members {
            let (study, read) = noted(|| campaign.study_of_case(member));
            files.extend(read.into_iter().filter(|f| files.iter().all(|known| known.path != f.path)).collect::<Vec<_>>());
            match study {
                Ok(study) => own.push(study),
                Err(error) => {
                    refused.push(Refused::of(campaign.labels(member), &error));
                    break;
                }
            }
        }
        if own.len() < members.len() {
            continue;
        }
        if let Some(reason) = campaign.disagreement(&case, &own) {
            let labels = campaign.labels(&case).into_iter().map(str::to_owned).collect();
            refused.push(Refused { labels, told: format!("error: {reason}"), reason });
            continue;
        }
        for study in own {
            let own = columns(campaign, std::iter::once(&study));
            if studies.iter().all(|s| s.0 != own) {
                studies.push((own, study));
            }
        }
    }
    let columns = columns(campaign, studies.iter().map(|s| &s.1));
    let objective = studies.first().map(|s| s.1.objective.clone());
    if let Some(other) = studies
        .iter()
        .map(|s| &s.1.objective)
        .find(|o| campaign.platform.is_none() && objective.as_ref().is_some_and(|first| first.column != o.column))
    {
        let first = objective.as_ref().map_or("", |o| o.column.as_str());
        say_to_error(&format!(
            "warning: studies differ in their first objective: the page compares by `{first}`, not by `{}`",
            other.column
        ));
    }
    (Checked { columns, objective, refused, combinations }, files)
}

/// Time of a case, s: of some in a row at a few places, less that of the first one, which the others may share.
fn seconds_per_case(campaign: &Campaign, columns: &[Column]) -> f64 {
    let cases = campaign.cases().unwrap_or_default();
    let timed = |start: usize, count: usize| {
        let begun = Instant::now();
        run_cases(campaign, columns, start..(start + count).min(cases), &[], &mut |_, _| {});
        begun.elapsed().as_secs_f64()
    };
    let place = |start: usize| {
        let one = timed(start, 1);
        if one > SLOW {
            return one;
        }
        let some = CASES.min(cases - start);
        let mut taken = (timed(start, some), some);
        // by fours: what follows quick cases, as refused ones are, need not be quick
        while taken.0 < QUICK.0 && taken.1 < QUICK.1.min(cases - start) {
            let more = (4 * taken.1).min(cases - start);
            taken = (timed(start, more), more);
        }
        if taken.1 > 1 { ((taken.0 - one) / (taken.1 - 1) as f64).max(1e-7) } else { one }
    };
    // the golden ratio spreads places over any number of cases
    let starts: BTreeSet<usize> = (0..PLACES).map(|i| ((0.5 + 0.618_034 * i as f64).fract() * cases as f64) as usize).collect();
    let (bar, begun, mut found) = (Bar::default(), Instant::now(), Vec::new());
    bar.stage("times of cases", starts.len());
    for start in starts {
        found.push(place(start));
        bar.step();
        if begun.elapsed().as_secs_f64() > LONG {
            break;
        }
    }
    found.iter().sum::<f64>() / found.len() as f64
}

/// A round number of cases that take about a minute.
fn cases_per_shard(cases: usize, seconds: f64) -> usize {
    let of = |time: f64| (time / seconds).clamp(1.0, MOST as f64) as usize;
    let most = of(SHARD).min(of(SHORT).max(cases.div_ceil(SHARDS))).max(1);
    let ten = 10_usize.pow(most.ilog10());
    [5, 2, 1].iter().map(|k| k * ten).find(|n| *n <= most).unwrap_or(1)
}
