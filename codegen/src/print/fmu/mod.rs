//! A functional mock-up unit (FMI 3.0 or 2.0): the C of a machine with a description of its variables, for simulators.
//!
//! `variables` says what is in it, `description` and `page` tell that to programs and people, `machine` to the C
//! that is the same for all machines: `fmi-3.c`, `fmi-2.c`, `fmi-instance.h`. `xml` writes elements, `units` their units.

mod description;
mod fmi;
mod machine;
mod page;
mod units;
mod variables;
mod xml;

use abbe_spec::Spec;
use sha2::{Digest, Sha256};

pub use self::fmi::Fmi;
use self::variables::Variables;
use super::c::{self, Real};
use super::source_file::SourceFile;
use crate::chain::Model;
use crate::program::Routines;

/// The files of the archive, with their folders. Inputs that are magnitudes of sources are its parameters.
pub(super) fn files(spec: &Spec, model: &Model, routines: &Routines, fmi: Fmi) -> Vec<SourceFile> {
    let variables = Variables::new(spec);
    let token = token(spec, fmi);
    let mut sources = c::files(spec, model, routines, Real::Double);
    let compiled = [format!("{}.c", spec.name), fmi.source().0.to_owned()];
    let file = |name: &str, text: String| SourceFile { name: name.to_owned(), text };
    sources.push(file("fmi-machine.h", machine::header(spec, &variables, &token)));
    sources.push(file("fmi-instance.h", include_str!("fmi-instance.h").to_owned()));
    sources.push(file(fmi.source().0, fmi.source().1.to_owned()));
    if fmi == Fmi::Three {
        sources.push(file("buildDescription.xml", description::build(spec, &compiled)));
    }
    sources.iter_mut().for_each(|source| source.name.insert_str(0, "sources/"));
    let described = description::model(spec, fmi, &variables, &token, &compiled);
    let mut files = vec![
        file("modelDescription.xml", described),
        file("documentation/index.html", page::page(spec, fmi, &variables)),
    ];
    files.append(&mut sources);
    files
}

/// What binds code to its description: of the generator's version, FMI's and the spec's hash, in the form of a GUID.
fn token(spec: &Spec, fmi: Fmi) -> String {
    let bound = format!("abbe {} FMI {} {}", env!("CARGO_PKG_VERSION"), fmi.name(), spec.hash);
    let hash = Sha256::digest(bound.as_bytes());
    let digits: String = hash.iter().take(16).map(|byte| format!("{byte:02x}")).collect();
    let [a, b, c, d, e] = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| &digits[range]);
    format!("{{{a}-{b}-{c}-{d}-{e}}}")
}
