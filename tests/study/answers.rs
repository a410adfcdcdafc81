//! What a reader is told of a design, in every file alike: values in the unit and sense of their measure, one value a design with what it is of, and verdicts on answers that are none.

use crate::support::{assert_close, read, variant};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

type Row = BTreeMap<String, String>;

/// What a run of a study prints, its files in the folder.
fn run(study: &Path, folder: &Path) -> String {
    let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
    let output =
        c.current_dir(env!("CARGO_MANIFEST_DIR")).args(["run", "--verbose"]).arg(study).arg("--out").arg(folder).output().expect("runs");
    assert!(output.status.code().is_some_and(|c| c <= 1), "{}", String::from_utf8_lossy(&output.stderr));
    // sentences are broken between words
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The same on one line a sentence.
fn unbroken(printed: &str) -> String {
    printed.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn rows(folder: &Path, name: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

fn json(folder: &Path, name: &str) -> Value {
    serde_json::from_str(&read(folder, name)).expect("JSON")
}

/// The entry of a list that has this name.
fn entry<'v>(list: &'v Value, key: &str, name: &str) -> &'v Value {
    list.as_array().and_then(|l| l.iter().find(|e| e[key] == name)).unwrap_or_else(|| panic!("{name}"))
}

/// A table of the page after a heading: its head and rows as words.
fn table_of(page: &str, heading: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let after = page.split(&format!("<h2>{heading}</h2>")).nth(1).unwrap_or_else(|| panic!("{heading}"));
    let table = after.split("</table>").next().expect("a table");
    let words = |cell: &str| {
        let mut out = String::new();
        for piece in cell.split('<').enumerate().map(|(i, p)| if i == 0 { p } else { p.split_once('>').map_or("", |p| p.1) }) {
            out.push_str(piece);
        }
        out.trim().to_owned()
    };
    let cells = |row: &str, tag: &str| -> Vec<String> {
        let open = format!("<{tag}");
        row.split(&open)
            .skip(1)
            .map(|c| words(c.split(&format!("</{tag}>")).next().expect("a cell").split_once('>').expect("a tag").1))
            .collect()
    };
    let (head, body) = table.split_once("<tbody>").expect("a body");
    (cells(head.split("<tr>").nth(1).expect("a head"), "th"), body.split("<tr").skip(1).map(|r| cells(r, "td")).collect())
}

/// The number that a text begins with.
fn leading(text: &str) -> f64 {
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))).unwrap_or(text.len());
    text[..end].parse().unwrap_or_else(|_| panic!("{text}"))
}

/// The answers of the page: paragraphs of that class, as words.
fn answers(page: &str) -> Vec<String> {
    let strip = |text: &str| {
        text.split('<').enumerate().map(|(i, p)| if i == 0 { p } else { p.split_once('>').map_or("", |p| p.1) }).collect::<String>()
    };
    page.split("<p class=\"answer\">").skip(1).map(|p| strip(p.split("</p>").next().expect("a paragraph"))).collect()
}

/// A study beside the engines of the shipped ones.
fn written(folder: &Path, text: &str) -> std::path::PathBuf {
    let engines = format!("{}/studies/engines", env!("CARGO_MANIFEST_DIR"));
    let path = folder.join("study.toml");
    std::fs::write(&path, text.replace("engines/", &format!("{engines}/"))).expect("written");
    path
}

