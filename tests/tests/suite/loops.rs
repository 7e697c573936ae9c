//! Closed loops: the machine closes, and `J_e` is the derivative of the machine that closes with
//! errors.

use abbe::laws;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::specs;

const FOUR_BAR: &str = r#"
[manipulator]
name = "four_bar"
length = "mm"

[[frame]]
name = "crank"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"], home = "60 deg" }
transform = "Rz(q1) Tx(40)"

[[frame]]
name = "coupler"
variable = { name = "p1", kind = "revolute", passive = true, home = "-30 deg" }
transform = "Rz(p1) Tx(120)"

[[frame]]
name = "rocker"
parent = "base"
variable = { name = "p2", kind = "revolute", passive = true, home = "80 deg" }
transform = "Tx(100) Rz(p2) Tx(80)"

[[loop]]
name = "knee"
frames = ["coupler", "rocker"]
closes = ["x", "y"]

[tool]
frame = "coupler"
transform = "Ty(30)"

[[source]]
name = "bearing"
class = "repeatable"
frame = "rocker"
e_x = 0.02
e_s = "0.1 mrad"
"#;

fn interpreter(text: &str) -> Interpreter {
    Interpreter::new(Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

#[test]
fn laws_hold() {
    let machine = interpreter(FOUR_BAR);
    laws::all(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
}

#[test]
fn batches_equal_single_configurations() {
    let machine = interpreter(FOUR_BAR);
    let found = laws::batches(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
    assert!(found.relative <= laws::ROUNDING_TOLERANCE, "{found:?}");
}

#[test]
fn laws_hold_for_several_loops() {
    let machine = Interpreter::new(Spec::read(specs::path("linkage")).unwrap());
    laws::all(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
}
