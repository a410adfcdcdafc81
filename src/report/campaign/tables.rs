//! The tables of a campaign in memory, column by column.

use super::dataset::Dataset;
use super::error::CampaignError;
use super::manifest::Manifest;
use crate::parquet::{ReadColumn, read_columns};
use std::collections::BTreeMap;
use std::path::Path;

/// A column of all shards.
#[derive(Debug, Clone)]
pub(super) enum Values {
    /// Numbers, whole ones and truths (0 and 1) with them; what is nothing is not a number.
    Numbers(Vec<f64>),
    /// Words, by their places in a list; `None` of nothing.
    Words(Vec<Option<usize>>, Vec<String>),
}

/// All rows.
#[derive(Debug)]
pub(super) struct Rows {
    pub names: Vec<String>,
    pub columns: Vec<Values>,
    pub count: usize,
}

impl Rows {
    /// Those of the shards that are done, in the order of their numbers.
    ///
    /// # Errors
    /// [`CampaignError::Damaged`] where a table cannot be read.
    pub fn read(folder: &Path, manifest: &Manifest, dataset: &Dataset) -> Result<Self, CampaignError> {
        let names: Vec<String> = manifest.columns.iter().map(|c| c.name.clone()).collect();
        let mut columns: Vec<Option<Values>> = vec![None; names.len()];
        let mut known: Vec<BTreeMap<String, usize>> = vec![BTreeMap::new(); names.len()];
        let mut count = 0;
        for receipt in dataset.done() {
            let path = folder.join(&receipt.table);
            let damaged = |why: String| CampaignError::Damaged { path: path.clone(), why };
            let read = read_columns(&path).map_err(|e| damaged(e.to_string()))?;
            if read.len() != names.len() {
                return Err(damaged(format!("found {} columns, expected {}", read.len(), names.len())));
            }
            for ((own, known), more) in columns.iter_mut().zip(&mut known).zip(read) {
                match (own, more) {
                    (Some(Values::Numbers(all)), ReadColumn::Numbers(more)) => all.extend(more),
                    (own @ None, ReadColumn::Numbers(more)) => *own = Some(Values::Numbers(more)),
                    (own, ReadColumn::Words(more)) => {
                        let Values::Words(all, list) = own.get_or_insert(Values::Words(Vec::new(), Vec::new())) else { continue };
                        for word in more {
                            all.push(word.map(|word| {
                                *known.entry(word).or_insert_with_key(|word| {
                                    list.push(word.clone());
                                    list.len() - 1
                                })
                            }));
                        }
                    }
                    (Some(Values::Words(..)), ReadColumn::Numbers(_)) => return Err(damaged("a column is of another kind".into())),
                }
            }
            let lengths = columns.iter().flatten().map(|c| match c {
                Values::Numbers(all) => all.len(),
                Values::Words(all, _) => all.len(),
            });
            count += receipt.rows;
            if lengths.into_iter().any(|n| n != count) {
                return Err(damaged(format!("its rows are not the {} of its receipt", receipt.rows)));
            }
        }
        let columns = columns.into_iter().map(|c| c.unwrap_or(Values::Numbers(Vec::new()))).collect();
        Ok(Self { names, columns, count })
    }

    /// The numbers of a column.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        match &self.columns[self.names.iter().position(|n| n == name)?] {
            Values::Numbers(all) => Some(all),
            Values::Words(..) => None,
        }
    }

    /// What stands in a row of a column, as words.
    pub fn word(&self, name: &str, row: usize) -> String {
        match self.names.iter().position(|n| n == name).map(|i| &self.columns[i]) {
            Some(Values::Words(all, list)) => all.get(row).copied().flatten().map_or_else(String::new, |i| list[i].clone()),
            Some(Values::Numbers(all)) => all.get(row).filter(|x| x.is_finite()).map_or_else(String::new, |x| told(*x)),
            None => String::new(),
        }
    }

    /// The same with all digits of numbers.
    pub fn exact(&self, name: &str, row: usize) -> String {
        self.numbers(name).and_then(|all| all.get(row)).filter(|x| x.is_finite()).map_or_else(|| self.word(name, row), |x| format!("{x}"))
    }

    /// Rows by what stands in some columns, in the order in which that first appears.
    pub fn groups(&self, names: &[&str]) -> Vec<(Vec<String>, Vec<usize>)> {
        let mut list: Vec<(Vec<String>, Vec<usize>)> = Vec::new();
        let mut places: BTreeMap<Vec<String>, usize> = BTreeMap::new();
        for row in 0..self.count {
            let key: Vec<String> = names.iter().map(|n| self.exact(n, row)).collect();
            let place = *places.entry(key).or_insert_with_key(|key| {
                list.push((key.clone(), Vec::new()));
                list.len() - 1
            });
            list[place].1.push(row);
        }
        list
    }
}

/// A whole number as it is, another one with four digits.
fn told(x: f64) -> String {
    const WHOLE: f64 = 1e9;
    if x.fract() == 0.0 && x.abs() < WHOLE { format!("{x}") } else { crate::text::short(x) }
}
