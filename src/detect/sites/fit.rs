//! Least-squares fit of a rendered ellipse to the sites of one colour.
//!
//! g(x, y) = (B + C I(x, y; u, v, p, q, r, s)) (1 + h·(x, y)) as for pictures ([`rendered`](crate::detect::rendered)), here at the
//! sites alone, each weighted by the inverse of its variance r + g g(x, y). The variance is computed from the model, not from the sample:
//! weights that depend on a sample's noise would bias the fit towards dark samples. For the same reason the model decides which sites
//! are saturated. The covariance is the Cramér-Rao bound of these sites, scaled by the residuals if these are larger than the noise.
//! Light that blur carries from neighbouring objects onto the sites is corrected to first order, as for pictures
//! ([`neighbours`](crate::detect::rendered::neighbours)).

mod system;

use super::Sites;
use crate::detect::acceptance::fit::{OVEREXPOSED, RMS_NOISE, RMS_PROFILE};
use crate::detect::acceptance::sites::{DISTURBED, FAR, LENS};
use crate::detect::ellipse::outline::Outline;
use crate::detect::normal::BLUR;
use crate::detect::rendered::lit::Lit;
use crate::detect::rendered::{Field, Span};
use system::{SiteUnknowns, System, UNKNOWNS, counts, modelled};

/// Maximum number of corrections; saturated targets need more.
const ROUNDS: usize = 40;
/// Size of a correction, in pixels, below which the fit has converged.
const CONVERGED: f64 = 2e-5;
/// Maximum width of the background used around the blurred rim, pixels.
const WIDEST: f64 = 14.0;

/// Result of the fit. Levels are samples minus the black level.
pub(super) struct SiteFit {
    pub outline: Outline,
    pub blur: f64,
    pub contrast: f64,
    /// Level of the background at the centre.
    pub ground: f64,
    /// Rms of the residuals.
    pub rms: f64,
    /// Share of the sites inside that are saturated.
    pub clipped: f64,
    /// Covariance of the centre: uu, uv, vv.
    pub covariance: [f64; 3],
}

/// A site: its position, its light (sample minus black level), and whether its sample is saturated.
struct Site {
    x: i64,
    y: i64,
    light: f64,
    black: f64,
    clipped: bool,
    kept: bool,
}

struct SiteFitState {
    outline: Outline,
    blur: f64,
    lit: Lit,
}

/// Fits, starting from an outline and a blur measured on the whole grid. `outer` is the distance from the rim up to which the background
/// is free of other objects. After a first fit the sites are chosen anew from its outline; sites in the hole are not used. `light` gives
/// the light of neighbouring objects at a site, as a share of the contrast, for a fit and a reach around it.
pub(super) fn fit<L: Fn(f64, f64) -> f64>(
    sites: &Sites,
    start: &Outline,
    hole: Option<&Outline>,
    blur: f64,
    outer: f64,
    field: &mut Field,
    light: impl Fn(&SiteFit, f64) -> Option<L>,
) -> Option<SiteFit> {
    let blur = blur.clamp(BLUR.0.max(0.4), BLUR.1);
    let reach = |blur: f64| (2.5 * blur + 1.0).max(outer.min(2.5 * blur + WIDEST));
    let around = |outline: &Outline, blur: f64| {
        let chosen = choose(sites, &outline.grown(reach(blur)), hole);
        (chosen.len() >= 2 * UNKNOWNS).then_some(chosen)
    };
    let mut chosen = around(start, blur)?;
    let mut state = first(start, blur, &chosen)?;
    approach(sites, &mut chosen, &mut state, true, field)?;
    chosen = around(&state.outline, state.blur)?;
    let origin = [state.outline.u, state.outline.v];
    state.lit.shift(origin[0] - start.u, origin[1] - start.v);
    let origin = approach(sites, &mut chosen, &mut state, false, field)?;
    let (mut found, system) = finished(sites, &chosen, &state, field, origin)?;
    if let Some(light) = light(&found, reach(state.blur)) {
        let [pu, pv] = system.pulled(sites, &chosen, &state, field, origin, |x, y| state.lit.contrast * light(x, y))?;
        (found.outline.u, found.outline.v) = (found.outline.u - pu, found.outline.v - pv);
        // the standard error of this correction is about its size
        let [uu, uv, vv] = found.covariance;
        found.covariance = [uu + pu * pu, uv + pu * pv, vv + pv * pv];
    }
    Some(found)
}

