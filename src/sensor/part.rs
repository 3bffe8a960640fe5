//! A part of a photo as it was stored, a pixel a sample: what a magnifier shows.

use super::{Sensor, Shot};
use crate::decode::Picture;
use crate::image::{Grey, Samples};

/// Share of the samples that may be whiter than white.
const BRIGHTEST: f64 = 0.005;

/// The square of at most `side` pixels whose top left corner is given, as far as the photo goes.
pub fn part(shot: &Shot, [left, top]: [usize; 2], side: usize) -> Picture {
    let [width, height] = shot.size();
    let (left, top) = (left.min(width), top.min(height));
    let (across, down) = ((width - left).min(side), (height - top).min(side));
    let levels = match shot {
        Shot::Photo(photo) => of_grey(&photo.grey, [left, top, across, down]),
        Shot::Sensor(sensor) => of_sensor(sensor, [left, top, across, down]),
    };
    let rgba = levels.into_iter().flat_map(|level| [level, level, level, 255]).collect();
    Picture { width: across as u32, height: down as u32, rgba }
}

/// The samples of a rectangle (left, top, columns, rows) as they were stored, row by row, with the rectangle as far as the photo goes.
/// Of a sensor black is not taken off.
pub fn values(shot: &Shot, [left, top, across, down]: [usize; 4]) -> ([usize; 4], Vec<u16>) {
    let [width, height] = shot.size();
    let (left, top) = (left.min(width), top.min(height));
    let (across, down) = ((width - left).min(across), (height - top).min(down));
    let lines = (top..top + down).map(|row| row * width + left..row * width + left + across);
    let samples = match shot {
        Shot::Sensor(sensor) => lines.flat_map(|line| &sensor.samples[line]).copied().collect(),
        Shot::Photo(photo) => match &photo.grey.samples {
            Samples::U8(samples) => lines.flat_map(|line| &samples[line]).map(|level| u16::from(*level)).collect(),
            Samples::U16(samples) => lines.flat_map(|line| &samples[line]).copied().collect(),
        },
    };
    ([left, top, across, down], samples)
}

fn of_grey(grey: &Grey, [left, top, across, down]: [usize; 4]) -> Vec<u8> {
    let lines = (top..top + down).map(|row| row * grey.width + left..row * grey.width + left + across);
    match &grey.samples {
        Samples::U8(samples) => lines.flat_map(|line| &samples[line]).copied().collect(),
        Samples::U16(samples) => lines.flat_map(|line| &samples[line]).map(|level| (level >> 8) as u8).collect(),
    }
}

/// Sites of each filter brought to the same mean, so that what is grey shows no chequers; light as its root.
fn of_sensor(sensor: &Sensor, [left, top, across, down]: [usize; 4]) -> Vec<u8> {
    let pattern = &sensor.mosaic.pattern;
    let filter = |x: usize, y: usize| y % pattern.height() * pattern.width() + x % pattern.width();
    let places = || (top..top + down).flat_map(|y| (left..left + across).map(move |x| (x, y)));
    let light =
        |x: usize, y: usize| (f64::from(sensor.samples[y * sensor.width + x]) - sensor.mosaic.black.at(x, y)).max(0.0);
    let mut sums = vec![(0.0, 0.0); pattern.width() * pattern.height()];
    for (x, y) in places() {
        let (sum, count) = &mut sums[filter(x, y)];
        (*sum, *count) = (*sum + light(x, y), *count + 1.0);
    }
    let means: Vec<f64> = sums.iter().map(|(sum, count)| f64::max(sum / f64::max(*count, 1.0), 1e-3)).collect();
    let balanced: Vec<f64> = places().map(|(x, y)| light(x, y) / means[filter(x, y)]).collect();
    let mut ordered = balanced.clone();
    ordered.sort_unstable_by(f64::total_cmp);
    let white = ordered.get((ordered.len() as f64 * (1.0 - BRIGHTEST)) as usize).copied().unwrap_or(1.0).max(1e-9);
    balanced.into_iter().map(|level| (255.0 * (level / white).min(1.0).sqrt()) as u8).collect()
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::super::{Black, Mosaic, Pattern};
    use super::*;
    use crate::decode::DecodedPhoto;

    #[test]
    fn a_part_ends_where_the_photo_does() {
        let grey = Grey { width: 4, height: 3, samples: Samples::U16((0..12).map(|k| k << 8).collect()) };
        let shot = Shot::Photo(DecodedPhoto { grey, damaged_rows: Vec::new(), page: None });
        let shown = part(&shot, [2, 1], 9);
        assert_eq!((shown.width, shown.height), (2, 2));
        assert_eq!(shown.rgba.iter().step_by(4).copied().collect::<Vec<_>>(), [6, 7, 10, 11]);
        assert!(part(&shot, [9, 9], 4).rgba.is_empty());
        assert_eq!(values(&shot, [2, 1, 9, 1]), ([2, 1, 2, 1], vec![6 << 8, 7 << 8]));
        assert_eq!(values(&shot, [9, 9, 1, 1]).1, Vec::<u16>::new());
    }

    #[test]
    fn grey_light_shows_no_chequers_whatever_the_filters_let_through() {
        let level = |x: usize, y: usize| match (x % 2, y % 2) {
            (0, 0) => 64 + 500,
            (1, 1) => 64 + 300,
            _ => 64 + 1000,
        };
        let samples = (0..6).flat_map(|y| (0..8).map(move |x| level(x, y))).collect();
        let mosaic = Mosaic {
            pattern: Pattern::parse("RGGB", 2).expect("a pattern"),
            active_area: [0, 0, 8, 6],
            black: Black::uniform(64.0),
            white: 4095.0,
        };
        let sensor = Sensor {
            format: "DNG".into(),
            width: 8,
            height: 6,
            bits: 12,
            mosaic,
            samples,
            damaged_rows: Vec::new(),
            corrections: Vec::new(),
            unread_corrections: 0,
        };
        let shot = Shot::Sensor(sensor);
        let shown = part(&shot, [1, 1], 4);
        assert_eq!((shown.width, shown.rgba.len()), (4, 64));
        assert!(shown.rgba.chunks(4).all(|pixel| pixel == [255; 4]));
    }
}
