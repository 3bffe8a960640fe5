//! Damaged and hostile files: intact rows are returned, damaged rows are named, and headers are not trusted.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use jpeg_encoder::{ColorType, Encoder, SamplingFactor};

use super::jpeg_kinds::{Kind, from_hex, planes, written};
use super::*;

const SIZE: (u16, u16) = (160, 256);

fn sample(progressive: bool, restart: u16) -> Vec<u8> {
    sampled(SamplingFactor::R_4_2_0, progressive, restart)
}

fn sampled(sampling: SamplingFactor, progressive: bool, restart: u16) -> Vec<u8> {
    written(SIZE.0, SIZE.1, &planes(SIZE.0, SIZE.1), Kind { sampling, progressive, restart, quality: 85 })
}

fn grey_sample(progressive: bool, restart: u16) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, 85);
    encoder.set_progressive(progressive);
    encoder.set_restart_interval(restart);
    encoder.encode(&planes(SIZE.0, SIZE.1)[0], SIZE.0, SIZE.1, ColorType::Luma).expect("encodable");
    file
}

/// Grey alone; colours with chroma of full and of less size, in one scan; a scan a plane, which 4:1:1 is written in; each of these
/// progressive, and with restart markers.
fn kinds() -> Vec<(String, Vec<u8>)> {
    let mut kinds = Vec::new();
    for (progressive, restart) in [(false, 0), (false, 10), (true, 0), (true, 10)] {
        let name = |sampling: &str| format!("{sampling}, progressive {progressive}, restart {restart}");
        kinds.push((name("grey"), grey_sample(progressive, restart)));
        for sampling in [SamplingFactor::R_4_4_4, SamplingFactor::R_4_2_0, SamplingFactor::R_4_1_1] {
            kinds.push((name(&format!("{sampling:?}")), sampled(sampling, progressive, restart)));
        }
    }
    kinds
}

fn first_scan(file: &[u8]) -> usize {
    file.windows(2).position(|w| w == b"\xff\xda").expect("a scan")
}

fn rows(photo: &DecodedPhoto) -> Vec<&[u8]> {
    let Samples::U8(samples) = &photo.grey.samples else { panic!("8 bits expected") };
    samples.chunks(photo.grey.width).collect()
}

fn is_damaged(photo: &DecodedPhoto, row: usize) -> bool {
    photo.damaged_rows.iter().any(|[first, last]| (*first as usize..*last as usize).contains(&row))
}

/// Rows reported as intact that are not, and intact rows.
fn wrong_and_whole(photo: &DecodedPhoto, truth: &DecodedPhoto) -> (usize, usize) {
    let (got, expected) = (rows(photo), rows(truth));
    let whole = (0..got.len()).filter(|row| !is_damaged(photo, *row)).collect::<Vec<_>>();
    (whole.iter().filter(|row| got[**row] != expected[**row]).count(), whole.len())
}

#[test]
fn a_file_that_ends_early_gives_the_rows_before() {
    for (name, file) in kinds() {
        for channel in [Channel::Grey, Channel::Green] {
            let truth = photo(&file, channel).unwrap();
            let mut before = 0;
            for end in (first_scan(&file)..file.len() - 2).step_by(97) {
                match photo(&file[..end], channel) {
                    Ok(photo) => {
                        let (wrong, whole) = wrong_and_whole(&photo, &truth);
                        assert!(wrong == 0 && whole >= before, "{name} {channel:?} cut at {end}: {wrong} of {whole}");
                        before = whole;
                    }
                    Err(error) => {
                        assert!(
                            error.code() == "broken_image" && before == 0,
                            "{name} {channel:?} cut at {end}: {error}"
                        );
                    }
                }
            }
            // of several scans a general decoder gives nothing that is sure
            let several = !name.starts_with("grey") && (name.contains("4_1_1") || name.contains("progressive true"));
            let least = if channel == Channel::Green && several { 0 } else { usize::from(SIZE.1) * 9 / 10 - 16 };
            assert!(before >= least, "{name} {channel:?}: {before} rows of {}", SIZE.1);
        }
    }
}

#[test]
fn the_end_marker_alone_is_not_missed() {
    let file = sample(false, 0);
    assert_eq!(grey(&file[..file.len() - 2], Channel::Grey), grey(&file, Channel::Grey));
}

