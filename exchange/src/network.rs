//! Code shared by the readers and writers of networks of other programs.
//!
//! A reader fills a [`ForeignNetwork`]; its cameras become those of the document over the part of the picture that is measured. A writer gets an
//! [`OutgoingNetwork`]: numbered cameras, oriented photos and points with what sees them.

use std::collections::{BTreeMap, HashMap, HashSet};

use serde::{Deserialize, Serialize};

use super::conversion::Conversion;
use super::foreign::{self, Assumed, CameraOptions, ForeignCamera, Notes, Outgoing, Pose};
use super::lens::{Lens, LensModel};
use super::{Files, Imported};
use sightline::adjust;
use sightline::adjustment::Adjustment;
use sightline::error::{Error, Lack, Place, Reason, Result};
use sightline::project::{Camera, DatumKind, Distance, Observation, Photo, Point, Project, Role, Sigma};

/// A network as its file has it.
#[derive(Clone, Debug, Default)]
pub struct ForeignNetwork {
    /// Name.
    pub name: String,
    /// Unit of length, where the file has one.
    pub unit: Option<String>,
    /// Cameras.
    pub cameras: Vec<ForeignCamera>,
    /// Photos.
    pub photos: Vec<Photo>,
    /// Points.
    pub points: Vec<Point>,
    /// Image measurements.
    pub observations: Vec<Observation>,
    /// Scale bars.
    pub distances: Vec<Distance>,
    /// Assumptions and ignored contents.
    pub notes: Notes,
}

/// A photo of a reader.
pub fn photo(id: String, camera: String, file: &str, pose: Option<Pose>) -> Photo {
    Photo {
        id,
        camera,
        file: file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned(),
        position: pose.map(|pose| pose.position),
        rotation: pose.map(|pose| pose.angles()),
        enabled: true,
        ..Photo::default()
    }
}

/// A measurement of a reader, without a standard error of its own.
pub fn observation(photo: &str, point: &str, [u, v]: [f64; 2]) -> Observation {
    let (photo, point) = (photo.to_owned(), point.to_owned());
    Observation { photo, point, u, v, sigma: Sigma::One(1.0), enabled: true, target: None }
}

impl ForeignNetwork {
    /// The document, with cameras converted where they have to be.
    ///
    /// # Errors
    /// As [`foreign::settled`], and what a document may not have.
    pub fn into_imported(mut self, format: &'static str, convert: bool) -> Result<Imported> {
        self.single();
        let mut measured: HashMap<&str, [f64; 4]> = HashMap::new();
        let of_photo: HashMap<&str, &str> =
            self.photos.iter().map(|photo| (photo.id.as_str(), photo.camera.as_str())).collect();
        for seen in &self.observations {
            let Some(camera) = of_photo.get(seen.photo.as_str()) else { continue };
            let all = measured.entry(camera).or_insert([seen.u, seen.v, seen.u, seen.v]);
            *all = [all[0].min(seen.u), all[1].min(seen.v), all[2].max(seen.u), all[3].max(seen.v)];
        }
        let mut conversions = Vec::new();
        let mut cameras = Vec::with_capacity(self.cameras.len());
        for camera in &self.cameras {
            let used = measured.get(camera.id.as_str()).map(rectangle).filter(|used| used[0] != used[2]);
            let used = used.filter(|used| used[0][0] < used[2][0] && used[0][1] < used[2][1]);
            let settled = foreign::settled(camera, used.as_ref().map(|used| &used[..]), convert)?;
            conversions.extend(settled.conversion);
            cameras.push(settled.camera);
        }
        if self.unit.is_none() && (!self.points.is_empty() || self.photos.iter().any(|photo| photo.position.is_some()))
        {
            self.notes.assume(Assumed::UnitUnknown);
        }
        let mut project = Project {
            name: self.name,
            cameras,
            photos: self.photos.into(),
            points: self.points.into(),
            observations: self.observations.into(),
            distances: self.distances,
            ..Project::default()
        };
        if let Some(unit) = self.unit {
            project.unit = unit;
        }
        if project.points.iter().any(|point| point.role == Role::Control) {
            project.datum.kind = DatumKind::Control;
        }
        project.validate()?;
        Ok(Imported { project, recognised: Some(format), conversions, notes: self.notes, ..Imported::default() })
    }

