//! Pages of reports under axe-core in headless Chromium: no violation.
//!
//! Node finds axe-core as it finds any package: in `node_modules` of this folder or of one above
//! it, or in `NODE_PATH`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, tool};

use crate::browser::{chromium, live_pages, pages};

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
    for page in [pages(folder.path()), live_pages(folder.path())].concat() {
        let text = fs::read_to_string(&page).expect("a page");
        let checked = page.with_extension("checked.html");
        // The policy of a page with a live panel forbids the scripts of this test.
        let lines = text.split_inclusive('\n').filter(|line| !line.contains("Content-Security-Policy"));
        let text: String = lines.collect();
        fs::write(&checked, format!("{text}<script>{axe}</script>{CHECK}")).expect("a page");
        let found = opened(&checked, folder.path());
        assert!(found.contains("<pre>0 violations"), "{}: {found}", page.display());
    }
    Ok(())
}

/// Returns the content of a page after its scripts have run.
fn opened(page: &Path, folder: &Path) -> String {
    let text = chromium(folder, &["--virtual-time-budget=60000", "--dump-dom"], page);
    text.split_once("<body").map_or_else(|| text.clone(), |(_, body)| body.to_owned())
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
