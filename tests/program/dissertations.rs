//! The chapter on the dissertations: every printed table is compared or excused, and every figure is drawn or excused.

use crate::support::{compared, hartog};
use hartog::analysis::Silent;
use hartog::analysis::curves::{Figure, curves};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::Path;

const CHAPTER: &str = include_str!("../../src/guide/dissertations.md");

/// Rows of the tables below a heading: their cells.
fn rows(heading: &str) -> Vec<Vec<&'static str>> {
    let (_, text) = CHAPTER.split_once(heading).expect("a heading");
    let text = text.split("\n## ").next().expect("a section");
    let cells = |line: &'static str| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>();
    text.lines().filter(|l| l.starts_with("| ") && !l.starts_with("| ---")).map(cells).collect()
}

/// Published numbers stand in `table` columns: some of several tables together.
fn tables_in(file: &Path) -> HashSet<String> {
    let mut reader = csv::Reader::from_path(file).expect("a table");
    let cells = reader.records().map(|r| r.expect("a row")[0].to_owned()).collect::<HashSet<String>>();
    cells.iter().flat_map(|c| c.split(", ").map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// All 33 tables of Villalva, 7 of Minucci and 26 of Fialho and Almeida: those that the chapter calls compared have rows, the others a reason.
#[test]
fn every_printed_table_is_compared_or_excused() {
    let folder = &compared().0;
    let mut known: BTreeMap<&str, HashSet<String>> = BTreeMap::new();
    let mut counted: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    let all = rows("\n## Tables\n");
    for row in &all[1..] {
        let [publication, table, _, study, why] = row[..] else { panic!("{row:?}") };
        let count = counted.entry(publication).or_default();
        count.0 += 1;
        if study.is_empty() {
            assert!(why.len() > 10, "{publication} {table}");
            continue;
        }
        count.1 += 1;
        let study = study.trim_matches('`');
        let found = known.entry(study).or_insert_with(|| {
            let page = folder.join(study);
            if page.join("comparison.csv").is_file() {
                return tables_in(&page.join("comparison.csv"));
            }
            let mut tables = tables_in(&page.join("sizing_examples.csv"));
            // its rows are of Table 26
            let rounds = fs::read_to_string(page.join("sizing_comparison.csv")).expect("rounds");
            tables.extend((rounds.lines().count() > 100).then(|| "26".to_owned()));
            tables
        });
        assert!(found.contains(table), "table {table} of {publication} is not in {study}: {found:?}");
    }
    let expected = [("Fialho & Almeida 2019", (26, 9)), ("Minucci 2010", (7, 7)), ("Villalva 2014", (33, 32))];
    assert_eq!(counted.into_iter().collect::<Vec<_>>(), expected);
}

/// Figures of the chapter: number, file (empty where it is not drawn), panel or reason.
fn figures() -> Vec<(&'static str, &'static str, &'static str)> {
    let all = rows("\n## Figures\n");
    let own = all.into_iter().filter(|r| r.len() == 4 && r[0] != "figure");
    own.map(|r| (r[0], r[2].trim_matches('`'), r[3])).collect()
}

/// Every axis has a unit in its name, or is a ratio, an order or a number.
fn has_unit(quantity: &str) -> bool {
    let units = [
        "_deg",
        "_rpm",
        "_n",
        "_n_m",
        "_mm",
        "_hz",
        "_mpa",
        "_bar",
        "_cm3",
        "_percent",
        "_m_per_s",
        "_m_per_s2",
        "_rad_per_s",
        "_rad_per_s2",
    ];
    let bare = [
        "order",
        "point",
        "safety_factor",
        "peak",
        "tuning",
        "damping_ratio",
        "inertia_ratio",
        "frequency_ratio",
        "amplitude_ratio",
        "station",
        "relative_angle",
    ];
    units.iter().any(|u| quantity.ends_with(u))
        || bare.contains(&quantity)
        || quantity.starts_with("relative")
        || quantity.ends_with("_number")
}

/// A figure of ours as it was written: the numbers of its table are those that the library computes, to the last bit.
fn holds(file: &Path, figure: &Figure) {
    let mut reader = csv::Reader::from_path(file).expect("a table");
    let mut rows = reader.records().map(|r| r.expect("a row"));
    for panel in &figure.panels {
        for curve in &panel.curves {
            for (x, y) in &curve.points {
                let row = rows.next().expect("a row a point");
                let number = |i: usize| row[i].parse::<f64>().expect("a number");
                assert_eq!((&row[0], &row[1], number(3), number(5)), (&panel.title[..], &curve.label[..], *x, *y), "{}", figure.name);
            }
        }
    }
    assert!(rows.next().is_none(), "{}", figure.name);
}

/// A history of four points for `hartog fatigue`.
fn history() -> String {
    let mut text = "point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n".to_owned();
    for p in 1..=4 {
        for j in 0..36 {
            let t = std::f64::consts::TAU * f64::from(j) / 36.0;
            let p = f64::from(p);
            text += &format!("p{p},{},{},0,{},0,{},0\n", 20 * j, 10.0 * p * t.sin(), 100.0 + 40.0 * p * t.cos(), 60.0 * t.sin());
        }
    }
    text
}

/// The 277 figures of the dissertations, none missing between the first and the last of a chapter; those that the chapter calls drawn are there as SVG and PNG, their panels have data, their axes units, and the tables of
/// both thesis engines and of the four-cylinder hold what the library computes.
#[test]
fn every_figure_is_drawn_or_excused() {
    let folder = tempfile::tempdir().expect("folder");
    let pages = &compared().0;
    let out = |name: &str| name.strip_prefix("compare/").map_or_else(|| folder.path().join(name), |page| pages.join(page));
    let speeds = |list: &[f64]| list.iter().flat_map(|s| ["--speed".to_owned(), s.to_string()]).collect::<Vec<_>>();
    let engines: [(&str, &str, &[f64]); 5] = [
        ("v10", "villalva_v10_thesis", &[6500.0, 8000.0, 8700.0]),
        ("i6", "villalva_i6_thesis", &[1600.0, 2600.0, 3200.0]),
        ("v10_flexible", "villalva_v10_flexible", &[8700.0]),
        ("i6_flexible", "villalva_i6_flexible", &[3200.0]),
        ("i4", "minucci_i4", &[1700.0, 2100.0, 3050.0]),
    ];
    for (name, study, list) in engines {
        hartog().arg("curves").arg(format!("studies/{study}.toml")).args(speeds(list)).arg("--out").arg(out(name)).assert().code(0);
        if name.ends_with("flexible") {
            continue;
        }
        let study = hartog::input::read(Path::new(&format!("studies/{study}.toml"))).expect("a study");
        for figure in curves(&study, list, &Silent).expect("damped").figures {
            holds(&out(name).join(format!("{}.csv", figure.name)), &figure);
        }
    }
    hartog().args(["size", "studies/fialho_two_stroke.toml", "--out"]).arg(out("size")).assert().code(0);
    let (table, steel) = (out("h.csv"), out("steel.toml"));
    fs::write(&table, history()).expect("written");
    fs::write(&steel, "tensile_strength_mpa = 1100\nbending_fatigue_limit_mpa = 720\ntorsion_fatigue_limit_mpa = 415\n").expect("written");
    hartog().arg("fatigue").arg(&table).arg("--material").arg(&steel).args(["--point", "p2", "--out"]).arg(out("fatigue")).assert().code(0);
    let all = figures();
    assert_eq!((all.len(), all.iter().filter(|f| f.1.is_empty()).count()), (277, 142));
    let mut last = (String::new(), 0);
    for (number, file, panel) in all {
        // 35 is printed twice; 10-6 is in an annex
        let (chapter, n) = number.rsplit_once('.').map_or((String::new(), number), |(c, n)| (c.to_owned(), n));
        if let Ok(n) = n.parse::<usize>() {
            assert!(n == 1 || chapter == last.0 && (n == last.1 + 1 || n == last.1), "figure {number} after {last:?}");
            last = (chapter, n);
        }
        if file.is_empty() {
            assert!(panel.len() >= 8, "figure {number} has no reason");
            continue;
        }
        for ending in ["svg", "png"] {
            assert!(out(&format!("{file}.{ending}")).is_file(), "figure {number}: {file}.{ending}");
        }
        let table = out(&format!("{file}.csv"));
        if file.ends_with("/orders") || file == "fatigue/fatigue" {
            continue;
        }
        let mut reader = csv::Reader::from_path(&table).expect("a table");
        let records: Vec<csv::StringRecord> = reader.records().map(|r| r.expect("a row")).collect();
        let title = panel.split("; ").next().expect("a title");
        let own: Vec<&csv::StringRecord> = records.iter().filter(|r| title == "all panels" || &r[0] == title).collect();
        assert!(own.len() > 1, "figure {number}: {file} has no panel `{title}`");
        for row in own {
            assert!(has_unit(&row[2]) && has_unit(&row[4]), "figure {number}: {} and {}", &row[2], &row[4]);
            assert!([&row[3], &row[5]].iter().all(|x| x.parse::<f64>().is_ok_and(f64::is_finite)), "figure {number}");
        }
    }
}
