//! Numbers as tables write them: decimal points, or decimal commas where commas do not separate columns; thousands grouped by spaces, apostrophes, points or commas. What
//! can be read in two ways is read as the rest of the table shows, or refused.

/// What groups thousands besides points and commas: a space, a non-breaking one, a narrow one, a thin one, apostrophes.
const BLANKS: [char; 6] = [' ', '\u{a0}', '\u{202f}', '\u{2009}', '\'', '’'];

/// A cell as far as it shows what its signs mean.
#[derive(Debug, Clone, PartialEq)]
enum Shape {
    /// One number, in the form of Rust, with the signs that separate its decimals and its thousands.
    Number { plain: String, decimal: Option<char>, group: Option<char> },
    /// A group of three digits behind the only sign: decimals or thousands.
    Either(char),
    /// No number in these forms.
    Other,
}

/// Groups of digits: up to three, then three in each.
fn are_groups<'a>(mut parts: impl Iterator<Item = &'a str>) -> bool {
    let digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    let first = parts.next().unwrap_or("");
    (1..=3).contains(&first.len()) && digits(first) && parts.all(|part| part.len() == 3 && digits(part))
}

fn shape(cell: &str) -> Shape {
    let (mantissa, exponent) = cell.find(['e', 'E']).map_or((cell, ""), |i| cell.split_at(i));
    let unsigned = mantissa.strip_prefix(['+', '-']).unwrap_or(mantissa);
    let sign = &mantissa[..mantissa.len() - unsigned.len()];
    let known = |c: char| c.is_ascii_digit() || c == '.' || c == ',' || BLANKS.contains(&c);
    if !unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.' || c == ',') || !unsigned.chars().all(known) {
        return Shape::Other;
    }
    let number = |whole: &str, decimals: &str, decimal: Option<char>, group: Option<char>| {
        let whole: String = whole.chars().filter(|c| Some(*c) != group).collect();
        let point = if decimal.is_some() { "." } else { "" };
        let plain = format!("{sign}{whole}{point}{decimals}{exponent}");
        if plain.parse::<f64>().is_ok() { Shape::Number { plain, decimal, group } } else { Shape::Other }
    };
    let last = unsigned.rfind(['.', ',']);
    let split = last.map(|i| (&unsigned[..i], unsigned[i..].chars().next(), &unsigned[i + 1..]));
    if let Some(blank) = unsigned.chars().find(|c| BLANKS.contains(c)) {
        let (whole, decimal, decimals) = split.unwrap_or((unsigned, None, ""));
        let right = are_groups(whole.split(blank)) && decimals.bytes().all(|b| b.is_ascii_digit());
        return if right { number(whole, decimals, decimal, Some(blank)) } else { Shape::Other };
    }
    let Some((whole, Some(sign), decimals)) = split else { return number(unsigned, "", None, None) };
    match whole.chars().find(|c| !c.is_ascii_digit()) {
        // the only sign
        None => {
            let three = decimals.len() == 3 && are_groups([whole, decimals].into_iter()) && !whole.starts_with('0') && exponent.is_empty();
            if three { Shape::Either(sign) } else { number(whole, decimals, Some(sign), None) }
        }
        // 1.234.567
        Some(group) if group == sign => {
            if are_groups(unsigned.split(group)) {
                number(unsigned, "", None, Some(group))
            } else {
                Shape::Other
            }
        }
        // 1.234,5
        Some(group) => {
            if are_groups(whole.split(group)) {
                number(whole, decimals, Some(sign), Some(group))
            } else {
                Shape::Other
            }
        }
    }
}

/// A cell that shows what a sign means in its table.
type Seen = Option<(u64, String)>;

/// What the signs of a table mean, by the cells that can be read in one way only.
#[derive(Debug, Clone, Default)]
pub(crate) struct Convention {
    delimiter: Option<char>,
    /// First cells in which a point and a comma separate decimals.
    decimal: [Seen; 2],
    /// First cells in which they group thousands.
    group: [Seen; 2],
    /// First cells that can be read in either way.
    either: [Seen; 2],
}

/// Place of a sign in lists of both.
fn index(sign: char) -> usize {
    usize::from(sign == ',')
}

/// The sign by its name.
fn named(sign: char) -> &'static str {
    if sign == ',' { "comma" } else { "point" }
}

/// Why a cell is no number.
#[derive(Debug)]
pub(crate) struct Unclear {
    pub expected: String,
    pub help: Option<String>,
}

impl Convention {
    pub(crate) fn new(delimiter: char) -> Self {
        Self { delimiter: Some(delimiter), ..Self::default() }
    }

    /// The same delimiter, nothing learnt.
    pub(crate) fn anew(&self) -> Self {
        Self { delimiter: self.delimiter, ..Self::default() }
    }

