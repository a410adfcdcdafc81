//! Platforms: dampers that several engines share, held against a search of two parameters and an enumeration of partitions that share no line with ours.

use crate::campaigns::{hartog, planned, rows, run, said};
use crate::support::{golden, scanned};
use nalgebra::Complex;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

type C64 = Complex<f64>;

/// An inertia on a spring to ground that a torque of 1 N m turns, perhaps with another inertia on a shaft beside it; the ring sits on the first.
#[derive(Debug, Clone, Copy)]
struct Primary {
    inertia: f64,
    stiffness: f64,
    /// Inertia and shaft.
    beside: Option<(f64, f64)>,
}

/// Of the spring of a ring.
#[derive(Debug, Clone, Copy)]
enum Damping {
    Viscous(f64),
    Loss(f64),
}

const RING: f64 = 0.1;
/// Speeds of the study, rad/s.
const SPEEDS: [f64; 2] = [100.0 * 0.104_719_755_119_659_77, 2000.0 * 0.104_719_755_119_659_77];

impl Primary {
    const fn alone(inertia: f64, stiffness: f64) -> Self {
        Self { inertia, stiffness, beside: None }
    }

    /// Twist to ground with a ring on a spring that is damped, rad.
    fn at(self, (k, damping): (f64, Damping), omega: f64) -> f64 {
        let appended = |s: C64, inertia: f64| {
            let ring = C64::from(-inertia * omega * omega);
            s * ring / (s + ring)
        };
        let own = C64::from(self.stiffness - self.inertia * omega * omega);
        let beside = self.beside.map_or(C64::from(0.0), |(j, shaft)| appended(C64::from(shaft), j));
        let spring = match damping {
            Damping::Viscous(c) => C64::new(k, c * omega),
            Damping::Loss(factor) => C64::new(k, k * factor),
        };
        // `norm` guards against overflow, which costs more than all the rest
        (own + beside + appended(spring, RING)).norm_sqr().sqrt().recip()
    }

    /// The largest over the speeds: by a scan, and a search round each maximum of it that could win.
    fn peak(self, damper: (f64, Damping)) -> f64 {
        const POINTS: usize = 600;
        static OMEGA: LazyLock<Vec<f64>> =
            LazyLock::new(|| (0..=POINTS).map(|i| SPEEDS[0] * (SPEEDS[1] / SPEEDS[0]).powf(i as f64 / POINTS as f64)).collect());
        let omega = |i: usize| OMEGA[i];
        let all: Vec<f64> = (0..=POINTS).map(|i| self.at(damper, omega(i))).collect();
        let best = all.iter().copied().fold(0.0, f64::max);
        let tops = (1..POINTS).filter(|i| all[*i] > 0.9 * best && all[*i] >= all[i - 1] && all[*i] >= all[i + 1]);
        tops.map(|i| -golden(omega(i - 1), omega(i + 1), &|x| -self.at(damper, x)).1).fold(best, f64::max)
    }
}

/// The least that one damper reaches of the largest ratio of the peaks of some engines to their targets.
fn minimax(of: &[(Primary, f64)]) -> f64 {
    let worst = |(k, c): (f64, f64)| of.iter().map(|(p, target)| p.peak((k, Damping::Viscous(c))) / target).fold(0.0, f64::max);
    scanned(100f64.ln(), 5000f64.ln(), &|k| scanned(0.3f64.ln(), 50f64.ln(), &|c| worst((k.exp(), c.exp()))).1).1
}

/// A campaign whose `[[vary]]` are these engines.
fn campaign(engines: &[(&str, Primary)], platform: &str) -> String {
    let variant = |(name, p): &(&str, Primary)| {
        let station = format!(
            "{{ name = \"engine\", throws = [1], inertia_kg_m2 = {}, stiffness_to_ground_n_m_per_rad = {} }}",
            p.inertia, p.stiffness
        );
        // what stands beside it comes first: the ring then sits on another station of the chain
        let beside = p.beside.map(|(j, k)| format!("{{ name = \"beside\", inertia_kg_m2 = {j}, stiffness_to_next_n_m_per_rad = {k} }}, "));
        format!("[[vary.variant]]\nname = \"{name}\"\nset = ['engine.station=[{}{station}]', 'design=[]']\n", beside.unwrap_or_default())
    };
    let family = "[[vary]]\nname = \"ring\"\n[[vary.variant]]\nname = \"own\"\nset = ['optimise.absorber=[{ on.station = \"engine\", types = [\"tuned\"], size.ring_inertia_kg_m2.fixed = 0.1 }]']\n";
    let all: String = engines.iter().map(variant).collect();
    format!("study = \"studies/den_hartog.toml\"\neach = \"platform\"\n[[vary]]\nname = \"engine\"\n{all}{family}{platform}")
}

