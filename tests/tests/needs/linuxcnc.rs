//! LinuxCNC with exported compensation files: a simulated machine moves, and the real tool point is
//! computed from the positions that were sent to its motors.

use std::fmt::Write;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};

use abbe::analysis::sampling;
use abbe::{Manipulator, VariableKind, drawn_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_metrology::positioning::Positioning;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::export::{Export, Format};
use abbe_study::template::Template;
use abbe_tests::needs::{Missing, Tests};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub(crate) const TESTS: Tests = &[("files_correct_machines", files_correct_machines)];

/// Runs one machine after the other: there can be only one LinuxCNC.
fn files_correct_machines() -> Result<(), Missing> {
    linuxcnc()?;
    a_mill_of_21_errors_with_backlash();
    the_angles_of_a_table();
    a_measured_axis_that_carries_the_workpiece();
    Ok(())
}

/// Number of targets of each axis that moves alone.
const ALONE: usize = 3;

/// Requires LinuxCNC with its Python modules.
fn linuxcnc() -> Result<(), Missing> {
    let modules = Command::new("/usr/bin/python3").args(["-c", "import linuxcnc, hal"]).output();
    let is_there =
        Path::new("/usr/bin/linuxcnc").exists() && modules.is_ok_and(|output| output.status.success());
    is_there.then_some(()).ok_or_else(|| Missing("linuxcnc is not installed".to_owned()))
}

/// Returns the configuration of a simulated machine, whose motors follow exactly.
fn ini(letters: &[char], spec: &Spec, with_files: bool) -> String {
    let coordinates: String = letters.iter().flat_map(|letter| [' ', *letter]).collect();
    let joined: String = letters.iter().collect();
    let mut text = format!(
        "[EMC]\nVERSION = 1.1\nMACHINE = sim\n[DISPLAY]\nDISPLAY = ./move.py\n[RS274NGC]\n\
         PARAMETER_FILE = sim.var\n[EMCMOT]\nEMCMOT = motmod\nCOMM_TIMEOUT = 4.0\nSERVO_PERIOD = 1000000\n\
         [TASK]\nTASK = milltask\nCYCLE_TIME = 0.001\n[HAL]\nHALFILE = sim.hal\n[TRAJ]\n\
         COORDINATES ={coordinates}\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\n\
         DEFAULT_LINEAR_VELOCITY = 400\nMAX_LINEAR_VELOCITY = 500\n[EMCIO]\nEMCIO = io\nTOOL_TABLE = tool.tbl\n\
         CYCLE_TIME = 0.1\n[KINS]\nKINEMATICS = trivkins coordinates={joined}\nJOINTS = {}\n",
        letters.len()
    );
    for (joint, letter) in letters.iter().enumerate() {
        let variable = &spec.variables[variable(*letter, spec)];
        let is_linear = variable.kind == VariableKind::Prismatic;
        let shown = |value: f64| if is_linear { value } else { value.to_degrees() };
        let ([lower, upper], home) = (variable.limits.map(shown), shown(variable.home));
        let limits = format!(
            "MAX_VELOCITY = 500\nMAX_ACCELERATION = 5000\nMIN_LIMIT = {}\nMAX_LIMIT = {}\n",
            lower - 1.0,
            upper + 1.0
        );
        let kind = if is_linear { "LINEAR" } else { "ANGULAR" };
        let _ = write!(
            text,
            "[AXIS_{letter}]\n{limits}[JOINT_{joint}]\nTYPE = {kind}\nHOME_SEQUENCE = 0\n\
             HOME = {home}\nHOME_OFFSET = {home}\n{limits}"
        );
        if with_files {
            let file = letter.to_ascii_lowercase();
            let _ = write!(text, "COMP_FILE = {file}.comp\nCOMP_FILE_TYPE = 0\n");
        }
    }
    text
}

fn variable(letter: char, spec: &Spec) -> usize {
    let name = letter.to_ascii_lowercase().to_string();
    spec.variables.iter().position(|variable| variable.name == name).unwrap()
}

/// Runs LinuxCNC through commands, in mm and degrees, and returns the positions of the motors.
fn motors(machine: &Machine, letters: &[char], commands: &[Vec<f64>], with_files: bool) -> Vec<Vec<f64>> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).unwrap();
        fs::set_permissions(folder.path().join(name), Permissions::from_mode(0o777)).unwrap();
    };
    fs::set_permissions(folder.path(), Permissions::from_mode(0o777)).unwrap();
    let format = Format::LinuxCnc { nodes: 256, has_matrix: false };
    let report = Export { machine: machine.clone(), format, samples: 10, seed: 0 }.run(&mut ()).unwrap();
    report.files.iter().for_each(|file| write(&file.name, &file.text));
    write("sim.ini", &ini(letters, &machine.spec, with_files));
    let mut hal = "loadrt [KINS]KINEMATICS\nloadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD \
                   num_joints=[KINS]JOINTS\naddf motion-command-handler servo-thread\n\
                   addf motion-controller servo-thread\n\
                   net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n"
        .to_owned();
    for joint in 0..letters.len() {
        let _ = writeln!(hal, "net j{joint} joint.{joint}.motor-pos-cmd => joint.{joint}.motor-pos-fb");
    }
    write("sim.hal", &hal);
    write("tool.tbl", "");
    write("move.py", include_str!("linuxcnc/move.py"));
    let row = |row: &Vec<f64>| row.iter().map(|value| format!("{value:.6}")).collect::<Vec<_>>().join(",");
    let heading: Vec<String> = letters.iter().map(char::to_string).collect();
    let lines: Vec<String> = [heading.join(",")].into_iter().chain(commands.iter().map(row)).collect();
    write("commands.csv", &lines.join("\n"));
    // It refuses to run as root without the id of another user.
    let status = Command::new("/usr/bin/linuxcnc")
        .arg("sim.ini")
        .current_dir(folder.path())
        .env("HOME", folder.path())
        .env("RTAPI_UID", "65534")
        .env_remove("DISPLAY")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .unwrap();
    let log = fs::read_to_string(folder.path().join("linuxcnc_debug.txt")).unwrap_or_default();
    assert!(status.success(), "{log}");
    let text = fs::read_to_string(folder.path().join("motors.csv")).unwrap_or_else(|_| panic!("{log}"));
    // The machine is at home where it starts, with the motors at 0.
    let home = |joint: usize| {
        let variable = &machine.spec.variables[variable(letters[joint], &machine.spec)];
        if variable.kind == VariableKind::Prismatic { variable.home } else { variable.home.to_degrees() }
    };
    let row = |line: &str| {
        let cells = line.split(',').enumerate();
        cells.map(|(joint, cell)| cell.parse::<f64>().unwrap() + home(joint)).collect()
    };
    text.lines().map(row).collect()
}

