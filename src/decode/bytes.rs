//! Just enough of the TIFF, PNG and JPEG containers to know what is in a file before a decoder is let loose on it.

/// Numbers of a TIFF file in its byte order, at the first directory.
pub struct Reader<'a> {
    bytes: &'a [u8],
    little: bool,
    big_tiff: bool,
}

impl<'a> Reader<'a> {
    /// A reader of a TIFF or BigTIFF file; none where the header is neither.
    pub fn tiff(bytes: &'a [u8]) -> Option<Self> {
        let little = match bytes.get(..2)? {
            b"II" => true,
            b"MM" => false,
            _ => return None,
        };
        let mut reader = Self { bytes, little, big_tiff: false };
        reader.big_tiff = reader.number(2, 2)? == 43;
        Some(reader)
    }

    fn number(&self, offset: usize, length: usize) -> Option<u64> {
        let bytes = self.bytes.get(offset..offset.checked_add(length)?)?;
        let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        Some(if self.little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) })
    }

    /// Tag and first value of every entry of the first directory whose value stands in the entry itself; other
    /// entries report their offset. Stops where the file does.
    pub fn entries(&self) -> Vec<(u16, u32)> {
        let (start_at, width, count_width, size) = if self.big_tiff { (8, 8, 8, 20) } else { (4, 4, 2, 12) };
        let mut entries = Vec::new();
        let inside = |n: u64| usize::try_from(n).ok().filter(|n| *n < self.bytes.len());
        let Some(start) = self.number(start_at, width).and_then(inside) else { return entries };
        let Some(count) = self.number(start, count_width) else { return entries };
        for index in 0..count.min(1000) as usize {
            let at = start + count_width + index * size;
            let (Some(tag), Some(kind)) = (self.number(at, 2), self.number(at + 2, 2)) else { break };
            let length = match kind {
                3 => 2,
                1 | 2 | 6 | 7 => 1,
                _ => 4,
            };
            let Some(value) = self.number(at + 4 + width, length) else { break };
            entries.push((tag as u16, value as u32));
        }
        entries
    }
}

/// Width and height of a PNG file as its header chunk states them.
///
/// The decoder itself refuses rows that a 32-bit machine cannot address before it tells the size.
pub fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    (bytes.get(12..16)? == b"IHDR").then_some(())?;
    Some((number(16)?, number(20)?))
}

/// Whether a JPEG file reaches its end marker.
///
/// Decoders fill what is missing with grey, which would be measured. Segments are stepped over by their lengths, so
/// that the end marker of an embedded preview does not count.
pub fn jpeg_is_complete(bytes: &[u8]) -> bool {
    let mut at = 2;
    loop {
        while bytes.get(at) == Some(&0xff) && bytes.get(at + 1) == Some(&0xff) {
            at += 1;
        }
        match (bytes.get(at), bytes.get(at + 1)) {
            (Some(0xff), Some(0xd9)) => return true,
            // Markers without a length: TEM, RSTn; and stuffed zeros of the entropy-coded data.
            (Some(0xff), Some(0x00 | 0x01 | 0xd0..=0xd7)) => at += 2,
            (Some(0xff), Some(_)) => {
                let (Some(high), Some(low)) = (bytes.get(at + 2), bytes.get(at + 3)) else { return false };
                at += 2 + usize::from(u16::from_be_bytes([*high, *low])).max(2);
            }
            (Some(0xff), None) | (None, _) => return false,
            // Entropy-coded data up to the next 0xff.
            (Some(_), _) => match bytes[at..].iter().position(|b| *b == 0xff) {
                Some(step) => at += step,
                None => return false,
            },
        }
    }
}