    /// Keeps the first measurement of a point in a photo: a document has one, and feature trackers now and then join two to one point.
    fn single(&mut self) {
        let places: HashMap<&str, usize> =
            self.photos.iter().enumerate().map(|(k, photo)| (photo.id.as_str(), k)).collect();
        let points: HashMap<&str, usize> =
            self.points.iter().enumerate().map(|(k, point)| (point.id.as_str(), k)).collect();
        let mut seen = HashSet::with_capacity(self.observations.len());
        let before = self.observations.len();
        self.observations.retain(|o| match (places.get(o.photo.as_str()), points.get(o.point.as_str())) {
            (Some(photo), Some(point)) => seen.insert((*photo, *point)),
            // What is not known is named when the document is checked.
            _ => true,
        });
        self.notes.ignore("further measurements of a point in a photo", before - self.observations.len());
    }
}

fn rectangle(&[left, top, right, bottom]: &[f64; 4]) -> [[f64; 2]; 4] {
    [[left, top], [right, top], [right, bottom], [left, bottom]]
}

/// A photo that is written.
#[derive(Clone, Debug)]
pub struct OutgoingPhoto {
    /// Number from 1.
    pub number: usize,
    /// Identifier.
    pub id: String,
    /// File name; the identifier where there is none.
    pub file: String,
    /// Place of its camera in [`OutgoingNetwork::cameras`].
    pub camera: usize,
    /// Exterior orientation.
    pub pose: Pose,
    /// Its measurements in their order: pixel and place of the point.
    pub measured: Vec<([f64; 2], usize)>,
}

/// A point that is written.
#[derive(Clone, Debug)]
pub struct OutgoingPoint {
    /// Number from 1.
    pub number: usize,
    /// Identifier.
    pub id: String,
    /// Coordinates.
    pub xyz: [f64; 3],
    /// Place of each photo that sees it, and of the measurement there.
    pub seen: Vec<(usize, usize)>,
}

/// A network that is written.
#[derive(Clone, Debug, Default)]
pub struct OutgoingNetwork {
    /// Cameras with the values of the other program's model.
    pub cameras: Vec<(Camera, Outgoing)>,
    /// Photos.
    pub photos: Vec<OutgoingPhoto>,
    /// Points.
    pub points: Vec<OutgoingPoint>,
    /// Data that the file cannot hold.
    pub notes: Notes,
}

/// The models of a format and the terms of a camera that none of their parameters moves.
pub type Models<'a> = (&'a [&'static LensModel], fn(&Camera) -> Lens);

/// The project as it is after an adjustment, where there is one.
pub fn adjusted(project: &Project, adjustment: Option<&Adjustment>) -> Project {
    adjustment.map_or_else(|| project.clone(), |adjustment| adjust::apply(project, adjustment))
}

/// Whether all identifiers are different whole numbers from 1, which then are the numbers; else they are counted.
fn numbers<'a>(ids: impl Iterator<Item = &'a str> + Clone) -> Vec<usize> {
    let mut seen = HashSet::new();
    let own: Option<Vec<usize>> = ids
        .clone()
        .map(|id| {
            let number: usize = id.parse().ok().filter(|number| (1..=u32::MAX as usize).contains(number))?;
            (number.to_string() == id && seen.insert(number)).then_some(number)
        })
        .collect();
    own.unwrap_or_else(|| (1..=ids.count()).collect())
}

