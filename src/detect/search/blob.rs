//! Blob tests: whether a chain of runs is the image of a circle, and its approximate ellipse.
//!
//! The runs are the blob: their area, centroid and second moments give the ellipse of the same moments, and an ellipse
//! fills it (area = 4 π sqrt(det of the second moments)). With enough runs their ends, edge points good to about a tenth of
//! a pixel, determine it better: along an ellipse the middles of the runs lie on a line, and the squares of their half
//! lengths on a parabola. Letters, corners and bars do not fit and go here, at the price of some hundred operations.

use super::component::Chord;
use crate::detect::acceptance::blob::{FILL, NECK, RMS, UNSEEN};
use crate::detect::acceptance::size::{BLOB_LARGE, BLOB_SMALL};
use crate::detect::ellipse::conic;
use crate::detect::ellipse::outline::Outline;
use crate::detection::Reason;

/// Limits of blobs in the scanned picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlobLimits {
    /// Smallest full axis in pixels of the scanned picture.
    pub min_diameter: f64,
    /// Largest full axis.
    pub max_diameter: f64,
    /// Smallest ratio of the axes of what goes on to be measured; the measurement decides.
    pub flattest: f64,
    /// Size of the scanned picture.
    pub width: usize,
    pub height: usize,
    /// Every how manieth row is scanned.
    pub step: usize,
}

/// A rejected blob.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoBlob {
    pub u: f64,
    pub v: f64,
    pub diameter: f64,
    pub reason: Reason,
    /// The outline that it seemed to have, if any.
    pub outline: Option<Outline>,
}

impl NoBlob {
    /// The outline of a rejected blob.
    pub fn of(outline: &Outline, reason: Reason) -> Self {
        Self { u: outline.u, v: outline.v, diameter: 2.0 * outline.semi_axes().0, reason, outline: Some(*outline) }
    }
}

/// Tests a chain of runs: its ellipse, to a fraction of a pixel, or why it has none.
pub(crate) fn test(chain: &[Chord], limits: &BlobLimits) -> Result<Outline, NoBlob> {
    if let [run] = chain
        && f64::from(run.x1 - run.x0) < limits.max_diameter
    {
        // one run alone shows no shape
        let (u, diameter) = (f64::from(run.x0 + run.x1) / 2.0, f64::from(run.x1 - run.x0));
        return Err(NoBlob { u, v: f64::from(run.y), diameter, reason: Reason::TooSmall, outline: None });
    }
    let moments = Moments::of(chain, limits.step as f64);
    let [u, v] = moments.middle;
    let no = |reason| NoBlob { u, v, diameter: moments.longest, reason, outline: None };
    if moments.longest > BLOB_LARGE * limits.max_diameter {
        return Err(no(Reason::TooLarge));
    }
    if chain.len() < 2 || moments.longest < BLOB_SMALL * limits.min_diameter {
        return Err(no(Reason::TooSmall));
    }
    let Some(outline) = moments.outline() else { return Err(no(Reason::NotAnEllipse)) };
    let lowest = limits.height.saturating_sub(limits.step) as f32;
    // the runs are in the order of their rows
    let at_border = |chord: &Chord| chord.y < limits.step as f32 || chord.y > lowest;
    let cut = moments.cut || chain.first().is_some_and(at_border) || chain.last().is_some_and(at_border);
    let (a, b) = outline.semi_axes();
    let fill = moments.area / (std::f64::consts::PI * a * b);
    if chain.len() < 4 {
        // up to one step of height is unknown above and below: no test of the area is fair
        return match cut {
            true => Err(no(Reason::AtBorder)),
            false if fattest(chain, limits.step as f64) < limits.flattest => Err(no(Reason::TooFlat)),
            false => Ok(outline),
        };
    }
    let flat = b < limits.flattest * a;
    if !cut && ((fill - 1.0).abs() > FILL || flat) {
        return Err(no(if flat { Reason::TooFlat } else { Reason::NotAnEllipse }));
    }
    let found = if cut { through_ends(chain, limits) } else { through_runs(chain, &moments) };
    let Some((fitted, rms)) = found else { return Err(no(Reason::NotAnEllipse)) };
    let area = |outline: &Outline| outline.p * outline.q - outline.r * outline.r;
    let unseen = !cut && area(&fitted) > UNSEEN * area(&outline);
    let outline = fitted;
    let (a, b) = outline.semi_axes();
    if unseen || rms > RMS[0] + RMS[1] * b {
        return Err(no(Reason::NotAnEllipse));
    }
    if cut {
        return Err(no(Reason::AtBorder));
    }
    if 2.0 * a > BLOB_LARGE * limits.max_diameter {
        return Err(no(Reason::TooLarge));
    }
    if b < limits.flattest * a {
        return Err(no(Reason::TooFlat));
    }
    Ok(outline)
}

