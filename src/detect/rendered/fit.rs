//! Least-squares fit of a rendered ellipse, the default measurement.
//!
//! g(x, y) = (B + C I(x, y; u, v, p, q, r, s)) (1 + h·(x, y)) for all pixels around the target, with I the exact image of the
//! blurred ellipse ([`rendered`](super::rendered)) and h the slope of the light ([`lit`](super::lit)): ten unknowns, weights equal. No pixel
//! is lost and none is interpolated, so the centre reaches the Cramér-Rao bound of the photograph.
//!
//! Light that blur carries from neighbouring objects onto those pixels biases the centre; it is corrected to first order
//! ([`neighbours`](super::neighbours)), δ = N⁻¹ J'l, and δ δ' is added to the covariance.
//!
//! Only the band of pixels that the rim's blur reaches depends on the outline ([`band`](super::band)). The design matrix
//! is rendered at the start and kept while the corrections are small against the blur (chord method): the limit is the
//! same, as the residuals are always exact.

use super::band::{Band, NormalMatrix, PixelRegion, Prior, Unknowns};
use super::flats::Flats;
use super::lit::Lit;
use super::neighbours::Neighbours;
use super::noise_autocorrelation::NoiseProducts;
use super::scatter;
use crate::detect::acceptance::{fit as limits, levels::QUIET};
use crate::detect::ellipse::outline::Outline;
use crate::detect::normal::BLUR;
use crate::detect::rendered::Field;
use crate::image::{Sample, SampleView};

/// Corrections below this share of the blur (and of the pixel) leave the design matrix as it is.
const NEAR: f64 = 0.12;
/// Corrections that shrink less than to this share renew it: where most of the profile is saturated, contrast and blur nearly
/// cannot be separated.
const SLOW: f64 = 0.35;
/// Corrections of what is saturated that do not shrink to this share are made by so much less, and by no less than the last share.
const STUCK: f64 = 0.8;
const HALTING: f64 = 0.7;
const LEAST_SHARE: f64 = 0.2;
/// Rounds at most: as a rule; of a fit with known blur and contrast, whose disc its blur has nearly swallowed; and of one that is
/// saturated, which has a longer way to its contrast.
const ROUNDS: [u32; 3] = [12, 24, 40];
/// Minimum blur, and least radius in units of blur and pixel, for which derivatives are sketched: there the standard error of a
/// centre comes out within about one percent.
const SHARPEST: f64 = 0.4;
const GENTLE: f64 = 6.0;

/// Result of the fit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    pub outline: Outline,
    /// Blur, sigma in pixels.
    pub blur: f64,
    /// Inside minus outside, negative for dark targets.
    pub contrast: f64,
    /// Rms of the residuals along the rim, in grey levels.
    pub rms: f64,
    /// Rms of the residuals less their mean profile across the rim.
    pub uneven: f64,
    /// Share of the rim's pixels that the model does not explain and that were left out.
    pub disturbed: f64,
    /// Covariance of the centre: uu, uv, vv.
    pub covariance: [f64; 3],
}

/// The values of a fit from which its noise products are computed.
struct LastFit {
    cofactors: NormalMatrix,
    contrast: f64,
    outline: Outline,
}

/// Memory that is reused from target to target.
#[derive(Default)]
pub(crate) struct Workspace {
    field: Field,
    band: Band,
    /// Place that the band's pixels are counted from.
    origin: [f64; 2],
    /// Whether neighbouring pixels may share their noise.
    pub coloured: bool,
    /// Sigma of the mean that the picture was made by; 0 of one as it was taken.
    pub mean: f64,
    /// Whether the last fit was given up for what its corrections promised.
    pub hopeless: bool,
    /// Of the last fit, if it led to a result.
    last: Option<LastFit>,
}

