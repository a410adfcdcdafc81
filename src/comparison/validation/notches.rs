//! Published factors of stress concentration: the four dimensions of web and fillets that they follow from, by an inverse fit. Four factors for four
//! dimensions prove nothing by themselves; that both fillets come out alike, as they would be made, is the only evidence.

use super::{Entry, Kind, Role, Uncertainty};
use crate::crankshaft::Concentration;
use crate::crankshaft::stress_concentration::{Formulas, Geometry};
use crate::input::published::PublishedFactor;
use crate::input::{Published, Study};
use crate::numerics::least_squares::{Range, fit};
use crate::units::M_PER_MM;
use std::convert::Infallible;

/// The fitted dimensions in their order, with the ranges of the formulas relative to the crankpin.
const DIMENSIONS: [(&str, (f64, f64)); 4] =
    [("web thickness", (0.2, 0.8)), ("web breadth", (1.1, 2.2)), ("crankpin fillet", (0.03, 0.13)), ("journal fillet", (0.03, 0.13))];
/// The search starts from these shares of the ranges; the best end counts.
const STARTS: [f64; 3] = [0.15, 0.4, 0.7];
/// Factors are printed with two digits.
const HALF_DIGIT: f64 = 0.005;

/// Dimensions from factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Inverse {
    /// With the fitted dimensions.
    pub geometry: Geometry,
    /// Bending and torsion at the crankpin, then at the journal, as fitted.
    pub factors: [f64; 4],
    /// Half the width of each dimension (in m) that the printed digits leave, to first order.
    pub digits: [f64; 4],
}

fn with(geometry: &Geometry, x: &[f64]) -> Geometry {
    let d = geometry.pin_diameter;
    Geometry { web_thickness: x[0] * d, web_breadth: x[1] * d, pin_fillet: x[2] * d, journal_fillet: x[3] * d, ..*geometry }
}

fn factors(geometry: &Geometry) -> [f64; 4] {
    let all = Concentration::new(geometry, Formulas::Fvv1973);
    [all.crankpin.bending, all.crankpin.torsion, all.journal.bending, all.journal.torsion]
}

/// The dimensions whose factors by appendix A of \[Villalva 2014\] are nearest to these four; diameters and overlap are those of `geometry`.
pub fn inverse(geometry: &Geometry, wanted: [f64; 4]) -> Option<Inverse> {
    let ranges: Vec<Range> = DIMENSIONS.iter().map(|(_, (lower, upper))| Range { lower: *lower, upper: *upper, scale: 1.0 }).collect();
    let mut residuals =
        |x: &[f64]| -> Result<Vec<f64>, Infallible> { Ok(factors(&with(geometry, x)).iter().zip(wanted).map(|(f, w)| f - w).collect()) };
    let mut best: Option<crate::numerics::least_squares::Fit> = None;
    for share in STARTS {
        let start: Vec<f64> = ranges.iter().map(|r| r.lower + share * (r.upper - r.lower)).collect();
        let Ok(found) = fit(&mut residuals, &ranges, &start);
        if best.as_ref().is_none_or(|b| found.cost() < b.cost()) {
            best = Some(found);
        }
    }
    let found = best?;
    let fitted = with(geometry, &found.point);
    let jacobian = found.jacobian.clone().try_inverse();
    let half = |i: usize| {
        jacobian.as_ref().map_or(f64::INFINITY, |j| j.row(i).iter().map(|s| s.abs()).sum::<f64>() * HALF_DIGIT * geometry.pin_diameter)
    };
    Some(Inverse { factors: factors(&fitted), geometry: fitted, digits: [0, 1, 2, 3].map(half) })
}

/// The published factors at crankpin and journal: bending and torsion of each.
pub(crate) fn published_factors(published: &Published) -> Option<[f64; 4]> {
    let factors_at = |fillet: &str| published.factors.iter().find(|f| f.fillet == fillet);
    let (pin, journal) = (factors_at("crankpin")?, factors_at("journal")?);
    Some([pin.bending, pin.torsion, journal.bending, journal.torsion])
}

pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let (Some(crank), Some(wanted)) = (&study.crank, published_factors(published)) else { return Vec::new() };
    let Some(found) = inverse(&crank.notch(), wanted) else { return Vec::new() };
    let table = |f: Option<&PublishedFactor>| f.map_or_else(String::new, |f| f.table.clone());
    let source = table(published.factors.first());
    let names = ["bending factor, crankpin", "torsion factor, crankpin", "bending factor, journal", "torsion factor, journal"];
    let entry = |quantity: &str, unit: &str, published: Option<f64>, computed: f64, note: String| Entry {
        table: source.clone(),
        design: String::new(),
        quantity: quantity.into(),
        kind: Kind::Other,
        unit: unit.into(),
        published,
        computed: Some(computed),
        uncertainty: Uncertainty::default(),
        role: Role::FittedExactly,
        note,
    };
    let mut list: Vec<Entry> = Vec::new();
    for i in 0..4 {
        let off = found.factors[i] - wanted[i];
        let note = format!("appendix A (FVV 1973) with four dimensions fitted to the four factors; {off:+.3} is left");
        list.push(entry(names[i], "-", Some(wanted[i]), found.factors[i], note));
    }
    let g = &found.geometry;
    let own = [g.web_thickness, g.web_breadth, g.pin_fillet, g.journal_fillet];
    for (i, (name, _)) in DIMENSIONS.iter().enumerate() {
        let note = if found.digits[i] < own[i] {
            format!("not printed; the digits of the factors leave ± {:.2} mm", found.digits[i] / M_PER_MM)
        } else {
            "not printed, and not determined by the digits of the factors".into()
        };
        list.push(entry(&format!("{name} by the inverse fit"), "mm", None, own[i] / M_PER_MM, note));
    }
    list
}
