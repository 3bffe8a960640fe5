//! The embedded preview is found in both byte orders, at every place where cameras put it, and little else is read.

use std::io::{self, Cursor, Read, Seek, SeekFrom};

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::decode::{Embedded, embedded};

/// A JPEG with one colour above another.
fn jpeg(width: u16, height: u16, [above, below]: [[u8; 3]; 2]) -> Vec<u8> {
    let rows = (0..height).flat_map(|y| (0..width).flat_map(move |_| if y < height / 2 { above } else { below }));
    let mut file = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut file, 90);
    encoder.encode(&rows.collect::<Vec<_>>(), width, height, jpeg_encoder::ColorType::Rgb).unwrap();
    file
}

const COLOURS: [[u8; 3]; 2] = [[200, 40, 40], [30, 60, 180]];

fn number(value: u32, length: usize, little: bool) -> Vec<u8> {
    if little { value.to_le_bytes()[..length].to_vec() } else { value.to_be_bytes()[4 - length..].to_vec() }
}

/// A directory with one value an entry; `next` is the place of the one after it.
fn directory(entries: &[(u16, u32)], next: u32, little: bool) -> Vec<u8> {
    let mut bytes = number(entries.len() as u32, 2, little);
    for (tag, value) in entries {
        bytes.extend(number(u32::from(*tag), 2, little));
        bytes.extend(number(4, 2, little));
        bytes.extend(number(1, 4, little));
        bytes.extend(number(*value, 4, little));
    }
    bytes.extend(number(next, 4, little));
    bytes
}

fn header(little: bool) -> Vec<u8> {
    let mut bytes = if little { b"II*\0".to_vec() } else { b"MM\0*".to_vec() };
    bytes.extend(number(8, 4, little));
    bytes
}

/// A file of 3:2 with so many bytes of samples, its preview behind them in a directory below the first.
fn raw(little: bool, samples: usize, preview: &[u8], by_strip: bool) -> Vec<u8> {
    let count = 4 + 4;
    let below = 8 + 2 + 12 * count + 4;
    let entries = if by_strip { 5 } else { 2 };
    let data = below + 2 + 12 * entries + 4;
    let end = (data + samples) as u32;
    let length = preview.len() as u32;
    let mut file = header(little);
    let whole = [(254, 0), (256, 6000), (257, 4000), (259, 1), (262, 32803), (273, data as u32), (274, 6)];
    let whole = [&whole[..], &[(330, below as u32)]].concat();
    file.extend(directory(&whole, 0, little));
    let strip = [(254, 1), (259, 7), (262, 6), (273, end), (279, length)];
    let pointers = [(513, end), (514, length)];
    file.extend(directory(if by_strip { &strip } else { &pointers }, 0, little));
    assert_eq!(file.len(), data);
    file.resize(data + samples, 0x55);
    file.extend(preview);
    file
}

/// Counts what is read.
struct Counted(Cursor<Vec<u8>>, usize);

impl Read for Counted {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = self.0.read(into)?;
        self.1 += read;
        Ok(read)
    }
}

