//! What tables say of limits: in every condition, and where there is nothing to say.

use crate::tables::{hartog, rows};
use std::collections::BTreeMap;

/// Law: of the conditions that limits are judged in, `limits.csv` has the worst of `condition_limits.csv`, and that of one condition is what a design has alone in it: a soft rubber breaks 0.6 degrees hot, and the ring that is
/// lost is told though nothing is judged by it.
#[test]
fn limits_in_every_condition() {
    let engine = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let folder = tempfile::tempdir().expect("a folder");
    let study = |conditions: &str| {
        format!(
            "engine = '{}'\nspeed_rpm = {{ from = 600, to = 3200, step = 50 }}\norder_limit = 12\nconditions = {conditions}\ntemperatures = {{ cold_c = -30, hot_c = 120 }}\n\
             [[constraint]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\", max_deg = 0.6 }}\n[[constraint]]\ndissipated_power = {{ max_w = 500 }}\n\
             [[design]]\nname = \"ring\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.rubber = {{ ring_inertia_kg_m2 = 0.076, stiffness_n_m_per_rad = 60000, loss_factor = 0.4 }}\n\
             material.temperature.exponential = {{ per_k = 0.0097, reference_c = 23, between_c = [-30, 120] }}\n",
            engine.display()
        )
    };
    let tables = |name: &str, conditions: &str| {
        let path = folder.path().join(format!("{name}.toml"));
        std::fs::write(&path, study(conditions)).expect("written");
        let out = folder.path().join(name);
        let run = hartog(&["run", &path.to_string_lossy(), "--quiet", "--out", &out.to_string_lossy()]);
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let each = if out.join("condition_limits.csv").exists() { rows(&out, "condition_limits.csv") } else { Vec::new() };
        (each, rows(&out, "limits.csv"))
    };
    let (each, worst) = tables("all", "[\"cold\", \"hot\", \"absorber_lost\"]");
    assert_eq!((each.len(), worst.len()), (8, 2));
    for limit in &worst {
        let own = |row: &&BTreeMap<String, String>| row["measure"] == limit["measure"];
        let judged =
            each.iter().filter(own).filter(|row| row["role"] == "judged").map(|row| row["used_percent"].parse::<f64>().expect("a number"));
        assert_eq!(judged.fold(0.0, f64::max), limit["used_percent"].parse::<f64>().expect("a number"), "{}", limit["measure"]);
    }
    let at = |condition: &str| each.iter().find(|r| r["condition"] == condition && r["measure"] == "peak_twist").expect("a row");
    assert_eq!((at("cold")["held"].as_str(), at("hot")["held"].as_str()), ("true", "false"));
    assert_eq!((at("absorber_lost")["held"].as_str(), at("absorber_lost")["role"].as_str()), ("false", "told"));
    // alone hot, the worst of both conditions is hot, too; where no condition changes a design there is no such table
    let (_, hot) = tables("hot", "[\"hot\"]");
    assert_eq!(hot[0]["value"], at("hot")["value"]);
    assert!(tables("none", "[\"firing\"]").0.is_empty());
}

/// An absorber that overheats has no temperature in balance: tables, page and screen give none, where at d0177b5 they had what the heat at the hottest allowed temperature would make of it.
#[test]
fn what_overheats_has_no_temperature() {
    let engine = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let folder = tempfile::tempdir().expect("a folder");
    let study = format!(
        "engine = '{}'\nspeed_rpm = {{ from = 600, to = 3200, step = 50 }}\norder_limit = 12\n[[constraint]]\ntemperature = {{ absorber = 1, max_c = 90 }}\n[[design]]\nname = \"hot\"\n\
         [[design.absorber]]\non.station = \"pulley\"\ntype.rubber = {{ ring_inertia_kg_m2 = 0.05, stiffness_n_m_per_rad = 40000, loss_factor = 0.3 }}\n\
         material.geometry.sleeve = {{ inner_diameter_mm = 230, outer_diameter_mm = 246, length_mm = 60 }}\nmaterial.temperature.exponential = {{ per_k = 0.0066, reference_c = 30, between_c = [-20, 150] }}\n\
         material.cooling = {{ air_c = 60, hub_c = 80, to_air.disc = {{ diameter_mm = 130, width_mm = 30 }}, to_hub_w_per_k = 0.1, limit_c = 95 }}\n",
        engine.display()
    );
    let (path, out) = (folder.path().join("study.toml"), folder.path().join("out"));
    std::fs::write(&path, study).expect("written");
    let run = hartog(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy()]);
    let told = String::from_utf8_lossy(&run.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("FAILS (it overheats: no temperature is in balance"), "{told}{}", String::from_utf8_lossy(&run.stderr));
    assert!(told.contains("Overheats at some speeds, without a temperature in balance: `hot`."), "{told}");
    for table in ["limits.csv", "condition_limits.csv"] {
        let own: Vec<_> = rows(&out, table).into_iter().filter(|r| r.get("condition").is_none_or(|c| c == "in_operation")).collect();
        assert!(
            !own.is_empty() && own.iter().all(|r| r["value"].is_empty() && r["used_percent"].is_empty() && r["held"] == "false"),
            "{table}: {own:?}"
        );
    }
}
