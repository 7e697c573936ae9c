//! Tests of `module.rs`.

use super::*;

/// Any free text stays in the comments, and lines stay narrow.
#[test]
fn free_text_stays_in_comments() {
    let text = r#"
        [manipulator]
        name = "arm"
        title = "two\nlines\rand \u0007 more"
        length = "m"
        [[frame]]
        name = "a | b"
        transform = "Tx(1)"
    "#;
    let module = crate::print::rust(&Spec::parse("arm.toml", text).unwrap());
    let above = module.split("pub mod arm {").next().unwrap();
    assert!(above.contains("two lines and"), "{above}");
    assert!(above.contains("| 1 | a \\| b | fixed |"), "{above}");
    assert!(above.lines().all(|line| line.starts_with("///") || line.starts_with("#[")), "{above}");
    assert!(module.lines().all(|line| line.chars().count() <= 100));
}
