//! Variants of JPEG: the luma plane that was written is read back.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use jpeg_encoder::{ColorType, Encoder, ImageBuffer, JpegColorType, SamplingFactor};

use super::super::jpeg::{self, Refusal};
use super::*;
use crate::error::PictureKind;

/// Smooth fields with noise, in colour.
pub fn planes(width: u16, height: u16) -> [Vec<u8>; 3] {
    let mut state = 7u32;
    let mut noise = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 16) / 65536.0 * 24.0 - 12.0
    };
    let mut plane = |phase: f64, size: f64| {
        let mut at = |k: usize| {
            let (x, y) = ((k % usize::from(width)) as f64, (k / usize::from(width)) as f64);
            128.0 + size * ((x / 9.0 + phase).sin() * (y / 7.0 - phase).cos()) + noise()
        };
        (0..usize::from(width) * usize::from(height)).map(|k| at(k) as u8).collect()
    };
    [plane(0.0, 100.0), plane(1.0, 60.0), plane(2.0, 60.0)]
}

/// Planes that are luma and colour differences already.
struct Planes<'a>(u16, u16, &'a [Vec<u8>; 3]);

impl ImageBuffer for Planes<'_> {
    fn get_jpeg_color_type(&self) -> JpegColorType {
        JpegColorType::Ycbcr
    }

    fn width(&self) -> u16 {
        self.0
    }

    fn height(&self) -> u16 {
        self.1
    }

    fn fill_buffers(&self, y: u16, buffers: &mut [Vec<u8>; 4]) {
        let row = usize::from(y) * usize::from(self.0);
        for (buffer, plane) in buffers.iter_mut().zip(self.2) {
            buffer.extend(&plane[row..row + usize::from(self.0)]);
        }
    }
}

/// How a file is written.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub sampling: SamplingFactor,
    pub progressive: bool,
    pub restart: u16,
    pub quality: u8,
}

pub fn written(width: u16, height: u16, planes: &[Vec<u8>; 3], kind: Kind) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, kind.quality);
    encoder.set_sampling_factor(kind.sampling);
    encoder.set_progressive(kind.progressive);
    encoder.set_restart_interval(kind.restart);
    encoder.encode_image(Planes(width, height, planes)).expect("encodable");
    file
}

#[test]
fn the_luma_plane_is_the_one_that_was_written() {
    let samplings = [
        SamplingFactor::R_4_4_4,
        SamplingFactor::R_4_2_2,
        SamplingFactor::R_4_2_0,
        SamplingFactor::R_4_4_0,
        SamplingFactor::R_4_1_1,
        SamplingFactor::R_4_1_0,
    ];
    for sampling in samplings {
        for (progressive, restart) in [(false, 0), (false, 3), (true, 0), (true, 2)] {
            for (width, height) in [(64, 48), (61, 43), (7, 5)] {
                let kind = Kind { sampling, progressive, restart, quality: 100 };
                let planes = planes(width, height);
                let photo = photo(&written(width, height, &planes, kind), Channel::Grey).unwrap();
                assert!(photo.damaged_rows.is_empty(), "{kind:?}: {:?}", photo.damaged_rows);
                let Samples::U8(samples) = &photo.grey.samples else { panic!("8 bits expected") };
                // steps of 1: what remains is the rounding of 64 coefficients, 0.29 rms each
                let differences = samples.iter().zip(&planes[0]).map(|(a, b)| f64::from(*a) - f64::from(*b));
                let squares = differences.clone().map(|d| d * d).sum::<f64>() / samples.len() as f64;
                let largest = differences.fold(0.0, |most: f64, d| most.max(d.abs()));
                assert!(squares.sqrt() < 0.5 && largest <= 2.0, "{kind:?} {width}: {} {largest}", squares.sqrt());
            }
        }
    }
}

pub fn from_hex(digits: &str) -> Vec<u8> {
    (0..digits.len() / 2).map(|k| u8::from_str_radix(&digits[2 * k..2 * k + 2], 16).expect("two digits")).collect()
}

