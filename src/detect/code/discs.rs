//! Hypothesis of discs in place of the set sectors of a ring.
//!
//! Dots around a dot can lie on the grid of a family, in the ring's middle, and be as bright as sectors. They differ from sectors by
//! their shape: the ends of sectors are straight rays and their rims arcs of the ring's circles, a disc leaves the corners free. Both are
//! drawn as levels of the ring's plane,
//!
//! ```text
//! sectors:  y(r, t) = B[r1, r2](r) Σ x_k S_k(t)          discs:  y(r, t) = Σ x_k Φ((ρ - |p(r, t) - p_k|) m / s)
//! ```
//!
//! with the shares B and S of ring and sector, the levels x of set sectors and the discs' centres p_k in their middles, m pixels a
//! radius across the disc's rim and the blur s; each is scaled to the picture by least squares.

use super::polar::{RingRays, radius, step};
use super::radial::Radial;
use super::sectors::Division;

/// Radii of the discs, and distances of their centres from the ring's middle, in widths of the ring.
const SIZES: [f64; 4] = [0.3, 0.4, 0.5, 0.6];
const ASIDE: [f64; 3] = [-0.1, 0.0, 0.1];

/// Square of what a ring's sectors leave of the picture over that of discs in their places.
pub(super) fn rivalry(radial: &Radial, division: &Division) -> f64 {
    let bands = &radial.bands;
    let [inner, outer] = bands.design;
    let sectors = left(radial, |j, k| division.seen(j) * bands.row(j)[k].basis[1]);
    let width = outer - inner;
    let all = SIZES.iter().flat_map(|size| ASIDE.map(|aside| [*size, aside]));
    let discs = all.map(|[size, aside]| {
        let discs = Discs::of(division, (inner + outer) / 2.0 + aside * width, size * width);
        left(radial, |j, k| discs.level(&bands.rays, j, radius(bands.samples.start + k)))
    });
    sectors / discs.fold(f64::INFINITY, f64::min)
}

/// Sum of squares that a model of a direction's sample leaves beside the dot, scaled to fit.
fn left(radial: &Radial, model: impl Fn(usize, usize) -> f64) -> f64 {
    let bands = &radial.bands;
    let (mut squares, mut products, mut own) = (0.0, 0.0, 0.0);
    for (j, arc) in bands.rays.arc.iter().enumerate() {
        let levels = &radial.polar.row(j)[bands.samples.clone()];
        for (k, (level, band)) in levels.iter().zip(bands.row(j)).enumerate().filter(|(_, (level, _))| !level.is_nan())
        {
            let (level, model) = (f64::from(*level) - band.dot, model(j, k));
            squares += arc * level * level;
            products += arc * level * model;
            own += arc * model * model;
        }
    }
    squares - products * products / own.max(f64::MIN_POSITIVE)
}

struct Discs {
    /// Centre and level of each.
    discs: Vec<([f64; 2], f64)>,
    size: f64,
}

impl Discs {
    fn of(division: &Division, distance: f64, size: f64) -> Self {
        let discs = division.set_middles().map(|([c, s], level)| ([distance * c, distance * s], level)).collect();
        Self { discs, size }
    }

    fn level(&self, rays: &RingRays, direction: usize, radius: f64) -> f64 {
        let [c, s] = rays.directions[direction];
        let nearest = |(centre, level): &([f64; 2], f64)| {
            let [x, y] = [radius * c - centre[0], radius * s - centre[1]];
            let distance = x.hypot(y);
            // the rim that is nearest is seen across
            (distance < 2.5 * self.size)
                .then(|| level * step((self.size - distance) * rays.pixels_along([x, y]) / rays.blur))
        };
        self.discs.iter().filter_map(nearest).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::super::{Around, outline_of};
    use super::*;
    use crate::detect::detect;
    use crate::detect::outline::Outline;
    use crate::detection::{Codes, DetectOptions};
    use crate::image::{GreyView, SampleView, SamplesView};
    use crate::ring_code::Design;

    const SIZE: usize = 140;
    const SECTORS: u32 = 14;
    const SET: [u32; 6] = [0, 2, 3, 6, 9, 11];

    /// Rivalry in a picture of a dot and what lies around it, given in the plane of its circle of radius 1.
    fn seen(design: Design, is_ink: impl Fn(f64, f64) -> bool) -> f64 {
        const FINE: usize = 6;
        let outline = Outline::from_axes(70.3, 69.6, 15.0, 11.0, 0.4);
        let ink = |k: usize, fine: usize| {
            let place = |whole: usize, part: usize| whole as f64 + (part as f64 + 0.5) / FINE as f64;
            let [x, y] = outline.normalised(place(k % SIZE, fine % FINE), place(k / SIZE, fine / FINE));
            usize::from(x.hypot(y) < 1.0 || is_ink(x, y))
        };
        let share = |k: usize| (0..FINE * FINE).map(|fine| ink(k, fine)).sum::<usize>() as f64 / (FINE * FINE) as f64;
        let samples: Vec<u8> = (0..SIZE * SIZE).map(|k| (210.0 - 170.0 * share(k)).round() as u8).collect();
        let view = GreyView::new(SIZE, SIZE, SamplesView::U8(&samples)).expect("a picture");
        let found =
            detect(&view, &DetectOptions { codes: Codes::None, ..DetectOptions::default() }).expect("valid options");
        let is_dot = |target: &&crate::detection::Target| (target.u - outline.u).hypot(target.v - outline.v) < 0.5;
        let target = found.targets.iter().find(is_dot).expect("the dot");
        assert!((outline_of(target).semi_axes().0 - 15.0).abs() < 0.3);
        let plane = SampleView::new(SIZE, SIZE, &samples);
        let around = Around::of(&plane, target, target.quality.edge_width, 6000);
        let radial = around.straightest(design).expect("a ring");
        rivalry(&radial, &radial.divide(SECTORS).expect("sectors"))
    }

    #[test]
    fn sectors_are_told_from_discs_in_their_places() {
        for design in [Design::Schneider, Design::Metashape] {
            let [inner, outer] = design.ring();
            let ring = seen(design, |x, y| {
                let sector = (y.atan2(x).rem_euclid(TAU) / TAU * f64::from(SECTORS)) as u32;
                (inner..outer).contains(&x.hypot(y)) && SET.contains(&sector)
            });
            assert!(ring < 0.1, "{design:?}: {ring}");
            for size in [0.4, 0.5, 0.6] {
                let discs = seen(design, |x, y| {
                    SET.iter().any(|k| {
                        let (sine, cosine) = ((f64::from(*k) + 0.5) / f64::from(SECTORS) * TAU).sin_cos();
                        let middle = (inner + outer) / 2.0;
                        (x - middle * cosine).hypot(y - middle * sine) < size * (outer - inner)
                    })
                });
                assert!(discs > 5.0, "{design:?} {size}: {discs}");
            }
        }
    }
}
