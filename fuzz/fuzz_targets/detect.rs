//! Any bytes as a file, any bytes as a picture, any options: decoding and detection must end in a result or an error, no
//! number of it NaN or infinite.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sightline::detect::{detect, detect_photo, measure_all, measure_at, measure_in_photo};
use sightline::detection::{Channel, Codes, DetectOptions, Method, PolarityChoice, Target};
use sightline::image::{GreyView, SamplesView};
use sightline::ring_code::Family;

/// The first bytes choose the options, the others are the picture.
fn options(head: &[u8]) -> DetectOptions {
    let at = |i: usize| head.get(i).copied().unwrap_or(0);
    let number = |i: usize| f64::from(f32::from_le_bytes([at(i), at(i + 1), at(i + 2), at(i + 3)]));
    DetectOptions {
        method: [Method::LeastSquares, Method::Ellipse, Method::Intensity, Method::Gradient][usize::from(at(0) % 4)],
        polarity: [PolarityChoice::Auto, PolarityChoice::Bright, PolarityChoice::Dark][usize::from(at(1) % 3)],
        channel: [Channel::Grey, Channel::Red, Channel::Green, Channel::Blue][usize::from(at(2) % 4)],
        codes: match usize::from(at(3) % 10) {
            0 => Codes::None,
            1 => Codes::Auto,
            family => Family::ALL[family - 2].into(),
        },
        min_diameter: if at(4) & 1 == 0 { 5.0 } else { number(5) },
        max_diameter: if at(4) & 2 == 0 { 400.0 } else { number(9) },
        min_axis_ratio: if at(4) & 4 == 0 { 0.29 } else { f64::from(at(13)) / 255.0 },
    }
}

fn check(targets: &[Target]) {
    for target in targets {
        let Target { u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, contrast, .. } = target;
        let numbers = [u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, contrast];
        assert!(numbers.iter().all(|number| number.is_finite()), "{target:?}");
    }
}

fn measure(view: &GreyView, options: &DetectOptions, place: [u8; 2]) {
    if let Ok(found) = detect(view, options) {
        check(&found.targets);
    }
    let [u, v] = [(place[0], view.width()), (place[1], view.height())].map(|(at, size)| f64::from(at) / 255.0 * size as f64);
    if let Ok(Some(target)) = measure_at(view, u, v, options) {
        check(&[target]);
    }
    if let Ok(all) = measure_all(view, u, v, options) {
        all.iter().for_each(|result| check(result.target.as_slice()));
    }
}

fuzz_target!(|data: &[u8]| {
    let (head, rest) = data.split_at(data.len().min(16));
    let options = options(head);
    let at = |i: usize| head.get(i).copied().unwrap_or(0);
    // as the page does it: what of a damaged file is whole is measured
    if let Ok(photo) = sightline::decode::photo(rest, options.channel)
        && photo.grey.width * photo.grey.height < 1 << 22
    {
        let [u, v] = [(at(14), photo.grey.width), (at(15), photo.grey.height)]
            .map(|(place, size)| f64::from(place) / 255.0 * size as f64);
        if let Ok(found) = detect_photo(&photo, &options) {
            check(&found.targets);
        }
        if let Ok(Some(target)) = measure_in_photo(&photo, u, v, &options) {
            check(&[target]);
        }
    }
    // the bytes themselves, in 8 and in 16 bits
    let width = 1 + usize::from(at(13));
    let height = rest.len() / width;
    if let Ok(view) = GreyView::new(width, height, SamplesView::U8(&rest[..width * height])) {
        measure(&view, &options, [at(14), at(15)]);
    }
    let words: Vec<u16> = rest.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    let height = words.len() / width;
    if let Ok(view) = GreyView::new(width, height, SamplesView::U16(&words[..width * height])) {
        measure(&view, &options, [at(14), at(15)]);
    }
    // a few numbers as a picture of discs: bytes alone hardly ever make a target
    let (mut samples, width) = (vec![at(0) / 2; 160 * 120], 160);
    for disc in rest.chunks_exact(6).take(24) {
        let [u, v, a, b, level, slope] = [0, 1, 2, 3, 4, 5].map(|i| f32::from(disc[i]));
        let (u, v, a, b) = (u * 160.0 / 255.0, v * 120.0 / 255.0, 1.0 + a / 5.0, 1.0 + b / 5.0);
        for (i, sample) in samples.iter_mut().enumerate() {
            let (x, y) = ((i % width) as f32 + 0.5 - u, (i / width) as f32 + 0.5 - v);
            let share = (0.5 + a.min(b) * (1.0 - (x / a).hypot(y / b)) / (0.5 + slope / 60.0)).clamp(0.0, 1.0);
            *sample = (f32::from(*sample) * (1.0 - share) + level * share) as u8;
        }
    }
    if let Ok(view) = GreyView::new(width, 120, SamplesView::U8(&samples)) {
        measure(&view, &options, [at(14), at(15)]);
    }
});
