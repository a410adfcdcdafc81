//! A study and an engine to begin with: every value is an example, to be replaced by those of an own engine.

mod kinds;
mod placeholders;
mod stations;

use crate::input::{FoundStation, FoundTraces};
pub use kinds::{Arrangement, Example, Gas};
use stations::PULLEY;
use std::fmt::Write;

/// Name and text of each file.
#[doc(hidden)]
pub type Files = Vec<(&'static str, String)>;

/// Bore, crank radius and rod length, mm.
const BORE: f64 = 95.0;
const RADIUS: f64 = 50.0;
const ROD: f64 = 160.0;
/// Compression ratio of the measured example, exponent of its compression, pressure at its beginning, bar, and by how much burning raises it.
const RATIO: f64 = 16.0;
const EXPONENT: f64 = 1.33;
const INTAKE: f64 = 1.5;
const RISE: f64 = 1.6;

/// Firing order of cylinders (or throws) in line.
fn order(count: usize) -> Vec<usize> {
    match count {
        3 => vec![1, 3, 2],
        4 => vec![1, 3, 4, 2],
        5 => vec![1, 2, 4, 5, 3],
        6 => vec![1, 5, 3, 6, 2, 4],
        8 => vec![1, 6, 2, 5, 8, 3, 7, 4],
        n => (1..=n).collect(),
    }
}

impl Example {
    /// Its files.
    pub fn files(&self) -> Files {
        let mut files = vec![("study.toml", self.study()), ("engine.toml", self.engine())];
        match self.gas {
            Gas::Measured => files.push(("pressure.csv", self.traces.as_ref().map_or_else(pressure, measured))),
            Gas::Harmonics => files.push(("harmonics.csv", harmonics())),
            Gas::Wiebe | Gas::Otto => {}
        }
        files
    }

    fn throws(&self) -> usize {
        if self.arrangement == Arrangement::V { self.cylinders / 2 } else { self.cylinders }
    }

    /// A ring of three times the pulley, tuned low as optima of such engines are.
    fn study(&self) -> String {
        let hub = self.chain.as_ref().map_or(PULLEY, |c| c.stations[0].inertia);
        let ring = 3.0 * hub;
        // several traces say where the pressure is known
        let speeds = self.traces.iter().flat_map(|t| &t.traces).map(|t| t.0);
        let (low, high) = match &self.traces {
            Some(t) if t.traces.len() > 1 => (speeds.clone().fold(f64::INFINITY, f64::min), speeds.fold(0.0, f64::max)),
            _ => (800.0, 4000.0),
        };
        let values = [
            ("@LOW@", low),
            ("@HIGH@", high),
            ("@RING@", ring),
            ("@LEAST_RING@", ring / 5.0),
            ("@MOST_RING@", 3.0 * ring),
            ("@STIFFNESS@", 1e6 * ring),
            ("@DAMPING@", ring / 3e-3),
        ];
        let text = values.iter().fold(include_str!("study.toml").to_owned(), |text, (key, value)| {
            text.replace(key, &format!("{}", (value * 1e6f64).round() / 1e6))
        });
        let (first, last) = self
            .chain
            .as_ref()
            .map_or(("pulley".into(), "flywheel".into()), |c| (c.stations[0].name.clone(), behind_throws(c).name.clone()));
        // of an engine of one's own no absorber is known
        let optional = if self.chain.is_some() { "# " } else { "" };
        let text = text.replace("@PLACEHOLDER@\n", &placeholders::list(&self.assumed_in_study()));
        text.replace("@OPTIONAL@", optional).replace("@FIRST@", &stations::quoted(&first)).replace("@LAST@", &stations::quoted(&last))
    }

    fn layout(&self) -> String {
        let even = 720.0 / self.cylinders as f64;
        let angles: Vec<f64> = (0..self.cylinders).map(|i| (even * i as f64 * 1e6).round() / 1e6).collect();
        match self.arrangement {
            // evenly spaced firings would need a bank angle of a whole turn
            Arrangement::V if self.cylinders == 2 => {
                "[layout.v]\nbank_angle_deg = 90\nfiring_order = [1, 2]\nfiring_deg = [0, 450]\n".into()
            }
            Arrangement::InLine => format!("[layout.in_line]\nfiring_order = {:?}\nfiring_deg = {angles:?}\n", order(self.cylinders)),
            Arrangement::V => {
                let pairs: Vec<usize> = order(self.throws()).into_iter().flat_map(|t| [2 * t - 1, 2 * t]).collect();
                format!(
                    "[layout.v]                       # cylinders 2t-1 and 2t on throw t\nbank_angle_deg = {even}\nfiring_order = {pairs:?}\nfiring_deg = {angles:?}\n"
                )
            }
        }
    }

    /// What of the study is to be confirmed: its speeds where no traces tell them, the absorber that is given, and the ring that is asked for.
    fn assumed_in_study(&self) -> Vec<&'static str> {
        let speeds = self.traces.as_ref().is_none_or(|t| t.traces.len() < 2).then_some("speed_rpm");
        let given = self.chain.is_none().then_some("design.absorber");
        speeds.into_iter().chain(given).chain(["optimise.absorber.size"]).collect()
    }

    /// What of the engine is to be confirmed: all that was not imported.
    fn assumed_in_engine(&self) -> Vec<&'static str> {
        let cylinder = if self.gas == Gas::Harmonics { &[] } else { placeholders::CYLINDER };
        let layout = if self.arrangement == Arrangement::V { placeholders::V } else { placeholders::IN_LINE };
        let gas = match (self.gas, &self.traces) {
            (Gas::Wiebe, _) => placeholders::WIEBE,
            (Gas::Otto, _) => placeholders::OTTO,
            (Gas::Measured, Some(_)) => &[],
            (Gas::Measured, None) => &["pressure.measured.file"],
            (Gas::Harmonics, _) => &["pressure.harmonics.file"],
        };
        let chain: &[&str] = match &self.chain {
            None => &["station"],
            Some(_) if self.assumes_damping() => &["damping.dynamic_magnifier"],
            Some(_) => &[],
        };
        ["strokes"].iter().chain(cylinder).chain(layout).chain(gas).chain(chain).copied().collect()
    }

    /// Whether the chain was imported without damping, so that some is assumed.
    fn assumes_damping(&self) -> bool {
        let damps = |s: &FoundStation| s.damping_to_ground > 0.0 || s.damping_to_next > 0.0 || s.loss_factor_to_next > 0.0;
        self.chain.as_ref().is_some_and(|chain| !chain.stations.iter().any(damps))
    }

    fn engine(&self) -> String {
        let gas = match self.gas {
            Gas::Wiebe => {
                "[pressure.wiebe]                 # also otto, measured, harmonics\nspeed_rpm = [600, 4000]\nindicated_mean_pressure_bar = [12, 12]\nboost_bar = 1.5                  # absolute\n\
                 compression_ratio = 16\nburn_start_deg = -7              # from firing dead centre\nburn_duration_deg = 60\n"
            }
            Gas::Otto => {
                "[pressure.otto]                  # also wiebe, measured, harmonics\nspeed_rpm = [600, 4000]\ncurve.torque_n_m = [300, 300]    # at the flywheel; or curve.power_kw\n\
                 compression_ratio = 11\npressure_scale = 1.15            # cycle over brake mean pressure\n"
            }
            Gas::Measured => {
                "[pressure.measured]              # bar, absolute, over the whole cycle from firing dead centre: crank_deg and a column a speed, 2000_rpm_bar\nfile = \"pressure.csv\"\n"
            }
            Gas::Harmonics => {
                "[pressure.harmonics]             # torque of a throw, whole: no inertia is added\nfile = \"harmonics.csv\"\n"
            }
        };
        let geometry = format!(
            "\n[geometry]\nbore_mm = {BORE}\ncrank_radius_mm = {RADIUS}             # half the stroke\nrod_length_mm = {ROD}\npiston_mass_kg = 0.9\nrod_mass_kg = 1.1\n\
             rod_rotating_fraction = 0.667    # the rest moves with the piston\n"
        );
        let mut text = String::from(
            "# An engine with its torsional chain. Every value is an example: replace it by your own; `hartog keys` tells of all keys.\nname = \"own engine\"\nstrokes = 4\n",
        );
        text += &placeholders::list(&self.assumed_in_engine());
        if self.gas != Gas::Harmonics {
            text += match self.chain {
                None => "reciprocating_inertia = \"mean\"   # the inertias below hold rotating parts only; \"none\": they hold all\n",
                Some(_) => {
                    "reciprocating_inertia = \"none\"   # assumption of the import: the inertias below hold the reciprocating masses; \"mean\" adds them\n"
                }
            };
            text += &geometry;
        }
        let _ = write!(text, "\n{}\n{gas}", self.layout());
        text += match &self.chain {
            Some(_) if self.assumes_damping() => {
                "\n[damping]                        # of the whole chain: an assumption, as what was imported says nothing of it\ndynamic_magnifier = 25           # of every shaft: its loss factor is 1/25\n"
            }
            _ => {
                "\n# [damping]                      # of the whole chain, instead of that of the stations below\n# fraction_of_critical = 0.02    # of the first mode\n"
            }
        };
        text + &self.chain.as_ref().map_or_else(|| stations::sample(self.throws()), stations::found)
    }
}