impl OutgoingNetwork {
    /// From a project, with the results of its adjustment. Photos without orientation and what only they measure stay out, with counts.
    ///
    /// # Errors
    /// [`Error::Empty`] without an oriented photo; as [`foreign::outgoing`].
    pub fn new(
        project: &Project,
        adjustment: Option<&Adjustment>,
        (shapes, base): Models<'_>,
        convert: bool,
    ) -> Result<Self> {
        let project = adjusted(project, adjustment);
        let mut all = Self::default();
        let known: HashMap<&str, &Camera> = project.cameras.iter().map(|camera| (camera.id.as_str(), camera)).collect();
        let oriented: Vec<&Photo> = project
            .photos
            .iter()
            .filter(|photo| {
                let whole = photo.position.is_some() && photo.rotation.is_some();
                let taken = photo.enabled && whole && known.contains_key(photo.camera.as_str());
                all.notes.ignore("photos without orientation or disabled", usize::from(!taken));
                taken
            })
            .collect();
        if oriented.is_empty() {
            return Err(Error::Empty { what: Lack::Photos });
        }
        let determined: Vec<&Point> = project
            .points
            .iter()
            .filter(|point| {
                all.notes.ignore("points without coordinates", usize::from(point.xyz.is_none()));
                point.xyz.is_some()
            })
            .collect();
        for ((point, xyz), number) in determined
            .iter()
            .filter_map(|point| Some((*point, point.xyz?)))
            .zip(numbers(determined.iter().map(|point| point.id.as_str())))
        {
            all.points.push(OutgoingPoint { number, id: point.id.clone(), xyz, seen: Vec::new() });
        }
        let place: HashMap<String, usize> = all.points.iter().enumerate().map(|(k, p)| (p.id.clone(), k)).collect();
        let photo_place: HashMap<&str, usize> =
            oriented.iter().enumerate().map(|(k, photo)| (photo.id.as_str(), k)).collect();
        let mut measured: Vec<Vec<([f64; 2], usize)>> = vec![Vec::new(); oriented.len()];
        for seen in project.observations.iter().filter(|seen| seen.enabled) {
            match (photo_place.get(seen.photo.as_str()), place.get(&seen.point)) {
                (Some(photo), Some(point)) => {
                    all.points[*point].seen.push((*photo, measured[*photo].len()));
                    measured[*photo].push(([seen.u, seen.v], *point));
                }
                _ => all.notes.ignore("observations of what is not written", 1),
            }
        }
        all.notes.ignore("disabled observations", project.observations.iter().filter(|seen| !seen.enabled).count());
        all.notes.ignore("standard errors of observations", usize::from(!project.observations.is_empty()));
        all.notes.ignore("given coordinates as such", determined.iter().filter(|p| p.role != Role::Tie).count());
        all.notes.ignore("distances", project.distances.len());
        all.notes.ignore("features", project.features.len());
        all.cameras(&oriented, &known, &measured, (shapes, base), convert)?;
        let numbers = numbers(oriented.iter().map(|photo| photo.id.as_str()));
        for ((k, photo), measured) in oriented.iter().enumerate().zip(measured) {
            let (Some(position), Some(rotation)) = (photo.position, photo.rotation) else { continue };
            all.photos.push(OutgoingPhoto {
                number: numbers[k],
                id: photo.id.clone(),
                file: if photo.file.is_empty() { photo.id.clone() } else { photo.file.clone() },
                camera: all.photos_camera(photo),
                pose: Pose::of(position, rotation),
                measured,
            });
        }
        Ok(all)
    }

    /// Place of a photo's camera: its own, if it has one.
    fn photos_camera(&self, photo: &Photo) -> usize {
        let own = own_id(photo);
        let place = |id: &str| self.cameras.iter().position(|(camera, _)| camera.id == id);
        place(&own).or_else(|| place(&photo.camera)).unwrap_or(0)
    }