/// Three objectives, one of which is a margin: the certificate on the terminal, the table of the page, `summary.json`, `results.json` and `optima.csv` tell the same value in the same unit; that of the margin is
/// the margin, not its inverse, and that of the twist is in degrees. To the four digits that the page shows; among files exactly.
#[test]
fn every_file_tells_an_objective_in_its_own_unit() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = written(
        folder.path(),
        "engine = \"engines/villalva_i6.toml\"\nspeed_rpm = { from = 1000, to = 3200, step = 100 }\norder_limit = 9\n\n\
         [[objective]]\npeak_twist = { from = \"pulley\", to = \"flywheel\" }\n\n[[objective]]\nmargin = { criterion = \"goodman\" }\n\n[[objective]]\nvibratory_torque = {}\n\n\
         [fatigue]\ncriteria = [\"goodman\"]\nmaterial = { tensile_strength_mpa = 1500, bending_fatigue_limit_mpa = 750 }\n\n\
         [optimise]\nrandom_starts = 2\n[[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"viscous\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\n",
    );
    let out = folder.path().join("out");
    let printed = unbroken(&run(&study, &out));
    let (results, summary, page) = (json(&out, "results.json"), json(&out, "summary.json"), read(&out, "report.html"));
    let (head, certificates) = table_of(&page, "Certificates of the optima");
    let value_column = head.iter().position(|h| h.starts_with("value")).expect("a column");
    let optima = rows(&out, "optima.csv");
    assert_eq!(optima.iter().map(|o| o["objective"].as_str()).collect::<Vec<_>>(), ["peak_twist", "margin", "vibratory_torque"]);
    for (o, suffix) in optima.iter().zip(["°", "", " N m"]) {
        let (name, value, unit) = (o["design"].as_str(), o["value"].parse::<f64>().expect("a number"), o["unit"].as_str());
        for own in [entry(&results["optima"], "design", name), entry(&summary["optima"], "design", name)] {
            assert_eq!(own["value"].as_f64(), Some(value), "{name}");
            let stated = if own["unit"].is_string() { &own["unit"] } else { &own["objective"]["unit"] };
            assert_eq!(stated, unit, "{name}");
        }
        let cell = &certificates.iter().find(|r| r[0] == name).expect("a row")[value_column];
        assert_close(leading(cell), value, 2e-3, 0.0, name);
        assert!(cell.ends_with(suffix), "{name}: {cell}");
        let is_value = |word: &str| {
            let digits: String = word.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
            digits.trim_end_matches('.').parse::<f64>().is_ok_and(|x| (x / value - 1.0).abs() < 2e-3)
        };
        let headline = printed
            .split(&format!("{name}: "))
            .find(|t| t.split_whitespace().take(40).any(is_value))
            .unwrap_or_else(|| panic!("{name}: {value} in {printed}"));
        assert!(headline.split_whitespace().take(40).any(is_value), "{name}");
    }
    // the margin is the one of the table of designs
    let by_margin = rows(&out, "designs.csv").into_iter().find(|d| d["design"] == optima[1]["design"]).expect("a design");
    assert_close(
        by_margin["margin_goodman"].parse().expect("a number"),
        optima[1]["value"].parse().expect("a number"),
        1e-9,
        0.0,
        "margin",
    );
}

/// Silicone oil that is judged cold, firing, hot and in operation has one value: the largest of `designs.csv` over those conditions. The table, the last line and the paragraph of the terminal, the table and the
/// answer of the page, `results.json` and `summary.json` tell it, each with the peak at the reference beside it.
#[test]
fn a_design_judged_in_operation_has_one_value() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = variant(
        folder.path(),
        "villalva_i6_materials",
        &[
            ("types = [\"fractional_zener\", \"carreau\", \"spring_pack\"]", "types = [\"carreau\"]"),
            ("speed_rpm = { from = 600, to = 3200, step = 20 }", "speed_rpm = { from = 1000, to = 3200, step = 100 }"),
            ("order_limit = 12", "order_limit = 9"),
            ("[optimise]\n", "[optimise]\nrandom_starts = 2\n"),
        ],
    );
    // materials of types that are not asked for
    let text = std::fs::read_to_string(&study).expect("a study");
    let (before, rest) = text.split_once("# EPDM of").expect("rubber");
    let oil = rest.split_once("# silicone oil").expect("oil").1.split_once("# leaf springs").expect("springs").0;
    std::fs::write(&study, format!("{before}#{oil}")).expect("written");
    let out = folder.path().join("out");
    let printed = run(&study, &out);
    let design = rows(&out, "designs.csv").into_iter().find(|d| d["design"] == "optimum_carreau").expect("a design");
    let number = |column: &str| design[column].parse::<f64>().unwrap_or_else(|_| panic!("{column}: {design:?}"));
    let reference = number("peak_twist_deg");
    let conditions = ["cold", "hot", "in_operation"].map(|c| number(&format!("{c}_objective_value")));
    let value = conditions.into_iter().fold(reference, f64::max);
    assert!(value > 1.01 * reference, "{value} against {reference}");
    assert_close(number("objective_value"), value, 1e-12, 0.0, "designs.csv");
    let (results, summary) = (json(&out, "results.json"), json(&out, "summary.json"));
    for own in [entry(&results["designs"], "name", "optimum_carreau"), entry(&summary["optima"], "design", "optimum_carreau")] {
        let judged = &own["judged"];
        assert_eq!(judged["value"].as_f64(), Some(value));
        assert_eq!(judged["reference"].as_f64(), Some(reference));
        assert_eq!(judged["worst_of"], serde_json::json!(["cold", "firing", "hot", "in_operation"]));
        let reached = judged["reached_in"].as_str().expect("a word");
        assert_close(number(&format!("{reached}_objective_value")), value, 1e-9, 0.0, reached);
    }
    let page = read(&out, "report.html");
    let answer = &answers(&page)[0];
    let told = format!("optimum_carreau: {value:.4}° (worst of cold, firing, hot and in operation: ");
    assert!(answer.contains(&told) && answer.contains(&format!("at the reference {reference:.4}°")), "{answer}");
    assert!(page.contains("at the worst of cold, firing, hot and in operation"), "the question");
    let (head, designs) = table_of(&page, "Designs");
    let column = head.iter().position(|h| h == "judged, °").expect("a column");
    let cell = &designs.iter().find(|r| r[0] == "optimum_carreau").expect("a row")[column];
    assert_close(leading(cell), value, 2e-4, 0.0, cell);
    // the table of the terminal: its block that has the column
    let block = printed.split("\n\n").find(|b| b.contains("judged/°")).expect("a column");
    let line = block.lines().find(|l| l.trim_start().starts_with("optimum_carreau")).expect("a row");
    let is_value = |word: &str| word.parse::<f64>().is_ok_and(|x| (x - value).abs() < 1e-4);
    assert!(line.split_whitespace().any(is_value), "{line}");
    let told = unbroken(&printed);
    let words = format!("{value:.6}° (worst of cold, firing, hot and in operation:");
    assert!(told.matches(&words).count() >= 2, "the paragraph of the optimum and the last line: {told}");
}

