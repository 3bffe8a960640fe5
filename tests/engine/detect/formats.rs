//! Targets in files of kinds that cameras do not write: BMP, and TIFF with a palette, with every depth and compression; and files that claim
//! more than they hold.

use std::process::Command;

use crate::support::painter::{Canvas, Spot, Uniform};
use sightline::decode::{self, DecodedPhoto, PIXEL_LIMIT};
use sightline::detect::detect_photo;
use sightline::detection::{Channel, DetectOptions};
use sightline::exif;
use sightline::image::Samples;
use tiff::encoder::compression::{CompressionAlgorithm, Deflate, Lzw, Packbits};

/// No multiple of a byte's pixels, nor of what rows are filled up to.
const SIZE: [usize; 2] = [331, 247];

/// A picture as places in a palette of grey levels that do not rise, and the discs in it.
struct Scene {
    spots: Vec<Spot>,
    bits: usize,
    places: Vec<u8>,
    palette: Vec<u8>,
}

/// The k-th colour of a palette is the 5 k + 1-st level: a permutation, as 5 and the count share no divisor.
fn step(k: usize, bits: usize) -> usize {
    (5 * k + 1) % (1 << bits)
}

fn palette(bits: usize) -> Vec<u8> {
    (0..1 << bits).map(|k| (step(k, bits) * 255 / ((1 << bits) - 1)) as u8).collect()
}

/// Discs as a camera sees them, of 8 bits; with fewer as they are drawn, black and white, which are two colours of the palette.
fn scene(bits: usize) -> Scene {
    let mut canvas = Canvas::new(SIZE[0], SIZE[1], 40.0);
    let mut random = Uniform(1);
    let mut spot = |k: usize| {
        let place = |i: usize| 80.0 * i as f64 + 42.0;
        let (u, v) = (place(k % 4) + random.next(), place(k / 4) + random.next());
        let a = random.within(8.0, 16.0);
        Spot { u, v, a, b: a, angle: 0.0, contrast: 170.0 }
    };
    let spots: Vec<Spot> = (0..12).map(&mut spot).collect();
    spots.iter().for_each(|spot| canvas.add(spot, 0.8));
    let Samples::U8(levels) = canvas.expose(1.0, 7).samples else { panic!("8 bits") };
    let place = |level: &u8| {
        let sought = if bits == 8 { usize::from(*level) } else { usize::from(*level > 127) * ((1 << bits) - 1) };
        (0..1 << bits).find(|k| step(*k, bits) == sought).expect("a permutation") as u8
    };
    Scene { spots, bits, places: levels.iter().map(place).collect(), palette: palette(bits) }
}

/// All colours of the palette in no order, and no discs.
fn mixed(bits: usize) -> Scene {
    let mut random = Uniform(3);
    let place = |_| (random.next() * f64::from(1 << bits)) as u8;
    Scene { spots: Vec::new(), bits, places: (0..SIZE[0] * SIZE[1]).map(place).collect(), palette: palette(bits) }
}

impl Scene {
    fn levels(&self) -> Vec<u8> {
        self.places.iter().map(|place| self.palette[usize::from(*place)]).collect()
    }

    /// Rows of places, the first in the highest bits of a byte, each filled up to whole words of `word` bytes.
    fn rows(&self, word: usize) -> Vec<Vec<u8>> {
        let row = |places: &[u8]| {
            let mut row = vec![0u8; (places.len() * self.bits).div_ceil(8).next_multiple_of(word)];
            for (x, place) in places.iter().enumerate() {
                let bit = x * self.bits;
                row[bit / 8] |= place << (8 - self.bits - bit % 8);
            }
            row
        };
        self.places.chunks(SIZE[0]).map(row).collect()
    }

    /// The file is decoded to the scene's levels.
    fn decoded(&self, file: &[u8], name: &str) -> DecodedPhoto {
        let photo = decode::photo(file, Channel::Grey).expect(name);
        assert_eq!([photo.grey.width, photo.grey.height], SIZE, "{name}");
        assert!(photo.grey.samples == Samples::U8(self.levels()), "{name}");
        photo
    }

    /// And all its discs are found where they are, and nothing else.
    fn judge(&self, file: &[u8], name: &str) {
        let photo = self.decoded(file, name);
        let found = detect_photo(&photo, &DetectOptions::default()).expect(name).targets;
        let error = |spot: &Spot| {
            let apart = found.iter().map(|target| (target.u - spot.u).hypot(target.v - spot.v));
            apart.fold(f64::INFINITY, f64::min)
        };
        let worst = self.spots.iter().map(error).fold(0.0, f64::max);
        println!("{name}: {} targets, worst {worst:.3} px", found.len());
        // a rim of whole pixels
        let most = if self.bits == 8 { 0.03 } else { 0.2 };
        assert!(found.len() == 12 && worst < most, "{name}: {} {worst}", found.len());
    }
}

