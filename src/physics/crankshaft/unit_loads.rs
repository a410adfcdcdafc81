//! Stresses per unit load at a point of a fillet, as from one finite-element run a load.

/// Stress tensor (xx, yy, zz, xy, yz, zx) per unit load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitLoads {
    /// Per bending moment in the plane of the throw, Pa/(N m).
    pub moment: [f64; 6],
    /// Per bending moment across it, Pa/(N m).
    pub tangential: [f64; 6],
    /// Per shear force in that plane, Pa/N.
    pub shear: [f64; 6],
    /// Per torque, Pa/(N m).
    pub torque: [f64; 6],
}
