//! `abbe explore`: the data, the page and its content security policy; and the commands that give
//! the figures of a page, `abbe analyze --q` and `--scale`.

use std::fs;

use serde_json::Value;
use sha2::{Digest, Sha256};
use tempfile::tempdir;

use crate::running::{abbe, json, prints, write};

/// Text that would end a script, a comment, a string or an attribute.
const HOSTILE: &str = r#"</script><script>fail()</script><!--<script> */ fail(); /* ' " \" ` ${fail()} &lt;"#;

/// Returns the content of each element of a kind whose start tag begins with `start`.
fn contents<'t>(page: &'t str, start: &str, end: &str) -> Vec<&'t str> {
    let rests = page.split(start).skip(1).filter_map(|rest| Some(rest.split_once('>')?.1));
    rests.map(|rest| rest.split_once(end).expect("its end").0).collect()
}

/// Returns the hash of an inline element as a policy names it.
fn source(text: &str) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bits: String = Sha256::digest(text).iter().map(|byte| format!("{byte:08b}")).collect();
    // 256 bits are 42 digits and 4 bits more.
    let padded = bits + "00";
    let digit = |i: usize| DIGITS[usize::from_str_radix(&padded[6 * i..6 * i + 6], 2).unwrap()];
    let digits: String = (0..43).map(digit).map(char::from).collect();
    format!("'sha256-{digits}='")
}

/// Asserts that the policy of a page forbids to load anything, and allows its own scripts and style
/// sheets only; returns the page without scripts. A page without scripts is returned as it is.
pub(crate) fn without_scripts(page: &str) -> String {
    let mut rest = page.to_owned();
    let data = "<script type=\"application/json\" class=\"abbe-data\">";
    let executed = page.replace(data, "<data>");
    let scripts = contents(&executed, "<script", "</script>");
    if scripts.is_empty() {
        return rest;
    }
    let (_, policy) = page.split_once("Content-Security-Policy\" content=\"").expect("a policy");
    let (policy, _) = policy.split_once('"').expect("its end");
    let directives: Vec<&str> = policy.split("; ").collect();
    let hashes = |name: &str, texts: Vec<&str>| {
        let sources: Vec<String> = texts.into_iter().map(source).collect();
        format!("{name} {}", sources.join(" "))
    };
    let expected = [
        "default-src 'none'".to_owned(),
        hashes("script-src", scripts),
        hashes("style-src", {
            let mut styles = contents(page, "<style", "</style>");
            // Of the panel first.
            styles.reverse();
            styles
        }),
        "worker-src blob:".to_owned(),
        "img-src data:".to_owned(),
        "base-uri 'none'".to_owned(),
        "form-action 'none'".to_owned(),
    ];
    assert_eq!(directives, expected);
    // Before everything that it restricts.
    assert!(page.find("Content-Security-Policy") < page.find("<style"));
    while let Some(start) = rest.find("<script") {
        let end = start + rest[start..].find("</script>").expect("its end") + "</script>".len();
        rest.replace_range(start..end, "");
    }
    rest
}

/// Returns the data of the only panel of a page.
pub(crate) fn panel(page: &str) -> Value {
    let data = contents(page, "<script type=\"application/json\" class=\"abbe-data\"", "</script>");
    assert_eq!((data.len(), page.matches("<section class=\"abbe-panel\">").count()), (1, 1));
    serde_json::from_str(data[0]).unwrap()
}

/// Returns the page of some arguments.
fn page(arguments: &[&str]) -> String {
    prints(&[&["explore"], arguments, &["--out", "-"]].concat())
}

/// Returns the data of some arguments.
fn reports(arguments: &[&str]) -> Value {
    let text = prints(&[&["explore"], arguments, &["--json"]].concat());
    serde_json::from_str(&text).unwrap()
}

