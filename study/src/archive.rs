//! Zip archives of uncompressed files (PKWARE's APPNOTE 6.3, sections 4.3.7, 4.3.12 and 4.3.16).

use abbe_codegen::print::SourceFile;

const LOCAL_HEADER: u32 = 0x0403_4b50;
const CENTRAL_HEADER: u32 = 0x0201_4b50;
const END_OF_DIRECTORY: u32 = 0x0605_4b50;

/// Version 1.0, which suffices for stored files.
const VERSION_NEEDED: u16 = 10;
const MADE_ON_UNIX: u16 = 3 << 8 | 20;
const NAME_IS_UTF8: u16 = 1 << 11;
const STORED: u16 = 0;
/// 1 January 1980, in MS-DOS format.
const DATE: u16 = 1 << 5 | 1;
/// Mode `-rw-r--r--` of a regular file.
const MODE: u32 = 0o100_644 << 16;

/// Returns a zip archive of files, such as a functional mock-up unit. The bytes depend only on the
/// files: all are dated 1980.
pub fn archive(files: &[SourceFile]) -> Vec<u8> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for SourceFile { name, text } in files {
        let (start, size) = (size(archive.len()), size(text.len()));
        let mut common = numbers16(&[VERSION_NEEDED, NAME_IS_UTF8, STORED, 0, DATE]);
        common.extend(numbers32(&[crc32(text.as_bytes()), size, size]));
        common.extend(numbers16(&[count(name.len()), 0]));
        archive.extend(LOCAL_HEADER.to_le_bytes());
        archive.extend(&common);
        archive.extend(name.as_bytes());
        archive.extend(text.as_bytes());
        directory.extend(CENTRAL_HEADER.to_le_bytes());
        directory.extend(MADE_ON_UNIX.to_le_bytes());
        directory.extend(&common);
        directory.extend(numbers16(&[0, 0, 0]));
        directory.extend(numbers32(&[MODE, start]));
        directory.extend(name.as_bytes());
    }
    let ends = numbers32(&[size(directory.len()), size(archive.len())]);
    archive.extend(directory);
    archive.extend(END_OF_DIRECTORY.to_le_bytes());
    archive.extend(numbers16(&[0, 0, count(files.len()), count(files.len())]));
    archive.extend(ends);
    archive.extend(numbers16(&[0]));
    archive
}

fn size(bytes: usize) -> u32 {
    u32::try_from(bytes).expect("generated code is shorter than 4 GiB")
}

fn count(number: usize) -> u16 {
    u16::try_from(number).expect("names are short and files are few")
}

fn numbers16(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn numbers32(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// CRC-32 of zip: reflected, with the polynomial 0x04c11db7.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| (crc >> 1) ^ (0xedb8_8320 * (crc & 1));
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc)))
}

#[cfg(test)]
mod tests;
