//! Campaigns: many cases of studies, each with other values of some keys.

use super::error::{At, Check, Source};
use super::overrides::Override;
use super::schema::campaign::{RawCampaign, RawEach, RawMethodOfSampling, RawSample, RawSampled, RawVariant, RawVary};
use super::{InputError, no_table};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// What is computed of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Each {
    /// The objectives and limits of given designs.
    Evaluate,
    /// The optima.
    Optimise,
    /// The front.
    Front,
    /// Designs, and optima where there are some, within tolerances.
    Robust,
}

impl Each {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Evaluate => "evaluate",
            Self::Optimise => "optimise",
            Self::Front => "front",
            Self::Robust => "robust",
        }
    }
}

/// One value of what varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// In tables: of numbers the number.
    pub label: String,
    /// The study, where it names one.
    pub study: Option<PathBuf>,
    /// Keys with their values.
    pub set: Vec<Override>,
}

/// What varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its column.
    pub name: String,
    /// Whether its labels are numbers.
    pub numeric: bool,
    /// Its values.
    pub variants: Vec<Variant>,
}

/// How a key is distributed.
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Between two values.
    Uniform(f64, f64),
    /// Gauss's, by mean and standard deviation.
    Normal(f64, f64),
    /// Values with their shares.
    Table(Vec<(f64, f64)>),
}

/// A key that points are drawn of.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// The key.
    pub key: String,
    /// Its column.
    pub name: String,
    /// How it is distributed; `None` of a table of points.
    pub distribution: Option<Distribution>,
}

/// How points are drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// Sobol's sequence.
    Sobol,
    /// A Latin hypercube.
    LatinHypercube,
    /// A full grid.
    Full,
    /// These points.
    Rows(Vec<Vec<f64>>),
}

/// Points that are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// How.
    pub drawing: Drawing,
    /// How many; of a full grid, of each key.
    pub points: usize,
    /// Of what is random.
    pub seed: u64,
    /// Whether in Saltelli's scheme.
    pub indices: bool,
    /// The keys.
    pub keys: Vec<Sampled>,
}

/// A campaign as checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaign {
    /// Name of its file without ending.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
    /// The study, where no variant names another.
    pub study: Option<PathBuf>,
    /// What is computed.
    pub each: Each,
    /// What varies; the first one makes the folders of its tables.
    pub axes: Vec<Axis>,
    /// What is drawn.
    pub sample: Option<Sample>,
    /// Relative error that objectives of given designs may have; `None`: rounding.
    pub tolerance: Option<f64>,
    /// Where it is given.
    pub cases_per_shard: Option<usize>,
}

/// Largest number of cases.
const MOST_CASES: usize = 100_000_000;

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
    if let Some(name) = &raw.partition {
        match axes.iter().position(|a| a.name == *name.get_ref()) {
            Some(i) => axes[..=i].rotate_right(1),
            None => check.wrong(name, format!("found `{}`, expected the name of a [[vary]]", name.get_ref())),
        }
    }
    let sample = raw.sample.as_ref().and_then(|s| sample(check, folder, s, &mut names));
    if raw.vary.is_empty() && raw.sample.is_none() {
        let message = "found nothing that varies, expected a [[vary]] or [sample]";
        check.mistakes.push(check.source.mistake(0..0, message.into(), None));
    }
    let cases_per_shard = raw.cases_per_shard.as_ref().map(|n| whole(check, n, 1, 1_000_000));
    let each = match raw.each {
        RawEach::Evaluate => Each::Evaluate,
        RawEach::Optimise => Each::Optimise,
        RawEach::Front => Each::Front,
        RawEach::Robust => Each::Robust,
    };
    let tolerance = raw.tolerance.as_ref().map(|t| {
        if each != Each::Evaluate {
            check.wrong(t, "found `tolerance` beside a search, whose optima are exact, expected it with `each = \"evaluate\"` only");
        }
        check.within(t, 1e-9..=0.1, "a share from 1e-9 to 0.1")
    });
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let campaign = Campaign { name, path: path.to_path_buf(), study, each, axes, sample, tolerance, cases_per_shard };
    if campaign.cases().is_none() {
        let message = format!("found more than {MOST_CASES} cases, expected fewer: each value of a [[vary]] is taken with all of the others");
        check.mistakes.push(check.source.mistake(0..0, message, None));
    }
    Some(campaign)
}

