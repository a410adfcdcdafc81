//! Which shards of a campaign are done.

use super::manifest::Manifest;
use super::shard::{Receipt, receipt_path, table_path};
use super::whole_file::UNFINISHED;
use crate::files::WriteError;
use crate::input::campaign::Campaign;
use crate::input::{InputError, checksum};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What keeps a campaign from going on.
#[derive(Debug, thiserror::Error)]
#[doc(hidden)]
pub enum CampaignError {
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] WriteError),
    /// The campaign cannot be read.
    #[error(transparent)]
    Input(InputError),
    /// There is no campaign.
    #[error("error: {} holds no manifest.json, expected the folder of a campaign: `hartog campaign plan FLEET.toml --out DIR` makes one", folder.display())]
    NoManifest {
        /// The folder.
        folder: PathBuf,
    },
    /// Another campaign is there.
    #[error("error: {} is of another campaign, of {before}: {why}; name another folder with --out", folder.display())]
    Another {
        /// The folder.
        folder: PathBuf,
        /// The file of the other one.
        before: String,
        /// What differs.
        why: String,
    },
    /// Program or inputs have changed since the campaign was planned.
    #[error("error: the campaign cannot go on: {what}; plan it anew in another folder")]
    Changed {
        /// What has changed.
        what: String,
    },
    /// A file is damaged.
    #[error("error: {} is damaged: {why}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How.
        why: String,
    },
    /// A file is none of the campaign's.
    #[error("error: {} {what}, expected nothing but what the campaign writes there: move it away", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: &'static str,
    },
    /// There is no shard of this number.
    #[error("error: found shard {shard}, expected one from 0 to {}", shards - 1)]
    NoShard {
        /// The number.
        shard: usize,
        /// How many there are.
        shards: usize,
    },
}

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

/// A receipt, where it is one of this campaign and shard.
fn receipt(folder: &Path, manifest: &Manifest, shard: usize) -> Option<Receipt> {
    let bytes = std::fs::read(receipt_path(folder, shard)).ok()?;
    let own: Receipt = serde_json::from_slice(&bytes).ok()?;
    (own.campaign == manifest.address && own.shard == shard).then_some(own)
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

    /// The checksum of the tables that are done, by their names.
    pub fn digest(&self) -> String {
        let lines: BTreeSet<String> = self.done().map(|r| format!("{} {}", r.table, r.crc32)).collect();
        format!("{:08x}", crc32fast::hash(lines.into_iter().collect::<Vec<_>>().join("\n").as_bytes()))
    }

    /// Files among the tables that are none of the campaign's.
    ///
    /// # Errors
    /// [`CampaignError::Foreign`] for the first of them.
    pub fn only_own(folder: &Path, manifest: &Manifest, campaign: &Campaign) -> Result<(), CampaignError> {
        let own: BTreeSet<String> = (0..manifest.shards).filter_map(|i| table_path(manifest, campaign, i)).collect();
        let entries = |path: &Path| std::fs::read_dir(path).into_iter().flatten().filter_map(Result::ok).map(|e| e.path()).collect::<Vec<_>>();
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
    pub fn remove_unfinished(folder: &Path) {
        let entries = |path: &Path| std::fs::read_dir(path).into_iter().flatten().filter_map(Result::ok).map(|e| e.path()).collect::<Vec<_>>();
        let parts = entries(&folder.join("cases")).into_iter().flat_map(|p| entries(&p));
        let all = parts.chain(entries(&folder.join("receipts"))).chain(entries(folder));
        for file in all.filter(|f| f.file_name().is_some_and(|n| n.to_string_lossy().starts_with(UNFINISHED))) {
            // what is gone already is gone
            _ = std::fs::remove_file(file);
        }
    }
}
