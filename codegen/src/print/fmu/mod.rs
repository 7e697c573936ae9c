//! A functional mock-up unit (FMI 3.0 or 2.0) for simulators: the C code of a machine with a
//! description of its variables.
//!
//! `variables` lists the variables, `description` describes them for programs and people,
//! `machine` for the C code that all machines share: `fmi-3.c`, `fmi-2.c`, `fmi-instance.h`. `xml`
//! writes elements.

mod description;
mod machine;
mod variables;
mod xml;

use abbe_spec::Spec;
use sha2::{Digest, Sha256};

use self::variables::{CORRECTED, CORRECTION, Causality, OUTPUTS, Variable, Variables, definitions};
use super::{Real, SourceFile, c};
use crate::{chain::Model, program::Routines};
pub use description::Fmi;
pub(super) use xml::escaped;

/// Functions of the C code that the unit calls.
pub(super) const FUNCTIONS: [&str; 4] = ["pose", "predicted_displacement", "real_pose", "compensated"];

/// Returns the files of the archive, with their folders. Inputs that scale sources become
/// parameters of the unit.
pub(super) fn files(spec: &Spec, model: &Model, routines: &Routines, fmi: Fmi) -> Vec<SourceFile> {
    let variables = Variables::new(spec);
    let token = token(spec, fmi);
    let mut sources = c::files(spec, model, routines, Real::Double);
    let compiled = [sources[1].name.clone(), fmi.source().0.to_owned()];
    let file = |name: &str, text: String| SourceFile { name: name.to_owned(), text };
    sources.push(file("fmi-machine.h", machine::header(spec, &variables, &token, &sources[0].name)));
    sources.push(file("fmi-instance.h", include_str!("fmi-instance.h").to_owned()));
    sources.push(file(fmi.source().0, fmi.source().1.to_owned()));
    if fmi == Fmi::Three {
        sources.push(file("buildDescription.xml", description::build(spec, &compiled)));
    }
    sources.iter_mut().for_each(|source| source.name.insert_str(0, "sources/"));
    let described = description::model(spec, fmi, &variables, &token, &compiled);
    let mut files = vec![
        file("modelDescription.xml", described),
        file("documentation/index.html", description::page(spec, fmi, &variables)),
    ];
    files.append(&mut sources);
    files
}

/// Returns the GUID that binds the code to its description: a hash of the generator's version,
/// FMI's version and the spec's hash.
fn token(spec: &Spec, fmi: Fmi) -> String {
    let bound = format!("abbe {} FMI {} {}", env!("CARGO_PKG_VERSION"), fmi.name(), spec.hash);
    let hash = Sha256::digest(bound.as_bytes());
    let digits: String = hash.iter().take(16).map(|byte| format!("{byte:02x}")).collect();
    let [a, b, c, d, e] = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| &digits[range]);
    format!("{{{a}-{b}-{c}-{d}-{e}}}")
}
