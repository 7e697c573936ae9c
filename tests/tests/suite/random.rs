//! Random sources of every kind: first order compared with a million draws on the exact chain.

use abbe::Manipulator;
use abbe::analysis::sampling::{halton, norm};
use abbe::analysis::{
    BudgetOptions, Configuration, Measurand, MonteCarlo, Row, error_budget, joint_samples, listed,
    monte_carlo, worst_case,
};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::chains::random_arm;

/// Returns an arm of two joints with the sources at its end.
fn arm(sources: &str) -> Spec {
    let text = r#"
        [manipulator]
        name = "arm"
        length = "mm"
        [[frame]]
        name = "shoulder"
        variable = { name = "q1", kind = "revolute", limits = ["-90 deg", "90 deg"] }
        transform = "Rz(q1)"
        [[frame]]
        name = "elbow"
        variable = { name = "q2", kind = "revolute", limits = ["0 deg", "120 deg"], home = "40 deg" }
        transform = "Tx(400) Rz(q2)"
        [tool]
        transform = "Tx(300)"
    "#;
    Spec::parse("arm.toml", &format!("{text}\n{sources}")).unwrap()
}

fn draws(spec: &Spec, count: usize) -> MonteCarlo {
    let robot = Interpreter::new(spec.clone());
    let configuration = Configuration::home(robot.description());
    monte_carlo(&robot, &configuration, count, 11).unwrap()
}

/// Checks that every entry of the covariance is within three standard errors of first order, plus
/// `slack`.
fn agrees(drawn: &MonteCarlo, slack: f64) {
    for i in 0..3 {
        for j in 0..3 {
            let difference = drawn.covariance[i][j] - drawn.first_order[i][j];
            let bound = 3.0 * drawn.standard_error[i][j] + slack;
            assert!(difference.abs() <= bound, "{i} {j}: {difference:e}, at most {bound:e}");
        }
    }
}

/// Returns the kinds of sources of random errors with one magnitude: a single one, and with effects
/// at several frames.
fn sources(distribution: &str) -> String {
    format!(
        r#"
        [[source]]
        name = "sag"
        class = "repeatable"
        frame = "elbow"
        e_z = "-0.2 mm*cos(q1)"
        [[source]]
        name = "shoulder bearing"
        class = "random"
        distribution = "{distribution}"
        frame = "shoulder"
        e_r = "30e-6"
        e_z = "0.01 mm"
        [[source]]
        name = "elbow encoder"
        class = "random"
        distribution = "{distribution}"
        frame = "elbow"
        e_r = "40e-6"
        [[source]]
        name = "room temperature"
        class = "random"
        distribution = "{distribution}"
        [[source.effect]]
        frame = "shoulder"
        e_x = "0.008 mm"
        e_p = "10e-6"
        [[source.effect]]
        frame = "elbow"
        e_x = "0.006 mm"
        e_s = "20e-6"
        "#
    )
}

#[test]
fn normal_sources_fill_their_ellipsoid() {
    let drawn = draws(&arm(&sources("normal")), 1_000_000);
    agrees(&drawn, 0.0);
    let inside = drawn.inside_ellipsoid.unwrap();
    println!("{:.3} % inside the 95 % ellipsoid", 100.0 * inside);
    assert!((inside - 0.95).abs() < 0.003, "{inside}");
    // The sag is a constant bias.
    assert!((drawn.mean[2] + 0.2).abs() < 1e-4 && drawn.quantiles[0].value > 0.2);
    assert!(drawn.quantiles.windows(2).all(|pair| pair[0].value < pair[1].value));
    assert!(drawn.quantiles.iter().all(|quantile| (0.0..1e-4).contains(&quantile.standard_error)));
}

#[test]
fn uniform_sources_stay_within_more_of_it() {
    let drawn = draws(&arm(&sources("uniform")), 1_000_000);
    agrees(&drawn, 0.0);
    assert!(drawn.inside_ellipsoid.unwrap() > 0.953);
}

