//! `order_<design>`: what stands on the page that a damper is ordered by, against the tables of the run.

use crate::support::{hartog, variant};
use std::fs;

const DRAWN: &str = "[[constraint]]\nstrain = { absorber = 1, max_percent = 16 }\n[[design]]\nname = \"drawn\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.sleeve = { ring_inertia_kg_m2 = 0.076, outer_diameter_mm = 265, ring_wall_mm = 15, rubber_thickness_mm = 12, length_over_width = 0.9, ring_density_kg_m3 = 7200 }\nmaterial.of = [\"vmq_60\"]\n[robust]\nsearch = false\nprocess = { rubber_thickness_mm = 0.3, hardness_shore_a = 5 }\nallocate = {}\n";

/// The tolerances that limits bear stand on the page and in its record as wide as `allocation.csv` has them, to the printed digits.
#[test]
fn tolerances_that_limits_bear() {
    let folder = tempfile::tempdir().expect("folder");
    let path = variant(folder.path(), "order_i6", &[]);
    let text = fs::read_to_string(&path).expect("study");
    let head = &text[..text.find("[[constraint]]").expect("limits")];
    let short = head.replace("from = 600", "from = 1800").replace("step = 20", "step = 200").replace("order_limit = 12", "order_limit = 6");
    let short =
        short.replace("conditions = [\"firing\", \"cold\", \"hot\"]\n", "").replace("temperatures = { cold_c = -20, hot_c = 90 }\n", "");
    fs::write(&path, format!("{short}{DRAWN}")).expect("written");
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
