//! What `hartog check` prints on one screen.

use super::check::{engine, unlikely};
use super::table::significant;
use super::to_be_computed::work;
use crate::analysis::model_check::{self, Critical};
use crate::engine::Excitation;
use crate::engine::excitation::Audit;
use crate::input::Study;
use crate::units::{PA_PER_BAR, W_PER_KW};
use std::fmt::Write;

/// Modes, critical speeds and designs that are told of.
const MODES: usize = 3;
const CRITICALS: usize = 6;
const DESIGNS: usize = 4;

/// The engine, the chain as a whole, its lowest modes, what the pressure delivers, and what is to be computed.
#[doc(hidden)]
pub fn check_in_brief(study: &Study) -> String {
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let mut text = engine(study, false);
    let (chain, modes) = (&study.chain, &study.modes);
    let name = |i: usize| chain.stations[i].name.as_str();
    let referred = if chain.speed_ratios().is_some() { ", referred to the crankshaft" } else { "" };
    _ = writeln!(
        text,
        "  chain: {} stations from {} to {}, {} kg m² together{referred}",
        chain.len(),
        name(0),
        name(chain.len() - 1),
        significant(chain.total_inertia(), 4)
    );
    if let Some(line) = super::reciprocating(study) {
        _ = writeln!(text, "  {line}");
    }
    let of_chain = if study.on_flexible().is_some() { " of the torsional chain" } else { "" };
    let lowest: Vec<String> = modes
        .elastic()
        .zip(modes.frequencies_hz())
        .take(MODES)
        .map(|(mode, hz)| format!("{hz:.2} Hz ({})", significant(modes.damping_ratio(mode), 3)))
        .collect();
    if !lowest.is_empty() {
        _ = writeln!(text, "  natural frequencies{of_chain} (damping ratio): {}", lowest.join(", "));
    }
    text += &super::flexible::in_brief(study);
    let critical = model_check::critical_speeds(study, &excitation.orders);
    let above = model_check::critical_speeds_above(study, &excitation.orders);
    let told = |c: &&Critical| format!("{} @ {:.0}", c.order, c.speed_rpm);
    let of_mode = |mode: usize| {
        let met: Vec<&Critical> = critical.iter().filter(|c| c.mode == mode).collect();
        let shown: Vec<String> = met.iter().take(CRITICALS).map(told).collect();
        let more = met.len() - shown.len();
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        let above: Vec<String> = above.iter().filter(|c| c.mode == mode).map(|c| told(&c)).collect();
        let above = if above.is_empty() { String::new() } else { format!(", just above the range {}", above.join(", ")) };
        (!met.is_empty()).then(|| format!("mode {mode}: {}{more}{above}", shown.join(", ")))
    };
    let met: Vec<String> = (1..=MODES).filter_map(of_mode).take(2).collect();
    if !met.is_empty() {
        _ = writeln!(text, "  critical speeds{of_chain} (order @ rpm): {}", met.join("; "));
    }
    let range = |of: &dyn Fn(&Audit) -> f64| {
        let all = excitation.audit.iter().map(of);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |m, x| (m.0.min(x), m.1.max(x)));
        format!("{} to {}", significant(low, 4), significant(high, 4))
    };
    if !excitation.audit.is_empty() {
        _ = writeln!(
            text,
            "  over the speeds of the pressure table: mean torque {} N m, {} kW, highest pressure {} bar",
            range(&|a| a.mean_torque),
            range(&|a| model_check::power(a.mean_torque, a.speed_rpm) / W_PER_KW),
            range(&|a| a.peak_pressure / PA_PER_BAR)
        );
    }
    let unlikely = unlikely(study, &excitation, false);
    let unlikely = if unlikely.is_empty() { unlikely } else { format!("\n{unlikely}") };
    format!(
        "{text}\n{}{unlikely}\n--verbose prints the chain station by station, every mode, the excitation and what the crank bears\n",
        work(study, &excitation, DESIGNS)
    )
}