/// Iterates to convergence, excluding sites that do not belong to the target. Returns the position to which the slopes of the background
/// refer.
fn approach(
    sites: &Sites,
    chosen: &mut [Site],
    state: &mut SiteFitState,
    by_sample: bool,
    field: &mut Field,
) -> Option<[f64; 2]> {
    let origin = [state.outline.u, state.outline.v];
    let black = sites.sensor.mosaic.black.at(origin[0].max(0.0) as usize, origin[1].max(0.0) as usize);
    let white = sites.clip - black;
    let shown = if state.lit.contrast > 0.0 { white - state.lit.ground } else { state.lit.ground }.max(1.0);
    let most = OVEREXPOSED * shown.max(state.lit.contrast.abs());
    let (mut cleaned, mut last) = (0, f64::INFINITY);
    for round in 0..ROUNDS {
        render(field, state);
        let system = System::of(sites, chosen, state, field, origin, by_sample && round == 0);
        let step = system.solve()?;
        let size = step.fixed_rows::<6>(0).amax();
        if !size.is_finite() {
            return None;
        }
        let limit =
            (0.6 * (state.blur + 0.3) / size).min(0.6 * state.lit.contrast.abs() / step[6].abs().max(1e-12)).min(1.0);
        state.add(&(step * limit), most);
        if !state.outline.is_proper() {
            return None;
        }
        let settled = size < CONVERGED || (round > 12 && size < 1e-3 && size > 0.5 * last);
        last = size;
        let near = size < 0.02;
        if (near && cleaned == 0) || (settled && cleaned < 4) {
            cleaned += 1;
            render(field, state);
            if clean(sites, chosen, state, field, origin) || !settled {
                continue;
            }
        }
        if settled {
            render(field, state);
            return Some(origin);
        }
    }
    // the contrast of a saturated target may not converge, which does not affect the centre
    render(field, state);
    (last < 1e-3).then_some(origin)
}

/// The sites inside an outline, without those in a hole.
fn choose(sites: &Sites, around: &Outline, hole: Option<&Outline>) -> Vec<Site> {
    let half_v = around.half_box().1;
    let [left, top, right, bottom] = sites.lit;
    let range = |from: f64, to: f64, low: usize, high: usize| {
        let last = (to.ceil().max(0.0) as usize).clamp(low, high);
        (from.floor().max(0.0) as usize).clamp(low, last)..last
    };
    let mut chosen = Vec::new();
    for y in range(around.v - half_v, around.v + half_v, top, bottom) {
        let Some((from, to)) = around.chord(y as f64 + 0.5).filter(|_| sites.is_whole(y)) else { continue };
        let hidden = hole.and_then(|hole| hole.chord(y as f64 + 0.5)).unwrap_or((f64::INFINITY, f64::INFINITY));
        let is_hidden = |x: &usize| (hidden.0..hidden.1).contains(&(*x as f64 + 0.5));
        for x in range(from - 0.5, to + 0.5, left, right).filter(|x| sites.has(*x, y) && !is_hidden(x)) {
            let (raw, black) = (f64::from(sites.raw(x, y)), sites.sensor.mosaic.black.at(x, y));
            let clipped = raw >= sites.clip;
            chosen.push(Site { x: x as i64, y: y as i64, light: raw - black, black, clipped, kept: true });
        }
    }
    chosen
}

