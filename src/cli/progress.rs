//! A progress line on the terminal for what takes more than a moment; nothing where standard error is not a terminal.

use crate::analysis::Progress;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The line is drawn anew this often, whether or not a step is done.
const TICK: Duration = Duration::from_millis(500);

/// Bar on standard error.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar, AtomicBool);

impl Default for Bar {
    fn default() -> Self {
        // shown from the first stage on
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("  {msg:<24} {bar:32} {pos}/{len}  {elapsed}{left}  {prefix}") {
            let left = |state: &ProgressState, out: &mut dyn Write| {
                // a line that cannot be drawn is no failure of the run
                let _drawn = out.write_str(&left(state.pos(), state.eta()));
            };
            bar.set_style(style.with_key("left", left));
        }
        Self(bar, AtomicBool::new(false))
    }
}

/// What is said of the time left after so many steps: nothing before the first one, which alone tells how long a step takes.
pub fn left(steps: u64, estimate: Duration) -> String {
    if steps == 0 { String::new() } else { format!(", {:#} left", HumanDuration(estimate)) }
}

impl Bar {
    /// Shows nothing.
    pub(crate) fn hidden() -> Self {
        Self(ProgressBar::hidden(), AtomicBool::new(true))
    }

    /// Tells of the best so far.
    pub(crate) fn best(&self, text: &str) {
        self.0.set_prefix(text.to_owned());
    }
}

impl Progress for Bar {
    fn stage(&self, name: &str, steps: usize) {
        self.0.set_length(steps as u64);
        self.0.set_message(name.to_owned());
        self.0.reset();
        if !self.1.swap(true, Ordering::Relaxed) {
            self.0.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
            if !self.0.is_hidden() {
                self.0.enable_steady_tick(TICK);
            }
        }
    }
    fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