/// 40 x 24 pixels in ten scans, with successive approximation, of 128 + 90 sin(x/5) cos(y/4).
const REFINED: &str = "ffd8ffe000104a46494600010100000100010000ffdb004300080606070605080707070909080a0c140d0c0b0b0c1912130f141d1a1f1e1d1a1c1c20242e2720222c231c1c2837292c30313434341f27393d38323c2e333432ffdb0043010909090c0b0c180d0d1832211c213232323232323232323232323232323232323232323232323232323232323232323232323232323232323232323232323232ffc20011080018002803012200021101031101ffc400190001000301010000000000000000000000000104060205ffc40017010101010100000000000000000000000003000204ffda000c03010002100310000001bdd6678d9d969a5eaecc1af6e4e21ae1eb01afffc400191000030101010000000000000000000000010203040013ffda000801010001050295c4c53407158173281433b841a19818331682a9175502ecc08cfebc72f9f1d3e7c34fa70cbe9dffc400161101010100000000000000000000000000001112ffda0008010301013f01d34d2aabffc400161101010100000000000000000000000000000201ffda0008010201013f0194b12963ffc400161001010100000000000000000000000000210020ffda0008010100063f02c93311afffc4001810010101010100000000000000000000000100113121ffda0008010100013f21c02d961b5416a92cf2c8e08866398a675641ef2e3db8f6e9cbffda000c030100020003000000102fbce30c3fffc400161101010100000000000000000000000000001110ffda0008010301013f10d14a53ffc400161101010100000000000000000000000000103100ffda0008010201013f100848dfffc40017100101010100000000000000000000000001110041ffda0008010100013f10282264246e4ee6e0ae2632626124cbcc38997b91816772302ce63e4cb8c5d5c64c4cce6267775710babbffd9";

#[test]
fn successive_approximation_ends_at_the_last_bit() {
    let file = from_hex(REFINED);
    let photo = photo(&file, Channel::Grey).unwrap();
    assert_eq!((photo.grey.width, photo.grey.height), (40, 24));
    let Samples::U8(samples) = &photo.grey.samples else { panic!("8 bits expected") };
    let level = |k: usize| 128.0 + 90.0 * ((k % 40) as f64 / 5.0).sin() * ((k / 40) as f64 / 4.0).cos();
    let mean = samples.iter().enumerate().map(|(k, s)| (f64::from(*s) - level(k)).abs()).sum::<f64>() / 960.0;
    // libjpeg's own decoding of it is 1.22 away; with the last scan missing it is beyond 2
    assert!(mean < 1.6, "{mean}");
    // what the last scan of luma would still refine is not whole
    let last = file.windows(2).rposition(|w| w == b"\xff\xc4").expect("tables");
    assert_eq!(super::super::photo(&file[..last], Channel::Grey).expect_err("cut").code(), "broken_image");
}

#[test]
fn red_green_and_blue_as_stored_are_not_taken_for_luma() {
    let [red, green, blue] = planes(48, 32);
    let pixels = (0..48 * 32).flat_map(|k| [red[k], green[k], blue[k]]).collect::<Vec<_>>();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, 100);
    encoder.set_sampling_factor(SamplingFactor::R_4_4_4);
    encoder.encode(&pixels, 48, 32, ColorType::Rgb).expect("encodable");
    let photo = grey(&file, Channel::Red).unwrap();
    let Samples::U8(samples) = &photo.samples else { panic!("8 bits expected") };
    assert!(samples.iter().zip(&red).all(|(a, b)| a.abs_diff(*b) <= 4));
    // the same planes, named R, G, B instead of converted
    let kind = Kind { sampling: SamplingFactor::R_4_4_4, progressive: false, restart: 0, quality: 100 };
    let mut stored = written(48, 32, &[red.clone(), green.clone(), blue.clone()], kind);
    without_jfif(&mut stored);
    rename(&mut stored, *b"RGB");
    for (channel, plane) in [(Channel::Red, &red), (Channel::Green, &green), (Channel::Blue, &blue)] {
        let Samples::U8(samples) = grey(&stored, channel).unwrap().samples else { panic!("8 bits expected") };
        assert!(samples.iter().zip(plane).all(|(a, b)| a.abs_diff(*b) <= 3), "{channel:?}");
    }
    let Samples::U8(samples) = grey(&stored, Channel::Grey).unwrap().samples else { panic!("8 bits expected") };
    for (k, sample) in samples.iter().enumerate() {
        let level = luminance([red[k], green[k], blue[k]].map(f64::from));
        assert!((f64::from(*sample) - level).abs() <= 3.0);
    }
}

