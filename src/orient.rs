//! Initial values for a whole project: principal distances, exterior orientations, object points.
//!
//! 1. Known points orient what they can: the principal distance where it is missing, then photo by photo by resection.
//! 2. Without them, a first pair is oriented from image points alone.
//! 3. Photo by photo the rest follows: intersect, resect, refine by a small bundle adjustment, leave out what disagrees.
//! 4. A model of its own is transformed into the system of the known points, or given a scale and a place.
//! 5. What was left out and misses by less than a wrong name would is adjusted with the rest once more; photos that may be in the
//!    second of two poses are oriented anew.
//!
//! What is given stays as it is: orientations and coordinates bit by bit, camera parameters unless the project leaves
//! them free without observing them. What cannot be found stays null, and a note says why. The same project gives the
//! same result, bit by bit.

mod absolute;
mod ambiguity;
mod ambiguous_orientation;
mod aside;
mod block;
mod bridge;
mod doubles;
mod evidence;
mod growth;
mod models;
mod neighbour;
mod note;
mod plane;
mod principal_distance;
mod questions;
mod readmission;
mod refine;
mod remaining;
mod seed;
mod tied;
mod ties;
mod trial;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

pub use note::{DistanceSource, Note, PhotoReason, PointReason, ScaleSource, SystemSource};

use absolute::DatumSource;
use aside::set_aside;
use block::{OrientationBlock, longer_side, principal_distance_px, set_principal_distance_px};
use growth::grow;
use models::Models;
use refine::{Freedom, distance_sigmas_px, refine};

use crate::error::{Error, Lack, Result};
use crate::initial::robust::quantile;
use crate::plausibility::{cameras, one_station};
use crate::project::{Parameter, Project, Role};
use crate::rotation;

/// A project with initial values, and notes about them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Oriented {
    /// The project, filled in as far as possible.
    pub project: Project,
    /// Assumptions, and items that could not be determined, with the reason.
    pub notes: Vec<Note>,
}

/// Share of the measurements that agree where given coordinates orient the photos rightly.
const MOSTLY: f64 = 0.7;
/// Maximum noise over the a priori sigma of an accepted network.
const FINE_SIGMAS: f64 = 3.0;

/// Fills in every initial value that can be found.
///
/// # Errors
/// [`Error::Empty`] without photos or measurements; [`Error::Unknown`], [`Error::Duplicate`], [`Error::Invalid`] where
/// the document is inconsistent. A project that cannot be oriented is not an error: the notes list what is missing.
pub fn orient(project: &Project) -> Result<Oriented> {
    project.validate()?;
    let doubts = cameras::implausible(project);
    let (given, believed) = (project, cameras::without(project, &doubts));
    let project = believed.as_ref().unwrap_or(project);
    let mut start = OrientationBlock::new(project);
    for (what, missing) in
        [(Lack::Photos, project.photos.is_empty()), (Lack::Observations, start.observations.is_empty())]
    {
        if missing {
            return Err(Error::Empty { what });
        }
    }
    let station = one_station::is_all(project);
    if let Some(station) = station.as_ref().filter(|_| !questions::is_known(&start)) {
        // No depth and no principal distance: whatever were adjusted here would be noise.
        let notes = doubts.into_iter().map(Note::ImplausibleCamera);
        let notes = std::iter::once(Note::OneStation(station.clone())).chain(notes).collect();
        return Ok(Oriented { project: project.clone(), notes });
    }
    let sources = give_principal_distances(&mut start);
    let mut attempt = Attempt::new(project, &start, &start.adjustable, &sources, true);
    if !attempt.settled && start.given_px.iter().any(Option::is_some) {
        // A given principal distance is information: a rough model of few photos may have changed it wrongly.
        let free: Vec<bool> = start.adjustable.iter().zip(&start.given_px).map(|(a, px)| *a && px.is_none()).collect();
        let again = Attempt::new(project, &start, &free, &sources, true);
        if again.settled && 2 * again.block.oriented() >= attempt.block.oriented() {
            attempt = again;
        }
    }
    if attempt.frame == Some(DatumSource::Known) && !attempt.agrees() {
        // Given coordinates that contradict each other orient photos in contradicting ways: the photos by themselves tell which fit.
        let again = Attempt::new(project, &start, &start.adjustable, &sources, false);
        if again.block.agreeing() > attempt.block.agreeing() {
            attempt = again;
        }
    }
    let Attempt { mut block, apart, frame, scaled, .. } = attempt;
    let misframed = questions::misframed(project, &mut block);
    let axes = questions::axes(project, &block);
    let sigmas = distance_sigmas_px(&block);
    let mut notes = note::of_frame(&block, frame, scaled);
    notes.extend(note::of_cameras(project, &block, &sources, &sigmas));
    notes.extend(note::of_groups(project, &block, &apart));
    notes.extend(note::of_photos(project, &block, &apart));
    notes.extend(ambiguity::notes(project, &block));
    notes.extend(note::of_points(project, &block));
    notes.extend(note::of_observations(project, &block));
    let doubles = doubles::notes(project, &block);
    let mut project = filled(project, &block);
    let mut questions = questions::units(given, &project);
    questions.extend(axes);
    questions.extend(
        station
            .map_or_else(|| one_station::groups(&project), |station| vec![station])
            .into_iter()
            .map(Note::OneStation),
    );
    questions.extend(doubts.into_iter().chain(misframed).map(Note::ImplausibleCamera));
    questions.extend((frame.is_some() && !scaled && block.oriented() > 0).then_some(Note::NoScale));
    notes.splice(0..0, questions);
    set_aside(&mut project, &block);
    notes.extend(note::of_control(&project, frame));
    notes.extend(doubles);
    if frame == Some(DatumSource::Own) {
        aside::set_control_aside(&mut project);
        // Directions given in another system mean nothing in this one.
        project.points.iter_mut().for_each(|point| point.normal = None);
    }
    Ok(Oriented { project, notes })
}

