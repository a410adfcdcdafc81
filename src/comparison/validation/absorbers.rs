//! Published absorbers: their values by the procedure of their source and by the correct one, and the natural frequencies with them.
//!
//! Nothing is assumed of the source but the list of formulas it may have used: the one that gives its numbers is found by trying them all.

use super::{Entry, Kind, Role, Uncertainty};
use crate::absorber::fixed_points::{self, Point};
use crate::absorber::mounted::station_of;
use crate::absorber::{Absorber, Declaration, Law, Mounted, closed_forms};
use crate::drivetrain::natural;
use crate::input::published::PublishedAbsorber;
use crate::input::{Published, Study};
use std::sync::Arc;

/// A formula is taken for that of the source where it gives the printed value within this share.
const FOUND: f64 = 0.02;
/// Units.
const STIFFNESS: &str = "N m/rad";
const DAMPING: &str = "N m s/rad";
/// Steps beside the common point.
const STEPS: [f64; 2] = [1.01, 0.99];

/// Whether the ring's damping is in printed frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Convention {
    /// Of the undamped motion.
    Undamped,
    /// Imaginary parts of the eigenvalues, the ring's damping included.
    Damped,
}

/// Frequencies of one published design by the convention that fits its printed ones, and by the other.
#[derive(Debug, Clone)]
pub(crate) struct Frequencies {
    /// Design.
    pub design: String,
    /// The one that fits; `None` without absorber, where there is no difference.
    pub convention: Option<Convention>,
    /// By that convention, Hz.
    pub fitting: Vec<f64>,
    /// By the other, Hz.
    pub other: Vec<f64>,
}

/// The same law with nothing that dissipates.
fn without_damping(law: &Arc<dyn Law>) -> Absorber {
    let declaration = law.declaration();
    let values: Vec<f64> = declaration.parameters.iter().zip(law.values()).map(|(p, v)| if p.dissipative { 0.0 } else { v }).collect();
    Absorber::Ring((declaration.build)(&values))
}

fn undamped(design: &[Mounted]) -> Vec<Mounted> {
    let still = |m: &Mounted| Mounted { absorber: m.absorber.law().map_or_else(|| m.absorber.clone(), without_damping), ..*m };
    design.iter().map(still).collect()
}

pub(crate) fn conventions(study: &Study, published: &Published) -> Vec<Frequencies> {
    let worst = |row: &PublishedAbsorber, own: &[f64]| {
        let off = |(i, hz): (usize, &Option<f64>)| hz.map(|hz| own.get(i).map_or(f64::INFINITY, |o| (o / hz - 1.0).abs()));
        row.frequencies_hz.iter().enumerate().filter_map(off).fold(0.0, f64::max)
    };
    let frequencies_of = |row: &PublishedAbsorber| {
        let design = study.designs.iter().find(|d| d.name == row.design)?;
        let with = |absorbers: &[Mounted]| natural::frequencies_hz(&study.chain, &study.modes, absorbers);
        let (damped, free) = (with(&design.absorbers), with(&undamped(&design.absorbers)));
        let design = row.design.clone();
        Some(if row.ring_inertia.is_none() {
            Frequencies { design, convention: None, fitting: damped, other: free }
        } else if worst(row, &damped) <= worst(row, &free) {
            Frequencies { design, convention: Some(Convention::Damped), fitting: damped, other: free }
        } else {
            Frequencies { design, convention: Some(Convention::Undamped), fitting: free, other: damped }
        })
    };
    published.absorbers.iter().filter_map(frequencies_of).collect()
}