type Table = Vec<BTreeMap<String, String>>;

/// The rows of a campaign that is run.
fn table(campaign: &str) -> Table {
    let place = planned(campaign);
    let done = run(place.path(), &[]);
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    rows(&place.path().join("out"))
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name}: {row:?}"))
}

/// What rows say of themselves: their peaks are those of their dampers, each engine has one of as many dampers as there are, the worst ratio is the largest, and its bound is no more than a thousandth below it.
fn hold(table: &Table, engines: &[(&str, Primary)]) {
    let counts: BTreeSet<&str> = table.iter().map(|row| row["dampers"].as_str()).collect();
    for count in counts {
        let own: Vec<_> = table.iter().filter(|row| row["dampers"] == count).collect();
        let dampers: BTreeSet<&str> = own.iter().map(|row| row["damper"].as_str()).collect();
        assert!(dampers.len() <= count.parse().expect("a number"), "{own:?}");
        for row in &own {
            let primary = engines.iter().find(|e| e.0 == row["engine"]).expect("an engine").1;
            let peak =
                primary.peak((number(row, "stiffness_n_m_per_rad"), Damping::Viscous(number(row, "damping_n_m_s_per_rad")))).to_degrees();
            assert!((number(row, "peak_twist_deg") / peak - 1.0).abs() < 1e-8, "{row:?}: {peak}");
            assert!((number(row, "ratio") * number(row, "target_of_peak_twist_deg") / peak - 1.0).abs() < 1e-8, "{row:?}");
            let share = number(row, "lower_bound_of_worst_ratio") / number(row, "worst_ratio");
            assert!((0.9989..=1.0).contains(&share) && row["proof"] == "proved" && row["status"] == "ok", "{row:?}");
        }
        let largest = own.iter().map(|row| number(row, "ratio")).fold(0.0, f64::max);
        assert!((largest / number(own[0], "worst_ratio") - 1.0).abs() < 1e-8, "{own:?}");
    }
}

fn worst(table: &Table, dampers: usize) -> f64 {
    number(table.iter().find(|row| row["dampers"] == dampers.to_string()).expect("rows"), "worst_ratio")
}

/// One ring for two primaries, one of them with another inertia on a shaft, so that the ring sits on the second station of its chain: equals a search of stiffness and damping to 1e-6, in units of what the best ring for each alone
/// reaches, and of given targets.
#[test]
fn one_ring_for_two_primaries() {
    let engines = [("light", Primary::alone(1.0, 1e4)), ("heavy", Primary { inertia: 1.5, stiffness: 1.3e4, beside: Some((0.3, 2e4)) })];
    let own = table(&campaign(&engines, "[platform]\nengines = \"engine\"\n"));
    assert_eq!(own.len(), 4);
    hold(&own, &engines);
    let alone = engines.map(|e| minimax(&[(e.1, 1.0)]));
    let both = minimax(&[(engines[0].1, alone[0]), (engines[1].1, alone[1])]);
    assert!((worst(&own, 1) / both - 1.0).abs() < 1e-6, "{} {both}", worst(&own, 1));
    assert!((worst(&own, 2) - 1.0).abs() < 1e-9);
    let given = table(&campaign(&engines, "[platform]\nengines = \"engine\"\ntargets = { light = 0.03, heavy = 0.02 }\n"));
    hold(&given, &engines);
    let [light, heavy] = [0.03_f64, 0.02].map(f64::to_radians);
    let both = minimax(&[(engines[0].1, light), (engines[1].1, heavy)]);
    assert!((worst(&given, 1) / both - 1.0).abs() < 1e-6, "{} {both}", worst(&given, 1));
    let each = f64::max(alone[0] / light, alone[1] / heavy);
    assert!((worst(&given, 2) / each - 1.0).abs() < 1e-6);
}

