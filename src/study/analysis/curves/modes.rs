//! Mode shapes with their nodes, Holzer's table of each mode, and the sums of phase vectors by which orders drive a mode.

use super::figure::{Axis, Curve, Figure, Look, ORDER, Panel, SPEED, Scale, curve};
use crate::analysis::model_check::{Critical, DRAWN_ORDERS, critical_speeds, largest_resonance, strongest_orders};
use crate::drivetrain::System;
use crate::input::Study;
use crate::numerics::C64;
use crate::units::HZ_PER_RPM;

const STATION: Axis = Axis { column: "station", label: "station" };
const RELATIVE: Axis = Axis { column: "relative_amplitude", label: "relative amplitude" };
const VECTOR_SUM: Axis = Axis { column: "vector_sum", label: "sum of phase vectors" };
const FREQUENCY: Axis = Axis { column: "frequency_hz", label: "frequency / Hz" };
/// Modes shown.
const MODES: usize = 4;

/// A row of Holzer's table: a station in a mode, for an angle of one at the largest station.
#[derive(Debug, Clone, PartialEq)]
pub struct HolzerRow {
    /// Elastic mode, from 1.
    pub mode: usize,
    /// Hz.
    pub frequency_hz: f64,
    /// Name.
    pub station: String,
    /// kg m².
    pub inertia: f64,
    /// Relative to the largest.
    pub angle: f64,
    /// J omega² theta, N m a rad of the largest.
    pub torque: f64,
    /// Of this station and those before it: what the link carries, N m a rad.
    pub sum: f64,
    /// Of the link, N m/rad.
    pub stiffness: f64,
    /// Of the link, a rad of the largest.
    pub twist: f64,
}

/// Shape of a mode, its largest amplitude one.
fn shape(study: &Study, mode: usize) -> Vec<f64> {
    let column = study.modes.shapes.column(mode);
    let largest = column.iter().copied().fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
    column.iter().map(|x| x / largest).collect()
}

/// Elastic modes that are shown: number from 1 and index.
fn shown(study: &Study) -> impl Iterator<Item = (usize, usize)> {
    study.modes.elastic().take(MODES).enumerate().map(|(i, mode)| (i + 1, mode))
}

/// Stations from each leaf to the first that another branch has, the longest way first.
fn branches(study: &Study) -> Vec<Vec<usize>> {
    let chain = &study.chain;
    let last = chain.len() - 1;
    let to_root = |leaf: usize| -> Vec<usize> { std::iter::successors(Some(leaf), |i| (*i < last).then(|| chain.next(*i))).collect() };
    let leaves = (0..chain.len()).filter(|i| (0..*i).all(|j| chain.next(j) != *i));
    let mut ways: Vec<Vec<usize>> = leaves.map(to_root).collect();
    ways.sort_by_key(|way| std::cmp::Reverse(way.len()));
    let mut seen = vec![false; chain.len()];
    for way in &mut ways {
        let own = way.iter().position(|i| seen[*i]).map_or(way.len(), |p| p + 1);
        way.truncate(own);
        way.iter().for_each(|i| seen[*i] = true);
    }
    ways
}

/// The first modes over the stations; a node is where a link has no motion, counted in stations; in a tree it is named by its link.
pub(super) fn modes(study: &Study) -> Figure {
    let frequencies = study.modes.frequencies_hz();
    let one = |(number, mode): (usize, usize)| {
        let shape = shape(study, mode);
        let chain = &study.chain;
        // seen from the shaft of the station, through the gear
        let node = |i: usize| {
            let after = shape[chain.next(i)] * chain.gear(i);
            (shape[i] * after < 0.0).then(|| match chain.is_row() {
                true => format!("{:.2}", (i + 1) as f64 + shape[i] / (shape[i] - after)),
                false => chain.shaft_name(i),
            })
        };
        let nodes: Vec<String> = (0..shape.len() - 1).filter_map(node).collect();
        let label =
            format!("{:.2} Hz, nodes at {}", frequencies[number - 1], if nodes.is_empty() { "none".into() } else { nodes.join(", ") });
        let line = |label: String, stations: &[usize]| {
            curve(label, stations.iter().map(|i| (i + 1) as f64), stations.iter().map(|i| shape[*i]).collect::<Vec<f64>>())
        };
        let ways = branches(study);
        let curves = ways.iter().enumerate().map(|(b, stations)| {
            line(if b == 0 { label.clone() } else { format!("branch of {}", chain.stations[stations[0]].name) }, stations)
        });
        let curves = curves.collect();
        Panel { title: format!("mode {number}"), x: STATION, y: RELATIVE, curves, scale: Scale::Own }
    };
    Figure {
        name: "modes".into(),
        title: format!("{}: mode shapes of the chain", study.engine.name),
        panels: shown(study).map(one).collect(),
    }
}