    /// Takes note of a cell. Where commas separate columns nothing is to be learnt.
    pub(crate) fn note(&mut self, row: u64, cell: &str) {
        if self.delimiter == Some(',') || !cell.contains(['.', ',']) {
            return;
        }
        let seen = || Some((row, cell.to_owned()));
        match shape(cell) {
            Shape::Number { decimal, group, .. } => {
                for (sign, list) in [(decimal, &mut self.decimal), (group, &mut self.group)] {
                    if let Some(place) = sign.filter(|s| ['.', ','].contains(s)).map(|s| &mut list[index(s)]).filter(|p| p.is_none()) {
                        *place = seen();
                    }
                }
            }
            Shape::Either(sign) if self.either[index(sign)].is_none() => self.either[index(sign)] = seen(),
            Shape::Either(_) | Shape::Other => {}
        }
    }

    /// Whether the only sign of a number, with three digits behind it, groups thousands here; None where the table does not show it.
    fn groups(&self, sign: char) -> Option<bool> {
        let other = if sign == ',' { '.' } else { ',' };
        let (own, its) = (index(sign), index(other));
        let [decimal, group] = [&self.decimal, &self.group].map(|list| [list[own].is_some(), list[its].is_some()]);
        // where commas are decimal signs, and semicolons or tabs separate columns, points are none
        let by_commas = self.delimiter != Some(',') && sign == '.' && decimal[1] && !group[1];
        let is_group = (group[0] || by_commas) && !decimal[0];
        let is_decimal = !group[0] && !decimal[1] && (decimal[0] || group[1]);
        // semicolons separate columns where commas are decimal signs
        let by_delimiter = self.delimiter == Some(';') && sign == ',' && !group[0] && !decimal[1];
        match (is_group, is_decimal || by_delimiter) {
            (true, false) => Some(true),
            (false, true) => Some(false),
            _ => None,
        }
    }

    /// What a reader of the table must know: how a number was read that could be read in two ways.
    pub(crate) fn remark(&self) -> Option<String> {
        let told = |sign: char| {
            let (row, cell) = self.either[index(sign)].as_ref()?;
            let (value, because) = match (self.groups(sign)?, &self.group[index(sign)], &self.decimal[index(sign)]) {
                (true, Some((other, seen)), _) => (cell.replace(sign, ""), format!("groups thousands in `{seen}` (row {other})")),
                (false, _, Some((other, seen))) => (cell.replace(sign, "."), format!("separates decimals in `{seen}` (row {other})")),
                (false, ..) => (cell.replace(sign, "."), "separates decimals where semicolons separate columns".to_owned()),
                (true, None, _) => {
                    let (other, seen) = self.decimal[index(',')].as_ref()?;
                    (cell.replace(sign, ""), format!("is no decimal sign where the comma is one, in `{seen}` (row {other})"))
                }
            };
            Some(format!("`{cell}` in row {row} is read as {value}: the {} {because}", named(sign)))
        };
        ['.', ','].into_iter().find_map(told)
    }

    /// A cell as a number.
    ///
    /// # Errors
    /// What was expected in its place.
    pub(crate) fn read(&self, cell: &str) -> Result<f64, Unclear> {
        const MOST: f64 = 1e20;
        let within = |x: &f64| x.abs() <= MOST;
        let wrong = |expected: &str| Err(Unclear { expected: expected.into(), help: None });
        let only_points = self.delimiter == Some(',');
        if only_points && let Some(x) = cell.parse().ok().filter(within) {
            return Ok(x);
        }
        match shape(cell) {
            Shape::Number { decimal: Some(','), group: None, .. } if only_points => wrong("expected a number with a decimal point"),
            Shape::Either(',') if only_points => wrong("expected a number with one decimal point and nothing between thousands"),
            Shape::Number { plain, .. } => match plain.parse().ok().filter(within) {
                Some(x) => Ok(x),
                None => wrong("expected a number up to 1e20"),
            },
            Shape::Either(sign) => {
                let plain = match self.groups(sign) {
                    Some(true) => cell.replace(sign, ""),
                    Some(false) => cell.replace(sign, "."),
                    None => return Err(self.unclear(cell, sign)),
                };
                plain.parse().map_or_else(|_| wrong("expected a number up to 1e20"), Ok)
            }
            // "inf", and what else is none
            Shape::Other => wrong("expected a number up to 1e20"),
        }
    }

    fn unclear(&self, cell: &str, sign: char) -> Unclear {
        let (whole, decimal) = (cell.replace(sign, ""), cell.replace(sign, "."));
        let other = if sign == ',' { '.' } else { ',' };
        let shown = self.decimal[index(other)].as_ref().or(self.decimal[index(sign)].as_ref());
        let because = shown.map_or_else(String::new, |(row, seen)| format!(" beside `{seen}` in row {row}"));
        let expected = format!("expected a number that can be read in one way: this is {whole} or {decimal}{because}");
        let help = "leave out what groups thousands, or write another number of decimals; where the sign is a decimal point, commas between columns say so, too";
        Unclear { expected, help: Some(help.into()) }
    }
}
