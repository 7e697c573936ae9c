//! Zip archives of uncompressed files.

use std::io::{Cursor, Write};

use abbe_codegen::print::SourceFile;
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

/// Returns a zip archive of files, such as a functional mock-up unit. The bytes depend only on the
/// files: all are dated 1980.
pub fn archive(files: &[SourceFile]) -> Vec<u8> {
    let stored = SimpleFileOptions::DEFAULT
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::DEFAULT)
        .unix_permissions(0o644);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for SourceFile { name, text } in files {
        archive.start_file(name, stored).expect("names are short and differ");
        archive.write_all(text.as_bytes()).expect("generated code is shorter than 4 GiB");
    }
    archive.finish().expect("files are few").into_inner()
}

#[cfg(test)]
mod tests;
