//! RAW files that are cut off, changed at random, or whose headers promise what is not there.

use super::*;

#[test]
fn damage_is_told_and_nothing_else_happens() {
    let canvas = Canvas::new(96, 64, 0.3);
    let whole = exposed(&canvas, TWELVE, "RGGB", 1);
    for lossless_jpeg in [false, true] {
        let file = Dng { lossless_jpeg, ..whole.clone() }.file();
        for end in (0..file.len()).step_by(31) {
            match unpack(&file[..end], Wanted::samples(Channel::Grey)).and_then(Unpacked::into_shot) {
                Ok(Shot::Sensor(sensor)) => assert!(!sensor.damaged_rows.is_empty()),
                Ok(Shot::Photo(_)) => panic!("not developed"),
                Err(error) => {
                    assert!(matches!(error, Error::BrokenImage { .. } | Error::UnknownImageFormat { .. }), "{error}")
                }
            }
        }
        let mut random = Uniform(3);
        for _ in 0..100 {
            let mut bytes = file.clone();
            for _ in 0..3 {
                let at = (random.next() * 420.0) as usize;
                bytes[at] = (random.next() * 256.0) as u8;
            }
            let wanted = Wanted { channel: Channel::Grey, samples: true, max_side: 64 };
            if let Ok(shot) = unpack(&bytes, wanted).and_then(Unpacked::into_shot) {
                let _ = detect_shot(&shot, &DetectOptions::default());
            }
        }
    }
    // Rows before the cut are measured.
    let (canvas, spots) = scene();
    let mut file = exposed(&canvas, TWELVE, "RGGB", 1).file();
    file.truncate(file.len() / 2);
    let found = detected(&file, Channel::Grey);
    assert_eq!(found.damaged_rows.len(), 1);
    let first = f64::from(found.damaged_rows[0][0]);
    assert!((first - canvas.height as f64 / 2.0).abs() < 4.0, "{first}");
    let whole = spots.iter().filter(|spot| spot.v + spot.a + 8.0 < first).collect::<Vec<_>>();
    assert!(whole.iter().all(|spot| nearest(&found.targets, spot).is_some()));
}

/// A directory's claims and those of the JPEG that shows the picture, which may be missed by a search for its frame only.
#[test]
fn headers_are_held_against_the_bytes() {
    let wanted = Wanted { channel: Channel::Grey, samples: true, max_side: 64 };
    let whole = exposed(&Canvas::new(96, 64, 0.3), TWELVE, "RGGB", 1);
    for lossless_jpeg in [false, true] {
        let mut file = Dng { lossless_jpeg, ..whole.clone() }.file();
        for (tag, value) in [(256u16, 16_000u32), (257, 15_600)] {
            // a long, one of it
            let entry = [tag.to_le_bytes(), 4u16.to_le_bytes(), 1u16.to_le_bytes(), [0; 2]].concat();
            let at = file.windows(8).position(|bytes| bytes == entry).expect("an entry") + 8;
            file[at..at + 4].copy_from_slice(&value.to_le_bytes());
        }
        for samples in [false, true] {
            let error = unpack(&file, Wanted { samples, ..wanted }).expect_err("more than the bytes hold");
            assert!(error.code() == "broken_image" && error.to_string().contains("16000 x 15600"), "{error}");
        }
    }
    let mut preview = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut preview, 90);
    encoder.encode(&[90; 3 * 32 * 16], 32, 16, jpeg_encoder::ColorType::Rgb).expect("a JPEG");
    let shown = |preview: &[u8]| {
        let file = Dng { preview: preview.to_vec(), ..whole.clone() }.file();
        let unpacked = unpack(&file, wanted).expect("a photo");
        assert_eq!(unpacked.samples, Samples::U16(whole.samples.clone()));
        unpacked.header.small
    };
    for hidden in [false, true] {
        if hidden {
            preview.splice(2..2, [0xff, 0]);
        }
        assert_eq!(shown(&preview), [32, 16]);
        let mut vast = preview.clone();
        let frame = vast.windows(2).position(|marker| marker == [0xff, 0xc0]).expect("a frame");
        // 15600 rows of 16000 pixels
        vast[frame + 5..frame + 9].copy_from_slice(&[0x3c, 0xf0, 0x3e, 0x80]);
        assert_eq!(shown(&vast), [0, 0]);
    }
}
