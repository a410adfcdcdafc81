//! Numbers of things.

/// So many of something.
#[doc(hidden)]
pub fn counted(n: usize, of: &str) -> String {
    format!("{n} {of}{}", if n == 1 { "" } else { "s" })
}
