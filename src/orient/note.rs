//! Notes of an orientation, as data: assumptions, and items that could not be determined, with the reason.

use serde::{Deserialize, Serialize};

use super::absolute::DatumSource;
use super::block::{OrientationBlock, principal_distance_px};
use super::tied;
use crate::adjust::wrong_control;
use crate::adjustment::{ImplausibleCamera, MirroredControl, OneStation, UndecidedAxes, UnitRatio};
use crate::initial::Degeneracy;
use crate::project::{DatumKind, Project, Role};

/// Where a principal distance that was missing comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DistanceSource {
    /// Photos of known points.
    KnownPoints,
    /// A usual value, refined by the network as far as it determines it.
    Assumed,
}

/// Where the coordinate system comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SystemSource {
    /// Points with given coordinates.
    KnownPoints,
    /// Photos with given orientation.
    GivenPhotos,
    /// Axes laid into the object.
    Own,
}

/// Where the scale comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ScaleSource {
    /// Points or photos with given coordinates, or distances.
    Given,
    /// Nothing gives a scale: the object's rms extent was made 1.
    Arbitrary,
}

/// Why a photo could not be oriented.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "why", rename_all = "snake_case")]
pub enum PhotoReason {
    /// No point was measured in it.
    NoPoints,
    /// Too few of its points are known or seen in oriented photos.
    TooFewPoints {
        /// How many are.
        determined: usize,
        /// How many it takes.
        needed: usize,
    },
    /// Its points do not fit together: wrong identities, or a wrong camera.
    Disagrees {
        /// Points that were tried.
        determined: usize,
    },
    /// It belongs to a group of photos that shares too little with the others.
    OtherGroup {
        /// The group's number, from 2; the oriented photos are the first.
        group: usize,
    },
}

/// Why a point has no coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "why", rename_all = "snake_case")]
pub enum PointReason {
    /// It was not measured.
    NotMeasured,
    /// It was measured in one photo only.
    SeenOnce {
        /// The photo.
        photo: String,
    },
    /// It was measured in fewer than two oriented photos.
    TooFewOrientedPhotos {
        /// How many there are.
        photos: usize,
    },
    /// Its rays are nearly parallel.
    NearParallel {
        /// Largest angle between two of them, radians.
        angle: f64,
    },
    /// It would lie behind a camera.
    BehindCamera {
        /// The photo.
        photo: String,
    },
    /// Its rays do not meet: wrong identities.
    RaysDisagree,
    /// It is a control or check point without coordinates.
    CoordinatesMissing,
    /// As many of its rays meet in one place as in another: one name for two targets, and it is unknown which is meant.
    Undecided {
        /// Photos whose rays meet in the one place.
        first: Vec<String>,
        /// Photos whose rays meet in the other.
        second: Vec<String>,
    },
}

/// A note on an orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "note", rename_all = "snake_case")]
pub enum Note {
    /// A principal distance was missing and has been found or assumed.
    PrincipalDistance {
        /// The camera.
        camera: String,
        /// The value, in the camera's units.
        value: f64,
        /// Where it comes from.
        source: DistanceSource,
    },
    /// The network determines a camera's principal distance badly.
    PrincipalDistanceWeak {
        /// The camera.
        camera: String,
        /// The value, in the camera's units.
        value: f64,
        /// Its standard error; null if the network does not determine it.
        sigma: Option<f64>,
    },
    /// A principal distance is far from the one that was given.
    PrincipalDistanceChanged {
        /// The camera.
        camera: String,
        /// The value, in the camera's units.
        value: f64,
        /// The one given.
        given: f64,
    },
    /// The photos fall into groups that share too little to be joined; the first, the largest, is oriented.
    Groups {
        /// The photos of each group.
        groups: Vec<Vec<String>>,
    },
    /// Two orientations of a photo fit its known points alike.
    PhotoAmbiguous {
        /// The photo.
        photo: String,
        /// Projection centre of the one not taken.
        position: [f64; 3],
        /// Omega, phi, kappa of the one not taken, radians.
        rotation: [f64; 3],
        /// Root mean square residual of the one taken and the other, pixels.
        rms_px: [f64; 2],
    },
    /// The system of the result.
    System {
        /// Where it comes from.
        source: SystemSource,
        /// Where its scale comes from.
        scale: ScaleSource,
    },
    /// A photo stays without orientation.
    PhotoNotOriented {
        /// The photo.
        photo: String,
        /// Why.
        #[serde(flatten)]
        reason: PhotoReason,
    },
    /// A point stays without coordinates.
    PointNotDetermined {
        /// The point.
        point: String,
        /// Why.
        #[serde(flatten)]
        reason: PointReason,
    },
    /// A measurement does not agree with the others: a wrong identity, most often.
    MeasurementDisagrees {
        /// The photo.
        photo: String,
        /// The point.
        point: String,
        /// Its distance from where the point should be, pixels; null behind the camera.
        distance_px: Option<f64>,
    },
    /// A control point's given coordinates are not where the photos see it, oriented by the other control points.
    ControlMisfit {
        /// The point.
        point: String,
        /// Given minus seen, in the project's unit.
        difference: [f64; 3],
        /// Size of the difference in its standard errors, those of both.
        sigma_ratio: f64,
    },
    /// Two control points whose given coordinates fit when they are exchanged.
    ExchangedPoints {
        /// The points.
        points: [String; 2],
    },
    /// Points nearer to each other than their standard errors can separate: one target under two names, most often.
    DoublePoints {
        /// The pairs.
        pairs: Vec<(String, String)>,
    },
    /// Given coordinates are a mirror image of what the photos show.
    MirroredControl(MirroredControl),
    /// Given points lie in a plane, and nothing shows whether their axes are mirrored.
    UndecidedAxes(UndecidedAxes),
    /// Something seems to be given in another unit than the rest.
    UnitRatio(UnitRatio),
    /// Photos were taken from one place.
    OneStation(OneStation),
    /// A given camera is implausible and is not used as given.
    ImplausibleCamera(ImplausibleCamera),
    /// Nothing gives a scale.
    NoScale,
}

