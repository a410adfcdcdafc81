//! Every conversion factor. Inside hartog everything is SI; files and tables carry the unit in the name, and convert here.

use std::f64::consts::PI;

/// rad in a degree.
pub const RAD_PER_DEG: f64 = PI / 180.0;
/// degrees in a rad.
#[doc(hidden)]
pub const DEG_PER_RAD: f64 = 180.0 / PI;
/// rad/s in a revolution per minute.
pub const RAD_PER_S_PER_RPM: f64 = PI / 30.0;
/// Hz in a rad/s.
#[doc(hidden)]
pub const HZ_PER_RAD_PER_S: f64 = 0.5 / PI;
/// Hz in a revolution per minute.
#[doc(hidden)]
pub const HZ_PER_RPM: f64 = 1.0 / 60.0;
/// m in a mm.
#[doc(hidden)]
pub const M_PER_MM: f64 = 1e-3;
/// Pa in a bar.
#[doc(hidden)]
pub const PA_PER_BAR: f64 = 1e5;
/// Pa in a MPa.
#[doc(hidden)]
pub const PA_PER_MPA: f64 = 1e6;
/// N in a kN.
#[doc(hidden)]
pub const N_PER_KN: f64 = 1e3;
/// Pa in a GPa.
#[doc(hidden)]
pub const PA_PER_GPA: f64 = 1e9;
/// Pa in a kpsi.
pub(crate) const PA_PER_KPSI: f64 = 6.894_757_293e6;
/// Pa in a psi.
#[doc(hidden)]
pub const PA_PER_PSI: f64 = 6_894.757_293_168;
/// N in a pound of force.
#[doc(hidden)]
pub const N_PER_LBF: f64 = 4.448_221_615_260_5;
/// m in an inch.
#[doc(hidden)]
pub const M_PER_IN: f64 = 0.0254;
/// W in a kW.
#[doc(hidden)]
pub const W_PER_KW: f64 = 1e3;
/// crank degrees in a revolution.
#[doc(hidden)]
pub const DEG_PER_REV: f64 = 360.0;
/// K at 0 °C.
#[doc(hidden)]
pub const KELVIN_AT_0_C: f64 = 273.15;

/// Ends of keys with their units, the longest first.
const SUFFIXES: [(&str, &str); 38] = [
    ("n_m_s_per_rad", "N m s/rad"),
    ("mm2_per_s", "mm²/s"),
    ("w_per_m_k", "W/(m K)"),
    ("n_m_per_rad", "N m/rad"),
    ("mpa_per_deg", "MPa/°"),
    ("rad_per_s2", "rad/s²"),
    ("rad_per_s", "rad/s"),
    ("kj_per_mol", "kJ/mol"),
    ("per_rad2", "1/rad²"),
    ("w_per_m2", "W/m²"),
    ("shore_a", "Shore A"),
    ("w_per_k", "W/K"),
    ("n_per_m", "N/m"),
    ("percent", "%"),
    ("kg_m2", "kg m²"),
    ("kg_m3", "kg/m³"),
    ("per_k", "1/K"),
    ("per_s", "1/s"),
    ("per_kg", "1/kg"),
    ("kg_m", "kg m"),
    ("n_m", "N m"),
    ("cm3", "cm³"),
    ("rpm", "rpm"),
    ("deg", "°"),
    ("mpa", "MPa"),
    ("gpa", "GPa"),
    ("bar", "bar"),
    ("mm", "mm"),
    ("kw", "kW"),
    ("kg", "kg"),
    ("hz", "Hz"),
    ("m2", "m²"),
    ("c", "°C"),
    ("h", "h"),
    ("k", "K"),
    ("s", "s"),
    ("w", "W"),
    ("n", "N"),
];

/// The unit that the end of a key names.
#[doc(hidden)]
pub fn of_key(key: &str) -> Option<&'static str> {
    let named = |end: &str| key.strip_suffix(end).is_some_and(|before| before.is_empty() || before.ends_with('_'));
    SUFFIXES.iter().find(|(end, _)| named(end)).map(|s| s.1)
}
