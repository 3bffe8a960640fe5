//! What a camera is written with for other programs: the part of the picture that is measured, and the covariance of its parameters.

use sightline::adjustment::AdjustedCamera;
use sightline::project::Project;
use sightline_exchange::conversion::Covariance;

/// The rectangle of all measurements in a camera's photos, as a polygon of pixels; `None` if they have no extent.
pub fn measured_region(project: &Project, camera: &str) -> Option<Vec<[f64; 2]>> {
    let photos: std::collections::HashSet<&str> =
        project.photos.iter().filter(|photo| photo.camera == camera).map(|photo| photo.id.as_str()).collect();
    let measured = project.observations.iter().filter(|o| o.enabled && photos.contains(o.photo.as_str()));
    let [left, top, right, bottom] = measured.fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |all, o| {
        [all[0].min(o.u), all[1].min(o.v), all[2].max(o.u), all[3].max(o.v)]
    });
    (left < right && top < bottom).then(|| vec![[left, top], [right, top], [right, bottom], [left, bottom]])
}

/// C_ij = σ_i σ_j ρ_ij of the estimated parameters; `None` without them.
pub fn parameter_covariance(adjusted: &AdjustedCamera) -> Option<Covariance> {
    let parameters = adjusted.correlation.names.clone();
    let named = |name: &String| adjusted.sigma.iter().find(|(p, _)| p.name() == name).map(|(_, sigma)| *sigma);
    let sigmas = parameters.iter().map(named).collect::<Option<Vec<f64>>>()?;
    let row = |(row, si): (&Vec<f64>, &f64)| row.iter().zip(&sigmas).map(|(r, sj)| r * si * sj).collect::<Vec<_>>();
    let matrix: Vec<Vec<f64>> = adjusted.correlation.matrix.iter().zip(&sigmas).map(row).collect();
    let square = matrix.len() == parameters.len() && matrix.iter().all(|row| row.len() == parameters.len());
    (square && !parameters.is_empty()).then_some(Covariance { parameters, matrix })
}

#[cfg(test)]
mod tests {
    use sightline::adjustment::Correlation;
    use sightline::project::{Camera, Interior, Observation, Parameter, Photo, Sigma};

    use super::*;

    #[test]
    fn the_region_holds_what_takes_part_in_the_camera_s_photos() {
        let seen = |photo: &str, u: f64, v: f64, enabled: bool| Observation {
            photo: photo.into(),
            point: "p".into(),
            u,
            v,
            sigma: Sigma::One(0.1),
            enabled,
            target: None,
        };
        let photo = |id: &str, camera: &str| Photo { id: id.into(), camera: camera.into(), ..Photo::default() };
        let project = Project {
            photos: vec![photo("1", "a"), photo("2", "b")].into(),
            observations: vec![
                seen("1", 10.0, 20.0, true),
                seen("1", 30.0, 5.0, true),
                seen("1", 99.0, 99.0, false),
                seen("2", 500.0, 500.0, true),
            ]
            .into(),
            ..Project::default()
        };
        let region = measured_region(&project, "a").expect("measured");
        assert_eq!(region, [[10.0, 5.0], [30.0, 5.0], [30.0, 20.0], [10.0, 20.0]]);
        assert_eq!(measured_region(&project, "b"), None);
        assert_eq!(measured_region(&project, "c"), None);
    }

    #[test]
    fn the_covariance_is_that_of_the_estimated_parameters() {
        let mut adjusted = AdjustedCamera {
            camera: Camera::new("a", 640, 480, Interior::brown(500.0)),
            photo: None,
            sigma: [(Parameter::C, 2.0), (Parameter::K1, 0.5)].into(),
            significance: Default::default(),
            correlation: Correlation {
                names: vec!["c".into(), "k1".into()],
                matrix: vec![vec![1.0, -0.5], vec![-0.5, 1.0]],
            },
        };
        let covariance = parameter_covariance(&adjusted).expect("estimated");
        assert_eq!(covariance.parameters, ["c", "k1"]);
        assert_eq!(covariance.matrix, [[4.0, -0.5], [-0.5, 0.25]]);
        adjusted.correlation = Correlation { names: Vec::new(), matrix: Vec::new() };
        assert_eq!(parameter_covariance(&adjusted), None);
    }
}
