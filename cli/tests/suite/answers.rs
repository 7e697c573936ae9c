//! The first screen of each command: at most 25 lines of 100 columns, the answer first.

use abbe::analysis::student_factor;
use abbe_manipulators::SHIPPED;
use serde_json::Value;

use super::analyses::{Analysis, analysis};
use super::running::{abbe, json, narrow, prints, write};
use super::workshop::Workshop;

fn is_one_screen(text: &str, command: &str) {
    narrow(text);
    assert!(text.lines().count() <= 25, "{command}: {} lines\n{text}", text.lines().count());
}

#[test]
fn shipped_manipulators_fit_one_screen() {
    for name in SHIPPED.iter().map(|shipped| shipped.name) {
        for (command, text) in [("analyze", &analysis(name).screen), ("check", &prints(&["check", name]))] {
            is_one_screen(text, &format!("{command} {name}"));
            assert!(text.lines().any(|line| line.starts_with("Next      ")), "{text}");
        }
    }
}

#[test]
fn every_command_fits_one_screen() {
    let workshop = Workshop::new();
    for line in [
        "check s.toml",
        "analyze s.toml --study study.toml",
        "bound s.toml --study study.toml",
        "plan s.toml --map m.toml --optimal 20 --candidates 40 --study study.toml",
        "plan ur5 --map ur5 --optimal 60 --candidates 120",
        "measure s.toml d.csv --map m.toml",
        "identify s.toml d.csv --map m.toml --test t.csv",
        "compensate s.toml d.csv --map m.toml",
        "monitor s.toml d.csv t.csv --map m.toml",
        "doctor s.toml d.csv",
        "export s.toml --to table -o t.table.csv",
        "merge a.part",
    ] {
        let words = workshop.words(line);
        let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
        let run = abbe(&words);
        assert!(run.status < 2, "{line}: {}", run.stderr);
        is_one_screen(&run.stdout, line);
        let found: Value = serde_json::from_str(&abbe(&[&words[..], &["--json"]].concat()).stdout).unwrap();
        let answer = found["statements"]["answer"].as_str().unwrap();
        let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(one_line(&run.stdout).contains(&one_line(answer)), "{line}: {answer}\n{}", run.stdout);
        let all = abbe(&[&words[..], &["--full"]].concat());
        assert!(all.stdout.lines().count() >= run.stdout.lines().count() - 2, "{line}\n{}", all.stdout);
    }
}

/// The paper's own robot: verdict, figures, sources, worst configuration and the published figures.
#[test]
fn the_answer_for_the_papers_robot() {
    let text = prints(&["analyze", "pps"]);
    let mut lines = text.lines();
    let expected =
        "NPTC patient positioning system: NOT MET as built by rss, tolerance 0.5 mm at 999 configurations";
    assert_eq!(lines.next(), Some(expected));
    let beginnings = [
        "  as built        5.480 mm   1096 %   P(within) < 0.002 %",
        "  compensated     0.349 mm     70 %",
        "  random only     0.099 mm     20 %",
        "  assembly               5.330    94 %     × 0.064",
        "  arm deflection         0.519     7 %      × 0.21",
        "  all, as built          5.480             × 0.091",
        "Worst     at d1 = 8.8331 mm, d2 = 80 mm, d3 = 986.701 mm, q4 = 70°",
        "Published 4 of 5 figures of the paper reproduced; spin encoder",
    ];
    for beginning in beginnings {
        assert!(lines.any(|line| line.starts_with(beginning)), "{beginning}\n{text}");
    }
}

/// A machine with many joints, and a path with a space.
#[test]
fn forty_joints_fit_one_screen() {
    let folder = tempfile::tempdir().unwrap();
    let source = "[[source]]\nname = \"encoder\"\nclass = \"random\"\ndistribution = \"normal\"\njoint = \"q1\"\nerror = \"1e-5\"\n";
    let spec = write(folder.path(), "my arm.toml", &(abbe_tests::chains::revolute_chain(30) + source));
    let spec = spec.to_str().unwrap();
    for command in [&["analyze", spec][..], &["check", spec], &["bound", spec, "--boxes", "100"]] {
        is_one_screen(&prints(command), command[0]);
    }
    assert!(prints(&["analyze", spec]).contains(" and 18 more\n"));
    assert!(prints(&["check", spec]).replace('\n', " ").contains("my arm.toml\";"));
}

/// The sampled difference between first order and the exact chain is rounded up.
#[test]
fn the_difference_from_the_exact_chain_is_not_rounded_down() {
    for name in ["pps", "machine3", "panda"] {
        let Analysis { screen, report, .. } = analysis(name);
        let text = screen.split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, line) = text.split_once("differs by up to ").expect("a sentence");
        let shown: f64 = line.split(' ').next().unwrap().parse().unwrap();
        let metres = if report["length"] == "m" { 1e3 } else { 1.0 };
        let largest = metres * report["first_order"]["largest_difference"].as_f64().unwrap();
        assert!(shown >= largest && shown <= 1.1 * largest, "{name}: {shown} {largest}");
        assert!(
            line.contains(&format!("at {} configurations", report["first_order"]["configurations"])),
            "{line}"
        );
    }
}

/// Only errors that differ from zero with 95 % confidence for all of them together are listed, and
/// the others are counted.
#[test]
fn only_significant_errors_are_listed() {
    let workshop = Workshop::new();
    let words = workshop.words("identify s.toml d.csv --map m.toml");
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    let (text, report) = (prints(&words), json(&[&words[..], &["--json"]].concat()));
    let number = |one: &serde_json::Value, key: &str| one[key].as_f64().unwrap();
    let machine = report["parameters"].as_array().unwrap().iter().filter(|one| one["kind"] == "machine");
    let count = machine.clone().count();
    let one = 1.0 - 0.05 / count as f64;
    let factor = student_factor(one, number(&report["certainty"], "freedom"));
    assert!(factor > number(&report["certainty"], "factor_95"));
    let (significant, others): (Vec<_>, Vec<_>) =
        machine.partition(|one| number(one, "value").abs() > factor * number(one, "standard_deviation"));
    let lists = |one: &serde_json::Value| {
        let name = format!("  {} ", one["name"].as_str().unwrap());
        text.lines().any(|line| line.starts_with(&name))
    };
    assert!(!others.is_empty() && !others.iter().any(|one| lists(one)), "{text}");
    assert_eq!(significant.iter().filter(|one| lists(one)).count(), significant.len().min(5), "{text}");
    let expected = match significant.len() {
        0 => format!("None of the {count} errors of the machine differs from zero with 95 % confidence."),
        _ => format!("{} not significant", others.len()),
    };
    assert!(text.contains(&expected), "{expected}\n{text}");
}
