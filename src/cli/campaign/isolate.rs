//! Workers, and the search for cases that end them.

use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};

/// How a worker has ended.
pub(super) struct Ended {
    /// Its exit code; `None` where a signal ended it.
    pub code: Option<i32>,
    /// The signal.
    signal: Option<i32>,
    /// What it said of errors.
    pub said: String,
}

impl Ended {
    /// In words.
    pub fn how(&self) -> String {
        match (self.code, self.signal) {
            (Some(code), _) => format!("exit code {code}"),
            (None, Some(signal)) => format!("signal {signal}"),
            (None, None) => "no exit code".to_owned(),
        }
    }
}

/// Runs this program on a part of a campaign, and waits for it.
///
/// # Errors
/// Where it cannot be started.
pub(super) fn worker(folder: &Path, arguments: &[String]) -> std::io::Result<Ended> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["campaign", "run"]).arg(folder).args(arguments);
    let output = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?.wait_with_output()?;
    #[cfg(unix)]
    let signal = std::os::unix::process::ExitStatusExt::signal(&output.status);
    #[cfg(not(unix))]
    let signal = None;
    Ok(Ended { code: output.status.code(), signal, said: String::from_utf8_lossy(&output.stderr).into_owned() })
}

/// Cases of a range that end the program: halves of what does are tried until single cases are left.
pub(super) fn crashing(folder: &Path, cases: Range<usize>) -> Vec<usize> {
    let text = format!("{}..{}", cases.start, cases.end - 1);
    let lives = worker(folder, &["--probe".to_owned(), text]).is_ok_and(|end| end.code == Some(0));
    match cases.len() {
        _ if lives => Vec::new(),
        1 => vec![cases.start],
        n => {
            let middle = cases.start + n / 2;
            [crashing(folder, cases.start..middle), crashing(folder, middle..cases.end)].concat()
        }
    }
}
