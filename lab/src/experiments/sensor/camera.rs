//! A camera between its lens and its files: filters and noise of the sensor, and what is made of the samples before a JPEG is kept.

use crate::reason::LabReason;
use image::ImageEncoder;
use image::codecs::jpeg::JpegEncoder;
use sightline_plan::reason::PlanReason;

use sightline::detection::Colour;
use sightline::error::{Error, Place, Result};
use sightline::image::{Grey, Samples};
use sightline::noise::Noise;
use sightline::sensor::{Black, Header, Mosaic, Pattern, Sensor, Shot, Unpacked};

const PATTERN: &str = "RGGB";
/// Sample without light and the largest one, of 14 bits.
const BLACK: f64 = 512.0;
const WHITE: f64 = 16383.0;
/// Light that the filters let through, as shares of what green gets: daylight on a common sensor.
const RED: f64 = 0.55;
const BLUE: f64 = 0.7;
/// Noise of reading a sample out.
const READ: f64 = 4.0;
/// Share of the difference to its surroundings that sharpening adds to a pixel.
pub const SHARPENED: f64 = 0.8;
/// Share of an S in the tone curve.
const CONTRAST: f64 = 0.3;
/// Shares of the colours in luma (ITU-R BT.601), as JPEG has it.
const LUMA: [f32; 3] = [0.299, 0.587, 0.114];

fn share(colour: Colour) -> f64 {
    match colour {
        Colour::Red => RED,
        Colour::Blue => BLUE,
        _ => 1.0,
    }
}

fn pattern() -> Option<Pattern> {
    Pattern::parse(PATTERN, 2)
}

/// What the sensor reads out of a picture without noise. Full scale of green has a standard deviation of `noise` by its photons.
///
/// # Errors
/// As [`Unpacked::into_shot`].
pub fn exposed(light: &Grey, noise: f64, seed: u64, stream: u64) -> Result<Sensor> {
    let invalid = || Error::Invalid { reason: LabReason::PixelNoise.into(), at: Place::field("pixel_noise") };
    let pattern = pattern().ok_or_else(invalid)?;
    let mut random = Noise::new(seed, stream);
    let scale = WHITE - BLACK;
    // The variance of n photons is n: in samples it grows with the light by this.
    let gain = noise * noise * scale;
    let mut samples = Vec::with_capacity(light.width * light.height);
    for (k, level) in levels(light).enumerate() {
        let filter = share(pattern.at(k % light.width, k / light.width));
        let light = level * filter * scale;
        let sample = BLACK + light + (READ * READ + gain * light).sqrt() * random.normal();
        samples.push(sample.round().clamp(0.0, WHITE) as u16);
    }
    let (width, height) = (light.width as u32, light.height as u32);
    let mosaic = Mosaic { pattern, active_area: [0, 0, width, height], black: Black::uniform(BLACK), white: WHITE };
    let header = Header { format: "DNG".into(), width, height, bits: 14, mosaic: Some(mosaic), ..Header::default() };
    match (Unpacked { header, samples: Samples::U16(samples), small: Vec::new() }).into_shot()? {
        Shot::Sensor(sensor) => Ok(sensor),
        Shot::Photo(_) => Err(invalid()),
    }
}

fn levels(light: &Grey) -> Box<dyn Iterator<Item = f64> + '_> {
    match &light.samples {
        Samples::U8(samples) => Box::new(samples.iter().map(|s| f64::from(*s) / 255.0)),
        Samples::U16(samples) => Box::new(samples.iter().map(|s| f64::from(*s) / 65535.0)),
    }
}

/// Red, green and blue of every pixel, shares of full scale.
pub struct Developed {
    width: usize,
    height: usize,
    planes: [Vec<f32>; 3],
}

/// A plane read with its border mirrored, which keeps the pattern of filters.
struct Mirrored<'a> {
    values: &'a [f32],
    width: isize,
    height: isize,
}

impl Mirrored<'_> {
    fn at(&self, x: isize, y: isize) -> f32 {
        let inside = |at: isize, size: isize| if at < 0 { -at } else { at.min(2 * (size - 1) - at) };
        self.values[(inside(y, self.height) * self.width + inside(x, self.width)) as usize]
    }
}

