//! How mistakes are told: the first of many, and how many more there are.

use super::error::InputError;
use std::fmt;

/// So many are read; more hide the first.
const MOST_TOLD: usize = 20;

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mistake) in self.mistakes.iter().take(MOST_TOLD).enumerate() {
            write!(f, "{}{mistake}", if i > 0 { "\n" } else { "" })?;
        }
        match self.mistakes.len().saturating_sub(MOST_TOLD) {
            0 => Ok(()),
            1 => writeln!(f, "\nand 1 more mistake"),
            more => writeln!(f, "\nand {more} more mistakes"),
        }
    }
}
