//! What a reader of TOML finds wrong, in the words of an input file, with what mends it.

use std::ops::Range;

/// A value of so many characters is shown.
const SHORT: usize = 40;

/// What a mistake of grammar is, and how to mend it, by the text in which it stands at these bytes.
pub(super) fn of_grammar(text: &str, span: &Range<usize>, message: &str) -> (String, Option<String>) {
    if let Some(found) = decimal_comma(text, span) {
        return (found, None);
    }
    let line_start = |place: usize| text.get(..place.min(text.len())).map_or(0, |before| before.rfind('\n').map_or(0, |i| i + 1));
    let line = text[line_start(span.start)..].lines().next().unwrap_or("");
    let (message, help) = reword(message);
    if line.split('"').skip(1).step_by(2).any(|quoted| quoted.contains('\\')) && (message.contains("escape") || message.contains("unicode"))
    {
        return ("found a backslash in double quotes that begins no escape".into(), Some(BACKSLASH.into()));
    }
    if message.starts_with("found several or no keys") {
        let own = text.get(span.clone()).unwrap_or("");
        let is_empty = own.trim_matches(|c: char| "{}".contains(c) || c.is_whitespace()).is_empty();
        let key = line.split('=').next().unwrap_or("").trim().trim_matches(['[', ']']).rsplit('.').next().unwrap_or("").trim();
        let help = (!key.is_empty()).then(|| format!("`hartog keys {key}` lists them"));
        return (if is_empty { "found an empty table, expected one choice in it".into() } else { message }, help);
    }
    if message.starts_with("found another type") {
        let own = text.get(span.clone()).unwrap_or("").trim();
        let found = if own.len() > SHORT || own.contains('\n') { "another type".to_owned() } else { format!("`{own}`") };
        let key = line.split('=').next().unwrap_or("").trim().rsplit('.').next().unwrap_or("").trim();
        let fixed =
            if own.parse::<f64>().is_ok() { format!(", such as `{key}.fixed = {own}` where one value is meant") } else { String::new() };
        let help = (!key.is_empty()).then(|| format!("`hartog keys {key}` lists them{fixed}"));
        return (format!("found {found}, expected one choice: a table with one key"), help);
    }
    let before_mistake = span.start.saturating_sub(line_start(span.start)) + 1;
    let help = help.or_else(|| comma_in_brackets(line, before_mistake));
    (message, help)
}

/// A comma between digits, within brackets and before a mistake in a line: it separates values or keys there, where a point may have been meant.
fn comma_in_brackets(line: &str, before: usize) -> Option<String> {
    let digit = |c: char| c.is_ascii_digit();
    line.match_indices(',').take_while(|(i, _)| *i <= before).find_map(|(i, _)| {
        let (left, right) = (&line[..i], &line[i + 1..]);
        let whole = &left[left.trim_end_matches(digit).len()..];
        let decimals = &right[..right.len() - right.trim_start_matches(digit).len()];
        let begins = left[..left.len() - whole.len()].trim_end_matches([' ', '-', '+']).ends_with(['=', '[', ',']);
        let is_meant = begins && left.contains(['{', '[']) && !whole.is_empty() && !decimals.is_empty();
        is_meant.then(|| format!("the comma of `{whole},{decimals}` separates two entries; a number has a point: `{whole}.{decimals}`"))
    })
}

/// How a path of Windows is written.
pub(super) const BACKSLASH: &str =
    "a path of Windows stands in single quotes, 'C:\\data\\x.csv', or has the strokes of others, \"C:/data/x.csv\"";

/// Whether a path has the control characters that escapes in double quotes make of a path of Windows.
pub(super) fn has_escapes(path: &str) -> bool {
    path.contains(['\n', '\t', '\r', '\u{8}', '\u{c}', '\u{1b}'])
}

/// Whether a text is a table: its first lines have separated cells and no key of TOML.
pub(super) fn is_table(text: &str) -> bool {
    const LINES: usize = 5;
    let all = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let mut lines = all.filter(|l| !l.is_empty() && !l.starts_with('#') && !l.to_lowercase().starts_with("sep=")).take(LINES).peekable();
    let is_separated = lines.clone().any(|l| l.contains([';', ',', '\t']));
    lines.peek().is_some_and(|first| !first.starts_with('{')) && is_separated && lines.all(|l| !l.contains('=') && !l.starts_with('['))
}