/// A file that is named.
fn file(check: &mut Check, folder: &Path, name: &At<String>) -> PathBuf {
    let path = folder.join(name.get_ref());
    if !path.is_file() {
        check.wrong_with_help(name, "file not found", super::error::looked_for(&path));
    }
    path
}

fn whole(check: &mut Check, n: &At<i64>, least: i64, most: i64) -> usize {
    let x = *n.get_ref();
    if !(least..=most).contains(&x) {
        check.wrong(n, format!("found {x}, expected a whole number from {least} to {most}"));
    }
    usize::try_from(x.clamp(least, most)).unwrap_or_default()
}

/// The column of a key that has no name of its own: the last of its parts that is no number.
fn column(key: &str) -> &str {
    key.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or(key)
}

/// Columns that every table has.
const TAKEN: [&str; 5] = ["case", "status", "reason", "design", "types"];

fn named<T>(check: &mut Check, at: &At<T>, name: Option<&At<String>>, key: Option<&At<String>>, names: &mut HashSet<String>) -> Option<String> {
    let own = match (name, key) {
        (Some(name), _) => name.get_ref().clone(),
        (None, Some(key)) => column(key.get_ref()).to_owned(),
        (None, None) => {
            check.wrong(at, "key `name` is missing in this table");
            return None;
        }
    };
    let plain = own.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') && own.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let mut wrong = |message: String| match name.or(key) {
        Some(place) => check.wrong(place, message),
        None => check.wrong(at, message),
    };
    if !plain {
        wrong(format!("found `{own}` as the name of a column, expected letters, digits and `_`; `name` gives another one"));
    } else if TAKEN.contains(&own.as_str()) || !names.insert(own.clone()) {
        wrong(format!("found the column `{own}` a second time, expected different ones; `name` gives another one"));
    }
    Some(own)
}

/// An override, as `--set` takes it.
fn set(check: &mut Check, at: &At<String>, text: &str) -> Option<Override> {
    Override::parse(text).map_err(|e| check.wrong_with_help(at, e.message, e.help.unwrap_or_else(|| "as --set takes it".into()))).ok()
}

fn axis(check: &mut Check, folder: &Path, raw: &At<RawVary>, names: &mut HashSet<String>) -> Option<Axis> {
    let own = raw.get_ref();
    let name = named(check, raw, own.name.as_ref(), own.key.as_ref(), names)?;
    let mut numeric = false;
    let variants: Vec<Variant> = match (&own.key, &own.values, &own.files) {
        (Some(key), Some(values), None) if own.variant.is_empty() => {
            numeric = values.get_ref().iter().all(|v| v.get_ref().is_float() || v.get_ref().is_integer());
            values.get_ref().iter().filter_map(|v| value(check, key, v.get_ref())).collect()
        }
        (Some(key), None, Some(pattern)) if own.variant.is_empty() => files(check, folder, key, pattern),
        (None, None, None) if !own.variant.is_empty() => own.variant.iter().map(|v| variant(check, folder, v)).collect(),
        _ => {
            check.wrong(raw, "found another choice, expected `key` with `values` or `files`, or [[vary.variant]]");
            return None;
        }
    };
    let mut seen = HashSet::new();
    if let Some(twice) = variants.iter().find(|v| !seen.insert(&v.label)) {
        check.wrong(raw, format!("found `{}` twice among the values of `{name}`, expected each once", twice.label));
    }
    if variants.is_empty() {
        check.wrong(raw, format!("found no value of `{name}`, expected at least one"));
    }
    Some(Axis { name, numeric, variants })
}

/// A value as it is told of: a list of one word is that word.
fn label(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Array(list) => list.iter().map(label).collect::<Vec<_>>().join("+"),
        other => other.to_string(),
    }
}

