//! Tables as spreadsheets of other countries save them: the same numbers, errors at the row of the user's own file, and refusals where a number can be read in two ways.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};

fn bad_input() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input")
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Exit code, standard output and standard error of the command in a folder.
pub fn hartog(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("hartog").expect("built").current_dir(folder).args(arguments).output().expect("run");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

pub fn written(folder: &Path, name: &str, text: impl AsRef<[u8]>) {
    fs::write(folder.join(name), text).expect("written");
}

/// The same table as a German Excel saves it: a mark, `sep=;`, a title, semicolons that trail, decimal commas, blank lines, line ends of Windows.
fn german(table: &str) -> String {
    let cell = |cell: &str| if cell.parse::<f64>().is_ok() { cell.replace('.', ",") } else { cell.to_owned() };
    let rows: Vec<String> = table.lines().map(|l| l.split(',').map(cell).collect::<Vec<_>>().join(";") + ";;\r\n").collect();
    format!("\u{feff}sep=;\r\nPrüfstand 3, Motor 4711;;\r\n;;\r\n{}\r\n;;;\r\n", rows.join(""))
}

/// A chain, measured pressures of two speeds, harmonics, a catalogue, a measured absorber and published amplitudes mean the same in either form, and so do stress histories, stresses per unit
/// load with their loads, and the table of a fit: what is printed and written is the same, word for word. At 19b2337 each German table is refused.
#[test]
fn every_table_is_read_in_german() {
    let (place, other) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let folder = |name: &str| text(&bad_input().join(name));
    let rows = |rise: f64| -> String {
        (0..48)
            .map(|i| format!("{},{:.3},{:.3}\n", 15.0 * f64::from(i), 1.0 + rise / f64::from(i + 1), 2.5 + rise / f64::from(2 * i + 1)))
            .collect()
    };
    let engine = folder("engine.toml");
    let (cycle, stations) = (engine.find("[pressure.wiebe]").expect("a cycle"), engine.find("[[station]]").expect("stations"));
    let own = format!("{}[pressure.measured]\nfile = \"pressure.csv\"\n[chain]\nfile = \"chain.csv\"\n", &engine[..cycle]);
    let chain = "station,inertia_kg_m2,stiffness_to_next_n_m_per_rad,throws,damping_to_ground_n_m_s_per_rad\nhub,0.0125,1.25e5,,\ncranks,0.02,200000,1 2,2.5\nflywheel,0.3,,,\n";
    let harmonics = "order,amplitude_n_m,phase_deg\n0.5,300.25,12.5\n1,150.5,-7.25\n";
    let geometry = engine.find("[geometry]").expect("a geometry")..engine.find("[layout").expect("a layout");
    let mut of_harmonics = format!("{}[pressure.harmonics]\nfile = \"harmonics.csv\"\n{}", &engine[..cycle], &engine[stations..]);
    of_harmonics.replace_range(geometry, "");
    let damper =
        "temperature_c,frequency_hz,stiffness_n_m_per_rad,loss_factor\n0,5,100.5,0.2\n0,500,120,0.25\n40,5,80,0.2\n40,500,90.125e0,0.3\n";
    let tables = [
        ("chain.csv", chain.to_owned()),
        ("pressure.csv", format!("crank_deg,1000_rpm_bar,4000_rpm_bar\n{}", rows(40.0))),
        ("harmonics.csv", harmonics.to_owned()),
        (
            "dampers.csv",
            "name,type,ring_inertia_kg_m2,stiffness_n_m_per_rad,loss_factor\na,rubber,0.005,3500.5,0.15\nb,rubber,0.0075,2500,0.2\n".into(),
        ),
        ("damper.csv", damper.to_owned()),
        ("amplitudes.csv", "design,order,speed_rpm,hub_amplitude_deg\ngiven,2,2000,0.125\n".into()),
        ("history.csv", folder("history.csv")),
        ("units.csv", folder("units.csv")),
        ("loads.csv", folder("loads.csv")),
    ];
    let published = format!("{}[published]\nengine = \"two\"\namplitudes = \"amplitudes.csv\"\n", folder("study.toml"));
    for (name, table) in &tables {
        written(place.path(), name, table);
        written(other.path(), name, german(table));
    }
    for place in [place.path(), other.path()] {
        written(place, "engine.toml", &own);
        written(place, "study.toml", &published);
        written(place, "second.toml", folder("study.toml").replace("engine.toml", "of_harmonics.toml"));
        written(place, "of_harmonics.toml", &of_harmonics);
        written(place, "third.toml", folder("catalogue_study.toml"));
        written(place, "fourth.toml", folder("measured_study.toml"));
        written(place, "material.toml", folder("material.toml"));
    }
    let material = ["--material", "material.toml"];
    let fatigue = [vec!["fatigue", "history.csv"], vec!["fatigue", "--unit-loads", "units.csv", "--loads", "loads.csv"]];
    let commands = [
        vec!["check", "--verbose", "study.toml"],
        vec!["check", "--verbose", "second.toml"],
        vec!["check", "--verbose", "third.toml"],
        vec!["check", "--verbose", "fourth.toml"],
    ]
    .into_iter()
    .chain(fatigue.into_iter().map(|command| [command, material.to_vec()].concat()))
    .chain([vec!["fit", "damper.csv", "--type", "rubber", "--reference-c", "0"]]);
    for command in commands {
        let (expected, found) = (hartog(place.path(), &command), hartog(other.path(), &command));
        assert_eq!(expected.0, 0, "{command:?}: {}", expected.2);
        assert_eq!(found.0, 0, "{command:?}: {}", found.2);
        // the model, without what is said of the files and of what is unlikely
        let told = |text: &str| {
            let end = [text.find("note:"), text.find("warning:")].into_iter().flatten().min().unwrap_or(text.len());
            text[..end].lines().filter(|l| !l.contains(" points in ")).collect::<Vec<_>>().join("\n").trim_end().to_owned()
        };
        assert_eq!(told(&expected.1), told(&found.1), "{command:?}");
        let words = (found.1 + &found.2).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("above the header is left out: `Prüfstand 3, Motor 4711`"), "{command:?}: {words}");
    }
    for name in ["out/history/fatigue.csv", "out/units/fatigue.csv"] {
        assert_eq!(text(&place.path().join(name)), text(&other.path().join(name)), "{name}");
    }
}