#[test]
fn half_a_photo_with_an_end_marker_is_still_half() {
    let file = sample(false, 0);
    let truth = photo(&file, Channel::Grey).unwrap();
    let mut half = file[..file.len() / 2].to_vec();
    half.extend(b"\xff\xd9");
    let photo = photo(&half, Channel::Grey).unwrap();
    let (wrong, whole) = wrong_and_whole(&photo, &truth);
    assert!(wrong == 0 && whole > 64, "{wrong} of {whole}");
}

#[test]
fn lost_sectors_are_found() {
    let mut random = 11u32;
    for (name, file) in kinds() {
        let scan = first_scan(&file);
        for channel in [Channel::Grey, Channel::Green] {
            let truth = photo(&file, channel).unwrap();
            let mut measured = 0;
            for filling in [0u8, 0x55, 0xff] {
                for _ in 0..12 {
                    random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    let at = scan + 600 + (random >> 8) as usize % (file.len() - scan - 1200);
                    let mut holed = file.clone();
                    holed[at..at + 512].fill(filling);
                    match photo(&holed, channel) {
                        Ok(photo) => {
                            measured += 1;
                            let (wrong, _) = wrong_and_whole(&photo, &truth);
                            assert_eq!(wrong, 0, "{name} {channel:?} {filling} at {at}: {:?}", photo.damaged_rows);
                            // of grey a hole in chroma takes nothing
                            let missing = photo.grey != truth.grey || channel == Channel::Green;
                            assert_eq!(photo.damaged_rows.is_empty(), !missing, "{name} {channel:?} {filling} at {at}");
                        }
                        Err(error) => assert_eq!(error.code(), "broken_image"),
                    }
                }
            }
            // what is whole is given where scans hold all of a row, or start anew
            let some = name.contains("restart 10") || name.contains("progressive false");
            assert!(measured > 0 || channel == Channel::Green || !some, "{name}");
        }
    }
}

#[test]
fn noise_in_the_data_is_seldom_taken_for_picture() {
    let mut random = 5u32;
    let mut next = move |below: usize| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 8) as usize % below
    };
    let mut missed = 0;
    for restart in [0, 10] {
        let file = sample(false, restart);
        let truth = photo(&file, Channel::Grey).unwrap();
        let scan = file.windows(2).position(|w| w == b"\xff\xda").expect("a scan");
        for _ in 0..200 {
            let at = scan + 20 + next(file.len() - scan - 100);
            let mut spoilt = file.clone();
            spoilt[at..at + 64].iter_mut().for_each(|byte| *byte = next(255) as u8);
            if let Ok(photo) = photo(&spoilt, Channel::Grey) {
                missed += usize::from(wrong_and_whole(&photo, &truth).0 > 0);
            }
        }
    }
    assert!(missed <= 20, "{missed} of 400");
}

#[test]
fn a_chosen_channel_names_damaged_rows_too() {
    let file = sample(false, 10);
    let truth = photo(&file, Channel::Green).unwrap();
    let photo = photo(&file[..file.len() / 2], Channel::Green).unwrap();
    let (wrong, whole) = wrong_and_whole(&photo, &truth);
    assert!(wrong == 0 && whole > 64, "{wrong} of {whole}: {:?}", photo.damaged_rows);
}

#[test]
fn a_header_is_held_against_the_bytes() {
    let mut file = sample(false, 0);
    let frame = file.windows(2).position(|w| w == b"\xff\xc0").expect("a frame");
    // 15600 rows of 16000 pixels
    file[frame + 5..frame + 9].copy_from_slice(&[0x3c, 0xf0, 0x3e, 0x80]);
    file.truncate(2400);
    for error in [size(&file).expect_err("size"), grey(&file, Channel::Red).expect_err("samples")] {
        assert!(error.code() == "broken_image" && error.to_string().contains("16000 x 15600"), "{error}");
    }
    // a progressive one has a bit of each block at least, however flat it is
    let mut file = sample(true, 0);
    let frame = file.windows(2).position(|w| w == b"\xff\xc2").expect("a frame");
    file[frame + 5..frame + 9].copy_from_slice(&[0x3c, 0xf0, 0x3e, 0x80]);
    let least = 15_600 / 8 * (16_000 / 8) / 8;
    file.resize(least - 1, 0);
    for error in [size(&file).expect_err("size"), grey(&file, Channel::Grey).expect_err("samples")] {
        assert!(error.code() == "broken_image" && error.to_string().contains("16000 x 15600"), "{error}");
    }
    file.push(0);
    assert_eq!(size(&file).unwrap(), Size { width: 16_000, height: 15_600, bits: 8 });
    let mut png = encoded(&coloured(), ImageFormat::Png);
    png[16..24].copy_from_slice(&[0, 0, 0x3a, 0x98, 0, 0, 0x3a, 0x98]);
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    assert!(png.len() < 200);
    let error = grey(&png, Channel::Grey).expect_err("15000 x 15000");
    assert!(error.code() == "broken_image" && error.to_string().contains("15000 x 15000"), "{error}");
    let tiff = encoded(&coloured(), ImageFormat::Tiff);
    let reader = bytes::TiffReader::tiff(&tiff).expect("a TIFF");
    let mut large = tiff.clone();
    for entry in reader.entries().iter().filter(|entry| entry.tag == 256 || entry.tag == 257) {
        reader.overwrite(&mut large, entry, 15_000);
    }
    assert_eq!(grey(&large, Channel::Grey).expect_err("15000 x 15000").code(), "broken_image");
}

