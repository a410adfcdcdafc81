//! `order_<design>`: what stands on the page that a damper is ordered by, against the tables of the run.

use crate::support::{hartog, variant};
use std::fs;
use std::path::{Path, PathBuf};

const DRAWN: &str = "[[constraint]]\nstrain = { absorber = 1, max_percent = 16 }\n[[design]]\nname = \"drawn\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.sleeve = { ring_inertia_kg_m2 = 0.076, outer_diameter_mm = 265, ring_wall_mm = 15, rubber_thickness_mm = 12, length_over_width = 0.9, ring_density_kg_m3 = 7200 }\nmaterial.of = [\"vmq_60\"]\n[robust]\nsearch = false\nprocess = { rubber_thickness_mm = 0.3, hardness_shore_a = 5 }\nallocate = {}\n";

/// A study of the six's order in a folder that is run quickly: what stands before a mark of its file, at few speeds and orders and without conditions, then something of its own.
fn quick(folder: &Path, mark: &str, own: &str) -> PathBuf {
    let path = variant(folder, "order_i6", &[]);
    let text = fs::read_to_string(&path).expect("study");
    let (head, _) = text.split_once(mark).expect("a mark");
    let short = head
        .replace("from = 600", "from = 1800")
        .replace("step = 20", "step = 200")
        .replace("order_limit = 12", "order_limit = 6")
        .replace("conditions = [\"firing\", \"cold\", \"hot\"]\n", "")
        .replace("temperatures = { cold_c = -20, hot_c = 90 }\n", "");
    fs::write(&path, format!("{short}{own}")).expect("written");
    path
}

const PRICED: &str = "[optimise]\nprices = true\n[[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"sleeve\"]\nsize.ring_inertia_kg_m2.fixed = 0.07\nouter_diameter_mm.fixed = 262\nring_wall_mm.fixed = 13\nring_density_kg_m3.fixed = 7200\nrubber_thickness_mm.between = [4, 20]\nlength_over_width.between = [0.5, 1]\nmaterial.sleeve.of = [\"vmq_60\"]\n";

/// An optimum's page has what limits that are used up are worth, as `limits.csv` has it, and with `prices = true` what is asked costs, in the words of the answer.
#[test]
fn prices_stand_on_the_page() {
    let folder = tempfile::tempdir().expect("folder");
    let path = quick(folder.path(), "[optimise]", PRICED);
    let out = folder.path().join("out");
    let run = hartog().arg("run").arg(&path).arg("--out").arg(&out).assert().code(0);
    let answer = String::from_utf8_lossy(&run.get_output().stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    let page = fs::read_to_string(out.join("order_optimum_sleeve.html")).expect("a page");
    let words: Vec<&str> = page.split('<').filter_map(|t| t.split_once('>')).map(|t| t.1.trim()).filter(|t| !t.is_empty()).collect();
    let words = words.join(" ");
    let costs = words.split_once("costs: ").expect("what is asked").1.split_once("Assumptions").expect("what is assumed").0;
    assert!(answer.contains(costs.trim()), "{costs} in {answer}");
    let mut reader = csv::Reader::from_path(out.join("limits.csv")).expect("a table");
    let head = reader.headers().expect("a head").clone();
    let column = |name: &str| head.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name} in {head:?}"));
    let (design, price) = (column("design"), head.len() - 1);
    let rows: Vec<csv::StringRecord> = reader.records().map(|r| r.expect("a row")).filter(|r| &r[design] == "optimum_sleeve").collect();
    let dear = rows.iter().filter_map(|r| r[price].parse::<f64>().ok()).filter(|p| *p > 1e-6).count();
    assert!(dear > 0, "a limit is used up");
    assert_eq!(words.matches("of it would bring").count(), dear, "{words}");
}

/// The tolerances that limits bear stand on the page and in its record as wide as `allocation.csv` has them, to the printed digits.
#[test]
fn tolerances_that_limits_bear() {
    let folder = tempfile::tempdir().expect("folder");
    let path = quick(folder.path(), "[[constraint]]", DRAWN);
    let out = folder.path().join("out");
    hartog().arg("run").arg(&path).arg("--out").arg(&out).assert().code(0);
    let page = fs::read_to_string(out.join("order_drawn.html")).expect("a page");
    let record: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("order_drawn.json")).expect("a record")).expect("JSON");
    let told: Vec<&str> = record["borne_tolerances"].as_array().expect("a list").iter().map(|t| t.as_str().expect("words")).collect();
    let mut reader = csv::Reader::from_path(out.join("allocation.csv")).expect("a table");
    let head = reader.headers().expect("a head").clone();
    let column = |name: &str| head.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name} in {head:?}"));
    let (design, key, width) = (column("design"), column("tolerance"), column("allocated"));
    let rows: Vec<csv::StringRecord> = reader.records().map(|r| r.expect("a row")).filter(|r| &r[design] == "drawn").collect();
    assert_eq!((told.len(), rows.len()), (2, 2), "{told:?}");
    for (told, row) in told.iter().zip(&rows) {
        assert!(page.contains(told) && page.contains("What the limits bear"), "{told}");
        let own: f64 = told.rsplit('±').next().and_then(|w| w.trim_end_matches(" %").parse().ok()).expect("a width");
        let exact: f64 = row[width].parse().expect("a number");
        assert!(told.starts_with(&row[key]) && (own / exact - 1.0).abs() < 1e-3, "{told}: {row:?}");
    }
}

