//! Tests of `run_record.rs`.

use super::{RunRecord, check_date};

#[test]
fn dates_are_of_the_calendar() {
    for date in ["2026-03-14", "20260314", "2026-03-14 08:30"] {
        assert_eq!(check_date(date), Ok(date.to_owned()));
    }
    for wrong in ["banana", "12.5", "2026-02-30", "14.03.2026", ""] {
        assert!(check_date(wrong).is_err_and(|message| message.contains("2026-03-14")), "{wrong}");
    }
}

#[test]
fn a_given_date_replaces_the_stated_one() {
    let mut record = RunRecord::default();
    record.state("operator", "A. Operator".to_owned());
    record.state("date", "2026-03-14".to_owned());
    record.state("serial", String::new());
    let record = record.dated(Some(&"2026-03-15".to_owned())).dated(None);
    let stated = record.stated().collect::<Vec<_>>();
    assert_eq!(stated, [("Date", "2026-03-15"), ("Operator", "A. Operator")]);
}
