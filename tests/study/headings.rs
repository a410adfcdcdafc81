//! What lies where in a chain of another program: to ground, to the next station, to the one before; sums, shafts, the sequence of the rows.

use crate::dialects::{CHAIN, hartog, imported, refused, written};
use crate::support::assert_close;
use hartog::input::tables::{HistoryReader, Superposed};
use std::path::Path;

/// A damping is to ground or to the next station by the words of its head, full or short; one that says neither is left out with the heads that do. What lies before a station, sums and rows of shafts are
/// refused: read as between a station and the next one they would give another chain.
#[test]
fn what_lies_where_in_a_chain() {
    let place = tempfile::tempdir().expect("a folder");
    let damped = |head: &str| CHAIN.replace('\n', ";5\n").replace("rad];5", &format!("rad];{head} [N m s/rad]")).replace("0,9;;5", "0,9;;");
    for (i, (head, ground, next)) in [
        ("Abs. Dämpfung", 5.0, 0.0),
        ("Äußere Dämpfung", 5.0, 0.0),
        ("Dämpfung gegen Gehäuse", 5.0, 0.0),
        ("Dämpfung gegen Erde", 5.0, 0.0),
        ("Dämpfung gegen Gestell", 5.0, 0.0),
        ("Rel. Dämpfung", 0.0, 5.0),
        ("Innere Dämpfung", 0.0, 5.0),
    ]
    .into_iter()
    .enumerate()
    {
        let own = format!("own{i}");
        written(place.path(), "c.csv", damped(head));
        let (code, out, told) = hartog(place.path(), &["import", "c.csv", &own, "--throws", "crank"]);
        assert!(code == 0 && !out.contains("Left out"), "{head}: {out}{told}");
        let study = hartog::input::read(&place.path().join(own).join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        let crank = &study.chain.stations[1];
        assert_eq!((crank.damping_to_ground, crank.damping_to_next), (ground, next), "{head}");
    }
    // the relative damping of a coupling's maker is 2 pi loss factors [DIN 740-2], and without a unit
    let psi = 5.0 / std::f64::consts::TAU;
    for (i, (head, loss)) in [
        ("Relative Dämpfung ψ [-]", psi),
        ("rel. Dämpfung [-]", psi),
        ("Dämpfung [ψ]", psi),
        ("Verlustfaktor", 5.0),
        ("Loss factor [%]", 0.05),
    ]
    .into_iter()
    .enumerate()
    {
        let own = format!("loss{i}");
        written(place.path(), "c.csv", damped("").replace(" [N m s/rad]", head));
        let (code, out, told) = hartog(place.path(), &["import", "c.csv", &own, "--throws", "crank"]);
        assert!(code == 0 && !out.contains("Left out"), "{head}: {out}{told}");
        let study = hartog::input::read(&place.path().join(own).join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        let crank = &study.chain.stations[1];
        assert_close(crank.loss_factor_to_next, loss, 1e-13, 0.0, head);
        assert_eq!((crank.damping_to_ground, crank.damping_to_next), (0.0, 0.0), "{head}");
    }
    let (_, told) = imported(damped("Dämpfung"));
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        told.contains("as `Damping to next [N m s/rad]` (Relative Dämpfung) and `Damping to ground [N m s/rad]` (Absolute Dämpfung) do"),
        "{told}"
    );
    // in German tables c is the stiffness and k the damping: their units tell
    let (_, told) = imported(damped("k").replace("k [N m/rad]", "c [N m/rad]"));
    assert!(told.contains("column `k [N m s/rad]`, which does not say whether"), "{told}");
    let (_, told) = imported(damped("Drehsteifigkeit gegen Gehäuse").replace("[N m s/rad]", "[N m/rad]"));
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("a stiffness to ground, which has to be put in by `stiffness_to_ground_n_m_per_rad`"), "{told}");
    let (_, told) = imported("Station;J [kg m2];k [N m/rad]\nwheel;0,9;900000\ncrank;0,02;300000\nhub;0,01;\n");
    assert!(told.contains("note: the chain begins with `wheel`, its largest inertia"), "{told}");
    let place = tempfile::tempdir().expect("a folder");
    for (chain, words) in [
        (CHAIN.replace("k [N m/rad]", "Steifigkeit zur vorherigen Masse [N m/rad]"), "move the column up by one row"),
        (format!("{CHAIN}Summe;0,93;\n"), "found `Summe`, expected a station"),
        (CHAIN.replace("J [kg m2]", "Trägheitsmoment ×10⁻⁴ [kg m2]"), "found `×10⁻⁴` beside the unit"),
        (CHAIN.replace("J [kg m2]", "Trägheitsmoment x 10^3 [kg m2]"), "found `x 10^3` beside the unit"),
        (CHAIN.replace("hub;0,01;300000", "hub;0,01;\nshaft;;300000"), "found no inertia, expected one above zero: a row is a station"),
    ] {
        let told = refused(place.path(), &chain);
        assert!(told.contains(words), "{chain}: {told}");
    }
}

