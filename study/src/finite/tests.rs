//! Tests of `finite.rs`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::finite;

#[derive(Serialize)]
struct Report {
    name: String,
    #[serde(serialize_with = "super::or_null")]
    degrees_of_freedom: f64,
    sizes: Vec<BTreeMap<String, Option<[f64; 2]>>>,
    #[serde(skip)]
    _scratch: f64,
}

#[test]
fn the_message_names_the_field() {
    let report = |value: f64| Report {
        name: "a".to_owned(),
        degrees_of_freedom: f64::INFINITY,
        sizes: vec![
            BTreeMap::new(),
            BTreeMap::from([("rms".to_owned(), Some([1.0, value])), ("x".to_owned(), None)]),
        ],
        _scratch: f64::NAN,
    };
    assert!(finite("arm", report(2.0)).is_ok());
    for value in [f64::NAN, f64::INFINITY] {
        let mistakes = finite("arm", report(value)).map(|_| ()).unwrap_err();
        assert_eq!(mistakes.list[0].message, "`sizes.2.rms.2` of the result is not a finite number");
    }
    assert!(finite("arm", Report { degrees_of_freedom: f64::NAN, ..report(1.0) }).is_err());
}
