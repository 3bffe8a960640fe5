use std::io::Cursor;

use image::{DynamicImage, GrayAlphaImage, ImageBuffer, ImageFormat, Luma, Rgb, RgbImage};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;

mod damage;
mod embedded_pictures;
mod jpeg_kinds;
mod tiff_kinds;

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    image.write_to(&mut file, format).expect("encodable");
    file.into_inner()
}

fn coloured() -> DynamicImage {
    RgbImage::from_fn(7, 5, |x, y| Rgb([(x * 30) as u8, (y * 50) as u8, 200])).into()
}

fn grey_16() -> DynamicImage {
    ImageBuffer::from_fn(6, 4, |x, y| Luma([(x * 1000 + y * 7) as u16])).into()
}

#[test]
fn lossless_formats_give_every_sample_back() {
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        let bytes = encoded(&coloured(), format);
        let red = grey(&bytes, Channel::Red).unwrap();
        let Samples::U8(samples) = &red.samples else { panic!("8 bits expected") };
        assert_eq!((red.width, red.height), (7, 5));
        assert!((0..35).all(|i| usize::from(samples[i]) == i % 7 * 30), "{format:?}: {samples:?}");
        assert_eq!(size(&bytes).unwrap(), Size { width: 7, height: 5, bits: 8 });

        let bytes = encoded(&grey_16(), format);
        let deep = grey(&bytes, Channel::Blue).unwrap();
        let Samples::U16(samples) = &deep.samples else { panic!("16 bits expected") };
        assert!((0..24).all(|i| usize::from(samples[i]) == i % 6 * 1000 + i / 6 * 7), "{format:?}: {samples:?}");
        assert_eq!(size(&bytes).unwrap().bits, 16);
    }
}

#[test]
fn luminance_is_rounded_once() {
    let Samples::U8(samples) = grey(&encoded(&coloured(), ImageFormat::Png), Channel::Grey).unwrap().samples else {
        panic!("8 bits expected")
    };
    for (i, sample) in samples.iter().enumerate() {
        let exact = 0.2126 * (i % 7 * 30) as f64 + 0.7152 * (i / 7 * 50) as f64 + 0.0722 * 200.0;
        assert!((f64::from(*sample) - exact).abs() <= 0.5, "{sample} for {exact}");
    }
}

#[test]
fn opacity_is_ignored() {
    let image = GrayAlphaImage::from_fn(3, 2, |x, _| image::LumaA([x as u8 * 10, 7]));
    let read = grey(&encoded(&image.into(), ImageFormat::Png), Channel::Green).unwrap();
    assert_eq!(read.samples, Samples::U8(vec![0, 10, 20, 0, 10, 20]));
}

#[test]
fn jpeg_is_read_within_its_loss() {
    let smooth: DynamicImage = RgbImage::from_fn(64, 48, |x, y| Rgb([x as u8 * 3, y as u8 * 3, 90])).into();
    let Samples::U8(samples) = grey(&encoded(&smooth, ImageFormat::Jpeg), Channel::Green).unwrap().samples else {
        panic!("8 bits expected")
    };
    assert!(samples.iter().enumerate().all(|(i, s)| (i32::from(*s) - (i / 64 * 3) as i32).abs() < 16));
}

#[test]
fn cut_files_are_broken_wherever_they_are_cut() {
    let photo: DynamicImage = RgbImage::from_fn(64, 48, |x, y| Rgb([(x * y) as u8, (x ^ y) as u8, y as u8])).into();
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::Bmp] {
        let bytes = encoded(&photo, format);
        // two letters and a size make a BMP
        let start = if format == ImageFormat::Bmp { 30 } else { 16 };
        for end in (start..bytes.len() - bytes.len() / 20).step_by(31) {
            let error = grey(&bytes[..end], Channel::Grey).expect_err("a cut file");
            assert_eq!(error.code(), "broken_image", "{format:?} cut at {end} of {}: {error}", bytes.len());
        }
    }
}

#[test]
fn bmp_is_read_as_png_is() {
    let (bmp, png) = (encoded(&coloured(), ImageFormat::Bmp), encoded(&coloured(), ImageFormat::Png));
    assert_eq!(size(&bmp).unwrap(), size(&png).unwrap());
    for channel in [Channel::Grey, Channel::Red, Channel::Green, Channel::Blue] {
        assert_eq!(grey(&bmp, channel).unwrap(), grey(&png, channel).unwrap());
    }
}

