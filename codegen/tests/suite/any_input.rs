//! Fuzzes the reader: neither random text nor randomly damaged specs make it panic or hang.

use abbe_spec::Spec;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const SPEC: &str = r#"
[manipulator]
name = "arm"
length = "mm"
orientation = "euler-yzx"
[parameters]
a = { value = "718 mm", description = "reach" }
[inputs]
load = { value = "0 kg", range = ["0 kg", "5 kg"] }
[[frame]]
name = "slide"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "500 mm"], home = "10 mm" }
transform = "Tx(d1 + 3 mm) Ry(0.5)"
[[frame]]
name = "turn"
variable = { name = "q2", kind = "revolute" }
matrix = [["cos(q2)", "-sin(q2)", 0, "a"], ["sin(q2)", "cos(q2)", 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
[tool]
transform = "Tz(5)"
[[source]]
name = "rail"
class = "random"
distribution = "uniform"
frame = "slide"
e_z = "-0.00006*d1 - 0.06 mm * sin(pi*d1/(1600 mm))"
e_s = "load * 1e-6/kg"
"#;

fn read(text: &str) {
    match Spec::parse("any.toml", text) {
        // Every spec that is accepted can be generated.
        Ok(spec) => drop(abbe_codegen::print::rust(&spec)),
        Err(diagnostics) => assert!(diagnostics.to_string().starts_with("error")),
    }
}

#[test]
fn the_spec_is_right() {
    assert!(Spec::parse("any.toml", SPEC).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default()
    })]

    #[test]
    fn any_text(text in "\\PC*") {
        read(&text);
    }

    #[test]
    fn any_expression(expression in "[-+*/^(), .0-9a-z]{0,40}|(sin|mm|deg|d1|a|pi|[-+*/^()]|[0-9]{1,3}| ){0,30}") {
        read(&SPEC.replace("d1 + 3 mm", &expression));
        read(&SPEC.replace("-0.00006*d1", &expression));
    }

    #[test]
    fn any_damage(at in 0..SPEC.len(), cut in 0..40_usize, insert in "\\PC{0,6}") {
        let start = SPEC.floor_char_boundary(at);
        let end = SPEC.floor_char_boundary((start + cut).min(SPEC.len()));
        read(&format!("{}{insert}{}", &SPEC[..start], &SPEC[end..]));
    }
}
