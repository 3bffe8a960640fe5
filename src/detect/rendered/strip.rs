//! An occluder across a target, from the two places where it hides the rim.
//!
//! A cable hides the rim twice. In between it lies on the disc, and may differ from it by so little that no pixel tells: only what
//! lies on the far side of the chords between the ends of both is the target's, or its background.

use crate::detect::ellipse::outline::Outline;

/// The chords that cut off what is seen, each as (nx, ny, d): a place is seen where nx x + ny y > d.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip([Option<[f64; 3]>; 2]);

impl Strip {
    /// Between the rays of an outline that are not kept, where these are two runs. A cap that is less deep than `shallow` pixels is
    /// occluded as well.
    pub fn of(outline: &Outline, kept: &[bool], shallow: f64) -> Option<Self> {
        let count = kept.len();
        let ends = (0..count).filter(|k| kept[*k] && !kept[(k + 1) % count]).take(3).collect::<Vec<_>>();
        let [first, second] = ends[..] else { return None };
        // the seen arc that ends at a ray begins after the run before it
        let arc = |last: usize| {
            let begin =
                (0..count).map(|back| (last + count - back) % count).find(|k| !kept[(k + count - 1) % count])?;
            let middle = begin as f64 + ((last + count - begin) % count) as f64 / 2.0;
            Some([begin as f64, middle, last as f64].map(|ray| {
                let (s, c) = (ray / count as f64 * std::f64::consts::TAU).sin_cos();
                let rim = outline.rim(c, s);
                [rim.x, rim.y]
            }))
        };
        let chord = |last: usize| {
            let [[x0, y0], [xm, ym], [x1, y1]] = arc(last)?;
            let length = (x1 - x0).hypot(y1 - y0);
            let (nx, ny) = ((y1 - y0) / length, (x0 - x1) / length);
            let d = nx * x0 + ny * y0;
            let depth = nx * xm + ny * ym - d;
            let side = depth.signum();
            (depth.abs() > shallow).then_some([side * nx, side * ny, side * d])
        };
        Some(Self([chord(first), chord(second)]))
    }

    /// Whether a place is not seen.
    pub fn hides(&self, x: f64, y: f64) -> bool {
        !self.0.iter().flatten().any(|[nx, ny, d]| nx * x + ny * y > *d)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn what_lies_between_the_hidden_parts_of_the_rim_is_hidden() {
        let outline = Outline::from_axes(50.0, 40.0, 20.0, 12.0, 0.4);
        let count = 64;
        let place = |ray: f64, share: f64| {
            let (s, c) = (ray / f64::from(count) * std::f64::consts::TAU).sin_cos();
            let rim = outline.rim(c, s);
            [outline.u + share * (rim.x - outline.u), outline.v + share * (rim.y - outline.v)]
        };
        // one run goes through the first ray
        for hidden in [[60..66, 25..30], [10..14, 40..46]] {
            let kept: Vec<bool> =
                (0..count).map(|k| !hidden.iter().any(|run| run.contains(&k) || run.contains(&(k + count)))).collect();
            let strip = Strip::of(&outline, &kept, 0.0).expect("two runs");
            let middle = |run: &std::ops::Range<i32>| f64::from(run.start + run.end - 1) / 2.0;
            let [from, to] = [0, 1].map(|k| place(middle(&hidden[k]), 1.0));
            for share in [-0.3, 0.0, 0.2, 0.5, 0.8, 1.0, 1.3] {
                let [x, y] = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
                assert!(strip.hides(x, y), "{hidden:?} {share}");
            }
            for (k, _) in kept.iter().enumerate().filter(|(_, kept)| **kept) {
                let [x, y] = place(k as f64, 1.001);
                assert!(!strip.hides(x, y), "{hidden:?} {k}");
            }
        }
        // of caps that are too shallow nothing is seen: of the smaller one alone, then of both
        let kept: Vec<bool> = (0..count).map(|k| !(10..14).contains(&k) && !(30..34).contains(&k)).collect();
        for (shallow, seen) in [(0.0, [true, true]), (15.0, [false, true]), (100.0, [false, false])] {
            let strip = Strip::of(&outline, &kept, shallow).expect("two runs");
            let caps = [22.0, 54.0].map(|ray| place(ray, 1.0)).map(|[x, y]| !strip.hides(x, y));
            assert_eq!(caps, seen, "{shallow}");
        }
        let three = [5..8, 20..25, 50..55];
        let hidden: [&[std::ops::Range<i32>]; 4] = [&[], &three[..1], &three, &[0..9, 9..count]];
        for hidden in hidden {
            let kept: Vec<bool> = (0..count).map(|k| !hidden.iter().any(|run| run.contains(&k))).collect();
            assert!(Strip::of(&outline, &kept, 0.0).is_none(), "{hidden:?}");
        }
    }
}