/// A TIFF file of one strip whose samples are places in a palette.
fn palette_tiff(width: u16, height: u16, bits: u16, samples: &[u8], palette: &[[u16; 3]]) -> Vec<u8> {
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    let (map_at, samples_at) = (8 + 2 + 12 * 9 + 4, 8 + 2 + 12 * 9 + 4 + 6 * palette.len());
    let entries = [
        (256, 3, 1, u32::from(width)),
        (257, 3, 1, u32::from(height)),
        (258, 3, 1, u32::from(bits)),
        (259, 3, 1, 1),
        (262, 3, 1, 3),
        (273, 4, 1, samples_at as u32),
        (278, 3, 1, u32::from(height)),
        (279, 4, 1, samples.len() as u32),
        (320, 3, 3 * palette.len() as u32, map_at as u32),
    ];
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend((tag as u16).to_le_bytes());
        bytes.extend((kind as u16).to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    for channel in 0..3 {
        palette.iter().for_each(|colour| bytes.extend(colour[channel].to_le_bytes()));
    }
    bytes.extend(samples);
    bytes
}

#[test]
fn the_palette_of_a_tiff_is_resolved() {
    let palette = (0..16u16).map(|k| [k * 4096, 65535 - k * 4096, k * 257]).collect::<Vec<_>>();
    // five pixels a row: the last half byte is padding
    let nibbles = [0x01, 0x23, 0x40, 0xfe, 0xdc, 0xb0];
    let places = [[0u16, 1, 2, 3, 4], [15, 14, 13, 12, 11]].concat();
    let bytes = palette_tiff(5, 2, 4, &nibbles, &palette);
    assert_eq!(size(&bytes).unwrap(), Size { width: 5, height: 2, bits: 8 });
    for (channel, c) in [(Channel::Red, 0), (Channel::Green, 1), (Channel::Blue, 2)] {
        let expected = places.iter().map(|k| (palette[usize::from(*k)][c] >> 8) as u8).collect();
        assert_eq!(grey(&bytes, channel).unwrap().samples, Samples::U8(expected));
    }
    let whole = (0..256u16).map(|k| [k * 257; 3]).collect::<Vec<_>>();
    let bytes = palette_tiff(3, 2, 8, &[0, 50, 100, 150, 200, 255], &whole);
    assert_eq!(grey(&bytes, Channel::Grey).unwrap().samples, Samples::U8(vec![0, 50, 100, 150, 200, 255]));
}

#[test]
fn a_picture_that_claims_to_be_huge_is_refused_before_allocation() {
    let mut bytes = encoded(&coloured(), ImageFormat::Png);
    // Width and height of the header chunk, and its checksum.
    bytes[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let crc = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    let error = grey(&bytes, Channel::Grey).expect_err("too large");
    assert!(matches!(error, Error::ImageSize { width: 65536, height: 65536, limit: PIXEL_LIMIT, .. }), "{error:?}");
}

/// The checksum of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

#[test]
fn unread_formats_say_what_they_are() {
    let heic = grey(b"\0\0\0\x18ftypheic\0\0\0\0", Channel::Grey).expect_err("HEIC");
    assert!(matches!(&heic, Error::UnknownImageFormat { recognised: Some(kind), .. } if kind.to_string() == "HEIC"));
    let text = size(b"1,2,3\n").expect_err("text");
    assert!(matches!(text, Error::UnknownImageFormat { recognised: None, .. }));
    let float: DynamicImage = ImageBuffer::from_pixel(2, 2, Rgb([0.5f32, 0.5, 0.5])).into();
    let float = grey(&encoded(&float, ImageFormat::Tiff), Channel::Grey).expect_err("float");
    assert!(float.to_string().starts_with("this is a picture of floating-point samples file"), "{float}");
}

#[test]
fn pictures_for_showing_are_reduced_and_stretched() {
    let shown = picture(&encoded(&coloured(), ImageFormat::Png), None).unwrap();
    assert_eq!((shown.width, shown.height, &shown.rgba[4..8]), (7, 5, &[30, 0, 200, 255][..]));
    let small = picture(&encoded(&coloured(), ImageFormat::Png), Some(4)).unwrap();
    assert_eq!((small.width, small.height, small.rgba.len()), (4, 3, 48));
    let deep = picture(&encoded(&grey_16(), ImageFormat::Tiff), None).unwrap();
    assert_eq!(deep.rgba.iter().step_by(4).max(), Some(&255));
}

#[test]
fn one_decoding_gives_the_samples_and_the_small_picture() {
    let photo: DynamicImage =
        RgbImage::from_fn(
            160,
            96,
            |x, y| if (x / 40 + y / 48) % 2 == 0 { Rgb([200, 30, 40]) } else { Rgb([20, 90, 180]) },
        )
        .into();
    for format in [ImageFormat::Png, ImageFormat::Jpeg] {
        let bytes = encoded(&photo, format);
        for channel in [Channel::Grey, Channel::Green] {
            let (samples, small) = photo_and_picture(&bytes, channel, 40).unwrap();
            assert_eq!(samples.grey, grey(&bytes, channel).unwrap());
            assert_eq!((small.width, small.height), (40, 24));
            let reduced = picture(&bytes, Some(40)).unwrap();
            // away from the borders of the fields, which blocks of chroma straddle
            for (x, y) in [(5, 5), (15, 5), (25, 18), (35, 18)] {
                let at = 4 * (y * 40 + x);
                let both = small.rgba[at..at + 4].iter().zip(&reduced.rgba[at..at + 4]);
                assert!(both.clone().all(|(a, b)| a.abs_diff(*b) <= 4), "{format:?} {channel:?} {x} {y}: {both:?}");
            }
        }
    }
}
