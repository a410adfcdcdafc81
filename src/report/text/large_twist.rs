//! Designs with an absorber whose twist is not small, in words.

use super::table::{between, significant, table};
use crate::analysis::{LargePoint, LargeTwistOfDesign, Results};
use crate::input::Study;
use crate::units::DEG_PER_RAD;

/// The designs whose law is one of large twist; empty where there is none.
#[doc(hidden)]
pub fn large_twist(study: &Study, results: &Results) -> String {
    if results.large_twist.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = results.large_twist.iter().map(|d| row(results, d)).collect();
    let header = ["design", "small/°", "peak/°", "at/rpm", "ring/°", "heat/W", "harmonics"];
    let mut text = format!(
        "At their own amplitude, by harmonic balance (objective and limits of a design are the worse of this and of small twist, other tables are of small twist; the peak is the largest found that may last):\n{}",
        table(&header, &rows)
    );
    for d in &results.large_twist {
        remarks(&mut text, d, study);
    }
    text
}

fn row(results: &Results, d: &LargeTwistOfDesign) -> Vec<String> {
    let degrees = |x: f64| significant(x * DEG_PER_RAD, 4);
    let shown = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let small = shown.filter(|own| own.name == d.design).find_map(|own| own.twist);
    let dash = |x: Option<String>| x.unwrap_or_else(|| "-".into());
    let cell = |f: &dyn Fn(&LargePoint) -> f64| dash(d.peak.as_ref().map(|p| degrees(f(p))));
    let largest = d.curves.iter().flatten().filter(|p| p.stable != Some(false)).map(|p| p.ring_twist).fold(0.0, f64::max);
    let most = d.curves.iter().flatten().filter(|p| p.stable != Some(false)).map(|p| p.power).fold(0.0, f64::max);
    vec![
        d.design.clone(),
        dash(small.map(|p| degrees(p.value))),
        cell(&|p| p.twist),
        dash(d.peak.as_ref().map(|p| format!("{:.1}", p.speed_rpm))),
        degrees(largest),
        format!("{most:.0}"),
        d.harmonics.to_string(),
    ]
}

/// Speeds of the study at which so many motions are known, those that may last counted alone.
fn speeds(d: &LargeTwistOfDesign, asked: impl Fn(usize, usize) -> bool) -> Vec<f64> {
    let mut all: Vec<f64> = d.curves.iter().flatten().filter(|p| p.asked).map(|p| p.speed_rpm).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let points_at = |speed: f64| d.curves.iter().flatten().filter(move |p| p.asked && p.speed_rpm == speed);
    all.retain(|s| asked(points_at(*s).count(), points_at(*s).filter(|p| p.stable != Some(false)).count()));
    all
}

fn remarks(text: &mut String, d: &LargeTwistOfDesign, study: &Study) {
    let unknown = d.curves.iter().flatten().any(|p| p.stable.is_none());
    if d.at_large_twist.alone && d.peak.is_some() {
        text.push_str(&format!("  {}: dry friction holds it at small twist, so that it is judged by its own amplitude alone.\n", d.design));
    }
    let several = speeds(d, |all, lasting| if unknown { all > 1 } else { lasting > 1 });
    if !several.is_empty() {
        let (at, verb) = (between(&several), if unknown { "are possible" } else { "last" });
        text.push_str(&format!("  {}: several motions {verb} at {at}; which one is met depends on what went before.\n", d.design));
    }
    let none = speeds(d, |_, lasting| lasting == 0);
    if !none.is_empty() {
        let at = between(&none);
        text.push_str(&format!("  {}: no steady motion that is known lasts at {at}; the amplitude wanders there.\n", d.design));
    }
    if unknown {
        text.push_str(&format!("  {}: stability cannot be told beside laws that are known by frequency only.\n", d.design));
    }
    let travel = d.travel.map_or_else(String::new, |t| format!("; its path ends at {}° of ring twist", significant(t * DEG_PER_RAD, 4)));
    if !d.without_motion.is_empty() {
        let at = between(&d.without_motion);
        text.push_str(&format!("  {} FAILS: NO STEADY MOTION of it is known at {at}{travel}. Small twist tells nothing of it there, so that it has no objective and holds no limit.\n", d.design));
    } else if !d.whole {
        text.push_str(&format!(
            "  {}: NOT FOLLOWED to the end of every curve: no motion was found further on, or too many steps were needed{travel}.\n",
            d.design
        ));
    }
    let limits = study.limits.iter().zip(&d.at_large_twist.limits).filter(|(_, own)| own.is_none()).map(|(l, _)| l.words.as_str());
    let objective = d.at_large_twist.objective.is_none().then_some(study.objective.label.as_str());
    let untold: Vec<&str> = objective.into_iter().chain(limits).collect();
    if !untold.is_empty() && d.without_motion.is_empty() {
        text.push_str(&format!("  {}: judged at small twist alone: {}.\n", d.design, untold.join("; ")));
    }
    if d.change > study.tolerance {
        let change = significant(100.0 * d.change, 2);
        let what = if d.change.is_finite() { format!("still change the peak by {change} %") } else { "find no motion there".into() };
        text.push_str(&format!("  {}: twice the harmonics {what}.\n", d.design));
    }
}
