//! `hartog campaign collect`.

use super::told::MISSING;
use crate::cli::exit::{DONE, FAILED, fail, say};
use crate::report::campaign::{Dataset, Manifest, PAGE, State, write_page};
use std::path::PathBuf;

/// Arguments of `campaign collect`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of a campaign.
    folder: PathBuf,
    /// Make the page of what is done so far.
    #[arg(long)]
    partial: bool,
}

/// Checks the shards of a campaign and writes its page.
pub(super) fn collect(arguments: &Arguments) -> u8 {
    let folder = arguments.folder.as_path();
    let opened = Manifest::read(folder).and_then(|manifest| Ok((manifest.campaign()?, manifest)));
    let (campaign, manifest) = match opened {
        Ok(opened) => opened,
        Err(error) => return fail(&error),
    };
    if let Err(error) = Dataset::only_own(folder, &manifest, &campaign) {
        return fail(&error);
    }
    let dataset = Dataset::read(folder, &manifest, true);
    let missing = dataset.missing();
    if !missing.is_empty() && !arguments.partial {
        let torn: Vec<String> = (0..manifest.shards).filter(|i| dataset.shards[*i] == State::Torn).map(|i| i.to_string()).collect();
        let torn =
            if torn.is_empty() { String::new() } else { format!("; the tables of {} are not as they were written", torn.join(", ")) };
        let path = folder.display();
        _ = fail(&format!(
            "error: {} of {} shards are missing{torn}: `hartog campaign run {path}` makes them, --partial does without",
            missing.len(),
            manifest.shards
        ));
        return MISSING;
    }
    if missing.is_empty() {
        Dataset::remove_unfinished(folder);
    }
    match write_page(folder, &manifest, &campaign, &dataset) {
        Ok(summary) => {
            say(&format!("{summary}\n{} in {}; digest of the tables {}\n", PAGE, folder.display(), dataset.digest()));
            if dataset.is_as_asked() { DONE } else { FAILED }
        }
        Err(error) => fail(&error),
    }
}
