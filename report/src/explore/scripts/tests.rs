//! Tests of `scripts.rs`.

use super::{escaped, without_exports};

#[test]
fn no_text_ends_a_script() {
    let script = r#"/* </script><SCRIPT> <!-- </ScRiPt */ const a = "</script <!--x", b = 1 <c;"#;
    let expected = r#"/* <\/script><\SCRIPT> <\!-- <\/ScRiPt */ const a = "<\/script <\!--x", b = 1 <c;"#;
    assert_eq!(escaped(script), expected);
}

#[test]
fn exports_are_declarations() {
    let module = "export const description = {\n};\n// export\nexport function pose(q) {\n}\nexport async function a() {}\nexport function* b() {}\n";
    let (code, names) = without_exports(module);
    assert_eq!(names, ["description", "pose", "a", "b"]);
    assert_eq!(
        code,
        "const description = {\n};\n// export\nfunction pose(q) {\n}\nasync function a() {}\nfunction* b() {}\n"
    );
}
