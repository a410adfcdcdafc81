//! A shard's table and its receipt.

use super::error::CampaignError;
use super::manifest::Manifest;
use super::whole_file;
use crate::analysis::campaign::{Cell, Rows, Status, run_cases};
use crate::input::campaign::Campaign;
use crate::parquet;
use crate::reason::WriteError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What is known of a shard that is done.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct Receipt {
    /// Of which campaign.
    pub campaign: String,
    /// Its number, from 0.
    pub shard: usize,
    /// Its first case, and the first one after it.
    pub cases: [usize; 2],
    /// Its table, in the folder.
    pub table: String,
    /// Its rows.
    pub rows: usize,
    /// Size of the table.
    pub bytes: u64,
    /// CRC-32 of the table.
    pub crc32: String,
    /// How many rows came to what.
    pub statuses: BTreeMap<String, usize>,
}

/// Digits of numbers of shards.
const DIGITS: usize = 5;

/// The receipt of a shard in a folder.
pub(super) fn receipt_path(folder: &Path, shard: usize) -> PathBuf {
    folder.join("receipts").join(format!("{shard:0DIGITS$}.json"))
}

/// A label as the name of a folder: letters, digits and a few signs are themselves.
fn plain(label: &str) -> String {
    let own = |b: u8| b.is_ascii_alphanumeric() || b"-_.+".contains(&b);
    label.bytes().map(|b| if own(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect()
}

/// The table of a shard within the folder.
pub(super) fn table_path(manifest: &Manifest, campaign: &Campaign, shard: usize) -> Option<String> {
    let own = manifest.shard(campaign, shard)?;
    let (name, label) = match (own.partition, campaign.axes.first()) {
        (Some(p), Some(axis)) => (axis.name.as_str(), plain(&axis.variants[p].label)),
        _ => ("each", campaign.each.name().to_owned()),
    };
    Some(format!("cases/{name}={label}/shard-{shard:0DIGITS$}.parquet"))
}

/// Computes a shard and writes its table, then its receipt. `crashed`: cases that are known to end the program, which are not computed.
///
/// # Errors
/// [`CampaignError`] where there is no such shard, or a file cannot be written.
#[doc(hidden)]
pub fn write_shard(
    folder: &Path,
    manifest: &Manifest,
    campaign: &Campaign,
    shard: usize,
    crashed: &[usize],
) -> Result<Receipt, CampaignError> {
    let none = || CampaignError::NoShard { shard, shards: manifest.shards };
    let (own, table) = (manifest.shard(campaign, shard).ok_or_else(none)?, table_path(manifest, campaign, shard).ok_or_else(none)?);
    let mut all: Rows = Vec::new();
    let mut statuses: BTreeMap<String, usize> = BTreeMap::new();
    let status = manifest.columns.iter().position(|c| c.name == "status");
    run_cases(campaign, &manifest.columns, own.cases.clone(), crashed, &mut |_, rows| {
        for row in &rows {
            if let Some(Cell::Text(word)) = status.map(|i| &row[i]) {
                *statuses.entry(word.clone()).or_default() += 1;
            }
        }
        all.extend(rows);
    });
    let mut bytes = Vec::new();
    let path = folder.join(&table);
    parquet::write_cells(&manifest.columns, &all, &mut bytes)
        .map_err(|e| CampaignError::File(WriteError { path: path.clone(), reason: e.to_string() }))?;
    whole_file::write(&path, &bytes)?;
    let receipt = Receipt {
        campaign: manifest.address.clone(),
        shard,
        cases: [own.cases.start, own.cases.end],
        table,
        rows: all.len(),
        bytes: bytes.len() as u64,
        crc32: format!("{:08x}", crc32fast::hash(&bytes)),
        statuses,
    };
    let text = format!("{}\n", serde_json::to_string(&receipt).unwrap_or_default());
    whole_file::write(&receipt_path(folder, shard), text.as_bytes())?;
    Ok(receipt)
}

impl Receipt {
    /// Rows that came to a status.
    pub fn count(&self, status: Status) -> usize {
        self.statuses.get(status.word()).copied().unwrap_or_default()
    }
}
