//! The flexible crank: its modes and stiffness, and designs by other models of the crank.

use super::table::{significant, table};
use crate::analysis::{ByModel, DesignResult, Modelled, Results, crank_at_speed};
use crate::crankshaft::flexible::{Assembled, Bearing, CrankBody, FlexibleSpec, LinearBearings};
use crate::input::{FlexibleModel, Study};
use crate::rotor::free_modes::FreeMode;
use crate::units::{DEG_PER_RAD, HZ_PER_RAD_PER_S, PA_PER_MPA, RAD_PER_S_PER_RPM};
use std::fmt::Write;

/// Modes that are told of.
const MODES: usize = 16;
const MODES_IN_BRIEF: usize = 5;
/// What its stations do by themselves, as the first line of a run tells it.
pub(crate) fn frequencies(study: &Study, results: &Results) -> String {
    let list = |all: Vec<f64>| all.iter().take(4).map(|f| format!("{f:.2}")).collect::<Vec<_>>().join(", ");
    if results.system.flexible.is_none() {
        return format!("natural frequencies {} Hz", list(study.modes.frequencies_hz()));
    }
    let on_bearings: Vec<String> = study.flexible.iter().flat_map(|f| elastic(f).take(MODES_IN_BRIEF)).map(|m| kind(m, 1)).collect();
    format!("flexible crank on its bearings, at rest {}", on_bearings.join(", "))
}

fn elastic(flexible: &FlexibleModel) -> impl Iterator<Item = &FreeMode> {
    flexible.modes().unwrap_or_default().iter().filter(|m| m.omega > 0.0)
}

fn kind(m: &FreeMode, digits: usize) -> String {
    format!("{:.digits$} Hz ({})", m.omega * HZ_PER_RAD_PER_S, m.kind())
}

/// The twist of designs by each model of the crank; empty where the response is that of the chain.
#[doc(hidden)]
pub fn crank_models(results: &Results) -> String {
    let mut text = choice(results);
    if results.crank_models.is_empty() {
        return text;
    }
    let row = |d: &ByModel| -> Vec<String> {
        let twist = |model: &Modelled| d.of(*model).map_or_else(|| "-".into(), |t| significant(t * DEG_PER_RAD, 4));
        std::iter::once(d.design.clone()).chain(Modelled::ALL.iter().map(twist)).collect()
    };
    let header = ["design", "on the chain", "flexible", "bearings halved", "bearings doubled"];
    let rows: Vec<Vec<String>> = results.crank_models.iter().map(row).collect();
    _ = write!(
        text,
        "Peak twist/° by model of the crank; main bearings are half and twice as stiff in the last two:\n{}",
        table(&header, &rows)
    );
    text
}

/// Which model a study took that leaves it open.
fn choice(results: &Results) -> String {
    let Some(difference) = results.crank_difference else { return String::new() };
    let (tolerance, taken) = (results.study.tolerance, if results.system.flexible.is_some() { "flexible crank" } else { "chain" });
    format!(
        "Crank: {taken}; in the twist of the given designs and without absorber the two differ by up to {} % of the larger, and the tolerance is {} %.\n",
        significant(100.0 * difference, 3),
        significant(100.0 * tolerance, 3)
    )
}