    /// Cameras of the photos, one more for each photo with an interior orientation of its own, converted over what is measured.
    fn cameras(
        &mut self,
        photos: &[&Photo],
        known: &HashMap<&str, &Camera>,
        measured: &[Vec<([f64; 2], usize)>],
        (shapes, base): Models<'_>,
        convert: bool,
    ) -> Result<()> {
        let mut wanted: Vec<(Camera, Option<[f64; 4]>)> = Vec::new();
        let mut places: HashMap<String, usize> = HashMap::new();
        for (photo, measured) in photos.iter().zip(measured) {
            let Some(camera) = known.get(photo.camera.as_str()) else { continue };
            let mut camera = (*camera).clone();
            if camera.per_photo
                && let Some(interior) = photo.interior
            {
                camera.interior = interior;
                camera.id = own_id(photo);
            }
            let place = *places.entry(camera.id.clone()).or_insert_with(|| {
                wanted.push((camera, None));
                wanted.len() - 1
            });
            for ([u, v], _) in measured {
                let all = wanted[place].1.get_or_insert([*u, *v, *u, *v]);
                *all = [all[0].min(*u), all[1].min(*v), all[2].max(*u), all[3].max(*v)];
            }
        }
        for (camera, used) in wanted {
            for ignored in foreign::unkept(&camera, false) {
                self.notes.ignore(&ignored.name, ignored.count);
            }
            let used = used.filter(|used| used[0] < used[2] && used[1] < used[3]);
            let region = used.as_ref().map(|used| rectangle(used).to_vec());
            let options = CameraOptions { region, convert, covariance: None };
            let out = foreign::outgoing(&camera, shapes, &base(&camera), &options)?;
            self.cameras.push((camera, out));
        }
        Ok(())
    }

    /// Conversions.
    pub fn conversions(&self) -> Vec<Conversion> {
        self.cameras.iter().filter_map(|(_, out)| out.conversion.clone()).collect()
    }

    /// `interchange.json` beside the files: what was converted, what has no place in the format, and numbers of identifiers that are none.
    ///
    /// # Errors
    /// [`Reason::CannotWriteJson`].
    pub fn companion(&self) -> Result<(String, Vec<u8>)> {
        let named = |all: &mut dyn Iterator<Item = (usize, &str)>| -> BTreeMap<usize, String> {
            all.filter(|(number, id)| number.to_string() != *id).map(|(number, id)| (number, id.to_owned())).collect()
        };
        companion(&Companion {
            conversions: self.conversions(),
            photos: named(&mut self.photos.iter().map(|photo| (photo.number, photo.id.as_str()))),
            points: named(&mut self.points.iter().map(|point| (point.number, point.id.as_str()))),
            ignored: &self.notes.ignored,
        })
    }
}

/// Name of the file beside those of a network.
const COMPANION: &str = "interchange.json";

/// Additional information with the written files of a network.
#[derive(Serialize)]
pub struct Companion<'a> {
    /// Conversions of cameras.
    pub conversions: Vec<Conversion>,
    /// Identifiers of photos by their numbers in the files.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub photos: BTreeMap<usize, String>,
    /// Identifiers of points by their numbers in the files.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub points: BTreeMap<usize, String>,
    /// Data that the format cannot hold.
    pub ignored: &'a [foreign::Ignored],
}

/// `interchange.json`.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn companion(content: &Companion<'_>) -> Result<(String, Vec<u8>)> {
    let json = serde_json::to_vec_pretty(content).map_err(|error| Error::Invalid {
        reason: Reason::CannotWriteJson { message: error.to_string() },
        at: Place::default(),
    })?;
    Ok((COMPANION.to_owned(), json))
}

fn own_id(photo: &Photo) -> String {
    format!("{} {}", photo.camera, photo.id)
}

/// Files of a written network with its companion.
///
/// # Errors
/// As [`OutgoingNetwork::companion`].
pub fn with_companion(mut files: Files, network: &OutgoingNetwork) -> Result<Files> {
    files.extend([network.companion()?]);
    Ok(files)
}

/// What `interchange.json` of written files states: conversions of cameras, and what has no place in the format. Nothing for files
/// without it.
pub fn stated(files: &Files) -> (Vec<Conversion>, Vec<foreign::Ignored>) {
    #[derive(Default, Deserialize)]
    struct Stated {
        conversions: Vec<Conversion>,
        ignored: Vec<foreign::Ignored>,
    }
    let read = files.get(COMPANION).and_then(|json| serde_json::from_slice::<Stated>(json).ok()).unwrap_or_default();
    (read.conversions, read.ignored)
}
