//! The page of a run in a browser: it loads without an error, a choice moves every view, and it works by keyboard.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A headless browser, where there is one.
fn browser() -> Option<&'static str> {
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(|name| Command::new(name).arg("--version").output().is_ok())
}

fn page_from(command: &[&str], folder: &Path) -> PathBuf {
    let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
    let status = c.current_dir(env!("CARGO_MANIFEST_DIR")).args(command).arg("--out").arg(folder).output().expect("runs").status;
    assert!(status.code().is_some_and(|c| c <= 1), "{command:?}: {status}");
    folder.join("report.html")
}

fn page_of(study: &str, folder: &Path) -> PathBuf {
    page_from(&["run", study], folder)
}

/// Text and its ground by the relative luminance of WCAG 2.1: a ratio of 4.5 at least for words, and 3 for curves.
const CONTRAST: &str = "
    const channel = v => { v /= 255; return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; };
    const luminance = c => 0.2126 * channel(c[0]) + 0.7152 * channel(c[1]) + 0.0722 * channel(c[2]);
    const numbers = text => (text.match(/[0-9.]+/g) || []).map(Number);
    const ratio = (a, b) => { const x = luminance(a), y = luminance(b); return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05); };
    const ground = e => { for (; e; e = e.parentElement) { const c = numbers(getComputedStyle(e).backgroundColor); if (c.length === 3) return c; } return [255, 255, 255]; };
    let words = 0;
    for (const e of document.querySelectorAll('body *')) {
        if (!['SCRIPT', 'STYLE', 'OPTION'].includes(e.tagName) && [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim())) {
            words += 1;
            const style = getComputedStyle(e), ink = numbers(e instanceof SVGElement ? style.fill : style.color);
            if (ratio(ink, ground(e)) < 4.5) told.push(e.tagName + ' ' + e.textContent.slice(0, 30) + ' ' + ratio(ink, ground(e)).toFixed(2));
        }
    }
    if (words < 20) told.push('no words');
    for (const path of document.querySelectorAll('.chart path')) {
        const stroke = numbers(getComputedStyle(path).stroke);
        if (stroke.length === 3 && path.getAttribute('stroke-width') > 1 && ratio(stroke, [255, 255, 255]) < 3) told.push('curve ' + stroke + ' ' + ratio(stroke, [255, 255, 255]).toFixed(2));
    }";

/// What the page looks like after a script, and what the browser said of errors.
fn after(browser: &str, page: &Path, width: u32, script: &str) -> (String, String) {
    let text = std::fs::read_to_string(page).expect("a page");
    let errors = "<script>window.told = []; window.addEventListener('error', e => told.push(e.message));</script>";
    let end = format!(
        "<script>try {{ {script} }} catch (e) {{ told.push(String(e)); }} document.title = 'told:' + told.join('|');</script></body>"
    );
    let own = page.with_file_name("page_under_test.html");
    std::fs::write(&own, text.replacen("<body>", &format!("<body>{errors}"), 1).replacen("</body>", &end, 1)).expect("written");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--virtual-time-budget=3000",
            &format!("--window-size={width},900"),
            "--dump-dom",
        ])
        .arg(format!("file://{}", own.display()))
        .output()
        .expect("a browser");
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let told = dom.split("<title>told:").nth(1).and_then(|t| t.split("</title>").next()).unwrap_or("no title").to_owned();
    (dom, told)
}

/// Curves of a chart of the page as it is.
fn curves(dom: &str, chart: &str) -> usize {
    let from = dom.find(&format!("id=\"{chart}\"")).unwrap_or_else(|| panic!("no {chart}"));
    let end = dom[from..].find("</svg>").map_or(dom.len(), |i| from + i);
    dom[from..end].matches("<path").count()
}

