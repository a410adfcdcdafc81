//! What a response is asked for.

/// A quantity that is linear in the angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub enum Quantity {
    /// Angle of station `from` less that of `to` (`None`: the ground, so the amplitude of a station), rad.
    Twist {
        /// Index of a station.
        from: usize,
        /// Index of a station, or the ground.
        to: Option<usize>,
    },
    /// Vibratory torque of a shaft length, elastic and damping parts, N m.
    ShaftTorque(usize),
    /// Angle of the ring of an absorber (index in the design) less that of its hub, rad.
    RingTwist(usize),
}
