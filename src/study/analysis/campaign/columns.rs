//! The columns that cases fill: the same in every shard of a campaign.

use crate::input::campaign::{BOUND_OF_RATIO, Campaign, DAMPER, DAMPERS, Each, RATIO, WORST_RATIO};
use crate::input::{AbsorberSpec, FrontSpec, MeasureSpec, Study};

/// What the cells of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellKind {
    /// Words.
    Text,
    /// True or false.
    Truth,
    /// Whole numbers.
    Count,
    /// Numbers.
    Number,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Column {
    /// With its unit.
    pub name: String,
    /// What its cells are.
    pub kind: CellKind,
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// A word.
    Text(String),
    /// True or false.
    Truth(bool),
    /// A whole number.
    Count(i64),
    /// A number; what is not finite is nothing.
    Number(f64),
}

impl Cell {
    /// A number, or nothing.
    pub(super) fn of(x: Option<f64>) -> Self {
        x.filter(|x| x.is_finite()).map_or(Self::Empty, Self::Number)
    }
}

fn column(name: impl Into<String>, kind: CellKind) -> Column {
    Column { name: name.into(), kind }
}

/// Columns of the values of objectives, and of limits: each measure over its limit.
pub(super) fn of_limit(study: &Study, index: usize) -> String {
    let own = &study.limits[index].of.column;
    let before = study.limits[..index].iter().filter(|l| l.of.column == *own).count();
    format!("{own}_over_limit{}", if before > 0 { format!("_{}", before + 1) } else { String::new() })
}

/// The column of a parameter of an absorber of a design of so many.
pub(super) fn of_parameter(key: &str, index: usize, absorbers: usize) -> String {
    if absorbers > 1 { format!("{key}_{}", index + 1) } else { key.to_owned() }
}

/// The column of a measure at its worst within tolerances.
pub(super) fn at_worst(name: &str) -> String {
    format!("worst_{name}")
}

/// The column of what no design is below.
pub(super) fn bound_of(o: &MeasureSpec) -> String {
    format!("lower_bound_of_{}", o.column)
}

/// The column of what an objective counts as one at.
pub(super) fn target_of(o: &MeasureSpec) -> String {
    format!("target_of_{}", o.column)
}

/// Objectives whose values are told.
pub(super) fn objectives(study: &Study) -> Vec<&MeasureSpec> {
    study.objectives().chain(study.combined.iter().map(|c| &c.spec)).collect()
}

/// Columns of the results of a study.
fn of_study(study: &Study, each: Each) -> Vec<Column> {
    use CellKind::{Count, Number, Text, Truth};
    let mut list = vec![column("design", Text), column("types", Text)];
    match each {
        Each::Optimise => list.push(column("objective", Text)),
        Each::Platform => list.extend([
            column(DAMPERS, Count),
            column(DAMPER, Count),
            column(WORST_RATIO, Number),
            column(BOUND_OF_RATIO, Number),
            column(RATIO, Number),
            column(target_of(&study.objective), Number),
        ]),
        Each::Evaluate | Each::Front | Each::Robust => {}
    }
    list.push(column("limits_hold", Truth));
    let told = if each == Each::Platform { vec![&study.objective] } else { objectives(study) };
    list.extend(told.iter().map(|o| column(o.column.clone(), Number)));
    list.extend((0..study.limits.len()).map(|i| column(of_limit(study, i), Number)));
    if each == Each::Optimise && study.robust.as_ref().is_some_and(|r| r.search) {
        list.push(column(at_worst(&study.objective.column), Number));
    }
    if let (Each::Front, Some(FrontSpec::Of { measures, .. })) = (each, &study.front) {
        list.extend(measures.iter().map(|m| column(m.column.clone(), Number)));
    }
    if each == Each::Robust {
        list.push(column(at_worst(&study.objective.column), Number));
        if study.robust.as_ref().is_some_and(|r| r.sampling.is_some()) {
            list.push(column(format!("percentile_{}", study.objective.column), Number));
        }
        list.extend((0..study.limits.len()).map(|i| column(at_worst(&of_limit(study, i)), Number)));
    }
    let sold = study.catalogues.iter().filter(|_| each == Each::Evaluate).flat_map(|c| &c.designs);
    let given = study.designs.iter().filter(|_| matches!(each, Each::Evaluate | Each::Robust)).chain(sold);
    let given = given.map(|d| d.absorbers.iter().map(|m| m.absorber.declaration().into_iter().collect()).collect::<Vec<Vec<_>>>());
    let sought = |absorbers: &[AbsorberSpec]| absorbers.iter().map(|a| a.types.clone()).collect::<Vec<_>>();
    let found = study.optimise.iter().filter(|_| each != Each::Evaluate).map(|o| sought(&o.absorbers));
    for design in given.chain(found) {
        for (i, declarations) in design.iter().enumerate() {
            let keys = declarations.iter().flat_map(|d| d.parameters).map(|p| p.key);
            list.extend(keys.map(|key| column(of_parameter(key, i, design.len()), Number)));
        }
    }
    match each {
        Each::Optimise => {
            list.extend([column("converged", Truth), column("kkt_residual", Number), column("starts_agreeing", Count)]);
            list.extend([column("evaluations", Count), column("proof", Text)]);
            list.extend(objectives(study).iter().map(|o| column(bound_of(o), Number)));
        }
        Each::Front => list.extend([column("point", Count), column("dominated", Truth), column("kkt_residual", Number)]),
        Each::Platform => {
            list.extend([
                column("converged", Truth),
                column("kkt_residual", Number),
                column("starts_agreeing", Count),
                column("proof", Text),
            ]);
        }
        Each::Evaluate | Each::Robust => {}
    }
    list
}

