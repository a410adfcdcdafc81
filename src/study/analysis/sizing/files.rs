//! Engine file and study of a sized slider-crank, as texts.

use super::results::{SizeError, StudyFiles};
use crate::engine::Pressure;
use crate::engine::pressure::Measured;
use crate::input::{SizedAbsorber, SizingStudy, Study, from_texts};
use crate::sizing::{Round, Sized, Sizes, bodies};
use crate::units::{M_PER_MM, PA_PER_BAR};
use std::fmt::Write;
use std::path::Path;

/// All files, the pressure in a table beside them.
pub(super) fn files(study: &SizingStudy, sized: &Sized) -> StudyFiles {
    let pressure = match &study.specification.pressure {
        Pressure::Measured(measured) => Some(traces(measured)),
        _ => None,
    };
    StudyFiles { engine: engine(study, sized.last(), "pressure.csv"), study: self::study(study, study.absorber), pressure }
}

/// The study that follows from a crank, as `hartog run` would read it.
///
/// # Errors
/// [`SizeError::Chain`] where it would not take it.
pub(super) fn study_of(of: &SizingStudy, round: &Round, absorber: Option<SizedAbsorber>) -> Result<Study, SizeError> {
    // tables that the file names are looked for beside it
    let path = of.pressure_file.as_deref().unwrap_or(Path::new("study.toml"));
    let table = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    from_texts(path, &study(of, absorber), &engine(of, round, &table)).map_err(|e| {
        // its places are lines of files that are not written
        SizeError::Chain(e.mistakes.first().map_or_else(String::new, |m| m.message.clone()))
    })
}