/// A column that is left out says nothing of how numbers are written: `1.1` in a column of positions does not make `1.450` one and a half.
#[test]
fn columns_that_are_left_out_say_nothing_of_decimals() {
    let place = tempfile::tempdir().expect("a folder");
    let chain = "Pos.;Station;J [kg cm²];k [N m/rad]\n1.1;hub;100;300000\n1.2;crank;200;900000\n1.3;wheel;1.450;\n";
    assert!(refused(place.path(), chain).contains("found `1.450`, expected a number that can be read in one way"));
    let other = chain.replace("100;300000", "100,5;300000");
    let (_, told) = imported(other);
    assert!(told.contains("`1.450` in row 4 is read as 1450"), "{told}");
}

/// Histories of stress and stresses per unit load as programs of finite elements and German offices head them: the same numbers as under our own keys. One number behind an S is a principal stress, and a component with two heads has
/// none.
#[test]
fn stresses_with_other_heads() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = "a;0;10,5;2;0;1;-3;4\na;120;-20;1;0;2;0;0\na;240;5;0;0,5;0;1;0\n";
    let own = "point;crank_deg;sxx_mpa;syy_mpa;szz_mpa;sxy_mpa;syz_mpa;szx_mpa\n";
    let read = |heads: &str, rows: &str| {
        written(folder.path(), "stress.csv", format!("{heads}{rows}"));
        let reader = HistoryReader::open(&folder.path().join("stress.csv")).map_err(|e| e.to_string())?;
        let points: Result<Vec<_>, _> = reader.collect();
        points.map(|p| format!("{p:?}")).map_err(|e| e.to_string())
    };
    let expected = read(own, rows);
    assert!(expected.is_ok(), "{expected:?}");
    for heads in [
        "Punkt;Kurbelwinkel [°KW];Sxx [MPa];Syy [MPa];Szz [MPa];Sxy [MPa];Syz [MPa];Szx [MPa]\n",
        "Spannungen aus FE;;;;;;;\nKnoten;Winkel [°];S11 (N/mm²);S22 (N/mm²);S33 (N/mm²);S12 (N/mm²);S23 (N/mm²);S13 (N/mm²)\n",
        "Point;Crank angle [deg];σ_x [MPa];σ_y [MPa];σ_z [MPa];τ_xy [MPa];τ_yz [MPa];τ_xz [MPa]\n",
        "Node;phi [deg];SX [MPa];SY [MPa];SZ [MPa];SXY [MPa];SYZ [MPa];SXZ [MPa]\n",
    ] {
        assert_eq!(read(heads, rows), expected, "{heads}");
    }
    let in_pa = rows.replace("10,5;2;", "1,05E7;2;");
    assert_eq!(read(&own.replace("sxx_mpa", "Sxx [Pa]"), &in_pa.replace("-20;", "-2E7;").replace("240;5;", "240;5E6;")), expected);
    let refused = |heads: &str, told: &str| {
        let error = read(heads, rows).expect_err(told);
        assert!(error.contains(told), "{error}");
    };
    refused(&own.replace("sxx_mpa", "S1 [MPa]"), "found no column `sxx_mpa`");
    refused(&own.replace("sxx_mpa", "Sxx"), "found no column `sxx_mpa`");
    refused(&own.replace("sxx_mpa", "Sxx [mm]"), "found no column `sxx_mpa`");
    let twice = own.replace("sxx_mpa", "Sxx [MPa]").replace("syy_mpa", "σx [MPa]");
    refused(&twice, "found columns `Sxx [MPa]` and `σx [MPa]`, which both are read as `sxx_mpa`");
    // loads over the cycle under a title, by the same angle
    let units = own.replace("crank_deg", "load") + "a;moment_n_m;1;0;0;0;0;0\n";
    written(folder.path(), "units.csv", units);
    let superposed = |loads: &str| {
        written(folder.path(), "loads.csv", loads);
        let points = Superposed::open(&folder.path().join("units.csv"), &folder.path().join("loads.csv")).unwrap_or_else(|e| panic!("{e}"));
        points.map(|p| format!("{:?}", p.unwrap_or_else(|e| panic!("{e}")))).collect::<Vec<_>>()
    };
    let in_degrees = "0;1,5\n120;2\n240;-3\n";
    let expected_points = superposed(&format!("crank_deg;moment_n_m\n{in_degrees}"));
    assert_eq!(superposed(&format!("Lasten vorn;\nKurbelwinkel [°KW];moment_n_m\n{in_degrees}")), expected_points);
    // beside our own names, other columns are left out as ever
    let more = rows.lines().map(|row| format!("{row};17;9\n")).collect::<String>();
    assert_eq!(read(&own.replace('\n', ";node;S11 [MPa]\n"), &more), expected);
}

