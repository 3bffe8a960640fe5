//! HEIC files from the encoder of the decoder's own crates, over pictures of an independent renderer.

#[allow(dead_code, reason = "shared with the engine's tests, which use all of it")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;

use heifer::{EncodeOptions, Image, Metadata};
use heifer_isobmff::HeifFile;
use heifer_isobmff::boxes::Property;
use painter::{Canvas, Spot, Uniform};
use sightline::decode;
use sightline::detect::{detect_photo, detect_shot};
use sightline::detection::{Channel, DetectOptions, Target};
use sightline::error::Error;
use sightline::exif::{self, PhotoInfo};
use sightline::image::{Grey, Samples};
use sightline::sensor::{Shot, Unpacked};
use sightline_codecs::{Wanted, unpack};

const WHOLE: Wanted = Wanted { channel: Channel::Grey, samples: true, max_side: 100 };

/// 10 x 10 circles of 6 to 24 pixels, in as many tiles as a phone would make of them.
fn scene() -> (Canvas, Vec<Spot>) {
    let mut canvas = Canvas::new(720, 700, 40.0);
    let mut random = Uniform(17);
    let spots: Vec<Spot> = (0..100)
        .map(|k| {
            let place = |i: i32| 70.0 * f64::from(i) + 40.0;
            let (u, v) = (place(k % 10) + random.next(), place(k / 10) + random.next());
            let a = random.within(3.0, 12.0);
            Spot { u, v, a, b: a * random.within(0.7, 1.0), angle: random.within(0.0, 3.1), contrast: 150.0 }
        })
        .collect();
    spots.iter().for_each(|spot| canvas.add(spot, 0.8));
    (canvas, spots)
}

fn grey_levels(grey: &Grey) -> &[u8] {
    match &grey.samples {
        Samples::U8(samples) => samples,
        Samples::U16(_) => panic!("8 bits"),
    }
}

fn heic(grey: &Grey, quality: u8) -> Vec<u8> {
    let rgb: Vec<u8> = grey_levels(grey).iter().flat_map(|level| [*level; 3]).collect();
    let options = EncodeOptions { quality, ..EncodeOptions::default() };
    heifer::encode_rgb8(grey.width as u32, grey.height as u32, &rgb, &options).expect("a file")
}

fn luma(file: &[u8]) -> (Unpacked, Grey) {
    let unpacked = unpack(file, WHOLE).expect("a picture");
    match unpacked.clone().into_shot().expect("a photo") {
        Shot::Photo(photo) => (unpacked, photo.grey),
        Shot::Sensor(_) => panic!("a developed picture"),
    }
}

fn hits(targets: &[Target], spots: &[Spot]) -> usize {
    let near = |spot: &Spot| targets.iter().any(|target| (target.u - spot.u).hypot(target.v - spot.v) < 0.5);
    spots.iter().filter(|spot| near(spot)).count()
}

#[test]
fn grey_is_the_luma_plane_tile_by_tile() {
    let picture = scene().0.expose(1.0, 5);
    let file = heic(&picture, 95);
    let (unpacked, grey) = luma(&file);
    let header = &unpacked.header;
    assert_eq!((header.width, header.height, header.bits, header.info.orientation), (720, 700, 8, 1));
    let difference = |(a, b): (&u8, &u8)| (f64::from(*a) - f64::from(*b)).powi(2);
    let squares: f64 = grey_levels(&picture).iter().zip(grey_levels(&grey)).map(difference).sum();
    let rms = (squares / (720.0 * 700.0)).sqrt();
    assert!(rms < 1.2, "{rms}");
    assert_eq!((header.small, unpacked.small.len()), ([100, 97], 4 * 100 * 97));
    // The header comes without decoding, and colours of a grey picture are its grey, but for rounding.
    let bare = unpack(&file, Wanted { samples: false, max_side: 0, ..WHOLE }).expect("a header");
    assert_eq!((bare.header.width, bare.samples), (720, Samples::U8(Vec::new())));
    let green = unpack(&file, Wanted { channel: Channel::Green, ..WHOLE }).expect("a channel");
    let Samples::U8(green) = green.samples else { panic!("8 bits") };
    let apart = green.iter().zip(grey_levels(&grey)).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(apart.is_some_and(|apart| apart <= 3), "{apart:?}");
}