/// A line on a design of a study on its flexible crank.
pub(crate) fn by_models(results: &Results, d: &DesignResult) -> Vec<String> {
    let mut lines: Vec<String> = choice(results).lines().map(|l| format!("  {l}")).collect();
    let known = results.crank_models.iter().find(|m| m.design == d.name);
    let twist = |model| known.and_then(|m| m.of(model)).map(|t| format!("{}°", significant(t * DEG_PER_RAD, 4)));
    if let (Some(halved), Some(doubled), Some(chain)) =
        (twist(Modelled::BearingsHalved), twist(Modelled::BearingsDoubled), twist(Modelled::Chain))
    {
        lines.push(format!("  its twist with bearings half as stiff {halved}, twice as stiff {doubled}; on the torsional chain {chain}"));
    }
    if let Some(joints) = results.joints.iter().find(|j| j.design == d.name) {
        lines.push(match joints.largest() {
            Some((linear, own)) => format!(
                "  on its bearings, which are not linear, {}°, on the linear ones near to them {}° ({:+.1} %), at the speed of its largest twist and 3 % beside it",
                significant(own * DEG_PER_RAD, 4),
                significant(linear * DEG_PER_RAD, 4),
                100.0 * (own / linear - 1.0)
            ),
            None => "  on its bearings, which are not linear, no periodic motion was found at some speed (`joints.csv`)".into(),
        });
    }
    if let Some(ratio) = known.and_then(ByModel::far_apart) {
        lines.push(format!(
            "  chain and flexible crank differ by a factor of {} in this: do the stiffnesses of the one fit the dimensions of the other (`hartog check --verbose`)?",
            significant(ratio, 3)
        ));
    }
    lines.extend(by_webs(results, d));
    let own = known.map(|m| Modelled::ALL.map(|model| m.of(model).unwrap_or_default()));
    if own.is_some_and(|[_, own, halved, doubled]| own < halved.min(doubled)) {
        lines.push(
            "  softer and stiffer bearings are both worse: a least twist lies between half and twice the stiffness given, count on the larger".into(),
        );
    }
    if results.system.flexible.is_some() {
        lines.extend(growing(&results.study).lines().map(|l| format!("  {l}")));
    }
    lines
}

/// A line on margins by the webs of the flexible crank, by the study's first criterion that they have.
fn by_webs(results: &Results, d: &DesignResult) -> Option<String> {
    let webs = results.webs.iter().find(|w| w.design == d.name)?;
    let margin = webs.margins.first()?;
    let criterion = results.study.fatigue.as_ref()?.criteria.get(margin.criterion)?;
    Some(format!(
        "  its margin by {} is {} with the webs bent as the flexible crank bends them, {} by the beam on rigid bearings; their vibration adds up to {} MPa to the nominal stress (`web_loads.csv`)",
        criterion.name(),
        significant(margin.margin, 4),
        significant(margin.beam, 4),
        significant(webs.added() / PA_PER_MPA, 3),
    ))
}

/// What it is made of, in words.
fn body(spec: &FlexibleSpec, assembled: &Assembled) -> String {
    match &spec.body {
        CrankBody::Beams(beams) => {
            let (f, estimated) = (beams.web_factors, if beams.estimated { " (estimate: 10 %, at most 31 %)" } else { "" });
            let [bending, twist, edge] = [f.bending, f.twist, f.edge].map(|x| significant(x, 4));
            format!("factors on the webs: bending {bending}, twist {twist}, edge {edge}{estimated}; {} nodes", assembled.shaft.len())
        }
        CrankBody::Matrices(own) => {
            let (all, modes) = (own.structure.unknowns.len(), own.structure.unknowns.iter().filter(|u| u.component == 0).count());
            format!("matrices of {all} unknowns, {modes} of them of modes, {} nodes", own.structure.nodes())
        }
    }
}

/// Stiffness of a throw by what its bearings hold, or of the whole crank by matrices; nothing without a flexible crank.
fn stiffness(study: &Study) -> Option<String> {
    let in_mega = |x: f64| significant(x / 1e6, 4);
    if let CrankBody::Matrices(own) = &study.flexible.as_ref()?.spec.body {
        let k = own.structure.checks().torsional_stiffness?;
        return Some(format!("by matrices; {} MN m/rad from hub to flywheel with free ends", in_mega(k)));
    }
    let k = crank_at_speed::stiffness(study)?;
    Some(format!(
        "k_held/k_free {}: a throw has {} MN m/rad with free ends, {} guided, {} held in its bearings",
        significant(k.held / k.free, 3),
        in_mega(k.free),
        in_mega(k.guided),
        in_mega(k.held)
    ))
}

/// One or two lines of `hartog check`.
pub(crate) fn in_brief(study: &Study) -> String {
    let (Some(flexible), Some(stiffness)) = (&study.flexible, stiffness(study)) else { return String::new() };
    let lowest: Vec<String> = elastic(flexible).take(MODES_IN_BRIEF).map(|m| kind(m, 1)).collect();
    let growing = study.on_flexible().map_or_else(String::new, |_| growing(study));
    format!("  flexible crank: {stiffness}\n    at rest {}\n{growing}", lowest.join(", "))
}

