//! Reports on terminals: every sign in a text has one in ASCII, and answers fit 80 columns.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use abbe_report::text::{Detail, at_width};
use abbe_report::{budget, plain, views};
use abbe_study::analyze::Analyze;
use abbe_study::check::Check;
use abbe_study::{Machine, Study};

use super::voice::sources;

#[test]
fn signs_of_all_words_are_known() {
    let mut unknown: BTreeMap<char, String> = BTreeMap::new();
    for folder in ["study/src", "metrology/src", "report/src/views", "report/src/text"] {
        let mut files = Vec::new();
        sources(&Path::new("..").join(folder), &mut files);
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            // Letters are of names, but for those of Greek.
            let is_sign = |sign: char| !sign.is_alphabetic() || ('\u{370}'..'\u{400}').contains(&sign);
            let is_unknown = |sign: &char| is_sign(*sign) && *sign != '?' && plain(&sign.to_string()) == "?";
            for sign in code.flat_map(str::chars).filter(is_unknown) {
                unknown.insert(sign, file.display().to_string());
            }
        }
    }
    assert!(unknown.is_empty(), "{unknown:?}");
}

#[test]
fn plain_reports_are_ascii() {
    let machine = Machine::find("pps").unwrap();
    let checked = Check { machine: machine.clone() }.run(&mut ()).unwrap();
    let study = Study::find(None, &machine).unwrap();
    let analyzed = Analyze::new(machine, study).run(&mut ()).unwrap();
    for document in [views::check(&checked), budget(&analyzed)] {
        let usual = document.text(Detail::Full);
        let text = document.in_plain_signs().text(Detail::Full);
        let faults = text.lines().filter(|line| !line.replace('─', "-").is_ascii() || line.contains('?'));
        let faults: Vec<&str> =
            faults.chain(text.lines().filter(|line| line.chars().count() > 100)).collect();
        assert!(faults.is_empty() && !usual.is_ascii(), "{faults:?}");
    }
}

#[test]
fn answers_fit_a_terminal_of_80_columns() {
    for name in ["pps", "ur5", "machine3", "hexapod"] {
        let machine = Machine::find(name).unwrap();
        let checked = Check { machine: machine.clone() }.run(&mut ()).unwrap();
        let study = Study::find(None, &machine).unwrap();
        let analyzed = Analyze::new(machine, study).run(&mut ()).unwrap();
        for document in [views::check(&checked), budget(&analyzed)] {
            let text = at_width(80, || document.text(Detail::Answer));
            assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
        }
    }
}