/// First values: medians of the light well inside and outside of the outline.
fn first(outline: &Outline, blur: f64, chosen: &[Site]) -> Option<SiteFitState> {
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    let (core, rim) = (outline.grown(-(1.2 * blur).min(0.5 * outline.semi_axes().1)), outline.grown(1.5 * blur + 0.5));
    for site in chosen {
        let [c, s] = core.normalised(site.x as f64 + 0.5, site.y as f64 + 0.5);
        let [far_c, far_s] = rim.normalised(site.x as f64 + 0.5, site.y as f64 + 0.5);
        if c * c + s * s < 1.0 {
            inside.push(site.light);
        } else if far_c * far_c + far_s * far_s > 1.0 {
            outside.push(site.light);
        }
    }
    let median = |levels: &mut Vec<f64>| {
        let middle = levels.len() / 2;
        (!levels.is_empty()).then(|| *levels.select_nth_unstable_by(middle, f64::total_cmp).1)
    };
    let (disc, ground) = (median(&mut inside)?, median(&mut outside)?);
    (disc != ground).then_some(SiteFitState { outline: *outline, blur, lit: Lit::new(ground, disc - ground, [0.0; 2]) })
}

fn render(field: &mut Field, state: &SiteFitState) {
    if field.width == 0 || !field.holds(&state.outline, state.blur) {
        field.place(&state.outline, state.blur, 1.5);
    }
    let spans: Vec<Span> = (0..field.height).map(|row| (row, 0, field.width)).collect();
    field.render(&state.outline, state.blur, true, &spans);
}

impl SiteFitState {
    fn add(&mut self, step: &SiteUnknowns, most: f64) {
        self.outline = self.outline.plus(&step.as_slice()[..5]);
        self.blur = (self.blur + step[5]).clamp(BLUR.0, BLUR.1);
        self.lit.add(&step.as_slice()[6..]);
        self.lit.contrast = self.lit.contrast.clamp(-most, most);
    }
}

/// Excludes sites that do not belong to the target: dirt, hot sites, occluders. Returns whether anything changed.
fn clean(sites: &Sites, chosen: &mut [Site], state: &SiteFitState, field: &Field, origin: [f64; 2]) -> bool {
    let mut changed = false;
    for k in 0..chosen.len() {
        let model = modelled(&chosen[k], state, field, origin);
        let limit = (FAR * sites.noise.deviation(model.level)).max(LENS * state.lit.contrast.abs());
        let clipped = !counts(sites, &Site { kept: true, ..chosen[k] }, model.level, false);
        let kept = clipped || (chosen[k].light - model.level).abs() <= limit;
        changed |= kept != chosen[k].kept;
        chosen[k].kept = kept;
    }
    changed
}

fn finished(
    sites: &Sites,
    chosen: &[Site],
    state: &SiteFitState,
    field: &Field,
    origin: [f64; 2],
) -> Option<(SiteFit, System)> {
    let system = System::of(sites, chosen, state, field, origin, false);
    let free = system.used.checked_sub(UNKNOWNS).filter(|free| *free >= UNKNOWNS)? as f64;
    let dropped = chosen.iter().filter(|site| !site.kept).count() as f64;
    let ground = state.lit.ground;
    let rms = (system.squares[1] / free).sqrt();
    let noise = sites.noise.deviation(ground.max(ground + state.lit.contrast));
    let explained = rms <= RMS_NOISE * noise + RMS_PROFILE * state.lit.contrast.abs();
    if dropped > DISTURBED * chosen.len() as f64 || !explained {
        return None;
    }
    // a chance deviation of the sum of squares does not change the noise
    let excess = system.squares[0] / free;
    let factor = if excess > 1.0 + 3.0 * (2.0 / free).sqrt() { excess } else { 1.0 };
    let covariance = system.covariance()?.map(|part| factor * part);
    let (mut inside, mut clipped) = (0.0, 0.0);
    for site in chosen {
        let [c, s] = state.outline.normalised(site.x as f64 + 0.5, site.y as f64 + 0.5);
        if c * c + s * s <= 1.0 {
            inside += 1.0;
            clipped += if site.clipped { 1.0 } else { 0.0 };
        }
    }
    let sound = covariance.iter().all(|part| part.is_finite()) && covariance[0] > 0.0 && covariance[2] > 0.0;
    let clipped = clipped / f64::max(inside, 1.0);
    let SiteFitState { outline, blur, lit: Lit { contrast, .. } } = *state;
    sound.then_some((SiteFit { outline, blur, contrast, ground, rms, clipped, covariance }, system))
}
