//! Which shards of a campaign are done.

use super::error::CampaignError;
use super::manifest::Manifest;
use super::shard::{Receipt, receipt_path, table_path};
use super::whole_file::UNFINISHED;
use crate::analysis::campaign::Status;
use crate::input::campaign::Campaign;
use crate::input::checksum;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What is known of a shard.
#[derive(Debug, Clone, PartialEq, Eq)]
#[doc(hidden)]
pub enum State {
    /// It is done.
    Done(Receipt),
    /// It has no receipt.
    Missing,
    /// It has a receipt, but its table is not as that says.
    Torn,
}

/// The shards of a campaign.
#[derive(Debug)]
#[doc(hidden)]
pub struct Dataset {
    /// Of each, by its number.
    pub shards: Vec<State>,
}

/// Paths in a folder; none where there is no such folder.
fn entries(path: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(path).into_iter().flatten().filter_map(Result::ok).map(|e| e.path()).collect()
}

/// A receipt, where it is one of this campaign and shard.
fn receipt(folder: &Path, manifest: &Manifest, shard: usize) -> Option<Receipt> {
    let bytes = std::fs::read(receipt_path(folder, shard)).ok()?;
    let own: Receipt = serde_json::from_slice(&bytes).ok()?;
    let rows: usize = own.statuses.values().sum();
    let cases = own.cases[0] <= own.cases[1] && own.cases[1] <= manifest.cases && own.cases[1] - own.cases[0] <= manifest.cases_per_shard;
    (own.campaign == manifest.address && own.shard == shard && rows == own.rows && cases).then_some(own)
}

impl Dataset {
    /// Looks at all shards; `thoroughly`: the checksums of their tables, too, not their sizes alone.
    pub fn read(folder: &Path, manifest: &Manifest, thoroughly: bool) -> Self {
        let state = |shard: usize| match receipt(folder, manifest, shard) {
            None => State::Missing,
            Some(own) => {
                let path = folder.join(&own.table);
                let whole = std::fs::metadata(&path).is_ok_and(|m| m.len() == own.bytes);
                let same = || !thoroughly || checksum(&path).is_ok_and(|sum| format!("{sum:08x}") == own.crc32);
                if whole && same() { State::Done(own) } else { State::Torn }
            }
        };
        Self { shards: (0..manifest.shards).map(state).collect() }
    }

    /// Numbers of those that are not done.
    pub fn missing(&self) -> Vec<usize> {
        self.shards.iter().enumerate().filter(|(_, s)| !matches!(s, State::Done(_))).map(|(i, _)| i).collect()
    }

    /// Receipts of those that are done.
    pub fn done(&self) -> impl Iterator<Item = &Receipt> {
        self.shards.iter().filter_map(|s| if let State::Done(receipt) = s { Some(receipt) } else { None })
    }

    /// How many rows came to each status.
    pub fn counts(&self) -> Vec<(Status, usize)> {
        Status::ALL.iter().map(|s| (*s, self.done().map(|r| r.count(*s)).sum())).collect()
    }

    /// Whether every row is as asked.
    #[doc(hidden)]
    pub fn is_as_asked(&self) -> bool {
        self.done().all(|r| r.count(Status::Ok) == r.rows)
    }

    /// The checksum of the tables that are done, by their names.
    #[doc(hidden)]
    pub fn digest(&self) -> String {
        let lines: BTreeSet<String> = self.done().map(|r| format!("{} {}", r.table, r.crc32)).collect();
        format!("{:08x}", crc32fast::hash(lines.into_iter().collect::<Vec<_>>().join("\n").as_bytes()))
    }

    /// Files among the tables that are none of the campaign's.
    ///
    /// # Errors
    /// [`CampaignError::Foreign`] for the first of them.
    #[doc(hidden)]
    pub fn only_own(folder: &Path, manifest: &Manifest, campaign: &Campaign) -> Result<(), CampaignError> {
        let own: BTreeSet<String> = (0..manifest.shards).filter_map(|i| table_path(manifest, campaign, i)).collect();
        let cases = folder.join("cases");
        for part in entries(&cases) {
            let files = if part.is_dir() { entries(&part) } else { vec![part] };
            for file in files {
                let name = file.strip_prefix(folder).map(|p| p.to_string_lossy().into_owned()).unwrap_or_default();
                let unfinished = file.file_name().is_some_and(|n| n.to_string_lossy().starts_with(UNFINISHED));
                if !unfinished && !own.contains(&name) {
                    return Err(CampaignError::Foreign { path: file, what: "is no table of the campaign" });
                }
            }
        }
        Ok(())
    }

    /// Removes what shards that were killed have not finished; none may be at work.
    #[doc(hidden)]
    pub fn remove_unfinished(folder: &Path) {
        let parts = entries(&folder.join("cases")).into_iter().flat_map(|p| entries(&p));
        let all = parts.chain(entries(&folder.join("receipts")));
        for file in all.filter(|f| f.file_name().is_some_and(|n| n.to_string_lossy().starts_with(UNFINISHED))) {
            // what is gone already is gone
            _ = std::fs::remove_file(file);
        }
    }
}
