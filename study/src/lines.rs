//! Line numbers in a file that is read in blocks.

use std::cell::RefCell;
use std::io::{self, Read};
use std::rc::Rc;

use abbe_spec::bounded::UnreadableFile;

/// Largest length of a row, in bytes.
const LONGEST: usize = 4 << 20;

/// Bytes read since the start of the current record.
#[derive(Default)]
struct Window {
    /// Offset of the window in the file.
    start: u64,
    bytes: Vec<u8>,
    /// Line number at the start of the window, from 1.
    line: u64,
}

/// Counts lines. The positions of the CSV reader are at the end of the preceding record, before its
/// line end, empty lines and comments.
pub struct Lines(Rc<RefCell<Window>>);

/// Reader that keeps what is read until its lines are counted.
pub struct RecordedReader<R> {
    inner: R,
    window: Rc<RefCell<Window>>,
}

impl<R: Read> RecordedReader<R> {
    /// Wraps a reader, and returns the counter of its lines.
    pub fn new(inner: R) -> (Self, Lines) {
        let window = Rc::new(RefCell::new(Window { line: 1, ..Window::default() }));
        (Self { inner, window: Rc::clone(&window) }, Lines(window))
    }
}

impl<R: Read> Read for RecordedReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut window = self.window.borrow_mut();
        if window.bytes.len() > LONGEST {
            let message = format!("the row in line {} is longer than {} MiB", window.line, LONGEST >> 20);
            return Err(UnreadableFile::new(message, "check for an unclosed quotation mark").into());
        }
        let length = self.inner.read(buffer)?;
        window.bytes.extend_from_slice(&buffer[..length]);
        Ok(length)
    }
}

impl Lines {
    /// Returns the line number of the next record after a byte offset, and discards everything
    /// before it.
    pub fn record_line(&mut self, byte: u64) -> u64 {
        let mut window = self.0.borrow_mut();
        let mut start = byte.saturating_sub(window.start) as usize;
        loop {
            match window.bytes.get(start) {
                Some(b'\r' | b'\n') => start += 1,
                Some(b'#') => {
                    start += window.bytes[start..].iter().take_while(|byte| **byte != b'\n').count();
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
mod tests;
