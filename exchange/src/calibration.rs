//! A record of the calibration of cameras as one file: parameters with their units, standard errors, the correlation matrix, and what they were
//! determined with. `calibration.json` is for programs, `calibration.csv` the same for spreadsheets.
//!
//! Standard errors are those of the adjustment (a posteriori, as the report's). The matrix holds the estimated parameters in the order of their
//! names; parameters that were held have no standard error and are not in it. Without an adjustment there are values only.

use std::fmt::Write;

use serde::Serialize;

use super::results::digits;
use super::text::{disarmed, quoted};
use sightline::adjustment::{Adjustment, Correlation};
use sightline::camera::parameter_unit;
use sightline::error::{Error, Lack, Reason, Result};
use sightline::project::{Camera, Parameter, Project};

/// A parameter of a camera.
#[derive(Serialize)]
struct Value {
    name: &'static str,
    unit: String,
    value: f64,
    /// Null: it was held.
    sigma: Option<f64>,
}

/// Properties of a camera.
#[derive(Serialize)]
struct Record {
    camera: String,
    /// The photo whose own interior orientation it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    photo: Option<String>,
    model: &'static str,
    width: u32,
    height: u32,
    /// Millimetres.
    pixel_pitch: Option<[f64; 2]>,
    parameters: Vec<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    correlation: Option<Correlation>,
}

#[derive(Serialize)]
struct Records {
    format: &'static str,
    version: u32,
    project: String,
    sigma0: Option<f64>,
    redundancy: Option<usize>,
    photos: usize,
    observations: usize,
    cameras: Vec<Record>,
}

fn record(camera: &Camera, photo: Option<&str>, found: Option<&sightline::adjustment::AdjustedCamera>) -> Record {
    let interior = &camera.interior;
    let parameters = interior.parameters().iter().filter(|parameter| **parameter != Parameter::F).map(|&parameter| {
        let sigma = found.and_then(|found| {
            let common = matches!(parameter, Parameter::Fx | Parameter::Fy).then_some(Parameter::F);
            found.sigma.get(&parameter).or_else(|| found.sigma.get(&common?)).copied()
        });
        let value = interior.get(parameter).unwrap_or_default();
        Value { name: parameter.name(), unit: parameter_unit(camera, parameter), value, sigma }
    });
    Record {
        camera: camera.id.clone(),
        photo: photo.map(str::to_owned),
        model: interior.model().name,
        width: camera.width,
        height: camera.height,
        pixel_pitch: camera.pixel_pitch,
        parameters: parameters.collect(),
        correlation: found.map(|found| found.correlation.clone()).filter(|matrix| !matrix.names.is_empty()),
    }
}

/// `calibration.json` and `calibration.csv`.
///
/// # Errors
/// [`Error::Empty`] for a project without cameras.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> Result<super::Files> {
    let found = adjustment.map(|adjustment| adjustment.cameras.as_slice()).unwrap_or_default();
    let mut cameras: Vec<Record> =
        found.iter().map(|found| record(&found.camera, found.photo.as_deref(), Some(found))).collect();
    let adjusted = |camera: &&Camera| found.iter().any(|found| found.camera.id == camera.id);
    cameras.extend(project.cameras.iter().filter(|camera| !adjusted(camera)).map(|camera| record(camera, None, None)));
    if cameras.is_empty() {
        return Err(Error::Empty { what: Lack::Cameras });
    }
    let records = Records {
        format: "sightline-calibration",
        version: 1,
        project: project.name.clone(),
        sigma0: adjustment.and_then(|adjustment| adjustment.sigma0),
        redundancy: adjustment.map(|adjustment| adjustment.redundancy),
        photos: project.photos.iter().filter(|photo| photo.enabled).count(),
        observations: project.observations.iter().filter(|observation| observation.enabled).count(),
        cameras,
    };
    let json = serde_json::to_vec_pretty(&records).map_err(|error| Error::Invalid {
        reason: Reason::CannotWriteJson { message: error.to_string() },
        at: Default::default(),
    })?;
    let table = table(&records.cameras);
    Ok(super::Files::from([("calibration.json".to_owned(), json), ("calibration.csv".to_owned(), table.into_bytes())]))
}

fn table(cameras: &[Record]) -> String {
    // The mark tells spreadsheets that it is UTF-8.
    let mut text = String::from("\u{feff}");
    for camera in cameras {
        let matrix = camera.correlation.as_ref();
        let name = quoted(&disarmed(&camera.camera), ',').into_owned();
        let photo = camera.photo.as_deref().map(|id| quoted(&disarmed(id), ',').into_owned()).unwrap_or_default();
        // Writing into a string does not fail.
        let names = matrix.map(|matrix| matrix.names.join(",")).unwrap_or_default();
        let _ =
            writeln!(text, "camera,photo,parameter,unit,value,sigma{}{names}", if names.is_empty() { "" } else { "," });
        for parameter in &camera.parameters {
            let value = digits(parameter.value, parameter.sigma);
            let sigma = parameter.sigma.map(|sigma| digits(sigma, Some(sigma))).unwrap_or_default();
            let _ = write!(text, "{name},{photo},{},{},{value},{sigma}", parameter.name, parameter.unit);
            let row = matrix.and_then(|matrix| {
                let own = matrix.names.iter().position(|name| name == parameter.name)?;
                matrix.matrix.get(own)
            });
            for correlation in row.into_iter().flatten() {
                let _ = write!(text, ",{correlation:.3}");
            }
            text.push('\n');
        }
        text.push('\n');
    }
    text
}
