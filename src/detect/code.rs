//! Reading ring codes.
//!
//! A ring is read as a picture of a model: dot, gap, n equal sectors of one of two levels, and clear background outside, all
//! blurred as the dot's own rim is. [`polar`] samples it, [`bands`] is the model of a ray, [`radial`] separates gap, ring and
//! outside in each direction, [`sectors`] divides the ring into sectors, [`discs`] draws discs in their places,
//! [`judge`](mod@judge) decides what that is.

mod bands;
mod discs;
mod judge;
mod light;
mod parts;
mod polar;
mod radial;
mod sectors;
mod vote;

use std::rc::Rc;

use super::outline::Outline;
use crate::detection::{CodeNote, Codes, Polarity, Target};
use crate::image::{Sample, SampleView};
use crate::ring_code::{Design, Family};
use bands::Bands;
use judge::{Divisions, Tone, judge};
use polar::{Polar, RingFrame, RingRays};
use radial::Radial;

pub(super) use parts::{drop_parts, drop_sectors, keep_ringed, settle_grounds};
pub(super) use radial::may_be_in_ring;
pub(super) use vote::{read_all, read_in};

/// Result of reading the code around a dot.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum CodeReading {
    /// No ring there.
    Plain,
    /// A ring that is safely one code.
    Code { number: u32, margin: f64 },
    /// A ring that may be one of these codes, and why it is not safely read.
    Doubtful { numbers: Vec<u32>, margin: f64, note: CodeNote },
    /// A ring all of whose arcs end on a coarser grid: one of fewer sectors, or by chance a code of this family, of this number if it has
    /// one.
    Coarse { number: Option<u32>, margin: f64 },
    /// A ring, and why it is no code.
    NoCode { margin: f64, note: CodeNote },
}

/// Whether the dots of these codes have spots in their centres.
pub(super) fn have_spots(codes: Codes) -> bool {
    codes.families().iter().any(|family| family.design().spot() > 0.0)
}

/// Ellipse of a target.
pub(super) fn outline_of(target: &Target) -> Outline {
    Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle)
}

/// Reads the ring around a target, whose edges have this blur in the picture, as a code of each of the families; `size` is the larger side of
/// the whole photo.
pub(super) fn read<T: Sample>(
    plane: &SampleView<T>,
    size: usize,
    target: &Target,
    blur: f64,
    families: &[Family],
) -> Vec<CodeReading> {
    if !radial::may_have_ring(plane, target) {
        return vec![CodeReading::Plain; families.len()];
    }
    // whether the levels are light or a camera's tone curve has bent them: each family is judged by what explains it best
    let bent = light::of_screen(plane, target, blur);
    let as_is = Around::of(plane, target, blur, size);
    let in_light = bent.as_ref().map(|(part, target)| (part.plane(), target));
    let in_light = in_light.as_ref().map(|(plane, target)| Around::of(plane, target, blur, size));
    let both = |design: Design| {
        let bent = in_light.as_ref().and_then(|around| around.straightest(design));
        as_is.straightest(design).into_iter().chain(bent)
    };
    let readings = read_tones(families, |design| both(design).collect());
    if bent.is_none() || readings.iter().any(|reading| matches!(reading, CodeReading::Code { .. })) {
        return readings;
    }
    // a sharpened rim has another place and another width than the curve alone explains: both as they are in light
    let Some((part, target)) = light::measured(plane, target) else { return readings };
    let part = part.plane();
    let around = Around::of(&part, &target, target.quality.edge_width, size);
    read_tones(families, |design| both(design).chain(around.straightest(design)).collect())
}

/// The same in a picture whose levels are a known curve of light, of which `light` is the inverse.
pub(super) fn read_curve<T: Sample>(
    plane: &SampleView<T>,
    target: &Target,
    families: &[Family],
    light: impl Fn(f64) -> f64,
) -> Vec<CodeReading> {
    let blur = target.quality.edge_width;
    let found =
        light::of(plane, target, blur, light).filter(|(part, target)| radial::may_have_ring(&part.plane(), target));
    let Some((part, target)) = found else { return vec![CodeReading::Plain; families.len()] };
    let size = plane.width.max(plane.height);
    let plane = part.plane();
    let around = Around::of(&plane, &target, blur, size);
    read_tones(families, |design| around.straightest(design).into_iter().collect())
}