impl Developed {
    /// White balance and demosaicing: green between its sites with the bend of the other colour there (Hamilton and Adams 1997,
    /// US patent 5 629 734, without its directions), red and blue by their differences to green.
    pub fn of(sensor: &Sensor) -> Self {
        let (width, height) = (sensor.width, sensor.height);
        let filter = |x: isize, y: isize| sensor.mosaic.pattern.at(x.unsigned_abs(), y.unsigned_abs());
        let light: Vec<f32> = sensor
            .samples
            .iter()
            .enumerate()
            .map(|(k, sample)| {
                let colour = sensor.mosaic.pattern.at(k % width, k / width);
                ((f64::from(*sample) - BLACK) / (WHITE - BLACK) / share(colour)) as f32
            })
            .collect();
        let read = |values| Mirrored { values, width: width as isize, height: height as isize };
        let places = || (0..height as isize).flat_map(|y| (0..width as isize).map(move |x| (x, y)));
        let l = read(&light);
        let green = |(x, y): (isize, isize)| {
            let around = |step| l.at(x - step, y) + l.at(x + step, y) + l.at(x, y - step) + l.at(x, y + step);
            let own = l.at(x, y);
            if filter(x, y) == Colour::Green { own } else { around(1) / 4.0 + (4.0 * own - around(2)) / 8.0 }
        };
        let green: Vec<f32> = places().map(green).collect();
        let g = read(&green);
        let other = |colour: Colour| {
            let level = |(x, y): (isize, isize)| {
                if filter(x, y) == colour {
                    return l.at(x, y);
                }
                let (mut sum, mut count) = (0.0, 0.0);
                for (i, j) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy))) {
                    // Steps of two lead from a site to one of the same colour, and so does the mirror.
                    if filter(i + 2, j + 2) == colour {
                        sum += l.at(i, j) - g.at(i, j);
                        count += 1.0;
                    }
                }
                g.at(x, y) + sum / f32::max(count, 1.0)
            };
            places().map(level).collect::<Vec<f32>>()
        };
        let planes = [other(Colour::Red), green.clone(), other(Colour::Blue)];
        Self { width, height, planes }
    }

    /// Each pixel differs more from the binomial mean of its surroundings.
    pub fn sharpened(&self) -> Self {
        let sharpen = |plane: &Vec<f32>| {
            let p = Mirrored { values: plane, width: self.width as isize, height: self.height as isize };
            let places = (0..self.height as isize).flat_map(|y| (0..self.width as isize).map(move |x| (x, y)));
            let level = |(x, y): (isize, isize)| {
                let row = |dy: isize| p.at(x - 1, y + dy) + 2.0 * p.at(x, y + dy) + p.at(x + 1, y + dy);
                let soft = (row(-1) + 2.0 * row(0) + row(1)) / 16.0;
                let own = p.at(x, y);
                (own + SHARPENED as f32 * (own - soft)).clamp(0.0, 1.0)
            };
            places.map(level).collect()
        };
        Self { planes: [0, 1, 2].map(|k| sharpen(&self.planes[k])), ..*self }
    }

    /// Gamma and an S.
    pub fn toned(&self) -> Self {
        let tone = |level: &f32| {
            let bright = level.clamp(0.0, 1.0).powf(1.0 / 2.2);
            let curved = bright * bright * (3.0 - 2.0 * bright);
            // Files of a camera have eight bits.
            ((bright + CONTRAST as f32 * (curved - bright)) * 255.0).round() / 255.0
        };
        Self { planes: [0, 1, 2].map(|k| self.planes[k].iter().map(tone).collect()), ..*self }
    }

    /// The luma plane.
    pub fn luma(&self) -> Grey {
        let level = |k: usize| (0..3).map(|c| LUMA[c] * self.planes[c][k]).sum::<f32>();
        let samples = (0..self.planes[0].len()).map(|k| (level(k).clamp(0.0, 1.0) * 65535.0).round() as u16);
        Grey { width: self.width, height: self.height, samples: Samples::U16(samples.collect()) }
    }

    /// A file of it.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the encoder refuses.
    pub fn jpeg(&self, quality: u8) -> Result<Vec<u8>> {
        let byte = |level: f32| (level * 255.0).round() as u8;
        let pixels: Vec<u8> =
            (0..self.planes[0].len()).flat_map(|k| [0, 1, 2].map(|c| byte(self.planes[c][k]))).collect();
        let mut file = Vec::new();
        let encoder = JpegEncoder::new_with_quality(&mut file, quality);
        let written =
            encoder.write_image(&pixels, self.width as u32, self.height as u32, image::ExtendedColorType::Rgb8);
        written.map_err(|error| Error::Invalid {
            reason: PlanReason::CannotWritePicture { message: error.to_string() }.into(),
            at: Place::default(),
        })?;
        Ok(file)
    }
}