/// A spring that stiffens is judged at its own amplitude: the page's table and answer have the value of `designs.csv`, 0.6657° for the shipped study's second design, beside 0.5243° of small twist, and the answer is the
/// best by that value. To the four digits that the page shows.
#[test]
fn a_design_of_large_twist_has_one_value() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = variant(folder.path(), "villalva_i6_large_twist", &[]);
    let text = std::fs::read_to_string(&study).expect("a study");
    let springs = text.split("[[design]]\nname = \"circle\"").next().expect("springs");
    std::fs::write(&study, springs).expect("written");
    let out = folder.path().join("out");
    let printed = unbroken(&run(&study, &out));
    let (page, results) = (read(&out, "report.html"), json(&out, "results.json"));
    let (head, designs) = table_of(&page, "Designs");
    let column = head.iter().position(|h| h == "judged, °").expect("a column");
    let mut best = (f64::INFINITY, String::new());
    let mut differ = 0;
    for d in rows(&out, "designs.csv").iter().filter(|d| d["design"] != "none") {
        let (value, small) =
            (d["objective_value"].parse::<f64>().expect("a number"), d["peak_twist_deg"].parse::<f64>().expect("a number"));
        let cell = &designs.iter().find(|r| r[0] == d["design"]).expect("a row")[column];
        assert_close(leading(cell), value, 2e-4, 0.0, cell);
        let judged = &entry(&results["designs"], "name", &d["design"])["judged"];
        assert_eq!((judged["value"].as_f64(), judged["reference"].as_f64()), (Some(value), Some(small)));
        if value > small {
            let row = designs.iter().find(|r| r[0] == d["design"]).expect("a row");
            assert!(row[column + 1] == "its own amplitude" && judged["reached_in"] == "own_amplitude", "{row:?}");
            differ += 1;
        }
        if value < best.0 {
            best = (value, d["design"].clone());
        }
    }
    assert!(differ > 0);
    let told = format!("{}: {:.4}°", best.1, best.0);
    assert!(answers(&page)[0].contains(&told), "{told}: {:?}", answers(&page));
    assert!(printed.contains(&format!("Best design: {} with {:.6}°", best.1, best.0)), "{printed}");
}

