//! What a campaign is of.

use super::error::CampaignError;
use super::whole_file;
use crate::analysis::campaign::{Column, Shard, compared_by};
use crate::input::campaign::{Campaign, read_campaign};
use crate::input::{InputFile, MeasureSpec, checksum};
use crate::manifest::PROGRAM;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Its name.
const MANIFEST: &str = "manifest.json";

/// What a campaign is of, and how it is cut into shards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct Manifest {
    /// The program that planned it.
    pub program: String,
    /// CRC-32 of the program.
    pub build: Option<u32>,
    /// What the campaign is called by: the CRC-32 of all that its results depend on.
    pub address: String,
    /// What is computed of each case.
    pub each: String,
    /// The campaign, before its studies, their engines and tables.
    pub inputs: Vec<InputFile>,
    /// Names of what varies, and of sampled keys.
    pub axes: Vec<String>,
    /// How many cases there are.
    pub cases: usize,
    /// How many a shard has at most.
    pub cases_per_shard: usize,
    /// How many shards there are.
    pub shards: usize,
    /// CRC-32 of what its file expands to.
    pub expanded: String,
    /// Mean time of a case on one thread, s: of some cases, where it was planned; `None` where none was timed.
    pub seconds_per_case: Option<f64>,
    /// Columns of the tables.
    pub columns: Vec<Column>,
    /// The column of the first objective.
    pub objective: String,
    /// Whether more of that is better.
    pub larger_is_better: bool,
}

/// CRC-32 of this program.
pub(super) fn build() -> Option<u32> {
    std::env::current_exe().and_then(|path| checksum(&path)).ok()
}

impl Manifest {
    /// That of a campaign, of which `inputs` were read.
    pub fn new(
        campaign: &Campaign,
        inputs: &[InputFile],
        (columns, objective): (Vec<Column>, &MeasureSpec),
        (cases_per_shard, seconds_per_case): (usize, Option<f64>),
    ) -> Self {
        let inputs: Vec<InputFile> =
            inputs.iter().map(|f| InputFile { path: f.path.canonicalize().unwrap_or_else(|_| f.path.clone()), ..f.clone() }).collect();
        let (compared_by, larger_is_better) = compared_by(campaign, &columns, objective);
        let axes = campaign.all_axes().map(|a| &a.name).chain(campaign.sample.iter().flat_map(|s| &s.keys).map(|k| &k.name));
        let mut own = Self {
            program: PROGRAM.to_owned(),
            build: build(),
            address: String::new(),
            each: campaign.each.name().to_owned(),
            inputs,
            axes: axes.cloned().collect(),
            cases: campaign.cases().unwrap_or_default(),
            cases_per_shard,
            shards: campaign.shards(cases_per_shard),
            expanded: format!("{:08x}", crc32fast::hash(campaign.expanded().as_bytes())),
            seconds_per_case,
            objective: compared_by,
            larger_is_better,
            columns,
        };
        own.address = own.address();
        own
    }

    /// The checksum of all that results depend on; where files are does not count.
    fn address(&self) -> String {
        let files = self.inputs.iter().map(|f| format!("{} {} {:08x}", f.path.file_name().unwrap_or_default().display(), f.bytes, f.crc32));
        let own = [
            self.program.clone(),
            format!("{:?}", self.build),
            self.cases_per_shard.to_string(),
            self.shards.to_string(),
            self.expanded.clone(),
        ];
        let text: Vec<String> = own.into_iter().chain(files).collect();
        format!("{:08x}", crc32fast::hash(text.join("\n").as_bytes()))
    }

    /// Time of some cases on one thread, hours; `None` where none was timed.
    pub fn hours(&self, cases: usize) -> Option<f64> {
        self.seconds_per_case.map(|seconds| seconds * cases as f64 / 3600.0)
    }

    /// Writes it into a folder.
    ///
    /// # Errors
    /// [`CampaignError`] where another campaign is there, or that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), CampaignError> {
        let path = folder.join(MANIFEST);
        if path.exists() {
            let there = Self::read(folder)?;
            if there.address != self.address {
                let files = |m: &Self| m.inputs.first().map(|f| f.path.display().to_string()).unwrap_or_default();
                return Err(CampaignError::Another { folder: folder.to_path_buf(), before: files(&there), why: there.difference(self) });
            }
            if there.inputs == self.inputs {
                return Ok(());
            }
            // the same files elsewhere
        } else if let Some(other) = ["cases", "receipts"].iter().map(|name| folder.join(name)).find(|p| p.exists()) {
            return Err(CampaignError::Foreign { path: other, what: "is there without a campaign's manifest.json" });
        }
        whole_file::write(&path, format!("{}\n", serde_json::to_string_pretty(self).unwrap_or_default()).as_bytes())
    }

    /// Reads that of a folder.
    ///
    /// # Errors
    /// [`CampaignError`] where there is none, or it is none of ours.
    pub fn read(folder: &Path) -> Result<Self, CampaignError> {
        let path = folder.join(MANIFEST);
        let bytes = std::fs::read(&path).map_err(|_| CampaignError::NoManifest { folder: folder.to_path_buf() })?;
        let own: Self = serde_json::from_slice(&bytes).map_err(|e| CampaignError::Damaged { path: path.clone(), why: e.to_string() })?;
        let why = "what it says is not what its address was made of".to_owned();
        if own.address == own.address() { Ok(own) } else { Err(CampaignError::Damaged { path, why }) }
    }

    /// What differs in a campaign that is planned now.
    fn difference(&self, now: &Self) -> String {
        if self.program != now.program || self.build != now.build {
            return "it was planned by another build of the program".to_owned();
        }
        let name = |f: &InputFile| f.path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let changed =
            now.inputs.iter().find(|f| !self.inputs.iter().any(|b| name(b) == name(f) && b.crc32 == f.crc32 && b.bytes == f.bytes));
        changed.map_or_else(|| "it is cut into other shards".to_owned(), |f| format!("`{}` is another file", name(f)))
    }

    /// Reads its campaign; program and inputs have to be those that it was planned with.
    ///
    /// # Errors
    /// [`CampaignError::Changed`] where they are not.
    pub fn campaign(&self) -> Result<Campaign, CampaignError> {
        let changed = |what: String| CampaignError::Changed { what };
        if self.program != PROGRAM || self.build != build() {
            return Err(changed(format!("it was planned by another build of {}, this is {PROGRAM}", self.program)));
        }
        for input in &self.inputs {
            let there = std::fs::metadata(&input.path).is_ok_and(|m| m.len() == input.bytes as u64);
            if !there || checksum(&input.path).ok() != Some(input.crc32) {
                return Err(changed(format!("`{}` is not as it was", input.path.display())));
            }
        }
        let path: PathBuf = self.inputs.first().map(|f| f.path.clone()).unwrap_or_default();
        let campaign = read_campaign(&path).map_err(CampaignError::Input)?;
        let expanded = format!("{:08x}", crc32fast::hash(campaign.expanded().as_bytes()));
        let same = expanded == self.expanded && campaign.shards(self.cases_per_shard) == self.shards;
        if same { Ok(campaign) } else { Err(changed(format!("the patterns of `{}` find other files than they did", path.display()))) }
    }

    /// A shard of its campaign.
    pub fn shard(&self, campaign: &Campaign, number: usize) -> Option<Shard> {
        campaign.shard(self.cases_per_shard, number)
    }
}