#[test]
fn sources_that_share_a_magnitude_do_not_add_as_squares() {
    let both =
        "frame = \"shoulder\"\ne_z = \"0.01 mm\"\n[[source.effect]]\nframe = \"elbow\"\ne_z = \"0.01 mm\"";
    let (first, second) = both.split_once("\n[[source.effect]]\n").unwrap();
    let head = |name: &str| {
        format!("[[source]]\nname = \"{name}\"\nclass = \"random\"\ndistribution = \"normal\"\n")
    };
    let effect = "[[source.effect]]\n";
    let shared = format!("{}{effect}{first}\n{effect}{second}\n", head("shared"));
    let apart = format!("{}{first}\n{}{second}\n", head("one"), head("two"));
    let shared = draws(&arm(&shared), 1000).first_order[2][2];
    let apart = draws(&arm(&apart), 1000).first_order[2][2];
    assert!((shared / apart - 2.0).abs() < 1e-12);
}

#[test]
fn zero_and_one_sided_sources_have_clear_results() {
    let spec = arm(r#"
        [[source]]
        name = "nothing"
        class = "random"
        distribution = "normal"
        frame = "elbow"
        e_x = 0
        [[source]]
        name = "one-sided"
        class = "repeatable"
        frame = "elbow"
        e_z = "0.1 mm*abs(sin(q1))"
    "#);
    let robot = Interpreter::new(spec.clone());
    let workspace = joint_samples(&robot, &[0, 1], 500).unwrap();
    let budget = error_budget(&robot, &workspace, BudgetOptions::default(), &mut ()).unwrap();
    let [nothing, one_sided] = &budget.sources[..] else { panic!("two sources") };
    assert_eq!((nothing.plain_max.norm, nothing.rms), (0.0, 0.0));
    // The error is never negative, so half its range is half its maximum.
    assert!((one_sided.half_peak_to_peak.z / one_sided.plain_max.z - 0.5).abs() < 0.01);
    assert_eq!(budget.combined.ellipsoid.configuration, None);
    let drawn = draws(&spec, 100);
    assert_eq!(drawn.inside_ellipsoid, None);
    assert_eq!((drawn.covariance, drawn.first_order), ([[0.0; 3]; 3], [[0.0; 3]; 3]));
}

/// The worst case of a sweep is the largest over all signs and configurations, found by trying them
/// all: for sources of every class, some in one direction, and for more than are tried in pairs.
#[test]
fn the_worst_case_of_a_sweep_is_the_largest_over_all_signs() {
    for count in [1, 2, 3, 5, 9, 40] {
        let number = |i: usize, k: usize| halton(10 * count + i, k) - 0.5;
        let source = |i: usize| {
            let class = ["repeatable", "tolerance", "random"][if i == 0 { 0 } else { 1 + i % 2 }];
            let distribution = if i == 0 { "" } else { "distribution = \"uniform\"" };
            let frame = ["shoulder", "elbow"][i % 2];
            // Every third one acts along x alone.
            let other = if i.is_multiple_of(3) { 0.0 } else { number(i, 1) };
            format!(
                "[[source]]\nname = \"s{i}\"\nclass = \"{class}\"\n{distribution}\nframe = \"{frame}\"\n\
                 e_x = \"{} mm\"\ne_z = \"{other} mm\"\ne_r = \"{} mrad\"\n",
                number(i, 0).abs(),
                other * number(i, 2)
            )
        };
        let robot = Interpreter::new(arm(&(0..=count).map(source).collect::<String>()));
        let workspace = joint_samples(&robot, &[0, 1], 200).unwrap();
        let mut largest = 0.0_f64;
        let mut rows = |row: &Row| {
            let rows: Vec<[f64; 3]> =
                row.sources.iter().map(|source| [source[0], source[1], source[2]]).collect();
            let mut sums = vec![rows[0]];
            if count > 12 {
                sums = vec![worst_case(rows[0], &rows[1..])];
            } else {
                for error in &rows[1..] {
                    let plus = |sum: &[f64; 3], sign: f64| core::array::from_fn(|i| sum[i] + sign * error[i]);
                    sums = sums.iter().flat_map(|sum| [plus(sum, 1.0), plus(sum, -1.0)]).collect();
                }
            }
            largest = sums.iter().map(|sum| norm(*sum)).fold(largest, f64::max);
        };
        let budget = error_budget(&robot, &workspace, BudgetOptions::default(), &mut rows).unwrap();
        let found = budget.combined.worst_case_radius.value;
        assert!((found / largest - 1.0).abs() < 1e-8, "{count}: {found}, not {largest}");
    }
}

/// A turn of the whole machine about the base changes no norm of an error: of the configurations
/// that differ by it, the first is named as the worst, whatever their roundings are.
#[test]
fn of_equally_bad_configurations_the_first_is_named() {
    const TURNS: [f64; 7] = [0.0, 0.1, 0.7, -1.3, 2.0, -2.9, 1e-3];
    const COUNT: usize = 60;
    for index in 0..60 {
        let arm = random_arm(index);
        let frames = arm.matches("[[frame]]").count();
        let turntable = "[[frame]]\nname = \"turntable\"\n\
                         variable = { name = \"turn\", kind = \"revolute\", limits = [-3, 3] }\n\
                         transform = \"Rz(turn)\"\n";
        let mut text = arm.replacen("[[frame]]", &format!("{turntable}[[frame]]"), 1);
        for (n, class) in ["repeatable", "tolerance", "random", "random"].into_iter().enumerate() {
            let kind = ["", "", "distribution = \"uniform\"\n", "distribution = \"normal\"\n"][n];
            let frame = 1 + (n * 5 + index as usize) % frames;
            text += &format!(
                "[[source]]\nname = \"{n}\"\nclass = \"{class}\"\n{kind}frame = \"frame {frame}\"\n\
                 e_x = \"{} mm\"\ne_s = \"0.{n}3 mrad\"\ne_p = \"0.2 mrad\"\ne_z = \"0.07 mm\"\n",
                n + 1
            );
        }
        let robot = Interpreter::new(Spec::parse(&format!("arm {index}"), &text).unwrap());
        let home = Configuration::home(robot.description());
        let configurations = TURNS.iter().flat_map(|turn| (0..COUNT).map(move |n| (turn, n)));
        let configurations = configurations.map(|(turn, n)| {
            let joint = |i: usize| if i == 0 { *turn } else { 4.0 * halton(1 + n, i - 1) - 2.0 };
            Configuration { q: (0..home.q.len()).map(joint).collect(), ..home.clone() }
        });
        let workspace = listed(&robot, configurations.collect()).unwrap();
        let options = BudgetOptions { tolerances: [Some(5e-3), Some(1e-3)] };
        let budget = error_budget(&robot, &workspace, options, &mut ()).unwrap();
        assert_eq!(budget.configurations, TURNS.len() * COUNT, "{index}");
        for (measurand, likely) in
            [Measurand::Position, Measurand::Orientation].into_iter().zip(&budget.least_likely)
        {
            let (sources, combined) = budget.errors(measurand);
            let worst = sources.iter().filter_map(|source| source.worst).chain(combined.indices());
            let worst: Vec<usize> = worst.chain(likely.first().copied()).collect();
            assert!(worst.iter().all(|index| *index < COUNT), "{index}, {measurand:?}: {worst:?}");
        }
    }
}

/// An error that is too large to be compared with others is not 0.
#[test]
fn absurd_errors_are_not_lost() {
    let spec = arm(
        "[[source]]\nname = \"absurd\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_x = \"1e76 mm * (2 + cos(q1)) * 1e76\"\n",
    );
    let robot = Interpreter::new(spec);
    let workspace = joint_samples(&robot, &[0, 1], 500).unwrap();
    let budget = error_budget(&robot, &workspace, BudgetOptions::default(), &mut ()).unwrap();
    for largest in [budget.sources[0].plain_max.norm, budget.combined.radius.value] {
        assert!((2e152..=3.1e152).contains(&largest), "{largest}");
    }
}