/// The page of a study with tolerances names both answers: the best as drawn with its worst beside it, and the one whose worst is least, with what it has as drawn; values of `robust.csv`, to the digits shown.
#[test]
fn a_page_with_tolerances_names_its_robust_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = variant(
        folder.path(),
        "villalva_i6_robust",
        &[
            ("types = [\"tuned\", \"viscous\"]", "types = [\"viscous\"]"),
            ("step = 10", "step = 100"),
            ("samples = 2000", "samples = 200"),
            ("[optimise]\n", "[optimise]\nrandom_starts = 2\n"),
        ],
    );
    let out = folder.path().join("out");
    let printed = unbroken(&run(&study, &out));
    let page = read(&out, "report.html");
    let found = rows(&out, "robust.csv");
    let of = |name: &str, column: &str| -> f64 {
        found.iter().find(|r| r["design"] == name && r["role"] == "objective").expect("a row")[column].parse().expect("a number")
    };
    let told = answers(&page);
    assert_eq!(told.len(), 2, "{told:?}");
    let drawn = format!(
        "optimum_viscous: {:.4}°; at its worst within the tolerances {:.4}°",
        of("optimum_viscous", "nominal"),
        of("optimum_viscous", "worst")
    );
    assert!(told[0].contains(&drawn), "{drawn}: {told:?}");
    let robust = format!("optimum_viscous_robust: {:.4}°", of("optimum_viscous_robust", "worst"));
    assert!(told[1].contains(&robust) && told[1].contains("its tolerances"), "{robust}: {told:?}");
    assert!(told[1].contains(&format!("at the reference {:.4}°", of("optimum_viscous_robust", "nominal"))), "{told:?}");
    assert!(page.contains("within the tolerances of its making ("), "the question");
    let last = format!("Best within the tolerances: optimum_viscous_robust with {:.6}°", of("optimum_viscous_robust", "worst"));
    assert!(printed.contains(&last), "{last}: {printed}");
}

/// The page of a catalogue names the best of it, as `catalogue.csv` has it.
#[test]
fn a_page_of_a_catalogue_names_its_best() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let printed = unbroken(&run(Path::new("studies/villalva_i6_oils.toml"), &out));
    let first = rows(&out, "catalogue.csv").into_iter().find(|r| r["place"] == "1").expect("a row");
    let value = first["value"].parse::<f64>().expect("a number");
    let told = answers(&read(&out, "report.html"));
    assert!(told[0].contains(&format!("The best of them is {}: {value:.4}°", first["design"])), "{told:?}");
    assert!(printed.contains(&format!("Best design: {} with {value:.6}°", first["design"])), "{printed}");
}

/// The line of the page below its first table that tells the verdicts on a design.
fn verdict_on_page(page: &str, name: &str) -> String {
    let list = page.split("id=\"verdicts\"").nth(1).expect("verdicts").split("</ul>").next().expect("a list").to_owned();
    list.split("<li>").find(|l| l.contains(&format!("<b>{name}</b>"))).unwrap_or_else(|| panic!("{name}: {list}")).to_owned()
}

/// Verdicts on an optimum by kind, in `results.json`.
fn verdicts(out: &Path, name: &str) -> Vec<String> {
    let results = json(out, "results.json");
    let list = entry(&results["designs"], "name", name)["verdicts"].clone();
    list.as_array().map_or_else(Vec::new, |l| l.iter().map(|v| v["verdict"].as_str().expect("a word").to_owned()).collect())
}

/// A study of one type on the in-line six.
fn of_type(speeds: &str, absorber: &str, more: &str) -> String {
    format!(
        "engine = \"engines/villalva_i6.toml\"\nspeed_rpm = {{ {speeds} }}\norder_limit = 9\n\n[[objective]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\" }}\n\n\
         [optimise]\nrandom_starts = 2\n[[optimise.absorber]]\non.station = \"pulley\"\n{absorber}\n{more}"
    )
}

/// Of sizes that a study lists, the best answers its question, whichever comes first: it is the answer of the terminal and of the page, and its response is drawn.
#[test]
fn the_best_of_the_sizes_answers() {
    let folder = tempfile::tempdir().expect("a folder");
    let absorber = "types = [\"viscous\"]\nsize.ring_inertia_kg_m2.each = [0.01, 0.08, 0.02]";
    let out = folder.path().join("out");
    let said = run(&written(folder.path(), &of_type("from = 1600, to = 2600, step = 100", absorber, "")), &out);
    assert!(unbroken(&said).contains(" optimum_viscous_0.08: peak twist"), "{said}");
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    assert!(answers(&page).iter().any(|a| a.contains("optimum_viscous_0.08: ")), "{:?}", answers(&page));
    let response = std::fs::read_to_string(out.join("response.csv")).expect("a table");
    assert!(response.contains("optimum_viscous_0.08,") && !response.contains("optimum_viscous_0.02,"));
}

