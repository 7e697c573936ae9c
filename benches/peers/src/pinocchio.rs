//! Pinocchio: every `A_i` as a joint about or along a coordinate axis, with the placement of `F_i`
//! on it.

use std::ffi::c_void;

use abbe::{Manipulator, Pose, VariableKind};

use crate::row::{Kind, Row, Side};

unsafe extern "C" {
    fn pinocchio_robot(
        n: i32,
        kinds: *const i32,
        signs: *const f64,
        joints: *const f64,
        offsets: *const f64,
        tool: *const f64,
    ) -> *mut c_void;
    fn pinocchio_dense(robot: *mut c_void, q: *const f64, pose: *mut f64, columns: *mut f64);
    fn pinocchio_distinct(robot: *mut c_void, q: *const f64, pose: *mut f64, numbers: *mut f64);
    fn pinocchio_displacement(robot: *mut c_void, q: *const f64, e: *const f64, shift: *mut f64);
    fn pinocchio_displacement_by_frames(robot: *mut c_void, q: *const f64, e: *const f64, shift: *mut f64);
    fn pinocchio_covariance(robot: *mut c_void, q: *const f64, variances: *const f64, covariance: *mut f64);
}

/// Returns Pinocchio's rows.
pub fn rows(manipulator: &dyn Manipulator) -> Vec<Row> {
    let robot = robot(manipulator);
    let mut rows = Vec::new();
    // Safety, here and below: the robot has static lifetime, and a row has room for all results.
    type Jacobian = unsafe extern "C" fn(*mut c_void, *const f64, *mut f64, *mut f64);
    let jacobians: [(Kind, Jacobian); 2] =
        [(Kind::Dense, pinocchio_dense), (Kind::Distinct, pinocchio_distinct)];
    for (kind, function) in jacobians {
        rows.push(Row::jacobian("Pinocchio, C++", Side::Library, kind, move |q, pose, result| unsafe {
            function(robot, q.as_ptr(), pose.as_mut_ptr(), result.as_mut_ptr());
        }));
    }
    type Given = unsafe extern "C" fn(*mut c_void, *const f64, *const f64, *mut f64);
    let given: [(&str, Kind, Given); 3] = [
        ("Pinocchio, C++", Kind::Displacement, pinocchio_displacement),
        ("Pinocchio, C++, ΔX without J_e", Kind::Displacement, pinocchio_displacement_by_frames),
        ("Pinocchio, C++", Kind::Covariance, pinocchio_covariance),
    ];
    for (name, kind, function) in given {
        rows.push(Row::given(name, Side::Library, kind, move |q, given, result| unsafe {
            function(robot, q.as_ptr(), given.as_ptr(), result.as_mut_ptr());
        }));
    }
    rows
}

fn robot(manipulator: &dyn Manipulator) -> *mut c_void {
    let description = manipulator.description();
    let n = description.frames.len();
    let (home, moved) = (transforms(manipulator, 0.0), transforms(manipulator, 1.0));
    let (mut kinds, mut signs, mut joints, mut offsets) = (vec![], vec![], vec![], vec![]);
    for (i, variable) in description.variables.iter().enumerate() {
        let joint = match variable.kind {
            VariableKind::Revolute => revolute(&home[i], &moved[i]),
            VariableKind::Prismatic => prismatic(&home[i], &moved[i]),
        };
        kinds.push(joint.kind);
        signs.push(joint.sign);
        joints.extend(joint.placement.0.concat());
        offsets.extend(joint.offset.0.concat());
    }
    let tool = home[n].0.concat();
    // Safety: n entries each, twelve times as many for motions.
    unsafe {
        pinocchio_robot(
            i32::try_from(n).expect("a few frames"),
            kinds.as_ptr(),
            signs.as_ptr(),
            joints.as_ptr(),
            offsets.as_ptr(),
            tool.as_ptr(),
        )
    }
}

/// Returns `A_1 … A_n` and the tool with every variable at `value`.
fn transforms(manipulator: &dyn Manipulator, value: f64) -> Vec<Pose> {
    let description = manipulator.description();
    assert!(description.frames.len() == description.variables.len(), "every frame has its variable");
    let q = vec![value; description.variables.len()];
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    manipulator.transforms(&q, &[], &mut transforms).expect("no parameters, finite values");
    transforms
}

/// Joint: `A = placement · joint(sign · q) · offset`.
struct Joint {
    /// Rotation about x, y, z (0, 1, 2), or translation along it (3, 4, 5).
    kind: i32,
    sign: f64,
    placement: Pose,
    offset: Pose,
}

/// Returns the joint of a translation along an axis of `F_i`, which needs no additional frame.
fn prismatic(home: &Pose, moved: &Pose) -> Joint {
    let along: [f64; 3] = std::array::from_fn(|k| moved.0[3][k] - home.0[3][k]);
    let (axis, sign) = aligned(rotation(&home.inverse()).turn(along)).expect("along an axis of its frame");
    Joint { kind: 3 + axis, sign, placement: *home, offset: Pose::IDENTITY }
}

/// Returns the joint of a rotation. An axis of `F_i` through its origin needs no additional frame;
/// other rotations are about z, as in URDF and Denavit–Hartenberg. `moved` is rotated by 1 rad.
fn revolute(home: &Pose, moved: &Pose) -> Joint {
    let turned = rotation(moved).then(&rotation(&home.inverse()));
    let [x, y, z, _] = turned.0;
    let sine = 1f64.sin();
    let axis = [y[2] - z[1], z[0] - x[2], x[1] - y[0]].map(|twice| twice / (2.0 * sine));
    // (1 − R) c = p' − R p for a point c of the axis; for c ⊥ axis: c = ½ (d + cot(½) axis × d).
    let back = turned.turn(home.position());
    let d: [f64; 3] = std::array::from_fn(|k| moved.0[3][k] - back[k]);
    let across = cross(axis, d);
    let point: [f64; 3] = std::array::from_fn(|k| 0.5 * (d[k] + across[k] / 0.5f64.tan()));
    let inverse = home.inverse();
    let own = rotation(&inverse).turn(axis);
    let distance = cross(own, inverse.apply(point)).iter().fold(0.0f64, |most, v| most.max(v.abs()));
    match aligned(own) {
        Some((axis, sign)) if distance < 1e-12 => {
            Joint { kind: axis, sign, placement: *home, offset: Pose::IDENTITY }
        }
        _ => {
            let (along, sign) = aligned(axis).expect("the joint's axis is one of the frame behind it");
            assert!(along == 2 && sign > 0.0, "about z of the frame behind it");
            let placement = Pose([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], point]);
            Joint { kind: 2, sign, placement, offset: placement.inverse().then(home) }
        }
    }
}

fn rotation(pose: &Pose) -> Pose {
    let [x, y, z, _] = pose.0;
    Pose([x, y, z, [0.0; 3]])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns the coordinate axis along a unit vector, and its sign.
fn aligned(v: [f64; 3]) -> Option<(i32, f64)> {
    (0..3).zip(v).find(|(_, component)| component.abs() > 1.0 - 1e-12).map(|(axis, v)| (axis, v.signum()))
}
