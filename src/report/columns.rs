//! What the columns of tables hold, by their names: the same in every table and of every study.

/// What the cells of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Text,
    /// `true` or `false`.
    Truth,
    /// A whole number.
    Count,
    Number,
}

/// Columns of words and names.
const TEXT: [&str; 36] = [
    "absorbers",
    "catalogue",
    "condition",
    "criterion",
    "curve",
    "design",
    "engine",
    "excluded_by",
    "fillet",
    "found_from",
    "front",
    "input",
    "kind",
    "material",
    "measure",
    "method",
    "note",
    "objective",
    "on_station",
    "panel",
    "parameter",
    "proof",
    "quantity",
    "role",
    "rule",
    "setting",
    "shaft",
    "stage",
    "station",
    "symbol",
    "table",
    "type",
    "unit",
    "where",
    "worst_at",
    "words",
];
/// Ends of names of such columns.
const TEXT_ENDS: [&str; 3] = ["_fillet", "_quantity", "_shaft"];
const TRUTH: [&str; 7] = ["converged", "dominated", "held", "knee", "limited", "limits_hold", "stable"];
const COUNT: [&str; 21] = [
    "absorber",
    "box",
    "designs_elsewhere",
    "designs_nearby",
    "direct_solves",
    "evaluations",
    "evaluations_minimax",
    "evaluations_search",
    "free_directions",
    "misfire_cylinder",
    "other_optima",
    "place",
    "point",
    "proof_boxes",
    "receptance_points",
    "round",
    "rounds",
    "singular_points",
    "starts",
    "starts_agreeing",
    "syntheses",
];
/// Columns that are something else in one table.
const IN_TABLE: [(&str, &str, Kind); 6] = [
    ("designs", "absorber", Kind::Text),
    ("pareto", "absorber", Kind::Text),
    ("heat", "stable", Kind::Text),
    ("speed_accuracy", "stable", Kind::Text),
    ("fatigue", "point", Kind::Text),
    ("large_twist", "curve", Kind::Count),
];

/// Units by the ends of names, longer ends before those that they end with.
const UNITS: [(&str, &str); 32] = [
    ("_n_m_s_per_rad", "N m s/rad"),
    ("_n_m_per_rad", "N m/rad"),
    ("_kg_m2", "kg m²"),
    ("_rad_per_s2", "rad/s²"),
    ("_rad_per_s", "rad/s"),
    ("_per_rad2", "1/rad²"),
    ("_n_m", "N m"),
    ("_kg_m", "kg m"),
    ("_pa_s", "Pa s"),
    ("_mm2_per_s", "mm²/s"),
    ("_mm4", "mm⁴"),
    ("_mm3", "mm³"),
    ("_mm2", "mm²"),
    ("_m3", "m³"),
    ("_mpa", "MPa"),
    ("_bar", "bar"),
    ("_rpm", "rpm"),
    ("_deg", "°"),
    ("_percent", "%"),
    ("_hz", "Hz"),
    ("_mm", "mm"),
    ("_kg", "kg"),
    ("_kn", "kN"),
    ("_per_h", "1/h"),
    ("seconds", "s"),
    ("_kw", "kW"),
    ("_w", "W"),
    ("_n", "N"),
    ("_c", "°C"),
    ("_h", "h"),
    ("_m", "m"),
    ("_s", "s"),
];

/// What a column of a table holds; the table is named without its ending.
pub(super) fn kind(table: &str, column: &str) -> Kind {
    if let Some((_, _, kind)) = IN_TABLE.iter().find(|(t, c, _)| *t == table && *c == column) {
        return *kind;
    }
    match column {
        c if TEXT.contains(&c) || TEXT_ENDS.iter().any(|end| c.ends_with(end)) => Kind::Text,
        c if TRUTH.contains(&c) => Kind::Truth,
        c if COUNT.contains(&c) => Kind::Count,
        _ => Kind::Number,
    }
}

/// The name of a column and the number behind it, of parameters of one absorber of several; the digit of a unit (`_kg_m2`) is none.
fn numbered(column: &str) -> (&str, Option<&str>) {
    let name = column.trim_end_matches(|c: char| c.is_ascii_digit());
    match name.strip_suffix('_') {
        Some(own) if name.len() < column.len() => (own, Some(&column[name.len()..])),
        _ => (column, None),
    }
}

/// The end of the name of a column of numbers that tells its unit, and the unit.
fn ending(name: &str) -> Option<(&'static str, &'static str)> {
    UNITS.iter().find(|(end, _)| name.ends_with(end)).copied()
}

/// The unit of a column of numbers, as its name says it; `None` of what has no unit or has it in another column.
pub(super) fn unit(column: &str) -> Option<&'static str> {
    ending(numbered(column).0).map(|found| found.1)
}

/// The name of a column in words, with its unit behind a comma.
pub(super) fn heading(column: &str) -> String {
    let (name, number) = numbered(column);
    let Some((end, unit)) = ending(name) else { return column.replace('_', " ") };
    let words = name.strip_suffix(end).filter(|words| !words.is_empty()).unwrap_or(name).replace('_', " ");
    let of = number.map_or_else(String::new, |n| format!(" of absorber {n}"));
    format!("{words}{of}, {unit}")
}