#[test]
fn data_are_those_of_the_spec_and_the_study() {
    let list = reports(&["pps"]);
    let [report] = &list.as_array().unwrap()[..] else { panic!("one report for each spec") };
    assert_eq!(
        (&report["name"], &report["length"], &report["tool"]),
        (&"pps".into(), &"mm".into(), &true.into())
    );
    assert_eq!(report["study"]["tolerance"], 0.5);
    assert_eq!(report["up"], 1, "its picture has y up");
    assert_eq!(reports(&["scara"])[0]["up"], 2, "without a study");
    let checked = json(&["check", "pps", "--json"]);
    for (key, of_check) in [("frames", "frames"), ("variables", "variables"), ("inputs", "inputs")] {
        assert_eq!(names(&report[key]), names(&checked[of_check]), "{key}");
    }
    let configurations = &report["configurations"];
    assert_eq!(configurations["q"].as_array().unwrap().len(), 999);
    assert_eq!(configurations["s"].as_array().unwrap().len(), 999, "the tool point varies");
    assert_eq!(configurations["u"], Value::Array(Vec::new()), "nominal in this study");
    let z = report["parameters"].as_array().unwrap().iter().find(|one| one["name"] == "z").unwrap();
    let values = configurations["s"].as_array().unwrap().iter();
    let index = names(&report["parameters"]).iter().position(|name| name == "z").unwrap();
    let values: Vec<f64> = values.map(|s| s[index].as_f64().unwrap()).collect();
    let ends = [f64::min, f64::max].map(|end| values.iter().copied().reduce(end).unwrap());
    assert_eq!(z["range"], serde_json::json!(ends));
}

fn names(list: &Value) -> Vec<String> {
    let name = |one: &Value| one["name"].as_str().unwrap_or_else(|| one.as_str().unwrap()).to_owned();
    list.as_array().unwrap().iter().map(name).collect()
}

#[test]
fn the_code_has_every_source_and_their_factors_as_inputs() {
    let list = reports(&["pps", "--disable", "assembly", "--scale", "base rail curvature=0.5"]);
    let report = &list[0];
    let sources = report["sources"].as_array().unwrap();
    let source = |name: &str| sources.iter().find(|source| source["name"] == name).unwrap();
    assert_eq!(source("assembly")["enabled"], false);
    assert_eq!(source("base rail curvature")["value"], 0.5);
    let inputs = report["inputs"].as_array().unwrap().len();
    let repeatable = sources.iter().filter(|source| source["class"] == "repeatable");
    let magnitudes: Vec<_> = repeatable.map(|source| source["magnitude"].as_u64().unwrap()).collect();
    assert_eq!(magnitudes, (inputs as u64..).take(magnitudes.len()).collect::<Vec<_>>());
    assert!(sources.iter().enumerate().all(|(k, source)| source["follows"] == k));
    let code = report["code"].as_str().unwrap();
    for function in ["pose", "real_pose", "error_jacobian", "effects", "source_displacements", "transforms"] {
        assert!(code.contains(&format!("export function {function}(")), "{function}");
    }
    let effects = report["effects"].as_array().unwrap();
    assert!(code.contains(&format!("Size: {}.", effects.len())));
    // The options that give the same figures, without a study of the machine itself.
    let command = ["--disable", "assembly", "--scale", "base rail curvature=0.5"];
    assert_eq!(report["command"], serde_json::json!(command));
    assert_eq!(report["jacobian_command"], report["command"]);
}

#[test]
fn commands_have_the_study_and_its_changes() {
    let folder = tempdir().unwrap();
    let study = "[study]\ntitle = \"Heavy\"\nset = { patient = \"90 kg\" }\ndisable = [\"assembly\"]\n\
                 [workspace.joints]\nsamples = 5\n";
    let study = write(folder.path(), "heavy.toml", study);
    let study = study.to_str().unwrap();
    let list = reports(&["pps", "--study", study, "--set", "x=1"]);
    assert_eq!(list[0]["command"], serde_json::json!(["--study", study, "--set", "x=1"]));
    let options = ["--set", "patient=90.0 kg", "--disable", "assembly", "--set", "x=1"];
    assert_eq!(list[0]["jacobian_command"], serde_json::json!(options));
}

