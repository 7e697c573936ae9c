//! Tests of `date.rs`.

use super::{Calendar, in_name, parse_date};

#[test]
fn dates_go_and_come_back() {
    for (text, days) in [("1970-01-01", 0.0), ("2000-03-01", 11_017.0), ("1600-02-29", -135_081.0)] {
        assert_eq!(parse_date(text), Some((Calendar::Dates, days)));
        assert_eq!(Calendar::Dates.show(days + 0.5), text);
    }
}

#[test]
fn dates_are_read_where_they_stand() {
    let date = Some((Calendar::Dates, 20_526.0));
    assert_eq!(parse_date("2026-03-14"), date);
    assert_eq!(parse_date("2026-03-14T12:00:00Z"), Some((Calendar::Dates, 20_526.5)));
    assert_eq!(parse_date("2026-03-14 06:00"), Some((Calendar::Dates, 20_526.25)));
    assert_eq!(parse_date("20260314"), date);
    assert_eq!(parse_date("12.5"), Some((Calendar::Days, 12.5)));
    for wrong in
        ["2026-02-30", "14.03.2026", "2026-3-14", "2026-03-14 25:00", "soon", "", "nan", "2026-03-1ü"]
    {
        assert_eq!(parse_date(wrong), None, "{wrong}");
    }
    for name in ["check-2026-03-14.csv", "20260314_flange.csv", "cell 7, 2026_03_14"] {
        assert_eq!(in_name(name), Some(20_526.0), "{name}");
    }
    assert_eq!((in_name("check-12.csv"), in_name("serial-202603141")), (None, None));
}
