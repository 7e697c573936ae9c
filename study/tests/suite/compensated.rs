//! Verdicts on the compensated machine, compared with probabilities in closed form.

use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::analyze::{Analyze, CompensationBasis, Report, ToleranceVerdict, Verdict};
use abbe_study::bound::Bound;
use abbe_study::study_file::JudgedMachine;
use abbe_study::{Machine, Study};

/// A slide with an error of 0.1 mm along x and a normal one of 0.01 mm in the same direction.
const SLIDE: &str = r#"
[manipulator]
name = "slide"
length = "mm"
[inputs]
payload = { value = "2 kg", uncertainty = "0.5 kg" }
[[frame]]
name = "slide"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "100 mm"] }
transform = "Tx(d1)"
[[source]]
name = "offset"
class = "repeatable"
frame = "slide"
e_x = "0.1 mm"
[[source]]
name = "play"
class = "random"
distribution = "normal"
frame = "slide"
e_x = "0.01 mm"
"#;

fn read(text: &str, study: &str) -> Result<Report, String> {
    let spec = Spec::parse("slide.toml", text).map_err(|refused| refused.to_string())?;
    let study = format!("[study]\ntitle = \"t\"\n{study}");
    let study =
        Study::read(Document::new("study.toml", study), &spec).map_err(|refused| refused.to_string())?;
    Ok(Analyze::new(Machine::of_spec(spec, "slide.toml"), study).run(&mut ()).unwrap())
}

fn analyzed(tolerance: &str, compensation: &str, added: &str) -> Report {
    let study = format!("tolerance = {tolerance}\n[workspace.joints]\nsamples = 5\n{compensation}");
    read(&format!("{SLIDE}{added}"), &study).unwrap()
}

/// Returns the verdicts on the position: as built and compensated.
fn positions(report: &Report) -> [ToleranceVerdict; 2] {
    let verdicts = report.verdicts.as_ref().unwrap();
    let compensated = verdicts.compensated.as_ref().unwrap();
    [&verdicts.as_built, &compensated.verdicts].map(|verdicts| verdicts.position.clone().unwrap())
}

/// Φ(1.644854) = 0.95 and Φ(2) = 0.977250.
const Z95: f64 = 1.644_853_626_951_472_6;
const PHI_2: f64 = 0.977_249_868_051_820_8;

fn close(found: f64, expected: f64, room: f64) {
    assert!((found - expected).abs() <= room, "{found}, not {expected}");
}

/// A residual of a fifth, ±0.02 mm, and the play of 0.01 mm: `P = Φ((T − 0.02)/0.01)`, and U95
/// where this is 95 %. The verdict counts for the compensated machine; as built it is not met.
#[test]
fn stated_share_has_an_unknown_sign() {
    let asked = "{ position = \"0.04 mm\", probability = 0.95 }";
    let report = analyzed(asked, "[compensation]\ndefault = 0.2\n", "");
    let [built, compensated] = positions(&report);
    let verdicts = report.verdicts.as_ref().unwrap();
    assert_eq!((verdicts.machine, verdicts.verdict), (JudgedMachine::Compensated, Verdict::Met));
    assert_eq!(built.verdict, Verdict::NotMet);
    close(compensated.compliance.probability, PHI_2, 4.0 * compensated.compliance.error);
    close(compensated.u95, 0.02 + 0.01 * Z95, 2e-4);
    close(compensated.radius, 0.02 + 0.03, 1e-12);
    // As built all errors are normal: 0.1 mm ± 0.01 mm.
    close(built.u95, 0.1 + 0.01 * Z95, 1e-9);

    let asked = "{ position = \"0.04 mm\", machine = \"as-built\" }";
    let report = analyzed(asked, "[compensation]\ndefault = 0.2\n", "");
    assert_eq!(report.verdict(), Some(Verdict::NotMet));
}

/// A tolerance of ±0.1 mm, uniform, counts as built as a random error; a residual of a fifth scales
/// its draw: `P = 2 (T/0.02) / 2` without play, and with a play of 0.01 mm the mean of
/// `Φ((T − t)/0.01) − Φ((−T − t)/0.01)` over ±0.02 mm. A calibration corrects it; a published
/// residual replaces it; a residual in mm has any direction.
#[test]
fn a_tolerance_is_what_the_compensation_leaves_of_one_draw() {
    let text = SLIDE.replace("\"repeatable\"", "\"tolerance\"");
    let asked = |compensation: &str| {
        let study = format!("tolerance = \"0.015 mm\"\n[workspace.joints]\nsamples = 5\n{compensation}");
        read(&text.replace("e_x = \"0.01 mm\"", "e_y = \"1e-9 mm\""), &study).unwrap()
    };
    let report = asked("[compensation]\ndefault = 0.2\n");
    let [built, compensated] = positions(&report);
    close(built.compliance.probability, 0.15, 4.0 * built.compliance.error);
    close(compensated.compliance.probability, 0.75, 4.0 * compensated.compliance.error);
    close(compensated.u95, 0.95 * 0.02, 1e-4);
    let [_, compensated] = positions(&asked("[compensation]\noffset = \"0.012 mm\"\n"));
    close(compensated.radius, 0.012, 1e-6);
    let [_, compensated] = positions(&asked("[compensation]\nresidual = \"0.012 mm\"\n"));
    close(compensated.radius, 0.012, 1e-6);
    // What is not compensated keeps its distribution.
    let [_, compensated] = positions(&asked("[compensation]\ndefault = 1.0\n"));
    close(compensated.compliance.probability, 0.15, 4.0 * compensated.compliance.error);
}

