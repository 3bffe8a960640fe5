//! The inverse cosine transform of an 8 x 8 block, in floating point: samples are rounded once.

use wide::{bytemuck, f32x4, i16x8, i32x4, i32x8, u8x16};

/// Added to the mean of a block, so that samples are rounded to the nearest, halves upwards as elsewhere.
const LEVEL: f32 = 128.0 + 1.0 / 1024.0;
/// Adding this leaves the rounded number in the lowest bits.
const ROUND: f32 = 12_582_912.0;

/// Coefficients of a block, weighted; columns one after the other. What a damaged run passes lands behind them.
pub type CoefficientBlock = [f32; 80];

/// Place of a coefficient in a [`CoefficientBlock`], by its place in the file.
pub const PLACES: [u8; 80] = {
    let mut places = [64; 80];
    let (mut x, mut y, mut k) = (0usize, 0usize, 0);
    while k < 64 {
        places[k] = (x * 8 + y) as u8;
        // up and to the right on even diagonals, down and to the left on odd ones
        if (x + y) % 2 == 0 {
            if x == 7 {
                y += 1;
            } else if y == 0 {
                x += 1;
            } else {
                (x, y) = (x + 1, y - 1);
            }
        } else if y == 7 {
            x += 1;
        } else if x == 0 {
            y += 1;
        } else {
            (x, y) = (x - 1, y + 1);
        }
        k += 1;
    }
    places
};

/// Weights of the coefficients in the places of a [`CoefficientBlock`], from the file's steps in its own order.
///
/// The factors of Arai, Agui and Nakajima's transform, cos(kπ/16) √2 of rows and columns, are taken into the steps.
pub fn weights(steps: &[u16; 64]) -> CoefficientBlock {
    let factor = |k: usize| if k == 0 { 1.0 } else { (k as f64 * std::f64::consts::PI / 16.0).cos() * 2f64.sqrt() };
    let mut weights = [0.0; 80];
    for (step, place) in steps.iter().zip(PLACES) {
        let place = usize::from(place);
        weights[place] = (f64::from(*step) * factor(place / 8) * factor(place % 8) / 8.0) as f32;
    }
    weights
}

/// One dimension of the transform, four at a time (Arai, Agui, Nakajima: A fast DCT-SQ scheme for images, 1988, reversed).
#[inline(always)]
fn eight(c: [f32x4; 8]) -> [f32x4; 8] {
    let (sum, difference) = (c[0] + c[4], c[0] - c[4]);
    let outer = c[2] + c[6];
    let inner = (c[2] - c[6]) * f32x4::splat(std::f32::consts::SQRT_2) - outer;
    let even = [sum + outer, difference + inner, difference - inner, sum - outer];
    let (a, b) = (c[5] + c[3], c[5] - c[3]);
    let (e, f) = (c[1] + c[7], c[1] - c[7]);
    let turned = (b + f) * f32x4::splat(1.847_759_1);
    let first = e + a;
    let second = turned - b * f32x4::splat(2.613_126) - first;
    let third = (e - a) * f32x4::splat(std::f32::consts::SQRT_2) - second;
    let fourth = f * f32x4::splat(1.082_392_2) - turned + third;
    [
        even[0] + first,
        even[1] + second,
        even[2] + third,
        even[3] - fourth,
        even[3] + fourth,
        even[2] - third,
        even[1] - second,
        even[0] - first,
    ]
}

/// Samples of a block, row by row.
#[inline(always)]
pub fn samples(block: &CoefficientBlock) -> [u8; 64] {
    let load = |at: usize| f32x4::new([block[at], block[at + 1], block[at + 2], block[at + 3]]);
    // columns stand one after the other: the first transform runs along the rows
    let mut upper: [f32x4; 8] = std::array::from_fn(|x| load(8 * x));
    let lower: [f32x4; 8] = std::array::from_fn(|x| load(8 * x + 4));
    upper[0] += f32x4::new([LEVEL, 0.0, 0.0, 0.0]);
    let (upper, lower) = (eight(upper), eight(lower));
    let turn = |v: &[f32x4; 8], x: usize| f32x4::transpose([v[x], v[x + 1], v[x + 2], v[x + 3]]);
    let side = |x: usize| {
        let ([a, b, c, d], [e, f, g, h]) = (turn(&upper, x), turn(&lower, x));
        eight([a, b, c, d, e, f, g, h])
    };
    let (left, right) = (side(0), side(4));
    let whole = |v: f32x4| bytemuck::cast::<_, i32x4>(v + f32x4::splat(ROUND)) - i32x4::splat(ROUND.to_bits() as i32);
    let row = |y: usize| i16x8::from_i32x8_saturate(bytemuck::cast::<_, i32x8>([whole(left[y]), whole(right[y])]));
    let two = |y: usize| u8x16::narrow_i16x8(row(y), row(y + 1));
    bytemuck::cast([two(0), two(2), two(4), two(6)])
}

/// The samples of a block that is its mean alone.
pub fn mean(direct: i32, step: u16) -> u8 {
    (((direct * i32::from(step) + 4) >> 3) + 128).clamp(0, 255) as u8
}
