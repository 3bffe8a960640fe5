//! Progressive JPEG: the coefficients from all scans, then the samples of luma (T.81, annex G).

use super::bits::Bits;
use super::frame::{Scan, Tables};
use super::huffman::{BadCode, Table};
use super::scan::{Content, LARGEST_DIRECT, Planes, walk};
use super::transform::{self, CoefficientBlock, PLACES};

/// Data of a component for the scan of DC coefficients.
struct Direct<'a> {
    component: usize,
    /// Its blocks in a row of a unit of all components; those of a unit of the scan.
    stride: usize,
    blocks: [usize; 2],
    /// `None` if the scan refines: its bits are not coded.
    table: Option<&'a Table>,
    step: u16,
    previous: i32,
}

impl Planes {
    /// One scan; where the next segment may begin.
    pub(super) fn progressive(&mut self, bytes: &[u8], at: usize, scan: &Scan, tables: &Tables) -> usize {
        let wanted = scan.parts.iter().any(|part| self.wants(part.component));
        let direct = scan.band[0] == 0;
        if !wanted && (!direct || scan.bits[0] > 0) {
            return at;
        }
        let units = match &scan.parts[..] {
            [part] => self.frame.blocks_alone(part.component),
            _ => self.frame.units(),
        };
        let mut whole = vec![true; units[1]];
        let end = if direct {
            self.direct_scan(bytes, at, scan, tables, units, &mut whole)
        } else {
            self.alternating_scan(bytes, at, scan, tables, units, &mut whole)
        };
        for part in scan.parts.iter().filter(|_| wanted) {
            let finest = &mut self.finest[part.component][scan.band[0]..=scan.band[1]];
            // refined is what a scan before it has left
            let follows = scan.bits[0] == 0 || finest.iter().all(|bits| *bits == scan.bits[0]);
            finest.fill(scan.bits[1]);
            if end.is_none() || !follows {
                self.spoil();
            }
        }
        if self.steps.is_none() && scan.parts.iter().any(|part| part.component == 0) {
            self.steps = tables.steps[self.frame.components[0].steps];
        }
        self.note(scan, &whole);
        end.unwrap_or(at)
    }

    /// The first direct coefficients, of which chroma's are its means, and the bits that refine them.
    fn direct_scan(
        &mut self,
        bytes: &[u8],
        at: usize,
        scan: &Scan,
        tables: &Tables,
        units: [usize; 2],
        whole: &mut [bool],
    ) -> Option<usize> {
        let alone = scan.parts.len() == 1;
        let read = |part: &super::frame::ScanComponent| {
            let component = &self.frame.components[part.component];
            let table = if scan.bits[0] == 0 { Some(tables.direct[part.direct].as_ref()?) } else { None };
            let blocks = if alone { [1, 1] } else { component.blocks };
            let step = tables.steps[component.steps]?[0];
            Some(Direct { component: part.component, stride: component.blocks[0], blocks, table, step, previous: 0 })
        };
        let mut parts = scan.parts.iter().map(read).collect::<Option<Vec<_>>>()?;
        let (across, low) = (self.frame.units()[0], scan.bits[1]);
        Some(walk(bytes, at, units, tables.restart, whole, |bits, place, anew| {
            for part in &mut parts {
                if anew {
                    part.previous = 0;
                }
                for k in 0..part.blocks[0] * part.blocks[1] {
                    let at = [
                        place[0] * part.blocks[0] + k % part.blocks[0],
                        place[1] * part.blocks[1] + k / part.blocks[0],
                    ];
                    let value = match part.table {
                        Some(table) => {
                            part.previous += table.direct(bits)?;
                            // no more than a block's coefficients take, and no more than its samples do
                            let value = i32::from(i16::try_from(part.previous << low).map_err(|_| BadCode)?);
                            let step = i32::from(part.step);
                            if (value * step).abs() > LARGEST_DIRECT + (step << low) {
                                return Err(BadCode);
                            }
                            value
                        }
                        None => i32::from(bits.bit()) << low,
                    };
                    let from = 64 * (at[1] * across * part.stride + at[0]);
                    match self.coefficients.get_mut(part.component) {
                        Some(coefficients) => *coefficients.get_mut(from).ok_or(BadCode)? |= value as i16,
                        None if part.table.is_some() => {
                            self.set_mean(part.component, at, transform::mean(value, part.step));
                        }
                        None => {}
                    }
                }
            }
            Ok(Content::Flat)
        }))
    }

