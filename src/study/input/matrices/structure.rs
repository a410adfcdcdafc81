//! A structure from its files: matrices put together, compared and brought into SI.

use super::lines::{Lines, Raw};
use super::{abaqus, coordinate, dmig, op4, user_element};
use crate::input::error::{InputError, Source};
use crate::input::tables::Table;
use crate::rotor::structure::{Structure, Unknown};
use nalgebra::{DMatrix, Vector3};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Relative difference of an entry and its mirror image that is rounding.
const SYMMETRIC: f64 = 1e-6;

/// A matrix with its unknowns, where its file names them.
#[derive(Debug, Clone, PartialEq)]
struct Read {
    values: DMatrix<f64>,
    unknowns: Option<Vec<Unknown>>,
}

/// Reads a matrix; `named`: unknowns that another file names.
fn read(path: &Path, named: Option<&[Unknown]>) -> Result<Read, InputError> {
    let source = Source::read(path)?;
    let lines = Lines { source: &source };
    let upper = source.text().to_uppercase();
    let first = upper.lines().find(|l| !l.trim().is_empty()).unwrap_or("");
    let raw = if first.starts_with("%%MATRIXMARKET") {
        coordinate::matrix_market(&lines)?
    } else if upper.contains("*USER ELEMENT") {
        user_element::read(&lines)?
    } else if upper.lines().any(|l| l.starts_with("DMIG")) {
        dmig::read(&lines)?
    } else if op4::is_header(first) {
        op4::read(&lines)?
    } else if first.contains(',') || first.starts_with('*') {
        abaqus::read(&lines)?
    } else {
        coordinate::triplets(&lines)?
    };
    assembled(&lines, path, raw, named)
}

/// The matrix: one triangle is mirrored, both are compared.
fn assembled(lines: &Lines, path: &Path, raw: Raw, named: Option<&[Unknown]>) -> Result<Read, InputError> {
    let largest = raw.entries.iter().map(|e| e.row.max(e.column) + 1).max().unwrap_or(0);
    let size = named.map(<[Unknown]>::len).or(raw.unknowns.as_ref().map(Vec::len)).or(raw.size).unwrap_or(largest);
    if raw.entries.is_empty() || size == 0 {
        return Err(InputError::of_file(
            path,
            "found no entry, expected a matrix: Matrix Market, rows of `row column value`, a substructure, DMIG or OP4",
        ));
    }
    if let Some(e) = raw.entries.iter().find(|e| e.row.max(e.column) >= size) {
        let found =
            format!("found row {} and column {}, expected at most {size} of each, as many as there are unknowns", e.row + 1, e.column + 1);
        return Err(lines.wrong(e.line, "", found));
    }
    if let Some(own) = raw.size.filter(|own| *own != size) {
        return Err(InputError::of_file(path, format!("found a matrix of {own} rows, expected {size}, one an unknown")));
    }
    let mut known: HashMap<(usize, usize), (f64, usize)> = HashMap::new();
    for e in &raw.entries {
        let other = known.insert((e.row, e.column), (e.value, e.line));
        if let Some((value, line)) = other.filter(|o| o.0 != e.value) {
            let (row, column) = (e.row + 1, e.column + 1);
            let found =
                format!("found row {row}, column {column} a second time, {} after {value} in line {line}, expected each once", e.value);
            return Err(lines.wrong(e.line, "", found));
        }
    }
    // of a sequence of unknowns of its own one triangle may lie on both sides of the diagonal
    let is_one = !raw.is_full && raw.entries.iter().all(|e| e.row == e.column || !known.contains_key(&(e.column, e.row)));
    let sign = if raw.skew { -1.0 } else { 1.0 };
    let mut values = DMatrix::zeros(size, size);
    for e in &raw.entries {
        values[(e.row, e.column)] = e.value;
        if is_one && e.row != e.column {
            values[(e.column, e.row)] = sign * e.value;
        }
    }
    Ok(Read { values, unknowns: raw.unknowns })
}

/// Units in which a finite-element program computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitSystem {
    /// m, kg, N, s.
    Si,
    /// mm, t, N, s.
    MmTonne,
}

/// Files of a structure.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct MatrixFiles {
    /// K.
    pub stiffness: PathBuf,
    /// M.
    pub mass: Option<PathBuf>,
    /// G and K_s + Kc - Z of turning axes.
    pub rotating: [Option<PathBuf>; 2],
    /// A line an unknown: node and component.
    pub unknowns: Option<PathBuf>,
    /// Columns node, x, y, z.
    pub nodes: Option<PathBuf>,
    /// Of all files.
    pub units: UnitSystem,
}

