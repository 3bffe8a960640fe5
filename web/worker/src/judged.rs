//! An adjusted camera judged for the page: how well it predicts pixels, and what its residuals are by column and row.

use sightline::calibration::{
    BandOptions, DistanceOptions, UncertaintyOptions, projection_uncertainty, residual_bands, uncertainty_over_distance,
};
use sightline_protocol::{CameraJudged, Given, JudgeCamera, Nothing, Progress, Served, Service};

use crate::Engine;

impl Service<JudgeCamera> for Engine {
    fn serve(&self, task: JudgeCamera, _: Vec<Given>, _: Progress<Nothing>) -> Served<CameraJudged> {
        let JudgeCamera { project, adjustment, camera } = task;
        let camera = Some(camera);
        let asked = UncertaintyOptions { camera: camera.clone(), ..UncertaintyOptions::default() };
        let uncertainty = projection_uncertainty(&project, &adjustment, &asked)?;
        let asked = BandOptions { camera: camera.clone(), ..BandOptions::default() };
        let bands = residual_bands(&project, &adjustment, &asked)?;
        // Robust weights leave no covariance with the photos; the rest is told all the same.
        let asked = DistanceOptions { camera, ..DistanceOptions::default() };
        let (distance, why) = match uncertainty_over_distance(&project, &adjustment, &asked) {
            Ok(found) => (Some(found), None),
            Err(error) => (None, Some(error)),
        };
        Ok((CameraJudged { uncertainty, distance, why, bands }, Vec::new()))
    }
}
