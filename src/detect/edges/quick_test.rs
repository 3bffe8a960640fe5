//! A quick test of a blob before any fit: one pixel inside and one outside its outline, in sixteen directions.
//!
//! The inside of a target has one grey level, the outside in most directions another. If the outside has the level of the inside, the
//! shape is open in that direction: it touches another object of the same level, or it is part of a letter. An occluder differs from
//! both levels.

use wide::f32x4;

use crate::detect::acceptance::{outline::GAP_MINOR, quick_test as limits};
use crate::detect::ellipse::outline::{Outline, RimPoint};
use crate::detect::ellipse::rays::{Rays, rim_points};
use crate::detect::picture::noise::GreyStatistics;
use crate::detection::Reason;
use crate::image::{Sample, SampleView};

/// Number of directions.
pub(crate) const DIRECTIONS: u32 = 16;

/// Grey levels of a dot: inside and outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DotLevels {
    pub dot: f64,
    pub background: f64,
}

/// Result of the test.
#[derive(Clone, Copy, Debug)]
struct QuickTest {
    /// Number of directions with a step of the right sign and at least two fifths of the typical step.
    pub agree: u32,
    /// Mean step of the twelve largest. The standard error of this mean is about 0.4 of a pixel's noise.
    pub step: f32,
    /// Number of gaps: runs of consecutive directions without that step.
    pub gaps: u32,
    /// Number of directions in which the outside has the level of the inside.
    pub open: u32,
    /// Whether the inside has one level, except in the directions that an occluder may cover.
    pub even: bool,
}

/// Tests a blob of which only a rough outline is known.
pub(crate) fn first<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    outline: &Outline,
    bright: bool,
) -> Result<(), Reason> {
    let small = 2.0 * outline.semi_axes().1 < limits::SMALL * GAP_MINOR;
    let missing = if small { limits::MISSING_SMALL } else { limits::MISSING };
    stands_out(plane, levels, outline, bright, missing, limits::OPEN)
}

/// Whether a blob stands out from its background: at most `missing` directions have no step, at most `open` are open.
pub(crate) fn stands_out<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    outline: &Outline,
    bright: bool,
    missing: u32,
    open: u32,
) -> Result<(), Reason> {
    match quick_test(plane, outline, bright, levels.step() as f32, missing) {
        Some(test) if f64::from(test.step) < limits::FAINT * levels.noise => Err(Reason::LowContrast),
        Some(test) if test.even && test.agree + missing >= DIRECTIONS && !test.is_interrupted(levels.noise) => {
            if test.open > open { Err(Reason::Touching) } else { Ok(()) }
        }
        _ => Err(Reason::NotAnEllipse),
    }
}

impl QuickTest {
    /// Whether the outline has more gaps than an occluder makes: one, or two for a cable across the target. Noise makes no gaps if the step
    /// is clear.
    fn is_interrupted(&self, noise: f64) -> bool {
        self.gaps > limits::GAPS && f64::from(self.step) > limits::CLEAR * noise
    }
}

