//! Boxes of points: each in every orientation, at every value of the joints that are held.

use abbe_spec::document::Document;
use abbe_study::Machine;
use abbe_study::study_file::Study;

#[test]
fn each_point_is_reached_in_each_orientation_at_each_approach() {
    let machine = Machine::find("puma560").unwrap();
    let text = "[study]\ntitle = \"t\"\n[workspace.box]\nx = [0.4, 0.5]\ny = [0.1]\nz = [0.1, -0.1]\n\
                orientation = [\"down\", \"home\", \"free\", { x = [8, 6, 0], y = [0.6, -0.8, 0] }, \
                { quaternion = [0, 2, 0, 0] }, { x = [0.6, 0, 0.8] }]\n";
    let held = format!(
        "{text}solve = [\"q1\", \"q2\", \"q3\", \"q4\", \"q5\"]\napproaches = {{ q6 = [0.5, -0.3] }}\n"
    );
    for (text, approaches) in [(text, &[f64::NAN][..]), (&held, &[0.5, -0.3])] {
        let study = Study::read(Document::new("study.toml", text), &machine.spec).unwrap();
        let manipulator = machine.evaluator(true);
        let workspace = study.region.workspace(&*manipulator, None).unwrap();
        assert_eq!(workspace.len(), 4 * 6 * approaches.len());
        let home = manipulator.pose(&workspace.home().q, &workspace.home().s).unwrap();
        let mut reached = [0; 6];
        for index in 0..workspace.len() {
            let (turned, point) = (index / approaches.len() % 6, index / approaches.len() / 6);
            let expected = [[0.4, 0.5][point / 2], 0.1, [0.1, -0.1][point % 2]];
            assert_eq!(workspace.point(index), Some(expected));
            let Ok(found) = workspace.configuration(index) else { continue };
            reached[turned] += 1;
            let approach = approaches[index % approaches.len()];
            assert!(approach.is_nan() || found.q[5] == approach);
            let pose = manipulator.pose(&found.q, &found.s).unwrap();
            let is_near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
            let [x, y, z, position] = pose.0;
            assert!(is_near(position, expected));
            assert!(match turned {
                0 => is_near(z, [0.0, 0.0, -1.0]),
                1 => is_near(x, home.0[0]) && is_near(y, home.0[1]),
                2 => true,
                3 => is_near(x, [0.8, 0.6, 0.0]) && is_near(y, [0.6, -0.8, 0.0]),
                4 => is_near(x, [1.0, 0.0, 0.0]) && is_near(y, [0.0, -1.0, 0.0]),
                _ => is_near(x, [0.6, 0.0, 0.8]),
            });
        }
        // Where one joint is held, an axis can still be turned down, but a whole rotation cannot.
        let all = 4 * approaches.len();
        let whole = if approaches.len() == 1 { 4 } else { 0 };
        assert_eq!([reached[0], reached[2]], [all; 2]);
        assert!(reached[1] > 0 || approaches.len() == 2);
        assert!(reached[5] >= 4);
        assert_eq!([reached[3], reached[4]], [whole; 2]);
        let described = study.region.describe(&machine.spec);
        assert!(described.contains("each reached in 6 orientations"), "{described}");
        assert_eq!(described.contains("at each of 2 q6"), approaches.len() == 2, "{described}");
    }
}
