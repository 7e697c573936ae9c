//! Tests of `dialect.rs`.

use super::Dialect;

#[test]
fn delimiters_and_decimals() {
    for (text, delimiter, decimal_comma) in [
        ("a,b\n1.5,2\n", b',', false),
        ("a;b\n1,5;2\n", b';', true),
        ("a;b\n1.5;2\n", b';', false),
        ("# made; by, an; instrument\r\n\r\na\tb\r\n1,5\t-2,0e3\r\n", b'\t', true),
        // A name with a comma, and a text with a comma that is no decimal.
        ("a;b, measured;c\n1.5;x,y;3\n", b';', false),
        ("a;b\n1,5;2.5\n", b';', false),
        ("a\n1\n", b',', false),
        ("\"a;b;c\",\"d\n;;\"\"e\"\n1.5,2\n", b',', false),
        ("5\" rail;x;y, z\n1;2;3\n", b';', false),
    ] {
        assert_eq!(Dialect::detect(text.as_bytes(), None), Dialect { delimiter, decimal_comma }, "{text:?}");
    }
    let comma = Dialect { delimiter: b';', decimal_comma: true };
    assert_eq!(
        ["1,5", "-2,5e-3", "7", "1.5", "1.234,5", "1,2,3"].map(|cell| comma.number(cell)),
        [Some(1.5), Some(-2.5e-3), Some(7.0), None, None, None]
    );
}