/// Partitions of some engines into at most so many sets, as the set of each.
fn partitions(engines: usize, sets: usize) -> Vec<Vec<usize>> {
    (0..engines).fold(vec![Vec::new()], |all, _| {
        let with = |own: &Vec<usize>| {
            let next = own.iter().max().map_or(0, |m| m + 1);
            (0..=next.min(sets - 1)).map(|s| own.iter().copied().chain([s]).collect()).collect::<Vec<_>>()
        };
        all.iter().flat_map(with).collect()
    })
}

/// One to four dampers for four engines equal the best of all partitions, each set of which is searched by itself; without a single set beyond those of the first assignment the bound still is one.
#[test]
fn dampers_for_four_engines() {
    let engines = [
        ("a", Primary::alone(1.0, 1e4)),
        ("b", Primary::alone(1.1, 0.7e4)),
        ("c", Primary::alone(0.8, 1.2e4)),
        ("d", Primary::alone(1.3, 1e4)),
    ];
    let alone = engines.map(|e| minimax(&[(e.1, 1.0)]));
    let mut of_sets: BTreeMap<Vec<usize>, f64> = BTreeMap::new();
    let mut cost = |set: Vec<usize>| {
        let of = || set.iter().map(|i| (engines[*i].1, alone[*i])).collect::<Vec<_>>();
        *of_sets.entry(set.clone()).or_insert_with(|| minimax(&of()))
    };
    let mut best = |dampers: usize| {
        let of = |own: Vec<usize>, cost: &mut dyn FnMut(Vec<usize>) -> f64| {
            let set = |s: usize| (0..own.len()).filter(|i| own[*i] == s).collect::<Vec<_>>();
            (0..dampers).map(set).filter(|set| !set.is_empty()).map(cost).fold(0.0, f64::max)
        };
        partitions(engines.len(), dampers).into_iter().map(|own| of(own, &mut cost)).fold(f64::INFINITY, f64::min)
    };
    let least: Vec<f64> = (1..=4).map(&mut best).collect();
    for sets in ["", "sets = 0\n"] {
        let own = table(&campaign(&engines, &format!("[platform]\nengines = \"engine\"\n{sets}")));
        if sets.is_empty() {
            hold(&own, &engines);
        }
        for (i, least) in least.iter().enumerate() {
            let row = own.iter().find(|row| row["dampers"] == (i + 1).to_string()).expect("rows");
            let (found, bound) = (number(row, "worst_ratio"), number(row, "lower_bound_of_worst_ratio"));
            assert!(bound <= least * (1.0 + 1e-6) && found >= least * (1.0 - 1e-6), "{row:?}: {least}");
            assert!(!sets.is_empty() || (found / least - 1.0).abs() < 1e-6, "{row:?}: {least}");
        }
    }
}

/// The damper of an engine is good for all its loads together: two springs of each of two engines are as four engines whose sets hold both springs or none.
#[test]
fn loads_share_the_damper_of_their_engine() {
    let springs = [1e4, 1.4e4];
    let set =
        |k: f64| format!("[[vary.variant]]\nname = \"k{k}\"\nset = [\"engine.station.engine.stiffness_to_ground_n_m_per_rad={k}\"]\n");
    let inertia = |j: f64| format!("[[vary.variant]]\nname = \"j{j}\"\nset = [\"engine.station.engine.inertia_kg_m2={j}\"]\n");
    let text = format!(
        "study = \"studies/den_hartog.toml\"\neach = \"platform\"\n[[vary]]\nname = \"engine\"\n{}{}[[vary]]\nname = \"spring\"\n{}{}[[vary]]\nname = \"ring\"\n[[vary.variant]]\nname = \"own\"\nset = ['optimise.absorber=[{{ on.station = \"engine\", types = [\"tuned\"], size.ring_inertia_kg_m2.fixed = 0.1 }}]', 'design=[]']\n[platform]\nengines = \"engine\"\nloads = [\"spring\"]\n",
        inertia(1.0),
        inertia(1.2),
        set(springs[0]),
        set(springs[1])
    );
    let own = table(&text);
    assert_eq!(own.len(), 8, "one and two dampers for two engines with two springs");
    let with = |j: f64| springs.map(|k| (Primary::alone(j, k), minimax(&[(Primary::alone(j, k), 1.0)])));
    let (light, heavy) = (with(1.0), with(1.2));
    assert!((worst(&own, 1) / minimax(&[light, heavy].concat()) - 1.0).abs() < 1e-6);
    let each = f64::max(minimax(&light), minimax(&heavy));
    assert!((worst(&own, 2) / each - 1.0).abs() < 1e-6, "{} {each}", worst(&own, 2));
}