/// At one configuration a tolerance is a random error: as built, all figures of some shipped
/// machines are the same if its random sources are tolerances.
#[test]
fn as_built_a_tolerance_counts_as_a_random_error() {
    for shipped in SHIPPED.iter().filter(|shipped| ["pps", "scara", "wam"].contains(&shipped.name)) {
        let [random, tolerance] = ["random", "tolerance"].map(|class| {
            let text = shipped.spec.replace("class = \"random\"", &format!("class = \"{class}\""));
            let spec = Spec::parse("machine.toml", &text).unwrap();
            let study = "[study]\ntitle = \"t\"\ntolerance = \"0.2 mm\"\n[workspace.joints]\nsamples = 20\n";
            let study = Study::read(Document::new("study.toml", study), &spec).unwrap();
            let report = Analyze::new(Machine::of_spec(spec, "machine.toml"), study).run(&mut ()).unwrap();
            serde_json::to_string(&report).unwrap().replace(&format!("\"class\":\"{class}\""), "")
        });
        assert_eq!(random, tolerance, "{}", shipped.name);
    }
}

/// A source that is not named keeps its error with its sign.
#[test]
fn what_is_not_compensated_keeps_its_sign() {
    let other =
        "[[source]]\nname = \"scale\"\nclass = \"repeatable\"\nframe = \"slide\"\ne_x = \"0.03 mm\"\n";
    let report = analyzed("\"0.05 mm\"", "[compensation]\noffset = 0\n", other);
    let [_, compensated] = positions(&report);
    assert!(compensated.compliance.draws.is_none());
    close(compensated.compliance.probability, PHI_2, 1e-9);
    close(compensated.radius, 0.03 + 0.03, 1e-12);
}

/// A residual of all sources together has any direction: with a norm of ρ and an error z along x
/// the norm is within T if `2 ρ z cos θ ≤ T² − ρ² − z²`, with cos θ uniform.
#[test]
fn residual_of_all_sources_has_any_direction() {
    let (residual, tolerance): (f64, f64) = (0.04, 0.045);
    let report = analyzed("\"0.045 mm\"", "[compensation]\nresidual = \"0.04 mm\"\n", "");
    let [_, compensated] = positions(&report);
    let steps = 20_000;
    let mut exact = 0.0;
    for k in 0..steps {
        let z = 0.06 * ((f64::from(k) + 0.5) / f64::from(steps) - 0.5) * 2.0;
        let density = (-0.5 * (z / 0.01).powi(2)).exp() / (0.01 * std::f64::consts::TAU.sqrt());
        let cosine = (tolerance.powi(2) - residual.powi(2) - z * z) / (2.0 * residual * z.abs());
        exact += density * (cosine.clamp(-1.0, 1.0) + 1.0) / 2.0 * 0.12 / f64::from(steps);
    }
    close(compensated.compliance.probability, exact, 4.0 * compensated.compliance.error);
    close(compensated.radius, 0.07, 1e-12);
}

/// The covariance of an identified error is the only error that remains of it; it belongs to both
/// machines. With the play: `√(0.01² + 0.0075²) = 0.0125 mm`.
#[test]
fn calibration_leaves_its_covariance() {
    let found = "[covariance]\nof = [{ source = \"offset\", error = \"e_x\" }]\nrows = [[5.625e-5]]\n";
    let asked = "{ position = \"0.025 mm\", probability = 0.95, machine = \"compensated\" }";
    let report = analyzed(asked, "", found);
    let [built, compensated] = positions(&report);
    let verdicts = report.verdicts.as_ref().unwrap();
    assert_eq!(verdicts.compensated.as_ref().unwrap().basis, CompensationBasis::Identified);
    assert_eq!(report.verdict(), Some(Verdict::Met));
    close(compensated.compliance.probability, 2.0 * PHI_2 - 1.0, 1e-9);
    close(compensated.u95, 0.0125 * 1.959_963_984_540_054, 1e-9);
    close(built.u95, 0.1 + 0.0125 * Z95, 1e-9);
    // Without a statement the verdict is on the machine as built.
    assert_eq!(analyzed("\"0.025 mm\"", "", found).verdict(), Some(Verdict::NotMet));
}

