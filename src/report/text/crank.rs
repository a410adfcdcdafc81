//! The crank of a study: factors of stress concentration, loads of its main bearings.

use super::table::{significant, table};
use crate::analysis::bearings::{BearingLoad, bearing_loads};
use crate::crankshaft::stress_concentration::Formulas;
use crate::crankshaft::{Concentration, Crank};
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

fn bearings(study: &Study) -> Option<String> {
    let speed = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let row = |b: &BearingLoad| {
        vec![
            b.number.to_string(),
            significant(b.largest / N_PER_KN, 4),
            format!("{:.0}", b.theta * DEG_PER_RAD),
            format!("{:.0}", b.towards * DEG_PER_RAD),
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
