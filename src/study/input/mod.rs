//! The only place that reads files: a study in TOML, the engine file and tables it names.

#[doc(hidden)]
pub mod campaign;
pub mod error;
mod files;
#[doc(hidden)]
pub mod import;
pub mod keys;
mod kinds;
mod letters;
pub mod matrices;
pub mod measure;
mod overrides;
pub mod published;
mod read_toml;
mod schema;
mod snippet;
mod spanned;
pub mod tables;
mod told;
mod validation;
mod wording;

pub use error::InputError;
pub use files::{InputFile, checksum, noted, remarked};
pub use import::{FoundChain, FoundStation, FoundTraces};
pub use letters::is_hidden;
pub use measure::{CombinedSpec, LimitOfRule, LimitSpec, MeasureSpec, UnitOf};
#[doc(hidden)]
pub use overrides::Override;
pub use published::Published;
pub use schema::json::FileKind;
pub use validation::{
    AbsorberSpec, AllocateSpec, CalibrateSpec, CatalogueSpec, CrankModel, DesignSpec, DutyPoint, FlexibleModel, FreeInput, FrontSpec,
    Input, OptimiseSpec, PartsError, Placeholder, ProveSpec, Reciprocating, ResponseMethod, RobustSpec, Sampling, Size, SizedAbsorber,
    SizedChain, SizingStudy, Study,
};
pub use validation::{RETUNED, scatter_key};
pub use wording::closest;

use error::Source;
use kinds::{another_kind, has, no_table};
use overrides::{OfFile, Overrides};
use std::path::Path;

/// Reads and checks a material file.
///
/// # Errors
/// [`InputError`] with every mistake found.
#[doc(hidden)]
pub fn read_material(path: &Path) -> Result<crate::fatigue::multiaxial::Limits, InputError> {
    let source = Source::read(path)?;
    no_table(&source, "a material file in TOML", "it has keys such as `tensile_strength_mpa = 900`")?;
    let raw: schema::material::RawMaterialFile = source.parse()?;
    validation::material::resolve(&source, &raw)
}

/// Whether a file that can be read is a sizing file.
#[doc(hidden)]
pub fn is_sizing(path: &Path) -> bool {
    Source::read(path).is_ok_and(|source| has(&source, "mechanism"))
}

/// Reads and checks a sizing file and the tables it names.
///
/// # Errors
/// [`InputError`] with every mistake found.
pub fn read_sizing(path: &Path) -> Result<SizingStudy, InputError> {
    let source = Source::read(path)?;
    no_table(&source, "a sizing file in TOML", "`hartog size` takes the operating data of an engine; `hartog import` takes tables")?;
    if has(&source, "engine") {
        return Err(another_kind(path, "found a study of an engine, expected a sizing file: `hartog run` takes it"));
    }
    let raw: schema::sizing::RawSizing = source.parse()?;
    validation::sizing::resolve(path, &source, &raw)
}

/// Checks a study whose study and engine files are texts; tables they name are looked for beside `path`.
///
/// # Errors
/// As [`read`].
pub(crate) fn from_texts(path: &Path, study: &str, engine: &str) -> Result<Study, InputError> {
    let engine_path = path.with_file_name("engine.toml");
    let source = Source::new(path, study);
    parsed(path, &source, &source.parse()?, &engine_path, &Source::new(&engine_path, engine))
}

/// Reads and checks a study and everything it names.
///
/// # Errors
/// [`InputError`] with every mistake found, each with file, line and column.
pub fn read(path: &Path) -> Result<Study, InputError> {
    read_with(path, &[])
}

/// Reads and checks a study with other values of some keys, those of its engine file behind `engine.`, and everything it names.
///
/// # Errors
/// As [`read`]; mistakes of these values are where they were given.
#[doc(hidden)]
pub fn read_with(path: &Path, overrides: &[Override]) -> Result<Study, InputError> {
    checked(path, Source::read(path)?, overrides)
}

