//! Cameras fixed to each other: which photos were taken together.

use sightline::project::{Project, Rig};
use sightline::units::factor;

use super::natural;

/// Standard errors that a new rig starts with: what a rigid bar of half a metre keeps, in millimetres and radians.
const POSITION_MM: f64 = 0.05;
const ROTATION: f64 = 1e-4;

/// Why a photo cannot be where it was put.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// No photo has this name.
    NoPhoto(String),
    /// The column is of another camera.
    OtherCamera { photo: String, camera: String },
}

/// The first photo of every camera taken together, the second one, and so on, in the order of their names: what cameras that release
/// together leave. None with fewer than two cameras that have photos.
pub fn proposed(project: &Project) -> Option<Rig> {
    let of = |camera: &String| -> Vec<String> {
        let mut photos: Vec<&String> =
            project.photos.iter().filter(|p| p.camera == *camera && p.enabled).map(|p| &p.id).collect();
        photos.sort_by(|a, b| natural(a, b));
        photos.into_iter().cloned().collect()
    };
    let columns: Vec<Vec<String>> =
        project.cameras.iter().map(|c| of(&c.id)).filter(|photos| !photos.is_empty()).collect();
    if columns.len() < 2 {
        return None;
    }
    let most = columns.iter().map(Vec::len).max().unwrap_or(0);
    let exposure = |row: usize| columns.iter().map(|photos| photos.get(row).cloned()).collect::<Vec<_>>();
    let together = (0..most).map(exposure).filter(|photos| photos.iter().flatten().count() > 1);
    // A unit without a known length is taken for millimetres, as everywhere.
    let millimetre = factor("mm", &project.unit).unwrap_or(1.0);
    Some(Rig { exposures: together.collect(), sigma_position: POSITION_MM * millimetre, sigma_rotation: ROTATION })
}

/// Camera of every column of the project's rig: that of its first photo.
pub fn cameras(project: &Project) -> Vec<Option<String>> {
    let Some(rig) = &project.rig else { return Vec::new() };
    let camera = |id: &String| project.photos.iter().find(|p| p.id == *id).map(|p| p.camera.clone());
    let first = |column: usize| rig.exposures.iter().filter_map(|row| row.get(column)?.as_ref()).find_map(camera);
    (0..rig.cameras()).map(first).collect()
}

/// Puts a photo into an exposure; an empty name takes out what is there. A photo that stood elsewhere changes places.
///
/// # Errors
/// [`Refused`].
pub fn put(project: &mut Project, row: usize, column: usize, name: &str) -> Result<(), Refused> {
    let name = name.trim();
    let columns = cameras(project);
    let photo = if name.is_empty() {
        None
    } else {
        let photo = project.photos.iter().find(|p| p.id == name).ok_or_else(|| Refused::NoPhoto(name.to_owned()))?;
        if let Some(Some(camera)) = columns.get(column)
            && photo.camera != *camera
        {
            return Err(Refused::OtherCamera { photo: name.to_owned(), camera: camera.clone() });
        }
        Some(photo.id.clone())
    };
    let Some(rig) = &mut project.rig else { return Ok(()) };
    let Some(before) = rig.exposures.get(row).and_then(|r| r.get(column)).cloned() else { return Ok(()) };
    if photo.is_some() {
        let elsewhere = rig.exposures.iter_mut().flatten().find(|other| **other == photo);
        if let Some(elsewhere) = elsewhere {
            *elsewhere = before;
        }
    }
    rig.exposures[row][column] = photo;
    Ok(())
}

#[cfg(test)]
mod tests {
    use sightline::project::{Camera, Interior, Photo};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn project() -> Project {
        let photo =
            |id: &str, camera: &str| Photo { id: id.into(), camera: camera.into(), enabled: true, ..Photo::default() };
        let mut project = Project {
            unit: "m".into(),
            cameras: ["left", "right"].map(|id| Camera::new(id, 100, 80, Interior::brown(90.0))).into(),
            photos: vec![photo("l10", "left"), photo("l9", "left"), photo("r1", "right"), photo("r2", "right")].into(),
            ..Project::default()
        };
        project.rig = proposed(&project).map(Box::new);
        project
    }

    #[test]
    fn photos_are_paired_in_the_order_of_their_names() {
        let project = project();
        let rig = project.rig.clone().expect("two cameras");
        let rows: Vec<Vec<&str>> =
            rig.exposures.iter().map(|row| row.iter().flatten().map(String::as_str).collect()).collect();
        assert_eq!(rows, [["l9", "r1"], ["l10", "r2"]]);
        assert!((rig.sigma_position - 5e-5).abs() < 1e-12, "{}", rig.sigma_position);
        assert_eq!(cameras(&project), [Some("left".to_owned()), Some("right".to_owned())]);
        project.validate().expect("sound");
    }

    #[test]
    fn a_photo_that_stood_elsewhere_changes_places() {
        let mut project = project();
        put(&mut project, 0, 1, "r2").expect("taken");
        let second =
            |p: &Project| p.rig.as_ref().expect("a rig").exposures.iter().map(|r| r[1].clone()).collect::<Vec<_>>();
        assert_eq!(second(&project), [Some("r2".to_owned()), Some("r1".to_owned())]);
        put(&mut project, 1, 1, " ").expect("taken out");
        assert_eq!(second(&project)[1], None);
        assert_eq!(put(&mut project, 1, 1, "x"), Err(Refused::NoPhoto("x".into())));
        let other = Refused::OtherCamera { photo: "l9".into(), camera: "right".into() };
        assert_eq!(put(&mut project, 1, 1, "l9"), Err(other));
        project.validate().expect("sound");
    }
}