/// Outline, blur and levels of a fit of a sketched ellipse ([`Band::sketch`]) to all pixels, which only needs to be good
/// enough to choose the pixels of the next one: corrections below `converged` pixels are expected. `None` if the steps lead
/// nowhere.
pub(crate) fn approach<T: Sample>(
    plane: &SampleView<T>,
    region: &PixelRegion,
    blur: f64,
    converged: f64,
    work: &mut Workspace,
) -> Option<(Outline, f64, Lit)> {
    let (mut state, flats) = work.begin(plane, region, blur)?;
    let (mut normal, mut anew, mut last) = (NormalMatrix::zeros(), true, state.first());
    for round in 0.. {
        state.may_go_on(round)?;
        if !work.field.holds(&state.outline, state.blur) {
            return None;
        }
        let clipped = state.is_clipped();
        if anew {
            work.band.sketch::<true>(&state.outline, state.blur, work.origin);
        } else if !clipped {
            work.band.sketch::<false>(&state.outline, state.blur, work.origin);
        }
        if clipped {
            // only the foot of its profile shows, where a sketch is not good enough
            work.residuals(&state, false)?;
        } else {
            work.band.subtract(&state.lit);
        }
        if anew {
            normal = work.normal(&state, &flats);
        }
        let (size, used) = state.step(&normal, &work.right(&state, &flats))?;
        normal = used;
        let near = size <= NEAR * state.pixel();
        if near && size * (size / last).min(1.0) < converged && last.is_finite() {
            return Some((state.outline, state.blur, state.lit));
        }
        anew = !near || size > SLOW * last;
        last = size;
    }
    None
}

