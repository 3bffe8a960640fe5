//! Distortion over the image radius with its confidence band from the covariance of the parameters.
//!
//! Brown: Δr = K1 r³ + K2 r⁵ + K3 r⁷, the correction of the measurement; opencv: Δr = f (k1 ρ³ + k2 ρ⁵ + k3 ρ⁷) with ρ = r / f, the distortion of
//! the ideal point; opencv_rational: Δr = r (R(ρ) - 1); opencv_fisheye: Δr = f (k1 θ³ + k2 θ⁵ + k3 θ⁷ + k4 θ⁹), and the radius is f θ. Balanced: Δr - (Δr(r₀) / r₀) r, which another principal distance gives the same images with; here r₀ is two thirds of the
//! largest radius. Decentring: √(P1² + P2²) r² (D. C. Brown 1966; J. G. Fryer and D. C. Brown 1986). Band: σ² = gᵀ C g with g the derivative by the
//! parameters.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot, file_name};
use crate::context::Context;
use crate::number::{decimals_for, fixed, round, round_below};
use sightline::adjustment::AdjustedCamera;
use sightline::camera::Rational;
use sightline::project::Parameter;

/// Places along the radius.
const STEPS: usize = 120;

pub fn plots(context: &Context) -> Vec<Plot> {
    let mut plots = Vec::new();
    for camera in &context.adjustment.cameras {
        let Some(lens) = Lens::of(context, camera) else { continue };
        plots.extend(lens.radial(context));
        plots.extend(lens.decentring(context));
    }
    plots
}

/// gᵀ C g from standard errors and correlations; parameters that were held have none.
fn variance(adjusted: &AdjustedCamera, terms: &[(Parameter, f64)]) -> f64 {
    let names = &adjusted.correlation.names;
    let place = |p: Parameter| names.iter().position(|name| name == p.name());
    let part = |(p, g): &(Parameter, f64)| Some((place(*p)?, g * adjusted.sigma.get(p)?));
    let known: Vec<(usize, f64)> = terms.iter().filter_map(part).collect();
    let correlation = |i: usize, j: usize| {
        let row = adjusted.correlation.matrix.get(i);
        row.and_then(|row| row.get(j)).copied().unwrap_or(if i == j { 1.0 } else { 0.0 })
    };
    let pairs = known.iter().flat_map(|a| known.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| a.1 * b.1 * correlation(a.0, b.0)).sum()
}

/// Standard error of K1 r³ + K2 r⁵ + K3 r⁷.
pub fn radial_sigma(adjusted: &AdjustedCamera, r: f64) -> Option<f64> {
    let terms = [(Parameter::K1, r.powi(3)), (Parameter::K2, r.powi(5)), (Parameter::K3, r.powi(7))];
    (!adjusted.sigma.is_empty()).then(|| variance(adjusted, &terms).max(0.0).sqrt())
}

/// A lens as a function of the radius.
struct Lens<'a> {
    adjusted: &'a AdjustedCamera,
    name: String,
    /// Photo units, or pixels.
    unit: &'static str,
    /// In which distortion is shown.
    shown: (f64, &'static str),
    /// Principal distance that radii are divided by, 1 for brown.
    focal: f64,
    /// To the farthest corner.
    corner: f64,
    /// Of the outermost target.
    outermost: f64,
}

