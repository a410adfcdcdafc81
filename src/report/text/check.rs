//! What `hartog check` prints: the model that a study describes.

use super::crank;
use super::plausibility::{implausible, placeholders};
use super::table::{significant, table};
use super::to_be_computed::work;
use crate::analysis::{model_check, plausibility, reciprocating};
use crate::drivetrain::System;
use crate::engine::forces::{inertia_for_growth, inertia_force_across};
use crate::engine::{Excitation, Geometry, Pressure, RodModel, Source};
use crate::input::Study;
use crate::units::{DEG_PER_RAD, M_PER_MM, PA_PER_BAR, W_PER_KW};
use std::fmt::Write;

/// What \[Villalva 2014\] p. 60 ff. finds when the rod's inertia, which it does not print, is doubled: "about 35 %".
const GROWTH: f64 = 0.35;

/// A secondary resonance above this share of the largest one matters.
const SECONDARY: f64 = 0.1;

/// A friction below this share of the torque is rounding.
const NEGLIGIBLE: f64 = 1e-6;
/// Below this share nothing but rounding is left.
const CANCELS: f64 = 1e-9;

/// Placeholders, notes and warnings.
pub(super) fn unlikely(study: &Study, excitation: &Excitation, in_full: bool) -> String {
    let remarks: String = study.remarks.iter().map(|s| format!("note: {s}\n")).collect();
    let unlikely: String =
        implausible(&plausibility::implausible(study, &excitation.audit)).iter().map(|s| format!("warning: {s}\n")).collect();
    placeholders(study, in_full) + &remarks + &unlikely
}

/// Engine, chain, modes, pressure, crank, a flexible crank where `with_flexible`, and what is to be computed.
pub fn model(study: &Study, with_flexible: bool) -> String {
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let unlikely = unlikely(study, &excitation, true);
    format!(
        "{}\n{}{}\n{}\n{}\n{}{}",
        engine(study, true),
        chain(study),
        moving_masses(study, &excitation),
        modes(study, &excitation),
        pressure(study, &excitation)
            + &crank::crank(study).map_or_else(String::new, |c| format!("\n{c}"))
            + &if with_flexible { super::flexible::in_full(study) } else { String::new() },
        work(study, &excitation, usize::MAX),
        if unlikely.is_empty() { unlikely } else { format!("\n{unlikely}") }
    )
}

pub(super) fn engine(study: &Study, in_full: bool) -> String {
    let e = &study.engine;
    let layout = match e.layout.bank_angle_deg {
        None => "in line".to_owned(),
        Some(_) if e.layout.rods_per_throw == 1 => "opposed".to_owned(),
        Some(bank) if e.layout.split_pin_deg != 0.0 => format!("V {bank}°, pins split by {}°", e.layout.split_pin_deg),
        Some(bank) => format!("V {bank}°"),
    };
    let mut text = format!("{}: {} cylinders, {layout}, {} strokes\n", e.name, e.layout.firing_deg.len(), e.strokes);
    let mut firing: Vec<(usize, f64)> = e.layout.firing_deg.iter().copied().enumerate().collect();
    firing.sort_by(|a, b| a.1.total_cmp(&b.1));
    let firing: Vec<String> = firing.iter().map(|(c, deg)| format!("{} at {deg}°", c + 1)).collect();
    let _ = writeln!(text, "  firing: {}", firing.join(", "));
    match &e.source {
        Source::Harmonics(table) => {
            let _ = writeln!(text, "  torque: table of {} harmonics of a throw", table.harmonics.len());
        }
        Source::Cylinder { geometry: g, pressure } => {
            let _ = writeln!(
                text,
                "  bore {} mm, stroke {} mm, rod ratio {:.4}, displaced {:.4} dm³ a cylinder, oscillating mass {:.4} kg",
                significant(g.bore / M_PER_MM, 5),
                significant(2.0 * g.slider_crank.crank_radius / M_PER_MM, 5),
                g.slider_crank.crank_radius / g.slider_crank.rod_length,
                1e3 * g.displacement(),
                g.oscillating_mass()
            );
            if in_full {
                let _ = writeln!(text, "  {}", rod(g));
            }
            let model = match pressure {
                Pressure::Otto(o) => {
                    format!(
                        "air-standard Otto cycle, compression {}, pressure scale {}{}",
                        o.compression_ratio,
                        o.pressure_scale,
                        if o.scale_over_speed.iter().all(|x| *x == 1.0) { "" } else { " times that of each speed" }
                    )
                }
                Pressure::Wiebe(w) => format!(
                    "Wiebe heat release, compression {}, boost {} bar, burn {}° to {}°, exponent {}, heat capacities {}",
                    w.compression_ratio,
                    significant(w.boost_pressure / PA_PER_BAR, 4),
                    w.burn_start_deg,
                    w.burn_start_deg + w.burn_duration_deg,
                    w.shape,
                    w.heat_capacity_ratio
                ),
                Pressure::Measured(m) => match m.speeds_rpm.as_slice() {
                    [only] => format!("measured at {only} rpm"),
                    speeds => format!("measured, {} speeds", speeds.len()),
                },
            };
            let _ = writeln!(text, "  pressure: {model}");
        }
    }
    text
}

