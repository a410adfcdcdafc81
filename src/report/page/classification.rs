//! `classification.html`: the calculation that a classification society asks for, on A4 pages.

use super::parts::{conditions, limits, model, page, parameters, picture, provenance};
use super::question::{judged_cells, judged_heads};
use crate::analysis::classification::{ABOVE, Classification};
use crate::analysis::curves::HolzerRow;
use crate::analysis::{DesignResult, Results, StillBroken};
use crate::files::{Folder, WriteError};
use crate::input::{InputFile, Study};
use crate::names::CLASSIFICATION;
use crate::text::judged::is_apart;
use crate::text::{dash, short};
use crate::units::DEG_PER_RAD;
use maud::{Markup, html};

/// Writes the page; plots are taken from the folder.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
#[doc(hidden)]
pub fn write(study: &Study, inputs: &[InputFile], results: &Results, c: &Classification, folder: &Folder) -> Result<(), WriteError> {
    let body = html! {
        h1 { (study.engine.name) ": torsional vibration calculation" }
        p { "Speeds " (study.speeds_rpm[0]) " to " (study.speeds_rpm[study.speeds_rpm.len() - 1]) " rpm, orders up to " (study.order_limit) ". Criticals, sums of phase vectors and Holzer's tables are of the chain without absorber; responses are of each design of the study" @if !results.optima.is_empty() { " and of its optima" } "." }
        (model(study, study.on_flexible().is_some()))
        (holzer(c))
        (sums(c))
        (criticals(c))
        (designs(study, results))
        (shafts(c))
        (conditions(results))
        (limits(study, results))
        (barred(study, results))
        (plots(results, folder))
        (provenance(study, inputs, results))
    };
    folder.write(CLASSIFICATION, page(&format!("{}: torsional vibration calculation", study.engine.name), &body).as_bytes())
}

fn holzer(c: &Classification) -> Markup {
    let modes = c.holzer.iter().map(|r| r.mode).max().unwrap_or(0);
    html! {
        h2 { "Holzer's tables" }
        p class="soft" { "For an angle of one at the largest station; the last sum is what the eigensolver leaves." }
        @for mode in 1..=modes {
            @let rows = || c.holzer.iter().filter(|r| r.mode == mode);
            h3 { "Mode " (mode) ", " (rows().next().map_or_else(String::new, |r| short(r.frequency_hz))) " Hz, " (nodes(rows())) }
            div class="scroll" { table {
                thead { tr { th { "station" } th { "J, kg m²" } th { "Θ" } th { "J ω² Θ, N m" } th { "Σ, N m" } th { "k, N m/rad" } th { "Σ/k" } } }
                tbody { @for r in rows() { tr { td { (r.station) } td { (short(r.inertia)) } td { (format!("{:.5}", r.angle)) } td { (format!("{:.4e}", r.torque)) } td { (format!("{:.4e}", r.sum)) } td { (short(r.stiffness)) } td { (format!("{:.5}", r.twist)) } } } }
            } }
        }
    }
}

/// How many links have a place without motion, seen from the shaft of their station: through a gear that reverses neighbours turn in opposite directions without one.
fn nodes<'r>(rows: impl Iterator<Item = &'r HolzerRow>) -> String {
    match rows.filter(|r| r.angle * (r.angle - r.twist) < 0.0).count() {
        1 => "one node".into(),
        n => format!("{n} nodes"),
    }
}

fn sums(c: &Classification) -> Markup {
    let modes: Vec<usize> = (1..=c.holzer.iter().map(|r| r.mode).max().unwrap_or(0)).collect();
    let orders: Vec<_> = c.sums.iter().filter(|s| s.mode == 1).map(|s| s.order).collect();
    let sum = |mode, order| c.sums.iter().find(|s| s.mode == mode && s.order == order).map(|s| format!("{:.4}", s.sum));
    html! {
        h2 { "Sums of phase vectors" }
        p class="soft" { "|Σ Θ e" sup { "−i n φ" } "| over the throws, Θ one at the largest station." }
        div class="scroll" { table {
            thead { tr { th { "order" } @for m in &modes { th { "mode " (m) } } } }
            tbody { @for o in orders { tr { td { (o) } @for m in &modes { td { (dash(sum(*m, o))) } } } } }
        } }
    }
}

fn criticals(c: &Classification) -> Markup {
    let degrees = |x: Option<f64>| dash(x.map(|r| short(r * DEG_PER_RAD)));
    html! {
        h2 { "Critical speeds" }
        p class="soft" { "Up to " (format!("{:.0}", 100.0 * ABOVE)) " % of the highest speed of the study. Equilibrium amplitude T |Σ| / (ω² Σ J Θ²) of the largest station; in resonance it is divided by 2 ζ, each mode by itself, without absorber. Outside the speeds of the study the torque is not known." }
        div class="scroll" { table {
            thead { tr { th { "rpm" } th { "order" } th { "mode" } th { "|Σ|" } th { "T of a throw, N m" } th { "equilibrium, °" } th { "ζ" } th { "in resonance, °" } } }
            tbody { @for k in &c.criticals { @let own = k.in_range; tr {
                td { (format!("{:.0}", k.of.speed_rpm)) } td { (k.of.order) } td { (k.of.mode) } td { (format!("{:.4}", k.of.sum)) } td { (dash(own.map(|r| short(r.torque)))) }
                td { (degrees(own.map(|r| r.equilibrium))) } td { (dash(own.map(|r| short(r.damping_ratio)))) } td { (degrees(own.and_then(|r| r.resonance))) }
            } } }
        } }
    }
}

