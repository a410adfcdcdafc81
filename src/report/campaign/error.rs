//! What keeps a campaign from going on.

use crate::files::WriteError;
use crate::input::InputError;
use std::path::PathBuf;

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
    /// A path that shells would read as something else.
    #[error("error: {} has a quote or `$` in its name, which the shells of schedulers would read: move it to a path without", path.display())]
    Quoted {
        /// The path.
        path: PathBuf,
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
