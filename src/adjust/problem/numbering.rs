//! Which photo, point and camera each row of a document means, as places in its lists: looked up by name once, or known beforehand by
//! whoever made the document.

use std::collections::HashMap;

use crate::project::Project;

/// Places in place of names.
#[derive(Clone, Debug, Default)]
pub struct Numbering {
    /// Of every observation its photo and its point.
    pub observations: Vec<(usize, usize)>,
    /// Of every photo its camera.
    pub cameras: Vec<usize>,
    /// Of every distance its ends.
    pub ends: Vec<[usize; 2]>,
    /// Of every exposure of the rig its photos; a photo that is not in the document is none.
    pub together: Vec<Vec<Option<usize>>>,
    /// Points that define the datum, if the document names them.
    pub datum: Option<Vec<usize>>,
}

impl Numbering {
    /// The numbering of a valid document.
    pub fn of(project: &Project) -> Self {
        fn places<'a>(ids: impl Iterator<Item = &'a String>) -> HashMap<&'a str, usize> {
            ids.enumerate().map(|(k, id)| (id.as_str(), k)).collect()
        }
        let photos = places(project.photos.iter().map(|p| &p.id));
        let points = places(project.points.iter().map(|p| &p.id));
        let cameras = places(project.cameras.iter().map(|c| &c.id));
        let point = |id: &String| points[id.as_str()];
        Self {
            observations: project.observations.iter().map(|o| (photos[o.photo.as_str()], point(&o.point))).collect(),
            cameras: project.photos.iter().map(|p| cameras[p.camera.as_str()]).collect(),
            ends: project.distances.iter().map(|d| [point(&d.from), point(&d.to)]).collect(),
            together: project
                .rig
                .iter()
                .flat_map(|rig| &rig.exposures)
                .map(|row| row.iter().map(|id| photos.get(id.as_deref()?).copied()).collect())
                .collect(),
            datum: project.datum.points.as_ref().map(|ids| ids.iter().map(point).collect()),
        }
    }
}
