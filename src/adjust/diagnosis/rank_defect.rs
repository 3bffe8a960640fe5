//! Why the numbers of a network leave it undetermined, in the network's own words, read from the null space of its normal
//! equations.

use std::collections::BTreeMap;

use crate::adjust::equations::context::{Context, Weighting};
use crate::adjust::equations::normal::ReducedNormalEquations;
use crate::adjustment::ResidualPlace;
use crate::error::{Defect, Error};
use crate::project::Project;

use super::null_space::null_space;
use super::structure::{groups, not_tied, photo_id, point_id};

/// Reads a rank defect from the null space of the normal equations, whatever the weights; overwrites `normal`.
pub fn rank_defect(
    project: &Project,
    context: Context<'_>,
    normal: &mut ReducedNormalEquations,
    pins: &[usize],
) -> Error {
    let Context { network, layout, .. } = context;
    let weighting = Weighting { place: ResidualPlace::Corrected, robust: &[], shift: &[] };
    let vectors = null_space(Context { weighting, ..context }, normal, pins).unwrap_or_default();
    let strength = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    let reduced = |from: usize, length: usize| {
        strength(&mut vectors.iter().flat_map(|v| v.reduced[from..from + length].iter().copied()))
    };
    let photos: Vec<f64> = layout.photo.iter().map(|&at| reduced(at, 6)).collect();
    let points: Vec<f64> = (0..network.points.len())
        .map(|p| strength(&mut vectors.iter().flat_map(|v| (0..3).map(move |a| v.at_point(layout, p, a)))))
        .collect();
    let interiors: Vec<Vec<f64>> = (network.interiors.iter().zip(&layout.interior))
        .map(|(block, &at)| (0..block.estimated.len()).map(|k| reduced(at + k, 1)).collect())
        .collect();
    let most = photos.iter().chain(&points).chain(interiors.iter().flatten()).fold(0.0_f64, |m, x| m.max(*x));
    let takes_part = |x: &f64| *x > 0.02 * most && *x > 0.0;
    let photos: Vec<String> = (photos.iter().enumerate().filter(|(_, x)| takes_part(x)))
        .map(|(k, _)| photo_id(project, network, k))
        .collect();
    let points: Vec<String> = (points.iter().enumerate().filter(|(_, x)| takes_part(x)))
        .map(|(k, _)| point_id(project, network, k))
        .collect();
    let mut parameters: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (block, strengths) in network.interiors.iter().zip(&interiors) {
        for (estimated, _) in block.estimated.iter().zip(strengths).filter(|(_, x)| takes_part(x)) {
            let list = parameters.entry(project.cameras[block.camera].id.clone()).or_default();
            if !list.iter().any(|name| name == estimated.parameter.name()) {
                list.push(estimated.parameter.name().to_owned());
            }
        }
    }
    let tied = groups(network, 3);
    let defects = if !parameters.is_empty() {
        undetermined_parameters(parameters, photos, points)
    } else if photos.is_empty() && !points.is_empty() {
        vec![Defect::TooFewRays { points }]
    } else if points.is_empty() && !photos.is_empty() {
        vec![Defect::PhotoUndetermined { photos }]
    } else if tied.len() > 1 {
        vec![not_tied(project, network, &tied)]
    } else {
        // Where no vector shows which, all photos are in it together.
        let nameless = points.is_empty() && photos.is_empty();
        let all = || (0..network.photos.len()).map(|k| photo_id(project, network, k)).collect();
        let photos = if nameless { all() } else { photos };
        vec![Defect::Combination { points, photos, parameters: Vec::new() }]
    };
    Error::RankDefect { defects }
}

/// Camera parameters that are undetermined, camera by camera; where they are not alone, what moves with them as well.
fn undetermined_parameters(
    parameters: BTreeMap<String, Vec<String>>,
    photos: Vec<String>,
    points: Vec<String>,
) -> Vec<Defect> {
    let names = |(camera, list): (&String, &Vec<String>)| {
        list.iter().map(|parameter| format!("{camera}.{parameter}")).collect::<Vec<_>>()
    };
    let together: Vec<String> = parameters.iter().flat_map(names).collect();
    let alone = photos.is_empty() && points.is_empty() && parameters.len() == 1;
    let each = parameters.into_iter().map(|(camera, parameters)| Defect::ParameterUndetermined { camera, parameters });
    each.chain((!alone).then_some(Defect::Combination { points, photos, parameters: together })).collect()
}