/// Natural frequencies of the chain, and the order lines that meet one of them in the range of speeds: where a curve of an order ends, it meets the
/// highest mode that it meets.
pub(super) fn campbell(study: &Study, system: &System) -> Figure {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let critical = critical_speeds(study, &system.excitation.orders);
    let frequencies = study.modes.frequencies_hz();
    let highest = critical.iter().map(|c| c.mode).max().unwrap_or(1).min(frequencies.len());
    let mode = |(i, f): (usize, &f64)| Curve { look: Look::Black(i), ..curve(format!("mode {}", i + 1), [low, high], [*f, *f]) };
    let mut curves: Vec<Curve> = frequencies[..highest].iter().enumerate().map(mode).collect();
    let orders = strongest_orders(study, system, DRAWN_ORDERS).into_iter().filter(|n| largest_resonance(study, system, *n) > 0.0);
    let mut met = Vec::new();
    for order in orders.map(|n| system.excitation.orders[n]) {
        let at = |c: &&Critical| c.order == order && c.mode <= highest;
        met.extend(critical.iter().filter(at).map(|c| (c.speed_rpm, frequencies[c.mode - 1])));
        let end = critical.iter().filter(|c| c.order == order).map(|c| c.speed_rpm).fold(low, f64::max);
        let line = curve(format!("order {order}"), [low, end], [low, end].map(|s| s * order.value() * HZ_PER_RPM));
        curves.push(Curve { look: Look::Order(order), ..line });
    }
    if !met.is_empty() {
        curves.push(Curve { label: "resonances".into(), look: Look::Points, points: met });
    }
    Figure {
        name: "campbell".into(),
        title: format!("{}: Campbell diagram of the chain", study.engine.name),
        panels: vec![Panel {
            title: format!("natural frequencies and at most {DRAWN_ORDERS} orders, those with the largest resonances without absorber"),
            x: SPEED,
            y: FREQUENCY,
            curves,
            scale: Scale::Own,
        }],
    }
}

/// Holzer's table of the first modes; the torque behind the last station, which must vanish, is its sum.
#[doc(hidden)]
pub fn holzer(study: &Study) -> Vec<HolzerRow> {
    let frequencies = study.modes.frequencies_hz();
    let stations = &study.chain.stations;
    let mut rows = Vec::new();
    for (number, mode) in shown(study) {
        let (angle, omega2) = (shape(study, mode), study.modes.omega[mode].powi(2));
        let mut sums = vec![0.0; stations.len()];
        for (i, s) in stations.iter().enumerate() {
            let torque = s.inertia * omega2 * angle[i];
            sums[i] += torque - s.stiffness_to_ground * angle[i];
            let last = i + 1 == stations.len();
            if !last {
                sums[study.chain.next(i)] += study.chain.gear(i) * sums[i];
            }
            rows.push(HolzerRow {
                mode: number,
                frequency_hz: frequencies[number - 1],
                station: s.name.clone(),
                inertia: s.inertia,
                angle: angle[i],
                torque,
                sum: sums[i],
                stiffness: s.stiffness_to_next,
                twist: if last { 0.0 } else { study.chain.link(i).of(|station| angle[station]) },
            });
        }
    }
    rows
}

/// Sums of the firing phases of all throws weighted by a mode: by how much an order drives it, per unit torque of a throw.
pub(super) fn phase_vectors(study: &Study, system: &System) -> Figure {
    let orders = || system.excitation.orders.iter().map(|o| o.value());
    let one = |(number, mode): (usize, usize)| {
        let shape = shape(study, mode);
        let sum = |n: usize| system.phases(n).iter().zip(&shape).map(|(p, phi)| p * *phi).sum::<C64>().norm();
        let curves = vec![curve(format!("mode {number}"), orders(), (0..system.orders()).map(sum))];
        Panel { title: format!("mode {number}"), x: ORDER, y: VECTOR_SUM, curves, scale: Scale::Own }
    };
    Figure {
        name: "phase_vectors".into(),
        title: format!("{}: sums of phase vectors", study.engine.name),
        panels: shown(study).map(one).collect(),
    }
}