fn chain(study: &Study) -> String {
    let is_row = study.chain.is_row();
    let zero = |x: f64| if x == 0.0 { "-".to_owned() } else { significant(x, 5) };
    let rows: Vec<Vec<String>> = study
        .chain
        .stations
        .iter()
        .map(|s| {
            let throws: Vec<String> = s.throws.iter().map(|t| (t + 1).to_string()).collect();
            let mut row = vec![
                s.name.clone(),
                if throws.is_empty() { "-".into() } else { throws.join(" ") },
                significant(s.inertia, 5),
                zero(s.stiffness_to_next),
                zero(s.damping_to_next),
                zero(s.loss_factor_to_next),
                zero(s.stiffness_to_ground),
                zero(s.damping_to_ground),
            ];
            // where a tree or a gear makes "next" another than the following one
            if let (Some(joint), false) = (&s.joint, is_row) {
                row.extend([study.chain.stations[joint.leads_to].name.clone(), significant(joint.gear, 4)]);
            } else if !is_row {
                row.extend(["following".to_owned(), "1".to_owned()]);
            }
            row
        })
        .collect();
    let mut header =
        vec!["station", "throws", "J/kg m²", "k next/N m/rad", "c next/N m s/rad", "loss next", "k ground/N m/rad", "c ground/N m s/rad"];
    if !is_row {
        header.extend(["next", "gear"]);
    }
    // what no station has takes no column
    let used: Vec<usize> = (0..header.len()).filter(|c| *c < 4 || rows.iter().any(|r| r[*c] != "-")).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(|r| used.iter().map(|c| r[*c].clone()).collect()).collect();
    table(&used.iter().map(|c| header[*c]).collect::<Vec<_>>(), &rows)
}

/// Whether the chain holds the reciprocating masses, what that does, and what a linear chain leaves out.
fn moving_masses(study: &Study, excitation: &Excitation) -> String {
    let mut text = super::reciprocating(study).map_or_else(String::new, |line| format!("  {line}\n"));
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation.clone());
    let Some(s) = reciprocating::secondary(study, &system) else { return text };
    let share = s.twist / s.primary;
    if share < CANCELS {
        text.push_str(
            "  the part that varies with twice the crank angle cancels between the cylinders of a throw, or drives no resonance\n",
        );
        return text;
    }
    let _ = writeln!(
        text,
        "  the part that varies with twice the crank angle is left out: its largest effect would be order {} at {:.0} rpm, driven by order {}, {}° of \
         twist, {} of the largest resonance of one order, {}° (each estimated as one mode){}",
        s.order,
        s.speed_rpm,
        s.driven_by,
        significant(s.twist * DEG_PER_RAD, 2),
        if share < 0.01 { "below 1 %".to_owned() } else { format!("{:.0} %", 100.0 * share) },
        significant(s.primary * DEG_PER_RAD, 2),
        if share > SECONDARY { ": here a linear chain is not enough" } else { "" }
    );
    text
}