/// Fits the rendered ellipse, started at the region's outline with the given blur, until corrections below `converged`
/// pixels are expected; `None` if that does not happen.
pub(crate) fn fit<T: Sample>(
    plane: &SampleView<T>,
    region: &PixelRegion,
    blur: f64,
    converged: f64,
    work: &mut Workspace,
) -> Option<Fit> {
    work.hopeless = false;
    let (mut state, flats) = work.begin(plane, region, blur)?;
    let mut normal = NormalMatrix::zeros();
    let (mut render_all, mut near, mut disturbed, mut dropped) = (true, true, true, 0);
    let (mut anew, mut last) = (true, state.first());
    let (mut limit, mut rounds) = (f64::INFINITY, 0);
    for round in 0.. {
        state.may_go_on(round)?;
        // derivatives only show the way
        let sketched = render_all && state.may_be_sketched();
        if sketched {
            work.band.sketch::<true>(&state.outline, state.blur, work.origin);
        }
        work.residuals(&state, render_all && !sketched)?;
        if near && disturbed {
            // the first limit is wide, as disturbances widen the scatter; one that followed the residuals in every round
            // would eat up what a lens does to an edge
            if rounds < 2 {
                limit = work.outlier_limit(&state, region);
            }
            rounds += 1;
            let count = work.band.drop_outliers(limit, 2.0 * state.blur + 1.0);
            anew = count > 0;
            disturbed = count > 0 && region.whole;
            dropped += count;
        }
        let right = work.right(&state, &flats);
        if render_all || anew {
            anew = false;
            normal = work.normal(&state, &flats);
            if let Some(prior) = &region.prior {
                let promised = solve(&normal, &right)?;
                work.hopeless =
                    prior.is_hopeless(work.band.promised_rms(&promised, &right), state.lit.contrast + promised[6]);
                if work.hopeless {
                    return None;
                }
            }
        }
        let (size, used) = state.step(&normal, &right)?;
        normal = used;
        // corrections shrink by about the same factor each time: the next one would be this small
        let settled = size * (size / last).min(1.0) < converged;
        let slow = size > SLOW * last;
        last = size;
        if settled && !disturbed {
            break;
        }
        near = size <= NEAR * state.pixel();
        render_all = !near || slow;
    }
    let (variance, used) = work.band.variance();
    // at the largest contrast nothing is left of the rim's profile but a step, and its sigma would promise too much
    if used < limits::PIXELS
        || state.lit.contrast.abs() > (limits::STEP_LEFT * state.brightest).max(limits::STEP_LEAST * state.shown)
    {
        return None;
    }
    let cofactors = invert(&normal)?;
    let (rms, uneven) = (variance.sqrt(), work.band.unevenness());
    let noise = region.surround.noise.powi(2).max(1.0 / 12.0);
    let beyond = variance > limits::UNEXPLAINED * noise;
    // What a camera does to edges it does on either side alike, which moves no centre. Where the scale ends, along aliased edges and at drawn
    // edges, which no lens has softened, it depends on where the pixels lie.
    let all_around = region.whole && region.developed && (work.coloured || beyond);
    let values = if all_around { work.band.take_profile(&state.outline, work.origin) } else { 0 };
    // a value takes the noise of a ring half a pixel wide, of which a mean has left that many times the variance
    let taken = values as f64 * (work.mean * std::f64::consts::PI.sqrt()).max(1.0);
    let lights = match beyond {
        true => work.band.lights::<true>(&cofactors, state.lit.contrast),
        false => work.band.lights::<false>(&cofactors, state.lit.contrast),
    }
    .of_profile(taken);
    let mut covariance = scatter::covariance(&cofactors, &lights, &flats, &state.lit);
    // what is left around a disturbance follows no light: the mean of all may tell more of it
    let mean = cofactors[(0, 0)] + cofactors[(1, 1)];
    let variance = if all_around { lights.variance() } else { variance };
    if dropped > 0 && mean * variance > covariance[0] + covariance[2] {
        covariance = [(0, 0), (0, 1), (1, 1)].map(|place| cofactors[place] * variance);
    }
    let by_shape = match variance > limits::SHAPED * noise {
        true => work.band.shifts_by_shape(&state.outline, work.origin, state.blur, state.lit.contrast, &cofactors),
        false => [0.0; 3],
    };
    // residuals above the noise that neighbouring pixels share are a shape that the model lacks, as that of motion blur
    if beyond && !work.coloured && work.band.shared(&work.field, &state.outline, work.origin) > limits::SHARED {
        let share = (1.0 - noise / variance).max(0.0);
        covariance = covariance.map(|value| value * (1.0 + share * (limits::MOVED_TOGETHER - 1.0)));
    }
    let mut outline = state.outline;
    let reach = region.half_band.min(region.surround.outer.max(1.0)) + 0.3;
    if let Some(neighbours) = Neighbours::of(plane, &outline, state.blur, state.lit.contrast, reach, rms) {
        let [u, v] = work.origin;
        let pulled = cofactors * work.band.right_of_light(state.lit.contrast, |x, y| neighbours.light(x + u, y + v));
        let [pu, pv] = [pulled[0], pulled[1]];
        (outline.u, outline.v) = (outline.u - pu, outline.v - pv);
        // the light is known to about its own size
        covariance = [covariance[0] + pu * pu, covariance[1] + pu * pv, covariance[2] + pv * pv];
    }
    work.last = Some(LastFit { cofactors, contrast: state.lit.contrast, outline: state.outline });
    (covariance[0] > 0.0 && covariance[2] > 0.0).then_some(Fit {
        outline,
        blur: state.blur,
        contrast: state.lit.contrast,
        rms,
        uneven,
        disturbed: dropped as f64 / used as f64,
        covariance: std::array::from_fn(|i| covariance[i] + by_shape[i]),
    })
}

impl Workspace {
    /// Chooses the pixels and the first values.
    fn begin<T: Sample>(
        &mut self,
        plane: &SampleView<T>,
        region: &PixelRegion,
        blur: f64,
    ) -> Option<(FitState, Flats)> {
        self.last = None;
        let surround = region.surround;
        let shown = if surround.contrast > 0.0 { region.saturation - surround.level } else { surround.level };
        let state = FitState {
            shown,
            brightest: (limits::OVEREXPOSED * shown).max(surround.contrast.abs()),
            outline: region.outline,
            blur: blur.clamp(BLUR.0, BLUR.1),
            lit: Lit::of(surround, region.light, region.multiplies),
            prior: region.prior,
            before: f64::INFINITY,
            share: 1.0,
        };
        self.origin = [region.outline.u, region.outline.v];
        self.field.place(&region.outline, state.blur, region.half_band);
        Some((state, self.band.collect(plane, &self.field, region)?))
    }