impl Seek for Counted {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

fn look(file: Vec<u8>, max_side: u32) -> Option<Embedded> {
    embedded(&mut Cursor::new(file), max_side)
}

fn assert_shows(found: &Embedded, size: [u32; 2]) {
    assert_eq!([found.picture.width, found.picture.height], size);
    let row = |y: u32| &found.picture.rgba[(4 * (y * size[0] + size[0] / 2)) as usize..][..3];
    for (y, colour) in [(size[1] / 8, COLOURS[0]), (size[1] - 1 - size[1] / 8, COLOURS[1])] {
        assert!(row(y).iter().zip(colour).all(|(a, b)| a.abs_diff(b) < 12), "{:?} for {colour:?}", row(y));
    }
}

#[test]
fn previews_of_raw_files_are_found_in_both_byte_orders_and_read_alone() {
    let preview = jpeg(960, 640, COLOURS);
    for (little, by_strip) in [(true, true), (true, false), (false, true), (false, false)] {
        let samples = 20_000_000;
        let mut file = Counted(Cursor::new(raw(little, samples, &preview, by_strip)), 0);
        let found = embedded(&mut file, 320).unwrap();
        assert_shows(&found, [320, 213]);
        assert_eq!(found.orientation, 6);
        assert!(file.1 < preview.len() + 100_000, "{} bytes read", file.1);
    }
}

#[test]
fn the_thumbnail_of_a_jpeg_is_found_and_loses_its_bars() {
    for little in [true, false] {
        // 160 x 120 with bars above and below, as cameras of 3:2 write them
        let bars = (0..120u32).flat_map(|y| {
            let colour = if !(7..113).contains(&y) { [0; 3] } else { COLOURS[usize::from(y >= 60)] };
            (0..160).flat_map(move |_| colour)
        });
        let mut thumbnail = Vec::new();
        let encoder = jpeg_encoder::Encoder::new(&mut thumbnail, 90);
        encoder.encode(&bars.collect::<Vec<_>>(), 160, 120, jpeg_encoder::ColorType::Rgb).unwrap();
        let first = directory(&[(274, 3)], 8 + 18, little);
        let second = directory(&[(513, 8 + 18 + 30), (514, thumbnail.len() as u32)], 0, little);
        let block = [b"Exif\0\0".to_vec(), header(little), first, second, thumbnail].concat();
        let whole = jpeg(600, 400, [[0; 3], [255; 3]]);
        let mut file = b"\xff\xd8\xff\xe1".to_vec();
        file.extend((block.len() as u16 + 2).to_be_bytes());
        file.extend(block);
        file.extend(&whole[2..]);
        let found = look(file.clone(), 320).unwrap();
        assert_shows(&found, [160, 107]);
        assert_eq!(found.orientation, 3);
        // Cut and changed anywhere it gives a picture or none.
        for at in (0..file.len()).step_by(7) {
            look(file[..at].to_vec(), 320);
            let mut changed = file.clone();
            changed[at] ^= 0xff;
            look(changed, 320);
        }
    }
}

#[test]
fn the_smallest_that_is_large_enough_is_taken_and_a_damaged_one_passed_over() {
    let sizes = [[160, 106], [640, 426], [1500, 1000]];
    let pictures = sizes.map(|[width, height]| jpeg(width, height, COLOURS));
    let file = |damaged: &[usize]| {
        let mut file = header(true);
        let mut at = 8 + 3 * 30;
        let mut after = Vec::new();
        for (k, picture) in pictures.iter().enumerate() {
            let next = if k < 2 { 8 + 30 * (k as u32 + 1) } else { 0 };
            file.extend(directory(&[(513, at as u32), (514, picture.len() as u32)], next, true));
            at += picture.len();
            let mut picture = picture.clone();
            if damaged.contains(&k) {
                picture[..40].fill(0);
            }
            after.extend(picture);
        }
        file.extend(after);
        file
    };
    for (max_side, damaged, expected) in [
        (320, &[][..], [320, 213]),
        (100, &[], [100, 66]),
        (320, &[1], [320, 213]),
        (320, &[1, 2], [160, 106]),
        (4000, &[], [1500, 1000]),
    ] {
        assert_shows(&look(file(damaged), max_side).unwrap(), expected);
    }
    assert_eq!(look(file(&[0, 1, 2]), 320), None);
}

#[test]
fn pictures_in_the_containers_of_other_makers_are_found() {
    let preview = jpeg(640, 426, COLOURS);
    // Fujifilm: where the JPEG stands is written in the head.
    let mut raf = b"FUJIFILMCCD-RAW ".to_vec();
    raf.resize(84, 0);
    raf.extend([number(160, 4, false), number(preview.len() as u32, 4, false)].concat());
    raf.resize(160, 0);
    raf.extend(&preview);
    assert_shows(&look(raf, 320).unwrap(), [320, 213]);
    // Canon: a box beside the others.
    let block = |kind: &[u8], payload: &[u8]| [&number(payload.len() as u32 + 8, 4, false), kind, payload].concat();
    let identity = b"\xea\xf4\x2b\x5e\x1c\x98\x4b\x88\xb9\xfb\xb7\xdc\x40\x6e\x4d\x16";
    let inner = [&[0; 8][..], &block(b"PRVW", &[&[0; 16][..], &preview].concat())].concat();
    let boxes = [
        block(b"ftyp", b"crx \0\0\0\x01crx isom"),
        block(b"moov", &[1; 300]),
        block(b"uuid", &[&identity[..], &inner].concat()),
        block(b"mdat", &[7; 5000]),
    ];
    assert_shows(&look(boxes.concat(), 320).unwrap(), [320, 213]);
    // Panasonic: the whole JPEG is the value of an entry.
    let mut rw2 = b"IIU\0\x08\0\0\0".to_vec();
    rw2.extend(number(1, 2, true));
    rw2.extend([46, 0, 7, 0]);
    rw2.extend([number(preview.len() as u32, 4, true), number(26, 4, true), number(0, 4, true)].concat());
    rw2.extend(&preview);
    assert_shows(&look(rw2, 320).unwrap(), [320, 213]);
    // Not packed, as converters to DNG leave it.
    let plain: Vec<u8> = (0..90 * 60).flat_map(|k| COLOURS[usize::from(k >= 90 * 30)]).collect();
    let entries = [(254, 1), (256, 90), (257, 60), (258, 8), (259, 1), (262, 2), (273, 8 + 2 + 96 + 4), (277, 3)];
    let file = [header(true), directory(&entries, 0, true), plain].concat();
    assert_shows(&look(file, 320).unwrap(), [90, 60]);
    for other in [&b""[..], b"II*\0", b"hello", &[0xff, 0xd8, 0xff, 0xff, 0xff, 0xff]] {
        assert_eq!(look(other.to_vec(), 320), None);
    }
}
