//! Centre, size and orientation of a blob without an outline: elliptical adaptive moments.
//!
//! A Gaussian window of mean μ and covariance W weights deviations from the background; of a Gaussian blob that it matches, the
//! weighted covariance is W / 2. So μ ← Σ w I x / Σ w I, W ← 2 Σ w I (x - μ)(x - μ)ᵀ / Σ w I, until they stand still: noise far
//! out and neighbours have no weight, as they have in plain moments (Bernstein & Jarvis, Astronomical Journal 123, 2002).

use super::edges::surround::Surround;
use crate::detect::acceptance::place::{NARROWEST, WIDEST};
use crate::image::{Sample, SampleView};

/// Rounds at most, and the change of the place, in pixels, that ends them.
const ROUNDS: usize = 12;
const STILL: f64 = 0.02;
/// Half the side of the window in its standard deviations.
const REACH: f64 = 2.5;

/// Centre and covariance uu, uv, vv of a blob.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AdaptiveMoments {
    pub u: f64,
    pub v: f64,
    pub covariance: [f64; 3],
}

/// The moments of the blob at a place, that of a picture of this blur, above or below its background, whose plane is relative to `origin`; `None` if the
/// moments lead away from it, by more than `farthest` pixels, or to nothing.
pub(crate) fn measure<T: Sample>(
    plane: &SampleView<T>,
    origin: [f64; 2],
    ground: &Surround,
    bright: bool,
    blur: f64,
    farthest: f64,
) -> Option<AdaptiveMoments> {
    let sign = if bright { 1.0 } else { -1.0 };
    let [mut u, mut v] = origin;
    // wider than a point's image, so that what lies beside it is felt
    let first = 2.0 * blur * blur;
    let [mut uu, mut uv, mut vv] = [first, 0.0, first];
    let [least, most] = [NARROWEST * blur, WIDEST * blur].map(|sigma| sigma * sigma);
    for _ in 0..ROUNDS {
        let det = uu * vv - uv * uv;
        let inverse = [vv / det, -uv / det, uu / det];
        let [half_u, half_v] = [uu, vv].map(|variance| REACH * variance.sqrt());
        if !plane.holds(u, v, 1.0) || !(det > 0.0) {
            return None;
        }
        let range = |middle: f64, half: f64, size: usize| {
            (middle - half).max(0.0) as usize..((middle + half).ceil().max(0.0) as usize).min(size)
        };
        let mut sums = [0.0; 6];
        for y in range(v, half_v, plane.height) {
            let dy = y as f64 + 0.5 - v;
            let row = plane.row(y);
            for x in range(u, half_u, plane.width) {
                let dx = x as f64 + 0.5 - u;
                let distance = inverse[0] * dx * dx + 2.0 * inverse[1] * dx * dy + inverse[2] * dy * dy;
                if distance > REACH * REACH {
                    continue;
                }
                let [from_u, from_v] = [u + dx - origin[0], v + dy - origin[1]];
                let level = ground.level + ground.slope[0] * from_u + ground.slope[1] * from_v;
                let weight = (-0.5 * distance).exp() * sign * (f64::from(row[x].level()) - level);
                let terms = [1.0, dx, dy, dx * dx, dx * dy, dy * dy];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += weight * term);
            }
        }
        let [light, x, y, xx, xy, yy] = sums;
        if !(light > 0.0) {
            return None;
        }
        let [x, y] = [x / light, y / light];
        (u, v) = (u + x, v + y);
        if !((u - origin[0]).hypot(v - origin[1]) <= farthest) {
            return None;
        }
        let next = [xx / light - x * x, xy / light - x * y, yy / light - y * y].map(|moment| 2.0 * moment);
        [uu, uv, vv] = bounded(next, least, most);
        if x.hypot(y) < STILL {
            break;
        }
    }
    Some(AdaptiveMoments { u, v, covariance: [uu, uv, vv] })
}

/// A covariance with its principal variances within bounds.
fn bounded([uu, uv, vv]: [f64; 3], least: f64, most: f64) -> [f64; 3] {
    let (mean, half, lean) = ((uu + vv) / 2.0, (uu - vv) / 2.0, uv);
    let size = half.hypot(lean);
    let [large, small] = [mean + size, mean - size].map(|variance| variance.clamp(least, most));
    let scale = if size > 0.0 { (large - small) / (2.0 * size) } else { 0.0 };
    let middle = (large + small) / 2.0;
    [middle + scale * half, scale * lean, middle - scale * half]
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const SIZE: usize = 64;

    /// A level of 40 that rises by 0.2 a pixel along u, with Gaussian blobs of this height: place and standard deviations.
    fn picture(height: f64, blobs: &[[f64; 4]]) -> Vec<u8> {
        let level = |x: f64, y: f64| {
            let of = |[u, v, su, sv]: &[f64; 4]| (-0.5 * (((x - u) / su).powi(2) + ((y - v) / sv).powi(2))).exp();
            40.0 + 0.2 * x + height * blobs.iter().map(of).sum::<f64>()
        };
        let pixel = |i: usize| level((i % SIZE) as f64 + 0.5, (i / SIZE) as f64 + 0.5).round() as u8;
        (0..SIZE * SIZE).map(pixel).collect()
    }

    fn found(samples: &[u8], from: [f64; 2], bright: bool) -> Option<AdaptiveMoments> {
        let ground = Surround {
            level: 40.0 + 0.2 * from[0],
            slope: [0.2, 0.0],
            slope_covariance: [0.0; 3],
            noise: 0.3,
            contrast: 100.0,
            uneven: 0.0,
            outer: 10.0,
        };
        measure(&SampleView::new(SIZE, SIZE, samples), from, &ground, bright, 2.0, 4.0)
    }

    #[test]
    fn a_gaussian_has_its_own_place_and_covariance() {
        let samples = picture(150.0, &[[30.3, 33.8, 3.2, 2.1]]);
        let moments = found(&samples, [28.5, 35.0], true).unwrap();
        assert!((moments.u - 30.3).hypot(moments.v - 33.8) < 0.02, "{moments:?}");
        let [uu, uv, vv] = moments.covariance;
        assert!((uu.sqrt() - 3.2).abs() < 0.1 && (vv.sqrt() - 2.1).abs() < 0.1 && uv.abs() < 0.1, "{moments:?}");
    }

    #[test]
    fn a_neighbour_hardly_pulls() {
        let samples = picture(150.0, &[[30.0, 30.0, 2.0, 2.0], [40.0, 30.0, 2.0, 2.0]]);
        let moments = found(&samples, [29.0, 31.0], true).unwrap();
        assert!((moments.u - 30.0).hypot(moments.v - 30.0) < 0.05, "{moments:?}");
    }

    #[test]
    fn what_is_no_lump_of_the_place_is_none() {
        // of the other polarity, and farther away than it may be
        assert!(found(&picture(150.0, &[[30.0, 30.0, 2.0, 2.0]]), [30.0, 30.0], false).is_none());
        assert!(found(&picture(150.0, &[[36.0, 30.0, 3.0, 3.0]]), [30.0, 30.0], true).is_none());
    }
}