fn value(check: &mut Check, key: &At<String>, value: &toml::Value) -> Option<Variant> {
    let set = set(check, key, &format!("{}={value}", key.get_ref()))?;
    Some(Variant { label: label(value), study: None, set: vec![set] })
}

/// Files that a pattern finds, in the order of their names.
fn files(check: &mut Check, folder: &Path, key: &At<String>, pattern: &At<String>) -> Vec<Variant> {
    let whole = folder.join(pattern.get_ref());
    let found: Vec<PathBuf> = match glob::glob(&whole.to_string_lossy()) {
        Ok(paths) => paths.filter_map(Result::ok).filter(|p| p.is_file()).collect(),
        Err(e) => {
            check.wrong(pattern, format!("found `{}`, expected a pattern of file names: {}", pattern.get_ref(), e.msg));
            return Vec::new();
        }
    };
    if found.is_empty() {
        check.wrong_with_help(pattern, "found no file of this pattern, expected at least one", super::error::looked_for(&whole));
    }
    let one = |path: PathBuf| {
        let label = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if key.get_ref() == "study" {
            return Some(Variant { label, study: Some(path), set: Vec::new() });
        }
        let path = path.canonicalize().unwrap_or(path);
        let set = set(check, key, &format!("{}={}", key.get_ref(), toml::Value::from(path.to_string_lossy().into_owned())))?;
        Some(Variant { label, study: None, set: vec![set] })
    };
    found.into_iter().filter_map(one).collect()
}

fn variant(check: &mut Check, folder: &Path, raw: &RawVariant) -> Variant {
    check.name(&raw.name);
    let study = raw.study.as_ref().map(|s| file(check, folder, s));
    let set = raw.set.iter().filter_map(|text| set(check, text, text.get_ref())).collect();
    Variant { label: raw.name.get_ref().clone(), study, set }
}

fn sample(check: &mut Check, folder: &Path, raw: &At<RawSample>, names: &mut HashSet<String>) -> Option<Sample> {
    let own = raw.get_ref();
    let seed = own.seed.as_ref().map_or(1, |s| whole(check, s, 0, i64::MAX) as u64);
    if own.method == RawMethodOfSampling::File {
        let Some(named_file) = &own.file else {
            check.wrong(raw, "found the method `file` without `file`, expected a table of points");
            return None;
        };
        if let Some(other) = own.of.first() {
            check.wrong(other, "found [[sample.of]] beside a table of points, expected the keys as its columns");
        }
        let path = file(check, folder, named_file);
        let (heads, rows) = points(check, named_file, &path)?;
        let keys = heads.into_iter().map(|key| {
            let name = column(&key).to_owned();
            if TAKEN.contains(&name.as_str()) || !names.insert(name.clone()) {
                check.wrong(named_file, format!("found the column `{name}` a second time, expected different ones"));
            }
            _ = set(check, named_file, &format!("{key}=0"));
            Sampled { key, name, distribution: None }
        });
        let keys = keys.collect();
        return Some(Sample { points: rows.len(), drawing: Drawing::Rows(rows), seed, indices: false, keys });
    }
    if let Some(other) = &own.file {
        check.wrong(other, "found a table of points beside another method, expected `method = \"file\"`");
    }
    let Some(count) = &own.points else {
        check.wrong(raw, "key `points` is missing in this table");
        return None;
    };
    let points = whole(check, count, 1, 10_000_000);
    let keys: Vec<Sampled> = own.of.iter().filter_map(|s| sampled(check, s, names)).collect();
    if own.of.is_empty() {
        check.wrong(raw, "found no key to draw, expected [[sample.of]]");
    }
    let drawing = match own.method {
        RawMethodOfSampling::LatinHypercube => Drawing::LatinHypercube,
        RawMethodOfSampling::Full => Drawing::Full,
        RawMethodOfSampling::Sobol | RawMethodOfSampling::File => Drawing::Sobol,
    };
    if own.indices && drawing != Drawing::Sobol {
        check.wrong(raw, "found `indices` with another method, expected them with `method = \"sobol\"`");
    }
    Some(Sample { drawing, points, seed, indices: own.indices, keys })
}

