//! Questions about the input: results of [`crate::plausibility`] and of an orientation from the photos alone.

use super::block::{OrientationBlock, principal_distance_px};
use super::note::Note;
use super::{Attempt, fine_px, give_principal_distances};
use crate::adjustment::ImplausibleCamera;
use crate::initial::Pose;
use crate::initial::robust::quantile;
use crate::plausibility::axes::{self, Handedness, PointPair, Question};
use crate::plausibility::framing::{self, Framing};
use crate::plausibility::units;
use crate::project::{Datum, Interior, Parameter, Project, Role};

/// Minimum number of given points that reveal a mirror image: three always lie in a plane.
const FEWEST: usize = 4;
/// Photos that are examined for another size; more that do not fit have another reason.
const MOST: usize = 8;
/// Share of a photo's measurements that may disagree before it is examined.
const DISAGREEING: f64 = 0.4;

/// Whether given coordinates or orientations hold photos that show no depth by themselves.
pub(super) fn is_known(block: &OrientationBlock) -> bool {
    block.points.iter().filter(|m| m.known.is_some() && !m.observations.is_empty()).count() >= 3
        || block.photos.iter().any(|block_photo| block_photo.given)
}

/// Lengths in another unit: of what is given, with the oriented document's coordinates.
pub(super) fn units(given: &Project, oriented: &Project) -> Vec<Note> {
    let mut found = units::of_lengths(oriented);
    for (before, after) in given.cameras.iter().zip(&oriented.cameras) {
        if let (Interior::Brown { c: Some(given), .. }, Some(_)) = (before.interior, before.pixel_pitch) {
            let c = after.interior.get(Parameter::C);
            found.extend(c.and_then(|found| units::of_camera(&before.id, given, found)));
        }
    }
    found.into_iter().map(Note::UnitRatio).collect()
}

/// Whether the axes of given coordinates are mirrored.
///
/// Where the oriented network, which took them for right, agrees with them and not with their mirror image, and the measurements of all of
/// them agree with it, nothing is asked; where they lie in a plane its form is the photos' own. Else the photos are oriented once more
/// without anything given in the object's system.
pub(super) fn axes(project: &Project, block: &OrientationBlock) -> Option<Note> {
    let measured = project.points.iter().zip(&block.points);
    let given = measured.filter(|(p, m)| p.role != Role::Tie && p.xyz.is_some() && m.observations.len() >= 2).count();
    let own = pairs(project, block);
    let question = match axes::handedness(&own) {
        Handedness::AsGiven if !is_contradicted(project, block) => None,
        Handedness::Both { .. } => axes::question(&own, &poses(block)),
        _ if given >= FEWEST => {
            let bare = without_given(project);
            let mut start = OrientationBlock::new(&bare);
            let sources = give_principal_distances(&mut start);
            let block = Attempt::new(&bare, &start, &start.adjustable, &sources, true).block;
            axes::question(&pairs(project, &block), &poses(&block))
        }
        _ => None,
    };
    question.map(|question| match question {
        Question::Mirrored(mirrored) => Note::MirroredControl(mirrored),
        Question::Undecided(undecided) => Note::UndecidedAxes(undecided),
    })
}

/// Whether the network fits far worse than the measurements are, or a given point is where fewer than half of its measurements are. Mirrored
/// coordinates bend the whole network, or hold it in the mirror image with some measurements set aside.
fn is_contradicted(project: &Project, block: &OrientationBlock) -> bool {
    if block.noise_px.is_some_and(|noise| noise > fine_px(project)) {
        return true;
    }
    project.points.iter().zip(&block.points).filter(|(p, _)| p.role != Role::Tie && p.xyz.is_some()).any(
        |(_, block_point)| {
            let agreeing = block_point
                .observations
                .iter()
                .filter(|&&s| block.observations[s].taken && block.misfit_px(s).is_some())
                .count();
            block_point.observations.len() >= 2 && 2 * agreeing < block_point.observations.len()
        },
    )
}

fn poses(block: &OrientationBlock) -> Vec<Pose> {
    block.photos.iter().filter_map(|block_photo| block_photo.pose).collect()
}

/// The project with tie points alone, in no system.
fn without_given(project: &Project) -> Project {
    let mut bare = Project { datum: Datum::default(), ..project.clone() };
    for point in &mut bare.points {
        (point.role, point.xyz, point.sigma) = (Role::Tie, None, None);
    }
    for photo in &mut bare.photos {
        (photo.position, photo.rotation, photo.sigma_position) = (None, None, None);
    }
    bare
}