fn designs(study: &Study, results: &Results) -> Markup {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let columns = parameters(all());
    let apart = is_apart(study, results);
    html! {
        h2 { "Designs" }
        p class="soft" { "Twist and torque: half peak-to-peak of all orders together at the worst speed; heat: largest mean power of all absorbers." }
        div class="scroll" { table {
            thead { tr { th { "design" } @for p in &columns { th { (p.label.replacen('/', ", ", 1)) } } th { "twist, °" } th { "at rpm" } th { "largest torque, N m" } th { "heat, W" } th { "ring twist, °" } @if apart { (judged_heads(study)) } } }
            tbody { @for d in all() { tr {
                td { (d.name) }
                @for p in &columns { td { (d.absorbers.iter().map(|m| dash(m.absorber.value(p.key).map(short))).collect::<Vec<_>>().join(" | ")) } }
                td { (dash(d.twist.map(|p| short(p.value * DEG_PER_RAD)))) } td { (dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm)))) }
                td { (dash(d.torque.map(|p| short(p.value)))) } td { (dash(d.power.map(short))) } td { (dash(d.ring_twist.map(|t| short(t * DEG_PER_RAD)))) }
                @if apart { (judged_cells(study, results, d)) }
            } } }
        } }
    }
}

fn shafts(c: &Classification) -> Markup {
    html! {
        h2 { "Vibratory torque of the shafts" }
        p class="soft" { "Largest of the speeds of the study, all orders together; at the speeds of the grid (peaks between them are in the table of designs). Of misfires the largest of all cylinders." }
        div class="scroll" { table {
            thead { tr { th { "design" } th { "condition" } th class="words" { "shaft" } th { "torque, N m" } th { "at rpm" } } }
            tbody { @for s in &c.shafts { tr { td { (s.design) } td { (s.condition.name().replace('_', " ")) } td class="words" { (s.shaft) } td { (short(s.torque)) } td { (format!("{:.0}", s.speed_rpm)) } } } }
        } }
    }
}

/// Where a design breaks a limit outside barred ranges.
fn outside(study: &Study, d: &DesignResult, b: &StillBroken) -> String {
    format!("{}: {} at {:.0} rpm, {:.1} % of it", d.name, study.limits[b.limit].words, b.speed_rpm, 100.0 * b.ratio)
}

fn barred(study: &Study, results: &Results) -> Markup {
    let designs = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let all = || designs().flat_map(|d| d.barred.iter().map(move |b| (d, b)));
    html! { @if study.limits.iter().any(|l| l.rule.is_some()) {
        h2 { "Barred speed ranges" }
        @for l in study.limits.iter().filter(|l| l.rule.is_some() && !l.of.measure.within.ranges.is_empty()) {
            p { (l.words) ": judged at " (l.of.measure.within.ranges.iter().map(|(a, b)| format!("{a} to {b}")).collect::<Vec<_>>().join(", ")) " rpm"
                @if l.rule.as_ref().is_some_and(|r| !r.excepted.is_empty()) { "; what the study excepts counts where the rule does not let it be barred" } "." }
        }
        @let broken: Vec<String> = designs().flat_map(|d| d.still_broken.iter().map(move |b| outside(study, d, b))).collect();
        @if !broken.is_empty() { p { "Broken where no range can be barred for it:" } ul { @for words in &broken { li class="bad" { (words) } } } }
        @if all().next().is_none() { p { @if broken.is_empty() { "No design needs one within the speeds of the study." } @else { "No critical speed within the speeds of the study breaks a limit." } } } @else {
            div class="scroll" { table {
                thead { tr { th { "design" } th class="words" { "limit" } th { "condition" } th { "critical, rpm" } th { "stress, % of limit" } th { "allowed in passing, %" } th { "from, rpm" } th { "to, rpm" } th { "rule allows it" } } }
                tbody { @for (d, b) in all() { tr { td { (d.name) } td class="words" { (study.limits[b.limit].words) } td { (b.condition.name().replace('_', " ")) } td { (format!("{:.0}", b.critical_rpm)) } td { (format!("{:.1}", 100.0 * b.ratio)) } td { (dash(study.limits[b.limit].rule.as_ref().and_then(|r| r.transient).map(|t| format!("{:.1}", 100.0 * t)))) } td { (format!("{:.0}", b.from_rpm)) } td { (format!("{:.0}", b.to_rpm)) } td { @if b.excepted { "excepted by the study; " } (b.objection.map_or("yes".to_owned(), |o| format!("no: {}", o.words()))) } } } }
            } }
        }
    } }
}

fn plots(results: &Results, folder: &Folder) -> Markup {
    let responses = results.sweeps.iter().map(|s| (format!("response_{}.svg", s.design), s.design.replace('_', " ")));
    let all = [("campbell.svg", "Natural frequencies and critical speeds"), ("excitation.svg", "Orders of the torque")];
    let all = all.map(|(name, words)| (name.to_owned(), words.to_owned())).into_iter().chain(responses);
    html! {
        h2 { "Plots" }
        @for (name, words) in all { @if let Some(source) = picture(folder, &name) { figure { img src=(source) alt=(words); figcaption class="soft" { (words) } } } }
    }
}