#[test]
fn the_uncertainty_of_a_magnitude_follows_its_source() {
    let folder = tempdir().unwrap();
    let spec = crate::running::shipped("pps").replacen(
        "[[source]]\nname = \"assembly\"",
        "[[source]]\nmagnitude = { value = 1, standard_deviation = 0.1 }\nname = \"assembly\"",
        1,
    );
    let spec = write(folder.path(), "arm.toml", &spec);
    let list = reports(&[spec.to_str().unwrap()]);
    let sources = list[0]["sources"].as_array().unwrap();
    let index = |name: &str| sources.iter().position(|source| source["name"] == name).unwrap();
    let uncertain = &sources[index("assembly (its magnitude)")];
    assert_eq!(uncertain["follows"], index("assembly"));
    assert_eq!((&uncertain["class"], &uncertain["bound"]), (&"random".into(), &3.0.into()));
}

#[test]
fn the_page_runs_its_own_scripts_only() {
    let one = page(&["pps"]);
    let rest = without_scripts(&one);
    assert_eq!(rest.matches("<section class=\"abbe-panel\"></section>").count(), 1);
    assert!(rest.contains("<noscript>") && rest.contains("<h1>NPTC patient positioning system</h1>"));
    for word in ["http:", "https:", "@import", "url(", "src=", " style=", " onclick"] {
        assert!(!rest.contains(word), "{word}");
    }
    for shipped in abbe_manipulators::SHIPPED {
        let size = page(&[shipped.name]).len();
        assert!(size < 400_000, "{}: {size} bytes", shipped.name);
    }
    let two = page(&["ur5", "puma560"]);
    assert_eq!(without_scripts(&two).matches("abbe-panel\"></section>").count(), 2);
    assert!(one == page(&["pps"]), "the same page every time");
}

#[test]
fn no_text_of_a_spec_leaves_its_string_or_comment() {
    let folder = tempdir().unwrap();
    // A name has no line separator, which ends a line of JavaScript.
    let [name, hostile] = ["", "\\u2028fail()"]
        .map(|end| format!("\"{}{end}\"", HOSTILE.replace('\\', "\\\\").replace('"', "\\\"")));
    let spec = format!(
        "[manipulator]\nname = \"arm\"\ntitle = {hostile}\ndescription = {hostile}\nreference = {hostile}\n\
         length = \"mm\"\n\
         [parameters]\na = {{ value = \"300 mm\", description = {hostile} }}\n\
         [inputs]\nload = {{ value = \"1 kg\", range = [\"0 kg\", \"2 kg\"], description = {hostile} }}\n\
         [tables.curve]\ndescription = {hostile}\ninterpolation = \"linear\"\nx = [\"-4\", \"0\", \"4\"]\ny = [\"0 mm\", \"1 mm\", \"0 mm\"]\n\
         [[frame]]\nname = {name}\n\
         variable = {{ name = \"q1\", kind = \"revolute\", limits = [-3, 3], description = {hostile} }}\n\
         dh = {{ theta = \"q1\", d = 0, a = \"a\", alpha = 0 }}\n\
         [[source]]\nname = {name}\nclass = \"repeatable\"\ndescription = {hostile}\nreference = {hostile}\n\
         frame = {name}\ne_x = \"curve(q1) * load/(1 kg)\"\n"
    );
    let spec = write(folder.path(), "arm.toml", &spec);
    let study = format!("[study]\ntitle = {hostile}\n[workspace.joints]\nsamples = 5\n");
    let study = write(folder.path(), "cell.toml", &study);
    let arguments = [spec.to_str().unwrap(), "--study", study.to_str().unwrap()];
    let page = page(&arguments);
    let report = &reports(&arguments)[0];
    let title = report["title"].as_str().unwrap();
    assert!(title.starts_with(HOSTILE) && title.ends_with("fail()"), "{title}");

    // A browser ends a script at `</script` and looks for `<script` behind `<!--`, in any case.
    let lower = page.to_ascii_lowercase();
    assert_eq!(lower.matches("<script").count(), 3, "data, machine, modules");
    assert_eq!(lower.matches("</script").count(), 3);
    assert!(!page.contains("<!--") && !page.contains('\u{2028}'));
    assert!(!without_scripts(&page).contains("fail()</script>"));

    // The data are those of `--json`, and the script has the code, but for `<\` instead of `<`.
    let [data] = contents(&page, "<script type=\"application/json\"", "</script>")[..] else {
        panic!("data")
    };
    let data: Value = serde_json::from_str(data).unwrap();
    let mut expected = report.clone();
    expected.as_object_mut().unwrap().remove("code");
    assert_eq!(data, expected);
    let code = report["code"].as_str().unwrap().replace("\nexport ", "\n");
    assert!(code.contains("</script>") || code.contains("\\</script"), "the texts are in the code");
    let machine = contents(&page, "<script>", "</script>");
    assert!(
        page.replace("<\\/", "</").replace("<\\!", "<!").replace("<\\s", "<s").contains(&code),
        "{machine:?}"
    );

    // The page of an analysis has the same panel.
    let out = folder.path().join("out");
    prints(&[&["analyze"], &arguments[..], &["--out", out.to_str().unwrap()]].concat());
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert_eq!(page.to_ascii_lowercase().matches("</script").count(), 3);
    without_scripts(&page);
}

