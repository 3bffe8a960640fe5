//! The entries around the photos of a project file: photo bytes are counted, but not kept.

use std::cell::Cell;
use std::io::{Error, Result, Seek, SeekFrom, Write};
use std::rc::Rc;

/// What happens to bytes after the end of the file.
#[derive(Clone, Copy, PartialEq)]
pub enum Mode {
    /// They are kept.
    Keep,
    /// They go by.
    Pass,
    /// They are kept, in a piece of their own.
    Cut,
}

/// Takes a file of which parts go by. Bytes that were kept may be written over, as an archive does with the headers of its entries.
pub struct Around {
    /// Where each piece begins, and its bytes.
    pieces: Vec<(u64, Vec<u8>)>,
    at: u64,
    end: u64,
    mode: Rc<Cell<Mode>>,
}

impl Around {
    pub fn new(mode: Rc<Cell<Mode>>) -> Self {
        Self { pieces: vec![(0, Vec::new())], at: 0, end: 0, mode }
    }

    /// What was kept, cut where something went by.
    pub fn into_pieces(self) -> Vec<Vec<u8>> {
        self.pieces.into_iter().map(|(_, bytes)| bytes).collect()
    }
}

impl Write for Around {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let mut count = bytes.len();
        if self.at == self.end {
            if self.mode.get() == Mode::Cut {
                self.pieces.push((self.end, Vec::new()));
                self.mode.set(Mode::Keep);
            }
            if let (Mode::Keep, Some((_, piece))) = (self.mode.get(), self.pieces.last_mut()) {
                piece.extend_from_slice(bytes);
            }
            self.end += count as u64;
        } else {
            let last = self.pieces.iter_mut().rev().find(|(start, _)| *start <= self.at);
            let (start, piece) = last.ok_or_else(|| Error::other("before all pieces"))?;
            let from = (self.at - *start) as usize;
            let here = piece.get_mut(from..).unwrap_or_default();
            count = count.min(here.len());
            if count == 0 {
                return Err(Error::other("what went by cannot be written over"));
            }
            here[..count].copy_from_slice(&bytes[..count]);
        }
        self.at += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Seek for Around {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
            SeekFrom::End(by) => self.end.checked_add_signed(by),
        };
        self.at = at.filter(|at| *at <= self.end).ok_or_else(|| Error::other("outside"))?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn what_goes_by_is_counted_and_what_is_kept_can_be_written_over() {
        let mode = Rc::new(Cell::new(Mode::Keep));
        let mut around = Around::new(mode.clone());
        around.write_all(b"head").unwrap();
        for name in [b"1", b"2"] {
            mode.set(Mode::Pass);
            around.write_all(b"a photo").unwrap();
            mode.set(Mode::Cut);
            around.write_all(name).unwrap();
        }
        assert_eq!(around.stream_position().unwrap(), 20);
        around.seek(SeekFrom::Start(2)).unwrap();
        around.write_all(b"RT").unwrap();
        assert!(around.write_all(b"over a photo").is_err());
        around.seek(SeekFrom::Start(11)).unwrap();
        around.write_all(b"A").unwrap();
        assert!(around.seek(SeekFrom::End(1)).is_err());
        assert_eq!(around.into_pieces(), [&b"heRT"[..], b"A", b"2"]);
    }
}