/// What stands in the cells of a table of a page, row by row, its head first.
fn cells(page: &str, id: &str) -> Vec<Vec<String>> {
    let from = page.find(&format!("id=\"{id}\"")).unwrap_or_else(|| panic!("no {id}"));
    let table = page[from..].split("</table>").next().expect("an end").replace("</th>", "</td>");
    let own = |row: &str| row.split("</td>").filter_map(|c| c.rsplit('>').next()).map(str::to_owned).collect();
    table.split("<tr>").skip(1).map(own).collect()
}

/// The README's lines are what its campaign prints, all of it is proved, and the page has the numbers of the table, to its digits.
#[test]
fn the_example_of_the_readme() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = tempfile::tempdir().expect("folder");
    let folder = out.path().display().to_string();
    for arguments in [&["plan", "studies/campaigns/platform.toml", "--out", &folder][..], &["run", &folder]] {
        let done = hartog(root, &[&["campaign"], arguments].concat());
        assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    }
    let told = said(&hartog(root, &["campaign", "collect", &folder]));
    let readme = std::fs::read_to_string(root.join("README.md")).expect("README");
    let lines: Vec<&str> = readme.lines().filter(|line| line.contains("worst ratio") && line.contains("damper")).collect();
    assert!(lines.len() == 3 && lines.iter().all(|line| told.contains(line)), "{told}");
    let own = rows(out.path());
    assert!(own.len() == 18 && own.iter().all(|row| row["proof"] == "proved" && row["status"] == "ok"), "{own:?}");
    let page = cells(&std::fs::read_to_string(out.path().join("campaign.html")).expect("a page"), "engines");
    let (head, shown) = page.split_first().expect("a head");
    assert_eq!(shown.len(), own.len());
    for (cells, row) in shown.iter().zip(&own) {
        for (heading, column, words) in [
            ("family", "family", true),
            ("engine", "engine", true),
            ("dampers", "dampers", true),
            ("damper", "damper", true),
            ("ratio", "ratio", false),
            ("peak twist, °", "peak_twist_deg", false),
            ("target of peak twist, °", "target_of_peak_twist_deg", false),
            ("stiffness, N m/rad", "stiffness_n_m_per_rad", false),
            ("damping, N m s/rad", "damping_n_m_s_per_rad", false),
        ] {
            let cell = &cells[head.iter().position(|h| h == heading).unwrap_or_else(|| panic!("{heading}: {head:?}"))];
            match cell.parse::<f64>() {
                Ok(x) if !words => assert!((x / number(row, column) - 1.0).abs() < 6e-4, "{heading}: {cell}, {row:?}"),
                _ => assert_eq!(if cell.is_empty() { "null" } else { cell }, row[column], "{heading}"),
            }
        }
    }
    let twist = |family: &str, engine: &str| {
        let row = own.iter().find(|r| r["family"] == family && r["engine"] == engine && r["dampers"] == "3").expect("a row");
        number(row, "peak_twist_deg")
    };
    for (engine, more) in [("six", 0.14), ("six_half", 0.18), ("v10", 0.10)] {
        assert!((twist("oil", engine) / twist("tuned", engine) - 1.0 - more).abs() < 0.005, "{engine}");
    }
}

/// What asks for different dampers is refused where it is planned, and says in what they differ; beside another family that does not, it is a row.
#[test]
fn different_dampers_are_refused() {
    let engines = [("light", Primary::alone(1.0, 1e4)), ("heavy", Primary::alone(1.5, 1e4))];
    let text = campaign(&engines, "[platform]\nengines = \"engine\"\n");
    let place = crate::campaigns::place(&text.replace("ring_inertia_kg_m2.fixed", "inertia_ratio.fixed"));
    let plan = hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]);
    assert!(plan.status.code() == Some(2) && said(&plan).contains("light and heavy ask for different dampers"), "{}", said(&plan));
    let ratio = "[[vary.variant]]\nname = \"ratio\"\nset = ['optimise.absorber=[{ on.station = \"engine\", types = [\"tuned\"], size.inertia_ratio.fixed = 0.1 }]']\n[platform]";
    let place = planned(&text.replace("[platform]", ratio));
    assert_eq!(run(place.path(), &[]).status.code(), Some(1));
    let own = rows(&place.path().join("out"));
    let refused: Vec<_> = own.iter().filter(|row| row["status"] == "refused").collect();
    assert!(own.len() == 5 && refused.len() == 1 && refused[0]["reason"].contains("inertia_ratio"), "{own:?}");
    let collect = said(&hartog(place.path(), &["campaign", "collect", "out"]));
    assert!(
        collect.contains("own, optimum_tuned, 2 dampers: worst ratio 1.0000") && collect.contains("refused: light and heavy ask"),
        "{collect}"
    );
}

