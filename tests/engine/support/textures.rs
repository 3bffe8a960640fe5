//! Textures without targets: fractal noise, gravel and leaves, as a phone's JPEG has them.

use sightline::image::{Grey, Samples};
use sightline::noise::Noise;

use super::painter::Uniform;

/// Kinds of texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Texture {
    Fractal,
    Gravel,
    Leaves,
}

impl Texture {
    pub const ALL: [Self; 3] = [Self::Fractal, Self::Gravel, Self::Leaves];
}

/// Grey levels of a texture of this many pixels a side, before noise and compression.
pub fn levels(random: &mut Uniform, texture: Texture, side: usize) -> Vec<f64> {
    let blur = random.within(0.5, 1.0);
    let contrast = random.within(20.0, 70.0);
    let mut levels = vec![random.within(80.0, 150.0); side * side];
    match texture {
        Texture::Fractal => {
            let roughness = random.within(0.5, 0.85);
            let (mut size, mut share) = (64.0, 1.0);
            while size >= 2.0 {
                let count = (side as f64 / size) as usize + 2;
                let nodes: Vec<f64> = (0..count * count).map(|_| random.within(-1.0, 1.0)).collect();
                for (i, level) in levels.iter_mut().enumerate() {
                    let [x, y] = [i % side, i / side].map(|k| k as f64 / size);
                    let (fx, fy) = (x.fract(), y.fract());
                    let node = |dx: usize, dy: usize| nodes[(y as usize + dy) * count + x as usize + dx];
                    let upper = node(0, 0) * (1.0 - fx) + node(1, 0) * fx;
                    let lower = node(0, 1) * (1.0 - fx) + node(1, 1) * fx;
                    *level += contrast * share * (upper * (1.0 - fy) + lower * fy);
                }
                (size, share) = (size / 2.0, share * roughness);
            }
        }
        Texture::Gravel | Texture::Leaves => {
            let ratios = if texture == Texture::Gravel { [0.5, 1.0] } else { [0.2, 0.6] };
            let largest = random.within(3.0, 12.0);
            for _ in 0..(side * side) / (largest * largest) as usize {
                let (u, v) = (random.within(0.0, side as f64), random.within(0.0, side as f64));
                let a = random.within(0.3, 1.0) * largest;
                let b = a * random.within(ratios[0], ratios[1]);
                let (s, c) = random.within(0.0, 3.1).sin_cos();
                let (own, shade) = (random.within(-1.0, 1.0), random.within(-0.5, 0.5));
                let reach = a + 3.0;
                let span = |at: f64| (at - reach).max(0.0) as usize..((at + reach).max(0.0) as usize).min(side);
                for y in span(v) {
                    for x in span(u) {
                        let [dx, dy] = [x as f64 + 0.5 - u, y as f64 + 0.5 - v];
                        let (along, across) = ((c * dx + s * dy) / a, (c * dy - s * dx) / b);
                        let cover = 0.5 * libm::erfc((along.hypot(across) - 1.0) * b / blur / 2f64.sqrt());
                        let level = &mut levels[y * side + x];
                        *level += cover * (115.0 + contrast * (own + shade * across) - *level);
                    }
                }
            }
        }
    }
    levels
}

/// The picture of these levels with noise, through a JPEG of this quality.
pub fn compressed(levels: &[f64], side: usize, noise: f64, quality: u8, seed: u64) -> Grey {
    let mut source = Noise::new(seed, 0);
    let sample = |level: &f64| (level + noise * source.normal()).round().clamp(0.0, 255.0) as u8;
    let picture = Grey { width: side, height: side, samples: Samples::U8(levels.iter().map(sample).collect()) };
    super::light::compressed(&picture, quality)
}
