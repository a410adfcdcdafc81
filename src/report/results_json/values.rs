//! What is known of a design, a value at a time.

use crate::analysis::{DesignResult, Results, over_states};
use crate::input::Study;
use crate::objective::{Condition, Peak};
use crate::response::Quantity;
use crate::units::DEG_PER_RAD;
use schemars::JsonSchema;
use serde::Serialize;

/// A value of a design.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub(crate) struct Value {
    /// The condition; `held` for the worst of those that an optimum is to hold in.
    pub condition: &'static str,
    /// What it is.
    pub measure: String,
    /// In the unit named.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// Of what: stations, a shaft length, an absorber, a mode, a fillet, a cylinder.
    #[serde(rename = "where", skip_serializing_if = "String::is_empty")]
    pub place: String,
    /// The order that adds most to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    /// The speed at which it is reached, rpm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_rpm: Option<f64>,
}

/// The worst of the conditions that an optimum is to hold in.
const HELD: &str = "held";

/// Values of one design on their way into a list: those that are not finite are left out.
struct Values<'a> {
    results: &'a Results,
    list: Vec<Value>,
}

impl Values<'_> {
    fn put(&mut self, condition: &'static str, measure: &str, (value, unit): (Option<f64>, &'static str), place: String) {
        if let Some(value) = value.filter(|v| v.is_finite()) {
            self.list.push(Value { condition, measure: measure.to_owned(), value, unit, place, order: None, speed_rpm: None });
        }
    }

    fn put_peak(&mut self, condition: Condition, measure: &str, peak: Option<&Peak>) {
        let Some(peak) = peak else { return };
        let (factor, unit) = match peak.quantity {
            Quantity::Twist { .. } | Quantity::RingTwist(_) => (DEG_PER_RAD, "deg"),
            Quantity::ShaftTorque(_) => (1.0, "N m"),
            Quantity::Motion(_, rate) => (1.0, rate.unit()),
        };
        let before = self.list.len();
        self.put(condition.name(), measure, (Some(peak.value * factor), unit), peak.quantity.place(&self.results.system.chain));
        for value in &mut self.list[before..] {
            value.order = self.results.system.excitation.orders.get(peak.order).map(|o| o.value());
            value.speed_rpm = Some(peak.speed_rpm);
        }
    }
}

/// Values of a design: natural frequencies, peaks, heat, objective, margins, what each absorber bears, and the same in other conditions.
pub(crate) fn values(study: &Study, results: &Results, d: &DesignResult) -> Vec<Value> {
    let firing = Condition::Firing;
    let mut all = Values { results, list: Vec::new() };
    for (i, f) in d.frequencies_hz.iter().enumerate() {
        all.put(firing.name(), "natural_frequency", (Some(*f), "Hz"), format!("mode {}", i + 1));
    }
    let peaks =
        [("peak_twist", &d.twist), ("peak_order_twist", &d.order_twist), ("peak_order_hub", &d.order_hub), ("peak_torque", &d.torque)];
    for (measure, peak) in peaks {
        all.put_peak(firing, measure, peak.as_ref());
    }
    all.put(firing.name(), "dissipated_power", (d.power, "W"), String::new());
    for (i, (m, load)) in d.absorbers.iter().zip(&d.loads).enumerate() {
        let place = || Quantity::RingTwist(i).place(&results.system.chain);
        all.put(firing.name(), "dissipated_power", (Some(load.power), "W"), place());
        all.put(firing.name(), "ring_twist", (Some(load.ring_twist * DEG_PER_RAD), "deg"), place());
        all.put(firing.name(), "implied_loss_factor", (m.absorber.implied_loss_factor().map(|l| l.0), "1"), place());
        all.put(firing.name(), "strain", (load.made_of.map(|m| 100.0 * m.strain), "%"), place());
    }
    for (i, m) in d.absorbers.iter().enumerate() {
        for (condition, own) in over_states(&m.absorber, d.conditions.iter().map(|c| c.condition)) {
            let place = || Quantity::RingTwist(i).place(&results.system.chain);
            all.put(condition.name(), "own_frequency", (Some(own.frequency_hz), "Hz"), place());
            all.put(condition.name(), "stiffness_at_own_frequency", (Some(own.stiffness), "N m/rad"), place());
            all.put(condition.name(), "loss_factor_at_own_frequency", (Some(own.loss_factor), "1"), place());
        }
    }
    for life in results.duty.iter().filter(|o| o.design == d.name).flat_map(|o| &o.lives) {
        let hours = Some(life.hours()).filter(|h| h.is_finite());
        all.put(firing.name(), "life_over_duty", (hours, "h"), Quantity::RingTwist(life.absorber).place(&results.system.chain));
    }
    let objective = &study.objective;
    all.put(HELD, "objective", (d.objective.map(|v| objective.unit.shown(v)), objective.unit.symbol()), objective.place.clone());
    for c in &d.conditions {
        let cylinder = c.cylinder.map_or_else(String::new, |c| format!("cylinder {}", c + 1));
        all.put_peak(c.condition, "peak_twist", c.twist.as_ref());
        all.put_peak(c.condition, "peak_torque", c.torque.as_ref());
        all.put(c.condition.name(), "objective", (Some(objective.unit.shown(c.objective)), objective.unit.symbol()), cylinder);
    }
    for m in &d.margins {
        let Some(model) = &results.margin else { continue };
        let before = all.list.len();
        let column = model.criteria[m.criterion].column();
        all.put(firing.name(), &column, (Some(m.margin), "1"), model.locations[m.used.location].name.clone());
        all.list[before..].iter_mut().for_each(|v| v.speed_rpm = Some(m.speed_rpm));
    }
    all.list
}
