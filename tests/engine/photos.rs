//! Photo files of real cameras.

use crate::data::data;
use sightline::decode::{Size, grey, picture, size};
use sightline::detection::Channel;
use sightline::exif;
use sightline::image::Samples;

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