/// Takes the JFIF segment away, by which three components are luma and colour differences.
fn without_jfif(file: &mut Vec<u8>) {
    let length = usize::from(u16::from_be_bytes([file[4], file[5]]));
    assert_eq!(file[2..4], *b"\xff\xe0");
    file.drain(2..4 + length);
}

/// Gives the components other names, in frame and scan.
fn rename(file: &mut [u8], names: [u8; 3]) {
    let frame = file.windows(2).position(|w| w == b"\xff\xc0").expect("a frame");
    let scan = file.windows(2).position(|w| w == b"\xff\xda").expect("a scan");
    for (k, name) in names.into_iter().enumerate() {
        file[frame + 10 + 3 * k] = name;
        file[scan + 5 + 2 * k] = name;
    }
}

#[test]
fn inks_are_read_as_their_luminance() {
    let pixels = (0..32 * 16u32).flat_map(|k| [(k % 32 * 8) as u8, 40, 60, 10]).collect::<Vec<_>>();
    let mut file = Vec::new();
    Encoder::new(&mut file, 95).encode(&pixels, 32, 16, ColorType::Cmyk).expect("encodable");
    let photo = grey(&file, Channel::Grey).unwrap();
    assert_eq!((photo.width, photo.height), (32, 16));
}

#[test]
fn kinds_that_are_not_read_are_named() {
    let kind = Kind { sampling: SamplingFactor::R_4_2_0, progressive: false, restart: 0, quality: 90 };
    let file = written(32, 16, &planes(32, 16), kind);
    let frame = file.windows(2).position(|w| w == b"\xff\xc0").expect("a frame");
    for (marker, name) in [
        (0xc3, "lossless JPEG"),
        (0xc5, "hierarchical JPEG"),
        (0xc9, "JPEG with arithmetic coding"),
        (0xca, "JPEG with arithmetic coding"),
    ] {
        let mut other = file.clone();
        other[frame + 1] = marker;
        for error in [size(&other).expect_err(name), grey(&other, Channel::Green).expect_err(name)] {
            assert!(error.to_string().starts_with(&format!("this is a {name} file")), "{error}");
        }
    }
    let mut deep = file.clone();
    deep[frame + 4] = 12;
    assert_eq!(jpeg::luma(&deep).err(), Some(Refusal::Kind(PictureKind::TwelveBitJpeg)));
    let mut later = file;
    later[frame + 5..frame + 7].fill(0);
    assert!(matches!(jpeg::luma(&later).err(), Some(Refusal::Kind(_))));
}

#[test]
fn frames_of_films_are_read_without_their_codes() {
    let kind = Kind { sampling: SamplingFactor::R_4_2_2, progressive: false, restart: 0, quality: 90 };
    let file = written(64, 48, &planes(64, 48), kind);
    let mut bare = Vec::new();
    let mut at = 0;
    // without the segments of codes, which are the usual ones
    while let Some(step) = file[at..].windows(2).position(|w| w == b"\xff\xc4") {
        bare.extend(&file[at..at + step]);
        at += step + 2 + usize::from(u16::from_be_bytes([file[at + step + 2], file[at + step + 3]]));
    }
    bare.extend(&file[at..]);
    bare[6..11].copy_from_slice(b"AVI1\0");
    assert_eq!(photo(&bare, Channel::Grey), photo(&file, Channel::Grey));
    // and their damage is named as that of other files
    let cut = photo(&bare[..bare.len() * 2 / 3], Channel::Grey).unwrap();
    assert!(matches!(cut.damaged_rows[..], [[8..=32, 48]]), "{:?}", cut.damaged_rows);
}
