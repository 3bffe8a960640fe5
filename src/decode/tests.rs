use image::{DynamicImage, GrayAlphaImage, ImageBuffer, ImageFormat, Luma, Rgb, RgbImage};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;

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
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tiff] {
        let bytes = encoded(&photo, format);
        for end in (16..bytes.len() - bytes.len() / 20).step_by(31) {
            let error = grey(&bytes[..end], Channel::Grey).expect_err("a cut file");
            assert_eq!(error.code(), "broken_image", "{format:?} cut at {end} of {}: {error}", bytes.len());
        }
    }
}

#[test]
fn the_end_of_an_embedded_preview_is_not_the_end_of_the_photo() {
    let photo = encoded(&coloured(), ImageFormat::Jpeg);
    let preview = encoded(&coloured(), ImageFormat::Jpeg);
    let mut bytes = photo[..2].to_vec();
    bytes.extend(b"\xff\xe2");
    bytes.extend((preview.len() as u16 + 2).to_be_bytes());
    bytes.extend(&preview);
    bytes.extend(&photo[2..photo.len() - 8]);
    assert_eq!(grey(&bytes, Channel::Grey).expect_err("a cut file").code(), "broken_image");
    bytes.extend(&photo[photo.len() - 8..]);
    assert!(grey(&bytes, Channel::Grey).is_ok());
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
    assert!(matches!(&heic, Error::UnknownImageFormat { recognised: Some(name), .. } if name == "HEIC"));
    let text = size(b"1,2,3\n").expect_err("text");
    assert!(matches!(text, Error::UnknownImageFormat { recognised: None, .. }));
    let float: DynamicImage = ImageBuffer::from_pixel(2, 2, Rgb([0.5f32, 0.5, 0.5])).into();
    assert_eq!(
        grey(&encoded(&float, ImageFormat::Tiff), Channel::Grey).expect_err("float").code(),
        "unknown_image_format"
    );
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
