//! Tables and `results.json` as other programs read them.

use crate::support::assert_close;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

pub fn hartog(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_hartog")).current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().expect("runs")
}

/// Rows of a table by the names of its columns.
pub fn rows(folder: &Path, name: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.join(name)).expect("a table");
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

fn value(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// One quantity at one speed: order, amplitude and phase (rad) of each order, and half the peak-to-peak of all.
#[derive(Default)]
struct Group {
    orders: Vec<[f64; 3]>,
    total: f64,
}

/// With `every_station` each order of the torque of a shaft is its stiffness times the difference of the angles of its ends, as phasors: the chain has no damping in its shafts.
///
/// Tolerance: seven digits of amplitudes and 1e-4 degrees of phases, of angles that nearly cancel where the chain rolls as one.
#[test]
fn every_station_and_shaft_on_request() {
    let folder = tempfile::tempdir().expect("folder");
    let own = folder.path().join("own").to_string_lossy().into_owned();
    assert!(hartog(&["new", &own]).status.success());
    let text = std::fs::read_to_string(format!("{own}/study.toml")).expect("a study");
    // what is left out has no values to confirm
    let text = text.replace("  \"optimise.absorber.size\",\n", "");
    let text = text.split("[optimise]").next().expect("a study").replace("step = 20", "step = 400") + "[response]\nevery_station = true\n";
    std::fs::write(format!("{own}/study.toml"), text).expect("written");
    assert!(hartog(&["run", &format!("{own}/study.toml"), "--quiet", "--out", &format!("{own}/out")]).status.success());
    let mut phasors: BTreeMap<[String; 4], [f64; 2]> = BTreeMap::new();
    for row in
        rows(folder.path().join("own/out").as_path(), "response.csv").iter().filter(|r| r["kind"] == "order" && r["design"] == "none")
    {
        let phase = value(row, "phase_deg").to_radians();
        let of = value(row, "amplitude");
        let key = [&row["quantity"], &row["where"], &row["speed_rpm"], &row["order"]].map(Clone::clone);
        phasors.insert(key, [of * phase.cos(), of * phase.sin()]);
    }
    let chain = ["pulley", "throw_1", "throw_2", "throw_3", "throw_4", "flywheel"];
    let mut looked_at = 0;
    for (i, pair) in chain.windows(2).enumerate() {
        let stiffness = if i == 0 { 3e5 } else { 9e5 };
        let shaft = format!("{}-{}", pair[0], pair[1]);
        for ([.., speed, order], torque) in phasors.iter().filter(|p| p.0[0] == "torque" && p.0[1] == shaft) {
            let angle = |station: &str| phasors[&["amplitude".into(), station.to_owned(), speed.clone(), order.clone()]];
            let (a, b) = (angle(pair[0]), angle(pair[1]));
            let size = torque[0].hypot(torque[1]) + stiffness * (a[0].hypot(a[1]) + b[0].hypot(b[1])).to_radians();
            for part in 0..2 {
                let expected = stiffness * (a[part] - b[part]).to_radians();
                assert_close(torque[part], expected, 0.0, 3e-6 * size, &format!("{shaft} at {speed} rpm, order {order}"));
            }
            looked_at += 1;
        }
    }
    assert_eq!(looked_at, 5 * 24 * 9);
}

/// A column of Parquet has one type in the tables of all studies, whatever fills it, so that these can be put together; what is true or false is no text, and an empty column of numbers none either. The
/// metadata have the units.
#[test]
fn columns_have_one_type() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let mut types: BTreeMap<(String, String), parquet::basic::Type> = BTreeMap::new();
    let mut shared = 0;
    for study in ["den_hartog", "mendes_mwm6", "villalva_i6_life"] {
        let folder = tempfile::tempdir().expect("folder");
        let out = folder.path().join("out");
        let arguments = ["run", &format!("studies/{study}.toml"), "--quiet", "--format", "parquet", "--out", &out.to_string_lossy()];
        // a proof of the ring that lasts would take most of the time
        let more: &[&str] = if study == "villalva_i6_life" { &["--set", "optimise.prove={boxes=0}"] } else { &[] };
        assert!(hartog(&[&arguments, more].concat()).status.success());
        for path in std::fs::read_dir(&out).expect("a folder").map(|e| e.expect("an entry").path()) {
            if path.extension().is_none_or(|e| e != "parquet") {
                continue;
            }
            let table = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let reader = SerializedFileReader::new(std::fs::File::open(&path).expect("a file")).expect("parquet");
            for column in reader.metadata().file_metadata().schema_descr().columns() {
                let known = types.insert((table.clone(), column.name().to_owned()), column.physical_type());
                shared += usize::from(known.is_some());
                assert!(known.is_none_or(|k| k == column.physical_type()), "{study}: {table}, {}", column.name());
            }
            let units = reader.metadata().file_metadata().key_value_metadata().cloned().unwrap_or_default();
            let unit = |column: &str| units.iter().find(|u| u.key == format!("unit:{column}")).and_then(|u| u.value.clone());
            if table == "designs" {
                assert_eq!(unit("peak_twist_deg").as_deref(), Some("°"));
                assert_eq!(unit("stiffness_n_m_per_rad").as_deref(), Some("N m/rad"));
                assert_eq!(unit("design"), None);
            }
        }
    }
    assert!(shared > 40, "{shared}");
    let of = |table: &str, column: &str| types[&(table.to_owned(), column.to_owned())];
    assert_eq!(of("optima", "converged"), parquet::basic::Type::BOOLEAN);
    assert_eq!(of("optima", "starts"), parquet::basic::Type::INT64);
    assert_eq!(of("designs", "f3_hz"), parquet::basic::Type::DOUBLE);
    assert_eq!(of("designs", "design"), parquet::basic::Type::BYTE_ARRAY);
}

