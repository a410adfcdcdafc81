//! Tables with a header row: cells with their places, for errors with row and column.
mod cycle;
mod history;
mod mass_elastic;
mod multiaxial;
mod published;
mod stream;
mod superposed;
mod table;
mod torque;
mod unit_loads;
pub(crate) use history::HistoryReader;
pub use history::PointHistory;
pub(crate) use mass_elastic::mass_elastic;
pub use multiaxial::{histories, multiaxial};
pub use published::{Reach, absorbers, amplitudes, engines, factors, fatigue, frequencies, stresses};
pub(crate) use superposed::Superposed;
pub(crate) use torque::{pressure_traces, torque_harmonics};
pub(crate) use unit_loads::{UnitLoadReader, UnitPoint};