/// Tests a blob; `None` as soon as more than `missing` directions have no step above `threshold`.
#[inline(never)]
fn quick_test<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    bright: bool,
    threshold: f32,
    missing: u32,
) -> Option<QuickTest> {
    let b = outline.semi_axes().1;
    let sign = f32x4::splat(if bright { 1.0 } else { -1.0 });
    let inner = f32x4::splat((1.0 - 2.0 / b.max(1.0)).clamp(0.2, 0.85) as f32);
    let outside = f32x4::splat(limits::OUTSIDE as f32);
    let from = [outline.u.floor(), outline.v.floor()];
    let [u, v] = [outline.u - from[0], outline.v - from[1]].map(|rest| f32x4::splat(rest as f32));
    let from = from.map(|whole| whole as i32);
    let rays = Rays::new(outline);
    let (mut steps, mut insides) = ([[0f32; 4]; 4], [[0f32; 4]; 4]);
    let mut without = 0;
    for (([c, s], steps), insides) in QUARTER.into_iter().zip(&mut steps).zip(&mut insides) {
        let rim = rays.at(c, s);
        let (inside, _) = plane.nearest_four(from, u + inner * rim.x, v + inner * rim.y);
        let (beyond, held) = plane.nearest_four(from, u + rim.x + outside * rim.nx, v + rim.y + outside * rim.ny);
        let step = held & (sign * (inside - beyond));
        without += step.simd_le(f32x4::splat(threshold)).to_bitmask().count_ones();
        if without > missing {
            return None;
        }
        (*steps, *insides) = (step.to_array(), inside.to_array());
    }
    let (steps, insides) = (steps.as_flattened(), insides.as_flattened());
    let sign = sign.to_array()[0];
    let mut pairs = std::array::from_fn(|k| f32x4::new([steps[k], insides[k], 0.0, 0.0]));
    sort(&mut pairs);
    let sorted = pairs.map(|pair| pair.to_array()[0]);
    let levels = pairs.map(|pair| pair.to_array()[1]);
    // typical step: the median of the larger half
    let typical = sorted[11];
    let least = (limits::STEP * typical).max(threshold);
    let own = |level: f32| (level - levels[8]).abs() < limits::OWN * typical;
    let open = steps.iter().zip(insides).filter(|(step, inside)| own(**inside) && own(**inside - sign * **step));
    // so many of the darkest and of the brightest may be covered by an occluder
    let missing = (0..).zip(steps).filter(|(_, step)| **step <= least);
    let missing: u32 = missing.map(|(k, _)| 1 << (AROUND[k / 4] + 4 * (k % 4))).sum();
    Some(QuickTest {
        agree: DIRECTIONS - missing.count_ones(),
        gaps: (missing & !(missing << 1 | missing >> (DIRECTIONS - 1))).count_ones(),
        step: sorted[4..].iter().sum::<f32>() / 12.0,
        open: open.count() as u32,
        even: levels[levels.len() - 1 - limits::STRANGE] - levels[limits::STRANGE] < limits::EVEN * typical,
    })
}

/// Sorts the first and the second values separately, by Batcher's odd-even merge sorting network: it has no branches, so its time does
/// not depend on the order.
fn sort(pairs: &mut [f32x4; DIRECTIONS as usize]) {
    for (i, j) in NETWORK {
        let (a, b) = (pairs[i], pairs[j]);
        (pairs[i], pairs[j]) = (a.fast_min(b), a.fast_max(b));
    }
}

/// The comparisons of the sorting network.
const NETWORK: [(usize, usize); 63] = {
    let mut network = [(0, 0); 63];
    let (mut count, mut merged) = (0, 1);
    while merged < DIRECTIONS as usize {
        let mut distance = merged;
        while distance > 0 {
            let mut i = distance % merged;
            while i + distance < DIRECTIONS as usize {
                let same = i / (2 * merged) == (i + distance) / (2 * merged);
                if same && (i - distance % merged) / distance % 2 == 0 {
                    network[count] = (i, i + distance);
                    count += 1;
                }
                i += 1;
            }
            distance /= 2;
        }
        merged *= 2;
    }
    assert!(count == 63);
    network
};

/// Median difference between the grey levels inside the rim and `outside` pixels outside of it; positive for bright targets.
pub(crate) fn contrast<T: Sample>(plane: &SampleView<T>, outline: &Outline, outside: f64) -> f64 {
    let mut steps = [0f32; DIRECTIONS as usize];
    for (rim, step) in rim_points(outline, DIRECTIONS as usize).zip(&mut steps) {
        let [nx, ny] = rim.normal;
        let [dx, dy] = [rim.x - outline.u, rim.y - outline.v];
        *step = plane.nearest(outline.u + 0.2 * dx, outline.v + 0.2 * dy)
            - plane.nearest(rim.x + outside * nx, rim.y + outside * ny);
    }
    f64::from(*steps.select_nth_unstable_by(DIRECTIONS as usize / 2, f32::total_cmp).1)
}

/// Cosine and sine of the directions of the first quarter. The horizontal and vertical directions come first: they reject most false
/// blobs.
pub(crate) const QUARTER: [[f32; 2]; 4] = {
    const C: [f32; 4] = [1.0, 0.923_879_5, std::f32::consts::FRAC_1_SQRT_2, 0.382_683_43];
    [[C[0], 0.0], [C[2], C[2]], [C[1], C[3]], [C[3], C[1]]]
};

/// Position of each of them in the order around the outline.
const AROUND: [usize; 4] = [0, 2, 1, 3];

