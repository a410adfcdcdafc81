//! Hostile use: folders that others write to, text that moves a cursor, counts that ask for all memory.

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::fs;

fn hartog(arguments: &[&str]) -> Assert {
    let mut c = Command::cargo_bin("hartog").expect("built");
    c.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).assert()
}

/// One run at a time writes to a folder; `summary.json`, written last, has the checksum of every file but that of times.
#[cfg(unix)]
#[test]
fn a_folder_belongs_to_one_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = || hartog(&["run", "studies/den_hartog.toml", "--out", &folder.path().to_string_lossy()]);
    run().success();
    let summary = fs::read_to_string(folder.path().join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    let files = summary["files"].as_array().expect("files");
    let names: Vec<String> =
        fs::read_dir(folder.path()).expect("a folder").map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    for name in names.iter().filter(|n| !["summary.json", "timing.csv"].contains(&n.as_str())) {
        let bytes = fs::read(folder.path().join(name)).expect("bytes");
        let entry = serde_json::json!({ "name": name, "bytes": bytes.len(), "crc32": format!("{:08x}", crc32(&bytes)) });
        assert!(files.contains(&entry), "{entry} in {files:?}");
    }
    let held = fs::File::open(folder.path()).expect("a folder");
    held.lock().expect("a lock");
    let refused = run().code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(text.contains("another run is writing to it"), "{text}");
}

/// CRC-32 of a text, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |c: u32| if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 };
    !bytes.iter().fold(!0, |c, b| (0..8).fold(c ^ u32::from(*b), |c, _| step(c)))
}

/// What files say is printed, whatever it does to a terminal: control characters, changed directions and characters without width stand as `\u{…}`; a word of a hundred thousand letters is cut, a line,
/// too, and the mistake is still underlined.
#[test]
fn nothing_from_a_file_moves_the_cursor() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = folder.path().join("study.toml");
    let long = "x".repeat(100_000);
    let checked = |text: String| {
        fs::write(&study, text).expect("written");
        let output = hartog(&["check", &study.to_string_lossy()]).code(2);
        String::from_utf8_lossy(&output.get_output().stderr).into_owned()
    };
    let text = checked("engine = \"a\\u001b]0;title\\u0007\\u202e\\u200b.toml\"\nspeed_rpm = { from = 1, to = 2, step = 1 }\n".into());
    assert!(text.contains("\\u{1b}") && text.contains("\\u{202e}"), "{text}");
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()) && !text.contains(['\u{202e}', '\u{200b}']), "{text:?}");
    let text = checked(format!("engine = \"{long}\"\nspeed_rpm = {{ from = 1, to = 2, step = 1 }}\n{long} = 3\n"));
    assert!(text.len() < 3000 && text.contains("(100000 characters)") && text.contains('^'), "{} characters", text.len());
}

