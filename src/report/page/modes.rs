//! Natural frequencies over speed and the shapes of the modes.

use super::crank_modes;
use super::numbers::{digits, list};
use crate::analysis::Results;
use crate::analysis::curves::holzer;
use crate::analysis::model_check::{DRAWN_ORDERS, strongest_orders};
use crate::input::Study;
use crate::units::HZ_PER_RPM;
use maud::{Markup, html};
use serde_json::{Map, Value, json};

/// Both views; the shapes are those of the flexible crank where the response is its.
pub(super) fn modes(flexible: bool) -> Markup {
    html! {
        h2 { "Natural frequencies and mode shapes" }
        p class="soft" { "Orders of the engine that meet a natural frequency excite it; drawn are at most " (DRAWN_ORDERS) ", those with the largest resonances of the engine without absorber. Grey: the engine without absorber; colours: the designs ticked above, where their frequencies do not depend on speed." }
        div id="campbell" {}
        @if flexible { (crank_modes::view()) } @else {
            div class="tools" { label { "Mode of the torsional chain " select id="mode" {} } }
            div id="shape" {}
        }
    }
}

/// What the script draws: order lines, frequencies of the chain and of each design, and the first shapes of the chain.
pub(super) fn data(study: &Study, results: &Results) -> Value {
    let orders = strongest_orders(study, &results.system, DRAWN_ORDERS).into_iter().map(|n| results.system.excitation.orders[n]);
    let orders: Vec<Value> = orders.map(|o| json!({ "name": o.to_string(), "hz_per_rpm": o.value() * HZ_PER_RPM })).collect();
    let designs = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).filter(|d| !d.absorbers.is_empty());
    let designs: Map<String, Value> = designs.map(|d| (d.name.clone(), list(&d.frequencies_hz))).collect();
    let rows = holzer(study);
    let shape = |mode: usize| {
        let rows_of_mode = || rows.iter().filter(|r| r.mode == mode);
        let hz = rows_of_mode().next().map_or(Value::Null, |r| digits(r.frequency_hz));
        json!({ "hz": hz, "angles": rows_of_mode().map(|r| digits(r.angle)).collect::<Vec<_>>() })
    };
    let shapes: Vec<Value> = (1..=rows.iter().map(|r| r.mode).max().unwrap_or(0)).map(shape).collect();
    let alone = if results.system.flexible.is_some() { "flexible crank alone" } else { "chain alone" };
    let stations: Vec<&str> = study.chain.stations.iter().map(|s| s.name.as_str()).collect();
    json!({ "orders": orders, "chain": list(&results.system.modes.frequencies_hz()), "designs": designs, "shapes": shapes, "stations": stations, "row": study.chain.is_row(), "alone": alone, "crank": crank_modes::data(study) })
}