/// A comma between digits where one value was expected.
fn decimal_comma(text: &str, span: &Range<usize>) -> Option<String> {
    let (before, rest) = text.split_at_checked(span.start)?;
    let digits = |c: char| c.is_ascii_digit();
    let whole = &before[before.trim_end_matches(digits).len()..];
    let decimals = rest.strip_prefix(',')?;
    let decimals = &decimals[..decimals.len() - decimals.trim_start_matches(digits).len()];
    let stands_alone = before[..before.len() - whole.len()].trim_end_matches([' ', '-', '+']).ends_with('=');
    (stands_alone && !whole.is_empty() && !decimals.is_empty())
        .then(|| format!("found the decimal comma of `{whole},{decimals}`, expected a point: `{whole}.{decimals}`"))
}

/// Serde's messages in the words of an input file.
pub(super) fn reword(message: &str) -> (String, Option<String>) {
    let message = message.trim_end();
    if let Some((key, rest)) = message.strip_prefix("unknown field `").and_then(|m| m.split_once('`')) {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        let help = closest(key, &known).map(|k| {
            let same_quantity = key.rsplit_once('_').is_some_and(|(quantity, _)| k.starts_with(quantity));
            format!("did you mean `{k}`?{}", if same_quantity { " The unit is part of the key" } else { "" })
        });
        let half = key.starts_with("stroke") && known.contains(&"crank_radius_mm");
        let help = if half { Some("`crank_radius_mm` is half the stroke".to_owned()) } else { help };
        return (format!("found unknown key `{key}`, expected {}", list(&known)), help);
    }
    if let Some((variant, rest)) = message.strip_prefix("unknown variant `").and_then(|m| m.split_once('`')) {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        let help = closest(variant, &known).map(|k| format!("did you mean `{k}`?"));
        let help = not_here(variant, &known).map(str::to_owned).or(help);
        return (format!("found `{variant}`, expected {}", list(&known)), help);
    }
    if let Some(key) = message.strip_prefix("missing field `").and_then(|m| m.split('`').next()) {
        return (format!("key `{key}` is missing in this table"), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid type: ").and_then(|m| m.split_once(", expected ")) {
        let found = found.replace("map", "a table").replace("sequence", "a list").replace(" as i128", "");
        return (format!("found {found}, expected {}", plain_type(expected)), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid value: ").and_then(|m| m.split_once(", expected ")) {
        let most = if found.starts_with("integer ") { format!(" from {} to {}", i64::MIN, i64::MAX) } else { String::new() };
        return (format!("found {found}, expected {}{most}", plain_type(expected)), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid length ").and_then(|m| m.split_once(", expected ")) {
        return (format!("found {found} values, expected {}", plain_type(expected)), None);
    }
    if message.starts_with("wanted exactly 1 element") {
        return ("found several or no keys, expected exactly one choice in this table".to_owned(), None);
    }
    if message.starts_with("wanted string or table") {
        return ("found another type, expected one choice: a table with one key".to_owned(), None);
    }
    (message.replace('\n', ", "), None)
}

/// Help for a word that has its place elsewhere.
fn not_here(word: &str, known: &[&str]) -> Option<&'static str> {
    match word {
        "measured" if known.contains(&"tuned") => Some("a measured law is of a given design: a search has no parameters of it"),
        "total_inertia" | "ring_inertia" | "dissipated_power" | "margin" | "ring_twist"
            if known == ["ring_inertia_kg_m2", "inertia_ratio"] =>
        {
            Some("a front of one measure against another is `of = [\"peak_twist\", \"total_inertia\"]`, say")
        }
        _ => None,
    }
}

fn plain_type(expected: &str) -> &str {
    match expected {
        "f64" => "a number",
        "i64" | "u64" | "u32" | "usize" => "a whole number",
        "a string" => "a text in quotes",
        "a sequence" => "a list",
        "an array of length 2" => "two values",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
}

fn list(known: &[&str]) -> String {
    let quoted: Vec<String> = known.iter().map(|k| format!("`{k}`")).collect();
    match quoted.as_slice() {
        [] => "no key here".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// The known word most like `word`: with the longest common start and end, more than half of it, or more than two thirds where they only end alike.
#[doc(hidden)]
pub fn closest<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let common = |k: &str| {
        let start = word.chars().zip(k.chars()).take_while(|(a, b)| a == b).count();
        let end = word.chars().rev().zip(k.chars().rev()).take_while(|(a, b)| a == b).count();
        (start + end).min(word.len())
    };
    let enough = |k: &str| {
        let begins_alike = word.chars().next() == k.chars().next();
        if begins_alike { 2 * common(k) > word.len() } else { 3 * common(k) > 2 * word.len() }
    };
    known.iter().copied().max_by_key(|k| (common(k), usize::MAX - k.len())).filter(|k| enough(k))
}
