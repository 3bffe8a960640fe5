//! Pictures for display: full size, or reduced.

use image::DynamicImage;

use super::jpeg::{Luma, Plane8};
use super::open::{bits, decoder, decoding_error, prepared};
use crate::error::Result;

/// A picture for showing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue and opacity of each pixel, row by row.
    pub rgba: Vec<u8>,
}

/// A picture for showing, reduced so that neither side exceeds `max_side`.
///
/// 16-bit pictures are stretched to their brightest sample, since many use 10 or 12 bits of the 16.
///
/// # Errors
/// As [`super::photo`].
pub fn picture(bytes: &[u8], max_side: Option<u32>) -> Result<Picture> {
    let bytes = prepared(bytes)?;
    let image = DynamicImage::from_decoder(decoder(&bytes)?).map_err(decoding_error)?;
    bits(image.color())?;
    Ok(match max_side {
        Some(side) => reduced(&image, side),
        None => shown(image),
    })
}

/// A decoded picture, reduced.
pub fn reduced(image: &DynamicImage, max_side: u32) -> Picture {
    let [width, height] = fitted([image.width(), image.height()], max_side);
    shown(if width < image.width() || height < image.height() {
        image.thumbnail_exact(width, height)
    } else {
        image.clone()
    })
}

fn shown(mut image: DynamicImage) -> Picture {
    if image.color().bytes_per_pixel() / image.color().channel_count() == 2 {
        stretch(&mut image);
    }
    let rgba = image.into_rgba8();
    Picture { width: rgba.width(), height: rgba.height(), rgba: rgba.into_raw() }
}

/// Sizes with the same proportions, neither beyond `max_side`.
fn fitted([width, height]: [u32; 2], max_side: u32) -> [u32; 2] {
    let longest = u64::from(width.max(height));
    let limit = u64::from(max_side.max(1)).min(longest);
    [width, height].map(|side| ((u64::from(side) * limit + longest / 2) / longest).max(1) as u32)
}

/// Scales 16-bit samples so that the brightest is white.
fn stretch(image: &mut DynamicImage) {
    let opaque = !image.color().has_alpha();
    let apply = |samples: &mut [u16]| {
        let top = samples.iter().copied().max().unwrap_or(0);
        if top > 0 && opaque {
            samples.iter_mut().for_each(|s| *s = (u64::from(*s) * 65535 / u64::from(top)) as u16);
        }
    };
    match image {
        DynamicImage::ImageLuma16(buffer) => apply(buffer),
        DynamicImage::ImageRgb16(buffer) => apply(buffer),
        _ => {}
    }
}

/// The middle of a picture, of the shape of another one; as it is where the two agree to a fiftieth.
pub fn cropped(picture: Picture, [width, height]: [u64; 2]) -> Picture {
    let [own, other] =
        [[picture.width.into(), picture.height.into()], [width, height]].map(|[w, h]: [u64; 2]| w as f64 / h as f64);
    if (own / other - 1.0).abs() < 0.02 {
        return picture;
    }
    let [across, down] = if own > other {
        [(f64::from(picture.height) * other).round() as u32, picture.height]
    } else {
        [picture.width, (f64::from(picture.width) / other).round() as u32]
    };
    let [across, down] = [across.clamp(1, picture.width), down.clamp(1, picture.height)];
    let [left, top] = [(picture.width - across) / 2, (picture.height - down) / 2].map(|n| n as usize);
    let rows = picture.rgba.chunks_exact(4 * picture.width as usize).skip(top).take(down as usize);
    let rgba = rows.flat_map(|row| &row[4 * left..4 * (left + across as usize)]).copied().collect();
    Picture { width: across, height: down, rgba }
}

/// The small picture of a JPEG: means of its luma, coloured by the means of its chroma blocks (JFIF 1.02).
pub fn reduced_luma(luma: &Luma, max_side: u32) -> Picture {
    let [width, height] = fitted([luma.plane.width as u32, luma.plane.height as u32], max_side);
    let means = means(&luma.plane.samples, luma.plane.width, luma.plane.height, [width, height]);
    let mut rgba = Vec::with_capacity(4 * means.len());
    for (k, mean) in means.iter().enumerate() {
        let place = [k as u32 % width, k as u32 / width];
        let [blue, red] = match &luma.chroma {
            Some(chroma) => [0, 1].map(|c| between(&chroma[c], &luma.plane, place, [width, height]) - 128.0),
            None => [0.0; 2],
        };
        let rgb = [mean + 1.402 * red, mean - 0.344_136 * blue - 0.714_136 * red, mean + 1.772 * blue];
        rgba.extend(rgb.map(|level| level.round() as u8));
        rgba.push(255);
    }
    Picture { width, height, rgba }
}

/// Means of the samples under each pixel of a smaller picture.
fn means(samples: &[u8], width: usize, height: usize, small: [u32; 2]) -> Vec<f32> {
    let [across, down] = small.map(|side| side as usize);
    let edges = |size: usize, count: usize| (0..=count).map(|k| k * size / count).collect::<Vec<_>>();
    let (columns, rows) = (edges(width, across), edges(height, down));
    let mut means = Vec::with_capacity(across * down);
    for row in rows.windows(2) {
        let mut sums = vec![0u64; across];
        for line in samples[row[0] * width..row[1] * width].chunks_exact(width) {
            for (sum, column) in sums.iter_mut().zip(columns.windows(2)) {
                *sum += u64::from(line[column[0]..column[1]].iter().map(|s| u32::from(*s)).sum::<u32>());
            }
        }
        for (sum, column) in sums.iter().zip(columns.windows(2)) {
            means.push(*sum as f32 / ((column[1] - column[0]) * (row[1] - row[0])) as f32);
        }
    }
    means
}

/// The plane of block means at the middle of a small picture's pixel, bilinear.
fn between(plane: &Plane8, luma: &Plane8, place: [u32; 2], small: [u32; 2]) -> f32 {
    // blocks of a unit cover the same pixels in both planes
    let size = [plane.width, plane.height];
    let covered = [0, 1].map(|axis| {
        let pixels = [luma.width, luma.height][axis];
        let block = (pixels as f32 / size[axis] as f32 / 8.0).ceil() * 8.0;
        let at = (place[axis] as f32 + 0.5) * pixels as f32 / small[axis] as f32 / block - 0.5;
        at.clamp(0.0, (size[axis] - 1) as f32)
    });
    let [x, y] = covered.map(|at| at as usize);
    let [fx, fy] = [covered[0] - x as f32, covered[1] - y as f32];
    let sample = |x: usize, y: usize| f32::from(plane.samples[y.min(size[1] - 1) * size[0] + x.min(size[0] - 1)]);
    let row = |y: usize| sample(x, y) + fx * (sample(x + 1, y) - sample(x, y));
    row(y) + fy * (row(y + 1) - row(y))
}
