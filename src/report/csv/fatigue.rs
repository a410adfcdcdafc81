//! `fatigue.csv`: a row a point and criterion, written as points come.

use super::table::number;
use crate::analysis::stress_histories::PointResult;
use crate::files::{Folder, Stream, WriteError};
use crate::units::{DEG_PER_RAD, PA_PER_MPA};

/// Columns, in order.
const COLUMNS: [&str; 11] = [
    "point",
    "criterion",
    "safety_factor",
    "plane_theta_deg",
    "plane_phi_deg",
    "shear_amplitude_mpa",
    "normal_max_mpa",
    "sqrt_j2_amplitude_mpa",
    "hydrostatic_amplitude_mpa",
    "hydrostatic_mean_mpa",
    "hydrostatic_max_mpa",
];

/// The table being written.
#[derive(Debug)]
#[doc(hidden)]
pub struct FatigueTable {
    writer: csv::Writer<Stream>,
    path: std::path::PathBuf,
}

impl FatigueTable {
    /// Begins the table in a folder.
    ///
    /// # Errors
    /// [`WriteError`] where it cannot be written.
    #[doc(hidden)]
    pub fn create(folder: &Folder) -> Result<Self, WriteError> {
        let mut table = Self { writer: csv::Writer::from_writer(folder.stream()?), path: folder.path().join("fatigue.csv") };
        table.row(COLUMNS.iter().copied().chain(["note"]).map(str::to_owned))?;
        Ok(table)
    }

    fn row(&mut self, cells: impl IntoIterator<Item = String>) -> Result<(), WriteError> {
        let path = &self.path;
        self.writer.write_record(cells).map_err(|e| WriteError { path: path.clone(), reason: e.to_string() })
    }

    /// Adds the rows of a point.
    ///
    /// # Errors
    /// [`WriteError`] where they cannot be written.
    pub fn point(&mut self, point: &PointResult) -> Result<(), WriteError> {
        let mpa = |x: f64| number(x / PA_PER_MPA);
        let optional = |x: Option<String>| x.unwrap_or_default();
        for v in &point.verdicts {
            let i = &point.invariants;
            self.row([
                point.name.clone(),
                v.criterion.name().to_owned(),
                if v.safety_factor.is_finite() { number(v.safety_factor) } else { "infinite".into() },
                optional(v.plane.map(|p| number(p.theta * DEG_PER_RAD))),
                optional(v.plane.map(|p| number(p.phi * DEG_PER_RAD))),
                optional(v.shear_amplitude.map(mpa)),
                optional(v.normal_max.map(mpa)),
                mpa(i.sqrt_j2_amplitude),
                mpa(i.hydrostatic_amplitude),
                mpa(i.hydrostatic_mean),
                mpa(i.hydrostatic_max()),
                v.note.clone(),
            ])?;
        }
        Ok(())
    }

    /// Ends the table and gives it its name.
    ///
    /// # Errors
    /// [`WriteError`] where it cannot be written.
    #[doc(hidden)]
    pub fn finish(self, folder: &Folder) -> Result<(), WriteError> {
        let path = self.path;
        let stream = self.writer.into_inner().map_err(|e| WriteError { path, reason: e.to_string() })?;
        folder.keep(stream, "fatigue.csv")
    }
}
