//! Light as cameras meet it: a lens that darkens the corners, lamps at one side, a tone curve. Light multiplies.

use sightline::image::{Grey, Samples};

use super::painter::{Canvas, Uniform};

/// How a picture is lit.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Share of the light that is lost in the corners.
    pub vignetting: f64,
    /// A wave of light across the picture: share of the mean, direction and phase, pixels in a radian of it.
    wave: f64,
    towards: f64,
    phase: f64,
    length: f64,
}

impl Light {
    /// At random: up to so much vignetting, and lamps that change the light by up to `steepest` of it a pixel.
    pub fn drawn(random: &mut Uniform, vignetting: f64, steepest: f64) -> Self {
        let wave = 0.15;
        Self {
            vignetting: random.within(0.0, vignetting),
            wave,
            towards: random.within(0.0, std::f64::consts::TAU),
            phase: random.within(0.0, std::f64::consts::TAU),
            length: wave / random.within(0.0, steepest).max(1e-9),
        }
    }

    /// Light at a place of a picture, 1 on average of the lamps in the middle of the lens.
    pub fn at(&self, canvas: &Canvas, u: f64, v: f64) -> f64 {
        let [half_u, half_v] = [canvas.width, canvas.height].map(|size| size as f64 / 2.0);
        let [x, y] = [u - half_u, v - half_v];
        let along = x * self.towards.cos() + y * self.towards.sin();
        let lens = 1.0 - self.vignetting * (x * x + y * y) / (half_u * half_u + half_v * half_v);
        lens * (1.0 + self.wave * (along / self.length + self.phase).sin())
    }

    /// Lights a picture.
    pub fn fall(&self, canvas: &mut Canvas) {
        for i in 0..canvas.levels.len() {
            let [x, y] = [i % canvas.width, i / canvas.width].map(|place| place as f64 + 0.5);
            let light = self.at(canvas, x, y);
            canvas.levels[i] *= light;
        }
    }

    /// Direction in which the light of such a picture grows at a place.
    pub fn direction(&self, canvas: &Canvas, u: f64, v: f64) -> [f64; 2] {
        let across = self.at(canvas, u + 0.5, v) - self.at(canvas, u - 0.5, v);
        let down = self.at(canvas, u, v + 0.5) - self.at(canvas, u, v - 0.5);
        let length = across.hypot(down).max(1e-12);
        [across / length, down / length]
    }
}

/// The tone curve of a camera, on a scale to 255.
pub fn tone(canvas: &mut Canvas, gamma: f64) {
    for level in &mut canvas.levels {
        *level = 255.0 * (level.clamp(0.0, 255.0) / 255.0).powf(1.0 / gamma);
    }
}

/// A picture of 8 bits as a JPEG of this quality has it.
pub fn compressed(picture: &Grey, quality: u8) -> Grey {
    let Samples::U8(samples) = &picture.samples else { panic!("8 bits are compressed") };
    let mut file = Vec::new();
    let size = [picture.width as u16, picture.height as u16];
    let encoder = jpeg_encoder::Encoder::new(&mut file, quality);
    encoder.encode(samples, size[0], size[1], jpeg_encoder::ColorType::Luma).expect("a JPEG");
    sightline::decode::grey(&file, sightline::detection::Channel::Grey).expect("a JPEG")
}
