//! `absorbers.csv`: a row an absorber of every design.

use super::table::{Table, number, optional};
use crate::absorber::construction::shape;
use crate::absorber::{Host, Mounted, Parameter, TYPES};
use crate::analysis::{DesignResult, Results};
use crate::drivetrain::natural;
use crate::files::{Folder, WriteError};
use crate::units::{DEG_PER_RAD, HZ_PER_RAD_PER_S, PA_PER_MPA};

/// Parameters of all types, each once, then those of laws that a program brought.
fn parameters<'a>(designs: impl Iterator<Item = &'a DesignResult>) -> Vec<&'static Parameter> {
    let used = designs.flat_map(|d| &d.absorbers).filter_map(|m| m.absorber.declaration());
    let mut list: Vec<&Parameter> = Vec::new();
    // dimensions where a design has them
    for p in TYPES.into_iter().filter(|t| shape(t).is_none()).chain(used).flat_map(|t| t.parameters) {
        if list.iter().all(|known| known.key != p.key) {
            list.push(p);
        }
    }
    list
}

/// What carries an absorber: a station by its name, or the ring of another absorber of the design by its number.
fn host(results: &Results, mounted: &Mounted) -> [String; 2] {
    match mounted.on {
        Host::Station(station) => [results.system.chain.stations[station].name.clone(), String::new()],
        Host::Ring(inner) => [String::new(), (inner + 1).to_string()],
    }
}

/// `absorbers.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn absorbers(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let designs = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let parameters = parameters(designs());
    let mut header = vec!["design", "absorber", "on_station", "on_ring_of", "type", "hub_inertia_kg_m2"];
    header.extend(parameters.iter().map(|p| p.key));
    header.extend(["dissipated_power_w", "ring_twist_deg", "implied_loss_factor"]);
    header.extend(["geometry_factor_m3", "own_frequency_hz", "shear_modulus_mpa", "loss_factor_there", "viscosity_pa_s", "strain_percent"]);
    let mut table = Table::new(&header);
    for d in designs() {
        for (i, (m, load)) in d.absorbers.iter().zip(&d.loads).enumerate() {
            let [station, ring] = host(results, m);
            let mut row =
                vec![d.name.clone(), (i + 1).to_string(), station, ring, m.absorber.type_name().to_owned(), number(m.hub_inertia)];
            row.extend(parameters.iter().map(|p| optional(m.absorber.value(p.key))));
            row.extend([number(load.power), number(load.ring_twist * DEG_PER_RAD)]);
            row.push(optional(m.absorber.implied_loss_factor().map(|l| l.0)));
            let made_of = load.made_of;
            let rubber = made_of.and_then(|m| m.rubber);
            row.push(optional(made_of.map(|m| m.factor)));
            let own = m.absorber.law().and_then(|law| natural::own(&**law)).map(|omega| omega * HZ_PER_RAD_PER_S);
            row.extend([rubber.map(|r| r.0).or(own), rubber.map(|r| r.1 / PA_PER_MPA), rubber.map(|r| r.2)].map(optional));
            row.push(optional(made_of.and_then(|m| m.viscosity)));
            row.push(optional(made_of.map(|m| 100.0 * m.strain)));
            table.row(row);
        }
    }
    table.save(folder, "absorbers.csv")
}
