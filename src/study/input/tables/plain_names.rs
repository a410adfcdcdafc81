//! Names that files and rows are called by.

use super::shown::shown;

/// What is wrong with a name of files and rows, which has letters without accents, digits, `_`, `-` and `.`; `None` where it is one.
pub(crate) fn not_plain(name: &str) -> Option<String> {
    let is_plain = !name.is_empty() && name.len() <= 100 && name.chars().all(is_of_names);
    if is_plain && !name.starts_with(['.', '-']) && !name.starts_with("optimum_") {
        return None;
    }
    let expected = "letters from A to Z without accents, digits, `_`, `-` and `.`, not starting with `-`, `.` or `optimum_`";
    let instead = plain_name(name).map_or_else(String::new, |plain| format!(": `{plain}`, say"));
    Some(format!("found the name `{}`, expected {expected}{instead}", shown(name)))
}

fn is_of_names(c: char) -> bool {
    c.is_ascii_alphanumeric() || "_-.".contains(c)
}

/// A name with `_` for what names of files and rows do not have, umlauts written out; `None` where little is left of it.
fn plain_name(found: &str) -> Option<String> {
    const UMLAUTS: [(&str, &str); 7] = [("ä", "ae"), ("ö", "oe"), ("ü", "ue"), ("Ä", "Ae"), ("Ö", "Oe"), ("Ü", "Ue"), ("ß", "ss")];
    let written = UMLAUTS.iter().fold(found.to_owned(), |text, (from, to)| text.replace(from, to));
    let plain: String = written.chars().map(|c| if is_of_names(c) { c } else { '_' }).collect();
    let has_word = plain.chars().any(|c| c.is_ascii_alphanumeric()) && !plain.starts_with(['.', '-']) && !plain.starts_with("optimum_");
    (has_word && plain.len() <= 100).then_some(plain)
}

/// A name of plain words as one of files and rows: letters of any language, digits and blanks, with what stands between them in the names of makers.
///
/// # Errors
/// What is wrong with other names.
pub(super) fn as_plain_words(name: &str) -> Result<String, String> {
    let Some(found) = not_plain(name) else { return Ok(name.to_owned()) };
    let is_of_words = |c: char| c.is_alphanumeric() || " _-.,()".contains(c);
    let is_words = name.starts_with(char::is_alphanumeric) && name.chars().all(is_of_words);
    plain_name(name).filter(|_| is_words).ok_or(found)
}
