//! Light that neighbouring features add to the background of a target.
//!
//! Blur carries the light of a code's ring, or of a neighbour, onto the pixels of the rim. Where it is too little to stand out as an
//! outlier it pulls the centre all the same, and all of it in one direction: noise of single pixels would average out, this does not.
//! Its size is known well enough to say by how much the centre may be off: along each ray an object begins where the level
//! has risen half-way from its least to its largest, with a rim as blurred as the target's own. (With the target's own light taken off
//! the ray, or the fit's background for the least level, centres of small coded dots come out worse: .0215 and .0190 px instead of .0183.)

use wide::f32x4;

use crate::detect::acceptance::fit::RISE;
use crate::detect::ellipse::outline::Outline;
use crate::detect::ellipse::rays::rim_points;
use crate::detect::normal::normal_distribution;
use crate::image::{Sample, SampleView};

/// Rays around an outline.
const RAYS: usize = 48;
/// Samples along a ray, a pixel apart, at most.
const LONGEST: usize = 48;
/// Distance beyond the rim's pixels that is examined, in blurs: objects further out have no effect.
const FAR: f64 = 3.0;

/// A neighbouring edge along a ray: its distance from the rim in pixels, and its height as a share of the target's contrast.
#[derive(Clone, Copy, Default)]
struct Begin {
    distance: f64,
    height: f64,
}

/// Objects around a target.
pub(crate) struct Neighbours {
    rays: [Begin; RAYS],
    outline: Outline,
    blur: f64,
}

impl Neighbours {
    /// Around an outline of this blur and contrast, whose fit leaves this rms, for pixels up to `reach` beyond it. `None` if nothing
    /// stands there.
    pub fn of<T: Sample>(
        plane: &SampleView<T>,
        outline: &Outline,
        blur: f64,
        contrast: f64,
        reach: f64,
        rms: f64,
    ) -> Option<Self> {
        let least = RISE[0].max(RISE[1] * rms / contrast.abs()) as f32;
        let samples = ((reach + FAR * blur).ceil() as usize + 1).clamp(3, LONGEST);
        let mut rays = [Begin::default(); RAYS];
        let mut profile = [0f32; LONGEST];
        let profile = &mut profile[..samples];
        let scale = 1.0 / contrast as f32;
        for (begin, rim) in rays.iter_mut().zip(rim_points(outline, RAYS)) {
            plane.profile([rim.x, rim.y], rim.normal, profile);
            profile.iter_mut().for_each(|level| *level *= scale);
            *begin = first_rise(profile, least);
        }
        rays.iter().any(|begin| begin.height > 0.0).then_some(Self { rays, outline: *outline, blur })
    }

    /// Distance of the nearest from the rim, in pixels, where there are several: an object on one side only may occlude the rim.
    pub fn nearest_of_several(&self) -> Option<f64> {
        let stands = |k: usize| self.rays[k % RAYS].height > 0.0;
        let several = (0..RAYS).filter(|k| stands(k + 1) && !stands(*k)).count() > 1;
        let distances = self.rays.iter().filter(|begin| begin.height > 0.0).map(|begin| begin.distance);
        several.then(|| distances.fold(f64::INFINITY, |a, b| if a < b { a } else { b }))
    }

    /// Their light at a place outside of the outline, as a share of the target's contrast.
    pub fn light(&self, x: f64, y: f64) -> f64 {
        let [c, s] = self.outline.normalised(x, y);
        if c * c + s * s < 1.0 {
            return 0.0;
        }
        let turn = (s.atan2(c) / std::f64::consts::TAU).rem_euclid(1.0) * RAYS as f64;
        let Begin { distance, height } = self.rays[(turn.round() as usize) % RAYS];
        if height <= 0.0 {
            return 0.0;
        }
        let beyond = (self.outline.nearest(x, y).1 - distance) / self.blur;
        height * f64::from(normal_distribution(f32x4::splat(beyond.clamp(-5.5, 5.5) as f32)).0.to_array()[0])
    }
}

/// The first rise of a profile by at least so much: where it is half-way, and its height.
fn first_rise(profile: &[f32], rise: f32) -> Begin {
    let (mut least, mut at) = (f32::MAX, 0);
    let (mut most, mut top) = (f32::MIN, 0);
    for (i, level) in profile.iter().enumerate() {
        if *level < least && most < least + rise {
            (least, at) = (*level, i);
            (most, top) = (*level, i);
        }
        if *level > most {
            (most, top) = (*level, i);
        }
    }
    if most - least < rise {
        return Begin::default();
    }
    let half = (least + most) / 2.0;
    let crossing = (at..top).find(|i| profile[*i] <= half && profile[i + 1] > half);
    crossing.map_or(Begin::default(), |i| {
        let part = (half - profile[i]) / (profile[i + 1] - profile[i]);
        Begin { distance: i as f64 + f64::from(part), height: f64::from(most - least) }
    })
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const BLUR: f64 = 1.2;

    /// A dark disc of radius 5 on paper, and ink from 4 px beyond its right side on, or both sides, all equally blurred.
    fn picture(right: bool, left: bool) -> Vec<u8> {
        let below = |t: f64| f64::from(normal_distribution(f32x4::splat(t.clamp(-5.5, 5.5) as f32)).0.to_array()[0]);
        let level = |i: usize| {
            let [x, y] = [(i % 40) as f64 - 19.5, (i / 40) as f64 - 19.5];
            let ink = |there: bool, x: f64| if there { below((x - 9.0) / BLUR) } else { 0.0 };
            let share = below((5.0 - x.hypot(y)) / BLUR) + ink(right, x) + ink(left, -x);
            (200.0 - 150.0 * share).round() as u8
        };
        (0..40 * 40).map(level).collect()
    }

    #[test]
    fn ink_beside_a_disc_throws_the_light_of_its_rim() {
        let outline = Outline::from_axes(20.0, 20.0, 5.0, 5.0, 0.0);
        let samples = picture(true, false);
        let plane = SampleView::new(40, 40, &samples);
        let neighbours = Neighbours::of(&plane, &outline, BLUR, -150.0, 4.0, 1.0).expect("ink stands there");
        // nearer to it, where pixels are outliers, its rim comes out a fifth of a pixel too far: the disc's own light raises the least level
        for distance in [1.5, 2.0, 2.5] {
            let own = neighbours.light(25.0 + distance, 20.0);
            let z = f32x4::splat(((distance - 4.0) / BLUR) as f32);
            let drawn = f64::from(normal_distribution(z).0.to_array()[0]);
            assert!((own - drawn).abs() < 0.06, "{own} of {drawn} at {distance}");
            assert_eq!(neighbours.light(15.0 - distance, 20.0), 0.0);
        }
        assert_eq!(neighbours.light(20.0, 20.0), 0.0);
        let alone = picture(false, false);
        assert!(Neighbours::of(&SampleView::new(40, 40, &alone), &outline, BLUR, -150.0, 4.0, 1.0).is_none());
    }

    #[test]
    fn what_stands_on_several_sides_is_as_near_as_the_nearest_of_it() {
        let outline = Outline::from_axes(20.0, 20.0, 5.0, 5.0, 0.0);
        let nearest = |right, left| {
            let samples = picture(right, left);
            let around = Neighbours::of(&SampleView::new(40, 40, &samples), &outline, BLUR, -150.0, 4.0, 1.0);
            around.expect("ink stands there").nearest_of_several()
        };
        assert_eq!([nearest(true, false), nearest(false, true)], [None, None]);
        let both = nearest(true, true).expect("two sides");
        assert!((both - 4.0).abs() < 0.4, "{both}");
    }
}
