//! Lines of a file that is read piece by piece.

use std::cell::RefCell;
use std::io::{self, Read};
use std::rc::Rc;

use abbe_spec::bounded::Unfit;

/// The longest row, in bytes.
const LONGEST: usize = 4 << 20;

/// What was read since the beginning of a record.
#[derive(Default)]
struct Window {
    /// Where it begins, in the file.
    start: u64,
    bytes: Vec<u8>,
    /// The line on which it begins, from 1.
    line: u64,
}

/// Counts lines. A reader's own positions are behind the record before: the rest of a line end, empty lines and comments
/// are still to come.
pub(crate) struct Lines(Rc<RefCell<Window>>);

/// What is read, remembered until its lines are counted.
pub(crate) struct Watched<R> {
    inner: R,
    window: Rc<RefCell<Window>>,
}

impl<R: Read> Watched<R> {
    pub(crate) fn new(inner: R) -> (Self, Lines) {
        let window = Rc::new(RefCell::new(Window { line: 1, ..Window::default() }));
        (Self { inner, window: Rc::clone(&window) }, Lines(window))
    }
}

impl<R: Read> Read for Watched<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut window = self.window.borrow_mut();
        if window.bytes.len() > LONGEST {
            let message =
                format!("the row in line {} does not end within {} MiB", window.line, LONGEST >> 20);
            return Err(Unfit::new(message, "is there a quotation mark that nothing closes?").into());
        }
        let length = self.inner.read(buffer)?;
        window.bytes.extend_from_slice(&buffer[..length]);
        Ok(length)
    }
}

impl Lines {
    /// The line on which the next record after that byte begins; what is before it is forgotten.
    pub(crate) fn of_record(&mut self, byte: u64) -> u64 {
        let mut window = self.0.borrow_mut();
        let mut start = byte.saturating_sub(window.start) as usize;
        loop {
            match window.bytes.get(start) {
                Some(b'\r' | b'\n') => start += 1,
                Some(b'#') => {
                    let rest = window.bytes[start..].iter();
                    start += rest.take_while(|byte| **byte != b'\n').count();
                }
                _ => break,
            }
        }
        let start = start.min(window.bytes.len());
        let ends = window.bytes[..start].iter().filter(|byte| **byte == b'\n').count();
        window.line += ends as u64;
        window.start += start as u64;
        window.bytes.drain(..start);
        window.line
    }
}

#[cfg(test)]
mod tests {
    use super::Watched;

    #[test]
    fn line_ends_of_any_kind_count() {
        for end in ["\n", "\r\n"] {
            let text = ["a,b", "1,2", "", "# no row", "3,4", "\"5", "x\",6", "7,8"].join(end);
            let (watched, mut lines) = Watched::new(text.as_bytes());
            let reader =
                csv::ReaderBuilder::new().comment(Some(b'#')).buffer_capacity(3).from_reader(watched);
            let records = reader.into_records();
            let found: Vec<u64> =
                records.map(|record| lines.of_record(record.unwrap().position().unwrap().byte())).collect();
            assert_eq!(found, [2, 5, 6, 8], "{end:?}");
        }
    }
}
