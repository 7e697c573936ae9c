//! Generated Rust can be read by tools: clippy asks for the receiver of every method call with one
//! argument and follows the initializers of all bindings behind it, without remembering them, so
//! that one such call at the end of a long chain of bindings takes exponential time.

use abbe_codegen::print;
use abbe_spec::Spec;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// An arm with a spherical wrist, whose generated module has every function.
pub(crate) const SPEC: &str = r#"
[manipulator]
name = "arm"
length = "m"
[parameters]
a = "0.4 m"
b = "3 m"
[inputs]
u = { value = "2 kg", range = ["0 kg", "5 kg"] }
[tables.bow]
x = [-3, 0, 1, 3]
y = { values = [0.1, 0, 0.2, 0.1], unit = "mm" }
interpolation = "cubic"
outside = "hold"
[[frame]]
name = "1"
variable = { name = "x", kind = "revolute" }
dh = { theta = "x", d = "0.3 m", a = "0", alpha = "-90 deg" }
[[frame]]
name = "2"
variable = { name = "y", kind = "revolute" }
dh = { theta = "y", d = "0", a = "a", alpha = "0" }
[[frame]]
name = "3"
variable = { name = "q3", kind = "revolute" }
dh = { theta = "q3", d = "0.1 m", a = "0", alpha = "90 deg" }
[[frame]]
name = "4"
variable = { name = "q4", kind = "revolute" }
dh = { theta = "q4", d = "0.4 m", a = "0", alpha = "-90 deg" }
[[frame]]
name = "5"
variable = { name = "q5", kind = "revolute" }
dh = { theta = "q5", d = "0", a = "0", alpha = "90 deg" }
[[frame]]
name = "6"
variable = { name = "q6", kind = "revolute" }
dh = { theta = "q6", d = "0", a = "0", alpha = "0" }
[[source]]
name = "any"
class = "repeatable"
frame = "2"
e_s = "EXPRESSION"
[[source]]
name = "more"
class = "repeatable"
frame = "3"
e_x = "bow(y)"
"#;

/// Returns the method calls with one argument, as `.name(argument)`.
fn calls_with_one_argument(tokens: TokenStream, found: &mut Vec<String>) {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    for window in trees.windows(3) {
        if let [TokenTree::Punct(dot), TokenTree::Ident(name), TokenTree::Group(group)] = window
            && dot.as_char() == '.'
            && group.delimiter() == Delimiter::Parenthesis
            && argument_count(group.stream()) == 1
        {
            found.push(format!(".{name}{group}"));
        }
    }
    for tree in trees {
        if let TokenTree::Group(group) = tree {
            calls_with_one_argument(group.stream(), found);
        }
    }
}

/// Returns the number of arguments between the parentheses of a call.
fn argument_count(tokens: TokenStream) -> usize {
    let is_comma = |tree: &TokenTree| matches!(tree, TokenTree::Punct(comma) if comma.as_char() == ',');
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    trees.split(is_comma).filter(|argument| !argument.is_empty()).count()
}

/// Fails if the module of a spec has a method call with one argument.
fn check(file: &str, spec: &str) {
    let spec = Spec::parse(file, spec).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut found = Vec::new();
    calls_with_one_argument(print::rust(&spec).parse().unwrap(), &mut found);
    assert!(found.is_empty(), "{file}: {found:?}");
}

#[test]
fn calls_are_recognized() {
    let mut found = Vec::new();
    let code = "let x = { a.min(b.max(c)) }; T::max(a, b); a.mul_add(b, c); a.sqrt(); a.powf(b,); 1.0";
    calls_with_one_argument(code.parse().unwrap(), &mut found);
    assert_eq!(found.len(), 3, "{found:?}");
}

/// Returns the name and the text of every shipped spec.
pub(crate) fn shipped() -> Vec<(String, String)> {
    let mut specs = Vec::new();
    for folder in ["specs", "mechanisms"] {
        let folder = format!("{}/../manipulators/{folder}", env!("CARGO_MANIFEST_DIR"));
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            specs.push((path.display().to_string(), std::fs::read_to_string(&path).unwrap()));
        }
    }
    assert!(specs.len() > 10, "{}", specs.len());
    specs
}

/// Returns a chain of 39 frames: above 30 frames, modules have loops.
pub(crate) fn long_chain() -> String {
    let (head, sources) = SPEC.split_once("[[source]]").unwrap();
    let frame = |index: usize| {
        format!(
            "[[frame]]\nname = \"{index}\"\nvariable = {{ name = \"q{index}\", kind = \"revolute\" }}\n\
             dh = {{ theta = \"q{index}\", d = \"a/2\", a = \"0.1 m\", alpha = \"0.3\" }}\n"
        )
    };
    let frames: String = (7..40).map(frame).collect();
    let sources = sources.replace("EXPRESSION", "sin(q31)/1000");
    format!("{head}{frames}[[source]]{sources}")
}

#[test]
fn shipped_robots_have_no_method_call_with_one_argument() {
    shipped().iter().for_each(|(file, spec)| check(file, spec));
}

#[test]
fn long_chains_have_no_method_call_with_one_argument() {
    check("long.toml", &long_chain());
}

/// Joints, parameters and inputs of [`SPEC`], and numbers.
pub(crate) const LEAVES: [&str; 6] = ["x", "y", "u/kg", "a/b", "0.3", "2.5"];

/// Returns random expressions of some values with every function of the language.
pub(crate) fn expression(leaves: &[&'static str]) -> impl Strategy<Value = String> + use<> {
    let leaf = prop::sample::select(leaves.to_vec()).prop_map(str::to_owned);
    leaf.prop_recursive(6, 40, 2, |inner| {
        let one = prop::sample::select(vec![
            "sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "abs", "exp", "log", "sign",
        ]);
        let two = prop::sample::select(vec!["atan2", "min", "max"]);
        let sign = prop::sample::select(vec!["+", "-", "*", "/"]);
        prop_oneof![
            (one, inner.clone()).prop_map(|(f, a)| format!("{f}({a})")),
            (two, inner.clone(), inner.clone()).prop_map(|(f, a, b)| format!("{f}({a}, {b})")),
            (sign, inner.clone(), inner.clone()).prop_map(|(sign, a, b)| format!("({a} {sign} {b})")),
            (inner.clone(), -3.0..3.0).prop_map(|(a, b)| format!("abs({a})^({b:.2})")),
            (inner.clone(), inner).prop_map(|(a, b)| format!("abs({a})^({b})")),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60, failure_persistence: None, rng_seed: RngSeed::Fixed(47), ..ProptestConfig::default()
    })]

    #[test]
    fn random_programs_have_no_method_call_with_one_argument(expression in expression(&LEAVES)) {
        let text = SPEC.replace("EXPRESSION", &format!("0.001*({expression})"));
        // Some are refused, such as `log(0.3 - 0.3)`.
        if Spec::parse("arm.toml", &text).is_ok() {
            check("arm.toml", &text);
        }
    }
}