/// All shipped studies: no error, two designs are drawn, one more when it is ticked, none when all are taken away, at the widths of a screen and of a telephone.
#[test]
#[ignore = "needs a browser; eight minutes"]
fn pages_work_in_a_browser() {
    let Some(browser) = browser() else {
        println!("skipped: no browser here");
        return;
    };
    let studies =
        std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("studies")).expect("studies").map(|e| e.expect("an entry").path());
    let runs =
        |p: &PathBuf| std::fs::read_to_string(p).is_ok_and(|t| p.extension().is_some_and(|e| e == "toml") && !t.contains("[mechanism]"));
    let studies: Vec<String> = studies.filter(runs).filter_map(|p| Some(p.file_stem()?.to_string_lossy().into_owned())).collect();
    assert!(studies.len() >= 18, "{studies:?}");
    for study in &studies {
        let folder = tempfile::tempdir().expect("a folder");
        let page = page_of(&format!("studies/{study}.toml"), folder.path());
        let size = std::fs::metadata(&page).expect("a page").len();
        assert!(size < 8 << 20, "{study}: {size} bytes");
        for width in [1280, 390] {
            let (dom, told) = after(browser, &page, width, "");
            assert_eq!(told, "", "{study}");
            let drawn = curves(&dom, "response");
            assert!(drawn >= 1, "{study}: nothing is drawn");
            let boxes = "document.querySelectorAll('#designs input[type=checkbox]')";
            let (_, told) = after(browser, &page, width, &format!("for (const b of {boxes}) if (!b.checked) b.click(); {CONTRAST}"));
            assert_eq!(told, "", "{study}: contrast");
            // every row may be ticked, those of other sizes, too
            let rows = dom.matches("<tr data-design=").count();
            assert_eq!(dom.matches("aria-label=\"draw ").count(), rows, "{study}: rows that cannot be drawn");
            let radians = "const head = [...document.querySelectorAll('#designs th')].find(h => h.textContent === 'twist, °'), cell = () => document.querySelector('#designs tbody tr').cells[head.cellIndex].textContent; \
                           const before = Number(cell()); document.getElementById('radians').click(); \
                           if (Math.abs(Number(cell()) * 180 / Math.PI / before - 1) > 1e-3 || head.textContent !== 'twist, rad') told.push(before + ' ' + cell() + head.textContent);";
            let (_, told) = after(browser, &page, width, radians);
            assert_eq!(told, "", "{study}: radians");
            // of a chain, or of a flexible crank in its place
            let modes = "const s = document.getElementById('mode') || document.getElementById('crankmode'), shape = document.getElementById('shape') || document.getElementById('crank'); \
                         const before = shape.innerHTML; s.selectedIndex = 1; s.dispatchEvent(new Event('change')); \
                         if (s.options.length > 1 && shape.innerHTML === before) told.push('the shape stays'); \
                         if (!document.querySelector('#campbell path')) told.push('no frequencies');";
            let (_, told) = after(browser, &page, width, modes);
            assert_eq!(told, "", "{study}: modes");
            let fronts = "const s = document.getElementById('fronts'), picked = () => document.getElementById('picked').textContent; \
                          if (s) for (const o of s.options) { s.value = o.value; s.dispatchEvent(new Event('change')); document.getElementById('picked').textContent = ''; \
                          document.querySelector('#front circle').dispatchEvent(new Event('click')); if (!picked().includes('kg m²')) told.push(o.textContent + ' tells ' + picked()); }";
            let (_, told) = after(browser, &page, width, fronts);
            assert_eq!(told, "", "{study}: fronts");
            let (dom, told) = after(browser, &page, width, &format!("for (const b of {boxes}) if (!b.checked) {{ b.click(); break; }}"));
            let more = dom.matches("type=\"checkbox\" aria-label=\"draw").count().min(drawn + 1);
            assert_eq!((curves(&dom, "response"), told.as_str()), (more, ""), "{study}");
            let (dom, told) = after(browser, &page, width, &format!("for (const b of {boxes}) if (b.checked) b.click();"));
            assert_eq!((curves(&dom, "response"), told.as_str()), (0, ""), "{study}");
            let keys = "const s = document.querySelector('#response svg'); s.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight'})); \
                        document.getElementById('log').click(); document.querySelector('#designs th button').click(); \
                        const q = document.getElementById('quantity'); q.selectedIndex = 1; q.dispatchEvent(new Event('change'));";
            let (dom, told) = after(browser, &page, width, keys);
            assert_eq!(told, "", "{study}");
            assert!(dom.contains(" rpm: ") && dom.contains("aria-sort=\"ascending\""), "{study}");
        }
    }
}

