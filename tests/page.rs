//! The page of a run in a browser: it loads without an error, a choice moves every view, and it works by keyboard.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A headless browser, where there is one.
fn browser() -> Option<&'static str> {
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(|name| Command::new(name).arg("--version").output().is_ok())
}

fn page_of(study: &str, folder: &Path) -> PathBuf {
    let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
    let status = c.current_dir(env!("CARGO_MANIFEST_DIR")).args(["run", study, "--out"]).arg(folder).output().expect("runs").status;
    assert!(status.code().is_some_and(|c| c <= 1));
    folder.join("report.html")
}

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

/// A page needs nothing from elsewhere, and no text of an input can end its script.
#[test]
fn a_page_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(page_of("studies/mendes_mwm6.toml", folder.path())).expect("a page");
    assert!(!text.contains("src=\"http") && !text.contains("href="), "something is taken from elsewhere");
    assert_eq!((text.matches("</script>").count(), text.matches("<script").count()), (2, 2));
    assert!(text.contains("class=\"answer\""));
}