/// Points and observed projection centres with given coordinates, where their rays meet and where their photos stand.
fn pairs(project: &Project, block: &OrientationBlock) -> Vec<PointPair> {
    let noise = block.noise_px.unwrap_or(1.0);
    let rms = |sigma: Option<[Option<f64>; 3]>| {
        sigma.map_or(0.0, |s| (s.iter().flatten().map(|s| s * s).sum::<f64>() / 3.0).sqrt())
    };
    let mut pairs = Vec::new();
    for (k, point) in project.points.iter().enumerate().filter(|(_, p)| p.role != Role::Tie) {
        let (Some(given), Ok((found, _))) = (point.xyz, block.intersection(k)) else { continue };
        // The photos' own uncertainty is about as much as that of the rays.
        let free_sigma = 2.0 * noise * found.cofactors.diagonal().max().max(0.0).sqrt();
        pairs.push(PointPair { free: found.point, given: given.into(), free_sigma, given_sigma: rms(point.sigma) });
    }
    for (photo, block_photo) in project.photos.iter().zip(&block.photos).filter(|(_, block_photo)| !block_photo.given) {
        let observed = photo.sigma_position.filter(|sigma| sigma.iter().all(Option::is_some));
        if let (Some(pose), Some(given), Some(_)) = (block_photo.pose, photo.position, observed) {
            let points = block_photo.observations.iter().filter_map(|&s| block.points[block.observations[s].point].xyz);
            let depths: Vec<f64> = points.map(|p| (p - pose.centre).norm()).collect();
            let px = principal_distance_px(&block.cameras[block_photo.camera]).unwrap_or(1.0);
            let free_sigma = 2.0 * noise * quantile(&depths, 0.5) / px;
            pairs.push(PointPair {
                free: pose.centre,
                given: given.into(),
                free_sigma,
                given_sigma: rms(photo.sigma_position),
            });
        }
    }
    pairs
}

/// Photos that were resized, cropped or taken at another principal distance: their poses are taken back, since with the camera's lens they
/// are wrong, and so are points that would be left with one ray.
pub(super) fn misframed(project: &Project, block: &mut OrientationBlock) -> Vec<ImplausibleCamera> {
    let mut found: Vec<(usize, Framing)> = Vec::new();
    let mut looked = 0;
    for photo in 0..block.photos.len() {
        let block_photo = &block.photos[photo];
        if block_photo.given || looked == MOST {
            continue;
        }
        let observations: Vec<usize> =
            block_photo.observations.iter().copied().filter(|&s| is_determined_without(block, s)).collect();
        let agrees = |s: &usize| block.observations[*s].taken && block.misfit_px(*s).is_some();
        let agreeing = observations.iter().filter(|s| agrees(s)).count();
        if observations.is_empty() || agreeing as f64 > (1.0 - DISAGREEING) * observations.len() as f64 {
            continue;
        }
        looked += 1;
        let object = observations.iter().filter_map(|&s| block.points[block.observations[s].point].xyz).collect();
        let pixels = observations.iter().map(|&s| block.observations[s].pixel).collect();
        let camera = block.cameras[block_photo.camera].of_photo(&block_photo.as_photo());
        let limit_px = observations.iter().map(|&s| block.limit_px(s)).fold(1.0, f64::max);
        let seen = framing::PhotoPoints { object, pixels, camera: &camera, limit_px };
        found.extend(framing::misframed(&seen).map(|framing| (photo, framing)));
    }
    for (photo, _) in &found {
        block.photos[*photo].pose = None;
        for s in block.photos[*photo].observations.clone() {
            let point = block.observations[s].point;
            if block.rays(point).0.len() < 2 && !(block.anchored && block.points[point].known.is_some()) {
                block.points[point].xyz = None;
            }
        }
    }
    if !found.is_empty() {
        block.review();
    }
    let doubt = |(photo, framing): (usize, Framing)| {
        let camera = &project.cameras[block.photos[photo].camera];
        ImplausibleCamera::of_framing(camera, &project.photos[photo].id, framing)
    };
    found.into_iter().map(doubt).collect()
}

/// Whether other photos determine the point of a measurement, or it is given.
fn is_determined_without(block: &OrientationBlock, observation: usize) -> bool {
    let photo = block.observations[observation].photo;
    let block_point = &block.points[block.observations[observation].point];
    let known = block.anchored && block_point.known.is_some();
    let others = block_point.observations.iter().filter(|&&s| {
        block.observations[s].photo != photo && block.observations[s].taken && block.misfit_px(s).is_some()
    });
    block_point.xyz.is_some() && (known || others.count() >= 2)
}