/// Length of the longest run.
fn widest(chain: &[Chord]) -> f32 {
    chain.iter().map(|chord| chord.x1 - chord.x0).fold(0.0, |a, b| if a > b { a } else { b })
}

/// Axis ratio, at most, of an ellipse that a few rows show. With w its widest run, h its height and m the lean of the runs'
/// middles, a b = w h / 4 and a² + b² = (w² + (1 + m²) h²) / 4; up to one step of height is unknown above and below.
fn fattest(chain: &[Chord], step: f64) -> f64 {
    let (Some(first), Some(last)) = (chain.first(), chain.last()) else { return 0.0 };
    let middle = |chord: &Chord| f64::from(chord.x0 + chord.x1) / 2.0;
    let lean = (middle(last) - middle(first)) / f64::from(last.y - first.y).max(1.0);
    let widest = f64::from(widest(chain));
    let slant = 1.0 + lean * lean;
    let rows = chain.len() as f64;
    // the ratio is largest where both terms of the sum are alike
    let height = (widest / slant.sqrt()).clamp((rows - 1.0) * step, (rows + 1.0) * step);
    let half = 2.0 * widest * height / (widest * widest + slant * height * height);
    // r from 2 r / (1 + r²)
    half / (1.0 + (1.0 - half * half).max(0.0).sqrt())
}

/// Narrowest run between two wide parts of a chain: at most two thirds of the widest run above and of that below.
pub(crate) fn neck(chain: &[Chord]) -> Option<usize> {
    let length = |chord: &Chord| chord.x1 - chord.x0;
    let inner = 3..chain.len().checked_sub(3)?;
    let neck = inner.min_by(|&a, &b| length(&chain[a]).total_cmp(&length(&chain[b])))?;
    let least = widest(&chain[..neck]).min(widest(&chain[neck + 1..]));
    (NECK * length(&chain[neck]) < least).then_some(neck)
}

/// Ellipse through the ends of four or more whole runs, and the rms distance of the ends from it.
///
/// With t the height above the centroid's, m = m0 + m1 t are the middles and h² = c0 + c1 t + c2 t² the squared half lengths.
/// The ends' errors along the normal are alike, so h² has equal weights, and m the weight h².
fn through_runs(chain: &[Chord], moments: &Moments) -> Option<(Outline, f64)> {
    let run = |chord: &Chord| {
        let (x0, x1) = (f64::from(chord.x0) - moments.u, f64::from(chord.x1) - moments.u);
        (f64::from(chord.y) - moments.v, (x0 + x1) / 2.0, ((x1 - x0) / 2.0).powi(2))
    };
    let (mut t, mut h, mut m) = ([0.0; 5], [0.0; 3], [0.0; 4]);
    for (y, middle, square) in chain.iter().map(run) {
        let yy = y * y;
        t = [t[0] + 1.0, t[1] + y, t[2] + yy, t[3] + yy * y, t[4] + yy * yy];
        h = [h[0] + square, h[1] + square * y, h[2] + square * yy];
        m = [m[0] + square * middle, m[1] + square * middle * y, 0.0, 0.0];
    }
    // the parabola, by cofactors of its symmetric normal matrix
    let (k00, k01, k02) = (t[2] * t[4] - t[3] * t[3], t[2] * t[3] - t[1] * t[4], t[1] * t[3] - t[2] * t[2]);
    let (k11, k12, k22) = (t[0] * t[4] - t[2] * t[2], t[1] * t[2] - t[0] * t[3], t[0] * t[2] - t[1] * t[1]);
    let det = t[0] * k00 + t[1] * k01 + t[2] * k02;
    let c0 = (k00 * h[0] + k01 * h[1] + k02 * h[2]) / det;
    let c1 = (k01 * h[0] + k11 * h[1] + k12 * h[2]) / det;
    let c2 = (k02 * h[0] + k12 * h[1] + k22 * h[2]) / det;
    // the line
    let det = h[0] * h[2] - h[1] * h[1];
    let (m0, m1) = ((m[0] * h[2] - m[1] * h[1]) / det, (m[1] * h[0] - m[0] * h[1]) / det);
    let top = -c1 / (2.0 * c2);
    let widest = c0 + c1 * top / 2.0;
    if !(c2 < 0.0 && widest > 0.0 && m0.is_finite() && m1.is_finite()) {
        return None;
    }
    // A A' = [[m11, m12], [m12, m22]]: the half height squared, the lean of the line, the widest run
    let m22 = widest / -c2;
    let m12 = m1 * m22;
    let outline = Outline::of_matrix(moments.u + m0 + m1 * top, moments.v + top, widest + m1 * m12, m12, m22);
    let mut sum = 0.0;
    for (y, middle, square) in chain.iter().map(run) {
        // F = (x - m)² - h²: at both ends its value over the length of its gradient (Sampson)
        let half = square.sqrt();
        let (shift, slope, model) = (middle - m0 - m1 * y, c1 + 2.0 * c2 * y, c0 + (c1 + c2 * y) * y);
        let value = |x: f64| {
            let (f, gx, gy) = (x * x - model, 2.0 * x, 2.0 * x * m1 + slope);
            f * f / (gx * gx + gy * gy)
        };
        sum += value(shift + half) + value(shift - half);
    }
    let rms = (sum / (2 * chain.len()) as f64).sqrt();
    (outline.is_proper() && rms.is_finite()).then_some((outline, rms))
}

