//! From rays to what is predicted: which points and photos take part, their network's cofactors, and what is wanted of them.

use nalgebra::{Matrix3, Vector3};

use sightline::adjust;
use sightline::adjustment::{Adjustment, Advice};
use sightline::error::{Defect, Error};
use sightline::project::Parameter;
use sightline::statistics::distribution::normal_quantile;

use super::setup::{Setup, Shot};
use super::{Criterion, Lacking, PredictedPoint, Prediction, StationSight};

/// Rays that meet under less than this, radians, leave a point undetermined.
const LEAST_ANGLE: f64 = 2e-3;
/// Times that points are left out which the network turns out not to determine.
const ROUNDS: usize = 4;

/// Predicted adjustment of a set of planned photos.
pub struct JudgedNetwork {
    /// Per point of the plan: whether it takes part.
    pub takes_part: Vec<bool>,
    /// Or why there is none.
    pub adjustment: Result<Box<Adjustment>, Vec<Defect>>,
    /// Places of the photos that take part, in the list given.
    pub used: Vec<usize>,
    /// Groups of photos that are not tied to each other; the network is that of the largest.
    pub untied: Option<Defect>,
}

/// Rays of every point: unit directions.
fn rays(setup: &Setup<'_>, shots: &[&Shot]) -> Vec<Vec<Vector3<f64>>> {
    let mut rays = vec![Vec::new(); setup.places.len()];
    for shot in shots {
        for (k, _) in &shot.seen {
            rays[*k].push((setup.places[*k] - shot.pose.centre).normalize());
        }
    }
    rays
}

/// Largest acute angle between two rays.
fn angle(rays: &[Vector3<f64>]) -> f64 {
    let mut least = 1.0_f64;
    for (n, a) in rays.iter().enumerate() {
        for b in &rays[..n] {
            least = least.min(a.dot(b).abs());
        }
    }
    least.min(1.0).acos()
}

/// Points and photos that a network can be made of, and its cofactors.
pub fn network(setup: &Setup<'_>, shots: &[&Shot]) -> JudgedNetwork {
    let mut used: Vec<usize> = (0..shots.len()).collect();
    let mut out = vec![false; setup.places.len()];
    let mut untied = None;
    for round in 0..=ROUNDS {
        let takes_part = loop {
            let now: Vec<&Shot> = used.iter().map(|k| shots[*k]).collect();
            let rays = rays(setup, &now);
            let part: Vec<bool> = (0..rays.len())
                .map(|k| !out[k] && ((setup.given[k] && !rays[k].is_empty()) || angle(&rays[k]) > LEAST_ANGLE))
                .collect();
            let enough = |k: &usize| shots[*k].seen.iter().filter(|(p, _)| part[*p]).count() >= 3;
            let left: Vec<usize> = used.iter().copied().filter(enough).collect();
            if left.len() == used.len() {
                break part;
            }
            used = left;
        };
        if used.len() < 2 && !takes_part.contains(&true) {
            return JudgedNetwork { takes_part, adjustment: Err(Vec::new()), used, untied };
        }
        let now: Vec<&Shot> = used.iter().map(|k| shots[*k]).collect();
        let Some((project, numbering)) = setup.numbered(&now, &takes_part) else {
            return JudgedNetwork { takes_part, adjustment: Err(Vec::new()), used, untied };
        };
        match adjust::predict_numbered(&project, &numbering) {
            Ok(adjustment) => return JudgedNetwork { takes_part, adjustment: Ok(Box::new(adjustment)), used, untied },
            Err(Error::RankDefect { defects }) => {
                let mut named = false;
                for defect in &defects {
                    if let Defect::TooFewRays { points } = defect {
                        points.iter().filter_map(|id| setup.index.get(id.as_str())).for_each(|k| {
                            named |= !std::mem::replace(&mut out[*k], true);
                        });
                    }
                }
                let not_tied = defects.iter().find(|defect| matches!(defect, Defect::NotTied { .. }));
                let groups = not_tied.and_then(|defect| adjust::groups_of(defect, &project, &numbering));
                let largest = groups.and_then(|groups| groups.into_iter().max_by_key(Vec::len));
                if let (Some(largest), true) = (largest, untied.is_none()) {
                    // The other groups are not connected: notes on points refer to the largest group.
                    let kept = largest.into_iter().map(|k| used[k]).collect();
                    untied = not_tied.cloned();
                    used = kept;
                    continue;
                }
                if !named || round == ROUNDS {
                    return JudgedNetwork { takes_part, adjustment: Err(defects), used, untied };
                }
            }
            // Too few points for a datum, or none at all: nothing that a name could be given to.
            Err(_) => return JudgedNetwork { takes_part, adjustment: Err(Vec::new()), used, untied },
        }
    }
    JudgedNetwork { takes_part: vec![false; setup.places.len()], adjustment: Err(Vec::new()), used, untied }
}

