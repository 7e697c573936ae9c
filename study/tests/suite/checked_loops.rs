//! `check` of machines whose frames are not a chain.

use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::check::{Check, Home, Report, State, Tree};

const PAGE: &str = include_str!("../../../docs/reference/spec.md");

/// Returns an example of the reference page.
fn example(name: &str) -> String {
    let start = format!("toml\n# {name}\n");
    let text = PAGE.split("```").find_map(|block| block.strip_prefix(&start));
    text.expect("an example of docs/reference/spec.md").to_owned()
}

fn checked(text: &str) -> Report {
    let spec = Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Check { machine: Machine::of_spec(spec, "machine.toml") }.run(&mut ()).unwrap()
}

fn parts(report: &Report) -> (&Tree, &Home) {
    let tree = report.tree.as_ref().unwrap();
    (tree, tree.home.as_ref().unwrap())
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found}, not {expected}");
}

/// Checks values and conditioning of a four-bar linkage against its closed form.
#[test]
fn a_four_bar_linkage() {
    let report = checked(&example("linkage.toml"));
    let (tree, home) = parts(&report);
    assert!(report.passed());
    assert_eq!((tree.commanded, tree.passive.len(), tree.equations), (1, 2, 2));
    assert_eq!((tree.tool.as_str(), tree.loops[0].passive.join(" ").as_str()), ("coupler", "p1 p2"));
    assert_eq!(home.state, State::Closed);
    assert!(tree.loops[0].gap.unwrap() < 1e-12 && tree.loops[0].angular_gap.is_none());

    // Two circles: about the end of the crank, and about the pivot of the rocker.
    let (crank, coupler, rocker, base) = (40.0, 120.0, 80.0, 100.0);
    let q = 60_f64.to_radians();
    let (x, y) = (crank * q.cos(), crank * q.sin());
    let (dx, dy) = (base - x, -y);
    let distance = f64::hypot(dx, dy);
    let along = (distance * distance + coupler * coupler - rocker * rocker) / (2.0 * distance);
    let across = (coupler * coupler - along * along).sqrt();
    let pin = [x + (along * dx - across * dy) / distance, y + (along * dy + across * dx) / distance];
    let absolute = (pin[1] - y).atan2(pin[0] - x);
    let angle = pin[1].atan2(pin[0] - base);
    close(tree.passive[0].value, absolute - q);
    close(tree.passive[1].value, angle);

    // The columns of φ_p are the velocities of the pin, in arm lengths.
    let arm = crank + coupler + f64::hypot(base + rocker * angle.cos(), rocker * angle.sin()) + 30.0;
    let [a, b] = [coupler / arm, rocker / arm];
    let columns = [[-a * absolute.sin(), a * absolute.cos()], [b * angle.sin(), -b * angle.cos()]];
    let squares = a * a + b * b;
    let determinant = columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
    let root = (squares * squares - 4.0 * determinant * determinant).sqrt();
    let expected = ((squares + root) / (squares - root)).sqrt();
    let found = home.condition.unwrap();
    assert!((found / expected - 1.0).abs() < 0.01, "{found}, not {expected}");
}

/// Checks the distance by which links that are too short stay apart.
#[test]
fn links_that_are_too_short() {
    let text = example("linkage.toml").replace("Tx(120)", "Tx(20)").replace("Tx(80)", "Tx(20)");
    let report = checked(&text);
    let (tree, home) = parts(&report);
    assert!(!report.passed() && report.laws.is_empty());
    assert_eq!(home.state, State::Open);
    let q = 60_f64.to_radians();
    close(f64::hypot(100.0 - 40.0 * q.cos(), 40.0 * q.sin()) - 40.0, tree.loops[0].gap.unwrap());
}

/// Checks that values near home, which Newton's method does not reach from the spec, make the spec
/// valid.
#[test]
fn a_home_far_from_closed() {
    let narrow = example("linkage.toml").replace("-170 deg", "50 deg").replace("170 deg", "70 deg");
    let text = narrow.replace("\"65 deg\"", "\"150 deg\"");
    let report = checked(&text);
    let (tree, home) = parts(&report);
    assert_eq!(home.state, State::Far);
    let [first, second] = [0, 1].map(|i| format!("\"{} rad\"", tree.passive[i].value));
    let text = text.replace("\"-40 deg\"", &first).replace("\"150 deg\"", &second);
    assert!(checked(&text).passed());
}

/// Checks that links in one line can move by themselves, and in which direction.
#[test]
fn links_in_line() {
    let straight = [("60 deg", "0 deg"), ("-40 deg", "0 deg"), ("65 deg", "0 deg")];
    let straight = straight.iter().fold(example("linkage.toml"), |text, (a, b)| text.replace(a, b));
    let report = checked(&straight.replace("Tx(120)", "Tx(100)").replace("Tx(80)", "Tx(40)"));
    let (_, home) = parts(&report);
    assert_eq!(home.state, State::Singular);
    let [free] = &home.free[..] else { panic!("{:?}", home.free) };
    assert_eq!((free.passive.join(" ").as_str(), free.loops.join(" ").as_str()), ("p1 p2", "knee"));
    // The pin moves across the line at 100 δp1 = 40 δp2.
    close(free.motion[0], 0.4);
    close(free.motion[1], 1.0);
}

/// Checks that branches without loops are a valid machine, all of whose variables are commanded.
#[test]
fn two_arms() {
    let text = r#"
        manipulator = { name = "torso", length = "mm" }
        frame = [
            { name = "torso", variable = { name = "q0", kind = "revolute" }, transform = "Rz(q0)" },
            { name = "left", variable = { name = "q1", kind = "revolute" }, transform = "Ty(100) Rz(q1) Tx(400)" },
            { name = "right", parent = "torso", variable = { name = "q2", kind = "revolute" },
              transform = "Ty(-100) Rz(q2) Tx(400)" },
        ]
    "#;
    let report = checked(text);
    let tree = report.tree.as_ref().unwrap();
    assert!(report.passed() && tree.home.is_none());
    assert_eq!((tree.tool.as_str(), tree.commanded, tree.equations), ("left", 3, 0));
    assert_eq!(report.facts.frames[2].parent.as_deref(), Some("torso"));
    // Errors of the right arm do not move the tool of the left one: 2 · 4 + 2 of a chain.
    assert_eq!(report.identifiable[0].rank, Some(10));
}
