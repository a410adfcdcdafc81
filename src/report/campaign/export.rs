//! Shards for programs that schedule: Slurm, Snakemake, GNU parallel, HyperQueue.

use super::error::CampaignError;
use super::manifest::Manifest;
use super::whole_file;
use std::path::Path;

/// A program that runs shards.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[doc(hidden)]
pub enum Scheduler {
    /// `submit.sh`: a job array, then one more of what is missing.
    Slurm,
    /// `Snakefile`: a rule that makes receipts.
    Snakemake,
    /// A line for a shell.
    Parallel,
    /// A line for a shell.
    Hyperqueue,
}

/// A word of a shell: paths with quotes are refused.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display())
}

/// A text of Python.
fn python(path: &Path) -> String {
    serde_json::Value::from(path.to_string_lossy().into_owned()).to_string()
}

const SLURM: &str = r#"#!/bin/sh
# Submits the shards of a campaign that are missing as an array of jobs, and after these once more those that are missing still; arguments are options of sbatch.
set -eu
hartog=@HARTOG@
folder=@FOLDER@
tries=${HARTOG_TRIES:-2}
missing=$("$hartog" campaign status "$folder" --missing || [ $? -eq 3 ])
if [ -z "$missing" ]; then
    echo "every shard is done: $hartog campaign collect $folder"
    exit 0
fi
[ "$tries" -gt 0 ] || { echo "shards are missing still"; exit 3; }
array=$(echo "$missing" | paste -sd, -)
job=$(sbatch --parsable --array="$array" --output=/dev/null --job-name=hartog "$@" --wrap "'$hartog' campaign run '$folder' --shard \$SLURM_ARRAY_TASK_ID || [ \$? -eq 1 ]")
echo "array $job"
HARTOG_TRIES=$((tries - 1)) sbatch --parsable --dependency="afterany:$job" --output=/dev/null --job-name=hartog-again "$@" --export=ALL "$folder/submit.sh" "$@"
"#;

const SNAKEMAKE: &str = r#"# A receipt a shard: snakemake --snakefile @SNAKEFILE@ --cores all
HARTOG = @HARTOG@
FOLDER = @FOLDER@
SHARDS = [f"{i:05d}" for i in range(@SHARDS@)]

rule all:
    input: expand(FOLDER + "/receipts/{shard}.json", shard=SHARDS)

rule shard:
    output: FOLDER + "/receipts/{shard}.json"
    params: number=lambda wildcards: int(wildcards.shard)
    threads: 1
    retries: 2
    shell: "'{HARTOG}' campaign run '{FOLDER}' --shard {params.number} || [ $? -eq 1 ]"
"#;

/// Writes a file where none is, or the same.
fn put(path: &Path, text: &str) -> Result<(), CampaignError> {
    match std::fs::read(path) {
        Ok(there) if there == text.as_bytes() => Ok(()),
        Ok(_) => Err(CampaignError::Foreign { path: path.to_path_buf(), what: "is there and is another file" }),
        Err(_) => whole_file::write(path, text.as_bytes()),
    }
}

/// Writes what a scheduler needs into the folder of a campaign, and tells what to do with it.
///
/// # Errors
/// [`CampaignError::File`] where a file cannot be written.
#[doc(hidden)]
pub fn export(folder: &Path, manifest: &Manifest, program: &Path, scheduler: Scheduler) -> Result<String, CampaignError> {
    let folder = &folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    if let Some(path) = [folder.as_path(), program].into_iter().find(|p| p.to_string_lossy().contains(['\'', '"', '`', '$'])) {
        return Err(CampaignError::Quoted { path: path.to_path_buf() });
    }
    let (hartog, own) = (quoted(program), quoted(folder));
    let run = format!("{hartog} campaign run {own} --shard");
    let missing = format!("{hartog} campaign status {own} --missing");
    match scheduler {
        Scheduler::Slurm => {
            let text = SLURM.replace("@HARTOG@", &hartog).replace("@FOLDER@", &own);
            let path = folder.join("submit.sh");
            put(&path, &text)?;
            Ok(format!("written to {0}: sh {0} --time=01:00:00 submits it\n", path.display()))
        }
        Scheduler::Snakemake => {
            let path = folder.join("Snakefile");
            let text = SNAKEMAKE
                .replace("@SNAKEFILE@", &path.to_string_lossy())
                .replace("@HARTOG@", &python(program))
                .replace("@FOLDER@", &python(folder))
                .replace("@SHARDS@", &manifest.shards.to_string());
            put(&path, &text)?;
            Ok(format!("written to {0}: snakemake --snakefile {0} --cores all runs it\n", path.display()))
        }
        Scheduler::Parallel => Ok(format!("{missing} | parallel \"{run} {{}} || [ \\$? -eq 1 ]\"\n")),
        Scheduler::Hyperqueue => {
            let list = quoted(&folder.join("missing.txt"));
            Ok(format!("{missing} > {list}; hq submit --each-line {list} sh -c \"{run} \\$HQ_ENTRY || [ \\$? -eq 1 ]\"\n"))
        }
    }
}
