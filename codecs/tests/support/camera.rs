//! What a camera makes of its samples before it keeps a JPEG: white balance, demosaicing, sharpening, tone curve.

use super::dng::Dng;

/// Share of the difference to its surroundings that sharpening adds to a pixel.
const SHARPENED: f64 = 0.8;
/// Share of the tone curve's S.
const CONTRAST: f64 = 0.3;

/// The JPEG of a mosaic; `filters` are the shares of light that the filters let through.
pub fn jpeg(dng: &Dng, filters: &[(char, f64)], quality: u8) -> Vec<u8> {
    let (width, height) = (dng.width as isize, dng.height as isize);
    let letters: Vec<char> = dng.pattern.chars().collect();
    let letter = |x: isize, y: isize| letters[(y.rem_euclid(2) * 2 + x.rem_euclid(2)) as usize];
    // mirrored at the border, which keeps the pattern
    let inside = |at: isize, size: isize| if at < 0 { -at } else { at.min(2 * (size - 1) - at) };
    let at = |x: isize, y: isize| (inside(y, height) * width + inside(x, width)) as usize;
    let places = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let light = |(x, y): (isize, isize)| {
        let share = filters.iter().find(|(known, _)| *known == letter(x, y)).unwrap().1;
        (f64::from(dng.samples[at(x, y)]) - f64::from(dng.black)) / f64::from(dng.white - dng.black) / share
    };
    let light: Vec<f64> = places().map(light).collect();
    // green between its sites with the bend of the other colour there (Hamilton and Adams 1997, without their directions)
    let green = |(x, y): (isize, isize)| {
        let around = |step: isize| {
            light[at(x - step, y)] + light[at(x + step, y)] + light[at(x, y - step)] + light[at(x, y + step)]
        };
        if letter(x, y) == 'G' { light[at(x, y)] } else { around(1) / 4.0 + (4.0 * light[at(x, y)] - around(2)) / 8.0 }
    };
    let green: Vec<f64> = places().map(green).collect();
    // red and blue by their differences to green
    let other = |colour: char| {
        let level = |(x, y): (isize, isize)| {
            let difference = |(i, j): (isize, isize)| light[at(i, j)] - green[at(i, j)];
            if letter(x, y) == colour {
                return light[at(x, y)];
            }
            let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
            let near: Vec<f64> = near.filter(|(i, j)| letter(*i, *j) == colour).map(difference).collect();
            green[at(x, y)] + near.iter().sum::<f64>() / near.len() as f64
        };
        places().map(level).collect::<Vec<f64>>()
    };
    let planes = [other('R'), green.clone(), other('B')].map(|plane| {
        let soft = |(x, y): (isize, isize)| {
            let weight = |step: isize| if step == 0 { 0.5 } else { 0.25 };
            let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
            near.map(|(dx, dy)| weight(dx) * weight(dy) * plane[at(x + dx, y + dy)]).sum::<f64>()
        };
        let level = |(x, y): (isize, isize)| {
            let own = plane[at(x, y)];
            let sharp = (own + SHARPENED * (own - soft((x, y)))).clamp(0.0, 1.0).powf(1.0 / 2.2);
            let curved = sharp * sharp * (3.0 - 2.0 * sharp);
            (255.0 * (sharp + CONTRAST * (curved - sharp))).round() as u8
        };
        places().map(level).collect::<Vec<u8>>()
    });
    let rgb: Vec<u8> = (0..green.len()).flat_map(|i| [planes[0][i], planes[1][i], planes[2][i]]).collect();
    let mut file = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut file, quality);
    encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_2_2);
    encoder.encode(&rgb, width as u16, height as u16, jpeg_encoder::ColorType::Rgb).expect("a JPEG");
    file
}
