//! Memory size of a function: its code and constants, including everything it calls except system
//! functions.

use std::path::Path;
use std::process::Command;

use crate::said;

/// Returns the bytes of `.text` and `.rodata` that the linker keeps for this function.
pub fn bytes(mut compiler: Command, source: &Path, function: &str, folder: &Path) -> u64 {
    let [whole, kept] = ["whole.o", "kept.o"].map(|name| folder.join(name));
    compiler.args(["-ffunction-sections", "-fdata-sections", "-c"]).arg(source).arg("-o").arg(&whole);
    said(&mut compiler);
    said(Command::new("ld").args(["-r", "--gc-sections", "-u", function]).arg(&whole).arg("-o").arg(&kept));
    let listed = said(Command::new("size").arg("-A").arg(&kept));
    let sections = listed.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        let (name, bytes) = (words.next()?, words.next()?);
        let counts = name.starts_with(".text") || name.starts_with(".rodata");
        counts.then(|| bytes.parse::<u64>().expect("a number of bytes"))
    });
    let bytes = sections.sum();
    assert!(bytes > 0, "{function} is not in {}", source.display());
    bytes
}