/// The same from the ends that are not the picture's border, by the direct fit.
fn through_ends(chain: &[Chord], limits: &BlobLimits) -> Option<(Outline, f64)> {
    let ends: Vec<[f64; 3]> = chain
        .iter()
        .flat_map(|chord| [(chord.x0, chord.y), (chord.x1, chord.y)])
        .filter(|&(x, _)| x > 0.0 && x < limits.width as f32)
        .map(|(x, y)| [f64::from(x), f64::from(y), 1.0])
        .collect();
    let outline = conic::fit(&ends)?;
    let sum: f64 = ends.iter().map(|&[x, y, _]| outline.distance(x, y).powi(2)).sum();
    Some((outline, (sum / ends.len() as f64).sqrt()))
}

/// How far runs extend, and their area, centroid and central second moments: all in one walk along the chain.
struct Moments {
    /// Middle of their box, and its longer side.
    middle: [f64; 2],
    longest: f64,
    /// Whether the border of the picture ends one of them.
    cut: bool,
    area: f64,
    u: f64,
    v: f64,
    uu: f64,
    uv: f64,
    vv: f64,
}

impl Moments {
    /// Each run represents a bar of `step` rows. Summed about the first run, where the sums stay small.
    fn of(chain: &[Chord], step: f64) -> Self {
        let (x, y) = chain.first().map_or((0.0, 0.0), |first| (f64::from(first.x0), f64::from(first.y)));
        let (mut left, mut right, mut cut) = (f32::INFINITY, f32::NEG_INFINITY, false);
        let (mut length, mut u, mut v, mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for chord in chain {
            left = if chord.x0 < left { chord.x0 } else { left };
            right = if chord.x1 > right { chord.x1 } else { right };
            cut |= chord.cut;
            let (x0, x1, dy) = (f64::from(chord.x0) - x, f64::from(chord.x1) - x, f64::from(chord.y) - y);
            let (bar, dx) = (x1 - x0, (x0 + x1) / 2.0);
            let (first, second) = (bar * dx, bar * dy);
            length += bar;
            u += first;
            v += second;
            uu += first * dx + bar * bar * bar / 12.0;
            uv += first * dy;
            vv += second * dy;
        }
        let (width, height) = (f64::from(right - left), chain.len() as f64 * step);
        let last = chain.last().map_or(y, |last| f64::from(last.y));
        (u, v) = (u / length, v / length);
        Self {
            middle: [f64::from(left + right) / 2.0, (y + last) / 2.0],
            longest: if width > height { width } else { height },
            cut,
            area: length * step,
            u: x + u,
            v: y + v,
            uu: uu / length - u * u,
            uv: uv / length - u * v,
            vv: vv / length - v * v + step * step / 12.0,
        }
    }

    /// Ellipse of the same second moments: A A' is four times their matrix.
    fn outline(&self) -> Option<Outline> {
        let outline = Outline::of_matrix(self.u, self.v, 4.0 * self.uu, 4.0 * self.uv, 4.0 * self.vv);
        outline.is_proper().then_some(outline)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const LIMITS: BlobLimits =
        BlobLimits { min_diameter: 5.0, max_diameter: 400.0, flattest: 0.22, width: 300, height: 200, step: 2 };

    fn chain(outline: &Outline) -> Vec<Chord> {
        (0..100)
            .filter_map(|k| {
                let y = f64::from(2 * k) + 0.5;
                let (x0, x1) = outline.chord(y)?;
                Some(Chord::new(x0 as f32, x1 as f32, y as f32, false))
            })
            .collect()
    }

    #[test]
    fn an_ellipse_passes_and_comes_back() {
        let truth = Outline::from_axes(80.3, 70.2, 30.0, 12.0, 0.7);
        let found = test(&chain(&truth), &LIMITS).unwrap();
        assert!((found.u - truth.u).hypot(found.v - truth.v) < 1e-3);
        assert!((found.p - truth.p).abs() < 1e-3 && (found.r - truth.r).abs() < 1e-3);
    }

    #[test]
    fn a_small_circle_passes_in_every_phase() {
        for k in 0..20 {
            let v = 40.0 + 0.1 * f64::from(k);
            let found = test(&chain(&Outline::from_axes(30.0, v, 3.0, 3.0, 0.0)), &LIMITS).unwrap();
            assert!((found.u - 30.0).abs() < 0.1 && (found.v - v).abs() < 1.1, "{found:?}");
        }
    }

    #[test]
    fn a_box_a_bar_and_a_spot_do_not_pass() {
        let bars = |rows: usize, width: f32, slant: f32| -> Vec<Chord> {
            (0..rows)
                .map(|k| {
                    let x0 = 50.0 + slant * k as f32;
                    Chord::new(x0, x0 + width, 20.5 + 2.0 * k as f32, false)
                })
                .collect()
        };
        assert_eq!(test(&bars(20, 40.0, 0.0), &LIMITS).unwrap_err().reason, Reason::NotAnEllipse);
        assert!(test(&bars(60, 5.0, 1.0), &LIMITS).is_err());
        assert_eq!(test(&bars(1, 3.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooSmall);
        assert_eq!(test(&bars(40, 600.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooLarge);
    }

    #[test]
    fn a_bar_that_bulges_is_no_ellipse() {
        // h² = 400 - 0.05 t²: an ellipse of 40 by 179 pixels, of which 40 would be seen
        let bulging: Vec<Chord> = (0..20)
            .map(|k| {
                let half = (400.0 - 0.05 * (2.0 * k as f32 - 19.0).powi(2)).sqrt();
                Chord::new(100.0 - half, 100.0 + half, 60.5 + 2.0 * k as f32, false)
            })
            .collect();
        assert_eq!(test(&bulging, &LIMITS).unwrap_err().reason, Reason::NotAnEllipse);
    }

    #[test]
    fn a_few_rows_show_whether_an_ellipse_is_too_flat() {
        let rows = |count: usize, width: f32, lean: f32| -> Vec<Chord> {
            let x = |k: usize| 100.0 + lean * 2.0 * k as f32;
            (0..count).map(|k| Chord::new(x(k), x(k) + width, 20.5 + 2.0 * k as f32, false)).collect()
        };
        // two rows represent up to six: a circle of six pixels, an ellipse of twenty by six upright, a bar, a slanted stroke
        assert!((fattest(&rows(2, 6.0, 0.0), 2.0) - 1.0).abs() < 1e-9);
        assert!((fattest(&rows(2, 20.0, 0.0), 2.0) - 0.3).abs() < 1e-9);
        assert_eq!(test(&rows(2, 40.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooFlat);
        assert_eq!(test(&rows(3, 6.0, 4.0), &LIMITS).unwrap_err().reason, Reason::TooFlat);
        // of an ellipse no rows show less than its own ratio
        for k in 0..60 {
            let (turn, v) = (0.1 * f64::from(k), 40.0 + 0.07 * f64::from(k));
            let truth = Outline::from_axes(60.0, v, 9.0, 3.0, turn);
            let chain = chain(&truth);
            assert!(chain.len() > 3 || fattest(&chain, 2.0) > 0.33, "{k}: {chain:?}");
        }
    }

    #[test]
    fn a_blob_cut_by_the_border_is_reported() {
        let mut cut = chain(&Outline::from_axes(10.0, 70.2, 16.0, 14.0, 0.0));
        for chord in &mut cut {
            if chord.x0 < 0.0 {
                (chord.x0, chord.cut) = (0.0, true);
            }
        }
        assert_eq!(test(&cut, &LIMITS).unwrap_err().reason, Reason::AtBorder);
    }
}
