//! The folder of a campaign: its manifest, a table and a receipt a shard, and its page.
//!
//! A shard is a function of the manifest, the inputs that it lists and its number to bytes; its receipt is written after its table. Whatever is killed, repeated or done in another order leaves the same files.

mod counted;
mod cut;
mod dampers;
mod dataset;
mod error;
mod export;
mod manifest;
mod page;
mod shard;
mod tables;
mod whole_file;

pub use counted::counted;
pub use dataset::{Dataset, State};
pub use error::CampaignError;
pub use export::{Scheduler, export};
pub use manifest::Manifest;
pub use page::{PAGE, write_page};
pub use shard::{Receipt, write_shard};
