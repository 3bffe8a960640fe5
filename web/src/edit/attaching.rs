//! Finds the photo of a project to which a file belongs: by SHA-256, else by name if no measurement can be mistaken.
//!
//! Cameras restart their numbering and folders repeat names, so that a name alone does not identify a photo. A file whose contents are others than those
//! recorded, or a photo with measurements and nothing recorded, is a question; nothing is attached before it is answered.

use std::collections::BTreeSet;

use sightline::project::{Photo, Project};

use crate::document::Document;

/// A file that comes in.
#[derive(Clone, Copy, Debug)]
pub struct Arriving<'a> {
    pub name: &'a str,
    pub sha256: &'a str,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

/// Where a file belongs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Belongs {
    /// It is this photo of the project.
    To(String),
    /// It is none of them.
    Nowhere,
    /// It has the name of this photo and other contents.
    Differs(String),
    /// It has the name and size of this photo; nothing recorded tells whether it is the one that was measured.
    Unrecorded(String),
}

/// Name of a file without folders, in lower case, with one ending for JPEG.
fn plain(file: &str) -> String {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file).to_lowercase();
    name.strip_suffix(".jpeg").map(|stem| format!("{stem}.jpg")).unwrap_or(name)
}

/// Where a file belongs among the photos that wait for theirs.
pub fn belongs(document: &Document, waiting: &dyn Fn(&Photo) -> bool, file: Arriving) -> Belongs {
    let project: &Project = &document.project;
    let all = || project.photos.iter().filter(|photo| waiting(photo));
    let same = |photo: &&Photo| !photo.sha256.is_empty() && photo.sha256.eq_ignore_ascii_case(file.sha256);
    if let Some(photo) = all().find(same) {
        return Belongs::To(photo.id.clone());
    }
    let named: Vec<&Photo> = all().filter(|photo| plain(&photo.file) == plain(file.name)).collect();
    let Some(first) = named.first() else { return Belongs::Nowhere };
    let unrecorded = |photo: &&&Photo| {
        let camera = project.cameras.iter().find(|camera| camera.id == photo.camera);
        photo.sha256.is_empty() && camera.is_none_or(|camera| [camera.width, camera.height] == file.size)
    };
    match named.iter().find(unrecorded) {
        Some(photo) if is_measured(document, &photo.id) => Belongs::Unrecorded(photo.id.clone()),
        Some(photo) => Belongs::To(photo.id.clone()),
        None => Belongs::Differs(first.id.clone()),
    }
}

fn is_measured(document: &Document, photo: &str) -> bool {
    document.detections.contains_key(photo) || document.project.observations.iter().any(|o| o.photo == photo)
}

/// Whether [`record`] would have something to note: a project that it changes is stored again.
pub fn is_unrecorded(project: &Project, photo: &str) -> bool {
    project.photos.iter().any(|known| known.id == photo && known.sha256.is_empty())
}

/// Records the contents of a photo's file; whether it is new.
pub fn record(project: &mut Project, photo: &str, sha256: &str) -> bool {
    let found = project.photos.iter_mut().find(|known| known.id == photo && known.sha256.is_empty());
    match found.filter(|_| !sha256.is_empty()) {
        Some(photo) => {
            sha256.clone_into(&mut photo.sha256);
            true
        }
        None => false,
    }
}

/// Puts the last photo in the place of another one, which goes with all that was measured in it.
pub fn replace(document: &mut Document, old: &str) {
    let photos = &mut document.project_mut().photos;
    if let Some(place) = photos.iter().position(|photo| photo.id == old)
        && let Some(new) = photos.pop()
    {
        photos.insert(place, new);
    }
    super::cameras::remove_photos(document, &BTreeSet::from([old.to_owned()]));
}

#[cfg(test)]
mod tests {
    use sightline::project::{Camera, Interior, Observation, Sigma};

    use super::*;

    fn document() -> Document {
        let mut d = Document::default();
        let photo = |id: &str, file: &str, sha256: &str| Photo {
            id: id.into(),
            camera: "k".into(),
            file: file.into(),
            sha256: sha256.into(),
            ..Photo::default()
        };
        let observation = |photo: &str| Observation {
            photo: photo.into(),
            point: "p".into(),
            u: 1.0,
            v: 1.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: None,
        };
        let project = d.project_mut();
        project.cameras = vec![Camera::new("k", 60, 40, Interior::brown(50.0))];
        project.photos = vec![
            photo("1", "DSC_0001.JPG", "aa"),
            photo("2", "day 2/DSC_0001.JPG", "bb"),
            photo("3", "old.tif", ""),
            photo("4", "fresh.png", ""),
        ]
        .into();
        project.observations = vec![observation("1"), observation("3")].into();
        d
    }

    fn asked(d: &Document, name: &str, sha256: &str, size: [u32; 2]) -> Belongs {
        belongs(d, &|_| true, Arriving { name, sha256, size })
    }

    #[test]
    fn contents_decide_and_names_ask() {
        let d = document();
        let to = |id: &str| Belongs::To(id.into());
        const SIZE: [u32; 2] = [60, 40];
        // The same contents, whatever the name, the folder and the case.
        for name in ["DSC_0001.JPG", "dsc_0001.jpg", "c:\\x\\DSC_0001.jpeg", "renamed.jpg"] {
            assert_eq!(asked(&d, name, "aa", SIZE), to("1"), "{name}");
            assert_eq!(asked(&d, name, "BB", SIZE), to("2"), "{name}");
        }
        // The same name, other contents: of another day, or of the other folder.
        for name in ["DSC_0001.JPG", "dsc_0001.jpg", "dsc_0001.JPEG"] {
            assert_eq!(asked(&d, name, "cc", SIZE), Belongs::Differs("1".into()), "{name}");
        }
        // Nothing recorded: measured photos are asked about, others are taken.
        assert_eq!(asked(&d, "OLD.TIF", "dd", SIZE), Belongs::Unrecorded("3".into()));
        assert_eq!(asked(&d, "old.tif", "dd", [40, 60]), Belongs::Differs("3".into()));
        assert_eq!(asked(&d, "fresh.png", "dd", SIZE), to("4"));
        assert_eq!(asked(&d, "fresh.png", "dd", [61, 40]), Belongs::Differs("4".into()));
        assert_eq!(asked(&d, "other.jpg", "dd", SIZE), Belongs::Nowhere);
        // A photo that has its file does not wait.
        let waiting = |photo: &Photo| photo.id != "1" && photo.id != "2";
        let arriving = Arriving { name: "DSC_0001.JPG", sha256: "cc", size: SIZE };
        assert_eq!(belongs(&d, &waiting, arriving), Belongs::Nowhere);
    }

    #[test]
    fn contents_are_recorded_once() {
        let mut d = document();
        let project = d.project_mut();
        assert!(!record(project, "1", "cc") && !record(project, "3", "") && !record(project, "9", "dd"));
        assert!(record(project, "3", "dd") && !record(project, "3", "ee"));
        assert_eq!(project.photos[2].sha256, "dd");
    }

    #[test]
    fn a_replaced_photo_goes_with_its_measurements_and_the_new_one_takes_its_place() {
        let mut d = document();
        d.project_mut().photos.push(Photo { id: "5".into(), camera: "k".into(), ..Photo::default() });
        replace(&mut d, "1");
        let ids: Vec<&str> = d.project.photos.iter().map(|photo| photo.id.as_str()).collect();
        assert_eq!(ids, ["5", "2", "3", "4"]);
        assert!(d.project.observations.iter().all(|o| o.photo != "1"));
    }
}