/// Absurd optima are called that in the first table of the terminal and of the page, in `results.json` and in `summary.json`: a damper that is worse than none where a resonance is drawn into the speeds (against
/// the value of the design without absorber, which the study does not have), a ring too small to do anything, rubber of no modulus. One that is none of it has no verdict in any file.
#[test]
fn absurd_optima_are_called_that() {
    let rubber = "[optimise.absorber.material.rubber]\ngeometry.sleeve = { inner_diameter_mm = 244, outer_diameter_mm = 246, length_mm = 60 }\nproperties.loss_factor.fixed = 0.15\n";
    let cases = [
        (
            "from = 600, to = 1500, step = 50",
            "types = [\"viscous\"]\nsize.ring_inertia_kg_m2.fixed = 0.3\ndamping_n_m_s_per_rad.between = [5e3, 1e4]",
            "",
            &["worse_than_none", "on_bound"][..],
        ),
        ("from = 1000, to = 3200, step = 100", "types = [\"viscous\"]\nsize.ring_inertia_kg_m2.fixed = 1e-5", "", &["little_gain"]),
        (
            "from = 1000, to = 3200, step = 100",
            "types = [\"rubber\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\nstiffness_n_m_per_rad.between = [10, 100]",
            rubber,
            &["modulus", "strain", "on_bound"],
        ),
        ("from = 1000, to = 3200, step = 100", "types = [\"viscous\"]\nsize.ring_inertia_kg_m2.fixed = 0.076", "", &[]),
    ];
    for (speeds, absorber, more, expected) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        let study = written(folder.path(), &of_type(speeds, absorber, more));
        let out = folder.path().join("out");
        let printed = unbroken(&run(&study, &out));
        let name = if more.is_empty() { "optimum_viscous" } else { "optimum_rubber" };
        let found = verdicts(&out, name);
        for kind in expected {
            assert!(found.iter().any(|k| k == kind), "{absorber}: {kind} of {found:?}");
        }
        let (page, summary) = (read(&out, "report.html"), json(&out, "summary.json"));
        let own = &entry(&summary["optima"], "design", name)["verdicts"];
        assert_eq!(own.as_array().map_or(0, Vec::len), found.len());
        assert_eq!(page.contains("id=\"verdicts\""), !expected.is_empty());
        assert_eq!(printed.contains("verdict on"), !expected.is_empty(), "{printed}");
        assert_eq!(read(&out, "results.json").contains("verdicts"), !expected.is_empty());
        if expected.is_empty() {
            assert!(found.is_empty(), "{found:?}");
            continue;
        }
        let line = verdict_on_page(&page, name);
        for v in own.as_array().expect("a list") {
            let words = v["words"].as_str().expect("words");
            assert!(line.contains(words) && printed.contains(&unbroken(words)), "{words}: {line}");
        }
        if expected[0] == "worse_than_none" {
            // the engine without absorber, evaluated by itself
            let bare = hartog::Study::read(&study)
                .expect("a study")
                .evaluate("none", Vec::new())
                .expect("finite")
                .objective
                .expect("a value")
                .to_degrees();
            let value = rows(&out, "designs.csv").iter().find(|d| d["design"] == name).expect("a row")["objective_value"]
                .parse::<f64>()
                .expect("a number");
            assert!(value > bare, "{value} {bare}");
            assert!(printed.contains(&format!("WORSE THAN NO ABSORBER: {value:.6}° against {bare:.6}°")), "{printed}");
        }
    }
}

/// Rubber that overheats is said to do so on the page and in `results.json`, not on the terminal alone: the V10's of the shipped study, at the speeds at which `heat.csv` has no balance.
#[test]
fn what_overheats_is_said_everywhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = variant(
        folder.path(),
        "villalva_v10_materials",
        &[("types = [\"fractional_zener\", \"carreau\", \"spring_pack\"]", "types = [\"fractional_zener\"]")],
    );
    let text = std::fs::read_to_string(&study).expect("a study");
    std::fs::write(&study, text.split("# silicone oil").next().expect("rubber")).expect("written");
    let out = folder.path().join("out");
    let printed = run(&study, &out);
    assert!(printed.contains("optimum_fractional_zener OVERHEATS"), "{printed}");
    assert!(verdicts(&out, "optimum_fractional_zener").iter().any(|v| v == "overheats"));
    let page = read(&out, "report.html");
    let line = verdict_on_page(&page, "optimum_fractional_zener");
    assert!(line.contains("OVERHEATS at") && page.split("<h2>").next().expect("the answer").contains("OVERHEATS at"), "{line}");
}
