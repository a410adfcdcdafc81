//! Absorbers that can be bought.

use super::named::{CATALOGUE, HUB_INERTIA, OWN_FREQUENCY, type_of};
use super::plain_names::as_plain_words;
use super::shown::shown;
use super::table::Table;
use crate::absorber::parameter::{DAMPING, RING_INERTIA, STIFFNESS};
use crate::absorber::{Declaration, Parameter, Range, TYPES, types};
use crate::input::error::InputError;
use crate::input::files::remark;
use crate::units::{HZ_PER_RAD_PER_S, PA_PER_MPA};
use std::path::Path;

/// An absorber of a catalogue.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CatalogueRow {
    /// Its name: letters, digits, `_`, `-` and `.`.
    pub name: String,
    /// Its type.
    pub declaration: &'static Declaration,
    /// A value for each of its parameters.
    pub values: Vec<f64>,
    /// Of the hub, kg m².
    pub hub_inertia: f64,
}

/// Types whose spring is the same at every frequency.
const SAME_SPRING: [&str; 3] = ["tuned", "undamped", "rubber"];

/// What a study says of all rows of a catalogue.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MadeWith {
    /// Of the ring, kg m².
    pub ring_inertia: Option<f64>,
    /// Factor B of the shape that is sheared, m³: with it a row may be a compound or an oil.
    pub factor: Option<f64>,
}

/// Columns of compounds and oils, with the parameter that each makes with a shape.
const OF_MATERIALS: [(&str, &str); 3] =
    [("shear_modulus_mpa", STIFFNESS.key), ("viscosity_mm2_per_s", DAMPING.key), ("density_kg_per_m3", DAMPING.key)];

impl MadeWith {
    /// A parameter that has no column of its own: S = B G' and B eta; nothing where it needs one.
    fn makes(&self, table: &Table, (line, cells): (u64, &[String]), p: &Parameter) -> Result<Option<f64>, InputError> {
        if table.header.iter().any(|h| h == p.key) {
            return Ok(None);
        }
        if p.key == RING_INERTIA.key {
            return Ok(self.ring_inertia);
        }
        if p.key == STIFFNESS.key && table.header.iter().any(|h| h == OWN_FREQUENCY) {
            return self.by_own_frequency(table, (line, cells)).map(Some);
        }
        let own = OF_MATERIALS.iter().filter(|m| m.1 == p.key && table.header.iter().any(|h| h == m.0));
        let (Some(factor), true) = (self.factor, own.count() > 0) else { return Ok(None) };
        let value = |key: &str| positive(table, (line, cells), key);
        let made = if p.key == STIFFNESS.key {
            PA_PER_MPA * value("shear_modulus_mpa")?
        } else {
            M2_PER_MM2 * value("viscosity_mm2_per_s")? * value("density_kg_per_m3")?
        };
        Ok(Some(factor * made))
    }

    /// J (2 pi f)².
    fn by_own_frequency(&self, table: &Table, (line, cells): (u64, &[String])) -> Result<f64, InputError> {
        let omega = positive(table, (line, cells), OWN_FREQUENCY)? / HZ_PER_RAD_PER_S;
        let inertia = match self.ring_inertia.filter(|_| table.header.iter().all(|h| h != RING_INERTIA.key)) {
            Some(inertia) => inertia,
            None => positive(table, (line, cells), RING_INERTIA.key)?,
        };
        Ok(inertia * omega * omega)
    }

    /// Whether a column of materials makes a parameter of a type.
    fn takes(table: &Table, declaration: &Declaration, column: &str) -> bool {
        if column == OWN_FREQUENCY {
            return SAME_SPRING.contains(&declaration.name);
        }
        let makes = |m: &&(&str, &str)| m.0 == column && declaration.index(m.1).is_some() && !table.header.iter().any(|h| h == m.1);
        OF_MATERIALS.iter().any(|m| makes(&m))
    }
}

/// The cell of a parameter.
fn within_range(table: &Table, (line, cells): (u64, &[String]), (declaration, p): (&Declaration, &Parameter)) -> Result<f64, InputError> {
    let column = table.column(p.key).map_err(|e| without(table, declaration, p).unwrap_or(e))?;
    let value = table.filled(line, column, &cells[column])?;
    let expected = match p.range {
        Range::Positive => (value <= 0.0).then(|| "a number above zero".to_owned()),
        Range::NotNegative => (value < 0.0).then(|| "zero or more".to_owned()),
        Range::Above(least) => (value <= least).then(|| format!("more than {least}")),
        Range::Within(low, high) => (!(low..=high).contains(&value)).then(|| format!("a value from {low} to {high}")),
    };
    match expected {
        Some(expected) => Err(table.at(line, column, format!("found {value}, expected {expected}"))),
        None => Ok(value),
    }
}

/// What is missing where no column says what the absorbers are.
fn without_types(table: &Table) -> InputError {
    let known: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
    let help = format!("each row says what it is, under `type`, Bauart or Typ: {}; Gummi and viskos are read, too", known.join(", "));
    table.without("type", "`type`", Some(help))
}