/// Pages of the other commands: no error, tables that sort and filter, words one can read.
#[test]
#[ignore = "needs a browser; two minutes"]
fn pages_of_other_commands_work_in_a_browser() {
    let Some(browser) = browser() else {
        println!("skipped: no browser here");
        return;
    };
    // bending and torsion out of phase at one point
    let inputs = tempfile::tempdir().expect("a folder");
    let row = |i: u32| {
        let angle = (2.0 * f64::from(i)).to_radians();
        format!("fillet,{},{},0,0,{},0,0\n", 2 * i, 80.0 * angle.sin(), 40.0 * angle.cos())
    };
    let history = inputs.path().join("history.csv");
    let head = "point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n".to_owned();
    std::fs::write(&history, head + &(0..360).map(row).collect::<String>()).expect("written");
    let fatigue = ["fatigue", history.to_str().expect("a path"), "--material", "tests/bad_input/material.toml"];
    let commands: [&[&str]; 5] = [
        &["size", "studies/fialho_four.toml"],
        &["curves", "studies/villalva_i6.toml"],
        &["chart", "studies/minucci_i4.toml"],
        &["compare", "studies/villalva_i6_thesis.toml"],
        &fatigue,
    ];
    for command in commands {
        let folder = tempfile::tempdir().expect("a folder");
        let mut page = page_from(command, folder.path());
        if command[0] == "compare" {
            page = folder.path().join("villalva_i6_thesis/report.html");
        }
        assert!(std::fs::metadata(&page).expect("a page").len() < 8 << 20, "{command:?}");
        for width in [1280, 390] {
            let sorts = "document.querySelectorAll('details').forEach(d => d.open = true); document.querySelector('th button').click(); \
                         const f = document.querySelector('input[type=search]'); f.value = 'no such value'; f.dispatchEvent(new Event('input')); \
                         if ([...document.getElementById(f.dataset.of).tBodies[0].rows].some(r => !r.hidden)) told.push('rows stay'); \
                         const inches = document.getElementById('inches'), metric = [...document.querySelectorAll('table.sorts th')].filter(h => /, mm$/.test(h.textContent)); \
                         const cells = () => metric.map(h => Number(h.closest('table').tBodies[0].rows[0].cells[h.cellIndex].textContent)), before = cells(); \
                         if (inches) { inches.click(); cells().forEach((v, i) => { if (!(Math.abs(v * 25.4 / before[i] - 1) < 1e-3)) told.push(before[i] + ' mm became ' + v); }); }";
            let (dom, told) = after(browser, &page, width, &format!("{CONTRAST} {sorts}"));
            assert_eq!(told, "", "{command:?}");
            assert!(dom.contains("aria-sort=\"ascending\"") && dom.contains("data:image/svg+xml"), "{command:?}");
            assert!(command[0] != "size" || dom.contains("crankpin diameter, in"), "{command:?}: no inches");
        }
    }
}

/// Names that would begin a comment of a script, or end it, stand in the data of the page as they are: nothing within the script is `<`, and its JSON has them.
#[test]
fn no_name_ends_the_script_of_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let engine = std::fs::read_to_string(engine).expect("an engine");
    let name = "<!--<script></script>";
    std::fs::write(folder.path().join("engine.toml"), engine.replace("name = \"flywheel\"", &format!("name = \"{name}\"")))
        .expect("written");
    let study =
        "engine = \"engine.toml\"\nspeed_rpm = { from = 1600, to = 2600, step = 500 }\norder_limit = 3\n[[design]]\nname = \"none\"\n";
    let path = folder.path().join("study.toml");
    std::fs::write(&path, study).expect("written");
    let text = std::fs::read_to_string(page_of(&path.to_string_lossy(), &folder.path().join("out"))).expect("a page");
    let data =
        text.split("<script type=\"application/json\" id=\"data\">").nth(1).expect("data").split("</script>").next().expect("an end");
    assert!(!data.contains('<'));
    let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
    assert!(data.to_string().contains(name));
    assert_eq!((text.matches("</script>").count(), text.matches("<script").count()), (2, 2));
}

/// A page needs nothing from elsewhere, and no text of an input can end its script.
#[test]
fn a_page_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(page_of("studies/mendes_mwm6.toml", folder.path())).expect("a page");
    assert!(!text.contains("src=\"http") && !text.contains("href="), "something is taken from elsewhere");
    assert_eq!((text.matches("</script>").count(), text.matches("<script").count()), (2, 2));
    assert!(text.contains("class=\"answer\""));
}

