//! What searches find, remembered from one run to the next: a run that goes on where another was interrupted takes it from there and need not search again.
//!
//! A search is a function of its problem and its start: a run that recalls it gives what an uninterrupted one gives, to the last bit.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::{self, Debug};
use std::hash::{DefaultHasher, Hasher};

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sought<'a> {
    /// The design.
    pub design: &'a str,
    /// Index of the objective.
    pub objective: usize,
}

/// What a search has come to.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct BestSoFar<'a> {
    /// What is sought.
    pub search: Sought<'a>,
    /// Value of the objective, in SI units.
    pub value: f64,
    /// Largest excess over a limit (a logarithm); zero where all hold.
    pub excess: f64,
    /// Type, parameter and value, SI units.
    pub design: Vec<(&'static str, &'static str, f64)>,
}

/// Keeps what was found, by a key of what was sought.
pub trait Memory: Sync + Debug {
    /// What was kept.
    fn recall(&self, key: u64) -> Option<Vec<u8>>;
    /// Keeps it.
    fn keep(&self, key: u64, found: &[u8]);
    /// Is told of what a search has come to, recalled or not.
    fn found(&self, found: &BestSoFar);
}

/// A memory, and what is sought.
#[derive(Debug, Clone, Copy)]
pub struct Remembers<'a> {
    /// The memory.
    pub memory: &'a dyn Memory,
    /// What is sought; nothing where it is only a part of that.
    pub search: Option<Sought<'a>>,
}

impl Remembers<'_> {
    /// The same of a part of what is sought.
    pub(super) fn part(self) -> Self {
        Self { search: None, ..self }
    }
}

/// Hashes what is written.
struct Hashed(DefaultHasher);

impl fmt::Write for Hashed {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// Of all digits of what tells a search from others.
fn key(of: &impl Debug) -> u64 {
    let mut hashed = Hashed(DefaultHasher::new());
    // a hasher takes everything
    let _taken = fmt::Write::write_fmt(&mut hashed, format_args!("{of:?}"));
    hashed.0.finish()
}

/// What is recalled by a key, else what is computed, which is kept; errors are not.
///
/// # Errors
/// Those of the computation.
#[doc(hidden)]
pub fn remembered<T: Serialize + DeserializeOwned, E>(
    memory: Option<&dyn Memory>,
    of: &impl Debug,
    compute: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let Some(memory) = memory else { return compute() };
    let key = key(of);
    let known = memory.recall(key).and_then(|bytes| postcard::from_bytes(&bytes).ok());
    if let Some(known) = known {
        return Ok(known);
    }
    let found = compute()?;
    if let Ok(bytes) = postcard::to_allocvec(&found) {
        memory.keep(key, &bytes);
    }
    Ok(found)
}
