//! Absorbers whose rubber softens with its strain, in words.

use super::table::{between, significant, table};
use crate::analysis::{MOST_STRAIN, Results, StrainOfDesign};
use crate::units::DEG_PER_RAD;

/// The designs whose material follows its strain, a row each with both rules; empty where there is none.
#[doc(hidden)]
pub fn strain(results: &Results) -> String {
    let pairs: Vec<&[StrainOfDesign]> = results.strain.chunks(2).collect();
    let row = |pair: &&[StrainOfDesign]| {
        let reference = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).find(|d| d.name == pair[0].design);
        let given = reference.and_then(|d| d.twist).map_or("-".into(), |p| significant(p.value * DEG_PER_RAD, 4));
        let mut row = vec![pair[0].design.clone(), given];
        for d in *pair {
            row.push(significant(d.peak.twist * DEG_PER_RAD, 4));
            row.push(format!("{:.0}", d.peak.speed_rpm));
            row.push(d.peak.strains.first().map_or("-".into(), |s| format!("{:.1}", 100.0 * s)));
        }
        let values: Vec<f64> = pair.iter().map(|d| d.peak.twist).collect();
        row.push(format!("{:.2}", 100.0 * (values[0] / values[values.len() - 1] - 1.0).abs()));
        row
    };
    if pairs.is_empty() {
        return String::new();
    }
    let header = ["design", "reference/°", "peak/°", "at/rpm", "strain/%", "rms rule/°", "at/rpm", "strain/%", "spread/%"];
    let rows: Vec<Vec<String>> = pairs.iter().map(row).collect();
    let mut text = format!(
        "At the strain of their rubber, one for all orders of a speed: half peak-to-peak of the twist, and the sine of its mean square beside it; the lowest where several agree with\nthemselves. Searches, and conditions but `in operation`, are of the reference strain; limits are judged at both\n{}",
        table(&header, &rows)
    );
    for d in &results.strain {
        let rule = d.rule.name().replace('_', " ");
        let speeds_where = |wanted: &dyn Fn(usize) -> bool| -> Vec<f64> {
            d.points.iter().filter(|p| wanted(p.strains.len())).map(|p| p.speed_rpm).collect()
        };
        let several = speeds_where(&|count| count > 1);
        if !several.is_empty() {
            text.push_str(&format!("  {}, {rule}: several strains agree with themselves at {}.\n", d.design, between(&several)));
        }
        let none = speeds_where(&|count| count == 0);
        if !none.is_empty() {
            let most = significant(MOST_STRAIN, 2);
            text.push_str(&format!(
                "  {}, {rule}: NO STRAIN up to {most} agrees with itself at {}; it is shown at that.\n",
                d.design,
                between(&none)
            ));
        }
    }
    text
}