#[test]
fn targets_are_found_as_in_a_jpeg_of_equal_quality() {
    let (canvas, spots) = scene();
    let picture = canvas.expose(2.0, 6);
    let options = DetectOptions::default();
    let file = heic(&picture, 85);
    let shot = unpack(&file, Wanted::samples(Channel::Grey)).and_then(Unpacked::into_shot).expect("a photo");
    let found = detect_shot(&shot, &options).expect("targets");
    let mut jpeg = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut jpeg, 90);
    encoder.encode(grey_levels(&picture), 720, 700, jpeg_encoder::ColorType::Luma).expect("a file");
    let photo = decode::photo(&jpeg, Channel::Grey).expect("a photo");
    let beside = detect_photo(&photo, &options).expect("targets");
    let (own, other) = (hits(&found.targets, &spots), hits(&beside.targets, &spots));
    println!("HEIC {own} of 100 in {} bytes, JPEG {other} in {} bytes", file.len(), jpeg.len());
    assert!(own >= other && own == 100, "{own} {other}");
    assert_eq!(found.targets.len(), 100);
}

#[test]
fn ten_bits_are_kept() {
    let mut data = Vec::new();
    for k in 0..600u16 * 64 {
        let level = 200 + k % 600;
        data.extend([level, level, level, 1023]);
    }
    let image = Image { width: 600, height: 64, bit_depth: 10, has_alpha: false, data };
    let options = EncodeOptions { quality: 100, ..EncodeOptions::default() };
    let (unpacked, grey) = luma(&heifer::encode(&image, &options).expect("a file"));
    let Samples::U16(samples) = grey.samples else { panic!("more than 8 bits") };
    assert_eq!(unpacked.header.bits, 10);
    let worst = samples.iter().enumerate().map(|(k, level)| (level >> 6).abs_diff(200 + k as u16 % 600)).max();
    assert!(worst.is_some_and(|worst| worst <= 3), "{worst:?}");
}

#[test]
fn exif_and_turns_are_told_and_the_grid_stays() {
    let mut image = Image::filled(96, 64, 8, [90, 90, 90, 255]);
    image.data[..400].fill(200);
    let info = PhotoInfo {
        make: Some("Maker".into()),
        model: Some("Model".into()),
        focal_length_mm: Some(4.25),
        orientation: 6,
        date: Some("2026-02-03T04:05:06".into()),
        ..PhotoInfo::default()
    };
    let metadata = Metadata { exif: Some(exif::write(&info)), ..Metadata::default() };
    let file = heifer::encode_with_metadata(&image, &metadata, &EncodeOptions::default()).expect("a file");
    let (unpacked, upright) = luma(&file);
    assert_eq!(unpacked.header.info, PhotoInfo { orientation: 1, ..info.clone() });
    // A rotation in the place of the colours: the box's first byte counts quarter turns to the left.
    let mut turned = file.clone();
    let at = turned.windows(8).position(|bytes| bytes == b"colrnclx").expect("colours");
    turned[at..at + 5].copy_from_slice(b"irot\x01");
    let (unpacked, grey) = luma(&turned);
    assert_eq!((unpacked.header.info.orientation, grey.width, grey.height), (8, 96, 64));
    assert_eq!(grey, upright);
}

/// Without its samples a file shows its embedded thumbnail, as its whole picture would be shown, a little blurred; whole, where the thumbnail
/// is too small, damaged or turned otherwise.
#[test]
fn the_thumbnail_that_a_file_carries_is_shown_for_it() {
    let (canvas, _) = scene();
    let file = heic(&canvas.expose(1.0, 5), 85);
    let shown = |file: &[u8], max_side: u32, samples: bool| {
        let unpacked = unpack(file, Wanted { channel: Channel::Grey, samples, max_side }).expect("a picture");
        (unpacked.header.small, unpacked.small)
    };
    let apart =
        |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.len() as f64;
    let (size, whole) = shown(&file, 160, true);
    let (small, thumbnail) = shown(&file, 160, false);
    assert_eq!((size, small), ([160, 156], [160, 156]));
    let blurred = apart(&whole, &thumbnail);
    assert!(whole != thumbnail && blurred < 12.0, "{blurred}");
    // beyond twice its side it shows too little
    assert_eq!(shown(&file, 700, false), shown(&file, 700, true));
    // the thumbnail's own samples lost
    let mut damaged = file.clone();
    let extent = {
        let parsed = HeifFile::parse(&file).expect("boxes");
        let id = parsed.referencing_items(parsed.primary_id, b"thmb")[0];
        parsed.item(id).expect("an item").location.as_ref().expect("a place").extents[0]
    };
    damaged[extent.offset as usize..(extent.offset + extent.length) as usize].fill(0);
    assert_eq!(shown(&damaged, 160, false), shown(&file, 160, true));
    // A rotation in the place of the colours, which both have, and then the picture alone.
    let mut turned = file.clone();
    let at = turned.windows(8).position(|bytes| bytes == b"colrnclx").expect("colours");
    turned[at..at + 5].copy_from_slice(b"irot\x01");
    let alone = {
        let parsed = HeifFile::parse(&turned).expect("boxes");
        let id = parsed.referencing_items(parsed.primary_id, b"thmb")[0];
        let mut properties = parsed.item_properties(id).expect("properties");
        let place = properties.position(|p| matches!(p, Property::Rotation(_))).expect("a rotation");
        without_property(&turned, u16::try_from(id).expect("a small file"), place)
    };
    for (file, embedded) in [(&turned, true), (&alone, false)] {
        let small =
            |samples| unpack(file, Wanted { channel: Channel::Grey, samples, max_side: 160 }).expect("a picture");
        let (own, whole) = (small(false), small(true));
        assert_eq!((own.header.info.orientation, whole.header.info.orientation), (8, 8));
        assert_eq!(own.small != whole.small, embedded);
    }
}