impl Note {
    /// Whether it means that a given value contradicts the photos, like [`Advice::contradicts`](crate::adjustment::Advice::contradicts).
    pub fn contradicts(&self) -> bool {
        match self {
            Self::ControlMisfit { .. }
            | Self::ExchangedPoints { .. }
            | Self::MirroredControl(_)
            | Self::UndecidedAxes(_)
            | Self::UnitRatio(_)
            | Self::ImplausibleCamera(_) => true,
            Self::OneStation(station) => station.all,
            _ => false,
        }
    }
}

pub(super) fn of_frame(block: &OrientationBlock, frame: Option<DatumSource>, scaled: bool) -> Vec<Note> {
    let source = match frame {
        None => return Vec::new(),
        Some(_) if block.oriented() == 0 => return Vec::new(),
        Some(DatumSource::Known) => SystemSource::KnownPoints,
        Some(DatumSource::GivenPhotos) => SystemSource::GivenPhotos,
        Some(DatumSource::Own) => SystemSource::Own,
    };
    vec![Note::System { source, scale: if scaled { ScaleSource::Given } else { ScaleSource::Arbitrary } }]
}

/// Relative standard error beyond which a principal distance is called badly determined, and change of a given one
/// that is worth a note.
const WEAK: f64 = 0.025;
const CHANGED: f64 = 0.08;

pub(super) fn of_cameras(
    project: &Project,
    block: &OrientationBlock,
    sources: &[Option<DistanceSource>],
    sigmas_px: &[Option<f64>],
) -> Vec<Note> {
    let mut notes = Vec::new();
    for (k, (camera, found)) in project.cameras.iter().zip(&block.cameras).enumerate() {
        let units = camera.residual_pitch()[0];
        let Some(px) = principal_distance_px(found) else { continue };
        let (id, value) = (camera.id.clone(), px * units);
        if let Some(source) = sources[k] {
            notes.push(Note::PrincipalDistance { camera: id.clone(), value, source });
        }
        if let Some(given) = block.given_px[k].filter(|given| (px / given - 1.0).abs() > CHANGED) {
            notes.push(Note::PrincipalDistanceChanged { camera: id.clone(), value, given: given * units });
        }
        let weak = sigmas_px[k].filter(|sigma| block.oriented() > 0 && *sigma > WEAK * px);
        if let Some(sigma) = weak {
            let sigma = Some(sigma * units).filter(|s| s.is_finite());
            notes.push(Note::PrincipalDistanceWeak { camera: id, value, sigma });
        }
    }
    notes
}

/// Photos of the models that could not be joined, each in the largest model that holds it.
pub(super) fn group_of(block: &OrientationBlock, apart: &[OrientationBlock], photo: usize) -> Option<usize> {
    let outside = block.photos[photo].pose.is_none();
    apart.iter().position(|model| outside && model.photos[photo].pose.is_some()).map(|k| k + 2)
}