/// The numbers of a table of points.
fn points(check: &mut Check, at: &At<String>, path: &Path) -> Option<(Vec<String>, Vec<Vec<f64>>)> {
    let bytes = super::error::read_bytes(path).map_err(|reason| check.wrong(at, reason)).ok()?;
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let heads: Vec<String> = reader.headers().ok()?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for (i, record) in reader.records().enumerate() {
        let cells = record.map_err(|e| check.wrong(at, format!("row {} of the table cannot be read: {e}", i + 2))).ok()?;
        let row: Vec<f64> = cells.iter().filter_map(|cell| cell.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
        if row.len() != heads.len() {
            check.wrong(at, format!("found a row {} of the table with a cell that is no number, expected numbers", i + 2));
            return None;
        }
        rows.push(row);
    }
    if rows.is_empty() || heads.is_empty() {
        check.wrong(at, "found a table without points, expected a column a key and a row a point");
        return None;
    }
    Some((heads, rows))
}

fn sampled(check: &mut Check, raw: &At<RawSampled>, names: &mut HashSet<String>) -> Option<Sampled> {
    let own = raw.get_ref();
    let name = named(check, raw, own.name.as_ref(), Some(&own.key), names)?;
    _ = set(check, &own.key, &format!("{}=0", own.key.get_ref()))?;
    let distribution = match (&own.uniform, &own.normal, &own.table) {
        (Some(range), None, None) => match range.get_ref().as_slice() {
            [low, high] if low.get_ref() < high.get_ref() && (high.get_ref() - low.get_ref()).is_finite() => {
                Distribution::Uniform(*low.get_ref(), *high.get_ref())
            }
            _ => {
                check.wrong(range, "found no range, expected two values, the lower one first");
                return None;
            }
        },
        (None, Some(n), None) => {
            Distribution::Normal(check.within(&n.mean, -1e20..=1e20, "a number up to 1e20"), check.positive(&n.deviation))
        }
        (None, None, Some(t)) => {
            let (values, shares) = (t.values.get_ref(), t.shares.get_ref());
            let sum: f64 = shares.iter().map(At::get_ref).sum();
            let positive = shares.iter().all(|s| *s.get_ref() > 0.0);
            if values.is_empty() || values.len() != shares.len() || !positive || (sum - 1.0).abs() > 1e-9 {
                check.wrong(&t.shares, "found other shares, expected one above zero for each value, 1 together");
                return None;
            }
            if let Some(wild) = values.iter().find(|v| !v.get_ref().is_finite()) {
                check.wrong(wild, "found no finite number, expected one");
            }
            Distribution::Table(values.iter().map(|v| *v.get_ref()).zip(shares.iter().map(|s| *s.get_ref())).collect())
        }
        _ => {
            check.wrong(raw, "found several distributions or none, expected one of `uniform`, `normal` and `table`");
            return None;
        }
    };
    Some(Sampled { key: own.key.get_ref().clone(), name, distribution: Some(distribution) })
}

impl Sample {
    /// How many points there are; `None` where they cannot be counted.
    pub fn count(&self) -> Option<usize> {
        let keys = self.keys.len();
        match (&self.drawing, self.indices) {
            (Drawing::Rows(rows), _) => Some(rows.len()),
            (Drawing::Full, _) => self.points.checked_pow(u32::try_from(keys).ok()?),
            (_, true) => self.points.checked_mul(keys + 2),
            (_, false) => Some(self.points),
        }
    }
}

impl Campaign {
    /// How many cases there are; `None` where there are too many.
    pub fn cases(&self) -> Option<usize> {
        let of_sample = self.sample.as_ref().map_or(Some(1), Sample::count)?;
        let all = self.axes.iter().try_fold(of_sample, |n, axis| n.checked_mul(axis.variants.len()))?;
        Some(all).filter(|n| *n <= MOST_CASES)
    }
}