/// The file with one property less of an item: its association is with none (ISO/IEC 14496-12, `ipma`).
fn without_property(file: &[u8], item: u16, place: usize) -> Vec<u8> {
    let mut file = file.to_vec();
    let start = file.windows(4).position(|bytes| bytes == b"ipma").expect("associations") + 4;
    assert_eq!(file[start..start + 4], [0; 4], "items of two bytes, properties of one");
    let mut at = start + 8;
    while file[at..at + 2] != item.to_be_bytes() {
        at += 3 + usize::from(file[at + 2]);
    }
    file[at + 3 + place] = 0;
    file
}

/// A stream's bits from its highest on.
fn bits_of(bytes: &[u8]) -> Vec<bool> {
    bytes.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1 == 1)).collect()
}

/// A number without sign as HEVC writes it (H.265, 9.2): as many zeros as bits follow the first one.
fn exp_golomb(value: u32) -> Vec<bool> {
    let length = 32 - (value + 1).leading_zeros();
    [vec![false; length as usize - 1], (0..length).rev().map(|bit| (value + 1) >> bit & 1 == 1).collect()].concat()
}

/// A sequence parameter set that claims another size (H.265, 7.3.2.2).
fn resized(unit: &[u8], width: u32, height: u32) -> Vec<u8> {
    let mut plain = Vec::new();
    for byte in unit {
        // a three after two zeros keeps start codes out
        if !(*byte == 3 && plain.ends_with(&[0, 0])) {
            plain.push(*byte);
        }
    }
    let bits = bits_of(&plain);
    // two bytes of header, identifiers of a byte, and twelve of profile and level
    let mut at = 8 * 15;
    assert_eq!(plain[2] >> 1 & 7, 0, "one layer");
    let skip = |at: &mut usize| {
        let zeros = bits[*at..].iter().take_while(|bit| !**bit).count();
        *at += 2 * zeros + 1;
    };
    skip(&mut at); // its number
    skip(&mut at); // kind of chroma
    let kept = at;
    skip(&mut at);
    skip(&mut at);
    let last = bits.iter().rposition(|bit| *bit).expect("a last one");
    let mut new = [&bits[..kept], &exp_golomb(width), &exp_golomb(height), &bits[at..=last]].concat();
    new.resize(new.len().next_multiple_of(8), false);
    let mut unit: Vec<u8> = Vec::new();
    for byte in new.chunks(8).map(|bits| bits.iter().fold(0, |byte, bit| byte << 1 | u8::from(*bit))) {
        if byte <= 3 && unit.ends_with(&[0, 0]) {
            unit.push(3);
        }
        unit.push(byte);
    }
    unit
}

