//! Points of campaigns, and how much of the variance each key makes.

use hartog::analysis::campaign::indices;
use hartog::input::campaign::{Campaign, read_campaign};
use hartog::numerics::normal::normal_quantile;
use std::f64::consts::PI;

/// A campaign of a sample, of a study that is not read.
fn campaign(sample: &str) -> Campaign {
    let place = tempfile::tempdir().expect("folder");
    std::fs::write(place.path().join("study.toml"), "").expect("written");
    let path = place.path().join("own.toml");
    std::fs::write(&path, format!("study = \"study.toml\"\neach = \"evaluate\"\n{sample}")).expect("written");
    read_campaign(&path).unwrap_or_else(|e| panic!("{e}"))
}

fn values(campaign: &Campaign) -> Vec<Vec<f64>> {
    campaign.cases_of(0..campaign.cases().expect("cases")).into_iter().map(|case| case.values).collect()
}

/// Equals the literature: Φ⁻¹ at the shares of tables, and in the tail; Φ⁻¹(Φ(x)) = x by the symmetry of both ends.
#[test]
fn quantiles_of_the_normal_distribution() {
    for (p, x) in [(0.5, 0.0), (0.975, 1.959_963_984_540_054), (0.99, 2.326_347_874_040_841), (0.001, -3.090_232_306_167_813_5)] {
        assert!((normal_quantile(p) - x).abs() < 1e-14 * (1.0 + x.abs()) * 10.0, "{p}: {}", normal_quantile(p));
    }
    assert!((normal_quantile(1e-12) + 7.034_483_825_301_132).abs() < 1e-12);
    assert!(normal_quantile(0.0) == f64::NEG_INFINITY && normal_quantile(1.0) == f64::INFINITY);
}

/// Ishigami's function sin x + 7 sin² y + 0.1 z⁴ sin x on (-π, π)³ has closed indices \[Ishigami & Homma 1990\]: with the variance 1/2 + a²/8 + bπ⁴/5 + b²π⁸/18, first orders (1/2)(1 + bπ⁴/5)², a²/8 and 0, totals
/// with 8 b²π⁸/225 more for x and z. Ours are within their confidence interval.
#[test]
fn indices_of_ishigamis_function() {
    let (a, b) = (7.0, 0.1);
    let own = "[sample]\nmethod = \"sobol\"\npoints = 4096\nindices = true\n";
    let of = |name: &str| format!("[[sample.of]]\nkey = \"{name}\"\nuniform = [{}, {}]\n", -PI, PI);
    let campaign = campaign(&[own.to_owned(), of("x"), of("y"), of("z")].concat());
    assert_eq!(campaign.cases(), Some(5 * 4096));
    let ishigami = |v: &Vec<f64>| Some(v[0].sin() + a * v[1].sin().powi(2) + b * v[2].powi(4) * v[0].sin());
    let results: Vec<Option<f64>> = values(&campaign).iter().map(ishigami).collect();
    let found = indices(&results, 3).expect("indices");
    let variance = 0.5 + a * a / 8.0 + b * PI.powi(4) / 5.0 + b * b * PI.powi(8) / 18.0;
    let (x, y) = (0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2) / variance, a * a / 8.0 / variance);
    let both = 8.0 * b * b * PI.powi(8) / 225.0 / variance;
    for (own, (first, total)) in found.iter().zip([(x, x + both), (y, y), (0.0, both)]) {
        assert!((own.first - first).abs() <= own.first_within, "{own:?}, {first}");
        assert!((own.total - total).abs() <= own.total_within, "{own:?}, {total}");
        assert!(own.first_within < 0.1 && own.total_within < 0.05, "{own:?}");
    }
    assert!(indices(&[Some(1.0); 50], 3).is_none(), "nothing varies");
    assert!(indices(&results[..4], 3).is_none() && indices(&[None; 10], 3).is_none());
}

/// Each equal share of every key has a point of a Latin hypercube, one or two of Sobol's sequence, and as many of a full grid as of each other; a part of a sample is the same as in the whole.
#[test]
fn points_fill_every_share() {
    for (method, points, least, most) in [("latin_hypercube", 64, 1, 1), ("sobol", 64, 0, 2), ("full", 8, 8, 8)] {
        let sample = format!(
            "[sample]\nmethod = \"{method}\"\npoints = {points}\nseed = 3\n[[sample.of]]\nkey = \"a.x\"\nuniform = [0, 1]\n[[sample.of]]\nkey = \"b.y\"\nuniform = [10, 20]\n"
        );
        let campaign = campaign(&sample);
        let all = values(&campaign);
        assert_eq!(all.len(), 64);
        for key in 0..2 {
            let mut counts = vec![0; points];
            for v in &all {
                let share = if key == 0 { v[0] } else { (v[1] - 10.0) / 10.0 };
                assert!((0.0..1.0).contains(&share));
                counts[(share * points as f64) as usize] += 1;
            }
            assert!(counts.iter().all(|n| (least..=most).contains(n)), "{method}: {counts:?}");
        }
        let part: Vec<Vec<f64>> = campaign.cases_of(17..40).into_iter().map(|c| c.values).collect();
        assert_eq!(part, all[17..40]);
    }
}

/// Shares of a table of values, and the mean and deviation of a normal key, are those of its points.
#[test]
fn distributions_are_those_that_are_asked_for() {
    let sample = "[sample]\nmethod = \"latin_hypercube\"\npoints = 1000\n[[sample.of]]\nkey = \"a\"\ntable = { values = [1, 2, 4], shares = [0.25, 0.5, 0.25] }\n\
                  [[sample.of]]\nkey = \"b\"\nnormal = { mean = 5, deviation = 2 }\n";
    let all = values(&campaign(sample));
    let count = |x: f64| all.iter().filter(|v| v[0] == x).count();
    assert_eq!([count(1.0), count(2.0), count(4.0)], [250, 500, 250]);
    let mean = all.iter().map(|v| v[1]).sum::<f64>() / 1000.0;
    let deviation = (all.iter().map(|v| (v[1] - mean).powi(2)).sum::<f64>() / 999.0).sqrt();
    assert!((mean - 5.0).abs() < 0.01 && (deviation - 2.0).abs() < 0.02, "{mean} {deviation}");
}