/// Result of one method of orienting a project.
struct Attempt {
    block: OrientationBlock,
    apart: Vec<OrientationBlock>,
    frame: Option<DatumSource>,
    scaled: bool,
    /// Whether the project it makes can be adjusted.
    settled: bool,
}

impl Attempt {
    /// Whether most measurements agree.
    fn agrees(&self) -> bool {
        self.block.agreeing() as f64 >= MOSTLY * self.block.observations.len() as f64
    }

    /// Orients what can be oriented while only the principal distances of the cameras in `free` may change; in the end all may
    /// that may be changed at all. Begins with photos of known points, if `by_known`, or else with the photos by themselves.
    fn new(
        project: &Project,
        start: &OrientationBlock,
        free: &[bool],
        sources: &[Option<DistanceSource>],
        by_known: bool,
    ) -> Self {
        let mut holding = start.clone();
        holding.adjustable = free.to_vec();
        let mut models = Models::new(if by_known { from_known(&holding) } else { holding });
        models.build(sources, fine_px(project));
        let Models { mut block, frame, mut apart } = models;
        let mut frame = frame;
        let mut scaled = true;
        if frame == Some(DatumSource::Own) {
            (frame, scaled) = absolute::to_own(&mut block, project, start);
        } else if frame == Some(DatumSource::GivenPhotos) {
            let larger = (0..apart.len()).find(|&k| apart[k].oriented() > block.oriented());
            if let Some(k) = larger {
                let mut model = apart.remove(k);
                (frame, scaled) = absolute::to_own(&mut model, project, &block);
                block = model;
            }
        }
        if frame == Some(DatumSource::Known) {
            block.anchor();
        }
        if frame != Some(DatumSource::Own) {
            grow(&mut block);
        }
        block.adjustable.clone_from(&start.adjustable);
        refine(&mut block, Freedom::Everything);
        block.intersect_new(0.0);
        block.review();
        verify(&mut block);
        let as_project = |block: &OrientationBlock| {
            let mut trial = filled(project, block);
            set_aside(&mut trial, block);
            trial
        };
        let mut accepted = vec![false; block.photos.len()];
        let mut looked = accepted.clone();
        let mut settled;
        loop {
            tied::release(&mut block);
            readmission::readmit(&mut block);
            settled = trial::settle(&mut block, as_project);
            let trial = as_project(&block);
            if evidence::withdraw(&mut block, &trial, &accepted) {
                block.review();
                continue;
            }
            let split = ties::split(&mut block, &trial);
            if !split.is_empty() {
                apart.extend(split);
            } else if !remaining::orient(&mut block, &mut accepted)
                && !ambiguous_orientation::orient_again(&mut block, &mut accepted, &mut looked)
            {
                break;
            }
        }
        apart.sort_by_key(|model| std::cmp::Reverse(model.oriented()));
        Self { block, apart, frame, scaled, settled }
    }
}

