//! Response of a design over the speeds of the study, for tables and plots.

use super::ConditionResult;
use super::in_operation::absorbers;
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::engine::Units;
use crate::numerics::C64;
use crate::objective::{Condition, PeakFinder};
use crate::response::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::units::DEG_PER_RAD;

/// Amplitudes of one quantity over the speeds of the study.
#[derive(Debug, Clone, serde::Serialize)]
pub struct QuantitySweep {
    /// Name with unit, as in `response.csv`.
    pub name: String,
    /// The condition, where it is the twist in one.
    pub condition: Option<Condition>,
    /// Per order (one row an order, in the unit of the name), empty where only the total is kept.
    pub orders: Vec<Vec<f64>>,
    /// Half peak-to-peak of all orders together (power: the sum).
    pub total: Vec<f64>,
}

/// Response of one design over the speeds of the study.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Sweeps {
    /// Name of the design.
    pub design: String,
    /// Twist, hub, then the torque of each shaft, ring twist and power of each absorber, then the twist in each condition.
    pub quantities: Vec<QuantitySweep>,
}

/// The engine of a condition, with the cylinder misfiring that is worst.
fn finder_of<'a, 'f>(finders: &'f [PeakFinder<'a>], c: &ConditionResult) -> &'f PeakFinder<'a> {
    let units = |f: &&PeakFinder| f.system.excitation.units.misfiring() == c.cylinder;
    engines_in(c.condition, finders).find(units).unwrap_or(&finders[0])
}

/// Computes the sweeps of a design on `grid` (the study's own speeds).
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub fn sweeps(
    finders: &[PeakFinder],
    grid: &Grid,
    (name, conditions): (&str, &[ConditionResult]),
    design: &[Mounted],
    (twist, hub): (Quantity, usize),
    work: &mut Work,
) -> Result<Sweeps, ResponseError> {
    let finder = &finders[0];
    let direct = Direct::new(finder.system, grid);
    let orders = finder.system.orders();
    let shafts = finder.system.chain.len() - 1;
    let which = |i: usize| if design.len() > 1 { format!("_{}", i + 1) } else { String::new() };
    let degrees = DEG_PER_RAD;
    let mut wanted =
        vec![("twist_deg".to_owned(), twist, degrees), ("hub_deg".to_owned(), Quantity::Twist { from: hub, to: None }, degrees)];
    wanted.extend((0..shafts).map(|s| (format!("torque_{}_n_m", finder.system.chain.shaft_name(s)), Quantity::ShaftTorque(s), 1.0)));
    wanted.extend((0..design.len()).map(|i| (format!("ring_twist{}_deg", which(i)), Quantity::RingTwist(i), degrees)));
    let list: Vec<Quantity> = wanted.iter().map(|w| w.1).collect();
    let mut quantities = Vec::new();
    for (i, ((name, quantity, factor), phasors)) in wanted.into_iter().zip(direct.sweep_each(design, &list, work)?).enumerate() {
        let total = finder.synthesis(&phasors).iter().map(|v| v * factor).collect();
        let per_order = |n: usize| phasors.iter().skip(n).step_by(orders).map(|y| y.norm() * factor).collect();
        // single orders of twist and hub are kept; the rest would make the table many times as long
        let kept = if i < 2 { (0..orders).map(per_order).collect() } else { Vec::new() };
        quantities.push(QuantitySweep { name, condition: None, orders: kept, total });
        if let Quantity::RingTwist(ring) = quantity {
            let power = |(y, speed): (&[C64], &f64)| direct.power_of_twist(design, ring, *speed, y);
            let total = phasors.chunks(orders).zip(&grid.speed_rpm).map(power).collect();
            quantities.push(QuantitySweep {
                name: format!("dissipated_power{}_w", which(ring)),
                condition: None,
                orders: Vec::new(),
                total,
            });
        }
    }
    for c in conditions {
        let finder = finder_of(finders, c);
        let mut phasors = Vec::new();
        Direct::new(finder.system, grid).sweep(&absorbers(c.condition, finder, design)?, twist, &mut phasors, work)?;
        let total = finder.synthesis(&phasors).iter().map(|v| v * degrees).collect();
        let per_order = |n: usize| phasors.iter().skip(n).step_by(orders).map(|y| y.norm() * degrees).collect();
        // cylinders that differ bring orders of their own
        let kept = if finder.system.excitation.units != Units::Equal { (0..orders).map(per_order).collect() } else { Vec::new() };
        quantities.push(QuantitySweep {
            name: format!("twist_{}_deg", c.condition.name()),
            condition: Some(c.condition),
            orders: kept,
            total,
        });
    }
    Ok(Sweeps { design: name.to_owned(), quantities })
}
