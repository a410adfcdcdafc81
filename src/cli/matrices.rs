//! `hartog matrices`: matrices of a crank from and for other programs.

use super::exit::{DONE, FAILED, fail, files, paths, say};
use super::place::chosen;
use crate::crankshaft::flexible::imported::ImportedCrank;
use crate::crankshaft::flexible::{Carried, assemble, reduced};
use crate::input::matrices::{MatrixFiles, UnitSystem, structure};
use crate::input::{self, InputError, Study};
use crate::report::matrices::{MatrixFormat, matrices as told, roles, write_matrices};
use crate::report::{Folder, Job, Names, about_inputs, write_folder};
use crate::rotor::structure::{CrankAxis, Structure};
use crate::rotor::structure_checks::OfChain;
use std::path::PathBuf;

/// Arguments of `matrices`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  hartog matrices crank.sti --mass crank.mas --dof crank.dof --nodes nodes.csv --units mm_t\n  \
hartog matrices studies/villalva_i6_flexible.toml --modes 20 --to calculix\n\n\
FILE is a stiffness: Matrix Market, .sti of CalculiX, a substructure (.mtx) of CalculiX or Abaqus, node, component, node, component, value of Abaqus,\n\
DMIG or OP4 of Nastran; which one is seen from the text. Or a study with [crank.flexible]: its crank, free, with hub and flywheel, reduced to bearings,\n\
pins and ends. What is found is printed: symmetry, rigid modes, mass, inertia, frequencies; with --to it is written in SI.\n\n\
Exit code: 0 done, 1 something of the structure is unlikely, 2 bad input.")]
pub struct Arguments {
    /// Stiffness, or a study (TOML).
    pub file: PathBuf,
    /// Mass.
    #[arg(long, value_name = "FILE")]
    pub mass: Option<PathBuf>,
    /// Gyroscopic matrix of turning axes, per rad/s.
    #[arg(long, value_name = "FILE")]
    pub gyroscopic: Option<PathBuf>,
    /// Centrifugal matrix of turning axes with the stiffness of tension, per rad²/s².
    #[arg(long, value_name = "FILE")]
    pub turning: Option<PathBuf>,
    /// A line an unknown, node.component; component 0 is a mode.
    #[arg(long, value_name = "FILE")]
    pub dof: Option<PathBuf>,
    /// Places of the nodes (CSV): node, x, y, z.
    #[arg(long, value_name = "FILE")]
    pub nodes: Option<PathBuf>,
    /// Units of all files.
    #[arg(long, value_enum, default_value_t)]
    pub units: Units,
    /// Axis of the crank in the files.
    #[arg(long, value_enum, default_value_t)]
    pub axis: Axis,
    /// A study whose chain the structure is held against (TOML).
    #[arg(long, value_name = "STUDY")]
    pub study: Option<PathBuf>,
    /// Modes with the interface held beside it, of a study's crank [default: 20].
    #[arg(long, value_name = "N")]
    pub modes: Option<usize>,
    /// Format to write.
    #[arg(long, value_enum)]
    pub to: Option<To>,
    /// Output folder [default: out/FILE_matrices].
    #[arg(long, value_name = "DIR", requires = "to")]
    pub out: Option<PathBuf>,
}

/// Units of files.
#[derive(Debug, Clone, Copy, Default, clap::ValueEnum)]
pub enum Units {
    /// m, kg, N, s.
    #[default]
    Si,
    /// mm, t, N, s.
    #[value(name = "mm_t")]
    MmTonne,
}

/// Axis of a crank.
#[derive(Debug, Clone, Copy, Default, clap::ValueEnum)]
pub enum Axis {
    /// x becomes z, y becomes x, z becomes y.
    X,
    /// y becomes z, z becomes x, x becomes y.
    Y,
    /// As it is.
    #[default]
    Z,
}

/// Formats.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum To {
    /// Matrix Market.
    #[value(name = "matrix_market")]
    MatrixMarket,
    /// .sti, .mas, .dof.
    Calculix,
    /// node, component, node, component, value.
    Abaqus,
    /// A substructure: stiffness only.
    #[value(name = "user_element")]
    UserElement,
    /// DMIG, ten digits.
    Dmig,
    /// OP4 as text.
    Op4,
}

impl From<To> for MatrixFormat {
    fn from(to: To) -> Self {
        match to {
            To::MatrixMarket => Self::MatrixMarket,
            To::Calculix => Self::Calculix,
            To::Abaqus => Self::Abaqus,
            To::UserElement => Self::UserElement,
            To::Dmig => Self::Dmig,
            To::Op4 => Self::Op4,
        }
    }
}

/// Modes that are kept, and at most.
const MODES: usize = 20;
const MOST_MODES: usize = 500;