/// Reads a structure, in SI.
///
/// # Errors
/// [`InputError`] at the line that is not understood, and where matrices are not square, not symmetric, or of other unknowns than each other.
#[doc(hidden)]
pub fn structure(files: &MatrixFiles) -> Result<Structure, InputError> {
    let named = files.unknowns.as_deref().map(unknowns).transpose()?;
    let own = read(&files.stiffness, named.as_deref())?;
    let count = own.values.nrows();
    let unknowns = named.or(own.unknowns.clone()).ok_or_else(|| {
        InputError::of_file(
            &files.stiffness,
            "found a matrix without names of its unknowns, expected them in a file of their own (--dof): a line each, `node.component`",
        )
    })?;
    let other = |path: &PathBuf| -> Result<DMatrix<f64>, InputError> {
        let found = read(path, files.unknowns.is_some().then_some(&unknowns[..]))?;
        if found.values.nrows() != count || found.unknowns.as_ref().is_some_and(|u| *u != unknowns) {
            return Err(InputError::of_file(
                path,
                format!("found a matrix of {} unknowns, expected the {count} of the stiffness in the same sequence", found.values.nrows()),
            ));
        }
        Ok(found.values)
    };
    let mass = files.mass.as_ref().map(other).transpose()?;
    let [gyroscopic, turning] = [0, 1].map(|k| files.rotating[k].as_ref().map(other).transpose());
    let (length, scale) = match files.units {
        UnitSystem::Si => (1.0, 1.0_f64),
        UnitSystem::MmTonne => (1e-3, 1e-3),
    };
    let places = files.nodes.as_deref().map(|path| places(path, &unknowns, length)).transpose()?.unwrap_or_default();
    // K_SI = 1e-3 D K D of N, mm, t and s, D 1000 of translations, 1 of rotations; a mode keeps its unit mass
    let factor = |u: &Unknown| match (files.units, u.component) {
        (UnitSystem::Si, _) | (UnitSystem::MmTonne, 4..=6) => 1.0,
        (UnitSystem::MmTonne, 0) => 1.0 / scale.sqrt(),
        (UnitSystem::MmTonne, _) => 1e3,
    };
    let d: Vec<f64> = unknowns.iter().map(factor).collect();
    let si = |x: DMatrix<f64>| DMatrix::from_fn(count, count, |i, j| scale * d[i] * x[(i, j)] * d[j]);
    let symmetric = |x: DMatrix<f64>, path: &Path, what: &str| -> Result<DMatrix<f64>, InputError> {
        let off = (&x - x.transpose()).amax() / x.amax().max(f64::MIN_POSITIVE);
        if off > SYMMETRIC {
            return Err(InputError::of_file(
                path,
                format!("found a {what} that differs from its mirror image by {off:.1e} of its largest entry, expected a symmetric one"),
            ));
        }
        Ok((&x + x.transpose()) * 0.5)
    };
    let stiffness = symmetric(si(own.values), &files.stiffness, "stiffness")?;
    let mass = mass.map(|m| symmetric(si(m), files.mass.as_deref().unwrap_or(&files.stiffness), "mass")).transpose()?;
    Ok(Structure { unknowns, places, stiffness, mass, gyroscopic: gyroscopic?.map(si), turning: turning?.map(si) })
}

/// Names of unknowns: lines `node.component`, or both with a blank or a comma between.
fn unknowns(path: &Path) -> Result<Vec<Unknown>, InputError> {
    let source = Source::read(path)?;
    let lines = Lines { source: &source };
    let mut all: Vec<Unknown> = Vec::new();
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty() && !l.1.trim_start().starts_with('#')) {
        let mut parts = text.split(|c: char| c == '.' || c == ',' || c.is_whitespace()).filter(|p| !p.is_empty());
        let (Some(node), Some(component), None) = (parts.next(), parts.next(), parts.next()) else {
            return Err(lines.wrong(line, text.trim(), format!("found `{}`, expected `node.component`", text.trim())));
        };
        let unknown = Unknown { node: lines.whole(line, node)?, component: lines.component(line, component)? };
        if all.contains(&unknown) {
            return Err(lines.wrong(line, text.trim(), format!("found `{}` a second time, expected each unknown once", text.trim())));
        }
        all.push(unknown);
    }
    if all.is_empty() {
        return Err(InputError::of_file(path, "found no unknown, expected a line each, `node.component`"));
    }
    Ok(all)
}

/// Places of nodes, m.
fn places(path: &Path, unknowns: &[Unknown], length: f64) -> Result<BTreeMap<u64, Vector3<f64>>, InputError> {
    let table = Table::read(path, &["node", "x", "y", "z"])?;
    let columns = ["node", "x", "y", "z"].map(|name| table.column(name));
    let [node, x, y, z] = columns;
    let (node, axes) = (node?, [x?, y?, z?]);
    let mut all = BTreeMap::new();
    for (line, cells) in &table.rows {
        let number = table.filled(*line, node, &cells[node])?;
        if number.fract() != 0.0 || !(0.0..1e15).contains(&number) {
            return Err(table.at(*line, node, format!("found `{}`, expected the number of a node", cells[node])));
        }
        let mut place = Vector3::zeros();
        for (k, column) in axes.iter().enumerate() {
            place[k] = length * table.filled(*line, *column, &cells[*column])?;
        }
        all.insert(number as u64, place);
    }
    if let Some(missing) = unknowns.iter().find(|u| u.component > 0 && !all.contains_key(&u.node)) {
        return Err(table.whole(format!("found no node {}, expected the places of all nodes that the matrices move", missing.node)));
    }
    Ok(all)
}