/// Returns each target after its approach from below and from above by 2 mm, which is not counted.
fn approached(targets: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let from = |target: &Vec<f64>, side: f64| target.iter().map(|value| value - 2.0 * side).collect();
    targets
        .iter()
        .flat_map(|target| [from(target, 1.0), target.clone(), from(target, -1.0), target.clone()])
        .collect()
}

fn a_mill_of_21_errors_with_backlash() {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "machine3").unwrap();
    let mut text = shipped.spec.to_owned();
    for axis in ["x", "y", "z"] {
        let _ = write!(
            text,
            "\n[inputs.{axis}_from]\nvalue = 0\nrange = [-1, 1]\n\n[[source]]\nname = \"backlash of {axis}\"\n\
             class = \"repeatable\"\njoint = \"{axis}\"\nerror = \"{axis}_from * 2.5 um\"\n"
        );
    }
    let machine = Machine::of_spec(Spec::parse("mill.toml", &text).unwrap(), "mill");
    let arm = Interpreter::new(machine.spec.clone());
    let (s, home) = (sampling::nominal_parameters(arm.description()), sampling::home(arm.description()));
    let magnitudes = repeatable_magnitudes(arm.description());
    let input = |axis: usize| {
        let name = format!("{}_from", ["x", "y", "z"][axis]);
        machine.spec.inputs.iter().position(|input| input.name == name).unwrap()
    };
    let error = |motors: &[f64], command: &[f64], side: f64| {
        let mut u = sampling::nominal_inputs(arm.description());
        (0..3).for_each(|axis| u[input(axis)] = side);
        let real = drawn_pose(&arm, motors, &s, &u, &magnitudes).unwrap().position();
        let ideal = arm.pose(command, &s).unwrap().position();
        [0, 1, 2].map(|axis| 1e3 * (real[axis] - ideal[axis]))
    };
    // Every axis alone with the others at home, then random targets.
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut drawn = |axis: usize| {
        let [lower, upper] = machine.spec.variables[axis].limits;
        random.random_range(lower + 3.0..upper - 3.0)
    };
    let alone = (0..3).flat_map(|axis| [axis; ALONE]).map(|axis| {
        let mut target = home.clone();
        target[axis] = drawn(axis);
        target
    });
    let mut targets: Vec<Vec<f64>> = alone.collect();
    targets.extend((0..6).map(|_| (0..3).map(&mut drawn).collect()));
    let commands = approached(&targets);
    let at_home = {
        let sides = [1.0, -1.0].map(|side| error(&home, &home, side));
        [0, 1, 2].map(|axis| (sides[0][axis] + sides[1][axis]) / 2.0)
    };
    let mut largest = [[0.0_f64; 2]; 2];
    for (run, with_files) in [false, true].into_iter().enumerate() {
        let motors = motors(&machine, &['X', 'Y', 'Z'], &commands, with_files);
        for (i, target) in targets.iter().enumerate() {
            for (visit, side) in [(1, 1.0), (3, -1.0)] {
                let error = error(&motors[4 * i + visit], target, side);
                let off = [0, 1, 2].map(|axis| error[axis] - at_home[axis]);
                match i / ALONE {
                    moved @ 0..3 => largest[run][0] = largest[run][0].max(off[moved].abs()),
                    _ => {
                        let norm = off.iter().map(|v| v * v).sum::<f64>().sqrt();
                        largest[run][1] = largest[run][1].max(norm);
                    }
                }
            }
        }
    }
    let [[alone, volume], [alone_with, volume_with]] = largest;
    println!(
        "LinuxCNC, a mill of 21 errors with backlash of 5 um: largest error along an axis that moves alone \
         {alone:.2} um without files, {alone_with:.2} um with them; of the tool point in the volume {volume:.2} \
         and {volume_with:.2} um"
    );
    // Between the nodes, 2.4 mm apart, the sine of the screw differs from a line by 0.1 um.
    assert!(alone > 7.0 && alone_with < 0.2, "{alone} {alone_with}");
    assert!(volume > 5.0 && volume_with < volume, "{volume} {volume_with}");
}