    fn alternating_scan(
        &mut self,
        bytes: &[u8],
        at: usize,
        scan: &Scan,
        tables: &Tables,
        units: [usize; 2],
        whole: &mut [bool],
    ) -> Option<usize> {
        let part = scan.parts.first()?;
        let table = tables.alternating[part.alternating].as_ref()?;
        let stride = self.stride(part.component);
        let coefficients = self.coefficients.get_mut(part.component)?;
        let mut run = 0;
        Some(walk(bytes, at, units, tables.restart, whole, |bits, place, anew| {
            if anew {
                run = 0;
            }
            let from = 64 * (place[1] * stride + place[0]);
            let block = coefficients.get_mut(from..from + 64).ok_or(BadCode)?;
            // blocks without new coefficients are what many of these scans are made of
            if scan.bits[0] == 0 {
                first(bits, table, scan, block, &mut run)
            } else {
                refine(bits, table, scan, block, &mut run)
            }
        }))
    }

    /// Blocks of a component in a row of units.
    fn stride(&self, component: usize) -> usize {
        self.frame.units()[0] * self.frame.components[component].blocks[0]
    }

    /// Samples of luma from the coefficients.
    pub(super) fn develop(&mut self) {
        let Some(steps) = self.steps else { return };
        let weights = transform::weights(&steps);
        let [across, down] = self.frame.blocks_alone(0);
        let (stride, coefficients) = (self.stride(0), std::mem::take(&mut self.coefficients[0]));
        for y in 0..down {
            for (x, coefficients) in coefficients[64 * y * stride..].chunks_exact(64).take(across).enumerate() {
                if coefficients[1..].iter().all(|c| *c == 0) {
                    self.put([x, y], &[transform::mean(coefficients[0].into(), steps[0]); 64]);
                    continue;
                }
                let mut block: CoefficientBlock = [0.0; 80];
                for (coefficient, place) in coefficients.iter().zip(PLACES) {
                    let place = usize::from(place);
                    block[place] = f32::from(*coefficient) * weights[place];
                }
                self.put([x, y], &transform::samples(&block));
            }
        }
    }
}

/// The first bits of a block's band (T.81, G.1.2.2); `run` counts blocks that have nothing more in it.
fn first(bits: &mut Bits, table: &Table, scan: &Scan, block: &mut [i16], run: &mut u32) -> Result<Content, BadCode> {
    let mut content = Content::Flat;
    if *run > 0 {
        *run -= 1;
        return Ok(content);
    }
    let mut at = scan.band[0];
    while at <= scan.band[1] {
        let symbol = table.symbol(bits)?;
        let (zeros, size) = (usize::from(symbol >> 4), u32::from(symbol & 15));
        match (size, zeros) {
            (0, 15) => at += 16,
            (0, _) => {
                *run = (1 << zeros) - 1 + bits.unsigned(zeros as u32);
                return Ok(content);
            }
            _ => {
                bits.refill();
                at += zeros;
                *block.get_mut(at).ok_or(BadCode)? = (bits.signed(size) << scan.bits[1]) as i16;
                at += 1;
                content = Content::Structure;
            }
        }
    }
    if at > 64 { Err(BadCode) } else { Ok(content) }
}

/// One more bit of a block's band (T.81, G.1.2.3): of what is there already, and what becomes something with it.
fn refine(bits: &mut Bits, table: &Table, scan: &Scan, block: &mut [i16], run: &mut u32) -> Result<Content, BadCode> {
    let bit = 1i16 << scan.bits[1];
    let mut content = Content::Flat;
    let mut at = scan.band[0];
    while *run == 0 && at <= scan.band[1] {
        let symbol = table.symbol(bits)?;
        let mut zeros = usize::from(symbol >> 4);
        let new = match symbol & 15 {
            0 if zeros < 15 => {
                *run = (1 << zeros) + bits.unsigned(zeros as u32);
                break;
            }
            0 => 0,
            1 => {
                if bits.bit() {
                    bit
                } else {
                    -bit
                }
            }
            _ => return Err(BadCode),
        };
        loop {
            let Some(coefficient) = block.get_mut(at).filter(|_| at <= scan.band[1]) else {
                // zeros up to the end of the band are no more than there are
                return if new == 0 { Ok(content) } else { Err(BadCode) };
            };
            if *coefficient != 0 {
                correct(bits, coefficient, bit);
            } else if zeros == 0 {
                if new != 0 {
                    *coefficient = new;
                    content = Content::Structure;
                }
                at += 1;
                break;
            } else {
                zeros -= 1;
            }
            at += 1;
        }
    }
    if *run > 0 {
        *run -= 1;
        for coefficient in block.iter_mut().take(scan.band[1] + 1).skip(at).filter(|c| **c != 0) {
            correct(bits, coefficient, bit);
        }
    }
    Ok(content)
}

/// Takes one bit more of a coefficient, away from zero.
fn correct(bits: &mut Bits, coefficient: &mut i16, bit: i16) {
    if bits.bit() && *coefficient & bit == 0 {
        *coefficient = coefficient.saturating_add(if *coefficient > 0 { bit } else { -bit });
    }
}
