//! `hartog campaign`: many cases of studies, cut into shards that any scheduler can run.

mod collect;
mod export;
mod isolate;
mod plan;
mod run;
mod status;
mod told;

/// Arguments of `campaign`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  hartog campaign plan studies/fleet.toml --out fleet\n  hartog campaign run fleet\n  hartog campaign status fleet\n  \
hartog campaign collect fleet\n\n\
A shard is a function of the campaign, its inputs, the program and its number: shards may be run in any order, anywhere, killed and repeated, and give\n\
the same bytes.\n\n\
Exit code: 0 done, 1 some cases are not as asked: they break limits or have no result, 2 bad input, 3 shards are missing."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Expand a campaign, check its studies, time some of its cases, and write its manifest.
    Plan(plan::Arguments),
    /// Run the shards that are missing, or some of them.
    Run(run::Arguments),
    /// Tell what is done, missing and failed, and the processor time that is left.
    Status(status::Arguments),
    /// Check all shards, and write the page of the campaign.
    Collect(collect::Arguments),
    /// Write what submits the shards to Slurm, or runs them with Snakemake, GNU parallel or HyperQueue.
    Export(export::Arguments),
}

/// Does what a campaign is asked for.
pub fn campaign(arguments: &Arguments) -> u8 {
    match &arguments.command {
        Command::Plan(arguments) => plan::plan(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Status(arguments) => status::status(arguments),
        Command::Collect(arguments) => collect::collect(arguments),
        Command::Export(arguments) => export::export(arguments),
    }
}