/// The decoder takes memory for what the stream of a tile claims, not for the size that its item has.
#[test]
fn the_size_in_the_stream_is_held_against_the_bytes() {
    let file = heic(&Canvas::new(64, 48, 99.0).expose(3.0, 1), 50);
    let (extent, sets, data) = {
        let parsed = HeifFile::parse(&file).expect("boxes");
        let config = parsed.hevc_config(parsed.primary_id).expect("an item").expect("parameter sets");
        assert_eq!(config.nal_length_size, 4);
        let extent = parsed.item(parsed.primary_id).expect("an item").location.as_ref().expect("a place").extents[0];
        let data = parsed.item_data(parsed.primary_id).expect("data").into_owned();
        (extent, config.nal_units.clone(), data)
    };
    let [sequence, picture] = [33, 34].map(|kind| sets.iter().find(|set| set[0] >> 1 == kind).expect("a set"));
    // sets that come again with the data replace those before
    let claiming = |width, height| {
        let mut new = Vec::new();
        for set in [&resized(sequence, width, height), picture] {
            new.extend((set.len() as u32).to_be_bytes());
            new.extend(set);
        }
        new.extend(&data);
        let place = [(extent.offset as u32).to_be_bytes(), (extent.length as u32).to_be_bytes()].concat();
        let entry = file.windows(8).position(|bytes| bytes == place).expect("its entry");
        let mut file = file.clone();
        file.extend((new.len() as u32 + 8).to_be_bytes());
        file.extend(b"mdat");
        let at = file.len() as u32;
        file[entry..entry + 8].copy_from_slice(&[at.to_be_bytes(), (new.len() as u32).to_be_bytes()].concat());
        file.extend(new);
        unpack(&file, WHOLE)
    };
    let same = claiming(64, 48).expect("as before");
    assert_eq!(same.samples, unpack(&file, WHOLE).expect("a picture").samples);
    let error = claiming(16_000, 15_616).expect_err("more than the bytes hold").to_string();
    assert!(error.contains("size limit"), "{error}");
}

#[test]
fn a_tile_that_is_lost_costs_its_rows() {
    let (canvas, spots) = scene();
    let mut file = heic(&canvas.expose(1.0, 5), 85);
    let (grid, cut) = {
        let parsed = HeifFile::parse(&file).expect("boxes");
        let extent = |id| parsed.item(id).expect("an item").location.as_ref().expect("a place").extents[0];
        let tile = extent(parsed.referenced_items(parsed.primary_id, b"dimg")[2]);
        (extent(parsed.primary_id), (tile.offset + tile.length / 2) as usize)
    };
    // Phones have the grid's sizes before the tiles, this encoder behind them: they go where the handler's box has room.
    let room = file.windows(4).position(|bytes| bytes == b"hdlr").expect("a handler") + 16;
    let place = [(grid.offset as u32).to_be_bytes(), (grid.length as u32).to_be_bytes()].concat();
    let entry = file.windows(8).position(|bytes| bytes == place).expect("its entry");
    file.copy_within(grid.offset as usize..(grid.offset + grid.length) as usize, room);
    file[entry..entry + 4].copy_from_slice(&(room as u32).to_be_bytes());
    // in the middle of the third tile
    file.truncate(cut);
    let unpacked = unpack(&file, WHOLE).expect("the first tiles");
    let Ok(Shot::Photo(photo)) = unpacked.into_shot() else { panic!("a photo") };
    assert_eq!(photo.damaged_rows, [[512, 700]]);
    let found = detect_photo(&photo, &DetectOptions::default()).expect("targets");
    let above: Vec<Spot> = spots.into_iter().filter(|spot| spot.v + spot.a + 8.0 < 512.0).collect();
    println!("{} targets, {} of {} above", found.targets.len(), hits(&found.targets, &above), above.len());
    assert_eq!(hits(&found.targets, &above), above.len());
    assert!(found.targets.iter().all(|target| target.v < 512.0));
}

#[test]
fn damage_is_told_and_nothing_else_happens() {
    let picture = Canvas::new(64, 48, 99.0).expose(3.0, 1);
    let whole = heic(&picture, 50);
    for end in (0..whole.len()).step_by(7) {
        if let Err(error) = unpack(&whole[..end], WHOLE) {
            assert!(matches!(error, Error::BrokenImage { .. } | Error::UnknownImageFormat { .. }), "{error}");
        }
    }
    let mut random = Uniform(3);
    for _ in 0..300 {
        let mut bytes = whole.clone();
        for _ in 0..4 {
            let at = (random.next() * bytes.len() as f64) as usize;
            bytes[at] = (random.next() * 256.0) as u8;
        }
        if let Ok(unpacked) = unpack(&bytes, WHOLE) {
            let _ = unpacked.into_shot();
        }
    }
    // A size beyond all bytes is refused before anything of that size is taken.
    let mut vast = whole;
    let at = vast.windows(4).position(|bytes| bytes == b"ispe").expect("a size");
    vast[at + 8..at + 16].copy_from_slice(&[0, 0, 0x30, 0, 0, 0, 0x30, 0]);
    assert!(matches!(unpack(&vast, WHOLE), Err(Error::BrokenImage { .. } | Error::ImageSize { .. })));
}
