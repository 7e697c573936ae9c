//! Live pages in headless Chromium: the scripts run under the policy of the page and fill each
//! panel.

use std::path::Path;
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, tool};

use crate::browser::{chromium, command, live_pages};

pub(crate) const TESTS: Tests =
    &[("scripts_fill_the_panels_under_the_policy", scripts_fill_the_panels_under_the_policy)];

fn scripts_fill_the_panels_under_the_policy() -> Result<(), Missing> {
    tool("chromium", "")?;
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    command(at, "analyze pps --out analysis");
    let pages = [live_pages(at), vec![at.join("analysis/report.html")]].concat();
    for (path, panels) in pages.iter().zip([1, 2, 1]) {
        let page = path.display();
        let opened = chromium(at, &["--virtual-time-budget=10000", "--dump-dom"], path);
        // Of an empty panel, only the section would be there.
        let sections: Vec<&str> = opened.split("<section class=\"abbe-panel").skip(1).collect();
        assert_eq!(sections.len(), panels, "{page}");
        for section in sections {
            assert!(section.contains("<svg") && section.contains("<input"), "{page}: {section}");
        }
        let log = chromium_log(at, path);
        let errors: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
        assert!(errors.is_empty(), "{page}: {errors:?}");
    }
    Ok(())
}

/// Opens a page and returns the log of Chromium, which has what the console of the page shows.
fn chromium_log(folder: &Path, page: &Path) -> String {
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"])
        .args(["--virtual-time-budget=10000", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(page)
        .output()
        .expect("chromium runs");
    String::from_utf8_lossy(&output.stderr).into_owned()
}
