//! Input files of jobs, which output must not overwrite.

use std::{borrow::Cow, path::PathBuf};

use crate::check::Check;
use crate::export::{Export, Format};
use crate::generate::Generate;
use crate::import::Import;
use crate::jacobian::Jacobian;
use crate::{Machine, Study};

/// Access to the files that an input was read from.
pub trait Reads {
    /// Returns the files, in any order. Shipped files are not included.
    fn files(&self) -> Vec<PathBuf>;
}

impl Reads for () {
    fn files(&self) -> Vec<PathBuf> {
        Vec::new()
    }
}

/// Files that are listed individually.
impl Reads for Vec<PathBuf> {
    fn files(&self) -> Vec<PathBuf> {
        self.clone()
    }
}

impl Reads for Machine {
    fn files(&self) -> Vec<PathBuf> {
        self.file.iter().chain(&self.spec.beside).cloned().collect()
    }
}

impl<T: Reads + Clone> Reads for Cow<'_, T> {
    fn files(&self) -> Vec<PathBuf> {
        self.as_ref().files()
    }
}

impl<T: Reads> Reads for Option<T> {
    fn files(&self) -> Vec<PathBuf> {
        self.as_ref().map(T::files).unwrap_or_default()
    }
}

/// Implements [`Reads`] for jobs: each names the fields that were read from files, then all others,
/// so that a new field does not compile until its files are considered. Or implements it for types
/// that have a list `files`.
#[macro_export]
macro_rules! reads {
    (files of $($own:ty),+) => {$(
        impl $crate::Reads for $own {
            fn files(&self) -> Vec<std::path::PathBuf> {
                self.files.clone()
            }
        }
    )+};
    ($($job:ty: $($read:ident)+, without $($other:ident)*;)+) => {$(
        impl $crate::Reads for $job {
            fn files(&self) -> Vec<std::path::PathBuf> {
                let Self { $($read,)+ $($other: _,)* } = self;
                [$($crate::Reads::files($read)),+].concat()
            }
        }
    )+};
}

reads! {
    Check: machine, without;
    Export: machine format, without samples seed;
    Generate: machine, without language only name;
    Jacobian: machine, without q;
    Import: file, without format round_angles;
}

reads!(files of Study);

impl Reads for PathBuf {
    fn files(&self) -> Vec<PathBuf> {
        vec![self.clone()]
    }
}

impl Reads for Format {
    fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Urdf { file, .. } => vec![file.clone()],
            _ => Vec::new(),
        }
    }
}