pub fn entries(study: &Study, published: &Published, conventions: &[Frequencies]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for row in &published.absorbers {
        let put = |quantity: &str, kind: Kind, unit: &str, values: (Option<f64>, Option<f64>), role: Role, note: String| Entry {
            table: row.table.clone(),
            design: row.design.clone(),
            quantity: quantity.into(),
            kind,
            unit: unit.into(),
            published: values.0,
            computed: values.1,
            uncertainty: Uncertainty::default(),
            role,
            note,
        };
        let used = study.designs.iter().find(|d| d.name == row.design).and_then(|d| d.absorbers.first()).map(|m| &m.absorber);
        if let (Some(used), Some(_)) = (used, row.ring_inertia) {
            let given = [
                ("ring inertia", "kg m2", row.ring_inertia, Some(used.ring_inertia())),
                ("stiffness", "N m/rad", row.stiffness, used.stiffness()),
                ("damping", "N m s/rad", row.damping, used.damping()),
            ];
            for (quantity, unit, printed, used) in given {
                entries.push(put(quantity, Kind::Other, unit, (printed, used), Role::Given, "input of the design".into()));
            }
        }
        for p in procedures(study, row) {
            entries.push(put(&p.quantity, p.kind, p.unit, (Some(p.published), Some(p.computed)), p.role, p.note));
        }
        let Some(own) = conventions.iter().find(|f| f.design == row.design) else { continue };
        for (i, hz) in row.frequencies_hz.iter().enumerate().filter(|f| f.1.is_some()) {
            let values = (*hz, own.fitting.get(i).copied());
            entries.push(put(&format!("f{}", i + 1), Kind::Frequency, "Hz", values, Role::Predicted, words(own.convention)));
        }
        // a table that mixes conventions misleads its reader: the minority of its damped rings is named
        let in_table = |c: Convention| {
            let of_table = published.absorbers.iter().filter(|a| a.table == row.table);
            of_table.filter(|a| conventions.iter().any(|f| f.design == a.design && f.convention == Some(c))).count()
        };
        if own.convention == Some(Convention::Undamped) && in_table(Convention::Damped) > 0 {
            let note = "the row has the frequencies of a ring without its damping, other rows of the table have damped ones";
            let values = (row.frequencies_hz.first().copied().flatten(), own.other.first().copied());
            entries.push(put("f1 with damping", Kind::Other, "Hz", values, Role::Erratum, note.into()));
        }
    }
    entries
}

fn words(convention: Option<Convention>) -> String {
    match convention {
        None => "chain alone".into(),
        Some(Convention::Undamped) => "ring undamped".into(),
        Some(Convention::Damped) => "ring damped".into(),
    }
}

/// A value by a formula.
struct Procedure {
    quantity: String,
    kind: Kind,
    unit: &'static str,
    published: f64,
    computed: f64,
    role: Role,
    note: String,
}

/// The tunings a source may have meant, as omega_absorber/omega_engine, with the words of the stiffness that follows.
fn tunings(mu: f64) -> [(f64, &'static str, &'static str); 3] {
    [
        (1.0, "unity", "J w0^2"),
        (1.0 / (1.0 + mu).sqrt(), "1/sqrt(1+mu)", "J w0^2/(1+mu)"),
        (1.0 / (1.0 + mu), "1/(1+mu)", "J w0^2/(1+mu)^2"),
    ]
}

fn off(computed: f64, published: f64) -> f64 {
    (computed / published - 1.0).abs()
}

