//! Tests of `unit.rs`.

use super::*;

#[test]
fn micro_sign_is_accepted() {
    for (sign, letter) in [("µm", "um"), ("μm", "um"), ("µrad", "urad"), ("μrad", "urad")] {
        assert_eq!(Unit::named(sign), Unit::named(letter));
    }
}

#[test]
fn conversions_are_exact_where_they_can_be() {
    let convert = |number, name, length| Unit::named(name).unwrap().convert(number, length);
    assert_eq!(convert(718.0, "mm", LengthUnit::Millimetre), 718.0);
    assert_eq!(convert(718.0, "mm", LengthUnit::Metre), 0.718);
    assert_eq!(convert(90.0, "deg", LengthUnit::Metre), std::f64::consts::FRAC_PI_2);
    assert_eq!(convert(1.0, "N", LengthUnit::Millimetre), 1000.0);
    assert_eq!(convert(210.0, "GPa", LengthUnit::Millimetre), 210e6);
    assert_eq!(convert(1.0, "inch", LengthUnit::Millimetre), 25.4);
    assert_eq!(convert(1.0, "inch", LengthUnit::Metre), 0.0254);
    assert_eq!(convert(1.0, "lb", LengthUnit::Metre), 0.453_592_37);
    assert_eq!(convert(2.0, "t", LengthUnit::Metre), 2000.0);
    assert_eq!(convert(3.0, "cm", LengthUnit::Millimetre), 30.0);
    assert_eq!(convert(7.0, "nm", LengthUnit::Metre), 7e-9);
    assert_eq!(convert(3.0, "mN", LengthUnit::Metre), 3e-3);
    assert_eq!(convert(5.0, "kPa", LengthUnit::Metre), 5e3);
    assert_eq!(convert(1.5, "h", LengthUnit::Metre), 5400.0);
    assert_eq!(convert(1.5, "min", LengthUnit::Metre), 90.0);
    assert_eq!(convert(7.0, "%", LengthUnit::Metre), 0.07);
    assert_eq!([convert(7.0, "ppm", LengthUnit::Metre), convert(7.0, "urad", LengthUnit::Metre)], [7e-6; 2]);
    let right = std::f64::consts::FRAC_PI_2;
    assert_eq!(convert(5400.0, "arcmin", LengthUnit::Metre), right);
    assert_eq!(convert(324_000.0, "arcsec", LengthUnit::Metre), right);
}

/// A decimal keeps its digits in every unit that differs by a power of ten.
#[test]
fn decimals_are_kept() {
    for (name, decades) in [("m", 3), ("cm", 1), ("mm", 0), ("um", -3), ("nm", -6)] {
        let unit = Unit::named(name).unwrap();
        for (length, more) in [(LengthUnit::Millimetre, 0), (LengthUnit::Metre, -3)] {
            for number in (1..20_000).step_by(7) {
                let found = unit.convert(f64::from(number) / 1e4, length);
                let exact: f64 = format!("{number}e{}", decades + more - 4).parse().unwrap();
                assert_eq!(found.to_bits(), exact.to_bits(), "{number} {name}");
            }
        }
    }
    assert_eq!(Unit::named("m").unwrap().convert(0.1133, LengthUnit::Millimetre), 113.3);
}

#[test]
fn factors_of_products_are_exact_too() {
    let inch = Unit::named("inch").unwrap();
    let area = Unit::NONE.times(inch, 2).unwrap();
    assert_eq!(area.convert(1.0, LengthUnit::Millimetre), 645.16);
    let speed = inch.times(Unit::named("min").unwrap(), -1).unwrap();
    assert_eq!(speed.convert(60.0, LengthUnit::Millimetre), 25.4);
}

#[test]
fn every_name_has_a_unit() {
    for name in UNIT_NAMES {
        assert!(Unit::named(name).is_some(), "{name}");
    }
}

/// Checks that a hint for a spelling has the size that was meant.
#[test]
fn hints_have_the_size_that_was_meant() {
    let inch = 0.0254;
    for (word, size) in [
        ("Nm", 1.0),
        ("Nmm", 1e-3),
        ("kNm", 1e3),
        ("micron", 1e-6),
        ("in", inch),
        ("mil", 1e-3 * inch),
        ("ft", 0.3048),
        ("millimeter", 1e-3),
        ("degrees", std::f64::consts::PI / 180.0),
        ("gon", std::f64::consts::PI / 200.0),
        ("kgf", 9.80665),
        ("lbf", 4.448_221_615_260_5),
        ("bar", 1e5),
        ("Kg", 1.0),
        ("mpa", 1e6),
        ("arcsecs", std::f64::consts::PI / 648_000.0),
        ("degg", std::f64::consts::PI / 180.0),
    ] {
        let help = unit_help(word);
        let unit = help.split('`').nth(1).unwrap_or_else(|| panic!("{word}: {help}"));
        let text = if unit.starts_with(|c: char| c.is_ascii_digit()) {
            unit.to_owned()
        } else {
            format!("1 {unit}")
        };
        let document = crate::Document::new("hint", text.as_str());
        let factors = text.split([' ', '*']).skip(1).map(|name| Unit::named(name).expect(name).dimension);
        let dimension = factors.fold(Dimension::NONE, |all, one| all.times(one).unwrap());
        let value = crate::value::parse_value(&document, 0..text.len(), LengthUnit::Metre, dimension, "it");
        let value = value.unwrap_or_else(|| panic!("{word}: {help}"));
        assert!((value / size - 1.0).abs() < 1e-12, "{word}: {help}, {value}");
    }
    // Nothing of another size is offered.
    for word in ["nrad", "Mrad", "degC", "V", "px", "tick", "Hz", "rpm", "x", "kW", "mn"] {
        assert!(!unit_help(word).contains("did you mean"), "{word}: {}", unit_help(word));
    }
}

/// Units that are offered for a number without one have its dimension.
#[test]
fn units_of_engineers_have_the_dimension() {
    let metre = Unit::named("m").unwrap().dimension;
    for power in -4..=4 {
        for base in [Dimension::FORCE, Dimension::NONE.over(Dimension::FORCE).unwrap(), Dimension::MASS] {
            let dimension = base.times(metre.power(f64::from(power)).unwrap()).unwrap();
            for unit in dimension.units("mm") {
                let text = format!("1 {unit}");
                let document = crate::Document::new("hint", text.as_str());
                let value =
                    crate::value::parse_value(&document, 0..text.len(), LengthUnit::Metre, dimension, "it");
                assert!(value.is_some(), "{unit}: {:?}", document.found.borrow());
            }
        }
    }
}
