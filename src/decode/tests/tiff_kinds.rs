//! TIFF files as many programs write them: every layout of samples is read to the last one or refused with a code, and of several
//! pictures the one of full resolution is read.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;

/// Pseudo-random numbers, xorshift.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % n
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len() as u64) as usize]
    }
}

/// How a picture lies in its file.
#[derive(Clone, Copy, Debug)]
struct Layout {
    width: usize,
    height: usize,
    bits: usize,
    samples: usize,
    planar: bool,
    /// Size of a tile; none: strips of so many rows.
    tile: Option<[usize; 2]>,
    rows: usize,
    reduced: u64,
}

/// Level of a sample.
fn level(layout: &Layout, x: usize, y: usize, sample: usize) -> u64 {
    let value = (x * 7 + y * 31 + sample * 101 + layout.width) as u64;
    if layout.bits == 8 { value % 251 } else { value * 97 % 65521 }
}

struct Writer {
    file: Vec<u8>,
    little: bool,
    big: bool,
}

impl Writer {
    fn new(little: bool, big: bool) -> Self {
        let mut writer = Self { file: Vec::new(), little, big };
        writer.file.extend(if little { b"II" } else { b"MM" });
        writer.put(if big { 43 } else { 42 }, 2);
        if big {
            writer.put(8, 2);
            writer.put(0, 2);
        }
        writer.put(0, writer.width());
        writer
    }

    fn width(&self) -> usize {
        if self.big { 8 } else { 4 }
    }

    fn put(&mut self, number: u64, width: usize) {
        let bytes = number.to_le_bytes();
        if self.little {
            self.file.extend(&bytes[..width]);
        } else {
            self.file.extend(bytes[..width].iter().rev());
        }
    }

    fn overwrite(&mut self, at: usize, number: u64) {
        let tail = self.file.split_off(at);
        self.put(number, self.width());
        let width = self.width();
        self.file.extend(&tail[width..]);
    }

    /// Samples, then the directory with `more` entries; its place, and that of its pointer to the next one.
    fn picture(&mut self, layout: &Layout, more: &[(u16, u64)]) -> (u64, usize) {
        let Layout { width, height, bits, samples, planar, tile, rows, reduced } = *layout;
        let (planes, together) = if planar { (samples, 1) } else { (1, samples) };
        let [across, down] = tile.unwrap_or([width, rows]);
        let (mut offsets, mut counts) = (Vec::new(), Vec::new());
        for plane in 0..planes {
            for top in (0..height).step_by(down) {
                for left in (0..width).step_by(across) {
                    let start = self.file.len();
                    offsets.push(start as u64);
                    let bottom = if tile.is_some() { top + down } else { (top + down).min(height) };
                    for y in top..bottom {
                        for x in left..left + across {
                            for sample in 0..together {
                                let inside = x < width && y < height;
                                let value = if inside { level(layout, x, y, plane + sample) } else { 0 };
                                self.put(value, bits / 8);
                            }
                        }
                    }
                    counts.push((self.file.len() - start) as u64);
                }
            }
        }
        let colours = if samples >= 3 { 3 } else { 1 };
        let mut entries: Vec<(u16, u16, Vec<u64>)> = vec![
            (254, 4, vec![reduced]),
            (256, 4, vec![width as u64]),
            (257, 4, vec![height as u64]),
            (258, 3, vec![bits as u64; samples]),
            (259, 3, vec![1]),
            (262, 3, vec![if colours == 3 { 2 } else { 1 }]),
            (277, 3, vec![samples as u64]),
            (284, 3, vec![if planar { 2 } else { 1 }]),
        ];
        if samples > colours {
            entries.push((338, 3, vec![2; samples - colours]));
        }
        match tile {
            Some([across, down]) => entries.extend([
                (322, 4, vec![across as u64]),
                (323, 4, vec![down as u64]),
                (324, 4, offsets),
                (325, 4, counts),
            ]),
            None => entries.extend([(273, 4, offsets), (278, 4, vec![rows as u64]), (279, 4, counts)]),
        }
        entries.extend(more.iter().map(|(tag, value)| (*tag, 4, vec![*value])));
        entries.sort_by_key(|entry| entry.0);
        let placed: Vec<(u16, u16, usize, Vec<u8>)> = entries
            .into_iter()
            .map(|(tag, kind, values)| {
                let size = if kind == 3 { 2 } else { 4 };
                let mut bytes = Self { file: Vec::new(), little: self.little, big: self.big };
                values.iter().for_each(|value| bytes.put(*value, size));
                let mut bytes = bytes.file;
                if bytes.len() <= self.width() {
                    bytes.resize(self.width(), 0);
                } else {
                    let at = self.file.len() as u64;
                    self.file.extend(bytes);
                    let mut pointer = Self { file: Vec::new(), little: self.little, big: self.big };
                    pointer.put(at, self.width());
                    bytes = pointer.file;
                }
                (tag, kind, values.len(), bytes)
            })
            .collect();
        let start = self.file.len() as u64;
        self.put(placed.len() as u64, if self.big { 8 } else { 2 });
        for (tag, kind, count, bytes) in placed {
            self.put(tag.into(), 2);
            self.put(kind.into(), 2);
            self.put(count as u64, self.width());
            self.file.extend(bytes);
        }
        let next = self.file.len();
        self.put(0, self.width());
        (start, next)
    }

