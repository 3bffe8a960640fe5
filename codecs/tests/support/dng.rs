//! Writes DNG files (Adobe's specification 1.4): one strip of a mosaic, packed bits or lossless JPEG (ITU-T T.81, process 14).

/// Tag, type, count and value.
type Entry = (u16, u16, u32, Vec<u8>);

/// A directory that stands at a place of the file, with what does not fit into its entries after it.
fn directory(entries: &[Entry], at: usize) -> Vec<u8> {
    let after = at + 2 + 12 * entries.len() + 4;
    let mut table = (entries.len() as u16).to_le_bytes().to_vec();
    let mut data = Vec::new();
    for (tag, kind, count, value) in entries {
        table.extend(tag.to_le_bytes());
        table.extend(kind.to_le_bytes());
        table.extend(count.to_le_bytes());
        let mut value = value.clone();
        if value.len() <= 4 {
            value.resize(4, 0);
            table.extend(value);
        } else {
            table.extend(((after + data.len()) as u32).to_le_bytes());
            data.extend(value);
            data.resize(data.len().next_multiple_of(2), 0);
        }
    }
    table.extend([0; 4]);
    table.extend(data);
    table
}

/// A mosaic to be written.
#[derive(Clone, Debug)]
pub struct Dng {
    pub width: usize,
    pub height: usize,
    pub bits: u32,
    /// "RGGB", "GRBG" …
    pub pattern: &'static str,
    pub black: u32,
    pub white: u32,
    /// Top, left, bottom, right.
    pub active_area: [u32; 4],
    pub samples: Vec<u16>,
    pub lossless_jpeg: bool,
    /// OpcodeList3, as it is stored.
    pub opcodes: Vec<u8>,
    pub orientation: u16,
    /// A baseline JPEG that shows the same; none where empty.
    pub preview: Vec<u8>,
}