impl<'a> Lens<'a> {
    fn of(context: &Context, adjusted: &'a AdjustedCamera) -> Option<Self> {
        let camera = &adjusted.camera;
        let model = camera.interior.model();
        let metric = model.in_photo_units && camera.pixel_pitch.is_some();
        let get = |p| camera.interior.get(p).unwrap_or(0.0);
        let centre = model.centre.map(get);
        let (focal, centre) = if model.in_photo_units {
            (1.0, centre)
        } else {
            (get(Parameter::Fx), camera.photo_from_pixel(centre).map(|c| c / camera.pitch()[0]))
        };
        let pitch = camera.residual_pitch();
        let (w, h) = (f64::from(camera.width) * pitch[0] / 2.0, f64::from(camera.height) * pitch[1] / 2.0);
        let corner = (w + centre[0].abs()).hypot(h + centre[1].abs());
        let radius = |u: f64, v: f64| {
            let x = (u - f64::from(camera.width) / 2.0) * pitch[0] - centre[0];
            let y = (f64::from(camera.height) / 2.0 - v) * pitch[1] - centre[1];
            x.hypot(y)
        };
        let own = |photo: &str| match &adjusted.photo {
            Some(only) => only == photo,
            None => context.camera_of(photo).is_some_and(|c| c.id == camera.id),
        };
        let pairs = context.project.observations.iter().zip(&context.adjustment.observations);
        let outermost =
            pairs.filter(|(o, r)| r.enabled && own(&o.photo)).map(|(o, _)| radius(o.u, o.v)).fold(0.0, f64::max);
        let name = adjusted.photo.as_ref().map_or(camera.id.clone(), |photo| format!("{} · {photo}", camera.id));
        (focal > 0.0 && corner.is_finite()).then_some(Self {
            adjusted,
            name,
            unit: if metric { "mm" } else { "px" },
            shown: if metric { (1000.0, "µm") } else { (1.0, "px") },
            focal,
            corner,
            outermost,
        })
    }

    fn value(&self, parameter: Parameter) -> f64 {
        self.adjusted.camera.interior.get(parameter).unwrap_or(0.0)
    }

    fn variance(&self, terms: &[(Parameter, f64)]) -> f64 {
        variance(self.adjusted, terms)
    }

    /// The radial terms alone with their derivatives: each parameter with the power of the radius that it multiplies.
    fn radial_at(&self, r: f64) -> (f64, f64) {
        let interior = &self.adjusted.camera.interior;
        let rho = r / self.focal;
        let power = |(p, power): &(Parameter, i32)| (*p, self.focal * rho.powi(*power));
        let mut terms: Vec<(Parameter, f64)> = interior.model().radial.iter().map(power).collect();
        let value = match Rational::new(interior) {
            Some(lens) => {
                // r R - r with R the ratio: by the numerator's terms over the denominator, by the denominator's -R times as much.
                let (ratio, below) = lens.radial(rho * rho);
                for (p, g) in &mut terms {
                    let denominator = matches!(p, Parameter::K4 | Parameter::K5 | Parameter::K6);
                    *g *= if denominator { -ratio / below } else { 1.0 / below };
                }
                r * (ratio - 1.0)
            }
            None => terms.iter().map(|(p, g)| self.value(*p) * g).sum(),
        };
        (value, self.variance(&terms).max(0.0).sqrt())
    }

    fn radii(&self) -> impl Iterator<Item = f64> + use<> {
        let corner = self.corner;
        (0..=STEPS).map(move |k| corner * k as f64 / STEPS as f64)
    }

