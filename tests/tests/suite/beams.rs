//! Beams under loads anywhere, compared with independently integrated curvature: statics at every
//! section, without generated code.

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

type Vector = [f64; 3];

/// Frame: axes by columns, and origin.
#[derive(Clone, Copy)]
struct Frame {
    axes: [Vector; 3],
    origin: Vector,
}

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn scale(k: f64, a: Vector) -> Vector {
    a.map(|v| k * v)
}

fn sub(a: Vector, b: Vector) -> Vector {
    add(a, scale(-1.0, b))
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl Frame {
    const BASE: Self = Self { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin: [0.0; 3] };

    fn direction(&self, v: Vector) -> Vector {
        add(add(scale(v[0], self.axes[0]), scale(v[1], self.axes[1])), scale(v[2], self.axes[2]))
    }

    fn point(&self, p: Vector) -> Vector {
        add(self.origin, self.direction(p))
    }

    fn local(&self, v: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, v))
    }

    fn then(&self, next: &Self) -> Self {
        Self { axes: next.axes.map(|axis| self.direction(axis)), origin: self.point(next.origin) }
    }

    /// Returns `T(p) Rz(angle) Rx(tilt)`.
    fn new(origin: Vector, angle: f64, tilt: f64) -> Self {
        let ((s, c), (t, d)) = (angle.sin_cos(), tilt.sin_cos());
        Self { axes: [[c, s, 0.0], [-s * d, c * d, t], [s * t, -c * t, d]], origin }
    }

    fn text(origin: Vector, angle: f64, tilt: f64) -> String {
        let [x, y, z] = origin;
        format!("Tx({x}) Ty({y}) Tz({z}) Rz({angle}) Rx({tilt})")
    }
}

/// Pseudorandom numbers: Weyl's sequence, mixed.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn vector(&mut self, size: f64) -> Vector {
        [0; 3].map(|_| self.between(-size, size))
    }

    fn chance(&mut self) -> bool {
        self.between(0.0, 1.0) < 0.5
    }
}

/// Force and moment at a point, in `F_0`. `along` is its position on the beam, from the clamp.
#[derive(Clone, Copy)]
struct Acting {
    along: f64,
    point: Vector,
    force: Vector,
    moment: Vector,
}

struct Beam {
    axis: usize,
    length: f64,
    /// Bending stiffness about its own axis, and about the two that follow in cyclic order.
    stiffness: Vector,
    extension: f64,
    mass_per_length: f64,
    end: Frame,
}

/// Gauss–Legendre nodes and weights, five points on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

impl Beam {
    fn text(&self) -> String {
        let [gj, b, c] = self.stiffness;
        let axis = ["x", "y", "z"][self.axis];
        let [first, second] = [["EI_y", "EI_z"], ["EI_z", "EI_x"], ["EI_x", "EI_y"]][self.axis];
        format!(
            "{{ length = {}, axis = {axis:?}, {first} = \"{b} N*m^2\", {second} = \"{c} N*m^2\", GJ = \"{gj} N*m^2\", EA = \"{} N\", mass_per_length = \"{} kg/m\" }}",
            self.length, self.extension, self.mass_per_length
        )
    }

    fn section(&self, x: f64) -> Vector {
        add(self.end.origin, scale(x - self.length, self.end.axes[self.axis]))
    }

    /// Returns the force and moment in the section at x, in the axes of the beam.
    fn section_wrench(&self, x: f64, loads: &[Acting], gravity: Vector) -> [Vector; 2] {
        let at = self.section(x);
        let weight = scale(self.mass_per_length * (self.length - x), gravity);
        let middle = self.section((x + self.length) / 2.0);
        let (mut force, mut moment) = (weight, cross(sub(middle, at), weight));
        for load in loads.iter().filter(|load| load.along > x) {
            force = add(force, load.force);
            moment = add(moment, add(load.moment, cross(sub(load.point, at), load.force)));
        }
        [self.end.local(force), self.end.local(moment)]
    }

    /// Integrates over the beam piece by piece: `sum(x, weight of x, wrench there)`.
    fn integrate(&self, loads: &[Acting], gravity: Vector, mut sum: impl FnMut(f64, f64, [Vector; 2])) {
        let mut ends: Vec<f64> = loads.iter().map(|load| load.along.clamp(0.0, self.length)).collect();
        ends.extend([0.0, self.length]);
        ends.sort_by(f64::total_cmp);
        for piece in ends.windows(2) {
            let [from, to] = piece else { continue };
            for (share, weight) in GAUSS {
                let x = from + share * (to - from);
                sum(x, weight * (to - from), self.section_wrench(x, loads, gravity));
            }
        }
    }