/// Of a BMP without compression every byte is told by its header; runs represent more.
#[test]
fn a_bmp_s_header_is_held_against_the_bytes() {
    let mut bmp = encoded(&RgbImage::new(900, 700).into(), ImageFormat::Bmp);
    assert_eq!(bmp[28], 24);
    assert!(size(&bmp).is_ok());
    let claims = |file: &[u8], width: u32, height: u32| {
        let mut file = file.to_vec();
        file[18..22].copy_from_slice(&width.to_le_bytes());
        file[22..26].copy_from_slice(&height.to_le_bytes());
        [size(&file).err(), grey(&file, Channel::Grey).err()].map(|error| error.map(|error| error.to_string()))
    };
    // two rows more than there are, and 750 MB in 2
    for [width, height] in [[900, 702], [16_000, 15_600]] {
        for error in claims(&bmp, width, height) {
            let named = error.is_some_and(|error| error.contains(&format!("{width} x {height}")));
            assert!(named, "{width} x {height}");
        }
    }
    bmp.truncate(54);
    // places of 8 bits in a palette of two colours, in two bytes a run of 255
    bmp[28] = 8;
    bmp[30] = 1;
    bmp[46] = 2;
    bmp[10] = 62;
    bmp.extend([0, 0, 0, 0, 200, 200, 200, 0]);
    for _ in 0..200 {
        bmp.extend([255, 1, 255, 1, 0, 0]);
    }
    bmp.extend([0, 1]);
    assert_eq!(claims(&bmp, 510, 200), [None, None]);
    assert!(claims(&bmp, 5_100, 2_000).iter().all(Option::is_some));
}

#[test]
fn profiles_of_png_are_not_unpacked() {
    let png = encoded(&coloured(), ImageFormat::Png);
    let mut with_profile = png[..33].to_vec();
    // an invalid profile, which only unpacking reveals
    let chunk = b"iCCPname\0\0not deflated at all";
    with_profile.extend((chunk.len() as u32 - 4).to_be_bytes());
    with_profile.extend(chunk);
    with_profile.extend(crc32(chunk).to_be_bytes());
    with_profile.extend(&png[33..]);
    assert_eq!(bytes::without_texts(&with_profile), png);
    assert_eq!(grey(&with_profile, Channel::Red), grey(&png, Channel::Red));
    assert_eq!(size(&with_profile), size(&png));
}

/// 112 x 112 pixels of a chessboard with fields of four, progressive: each block is a few equal bits.
const PATTERN: &str = "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a181616183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c656763ffc2000b080070007001011100ffc40014000100000000000000000000000000000000ffda00080101000000010000000000000000000000000000000000000000000000000fffc4001510010100000000000000000000000000000035ffda00080101000105029c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9c9cffc4001810000203000000000000000000000000000011125381ffda0008010100063f02b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788b2788ffc40018100002030000000000000000000000000000415191f0ffda0008010100013f21d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4d55726aab93555c9aaae4fffda00080101000000100000000000000000000000000000000000000000000000000fffc40019100001050000000000000000000000000000113171e1f0ffda0008010100013f10cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58cec962c6764b1633b258b19d92c58fffd9";

#[test]
fn the_equal_bytes_of_a_pattern_are_not_damage() {
    let file = from_hex(PATTERN);
    assert!(file.windows(48).any(|bytes| bytes.iter().all(|byte| *byte == bytes[0])));
    assert_eq!(photo(&file, Channel::Grey).unwrap().damaged_rows, Vec::<[u32; 2]>::new());
}