    /// Noise autocorrelation of the last fit; `None` without one, or where neighbouring pixels are not known to share their noise.
    pub fn noise_products(&self) -> Option<NoiseProducts> {
        let LastFit { cofactors, contrast, outline } = self.last.as_ref().filter(|_| self.coloured)?;
        self.band.colour(&self.field, cofactors, *contrast, outline, self.origin, self.mean)
    }

    /// Discards the last fit, so that a target measured without a fit is not given its noise products.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// Renders the model at the state and takes it off the pixels; `None` if it leaves the field.
    fn residuals(&mut self, state: &FitState, derivatives: bool) -> Option<()> {
        if !self.field.holds(&state.outline, state.blur) {
            return None;
        }
        self.field.render(&state.outline, state.blur, derivatives, &self.band.spans);
        self.band.gather(&self.field, self.origin, derivatives.then_some(&state.outline));
        self.band.subtract(&state.lit);
        Some(())
    }

    /// Residual beyond which, near the end, a pixel is not the target's.
    fn outlier_limit(&mut self, state: &FitState, region: &PixelRegion) -> f64 {
        // an edge sharper than any that is rendered leaves up to 0.4 of the least blur in a pixel
        let sharp = if state.blur <= BLUR.0 { limits::SHARP * state.lit.contrast.abs() } else { 0.0 };
        let profile = if region.stairs { limits::STAIRS } else { limits::LENS };
        // where the rim departs from an ellipse, by the steepness of its profile
        let steepest = 1.0 / (std::f64::consts::TAU * (state.blur * state.blur + 1.0 / 12.0)).sqrt();
        let shape = limits::DEPARTS * region.shape * steepest;
        let least = (limits::OUTLIER * region.surround.noise.max(QUIET))
            .max(sharp)
            .max(profile.max(shape) * state.lit.contrast.abs());
        // rounding to levels that lie apart moves a sample by up to half of that
        let least = least + (region.quantum - 1.0) / 2.0;
        least.max(limits::OUTLIER * self.band.robust_deviation(least / limits::OUTLIER))
    }

    fn normal(&self, state: &FitState, flats: &Flats) -> NormalMatrix {
        let mut normal = self.band.normal(state.lit.contrast);
        flats.add_normal(&state.lit, &mut normal);
        if let Some(prior) = &state.prior {
            prior.add_normal(&mut normal);
        }
        normal
    }

    fn right(&self, state: &FitState, flats: &Flats) -> Unknowns {
        let mut right = self.band.right(state.lit.contrast);
        flats.add_right(&state.lit, &mut right);
        if let Some(prior) = &state.prior {
            prior.add_right(state.blur, state.lit.contrast, &mut right);
        }
        right
    }
}

/// Values of the unknowns.
struct FitState {
    outline: Outline,
    blur: f64,
    lit: Lit,
    prior: Option<Prior>,
    /// Contrast that the scale can show, and the maximum that is accepted.
    shown: f64,
    brightest: f64,
    /// Size of the last correction, and the share of corrections that is made.
    before: f64,
    share: f64,
}

impl FitState {
    /// Blur and pixel together: corrections that are small against it change the profile in proportion.
    fn pixel(&self) -> f64 {
        self.blur + 0.3
    }

    /// Whether a bright target seems to go on beyond the scale.
    fn is_clipped(&self) -> bool {
        self.lit.contrast > limits::CLIPPED * self.shown
    }

    /// What the first correction is compared with: Newton's steps shrink in the ratio of the correction to the profile's
    /// width. Where it is saturated, contrast and blur can hardly be separated and may go on for long, which the centre
    /// does not notice: two corrections of an approach, and one of a fit that follows it, are enough.
    fn first(&self) -> f64 {
        if self.is_clipped() { f64::INFINITY } else { self.pixel() }
    }

    /// Whether the derivatives of a sketch are as good as rendered ones: where the rim's smallest radius is large against the blur.
    fn may_be_sketched(&self) -> bool {
        let (a, b) = self.outline.semi_axes();
        !self.is_clipped() && self.blur >= SHARPEST && b * b > GENTLE * a * self.blur.hypot(0.29)
    }

