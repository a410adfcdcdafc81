//! What is shown of lines and words that are too long to be read.

/// Longest line that is shown whole, and what is shown before a mistake in a longer one.
const LONGEST_LINE: usize = 200;
const BEFORE: usize = 60;
/// Longest word of a message, and what is left of a longer one.
const LONGEST_WORD: usize = 120;
const KEPT: usize = 60;

/// What is shown of a line round a stretch of it, with where that begins and how long it is there.
pub(super) fn window(text: &str, from: usize, length: usize) -> (String, usize, usize) {
    let count = text.chars().count();
    if count <= LONGEST_LINE {
        return (text.to_owned(), from, length);
    }
    let start = from.saturating_sub(BEFORE);
    let end = (start + LONGEST_LINE).min(count);
    let (left, right) = (if start > 0 { "…" } else { "" }, if end < count { "…" } else { "" });
    let shown: String = text.chars().skip(start).take(end - start).collect();
    let before = from - start + left.chars().count();
    (format!("{left}{shown}{right}"), before, length.clamp(1, (end - from).max(1)))
}

/// A message whose words have a length that can be read.
pub(super) fn shortened(message: &str) -> String {
    let word = |w: &str| {
        let count = w.chars().count();
        if count <= LONGEST_WORD {
            return w.to_owned();
        }
        let closing = w.chars().rev().take_while(|c| "`,.;".contains(*c)).count();
        let opening = usize::from(w.starts_with('`'));
        let (head, tail): (String, String) = (w.chars().take(KEPT).collect(), w.chars().skip(count - closing).collect());
        format!("{head}… ({} characters){tail}", count - closing - opening)
    };
    message.split(' ').map(word).collect::<Vec<_>>().join(" ")
}