/// Names that hide something, turn the text about them, or that a spreadsheet would compute are refused where they stand, in whatever file; so no cell of a table that is written begins so.
#[test]
fn names_hide_and_compute_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let engine = fs::read_to_string(root.join("studies/engines/villalva_i6.toml")).expect("an engine");
    let own = |name: &str| folder.path().join(name);
    let study =
        "engine = \"engine.toml\"\nspeed_rpm = { from = 1600, to = 2600, step = 500 }\norder_limit = 3\n[[design]]\nname = \"none\"\n";
    let sold = "[[catalogue]]\nfile = \"sold.csv\"\non.station = \"pulley\"\nbest = 1\n";
    let refused = |arguments: &[&str], place: &str| {
        let arguments: Vec<String> = arguments.iter().map(|a| a.replace('@', &folder.path().to_string_lossy())).collect();
        let output = hartog(&arguments.iter().map(String::as_str).collect::<Vec<_>>()).code(2);
        let text = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
        assert!(
            text.contains(place)
                && (text.contains("in a name, expected") || text.contains("of a name, expected") || text.contains("found the name")),
            "{text}"
        );
    };
    let row = |name: &str, deg: i32| format!("{name},{deg},{},0,0,0,0,0\n", if deg < 360 { 50 } else { -50 });
    for name in ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "＝1", "safe\u{202e}txt", "a\u{200b}b", "\u{2066}b", "b\u{7f}"] {
        let quoted =
            name.chars().map(|c| if c.is_ascii_graphic() { c.to_string() } else { format!("\\u{:04x}", u32::from(c)) }).collect::<String>();
        fs::write(own("engine.toml"), engine.replace("name = \"flywheel\"", &format!("name = \"{quoted}\""))).expect("written");
        fs::write(own("study.toml"), study).expect("written");
        refused(&["check", "@/study.toml"], "engine.toml:");
        fs::write(own("engine.toml"), &engine).expect("written");
        fs::write(own("study.toml"), study.replace("none", &quoted)).expect("written");
        refused(&["check", "@/study.toml"], "study.toml:5:8");
        fs::write(own("study.toml"), format!("{study}{sold}")).expect("written");
        fs::write(own("sold.csv"), format!("name,type,ring_inertia_kg_m2,damping_n_m_s_per_rad\n{name},viscous,0.1,10\n"))
            .expect("written");
        refused(&["check", "@/study.toml"], "sold.csv, row 2, column `name`");
        let history: String = (0..72).map(|i| row(name, 10 * i)).collect();
        fs::write(own("history.csv"), format!("point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n{history}"))
            .expect("written");
        let material = root.join("tests/bad_input/material.toml").to_string_lossy().into_owned();
        refused(&["fatigue", "@/history.csv", "--material", &material, "--out", "@/out"], "history.csv, row 2, column `point`");
        let chain = format!("Station;Inertia [kg m2];Stiffness to next [MN m/rad];Throws\n{name};0.1;1;1\nb;1;;\n");
        fs::write(own("chain.csv"), chain).expect("written");
        refused(&["import", "@/chain.csv", "@/imported"], "chain.csv, row 2, column `Station`");
    }
    // a sign alone computes nothing
    fs::write(own("engine.toml"), engine.replace("name = \"flywheel\"", "name = \"-\"")).expect("written");
    fs::write(own("study.toml"), study).expect("written");
    hartog(&["check", &own("study.toml").to_string_lossy()]).code(0);
}

/// Counts are bounded before anything is built from them: a huge `order_limit` is refused at once, a chain of more stations than any shaft has, and more samples than any cycle needs.
#[test]
fn counts_are_bounded() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let engine = root.join("studies/engines/villalva_i6.toml");
    let study = folder.path().join("study.toml");
    let speeds = "speed_rpm = { from = 600, to = 3200, step = 100 }\n[[design]]\nname = \"none\"\n";
    let refused = |study: &std::path::Path| {
        let output = hartog(&["check", &study.to_string_lossy()]).code(2);
        String::from_utf8_lossy(&output.get_output().stderr).into_owned()
    };
    for limit in ["1e9", "1e300", "inf", "nan"] {
        fs::write(&study, format!("engine = {:?}\norder_limit = {limit}\n{speeds}", engine)).expect("written");
        let text = refused(&study);
        assert!(text.contains("expected an order from 0.5 to 200"), "{text}");
    }
    let more: String = (0..2000)
        .map(|i| format!("\n[[station]]\nname = \"extra{i}\"\ninertia_kg_m2 = 1e-3\nstiffness_to_next_n_m_per_rad = 1e6\n"))
        .collect();
    let long = fs::read_to_string(&engine).expect("an engine") + &more;
    fs::write(folder.path().join("long.toml"), long).expect("written");
    fs::write(&study, format!("engine = \"long.toml\"\n{speeds}")).expect("written");
    let text = refused(&study);
    assert!(text.contains("expected at most 500"), "{text}");
    let row = |i: u32| format!("a,{},0,0,0,50,0,0\n", f64::from(i) * 720.0 / 100_001.0);
    let history =
        "point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n".to_owned() + &(0..100_001).map(row).collect::<String>();
    let (csv, material) = (folder.path().join("history.csv"), root.join("tests/bad_input/material.toml"));
    fs::write(&csv, history).expect("written");
    let output = hartog(&["fatigue", &csv.to_string_lossy(), "--material", &material.to_string_lossy()]).code(2);
    let text = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
    assert!(text.contains("found more than 100000 samples of point `a`"), "{text}");
}

