//! Pages of reports under axe-core in headless Chromium: no violation.
//!
//! Node finds axe-core as it finds any package: in `node_modules` of this folder or of one above
//! it, or in `NODE_PATH`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, tool};

pub(crate) const TESTS: Tests = &[("pages_are_accessible", pages_are_accessible)];

/// Opens folded tables, checks the page, and replaces it with the result.
const CHECK: &str = r#"<script>
document.querySelectorAll("details").forEach((details) => (details.open = true));
axe.run().then(({ violations }) => {
    const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
    const result = document.createElement("pre");
    result.textContent = `${found.length} violations\n${found.join("\n")}`;
    document.body.replaceChildren(result);
});
</script>"#;

fn pages_are_accessible() -> Result<(), Missing> {
    tool("chromium", "")?;
    let axe = fs::read_to_string(axe_core()?).expect("axe-core can be read");
    let folder = tempfile::tempdir().expect("a folder");
    for page in pages(folder.path()) {
        let text = fs::read_to_string(&page).expect("a page");
        let checked = page.with_extension("checked.html");
        fs::write(&checked, format!("{text}<script>{axe}</script>{CHECK}")).expect("a page");
        let found = opened(&checked, folder.path());
        assert!(found.contains("<pre>0 violations"), "{}: {found}", page.display());
    }
    Ok(())
}

/// Writes a page of every kind.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let run = |line: &str| {
        let words = shell_words::split(line).expect("words");
        let run = Command::new(env!("CARGO_BIN_EXE_abbe")).args(words).current_dir(folder).output();
        let run = run.expect("abbe runs");
        assert!(run.status.success(), "{line}: {}", String::from_utf8_lossy(&run.stderr));
    };
    run("analyze pps --monte-carlo 100 --out analysis");
    run("analyze ur5 --out arm");
    run("simulate pps --map pps --samples 40 --out data.csv");
    run("simulate pps --map pps --samples 40 --seed 1 --out test.csv");
    run("measure pps data.csv --map pps --accept 'mean 9 mm' --out measured");
    run("identify pps data.csv --map pps --test test.csv --report identification.html");
    run("compensate pps data.csv --map pps --report compensation.html");
    run("plan ur5 --map ur5 --optimal 20 --out plan.csv");
    for (seed, day) in (1..).zip(["monday", "tuesday", "wednesday"]) {
        run(&format!("simulate ur5 plan.csv --map ur5 --seed {seed} --out {day}.csv"));
    }
    run("monitor ur5 monday.csv tuesday.csv wednesday.csv --map ur5 --report monitoring.html");
    let pages =
        ["analysis/report", "arm/report", "measured/report", "identification", "compensation", "monitoring"];
    pages.map(|page| folder.join(page).with_extension("html")).to_vec()
}

/// Returns the content of a page after its scripts have run.
fn opened(page: &Path, folder: &Path) -> String {
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=60000", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(page)
        .output()
        .expect("chromium runs");
    let text = String::from_utf8_lossy(&output.stdout);
    text.split_once("<body").map_or_else(|| text.to_string(), |(_, body)| body.to_owned())
}

/// Returns the path of axe-core.
fn axe_core() -> Result<PathBuf, Missing> {
    let found = Command::new("node").args(["-p", "require.resolve('axe-core/axe.min.js')"]).output();
    let found = found.map_err(|_| Missing("node is not here".to_owned()))?;
    match found.status.success() {
        true => Ok(String::from_utf8_lossy(&found.stdout).trim().into()),
        false => Err(Missing("node does not find axe-core".to_owned())),
    }
}