pub const CHAIN: &str = "Station;J [kg m2];k [N m/rad]\nhub;0,01;300000\ncrank;0,02;900000\nwheel;0,9;\n";

/// What `import` says of a chain that it refuses.
pub fn refused(place: &Path, chain: impl AsRef<[u8]>) -> String {
    written(place, "c.csv", chain);
    let (code, _, told) = hartog(place, &["import", "c.csv", "own", "--throws", "crank"]);
    assert!(code == 2 && !place.join("own").exists(), "{told}");
    told
}

/// Inertias and stiffnesses of the chain that `import` makes of a table; the rest of what it says.
pub fn imported(chain: impl AsRef<[u8]>) -> (Vec<[f64; 2]>, String) {
    let place = tempfile::tempdir().expect("a folder");
    written(place.path(), "c.csv", chain);
    let (code, out, told) = hartog(place.path(), &["import", "c.csv", "own", "--throws", "crank"]);
    assert_eq!(code, 0, "{told}");
    let study = hartog::input::read(&place.path().join("own/study.toml")).unwrap_or_else(|e| panic!("{e}"));
    (study.chain.stations.iter().map(|s| [s.inertia, s.stiffness_to_next]).collect(), out + &told)
}

fn is_chain(found: &[[f64; 2]]) -> bool {
    let expected = [[0.01, 3e5], [0.02, 9e5], [0.9, 0.0]];
    found.len() == 3 && found.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() <= 1e-12 * b.abs())
}

