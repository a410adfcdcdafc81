//! The only place that reads files: a study in TOML, the engine file and tables it names.

pub mod error;
pub mod published;
mod schema;
pub mod tables;
mod validation;

pub use error::InputError;
pub use published::Published;
pub use validation::{
    AbsorberSpec, CalibrateSpec, DesignSpec, DutyPoint, FreeInput, FrontSpec, Input, ObjectiveSpec, OptimiseSpec, Reciprocating,
    ResponseMethod, Size, Study, UnitOf,
};

use error::Source;
use std::path::Path;

/// Reads and checks a material file.
///
/// # Errors
/// [`InputError`] with every mistake found.
pub(crate) fn read_material(path: &Path) -> Result<crate::fatigue::multiaxial::Limits, InputError> {
    let source = Source::read(path)?;
    let raw: schema::material::RawMaterialFile = source.parse()?;
    validation::material::resolve(&source, &raw)
}

/// Reads and checks a study and everything it names.
///
/// # Errors
/// [`InputError`] with every mistake found, each with file, line and column.
pub fn read(path: &Path) -> Result<Study, InputError> {
    checked(path, &Source::read(path)?)
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
        checked(name.as_ref(), &Source::new(name.as_ref(), text))
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

fn checked(path: &Path, source: &Source) -> Result<Study, InputError> {
    let study: schema::study::RawStudy = source.parse()?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let engine_path = folder.join(study.engine.get_ref());
    let engine_source = Source::read_named(&engine_path, source, study.engine.span())?;
    let mut engine: schema::engine::RawEngine = engine_source.parse()?;
    if let Some(chain) = &engine.chain {
        engine.station = mass_elastic(&engine_source, &chain.file, &engine.station)?;
    }
    validation::resolve(&validation::Files {
        path,
        source,
        study: &study,
        engine_path: &engine_path,
        engine_source: &engine_source,
        engine: &engine,
    })
}
