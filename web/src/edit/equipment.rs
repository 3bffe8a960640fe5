//! Use of stored equipment in a project: calibrations for its cameras, distances from scale bars.

use sightline::equipment::{Calibration, ScaleBar, Use, bars_in};

use crate::document::Document;

/// Gives a camera the values of a calibration; whether it is there.
pub fn use_calibration(document: &mut Document, camera: &str, calibration: &Calibration, how: Use) -> bool {
    // What its parameters were observed with before belongs to the values before.
    document.sigmas_of_held.retain(|(of, _), _| of != camera);
    let project = document.project_mut();
    let found = project.cameras.iter_mut().find(|c| c.id == camera);
    found.map(|camera| calibration.apply(camera, how)).is_some()
}

/// Adds the distances of the scale bars whose ends are measured; how many.
pub fn take_bars(document: &mut Document, bars: &[ScaleBar]) -> usize {
    let found: Vec<_> = bars_in(bars, &document.project).into_iter().map(|(_, distance)| distance).collect();
    let count = found.len();
    if count > 0 {
        document.project_mut().distances.extend(found);
    }
    count
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sightline::project::{Camera, Interior, Observation, Parameter, Photo, Point, Project, Sigma};

    use super::*;
    use crate::edit::cameras::set_free;

    fn calibration() -> Calibration {
        Calibration {
            date: "2026-05-01".into(),
            pixel_pitch: None,
            interior: Interior::brown(9000.0),
            sigma: [(Parameter::C, 0.5)].into(),
            remark: String::new(),
            origin: None,
        }
    }

    #[test]
    fn a_calibration_replaces_values_and_what_they_were_observed_with() {
        let camera = Camera {
            free: vec![Parameter::K1],
            sigma: [(Parameter::K1, 1.0)].into(),
            ..Camera::new("k", 10, 8, Interior::brown(1.0))
        };
        let project = Project { cameras: vec![camera], ..Project::default() };
        let mut d = Document { project: Arc::new(project), ..Document::default() };
        set_free(&mut d, "k", Parameter::K1, false);
        assert_eq!(d.sigmas_of_held.len(), 1);
        assert!(use_calibration(&mut d, "k", &calibration(), Use::Observed));
        assert!(d.sigmas_of_held.is_empty());
        assert_eq!(d.project.cameras[0].sigma, [(Parameter::C, 0.5)].into());
        assert_eq!(d.project.cameras[0].free, [Parameter::C]);
        assert!(!use_calibration(&mut d, "none", &calibration(), Use::Held));
    }

    #[test]
    fn a_bar_is_taken_once() {
        let observation = |photo: &str, point: &str| Observation {
            photo: photo.into(),
            point: point.into(),
            u: 1.0,
            v: 1.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: None,
        };
        let both = ["1", "2"].map(|photo| ["a", "b"].map(|point| observation(photo, point)));
        let project = Project {
            photos: ["1", "2"].map(|id| Photo { id: id.into(), enabled: true, ..Photo::default() }).into(),
            points: ["a", "b"].map(|id| Point { id: id.into(), ..Point::default() }).into(),
            observations: both.into_iter().flatten().collect(),
            ..Project::default()
        };
        let mut d = Document { project: Arc::new(project), ..Document::default() };
        let bar = ScaleBar {
            id: "A".into(),
            from: "a".into(),
            to: "b".into(),
            length: 1.0,
            sigma: 0.001,
            unit: "m".into(),
            certificate: String::new(),
            date: String::new(),
        };
        assert_eq!(take_bars(&mut d, std::slice::from_ref(&bar)), 1);
        assert_eq!((d.project.unit.as_str(), d.project.distances[0].length), ("mm", 1000.0));
        assert_eq!(take_bars(&mut d, &[bar]), 0);
    }
}
