//! Filled rubber softens with the amplitude of its strain (Payne's effect): Kraus's model \[Kraus 1984\].

use crate::numerics::elementary::Elementary;

/// G'(g) = G'inf (1 + (r - 1)/(1 + y²)), G''(g) = G''inf (1 + 2 (q - 1) y/(1 + y²)) with y = (g/g_c)^m, g the amplitude of shear strain, zero to peak. Known to the author from quotations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kraus {
    /// r: storage modulus at no strain over that at large strain, at least one.
    pub storage_ratio: f64,
    /// q: largest loss modulus over that at large strain, at least one.
    pub loss_ratio: f64,
    /// g_c.
    pub strain: f64,
    /// m.
    pub exponent: f64,
    /// Strain at which the values of the law are given.
    pub reference: f64,
}

impl Kraus {
    /// Storage and loss modulus at an amplitude of strain over those at the reference.
    pub fn factors(&self, strain: f64) -> (f64, f64) {
        let factors_at = |strain: f64| {
            let y = (strain / self.strain).power(self.exponent);
            let share = 1.0 / (1.0 + y * y);
            // y share, without infinity over infinity
            let slope = if y > 1.0 { 1.0 / (y + 1.0 / y) } else { y * share };
            (1.0 + (self.storage_ratio - 1.0) * share, 1.0 + 2.0 * (self.loss_ratio - 1.0) * slope)
        };
        let (now, reference) = (factors_at(strain), factors_at(self.reference));
        (now.0 / reference.0, now.1 / reference.1)
    }
}
