//! The `hartog` command.

use clap::{CommandFactory, Parser, Subcommand};
use hartog::cli::{campaign, chart, check, compare, curves, fatigue, fit, import, keys, matrices, new, report, run, shell, size};
use hartog::report::formats::Format;
use std::path::PathBuf;
use std::process::ExitCode;

/// Designs torsional vibration absorbers for engine crankshafts.
#[derive(Debug, Parser)]
#[command(
    version,
    about,
    max_term_width = 120,
    after_help = "Examples:\n  hartog check studies/villalva_i6.toml\n  hartog run studies/villalva_i6.toml\n  hartog compare"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print all columns of all tables, however wide [default: those that decide, in at most 100 columns].
    #[arg(long, global = true)]
    wide: bool,
    /// Write plots as PDF, and tables as Parquet, beside SVG, PNG and CSV.
    #[arg(long, global = true, value_enum, value_delimiter = ',', value_name = "FORMATS")]
    format: Vec<Format>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Evaluate the designs of a study, find the optimal absorbers and the front, write tables and plots.
    Run(run::Arguments),
    /// Write a commented study and engine to begin with, which run at once.
    New(new::Arguments),
    /// Write a study and engine round a chain of one's own: a mass-elastic table or an assembly of openTorsion.
    Import(import::Arguments),
    /// Tell what may stand in files: every key with its unit, range, default and an example; or a JSON Schema for editors.
    Keys(keys::Arguments),
    /// Check a study and print the model it describes: chain, modes, pressure, what would be computed.
    Check(check::Arguments),
    /// Run many cases of studies, other loads, engines, types or tolerances, on this machine or a cluster.
    Campaign(campaign::Arguments),
    /// Chart speed against accuracy of every response method, how cost grows, and where each method fails.
    Chart(chart::Arguments),
    /// Set published tables beside our own numbers, each with its role.
    Compare(compare::Arguments),
    /// Plot what lies behind a design: pressure, forces, torque, bearings, crank loads, balance, modes, shafts, motions.
    Curves(curves::Arguments),
    /// Judge stress histories by multiaxial fatigue criteria.
    Fatigue(fatigue::Arguments),
    /// Fit the law of a type of absorber to measured stiffness over frequency and temperature, with standard errors.
    Fit(fit::Arguments),
    /// Read the matrices of a crank from a finite-element program and say what they are, or write those of a study's flexible crank.
    Matrices(matrices::Arguments),
    /// Write the calculation that a classification society asks for: Holzer's tables, vector sums, criticals, torques, misfire.
    Report(report::Arguments),
    /// Size piston pin, connecting rod and crank from operating data, and write the engine and study that follow.
    Size(size::Arguments),
    /// Print completions for a shell: `hartog completions bash > ~/.local/share/bash-completion/completions/hartog`.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Write a manual page of every command.
    Man {
        /// Folder for the pages.
        folder: PathBuf,
    },
}

/// Bytes; the GNU allocator heeds blocks of up to 32 MiB.
const LARGE: usize = 24 << 20;

/// The GNU allocator hands freed memory back to the system as soon as there are 128 KiB of it, which costs large studies 4 % of their time. Once a large block has been freed, it keeps twice as much \[mallopt(3), M_TRIM_THRESHOLD\]. The
/// block itself is never touched, and other allocators do not mind.
fn keep_freed_memory() {
    let mut block = Vec::<u8>::new();
    // where there is no room for it, nothing is lost
    let _ = block.try_reserve_exact(LARGE);
    drop(std::hint::black_box(block));
}

fn main() -> ExitCode {
    keep_freed_memory();
    let cli = Cli::parse();
    hartog::cli::exit::width(cli.wide);
    cli.format.iter().for_each(|f| f.ask());
    ExitCode::from(match cli.command {
        Command::Run(arguments) => run::run(&arguments),
        Command::New(arguments) => new::new(&arguments),
        Command::Completions { shell } => shell::completions(shell, &mut Cli::command()),
        Command::Man { folder } => shell::manual(&folder, &mut Cli::command()),
        Command::Import(arguments) => import::import(&arguments),
        Command::Keys(arguments) => keys::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Campaign(arguments) => campaign::campaign(&arguments),
        Command::Chart(arguments) => chart::chart(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments),
        Command::Curves(arguments) => curves::curves(&arguments),
        Command::Fatigue(arguments) => fatigue::fatigue(&arguments),
        Command::Fit(arguments) => fit::fit(&arguments),
        Command::Matrices(arguments) => matrices::matrices(&arguments),
        Command::Report(arguments) => report::report(&arguments),
        Command::Size(arguments) => size::size(&arguments),
    })
}
