//! Assembly modes and dead points that `check` finds.

use std::f64::consts::{PI, TAU};

use abbe::{Error, Manipulator, VariableKind};
use abbe_codegen::chain::LoopEquations;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::check::{Check, Home, LoopModes, Mode, State};
use abbe_tests::closed_machines::{FOUR_BAR, hexapod};
use abbe_tests::mechanisms::Mechanism;
use abbe_tests::sample_size;

fn parsed(text: &str) -> Spec {
    Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn loops_at_home(spec: &Spec) -> Home {
    let job = Check { machine: Machine::of_spec(spec.clone(), "machine.toml") };
    job.run(&mut ()).unwrap().tree.unwrap().home.unwrap()
}

fn home(spec: &Spec) -> Vec<f64> {
    spec.variables.iter().map(|variable| variable.home).collect()
}

/// Returns the passive variables of a machine.
fn passive(machine: &Interpreter, q: &[f64]) -> Result<Vec<f64>, Error> {
    let mut passive = vec![0.0; machine.spec().passive.len()];
    let s: Vec<f64> = machine.spec().parameters.iter().map(|parameter| parameter.value).collect();
    machine.passive(q, &s, &mut passive).map(|()| passive)
}

/// Returns the spec with a mode as home of the passive joints.
fn chosen(spec: &Spec, mode: &Mode) -> Spec {
    let mut spec = spec.clone();
    for (name, value) in &mode.home.0 {
        let variable = spec.passive.iter_mut().find(|variable| variable.name == *name).unwrap();
        variable.home = *value;
    }
    spec
}

/// Each mode closes, is one of its own, and is chosen by its values.
fn assert_chosen(spec: &Spec, groups: &[LoopModes]) {
    let equations = LoopEquations::new(spec);
    let parameters: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    for group in groups {
        assert!(group.found.iter().filter(|mode| mode.is_chosen).count() == 1 && group.found[0].is_chosen);
        assert!(group.found.iter().map(|mode| mode.starts).sum::<usize>() <= group.starts);
        let mut seen: Vec<Vec<f64>> = Vec::new();
        for mode in &group.found {
            let other = chosen(spec, mode);
            let found = passive(&Interpreter::new(other.clone()), &home(spec)).unwrap();
            for (name, value) in &mode.home.0 {
                let i = spec.passive.iter().position(|variable| variable.name == *name).unwrap();
                assert!((found[i] - value).abs() < 1e-6, "{name}: {} {value}", found[i]);
            }
            for (gap, unit) in
                equations.residual_at(&home(spec), &found, &parameters).iter().zip(&equations.row_units)
            {
                assert!(gap.abs() <= 1e-10 * unit, "{gap}");
            }
            assert!(seen.iter().all(|other| { other.iter().zip(&found).any(|(a, b)| (a - b).abs() > 1e-6) }));
            seen.push(found);
        }
    }
}

/// The other mode of a four-bar linkage is its mirror image in the line from the crank to the pivot
/// of the rocker, all around: the spec with its home moves in it.
#[test]
fn both_modes_of_a_four_bar() {
    let spec = parsed(FOUR_BAR);
    let [group] = &loops_at_home(&spec).modes[..] else { panic!("one group") };
    let [own, other] = &group.found[..] else { panic!("{:?}", group.found) };
    assert!(2 * (own.starts + other.starts) > group.starts, "{group:?}");
    assert_chosen(&spec, std::slice::from_ref(group));
    let [degrees_1, degrees_2] = [0, 1].map(|i| format!("\"{:.6} deg\"", other.home.0[i].1.to_degrees()));
    let text = FOUR_BAR.replace("\"-30 deg\"", &degrees_1).replace("\"80 deg\"", &degrees_2);
    let [own, other] = [FOUR_BAR, &text].map(|text| Interpreter::new(parsed(text)));
    for k in 0..100 {
        let q = (-170.0 + 3.4 * f64::from(k)).to_radians();
        let [a, b] = [&own, &other].map(|machine| passive(machine, &[q]).unwrap()[1]);
        let line = (-40.0 * q.sin()).atan2(100.0 - 40.0 * q.cos());
        let sum = (a + b - 2.0 * line).rem_euclid(TAU);
        assert!(sum.min(TAU - sum) < 1e-9 && (a - b).abs() > 0.1, "{q}: {a}, {b}");
    }
}

/// A platform has many modes; a delta machine two, of which the other has the effector above.
#[test]
fn modes_of_platforms() {
    let spec = parsed(&hexapod(&[[0.0; 7]; 6], ""));
    let groups = loops_at_home(&spec).modes;
    assert!(groups.len() == 1 && groups[0].found.len() > 1, "{groups:?}");
    assert_chosen(&spec, &groups);
    // Half a turn of yaw and roll, with the rest of a half turn of pitch, is the same pose.
    let angles = |mode: &Mode| [3, 4, 5].map(|i| mode.home.0[i].1);
    let place = |mode: &Mode| [0, 1, 2].map(|i| mode.home.0[i].1);
    for (i, a) in groups[0].found.iter().enumerate() {
        for b in &groups[0].found[..i] {
            let near = |a: [f64; 3], b: [f64; 3], turn: f64| {
                a.iter().zip(b).all(|(a, b)| ((a - b) / turn - ((a - b) / turn).round()).abs() < 1e-6)
            };
            let [yaw, pitch, roll] = angles(b);
            let is_same = near(angles(a), [yaw + PI, PI - pitch, roll + PI], TAU);
            assert!(!is_same || !near(place(a), place(b), 1e5), "{a:?} {b:?}");
        }
    }
    let delta = super::mechanism("delta");
    let groups = loops_at_home(delta.spec()).modes;
    assert_chosen(delta.spec(), &groups);
}

/// Loops side by side have modes of their own.
#[test]
fn independent_loops_have_their_own_modes() {
    let frames = FOUR_BAR.split("[tool]").next().unwrap().split_once("[[frame]]").unwrap().1;
    let mut text = "[manipulator]\nname = \"row\"\nlength = \"mm\"\n".to_owned();
    for k in 0..4 {
        let parent = if k == 0 { String::new() } else { format!("parent = \"coupler{}\"\n", k - 1) };
        let mut one = format!("[[frame]]{frames}");
        for name in ["crank", "coupler", "rocker", "knee"] {
            one = one.replace(&format!("\"{name}\""), &format!("\"{name}{k}\""));
        }
        for name in ["q1", "p1", "p2"] {
            one = one.replace(name, &format!("{name}_{k}"));
        }
        one = one.replacen("variable", &format!("{parent}variable"), 1);
        let base = if k == 0 { "base".to_owned() } else { format!("coupler{}", k - 1) };
        text += &one.replace("\"base\"", &format!("\"{base}\""));
    }
    let spec = parsed(&(text + "[tool]\nframe = \"coupler3\"\ntransform = \"Ty(30)\"\n"));
    let groups = loops_at_home(&spec).modes;
    assert_eq!(groups.len(), 4);
    assert!(groups.iter().all(|group| group.loops.len() == 1 && group.found.len() == 2));
    assert_chosen(&spec, &groups);
}

/// Random mechanisms: each mode is chosen by its values. Up to the dead point the joint moves, and
/// not beyond; no other joint has one that is nearer.
#[test]
fn modes_and_dead_points_of_mechanisms() {
    let (mut machines, mut modes, mut dead) = (0, 0, 0);
    for seed in 0.. {
        let mut spec = parsed(&Mechanism::new(seed).text);
        for variable in &mut spec.variables {
            variable.limits = [variable.home - 1.5, variable.home + 1.5];
        }
        let found = loops_at_home(&spec);
        if found.state != State::Closed || found.condition.is_none_or(|condition| condition > 100.0) {
            continue;
        }
        machines += 1;
        modes += found.modes.iter().map(|group| group.found.len()).sum::<usize>();
        assert_chosen(&spec, &found.modes);
        let machine = Interpreter::new(spec.clone());
        let moves = |i: usize, distance: f64| {
            let mut q = home(&spec);
            q[i] += distance;
            passive(&machine, &q).is_ok()
        };
        let unit = LoopEquations::new(&spec).variable_units;
        let mut farthest = f64::INFINITY;
        if let Some(point) = found.dead_point {
            dead += 1;
            let i = spec.variables.iter().position(|variable| variable.name == point.joint).unwrap();
            let way = point.value - spec.variables[i].home;
            assert!((way.abs() - point.distance).abs() < 1e-12 && way.abs() <= 1.5);
            assert!(moves(i, 0.999 * way) && !moves(i, 1.001 * way), "{seed}: {point:?}");
            farthest = point.distance / unit[i];
        }
        for (i, variable) in spec.variables.iter().enumerate() {
            let most = match variable.kind {
                VariableKind::Revolute => 1.5,
                VariableKind::Prismatic => f64::min(1.5, 2.0 * unit[i]),
            };
            let way = most.min(0.999 * farthest * unit[i]);
            assert!(moves(i, way) && moves(i, -way), "{seed}: {} by {way}", variable.name);
        }
        if machines == sample_size(60).max(10) {
            break;
        }
    }
    println!("{machines} mechanisms, {modes} modes, {dead} dead points");
    assert!(modes > 2 * machines && dead > machines / 4, "{machines} {modes} {dead}");
}

/// A crank that cannot turn has its dead points where coupler and rocker are in line.
#[test]
fn dead_points_of_a_four_bar() {
    let links = [
        ("Tx(100) Rz(p2) Tx(80)", "Tx(120) Rz(p2) Tx(90)"),
        ("Tx(40)", "Tx(100)"),
        ("Rz(p1) Tx(120)", "Rz(p1) Tx(40)"),
    ];
    let text = links.iter().fold(FOUR_BAR.to_owned(), |text, (from, to)| text.replace(from, to));
    let found = loops_at_home(&parsed(&text));
    // (120 − 100 cos q)² + (100 sin q)² = (90 + 40)².
    let end = ((24_400.0_f64 - 16_900.0) / 24_000.0).acos();
    let point = found.dead_point.unwrap();
    assert!((point.value - end).abs() < 1e-5 && point.joint == "q1", "{point:?}, {end}");
    assert!((point.distance - (end - 60_f64.to_radians())).abs() < 1e-5);
    let narrow = text.replace("\"170 deg\"", "\"71 deg\"");
    // (90 − 40)² on the other side.
    let end = ((24_400.0_f64 - 2_500.0) / 24_000.0).acos();
    let point = loops_at_home(&parsed(&narrow)).dead_point.unwrap();
    assert!((point.value - end).abs() < 1e-5, "{point:?}, {end}");
    let none = narrow.replace("\"-170 deg\"", "\"30 deg\"");
    assert!(loops_at_home(&parsed(&none)).dead_point.is_none());
}