/// Webs, masses, modes at rest and at the highest speed; empty without a flexible crank.
pub(crate) fn in_full(study: &Study) -> String {
    let (Some(flexible), Some(stiffness)) = (&study.flexible, stiffness(study)) else { return String::new() };
    let (spec, assembled) = (&flexible.spec, &flexible.assembled);
    let mut text =
        format!("Flexible crank: {stiffness}\n  {}; {} kg with all that is on it\n", body(spec, assembled), significant(assembled.mass, 4));
    let throws: Vec<Vec<String>> = assembled
        .balance
        .iter()
        .enumerate()
        .map(|(t, b)| {
            let rounded = |x: f64| significant(x, 4);
            let webs = if b.counterweight > 0.0 { format!("{} kg", rounded(b.counterweight)) } else { "none".into() };
            vec![format!("{}", t + 1), rounded(b.steel), rounded(b.on_pin), rounded(b.station), webs, rounded(b.density)]
        })
        .collect();
    let header = ["throw", "steel as drawn/kg m²", "on the pin/kg m²", "station/kg m²", "counterweights", "density factor"];
    if !throws.is_empty() {
        text += &format!("  inertia about the axis is that of the stations:\n{}", table(&header, &throws));
    }
    if let LinearBearings::Each(all) = &spec.bearing {
        let list =
            |of: &dyn Fn(&Bearing) -> f64, points: &[Bearing]| points.iter().map(|b| significant(of(b), 3)).collect::<Vec<_>>().join(", ");
        let row = |(i, points): (usize, &Vec<Bearing>)| {
            vec![format!("{}", i + 1), list(&|b| b.stiffness / 1e6, points), list(&|b| b.damping / 1e3, points)]
        };
        let rows: Vec<Vec<String>> = all.iter().enumerate().map(row).collect();
        let header = ["bearing", "k of its points/MN/m", "c/kN s/m"];
        text += &format!(
            "  linear bearings nearest to the law over cycles without absorber, means of the lowest, a middle and the highest speed:\n{}",
            table(&header, &rows)
        );
    }
    text + &modes(study, flexible)
}

fn modes(study: &Study, flexible: &FlexibleModel) -> String {
    if flexible.modes().is_none() {
        return "  its mass matrix is not positive definite\n".into();
    }
    let highest = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let speed = highest * RAD_PER_S_PER_RPM;
    let share = |x: f64| format!("{:.0} %", 100.0 * x);
    let row = |m: &FreeMode| {
        vec![format!("{:.2}", m.omega * HZ_PER_RAD_PER_S), m.kind().into(), share(m.torsion), share(m.bending()), share(m.axial)]
    };
    let rows: Vec<Vec<String>> = elastic(flexible).take(MODES).map(row).collect();
    let mut text =
        format!("  modes at rest, by share of the kinetic energy:\n{}", table(&["f/Hz", "kind", "torsion", "bending", "axial"], &rows));
    let found = crank_at_speed::eigenvalues(study);
    let turning: Vec<Vec<String>> = found
        .iter()
        .take(MODES)
        .map(|s| {
            let hz = |w: f64| format!("{:.2}", w * HZ_PER_RAD_PER_S);
            vec![hz(s.im), format!("{:.4}", -s.re / s.norm()), hz((s.im - speed).abs()), hz(s.im + speed)]
        })
        .collect();
    let header = ["f/Hz", "damping ratio", "backward/Hz", "forward/Hz"];
    _ = write!(
        text,
        "  at {highest} rpm in axes that turn with the crank; its motion across the axis is seen standing still at the frequencies on the right:\n{}",
        table(&header, &turning)
    );
    text += &growing(study);
    text
}

/// A line on each motion that grows by itself at the highest speed.
pub(crate) fn growing(study: &Study) -> String {
    let rpm = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let line = |s: &crate::numerics::C64| {
        format!(
            "warning: the motion of the flexible crank at {:.2} Hz grows by itself at {rpm} rpm: no steady response is ever reached\n",
            s.im * HZ_PER_RAD_PER_S
        )
    };
    crank_at_speed::growing(study).iter().map(line).collect()
}
