//! Small pictures that were wrong once, with their right answers.

use crate::support::data::data;
use sightline::decode;
use sightline::detect::detect_photo;
use sightline::detection::{DetectOptions, Detection};

fn found(name: &str, options: &DetectOptions) -> Option<Detection> {
    let bytes = data(&format!("cases/{name}"))?;
    let photo = decode::photo(&bytes, options.channel).expect("a photo");
    Some(detect_photo(&photo, options).expect("valid options"))
}

#[test]
fn the_full_page_behind_a_thumbnail_and_planar_tiles_are_measured() {
    if let Some(detection) = found("thumbnail_first.tif", &DetectOptions::default()) {
        let page = detection.page.expect("a file of several pictures");
        assert_eq!((page.number, page.skipped), (2, 1));
        assert_eq!(detection.targets.len(), 35);
    }
    for _ in 0..2 {
        if let Some(detection) = found("tiled_planar.tif", &DetectOptions::default()) {
            assert!(detection.width > 0);
        }
    }
}