/// How many glyphs the page of a PDF shows.
fn shown(pdf: &[u8]) -> usize {
    let find = |from: usize, word: &[u8]| from + pdf[from..].windows(word.len()).position(|w| w == word).expect("a part of a PDF");
    let begin = find(find(0, b"\n4 0 obj"), b"stream\n") + 7;
    let mut content = String::new();
    let mut decoder = flate2::read::ZlibDecoder::new(&pdf[begin..find(begin, b"\nendstream")]);
    std::io::Read::read_to_string(&mut decoder, &mut content).expect("text");
    content.matches(" Tj\n").count()
}

/// Every table but that of times as Parquet holds what its CSV holds, numbers as numbers and empty cells as nulls; every plot is a page of PDF of its printed width, 170 mm, with its words as text; files do
/// not depend on the number of threads; a run that is not asked for them takes them away.
#[test]
fn parquet_and_pdf_stand_beside_tables_and_plots() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let folders = [tempfile::tempdir().expect("folder"), tempfile::tempdir().expect("folder")];
    let names = |folder: &Path, end: &str| -> Vec<String> {
        let all = std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned());
        let mut own: Vec<String> = all.filter_map(|n| n.strip_suffix(end).map(str::to_owned)).collect();
        own.sort();
        own
    };
    let run = |folder: &Path, more: &[&str]| {
        let out = folder.to_string_lossy().into_owned();
        let arguments = [&["run", "studies/den_hartog.toml", "--quiet", "--out", &out], more].concat();
        assert!(hartog(&arguments).status.success());
    };
    run(folders[0].path(), &["--format", "pdf,parquet", "--threads", "1"]);
    run(folders[1].path(), &["--format", "parquet", "--format", "pdf", "--threads", "8"]);
    let folder = folders[0].path();
    let (tables, plots) = (names(folder, ".parquet"), names(folder, ".pdf"));
    let csv: Vec<String> = names(folder, ".csv").into_iter().filter(|n| n != "timing").collect();
    assert_eq!((&tables, &plots), (&csv, &names(folder, ".svg")));
    assert!(tables.len() >= 4 && plots.len() >= 4, "{tables:?} {plots:?}");
    for name in tables.iter().map(|n| format!("{n}.parquet")).chain(plots.iter().map(|n| format!("{n}.pdf"))) {
        let [first, second] = [0, 1].map(|i| std::fs::read(folders[i].path().join(&name)).expect("a file"));
        assert!(first == second, "{name}");
    }
    let mut numbers = 0;
    for table in &tables {
        let file = std::fs::File::open(folder.join(format!("{table}.parquet"))).expect("a file");
        let reader = SerializedFileReader::new(file).expect("parquet");
        let own: Vec<_> = reader.get_row_iter(None).expect("rows").map(|r| r.expect("a row")).collect();
        let expected = rows(folder, &format!("{table}.csv"));
        assert_eq!(own.len(), expected.len(), "{table}");
        for (row, expected) in own.iter().zip(&expected) {
            for (head, field) in row.get_column_iter() {
                let cell = &expected[head];
                match field {
                    parquet::record::Field::Null => assert_eq!(cell, "", "{table} {head}"),
                    parquet::record::Field::Double(x) => {
                        assert_eq!(*x, cell.parse::<f64>().expect("a number"), "{table} {head}");
                        numbers += 1;
                    }
                    parquet::record::Field::Long(n) => assert_eq!(*n, cell.parse::<i64>().expect("a whole number"), "{table} {head}"),
                    parquet::record::Field::Bool(b) => assert_eq!(b.to_string(), *cell, "{table} {head}"),
                    parquet::record::Field::Str(text) => assert_eq!(text, cell, "{table} {head}"),
                    other => panic!("{table} {head}: {other}"),
                }
            }
        }
    }
    assert!(numbers > 1000, "{numbers}");
    for plot in &plots {
        let bytes = std::fs::read(folder.join(format!("{plot}.pdf"))).expect("a file");
        let text = String::from_utf8_lossy(&bytes);
        let width = text.split("/MediaBox [0 0 ").nth(1).and_then(|t| t.split(' ').next()).and_then(|w| w.parse::<f64>().ok());
        assert!(bytes.starts_with(b"%PDF-") && text.contains("/Type /Font"), "{plot}: no page of PDF with text");
        assert_close(width.expect("a page"), 170.0 / 25.4 * 72.0, 1e-3, 0.0, plot);
        // a glyph for every character of the picture's words
        let svg = std::fs::read_to_string(folder.join(format!("{plot}.svg"))).expect("a picture");
        let words = svg.split("<text").skip(1).map(|t| t.split_once('>').expect("a tag").1.split("</text>").next().expect("words").trim());
        let characters: usize = words
            .map(|w| {
                // the font has one glyph for these letters
                let plain = w.replace("&lt;", "<").replace("&gt;", ">").replace("&apos;", "'").replace("&amp;", "&");
                plain.replace("ffi", "*").replace("ff", "*").replace("fi", "*").replace("fl", "*").chars().count()
            })
            .sum();
        assert_eq!(shown(&bytes), characters, "{plot}");
    }
    run(folder, &[]);
    assert_eq!((names(folder, ".parquet").len(), names(folder, ".pdf").len()), (0, 0));
}