/// The damping of a ring without a spring, by the inertia that gives it best.
fn viscous_procedure(row: &PublishedAbsorber, ring: f64, unit: f64, inertias: &[(f64, &'static str)]) -> Option<Procedure> {
    let published = row.damping?;
    let damping_by = |(inertia, words): &(f64, &'static str)| (unit * closed_forms::viscous_untuned(ring / inertia), *words);
    let (computed, inertia) = inertias.iter().map(damping_by).min_by(|a, b| off(a.0, published).total_cmp(&off(b.0, published)))?;
    let note = format!("1/sqrt(2(1+mu)(2+mu)), mu of the {inertia}");
    Some(Procedure {
        quantity: "damping by procedure".into(),
        kind: Kind::Damping,
        unit: DAMPING,
        published,
        computed,
        role: Role::Recomputed,
        note,
    })
}

fn procedures(study: &Study, row: &PublishedAbsorber) -> Vec<Procedure> {
    let (Some(ring), Some(station), Some(mode)) = (
        row.ring_inertia,
        study.designs.iter().find(|d| d.name == row.design).filter(|d| !d.absorbers.is_empty()).map(|d| station_of(&d.absorbers, 0)),
        study.modes.elastic().next(),
    ) else {
        return Vec::new();
    };
    let omega = study.modes.omega[mode];
    let inertias = [(study.chain.total_inertia(), "whole chain"), (study.modes.equivalent_inertia(mode, station), "first mode")];
    let unit = 2.0 * ring * omega;
    let mut list = Vec::new();
    let mut put = |quantity: &str, (kind, unit): (Kind, &'static str), (published, computed): (f64, f64), role: Role, note: String| {
        list.push(Procedure { quantity: quantity.into(), kind, unit, published, computed, role, note });
    };
    let viscous = row.stiffness.is_none_or(|k| k == 0.0);
    if viscous {
        return viscous_procedure(row, ring, unit, &inertias).into_iter().collect();
    }
    // the inertia and the tuning that give the printed stiffness, and those that give the printed damping
    let candidates = || inertias.into_iter().flat_map(|(inertia, words)| tunings(ring / inertia).map(|t| (ring / inertia, words, t)));
    let best = |value: &dyn Fn(f64, f64) -> Option<f64>, printed: f64| {
        let tried = candidates().filter_map(|(mu, words, t)| value(mu, t.0).map(|v| (v, mu, words, t)));
        tried.min_by(|a, b| off(a.0, printed).total_cmp(&off(b.0, printed)))
    };
    let by_stiffness = row.stiffness.and_then(|k| best(&|_, t| Some(ring * omega * omega * t * t), k).map(|b| (k, b)));
    let by_damping = row.damping.and_then(|c| {
        let nearest = |mu: f64, t: f64| {
            let of_step = |s: f64| fixed_points::damping(mu, t, Point::I, s).map(|d| unit * d);
            STEPS.iter().filter_map(|s| of_step(*s)).min_by(|a, b| off(*a, c).total_cmp(&off(*b, c)))
        };
        best(&nearest, c).map(|b| (c, b))
    });
    if let Some((k, (computed, _, inertia, t))) = by_stiffness {
        // a tuning of one does not depend on the inertia
        let of = if t.1 == "unity" { String::new() } else { format!(", mu of the {inertia}") };
        let nearest = if off(computed, k) < FOUND { "" } else { "; none of the formulas tried is nearer" };
        put("stiffness by procedure", (Kind::Stiffness, STIFFNESS), (k, computed), Role::Recomputed, format!("{}{of}{nearest}", t.2));
    }
    if let Some((c, (computed, mu, inertia, t))) = by_damping {
        for step in STEPS {
            if let Some(d) = fixed_points::damping(mu, t.0, Point::I, step) {
                let note = format!("level with common point I a step away, tuning {}, mu of the {inertia}", t.1);
                put(&format!("damping by step {step}"), (Kind::Damping, DAMPING), (c, unit * d), Role::Recomputed, note);
            }
        }
        let exact = match t.1 {
            "unity" => Some(closed_forms::brock_unity(mu)),
            "1/(1+mu)" => Some(closed_forms::den_hartog_brock(mu)),
            _ => None,
        };
        if let Some(exact) = exact {
            put(
                "damping, exact",
                (Kind::Other, DAMPING),
                (c, unit * exact),
                Role::Recomputed,
                "Brock: horizontal at the common points, no step".into(),
            );
        }
        if let Some((k, (found, _, _, used))) = by_stiffness
            && used.1 != t.1
            && off(found, k) < FOUND
            && off(computed, c) < FOUND
        {
            let note = format!("printed as {}, but the damping is that of the tuning {}, which needs {}", used.2, t.1, t.2);
            put("stiffness, correct", (Kind::Other, STIFFNESS), (k, ring * omega * omega * t.0 * t.0), Role::Erratum, note);
        }
    }
    list
}

impl Frequencies {
    /// Number of the mode nearest to a frequency, from 1, with its frequency; nothing where there is none.
    pub(crate) fn nearest(&self, hz: f64) -> Option<(usize, f64)> {
        let found = self.fitting.iter().enumerate().min_by(|a, b| (a.1 - hz).abs().total_cmp(&(b.1 - hz).abs()));
        found.map(|(i, f)| (i + 1, *f))
    }
}

/// The type of a design's first absorber; nothing where there is none, or where it is locked.
pub(crate) fn type_of(design: &[Mounted]) -> Option<&'static Declaration> {
    design.first().and_then(|m| m.absorber.declaration())
}