    /// Whether the blur is at an end of its range and the correction would take it out.
    fn blur_leaves(&self, correction: f64) -> bool {
        (self.blur <= BLUR.0 && correction < 0.0) || (self.blur >= BLUR.1 && correction > 0.0)
    }

    /// `None` if there were rounds enough.
    fn may_go_on(&self, round: u32) -> Option<()> {
        let [usual, swallowed, clipped] = ROUNDS;
        let rounds = if self.lit.contrast.abs() > self.shown { clipped } else { usual };
        (round < if self.prior.is_some() { rounds.max(swallowed) } else { rounds }).then_some(())
    }

    /// Solves and corrects the state; the size of the correction of outline and blur, in pixels, and the normal matrix used.
    fn step(&mut self, normal: &NormalMatrix, right: &Unknowns) -> Option<(f64, NormalMatrix)> {
        let (mut normal, mut right) = (*normal, *right);
        let mut step = solve(&normal, &right)?;
        if self.blur_leaves(step[5]) {
            // at the end of its range the blur is held, or the others would follow a correction that is never made
            hold(5, &mut normal, &mut right);
            step = solve(&normal, &right)?;
        }
        if self.lit.contrast.abs() >= self.brightest && step[6] * self.lit.contrast > 0.0 {
            hold(6, &mut normal, &mut right);
            step = solve(&normal, &right)?;
        }
        let size = step.fixed_rows::<6>(0).amax();
        if !size.is_finite() {
            return None;
        }
        let limit = 0.8 * self.pixel();
        let whole = (limit / size).min(0.6 * self.lit.contrast.abs() / step[6].abs()).min(1.0);
        // where contrast and blur can hardly be separated whole corrections may go to and fro for ever
        if self.is_clipped() && size > STUCK * self.before {
            self.share = (HALTING * self.share).max(LEAST_SHARE);
        }
        self.before = size;
        self.add(&(step * self.share * if whole > 0.0 { whole } else { 1.0 }));
        self.lit.contrast = self.lit.contrast.clamp(-self.brightest, self.brightest);
        self.outline.is_proper().then_some((size, normal))
    }

    fn add(&mut self, step: &Unknowns) {
        self.outline = self.outline.plus(&step.as_slice()[..5]);
        self.blur = (self.blur + step[5]).clamp(BLUR.0, BLUR.1);
        self.lit.add(&step.as_slice()[6..]);
    }
}

/// Takes one out of the unknowns.
fn hold(which: usize, normal: &mut NormalMatrix, right: &mut Unknowns) {
    for i in 0..normal.nrows() {
        (normal[(which, i)], normal[(i, which)]) = (0.0, 0.0);
    }
    normal[(which, which)] = 1.0;
    right[which] = 0.0;
}

/// Scales the normal equations to a unit diagonal, with a trace of damping for what the pixels do not determine (the
/// contrast of a target that is saturated inside).
fn scaled(normal: &NormalMatrix) -> (NormalMatrix, Unknowns) {
    let scale = Unknowns::from_fn(|i, _| 1.0 / normal[(i, i)].max(1e-12).sqrt());
    let mut matrix = NormalMatrix::from_fn(|i, j| normal[(i, j)] * scale[i] * scale[j]);
    for i in 0..matrix.nrows() {
        matrix[(i, i)] += 1e-7;
    }
    (matrix, scale)
}

fn solve(normal: &NormalMatrix, right: &Unknowns) -> Option<Unknowns> {
    let (matrix, scale) = scaled(normal);
    Some(matrix.cholesky()?.solve(&right.component_mul(&scale)).component_mul(&scale))
}

fn invert(normal: &NormalMatrix) -> Option<NormalMatrix> {
    let (matrix, scale) = scaled(normal);
    let inverse = matrix.cholesky()?.inverse();
    Some(NormalMatrix::from_fn(|i, j| inverse[(i, j)] * scale[i] * scale[j]))
}
