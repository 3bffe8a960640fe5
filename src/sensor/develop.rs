//! Pictures for the screen: means over squares of sites, scaled so that the brightest part is white. They are not used for measuring.

use super::Sensor;
use crate::decode::Picture;
use crate::detection::Colour;
use crate::image::{Grey, Samples};

/// Share of the pixels that may exceed white.
const BRIGHTEST: f64 = 0.005;

/// A grey picture, reduced.
pub fn grey(grey: &Grey, max_side: u32) -> Picture {
    let step = step([grey.width, grey.height], max_side, 1);
    let [across, down] = [grey.width, grey.height].map(|side| (side / step).max(1));
    let level = |x: usize, y: usize| match &grey.samples {
        Samples::U8(samples) => u32::from(samples[y * grey.width + x]),
        Samples::U16(samples) => u32::from(samples[y * grey.width + x]) >> 8,
    };
    let mut rgba = Vec::with_capacity(4 * across * down);
    for row in 0..down {
        for column in 0..across {
            let [xs, ys] =
                [(column, grey.width), (row, grey.height)].map(|(at, size)| at * step..((at + 1) * step).min(size));
            let count = (xs.len() * ys.len()) as u32;
            let sum: u32 = ys.flat_map(|y| xs.clone().map(move |x| (x, y))).map(|(x, y)| level(x, y)).sum();
            let mean = (sum / count.max(1)) as u8;
            rgba.extend([mean, mean, mean, 255]);
        }
    }
    Picture { width: across as u32, height: down as u32, rgba }
}

/// The picture of a sensor: each pixel is the mean of the sites of a square of at least one filter pattern, minus the black level, with
/// channels balanced by their means and a square-root tone curve.
pub fn colours(sensor: &Sensor, max_side: u32) -> Picture {
    let pattern = &sensor.mosaic.pattern;
    let least = pattern.width().max(pattern.height()).max(2);
    let step = step([sensor.width, sensor.height], max_side, least);
    let [across, down] = [sensor.width, sensor.height].map(|side| (side / step).max(1));
    // Of large squares only a part of the sites is used.
    let stride = (step / least / 2).max(1) * least;
    let mut light = vec![[0f32; 3]; across * down];
    for row in 0..down {
        for column in 0..across {
            let (mut sums, mut counts) = ([0f64; 3], [0f64; 3]);
            for (top, left) in tiles(row * step, step, stride, sensor.height, column * step, sensor.width) {
                for y in top..(top + least).min(sensor.height) {
                    for x in left..(left + least).min(sensor.width) {
                        let level = f64::from(sensor.samples[y * sensor.width + x]) - sensor.mosaic.black.at(x, y);
                        for which in parts(pattern.at(x, y)) {
                            sums[*which] += level;
                            counts[*which] += 1.0;
                        }
                    }
                }
            }
            light[row * across + column] = [0, 1, 2].map(|k| (sums[k] / counts[k].max(1.0)).max(0.0) as f32);
        }
    }
    let gains = gains(&light);
    let mut rgba = Vec::with_capacity(4 * light.len());
    for pixel in &light {
        rgba.extend([0, 1, 2].map(|k| (255.0 * (pixel[k] * gains[k]).min(1.0).sqrt()) as u8));
        rgba.push(255);
    }
    Picture { width: across as u32, height: down as u32, rgba }
}

/// Top left corners of the squares of a pixel's sites that are used.
fn tiles(
    top: usize,
    step: usize,
    stride: usize,
    height: usize,
    left: usize,
    width: usize,
) -> impl Iterator<Item = (usize, usize)> {
    let rows = (top..(top + step).min(height)).step_by(stride);
    rows.flat_map(move |row| (left..(left + step).min(width)).step_by(stride).map(move |column| (row, column)))
}

/// Indices of the channels (red, green, blue) that a filter transmits.
fn parts(colour: Colour) -> &'static [usize] {
    match colour {
        Colour::Red => &[0],
        Colour::Green | Colour::Emerald => &[1],
        Colour::Blue => &[2],
        Colour::Cyan => &[1, 2],
        Colour::Magenta => &[0, 2],
        Colour::Yellow => &[0, 1],
        Colour::White => &[0, 1, 2],
    }
}

/// Factors that make the mean of the picture grey and its brightest part white.
fn gains(light: &[[f32; 3]]) -> [f32; 3] {
    let mean = |k: usize| light.iter().map(|pixel| f64::from(pixel[k])).sum::<f64>() / light.len().max(1) as f64;
    let means = [0, 1, 2].map(mean);
    let mut greens: Vec<f32> = light.iter().map(|pixel| pixel[1]).collect();
    greens.sort_unstable_by(f32::total_cmp);
    let at = (greens.len() as f64 * (1.0 - BRIGHTEST)) as usize;
    let white = f64::from(greens.get(at.min(greens.len().saturating_sub(1))).copied().unwrap_or(1.0)).max(1e-3);
    means.map(|mean| if mean > 0.0 { (means[1].max(1e-3) / mean / white) as f32 } else { (1.0 / white) as f32 })
}

/// Number of sites along a side of a pixel, so that no side of the picture exceeds `max_side`.
fn step([width, height]: [usize; 2], max_side: u32, least: usize) -> usize {
    let needed = width.max(height).div_ceil(max_side.max(1) as usize);
    needed.max(1).next_multiple_of(least)
}
