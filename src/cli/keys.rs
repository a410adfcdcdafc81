//! `hartog keys`: what may stand in files.

use super::exit::{DONE, fail, say, say_raw};
use crate::input::FileKind;
use crate::input::closest;
use crate::input::keys::{Key, keys};
use crate::report::results_json;
use crate::report::text::keys::{explained, list};

/// A kind of file.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum File {
    /// What is asked of an engine and its absorbers.
    Study,
    /// An engine with its torsional chain.
    Engine,
    /// Operating data of an engine that is sized.
    Sizing,
    /// Strengths of a material, for `hartog fatigue`.
    Material,
    /// Compounds of rubber and oils for dampers.
    Compounds,
    /// Many cases of studies, for `hartog campaign`.
    Campaign,
}

impl From<File> for FileKind {
    fn from(file: File) -> Self {
        match file {
            File::Study => Self::Study,
            File::Engine => Self::Engine,
            File::Sizing => Self::Sizing,
            File::Material => Self::Material,
            File::Compounds => Self::Compounds,
            File::Campaign => Self::Campaign,
        }
    }
}

/// What has a schema.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum Schema {
    /// What is asked of an engine and its absorbers.
    Study,
    /// An engine with its torsional chain.
    Engine,
    /// Operating data of an engine that is sized.
    Sizing,
    /// Strengths of a material, for `hartog fatigue`.
    Material,
    /// Compounds of rubber and oils for dampers.
    Compounds,
    /// Many cases of studies, for `hartog campaign`.
    Campaign,
    /// What a run found: `results.json`.
    Results,
}

impl Schema {
    fn text(self) -> String {
        match self {
            Self::Study => FileKind::Study.json_schema_text(),
            Self::Engine => FileKind::Engine.json_schema_text(),
            Self::Sizing => FileKind::Sizing.json_schema_text(),
            Self::Material => FileKind::Material.json_schema_text(),
            Self::Compounds => FileKind::Compounds.json_schema_text(),
            Self::Campaign => FileKind::Campaign.json_schema_text(),
            Self::Results => format!("{:#}\n", results_json::json_schema()),
        }
    }
}

/// Arguments of `keys`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  hartog keys crank_radius_mm\n  hartog keys pareto\n  hartog keys --file engine\n  hartog keys --json-schema study > study.schema.json"
)]
pub struct Arguments {
    /// A key, or part of its path, to be explained; without it all keys are listed.
    pub key: Option<String>,
    /// Keys of this kind of file only.
    #[arg(long, value_enum)]
    pub file: Option<File>,
    /// Print the JSON Schema of a kind of file, by which editors complete and explain keys; of `results`, what `results.json` holds.
    #[arg(long, value_enum, value_name = "FILE", conflicts_with_all = ["key", "file"])]
    pub json_schema: Option<Schema>,
}

/// Prints keys, or the schema of a file.
pub fn run(arguments: &Arguments) -> u8 {
    if let Some(schema) = arguments.json_schema {
        say_raw(&schema.text());
        return DONE;
    }
    let kinds = arguments.file.map_or_else(|| FileKind::ALL.to_vec(), |file| vec![file.into()]);
    let all: Vec<Key> = kinds.into_iter().flat_map(keys).collect();
    let Some(wanted) = &arguments.key else {
        for (i, kind) in FileKind::ALL.iter().enumerate() {
            let own: Vec<Key> = all.iter().filter(|k| k.file == *kind).cloned().collect();
            if !own.is_empty() {
                say(&format!("{}The {} file\n\n{}", if i > 0 { "\n" } else { "" }, kind.name(), list(&own)));
            }
        }
        say("\n`hartog keys KEY` tells what a key is, with an example.\n");
        return DONE;
    };
    // as it stands in a file: a limit is an objective with a bound
    let wanted = &wanted.trim_end_matches('.').replace("constraint.", "objective.");
    // a key of this name, or all that have it in their path
    let mut found: Vec<&Key> = all.iter().filter(|k| k.name() == wanted || k.path == *wanted).collect();
    if found.is_empty() {
        found = all.iter().filter(|k| k.path.contains(wanted.as_str())).collect();
    }
    if found.is_empty() {
        let names: Vec<&str> = all.iter().map(Key::name).collect();
        let hint = closest(wanted, &names).map_or_else(String::new, |n| format!("; did you mean `{n}`?"));
        return fail(&format!("error: found no key `{wanted}`{hint}"));
    }
    say(&explained(&found));
    DONE
}
