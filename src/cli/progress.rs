//! A progress line on the terminal for what takes more than a moment; where standard error is not a terminal, a line now and then for what takes long.

use crate::analysis::Progress;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The line is drawn anew this often, whether or not a step is done.
const TICK: Duration = Duration::from_millis(500);

/// Where there is no terminal a line is written this often.
const LINE: Duration = Duration::from_secs(10);

/// Bar on standard error.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar, AtomicBool, Option<Lines>);

/// Lines that a thread writes until this is dropped.
#[derive(Debug)]
struct Lines {
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Lines {
    fn of(bar: &ProgressBar) -> Self {
        let (end, ended) = channel();
        let (bar, begun) = (bar.clone(), Instant::now());
        let write = move || {
            while ended.recv_timeout(LINE) == Err(RecvTimeoutError::Timeout) {
                if bar.message().is_empty() {
                    continue;
                }
                let (stage, done, all) = (bar.message(), bar.position(), bar.length().unwrap_or(0));
                // a line that nobody reads is no failure of the run
                let _written = writeln!(std::io::stderr(), "  {stage} {done}/{all}, {:.0} s so far", begun.elapsed().as_secs_f64());
            }
        };
        Self { end: Some(end), thread: std::thread::Builder::new().spawn(write).ok() }
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        // without a sender the thread ends at once
        drop(self.end.take());
        if let Some(thread) = self.thread.take() {
            let _ended = thread.join();
        }
    }
}

impl Default for Bar {
    fn default() -> Self {
        // shown from the first stage on
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("  {msg:<24} {bar:32} {pos}/{len}  {elapsed}{left}  {prefix}") {
            let left = |state: &ProgressState, out: &mut dyn fmt::Write| {
                // a line that cannot be drawn is no failure of the run
                let _drawn = out.write_str(&left(state.pos(), state.eta()));
            };
            bar.set_style(style.with_key("left", left));
        }
        let lines = (!std::io::stderr().is_terminal()).then(|| Lines::of(&bar));
        Self(bar, AtomicBool::new(false), lines)
    }
}

/// What is said of the time left after so many steps: nothing before the first one, which alone tells how long a step takes.
pub fn left(steps: u64, estimate: Duration) -> String {
    if steps == 0 { String::new() } else { format!(", {:#} left", HumanDuration(estimate)) }
}

impl Bar {
    /// Shows nothing.
    pub(crate) fn hidden() -> Self {
        Self(ProgressBar::hidden(), AtomicBool::new(true), None)
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
        // a search may take more steps than were foreseen
        if self.0.length().is_some_and(|all| self.0.position() > all) {
            self.0.set_length(self.0.position());
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
        drop(self.2.take());
    }
}