/// Amplitudes and phases of `response.csv` are those of a cos(n theta + phi): added up over a cycle, they have the half peak-to-peak of their row of totals.
///
/// Tolerance: phases are given to 1e-4 degrees (2e-6 rad) and sums are sampled 4000 times in two turns: (12 x 2 pi x 2 / 4000)²/8 of the highest order.
#[test]
fn orders_of_response_csv_add_up_to_its_totals() {
    let folder = tempfile::tempdir().expect("folder");
    assert!(hartog(&["run", "studies/mendes_mwm6.toml", "--quiet", "--out", &folder.path().to_string_lossy()]).status.success());
    let mut groups: BTreeMap<[String; 4], Group> = BTreeMap::new();
    let designs: Vec<String> = rows(folder.path(), "designs.csv").iter().map(|r| r["design"].clone()).collect();
    for row in rows(folder.path(), "response.csv").iter().filter(|r| r["design"] == designs[0] && value(r, "speed_rpm") % 250.0 == 0.0) {
        let group = groups.entry([&row["quantity"], &row["condition"], &row["where"], &row["speed_rpm"]].map(Clone::clone)).or_default();
        if row["kind"] == "order" {
            group.orders.push([value(row, "order"), value(row, "amplitude"), value(row, "phase_deg").to_radians()]);
        } else {
            assert_eq!((row["order"].as_str(), row["phase_deg"].as_str()), ("", ""));
            group.total = value(row, "amplitude");
        }
    }
    let mut looked_at = 0;
    for ([quantity, ..], Group { orders, total }) in groups.iter().filter(|g| !g.1.orders.is_empty()) {
        let at = |i: i32| {
            let theta = f64::from(i) / 4000.0 * 4.0 * std::f64::consts::PI;
            orders.iter().map(|[n, a, phi]| a * (n * theta + phi).cos()).sum::<f64>()
        };
        let sampled: Vec<f64> = (0..4000).map(at).collect();
        let (least, most) = sampled.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), v| (l.min(*v), m.max(*v)));
        assert_close(0.5 * (most - least), *total, 3e-4, 0.0, quantity);
        looked_at += 1;
    }
    assert!(looked_at >= 8, "{looked_at}");
}

