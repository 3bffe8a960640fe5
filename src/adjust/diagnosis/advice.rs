//! Advice: weaknesses of a solved network.

use crate::adjust::problem::left_out::Key;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::adjustment::criteria::{HIGH_CORRELATION, LOW_REDUNDANCY, NARROW_INTERSECTION};
use crate::adjustment::{Adjustment, Advice};
use crate::project::{Parameter, Project};

use super::structure::{photo_id, point_id};

/// Principal distances whose standard errors are a larger share of them are reported.
const WEAK_DISTANCE: f64 = 0.05;

/// Principal distances that the geometry leaves nearly open: parallel photos, or a plane seen from one side.
fn weak_principal_distances(network: &Network, state: &State, adjustment: &Adjustment) -> Vec<Advice> {
    let mut advice = Vec::new();
    for (k, camera) in adjustment.cameras.iter().enumerate() {
        for parameter in [Parameter::C, Parameter::F, Parameter::Fx, Parameter::Fy] {
            let value = camera.camera.interior.get(parameter);
            let (Some(value), Some(&sigma)) = (value, camera.sigma.get(&parameter)) else { continue };
            if sigma <= WEAK_DISTANCE * value.abs() {
                continue;
            }
            let own = network.photos.iter().zip(&state.poses).filter(|(photo, _)| photo.interior == k);
            let axes: Vec<[f64; 3]> = own.map(|(_, pose)| pose.m[2]).collect();
            let pairs = axes.iter().enumerate().flat_map(|(n, a)| axes[..n].iter().map(move |b| cosine(a, b)));
            advice.push(Advice::WeakPrincipalDistance {
                camera: camera.camera.id.clone(),
                photo: camera.photo.clone(),
                parameter: parameter.name().to_owned(),
                value,
                sigma,
                convergence: pairs.fold(1.0, f64::min).clamp(-1.0, 1.0).acos(),
            });
            break;
        }
    }
    advice
}

/// Weaknesses of a solved network.
pub fn advice(project: &Project, network: &Network, state: &State, adjustment: &Adjustment) -> Vec<Advice> {
    let mut advice = weak_principal_distances(network, state, adjustment);
    for camera in &adjustment.cameras {
        let correlation = &camera.correlation;
        for (i, row) in correlation.matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate().take(i).filter(|(_, value)| value.abs() > HIGH_CORRELATION) {
                advice.push(Advice::HighCorrelation {
                    camera: camera.camera.id.clone(),
                    photo: camera.photo.clone(),
                    first: correlation.names[j].clone(),
                    second: correlation.names[i].clone(),
                    correlation: *value,
                });
            }
        }
    }
    for (block, photo) in network.photos.iter().zip(&adjustment.photos) {
        let Some(correlation) = &photo.correlation else { continue };
        for (i, row) in correlation.matrix.iter().enumerate() {
            // The interior orientation's own correlations are reported once, above.
            for (j, value) in row.iter().enumerate().take(i.min(6)).filter(|(_, v)| v.abs() > HIGH_CORRELATION) {
                advice.push(Advice::HighCorrelation {
                    camera: project.photos[block.index].camera.clone(),
                    photo: Some(photo.id.clone()),
                    first: correlation.names[j].clone(),
                    second: correlation.names[i].clone(),
                    correlation: *value,
                });
            }
        }
    }
    let weak = adjustment
        .observations
        .iter()
        .filter(|o| o.enabled && [o.rx, o.ry].into_iter().flatten().any(|r| r < LOW_REDUNDANCY));
    let weak: Vec<_> = weak.map(|o| (o.photo.clone(), o.point.clone())).collect();
    let given = adjustment.given.iter();
    let given = given.filter(|g| g.enabled && g.reliability.is_some_and(|r| r.redundancy < LOW_REDUNDANCY));
    let given: Vec<_> = given.map(|g| g.what.clone()).collect();
    if !(weak.is_empty() && given.is_empty()) {
        advice.push(Advice::LowRedundancy { observations: weak, given });
    }
    let (mut two, mut narrow, mut behind) = (Vec::new(), Vec::new(), Vec::new());
    for (k, block) in network.points.iter().enumerate() {
        let id = || point_id(project, network, k);
        let rays = &network.rays[block.rays.clone()];
        let given = (0..3).all(|a| block.fixed[a] || block.prior[a].1 > 0.0);
        if rays.len() == 2 && !given {
            two.push(id());
        }
        let x = &state.points[k];
        let directions: Vec<[f64; 3]> = rays.iter().map(|ray| direction(&state.poses[ray.photo].centre, x)).collect();
        // Rays from opposite sides meet as badly as parallel ones.
        let cosines =
            directions.iter().enumerate().flat_map(|(n, a)| directions[..n].iter().map(move |b| cosine(a, b).abs()));
        let angle = cosines.fold(1.0, f64::min).acos();
        if rays.len() >= 2 && !given && angle < NARROW_INTERSECTION {
            narrow.push((id(), angle));
        }
        let is_wide = |photo: usize| state.interiors[network.photos[photo].interior].model().is_wide;
        let lies_behind = |photo: usize| !is_wide(photo) && state.poses[photo].camera_point(x)[2] >= 0.0;
        for ray in rays.iter().filter(|ray| lies_behind(ray.photo)) {
            behind.push((photo_id(project, network, ray.photo), id()));
        }
    }
    if !two.is_empty() {
        advice.push(Advice::TwoRays { points: two });
    }
    if !narrow.is_empty() {
        advice.push(Advice::NarrowIntersection { points: narrow });
    }
    if !behind.is_empty() {
        advice.push(Advice::BehindCamera { observations: behind });
    }
    let used: Vec<usize> = network.bars.iter().map(|bar| bar.index).collect();
    let out = |k: &usize| network.left_out.contains(&Key::Distance(*k));
    let unused = project.distances.iter().enumerate().filter(|(k, d)| !d.check && !used.contains(k) && !out(k));
    let unused: Vec<_> = unused.map(|(_, d)| (d.from.clone(), d.to.clone())).collect();
    if !unused.is_empty() {
        advice.push(Advice::DistanceUnused { distances: unused });
    }
    advice
}

fn direction(from: &[f64; 3], to: &[f64; 3]) -> [f64; 3] {
    let d: [f64; 3] = std::array::from_fn(|a| to[a] - from[a]);
    let length = d[0].hypot(d[1]).hypot(d[2]).max(1e-300);
    d.map(|x| x / length)
}

fn cosine(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
