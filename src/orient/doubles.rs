//! Points that may be one, from what the orientation knows of them: their rays and the noise of these.

use nalgebra::Matrix3;

use super::block::Block;
use super::note::Note;
use crate::adjust::{Candidate, pairs_of_one};
use crate::initial::pose::image_jacobian;
use crate::project::Project;

/// What there is to say of them.
pub(super) fn notes(project: &Project, block: &Block) -> Option<Note> {
    let noise = block.noise_px?;
    let candidate = |point: usize| {
        let mark = &block.marks[point];
        let xyz = mark.xyz?;
        let (mut normal, mut places) = (Matrix3::zeros(), Vec::new());
        for &s in mark.sights.iter().filter(|&&s| block.sights[s].taken) {
            let sight = &block.sights[s];
            let Some(pose) = block.views[sight.photo].pose else { continue };
            let scale = block.pixels_per_unit(sight.photo) / noise.max(sight.sigma_px);
            let by_point = image_jacobian(&pose.to_camera(&xyz)) * pose.object_to_camera * scale;
            normal += by_point.transpose() * by_point;
            places.push((sight.photo, sight.pixel));
        }
        places.sort_unstable_by_key(|place| place.0);
        let held = block.anchored && mark.known.is_some();
        let covariance = if held { Matrix3::zeros() } else { normal.try_inverse().filter(|_| places.len() > 1)? };
        Some((point, Candidate { xyz, covariance, places }))
    };
    let (ids, candidates): (Vec<usize>, Vec<Candidate>) = (0..block.marks.len()).filter_map(candidate).unzip();
    let name = |k: usize| project.points[ids[k]].id.clone();
    let pairs: Vec<_> = pairs_of_one(&candidates).into_iter().map(|[a, b]| (name(a), name(b))).collect();
    (!pairs.is_empty()).then_some(Note::DoublePoints { pairs })
}