/// Measured stiffness by a loss angle, whose tangent is the loss factor, by its magnitude, and with units in a row of their own: the numbers that stand under our own keys.
#[test]
fn measurements_by_angles_and_magnitudes() {
    let folder = tempfile::tempdir().expect("a folder");
    let german = "Temperatur [°C];Frequenz [Hz];dyn. Drehsteifigkeit [kNm/rad];Verlustfaktor [-]\r\n\
                  0;5;100,5;0,2\r\n0;500;120;0,25\r\n40;5;80;0,2\r\n40;500;90,125;0,3\r\n";
    let read = |name: &str| hartog::input::tables::measured_law(&folder.path().join(name)).unwrap_or_else(|e| panic!("{e}"));
    written(folder.path(), "german.csv", german);
    // a loss angle has the loss factor for its tangent
    for (head, factor) in [("Verlustwinkel [°]", 1.0), ("phase angle [deg]", 1.0), ("Verlustwinkel δ [rad]", std::f64::consts::PI / 180.0)]
    {
        let angles = german.replace("Verlustfaktor [-]", head);
        let angles = [("0,25", 14.0), ("0,2", 11.5), ("0,3", 17.0)].iter().fold(angles, |text, (loss, deg): &(&str, f64)| {
            text.replace(&format!(";{loss}\r"), &format!(";{}\r", (deg * factor).to_string().replace('.', ",")))
        });
        written(folder.path(), "angles.csv", angles);
        let (real, lost) = read("angles.csv").stiffness[0][1];
        assert_close(real, 120e3, 1e-12, 0.0, head);
        assert_close(lost / real, (14.0 * std::f64::consts::PI / 180.0).tan(), 1e-12, 0.0, head);
    }
    // a magnitude has both parts
    let magnitude = german.replace("dyn. Drehsteifigkeit", "dyn. Drehsteifigkeit |c*|");
    written(folder.path(), "magnitude.csv", magnitude);
    let (real, lost) = read("magnitude.csv").stiffness[0][1];
    assert_close(real.hypot(lost), 120e3, 1e-12, 0.0, "magnitude");
    assert_close(lost / real, 0.25, 1e-12, 0.0, "loss factor");
    // units may stand in a row of their own
    let below = german.replace(
        " [°C];Frequenz [Hz];dyn. Drehsteifigkeit [kNm/rad];Verlustfaktor [-]",
        ";Frequenz;dyn. Drehsteifigkeit;Verlustfaktor\r\n°C;Hz;kNm/rad;-",
    );
    assert!(below != german);
    written(folder.path(), "below.csv", below);
    assert_eq!(format!("{:?}", read("german.csv")), format!("{:?}", read("below.csv")));
}

