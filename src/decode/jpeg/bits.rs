//! The entropy-coded bits of a JPEG scan.

/// Reads bits, most significant first; stuffed zeros after 0xff are left out, and a marker or the end of the file ends the data.
pub struct Bits<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Bits not yet taken, from the top.
    window: u64,
    /// How many bits of the window count.
    count: u32,
    /// How many of the last ones were made up because the data had ended.
    invented: u32,
}

impl<'a> Bits<'a> {
    /// Data from a place in the file on.
    pub fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at, window: 0, count: 0, invented: 0 }
    }

    /// Sees to it that 32 bits can be examined and taken.
    #[inline(always)]
    pub fn refill(&mut self) {
        if self.count >= 32 {
            return;
        }
        if let Some(word) = self.bytes.get(self.at..self.at + 4) {
            let word = u32::from_be_bytes([word[0], word[1], word[2], word[3]]);
            let inverse = !word;
            // no byte of the inverse is 0: no byte is 0xff
            if inverse.wrapping_sub(0x0101_0101) & word & 0x8080_8080 == 0 {
                self.window |= u64::from(word) << (32 - self.count);
                self.count += 32;
                self.at += 4;
                return;
            }
        }
        self.refill_bytewise();
    }

    #[inline(never)]
    fn refill_bytewise(&mut self) {
        while self.count <= 56 {
            let byte = match (self.bytes.get(self.at), self.bytes.get(self.at + 1)) {
                (Some(0xff), Some(0)) => {
                    self.at += 2;
                    0xff
                }
                (Some(0xff), _) | (None, _) => {
                    self.invented += 8;
                    0
                }
                (Some(byte), _) => {
                    self.at += 1;
                    *byte
                }
            };
            self.window |= u64::from(byte) << (56 - self.count);
            self.count += 8;
        }
    }

    /// The next `n` bits, 1 to 32, without taking them.
    #[inline(always)]
    pub fn peek(&self, n: u32) -> u32 {
        (self.window >> (64 - n)) as u32
    }

    /// Takes `n` bits.
    #[inline(always)]
    pub fn take(&mut self, n: u32) {
        self.window <<= n;
        self.count = self.count.wrapping_sub(n);
    }

    /// Takes a number of `size` bits, 1 to 15, in which a leading 0 means negative (T.81, F.2.2.1).
    #[inline(always)]
    pub fn signed(&mut self, size: u32) -> i32 {
        let value = self.peek(size) as i32;
        self.take(size);
        if value < 1 << (size - 1) { value - (1 << size) + 1 } else { value }
    }

    /// Takes one bit.
    pub fn bit(&mut self) -> bool {
        self.refill();
        let bit = self.peek(1) == 1;
        self.take(1);
        bit
    }

    /// Takes a number of `size` bits, 0 to 15.
    pub fn unsigned(&mut self, size: u32) -> u32 {
        self.refill();
        let value = if size == 0 { 0 } else { self.peek(size) };
        self.take(size);
        value
    }

    /// Whether more bits were taken than there were.
    #[inline(always)]
    pub fn overrun(&self) -> bool {
        self.count < self.invented
    }

    /// Place of the first byte of which no bit was taken, at the earliest: stuffed zeros in the window count as bits do.
    pub fn position(&self) -> usize {
        self.at.saturating_sub((self.count.saturating_sub(self.invented) / 8) as usize)
    }
}