/// A torque of 1 cos(theta) on Den Hartog's mass: its motion follows in phase far below resonance (-2 zeta r of a degree or two at most) and lags by half a turn above; a damper never lets it lead.
#[test]
fn phases_of_response_csv_are_lags() {
    let folder = tempfile::tempdir().expect("folder");
    assert!(hartog(&["run", "studies/den_hartog.toml", "--quiet", "--out", &folder.path().to_string_lossy()]).status.success());
    let all = rows(folder.path(), "response.csv");
    let own: Vec<(f64, f64)> = all
        .iter()
        .filter(|r| r["design"] == "den_hartog_brock" && r["quantity"] == "twist" && r["kind"] == "order")
        .map(|r| (value(r, "speed_rpm"), value(r, "phase_deg")))
        .collect();
    assert!(own.iter().all(|(_, phase)| (-180.0..=0.0).contains(phase)));
    assert!(own[0].1 > -0.01 && own.last().is_some_and(|l| l.1 < -177.0), "{:?}", (own[0], own.last()));
}

/// `results.json` of studies of every kind is what its schema says, what `--json` prints, and holds the numbers of `designs.csv`; `--quiet` prints nothing.
#[test]
fn results_for_a_script() {
    let schema: serde_json::Value = serde_json::from_slice(&hartog(&["keys", "--json-schema", "results"]).stdout).expect("a schema");
    let validator = jsonschema::validator_for(&schema).expect("a schema");
    for study in ["den_hartog", "minucci_i4", "villalva_i6_catalogue", "villalva_i6_laws"] {
        let folder = tempfile::tempdir().expect("folder");
        let out = folder.path().to_string_lossy();
        let printed = hartog(&["run", &format!("studies/{study}.toml"), "--json", "--out", &out]).stdout;
        assert_eq!(printed, std::fs::read(folder.path().join("results.json")).expect("results"), "{study}");
        let results: serde_json::Value = serde_json::from_slice(&printed).expect("JSON");
        let mistakes: Vec<String> = validator.iter_errors(&results).map(|e| format!("{}: {e}", e.instance_path())).collect();
        assert!(mistakes.is_empty(), "{study}: {mistakes:?}");
        let designs = results["designs"].as_array().expect("designs");
        let table = rows(folder.path(), "designs.csv");
        assert_eq!(designs.len(), table.len(), "{study}");
        for (design, row) in designs.iter().zip(&table) {
            assert_eq!(design["name"], row["design"]);
            let named = |name: &str| {
                let values = design["values"].as_array().expect("values").iter();
                values.filter(|v| v["measure"] == name).find_map(|v| v["value"].as_f64())
            };
            for (measure, column) in [
                ("peak_twist", "peak_twist_deg"),
                ("peak_torque", "peak_torque_n_m"),
                ("objective", "objective_value"),
                ("natural_frequency", "f1_hz"),
            ] {
                assert_eq!(named(measure), row[column].parse().ok(), "{study}: {measure} of {}", row["design"]);
            }
        }
        let optima = results["optima"].as_array().expect("optima");
        assert_eq!(optima.len(), designs.iter().filter(|d| d["optimum"] == true).count());
        let values = rows(folder.path(), "values.csv");
        assert_eq!(values.len(), designs.iter().map(|d| d["values"].as_array().map_or(0, Vec::len)).sum::<usize>());
    }
    let folder = tempfile::tempdir().expect("folder");
    let quiet = hartog(&["run", "studies/den_hartog.toml", "--quiet", "--out", &folder.path().to_string_lossy()]);
    assert!(quiet.status.success() && quiet.stdout.is_empty() && quiet.stderr.is_empty());
}

