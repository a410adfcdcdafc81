//! Closed-form optima of an absorber on an undamped engine of one mode. They start the search, and reproduce published designs.
//!
//! Two damping ratios are in use and easily confused: `c/(2 J omega_absorber)` with the absorber's own frequency sqrt(k/J), and
//! `c/(2 J omega_engine)` with the engine's. Each rule below says which one its source means.

use super::dynamic_stiffness::SpringAndDamper;

/// The engine as the closed forms see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngineMode {
    /// Inertia at the absorber's station, kg m².
    pub inertia: f64,
    /// Circular natural frequency without absorber, rad/s.
    pub omega: f64,
}

/// Stiffness and damping of a ring with this tuning omega_absorber/omega_engine and damping ratio c/(2 J omega_engine).
fn tuned_to(ring_inertia: f64, engine: EngineMode, tuning: f64, damping_ratio: f64) -> SpringAndDamper {
    let omega = tuning * engine.omega;
    SpringAndDamper { stiffness: ring_inertia * omega * omega, damping: 2.0 * ring_inertia * engine.omega * damping_ratio }
}

/// Ring tuned to the engine, damping after Brock.
pub fn brock_unity_ring(ring_inertia: f64, engine: EngineMode) -> SpringAndDamper {
    tuned_to(ring_inertia, engine, 1.0, brock_unity(ring_inertia / engine.inertia))
}

/// Ring tuned to 1/(1 + mu), damping after Brock.
pub fn den_hartog_brock_ring(ring_inertia: f64, engine: EngineMode) -> SpringAndDamper {
    let mu = ring_inertia / engine.inertia;
    tuned_to(ring_inertia, engine, 1.0 / (1.0 + mu), den_hartog_brock(mu))
}

/// The exact minimum of the largest amplitude.
#[doc(hidden)]
pub fn h_infinity_ring(ring_inertia: f64, engine: EngineMode) -> SpringAndDamper {
    let (tuning, damping_ratio) = h_infinity(ring_inertia / engine.inertia);
    tuned_to(ring_inertia, engine, tuning, damping_ratio)
}

/// Damping of the best ring without a spring, N m s/rad.
pub fn viscous_damping(ring_inertia: f64, engine: EngineMode) -> f64 {
    tuned_to(ring_inertia, engine, 0.0, viscous_untuned(ring_inertia / engine.inertia)).damping
}

/// Damping ratio c/(2 J omega_engine) for a ring tuned to the engine's frequency (so that both frequencies are the same), inertia ratio
/// `mu`: the peak at the lower fixed point is horizontal \[Brock 1946\], \[Den Hartog 1956\] section 3.3.
pub fn brock_unity(mu: f64) -> f64 {
    (mu * (mu + 3.0) * (1.0 + (mu / (mu + 2.0)).sqrt()) / (8.0 * (1.0 + mu))).sqrt()
}

/// Damping ratio c/(2 J omega_engine) for the tuning omega_absorber/omega_engine = 1/(1 + mu), which levels the fixed points: the mean of the
/// squares that make either peak horizontal \[Brock 1946\], \[Den Hartog 1956\] section 3.3. As c/(2 J omega_absorber) the same damper is
/// sqrt(3 mu/(8 (1 + mu))).
pub fn den_hartog_brock(mu: f64) -> f64 {
    (3.0 * mu / (8.0 * (1.0 + mu).powi(3))).sqrt()
}

/// Damping ratio c/(2 J omega_engine) of a viscous absorber whose peak lies on the fixed point \[Villalva 2014\] eq. (6.33); the peak is
/// (2 + mu)/mu static deflections.
pub fn viscous_untuned(mu: f64) -> f64 {
    1.0 / (2.0 * (1.0 + mu) * (2.0 + mu)).sqrt()
}

/// Tuning omega_absorber/omega_engine and damping ratio **c/(2 J omega_engine)** that minimise the largest amplitude exactly \[Nishihara & Asami
/// 2002\]. The paper gives the ratio c/(2 J omega_absorber); it is multiplied by the tuning here.
pub fn h_infinity(mu: f64) -> (f64, f64) {
    let root = (4.0 + 3.0 * mu).sqrt();
    let tuning = 2.0 / (1.0 + mu)
        * (2.0 * (16.0 + 23.0 * mu + 9.0 * mu * mu + 2.0 * (2.0 + mu) * root) / (3.0 * (64.0 + 80.0 * mu + 27.0 * mu * mu))).sqrt();
    // 8 + 9 mu - 4 root, without cancellation for small mu
    let excess = mu * (96.0 + 81.0 * mu) / (8.0 + 9.0 * mu + 4.0 * root);
    let damping_of_absorber = 0.25 * (excess / (1.0 + mu)).sqrt();
    (tuning, tuning * damping_of_absorber)
}
