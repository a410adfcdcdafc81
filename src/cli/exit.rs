//! What every command shares: exit codes, output, threads.

use crate::input::{InputFile, is_hidden};
use crate::report::text::width::{USUAL, set, wrapped};
use crate::report::{Folder, PAGE};
use std::fmt::Display;
use std::io::Write;
use std::path::PathBuf;

/// Exit code: done.
pub(crate) const DONE: u8 = 0;
/// Exit code: ran, but a limit failed.
pub(crate) const FAILED: u8 = 1;
/// Exit code: bad input or numerical failure.
pub(crate) const BAD_INPUT: u8 = 2;

/// Exit code: ended by an interrupt, as shells count it.
pub(crate) const INTERRUPTED: u8 = 130;

/// Text for a terminal: what would move its cursor, turn its direction or hide stands in it as `\u{…}`, whatever file it came from.
fn printable(text: &str) -> String {
    let hidden = |c: char| is_hidden(c) && c != '\n' && c != '\t';
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if hidden(c) { out.extend(c.escape_unicode()) } else { out.push(c) }
    }
    out
}

/// Prints to standard output. A pipe closed early (`| head`) is not an error: the rest is dropped. Any other loss of output ends the
/// program with the code of bad input.
pub fn say(text: &str) {
    say_raw(&wrapped(&printable(text)));
}

/// The same as it is: a text of our own, for another program.
pub(crate) fn say_raw(text: &str) {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            fail(&format!("error: standard output cannot be written: {e}"));
            std::process::exit(i32::from(BAD_INPUT));
        }
        _ => {}
    }
}

/// Where the files of a command are, and which to open.
pub(crate) fn files(folder: &Folder) -> String {
    format!("{} files in {}: open {PAGE} there first\n", folder.written(), folder.path().display())
}

/// Paths of what was read.
pub(crate) fn paths(inputs: &[InputFile]) -> Vec<PathBuf> {
    inputs.iter().map(|f| f.path.clone()).collect()
}

/// Prints an error and gives the exit code of bad input.
pub fn fail(error: &dyn Display) -> u8 {
    say_to_error(&error.to_string());
    BAD_INPUT
}

/// Prints to standard error.
pub(crate) fn say_to_error(text: &str) {
    let _closed = writeln!(std::io::stderr(), "{}", printable(text.trim_end()));
}

/// Sets the number of threads; 0 or none leaves the choice to the machine.
pub fn threads(count: Option<usize>) {
    if let Some(n) = count {
        // fails only where a pool exists already: the first wins
        let _first = rayon::ThreadPoolBuilder::new().num_threads(n).build_global();
    }
}

/// What is printed fits the terminal, a hundred columns at most; `wide`: all columns of all tables, however wide.
pub fn width(wide: bool) {
    let stated = || std::env::var("COLUMNS").ok()?.parse().ok();
    let terminal = terminal_size::terminal_size().map(|(columns, _)| usize::from(columns.0)).or_else(stated).unwrap_or(USUAL);
    set((!wide).then_some(terminal.min(USUAL)));
}
