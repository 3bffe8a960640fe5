//! Any bytes as a file, any bytes as a picture, any options: decoding and detection must end in a result or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sightline::detect::{detect, measure_all, measure_at};
use sightline::detection::{Channel, Codes, DetectOptions, Method, PolarityChoice};
use sightline::image::{GreyView, SamplesView};

/// The first bytes choose the options, the others are the picture.
fn options(head: &[u8]) -> DetectOptions {
    let at = |i: usize| head.get(i).copied().unwrap_or(0);
    let number = |i: usize| f64::from(f32::from_le_bytes([at(i), at(i + 1), at(i + 2), at(i + 3)]));
    DetectOptions {
        method: [Method::LeastSquares, Method::Ellipse, Method::Intensity, Method::Gradient][usize::from(at(0) % 4)],
        polarity: [PolarityChoice::Auto, PolarityChoice::Bright, PolarityChoice::Dark][usize::from(at(1) % 3)],
        channel: [Channel::Grey, Channel::Red, Channel::Green, Channel::Blue][usize::from(at(2) % 4)],
        codes: [Codes::None, Codes::Ring12, Codes::Ring14, Codes::Ring16, Codes::Auto][usize::from(at(3) % 5)],
        min_diameter: if at(4) & 1 == 0 { 5.0 } else { number(5) },
        max_diameter: if at(4) & 2 == 0 { 400.0 } else { number(9) },
    }
}

fuzz_target!(|data: &[u8]| {
    let (head, rest) = data.split_at(data.len().min(16));
    let options = options(head);
    if let Ok(grey) = sightline::decode::grey(rest, options.channel) {
        if let Ok(view) = grey.view() {
            let _ = detect(&view, &options);
        }
    }
    let width = 1 + usize::from(head.get(13).copied().unwrap_or(0));
    let height = rest.len() / width;
    if let Ok(view) = GreyView::new(width, height, SamplesView::U8(&rest[..width * height])) {
        let _ = detect(&view, &options);
        let _ = measure_at(&view, width as f64 / 2.0, height as f64 / 2.0, &options);
        let _ = measure_all(&view, width as f64 / 2.0, height as f64 / 2.0, &options);
    }
});
