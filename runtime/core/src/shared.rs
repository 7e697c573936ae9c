//! Texts and lists of a description: constants of generated code, or shared data read from a spec
//! at run time.

use core::{fmt, ops::Deref};
#[cfg(feature = "std")]
use std::sync::Arc;

/// Text that is cheap to clone.
#[derive(Clone)]
pub enum Text {
    /// Constant of the program.
    Constant(&'static str),
    /// Text read at run time.
    #[cfg(feature = "std")]
    Shared(Arc<str>),
}

/// List that is cheap to clone.
#[derive(Clone)]
pub enum List<T: 'static> {
    /// Constant of the program.
    Constant(&'static [T]),
    /// List created at run time.
    #[cfg(feature = "std")]
    Shared(Arc<[T]>),
}

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        match self {
            Self::Constant(text) => text,
            #[cfg(feature = "std")]
            Self::Shared(text) => text,
        }
    }
}

impl<T> Deref for List<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match self {
            Self::Constant(list) => list,
            #[cfg(feature = "std")]
            Self::Shared(list) => list,
        }
    }
}

impl PartialEq for Text {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Eq for Text {}

impl PartialEq<&str> for Text {
    fn eq(&self, other: &&str) -> bool {
        **self == **other
    }
}

#[cfg(feature = "std")]
impl PartialEq<&String> for Text {
    fn eq(&self, other: &&String) -> bool {
        **self == ***other
    }
}

impl PartialEq<str> for Text {
    fn eq(&self, other: &str) -> bool {
        **self == *other
    }
}

impl<T: PartialEq> PartialEq for List<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<'a, T> IntoIterator for &'a List<T> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&**self, f)
    }
}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

impl<T: fmt::Debug> fmt::Debug for List<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

#[cfg(feature = "std")]
impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::Shared(text.into())
    }
}

#[cfg(feature = "std")]
impl<T> FromIterator<T> for List<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        Self::Shared(items.into_iter().collect())
    }
}