/// A table that turns about C on the bed, below slides.
const TABLE: &str = r#"
[manipulator]
name = "table"
length = "mm"
[inputs]
c_from = { value = 0, range = [-1, 1] }
[[frame]]
name = "C"
variable = { name = "c", kind = "revolute", limits = ["-180 deg", "180 deg"] }
transform = "Rz(c)"
[[frame]]
name = "X"
variable = { name = "x", kind = "prismatic", limits = [0, 500] }
transform = "Tx(x)"
[[frame]]
name = "Y"
variable = { name = "y", kind = "prismatic", limits = [0, 400] }
transform = "Ty(y)"
[[frame]]
name = "Z"
variable = { name = "z", kind = "prismatic", limits = [0, 400] }
transform = "Tz(z)"
[[source]]
name = "ECC"
class = "repeatable"
frame = "C"
e_r = "30e-6 * sin(c)"
[[source]]
name = "backlash of C"
class = "repeatable"
joint = "c"
error = "c_from * 10e-6"
"#;

fn the_angles_of_a_table() {
    let machine = Machine::of_spec(Spec::parse("table.toml", TABLE).unwrap(), "table");
    let targets: Vec<Vec<f64>> =
        [-170.0, -90.0, -33.0, 0.0, 45.0, 90.0, 120.0].iter().map(|c| vec![100.0, 50.0, 20.0, *c]).collect();
    let commands = approached(&targets);
    let mut largest = [0.0_f64; 2];
    for (run, with_files) in [false, true].into_iter().enumerate() {
        let motors = motors(&machine, &['X', 'Y', 'Z', 'C'], &commands, with_files);
        for (i, target) in targets.iter().enumerate() {
            for (visit, side) in [(1, 1.0), (3, -1.0)] {
                let sent = motors[4 * i + visit][3].to_radians();
                let angle = sent + 30e-6 * sent.sin() + side * 10e-6;
                largest[run] = largest[run].max(1e6 * (angle - target[3].to_radians()).abs());
            }
        }
    }
    let [without, with] = largest;
    println!(
        "LinuxCNC, a table: largest error of its angle {without:.2} urad without files, {with:.3} urad with them"
    );
    assert!(without > 30.0 && with < 0.1, "{without} {with}");
}

