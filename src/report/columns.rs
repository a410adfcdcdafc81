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
const TEXT: [&str; 34] = [
    "absorbers",
    "catalogue",
    "condition",
    "criterion",
    "curve",
    "design",
    "engine",
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
const COUNT: [&str; 19] = [
    "absorber",
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

/// The unit of a column of numbers, as its name says it; `None` of what has no unit or has it in another column.
pub(super) fn unit(column: &str) -> Option<&'static str> {
    // parameters of one absorber of several end with its number
    let name = column.trim_end_matches(|c: char| c.is_ascii_digit());
    let name = if name.len() < column.len() { name.strip_suffix('_').unwrap_or(column) } else { column };
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| *unit)
}

/// The name of a column in words, with its unit behind a comma.
pub(super) fn heading(column: &str) -> String {
    let Some(unit) = unit(column) else { return column.replace('_', " ") };
    let number = &column[column.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
    let name = column.strip_suffix(number).unwrap_or(column).trim_end_matches('_');
    let words = UNITS.iter().find(|(end, _)| name.ends_with(end)).map_or(name, |(end, _)| &name[..name.len() - end.len()]);
    let words = if words.is_empty() { name } else { words };
    let of = if number.is_empty() { String::new() } else { format!(" of absorber {number}") };
    format!("{}{of}, {unit}", words.replace('_', " ").trim())
}
