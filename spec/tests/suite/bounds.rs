//! Excessive input is rejected with the limit and a remedy; input at the limit is accepted.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

const HEAD: &str = "[manipulator]\nname = \"arm\"\nlength = \"m\"\n";

const FRAME: &str = "[[frame]]\nname = \"f\"\nvariable = { name = \"q\", kind = \"revolute\" }\ntransform = \"Rz(q) Tx(0.3)\"\n";

fn refused(text: &str) -> Diagnostics {
    match Spec::parse("arm.toml", text) {
        Ok(_) => panic!("this is read as if nothing were wrong"),
        Err(diagnostics) => diagnostics,
    }
}

/// Concatenates numbered lines or tables.
fn many(count: usize, one: impl Fn(usize) -> String) -> String {
    (0..count).map(one).collect()
}

fn source(name: usize, error: &str) -> String {
    format!("[[source]]\nname = \"{name}\"\nclass = \"repeatable\"\nframe = \"f\"\ne_s = \"{error}\"\n")
}

/// Returns a spec with the given number of items.
type Text<'a> = &'a dyn Fn(usize) -> String;

/// Checks the limits that the reference states.
#[test]
fn counts_have_limits() {
    let frames =
        |count| many(count, |i| FRAME.replace("\"f\"", &format!("\"{i}\"")).replace('q', &format!("q{i}")));
    let sources = |count| FRAME.to_owned() + &many(count, |i| source(i, "1e-6"));
    let parameters = |count| format!("[parameters]\n{}{FRAME}", many(count, |i| format!("p{i} = 1\n")));
    let inputs = |count| format!("[inputs]\n{}{FRAME}", many(count, |i| format!("u{i} = 1\n")));
    let table = |i: usize| format!("[tables.t{i}]\nx = [0, 1]\ny = [0, 1]\ninterpolation = \"linear\"\n");
    let tables = |count| FRAME.to_owned() + &many(count, table);
    let kinds: [(&str, usize, Text); 5] = [
        ("frames", 3000, &frames),
        ("sources", 10_000, &sources),
        ("parameters", 10_000, &parameters),
        ("inputs", 10_000, &inputs),
        ("tables", 1000, &tables),
    ];
    let reference = include_str!("../../../docs/reference/spec.md");
    for (what, most, text) in kinds {
        assert!(Spec::parse("arm.toml", &(HEAD.to_owned() + &text(most))).is_ok(), "{most} {what}");
        let said = refused(&(HEAD.to_owned() + &text(most + 1))).to_string();
        let expected = format!("too many {what}: found {}, the maximum is {most}", most + 1);
        assert!(
            said.contains(&expected) && said.contains("--> arm.toml:") && said.contains("help: "),
            "{said}"
        );
        assert!(reference.contains(&format!("{most} ")), "{what}");
    }
}

#[test]
fn a_sum_has_as_many_terms_as_a_spec_has_parameters() {
    let sum = |count: usize| HEAD.to_owned() + FRAME + &source(0, &vec!["q"; count].join("+"));
    assert!(Spec::parse("arm.toml", &sum(10_000)).is_ok());
    for count in [10_001, 200_000] {
        let diagnostics = refused(&sum(count));
        let [only] = &diagnostics.list[..] else { panic!("{} mistakes", diagnostics.list.len()) };
        assert_eq!(only.message, "this expression has more than 20000 names, numbers and operators");
        assert!(only.help.as_ref().is_some_and(|help| help.contains("[tables.NAME]")));
    }
}

/// Thousands of names are neither all listed nor all compared with each mistake.
#[test]
fn thousands_of_mistakes_are_told_soon() {
    let parameters = many(2000, |i| format!("reach{i} = 1\n"));
    let sources = many(300, |i| source(i, &format!("1e-6*raech{i}")));
    let diagnostics = refused(&format!("{HEAD}[parameters]\n{parameters}{FRAME}{sources}"));
    assert_eq!(diagnostics.list.len(), 300);
    let help = |i: usize| diagnostics.list[i].help.clone().unwrap();
    assert_eq!(help(7), "did you mean `reach7`?");
    assert!(
        help(200).starts_with("declared names: reach0, reach1, ")
            && help(200).ends_with("reach19 and 1981 more"),
        "{}",
        help(200)
    );
    // Every unknown key is reported once.
    let keys = many(3000, |i| format!("[sourc{i}]\n"));
    let diagnostics = refused(&format!("{HEAD}{FRAME}{keys}"));
    assert_eq!(diagnostics.list.len(), 3000);
    assert_eq!(diagnostics.list[0].help.as_deref(), Some("did you mean `source`?"));
    assert!(diagnostics.list[2999].help.as_ref().unwrap().starts_with("known keys: "));
}