/// The covariance of a calibration is one source of every figure: two offsets along x with σ =
/// 0.0075 mm and a correlation of −0.92 leave `σ² (2 − 1.84) = (0.003 mm)²`, one along y 0.004 mm.
/// With the play: `u = √(0.01² + 0.005²) mm`, bounds of 3 u.
#[test]
fn calibration_is_a_source_of_budget_ledger_draws_and_bound() {
    let found = "[[source]]\nname = \"more\"\nclass = \"repeatable\"\nframe = \"slide\"\n\
                 e_x = \"0.02 mm\"\ne_y = \"0.05 mm\"\n\
                 [covariance]\nof = [{ source = \"offset\", error = \"e_x\" }, { source = \"more\", error = \"e_y\" },\n\
                 { source = \"more\", error = \"e_x\" }]\n\
                 rows = [[5.625e-5, 0, -5.175e-5], [0, 1.6e-5, 0], [-5.175e-5, 0, 5.625e-5]]\n";
    let slide = SLIDE.replace(", uncertainty = \"0.5 kg\"", "");
    let spec = Spec::parse("slide.toml", &format!("{slide}{found}")).unwrap();
    let study = "[study]\ntitle = \"t\"\ntolerance = \"0.2 mm\"\n[workspace.joints]\nsamples = 5\n";
    let study = Study::read(Document::new("study.toml", study), &spec).unwrap();
    let machine = Machine::of_spec(spec, "slide.toml");
    let mut job = Analyze::new(machine.clone(), study.clone());
    job.monte_carlo = Some(50_000);
    let report = job.run(&mut ()).unwrap();

    let (calibration, play) = (0.005, 0.01_f64);
    let both = f64::hypot(calibration, play);
    let budget = report.uncertainty.as_ref().unwrap();
    close(budget.standard_uncertainty[3], both, 1e-12);
    let [first, second] = &budget.sources[..] else { panic!("{:?}", budget.sources) };
    assert_eq!([&*first.source, &*second.source], ["play", "calibration"]);
    for (row, expected) in [0.003, 0.004, 0.0, calibration].into_iter().enumerate() {
        close(second.standard_uncertainty[row], expected, 1e-12);
    }
    close(second.share, (calibration / both).powi(2), 1e-12);

    let names: Vec<&str> = report.ledger.sources.iter().map(|entry| &*entry.name).collect();
    assert_eq!(names, ["offset", "more", "play", "calibration"]);
    // In any direction it is at most as large as along y.
    let largest = 0.012;
    close(report.ledger.sources[3].max, largest, 1e-12);
    close(report.ledger.sources[3].rms.unwrap(), largest, 1e-12);
    assert_eq!((report.sources.len(), report.orientation.sources.len()), (4, 4));
    close(report.sources[3].plain_max.y, largest, 1e-12);
    close(report.combined.radii.random_radius, largest.hypot(3.0 * play), 1e-12);
    close(report.ledger.sources[3].share_of_tolerance.unwrap(), largest / 0.2, 1e-9);

    let drawn = &report.monte_carlo.as_ref().unwrap().worst.errors;
    close(drawn.covariance[1][1], 1.6e-5, 4.0 * drawn.standard_error[1][1]);
    close(drawn.covariance[0][0], 1.09e-4, 4.0 * drawn.standard_error[0][0]);

    let certified = report.certified.as_ref().unwrap().random.as_ref().unwrap().certified.unwrap();
    // The factors of the covariance are sources of their own, any of which may be at 3 σ.
    let factors = [0.0075 * (1.0 - 0.92), 0.0075 * f64::sqrt(1.0 - 0.92 * 0.92)];
    let worst = 3.0 * f64::hypot(play + factors[0] + factors[1], 0.004);
    assert!((worst..worst * 1.011).contains(&certified), "{certified}");
    let bound = Bound::new(machine, study).run(&mut ()).unwrap();
    let random = bound.random.norm.certified.unwrap();
    assert!((worst..worst * 1.011).contains(&random), "{random}");
}

