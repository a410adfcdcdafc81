//! Times of stages, and the median of repeated ones.

use crate::response::{ResponseError, Work};
use std::time::Instant;

/// Time of a stage.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Timing {
    /// The stage.
    pub stage: String,
    /// Wall-clock time, s.
    pub seconds: f64,
    /// Work done in it.
    pub work: Work,
}

/// Times one stage after the other.
#[derive(Debug)]
#[doc(hidden)]
pub struct Clock {
    /// Stages so far.
    pub timing: Vec<Timing>,
    since: Instant,
}

impl Clock {
    /// Starts now.
    pub fn start() -> Self {
        Self { timing: Vec::new(), since: Instant::now() }
    }

    /// Ends a stage, and begins the next.
    pub(crate) fn lap(&mut self, stage: &str, work: Work) {
        self.timing.push(Timing { stage: stage.into(), seconds: self.since.elapsed().as_secs_f64(), work });
        self.since = Instant::now();
    }

    /// Ends a stage that ran beside others, which took so many seconds itself; the next begins.
    pub(crate) fn beside(&mut self, stage: &str, seconds: f64, work: Work) {
        self.timing.push(Timing { stage: stage.into(), seconds, work });
        self.since = Instant::now();
    }
}

/// What a stage gives with its time, for stages that run side by side.
pub(crate) fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let found = run();
    (found, start.elapsed().as_secs_f64())
}

/// How often something is repeated to be timed.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Repeats {
    /// At least.
    pub least: usize,
    /// At most.
    pub most: usize,
    /// No further repetition once they took this long together, s.
    pub seconds: f64,
}

/// Median of the seconds that repetitions take.
///
/// # Errors
/// The first error of `once`.
#[doc(hidden)]
pub fn median_seconds(repeats: Repeats, mut once: impl FnMut() -> Result<(), ResponseError>) -> Result<f64, ResponseError> {
    let (begun, mut times) = (Instant::now(), Vec::new());
    while times.len() < repeats.least || (begun.elapsed().as_secs_f64() < repeats.seconds && times.len() < repeats.most) {
        let start = Instant::now();
        once()?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times[times.len() / 2])
}
