//! How much stiffer a web is than a beam from axis to axis: by overlap of pin and journal, and by its ends beyond the axes.

use crate::crankshaft::Crank;
use crate::numerics::elementary::Elementary;

/// Factors on the stiffness of a web as one beam of breadth B and thickness W from the axis of the journal to that of the pin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WebFactors {
    /// On B W³/12, bending in the plane of the throw.
    pub bending: f64,
    /// On the torsion constant of the rectangle.
    pub twist: f64,
    /// On W B³/12, bending about the axis of the crank.
    pub edge: f64,
}

/// A ratio that the estimate depends on, with the range it was fitted in.
struct Ratio {
    of: &'static str,
    value: f64,
    range: (f64, f64),
}

/// Overlap, thickness, breadth and journal, over the diameter of the pin.
fn ratios(crank: &Crank) -> [Ratio; 4] {
    let over = |length: f64| length / crank.pin_diameter;
    [
        Ratio { of: "overlap of crankpin and journal", value: over(crank.overlap()), range: (-0.2, 0.4) },
        Ratio { of: "thickness of the webs", value: over(crank.web_thickness), range: (0.2, 0.6) },
        Ratio { of: "breadth of the webs", value: over(crank.web_breadth), range: (1.15, 2.2) },
        Ratio { of: "diameter of the journals", value: over(crank.journal_diameter), range: (1.0, 1.35) },
    ]
}

impl WebFactors {
    // 0.318 is a coefficient of the fit, not 1/pi
    #[allow(clippy::approx_constant)]
    /// By dimensions, or why not. Fitted to the flexibility of 48 throws of solid finite elements (coarse meshes, no fillets): 10 % (root of the mean square), 31 % at most. It misses the
    /// coupling of tangential motion and rotation by 15 %, the motion of the pin under torque by 45 %.
    ///
    /// # Errors
    /// The ratio that is outside the range of the fit, in words.
    pub fn estimate(crank: &Crank) -> Result<Self, String> {
        let ratios = ratios(crank);
        if let Some(Ratio { of, value, range: (low, high) }) = ratios.iter().find(|r| !(r.range.0..=r.range.1).contains(&r.value)) {
            return Err(format!(
                "the {of} is {value:.3} of the diameter of the crankpins, and the estimate was fitted from {low} to {high}"
            ));
        }
        let [s, w, b, j] = ratios.map(|r| r.value);
        let (ln_w, ln_b, j) = (w.logarithm(), b.logarithm(), j - 1.2);
        Ok(Self {
            bending: (-0.039 + 0.904 * s + 1.885 * s * s - 0.949 * ln_w - 0.361 * ln_b + 0.208 * j).exponential(),
            twist: (0.158 + 1.214 * s + 1.211 * s * s - 1.225 * ln_w - 0.318 * ln_b + 0.455 * j).exponential(),
            edge: (0.807 + 0.074 * s + 0.502 * s * s + 0.377 * ln_w - 0.945 * ln_b + 0.173 * j).exponential(),
        })
    }
}
