//! The sample project as it comes on the desk.

use sightline::detection::Detection;
use sightline::project::Project;

use super::targets;
use crate::document::Document;

/// The sample with those of its photos that were made: of each, by the name of its file, the digest and what was detected.
pub fn document(project: &Project, name: &str, made: impl Fn(&str) -> Option<(String, Detection)>) -> Document {
    let mut project = Project { name: name.to_owned(), ..project.clone() };
    let mut detected = Vec::new();
    project.photos.retain_mut(|photo| {
        let Some((sha256, detection)) = made(&photo.file) else { return false };
        photo.sha256 = sha256;
        detected.push((photo.id.clone(), detection));
        true
    });
    let mut document = Document { project: project.into(), ..Document::default() };
    for (photo, detection) in detected {
        targets::take_detection(&mut document, &photo, detection, None);
    }
    document
}

#[cfg(test)]
mod tests {
    use sightline::detection::Target;
    use sightline::project::Photo;

    use super::super::undoing::target;
    use super::*;

    #[test]
    fn photos_that_were_made_are_there_with_their_files_and_targets() {
        let photo = |id: &str| Photo { id: id.into(), file: format!("{id}.jpg"), enabled: true, ..Photo::default() };
        let sample = Project { name: "engine".into(), photos: ["1", "2", "3"].map(photo).into(), ..Project::default() };
        let coded = |code| Target { code: Some(code), ..target(code, 10.0, 5.0) };
        let made = |file: &str| {
            let (digest, code) = match file {
                "1.jpg" => ("a", 7),
                "3.jpg" => ("c", 9),
                _ => return None,
            };
            Some((digest.to_owned(), Detection { targets: vec![coded(code)], ..Detection::default() }))
        };
        let document = document(&sample, "A sample", made);
        let project = &document.project;
        let photos: Vec<_> = project.photos.iter().map(|p| (p.id.as_str(), p.sha256.as_str())).collect();
        assert_eq!((project.name.as_str(), photos), ("A sample", vec![("1", "a"), ("3", "c")]));
        let found: Vec<_> = document.detections.iter().map(|(id, d)| (id.as_str(), d.targets[0].code)).collect();
        assert_eq!(found, [("1", Some(7)), ("3", Some(9))]);
        let seen: Vec<_> = project.observations.iter().map(|o| (o.photo.as_str(), o.point.as_str())).collect();
        assert_eq!(seen, [("1", "7"), ("3", "9")]);
    }
}