impl Dng {
    /// The file, little-endian.
    pub fn file(&self) -> Vec<u8> {
        let strip = if self.lossless_jpeg { self.jpeg() } else { self.packed() };
        let colours: Vec<u8> =
            self.pattern.bytes().map(|c| b"RGB".iter().position(|k| *k == c).unwrap() as u8).collect();
        let long = |values: &[u32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
        let short = |values: &[u16]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
        let text = |text: &str| [text.as_bytes(), b"\0"].concat();
        let matrix: Vec<u8> = [1i32, 0, 0, 0, 1, 0, 0, 0, 1]
            .iter()
            .flat_map(|v| [v.to_le_bytes(), 1i32.to_le_bytes()].concat())
            .collect();
        let neutral: Vec<u8> = (0..3).flat_map(|_| [1u32.to_le_bytes(), 1u32.to_le_bytes()].concat()).collect();
        let (width, height) = (self.width as u32, self.height as u32);
        let mut entries: Vec<Entry> = vec![
            (254, 4, 1, long(&[0])),
            (256, 4, 1, long(&[width])),
            (257, 4, 1, long(&[height])),
            (258, 3, 1, short(&[self.bits as u16])),
            (259, 3, 1, short(&[if self.lossless_jpeg { 7 } else { 1 }])),
            (262, 3, 1, short(&[32803])),
            (271, 2, 6, text("Maker")),
            (272, 2, 6, text("Model")),
            (273, 4, 1, long(&[0])),
            (274, 3, 1, short(&[self.orientation])),
            (277, 3, 1, short(&[1])),
            (278, 4, 1, long(&[height])),
            (279, 4, 1, long(&[strip.len() as u32])),
            (284, 3, 1, short(&[1])),
            (306, 2, 20, text("2026:02:03 04:05:06")),
            (330, 4, 1, long(&[0])),
            (33421, 3, 2, short(&[2, 2])),
            (33422, 1, 4, colours),
            (50706, 1, 4, vec![1, 4, 0, 0]),
            (50707, 1, 4, vec![1, 1, 0, 0]),
            (50708, 2, 12, text("Maker Model")),
            (50714, 4, 1, long(&[self.black])),
            (50717, 4, 1, long(&[self.white])),
            (50721, 10, 9, matrix),
            (50728, 5, 3, neutral),
            (50778, 3, 1, short(&[21])),
            (50829, 4, 4, long(&self.active_area)),
        ];
        if !self.opcodes.is_empty() {
            entries.push((51022, 7, self.opcodes.len() as u32, self.opcodes.clone()));
        }
        if self.preview.is_empty() {
            entries.retain(|entry| entry.0 != 330);
        }
        let mut set = |tag: u16, value: usize| {
            entries.iter_mut().find(|entry| entry.0 == tag).unwrap().3 = long(&[value as u32]);
            directory(&entries, 8)
        };
        let mut file = b"II*\0\x08\0\0\0".to_vec();
        if self.preview.is_empty() {
            let length = set(273, 0).len();
            file.extend(set(273, 8 + length));
            return [file, strip].concat();
        }
        let second = 8 + set(273, 0).len();
        set(330, second);
        let picture = |at: usize| {
            let side = |at: usize| u32::from(u16::from_be_bytes([self.preview[at], self.preview[at + 1]]));
            // the frame's header of a baseline JPEG
            let frame = self.preview.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
            let entries: Vec<Entry> = vec![
                (254, 4, 1, long(&[1])),
                (256, 4, 1, long(&[side(frame + 7)])),
                (257, 4, 1, long(&[side(frame + 5)])),
                (258, 3, 3, short(&[8, 8, 8])),
                (259, 3, 1, short(&[7])),
                (262, 3, 1, short(&[6])),
                (273, 4, 1, long(&[at as u32])),
                (277, 3, 1, short(&[3])),
                (278, 4, 1, long(&[side(frame + 5)])),
                (279, 4, 1, long(&[self.preview.len() as u32])),
            ];
            directory(&entries, second)
        };
        let first = second + picture(0).len();
        file.extend(set(273, first + self.preview.len()));
        file.extend(picture(first));
        [file, self.preview.clone(), strip].concat()
    }

    /// Bits one after the other, the highest first, every row from a new byte; 16 bits as words.
    fn packed(&self) -> Vec<u8> {
        if self.bits == 16 {
            return self.samples.iter().flat_map(|sample| sample.to_le_bytes()).collect();
        }
        let mut bytes = Vec::new();
        for row in self.samples.chunks(self.width) {
            let mut bits = Bits::default();
            row.iter().for_each(|sample| bits.put(u32::from(*sample), self.bits));
            bytes.extend(bits.finish(false));
        }
        bytes
    }

    /// Two components, the even and the odd columns, so that a sample is predicted by one of its own colour; those of the first two
    /// columns by the ones above.
    fn jpeg(&self) -> Vec<u8> {
        assert!(self.width.is_multiple_of(2), "pairs of columns");
        let mut file = vec![0xff, 0xd8];
        // a Huffman table of 17 codes of five bits
        file.extend([0xff, 0xc4, 0, 36, 0, 0, 0, 0, 0, 17, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        file.extend(0..17u8);
        file.extend([0xff, 0xc3, 0, 14, self.bits as u8]);
        file.extend((self.height as u16).to_be_bytes());
        file.extend((self.width as u16 / 2).to_be_bytes());
        file.extend([2, 1, 0x11, 0, 2, 0x11, 0]);
        file.extend([0xff, 0xda, 0, 10, 2, 1, 0, 2, 0, 1, 0, 0]);
        let mut bits = Bits::default();
        for (y, row) in self.samples.chunks(self.width).enumerate() {
            for (x, sample) in row.iter().enumerate() {
                let before = match (x, y) {
                    (0 | 1, 0) => 1 << (self.bits - 1),
                    (0 | 1, _) => i32::from(self.samples[(y - 1) * self.width + x]),
                    _ => i32::from(row[x - 2]),
                };
                let difference = i32::from(*sample) - before;
                let size = 32 - difference.unsigned_abs().leading_zeros();
                bits.put(size, 5);
                let low = if difference < 0 { difference - 1 } else { difference };
                bits.put(low as u32 & ((1u32 << size) - 1), size);
            }
        }
        file.extend(bits.finish(true));
        file.extend([0xff, 0xd9]);
        file
    }
}

#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    held: u64,
    count: u32,
}

impl Bits {
    fn put(&mut self, value: u32, count: u32) {
        self.held = self.held << count | u64::from(value);
        self.count += count;
        while self.count >= 8 {
            self.count -= 8;
            self.bytes.push((self.held >> self.count) as u8);
        }
    }

    /// With ones to the end of the last byte, and zeros after bytes of ones where `stuffed`.
    fn finish(mut self, stuffed: bool) -> Vec<u8> {
        if self.count > 0 {
            let fill = 8 - self.count;
            self.put((1 << fill) - 1, fill);
        }
        if !stuffed {
            return self.bytes;
        }
        self.bytes.iter().flat_map(|byte| if *byte == 0xff { vec![0xff, 0] } else { vec![*byte] }).collect()
    }
}