/// Rubber follows the temperature of each engine: one ring for a warm and a hot one equals a search of stiffness and loss factor with both of each times exp(-b (T - T0)), as that law has it.
#[test]
fn each_engine_has_its_temperature() {
    let (per_k, reference) = (0.01, 20.0);
    let places = [("warm", 1.0, 50.0), ("hot", 1.2, 110.0)];
    let variant = |(name, inertia, celsius): &(&str, f64, f64)| {
        format!(
            "[[vary.variant]]\nname = \"{name}\"\nset = ['engine.station.engine.inertia_kg_m2={inertia}', 'temperatures={{ hot_c = {celsius} }}']\n"
        )
    };
    let family = format!(
        "[[vary]]\nname = \"ring\"\n[[vary.variant]]\nname = \"own\"\nset = ['conditions=[\"hot\"]', 'optimise.conditions=[\"hot\"]', 'design=[]', 'optimise.absorber=[{{ on.station = \"engine\", types = [\"rubber\"], size.ring_inertia_kg_m2.fixed = 0.1, material.rubber.temperature.exponential = {{ per_k = {per_k}, reference_c = {reference}, between_c = [-20, 120] }} }}]']\n"
    );
    let all: String = places.iter().map(variant).collect();
    let own = table(&format!(
        "study = \"studies/den_hartog.toml\"\neach = \"platform\"\n[[vary]]\nname = \"engine\"\n{all}{family}[platform]\nengines = \"engine\"\n"
    ));
    let factor = |celsius: f64| (-per_k * (celsius - reference)).exp();
    let ring = |celsius: f64| move |k: f64, loss: f64| (k * factor(celsius), Damping::Loss(loss * factor(celsius)));
    let least = |of: &[((Primary, f64), f64)]| {
        let worst =
            |k: f64, loss: f64| of.iter().map(|((p, celsius), target)| p.peak(ring(*celsius)(k, loss)) / target).fold(0.0, f64::max);
        scanned(100f64.ln(), 5000f64.ln(), &|k| scanned(0.02f64.ln(), 2f64.ln(), &|loss| worst(k.exp(), loss.exp())).1).1
    };
    let engines = places.map(|(_, inertia, celsius)| (Primary::alone(inertia, 1e4), celsius));
    let alone = engines.map(|e| least(&[(e, 1.0)]));
    let both = least(&[(engines[0], alone[0]), (engines[1], alone[1])]);
    assert!((worst(&own, 1) / both - 1.0).abs() < 1e-6, "{} {both}", worst(&own, 1));
    for ((name, ..), target) in places.iter().zip(alone) {
        let row = own.iter().find(|r| r["engine"] == *name).expect("a row");
        assert!((number(row, "target_of_peak_twist_deg") / target.to_degrees() - 1.0).abs() < 1e-6, "{row:?}");
    }
}