/// A text in a line of its own.
fn comment(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A text in quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn list(values: impl IntoIterator<Item = f64>) -> String {
    let values: Vec<String> = values.into_iter().map(|v| v.to_string()).collect();
    format!("[{}]", values.join(", "))
}

/// Engine file: geometry, layout, pressure, crank and chain.
pub(super) fn engine(study: &SizingStudy, round: &Round, pressure_file: &str) -> String {
    let spec = &study.specification;
    let mm = |x: f64| x / M_PER_MM;
    let mut text = format!(
        "# Sized by `hartog size` from {}.toml.\nname = {}\nstrokes = {}\n\n[geometry]\n",
        comment(&study.name),
        quoted(&study.title),
        spec.strokes
    );
    let geometry = [
        ("bore_mm", mm(spec.bore)),
        ("crank_radius_mm", mm(spec.crank_radius())),
        ("rod_length_mm", mm(spec.rod_length)),
        ("piston_mass_kg", spec.piston_mass),
        ("rod_mass_kg", round.rod.mass),
        ("rod_centre_from_big_end_mm", mm(round.rod.centre)),
        ("rod_inertia_kg_m2", round.rod.inertia()),
        ("crankcase_pressure_bar", spec.crankcase_pressure / PA_PER_BAR),
        ("liner_friction", spec.liner_friction),
    ];
    geometry.iter().for_each(|(key, value)| _ = writeln!(text, "{key} = {value}"));
    let mut firing: Vec<(usize, f64)> = spec.firing_deg.iter().copied().enumerate().collect();
    firing.sort_by(|a, b| a.1.total_cmp(&b.1));
    let order: Vec<String> = firing.iter().map(|f| (f.0 + 1).to_string()).collect();
    let angles = list(firing.iter().map(|f| f.1));
    _ = writeln!(text, "\n[layout.in_line]\nfiring_order = [{}]\nfiring_deg = {angles}\n", order.join(", "));
    text += &pressure(&spec.pressure, pressure_file);
    text += &crank(study, &round.sizes);
    text += &chain(study, &round.sizes);
    text
}

fn pressure(pressure: &Pressure, file: &str) -> String {
    match pressure {
        Pressure::Otto(m) => format!(
            "[pressure.otto]\nspeed_rpm = {}\ncurve.torque_n_m = {}\ncompression_ratio = {}\npressure_scale = {}\npressure_scale_over_speed = {}\n\
             inlet_pressure_bar = {}\nheat_capacity_ratio = {}\n",
            list(m.speeds_rpm.iter().copied()),
            list(m.brake_torque.iter().copied()),
            m.compression_ratio,
            m.pressure_scale,
            list(m.scale_over_speed.iter().copied()),
            m.inlet_pressure / PA_PER_BAR,
            m.heat_capacity_ratio
        ),
        Pressure::Wiebe(m) => format!(
            "[pressure.wiebe]\nspeed_rpm = {}\nindicated_mean_pressure_bar = {}\nboost_bar = {}\ncompression_ratio = {}\nburn_start_deg = {}\n\
             burn_duration_deg = {}\nwiebe_exponent = {}\nheat_capacity_ratio = {}\n",
            list(m.speeds_rpm.iter().copied()),
            list(m.indicated_mean_pressure.iter().map(|p| p / PA_PER_BAR)),
            m.boost_pressure / PA_PER_BAR,
            m.compression_ratio,
            m.burn_start_deg,
            m.burn_duration_deg,
            m.shape,
            m.heat_capacity_ratio
        ),
        Pressure::Measured(_) => format!("[pressure.measured]\nfile = {}\n", quoted(file)),
    }
}

/// Traces as they were read.
fn traces(measured: &Measured) -> String {
    let mut text = "crank_deg".to_owned();
    let mut columns: Vec<&Vec<f64>> = Vec::new();
    for (speed, trace) in measured.speeds_rpm.iter().zip(&measured.pressure) {
        _ = write!(text, ",{speed}_rpm_bar");
        columns.push(trace);
    }
    for part in &measured.part_load {
        for (speed, trace) in measured.speeds_rpm.iter().zip(&part.pressure) {
            // shares were read as per cent
            _ = write!(text, ",{speed}_rpm_{}_percent_bar", (1e8 * part.load).round() / 1e6);
            columns.push(trace);
        }
    }
    for (i, angle) in measured.crank_deg.iter().enumerate() {
        _ = write!(text, "\n{angle}");
        columns.iter().for_each(|c| _ = write!(text, ",{}", c[i] / PA_PER_BAR));
    }
    text + "\n"
}

fn crank(study: &SizingStudy, s: &Sizes) -> String {
    let spec = &study.specification;
    let mm = |x: f64| x / M_PER_MM;
    let journal: f64 = bodies::journal_lengths(s, &spec.bearings).iter().sum();
    let mut text =
        format!("\n[crank]\npitch_mm.all = {}\njournal_length_mm.all = {}\n", mm(spec.bearings.before + spec.bearings.after), mm(journal));
    let values = [
        ("crankpin_diameter_mm", s.crankpin_diameter),
        ("crankpin_length_mm", s.crankpin_length),
        ("crankpin_fillet_mm", spec.fillet_radius),
        ("journal_diameter_mm", s.journal_diameter),
        ("journal_fillet_mm", spec.fillet_radius),
        ("web_thickness_mm", s.web_thickness),
        ("web_breadth_mm", s.web_breadth),
    ];
    values.iter().for_each(|(key, value)| _ = writeln!(text, "{key} = {}", mm(*value)));
    let radius = spec.crank_radius();
    _ = writeln!(
        text,
        "stiffness_formula = {}\nmasses = {{ density_kg_m3 = {}, web_height_mm = {}, web_centre_mm = {} }}",
        quoted(study.chain.formula.name()),
        spec.density,
        mm(bodies::web_height(s, radius)),
        mm(0.5 * radius)
    );
    text
}

fn chain(study: &SizingStudy, s: &Sizes) -> String {
    let (spec, chain) = (&study.specification, &study.chain);
    let shaft = |diameter: f64, length: f64| {
        format!("shaft_to_next = [{{ diameter_mm = {}, length_mm = {} }}]\n", diameter / M_PER_MM, length / M_PER_MM)
    };
    let mut text = format!("\n[damping]\nfraction_of_critical = {}\n", chain.fraction_of_critical);
    _ = write!(
        text,
        "\n[[station]]\nname = \"pulley\"\ninertia_kg_m2 = {}\n{}",
        chain.pulley_inertia,
        shaft(s.journal_diameter, chain.pulley_distance)
    );
    let throws = spec.firing_deg.len();
    for throw in 1..=throws {
        _ = write!(text, "\n[[station]]\nname = \"throw_{throw}\"\nthrows = [{throw}]\n");
        if throw == throws {
            text += &shaft(s.seat_diameter, spec.bearings.before_flywheel);
        }
    }
    _ = write!(text, "\n[[station]]\nname = \"flywheel\"\ninertia_kg_m2 = {}\n", chain.flywheel_inertia);
    text
}

/// Study: the engine without absorber, and the best one of a type and ring.
pub(super) fn study(study: &SizingStudy, absorber: Option<SizedAbsorber>) -> String {
    let speeds = &study.speeds_rpm;
    let mut text = format!(
        "# Written by `hartog size` from {}.toml.\nengine = \"engine.toml\"\nspeed_rpm = {{ from = {}, to = {}, step = {} }}\n\n[[design]]\nname = \"none\"\n",
        comment(&study.name),
        speeds[0],
        speeds[speeds.len() - 1],
        study.speed_step_rpm
    );
    if let Some(absorber) = absorber {
        _ = write!(
            text,
            "\n[optimise]\n[[optimise.absorber]]\non.station = \"pulley\"\ntypes = [{}]\nsize.ring_inertia_kg_m2.fixed = {}\n",
            quoted(absorber.kind.name),
            absorber.ring_inertia
        );
    }
    text
}
