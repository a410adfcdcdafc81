//! Random studies and engine files by the grammar of the input: most of them valid, some with one mistake or more.

use rand::Rng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::fmt::Write;

/// A study, its engine, and the tables that they name.
#[derive(Debug, Clone)]
pub struct Written {
    pub study: String,
    pub engine: String,
    pub tables: Vec<(&'static str, String)>,
}

struct Grammar<'r> {
    random: &'r mut Xoshiro256PlusPlus,
}

impl Grammar<'_> {
    /// Equal ratios are equally likely.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let value = low * (high / low).powf(self.random.random());
        // as people write numbers
        format!("{value:.3e}").parse().expect("a number")
    }

    fn one_in(&mut self, n: u32) -> bool {
        self.random.random_range(0..n) == 0
    }

    fn of<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.random.random_range(0..list.len())]
    }

    fn shuffled(&mut self, count: usize) -> Vec<usize> {
        let mut list: Vec<usize> = (1..=count).collect();
        for i in (1..count).rev() {
            list.swap(i, self.random.random_range(0..=i));
        }
        list
    }

    /// Angles of firings, evenly spaced or (in line) not, and who fires.
    fn layout(&mut self, cylinders: usize, cycle: f64) -> String {
        let even = cycle / cylinders as f64;
        let mut angles: Vec<f64> = (0..cylinders).map(|i| even * i as f64).collect();
        if cylinders.is_multiple_of(2) && even <= 180.0 && self.one_in(3) {
            // cylinders of a throw fire one after the other
            let order: Vec<usize> = self.shuffled(cylinders / 2).into_iter().flat_map(|t| [2 * t - 1, 2 * t]).collect();
            return format!("[layout.v]\nbank_angle_deg = {even}\nfiring_order = {order:?}\nfiring_deg = {angles:?}\n");
        }
        if self.one_in(4) {
            for angle in angles.iter_mut().skip(1) {
                *angle = (*angle + self.random.random_range(-20.0..20.0f64).round()).max(0.0);
            }
            angles.sort_by(f64::total_cmp);
        }
        format!("[layout.in_line]\nfiring_order = {:?}\nfiring_deg = {angles:?}\n", self.shuffled(cylinders))
    }

    fn pressure(&mut self, strokes: u32, tables: &mut Vec<(&'static str, String)>) -> (String, bool) {
        let mean = self.between(2.0, 25.0);
        match self.random.random_range(0..4) {
            0 => {
                let mut table = String::from("order,amplitude_n_m,phase_deg\n");
                for twice in 1..=self.random.random_range(1..12) {
                    let order = f64::from(twice) * if strokes == 4 { 0.5 } else { 1.0 };
                    let _ = writeln!(table, "{order},{},{}", self.between(0.1, 1e3), self.random.random_range(-180..180));
                }
                tables.push(("harmonics.csv", table));
                ("[pressure.harmonics]\nfile = \"harmonics.csv\"\n".into(), false)
            }
            1 => {
                let mut table = String::from("crank_deg,300_rpm_bar,4000_rpm_bar\n");
                let cycle = 180 * strokes;
                for degree in (0..=cycle).step_by(10) {
                    let from_firing = f64::from(if degree > cycle / 2 { cycle - degree } else { degree });
                    let shape = (-from_firing / 40.0).exp();
                    let _ = writeln!(table, "{degree},{:.4},{:.4}", 1.0 + 4.0 * mean * shape, 1.0 + 3.5 * mean * shape);
                }
                tables.push(("pressure.csv", table));
                ("[pressure.measured]\nfile = \"pressure.csv\"\n".into(), true)
            }
            2 if strokes == 4 => {
                let ratio = self.between(6.0, 20.0);
                let scale = self.between(0.5, 1.5);
                let torque = self.between(20.0, 500.0);
                (
                    format!(
                        "[pressure.otto]\nspeed_rpm = [300, 4000]\ncurve.torque_n_m = [{torque}, {torque}]\ncompression_ratio = {ratio}\n\
                         pressure_scale = {scale}\n"
                    ),
                    true,
                )
            }
            _ => {
                let (boost, ratio) = (self.between(0.8, 3.0), self.between(8.0, 20.0));
                (
                    format!(
                        "[pressure.wiebe]\nspeed_rpm = [300, 4000]\nindicated_mean_pressure_bar = [{mean}, {mean}]\nboost_bar = {boost}\n\
                         compression_ratio = {ratio}\nburn_start_deg = -8\nburn_duration_deg = 60\n"
                    ),
                    true,
                )
            }
        }
    }

    /// Engine file, names of its stations, tables.
    fn engine(&mut self) -> (String, Vec<String>, Vec<(&'static str, String)>) {
        let strokes = if self.one_in(4) { 2 } else { 4 };
        let cylinders = if self.one_in(10) { self.random.random_range(4..=6) } else { self.random.random_range(1..=3) };
        let mut tables = Vec::new();
        let (pressure, geometry) = self.pressure(strokes, &mut tables);
        let mut text = format!("name = \"generated\"\nstrokes = {strokes}\n");
        if geometry {
            let radius = self.between(20.0, 200.0);
            let reciprocating = self.of(&["none", "mean", "none"]);
            if reciprocating != "none" {
                let _ = writeln!(text, "reciprocating_inertia = \"{reciprocating}\"");
            }
            let (bore, rod) = (self.between(40.0, 400.0), self.between(2.5, 5.0));
            let _ = write!(
                text,
                "[geometry]\nbore_mm = {bore}\ncrank_radius_mm = {radius}\nrod_length_mm = {:.3}\npiston_mass_kg = {}\nrod_mass_kg = {}\n\
                 rod_rotating_fraction = 0.667\n",
                rod * radius,
                self.between(0.1, 20.0),
                self.between(0.1, 20.0),
            );
        }
        text += &self.layout(cylinders, f64::from(180 * strokes));
        text += &pressure;
        let throws = if text.contains("layout.v") { cylinders / 2 } else { cylinders };
        // throws may share a station
        let shared = self.one_in(3);
        let mut names = Vec::new();
        let mut stations: Vec<(String, Vec<usize>)> = Vec::new();
        if self.random.random() {
            stations.push(("pulley".into(), Vec::new()));
        }
        if shared {
            stations.push(("crank".into(), (1..=throws).collect()));
        } else {
            stations.extend((1..=throws).map(|t| (format!("throw_{t}"), vec![t])));
        }
        stations.push(("flywheel".into(), Vec::new()));
        if self.one_in(3) {
            stations.push(("load".into(), Vec::new()));
        }
        let last = stations.len() - 1;
        for (i, (name, throws)) in stations.into_iter().enumerate() {
            let inertia = if i == last { self.between(0.1, 10.0) } else { self.between(0.003, 0.3) };
            let _ = write!(text, "\n[[station]]\nname = \"{name}\"\ninertia_kg_m2 = {inertia}\n");
            if !throws.is_empty() {
                let _ = writeln!(text, "throws = {throws:?}");
                if !self.one_in(8) {
                    let _ = writeln!(text, "damping_to_ground_n_m_s_per_rad = {}", self.between(0.1, 30.0));
                }
            }
            if i < last {
                let _ = writeln!(text, "stiffness_to_next_n_m_per_rad = {}", self.between(1e4, 3e6));
                match self.random.random_range(0..6) {
                    0 => drop(writeln!(text, "damping_to_next_n_m_s_per_rad = {}", self.between(0.1, 100.0))),
                    1 => drop(writeln!(text, "loss_factor_to_next = {}", self.between(1e-3, 0.1))),
                    _ => {}
                }
            }
            names.push(name);
        }
        (text, names, tables)
    }

    /// An absorber type with its values.
    fn law(&mut self) -> String {
        let ring = self.between(0.001, 0.2);
        let (k, c) = (self.between(1e2, 1e6), self.between(0.1, 300.0));
        let ring = format!("ring_inertia_kg_m2 = {ring}");
        match self.random.random_range(0..15) {
            0 => format!("viscous = {{ {ring}, damping_n_m_s_per_rad = {c} }}"),
            1 => format!("undamped = {{ {ring}, stiffness_n_m_per_rad = {k} }}"),
            2 => format!("rubber = {{ {ring}, stiffness_n_m_per_rad = {k}, loss_factor = {} }}", self.between(0.02, 1.0)),
            3 => format!(
                "fractional_kelvin = {{ {ring}, stiffness_n_m_per_rad = {k}, relaxation_time_s = {}, fractional_exponent = {} }}",
                self.between(1e-6, 1e-2),
                self.between(0.1, 0.9)
            ),
            4 => format!(
                "fractional_zener = {{ {ring}, stiffness_n_m_per_rad = {k}, glass_ratio = {}, relaxation_time_s = {}, fractional_exponent = {} }}",
                self.between(2.0, 1e3),
                self.between(1e-9, 1e-2),
                self.between(0.1, 0.9)
            ),
            5 => format!("maxwell = {{ {ring}, damping_n_m_s_per_rad = {c}, relaxation_time_s = {} }}", self.between(1e-5, 0.1)),
            6 => format!(
                "carreau = {{ {ring}, damping_n_m_s_per_rad = {c}, relaxation_time_s = {}, transition_exponent = 0.8, flow_index = {} }}",
                self.between(1e-5, 0.1),
                self.between(0.2, 0.9)
            ),
            7 => format!(
                "spring_pack = {{ {ring}, stiffness_n_m_per_rad = {k}, damping_factor = {}, dynamic_ratio = {}, reference_frequency_hz = 150 }}",
                self.between(0.05, 0.6),
                self.between(1.1, 3.0)
            ),
            8 => format!(
                "pendulum = {{ {ring}, tuning_order = {}, damping_n_m_s_per_rad = {} }}",
                self.between(0.5, 9.0),
                self.between(0.01, 3.0)
            ),
            9 => format!("seeded = {{ by = \"{}\", {ring} }}", self.of(&["den_hartog_brock", "h_infinity", "brock_unity"])),
            _ => format!("tuned = {{ {ring}, stiffness_n_m_per_rad = {k}, damping_n_m_s_per_rad = {c} }}"),
        }
    }

    fn objective(&mut self, stations: &[String]) -> String {
        let from = &stations[self.random.random_range(0..stations.len() - 1)];
        let over = self.of(&["", ", over = \"orders\"", ", over = \"synthesis\"", ""]);
        match self.random.random_range(0..6) {
            0 => format!("hub_amplitude = {{ station = \"{from}\"{over} }}"),
            1 => "vibratory_torque = {}".into(),
            2 if self.one_in(2) => format!("velocity = {{ station = \"{from}\", over = \"rms\" }}"),
            2 => format!("acceleration = {{ station = \"{from}\" }}"),
            _ => format!("peak_twist = {{ from = \"{from}\", to = \"{}\"{over} }}", stations[stations.len() - 1]),
        }
    }

    fn study(&mut self, stations: &[String]) -> String {
        let low = self.random.random_range(4..15) * 100;
        let high = low + self.random.random_range(2..20) * 100;
        let step = (high - low) / self.random.random_range(1..=5);
        let mut text = format!(
            "engine = \"engine.toml\"\nspeed_rpm = {{ from = {low}, to = {high}, step = {step} }}\norder_limit = {}\n",
            self.random.random_range(1..=4)
        );
        if self.one_in(20) {
            text += "conditions = [\"firing\", \"absorber_locked\", \"absorber_lost\"]\n";
        } else if self.one_in(30) {
            text += "conditions = [\"firing\", \"misfire\"]\n";
        }
        let on = stations[self.random.random_range(0..stations.len())].clone();
        for i in 0..self.random.random_range(0..3) {
            let law = self.law();
            let _ = write!(text, "[[design]]\nname = \"design_{i}\"\n[[design.absorber]]\non.station = \"{on}\"\ntype.{law}\n");
        }
        let _ = write!(text, "[[objective]]\n{}\n", self.objective(stations));
        if self.one_in(20) {
            let _ = write!(text, "[[constraint]]\ndissipated_power = {{ max_w = {} }}\n", self.between(1.0, 1e4));
        }
        if self.one_in(40) {
            let _ = write!(text, "[[constraint]]\nvibratory_torque = {{ max_n_m = {} }}\n", self.between(10.0, 1e5));
        }
        if self.one_in(4) {
            return text;
        }
        let types = match self.random.random_range(0..10) {
            0 => "\"viscous\"",
            1 => "\"tuned\", \"viscous\"",
            2 => "\"rubber\"",
            3 => "\"maxwell\"",
            _ => "\"tuned\"",
        };
        let _ = write!(
            text,
            "[response]\nmethod = \"{}\"\nrefine_peaks = {}\n[optimise]\nrandom_starts = {}\n[[optimise.absorber]]\non.station = \"{on}\"\ntypes = [{types}]\n",
            self.of(&["receptance", "direct", "auto"]),
            self.one_in(6),
            u8::from(self.one_in(4))
        );
        let ring = self.between(0.001, 0.2);
        text += &match self.random.random_range(0..10) {
            0 => format!("size.ring_inertia_kg_m2.between = [{ring}, {}]\n", 3.0 * ring),
            1 => format!("size.ring_inertia_kg_m2.each = [{}, {ring}]\n", 2.0 * ring),
            _ => format!("size.ring_inertia_kg_m2.fixed = {ring}\n"),
        };
        if types.contains("rubber") {
            text += "loss_factor.between = [0.05, 0.3]\n";
        }
        if types.contains("maxwell") {
            text += "relaxation_time_s.between = [1e-4, 1e-2]\n";
        }
        if self.one_in(40) && !types.contains(',') {
            let _ = write!(
                text,
                "[pareto]\npoints = {}\nagainst.ring_inertia_kg_m2 = [{ring}, {}]\n",
                self.random.random_range(2..5),
                4.0 * ring
            );
        }
        if self.one_in(40) && types == "\"tuned\"" {
            text += "[robust]\ntolerance = { stiffness_n_m_per_rad = 0.1 }\n";
        }
        text
    }

    /// A mistake, as hands and programs make them.
    fn mistake(&mut self, text: &mut String) {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let i = self.random.random_range(0..lines.len());
        match self.random.random_range(0..8) {
            0 => drop(lines.remove(i)),
            1 => lines.insert(i, lines[i].clone()),
            2 => lines.swap(i, 0),
            3 => lines.insert(i, "unknown_key = 3".into()),
            4 => lines[i] = lines[i].chars().take(lines[i].chars().count() / 2).collect(),
            _ => {
                let odd = [
                    "0",
                    "-1",
                    "nan",
                    "inf",
                    "-inf",
                    "1e308",
                    "1e-308",
                    "\"text\"",
                    "[]",
                    "{}",
                    "true",
                    "99999999999999999999",
                    "-0.0",
                    "3,5",
                ];
                let value = self.of(&odd.map(|o| o));
                lines[i] = replace_number(&lines[i], value, self.random.random_range(0..4));
            }
        }
        *text = lines.join("\n") + "\n";
    }
}

/// The n-th number of a line (the last, where there are fewer) replaced.
fn replace_number(line: &str, by: &str, n: usize) -> String {
    let mut numbers: Vec<(usize, usize)> = Vec::new();
    let mut start = None;
    for (i, c) in line.char_indices().chain([(line.len(), '\n')]) {
        let part = c.is_ascii_digit() || (start.is_some() && (c == '.' || c == 'e' || c == '-'));
        match (start, part) {
            (None, true) if !line[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_') => start = Some(i),
            (Some(from), false) => {
                numbers.push((from, i));
                start = None;
            }
            _ => {}
        }
    }
    let Some((from, to)) = numbers.get(n).or(numbers.last()) else { return format!("{line} {by}") };
    format!("{}{by}{}", &line[..*from], &line[*to..])
}

/// A random input; one in four with mistakes.
pub fn written(random: &mut Xoshiro256PlusPlus) -> Written {
    let mut grammar = Grammar { random };
    let (mut engine, stations, mut tables) = grammar.engine();
    let mut study = grammar.study(&stations);
    if grammar.one_in(4) {
        for _ in 0..grammar.random.random_range(1..3) {
            match grammar.random.random_range(0..5) {
                0 if !tables.is_empty() => grammar.mistake(&mut tables[0].1),
                0..=2 => grammar.mistake(&mut engine),
                _ => grammar.mistake(&mut study),
            }
        }
    }
    Written { study, engine, tables }
}