/// An engine whose limit nothing holds is left out of the assignment of the others, which is as it is without it; of two that only hold theirs apart, no damper holds those of both.
#[test]
fn limits_that_nothing_holds() {
    let engines = [("a", Primary::alone(1.0, 1e4)), ("b", Primary::alone(1.2, 1e4)), ("c", Primary::alone(0.8, 1e4))];
    let without = table(&campaign(&engines, "[platform]\nengines = \"engine\"\n"));
    let limit =
        |most: f64| format!("'constraint=[{{ peak_twist = {{ from = \"engine\", to = \"ground\", max_deg = {most} }} }}]', 'design=[]'");
    let all = [&engines[..], &[("d", Primary::alone(1.1, 1e4))]].concat();
    let text = campaign(&all, "[platform]\nengines = \"engine\"\n");
    let (head, tail) = text.split_at(text.find("name = \"d\"").expect("d"));
    let place = planned(&format!("{head}{}", tail.replacen("'design=[]'", &limit(1e-3), 1)));
    assert_eq!(run(place.path(), &[]).status.code(), Some(1));
    let own = rows(&place.path().join("out"));
    assert_eq!(own.len(), 12, "up to three dampers, four engines");
    for row in &own {
        if row["engine"] == "d" {
            assert!(row["status"] == "limits_broken" && row["damper"] == "null" && row["ratio"] == "null", "{row:?}");
        } else {
            let same = without.iter().find(|r| r["engine"] == row["engine"] && r["dampers"] == row["dampers"]).expect("a row");
            assert!(row["damper"] == same["damper"] && (number(row, "worst_ratio") / number(same, "worst_ratio") - 1.0).abs() < 1e-9);
        }
    }
    let told = said(&hartog(place.path(), &["campaign", "collect", "out"])).replace("\n  ", " ");
    assert!(told.contains("none was found for d [limits broken]"), "{told}");
    // nothing serves any of them
    let none = campaign(&engines[..2], "[platform]\nengines = \"engine\"\n").replace("'design=[]'", &limit(1e-3));
    let place = planned(&none);
    assert_eq!(run(place.path(), &[]).status.code(), Some(1));
    let own = rows(&place.path().join("out"));
    assert!(own.len() == 2 && own.iter().all(|row| row["status"] == "limits_broken" && row["worst_ratio"] == "null"), "{own:?}");
    let told = said(&hartog(place.path(), &["campaign", "collect", "out"])).replace("\n  ", " ");
    assert!(told.contains("1 damper: no assignment was found that holds all limits: none was found for a, b"), "{told}");
    // each alone comes to less than the limit, one damper for both to more
    let pair = [("light", Primary::alone(0.8, 1e4)), ("heavy", Primary::alone(1.3, 1e4))];
    let place = planned(&campaign(&pair, "[platform]\nengines = \"engine\"\n").replace("'design=[]'", &limit(0.034)));
    assert_eq!(run(place.path(), &[]).status.code(), Some(1));
    let own = rows(&place.path().join("out"));
    for row in &own {
        let (status, ratio) = if row["dampers"] == "1" { ("limits_broken", "null") } else { ("ok", "1.0") };
        assert!(row["status"] == status && row["worst_ratio"].starts_with(ratio), "{row:?}");
        assert!(status == "ok" || row["reason"] == "no damper holds all limits of light, heavy", "{row:?}");
    }
}

/// Mistakes of a platform are told with their place.
#[test]
fn mistakes_have_their_place() {
    let engines = [("light", Primary::alone(1.0, 1e4)), ("heavy", Primary::alone(1.5, 1e4))];
    let whole = "[platform]\nengines = \"engine\"\ntargets = { light = 0.03, heavy = 0.02 }\n";
    for (from, to, expected) in [
        ("engines = \"engine\"", "engines = \"motor\"", "found `motor`, expected the name of another [[vary]]"),
        ("engines = \"engine\"", "engines = \"engine\"\nloads = [\"engine\"]", "found `engine`, expected the name of another [[vary]]"),
        ("heavy = 0.02", "heavy = 0", "found 0, expected a number above zero"),
        (", heavy = 0.02", "", "found no target of heavy, expected one for each of `engine`"),
        ("heavy = 0.02", "heavy = 0.02, v10 = 1", "found `v10`, expected one of the values of `engine`: light, heavy"),
        ("each = \"platform\"", "each = \"optimise\"", "found [platform], expected it with `each = \"platform\"` only"),
        (
            "each = \"platform\"",
            "each = \"platform\"\npartition = \"engine\"",
            "found `engine`, expected the name of a [[vary]] by which cases differ",
        ),
        ("each = \"platform\"", "each = \"platform\"\ntolerance = 0.01", "found `tolerance` beside a search"),
        (whole, "", "key `platform` is missing in this table"),
        ("name = \"ring\"", "name = \"ratio\"", "found `ratio` as the name of what varies, which the tables of a platform have"),
    ] {
        let text = campaign(&engines, whole);
        assert!(text.contains(from), "{from}");
        let place = crate::campaigns::place(&text.replace(from, to));
        let plan = hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]);
        assert!(plan.status.code() == Some(2) && said(&plan).contains(expected), "{expected}: {}", said(&plan));
    }
}
