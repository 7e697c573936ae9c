//! Generated code as it is checked in, compiled with warnings denied: a change of it stands in the
//! review.
//!
//! `UPDATE_EXPECT=1 cargo test -p abbe-tests` writes it anew.

use std::path::Path;

use abbe::{LookupTable, Manipulator, Scalar};
use abbe_codegen::{CompileError, compile_into, print};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::{golden, specs};
use expect_test::expect_file;

/// The smallest spec there is: everything optional is missing.
const SLIDE: &str = r#"
[manipulator]
name = "slide"
length = "mm"
[[frame]]
name = "carriage"
variable = { name = "d1", kind = "prismatic" }
transform = "Tx(d1)"
"#;

/// Names that generated code uses itself, constants that look like π, text that looks like markup.
const NAMES: &str = r#"
[manipulator]
name = "self_"
title = "A robot with <unlucky> [names]"
description = "Its `names` | are those that *generated* code has: see [`nothing`] and <b>."
length = "m"
[parameters]
q = { value = "3.14 m", description = "Not [quite] <pi>" }
None = 0.5
ERRORS = "2 m"
T = 1.57
zero = "1 K"
t1 = { value = "0.7071 m^2", description = "" }
r1_11 = 2
EI = "5 N*m^2"
pose = "2.718281828 s"
_s = 1
[inputs]
u = { value = "20 N", range = ["-1e3 N", "1 kN"] }
columns = { value = 6.2832, range = [-7, 7] }
[[frame]]
name = "first | `frame`"
variable = { name = "Some", kind = "revolute", limits = [-1.5708, "pi/2"] }
transform = "Rz(Some + None*T) Tx(q) Ty(ERRORS*Some) Rx(r1_11 - pi)"
[[frame]]
name = "x"
variable = { name = "self_", kind = "prismatic" }
transform = "Rz(_s) Tx(self_) Ry(atan2(self_, q)) Rx(abs(Some)^2.7)"
[[source]]
name = "\"quoted\" \\ name"
class = "random"
distribution = "normal"
frame = "x"
e_x = "u*q^3/(3*EI) * sqrt(t1)/q + 1e-6 m/K*zero"
e_p = "columns * 1e-6 + 1e-6/s*pose + asin(_s/2)/tan(T)^2"
"#;

fn spec(name: &str) -> Spec {
    if name == "measured" {
        return Spec::read(specs::path(name)).unwrap();
    }
    let long = long_chain();
    let own = [("long", &*long), ("slide", SLIDE), ("self_", NAMES)];
    let shipped = SHIPPED.iter().map(|shipped| (shipped.name, shipped.spec));
    let (_, text) = shipped.chain(own).find(|(known, _)| *known == name).unwrap();
    Spec::parse(&format!("{name}.toml"), text).unwrap()
}

#[test]
fn generated_code_is_what_is_checked_in() {
    for name in ["long", "measured", "pps", "puma560", "self_", "slide"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{name}.rs"));
        expect_file![path].assert_eq(&print::rust(&spec(name)));
    }
}

#[test]
fn the_same_bytes_every_time() {
    for shipped in SHIPPED {
        let spec = spec(shipped.name);
        assert_eq!(print::rust(&spec), print::rust(&Spec::parse(&spec.file, shipped.spec).unwrap()));
    }
}

#[test]
fn no_absolute_path_no_time_and_not_too_long() {
    for shipped in SHIPPED {
        let text = print::rust(&spec(shipped.name));
        assert!(!text.contains(env!("CARGO_MANIFEST_DIR")), "{}", shipped.name);
        println!("{}: {} bytes", shipped.name, text.len());
        // All but the one whose 24 numbers are parameters, and the one with six errors in every
        // frame and Euler rows.
        assert!(text.len() < 95_000 || ["general6r", "pps"].contains(&shipped.name), "{}", shipped.name);
    }
}