/// A little-endian BMP whose rows begin at the bottom; compression 0 is none, 1 are runs of 8 bits.
fn bmp(bits: usize, compression: u32, palette: &[u8], data: &[u8]) -> Vec<u8> {
    let start = 54 + 4 * palette.len();
    let mut file = b"BM".to_vec();
    for word in [(start + data.len()) as u32, 0, start as u32, 40, SIZE[0] as u32, SIZE[1] as u32] {
        file.extend(word.to_le_bytes());
    }
    file.extend([1, 0, bits as u8, 0]);
    for word in [compression, data.len() as u32, 2835, 2835, palette.len() as u32, 0] {
        file.extend(word.to_le_bytes());
    }
    palette.iter().for_each(|level| file.extend([*level, *level, *level, 0]));
    file.extend(data);
    file
}

/// Lengths and places of equal neighbours.
fn runs(row: &[u8]) -> Vec<u8> {
    let equal = row.chunk_by(|a, b| a == b).flat_map(|run| run.chunks(255));
    equal.flat_map(|run| [run.len() as u8, run[0]]).collect()
}

#[test]
fn discs_are_found_in_bmp() {
    for bits in [1, 4, 8] {
        let file = |scene: &Scene| {
            let data = scene.rows(4).into_iter().rev().flatten().collect::<Vec<_>>();
            bmp(bits, 0, &scene.palette, &data)
        };
        let (scene, mixed, name) = (scene(bits), mixed(bits), format!("BMP of {bits} bits"));
        scene.judge(&file(&scene), &name);
        mixed.decoded(&file(&mixed), &name);
    }
    let scene = scene(8);
    let mut packed: Vec<u8> =
        scene.places.chunks(SIZE[0]).rev().flat_map(|row| [runs(row), vec![0, 0]].concat()).collect();
    packed.extend([0, 1]);
    scene.judge(&bmp(8, 1, &scene.palette, &packed), "BMP of 8 bits in runs");
    for bytes in [3, 4] {
        let mut data = Vec::new();
        for row in scene.levels().chunks(SIZE[0]).rev() {
            row.iter().for_each(|level| data.extend(&[*level, *level, *level, 0][..bytes]));
            data.resize(data.len().next_multiple_of(4), 0);
        }
        scene.judge(&bmp(8 * bytes, 0, &[], &data), &format!("BMP of {} bits", 8 * bytes));
    }
}

/// A little-endian TIFF of one strip with a palette.
fn tiff(scene: &Scene, compression: u16, strip: &[u8]) -> Vec<u8> {
    const COUNT: usize = 9;
    let map = 8 + 2 + 12 * COUNT + 4;
    let [width, height] = SIZE.map(|side| side as u32);
    let entries: [(u16, u16, u32, u32); COUNT] = [
        (256, 4, 1, width),
        (257, 4, 1, height),
        (258, 3, 1, scene.bits as u32),
        (259, 3, 1, compression.into()),
        (262, 3, 1, 3),
        (273, 4, 1, (map + 6 * scene.palette.len()) as u32),
        (278, 4, 1, height),
        (279, 4, 1, strip.len() as u32),
        (320, 3, 3 * scene.palette.len() as u32, map as u32),
    ];
    let mut file = b"II*\0\x08\0\0\0".to_vec();
    file.extend((COUNT as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        file.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        file.extend([count.to_le_bytes(), value.to_le_bytes()].concat());
    }
    file.extend([0; 4]);
    for _ in 0..3 {
        scene.palette.iter().for_each(|level| file.extend((257 * u16::from(*level)).to_le_bytes()));
    }
    file.extend(strip);
    file
}

#[test]
fn discs_are_found_in_tiff_with_a_palette() {
    for bits in [1, 2, 4, 8] {
        for (scene, has_discs) in [(scene(bits), true), (mixed(bits), false)] {
            let rows = scene.rows(1);
            let strip = rows.concat();
            let [mut lzw, mut deflate, mut packbits] = [const { Vec::new() }; 3];
            Lzw.write_to(&mut lzw, &strip).expect("packed");
            Deflate::default().write_to(&mut deflate, &strip).expect("packed");
            // no run goes beyond its row
            for row in &rows {
                Packbits.write_to(&mut packbits, row).expect("packed");
            }
            for (compression, strip) in [(1, &strip), (5, &lzw), (8, &deflate), (32_946, &deflate), (32_773, &packbits)]
            {
                let (file, name) =
                    (tiff(&scene, compression, strip), format!("TIFF of {bits} bits, compression {compression}"));
                if has_discs {
                    scene.judge(&file, &name);
                } else {
                    scene.decoded(&file, &name);
                }
            }
        }
    }
}

/// A chunk of a PNG file.
fn chunk(kind: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let named = [&kind[..], content].concat();
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    let crc = !named.iter().fold(!0u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step));
    [&(content.len() as u32).to_be_bytes()[..], &named, &crc.to_be_bytes()].concat()
}