/// The cells of a table of a page.
fn cells<'p>(page: &'p str, id: &str) -> Vec<Vec<&'p str>> {
    let from = page.find(&format!("id=\"{id}\"")).unwrap_or_else(|| panic!("no {id}"));
    let body = page[from..].split("<tbody>").nth(1).and_then(|b| b.split("</tbody>").next()).expect("a body");
    let cells = |row: &'p str| row.split("<td>").skip(1).map(|c| c.split("</td>").next().expect("an end")).collect();
    body.split("<tr>").skip(1).map(cells).collect()
}

/// Every table of a run stands on its page, number for number to four digits, with its caption in the words of the guide; what `--verbose` prints is there, too. The tables of curves are drawn instead.
#[test]
fn a_page_holds_every_table() {
    let guide = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide/outputs.md")).expect("a guide");
    let guide = guide.replace('`', "");
    for study in ["studies/villalva_i6_life.toml", "studies/den_hartog.toml"] {
        let folder = tempfile::tempdir().expect("a folder");
        let page = std::fs::read_to_string(page_of(study, folder.path())).expect("a page");
        let mut numbers = 0;
        for path in std::fs::read_dir(folder.path()).expect("a folder").map(|e| e.expect("an entry").path()) {
            let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
            if path.extension().is_none_or(|e| e != "csv") || ["response", "margin", "timing"].contains(&stem.as_str()) {
                continue;
            }
            let mut table = csv::Reader::from_path(&path).expect("a table");
            let rows: Vec<csv::StringRecord> = table.records().map(|r| r.expect("a row")).collect();
            let shown = cells(&page, &format!("table_{stem}"));
            assert_eq!(shown.len(), rows.len(), "{stem}");
            for (shown, row) in shown.iter().zip(&rows) {
                assert_eq!(shown.len(), row.len(), "{stem}");
                for (own, cell) in shown.iter().zip(row) {
                    match (own.parse::<f64>(), cell.parse::<f64>()) {
                        (Ok(a), Ok(b)) => {
                            numbers += 1;
                            assert!((a - b).abs() <= 5.1e-4 * b.abs(), "{stem}: {own} for {cell}");
                        }
                        _ => assert_eq!(
                            own.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&").replace("&quot;", "\""),
                            cell,
                            "{stem}"
                        ),
                    }
                }
            }
            let caption = page.split(&format!(" ({stem}.csv, ")).next().and_then(|p| p.rsplit("<b>").next()).expect("a caption");
            let caption = caption.trim_end_matches("</b>");
            let words: String = caption.chars().take(1).flat_map(char::to_lowercase).chain(caption.chars().skip(1)).collect();
            assert!(guide.contains(&words) && words.len() > 10, "{stem}: {words}");
        }
        assert!(page.contains("<th>ring inertia, kg m²</th>") && page.contains("<th>stiffness, N m/rad</th>"), "{study}: units of heads");
        assert!(numbers > 50, "{numbers}");
        assert!(page.contains("What was found, in words") && page.contains("first-order"), "{study}");
    }
}

/// A question whose objective is the same in every condition names those that its limits are held in.
#[test]
fn a_question_names_the_conditions_of_its_limits() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = folder.path().join("lightest.toml");
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let text = format!(
        "engine = '{}'\nspeed_rpm = {{ from = 600, to = 3200, step = 200 }}\norder_limit = 6\n\n[[objective]]\nring_inertia = {{}}\n\n\
         [[constraint]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\", max_deg = 0.6 }}\n\n[optimise]\nconditions = [\"firing\", \"misfire\"]\nrandom_starts = 0\nprove = {{ boxes = 0 }}\n\
         [[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"tuned\"]\nsize.ring_inertia_kg_m2.between = [0.005, 0.15]\n",
        engine.display()
    );
    std::fs::write(&study, text).expect("written");
    let page = std::fs::read_to_string(page_of(&study.to_string_lossy(), &folder.path().join("out"))).expect("a page");
    assert!(page.contains("at most 0.6°, each at the worst of firing and misfire?"), "{}", page.split("</p>").next().unwrap_or_default());
}