/// Every example of the guide that reads a table by pandas runs as printed and prints something, after the runs that it names by their folders; every table that they make has one.
#[test]
#[ignore = "needs python3 with pandas; a minute"]
fn examples_of_the_guide_read_every_table() {
    if !Command::new("python3").args(["-c", "import pandas"]).output().is_ok_and(|o| o.status.success()) {
        println!("skipped: no python3 with pandas here");
        return;
    }
    let folder = tempfile::tempdir().expect("folder");
    let chapter = include_str!("../../src/guide/other_programs.md");
    let examples: Vec<&str> = chapter.lines().filter(|l| l.starts_with("python3 -c ")).collect();
    let mut made: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for example in &examples {
        let study = example.split("out/").nth(1).and_then(|rest| rest.split('/').next()).expect("a folder");
        if !made.contains_key(study) {
            let out = folder.path().join("out").join(study);
            let run = hartog(&["run", &format!("studies/{study}.toml"), "--quiet", "--out", &out.to_string_lossy()]);
            assert!(run.status.code().is_some_and(|c| c <= 1), "{study}");
            let tables =
                std::fs::read_dir(&out).expect("a folder").map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned());
            made.insert(study.to_owned(), tables.filter(|n| n.ends_with(".csv") || n == "results.json").collect());
        }
        let output = Command::new("bash").current_dir(folder.path()).args(["-c", example]).output().expect("runs");
        let printed = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && printed.lines().count() >= 1, "{example}\n{printed}{}", String::from_utf8_lossy(&output.stderr));
        println!("$ {example}\n{printed}");
    }
    let mut tables: Vec<&String> = made.values().flatten().collect();
    tables.sort();
    tables.dedup();
    let missing: Vec<_> = tables.iter().filter(|t| !examples.iter().any(|e| e.contains(t.as_str()))).collect();
    assert!(missing.is_empty(), "no example: {missing:?}");
}

/// Law: a stiffness that falls by 0.6 % a kelvin is exp(0.3) times as large 50 K below its reference, and the frequency of the ring on its held hub the root of that; the loss factor falls as the stiffness does. `values.csv` tells all three, cold,
/// hot and in the reference, to rounding.
#[test]
fn a_ring_cold_and_hot() {
    let folder = tempfile::tempdir().expect("a folder");
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let study = format!(
        "engine = {engine:?}\norder_limit = 6\nspeed_rpm = {{ from = 1600, to = 2600, step = 200 }}\nconditions = [\"cold\", \"hot\"]\n\
         temperatures = {{ cold_c = -30, hot_c = 120 }}\n[[design]]\nname = \"rubber\"\n[[design.absorber]]\non.station = \"pulley\"\n\
         type.rubber = {{ ring_inertia_kg_m2 = 0.05, stiffness_n_m_per_rad = 5e4, loss_factor = 0.2 }}\n\
         material.temperature.exponential = {{ per_k = 0.006, reference_c = 20, between_c = [-40, 130] }}\n"
    );
    let path = folder.path().join("study.toml");
    std::fs::write(&path, study).expect("written");
    let out = folder.path().join("out");
    assert!(hartog(&["run", &path.to_string_lossy(), "--quiet", "--out", &out.to_string_lossy()]).status.success());
    let values = rows(&out, "values.csv");
    let value = |condition: &str, measure: &str| -> f64 {
        let row = values.iter().find(|r| r["condition"] == condition && r["measure"] == measure).expect(measure);
        row["value"].parse().expect("a number")
    };
    for (condition, kelvin) in [("firing", 0.0), ("cold", -50.0), ("hot", 100.0)] {
        let factor = f64::exp(-0.006 * kelvin);
        let stiffness = 5e4 * factor;
        assert!((value(condition, "stiffness_at_own_frequency") / stiffness - 1.0).abs() < 1e-12, "{condition}");
        let hz = (stiffness / 0.05).sqrt() / std::f64::consts::TAU;
        assert!((value(condition, "own_frequency") / hz - 1.0).abs() < 1e-9, "{condition}");
        assert!((value(condition, "loss_factor_at_own_frequency") / (0.2 * factor) - 1.0).abs() < 1e-12, "{condition}");
    }
}