/// A laser between table and spindle measures X', which carries the workpiece; its deviations
/// become a table of the spec as they are, and the control corrects by it.
fn a_measured_axis_that_carries_the_workpiece() {
    // The position of the spindle over the table minus the command, approached from one side.
    let deviation = |x: f64, side: f64| 0.030 * x / 500.0 + 0.004 * (x / 80.0).sin() + side * 0.002;
    let folder = tempfile::tempdir().unwrap();
    let mut runs = "position (mm),direction,deviation (um)\n".to_owned();
    for at in (0..=500).step_by(10) {
        for (sign, side) in [("+", 1.0), ("-", -1.0)].repeat(5) {
            let _ = writeln!(runs, "{at},{sign},{:.4}", 1e3 * deviation(f64::from(at), side));
        }
    }
    let file = folder.path().join("runs.csv");
    fs::write(&file, runs).unwrap();
    let job = Positioning { data: (&file).into(), reading: None, scale: None, accept: None };
    let report = job.run(&mut ()).unwrap();
    fs::write(folder.path().join("exx.csv"), report.table().unwrap().csv()).unwrap();
    let axes = Template::MachineTool.spec("mill", Some("w X' b Y Z t")).unwrap();
    let (frames, _) = axes.split_once("[[source]]").unwrap();
    let of_side = |side: &str| {
        format!(
            "{{ file = \"exx.csv\", x = {{ column = \"position (mm)\", unit = \"mm\" }}, \
             y = {{ column = \"{side} (um)\", unit = \"um\" }}, interpolation = \"linear\" }}"
        )
    };
    let text = format!(
        "{frames}[inputs]\nx_from = {{ value = 0, range = [-1, 1] }}\n\n[tables]\nup = {}\ndown = {}\n\n\
         [[source]]\nname = \"EXX\"\nclass = \"repeatable\"\nframe = \"X'\"\n\
         e_x = \"(up(x) + down(x))/2 + x_from * (up(x) - down(x))/2\"\n",
        of_side("forward"),
        of_side("reverse")
    );
    let spec = Spec::parse_in(folder.path(), "mill.toml", &text).unwrap();
    let machine = Machine::of_spec(spec, "mill");
    let targets: Vec<Vec<f64>> =
        [30.0, 111.0, 203.0, 250.0, 388.0, 470.0].iter().map(|x| vec![*x, 250.0, 250.0]).collect();
    let commands = approached(&targets);
    let mut largest = [0.0_f64; 2];
    for (run, with_files) in [false, true].into_iter().enumerate() {
        let motors = motors(&machine, &['X', 'Y', 'Z'], &commands, with_files);
        // The motors are at 0 at home, whatever the files correct there.
        let at_home = if with_files { -deviation(250.0, 0.0) } else { 0.0 };
        for (i, target) in targets.iter().enumerate() {
            for (visit, side) in [(1, 1.0), (3, -1.0)] {
                let sent = motors[4 * i + visit][0] + at_home;
                largest[run] = largest[run].max(1e3 * (sent + deviation(sent, side) - target[0]).abs());
            }
        }
    }
    let [without, with] = largest;
    println!(
        "LinuxCNC, a measured axis that carries the workpiece: {without:.2} um without files, {with:.2} um with them"
    );
    assert!(without > 25.0 && with < 0.3, "{without} {with}");
}
