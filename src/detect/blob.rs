//! Blob tests: is a chain of runs the image of a circle, and roughly which?
//!
//! The runs are the blob: their area, centroid and second moments give the ellipse of the same moments, and an ellipse
//! fills it (area = 4 π sqrt(det of the second moments)). With enough runs their ends are edge points, good to about a
//! tenth of a pixel, through which an ellipse is fitted directly; letters, corners and bars do not fit and go here, at the
//! price of a few hundred operations.

use super::component::Chord;
use super::conic;
use super::outline::Outline;
use crate::detection::Reason;

/// What the scanned picture allows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Smallest full axis in pixels of the scanned picture.
    pub min_diameter: f64,
    /// Largest full axis.
    pub max_diameter: f64,
    /// Size of the scanned picture.
    pub width: usize,
    pub height: usize,
    /// Every how manieth row is scanned.
    pub step: usize,
}

/// A blob that is no target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoBlob {
    pub u: f64,
    pub v: f64,
    pub diameter: f64,
    pub reason: Reason,
}

/// Flattest ellipse that goes on to be measured; the measurement decides at 0.3.
const FLATTEST: f64 = 0.2;

/// Tests a chain of runs: its ellipse, to a fraction of a pixel, or why it has none.
pub(crate) fn test(chain: &[Chord], limits: &Limits) -> Result<Outline, NoBlob> {
    let moments = Moments::of(chain, limits.step as f64);
    let no = |reason| NoBlob { u: moments.u, v: moments.v, diameter: moments.width.max(moments.height), reason };
    if moments.width.max(moments.height) > 1.3 * limits.max_diameter + 4.0 {
        return Err(no(Reason::TooLarge));
    }
    // one run alone shows no shape
    if chain.len() < 2 || moments.width.max(moments.height) < 0.7 * limits.min_diameter {
        return Err(no(Reason::TooSmall));
    }
    let Some(outline) = moments.outline() else { return Err(no(Reason::NotAnEllipse)) };
    let lowest = (limits.height - limits.step.min(limits.height)) as f32;
    let cut = chain.iter().any(|chord| chord.cut || chord.y < limits.step as f32 || chord.y > lowest);
    if chain.len() < 4 {
        // up to one step of height is unknown above and below: only the roughest test is fair
        let (a, b, _) = outline.axes();
        let fill = moments.area / (std::f64::consts::PI * a * b);
        return match cut {
            true => Err(no(Reason::AtBorder)),
            false if (fill - 1.0).abs() > 0.45 => Err(no(Reason::NotAnEllipse)),
            false => Ok(outline),
        };
    }
    let (a, b, _) = outline.axes();
    let fill = moments.area / (std::f64::consts::PI * a * b);
    if !cut && ((fill - 1.0).abs() > 0.12 || b < 0.15 * a) {
        return Err(no(if b < 0.15 * a { Reason::TooFlat } else { Reason::NotAnEllipse }));
    }
    let ends: Vec<[f64; 3]> = chain
        .iter()
        .flat_map(|chord| [(chord.x0, chord.y), (chord.x1, chord.y)])
        .filter(|&(x, _)| x > 0.0 && x < limits.width as f32)
        .map(|(x, y)| [f64::from(x), f64::from(y), 1.0])
        .collect();
    let Some(outline) = conic::fit(&ends) else { return Err(no(Reason::NotAnEllipse)) };
    let (a, b, _) = outline.axes();
    if rms_distance(&outline, &ends) > 0.3 + 0.05 * b {
        return Err(no(Reason::NotAnEllipse));
    }
    if cut {
        return Err(no(Reason::AtBorder));
    }
    if 2.0 * a > 1.3 * limits.max_diameter {
        return Err(no(Reason::TooLarge));
    }
    if b < FLATTEST * a {
        return Err(no(Reason::TooFlat));
    }
    Ok(outline)
}

/// Rms distance of points from an ellipse, to first order (Sampson).
fn rms_distance(outline: &Outline, points: &[[f64; 3]]) -> f64 {
    let det = outline.p * outline.q - outline.r * outline.r;
    let sum: f64 = points
        .iter()
        .map(|&[x, y, _]| {
            let [c, s] = outline.normalised(x, y);
            // the length of the normalised point over that of its gradient
            let square = (c * c + s * s).max(1e-18);
            let (gx, gy) = ((outline.q * c - outline.r * s) / det, (outline.p * s - outline.r * c) / det);
            (square.sqrt() - 1.0).powi(2) * square / (gx * gx + gy * gy)
        })
        .sum();
    (sum / points.len() as f64).sqrt()
}

/// Area, centroid and central second moments of runs, and their extent.
struct Moments {
    area: f64,
    u: f64,
    v: f64,
    uu: f64,
    uv: f64,
    vv: f64,
    width: f64,
    height: f64,
}

impl Moments {
    /// Each run stands for a bar of `step` rows.
    fn of(chain: &[Chord], step: f64) -> Self {
        let (mut area, mut u, mut v) = (0.0, 0.0, 0.0);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        let bars = || chain.iter().map(|c| (f64::from(c.x0), f64::from(c.x1), f64::from(c.y)));
        for (x0, x1, y) in bars() {
            let bar = (x1 - x0) * step;
            area += bar;
            u += bar * (x0 + x1) / 2.0;
            v += bar * y;
            (left, right) = (left.min(x0), right.max(x1));
        }
        (u, v) = (u / area, v / area);
        let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
        for (x0, x1, y) in bars() {
            let (length, dx, dy) = (x1 - x0, (x0 + x1) / 2.0 - u, y - v);
            let bar = length * step / area;
            uu += bar * (dx * dx + length * length / 12.0);
            uv += bar * dx * dy;
            vv += bar * (dy * dy + step * step / 12.0);
        }
        Self { area, u, v, uu, uv, vv, width: right - left, height: chain.len() as f64 * step }
    }

    /// Ellipse of the same second moments: A A' is four times their matrix.
    fn outline(&self) -> Option<Outline> {
        let root = (self.uu * self.vv - self.uv * self.uv).sqrt();
        let norm = (self.uu + self.vv + 2.0 * root).sqrt();
        let outline = Outline {
            u: self.u,
            v: self.v,
            p: 2.0 * (self.uu + root) / norm,
            q: 2.0 * (self.vv + root) / norm,
            r: 2.0 * self.uv / norm,
        };
        outline.is_proper().then_some(outline)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const LIMITS: Limits = Limits { min_diameter: 5.0, max_diameter: 400.0, width: 300, height: 200, step: 2 };

    fn chain(outline: &Outline) -> Vec<Chord> {
        (0..100)
            .filter_map(|k| {
                let y = f64::from(2 * k) + 0.5;
                let (x0, x1) = outline.chord(y)?;
                Some(Chord { x0: x0 as f32, x1: x1 as f32, y: y as f32, cut: false })
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
                    Chord { x0, x1: x0 + width, y: 20.5 + 2.0 * k as f32, cut: false }
                })
                .collect()
        };
        // two straight sides are those of an endless ellipse
        assert_eq!(test(&bars(20, 40.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooLarge);
        assert!(test(&bars(60, 5.0, 1.0), &LIMITS).is_err());
        assert_eq!(test(&bars(1, 3.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooSmall);
        assert_eq!(test(&bars(40, 600.0, 0.0), &LIMITS).unwrap_err().reason, Reason::TooLarge);
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