/// A build script's folder gives the same bytes, and writes only what has changed.
#[test]
fn build_script_door() {
    let (specs, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for name in ["pps", "slide"] {
        let text = SHIPPED.iter().find(|shipped| shipped.name == name).map_or(SLIDE, |shipped| shipped.spec);
        std::fs::write(specs.path().join(format!("{name}.toml")), text).unwrap();
    }
    compile_into(specs.path(), out.path()).unwrap();
    let modified = |name: &str| std::fs::metadata(out.path().join(name)).unwrap().modified().unwrap();
    let generated = std::fs::read_to_string(out.path().join("abbe_pps.rs")).unwrap();
    assert_eq!(generated, print::rust(&spec("pps")));
    let before = [modified("abbe_pps.rs"), modified("abbe_slide.rs"), modified("abbe_manipulators.rs")];
    std::fs::write(specs.path().join("slide.toml"), SLIDE.replace("d1", "x1")).unwrap();
    compile_into(specs.path(), out.path()).unwrap();
    let after = [modified("abbe_pps.rs"), modified("abbe_slide.rs"), modified("abbe_manipulators.rs")];
    assert_eq!((before[0], before[2]), (after[0], after[2]));
    assert_ne!(before[1], after[1]);

    std::fs::write(specs.path().join("zz.toml"), SLIDE).unwrap();
    let clash = SLIDE.replace("\"d1\"", "\"d2\"");
    std::fs::write(specs.path().join("slide.toml"), SLIDE).unwrap();
    std::fs::write(specs.path().join("broken.toml"), clash).unwrap();
    let Err(CompileError::Specs(all)) = compile_into(specs.path(), out.path()) else {
        panic!("two manipulators of one name, and one broken");
    };
    assert_eq!(all.len(), 2);
    let extensions = std::fs::read_dir(out.path()).unwrap().map(|file| file.unwrap().path());
    let mut extensions = extensions.map(|path| path.extension().unwrap().to_owned());
    assert!(extensions.all(|extension| extension == "rs"), "only whole files");
}

/// `f32`, and numbers that carry a derivative, run through the same code.
#[test]
fn generic_over_the_scalar() {
    use golden::puma560::{self, raw};
    let q = [0.3, 0.9, -0.7, 0.4, 1.1, -0.2];
    let (pose, columns) = puma560::joint_jacobian(&q, &puma560::Parameters::NOMINAL).unwrap();
    for (joint, column) in columns.iter().enumerate() {
        let dual: [Dual; 6] = std::array::from_fn(|i| Dual(q[i], f64::from(i == joint)));
        let mut carried = [[Dual(0.0, 0.0); 3]; 4];
        raw::pose(&dual, &[], &mut carried);
        for row in 0..3 {
            assert_eq!(carried[3][row].0, pose.position()[row]);
            assert!((carried[3][row].1 - column[row]).abs() < 1e-15);
        }
    }
    let mut single = [[0.0_f32; 3]; 4];
    raw::pose(&q.map(|value| value as f32), &[], &mut single);
    for (single, double) in single.as_flattened().iter().zip(pose.0.as_flattened()) {
        assert!((f64::from(*single) - double).abs() < 1e-6);
    }
}

/// Typed calls answer with an error value where there is no result.
#[test]
fn errors_are_values() {
    use golden::pps::{self, Parameters};
    let home = [1128.0, 280.0, 0.0, 0.0, 0.0, 0.0];
    let singular = [1128.0, 280.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0];
    assert!(pps::pose(&singular, &Parameters::NOMINAL).is_ok());
    assert!(matches!(
        pps::error_jacobian(&singular, &Parameters::NOMINAL),
        Err(abbe::Error::EulerSingularity { margin }) if margin < 1e-15
    ));
    let mut nan = home;
    nan[2] = f64::NAN;
    let expected = abbe::Error::NotFinite { quantity: abbe::Quantity::Variables, index: 2 };
    assert_eq!(pps::error_jacobian(&nan, &Parameters::NOMINAL), Err(expected));
    let stiff = Parameters { arm_EI: 0.0, ..Parameters::NOMINAL };
    assert!(matches!(
        pps::generalized_errors(&home, &stiff, &pps::Inputs::NOMINAL),
        Err(abbe::Error::NotFinite { quantity: abbe::Quantity::Errors, .. })
    ));
    let wrong = golden::slide::Slide.pose(&[1.0, 2.0], &[]);
    assert!(matches!(wrong, Err(abbe::Error::Count { expected: 1, found: 2, .. })));
}

/// A value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dual(f64, f64);

impl std::ops::Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}

impl std::ops::Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}

impl std::ops::Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.0 + self.0 * b.1)
    }
}

impl std::ops::Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        Self(self.0 / b.0, (self.1 - self.0 / b.0 * b.1) / b.0)
    }
}

impl std::ops::Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Dual {
    fn chain(self, value: f64, slope: f64) -> Self {
        Self(value, slope * self.1)
    }
}

impl Scalar for Dual {
    fn constant(value: f64) -> Self {
        Self(value, 0.0)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.0);
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }
    fn tan(self) -> Self {
        let tangent = self.0.tan();
        self.chain(tangent, 1.0 + tangent * tangent)
    }
    fn asin(self) -> Self {
        self.chain(self.0.asin(), 1.0 / (1.0 - self.0 * self.0).sqrt())
    }
    fn acos(self) -> Self {
        self.chain(self.0.acos(), -1.0 / (1.0 - self.0 * self.0).sqrt())
    }
    fn atan(self) -> Self {
        self.chain(self.0.atan(), 1.0 / (1.0 + self.0 * self.0))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.0 * self.0 + x.0 * x.0;
        Self(self.0.atan2(x.0), (x.0 * self.1 - self.0 * x.1) / square)
    }
    fn sqrt(self) -> Self {
        self.chain(self.0.sqrt(), 0.5 / self.0.sqrt())
    }
    fn abs(self) -> Self {
        self.chain(self.0.abs(), self.0.signum())
    }
    fn exp(self) -> Self {
        self.chain(self.0.exp(), self.0.exp())
    }
    fn ln(self) -> Self {
        self.chain(self.0.ln(), 1.0 / self.0)
    }
    fn sign(self) -> Self {
        Self::constant(self.0.signum())
    }
    fn side(self) -> Self {
        Self::constant(Scalar::side(self.0))
    }
    fn is_positive(self) -> bool {
        self.0 > 0.0
    }
    fn min(self, other: Self) -> Self {
        if self.0 < other.0 { self } else { other }
    }
    fn max(self, other: Self) -> Self {
        if self.0 > other.0 { self } else { other }
    }
    fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]) {
        let (t, coefficients) = self.0.piece(table);
        (self.chain(t, table.unit()), coefficients.map(Self::constant))
    }
    fn powf(self, exponent: Self) -> Self {
        self.chain(self.0.powf(exponent.0), exponent.0 * self.0.powf(exponent.0 - 1.0))
    }
}

#[test]
fn unlucky_names_obey_the_laws() {
    abbe::laws::all(&golden::self_::ManipulatorSelf, 60).unwrap();
}
