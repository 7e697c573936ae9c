//! Parameters of LinuxCNC's kinematics `genhexkins`: a platform on six legs, whose lengths are the
//! positions of the joints.
//!
//! With the tool point t and `R = Rz(C) Ry(B) Rx(A)` joint N is at the length
//!
//! ```text
//! |t + R a_N − b_N|      a: joint on the platform, from the tool point along the axes of the tool
//!                        b: joint on the base, in F_0
//! ```
//!
//! which is the length of the real leg where its variable is 0, plus the variable.

use std::fmt::Write;

use abbe::{Manipulator, Pose, analysis::sampling};
use abbe_spec::{Diagnostics, Loop, Symbol, mistake, option::TO_URDF};

use crate::export::origins::moves;
use crate::export::{ExportReport, ExportedFile, RealMachine};
use crate::placement::roll_pitch_yaw;

/// Writes the joints and lengths of the legs of the real machine as a HAL file, in mm.
///
/// # Errors
///
/// The machine is no platform that carries the tool on six legs from the base, or the length of a
/// leg is not its variable and a constant.
pub fn write_genhexkins(machine: &RealMachine) -> Result<ExportReport, Diagnostics> {
    let spec = &machine.spec;
    let refused = |message: String| {
        let help = format!(
            "genhexkins holds six legs from the base to the part with the tool, each as long as its variable \
             and a constant; `{TO_URDF}` writes frames and loops, `abbe generate` code for any machine"
        );
        mistake::with_help(&machine.origin, message, help)
    };
    let (joints, loops) = (spec.variables.len(), spec.loops.len());
    if (joints, loops) != (6, 6) {
        return Err(refused(format!("the machine has {joints} commanded joints and {loops} loops")));
    }
    let home = machine.mean_tool(&sampling::home(machine.manipulator.description()));
    let home = home.map_err(|error| mistake::whole(&machine.origin, &error))?;
    let mm = spec.length.in_metres() * 1e3;
    let (position, turn) = (home.position().map(|x| x * mm), roll_pitch_yaw(&home).map(f64::to_degrees));
    let axes = [position, turn].concat().iter().map(|x| format!(" {x:.9}")).collect::<String>();
    let mut text = format!(
        "# {}: for KINEMATICS = genhexkins, LINEAR_UNITS = mm, ANGULAR_UNITS = degree.\n\
         # X Y Z: tool point in F_0. A B C: roll, pitch and yaw of the tool. Joints: lengths of legs.\n\
         # For the INI file, if each joint is homed where its variable in the spec is 0:\n\
         # [TRAJ] HOME ={axes}\n",
        spec.name
    );
    for (n, variable) in spec.variables.iter().enumerate() {
        let name = &variable.name;
        let leg = spec.loops.iter().find_map(|closed| match machine.affine(closed.closure.length()?)? {
            (length, Some((Symbol::Variable(i), 1.0))) if i == n => Some((closed, length)),
            _ => None,
        });
        let missing = || refused(format!("no leg has the length `{name}` and a constant"));
        let (closed, length) = leg.ok_or_else(missing)?;
        let loose =
            || format!("\"{}\" does not join the base and the part that carries the tool", closed.name);
        let ends = ends(machine, closed).ok_or_else(|| refused(loose()))?;
        let _ = write!(text, "# [JOINT_{n}]");
        let [lower, upper] = variable.limits;
        let keys = ["HOME_OFFSET", "HOME", "MIN_LIMIT", "MAX_LIMIT"];
        for (key, q) in keys.into_iter().zip([0.0, variable.home, lower, upper]) {
            let _ = write!(text, " {key} = {:.12}", (length + q) * mm);
        }
        let _ = writeln!(text, " ({name})");
        for (end, point) in ["base", "platform"].into_iter().zip(ends) {
            for (axis, x) in ["x", "y", "z"].into_iter().zip(point) {
                let _ = writeln!(text, "setp genhexkins.{end}.{n}.{axis} {:.12}", x * mm);
            }
        }
    }
    text += "setp genhexkins.spindle-offset 0\nsetp genhexkins.screw-lead 0\n";
    let files = vec![ExportedFile { name: "genhexkins.hal".to_owned(), text }];
    let mut report = ExportReport::for_mean(machine, "parameters of genhexkins (LinuxCNC)", files)?;
    report.left_out.push(
        "Set `KINEMATICS = genhexkins` in the section [KINS] of the INI file, name `genhexkins.hal` there as a \
         `HALFILE` behind the one that loads the kinematics, and copy the values of [TRAJ] and [JOINT_N] from \
         its comments. They hold for the tool point of the spec (`tool-offset` 0), and for legs whose screws \
         do not turn with the joints (`screw-lead` 0)."
            .to_owned(),
    );
    Ok(report)
}

/// Returns the ends of a leg: the one on the base in `F_0`, the other one in the frame of the tool
/// point. `None` if they move there.
fn ends(machine: &RealMachine, closed: &Loop) -> Option<[[f64; 3]; 2]> {
    let spec = &machine.spec;
    // A frame that moves has no pose.
    let pose = |path: &[usize]| {
        path.iter().try_fold(Pose::IDENTITY, |pose, i| {
            let factors = &spec.frames[*i].factors;
            let fixed = (!moves(factors)).then(|| pose.then(&machine.pose_at_zero(factors)));
            fixed.map(|pose| pose.then(&machine.mean_error(*i)))
        })
    };
    let [first, second] = closed.frames.map(|frame| spec.path(frame));
    let carrier = spec.path(Some(spec.tool_frame));
    [[&first, &second], [&second, &first]].into_iter().find_map(|[base, platform]| {
        let common = platform.iter().zip(&carrier).take_while(|(one, other)| one == other).count();
        let tool =
            pose(&carrier[common..]).filter(|_| !moves(&spec.tool))?.then(&machine.pose_at_zero(&spec.tool));
        Some([pose(base)?.position(), tool.inverse().apply(pose(&platform[common..])?.position())])
    })
}