fn modes(study: &Study, excitation: &Excitation) -> String {
    let critical = model_check::critical_speeds(study, &excitation.orders);
    let rows: Vec<Vec<String>> = study
        .modes
        .elastic()
        .enumerate()
        .take(12)
        .map(|(i, mode)| {
            let met: Vec<String> =
                critical.iter().filter(|c| c.mode == i + 1).map(|c| format!("{} @ {:.0}", c.order, c.speed_rpm)).collect();
            let shown = if met.len() > 6 {
                format!("{} … {} ({} in all)", met[..3].join(", "), met[met.len() - 1], met.len())
            } else {
                met.join(", ")
            };
            vec![
                format!("{}", i + 1),
                format!("{:.2}", study.modes.frequencies_hz()[i]),
                format!("{:.4}", study.modes.damping_ratio(mode)),
                // rounding leaves a trace of motion where there is none
                Some(study.modes.equivalent_inertia(mode, study.hub))
                    .filter(|j| *j < 1e6 * study.chain.total_inertia())
                    .map_or("does not move".into(), |j| significant(j, 5)),
                if shown.is_empty() { "none in range".into() } else { shown },
            ]
        })
        .collect();
    let hub = format!("J at {}/kg m²", study.chain.stations[study.hub].name);
    format!(
        "{}{} rigid mode{}; elastic modes:\n{}",
        if study.on_flexible().is_some() { "Torsional chain: " } else { "" },
        study.modes.rigid,
        if study.modes.rigid == 1 { "" } else { "s" },
        table(&["mode", "f/Hz", "damping ratio", &hub, "critical speeds (order @ rpm)"], &rows)
    )
}

fn pressure(study: &Study, excitation: &Excitation) -> String {
    if excitation.audit.is_empty() {
        return "The torque comes from a table: there is no pressure to check.\n".into();
    }
    let rows: Vec<Vec<String>> = excitation
        .audit
        .iter()
        .map(|a| {
            let friction = model_check::implied_friction(study, a);
            let dash = |x: Option<String>| x.unwrap_or_else(|| "-".into());
            vec![
                format!("{}", a.speed_rpm),
                format!("{:.2}", a.indicated_mean_pressure / PA_PER_BAR),
                format!("{:.1}", a.peak_pressure / PA_PER_BAR),
                format!("{:.1}", a.mean_torque),
                format!("{:.1}", model_check::power(a.mean_torque, a.speed_rpm) / W_PER_KW),
                dash(a.brake_torque.map(|t| format!("{t:.1}"))),
                dash(friction.map(|f| format!("{:.1}", f.0))),
                dash(friction.map(|f| format!("{:.2}", f.1 / PA_PER_BAR))),
            ]
        })
        .collect();
    let header = ["rpm", "indicated/bar", "peak/bar", "order 0/N m", "power/kW", "brake/N m", "friction/N m", "friction/bar"];
    let mut text = format!("Excitation, per speed of the pressure table:\n{}", table(&header, &rows));
    if excitation.audit.iter().any(|a| model_check::implied_friction(study, a).is_some_and(|f| f.0 < -NEGLIGIBLE * a.mean_torque.abs())) {
        text.push_str(
            "  The friction is negative: the pressure delivers less than the brake torque. With `pressure_scale` below one the cycle is a\n  \
             reconstruction of the torque orders, not of the work.\n",
        );
    }
    text
}

/// Where the rod's mass is, and what its inertia does.
fn rod(g: &Geometry) -> String {
    let unit = g.two_mass_inertia();
    let about = |inertia: f64| significant(inertia, 4);
    let own = match g.rod {
        RodModel::TwoMasses { .. } => format!("rod as two masses: its inertia is m a b = {} kg m²", about(unit)),
        RodModel::Body { inertia, .. } => format!("rod as a rigid body of {} kg m² (m a b is {})", about(inertia), about(unit)),
    };
    let doubled =
        100.0 * (inertia_force_across(g, 2.0 * (unit + g.excess_inertia())) / inertia_force_across(g, unit + g.excess_inertia()) - 1.0);
    let thesis = inertia_for_growth(g, GROWTH);
    let thesis = thesis.map_or_else(String::new, |m| format!("; by {:.0} % if it were {m:.2} m a b", 100.0 * GROWTH));
    if doubled.is_finite() {
        format!("{own}; twice the inertia would raise the largest inertia force across the cylinder by {doubled:.0} %{thesis}")
    } else {
        own
    }
}
