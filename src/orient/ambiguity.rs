//! Photos that known points alone orient, where a second orientation fits as well.

use super::block::OrientationBlock;
use super::note::Note;
use crate::initial::resection::space_resection;
use crate::project::Project;
use crate::rotation;

/// Points beyond which a second minimum is far worse unless they lie in a plane, and the most that are examined.
const MOST_POINTS: usize = 60;
/// Difference of the sums of squares, over the variance, below which the better of two is chance: one in a thousand for
/// one degree of freedom.
const CHANCE: f64 = 10.83;

/// A note for every photo whose second-best orientation cannot be distinguished from the best. Only photos whose every agreeing
/// measurement is of a given point are asked: others are decided by the network.
pub(super) fn notes(project: &Project, block: &OrientationBlock) -> Vec<Note> {
    if !block.anchored {
        return Vec::new();
    }
    let mut notes = Vec::new();
    for (photo, block_photo) in block.photos.iter().enumerate() {
        let (Some(pose), false) = (block_photo.pose, block_photo.given) else { continue };
        let agreeing =
            block_photo.observations.iter().filter(|&&s| block.observations[s].taken && block.misfit_px(s).is_some());
        let points: Vec<_> = agreeing
            .filter_map(|&s| {
                let observation = &block.observations[s];
                Some((block.points[observation.point].known, observation.ray?, observation.sigma_px))
            })
            .collect();
        if points.len() > MOST_POINTS || points.iter().any(|(known, ..)| known.is_none()) {
            continue;
        }
        let (object, image): (Vec<_>, Vec<_>) = points.iter().filter_map(|(xyz, ray, _)| Some(((*xyz)?, *ray))).unzip();
        let Ok(found) = space_resection(&object, &image) else { continue };
        let units = block.pixels_per_unit(photo);
        let variance = points.iter().map(|(.., s)| s * s).sum::<f64>() / points.len().max(1) as f64 / (units * units);
        // What is left in the best one is noise, too, where it is more than stated.
        let own = found[0].sigma0.map_or(0.0, |s| s * s);
        let rms = |squares: f64| (squares / object.len() as f64).sqrt() * units;
        let same = |other: &crate::initial::Pose| {
            let distance = (pose.centre - object[0]).norm();
            (other.centre - pose.centre).norm() < 0.01 * distance
                && (other.object_to_camera - pose.object_to_camera).norm() < 0.01
        };
        let taken = pose.cost(&object, &image);
        let rival = found.iter().find(|other| !same(&other.pose));
        if let Some(rival) = rival.filter(|r| r.squares() - taken < CHANCE * variance.max(own)) {
            notes.push(Note::PhotoAmbiguous {
                photo: project.photos[photo].id.clone(),
                position: (rival.pose.centre + block.origin).into(),
                rotation: rotation::angles(&rival.pose.object_to_camera),
                rms_px: [rms(taken), rms(rival.squares())],
            });
        }
    }
    notes
}
