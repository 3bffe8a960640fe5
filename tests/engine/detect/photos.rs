//! Photo files of real cameras, and what a damaged one still shows.

use crate::support::data::data;
use crate::support::painter::{Canvas, Spot};
use sightline::decode::{DecodedPhoto, Size, grey, photo, picture, size};
use sightline::detect::{detect, detect_photo, measure_in_photo};
use sightline::detection::{Channel, DetectOptions, Target};
use sightline::exif;
use sightline::image::{Grey, Samples};

#[test]
fn a_camera_jpeg_with_exif() {
    let Some(bytes) = data("camcal/photos/P8250021.JPG") else { return };
    let info = exif::read(&bytes);
    assert_eq!(info.make.as_deref(), Some("OLYMPUS OPTICAL CO.,LTD"));
    assert_eq!(info.model.as_deref(), Some("C4040Z"));
    assert_eq!((info.focal_length_mm, info.pixel_pitch, info.orientation), (Some(7.3), None, 1));
    assert_eq!(info.date.as_deref(), Some("2007-08-25T16:49:21"));
    assert_eq!(size(&bytes).unwrap(), Size { width: 2272, height: 1704, bits: 8 });
    let shown = picture(&bytes, Some(320)).unwrap();
    assert_eq!((shown.width, shown.height), (320, 240));
    assert_eq!(grey(&bytes[..bytes.len() / 2], Channel::Green).unwrap_err().code(), "broken_image");
}

#[test]
fn a_compressed_grey_tiff() {
    let Some(bytes) = data("panel/043_0005_Scaled.tif") else { return };
    let photo = grey(&bytes, Channel::Grey).unwrap();
    assert_eq!((photo.width, photo.height), (2000, 1333));
    let Samples::U8(samples) = photo.samples else { panic!("8 bits expected") };
    // A photograph: neighbours resemble each other far more than the whole does.
    let step = samples.windows(2).map(|p| f64::from(p[0].abs_diff(p[1]))).sum::<f64>() / samples.len() as f64;
    let (low, high) = (samples.iter().min().unwrap(), samples.iter().max().unwrap());
    assert!(f64::from(high - low) > 20.0 * step, "range {low} to {high}, mean step {step}");
}

#[test]
fn half_a_photo_gives_the_targets_of_its_half() {
    let Some(bytes) = data("camcal/photos/P8250021.JPG") else { return };
    for channel in [Channel::Grey, Channel::Green] {
        let options = DetectOptions { channel, ..DetectOptions::default() };
        let whole = detect_photo(&photo(&bytes, channel).unwrap(), &options).unwrap();
        let half = detect_photo(&photo(&bytes[..bytes.len() / 2], channel).unwrap(), &options).unwrap();
        assert!(whole.damaged_rows.is_empty());
        let [[first, last]] = half.damaged_rows[..] else { panic!("{:?}", half.damaged_rows) };
        assert!(first > 400 && first < 1300 && last == 1704, "{first} {last}");
        // those a diameter above the damage; noise and range are taken over the rows that are there
        let above = whole.targets.iter().filter(|t| t.v + t.major < f64::from(first)).collect::<Vec<_>>();
        let found = |t: &&&Target| half.targets.iter().any(|h| (h.u - t.u).hypot(h.v - t.v) < 0.02);
        let hits = above.iter().filter(found).count();
        assert!(above.len() > 20 && hits + 1 >= above.len(), "{hits} of {}", above.len());
        assert!(half.targets.iter().all(|t| t.v < f64::from(first)));
        let there = above[0];
        let clicked = measure_in_photo(&photo(&bytes[..bytes.len() / 2], channel).unwrap(), there.u, there.v, &options);
        assert!(clicked.unwrap().is_some());
        let gone = measure_in_photo(&photo(&bytes[..bytes.len() / 2], channel).unwrap(), 100.0, 1650.0, &options);
        assert_eq!(gone.unwrap_err().code(), "invalid");
    }
}

#[test]
fn a_damaged_photo_is_reported_by_its_largest_whole_part() {
    const WIDTH: usize = 320;
    let part = |height: usize, noise: f64| {
        let mut canvas = Canvas::new(WIDTH, height, 200.0);
        for k in 0..12 {
            let (u, v) = (40.0 + 80.0 * f64::from(k % 4), 30.0 + 45.0 * f64::from(k / 4));
            canvas.add(&Spot { u, v, a: 9.0, b: 9.0, angle: 0.0, contrast: -150.0 }, 0.8);
        }
        canvas.expose(noise, 5)
    };
    let parts = [part(160, 2.0), part(48, 0.0), part(240, 5.0)];
    let bytes = |grey: &Grey| match &grey.samples {
        Samples::U8(samples) => samples.clone(),
        Samples::U16(_) => Vec::new(),
    };
    let samples = Samples::U8(parts.iter().flat_map(bytes).collect());
    let photo =
        DecodedPhoto { grey: Grey { width: WIDTH, height: 448, samples }, damaged_rows: vec![[160, 208]], page: None };
    let options = DetectOptions::default();
    let found = detect_photo(&photo, &options).unwrap();
    assert_eq!(found.targets.len(), 24);
    let [smaller, _, larger] = parts.map(|part| detect(&part.view().unwrap(), &options).unwrap().picture);
    assert!(
        (smaller.noise / 2.0 - 1.0).abs() < 0.25 && (larger.noise / 5.0 - 1.0).abs() < 0.25,
        "{smaller:?} {larger:?}"
    );
    assert_eq!(found.picture, larger);
}
