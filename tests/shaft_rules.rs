//! Limits of classification societies for shafts and cranks, against fine sweeps and the rules' own formulas.

use crate::support::assert_close;
use hartog::analysis::{self, Silent};
use hartog::input::Study;
use hartog::response::Quantity;

/// Source: [IACS UR M68]: tau_C = (sigma_B + 160)/18 c_K c_D (3 - 2 lambda²), 1.38 from 0.9 of the rated speed to 1.05, c_D = 0.35 + 0.93 d^-0.2. The ratio of a design to its limit is the largest of
/// nominal stress over that curve in a sweep, in which the limit is below the curve by no more than 1e-4.
#[test]
fn shafts_by_the_rule() {
    let root = env!("CARGO_MANIFEST_DIR");
    let text = std::fs::read_to_string(format!("{root}/studies/villalva_i6_limits.toml")).expect("a study");
    let (head, rest) = (&text[..text.find("[[constraint]]").expect("limits")], &text[text.find("[optimise]").expect("optimises")..]);
    let rule = "shaft_stress = { shaft = \"throw_6\", outer_diameter_mm = 80, iacs_m68 = { rated_speed_rpm = 2800, tensile_strength_mpa = 600, stress_factor = 0.6 }, except_rpm = [[2900, 3000], [3100, 3150]] }";
    let text = format!("{head}[[constraint]]\n{rule}\n\n{rest}").replace("engines/", &format!("{root}/studies/engines/"));
    let file = tempfile::tempdir().expect("folder").path().join("rule.toml");
    std::fs::create_dir_all(file.parent().expect("a folder")).expect("made");
    std::fs::write(&file, text).expect("written");
    let mut s = Study::read(&file).unwrap_or_else(|e| panic!("{e}"));
    (s.optimise, s.front) = (None, None);
    let results = analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}"));
    // the rule ends at 2940 rpm, and barred ranges beyond leave nothing there
    assert!(s.limits[0].words.contains(", 600 to 2900 rpm by"), "{}", s.limits[0].words);
    let modulus = std::f64::consts::PI * 0.08f64.powi(3) / 16.0;
    let limit = |ratio: f64| {
        let speed = if ratio < 0.9 { 3.0 - 2.0 * ratio * ratio } else { 1.38 };
        (600.0 + 160.0) / 18.0 * 0.6 * (0.35 + 0.93 * 80f64.powf(-0.2)) * speed * 1e6
    };
    for d in &results.designs {
        let speeds: Vec<f64> = (0..=4600).map(|i| 600.0 + 0.5 * f64::from(i)).collect();
        let sys = crate::support::system(&s);
        let grid = hartog::response::Grid::new(&speeds, &[]);
        let method = hartog::response::Method::Direct(hartog::response::Direct::new(&sys, &grid));
        let finder = hartog::objective::PeakFinder::new(&sys, &grid, &method, false);
        let mut sweep = Vec::new();
        let shaft = Quantity::ShaftTorque(6);
        hartog::response::Response::sweep(&method, &d.absorbers, shaft, &mut sweep, &mut hartog::response::Work::default())
            .expect("damped");
        let ratios = finder.synthesis(&sweep).into_iter().zip(&speeds).map(|(torque, speed)| torque / modulus / limit(speed / 2800.0));
        assert_close(d.limits[0], ratios.fold(0.0, f64::max), 2e-4, 0.0, &d.name);
    }
}
