//! One file a command: arguments in, exit code out.
pub mod campaign;
pub mod chart;
pub mod check;
pub mod compare;
pub mod curves;
pub mod exit;
pub mod fatigue;
pub mod fit;
pub mod import;
pub mod keys;
pub mod matrices;
pub mod new;
mod place;
pub mod progress;
pub mod report;
pub mod run;
pub mod shell;
pub mod size;
pub mod study_arguments;
mod supervised_run;

pub(crate) use exit::threads;