/// One chain by heads of four languages and units of two systems is one chain. Factors: a lbf is 4.4482216152605 N and an inch 0.0254 m by definition (NIST SP 811), a degree pi/180 rad;
/// tolerance: the rounding of the numbers in the tables.
#[test]
fn heads_and_units_of_four_languages() {
    let (lbf_in, deg) = (4.448_221_615_260_5 * 0.0254, 180.0 / std::f64::consts::PI);
    let heads = [
        "Stelle;Massenträgheitsmoment [kg m²];Drehsteifigkeit [N m/rad]",
        "Bezeichnung;Trägheitsmoment in kg m²;Steifigkeit (zur nächsten) (Nm/rad)",
        "Masse;Traegheitsmoment [kg·m^2];Torsionssteifigkeit [N·m·rad^-1]",
        "Nom;Inertie [kg.m2];Raideur [Nm/rad]",
        "Estação;Momento de inércia [kg m²];Rigidez [N m rad⁻¹]",
        "Station;\"Mass moment\nof inertia [kg m²]\";Stiffness [N m/rad]",
        // as DIN and ISO 80000 write units, and in a row of their own
        "Bauteil;Trägheitsmoment / kg m²;Verdrehsteifigkeit / N m/rad",
        "Bezeichnung;J in kgm2;c in Nm/rad",
        "Benennung;Drehmasse kg m²;Federrate Nm/rad",
        "Bezeichnung;Trägheitsmoment;Steifigkeit\n;[kg m²];[N m/rad]",
    ];
    for head in heads {
        let (found, told) = imported(CHAIN.replace("Station;J [kg m2];k [N m/rad]", head));
        assert!(is_chain(&found), "{head}: {found:?} {told}");
    }
    let units = [
        ("kN m/deg", 1e3 * deg, "kg m2", 1.0),
        ("kN·m/°", 1e3 * deg, "g m²", 1e-3),
        ("kNm/Grad", 1e3 * deg, "kg cm2", 1e-4),
        ("lb in/rad", lbf_in, "lb in s²", lbf_in),
        ("lbf·ft/rad", 12.0 * lbf_in, "lbf·in·s^2", lbf_in),
        ("in-lb/rad", lbf_in, "in-lb-s2", lbf_in),
        ("ft lb/rad", 12.0 * lbf_in, "lb ft s²", 12.0 * lbf_in),
    ];
    for (stiffness, k, inertia, j) in units {
        let rows = [("hub", 0.01, 3e5), ("crank", 0.02, 9e5), ("wheel", 0.9, 0.0)]
            .map(|(name, own, next)| format!("{name};{};{}\n", own / j, next / k));
        let (found, told) = imported(format!("Station;J [{inertia}];k [{stiffness}]\n{}", rows.concat()));
        assert!(is_chain(&found), "{stiffness}, {inertia}: {found:?} {told}");
    }
}