/// A PNG file with the chunks before its data.
fn png(width: u32, height: u32, [bits, colours]: [u8; 2], before: &[u8], data: &[u8]) -> Vec<u8> {
    let head = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[bits, colours, 0, 0, 0]].concat();
    [b"\x89PNG\r\n\x1a\n", &chunk(b"IHDR", &head)[..], before, &chunk(b"IDAT", data), &chunk(b"IEND", b"")].concat()
}

/// Zeros, deflated to a hundred and sixtieth part: one, and then so many times 258 more (RFC 1951, 3.2.6).
fn zeros(times: u32) -> Vec<u8> {
    let mut packed = vec![0x78, 0x9c];
    let (mut held, mut count) = (0u32, 0);
    let mut put = |value: u32, bits: u32| {
        held |= value << count;
        count += bits;
        while count >= 8 {
            packed.push(held as u8);
            (held, count) = (held >> 8, count - 8);
        }
    };
    // the last block, of fixed codes; the lowest bit of a number comes first, and of a code the highest
    put(0b011, 3);
    put(0b0000_1100, 8);
    for _ in 0..times {
        // length 258, distance 1
        put(0b0_0000_1010_0011, 13);
    }
    // the end of the block, and zeros to the end of a byte
    put(0, 14);
    packed.extend(((((1 + 258 * times) % 65_521) << 16) | 1).to_be_bytes());
    packed
}

/// Nothing is taken on a header's word: neither what a photo says of itself nor its targets cost memory that its bytes do not account for.
///
/// The highest memory of a process is that of all its tests: these files are opened in one of their own.
#[test]
fn small_files_take_little_memory() {
    const ALONE: &str = "SIGHTLINE_TEST_ALONE";
    if std::env::var_os(ALONE).is_none() {
        let name = "detect::formats::small_files_take_little_memory";
        let mut alone = Command::new(std::env::current_exe().expect("this program"));
        let done = alone.args(["--exact", name, "--nocapture"]).env(ALONE, "1").output().expect("a process");
        let said = String::from_utf8_lossy(&done.stdout);
        assert!(done.status.success() && said.contains("1 passed"), "{said}{}", String::from_utf8_lossy(&done.stderr));
        return;
    }
    let info = |file: &[u8]| decode::size(file).map(|size| (size, exif::read(file)));
    let found = |file: &[u8]| {
        decode::photo(file, Channel::Grey).and_then(|photo| detect_photo(&photo, &DetectOptions::default()))
    };
    let scene = scene(8);
    let levels = scene.levels();
    let mut jpeg = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut jpeg, 90);
    encoder.encode(&levels, SIZE[0] as u16, SIZE[1] as u16, jpeg_encoder::ColorType::Luma).expect("a JPEG");
    assert_eq!(found(&jpeg).expect("targets").targets.len(), 12);
    let frame = jpeg.windows(2).position(|marker| marker == b"\xff\xc0").expect("a frame");
    // 15600 rows of 16000 pixels
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x3c, 0xf0, 0x3e, 0x80]);
    jpeg.truncate(2400);
    // four times 16 bits a pixel
    let vast = png(15_800, 15_800, [16, 6], &[], &zeros(0));
    assert!(vast.len() < 100 && 15_800 * 15_800 < PIXEL_LIMIT, "{}", vast.len());
    for file in [&jpeg, &vast] {
        assert_eq!(info(file).expect_err("too much").code(), "broken_image");
        assert_eq!(found(file).expect_err("too much").code(), "broken_image");
    }
    // a profile of 270 MB in 1.7 MB
    let profile = chunk(b"iCCP", &[b"name\0\0", &zeros(1 << 20)[..]].concat());
    let mut data = Vec::new();
    let rows: Vec<u8> = levels.chunks(SIZE[0]).flat_map(|row| [&[0], row].concat()).collect();
    Deflate::default().write_to(&mut data, &rows).expect("deflated");
    let file = png(SIZE[0] as u32, SIZE[1] as u32, [8, 0], &profile, &data);
    assert_eq!(info(&file).map(|(size, _)| [size.width, size.height]), Ok(SIZE.map(|side| side as u32)));
    scene.judge(&file, "PNG with a profile");
    let Ok(status) = std::fs::read_to_string("/proc/self/status") else { return println!("memory is not told here") };
    let highest = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
    let highest = highest.and_then(|number| number.parse::<u64>().ok()).expect("a number");
    println!("highest memory {highest} kB");
    assert!(highest < 150_000, "{highest} kB");
}
