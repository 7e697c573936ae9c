//! Whether every number of a report is one.
//!
//! Configurations that cannot be evaluated are mistakes where they are met, with their place. What gets here all the same
//! was worked out of numbers that are each finite: squares of what is far too large, a share of nothing.

use std::fmt::{self, Display};

use abbe_spec::diagnostic::Diagnostics;
use serde::ser::{
    self, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant,
};
use serde::{Serialize, Serializer};

use crate::mistake;

/// What may be infinite, and is said to be so: freedom without end, joints without limits, tests without a spread.
const ENDLESS: [&str; 7] =
    ["degrees_of_freedom", "effective_degrees_of_freedom", "limits", "range", "condition", "f", "t"];

/// The report itself, or the mistake that a number in it is not finite, with its place in the report.
pub fn finite<R: Serialize>(subject: impl Display, report: R) -> Result<R, Diagnostics> {
    match report.serialize(&mut Looking { path: Vec::new(), text: String::new() }) {
        Err(NotFinite(place)) if !place.is_empty() => {
            let message = format!("`{place}` of the result is not a finite number");
            let help = "a number that went in is far too large or too small: are the units of the spec, the map and the \
                        options right?";
            Err(mistake::with_help(subject, message, help))
        }
        _ => Ok(report),
    }
}

/// Where it is in a report.
struct Looking {
    path: Vec<String>,
    /// The last text: that of a key, if it was one.
    text: String,
}

/// The place of a number that is not finite; none for what has no place.
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

impl Looking {
    fn number(&self, value: f64) -> Result<(), NotFinite> {
        let may_be_endless =
            || value.is_infinite() && self.path.iter().any(|name| ENDLESS.contains(&name.as_str()));
        if value.is_finite() || may_be_endless() { Ok(()) } else { Err(NotFinite(self.path.join("."))) }
    }

    fn within<T: ?Sized + Serialize>(&mut self, name: String, value: &T) -> Result<(), NotFinite> {
        self.path.push(name);
        value.serialize(&mut *self)?;
        self.path.pop();
        Ok(())
    }
}

/// The entries of a list, a table or a structure.
struct Entries<'l> {
    looking: &'l mut Looking,
    count: usize,
    key: String,
}

macro_rules! nothing_to_see {
    ($($name:ident: $kind:ty),* $(,)?) => {
        $(fn $name(self, _: $kind) -> Result<(), NotFinite> {
            Ok(())
        })*
    };
}

impl<'l> Serializer for &'l mut Looking {
    type Ok = ();
    type Error = NotFinite;
    type SerializeSeq = Entries<'l>;
    type SerializeTuple = Entries<'l>;
    type SerializeTupleStruct = Entries<'l>;
    type SerializeTupleVariant = Entries<'l>;
    type SerializeMap = Entries<'l>;
    type SerializeStruct = Entries<'l>;
    type SerializeStructVariant = Entries<'l>;

    nothing_to_see! {
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_char: char,
        serialize_bytes: &[u8], serialize_unit_struct: &'static str,
    }

    fn serialize_str(self, text: &str) -> Result<(), NotFinite> {
        text.clone_into(&mut self.text);
        Ok(())
    }

    fn serialize_f32(self, value: f32) -> Result<(), NotFinite> {
        self.number(f64::from(value))
    }

    fn serialize_f64(self, value: f64) -> Result<(), NotFinite> {
        self.number(value)
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
        self.within(variant.to_owned(), value)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Entries<'l>, NotFinite> {
        Ok(Entries { looking: self, count: 0, key: String::new() })
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
    fn next<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
        self.count += 1;
        self.looking.within(self.count.to_string(), value)
    }
}

macro_rules! listed {
    ($($list:ident: $add:ident),*) => {
        $(impl $list for Entries<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn $add<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
                self.next(value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

macro_rules! named {
    ($($structure:ident),*) => {
        $(impl $structure for Entries<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn serialize_field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Result<(), NotFinite> {
                self.looking.within(name.to_owned(), value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

listed!(
    SerializeSeq: serialize_element,
    SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field,
    SerializeTupleVariant: serialize_field
);
named!(SerializeStruct, SerializeStructVariant);

impl SerializeMap for Entries<'_> {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: ?Sized + Serialize>(&mut self, key: &T) -> Result<(), NotFinite> {
        key.serialize(&mut *self.looking)?;
        self.key = std::mem::take(&mut self.looking.text);
        Ok(())
    }

    fn serialize_value<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), NotFinite> {
        let key = std::mem::take(&mut self.key);
        self.looking.within(key, value)
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
    fn the_place_is_named() {
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
