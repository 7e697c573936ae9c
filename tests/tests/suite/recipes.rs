//! The recipes of `docs/sources.md`: the chapter's own blocks, combined to a spec, compared with
//! explicit formulas.

use std::path::Path;

use abbe::{Class, Distribution, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

fn recipes() -> Spec {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/sources.md");
    let text = std::fs::read_to_string(path).unwrap();
    let blocks = text.split("```").skip(1).step_by(2).filter_map(|block| block.strip_prefix("toml\n"));
    Spec::parse("docs/sources.md", &blocks.collect::<Vec<_>>().join("\n")).unwrap()
}

/// Returns the six errors of a source at the table or the rail.
fn errors(spec: &Spec, source: &str, frame: usize, q: [f64; 2], u: [f64; 3]) -> [f64; 6] {
    let robot = Interpreter::new(spec.clone());
    let description = robot.description();
    let mut values = vec![0.0; description.effects.len()];
    robot.effects(&q, &[], &u, &mut values).unwrap();
    let mut errors = [0.0; 6];
    for (effect, value) in description.effects.iter().zip(values) {
        if description.sources[effect.source].name == source && effect.frame == frame {
            errors[effect.component.index()] = value;
        }
    }
    errors
}

fn close(errors: [f64; 6], expected: [f64; 6]) {
    let largest = expected.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    for (a, b) in errors.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-10 * largest, "{errors:?}, expected {expected:?}");
    }
}

#[test]
fn every_recipe_gives_its_formula() {
    use std::f64::consts::PI;
    let spec = recipes();
    for (d1, q2, u) in [(700.0, 0.4, [3.0, 1.0, 80.0]), (1900.0, -2.1, [-7.0, -1.0, 15.0])] {
        let at = |source: &str, frame: usize| errors(&spec, source, frame, [d1, q2], u);
        let [temperature, approach, payload] = u;
        // Fritsch and Butland's cubic interpolates the points and stays between neighbors.
        let [_, y, ..] = at("rail, as measured", 0);
        assert!(if d1 == 700.0 { 0.0125 < y && y < 0.018 } else { -0.0035 < y && y < 0.011 }, "{y}");
        let [_, y, ..] = errors(&spec, "rail, as measured", 0, [1500.0, q2], u);
        assert!((y - 0.011).abs() < 1e-15);
        let arcsec = PI / 180.0 / 3600.0;
        let turned = if u[1] == 1.0 { 0.9 * arcsec } else { -0.8 * arcsec };
        close(at("hysteresis of the turntable", 1), [0.0, 0.0, 0.0, turned, 0.0, 0.0]);
        // The rotation is minus the slope of the translation, by central differences.
        let rail = at("rail profile", 0);
        let z = |d1: f64| errors(&spec, "rail profile", 0, [d1, q2], u)[2];
        close(
            rail,
            [
                0.0,
                0.0,
                0.05 * (d1 / 2000.0_f64).powi(2) + 0.02 * (2.0 * PI * d1 / 800.0).sin(),
                rail[3],
                0.0,
                0.0,
            ],
        );
        assert!((rail[3] + (z(d1 + 1e-2) - z(d1 - 1e-2)) / 2e-2).abs() < 1e-12);
        close(at("turntable encoder", 1), [0.0, 0.0, 0.0, PI / 100_000.0, 0.0, 0.0]);
        close(at("encoder disc off centre", 1), [0.0, 0.0, 0.0, 0.008 / 60.0 * (q2 + 0.7).sin(), 0.0, 0.0]);
        close(at("backlash, direction known", 1), [0.0, 0.0, 0.0, 15e-6 * approach, 0.0, 0.0]);
        close(at("growth of the scale", 0), [11.5e-6 * d1 * temperature, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // 500 mm below, in axes that do not rotate with the table: the tilt about z moves the table
        // by −500 · 0.2e-3.
        let (s, c) = q2.sin_cos();
        let shift = 0.1 - 500.0 * 0.2e-3;
        close(at("foot of the column", 1), [c * shift, 0.0, s * shift, 0.0, 0.2e-3 * c, -0.2e-3 * s]);
        // The load is 250 mm off center, and bends the column by M = 250 mm · W about the
        // transverse axis.
        let (w, l) = (payload * 9806.65, 500.0);
        let (ei, m) = (4e15, 250.0 * w);
        // About z of F_0 by −M c, about x by M s, in the frame of the unrotated column; then
        // converted to the rotated table.
        let (about_z, about_x) = (-m * c * l / ei, -m * s * l / ei);
        // The tool pushes along −x of F_0: it bends the column about z, and twists it by 250 mm sin
        // q2.
        let (f, gj) = (200e3, 3e15);
        let (along_x, along_z) = (-about_z * l / 2.0 - f * l.powi(3) / (3.0 * ei), about_x * l / 2.0);
        let (about_z, about_y) = (about_z + f * l * l / (2.0 * ei), 250.0 * s * f * l / gj);
        close(
            at("bending of the column", 1),
            [
                c * along_x - s * along_z,
                0.0,
                s * along_x + c * along_z,
                about_y,
                s * about_x + c * about_z,
                c * about_x - s * about_z,
            ],
        );
        let give = at("bearing of the table", 1);
        close(give, [-1e-9 * f * c, -5e-10 * w, -1e-9 * f * s, 0.0, -2e-13 * m, 0.0]);
        // 30 kg of the column, which the bearing at its end does not carry.
        close(at("carriage of the rail", 0), [0.0, -1e-9 * (w + 30.0 * 9806.65), 0.0, 0.0, 0.0, 0.0]);
        close(at("scale slips", 0), [0.005, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close(at("scale slips", 1), [-0.002 * c, 0.0, -0.002 * s, 0.0, 0.0, 0.0]);
    }
}

/// Checks that classes and distributions follow the chapter's recommendations.
#[test]
fn classes_are_as_recommended() {
    let spec = recipes();
    let robot = Interpreter::new(spec.clone());
    let class =
        |name: &str| robot.description().sources.iter().find(|source| source.name == name).unwrap().class;
    assert_eq!(class("turntable encoder"), Class::Random(Distribution::Uniform));
    assert_eq!(class("scale slips"), Class::Random(Distribution::Normal));
    assert_eq!(class("bending of the column"), Class::Repeatable);
    assert!(
        spec.sources.iter().any(|source| !source.enabled && source.name == "backlash, direction unknown")
    );
}

/// Checks that the effects of one random source share one magnitude: at q2 = 0 the two slips partly
/// cancel.
#[test]
fn effects_of_one_source_go_together() {
    let mut spec = recipes();
    spec.sources.retain(|source| source.name == "scale slips");
    let robot = Interpreter::new(spec.clone());
    let workspace = abbe::analysis::joint_grid(
        &robot,
        &[
            abbe::analysis::Axis { index: 0, values: vec![0.0] },
            abbe::analysis::Axis { index: 1, values: vec![0.0] },
        ],
    )
    .unwrap();
    let budget = abbe::analysis::error_budget(&robot, &workspace, Default::default(), &mut ()).unwrap();
    // 3σ of 5 µm − 2 µm, not of √(5² + 2²).
    assert!((budget.combined.random_radius.value - 3.0 * 0.003).abs() < 1e-15);
}