/// Number of directions in which the level of the inside occurs again outside of the rim, within about the semi-minor axis: nearly all
/// for the counter of a letter, those of the set bits for a code ring.
pub(crate) fn stroke<T: Sample>(plane: &SampleView<T>, outline: &Outline, levels: DotLevels) -> u32 {
    let reach = 1.1 * outline.semi_axes().1 + 1.0;
    let half = limits::COMES_BACK * (levels.dot - levels.background).abs();
    let recurs = |rim: RimPoint| {
        let [nx, ny] = rim.normal;
        (0..(reach - 0.5) as u32).map(|k| reach - f64::from(k)).any(|distance| {
            let level = f64::from(plane.nearest(rim.x + distance * nx, rim.y + distance * ny));
            (level - levels.dot).abs() < half
        })
    };
    rim_points(outline, DIRECTIONS as usize).filter(|rim| recurs(*rim)).count() as u32
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const SIZE: usize = 60;

    /// A picture of 60 x 60 pixels, bright where the condition holds about its middle.
    fn picture(bright: impl Fn(f64, f64) -> bool) -> Vec<u8> {
        let place = |i: usize| i as f64 + 0.5 - 30.0;
        (0..SIZE * SIZE).map(|i| if bright(place(i % SIZE), place(i / SIZE)) { 200 } else { 40 }).collect()
    }

    fn disc() -> Outline {
        Outline::from_axes(30.0, 30.0, 10.0, 10.0, 0.0)
    }

    #[test]
    fn the_network_sorts() {
        // zero-one principle: a network that sorts all sequences of zeros and ones sorts all sequences
        for bits in 0..1u32 << DIRECTIONS {
            let mut pairs = std::array::from_fn(|k| f32x4::splat((bits >> k & 1) as f32));
            sort(&mut pairs);
            assert!(pairs.map(|pair| pair.to_array()[1]).is_sorted(), "{bits:016b}");
        }
    }

    #[test]
    fn a_disc_has_a_step_in_every_direction_and_is_open_at_a_handle() {
        let samples = picture(|x, y| x.hypot(y) < 10.0);
        let plain = quick_test(&SampleView::new(SIZE, SIZE, &samples), &disc(), true, 6.0, 0).unwrap();
        assert_eq!((plain.agree, plain.open, plain.even), (DIRECTIONS, 0, true));
        assert!(quick_test(&SampleView::new(SIZE, SIZE, &samples), &disc(), false, 6.0, 7).is_none());
        let samples = picture(|x, y| x.hypot(y) < 10.0 || x > 0.0 && y.abs() < 9.5);
        let handle = quick_test(&SampleView::new(SIZE, SIZE, &samples), &disc(), true, 6.0, 7).unwrap();
        assert_eq!((handle.agree, handle.open), (DIRECTIONS - 5, 5));
    }

    #[test]
    fn a_disc_crossed_by_a_cable_is_accepted_and_a_star_is_rejected() {
        let levels = GreyStatistics {
            noise: 1.0,
            range: 160.0,
            saturation: 255.0,
            stairs: false,
            quantum: 1.0,
            developed: false,
        };
        let first = |samples: &[u8]| stands_out(&SampleView::new(SIZE, SIZE, samples), &levels, &disc(), true, 7, 5);
        let crossed = picture(|x, y| x.hypot(y) < 10.0 && (x - y).abs() > 2.5);
        assert_eq!(first(&crossed), Ok(()));
        // three notches, each as wide as one of the two that the cable leaves
        let notch = |x: f64, y: f64, c: f64, s: f64| c * x + s * y > 4.0 && (c * y - s * x).abs() < 2.5;
        let star = picture(|x, y| {
            let at = |turn: f64| notch(x, y, turn.to_radians().cos(), turn.to_radians().sin());
            x.hypot(y) < 10.0 && !(at(0.0) || at(135.0) || at(-112.5))
        });
        assert_eq!(first(&star), Err(Reason::NotAnEllipse));
    }

    #[test]
    fn the_level_recurs_outside_the_counter_of_a_letter_but_not_outside_a_disc_on_a_card() {
        let levels = DotLevels { dot: 200.0, background: 40.0 };
        let samples = picture(|x, y| x.hypot(y) < 10.0 || x.hypot(y) > 15.0);
        assert_eq!(stroke(&SampleView::new(SIZE, SIZE, &samples), &disc(), levels), DIRECTIONS);
        let samples = picture(|x, y| x.hypot(y) < 10.0 || x.hypot(y) > 24.0);
        assert_eq!(stroke(&SampleView::new(SIZE, SIZE, &samples), &disc(), levels), 0);
    }
}
