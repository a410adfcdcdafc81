//! Points that are drawn.

use super::named::{column, file, free, named, set};
use super::spec::{Distribution, Drawing, Sample, Sampled};
use crate::input::error::{At, Check, read_bytes};
use crate::input::schema::bounds::{ANY, POINTS_OF_SAMPLE, SEED};
use crate::input::schema::campaign::{RawMethodOfSampling, RawSample, RawSampled};
use std::collections::HashSet;
use std::path::Path;

pub(super) fn sample(check: &mut Check, folder: &Path, raw: &At<RawSample>, names: &mut HashSet<String>) -> Option<Sample> {
    let own = raw.get_ref();
    let seed = own.seed.as_ref().map_or(1, |s| check.whole(s, &SEED));
    if own.method == RawMethodOfSampling::File {
        let Some(named_file) = &own.file else {
            check.wrong(raw, "found the method `file` without `file`, expected a table of points");
            return None;
        };
        if let Some(other) = own.of.first() {
            check.wrong(other, "found [[sample.of]] beside a table of points, expected the keys as its columns");
        }
        if own.indices || own.points.is_some() || own.seed.is_some() {
            check.wrong(raw, "found `points`, `seed` or `indices` beside a table of points, expected none of them");
        }
        let path = file(check, folder, named_file);
        let (heads, rows) = points(check, named_file, &path)?;
        let keys = heads.into_iter().map(|key| {
            let name = column(&key).to_owned();
            free(check, named_file, &name, names);
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
    let points = check.whole(count, &POINTS_OF_SAMPLE) as usize;
    let keys: Vec<Sampled> = own.of.iter().filter_map(|s| sampled(check, s, names)).collect();
    if own.of.is_empty() {
        check.wrong(raw, "found no key to draw, expected [[sample.of]]");
    }
    if own.method == RawMethodOfSampling::Sobol && keys.len() * (1 + usize::from(own.indices)) > MOST_DIMENSIONS {
        let of = if own.indices { "half of them with `indices`" } else { "half as many with `indices`" };
        check.wrong(raw, format!("found {} keys of Sobol's sequence, expected at most {MOST_DIMENSIONS}, {of}", keys.len()));
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

/// Dimensions of Sobol's sequence.
const MOST_DIMENSIONS: usize = 100;

/// The numbers of a table of points.
fn points(check: &mut Check, at: &At<String>, path: &Path) -> Option<(Vec<String>, Vec<Vec<f64>>)> {
    let bytes = read_bytes(path).map_err(|reason| check.wrong(at, reason)).ok()?;
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let heads = reader.headers().map_err(|e| check.wrong(at, format!("the header of the table cannot be read: {e}"))).ok()?;
    let heads: Vec<String> = heads.iter().map(|h| h.trim_start_matches('\u{feff}').trim().to_owned()).collect();
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
        (None, Some(n), None) => Distribution::Normal(check.within(&n.mean, &ANY), check.positive(&n.deviation)),
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
