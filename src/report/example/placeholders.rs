//! Which values of an example are to be confirmed.

/// The head of a list of them in a file.
const HEAD: &str = "# Values of an example: `hartog check` and `hartog run` name them. Put in your own, and delete their names here.\n";

/// Of the cylinder.
pub(super) const CYLINDER: &[&str] = &[
    "reciprocating_inertia",
    "geometry.bore_mm",
    "geometry.crank_radius_mm",
    "geometry.rod_length_mm",
    "geometry.piston_mass_kg",
    "geometry.rod_mass_kg",
    "geometry.rod_rotating_fraction",
];
/// Of engines in line.
pub(super) const IN_LINE: &[&str] = &["layout.in_line.firing_order", "layout.in_line.firing_deg"];
/// Of V engines.
pub(super) const V: &[&str] = &["layout.v.bank_angle_deg", "layout.v.firing_order", "layout.v.firing_deg"];
/// Of burning by Wiebe's law.
pub(super) const WIEBE: &[&str] = &[
    "pressure.wiebe.speed_rpm",
    "pressure.wiebe.indicated_mean_pressure_bar",
    "pressure.wiebe.boost_bar",
    "pressure.wiebe.compression_ratio",
    "pressure.wiebe.burn_start_deg",
    "pressure.wiebe.burn_duration_deg",
];
/// Of an ideal cycle.
pub(super) const OTTO: &[&str] =
    &["pressure.otto.speed_rpm", "pressure.otto.curve.torque_n_m", "pressure.otto.compression_ratio", "pressure.otto.pressure_scale"];

/// The list of these keys, as a file has it.
pub(super) fn list(keys: &[&str]) -> String {
    format!("{HEAD}placeholder = [\n{}]\n", keys.iter().map(|key| format!("  \"{key}\",\n")).collect::<String>())
}