/// Takes back poses that too few of their photo's measurements agree with after all, and tries those photos once more.
fn verify(block: &mut OrientationBlock) {
    let doubtful: Vec<usize> = (0..block.photos.len()).filter(|&k| !growth::holds(block, k)).collect();
    if doubtful.is_empty() {
        return;
    }
    doubtful.iter().for_each(|&k| block.photos[k].pose = None);
    refine(block, Freedom::Everything);
    grow(block);
    refine(block, Freedom::Everything);
    block.intersect_new(0.0);
    block.review();
    for k in 0..block.photos.len() {
        if !growth::holds(block, k) {
            block.photos[k].pose = None;
        }
    }
    block.review();
}

fn fine_px(project: &Project) -> f64 {
    let sigmas: Vec<f64> = project.observations.iter().map(|o| o.sigma.both()[0]).collect();
    FINE_SIGMAS * quantile(&sigmas, 0.5)
}

/// Gives every camera a principal distance to work with, and notes where it comes from; `None` if it was given.
fn give_principal_distances(block: &mut OrientationBlock) -> Vec<Option<DistanceSource>> {
    let mut sources = vec![None; block.cameras.len()];
    for camera in 0..block.cameras.len() {
        if principal_distance_px(&block.cameras[camera]).is_some() {
            continue;
        }
        let known = principal_distance::from_known(block, camera);
        let px = known.unwrap_or_else(|| principal_distance::ASSUMED * longer_side(&block.cameras[camera]));
        sources[camera] = Some(if known.is_some() { DistanceSource::KnownPoints } else { DistanceSource::Assumed });
        set_principal_distance_px(&mut block.cameras[camera], px);
    }
    block.refresh_rays();
    sources
}

/// Orients what is possible from given coordinates and given orientations.
fn from_known(start: &OrientationBlock) -> OrientationBlock {
    let mut block = start.clone();
    if start.points.iter().filter(|m| m.known.is_some() && !m.observations.is_empty()).count() >= 3 {
        block.anchor();
        for photo in 0..block.photos.len() {
            if block.photos[photo].pose.is_none() {
                growth::resect(&mut block, photo);
            }
        }
        if block.oriented() == 0 {
            return start.clone();
        }
    }
    if block.oriented() > 0 {
        grow(&mut block);
    }
    block
}

/// The project with what the block found in the places that were empty.
fn filled(project: &Project, block: &OrientationBlock) -> Project {
    let mut project = project.clone();
    let object = |xyz: Vector3<f64>| -> Option<[f64; 3]> {
        let xyz = xyz + block.origin;
        xyz.iter().all(|x| x.is_finite()).then(|| xyz.into())
    };
    for (camera, found) in project.cameras.iter_mut().zip(&block.cameras) {
        for &parameter in camera.interior.parameters() {
            let free = camera.free.contains(&parameter)
                || matches!(parameter, Parameter::Fx | Parameter::Fy) && camera.free.contains(&Parameter::F);
            let empty = camera.interior.get(parameter).is_none();
            if parameter == Parameter::F || !(empty || free && !camera.sigma.contains_key(&parameter)) {
                continue;
            }
            if let Some(value) = found.interior.get(parameter).filter(|value| value.is_finite()) {
                camera.interior.set(parameter, value);
            }
        }
    }
    for (photo, block_photo) in project.photos.iter_mut().zip(&block.photos) {
        if let (Some(pose), false) = (block_photo.pose, block_photo.given) {
            photo.position = photo.position.or_else(|| object(pose.centre));
            photo.rotation = photo.rotation.or(Some(rotation::angles(&pose.object_to_camera)));
        }
    }
    for (point, block_point) in project.points.iter_mut().zip(&block.points) {
        if point.role == Role::Tie && point.xyz.is_none() {
            point.xyz = block_point.xyz.and_then(object);
        }
    }
    project
}
