//! The modes of a flexible crank as they move.

use super::numbers::digits;
use crate::input::Study;
use crate::rotor::free_modes::FreeMode;
use crate::units::{HZ_PER_RAD_PER_S, M_PER_MM};
use maud::{Markup, html};
use serde_json::{Value, json};

/// Modes that can be chosen.
const MODES: usize = 12;
/// Radius of the discs at both ends over that of the throws.
const DISC: f64 = 1.6;

/// Where they are drawn.
pub(super) fn view() -> Markup {
    html! {
        p class="soft" { "The crank on its bearings at rest, seen obliquely; thick: a mode, its size at will. Discs with a spoke stand for what is on both ends." }
        div class="tools" {
            label { "Mode of the flexible crank " select id="crankmode" {} }
            label { input type="checkbox" id="moving"; " moving" }
        }
        div id="crank" {}
    }
}

/// Nodes, mm, those of both ends with the radius of their discs, mm, and by mode what each node does, its translation and its rotation per mm of the largest motion: of the nodes, or of the edge of a disc on one; `Null` on a torsional
/// chain.
pub(super) fn data(study: &Study) -> Value {
    let Some((flexible, crank)) = study.on_flexible().zip(study.crank.as_ref()) else { return Value::Null };
    let (assembled, radius) = (&flexible.assembled, DISC * crank.crank_radius);
    let places: Vec<Vec<Value>> = assembled.shaft.places.iter().map(|p| p.iter().map(|x| digits(x / M_PER_MM)).collect()).collect();
    let mode = |(i, m): (usize, &FreeMode)| {
        let size = |(k, x): (usize, &f64)| if k % 6 < 3 { x.abs() } else { x.abs() * radius };
        // behind the places stand coordinates of modes of a crank by matrices
        let largest = m.shape.iter().take(places.len()).flat_map(|x| x.iter().enumerate().map(size)).fold(0.0, f64::max);
        let of_node = |x: &[f64]| -> Vec<Value> {
            let all = x.iter().enumerate().map(|(k, x)| if k < 3 { x / largest } else { x * M_PER_MM / largest });
            all.map(digits).collect()
        };
        let motion: Vec<Vec<Value>> = m.shape.iter().take(places.len()).map(|x| of_node(x.as_slice())).collect();
        json!({ "name": format!("{}: {:.1} Hz, {}", i + 1, m.omega * HZ_PER_RAD_PER_S, m.kind()), "motion": motion })
    };
    let elastic = flexible.modes().unwrap_or_default().iter().filter(|m| m.omega > 0.0).take(MODES);
    let modes: Vec<Value> = elastic.enumerate().map(mode).collect();
    let discs: Vec<usize> = [assembled.stations.first(), assembled.stations.last()].into_iter().flatten().copied().collect();
    if modes.is_empty() {
        Value::Null
    } else {
        json!({ "places": places, "radius": digits(radius / M_PER_MM), "discs": discs, "modes": modes })
    }
}