#[test]
fn outputs_are_as_safe_as_those_of_other_commands() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "arm.toml", crate::running::shipped("ur5"));
    let spec = spec.to_str().unwrap();
    let run = abbe(&["explore", spec, "--out", spec]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("this file is an input of the command"), "{}", run.stderr);
    let run = abbe(&["explore", "ur5", "--set", "payload=1kg", "--out", "-"]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("no parameter or input `payload`"), "{}", run.stderr);
}

/// Returns the norms of each source, and the total, of an analysis at one configuration of `pps`.
fn norms(options: &[&str]) -> (Vec<(String, f64)>, f64) {
    let at = ["analyze", "pps", "--q", "100,300,900,70deg,1deg,-2deg", "--json"];
    let report = json(&[&at, options].concat());
    let sources = report["sources"].as_array().unwrap().iter();
    let norm = |source: &Value| source["plain_max"]["norm"].as_f64().unwrap();
    let named = sources.map(|source| (source["name"].as_str().unwrap().to_owned(), norm(source))).collect();
    (named, report["combined"]["radius"].as_f64().unwrap())
}

#[test]
fn scale_multiplies_the_errors_of_a_source() {
    let (all, _) = norms(&[]);
    for (name, norm) in &all {
        let scaled = |factor: &str| norms(&["--scale", &format!("{name}={factor}")]);
        let (halves, _) = scaled("0.5");
        for ((other, before), (_, after)) in all.iter().zip(&halves) {
            let expected = if other == name { 0.5 * norm } else { *before };
            assert!((after - expected).abs() <= 1e-12 * expected, "{other} with half of {name}");
        }
        let (_, without) = norms(&["--disable", name]);
        assert!((scaled("0").1 - without).abs() <= 1e-12 * without, "{name}");
        // Applied one after the other.
        let twice = norms(&["--scale", &format!("{name}=2"), "--scale", &format!("{name}=0.25")]);
        assert_eq!(twice, scaled("0.5"));
    }
}

#[test]
fn scale_needs_a_source_and_a_factor() {
    for (option, message) in [
        ("assembly", "expected SOURCE=FACTOR"),
        ("asembly=2", "did you mean `assembly`?"),
        ("assembly=", "the factor of `assembly` is missing"),
        ("assembly=-1", "the factor of `assembly` is negative"),
        ("assembly=2 mm", "must be a pure number"),
    ] {
        let run = abbe(&["analyze", "pps", "--scale", option]);
        assert_eq!(run.status, 2, "{option}");
        assert!(run.stderr.contains(message) && run.stderr.contains("--scale"), "{option}: {}", run.stderr);
    }
}

