//! Possibly identical points, from their rays and the noise of these.

use nalgebra::Matrix3;

use super::block::OrientationBlock;
use super::note::Note;
use crate::adjust::{DoublePointCandidate, pairs_of_one};
use crate::initial::pose::image_jacobian;
use crate::project::Project;

/// Note on double points; `None` without any.
pub(super) fn notes(project: &Project, block: &OrientationBlock) -> Option<Note> {
    let noise = block.noise_px?;
    let candidate = |point: usize| {
        let block_point = &block.points[point];
        let xyz = block_point.xyz?;
        let (mut normal, mut places) = (Matrix3::zeros(), Vec::new());
        for &s in block_point.observations.iter().filter(|&&s| block.observations[s].taken) {
            let observation = &block.observations[s];
            let Some(pose) = block.photos[observation.photo].pose else { continue };
            let scale = block.pixels_per_unit(observation.photo) / noise.max(observation.sigma_px);
            let by_point = image_jacobian(&pose.to_camera(&xyz)) * pose.object_to_camera * scale;
            normal += by_point.transpose() * by_point;
            places.push((observation.photo, observation.pixel));
        }
        places.sort_unstable_by_key(|place| place.0);
        let held = block.anchored && block_point.known.is_some();
        let covariance = if held { Matrix3::zeros() } else { normal.try_inverse().filter(|_| places.len() > 1)? };
        Some((point, DoublePointCandidate { xyz, covariance, places }))
    };
    let (ids, candidates): (Vec<usize>, Vec<DoublePointCandidate>) =
        (0..block.points.len()).filter_map(candidate).unzip();
    let name = |k: usize| project.points[ids[k]].id.clone();
    let pairs: Vec<_> = pairs_of_one(&candidates).into_iter().map(|[a, b]| (name(a), name(b))).collect();
    (!pairs.is_empty()).then_some(Note::DoublePoints { pairs })
}