    /// Returns the strain and the curvatures of a section, in the axes of the beam.
    fn strain(&self, [force, moment]: [Vector; 2]) -> (Vector, Vector) {
        let (a, b, c) = (self.axis, (self.axis + 1) % 3, (self.axis + 2) % 3);
        let (mut stretch, mut curvature) = ([0.0; 3], [0.0; 3]);
        stretch[a] = force[a] / self.extension;
        for (axis, stiffness) in [a, b, c].into_iter().zip(self.stiffness) {
            curvature[axis] = moment[axis] / stiffness;
        }
        (stretch, curvature)
    }

    /// Returns the displacement and rotation of the end, in its axes.
    fn end_displacement(&self, loads: &[Acting], gravity: Vector) -> [Vector; 2] {
        let [mut shift, mut turn] = [[0.0; 3]; 2];
        self.integrate(loads, gravity, |x, weight, wrench| {
            let (stretch, curvature) = self.strain(wrench);
            let mut rest = [0.0; 3];
            rest[self.axis] = self.length - x;
            shift = add(shift, scale(weight, add(stretch, cross(curvature, rest))));
            turn = add(turn, scale(weight, curvature));
        });
        [shift, turn]
    }

    /// Returns twice the stored energy.
    fn twice_the_energy(&self, loads: &[Acting], gravity: Vector) -> f64 {
        let mut energy = 0.0;
        self.integrate(loads, gravity, |_, weight, wrench| {
            let (stretch, curvature) = self.strain(wrench);
            energy += weight * (dot(stretch, wrench[0]) + dot(curvature, wrench[1]));
        });
        energy
    }
}

fn random_beam(random: &mut Random, heavy: bool) -> Beam {
    Beam {
        axis: (random.between(0.0, 3.0)) as usize,
        length: random.between(0.1, 3.0),
        stiffness: [0; 3].map(|_| random.between(100.0, 5000.0)),
        extension: random.between(1e5, 1e7),
        mass_per_length: if heavy { random.between(0.0, 20.0) } else { 0.0 },
        end: Frame::BASE,
    }
}

fn errors(text: &str) -> (Vec<[f64; 6]>, Interpreter) {
    let spec = Spec::parse("beams.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut errors = vec![[0.0; 6]; spec.frames.len()];
    let robot = Interpreter::new(spec);
    let s: Vec<f64> = robot.description().parameters.iter().map(|parameter| parameter.nominal).collect();
    robot.generalized_errors(&[], &s, &[], &mut errors).unwrap();
    (errors, robot)
}

/// Converts errors from the order of ε to displacement and rotation about x, y, z.
fn vectors([x, y, z, spin, roll, pitch]: [f64; 6]) -> [Vector; 2] {
    [[x, y, z], [pitch, spin, roll]]
}

fn close(found: [Vector; 2], expected: [Vector; 2], what: &str) {
    for (found, expected) in found.iter().zip(expected) {
        // Metres carry rounding errors of 1e-15.
        let size = expected.iter().fold(1e-5_f64, |size, v| size.max(v.abs()));
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() <= 1e-10 * size, "{what}: {found:?}, expected {expected:?}");
        }
    }
}

fn list(v: Vector, unit: &str) -> String {
    format!("[\"{} {unit}\", \"{} {unit}\", \"{} {unit}\"]", v[0], v[1], v[2])
}

