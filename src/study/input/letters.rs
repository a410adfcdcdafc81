//! What names may not have: they stand in tables, plots and pages, and on terminals.

/// Returns whether a character is not seen, moves a cursor or turns the direction of the text beside it.
#[doc(hidden)]
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
}

/// Returns what a name has that it may not have, None where it has nothing of that: what is hidden, or a beginning by which a spreadsheet that opens a table takes a cell for a formula and computes it.
pub(crate) fn fault(name: &str) -> Option<String> {
    if let Some(c) = name.chars().find(|c| is_hidden(*c)) {
        return Some(format!(
            "the character U+{:04X} in a name, expected letters that are seen and do not turn the text about them",
            u32::from(c)
        ));
    }
    let formula = name.starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠']) && name.chars().count() > 1;
    formula.then(|| {
        format!(
            "`{}` at the beginning of a name, expected another sign: spreadsheets compute what begins so",
            &name[..name.chars().next().map_or(0, char::len_utf8)]
        )
    })
}