/// A shaft of no stiffness to speak of leaves no frequency to lower: nothing is said of per cent where there is no number.
#[test]
fn no_per_cent_of_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let engine = fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml"));
    let engine = engine.expect("an engine");
    let stiffness = "stiffness_to_next_n_m_per_rad = ";
    let throw = engine.find("name = \"throw_1\"").expect("a throw");
    let at = throw + engine[throw..].find(stiffness).expect("a stiffness") + stiffness.len();
    let end = at + engine[at..].find('\n').expect("a line");
    fs::write(folder.path().join("engine.toml"), format!("{}1e-20{}", &engine[..at], &engine[end..])).expect("written");
    let study =
        "engine = \"engine.toml\"\nspeed_rpm = { from = 600, to = 3200, step = 650 }\norder_limit = 3\n[[design]]\nname = \"none\"\n";
    let path = folder.path().join("study.toml");
    fs::write(&path, study).expect("written");
    let printed = hartog(&["check", &path.to_string_lossy()]).code(0);
    let text = String::from_utf8_lossy(&printed.get_output().stdout).replace("\n    ", " ");
    assert!(!text.contains("inf") && !text.contains("NaN") && text.contains("f1 is too near to zero"), "{text}");
}

/// A whole number that is too large is told of in words; a station that a mode does not move has no inertia there, not an infinite one; a link to nothing is no folder.
#[test]
fn words_for_what_has_no_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("study.toml");
    let given = |text: &str| fs::write(&path, text).expect("written");
    let family = "[optimise]\nseed = 9223372036854775808\n[[optimise.absorber]]\non.station = \"a\"\ntypes = [\"tuned\"]\n";
    let size = "size.ring_inertia_kg_m2.fixed = 0.1\n";
    let speeds = "engine = \"engine.toml\"\nspeed_rpm = { from = 600, to = 700, step = 100 }\norder_limit = 2\n";
    given(&format!("{speeds}{family}{size}"));
    let path = path.to_string_lossy().into_owned();
    let text = String::from_utf8_lossy(&hartog(&["check", &path]).code(2).get_output().stderr).into_owned();
    assert!(text.contains("expected a whole number from") && !text.contains("i64"), "{text}");
    // three equal masses in a row: the first elastic mode does not move the one in the middle
    let station =
        |name: &str, more: &str| format!("[[station]]\nname = \"{name}\"\ninertia_kg_m2 = 1\nstiffness_to_next_n_m_per_rad = 1e6\n{more}");
    let engine = fs::read_to_string("studies/engines/den_hartog.toml").expect("an engine");
    let head = engine.split("[[station]]").next().expect("a head").replace("den_hartog_harmonics", "harmonics");
    fs::copy("studies/engines/den_hartog_harmonics.csv", folder.path().join("harmonics.csv")).expect("copied");
    let chain = station("a", "throws = [1]\n") + &station("b", "") + &station("c", "").replace("stiffness_to_next_n_m_per_rad = 1e6\n", "");
    fs::write(folder.path().join("engine.toml"), head + &chain).expect("written");
    let design = "[[design]]\nname = \"d\"\n[[design.absorber]]\non.station = \"b\"\ntype.viscous = { ring_inertia_kg_m2 = 0.1, damping_n_m_s_per_rad = 1 }\n";
    fs::write(&path, format!("{speeds}{design}")).expect("written");
    let found = hartog(&["check", "--verbose", &path]).code(0);
    let text = String::from_utf8_lossy(&found.get_output().stdout).into_owned();
    assert!(text.contains("does not move"), "{text}");
    #[cfg(unix)]
    {
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("/nowhere/at/all", &link).expect("a link");
        let refused = hartog(&["run", "studies/den_hartog.toml", "--out", &link.to_string_lossy()]).code(2);
        let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(text.contains("a link to something that is not there"), "{text}");
    }
}