    fn first(&mut self, start: u64) {
        self.overwrite(if self.big { 8 } else { 4 }, start);
    }
}

fn random_layout(random: &mut Random) -> Layout {
    let side = [1, 2, 15, 16, 17, 31, 33, 40, 64];
    let height = random.of(&side);
    Layout {
        width: random.of(&side),
        height,
        bits: random.of(&[8, 16]),
        samples: random.of(&[1, 2, 3, 3, 4]),
        planar: random.below(2) == 0,
        tile: (random.below(2) == 0).then(|| [random.of(&[16, 32, 48]), random.of(&[16, 32, 64])]),
        rows: 1 + random.below(height as u64) as usize,
        reduced: 0,
    }
}

fn check(layout: &Layout, photo: &Grey, channel: usize) {
    assert_eq!((photo.width, photo.height), (layout.width, layout.height), "{layout:?}");
    let sample = if layout.samples >= 3 { channel } else { 0 };
    for y in 0..layout.height {
        for x in 0..layout.width {
            let at = y * layout.width + x;
            let found = match &photo.samples {
                Samples::U8(samples) => u64::from(samples[at]),
                Samples::U16(samples) => u64::from(samples[at]),
            };
            assert_eq!(found, level(layout, x, y, sample), "{layout:?} at {x}, {y}");
        }
    }
}

#[test]
fn every_layout_is_read_to_the_last_sample() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for _ in 0..400 {
        let layout = random_layout(&mut random);
        let mut writer = Writer::new(random.below(2) == 0, random.below(4) == 0);
        let (start, _) = writer.picture(&layout, &[]);
        writer.first(start);
        for (k, channel) in [Channel::Red, Channel::Green, Channel::Blue].into_iter().enumerate() {
            let read = match photo(&writer.file, channel) {
                // Grey with opacity, interleaved, is a kind that the decoder does not know.
                Err(Error::UnknownImageFormat { .. }) if layout.samples == 2 && !layout.planar => continue,
                read => read.unwrap_or_else(|error| panic!("{error} {layout:?}")),
            };
            assert_eq!(read.page, None);
            check(&layout, &read.grey, k);
        }
        let Ok(found) = size(&writer.file) else { continue };
        assert_eq!(
            [found.width as usize, found.height as usize, found.bits as usize],
            [layout.width, layout.height, layout.bits]
        );
        picture(&writer.file, Some(8)).unwrap();
    }
}

#[test]
fn the_page_of_full_resolution_is_read_and_told() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..200 {
        let whole = Layout { samples: random.of(&[1, 3, 4]), ..random_layout(&mut random) };
        let mut writer = Writer::new(random.below(2) == 0, random.below(4) == 0);
        // Reduced copies and masks before the picture, some more pages after it.
        let copies = 1 + random.below(3) as usize;
        let mut pages = Vec::new();
        for k in 0..copies {
            let thumbnail = Layout { reduced: [1, 4, 5][k % 3], ..random_layout(&mut random) };
            pages.push(writer.picture(&thumbnail, &[]));
        }
        pages.push(writer.picture(&whole, &[]));
        for _ in 0..random.below(3) {
            let other = random_layout(&mut random);
            pages.push(writer.picture(&other, &[]));
        }
        writer.first(pages[0].0);
        for pair in pages.clone().windows(2) {
            writer.overwrite(pair[0].1, pair[1].0);
        }
        let read = photo(&writer.file, Channel::Red).unwrap_or_else(|error| panic!("{error} {whole:?}"));
        check(&whole, &read.grey, 0);
        let page = read.page.expect("several pictures");
        assert_eq!((page.number, page.of, page.skipped), (copies + 1, pages.len(), copies));
        let found = size(&writer.file).unwrap();
        assert_eq!([found.width as usize, found.height as usize], [whole.width, whole.height]);
    }
}

#[test]
fn damaged_directories_are_an_error_and_no_panic() {
    let mut random = Random(77);
    for _ in 0..500 {
        let layout = random_layout(&mut random);
        let mut writer = Writer::new(random.below(2) == 0, random.below(4) == 0);
        let thumbnail = Layout { reduced: 1, ..random_layout(&mut random) };
        let first = writer.picture(&thumbnail, &[]);
        let second = writer.picture(&layout, &[(330, first.0)]);
        writer.first(first.0);
        // A ring of directories ends too.
        writer.overwrite(first.1, second.0);
        writer.overwrite(second.1, first.0);
        let length = writer.file.len() as u64;
        for _ in 0..1 + random.below(4) {
            // The directories are at the end of each picture: damage hits them as often as the samples.
            let at =
                if random.below(2) == 0 { second.0 + random.below(length - second.0) } else { random.below(length) };
            writer.file[at as usize] = random.below(256) as u8;
        }
        if random.below(8) == 0 {
            writer.file.truncate(random.below(length) as usize);
        }
        let _ = photo(&writer.file, Channel::Green);
        let _ = size(&writer.file);
    }
}