/// The crank of a study, free, with hub and flywheel.
fn of_study(study: &Study, modes: usize) -> Result<(ImportedCrank, String), String> {
    let (Some(flexible), Some(crank)) = (&study.flexible, &study.crank) else {
        return Err("found an engine without [crank.flexible], expected the dimensions of its crank there".into());
    };
    let assembled = assemble(crank, &study.engine, &study.chain, &flexible.spec, Carried::Ends)?;
    let bare: Vec<String> = assembled.balance.iter().enumerate().filter(|b| b.1.left_out > 0.0).map(|(t, _)| (t + 1).to_string()).collect();
    let without = if bare.is_empty() {
        String::new()
    } else {
        format!(
            "  note: without counterweights on throws {}, for which their stations leave no inertia: mean forces on the bearings, and all on exponential ones, are of a crank without them\n",
            bare.join(", ")
        )
    };
    let found = reduced(&assembled, modes).ok_or("its mass matrix is not positive definite")?;
    let told = roles(&found) + &without;
    Ok((found, told))
}

fn is_study(arguments: &Arguments) -> bool {
    arguments.file.extension().is_some_and(|e| e == "toml")
}

/// An option that says nothing of what is read.
fn without_use(arguments: &Arguments) -> Option<&'static str> {
    let of_files = [
        (arguments.mass.is_some(), "--mass"),
        (arguments.gyroscopic.is_some(), "--gyroscopic"),
        (arguments.turning.is_some(), "--turning"),
        (arguments.dof.is_some(), "--dof"),
        (arguments.nodes.is_some(), "--nodes"),
        (arguments.study.is_some(), "--study"),
        (!matches!(arguments.units, Units::Si), "--units"),
        (!matches!(arguments.axis, Axis::Z), "--axis"),
    ];
    let of_study = [(arguments.modes.is_some(), "--modes")];
    let given = if is_study(arguments) { &of_files[..] } else { &of_study[..] };
    given.iter().find(|o| o.0).map(|o| o.1)
}

/// Inertia of a chain and its stiffness from end to end.
fn of_chain(study: &Study) -> OfChain {
    let chain = &study.chain;
    let compliance: f64 = chain.stations[..chain.len() - 1].iter().map(|s| 1.0 / s.stiffness_to_next).sum();
    OfChain { inertia: chain.total_inertia(), stiffness: 1.0 / compliance }
}

/// A structure in axes with z along the crank, what it is held against, and what is told of its nodes.
struct Read {
    structure: Structure,
    chain: Option<OfChain>,
    roles: String,
}

fn read(arguments: &Arguments) -> Result<Read, InputError> {
    let study = |path: &PathBuf| input::read(path);
    if is_study(arguments) {
        let own = study(&arguments.file)?;
        let (reduced, roles) =
            of_study(&own, arguments.modes.unwrap_or(MODES)).map_err(|words| InputError::of_file(&arguments.file, words))?;
        return Ok(Read { roles, structure: reduced.structure, chain: None });
    }
    let chain = arguments.study.as_ref().map(study).transpose()?.map(|s| of_chain(&s));
    let files = MatrixFiles {
        stiffness: arguments.file.clone(),
        mass: arguments.mass.clone(),
        rotating: [arguments.gyroscopic.clone(), arguments.turning.clone()],
        unknowns: arguments.dof.clone(),
        nodes: arguments.nodes.clone(),
        units: match arguments.units {
            Units::Si => UnitSystem::Si,
            Units::MmTonne => UnitSystem::MmTonne,
        },
    };
    let found = structure(&files)?;
    let axis = match arguments.axis {
        Axis::X => CrankAxis::X,
        Axis::Y => CrankAxis::Y,
        Axis::Z => CrankAxis::Z,
    };
    let structure = found.along(axis);
    Ok(Read { structure, chain, roles: String::new() })
}

/// Reads a structure, prints what it is found to be, and writes it.
pub fn matrices(arguments: &Arguments) -> u8 {
    if let Some(modes) = arguments.modes.filter(|m| *m > MOST_MODES) {
        return fail(&format!("error: found --modes {modes}, expected at most {MOST_MODES}"));
    }
    if let Some(option) = without_use(arguments) {
        let of = if is_study(arguments) { "a study, whose crank is computed" } else { "matrices, which have their modes" };
        return fail(&format!("error: found {option} with {of}, expected it without"));
    }
    let (found, inputs) = input::noted(|| read(arguments));
    let Read { structure: found, chain, roles } = match found {
        Ok(found) => found,
        Err(error) => return fail(&error),
    };
    let checks = found.checks();
    let printed = || told(&found, &checks, chain) + &roles;
    let ends = if checks.objections(chain).is_empty() { DONE } else { FAILED };
    let Some(to) = arguments.to else {
        say(&printed());
        return ends;
    };
    let path = match chosen(arguments.out.as_ref(), &arguments.file, "_matrices") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let folder = match Folder::create(&path, Job { names: &Names::of_matrices(), inputs: &inputs, reads: &paths(&inputs) }) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let title = format!("{}: its matrices", arguments.file.display());
    let written = write_matrices(&found, to.into(), &folder).and_then(|()| write_folder(&title, printed, &folder));
    if let Err(error) = written.and_then(|()| folder.complete(&about_inputs(&inputs))) {
        return fail(&error);
    }
    say(&printed());
    say(&files(&folder));
    ends
}
