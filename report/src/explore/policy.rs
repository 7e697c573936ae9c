//! Content security policy: the page loads nothing, and runs its own scripts alone.

use abbe_study::hash;
use base64::prelude::{BASE64_STANDARD, Engine};

/// Returns the policy of a page with these inline scripts and style sheets, as an element of the
/// head.
pub(super) fn policy(scripts: &[&str], styles: &[&str]) -> String {
    let sources = |texts: &[&str]| texts.iter().map(|text| source(text)).collect::<Vec<_>>().join(" ");
    format!(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         script-src {}; style-src {}; worker-src blob:; img-src data:; base-uri 'none'; \
         form-action 'none'\">\n",
        sources(scripts),
        sources(styles)
    )
}

/// Returns the hash by which a policy allows an inline element.
fn source(text: &str) -> String {
    format!("'sha256-{}'", BASE64_STANDARD.encode(hash::digest(text)))
}

#[cfg(test)]
mod tests;