#[test]
fn a_thousand_random_beams_bend_as_their_curvature_says() {
    let mut random = Random(1);
    for case in 0..1000 {
        let mut beam = random_beam(&mut random, case % 3 != 0);
        let (origin, angle, tilt) =
            (random.vector(2.0), random.between(-3.0, 3.0), random.between(-3.0, 3.0));
        let frame = Frame::new(origin, angle, tilt);
        let text = Frame::text(origin, angle, tilt);
        let (at, place) = if case % 2 == 0 {
            (String::new(), Frame::BASE)
        } else {
            let (origin, angle, tilt) =
                (random.vector(0.5), random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            (format!("at = \"{}\"\n", Frame::text(origin, angle, tilt)), Frame::new(origin, angle, tilt))
        };
        beam.end = frame.then(&place);
        let gravity = random.vector(10.0);
        let mut spec = format!(
            "[manipulator]\nname = \"b\"\nlength = \"m\"\ngravity = {}\n[[frame]]\nname = \"arm\"\ntransform = \"{text}\"\n[[frame]]\nname = \"hand\"\ntransform = \"Tx(0.2) Rz(0.4)\"\n[[source]]\nname = \"arm\"\nclass = \"repeatable\"\nframe = \"arm\"\n{at}beam = {}\n",
            list(gravity, "m/s^2"),
            beam.text()
        );
        let hand = frame.then(&Frame::new([0.2, 0.0, 0.0], 0.4, 0.0));
        let mut loads = Vec::new();
        for load in 0..1 + case % 4 {
            // Before the clamp, within the span, or beyond the end. The last load acts on the next
            // frame, wherever that is.
            let on_hand = load == 3;
            let on = if on_hand { &hand } else { &frame };
            let mut point = random.vector(1.5);
            if !on_hand {
                let mut on_beam = random.vector(0.3);
                on_beam[beam.axis] = random.between(-1.3 * beam.length, 0.4 * beam.length);
                point = place.point(on_beam);
            }
            spec += &format!(
                "[[load]]\nframe = \"{}\"\npoint = [{}, {}, {}]\n",
                if on_hand { "hand" } else { "arm" },
                point[0],
                point[1],
                point[2]
            );
            let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
            if random.chance() {
                let mass = random.between(0.0, 30.0);
                spec += &format!("mass = \"{mass} kg\"\n");
                force = scale(mass, gravity);
            }
            if random.chance() || force == [0.0; 3] {
                let (pull, turn) = (random.vector(100.0), random.vector(50.0));
                spec += &format!("force = {}\nmoment = {}\n", list(pull, "N"), list(turn, "N*m"));
                let in_base = random.chance();
                if in_base {
                    spec += "axes = \"base\"\n";
                }
                let turned = |v| if in_base { v } else { on.direction(v) };
                force = add(force, turned(pull));
                moment = turned(turn);
            }
            let point = on.point(point);
            let along = dot(sub(point, beam.end.origin), beam.end.axes[beam.axis]) + beam.length;
            loads.push(Acting { along: if on_hand { f64::INFINITY } else { along }, point, force, moment });
        }
        if case % 5 == 0 {
            // The position of the load is known only at run time.
            let length = format!("length = {}", beam.length);
            spec = spec.replacen(&length, "length = \"reach\"", 1);
            spec += &format!("[parameters]\nreach = \"{} m\"\n", beam.length);
        }
        let (errors, _) = errors(&spec);
        let [shift, turn] = beam.end_displacement(&loads, gravity);
        // Convert to the frame itself: a rigid body.
        let turn = place.direction(turn);
        let shift = add(place.direction(shift), cross(place.origin, turn));
        close(vectors(errors[0]), [shift, turn], &format!("case {case}\n{spec}"));
    }
}

/// Checks a chain of three heavy beams and a bearing with one load at the tool point: `F · ΔX = 2U`
/// without weights. With weights every beam and the bearing carry the weight beyond them.
#[test]
fn work_of_a_load_is_twice_the_energy_of_all_beams() {
    let mut random = Random(2);
    for case in 0..100 {
        let heavy = case % 2 == 1;
        let gravity = if heavy { random.vector(10.0) } else { [0.0; 3] };
        let mut at = Frame::BASE;
        let mut beams = Vec::new();
        let mut text = format!(
            "[manipulator]\nname = \"b\"\nlength = \"m\"\ngravity = {}\n[tool]\ntransform = \"Tx(0.3) Ty(-0.1) Tz(0.2)\"\n",
            list(gravity, "m/s^2")
        );
        for i in 0..3 {
            let (origin, angle, tilt) =
                (random.vector(1.0), random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            at = at.then(&Frame::new(origin, angle, tilt));
            let mut beam = random_beam(&mut random, heavy);
            beam.end = at;
            text += &format!(
                "[[frame]]\nname = \"{i}\"\ntransform = \"{}\"\n[[source]]\nname = \"{i}\"\nclass = \"repeatable\"\nframe = \"{i}\"\nbeam = {}\n",
                Frame::text(origin, angle, tilt),
                beam.text()
            );
            beams.push(beam);
        }
        let (force, moment) = (random.vector(100.0), random.vector(30.0));
        text += &format!(
            "[[load]]\nframe = \"2\"\npoint = \"tool\"\naxes = \"base\"\nforce = {}\nmoment = {}\n",
            list(force, "N"),
            list(moment, "N*m")
        );
        let tool = at.point([0.3, -0.1, 0.2]);
        let (errors, robot) = errors(&text);
        let mut energy = 0.0;
        for (i, beam) in beams.iter().enumerate() {
            let mut loads = vec![Acting { along: f64::INFINITY, point: tool, force, moment }];
            // A load on the beam's own frame acts at its projection onto the beam.
            if i == 2 {
                loads[0].along = dot(sub(tool, at.origin), at.axes[beam.axis]) + beam.length;
            }
            // The weight beyond it in small pieces.
            for later in &beams[i + 1..] {
                let pieces = 2;
                for piece in 0..pieces {
                    let x = later.length * (f64::from(piece) + 0.5) / f64::from(pieces);
                    let force = scale(later.mass_per_length * later.length / f64::from(pieces), gravity);
                    let point = later.section(x);
                    loads.push(Acting { along: f64::INFINITY, point, force, moment: [0.0; 3] });
                }
            }
            close(vectors(errors[i]), beam.end_displacement(&loads, gravity), &format!("beam {i}\n{text}"));
            energy += beam.twice_the_energy(&loads, gravity);
        }
        // The tool point must be beyond the end of the last beam, where its displacement is that of
        // the load.
        let beyond = dot(sub(tool, at.origin), at.axes[beams[2].axis]) >= 0.0;
        if !heavy && beyond {
            let mut columns = vec![[0.0; 6]; 18];
            robot.error_jacobian(&[], &[], &mut columns).unwrap();
            let mut work = 0.0;
            for (column, error) in columns.iter().zip(errors.as_flattened()) {
                let [shift, turn] = [[column[0], column[1], column[2]], [column[3], column[4], column[5]]];
                work += error * (dot(shift, force) + dot(turn, moment));
            }
            assert!((work - energy).abs() <= 1e-10 * energy, "{work} {energy}");
        }
    }
}

const CANTILEVER: &str = r#"
[manipulator]
name = "cantilever"
length = "m"
gravity = [0, 0, "-10 m/s^2"]
[[frame]]
name = "arm"
transform = "Tx(1)"
"#;

fn tip(rest: &str) -> [f64; 6] {
    errors(&format!("{CANTILEVER}{rest}")).0[0]
}

fn is(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found}, expected {expected}");
}

/// Checks handbook values: F = 60 N, L = 1 m, EI = 1000 N m².
#[test]
fn a_load_in_the_middle_and_a_beams_own_weight() {
    let beam = "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"arm\"\n";
    let bare = format!("{beam}beam = {{ length = 1, EI_y = \"1000 N*m^2\", EI_z = \"1000 N*m^2\" }}\n");
    let middle = tip(&format!("{bare}[[load]]\nmass = \"6 kg\"\nframe = \"arm\"\npoint = [-0.5, 0, 0]\n"));
    is(middle[2], -5.0 * 60.0 / (48.0 * 1000.0));
    is(middle[3], 60.0 / (8.0 * 1000.0));
    let heavy = tip(&format!(
        "{beam}beam = {{ length = 1, EI_y = \"1000 N*m^2\", EI_z = \"1000 N*m^2\", mass_per_length = \"6 kg/m\" }}\n"
    ));
    is(heavy[2], -60.0 / (8.0 * 1000.0));
    is(heavy[3], 60.0 / (6.0 * 1000.0));
    let moment = tip(&format!("{bare}[[load]]\nmoment = [0, \"60 N*m\", 0]\nframe = \"arm\"\n"));
    is(moment[2], -60.0 / (2.0 * 1000.0));
    is(moment[3], 60.0 / 1000.0);
    // Behind the clamp nothing bends.
    let behind = tip(&format!("{bare}[[load]]\nmass = \"6 kg\"\nframe = \"arm\"\npoint = [-1.5, 0, 0]\n"));
    assert_eq!(behind, [0.0; 6]);
}

/// Checks that a bearing carries the part of a beam's weight beyond it: none at the end, half in
/// the middle, all at the foot.
#[test]
fn a_bearing_carries_the_weight_beyond_it() {
    let beam = "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"arm\"\nenabled = true\nbeam = { length = 1, EI_y = \"1e30 N*m^2\", EI_z = \"1e30 N*m^2\", mass_per_length = \"6 kg/m\" }\n";
    for (at, expected) in [(0.0, 0.0), (-0.5, 30.0), (-1.0, 60.0), (-1.4, 60.0), (0.3, 0.0)] {
        let bearing = format!(
            "[[source]]\nname = \"bearing\"\nclass = \"repeatable\"\nframe = \"arm\"\nat = \"Tx({at})\"\ncompliance = {{ diagonal = [0, 0, \"1e-3 m/N\", 0, 0, 0] }}\n"
        );
        let found = tip(&format!("{beam}{bearing}"));
        assert!((found[2] + 1e-3 * expected).abs() < 1e-15, "{at}: {found:?}");
    }
}
