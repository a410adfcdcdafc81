//! The page of a run on a flexible crank.

use assert_cmd::Command;
use std::path::Path;

/// The page of a run on the chain says nothing of a flexible crank that its engine file describes; that of a run on the flexible crank does.
#[test]
fn a_page_tells_of_the_crank_that_was_used() {
    let folder = tempfile::tempdir().expect("folder");
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let page = |crank: &str| {
        let study = folder.path().join(format!("{crank}.toml"));
        let text = format!(
            "engine = {engine:?}\ncrank = \"{crank}\"\nspeed_rpm = {{ from = 600, to = 3200, step = 100 }}\norder_limit = 6\n[[design]]\nname = \"none\"\n"
        );
        std::fs::write(&study, text).expect("written");
        let out = folder.path().join(crank);
        Command::cargo_bin("hartog").expect("built").arg("run").arg(&study).arg("--out").arg(&out).assert().code(0);
        std::fs::read_to_string(out.join("report.html")).expect("a page")
    };
    let (chain, flexible) = (page("chain"), page("flexible"));
    assert!(!chain.contains("k_held/k_free") && flexible.contains("k_held/k_free"));
    // its modes move on the page as they are: nodes and frequencies of the crank, a largest motion of one
    assert!(!chain.contains("crankmode") && flexible.contains("crankmode"));
    let data = flexible.split_once("id=\"data\">").and_then(|(_, rest)| rest.split_once("</script>")).expect("data of the page").0;
    let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
    let study = hartog::input::read(&folder.path().join("flexible.toml")).unwrap_or_else(|e| panic!("{e}"));
    let own = study.flexible.as_ref().expect("a flexible crank");
    let (crank, nodes) = (&data["modes"]["crank"], own.assembled.shaft.places.len());
    assert_eq!(crank["places"].as_array().expect("places").len(), nodes);
    let radius = crank["radius"].as_f64().expect("a radius");
    for (i, mode) in own.modes().expect("modes").iter().filter(|m| m.omega > 0.0).take(12).enumerate() {
        let drawn = &crank["modes"][i];
        assert_eq!(drawn["name"], format!("{}: {:.1} Hz, {}", i + 1, mode.omega / std::f64::consts::TAU, mode.kind()));
        let motion: Vec<Vec<f64>> = serde_json::from_value(drawn["motion"].clone()).expect("six numbers a node");
        assert_eq!(motion.len(), nodes);
        let size = |k: usize, x: f64| if k < 3 { x.abs() } else { radius * x.abs() };
        let largest = motion.iter().flatten().enumerate().map(|(k, x)| size(k % 6, *x)).fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < 1e-3, "{largest}");
        // all nodes by one factor
        let (node, k) = (nodes / 2, if mode.torsion > 0.5 { 5 } else { 0 });
        let scale = if k == 5 { 1e-3 } else { 1.0 } * mode.shape[node][k] / motion[node][k];
        let other = mode.shape[1][k] * if k == 5 { 1e-3 } else { 1.0 } / scale;
        assert!((motion[1][k] - other).abs() < 1e-3, "mode {}: {} {other}", i + 1, motion[1][k]);
    }
}
