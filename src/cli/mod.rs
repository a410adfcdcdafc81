//! One file a command: arguments in, exit code out.
pub mod exit;
pub mod chart;
pub mod check;
pub mod compare;
pub mod fatigue;
pub mod progress;
pub mod run;
pub use exit::{DONE, FAILED, BAD_INPUT, say, fail, threads};