/// A column of numbers beside one of words tells rows apart and names no station; alone it names them.
#[test]
fn stations_are_named_by_words() {
    let place = tempfile::tempdir().expect("a folder");
    let names = |head: &str, throw: &str| {
        let rows = ["hub;0,01;300000", "crank;0,02;900000", "wheel;0,9;"];
        let rows: Vec<String> = rows.iter().enumerate().map(|(i, row)| format!("{};{row}", i + 1)).collect();
        written(place.path(), "c.csv", format!("{head}\n{}\n", rows.join("\n")));
        let (code, _, told) = hartog(place.path(), &["import", "c.csv", throw, "--throws", throw]);
        assert_eq!(code, 0, "{told}");
        let study = hartog::input::read(&place.path().join(throw).join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        study.chain.stations.into_iter().map(|s| s.name).collect::<Vec<_>>()
    };
    assert_eq!(names("Stelle;Bezeichnung;J [kg m2];k [N m/rad]", "crank"), ["hub", "crank", "wheel"]);
    assert_eq!(names("Stelle;Bemerkung;J [kg m2];k [N m/rad]", "2"), ["1", "2", "3"]);
}

/// Numbers with grouped thousands are read where one reading is possible, by themselves or by the rest of the table, and else refused with both readings; nothing is guessed. A remark names what the
/// rest of the table has told.
#[test]
fn grouped_thousands_are_read_or_refused() {
    let read = |from: &str, to: &str| imported(CHAIN.replace(from, to));
    for grouped in ["300 000", "300\u{a0}000", "300\u{202f}000,0", "300'000", "300.000,0", "3,0e5", "3e5", "300000,000"] {
        let (found, told) = read("300000", grouped);
        assert!(is_chain(&found), "{grouped}: {found:?} {told}");
    }
    // a wheel of 1234.5 kg m² shows what points mean
    let (found, told) = imported(CHAIN.replace("300000", "300.000").replace("0,9;", "1.234,5;"));
    assert!(
        found[0][1] == 3e5
            && found[2][0] == 1234.5
            && told.contains("`300.000` in row 2 is read as 300000: the point groups thousands in `1.234,5` (row 4)"),
        "{found:?} {told}"
    );
    // so does the comma of another number where semicolons separate columns
    let (found, told) = read("300000", "300.000");
    let words = "`300.000` in row 2 is read as 300000: the point is no decimal sign where the comma is one, in `0,01` (row 2)";
    assert!(is_chain(&found) && told.contains(words), "{found:?} {told}");
    let (found, told) = imported(CHAIN.replace("0,01", "1").replace("0,02", "1").replace("0,9;", "1,234;"));
    let words = "`1,234` in row 4 is read as 1.234: the comma separates decimals where semicolons separate columns";
    assert!(found[2][0] == 1.234 && told.contains(words), "{found:?} {told}");
    let (found, _) = imported(CHAIN.replace("0,9;", "1,234;"));
    assert_eq!(found[2][0], 1.234, "three decimals in a table with decimal commas");
    let (found, _) = imported(CHAIN.replace(',', ".").replace("0.9;", "1.234;"));
    assert_eq!(found[2][0], 1.234, "three decimals in a table with decimal points");
    let place = tempfile::tempdir().expect("a folder");
    for (text, place_of, both) in [
        (
            CHAIN.replace("0,01", "1").replace("0,02", "1").replace("0,9;", "1;").replace("300000", "300.000"),
            "row 2, column `k [N m/rad]`",
            "found `300.000`, expected a number that can be read in one way: this is 300000 or 300.000",
        ),
        (
            CHAIN.replace(',', ".").replace("300000", "300,000"),
            "row 2, column `k [N m/rad]`",
            "found `300,000`, expected a number that can be read in one way: this is 300000 or 300.000",
        ),
        (CHAIN.replace("0,9;", "1.23.4;"), "row 4, column `J [kg m2]`", "found `1.23.4`, expected a number"),
        (CHAIN.replace("0,9;", "0,9;5;7"), "row 4", "found 4 cells, expected 3"),
        (CHAIN.replace("0,9;", "\"0,9;"), "row 4", "found a quotation mark that is not closed"),
    ] {
        let told = refused(place.path(), &text);
        assert!(told.contains(place_of) && told.contains(both), "{text}: {told}");
    }
}

/// Titles, blank lines, comments and line ends of Windows above a mistake leave its row that of the file, and the cell as it stands there; a chain with a title but without a header that is known is
/// refused by its first line.
#[test]
fn mistakes_keep_their_row() {
    let place = tempfile::tempdir().expect("a folder");
    let lines = "sep=;\r\nMotor 4711;;;\r\n\r\n# von Hand\r\nStation;J [kg m2];k [N m/rad];;\r\n\r\n;;;\r\nhub;0,01;300000\r\ncrank;\"0,\n02\";900000\r\nwheel;0,9;\r\n";
    let told = refused(place.path(), lines);
    assert!(told.contains("found `0,…`, expected a number") && told.contains("c.csv, row 9, column `J [kg m2]`"), "{told}");
    let told = refused(place.path(), lines.replace("\"0,\n02\"", "0,02").replace("wheel;0,9", "wheel;viel"));
    assert!(told.contains("found `viel`, expected a number") && told.contains("c.csv, row 10, column `J [kg m2]`"), "{told}");
    for (from, to, words) in [
        ("crank", "hub", "found station `hub` a second time, expected different names\n  --> c.csv, row 3, column `Station`"),
        (
            "900000",
            "-",
            "found no stiffness from `crank` to the next station, expected one for all but the last\n  --> c.csv, row 3, column `k [N m/rad]`",
        ),
        ("0,9;", "0,9;5", "found a stiffness behind the last station `wheel`, expected none\n  --> c.csv, row 4, column `k [N m/rad]`"),
    ] {
        let told = refused(place.path(), CHAIN.replace(from, to));
        assert!(told.contains(words), "{told}");
    }
    let told = refused(place.path(), "Motor 4711\nhub;0,01;300000\ncrank;0,02;900000\n");
    assert!(told.contains("found columns `Motor 4711`, expected one like `Station` among them"), "{told}");
}

/// UTF-16 with its mark is read as it is; bytes of Windows-1252 (latin-1) are read, and named with the text they make; UTF-16 without its mark, bytes that are no text and workbooks are refused with what
/// mends it.
#[test]
fn encodings_are_read_or_named() {
    let chain = CHAIN.replace("Station;J [kg m2]", "Station;Trägheitsmoment [kg m²]");
    let units = |big: bool, text: &str| -> Vec<u8> {
        text.encode_utf16().flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    };
    for (big, mark) in [(false, [0xff, 0xfe]), (true, [0xfe, 0xff])] {
        let (found, told) = imported([&mark[..], &units(big, &chain.replace(';', "\t"))].concat());
        assert!(is_chain(&found) && !told.contains("note"), "{found:?} {told}");
    }
    let latin: Vec<u8> = chain.chars().map(|c| u8::try_from(u32::from(c)).expect("latin-1")).collect();
    let (found, told) = imported(&latin);
    assert!(is_chain(&found) && told.contains("read as Windows-1252 (latin-1)") && told.contains("Trägheitsmoment"), "{told}");
    let place = tempfile::tempdir().expect("a folder");
    for (bytes, words) in [
        (units(false, &chain), "found a zero byte, as UTF-16 without its mark has, expected UTF-8"),
        ([CHAIN.as_bytes(), b"\x01\x81"].concat(), "found bytes that are not text, expected UTF-8"),
        ([&[0xff, 0xfe][..], &units(false, &chain), b"x"].concat(), "half a character of UTF-16"),
        (b"PK\x03\x04\x14\0".to_vec(), "found a workbook or archive, expected a table as text"),
        (Vec::new(), "found an empty table"),
    ] {
        let told = refused(place.path(), &bytes);
        assert!(told.contains(words), "{told}");
    }
}

/// A pressure in psi with heads in French and German is one in bar (a psi is 6894.757 Pa); gauge pressures and two columns that may be the pressure are refused.
#[test]
fn traces_of_other_countries() {
    let place = tempfile::tempdir().expect("a folder");
    written(place.path(), "c.csv", CHAIN);
    let rows = |unit: f64, more: &str| -> String {
        (0..=720)
            .map(|deg| format!("{deg};{}{more}\n", (format!("{:.6}", (1.0 + 60.0 / f64::from(1 + deg)) / unit)).replace('.', ",")))
            .collect()
    };
    let psi = 6_894.757_293_168 / 1e5;
    let mut found = Vec::new();
    for (i, (head, unit)) in [
        ("Winkel [°KW];Druck [bar]", 1.0),
        ("Angle vilebrequin [°];Pression cylindre [psi]", psi),
        ("Ângulo [graus];Pressão [MPa]", 10.0),
        ("Kurbelwinkel in Grad;Zylinderdruck in bar", 1.0),
        ("°KW;bar", 1.0),
        ("Kurbelwinkel / °KW;Druck / bar", 1.0),
        ("Angle vilebrequin [°V];Pression [bar]", 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        written(place.path(), "t.csv", format!("Messung 12\n{head}\n{}", rows(unit, "")));
        let own = format!("own{i}");
        let (code, _, told) = hartog(place.path(), &["import", "c.csv", &own, "--throws", "crank", "--trace", "2000=t.csv"]);
        assert_eq!(code, 0, "{head}: {told}");
        let study = hartog::input::read(&place.path().join(own).join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        found.push(hartog::engine::Excitation::new(&study.engine, 12.0).audit[0].peak_pressure / 1e5);
    }
    assert!(found.iter().all(|peak| (peak - 61.0).abs() < 1e-3), "{found:?}");
    for (head, more, words) in [
        ("Winkel [°KW];Druck [bar(ü)]", "", "pressures are absolute"),
        ("Winkel [°KW];Überdruck [bar]", "", "pressures are absolute"),
        ("Angle [deg];Gauge pressure [bar]", "", "pressures are absolute"),
        ("Winkel [°KW];Druck rel. [bar]", "", "pressures are absolute"),
        ("Kurbelwinkel v. OT [°KW];Druck [bar]", "", "angles before it are negative"),
        ("Angle BTDC [deg];Pressure [bar]", "", "angles before it are negative"),
        ("Kurbelwinkel nach UT [°];Druck [bar]", "", "expected angles from the firing (top) dead centre"),
        ("Winkel [°KW];Druck [mPa]", "", "did you mean `MPa`?"),
        (
            "Winkel [°KW];Saugrohrdruck [bar];Zylinderdruck [bar]",
            ";1",
            "found `Saugrohrdruck [bar]` and `Zylinderdruck [bar]`, expected one column",
        ),
    ] {
        written(place.path(), "t.csv", format!("{head}\n{}", rows(1.0, more)));
        let (code, _, told) = hartog(place.path(), &["import", "c.csv", "no", "--throws", "crank", "--trace", "2000=t.csv"]);
        assert!(code == 2 && told.contains(words), "{head}: {told}");
    }
    let (code, _, told) = hartog(place.path(), &["import", "c.csv", "no", "--throws", "crank", "--trace", "2.000=t.csv"]);
    assert!(code == 2 && told.contains("may be grouped thousands"), "{told}");
}

/// Mistakes of files that are not what a command takes say what mends them: a path of Windows in double quotes, a table in place of a study, an engine or a material, an empty `size`, an empty file.
#[test]
fn messages_mend() {
    let place = tempfile::tempdir().expect("a folder");
    written(place.path(), "chain.csv", CHAIN);
    written(place.path(), "two.csv", "Winkel [°KW];p 2000 1/min [bar];p 4000 1/min [bar]\n0;20;25\n360;1;1\n719;19;24\n");
    let (code, _, told) = hartog(place.path(), &["import", "chain.csv", "of_two", "--throws", "crank", "--trace", "2000=two.csv"]);
    assert!(code == 2 && told.contains("a table with a column a speed is read by `pressure.measured.file`"), "{told}");
    let study = text(&bad_input().join("study.toml"));
    written(place.path(), "engine.toml", text(&bad_input().join("engine.toml")));
    written(place.path(), "c.csv", CHAIN);
    written(place.path(), "e.toml", "# nothing\n");
    let with = |engine: &str| study.replace("\"engine.toml\"", engine);
    let quotes = "a path of Windows stands in single quotes, 'C:\\data\\x.csv', or has the strokes of others, \"C:/data/x.csv\"";
    let files = [
        ("drive.toml", with("\"C:\\data\\engine.toml\""), quotes),
        ("escapes.toml", with("\"C:\\new\\table.toml\""), quotes),
        ("users.toml", with("\"C:\\users\\engine.toml\""), quotes),
        (
            "size.toml",
            study.replace("size.ring_inertia_kg_m2.between = [0.001, 0.01]", "size = {}"),
            "found an empty table, expected one choice in it",
        ),
        ("table.toml", with("\"c.csv\""), "found a table, expected an engine file in TOML"),
        ("latin.toml", study.clone(), "this may be latin-1 (Windows-1252): save the file as UTF-8"),
    ];
    for (name, text, words) in files {
        written(place.path(), name, text.as_bytes());
        if name == "latin.toml" {
            written(place.path(), name, [text.as_bytes(), b"# K\xfchler\n"].concat());
        }
        let (code, _, told) = hartog(place.path(), &["check", name]);
        assert!(code == 2 && told.contains(words), "{name}: {told}");
    }
    for (arguments, words) in [
        (
            ["run", "c.csv"],
            "found a table, expected a study in TOML\n  --> c.csv\n  = help: `hartog import c.csv own` makes a study of a table of masses and shafts",
        ),
        (["check", "c.csv"], "found a table, expected a study in TOML"),
        (["size", "c.csv"], "found a table, expected a sizing file in TOML"),
        (["check", "e.toml"], "found an empty file, expected one with keys"),
        (["size", "e.toml"], "found an empty file, expected one with keys"),
    ] {
        let (code, _, told) = hartog(place.path(), &arguments);
        assert!(code == 2 && told.contains(words), "{arguments:?}: {told}");
    }
}