/// Measured stiffness and catalogues with the heads of a German laboratory, with a title, units and types in words: the same numbers as under our own keys, and a note of what was read as what.
#[test]
fn measurements_and_catalogues_with_german_heads() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = "temperature_c,frequency_hz,stiffness_n_m_per_rad,loss_factor\n0,5,100500,0.2\n0,500,120000,0.25\n40,5,80000,0.2\n40,500,90125,0.3\n";
    let german = "Prüfbericht NR 60;;;\r\nTemperatur [°C];Frequenz [Hz];dyn. Drehsteifigkeit [kNm/rad];Verlustfaktor [-]\r\n\
                  0;5;100,5;0,2\r\n0;500;120;0,25\r\n40;5;80;0,2\r\n40;500;90,125;0,3\r\n";
    written(folder.path(), "own.csv", own);
    written(folder.path(), "german.csv", german);
    let read = |name: &str| hartog::input::tables::measured_law(&folder.path().join(name)).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(format!("{:?}", read("own.csv")), format!("{:?}", read("german.csv")));
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let study = format!(
        "engine = '{}'\nspeed_rpm = {{ from = 600, to = 3200, step = 200 }}\norder_limit = 6\n[[objective]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\" }}\n[[catalogue]]\non.station = \"pulley\"\nfile = \"catalogue.csv\"\nbest = 1\n",
        engine.display()
    );
    let catalogue = |text: &str| {
        written(folder.path(), "catalogue.csv", text);
        let study = hartog::input::Study::from_toml(&study, folder.path().join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        format!("{:?}", study.catalogues[0].designs)
    };
    let keys = "name,type,ring_inertia_kg_m2,stiffness_n_m_per_rad,loss_factor,damping_n_m_s_per_rad\na,rubber,0.04,26687,0.12,\nb,viscous,0.04,,,35\n";
    let words = "Lieferprogramm 2024;;;;;\r\nBezeichnung;Bauart;Ringträgheit [kg cm²];Drehsteifigkeit [Nm/rad];Verlustfaktor [-];Dämpfung [Nms/rad]\r\na;Gummi;400;26.687;0,12;\r\nb;Viskose;400;;;35\r\n";
    assert_eq!(catalogue(keys), catalogue(words));
    // a share in per cent, the tangent of the loss angle, and two columns for one key
    assert_eq!(catalogue(keys), catalogue(&words.replace("Verlustfaktor [-]", "tan δ [%]").replace(";0,12;", ";12,0;")));
    // the spring by the frequency of the ring on its held hub, the inertia of the hub beside it
    let omega = 2.0 * std::f64::consts::PI * 130.0;
    let stiff = keys.replace("26687", &(0.04 * omega * omega).to_string()).replace("per_rad\n", "per_rad,hub_inertia_kg_m2\n");
    let stiff = stiff.replace("0.12,\n", "0.12,,0.002\n").replace(",35\n", ",35,\n");
    let frequency =
        words.replace("Drehsteifigkeit [Nm/rad]", "Eigenfrequenz [Hz]").replace("[Nms/rad]\r", "[Nms/rad];Nabenträgheit [kg cm²]\r");
    let frequency = frequency.replace("26.687", "130").replace("0,12;\r", "0,12;;20\r").replace(";35\r", ";35;\r");
    assert_eq!(catalogue(&stiff), catalogue(&frequency));
    // beside a stiffness it is left out
    let both = words.replace("Drehsteifigkeit [Nm/rad]", "Eigenfrequenz [Hz];Drehsteifigkeit [Nm/rad]").replace(";26.687;", ";130;26.687;");
    assert_eq!(catalogue(keys), catalogue(&both.replace(";400;;;35", ";400;;;;35")));
    let twice = words.replace("Bezeichnung;", "Artikel-Nr.;Bezeichnung;").replace("\r\na;", "\r\n7;a;").replace("\r\nb;", "\r\n8;b;");
    // of two that say what a row is called the first counts, in letters that files may have
    assert_eq!(catalogue(&keys.replace("\na,", "\n7,").replace("\nb,", "\n8,")), catalogue(&twice));
    let sold = words.replace("\r\na;", "\r\nDämpfer Nr. 7;").replace("\r\nb;", "\r\nDämpfer Nr. 8;");
    assert_eq!(catalogue(&keys.replace("\na,", "\nDaempfer_Nr._7,").replace("\nb,", "\nDaempfer_Nr._8,")), catalogue(&sold));
    // the hub's in any words, and no frequency of a damper on its engine
    for hub in ["Trägheit Nabe [kg cm²]", "Massenträgheitsmoment Nabe [kg cm²]", "Trägheit primär [kg cm²]"] {
        assert_eq!(catalogue(&stiff), catalogue(&frequency.replace("Nabenträgheit [kg cm²]", hub)), "{hub}");
    }
    written(folder.path(), "catalogue.csv", frequency.replace("Eigenfrequenz [Hz]", "Eigenfrequenz eingebaut [Hz]"));
    let error = hartog::input::Study::from_toml(&study, folder.path().join("study.toml")).expect_err("coupled").to_string();
    assert!(error.contains("or `own_frequency_hz`, that of the ring on its hub held fast"), "{error}");
    // a modulus is no stiffness
    written(folder.path(), "modulus.csv", german.replace("dyn. Drehsteifigkeit [kNm/rad]", "Speichermodul G' [N/mm²]"));
    let error = hartog::input::tables::measured_law(&folder.path().join("modulus.csv")).expect_err("a modulus").to_string();
    assert!(error.contains("expected the stiffness of an element") && error.contains("4 pi L/(1/r_i²"), "{error}");
    written(folder.path(), "catalogue.csv", words.replace("Drehsteifigkeit [Nm/rad]", "Drehsteifigkeit x10³ [Nm/rad]"));
    assert!(hartog::input::Study::from_toml(&study, folder.path().join("study.toml")).is_err(), "a factor beside the unit");
    // what is not the ring's, not stiffness or no frequency is not taken for it
    for (head, other) in [("Frequenz [Hz]", "Kreisfrequenz [1/s]"), ("dyn. Drehsteifigkeit [kNm/rad]", "Verluststeifigkeit [kNm/rad]")] {
        written(folder.path(), "other.csv", german.replace(head, other));
        let error = hartog::input::tables::measured_law(&folder.path().join("other.csv")).expect_err(other).to_string();
        assert!(error.contains(other), "{error}");
    }
    written(folder.path(), "catalogue.csv", words.replace("Ringträgheit", "Nabenträgheit"));
    let error = hartog::input::Study::from_toml(&study, folder.path().join("study.toml")).expect_err("of the hub").to_string();
    assert!(error.contains("`hub_inertia_kg_m2`") && error.contains("expected `ring_inertia_kg_m2` among them"), "{error}");
    // neither is a static stiffness that of a ring
    let other = "stat. Drehsteifigkeit";
    written(folder.path(), "catalogue.csv", words.replace("Drehsteifigkeit", other));
    let error = hartog::input::Study::from_toml(&study, folder.path().join("study.toml")).expect_err(other).to_string();
    assert!(error.contains(other) && error.contains("among them"), "{error}");
    // what no type has is left out, whatever it holds
    let more = words.replace("\r\na;", ";Masse [kg];Preis\r\na;").replace(";0,12;", ";0,12;;2,4;19,90").replace(";;;35", ";;;35;x;");
    assert_eq!(catalogue(keys), catalogue(&more));
}

