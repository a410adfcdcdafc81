//! The crank of a study: factors of stress concentration, loads of its main bearings.

use super::table::{significant, table};
use crate::analysis::bearings::{BearingLoad, bearing_loads};
use crate::crankshaft::stress_concentration::Formulas;
use crate::crankshaft::{Concentration, Crank};
use crate::drivetrain::throw_inertia::throw_inertia;
use crate::drivetrain::throw_stiffness::{ThrowFormula, shear_modulus};
use crate::engine::Source;
use crate::input::Study;
use crate::units::{DEG_PER_RAD, M_PER_MM, N_PER_KN};
use std::fmt::Write;

/// Dimensions, factors and bearing loads at the highest speed; nothing without `[crank]`.
pub fn crank(study: &Study) -> Option<String> {
    let crank = study.crank.as_ref()?;
    let mut text = format!(
        "Crank: overlap of crankpin and journal {} mm ({:.4} of the crankpin)",
        significant(crank.overlap() / M_PER_MM, 4),
        crank.overlap() / crank.pin_diameter
    );
    if !crank.assumed.is_empty() {
        let _ = write!(text, "; assumed: {}", crank.assumed.join(", "));
    }
    text.push('\n');
    text.push_str(&factors(crank));
    text.push_str(&throws(study, crank));
    if let Some(loads) = bearings(study) {
        text.push_str(&loads);
    }
    Some(text)
}

fn factors(crank: &Crank) -> String {
    let notch = crank.notch();
    let out = notch.out_of_range();
    if !out.is_empty() {
        let names: Vec<&str> = out.iter().map(|o| o.name).collect();
        return format!("  no factors by formulas: {} outside their ranges\n", names.join(", "));
    }
    let mut rows = Vec::new();
    for (name, formulas) in [("IACS UR M53", Formulas::IacsM53), ("FVV 1973", Formulas::Fvv1973)] {
        let c = Concentration::new(&notch, formulas);
        let places = [("crankpin", Some(c.crankpin)), ("journal", Some(c.journal)), ("oil bore", c.oil_bore)];
        for (place, f) in places.into_iter().filter_map(|(p, f)| Some((p, f?))) {
            let number = |x: f64| if x == 0.0 { "-".into() } else { format!("{x:.4}") };
            rows.push(vec![format!("{name}, {place}"), number(f.bending), number(f.radial), number(f.torsion)]);
        }
    }
    table(&["stress concentration", "bending", "radial force", "torsion"], &rows)
}

/// Stiffness of each throw by every formula: how far apart they are is how well it is known.
fn throws(study: &Study, crank: &Crank) -> String {
    let modulus = shear_modulus(crank.young_modulus);
    let cell = |formula: ThrowFormula, t: usize| {
        let throw = crank.throw(t);
        formula.out_of_range(&throw).map_or_else(|| significant(formula.stiffness(&throw, modulus), 4), |_| "out of range".into())
    };
    let row = |t: usize| -> Vec<String> {
        std::iter::once((t + 1).to_string()).chain(ThrowFormula::ALL.into_iter().map(|f| cell(f, t))).collect()
    };
    let header: Vec<&str> = std::iter::once("throw").chain(ThrowFormula::ALL.map(ThrowFormula::name)).collect();
    let chosen = crank.stiffness_formula.map_or_else(
        || "none is used: the stations give theirs".to_owned(),
        |f| format!("`{}` is used where a station gives none", f.name()),
    );
    let rows: Vec<Vec<String>> = (0..crank.throws()).map(row).collect();
    let mut text = format!("{}  torsional stiffness of a throw by the formulas, N m/rad; {chosen}\n", table(&header, &rows));
    if let (Some(masses), Source::Cylinder { geometry, .. }) = (&crank.masses, &study.engine.source) {
        let rods = crank.rods as f64 * geometry.rod_rotating_fraction() * geometry.rod_mass;
        let own = throw_inertia(&crank.throw(0), masses, rods);
        let _ = writeln!(text, "  inertia of the first throw from its dimensions, rods included: {} kg m²", significant(own, 4));
    }
    text
}

fn bearings(study: &Study) -> Option<String> {
    let speed = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let row = |b: &BearingLoad| {
        vec![
            b.number.to_string(),
            significant(b.largest / N_PER_KN, 4),
            format!("{:.0}", b.theta * DEG_PER_RAD),
            // no -0
            format!("{:.0}", (b.towards * DEG_PER_RAD).round() + 0.0),
            significant(b.turning / N_PER_KN, 3),
        ]
    };
    let rows: Vec<Vec<String>> = bearing_loads(study)?.iter().map(row).collect();
    let header = ["main bearing", "largest load/kN", "at crank/°", "towards/°", "turning with the crank/kN"];
    Some(format!(
        "{}  loads at {speed} rpm, the crank a continuous beam; towards: from the middle of the banks in the direction of rotation\n",
        table(&header, &rows)
    ))
}
