//! Huffman tables of JPEG (T.81, annexes C and F), looked up by the next bits.

use super::bits::Bits;

/// Bits that are looked up at once.
const LOOK: u32 = 10;
const SIZE: usize = 1 << LOOK;

/// A code that is none, or coefficients beyond the block's end.
pub struct BadCode;

/// One table, for direct or alternating coefficients.
#[derive(Clone)]
pub struct Table {
    /// By the next bits: value (16 bits), size (4), run (4) and length (8). With a value, the length covers code and value; with
    /// none it is the code's alone, and `size` bits of the value follow; 0: the code is longer than the lookup.
    steps: Box<[u32; SIZE]>,
    /// By the next bits: what several codes do together: coefficients passed (16 bits), whether the block ends (8), length (8).
    leaps: Box<[u32; SIZE]>,
    /// Per length: the first code beyond those of the length, its bits moved to the top of 16.
    limits: [u32; 17],
    /// Per length: what has to be added to a code to have the place of its symbol.
    offsets: [i32; 17],
    symbols: Vec<u8>,
}

impl Table {
    /// A table from its numbers of codes of each length 1..=16 and its symbols; `None` if these are no code.
    pub fn new(counts: &[u8; 16], symbols: &[u8]) -> Option<Self> {
        let mut table = Self {
            steps: Box::new([0; SIZE]),
            leaps: Box::new([0; SIZE]),
            limits: [0; 17],
            offsets: [0; 17],
            symbols: symbols.to_vec(),
        };
        let (mut code, mut place) = (0u32, 0usize);
        for length in 1..=16u32 {
            let count = usize::from(counts[length as usize - 1]);
            table.offsets[length as usize] = place as i32 - code as i32;
            for symbol in symbols.get(place..place + count)? {
                if code >> length != 0 {
                    return None;
                }
                if length <= LOOK {
                    table.enter(code, length, *symbol);
                }
                code += 1;
            }
            if code > 1 << length {
                return None;
            }
            place += count;
            table.limits[length as usize] = code << (16 - length);
            code <<= 1;
        }
        table.chain();
        Some(table)
    }

    /// Fills the places whose first bits are a code.
    fn enter(&mut self, code: u32, length: u32, symbol: u8) {
        let (run, size) = (u32::from(symbol >> 4), u32::from(symbol & 15));
        let spare = LOOK - length;
        for rest in 0..1u32 << spare {
            let at = (code << spare | rest) as usize;
            self.steps[at] = if size > 0 && size <= spare {
                let value = (rest >> (spare - size)) as i32;
                let value = if value < 1 << (size - 1) { value - (1 << size) + 1 } else { value };
                (value as u32) << 16 | size << 12 | run << 8 | (length + size)
            } else {
                size << 12 | run << 8 | length
            };
        }
    }

    /// Follows codes one after the other as far as their bits are known: what has to be passed needs no values.
    fn chain(&mut self) {
        for at in 0..SIZE {
            let (mut taken, mut passed, mut ends) = (0, 0, false);
            while taken < LOOK && !ends {
                let step = self.steps[at << taken & (SIZE - 1)];
                let (has_value, size, run) = (step >> 16 != 0, step >> 12 & 15, step >> 8 & 15);
                let code = (step & 255) - if has_value { size } else { 0 };
                if step == 0 || code > LOOK - taken {
                    break;
                }
                taken += code + size;
                match (size, run) {
                    (0, 15) => passed += 16,
                    (0, _) => ends = true,
                    _ => passed += run + 1,
                }
            }
            self.leaps[at] = if taken > 32 { 0 } else { passed << 16 | u32::from(ends) << 8 | taken };
        }
    }

    /// Run (upper half) and size of the next code.
    #[inline(always)]
    pub fn symbol(&self, bits: &mut Bits) -> Result<u8, BadCode> {
        bits.refill();
        let step = self.steps[bits.peek(LOOK) as usize];
        if step == 0 {
            return self.long_symbol(bits);
        }
        let (size, run) = (step >> 12 & 15, step >> 8 & 15);
        bits.take((step & 255) - if step >> 16 != 0 { size } else { 0 });
        Ok((run << 4 | size) as u8)
    }

    /// The same for a code that is longer than the lookup.
    #[inline(never)]
    fn long_symbol(&self, bits: &mut Bits) -> Result<u8, BadCode> {
        bits.refill();
        let next = bits.peek(16);
        let length = (1..=16).find(|length| next < self.limits[*length]).ok_or(BadCode)?;
        let place = (next >> (16 - length)) as i32 + self.offsets[length];
        let symbol = usize::try_from(place).ok().and_then(|place| self.symbols.get(place)).ok_or(BadCode)?;
        bits.take(length as u32);
        Ok(*symbol)
    }

    /// Difference of a direct coefficient.
    #[inline(always)]
    pub fn direct(&self, bits: &mut Bits) -> Result<i32, BadCode> {
        bits.refill();
        let step = self.steps[bits.peek(LOOK) as usize];
        if step >> 16 != 0 {
            bits.take(step & 255);
            return Ok((step as i32) >> 16);
        }
        let size = if step != 0 {
            bits.take(step & 255);
            step >> 12 & 15
        } else {
            u32::from(self.long_symbol(bits)?)
        };
        match size {
            0 => Ok(0),
            1..=15 => Ok(bits.signed(size)),
            _ => Err(BadCode),
        }
    }

    /// Alternating coefficients of a sequential block: `put(place in zigzag order, value)`; the number of the last, 0 for none.
    #[inline(always)]
    pub fn alternating(&self, bits: &mut Bits, mut put: impl FnMut(usize, i32)) -> Result<usize, BadCode> {
        let (mut at, mut last) = (1, 0);
        while at < 64 {
            bits.refill();
            let mut step = self.steps[bits.peek(LOOK) as usize];
            if step >> 16 != 0 {
                bits.take(step & 255);
                last = at + (step >> 8 & 15) as usize;
                put(last, (step as i32) >> 16);
                at = last + 1;
                continue;
            }
            if step == 0 {
                step = u32::from(self.long_symbol(bits)?);
                step = (step & 15) << 12 | (step >> 4) << 8;
            } else {
                bits.take(step & 255);
            }
            let (size, run) = (step >> 12 & 15, (step >> 8 & 15) as usize);
            match (size, run) {
                (0, 15) => at += 16,
                (0, _) => return Ok(last),
                _ => {
                    bits.refill();
                    last = at + run;
                    put(last, bits.signed(size));
                    at = last + 1;
                }
            }
        }
        if at > 64 { Err(BadCode) } else { Ok(last) }
    }

    /// Passes the alternating coefficients of a sequential block; whether there are any.
    #[inline(always)]
    pub fn pass(&self, bits: &mut Bits) -> Result<bool, BadCode> {
        let mut at = 1;
        while at < 64 {
            bits.refill();
            let leap = self.leaps[bits.peek(LOOK) as usize];
            if leap != 0 && at + (leap >> 16) < 64 {
                bits.take(leap & 255);
                at += leap >> 16;
                if leap & 0x100 != 0 {
                    return Ok(at > 1);
                }
                continue;
            }
            let symbol = u32::from(self.symbol(bits)?);
            match (symbol & 15, symbol >> 4) {
                (0, 15) => at += 16,
                (0, _) => return Ok(at > 1),
                (size, run) => {
                    bits.refill();
                    bits.take(size);
                    at += run + 1;
                }
            }
        }
        if at > 64 { Err(BadCode) } else { Ok(true) }
    }
}