#[test]
fn one_configuration_is_analyzed_with_the_tolerance_of_the_study() {
    let q = "100,300,900,70deg,1deg,-2deg";
    let at = json(&["analyze", "pps", "--q", q, "--set", "patient=50kg", "--json"]);
    assert_eq!((&at["configurations"], &at["tolerance"]), (&1.into(), &0.5.into()));
    assert_eq!(at["published"], Value::Array(Vec::new()));
    assert_eq!(
        at["workspace"],
        "one configuration, d1 = 100 mm, d2 = 300 mm, d3 = 900 mm, q4 = 70°, q5 = 1°, q6 = -2°"
    );
    // The repeatable part is ΔX of `abbe jacobian` at the same values.
    let jacobian = json(&["jacobian", "pps", "--q", q, "--set", "patient=50kg", "--json"]);
    let dx: Vec<f64> = (0..3).map(|i| jacobian["displacement"][i].as_f64().unwrap()).collect();
    let norm = dx.iter().map(|d| d * d).sum::<f64>().sqrt();
    let repeatable = at["combined"]["repeatable_radius"].as_f64().unwrap();
    assert!((repeatable - norm).abs() <= 1e-12 * norm, "{repeatable} {norm}");
    let run = abbe(&["analyze", "pps", "--q", q]);
    assert!(run.stderr.contains("published figures are not compared: --q"), "{}", run.stderr);
}

#[test]
fn a_configuration_outside_the_limits_is_named() {
    let run = abbe(&["analyze", "pps", "--q", "100,300,900,700deg,0,0"]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("q4"), "{}", run.stderr);
    let run = abbe(&["analyze", "pps", "--q", "1,2"]);
    assert!(run.stderr.contains("expected 6 joint variables, found 2"), "{}", run.stderr);
}

#[test]
fn more_than_two_machines_are_pages_with_an_index() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("pages");
    prints(&["explore", "ur5", "scara", "stanford", "--out", out.to_str().unwrap()]);
    let index = fs::read_to_string(out.join("index.html")).unwrap();
    for name in ["ur5", "scara", "stanford"] {
        assert!(index.contains(&format!("<a href=\"{name}.html\">{name}</a>")), "{name}");
        let page = fs::read_to_string(out.join(format!("{name}.html"))).unwrap();
        assert_eq!(without_scripts(&page).matches("abbe-panel\"></section>").count(), 1);
    }
    let twice = abbe(&["explore", "ur5", "ur5", "scara", "--out", out.to_str().unwrap()]);
    assert_eq!(twice.status, 2);
    assert!(twice.stderr.contains("two pages would have the name ur5.html"), "{}", twice.stderr);
}

/// The weight of a beam loads the structure only where its source is enabled: the code of a page,
/// which has every source, cannot switch it.
#[test]
fn a_disabled_source_with_a_weight_cannot_be_switched_on() {
    let folder = tempdir().unwrap();
    let text = include_str!("../../../docs/reference/spec.md");
    let (_, spec) = text.split_once("```toml\n").unwrap();
    let (spec, _) = spec.split_once("```").unwrap();
    // Without the covariance of its calibration.
    let spec = write(folder.path(), "arm.toml", spec.split("[covariance]").next().unwrap());
    let beam = "bending of the upper arm";
    for (options, follows) in [(&[][..], true), (&["--disable", beam], false)] {
        let list = reports(&[&[spec.to_str().unwrap()], options].concat());
        let sources = list[0]["sources"].as_array().unwrap();
        let k = sources.iter().position(|source| source["name"] == beam).unwrap();
        assert_eq!(sources[k]["enabled"], follows);
        assert_eq!(sources[k]["follows"] == k, follows, "{}", sources[k]["follows"]);
    }
}

#[test]
fn sources_without_an_error_have_no_share() {
    let scales: Vec<String> = names(&reports(&["ur5"])[0]["sources"])
        .into_iter()
        .flat_map(|name| ["--scale".to_owned(), format!("{name}=0")])
        .collect();
    let text = prints(&[&["analyze".to_owned(), "ur5".to_owned()], &scales[..]].concat());
    assert!(text.contains("0 %") && !text.contains("NaN"), "{text}");
}
