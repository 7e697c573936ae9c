//! Content security policy: the page loads nothing, and runs its own scripts alone.

use abbe_study::hash;

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
    format!("'sha256-{}'", base64(&hash::digest(text)))
}

/// Encodes bytes by RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |three: &[u8]| {
        let bits = (0..3).fold(0, |bits, i| bits << 8 | usize::from(*three.get(i).unwrap_or(&0)));
        let digit = |i: usize| match i <= three.len() {
            true => char::from(DIGITS[bits >> (18 - 6 * i) & 63]),
            false => '=',
        };
        (0..4).map(digit).collect::<String>()
    };
    bytes.chunks(3).map(group).collect()
}

#[cfg(test)]
mod tests;
