//! The crank of a study: factors of stress concentration, loads of its main bearings.

use super::table::{significant, table};
use crate::crankshaft::loads::CrankModel;
use crate::crankshaft::stress_concentration::Formulas;
use crate::crankshaft::{Concentration, Crank};
use crate::engine::cycle::crank_fixed;
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
    if let Some(loads) = bearings(study, crank) {
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

fn bearings(study: &Study, crank: &Crank) -> Option<String> {
    let model = CrankModel::new(&study.engine, crank)?;
    let speed = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let loads = model.at(speed);
    let numbers: Vec<usize> = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b)).collect();
    let n = loads.theta.len();
    let forces: Vec<Vec<[f64; 2]>> = (0..n).map(|j| loads.bearing_forces(j)).collect();
    let rows: Vec<Vec<String>> = numbers
        .iter()
        .enumerate()
        .map(|(i, number)| {
            let size = |j: usize| forces[j][i][0].hypot(forces[j][i][1]);
            let worst = (0..n).fold(0, |m, j| if size(j) > size(m) { j } else { m });
            let [x, y] = forces[worst][i];
            // what turns with the crank stays in the mean of crank-fixed axes
            let turning = (0..n).map(|j| crank_fixed(forces[j][i], loads.theta[j])).fold([0.0; 2], |s, f| [s[0] + f[0], s[1] + f[1]]);
            vec![
                (number + 1).to_string(),
                significant(size(worst) / N_PER_KN, 4),
                format!("{:.0}", loads.theta[worst] * DEG_PER_RAD),
                format!("{:.0}", y.atan2(x) * DEG_PER_RAD),
                significant(turning[0].hypot(turning[1]) / n as f64 / N_PER_KN, 3),
            ]
        })
        .collect();
    let header = ["main bearing", "largest load/kN", "at crank/°", "towards/°", "turning with the crank/kN"];
    Some(format!(
        "{}  loads at {speed} rpm, the crank a continuous beam; towards: from the middle of the banks in the direction of rotation\n",
        table(&header, &rows)
    ))
}