/// The station behind the last throw, as a rule the flywheel: the twist up to it is that of the crank, and not of what is coupled to it.
fn behind_throws(chain: &crate::input::FoundChain) -> &FoundStation {
    let last = chain.stations.len() - 1;
    let throw = chain.stations.iter().rposition(|s| !s.throws.is_empty()).unwrap_or(last);
    &chain.stations[(throw + 1).min(last)]
}

/// Compression and expansion with a rise at dead centre, twice: 800 and 4000 rpm.
fn pressure() -> String {
    use crate::numerics::elementary::Elementary;
    let clearance = 2.0 * RADIUS / (RATIO - 1.0);
    let volume = |deg: f64| {
        let angle = deg.to_radians();
        let rod = (ROD * ROD - (RADIUS * angle.sine()).powi(2)).sqrt();
        clearance + RADIUS * (1.0 - angle.cosine()) + ROD - rod
    };
    let whole = volume(180.0);
    let mut text = String::from("# an example: replace it by a measurement\ncrank_deg,800_rpm_bar,4000_rpm_bar\n");
    for deg in 0..=720 {
        let turned = f64::from(deg);
        let closed = INTAKE * (whole / volume(turned)).power(EXPONENT);
        // burning within 40 degrees of dead centre, then expansion; gas exchange between 180 and 540
        let burnt = |rise: f64| match deg {
            0..180 => closed * (1.0 + rise * (turned / 20.0).min(1.0)),
            180..540 => INTAKE,
            _ => closed,
        };
        let _ = writeln!(text, "{deg},{:.4},{:.4}", burnt(RISE), burnt(0.9 * RISE));
    }
    text
}

/// Traces as they were imported.
fn measured(found: &FoundTraces) -> String {
    let heads: Vec<String> = found.traces.iter().map(|t| format!("{}_rpm_bar", t.0)).collect();
    let mut text = format!("crank_deg,{}\n", heads.join(","));
    for (i, angle) in found.angles.iter().enumerate() {
        let cells: Vec<String> = found.traces.iter().map(|t| t.1[i].to_string()).collect();
        let _ = writeln!(text, "{angle},{}", cells.join(","));
    }
    text
}

fn harmonics() -> String {
    let rows: Vec<String> = (1..=12).map(|i| format!("{},{:.1},{}", 0.5 * f64::from(i), 300.0 / f64::from(i), (37 * i) % 360)).collect();
    format!("# an example: replace it by your own\norder,amplitude_n_m,phase_deg\n{}\n", rows.join("\n"))
}
