//! Input errors that look like a rank defect: a standard error wrong by digits or a unit, whose weight dominates all others, and a
//! photo placed where it cannot see its measurements.

use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::error::{Error, Number, Place, Reason};
use crate::project::Project;

use super::structure::photo_id;

/// Standard errors further apart than this, as they act on the images, cannot be computed with: their squares differ by half of
/// all digits.
const APART: f64 = 1e4;
/// Tangent of the angle off the axis beyond which no lens that draws straight lines straight sees anything.
const SEEN: f64 = 2.0;

/// The slip that is behind a rank defect of the network at its initial values, if there is one.
pub fn slip(project: &Project, network: &Network, initial: &State) -> Option<Error> {
    standard_error(project, network, initial).or_else(|| astray(project, network, initial))
}

fn invalid(reason: Reason, at: Place) -> Error {
    Error::Invalid { reason, at }
}

/// A photo more than half of whose measured points lie behind it or far outside its picture.
fn astray(project: &Project, network: &Network, state: &State) -> Option<Error> {
    let mut unseen = vec![0; network.photos.len()];
    for (point, x) in network.points.iter().zip(&state.points) {
        for ray in &network.rays[point.rays.clone()] {
            let [x, y, z] = state.poses[ray.photo].camera_point(x);
            unseen[ray.photo] += usize::from(z >= 0.0 || x.hypot(y) > SEEN * -z);
        }
    }
    let photo = (0..unseen.len()).find(|k| 2 * unseen[*k] > network.photos[*k].rays)?;
    Some(invalid(Reason::PhotoAstray, Place::photo(photo_id(project, network, photo)).with_field("position")))
}

/// The standard error furthest from the usual one: those of lengths by what they are in the images, pixels.
fn standard_error(project: &Project, network: &Network, state: &State) -> Option<Error> {
    // In pixels, in the observation's own unit, where.
    let mut all: Vec<(f64, f64, Place)> = Vec::new();
    let mut scales = Vec::new();
    for (block, x) in network.points.iter().zip(&state.points) {
        for ray in &network.rays[block.rays.clone()] {
            let o = &project.observations[ray.row];
            let at = Place { photo: Some(o.photo.clone()), point: Some(o.point.clone()), ..Place::default() };
            all.extend(o.sigma.both().map(|sigma| (sigma, sigma, at.clone().with_field("sigma"))));
            let interior = network.photos[ray.photo].interior;
            let camera = &project.cameras[network.interiors[interior].camera];
            let model = state.interiors[interior].model();
            let distance = state.interiors[interior].get(model.distance).unwrap_or_default();
            let distance_px = distance / camera.residual_pitch()[0];
            let depth = -state.poses[ray.photo].camera_point(x)[2] * network.frame.scale;
            if depth > 0.0 {
                scales.push(distance_px / depth);
            }
        }
    }
    let px = median(scales)?;
    let mut length = |sigma: Option<f64>, at: Place| {
        all.extend(sigma.filter(|s| *s > 0.0).map(|sigma| (sigma * px, sigma, at)));
    };
    for block in &network.points {
        let point = &project.points[block.index];
        for a in (0..3).filter(|a| block.prior[*a].1 > 0.0) {
            length(point.sigma.and_then(|s| s[a]), Place::point(&point.id).with_field("sigma"));
        }
    }
    for block in &network.photos {
        let photo = &project.photos[block.index];
        for a in (0..3).filter(|a| block.prior[*a].1 > 0.0) {
            length(photo.sigma_position.and_then(|s| s[a]), Place::photo(&photo.id).with_field("sigma_position"));
        }
    }
    for bar in &network.bars {
        let distance = &project.distances[bar.index];
        let field = format!("distances[{}].sigma", bar.index);
        length(Some(distance.sigma), Place::point(&distance.from).with_field(field));
    }
    let usual = median(all.iter().map(|(in_px, ..)| *in_px).collect())?;
    let apart = |in_px: f64| (in_px / usual).ln().abs();
    let (in_px, value, at) = all.into_iter().max_by(|a, b| apart(a.0).total_cmp(&apart(b.0)))?;
    let usual = rounded(usual * value / in_px);
    // a camera that makes nothing of lengths, or any, is what has slipped then
    let told = apart(in_px) > APART.ln() && usual.is_finite();
    told.then(|| invalid(Reason::StandardErrorsApart { value: Number(value), usual: Number(usual) }, at))
}

/// To two digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

fn median(mut list: Vec<f64>) -> Option<f64> {
    let middle = list.len() / 2;
    (!list.is_empty()).then(|| *list.select_nth_unstable_by(middle, f64::total_cmp).1)
}
