//! Checks that a report has only finite numbers.
//!
//! Configurations that cannot be evaluated are reported earlier, with their values. This check
//! finds results of finite numbers that overflow, or ratios with a zero denominator.

use std::fmt::{self, Display};

use abbe_spec::diagnostic::Diagnostics;
use serde::ser::{
    self, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant,
};
use serde::{Serialize, Serializer};

use crate::mistake;

/// Names of fields that may be infinite by definition.
const MAY_BE_INFINITE: [&str; 7] =
    ["degrees_of_freedom", "effective_degrees_of_freedom", "limits", "range", "condition", "f", "t"];

/// Returns the report, or a diagnostic that names the first number in it that is not finite.
pub fn finite<R: Serialize>(subject: impl Display, report: R) -> Result<R, Diagnostics> {
    match report.serialize(&mut FiniteCheck { path: Vec::new(), text: String::new() }) {
        Err(NotFinite(place)) if !place.is_empty() => {
            let message = format!("`{place}` of the result is not a finite number");
            let help = "an input is far too large or too small: check the units in the spec, the \
                map and the options";
            Err(mistake::with_help(subject, message, help))
        }
        _ => Ok(report),
    }
}

/// Serializer that checks numbers and tracks its position in the report.
struct FiniteCheck {
    path: Vec<String>,
    /// Text of the last string, which may be a map key.
    text: String,
}

/// Path of a number that is not finite; empty for any other error.
#[derive(Debug)]
struct NotFinite(String);

impl Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NotFinite {}

impl ser::Error for NotFinite {
    fn custom<T: Display>(_: T) -> Self {
        Self(String::new())
    }
}

impl FiniteCheck {
    fn check_number(&self, value: f64) -> Result<(), NotFinite> {
        let may_be_infinite =
            || value.is_infinite() && self.path.iter().any(|name| MAY_BE_INFINITE.contains(&name.as_str()));
        if value.is_finite() || may_be_infinite() { Ok(()) } else { Err(NotFinite(self.path.join("."))) }
    }

    fn check_entry<T: ?Sized + Serialize>(&mut self, name: String, value: &T) -> Result<(), NotFinite> {
        self.path.push(name);
        value.serialize(&mut *self)?;
        self.path.pop();
        Ok(())
    }
}

/// Entries of a list, map or structure.
struct Entries<'l> {
    check: &'l mut FiniteCheck,
    count: usize,
    key: String,
}

macro_rules! always_finite {
    ($($name:ident: $kind:ty),* $(,)?) => {
        $(fn $name(self, _: $kind) -> Result<(), NotFinite> {
            Ok(())
        })*
    };
}

impl<'l> Serializer for &'l mut FiniteCheck {
    type Ok = ();
    type Error = NotFinite;
    type SerializeSeq = Entries<'l>;
    type SerializeTuple = Entries<'l>;
    type SerializeTupleStruct = Entries<'l>;
    type SerializeTupleVariant = Entries<'l>;
    type SerializeMap = Entries<'l>;
    type SerializeStruct = Entries<'l>;
    type SerializeStructVariant = Entries<'l>;

    always_finite! {
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_char: char,
        serialize_bytes: &[u8], serialize_unit_struct: &'static str,
    }

    fn serialize_str(self, text: &str) -> Result<(), NotFinite> {
        text.clone_into(&mut self.text);
        Ok(())
    }

    fn serialize_f32(self, value: f32) -> Result<(), NotFinite> {
        self.check_number(f64::from(value))
    }

    fn serialize_f64(self, value: f64) -> Result<(), NotFinite> {
        self.check_number(value)
    }

    fn serialize_none(self) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), NotFinite> {
        self.check_entry(variant.to_owned(), value)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Entries<'l>, NotFinite> {
        Ok(Entries { check: self, count: 0, key: String::new() })
    }

    fn serialize_tuple(self, _: usize) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Entries<'l>, NotFinite> {
        self.serialize_seq(None)
    }
}

impl Entries<'_> {
    fn check_next<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
        self.count += 1;
        self.check.check_entry(self.count.to_string(), value)
    }
}

macro_rules! list_traits {
    ($($list:ident: $add:ident),*) => {
        $(impl $list for Entries<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn $add<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
                self.check_next(value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

macro_rules! struct_traits {
    ($($structure:ident),*) => {
        $(impl $structure for Entries<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn serialize_field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Result<(), NotFinite> {
                self.check.check_entry(name.to_owned(), value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

list_traits!(
    SerializeSeq: serialize_element,
    SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field,
    SerializeTupleVariant: serialize_field
);
struct_traits!(SerializeStruct, SerializeStructVariant);

impl SerializeMap for Entries<'_> {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: ?Sized + Serialize>(&mut self, key: &T) -> Result<(), NotFinite> {
        key.serialize(&mut *self.check)?;
        self.key = std::mem::take(&mut self.check.text);
        Ok(())
    }

    fn serialize_value<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
        let key = std::mem::take(&mut self.key);
        self.check.check_entry(key, value)
    }

    fn end(self) -> Result<(), NotFinite> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::Serialize;

    use super::finite;

    #[derive(Serialize)]
    struct Report {
        name: String,
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
}