/// Largest half axis of a covariance (xx, xy, xz, yy, yz, zz).
pub fn largest_axis([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> f64 {
    let values = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).symmetric_eigenvalues();
    values.max().max(0.0).sqrt()
}

/// Largest half axis of every point of the plan; `None` if it is not determined.
fn axes(setup: &Setup<'_>, network: &JudgedNetwork) -> Vec<Option<f64>> {
    let mut axes = vec![None; setup.places.len()];
    if let Ok(adjustment) = &network.adjustment {
        for point in &adjustment.points {
            if let Some(k) = setup.index.get(point.id.as_str()) {
                axes[*k] = point.covariance.map(largest_axis);
            }
        }
    }
    axes
}

/// Values that stand for an undetermined point and for an undetermined network.
const UNDETERMINED: f64 = 1e12;
/// A point with one ray from a photo of the network lacks less than one that none sees: without that, nothing leads a search around the
/// corner of a box, where the first photo that sees another face determines none of its points.
const HALF_SEEN: f64 = 0.6;

/// The value of a criterion, the smaller the better. What is not determined counts before everything else.
pub fn value(setup: &Setup<'_>, shots: &[&Shot], criterion: &Criterion) -> f64 {
    let network = network(setup, shots);
    let axes = axes(setup, &network);
    let judged = |k: &usize| !setup.given[*k];
    let mut seen = vec![false; axes.len()];
    network.used.iter().flat_map(|k| &shots[*k].seen).for_each(|(k, _)| seen[*k] = true);
    let lacks = |k: usize| if seen[k] { HALF_SEEN } else { 1.0 };
    let missing: f64 = (0..axes.len()).filter(judged).filter(|k| axes[*k].is_none()).map(lacks).sum();
    let Ok(adjustment) = &network.adjustment else {
        let loose = network.takes_part.iter().filter(|part| !**part).count();
        return UNDETERMINED * (1.0 + (axes.len() + loose) as f64);
    };
    let all = || (0..axes.len()).filter(judged).filter_map(|k| axes[k]);
    let own = match criterion {
        Criterion::Worst => all().fold(0.0, f64::max),
        Criterion::Mean => (all().map(|a| a * a).sum::<f64>() / all().count().max(1) as f64).sqrt(),
        Criterion::Points { points } => {
            let chosen = points.iter().filter_map(|id| setup.index.get(id.as_str()));
            chosen.map(|k| axes[*k].unwrap_or(UNDETERMINED)).fold(0.0, f64::max)
        }
        Criterion::Parameter { parameter } => parameter_sigma(adjustment, *parameter).unwrap_or(UNDETERMINED),
    };
    own + UNDETERMINED * missing
}

fn parameter_sigma(adjustment: &Adjustment, parameter: Parameter) -> Option<f64> {
    adjustment.cameras.first()?.sigma.get(&parameter).copied()
}

/// Whether a value means that something is not determined.
pub fn is_determined(value: f64) -> bool {
    value < HALF_SEEN * UNDETERMINED
}

/// From standard errors to a probability along one axis.
pub fn factor(probability: f64) -> f64 {
    normal_quantile((1.0 + probability) / 2.0)
}

/// All information on a set of photos.
pub fn judged(setup: &Setup<'_>, shots: &[Shot]) -> Prediction {
    let all: Vec<&Shot> = shots.iter().collect();
    let network = network(setup, &all);
    let axes = axes(setup, &network);
    let rays = rays(setup, &all);
    let plan = setup.plan;
    let mut points: Vec<PredictedPoint> = plan
        .points
        .iter()
        .zip(&rays)
        .map(|(point, rays)| PredictedPoint {
            id: point.id.clone(),
            rays: rays.len(),
            angle: angle(rays),
            sigma: None,
            covariance: None,
            axis: None,
            detectable: None,
        })
        .collect();
    let mut lacks = Vec::new();
    let (mut cameras, mut redundancy, mut advice, mut repeated) = (Vec::new(), None, Vec::new(), None);
    let determined = network.adjustment.is_ok();
    lacks.extend(network.untied.into_iter().map(|defect| Lacking::Defect { defect }));
    match network.adjustment {
        Ok(adjustment) => {
            for predicted in &adjustment.points {
                let Some(k) = setup.index.get(predicted.id.as_str()) else { continue };
                points[*k].sigma = predicted.sigma;
                points[*k].covariance = predicted.covariance;
                points[*k].axis = axes[*k];
            }
            redundancy = Some(adjustment.redundancy);
            repeated = super::repeated::repeated(setup, &all, (&network.takes_part, &adjustment), &mut points);
            cameras = adjustment.cameras;
            advice = adjustment.advice;
            advice.retain(concerns_plans);
        }
        Err(_) if plan.points.is_empty() => lacks.push(Lacking::NoPoints),
        Err(_) if shots.is_empty() => lacks.push(Lacking::NoPhotos),
        Err(defects) => lacks.extend(defects.into_iter().map(|defect| Lacking::Defect { defect })),
    }
    let judged = |k: &usize| !setup.given[*k];
    let ids = |places: Vec<usize>| places.into_iter().map(|k| plan.points[k].id.clone()).collect::<Vec<_>>();
    let loose: Vec<usize> = (0..axes.len())
        .filter(judged)
        .filter(|k| axes[*k].is_none() && (determined || !network.takes_part[*k]))
        .collect();
    if !loose.is_empty() && !shots.is_empty() {
        lacks.push(Lacking::Undetermined { points: ids(loose) });
    } else if lacks.is_empty() && !determined {
        lacks.push(Lacking::Defect {
            defect: Defect::Combination { points: Vec::new(), photos: Vec::new(), parameters: Vec::new() },
        });
    }
    let mut order: Vec<(usize, f64)> = (0..axes.len()).filter(judged).filter_map(|k| Some((k, axes[k]?))).collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let factor = factor(plan.wanted.probability);
    let beyond: Vec<usize> =
        order.iter().take_while(|(_, axis)| axis * factor > plan.wanted.precision).map(|(k, _)| *k).collect();
    if !beyond.is_empty() {
        lacks.push(Lacking::Beyond { points: ids(beyond) });
    }
    let forbidden: Vec<String> = shots.iter().filter(|s| s.forbidden).map(|s| s.station.id.clone()).collect();
    if !forbidden.is_empty() {
        lacks.push(Lacking::Forbidden { stations: forbidden });
    }
    let squares: f64 = order.iter().map(|(_, axis)| axis * axis).sum();
    Prediction {
        stations: shots.iter().map(|shot| sight(setup, shot)).collect(),
        points,
        cameras,
        worst: order.first().map(|(k, _)| plan.points[*k].id.clone()),
        largest: order.first().map(|(_, axis)| *axis),
        rms: (!order.is_empty()).then(|| (squares / order.len() as f64).sqrt()),
        factor,
        redundancy,
        reached: lacks.is_empty() && determined,
        lacks,
        advice,
        repeated,
    }
}

/// Whether advice applies to a plan. Advice that depends on residuals does not, and every photo's angles and centre are correlated where
/// the object is small: the camera's own parameters tell enough.
fn concerns_plans(advice: &Advice) -> bool {
    !matches!(advice, Advice::HighCorrelation { photo: Some(_), .. } | Advice::LowRedundancy { .. })
}

fn sight(setup: &Setup<'_>, shot: &Shot) -> StationSight {
    let camera = &setup.plan.cameras[shot.camera];
    let mut distances: Vec<f64> = shot.seen.iter().map(|(k, _)| (setup.places[*k] - shot.pose.centre).norm()).collect();
    distances.sort_by(f64::total_cmp);
    let c = super::setup::principal_distance_px(camera).unwrap_or(1.0);
    let half = [f64::from(camera.width) / 2.0 / c, f64::from(camera.height) / 2.0 / c];
    let ray = |x: f64, y: f64| -> [f64; 3] { shot.pose.ray([x * half[0], y * half[1]]).into() };
    StationSight {
        id: shot.station.id.clone(),
        points: shot.seen.iter().map(|(k, _)| setup.plan.points[*k].id.clone()).collect(),
        unseen: shot.unseen,
        distance: distances.get(distances.len() / 2).copied(),
        smallest_px: shot.smallest_px,
        direction: ray(0.0, 0.0),
        corners: [ray(-1.0, 1.0), ray(1.0, 1.0), ray(1.0, -1.0), ray(-1.0, -1.0)],
        forbidden: shot.forbidden,
    }
}