/// Traces that an engine file names itself, under the heads of an indicating system: speed and load in the head of each, another unit of pressure and angle. Pressures above that of the surroundings and angles before the dead centre are
/// not taken.
#[test]
fn traces_of_an_engine_file_with_other_heads() {
    let place = tempfile::tempdir().expect("a folder");
    let (code, _, told) = hartog(place.path(), &["new", "own", "--cylinders", "4", "--pressure", "measured"]);
    assert_eq!(code, 0, "{told}");
    let own = place.path().join("own");
    let table = std::fs::read_to_string(own.join("pressure.csv")).expect("a table");
    let read = || hartog::input::read(&own.join("study.toml")).map(|s| format!("{:?}", s.engine.source)).map_err(|e| e.to_string());
    let expected = read().expect("its own heads");
    let headed = |angle: &str, [first, second]: [&str; 2]| {
        written(&own, "pressure.csv", table.replace("crank_deg,800_rpm_bar,4000_rpm_bar", &format!("{angle},{first},{second}")));
        read()
    };
    let bar = ["p 800 1/min [bar]", "p 4000 1/min [bar]"];
    for (angle, pressures) in [
        ("Kurbelwinkel [°KW]", ["Zylinderdruck 800 U/min [bar]", "Zylinderdruck 4000 U/min [bar]"]),
        ("Crank angle [deg]", ["800rpm 100% [bar abs]", "4000rpm 100% [bara]"]),
        ("angle / °CA", bar),
        ("Kurbelwinkel [°KW]", ["n=800 1/min [bar]", "n = 4000 min⁻¹ p_Zyl [bar]"]),
    ] {
        assert_eq!(headed(angle, pressures).as_ref(), Ok(&expected), "{angle}");
    }
    let part_load = [bar[0], "p 800 1/min 50 % [bar]"];
    let own_part_load = headed("crank_deg", ["800_rpm_bar", "800_rpm_50_percent_bar"]);
    assert!(own_part_load.is_ok() && own_part_load == headed("Kurbelwinkel [°KW]", part_load), "{own_part_load:?}");
    for (angle, pressures, told) in [
        ("Winkel v. OT [°]", bar, "found columns `Winkel v. OT [°]`"),
        ("Winkel [°]", ["Überdruck 800 1/min [bar]", bar[1]], "found column `Überdruck 800 1/min [bar]`, expected absolute pressures"),
        ("Winkel [°]", ["p [bar]", bar[1]], "found column `p [bar]`"),
        ("Winkel [°]", [bar[0], "p 4.000 1/min [bar]"], "found column `p 4.000 1/min [bar]`"),
        ("Winkel [°]", ["p 800 1/min [N]", bar[1]], "found column `p 800 1/min [N]`"),
    ] {
        let error = headed(angle, pressures).expect_err(told);
        assert!(error.contains(told), "{error}");
    }
}