/// A bound counts an uncertain input by the slope of the errors: 0.002 mm/kg² × p² has 0.04 mm/kg
/// at 10 kg, times 0.5 kg, times 3; without it nothing is random.
#[test]
fn bound_counts_the_uncertainty_of_an_input() {
    let sag = "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"slide\"\ne_x = \"0.002 mm/kg^2 * payload^2\"\n";
    let text =
        SLIDE.replace("uncertainty = \"0.5 kg\"", "range = [\"0 kg\", \"10 kg\"], uncertainty = \"0.5 kg\"");
    let (text, _) = text.split_once("[[source]]\nname = \"play\"").unwrap();
    let bound = |text: &str| {
        let spec = Spec::parse("slide.toml", text).unwrap();
        let study = Study::joint_samples(&spec);
        Bound::new(Machine::of_spec(spec, "slide.toml"), study).run(&mut ()).unwrap()
    };
    let report = bound(&format!("{text}{sag}"));
    let random = &report.random.norm;
    close(random.found, 0.06, 1e-9);
    assert!((0.06..0.0607).contains(&random.certified.unwrap()), "{random:?}");
    close(random.at["payload"], 10.0, 1e-9);
    let exact = bound(&format!("{text}{sag}").replace(", uncertainty = \"0.5 kg\"", ""));
    assert_eq!(exact.random.norm.certified, Some(0.0));
}

/// A bound for a study of points in space covers the joint values that reach them, not the limits
/// of the joints: the error of 0.001 mm/mm is 0.2 mm at the end of the study and 1 mm at that of
/// the slide. What lies outside the study is no verdict on it.
#[test]
fn box_of_a_bound_is_that_of_the_study() {
    let gantry = r#"
[manipulator]
name = "gantry"
length = "mm"
[[frame]]
name = "x"
variable = { name = "x", kind = "prismatic", limits = ["0 mm", "1000 mm"] }
transform = "Tx(x)"
[[frame]]
name = "y"
variable = { name = "y", kind = "prismatic", limits = ["0 mm", "1000 mm"] }
transform = "Ty(y)"
[[frame]]
name = "z"
variable = { name = "z", kind = "prismatic", limits = ["0 mm", "1000 mm"] }
transform = "Tz(z)"
[[source]]
name = "scale"
class = "repeatable"
frame = "x"
e_x = "1e-3 * x"
"#;
    let spec = Spec::parse("gantry.toml", gantry).unwrap();
    let bound = |tolerance: &str| {
        let ranges = ["x", "y", "z"]
            .map(|axis| format!("{axis} = {{ from = \"100 mm\", to = \"200 mm\", count = 3 }}\n"));
        let study = format!(
            "[study]\ntitle = \"t\"\ntolerance = \"{tolerance}\"\n[workspace.box]\n{}",
            ranges.concat()
        );
        let study = Study::read(Document::new("study.toml", study), &spec).unwrap();
        Bound::new(Machine::of_spec(spec.clone(), "gantry.toml"), study).run(&mut ()).unwrap()
    };
    let report = bound("0.25 mm");
    let [low, high] = report.spans["x"];
    close(low, 100.0, 1e-6);
    close(high, 200.0, 1e-6);
    let margin = report.margin.unwrap();
    assert!((0.049..0.0500001).contains(&margin.certified.unwrap()), "{margin:?}");
}

/// The uncertainty of an input that the correction uses remains: 0.02 mm/kg × 0.5 kg.
#[test]
fn uncertainty_of_an_input_remains() {
    let sag = "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"slide\"\ne_x = \"0.02 mm/kg * payload\"\n";
    let report = analyzed("\"0.03 mm\"", "[compensation]\ndefault = 0\n", sag);
    let [_, compensated] = positions(&report);
    close(compensated.u95, 0.01 * 2_f64.sqrt() * 1.959_963_984_540_054, 1e-9);
}

/// A verdict on a compensated machine needs something that says what compensation leaves.
#[test]
fn compensated_machine_must_be_known() {
    let study =
        "tolerance = { position = \"0.1 mm\", machine = \"compensated\" }\n[workspace.joints]\nsamples = 5\n";
    let refused = read(SLIDE, study).unwrap_err();
    assert!(refused.contains("nothing says what compensation leaves"), "{refused}");
    let both = "[workspace.joints]\nsamples = 5\n[compensation]\nresidual = \"0.1 mm\"\noffset = 0.1\n";
    let refused = read(SLIDE, both).unwrap_err();
    assert!(refused.contains("`offset` contradicts it"), "{refused}");
}

/// The paper's positioner: as built 5.480 mm of 0.5 mm; with its published residual of 0.25 mm no
/// draw of the four encoders exceeds the tolerance.
#[test]
fn compensated_positioner_meets_its_tolerance() {
    let machine = Machine::find("pps").unwrap();
    let study = Study::find(None, &machine).unwrap();
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    let [built, compensated] = positions(&report);
    assert_eq!((built.verdict, compensated.verdict), (Verdict::NotMet, Verdict::Met));
    assert_eq!(report.verdict(), Some(Verdict::NotMet));
    close(built.radius, 5.480, 5e-4);
    close(compensated.radius, 0.349, 5e-4);
    assert!(compensated.worst_case < 0.5 && compensated.is_bounded && compensated.u95 < compensated.radius);
}