pub(super) fn of_groups(project: &Project, block: &OrientationBlock, apart: &[OrientationBlock]) -> Vec<Note> {
    let id = |k: usize| project.photos[k].id.clone();
    let all = 0..block.photos.len();
    let main: Vec<String> = all.clone().filter(|&k| block.photos[k].pose.is_some()).map(id).collect();
    let others = (0..apart.len())
        .map(|n| all.clone().filter(|&k| group_of(block, apart, k) == Some(n + 2)).map(id).collect::<Vec<_>>());
    let groups: Vec<Vec<String>> = std::iter::once(main).chain(others).filter(|g| !g.is_empty()).collect();
    if groups.len() > 1 { vec![Note::Groups { groups }] } else { Vec::new() }
}

pub(super) fn of_photos(project: &Project, block: &OrientationBlock, apart: &[OrientationBlock]) -> Vec<Note> {
    let missing = project.photos.iter().enumerate().filter(|(k, p)| p.enabled && block.photos[*k].pose.is_none());
    missing
        .map(|(k, photo)| {
            let determined = block.determined(k).0.len();
            let reason = if block.photos[k].observations.is_empty() {
                PhotoReason::NoPoints
            } else if let Some(group) = group_of(block, apart, k) {
                PhotoReason::OtherGroup { group }
            } else if determined < super::growth::FEWEST {
                PhotoReason::TooFewPoints { determined, needed: super::growth::FEWEST }
            } else {
                PhotoReason::Disagrees { determined }
            };
            Note::PhotoNotOriented { photo: photo.id.clone(), reason }
        })
        .collect()
}

pub(super) fn of_points(project: &Project, block: &OrientationBlock) -> Vec<Note> {
    let photo_of = |observation: usize| project.photos[block.observations[observation].photo].id.clone();
    let mut notes = Vec::new();
    for (k, point) in project.points.iter().enumerate() {
        let block_point = &block.points[k];
        let reason = if point.role != Role::Tie {
            if point.xyz.is_some() {
                continue;
            }
            PointReason::CoordinatesMissing
        } else if block_point.xyz.is_some() || point.xyz.is_some() {
            continue;
        } else {
            let oriented: Vec<usize> = block_point
                .observations
                .iter()
                .copied()
                .filter(|&s| block.photos[block.observations[s].photo].pose.is_some())
                .collect();
            let sides = tied::sides(block, k);
            match (block_point.observations.len(), oriented.len()) {
                (0, _) => PointReason::NotMeasured,
                (1, _) => PointReason::SeenOnce { photo: photo_of(block_point.observations[0]) },
                (_, photos @ (0 | 1)) => PointReason::TooFewOrientedPhotos { photos },
                _ if sides.is_some() => {
                    let named = |side: Vec<usize>| -> Vec<String> { side.into_iter().map(photo_of).collect() };
                    let [first, second] = sides.unwrap_or_default().map(named);
                    PointReason::Undecided { first, second }
                }
                _ => match block.intersection(k) {
                    Err(Degeneracy::NearParallel { angle }) => PointReason::NearParallel { angle },
                    Err(Degeneracy::BehindCamera { ray }) => {
                        let which = block.rays(k).0;
                        PointReason::BehindCamera { photo: photo_of(*which.get(ray).unwrap_or(&oriented[0])) }
                    }
                    _ => PointReason::RaysDisagree,
                },
            }
        };
        notes.push(Note::PointNotDetermined { point: point.id.clone(), reason });
    }
    notes
}

pub(super) fn of_observations(project: &Project, block: &OrientationBlock) -> Vec<Note> {
    let standing_out = (0..block.observations.len()).filter(|&s| block.is_wrong(s));
    standing_out
        .filter_map(|s| {
            let distance_px = block.misfit_px(s)?;
            let observation = &block.observations[s];
            Some(Note::MeasurementDisagrees {
                photo: project.photos[observation.photo].id.clone(),
                point: project.points[observation.point].id.clone(),
                distance_px: distance_px.is_finite().then_some(distance_px),
            })
        })
        .collect()
}

/// Control points that are not where the photos see them. The project is the oriented one.
pub(super) fn of_control(oriented: &Project, frame: Option<DatumSource>) -> Vec<Note> {
    let controlled = oriented.datum.kind == DatumKind::Control || frame == Some(DatumSource::Known);
    if !controlled {
        return Vec::new();
    }
    let (exchanged, wrong) = wrong_control(oriented);
    let exchanged = exchanged.into_iter().map(|points| Note::ExchangedPoints { points });
    let wrong = wrong.into_iter();
    let wrong = wrong.map(|(point, difference, sigma_ratio)| Note::ControlMisfit { point, difference, sigma_ratio });
    exchanged.chain(wrong).collect()
}