/// Columns of a campaign: the case, what varies, what is drawn, what became of it, and its results by some of its studies.
#[doc(hidden)]
pub fn columns<'s>(campaign: &Campaign, studies: impl Iterator<Item = &'s Study>) -> Vec<Column> {
    let mut list = vec![column("case", CellKind::Count)];
    let axis = |numeric: bool| if numeric { CellKind::Number } else { CellKind::Text };
    list.extend(campaign.all_axes().map(|a| column(a.name.clone(), axis(a.numeric))));
    list.extend(campaign.sample.iter().flat_map(|s| &s.keys).map(|k| column(k.name.clone(), CellKind::Number)));
    list.extend([column("status", CellKind::Text), column("reason", CellKind::Text)]);
    let inputs = list.len();
    let exact = campaign.tolerance.map(|_| column("exact", CellKind::Truth));
    for own in exact.into_iter().chain(studies.flat_map(|study| of_study(study, campaign.each))) {
        // what a case is given has its column already: of a result of the same name, but for capitals, there is another one
        let is_given = list[..inputs].iter().any(|c| c.name.eq_ignore_ascii_case(&own.name));
        let name = if is_given { found(&own.name) } else { own.name };
        if list.iter().all(|c| c.name != name) {
            list.push(Column { name, ..own });
        }
    }
    list
}

/// The column that rows are compared by, and whether the largest is best.
#[doc(hidden)]
pub fn compared_by(campaign: &Campaign, columns: &[Column], objective: &MeasureSpec) -> (String, bool) {
    let (name, larger) = match campaign.platform {
        Some(_) => (WORST_RATIO, false),
        None => (objective.column.as_str(), objective.unit.is_inverse()),
    };
    (index_of(campaign, columns, name).map(|i| columns[i].name.clone()).unwrap_or_default(), larger)
}

/// Where results of a name are: in its own column, in another one where a case is given what has that name, or, of a single absorber, in that of the first of several.
pub(super) fn index_of(campaign: &Campaign, columns: &[Column], name: &str) -> Option<usize> {
    // the case and what it is given, status and reason
    let inputs = 3 + campaign.all_axes().count() + campaign.sample.as_ref().map_or(0, |s| s.keys.len());
    let at = |name: &str| columns.iter().skip(inputs).position(|c| c.name == name).map(|i| inputs + i);
    at(name).or_else(|| at(&found(name))).or_else(|| at(&of_parameter(name, 0, 2)))
}

/// The column of a result where its name is that of what a case is given.
fn found(name: &str) -> String {
    format!("{name}_found")
}