    fn radial(&self, context: &Context) -> Option<Plot> {
        let words = context.words;
        let any = self.adjusted.camera.interior.model().radial.iter().any(|(p, _)| self.value(*p) != 0.0);
        if !any {
            return None;
        }
        let (factor, unit) = self.shown;
        let curve: Vec<(f64, f64, f64)> = self
            .radii()
            .map(|r| {
                let (d, s) = self.radial_at(r);
                (r, d * factor, s * factor)
            })
            .collect();
        let r0 = self.corner * 2.0 / 3.0;
        let slope = self.radial_at(r0).0 / r0;
        let balanced: Vec<[f64; 2]> = curve.iter().map(|(r, d, _)| [*r, d - slope * r * factor]).collect();
        // The band is widened until it is seen where there are targets.
        let range = curve.iter().map(|c| c.1.abs()).fold(0.0, f64::max);
        let edge = self.radial_at(if self.outermost > 0.0 { self.outermost } else { self.corner }).1 * factor;
        let widened = if edge > 0.0 { round_below((0.04 * range / edge).clamp(1.0, 1000.0)) } else { 1.0 };
        let title = words.plot_radial(&self.name);
        let at_edge = self.radial_at(self.outermost);
        let sentence = words.plot_radial_says(
            &fixed(at_edge.0 * factor, 1),
            &fixed(at_edge.1 * factor, 2),
            &unit,
            &fixed(self.outermost, 1),
            &self.unit,
            &round(widened),
        );
        let y = Axis::around(
            curve.iter().map(|c| c.1).chain(balanced.iter().map(|b| b[1])).chain([0.0]),
            &format!("Δr {unit}"),
        );
        let mut chart = Chart::new(&title, &sentence, Axis::of(0.0, self.corner, &format!("r {}", self.unit)), y);
        let side = |sign: f64| curve.iter().map(|(r, d, s)| [*r, d + sign * widened * s]).collect::<Vec<_>>();
        chart.band("band", &side(-1.0), &side(1.0));
        let middle: Vec<[f64; 2]> = curve.iter().map(|(r, d, _)| [*r, *d]).collect();
        chart.line("line-a", &middle);
        chart.line("line-b", &balanced);
        if self.outermost > 0.0 && self.outermost < self.corner {
            chart.mark(self.outermost, &words.no_target_beyond(&fixed(self.outermost, 1), &self.unit));
        }
        let [left, top, ..] = chart.frame();
        chart.svg.label("a", [left + 10.0, top + 26.0], Anchor::Start, words.as_estimated());
        chart.svg.label("b", [left + 10.0, top + 41.0], Anchor::Start, words.balanced());
        Some(self.plot("radial", title, sentence, chart))
    }

    fn decentring(&self, context: &Context) -> Option<Plot> {
        let words = context.words;
        let (p1, p2) = (self.value(Parameter::P1), self.value(Parameter::P2));
        let size = p1.hypot(p2);
        if size == 0.0 {
            return None;
        }
        let (factor, unit) = self.shown;
        let at = |r: f64| {
            let g = r * r / self.focal;
            let sigma =
                self.variance(&[(Parameter::P1, g * p1 / size), (Parameter::P2, g * p2 / size)]).max(0.0).sqrt();
            (size * g * factor, sigma * factor)
        };
        let curve: Vec<(f64, f64, f64)> = self
            .radii()
            .map(|r| {
                let (d, s) = at(r);
                (r, d, s)
            })
            .collect();
        let title = words.plot_decentring(&self.name);
        let (value, sigma) = at(self.outermost);
        let decimals = decimals_for(sigma);
        let sentence = words.plot_decentring_says(
            &fixed(value, decimals),
            &fixed(sigma, decimals),
            &unit,
            &fixed(self.outermost, 1),
            &self.unit,
        );
        let top = curve.iter().map(|c| c.1 + 2.0 * c.2).fold(0.0, f64::max);
        let y = Axis::of(0.0, 1.05 * top, &format!("P(r) {unit}"));
        let mut chart = Chart::new(&title, &sentence, Axis::of(0.0, self.corner, &format!("r {}", self.unit)), y);
        let side = |sign: f64| curve.iter().map(|(r, d, s)| [*r, d + sign * 2.0 * s]).collect::<Vec<_>>();
        chart.band("band", &side(-1.0), &side(1.0));
        let middle: Vec<[f64; 2]> = curve.iter().map(|(r, d, _)| [*r, *d]).collect();
        chart.line("line-a", &middle);
        if self.outermost > 0.0 && self.outermost < self.corner {
            chart.mark(self.outermost, &words.no_target_beyond(&fixed(self.outermost, 1), &self.unit));
        }
        Some(self.plot("decentring", title, sentence, chart))
    }

    fn plot(&self, kind: &str, title: String, sentence: String, chart: Chart) -> Plot {
        let name = format!("{kind}-{}", file_name(&self.name));
        Plot { name, group: Group::Cameras, small: false, title, sentence, svg: chart.finish() }
    }
}