/// What is missing where neither a stiffness nor what makes one has a column; `None` of other parameters.
fn without(table: &Table, declaration: &Declaration, p: &Parameter) -> Option<InputError> {
    let has_frequency = p.key == STIFFNESS.key && SAME_SPRING.contains(&declaration.name);
    has_frequency.then(|| {
        let expected = format!("`{}`, or `{OWN_FREQUENCY}`, that of the ring on its hub held fast,", p.key);
        table.without(p.key, &expected, None)
    })
}

/// A cell of a row that is to be above zero.
fn positive(table: &Table, (line, cells): (u64, &[String]), key: &str) -> Result<f64, InputError> {
    let column = table.column(key)?;
    let value = table.filled(line, column, &cells[column])?;
    if value > 0.0 { Ok(value) } else { Err(table.at(line, column, format!("found {value}, expected a number above zero"))) }
}

/// Of the hub of a row, kg m²; none where it says none.
fn hub_inertia(table: &Table, (line, cells): (u64, &[String])) -> Result<f64, InputError> {
    let Some(column) = table.optional(HUB_INERTIA).filter(|c| !cells[*c].is_empty()) else { return Ok(0.0) };
    let value = table.filled(line, column, &cells[column])?;
    if value >= 0.0 { Ok(value) } else { Err(table.at(line, column, format!("found {value}, expected zero or more"))) }
}

const M2_PER_MM2: f64 = 1e-6;

/// `name, type` and a column for every parameter that a type in it has, empty where a row's type has none; what the study says of all rows needs no column.
///
/// # Errors
/// [`InputError`] with file, row and column.
#[doc(hidden)]
pub fn catalogue(path: &Path, with: MadeWith) -> Result<Vec<CatalogueRow>, InputError> {
    let own = ["name", "type", HUB_INERTIA, OWN_FREQUENCY]
        .into_iter()
        .chain(OF_MATERIALS.map(|m| m.0))
        .chain(TYPES.iter().flat_map(|t| t.parameters).map(|p| p.key));
    let table = Table::read_named(path, &own.collect::<Vec<_>>(), &CATALOGUE)?;
    let name = table.column("name")?;
    let kind = table.column("type").map_err(|_| without_types(&table))?;
    if let (Some(column), None) = (table.header.iter().position(|h| OF_MATERIALS.iter().any(|m| m.0 == h)), with.factor) {
        let found = format!("found column `{}`, expected `geometry` in its [[catalogue]], the shape that is sheared", table.header[column]);
        return Err(table.at_head(column, found));
    }
    let of_material = |key: &String| OF_MATERIALS.iter().any(|m| m.0 == key);
    // beside a stiffness the frequency says nothing more
    let has_stiffness = table.header.iter().any(|h| h == STIFFNESS.key);
    let known = |key: &String| {
        ["name", "type", HUB_INERTIA].contains(&key.as_str())
            || key == OWN_FREQUENCY && !has_stiffness
            || of_material(key)
            || TYPES.iter().any(|t| t.index(key).is_some())
    };
    let others: Vec<String> =
        table.header.iter().filter(|key| !known(key) && !key.is_empty()).map(|key| format!("`{}`", shown(key))).collect();
    if !others.is_empty() {
        remark(path, &format!("columns are left out: {}", others.join(", ")));
    }
    let mut rows: Vec<CatalogueRow> = Vec::new();
    let mut written = Vec::new();
    for (line, cells) in &table.rows {
        let word = &cells[kind];
        let own = as_plain_words(&cells[name]).map_err(|found| table.at(*line, name, found))?;
        if own != cells[name] {
            written.push(format!("`{}` as `{own}`", shown(&cells[name])));
        }
        if rows.iter().any(|r| r.name == own) {
            return Err(table.at(*line, name, format!("found `{own}` a second time, expected different names")));
        }
        let Some(declaration) = types::find(type_of(word)) else {
            let known: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
            return Err(table.at(*line, kind, format!("found type `{}`, expected one of {}", shown(word), known.join(", "))));
        };
        let mut values = Vec::new();
        for p in declaration.parameters {
            if let Some(value) = with.makes(&table, (*line, cells), p)? {
                values.push(value);
                continue;
            }
            values.push(within_range(&table, (*line, cells), (declaration, p))?);
        }
        let is_value = |c: usize| ![name, kind].contains(&c) && table.header[c] != HUB_INERTIA && known(&table.header[c]);
        for (column, cell) in cells.iter().enumerate().filter(|(c, cell)| !cell.is_empty() && is_value(*c)) {
            if declaration.index(&table.header[column]).is_none() && !MadeWith::takes(&table, declaration, &table.header[column]) {
                let found = format!(
                    "found `{}`, expected an empty cell: `{}` has no `{}`",
                    shown(cell),
                    declaration.name,
                    shown(&table.header[column])
                );
                return Err(table.at(*line, column, found));
            }
        }
        let hub_inertia = hub_inertia(&table, (*line, cells))?;
        rows.push(CatalogueRow { name: own, declaration, values, hub_inertia });
    }
    if !written.is_empty() {
        remark(path, &format!("names are written: {}", written.join(", ")));
    }
    if rows.is_empty() {
        return Err(table.whole("found no absorber, expected at least one row".into()));
    }
    Ok(rows)
}