/// Reads what `--set KEY=VALUE` gives.
///
/// # Errors
/// [`InputError`] with every one that is none.
#[doc(hidden)]
pub fn overrides(texts: &[String]) -> Result<Vec<Override>, InputError> {
    let (mut good, mut mistakes) = (Vec::new(), Vec::new());
    for text in texts {
        match Override::parse(text) {
            Ok(own) => good.push(own),
            Err(e) => mistakes.push(Source::new(Path::new(overrides::OPTION), text).mistake(e.span, e.message, e.help)),
        }
    }
    if mistakes.is_empty() { Ok(good) } else { Err(InputError { mistakes }) }
}

impl Study {
    /// Reads and checks a study and everything it names.
    ///
    /// # Errors
    /// [`InputError`] with every mistake found, each with file, line and column.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, InputError> {
        read(path.as_ref())
    }

    /// Checks a study given as text. `name`: what it is called, in messages too; paths in it are relative to the folder of that name.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn from_toml(text: &str, name: impl AsRef<Path>) -> Result<Self, InputError> {
        checked(name.as_ref(), Source::new(name.as_ref(), text), &[])
    }
}

/// The stations of a table named in an engine file.
fn mass_elastic(
    engine: &Source,
    file: &error::At<String>,
    own: &[schema::engine::RawStation],
) -> Result<Vec<schema::engine::RawStation>, InputError> {
    let mut check = error::Check::new(engine);
    if let Some(station) = own.first() {
        check.wrong(&station.name, "found [[station]] beside [chain], expected the stations in the file or in its table");
        return Err(InputError { mistakes: check.mistakes });
    }
    let folder = engine.path().parent().unwrap_or_else(|| Path::new(""));
    let read = |path: &Path| tables::mass_elastic(path, file.span());
    validation::table(&mut check, file, folder, read).ok_or(InputError { mistakes: check.mistakes })
}

fn checked(path: &Path, source: Source, set: &[Override]) -> Result<Study, InputError> {
    let source = source.with(Overrides::of(OfFile::Study, set));
    let (study, remarks) = files::remarked(|| resolved(path, &source, set));
    study.map(|mut study| {
        study.remarks = study.remarks_on_crank().into_iter().chain(remarks).collect();
        // what is given is no example any more
        study.placeholders.retain(|p| !set.iter().any(|o| o.is_of(&p.key, p.file != path)));
        study.set = set.iter().map(|o| o.text().to_owned()).collect();
        if !set.is_empty() {
            study.remarks.insert(0, format!("{} gives other values than the files have: {}", overrides::OPTION, study.set.join("; ")));
        }
        study
    })
}

fn resolved(path: &Path, source: &Source, set: &[Override]) -> Result<Study, InputError> {
    let make = format!("`hartog import {} own` makes a study of a table of masses and shafts", path.display());
    no_table(source, "a study in TOML", &make)?;
    if has(source, "mechanism") {
        return Err(another_kind(path, "found a sizing file, expected a study: `hartog size` takes it, and writes a study"));
    }
    if !has(source, "engine") && ["station", "chain", "layout", "geometry"].iter().any(|key| has(source, key)) {
        return Err(another_kind(
            path,
            "found an engine file, expected a study: a file that names this one, `engine = \"…\"`, and says what is asked of it",
        ));
    }
    let study: schema::study::RawStudy = source.parse()?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let engine_path = folder.join(study.engine.get_ref());
    let engine_source = Source::read_named(&engine_path, source, study.engine.span())?.with(Overrides::of(OfFile::Engine, set));
    no_table(
        &engine_source,
        "an engine file in TOML",
        "its `[chain]` names a table of masses and shafts as `file`, its `[pressure.measured]` one of pressures",
    )?;
    parsed(path, source, &study, &engine_path, &engine_source)
}

fn parsed(
    path: &Path,
    source: &Source,
    study: &schema::study::RawStudy,
    engine_path: &Path,
    engine_source: &Source,
) -> Result<Study, InputError> {
    let mut engine: schema::engine::RawEngine = engine_source.parse()?;
    if let Some(chain) = &engine.chain {
        engine.station = mass_elastic(engine_source, &chain.file, &engine.station)?;
    }
    validation::resolve(&validation::Files { path, source, study, engine_path, engine_source, engine: &engine })
}