fn read_tones(families: &[Family], rings: impl Fn(Design) -> Vec<Radial>) -> Vec<CodeReading> {
    let mut readings = vec![CodeReading::Plain; families.len()];
    for design in [Design::Schneider, Design::Metashape] {
        if families.iter().all(|family| family.design() != design) {
            continue;
        }
        let tones: Vec<Tone> = rings(design).into_iter().map(|ring| (ring, Divisions::default())).collect();
        for (family, reading) in families.iter().zip(&mut readings) {
            if family.design() == design {
                *reading = judge(*family, &tones);
            }
        }
    }
    readings
}

/// Shift of the ring's middle, in radii, above which the perspective of a target matters.
const SHIFT: f64 = 0.1;
/// Minimum side of a camera's picture in pixels: a smaller one is cut out of one.
const CAMERA: usize = 640;

/// Levels around a target in one picture, for every code design.
struct Around<'a, T> {
    plane: &'a SampleView<'a, T>,
    target: &'a Target,
    rays: Rc<RingRays>,
    /// Its samples seen straight on.
    straight: Polar,
    /// Larger side of the whole picture.
    size: usize,
}

impl<'a, T: Sample> Around<'a, T> {
    fn of(plane: &'a SampleView<'a, T>, target: &'a Target, blur: f64, size: usize) -> Self {
        let rays = Rc::new(RingRays::of(outline_of(target), blur));
        let straight = Polar::sample(plane, &RingFrame::new(rays.outline, 0.0), &rays);
        Self { plane, target, rays, straight, size }
    }

    /// The ring under the perspective that explains it best.
    ///
    /// A plane tilted by t at a distance that a target of semi-axis a px sees under a/f has a boost of a sin t / f along its slope; the
    /// slope is that of the minor axis, and f at least 0.6 widths of the whole picture.
    fn straightest(&self, design: Design) -> Option<Radial> {
        let Self { plane, target, rays, .. } = self;
        let outline = rays.outline;
        let (a, b) = outline.semi_axes();
        let sine = (1.0 - (b / a) * (b / a)).max(0.0).sqrt();
        let largest = a * sine / (0.6 * self.size.max(CAMERA) as f64);
        let bands = Rc::new(Bands::of(rays.clone(), design));
        let of = |boost: f64| {
            let frame = RingFrame::new(outline, boost);
            let sampled = (boost != 0.0).then(|| Polar::sample(plane, &frame, rays));
            let polar = sampled.as_ref().unwrap_or(&self.straight);
            Radial::of(plane, target, &frame, polar, &bands).map(|radial| (boost, radial))
        };
        let looked_around =
            |(boost, radial): (f64, Radial)| radial.with_neighbours(plane, target, &RingFrame::new(outline, boost));
        let [inner, outer] = design.ring();
        let moves = inner * outer - 1.0;
        if largest * moves < SHIFT {
            return of(0.0).map(looked_around);
        }
        let steps = (largest * moves / SHIFT).ceil().min(4.0);
        let better = |a: (f64, Radial), b: (f64, Radial)| if b.1.misfit < a.1.misfit { b } else { a };
        let all = (-(steps as i32)..=steps as i32).map(|k| largest * f64::from(k) / steps);
        let mut best = all.filter_map(of).reduce(better)?;
        for half in [0.5, 0.25] {
            let step = half * largest / steps;
            let around = [best.0 - step, best.0 + step].into_iter().filter_map(of);
            best = around.fold(best, better);
        }
        Some(looked_around(best))
    }
}

/// Sign of a target's contrast: inside less outside.
fn sign(target: &Target) -> f64 {
    if target.polarity == Polarity::Bright { 1.0 } else { -1.0 }
}