const OF_STEEL: &str = "[[constraint]]\nspring_stress = { absorber = 1, max_mpa = 2000 }\n[[design]]\nname = \"leaves\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.leaf_springs = { ring_inertia_kg_m2 = 0.076, outer_diameter_mm = 270, ring_wall_mm = 20, springs = 24, leaf_length_mm = 50, leaf_thickness_mm = 3, leaf_over_width = 0.8, ring_density_kg_m3 = 7850, youngs_modulus_gpa = 206, damping_factor = 0.3, dynamic_ratio = 1.4, reference_frequency_hz = 150 }\n[[design]]\nname = \"coils\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.coil_springs = { ring_inertia_kg_m2 = 0.076, outer_diameter_mm = 300, ring_wall_mm = 15, springs = 6, wire_diameter_mm = 12, spring_index = 4, active_coils = 3, ring_density_kg_m3 = 7850, shear_modulus_gpa = 79, damping_n_m_s_per_rad = 15 }\n[[design]]\nname = \"masses\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.pendulum_masses = { ring_inertia_kg_m2 = 0.03, outer_diameter_mm = 270, mass_height_mm = 50, masses = 4, filled_share = 0.8, path_radius_mm = 10, ring_density_kg_m3 = 7850, damping_n_m_s_per_rad = 0.5 }\n";

/// Springs and pendulum masses have a page each, with what its type has and nothing of what it has not, and its record has the same numbers: stress of springs, swing of masses, and neither strain nor rubber.
#[test]
fn pages_of_springs_and_pendulums() {
    let folder = tempfile::tempdir().expect("folder");
    let path = quick(folder.path(), "[[constraint]]", OF_STEEL);
    let out = folder.path().join("out");
    hartog().arg("run").arg(&path).arg("--out").arg(&out).assert().code(0);
    let read = |name: &str| {
        let page = fs::read_to_string(out.join(format!("order_{name}.html"))).expect("a page");
        let record = fs::read_to_string(out.join(format!("order_{name}.json"))).expect("a record");
        // its words without where they stand
        let words: Vec<&str> = page.split('<').filter_map(|t| t.split_once('>')).map(|t| t.1.trim()).filter(|t| !t.is_empty()).collect();
        (words.join(" "), serde_json::from_str::<serde_json::Value>(&record).expect("JSON"))
    };
    let holds = |page: &str, words: &[&str]| words.iter().for_each(|w| assert!(page.contains(w), "{w}"));
    let springs = ["Static stiffness", "Ring on its held hub", "Largest stress of the springs", "Stress and heat"];
    let (page, record) = read("leaves");
    holds(&page, &springs);
    holds(&page, &["24 leaves 50.00 x 3.00 x ", "Width of a leaf", "Leaves together", "clamped in the hub", "stress of the springs "]);
    assert!(record["order"]["stress"].as_f64().is_some_and(|s| s > 1e6) && record["leaf_width_mm"].as_f64().is_some_and(|b| b > 1.0));
    let (page, record) = read("coils");
    holds(&page, &springs);
    holds(&page, &["6 coil springs of 12.0 mm wire, 60.00 mm outside, 3 active coils", "Springs together", "factor of curvature"]);
    assert!((record["coil_outer_diameter_mm"].as_f64().expect("a size") - 60.0).abs() < 1e-9);
    let (page, record) = read("masses");
    holds(&page, &["4 masses of ", "Each mass", "Tuned to the order", "Largest arc to each side", "Radius that its corners come to"]);
    let swing = &record["order"]["swing"];
    let of = |key: &str| swing[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert!((of("tuning_order").powi(2) - (of("centre_radius") / 0.010 - 1.0)).abs() < 1e-9);
    assert!((of("arc") - of("angle") * 0.010).abs() < 1e-12 && of("reach") > 0.135, "{swing}");
    for name in ["leaves", "coils", "masses"] {
        let (page, record) = read(name);
        assert!(!page.contains("shear strain") && !page.contains("Compound") && record["order"].get("strain").is_none(), "{name}");
        assert_eq!(record["order"].get("stress").is_some(), name != "masses");
        assert_eq!(record.get("sheared_volume_l"), None);
        // e Omega = 6.3 mm/s of the whole mass, at the highest speed of the study
        let unbalance = record["order"]["mass"].as_f64().expect("a mass") * 6.3e-3 / (3200.0 * std::f64::consts::TAU / 60.0) * 1e6;
        let told = page.split_once("Balance: ").and_then(|p| p.1.split_once(" g mm would be G 6.3 at 3200 rpm")).expect("a balance").0;
        assert!((told.parse::<f64>().expect("a number") / unbalance - 1.0).abs() < 6e-3, "{told} {unbalance}");
        holds(&page, &["To be agreed", "Surface protection", if name == "masses" { "End stops" } else { "Springs: steel" }]);
    }
}
